//! What the names of specifications mean: where each is declared, and where it is used. It is collected while the
//! names are resolved, so that editors show what the compiler understood.

use super::Checker;
use crate::source::{Sources, Span};
use std::collections::{BTreeMap, HashMap};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum What {
    Enumeration,
    Member,
    Interface,
    Automaton,
    Parameter,
    Cell,
    Role,
    Local,
    Define,
    State,
    /// Of a binder or a quantifier.
    Variable,
    Device,
    Assembly,
    /// What a layout gives a device, or a device an assembly.
    Key,
    DeviceDefine,
    Part,
    Port,
    Constant,
    Command,
    /// Where items change hands.
    Handover,
    /// A kind of part that the simulator knows.
    Primitive,
    Setting,
    /// A signal, a level or an action of a primitive.
    Wire,
}

/// Names of one space are unlike one another, those of different spaces need not be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Space {
    Types,
    OfType,
    States,
    Devices,
    OfDevice,
    Ports,
    Commands,
    Handovers,
    Variables,
    Primitives,
    Settings,
    Wires,
}

impl What {
    pub(crate) fn space(self) -> Space {
        match self {
            Self::Enumeration | Self::Interface | Self::Automaton => Space::Types,
            Self::Member | Self::Parameter | Self::Cell | Self::Role | Self::Local | Self::Define => {
                Space::OfType
            }
            Self::State => Space::States,
            Self::Variable => Space::Variables,
            Self::Device | Self::Assembly => Space::Devices,
            Self::Key | Self::DeviceDefine | Self::Part | Self::Constant => Space::OfDevice,
            Self::Port => Space::Ports,
            Self::Command => Space::Commands,
            Self::Handover => Space::Handovers,
            Self::Primitive => Space::Primitives,
            Self::Setting => Space::Settings,
            Self::Wire => Space::Wires,
        }
    }
}

#[derive(Clone, Debug)]
pub struct Declaration {
    pub what: What,
    pub name: String,
    /// The type or device in which it is declared; empty for these themselves.
    pub owner: String,
    /// Where its name stands; none for what is in no specification: kinds, and the ports that every device with
    /// commands has.
    pub place: Option<Span>,
    /// As specifications write it, perhaps with what follows it; empty for what has no type.
    pub ty: String,
    pub doc: Vec<String>,
}

/// The number of a declaration among [`Names::declarations`].
pub type Number = usize;

#[derive(Clone, Debug, Default)]
pub struct Names {
    declarations: Vec<Declaration>,
    uses: BTreeMap<Span, Number>,
    /// Declarations that have to have the same name: a parameter of an interface and what supplies it.
    same: Vec<(Number, Number)>,
    /// What is known of a whole number where it is read, if that is more than its type says.
    bounds: BTreeMap<Span, (i32, i32)>,
    places: HashMap<Span, Number>,
    known: HashMap<(Space, String, String), Number>,
}

impl Names {
    pub fn declarations(&self) -> &[Declaration] {
        &self.declarations
    }

    /// In the order of their places, without those of the declarations themselves.
    pub fn uses(&self) -> impl Iterator<Item = (Span, Number)> + '_ {
        self.uses.iter().map(|(place, number)| (*place, *number))
    }

    /// What is declared or used at a byte of a file, and the place of that name; of a byte between two names the
    /// one before it.
    pub fn at(&self, place: Span) -> Option<(Number, Span)> {
        let holds = |span: &Span| span.file == place.file && (span.start..=span.end).contains(&place.start);
        let used = self.uses.iter().map(|(span, number)| (*number, *span));
        let declared = self.places.iter().map(|(span, number)| (*number, *span));
        let found = used.chain(declared).filter(|(_, span)| holds(span));
        found.max_by_key(|(_, span)| span.start)
    }

    /// What is known of a whole number at the place where it is read.
    pub fn bounds(&self, place: Span) -> Option<(i32, i32)> {
        self.bounds.get(&place).copied()
    }

    /// A declaration with all that have to have its name, in the order of their numbers.
    pub fn same(&self, number: Number) -> Vec<Number> {
        let mut found = vec![number];
        let mut next = 0;
        while let Some(of) = found.get(next).copied() {
            let others = self.same.iter().filter_map(|(a, b)| match of {
                of if of == *a => Some(*b),
                of if of == *b => Some(*a),
                _ => None,
            });
            let new: Vec<_> = others.filter(|other| !found.contains(other)).collect();
            for number in new {
                if !found.contains(&number) {
                    found.push(number);
                }
            }
            next += 1;
        }
        found.sort_unstable();
        found
    }

    pub(crate) fn find(&self, space: Space, owner: &str, name: &str) -> Option<Number> {
        self.known.get(&(space, owner.into(), name.into())).copied()
    }

    /// Of declarations with one name in one place of names, the first counts.
    pub(crate) fn declare(&mut self, declaration: Declaration) -> Number {
        if let Some(number) = declaration.place.and_then(|place| self.places.get(&place)) {
            return *number;
        }
        let number = self.declarations.len();
        let key = (declaration.what.space(), declaration.owner.clone(), declaration.name.clone());
        match (declaration.place, self.known.get(&key)) {
            (None, Some(known)) => return *known,
            (Some(place), _) => drop(self.places.insert(place, number)),
            (None, None) => {}
        }
        if declaration.what != What::Variable {
            self.known.entry(key).or_insert(number);
        }
        self.declarations.push(declaration);
        number
    }

    pub(crate) fn set_type(&mut self, number: Number, ty: String) {
        self.declarations[number].ty = ty;
    }

    pub(crate) fn use_at(&mut self, sources: &Sources, span: Span, number: Number) {
        if let Some(place) = word(sources, span)
            && !self.places.contains_key(&place)
        {
            self.uses.insert(place, number);
        }
    }

    pub(crate) fn narrow(&mut self, sources: &Sources, span: Span, (lo, hi): (i32, i32)) {
        if let Some(place) = word(sources, span) {
            let known = self.bounds.entry(place).or_insert((lo, hi));
            // A transition of `any state` is read once for each state.
            *known = (known.0.min(lo), known.1.max(hi));
        }
    }

    pub(crate) fn link(&mut self, a: Option<Number>, b: Option<Number>) {
        if let (Some(a), Some(b)) = (a, b)
            && a != b
        {
            self.same.push((a, b));
        }
    }
}

/// The place of the one word that stands there, perhaps in parentheses.
fn word(sources: &Sources, span: Span) -> Option<Span> {
    let text = sources.text(span);
    let inner = text.trim_start_matches(|c: char| c == '(' || c.is_whitespace());
    let start = span.start as usize + (text.len() - inner.len());
    let length = inner.find(|c: char| !c.is_ascii_alphanumeric() && c != '_').unwrap_or(inner.len());
    (length > 0).then(|| Span::new(span.file, start, start + length))
}

impl Checker<'_> {
    /// A name that stands at a place means what has this name in one space of a type or device.
    pub(super) fn uses(&mut self, span: Span, space: Space, owner: &str, name: &str) {
        if let Some(names) = &mut self.names
            && let Some(number) = names.find(space, owner, name)
        {
            names.use_at(self.sources, span, number);
        }
    }
}
