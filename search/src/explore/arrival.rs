//! States that are reached, where others may count for them.

use super::Search;
use crate::program::members;
use crate::reached::Coded;
use crate::representative::{Owed, Representatives};
use crate::successor::Part;
use std::ops::Range;

impl Search<'_> {
    /// A scan, in which answers of these machines are postponed unseen, leads from one state to one for which another one
    /// counts: its number, and the machines whose commands have not ended in it.
    pub(super) fn reach(
        &mut self,
        part: Part,
        from: usize,
        mask: u64,
        (to, ended): (usize, u64),
        is_plain: bool,
    ) {
        let Some(representatives) = &self.representatives else { return self.lead(from, to, is_plain) };
        let (counts, more) = representatives.of(to);
        self.owe(counts, Owed { from, ended: ended | more, mask });
        let to = self.representatives.as_ref().map_or(to, |all| all.of(to).0);
        self.lead(from, to, is_plain);
        // What was postponed until devices fail.
        if part == Part::Failing && is_plain {
            self.bind(from, to);
            if to >= self.round {
                self.late.push(to);
            }
        }
    }

    /// Whether it is known which state counts for one that was reached before.
    pub(super) fn still_counts(&self, (number, ended): (usize, u64)) -> bool {
        let postponed = |all: &Representatives| all.postponed.get(number).copied().unwrap_or(0);
        number != usize::MAX && self.representatives.as_ref().is_none_or(|all| ended & !postponed(all) == 0)
    }

    /// The number of a state that is reached, or of the one that counts for it, and the machines whose commands have not
    /// ended in that.
    pub(super) fn arrive(&mut self, from: usize, mask: u64, state: Coded, restless: u64) -> (usize, u64) {
        if let Some(representatives) = &self.representatives {
            if let Some(known) = self.store.find_coded(&state) {
                return representatives.of(known);
            }
            if let Some(found) = representatives.find(&self.store, &self.first, &state) {
                return found;
            }
        }
        let (to, is_new) = self.store.add_coded(state, from);
        if is_new {
            self.restless.push(restless);
            self.representatives.iter_mut().for_each(|all| all.add(from, mask));
        }
        (to, 0)
    }

    /// Leaves out those of these states for which another one counts.
    pub(super) fn leave_out(&mut self, states: Range<usize>) {
        for number in states {
            let Some(representatives) = &mut self.representatives else { return };
            if representatives.is_expanded(number) {
                continue;
            }
            let state = self.store.state(number);
            let Some((other, ended)) =
                representatives.find(&self.store, &self.first, &self.store.coded(number, &state))
            else {
                continue;
            };
            let all = representatives.owed(number, self.store.parent(number));
            representatives.leave_out(number, (other, ended));
            for owed in all {
                self.owe(other, Owed { ended: owed.ended | ended, ..owed });
            }
        }
    }

    /// What is postponed in a state that was expanded, and what was to be decided then.
    pub(super) fn note_expanded(&mut self, number: usize, left: u64) {
        let Some(representatives) = &mut self.representatives else { return };
        let is_first = !representatives.is_expanded(number);
        let state = self.store.state(number);
        representatives.expanded(number, &state, left, &mut self.first);
        if !is_first {
            return;
        }
        for owed in representatives.last_owed(number, self.store.parent(number)) {
            self.settle(number, owed);
        }
    }

    /// A scan has led to a state, or to one that it counts for.
    pub(super) fn owe(&mut self, to: usize, mut owed: Owed) {
        let Some(representatives) = &mut self.representatives else { return };
        let (to, more) = representatives.of(to);
        owed.ended |= more;
        if representatives.is_expanded(to) {
            return self.settle(to, owed);
        }
        let first = representatives.first(to, self.store.parent(to));
        if owed.ended != 0 || owed.mask & !first.mask != 0 {
            representatives.owe(to, owed);
        }
    }

    /// Stores what the state, which is expanded, does not count for.
    pub(super) fn settle(&mut self, of: usize, Owed { from, ended, mask }: Owed) {
        let Some(representatives) = &self.representatives else { return };
        let postponed = representatives.postponed[of];
        if (ended | mask) & !postponed == 0 {
            return;
        }
        let state = self.store.state(of);
        if ended & !postponed != 0 {
            let (to, ended) = self.reach_ended(from, mask, &state, ended);
            self.bind(of, to);
            return self.owe(to, Owed { from, ended, mask });
        }
        let (lost, mask) = (mask & !postponed, mask & postponed);
        let mut some = lost;
        while some != 0 {
            let (to, more) = self.reach_ended(from, mask, &state, ended | some);
            self.bind(of, to);
            self.owe(to, Owed { from, ended: more, mask });
            some = (some - 1) & lost;
        }
    }

    /// A state counts for others only if this one does, in which more has ended.
    pub(super) fn bind(&mut self, state: usize, to: usize) {
        if let Some(representatives) = &mut self.representatives {
            representatives.bound.push((state as u32, to as u32));
        }
    }

    /// The state in which the commands of these machines have ended.
    pub(super) fn reach_ended(&mut self, from: usize, mask: u64, state: &[u8], ended: u64) -> (usize, u64) {
        let mut state = state.to_vec();
        for machine in members(ended) {
            if let Some(end) = self.first.end_of(machine, &state) {
                let after = end.after.clone();
                self.first.postponing.replace(machine, &mut state, &after);
            }
        }
        let state = self.store.code(&state);
        let found = self.store.find_coded(&state);
        if let Some(representatives) = self.representatives.as_mut()
            && let Some(found) = found
        {
            let (other, more) = representatives.of(found);
            if more & !representatives.postponed[other] != 0 {
                representatives.resume(found);
            }
        }
        self.arrive(from, mask, state, u64::MAX)
    }
}
