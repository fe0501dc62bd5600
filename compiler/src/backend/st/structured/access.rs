//! Where the variables of the portable text are.

use crate::backend::st::alarm::COLUMNS;
use crate::backend::st::code::{Ex, name};
use crate::backend::st::context::Shared;
use crate::backend::st::name::Name;
use crate::backend::st::names::Held;
use crate::ir::AutomatonId;
use std::collections::HashMap;
use std::sync::Arc;

/// The coordinates of a point.
pub const COORDINATES: [&str; 3] = ["x", "y", "z"];

/// A part of a variable.
#[derive(Clone, Debug)]
pub struct Place {
    /// The variable.
    pub of: Name,
    /// The field of its elements.
    pub field: Option<Name>,
    pub coordinate: Option<&'static str>,
}

/// By the names of the portable text. What is not among them is a variable by itself.
#[derive(Clone, Default)]
pub struct Places {
    /// What all units share.
    shared: Arc<HashMap<Name, Place>>,
    own: HashMap<Name, Place>,
    /// What the instances of blocks have.
    instances: HashMap<Name, Arc<Places>>,
}

impl Places {
    /// What all units share.
    pub fn shared(shared: Shared) -> Self {
        let mut places = Self::default();
        for names in &shared.names.interfaces {
            for (cell, field) in names.cells.iter().zip(&names.fields) {
                places.add(cell, &names.rows, Some(field));
            }
            names.parameters.iter().for_each(|held| places.point(held));
        }
        for robot in &shared.names.robots {
            robot.ports.iter().chain(&robot.parameters).for_each(|held| places.point(held));
        }
        shared.names.automata.iter().flat_map(|names| &names.tables).for_each(|held| places.point(held));
        for column in COLUMNS {
            let place = Place { of: "alarms".into(), field: Some(column.into()), coordinate: None };
            places.own.insert(format!("alarms_{column}").into(), place);
        }
        Self { shared: Arc::new(places.own), ..Self::default() }
    }

    /// With what the blocks of a type have.
    pub fn of_automaton(&self, shared: Shared, id: AutomatonId) -> Self {
        let mut places = self.clone();
        let names = &shared.names.automata[id.0];
        let held = names.parameters.iter().chain(&names.locals).chain(&names.ports);
        held.for_each(|held| places.point(held));
        places
    }

    /// With what the instances of the program have.
    pub fn of_program(&self, instances: HashMap<Name, Arc<Places>>) -> Self {
        Self { instances, ..self.clone() }
    }

    fn point(&mut self, held: &Held) {
        if let Some(whole) = &held.whole {
            self.add(held, whole, None);
        }
    }

    fn add(&mut self, held: &Held, of: &Name, field: Option<&Name>) {
        let coordinates = COORDINATES.iter().filter(|_| held.whole.is_some());
        let coordinates: Vec<Option<&'static str>> = match held.whole {
            Some(_) => coordinates.map(|c| Some(*c)).collect(),
            None => vec![None],
        };
        for (name, coordinate) in held.iter().zip(coordinates) {
            self.own.insert(name.clone(), Place { of: of.clone(), field: field.cloned(), coordinate });
        }
    }

    pub fn get(&self, name: &str) -> Option<&Place> {
        self.own.get(name).or_else(|| self.shared.get(name))
    }

    /// An output of an instance.
    pub fn output(&self, instance: &Name, held: &Name) -> Ex {
        let place = self.instances.get(instance).and_then(|places| places.get(held));
        let field = |of: &Name| Ex::Field(instance.clone(), of.clone());
        match place {
            Some(Place { of, coordinate: Some(coordinate), .. }) => {
                Ex::Part(Box::new(field(of)), (*coordinate).into())
            }
            _ => field(held),
        }
    }

    /// What the portable text calls so.
    pub fn read(&self, held: &Name, index: Option<Ex>) -> Ex {
        let plain = Place { of: held.clone(), field: None, coordinate: None };
        let place = self.get(held).unwrap_or(&plain);
        let part = |of: Ex, field: Name| Ex::Part(Box::new(of), field);
        let found = match (&place.field, index) {
            (None, None) => name(&place.of),
            (None, Some(Ex::Within(row, _, element))) => {
                Ex::Item(Box::new(name(&place.of)), vec![*row, *element])
            }
            (None, Some(index)) => Ex::Element(place.of.clone(), Box::new(index)),
            (Some(field), None) => part(name(&place.of), field.clone()),
            (Some(field), Some(Ex::Within(row, _, element))) => {
                Ex::Item(Box::new(part(Ex::Element(place.of.clone(), row), field.clone())), vec![*element])
            }
            (Some(field), Some(index)) => part(Ex::Element(place.of.clone(), Box::new(index)), field.clone()),
        };
        match place.coordinate {
            Some(coordinate) => part(found, coordinate.into()),
            None => found,
        }
    }
}
