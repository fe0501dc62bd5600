//! Of which instances a machine has locks.

use super::lock::{self, Lock};
use super::region::{Bound, rows_of_local};
use crate::ir::{Scalar, System};

/// Instances of which a machine has a lock. In a long line a local names a thousand: they are written out once for each set.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Holder {
    Itself,
    One(usize),
    /// All that a local may name.
    Named(usize),
    /// Those of them that lock themselves.
    Lending(usize),
}

impl Holder {
    pub fn instances(self, system: &System, instance: usize) -> Vec<usize> {
        match self {
            Self::Itself => vec![instance],
            Self::One(instance) => vec![instance],
            Self::Named(local) => members(system, instance, local),
            Self::Lending(local) => {
                let named = members(system, instance, local);
                named.into_iter().filter(|member| lock::locks_itself(system, *member)).collect()
            }
        }
    }
}

/// Of which instance a lock is; all of which it may be, so that nothing is said that may not be true.
pub fn owner(system: &System, instance: usize, bound: &Bound, lock: &Lock) -> Holder {
    let named = |local: usize| one(system, instance, bound, local).map_or(Holder::Named(local), Holder::One);
    lock.of.map_or(Holder::Itself, named)
}

/// The instances that a local may name, as far as they lock themselves.
pub fn lender(system: &System, instance: usize, bound: &Bound, local: usize) -> Option<Holder> {
    match one(system, instance, bound, local) {
        Some(member) => lock::locks_itself(system, member).then_some(Holder::One(member)),
        None => Some(Holder::Lending(local)),
    }
}

/// The one that a bound local names.
fn one(system: &System, instance: usize, bound: &Bound, local: usize) -> Option<usize> {
    let Scalar::Ref(interface) = system.automaton_of(instance).locals[local].ty.scalar else { return None };
    bound.row(local).map(|row| system.members[interface.0][row])
}

/// The instances that a local may name.
fn members(system: &System, instance: usize, local: usize) -> Vec<usize> {
    let Scalar::Ref(interface) = system.automaton_of(instance).locals[local].ty.scalar else {
        return Vec::new();
    };
    let rows = rows_of_local(system, instance, local);
    rows.into_iter().map(|row| system.members[interface.0][row]).collect()
}
