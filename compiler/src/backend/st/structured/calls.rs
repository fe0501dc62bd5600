//! Calls of blocks in the program.

use super::POINT;
use super::access::{COORDINATES, Place, Places};
use super::units::Given;
use crate::backend::st::code::{Ex, Stmt, name};
use crate::backend::st::context::Shared;
use crate::backend::st::declaration::{Basic, Unit, Variable, constants};
use crate::backend::st::globals::{Table, about};
use crate::ir::Value;
use crate::naming::st::Scope;
use std::collections::{BTreeMap, HashMap};
use std::rc::Rc;

pub struct Calls<'a> {
    shared: Shared<'a>,
    /// By the name of an instance.
    blocks: HashMap<&'a str, &'a Given>,
    robots: HashMap<&'a str, usize>,
    scope: &'a mut Scope,
    /// Points that robots are given, by robot and number of the parameter.
    named: BTreeMap<(usize, usize), String>,
    pub parameters: Vec<Table>,
}

impl<'a> Calls<'a> {
    pub fn new(shared: Shared<'a>, given: &'a [Given], program: &'a Unit, scope: &'a mut Scope) -> Self {
        let of = |block: &str| given.iter().find(|given| given.unit.name == block);
        let blocks: HashMap<&str, &Given> =
            program.instances.iter().filter_map(|i| Some((i.name.as_str(), of(&i.block)?))).collect();
        let robots = shared.names.robots.iter().enumerate();
        let robots = robots.flat_map(|(robot, names)| {
            [(names.instance.as_str(), robot), (names.properties.as_str(), robot)]
        });
        Self {
            shared,
            blocks,
            robots: robots.collect(),
            scope,
            named: BTreeMap::new(),
            parameters: Vec::new(),
        }
    }

    /// What the instances have.
    pub fn places(&self) -> HashMap<String, Rc<Places>> {
        self.blocks.iter().map(|(name, given)| (name.to_string(), given.places.clone())).collect()
    }

    pub fn call(&mut self, instance: &str, arguments: &[(String, Ex)], places: &Places) -> Stmt {
        let given = self.blocks.get(instance).copied();
        let shared = given.map_or(&[][..], |given| &given.shared);
        let mut all: Vec<(String, Ex)> = Vec::with_capacity(arguments.len() + shared.len());
        for (argument, value) in arguments {
            let value = places.ex(value);
            match given.and_then(|given| given.places.get(argument)) {
                Some(Place { of, coordinate: Some(_), .. }) => {
                    if all.iter().all(|(known, _)| known != of) {
                        let whole = match value {
                            Ex::Part(whole, _) => *whole,
                            // Of an array the variable itself.
                            Ex::Name(array) => name(&array),
                            _ => self.parameter(instance, of),
                        };
                        all.push((of.clone(), whole));
                    }
                }
                _ => all.push((argument.clone(), value)),
            }
        }
        all.extend(shared.iter().map(|shared| (shared.clone(), name(shared))));
        Stmt::Call { instance: instance.into(), arguments: all }
    }

    /// The variable that holds a point which a robot is given.
    fn parameter(&mut self, instance: &str, of: &str) -> Ex {
        let robot = self.robots.get(instance).copied().unwrap_or_default();
        let own = &self.shared.system.instances[robot];
        let names = &self.shared.names.automata[own.automaton.0];
        let number = names.parameters.iter().position(|held| held.whole.as_deref() == Some(of));
        let number = number.unwrap_or_default();
        if let Some(known) = self.named.get(&(robot, number)) {
            return name(known);
        }
        let parameter = &self.shared.system.model.automaton(own.automaton).parameters[number];
        let variable = self.scope.take(&format!("{}_{}", own.name, parameter.name));
        let value = own.parameters[number].first().copied().unwrap_or(Value::Point([0.0; 3]));
        let fields = COORDINATES.iter().map(|c| Rc::from(*c)).zip(constants(value)).collect();
        let declared = Variable::new(&variable, Basic::Lreal).with_initial(Ex::Fields(fields));
        let comments = about(&parameter.doc, String::new());
        let declared = Variable { structure: Some(POINT.into()), comments, ..declared };
        self.parameters.push(Table { variable: declared, values: Vec::new() });
        self.named.insert((robot, number), variable.clone());
        name(&variable)
    }
}
