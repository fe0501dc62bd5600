//! Calls of blocks in the program.

use super::POINT;
use super::access::{COORDINATES, Places};
use super::units::Given;
use crate::backend::st::block::Block;
use crate::backend::st::code::{Ex, Stmt, name};
use crate::backend::st::context::Shared;
use crate::backend::st::declaration::{Basic, Unit, Variable, constants};
use crate::backend::st::globals::{Table, about};
use crate::backend::st::name::Name;
use crate::backend::st::program::Blocks;
use crate::ir::{Automaton, Extent, Parameter, Scalar, System, Value};
use crate::naming::st::Scope;
use std::collections::{BTreeMap, HashMap};

pub struct Calls<'a> {
    shared: Shared<'a>,
    given: Vec<Given<'a>>,
    /// By the name of an instance.
    blocks: HashMap<&'a str, usize>,
    robots: HashMap<&'a str, usize>,
    /// With what the instances have.
    pub places: Places,
    /// Points that robots are given, by robot and number of the parameter.
    named: BTreeMap<(usize, usize), Name>,
}

impl<'a> Calls<'a> {
    pub fn new(shared: Shared<'a>, given: Vec<Given<'a>>, program: &'a Unit, places: &Places) -> Self {
        let of = |block: &str| given.iter().position(|given| given.unit.name == block);
        let blocks: HashMap<&str, usize> =
            program.instances.iter().filter_map(|i| Some((i.name.as_str(), of(&i.block)?))).collect();
        let robots = shared.names.robots.iter().enumerate();
        let robots = robots.flat_map(|(robot, names)| {
            [(names.instance.as_str(), robot), (names.properties.as_str(), robot)]
        });
        let of_instances = blocks.iter().map(|(name, i)| (Name::from(*name), given[*i].places.clone()));
        let places = places.of_program(of_instances.collect());
        Self { shared, blocks, robots: robots.collect(), places, named: BTreeMap::new(), given }
    }

    fn given(&self, instance: &str) -> Option<&Given<'a>> {
        self.blocks.get(instance).map(|i| &self.given[*i])
    }

    pub fn call(&self, instance: &Name, arguments: &[(Name, Ex)]) -> Stmt {
        let given = self.given(instance);
        let shared = given.map_or(&[][..], |given| &given.shared);
        let mut all: Vec<(Name, Ex)> = Vec::with_capacity(arguments.len() + shared.len());
        for (number, (argument, value)) in arguments.iter().enumerate() {
            let value = self.places.ex(value);
            match given.and_then(|given| given.point_of(number, argument)) {
                Some(of) => {
                    if all.iter().all(|(known, _)| known != of) {
                        let whole = match value {
                            Ex::Part(whole, _) => *whole,
                            // Of an array the variable itself.
                            Ex::Name(array) => name(array),
                            _ => self.named.get(&self.parameter(instance, of)).map_or(value, name),
                        };
                        all.push((of.clone(), whole));
                    }
                }
                None => all.push((argument.clone(), value)),
            }
        }
        all.extend(shared.iter().map(|shared| (shared.clone(), name(shared))));
        Stmt::Call { instance: instance.clone(), arguments: all }
    }

    /// Names the variables that hold points which robots are given, in the order of the calls.
    pub fn name_points(&mut self, blocks: &[Option<Blocks>], scope: &mut Scope) -> Vec<Table> {
        let system = self.shared.system;
        let steps = points_given(system, blocks, |of| Some(&of.steps));
        let properties = points_given(system, blocks, |of| of.properties.as_ref());
        let mut tables = Vec::new();
        for of_types in [steps, properties] {
            for (robot, instance) in system.instances.iter().enumerate() {
                for number in &of_types[instance.automaton.0] {
                    if !self.named.contains_key(&(robot, *number)) {
                        let table = self.point(robot, *number, scope);
                        self.named.insert((robot, *number), table.variable.name.clone());
                        tables.push(table);
                    }
                }
            }
        }
        tables
    }

    /// Which parameter of which robot an argument is.
    fn parameter(&self, instance: &str, of: &str) -> (usize, usize) {
        let robot = self.robots.get(instance).copied().unwrap_or_default();
        let names = &self.shared.names.automata[self.shared.system.instances[robot].automaton.0];
        let number = names.parameters.iter().position(|held| held.whole.as_deref() == Some(of));
        (robot, number.unwrap_or_default())
    }

    /// The variable that holds a point which a robot is given.
    fn point(&self, robot: usize, number: usize, scope: &mut Scope) -> Table {
        let own = &self.shared.system.instances[robot];
        let parameter = &self.shared.system.model.automaton(own.automaton).parameters[number];
        let variable = scope.take(&format!("{}_{}", own.name, parameter.name));
        let value = own.parameters[number].first().copied().unwrap_or(Value::Point([0.0; 3]));
        let fields = COORDINATES.map(Name::from).into_iter().zip(constants(value)).collect();
        let declared = Variable::new(&variable, Basic::Lreal).with_initial(Ex::Fields(fields));
        let comments = about(&parameter.doc, String::new());
        Table::declared(Variable { structure: Some(POINT.into()), comments, ..declared })
    }
}

/// The parameters that are points, of those with which a block of each type is called.
fn points_given<'b, 'a: 'b>(
    system: &System,
    blocks: &'b [Option<Blocks<'a>>],
    block: impl Fn(&'b Blocks<'a>) -> Option<&'b Block<'a>>,
) -> Vec<Vec<usize>> {
    let is_point = |p: &Parameter| p.ty.scalar == Scalar::Point && p.ty.extent == Extent::One;
    let of_type = |(blocks, automaton): (&'b Option<Blocks<'a>>, &Automaton)| {
        let arguments = blocks.as_ref().and_then(&block).map_or(&[][..], |block| &block.arguments);
        let mut points: Vec<usize> = arguments.iter().filter_map(|(_, origin)| origin.parameter()).collect();
        points.retain(|number| is_point(&automaton.parameters[*number]));
        points.dedup();
        points
    };
    blocks.iter().zip(&system.model.automata).map(of_type).collect()
}
