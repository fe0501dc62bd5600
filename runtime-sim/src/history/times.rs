//! The time of a machine in its state, where it is not what its states say.

use super::Stay;
use crate::account::Counted;

/// A time in a state is 0 in the scan in which the state is entered, and grows in each scan in which the machine is not
/// stopped. Anything else is noted here: a transition to the same state, a reset, a new begin.
#[derive(Clone, Debug, Default)]
pub struct Times {
    /// Scans, and the time in the state at their ends, ms.
    pub set: Vec<(u64, u64)>,
    last: Option<(Stay, u64)>,
}

/// Times in states do not grow further.
const MOST_MS: u64 = i32::MAX as u64;

impl Times {
    /// What holds at the end of a scan in which the controllers were stepped. Whether it is more than that time has passed.
    pub(super) fn note(&mut self, stay: Stay, ms: u64, scan_ms: u64) -> bool {
        let grows = |counted: Counted| if counted == Counted::Stopped { 0 } else { scan_ms };
        let expected = match self.last {
            Some((last, ms)) if last.state == stay.state => {
                let left_out = (stay.scan - last.scan).saturating_sub(1);
                (ms + left_out * grows(last.counted) + grows(stay.counted)).min(MOST_MS)
            }
            _ => 0,
        };
        let is_new = ms != expected;
        if is_new {
            self.set.push((stay.scan, ms));
        }
        self.last = Some((stay, ms));
        is_new
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_times_that_have_not_just_grown_are_noted() {
        let mut times = Times::default();
        let mut note = |scan, state, counted, ms| {
            times.note(Stay { scan, state, counted }, ms, 10);
        };
        note(0, 0, Counted::Stopped, 0);
        note(2, 1, Counted::Working, 0);
        note(5, 1, Counted::Working, 30);
        // To the same state, then a pause.
        note(6, 1, Counted::Waiting, 0);
        note(8, 1, Counted::Stopped, 10);
        note(20, 1, Counted::Working, 20);
        // A reset while the line stands.
        note(22, 1, Counted::Stopped, 30);
        note(30, 1, Counted::Stopped, 0);
        note(31, 2, Counted::Working, 0);
        assert_eq!(times.set, [(6, 0), (30, 0)]);
    }
}
