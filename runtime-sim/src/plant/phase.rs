//! How long a machine goes on as it does: until then nothing of it changes but places on its paths, so that whoever has
//! seen how it moves need not look again.

use super::{EARLY_MS, Plant};

/// What a machine does from one event of its own to the next one.
#[derive(Clone, Debug)]
pub(super) struct Phase {
    number: u64,
    /// It has not moved on since it began: how it moves is not settled.
    is_new: bool,
    /// The one in which it obeyed its outputs.
    obeyed: u64,
    /// When the machine does something next, ms; negative infinity: at once, as far as anybody knows.
    next_ms: f64,
}

impl Default for Phase {
    fn default() -> Self {
        Self { number: 1, is_new: true, obeyed: 0, next_ms: f64::NEG_INFINITY }
    }
}

impl Phase {
    /// Another one for each phase of the machine.
    pub fn number(&self) -> u64 {
        self.number
    }

    /// Something has happened to the machine.
    pub fn begin(&mut self) {
        *self = Self { number: self.number + 1, obeyed: self.obeyed, ..Self::default() };
    }

    /// The machine moves on to a time, ms.
    pub fn go_on_to(&mut self, ms: f64) {
        if self.is_new {
            self.begin();
            self.is_new = false;
        } else if self.next_ms <= ms + EARLY_MS {
            self.begin();
        }
    }

    /// When the machine does something next, if that is later than a time, ms, and known.
    pub fn next_after(&self, ms: f64) -> Option<f64> {
        Some(self.next_ms).filter(|next_ms| *next_ms > ms)
    }

    /// What [`Self::next_after`] knows from now on.
    pub fn expect(&mut self, next_ms: f64) {
        if !self.is_new {
            self.next_ms = next_ms;
        }
    }

    /// Whether the machine has obeyed the same outputs in this phase before; now it has.
    pub fn has_obeyed(&mut self) -> bool {
        std::mem::replace(&mut self.obeyed, self.number) == self.number
    }
}

impl Plant {
    /// Changes whenever a machine may not go on as it did.
    pub(crate) fn phase(&self, machine: usize) -> u64 {
        self.machines.get(machine).map_or(0, |machine| machine.phase.number)
    }

    /// The same for all machines.
    pub(super) fn phases(&self) -> u64 {
        self.machines.iter().map(|machine| machine.phase.number).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Moved on once, so that how it moves is settled.
    fn settled() -> Phase {
        let mut phase = Phase::default();
        phase.go_on_to(10.0);
        phase
    }

    #[test]
    fn what_has_just_begun_is_asked_again_after_it_has_moved_on() {
        let mut phase = Phase::default();
        phase.expect(1000.0);
        assert_eq!(phase.next_after(0.0), None);
        let begun = phase.number();
        phase.go_on_to(10.0);
        assert!(phase.number() > begun);
        phase.expect(1000.0);
        assert_eq!(phase.next_after(10.0), Some(1000.0));
    }

    #[test]
    fn a_phase_ends_when_the_machine_does_something() {
        let mut phase = settled();
        phase.expect(1000.0);
        let number = phase.number();
        phase.go_on_to(999.0);
        assert_eq!((phase.number(), phase.next_after(999.0)), (number, Some(1000.0)));
        phase.go_on_to(1000.0);
        assert!(phase.number() > number);
        assert_eq!(phase.next_after(0.0), None);
    }

    #[test]
    fn of_whom_nobody_asked_nothing_is_known() {
        let mut phase = settled();
        let number = phase.number();
        phase.go_on_to(20.0);
        assert!(phase.number() > number);
    }

    #[test]
    fn outputs_are_obeyed_once_in_each_phase() {
        let mut phase = settled();
        assert_eq!([phase.has_obeyed(), phase.has_obeyed()], [false, true]);
        phase.begin();
        assert_eq!([phase.has_obeyed(), phase.has_obeyed()], [false, true]);
    }
}
