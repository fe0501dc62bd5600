//! Values that nobody reads until they are written again: the search finds out itself where that is so.
//!
//! It begins as if nobody ever read any of them, and forgets what they hold. If one that is forgotten is read all the same,
//! or would count as known again, then it is kept in future, and the search begins anew. So in a search that comes to its
//! end nobody has asked for what was forgotten: with every other value, all would have been the same.

use crate::program::{Instance, bit};
use crate::start::Start;
use crate::value::Var;

/// So many values, at most.
const MOST: usize = u128::BITS as usize;

/// A value of an instance.
#[derive(Clone, Debug)]
pub struct Cell {
    pub var: Var,
    pub owner: usize,
    /// The same for the same value of instances of the same type, and for all elements of an array.
    pub kind: usize,
    /// Of an element with a token this.
    pub token: Option<Tell>,
    /// What is held while it is forgotten.
    pub instead: i32,
}

/// A number that the state holds from 0 on, of so many values.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Tell {
    pub var: Var,
    pub values: usize,
}

/// What is forgotten has been asked for, or would have become known again.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Needed {
    /// A value, in this mode: the state of its owner, what this tells, and the token.
    Value { cell: usize, mode: usize },
    /// Where a vehicle under way has set out, in this state of its automaton.
    Start { machine: usize, state: usize },
}

/// What is the same for all for which [`Unread::keep`] does the same.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Like {
    Value { kind: usize, mode: usize },
    Start { kind: usize, state: usize },
}

/// Values, a bit each in masks, and where they are forgotten.
#[derive(Clone, Debug, Default)]
pub struct Unread {
    cells: Vec<Cell>,
    /// Of each byte of a state one more than the number of the value that begins there.
    at: Vec<u8>,
    owners: Vec<Owner>,
    /// Vehicles.
    pub(crate) starts: Vec<Start>,
}

/// What is forgotten of an instance.
#[derive(Clone, Debug)]
struct Owner {
    /// All that it owns.
    own: u128,
    /// What, with its state, tells whether it is of use.
    tells: Vec<Tell>,
    /// In each mode what is forgotten without a token, and with each token.
    single: Vec<u128>,
    elements: Vec<(Tell, Vec<u128>)>,
}

impl Tell {
    /// In a mode, beside what was told before.
    fn within(self, mode: usize, state: &[u8]) -> usize {
        mode * self.values + (self.var.load(state) as usize).min(self.values - 1)
    }
}

impl Owner {
    fn mode(&self, instance: &Instance, state: &[u8]) -> usize {
        let begin = instance.state.load(state) as usize;
        self.tells.iter().fold(begin, |mode, tell| tell.within(mode, state))
    }

    /// Where all with this token are forgotten.
    fn forgotten(&mut self, token: Option<Tell>) -> &mut Vec<u128> {
        let Some(token) = token else { return &mut self.single };
        let known = self.elements.iter().position(|(other, _)| *other == token);
        let number = known.unwrap_or(self.elements.len());
        if known.is_none() {
            self.elements.push((token, vec![0; self.single.len() * token.values]));
        }
        &mut self.elements[number].1
    }
}

impl Unread {
    /// The first of these values, which the instances own, in a state of so many bytes. Of each instance what tells.
    pub fn new(
        mut cells: Vec<Cell>,
        tells: Vec<Vec<Tell>>,
        instances: &[Instance],
        length: usize,
        starts: Vec<Start>,
    ) -> Self {
        cells.truncate(MOST);
        let mut at = vec![0; length];
        let owners = tells.into_iter().zip(instances).map(|(tells, instance)| {
            let modes = tells.iter().fold(instance.states.len(), |modes, tell| modes * tell.values);
            Owner { own: 0, tells, single: vec![0; modes], elements: Vec::new() }
        });
        let mut owners: Vec<Owner> = owners.collect();
        for (number, cell) in cells.iter().enumerate() {
            at[cell.var.at as usize] = number as u8 + 1;
            let owner = &mut owners[cell.owner];
            owner.own |= 1 << number;
            owner.forgotten(cell.token).iter_mut().for_each(|mask| *mask |= 1 << number);
        }
        Self { cells, at, owners, starts }
    }

    /// Where they stand.
    pub fn vars(&self) -> impl Iterator<Item = Var> {
        self.cells.iter().map(|cell| cell.var).chain(self.starts.iter().map(|start| start.at))
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.cells.is_empty() && self.starts.is_empty()
    }

    pub(crate) fn like(&self, needed: Needed) -> Like {
        match needed {
            Needed::Value { cell, mode } => Like::Value { kind: self.cells[cell].kind, mode },
            Needed::Start { machine, state } => Like::Start { kind: self.kind_of_start(machine), state },
        }
    }

    fn kind_of_start(&self, machine: usize) -> usize {
        let start = self.starts.iter().find(|start| start.machine == machine);
        start.map_or(machine, |start| start.kind)
    }

    /// What a mask has of the value that stands here.
    #[inline]
    pub(crate) fn part(&self, mask: u128, var: Var) -> u128 {
        match self.at.get(var.at as usize) {
            None | Some(0) => 0,
            Some(number) => mask & 1 << (number - 1),
        }
    }

    /// What is forgotten in a state, of these instances.
    pub(crate) fn in_state(&self, instances: &[Instance], state: &[u8], owners: u64) -> u128 {
        let mut all = 0;
        for (owner, instance) in self.of_instances(owners).map(|(number, owner)| (owner, &instances[number]))
        {
            let mode = owner.mode(instance, state);
            all |= owner.single[mode];
            for (token, forgotten) in &owner.elements {
                all |= forgotten[token.within(mode, state)];
            }
        }
        all
    }

    /// All that these instances own.
    pub(crate) fn owned(&self, owners: u64) -> u128 {
        self.of_instances(owners).fold(0, |all, (_, owner)| all | owner.own)
    }

    fn of_instances(&self, owners: u64) -> impl Iterator<Item = (usize, &Owner)> {
        let all = self.owners.iter().enumerate();
        all.filter(move |(number, owner)| owners & bit(*number) != 0 && owner.own != 0)
    }

    /// These values.
    pub(crate) fn of(&self, mut mask: u128) -> impl Iterator<Item = &Cell> {
        std::iter::from_fn(move || {
            let cell = (mask != 0).then(|| mask.trailing_zeros() as usize)?;
            mask &= mask - 1;
            Some(&self.cells[cell])
        })
    }

    /// Notes that these values have to be known in this state.
    pub(crate) fn needed(
        &self,
        instances: &[Instance],
        mut mask: u128,
        state: &[u8],
        noted: &mut Vec<Needed>,
    ) {
        while mask != 0 && noted.len() < MOST {
            let number = mask.trailing_zeros() as usize;
            let cell = &self.cells[number];
            let mode = self.owners[cell.owner].mode(&instances[cell.owner], state);
            let mode = cell.token.map_or(mode, |token| token.within(mode, state));
            let needed = Needed::Value { cell: number, mode };
            if !noted.contains(&needed) {
                noted.push(needed);
            }
            mask &= mask - 1;
        }
    }

    /// From now on they are known there, as are all of their kinds; one that was known already, everywhere.
    pub(crate) fn keep(&mut self, needed: &[Needed]) {
        let was_known = needed.iter().map(|needed| match *needed {
            Needed::Value { cell, mode } => self.is_known(cell, mode),
            Needed::Start { machine, state } => self.is_start_known(machine, state),
        });
        let was_known: Vec<bool> = was_known.collect();
        for (needed, was_known) in needed.iter().zip(was_known) {
            match *needed {
                Needed::Value { cell, mode } => self.keep_value(cell, (!was_known).then_some(mode)),
                Needed::Start { machine, state } => self.keep_start(machine, (!was_known).then_some(state)),
            }
        }
    }

    fn is_known(&mut self, cell: usize, mode: usize) -> bool {
        let Cell { owner, token, .. } = self.cells[cell];
        self.owners[owner].forgotten(token)[mode] & 1 << cell == 0
    }

    /// In one mode, or in all.
    fn keep_value(&mut self, cell: usize, mode: Option<usize>) {
        let Self { cells, owners, .. } = self;
        let kind = cells[cell].kind;
        for (number, cell) in cells.iter().enumerate().filter(|(_, cell)| cell.kind == kind) {
            let forgotten = owners[cell.owner].forgotten(cell.token);
            let modes = mode.map_or(0..forgotten.len(), |mode| mode..mode + 1);
            forgotten[modes].iter_mut().for_each(|mask| *mask &= !(1 << number));
        }
    }

    fn is_start_known(&self, machine: usize, state: usize) -> bool {
        self.starts.iter().any(|start| start.machine == machine && start.known[state])
    }

    /// In one state of the automaton, or in all.
    fn keep_start(&mut self, machine: usize, state: Option<usize>) {
        let kind = self.kind_of_start(machine);
        for start in self.starts.iter_mut().filter(|start| start.kind == kind) {
            let states = state.map_or(0..start.known.len(), |state| state..state + 1);
            start.known[states].fill(true);
        }
    }
}
