//! Where the variables stand in memory.

use super::place::{Place, split};
use crate::check::Checked;
use crate::literal;
use crate::types::{Scalar, Type};
use crate::view::{ExpressionKind, Section, Unit, UnitKind, Variable};
use std::collections::HashMap;

/// The words of all units.
#[derive(Clone, Debug, Default)]
pub(super) struct Layouts {
    globals: Vec<(String, String, Type, usize)>,
    units: HashMap<String, Frame>,
    /// Names of globals by address.
    addresses: HashMap<String, String>,
    /// Where the frame of a program or a function begins.
    bases: HashMap<String, usize>,
    programs: Vec<String>,
    size: usize,
    retained: Vec<usize>,
}

/// The words of one instance of a unit.
#[derive(Clone, Debug, Default)]
pub(super) struct Frame {
    pub(super) variables: HashMap<String, Spot>,
    pub(super) size: usize,
    /// Those of its words that outlast a loss of power.
    retained: Vec<usize>,
}

#[derive(Clone, Debug)]
pub(super) struct Spot {
    pub(super) base: Base,
    pub(super) offset: usize,
    pub(super) ty: Type,
    pub(super) section: Section,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Base {
    Frame,
    Global,
}

impl Layouts {
    pub(super) fn new(checked: &Checked) -> Self {
        let mut layouts = Self::default();
        for variable in checked.text.configurations.iter().flat_map(|c| &c.globals) {
            let ty = type_of(variable);
            let (key, offset) = (variable.name.key(), layouts.size);
            layouts.size += layouts.words(&ty);
            let retained = layouts.retained_of(variable, &ty);
            layouts.retained.extend(retained.into_iter().map(|word| offset + word));
            if let Some(address) = &variable.address {
                layouts.addresses.insert(address.text.clone(), key.clone());
            }
            layouts.globals.push((key, variable.name.text.clone(), ty, offset));
        }
        for unit in &checked.text.units {
            let frame = layouts.frame(unit);
            if unit.kind != UnitKind::Block {
                layouts.bases.insert(unit.name.key(), layouts.size);
                let base = layouts.size;
                layouts.retained.extend(frame.retained.iter().map(|word| base + word));
                layouts.size += frame.size;
            }
            if unit.kind == UnitKind::Program {
                layouts.programs.push(unit.name.key());
            }
            layouts.units.insert(unit.name.key(), frame);
        }
        layouts
    }

    fn words(&self, ty: &Type) -> usize {
        match ty {
            Type::Scalar(_) => 1,
            Type::Array(_, upper) => upper + 1,
            Type::Block(block) => self.units[block].size,
        }
    }

    fn frame(&self, unit: &Unit) -> Frame {
        let mut frame = Frame::default();
        if let Some(result) = &unit.result {
            let ty = type_of_name(result);
            let spot = Spot { base: Base::Frame, offset: 0, ty, section: Section::Local };
            frame.variables.insert(unit.name.key(), spot);
            frame.size = 1;
        }
        for variable in &unit.variables {
            let (key, ty, section) = (variable.name.key(), type_of(variable), variable.section);
            let spot = if section == Section::External {
                let offset = self.global(&key).expect("the check has seen it").1;
                Spot { base: Base::Global, offset, ty, section }
            } else {
                let offset = frame.size;
                frame.size += self.words(&ty);
                let retained = self.retained_of(variable, &ty);
                frame.retained.extend(retained.into_iter().map(|word| offset + word));
                Spot { base: Base::Frame, offset, ty, section }
            };
            frame.variables.insert(key, spot);
        }
        frame
    }

    /// The words of a variable that outlast a loss of power.
    fn retained_of(&self, variable: &Variable, ty: &Type) -> Vec<usize> {
        match ty {
            Type::Block(block) if !variable.is_retained => self.units[block].retained.clone(),
            ty if variable.is_retained => (0..self.words(ty)).collect(),
            _ => Vec::new(),
        }
    }

    /// All words that outlast a loss of power.
    pub(super) fn retained(&self) -> &[usize] {
        &self.retained
    }

    fn global(&self, key: &str) -> Option<(&Type, usize)> {
        self.globals.iter().find(|g| g.0 == key).map(|(_, _, ty, offset)| (ty, *offset))
    }

    pub(super) fn size(&self) -> usize {
        self.size
    }

    pub(super) fn unit(&self, key: &str) -> &Frame {
        &self.units[key]
    }

    pub(super) fn base(&self, key: &str) -> usize {
        self.bases[key]
    }

    /// Initial values of the scalars in VAR_GLOBAL and of PROGRAMs; no others.
    pub(super) fn initialise(&self, checked: &Checked, memory: &mut [u64]) {
        for variable in checked.text.configurations.iter().flat_map(|c| &c.globals) {
            let offset = self.global(&variable.name.key()).expect("laid out above").1;
            memory[offset] = initial(variable);
        }
        for unit in checked.text.units.iter().filter(|u| u.kind == UnitKind::Program) {
            let base = self.base(&unit.name.key());
            for variable in
                unit.variables.iter().filter(|v| v.section == Section::Local && v.initial.is_some())
            {
                memory[base + self.unit(&unit.name.key()).variables[&variable.name.key()].offset] =
                    initial(variable);
            }
        }
    }

    pub(super) fn globals(&self) -> Vec<String> {
        let mut names = Vec::new();
        for (_, name, ty, _) in &self.globals {
            match ty {
                Type::Array(_, upper) => names.extend((0..=*upper).map(|i| format!("{name}[{i}]"))),
                _ => names.push(name.clone()),
            }
        }
        names
    }

    pub(super) fn located(&self, address: &str) -> Option<Place> {
        self.place(self.addresses.get(address)?)
    }

    pub(super) fn place(&self, path: &str) -> Option<Place> {
        let (names, index) = split(path)?;
        let (first, rest) = names.split_first()?;
        let (mut ty, mut address) = match self.global(first) {
            Some((ty, offset)) => (ty.clone(), offset),
            None => self.programs.iter().find_map(|program| {
                let spot = self.units[program].variables.get(first)?;
                Some((spot.ty.clone(), self.bases[program] + spot.offset))
            })?,
        };
        for name in rest {
            let Type::Block(block) = &ty else { return None };
            let spot = self.units[block].variables.get(name)?;
            address = if spot.base == Base::Frame { address + spot.offset } else { spot.offset };
            ty = spot.ty.clone();
        }
        match (ty, index) {
            (Type::Scalar(ty), None) => Some(Place { address, ty }),
            (Type::Array(ty, upper), Some(index)) if index <= upper => {
                Some(Place { address: address + index, ty })
            }
            _ => None,
        }
    }
}

fn type_of(variable: &Variable) -> Type {
    type_of_name(&variable.ty)
}

fn type_of_name(name: &crate::view::TypeName) -> Type {
    use crate::view::TypeKind;
    match &name.kind {
        TypeKind::Named(word) => match Scalar::named(word) {
            Some(scalar) => Type::Scalar(scalar),
            None => Type::Block(word.to_ascii_lowercase()),
        },
        TypeKind::Array { upper, element, .. } => {
            let upper = match &upper.kind {
                ExpressionKind::Int(text) => text.parse().expect("the check has read it"),
                _ => unreachable!("the check wants a literal"),
            };
            match type_of_name(element) {
                Type::Scalar(scalar) => Type::Array(scalar, upper),
                _ => unreachable!("the check wants scalars"),
            }
        }
        TypeKind::Other => unreachable!("the check refuses it"),
    }
}

fn initial(variable: &Variable) -> u64 {
    match variable.initial.as_ref().map(|e| &e.kind) {
        Some(ExpressionKind::Bool(value)) => u64::from(*value),
        Some(ExpressionKind::Int(text)) => u64::from(literal::int(text).expect("checked") as u32),
        Some(ExpressionKind::Real(text)) => literal::real(text).expect("checked").to_bits(),
        _ => 0,
    }
}
