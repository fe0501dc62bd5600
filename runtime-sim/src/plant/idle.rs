//! Machines that are idle: nothing of them changes until one of their outputs, an item on them, or an order does. Until
//! then they are left out of what is done with all machines.

use super::Plant;
use super::working::{Shared, Working};
use crate::event::Event;
use crate::image::are_same;
use crate::part::Running;
use crate::plant::trajectory::Trajectory;

/// For how long nothing of a machine has changed.
#[derive(Clone, Debug, Default)]
pub(super) struct Idle {
    /// Others move its parts or look for them.
    is_shared: bool,
    has_faults: bool,
    /// The outputs that it obeyed last.
    outputs: Vec<f64>,
    /// How often in a row nothing of it had changed, nor was going to.
    quiet: u32,
    /// When its parts were advanced last, ms.
    advanced_ms: u64,
}

/// Up to the first of these times it may have moved; who looked at it then has seen how it stands at the second one.
const QUIET: u32 = 2;

impl Idle {
    pub fn new(parts: &[Option<Box<dyn Running>>], has_faults: bool) -> Self {
        let mut running = parts.iter().flatten();
        let is_shared = running.any(|part| part.lane().is_some() || part.scanner().is_some());
        Self { is_shared, has_faults, ..Self::default() }
    }

    /// The machine goes on as it did when it was last asked, and nothing of it changes.
    fn stay(&mut self, now_ms: u64) {
        if self.quiet > 0 {
            self.quiet += 1;
        }
        self.advanced_ms = now_ms;
    }
}

impl Working {
    pub(super) fn is_idle(&self) -> bool {
        self.is_still() && !self.idle.is_shared
    }

    /// None of its inputs changes until something happens to it.
    pub(super) fn is_still(&self) -> bool {
        self.idle.quiet >= QUIET
    }

    /// Whether these are the outputs that it obeyed last; it remembers them.
    fn has_obeyed(&mut self, outputs: &[f64]) -> bool {
        let known = &mut self.idle.outputs;
        let is_same = known.len() == outputs.len() && are_same(known, outputs);
        if !is_same {
            known.clear();
            known.extend(outputs);
        }
        is_same
    }

    /// Something of it changes at this time, ms, to which all that is not idle was advanced.
    fn wake(&mut self, shared: &mut Shared, now_ms: u64) {
        if self.is_idle() {
            let since_ms = self.idle.advanced_ms;
            (shared.now_ms, shared.dt_ms) = (since_ms, now_ms - since_ms);
            self.advance(shared);
        }
        self.begin_phase();
    }

    /// It does not go on as it did; it is not idle.
    pub(super) fn begin_phase(&mut self) {
        self.idle.quiet = 0;
        self.phase.begin();
    }
}

impl Plant {
    /// What concerns a machine wakes it: events since the last time. All that is not idle was advanced to this time, ms.
    pub(super) fn wake_concerned(&mut self, now_ms: u64) {
        for number in self.heard..self.items.log().count() {
            match self.items.log().since(number)[0] {
                Event::Item { from, to, .. } => {
                    for machine in [from, to].map(|carrier| self.machine_under(carrier)).into_iter().flatten()
                    {
                        self.wake(machine, now_ms);
                    }
                }
                Event::Kind { item, .. } => {
                    if let Some(machine) = self.base_carrier(item).machine() {
                        self.wake(machine, now_ms);
                    }
                }
                Event::Order { .. } => {
                    (0..self.machines.len()).for_each(|machine| self.wake(machine, now_ms))
                }
            }
        }
        self.heard = self.items.log().count();
    }

    fn wake(&mut self, machine: usize, now_ms: u64) {
        let (machines, mut shared) = self.split(self.scan + 1);
        machines[machine].wake(&mut shared, now_ms);
    }

    /// Whether a machine has to look at its outputs: they are others than before, or it does not go on as it did.
    pub(super) fn has_to_obey(&mut self, machine: usize, outputs: &[f64]) -> bool {
        let working = &mut self.machines[machine];
        if !working.has_obeyed(outputs) || working.faults().exist() {
            self.wake(machine, self.now_ms());
        }
        !self.machines[machine].phase.has_obeyed()
    }

    /// When a machine does something next, as [`Working::next_change`]. If it never does, and nothing of it has changed
    /// since it was asked last, it is idle.
    pub(super) fn next_change_of(&mut self, machine: usize) -> f64 {
        let now_ms = self.now_ms();
        let working = &mut self.machines[machine];
        if working.is_idle() {
            return f64::INFINITY;
        }
        if let Some(next_ms) = working.phase.next_after(now_ms as f64) {
            working.idle.stay(now_ms);
            return next_ms;
        }
        let working = &self.machines[machine];
        let next_ms = working.next_change(&self.items, &self.desk, now_ms);
        let is_quiet = !working.idle.has_faults
            && next_ms.is_infinite()
            && working.trajectory(now_ms).since(now_ms as f64) == Trajectory::Rests
            && !working.flows(now_ms)
            && working.looks().next().is_none()
            && !working.is_busy(&self.items, &self.desk, self.scan, now_ms);
        let working = &mut self.machines[machine];
        working.phase.expect(next_ms);
        working.idle.quiet = if is_quiet { working.idle.quiet + 1 } else { 0 };
        working.idle.advanced_ms = now_ms;
        next_ms
    }

    /// Nothing of it moves, nor has since it was looked at last.
    pub(crate) fn is_idle(&self, machine: usize) -> bool {
        self.machines.get(machine).is_some_and(Working::is_idle)
    }

    /// The inputs of a machine that is still are as they were.
    pub(super) fn check_still(&self, machine: usize) {
        let mut image = self.images[machine].clone();
        self.machines[machine].write(&mut image, &self.items, &self.desk);
        let bits = |image: &[f64]| image.iter().map(|word| word.to_bits()).collect::<Vec<_>>();
        debug_assert_eq!(bits(&image), bits(&self.images[machine]), "machine {machine} is not still");
    }
}
