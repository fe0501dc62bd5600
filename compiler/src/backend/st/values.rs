//! The values of tables: as many as a line has parameters, so they are held as narrow as they are, and once.

use super::code::Ex;
use super::name::Name;
use std::sync::Arc;

/// The values of a table, in the order of its elements.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    Bool(Vec<bool>),
    Int(Vec<i32>),
    Real(Vec<f64>),
    /// So many times one.
    Alike(Box<Ex>, usize),
    /// Of any kinds.
    Any(Vec<Ex>),
}

impl Values {
    pub fn len(&self) -> usize {
        match self {
            Values::Bool(all) => all.len(),
            Values::Int(all) => all.len(),
            Values::Real(all) => all.len(),
            Values::Alike(_, count) => *count,
            Values::Any(all) => all.len(),
        }
    }

    pub fn get(&self, i: usize) -> Option<Ex> {
        match self {
            Values::Bool(all) => all.get(i).copied().map(Ex::Bool),
            Values::Int(all) => all.get(i).copied().map(Ex::Int),
            Values::Real(all) => all.get(i).copied().map(Ex::Real),
            Values::Alike(value, count) => (i < *count).then(|| (**value).clone()),
            Values::Any(all) => all.get(i).cloned(),
        }
    }

    pub fn iter(&self) -> impl Iterator<Item = Ex> + Clone {
        (0..self.len()).filter_map(|i| self.get(i))
    }

    fn push(&mut self, value: Ex) {
        match (&mut *self, value) {
            (Values::Bool(all), Ex::Bool(value)) => all.push(value),
            (Values::Int(all), Ex::Int(value)) => all.push(value),
            (Values::Real(all), Ex::Real(value)) => all.push(value),
            (Values::Any(all), value) => all.push(value),
            (_, value) => *self = Values::Any(self.iter().chain([value]).collect()),
        }
    }

    fn shrink(&mut self) {
        match self {
            Values::Bool(all) => all.shrink_to_fit(),
            Values::Int(all) => all.shrink_to_fit(),
            Values::Real(all) => all.shrink_to_fit(),
            Values::Any(all) => all.shrink_to_fit(),
            Values::Alike(..) => {}
        }
    }
}

impl FromIterator<Ex> for Values {
    fn from_iter<T: IntoIterator<Item = Ex>>(values: T) -> Self {
        let mut values = values.into_iter().peekable();
        let mut all = match values.peek() {
            Some(Ex::Bool(_)) => Values::Bool(Vec::new()),
            Some(Ex::Int(_)) => Values::Int(Vec::new()),
            Some(Ex::Real(_)) => Values::Real(Vec::new()),
            _ => Values::Any(Vec::new()),
        };
        values.for_each(|value| all.push(value));
        all.shrink();
        all
    }
}

/// The values of an array where it is declared: those of one table, or structures of those of several.
#[derive(Clone, Debug, PartialEq)]
pub struct List {
    pub len: usize,
    pub elements: Elements,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Elements {
    Single(Arc<Values>),
    Structures(Vec<Field>),
}

/// A field of structures.
#[derive(Clone, Debug, PartialEq)]
pub struct Field {
    pub name: Name,
    pub values: Arc<Values>,
    /// What a structure has that does not say it.
    pub unsaid: Option<Ex>,
}

impl Field {
    /// The value of an element, if its structure says it.
    pub fn said(&self, i: usize) -> Option<Ex> {
        self.values.get(i).filter(|value| Some(value) != self.unsaid.as_ref())
    }
}

impl List {
    pub fn single(values: Arc<Values>) -> Self {
        Self { len: values.len(), elements: Elements::Single(values) }
    }

    pub fn iter(&self) -> impl Iterator<Item = Ex> + Clone {
        (0..self.len).filter_map(|i| self.get(i))
    }

    fn get(&self, i: usize) -> Option<Ex> {
        match &self.elements {
            Elements::Single(values) => values.get(i),
            Elements::Structures(fields) => {
                let fields = fields.iter().filter_map(|field| Some((field.name.clone(), field.said(i)?)));
                Some(Ex::Fields(fields.collect()))
            }
        }
    }
}
