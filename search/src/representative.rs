//! Of states that differ only in what has ended unseen, the one that counts for the others.
//!
//! A state `s` counts for those in which commands of machines that are postponed in `s` have ended. When a state is reached
//! for which another one counts, it is not stored. If it turns out later that the other one does not postpone these commands,
//! it is. And where a scan leads from a state to one in which fewer commands are postponed, those with the others ended are
//! stored beside it.

use crate::program::{bit, members};
use crate::reached::{Coded, Reached};
use crate::successor::Expander;
use rustc_hash::FxHashMap;
use std::collections::BTreeSet;

/// So many candidates are looked up at most.
const MOST: usize = 256;

/// What nothing is known of yet.
const UNKNOWN: u64 = u64::MAX;
/// Another state counts for this one. It has the bit of no machine.
pub(crate) const LEFT_OUT: u64 = 1 << 63;

/// Those of a machine.
type Values = Box<[u8]>;

#[derive(Default)]
pub(crate) struct Representatives {
    /// Of each state the machines of which answers are postponed in it; all bits: it has not been expanded; or
    /// [`LEFT_OUT`].
    pub postponed: Vec<u64>,
    /// Of each machine, by its values after its command has ended, those before.
    before: Vec<FxHashMap<Values, Vec<Values>>>,
    /// States that are left out, with those that count for them, and the machines whose commands have not ended there.
    left_out: FxHashMap<usize, (usize, u64)>,
    /// States that are not left out any more.
    pub resumed: Vec<usize>,
    /// Of states that have not been expanded the machines that were postponed unseen in the scan that has led there, if
    /// they are not all that are postponed in the state before.
    unseen: FxHashMap<usize, u64>,
    /// What has to be decided when a state is expanded.
    owed: FxHashMap<usize, Vec<Owed>>,
    /// States that count for others for sure only if the other one does, in which more has ended.
    pub bound: Vec<(u32, u32)>,
    /// Automata, and their states in which only postponed answers have brought them.
    pub entered: BTreeSet<(usize, usize)>,
}

/// A scan has led from a state to another one, in which commands of some machines have ended.
#[derive(Clone, Copy)]
pub(crate) struct Owed {
    pub from: usize,
    pub ended: u64,
    /// Machines of which answers are postponed in the first one, and that did nothing in the scan.
    pub mask: u64,
}

impl Representatives {
    pub fn new(machines: usize) -> Self {
        Self { postponed: vec![UNKNOWN], before: vec![FxHashMap::default(); machines], ..Self::default() }
    }

    pub fn is_expanded(&self, state: usize) -> bool {
        self.postponed[state] != UNKNOWN
    }

    /// Bytes of memory that it takes.
    pub fn size(&self) -> usize {
        8 * (self.postponed.capacity() + self.bound.capacity())
            + 24 * (self.unseen.capacity() + self.left_out.capacity())
            + self.owed.values().map(|owed| size_of_val(owed.as_slice()) + 48).sum::<usize>()
    }

    /// A state is expanded, for the first time or with faults.
    pub fn expanded(&mut self, number: usize, state: &[u8], left: u64, expander: &mut Expander) {
        self.postponed[number] &= left;
        for machine in members(left) {
            let Some(end) = expander.end_of(machine, state) else { continue };
            let (after, entered) = (end.after.clone(), end.state);
            let own = expander.postponing.own(machine, state);
            let before = self.before[machine].entry(after).or_default();
            if !before.contains(&own) {
                before.push(own);
                self.entered.insert((machine, entered));
            }
        }
    }

    /// The state that counts for this one, and the machines whose commands have not ended in it.
    pub fn find(&self, store: &Reached, expander: &Expander, coded: &Coded) -> Option<(usize, u64)> {
        let state = coded.state;
        let mut ended: Vec<(usize, &[Values])> = Vec::new();
        let (mut count, mut own) = (1, Vec::new());
        for machine in expander.postponing.machines() {
            expander.postponing.read_own(machine, state, &mut own);
            if let Some(before) = self.before[machine].get(own.as_slice()) {
                count *= before.len() + 1;
                ended.push((machine, before));
            }
        }
        if ended.is_empty() {
            return None;
        }
        let (mut candidate, mut code) = (state.to_vec(), Vec::new());
        // The last one is the state itself.
        for number in 0..count.min(MOST).saturating_sub(usize::from(count <= MOST)) {
            let mut rest = number;
            let mut machines = 0;
            candidate.copy_from_slice(state);
            for (machine, before) in &ended {
                let choice = rest % (before.len() + 1);
                rest /= before.len() + 1;
                if let Some(own) = before.get(choice) {
                    expander.postponing.replace(*machine, &mut candidate, own);
                    machines |= bit(*machine);
                }
            }
            let found = store.find_beside(&candidate, coded, &mut code).map(|found| self.of(found));
            let found = found.map(|(found, more)| (found, machines | more));
            let found = found.filter(|(found, machines)| machines & !self.postponed[*found] == 0);
            if found.is_some() {
                return found;
            }
        }
        None
    }

    /// The state that counts for one that is known, and the machines whose commands have not ended there.
    pub fn of(&self, mut state: usize) -> (usize, u64) {
        let mut ended = 0;
        while let Some((other, more)) = self.left_out.get(&state) {
            state = *other;
            ended |= more;
        }
        (state, ended)
    }

    /// A state is not expanded, because another one counts for it.
    pub fn leave_out(&mut self, state: usize, (other, ended): (usize, u64)) {
        self.left_out.insert(state, (other, ended));
        self.postponed[state] = LEFT_OUT;
    }

    /// It is expanded after all, if it was left out.
    pub fn resume(&mut self, state: usize) {
        if self.left_out.remove(&state).is_some() {
            self.postponed[state] = UNKNOWN;
            self.resumed.push(state);
        }
    }

    /// All states that are left out, and those that count for them.
    pub fn left_out(&self) -> impl Iterator<Item = (usize, usize)> {
        self.left_out.iter().map(|(state, (other, _))| (*state, *other))
    }

    /// A state is stored, which a scan has led to from a known one with `mask`.
    pub fn add(&mut self, from: usize, mask: u64) {
        if mask != self.postponed[from] {
            self.unseen.insert(self.postponed.len(), mask);
        }
        self.postponed.push(UNKNOWN);
    }

    /// The first scan that has led to a state, from `parent`.
    pub fn first(&self, state: usize, parent: usize) -> Owed {
        let mask = self.unseen.get(&state).copied().unwrap_or(self.postponed[parent]);
        Owed { from: parent, ended: 0, mask }
    }

    /// Notes what has to be decided once a state is expanded.
    pub fn owe(&mut self, state: usize, owed: Owed) {
        let all = self.owed.entry(state).or_default();
        if !all.iter().any(|other| other.ended == owed.ended && owed.mask & !other.mask == 0) {
            all.push(owed);
        }
    }

    /// What has to be decided of a state that was reached first from `parent`.
    pub fn owed(&mut self, state: usize, parent: usize) -> Vec<Owed> {
        let mut owed = self.owed.remove(&state).unwrap_or_default();
        owed.push(self.first(state, parent));
        owed
    }

    /// The same of a state that is expanded now, and so will not be left out any more.
    pub fn last_owed(&mut self, state: usize, parent: usize) -> Vec<Owed> {
        let owed = self.owed(state, parent);
        self.unseen.remove(&state);
        owed
    }
}
