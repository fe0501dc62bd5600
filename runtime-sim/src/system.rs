//! The inputs of the system, as the scenario has them given.

use crate::line::{LineButton, Pause, Scenario};
use crate::scan::SystemInputs;

/// Takes the permit away in the pauses, and gives an edge of `start` one scan after it has come back.
#[derive(Clone)]
pub struct Operator {
    had_permit: bool,
    owes_start: bool,
    /// It has given `start` at least once.
    gave_start: bool,
    last: SystemInputs,
    /// The next scan whose inputs were not given yet.
    next: u64,
}

impl Operator {
    pub fn new() -> Self {
        Self {
            had_permit: true,
            owes_start: false,
            gave_start: false,
            last: SystemInputs::default(),
            next: 0,
        }
    }

    pub fn inputs(&mut self, scan: u64, scenario: &Scenario) -> SystemInputs {
        let run_permit = !pauses(scenario).any(|pause| pause.holds(scan));
        if scan == scenario.start_scan || (!run_permit && scan > scenario.start_scan) {
            self.owes_start = true;
        }
        let start = self.owes_start && run_permit && self.had_permit;
        if start {
            self.owes_start = false;
            self.gave_start = true;
        }
        self.had_permit = run_permit;
        self.next = scan + 1;
        self.last = SystemInputs {
            run_permit,
            start: start || scenario.presses(LineButton::Start, scan),
            reset: scenario.presses(LineButton::Reset, scan),
        };
        self.last
    }

    /// Whether the permit is there before this scan, and all edges of `start` were given by then.
    pub fn has_started(&self, scan: u64, scenario: &Scenario) -> bool {
        let mut later = self.clone();
        if later.next < scan {
            later.inputs(scan - 1, scenario);
        }
        later.had_permit && later.gave_start && !later.owes_start
    }

    /// The first scan after this one, whose inputs were given last, in which they may be others. None: never.
    pub fn next_change(&self, scan: u64, scenario: &Scenario) -> Option<u64> {
        if self.clone().inputs(scan + 1, scenario) != self.last {
            return Some(scan + 1);
        }
        let ends = pauses(scenario).flat_map(|pause| [pause.at_scan, pause.end()]);
        ends.chain([scenario.start_scan]).chain(scenario.changes_by_hand()).filter(|at| *at > scan).min()
    }

    /// Something is still to come from here after this scan: a permit, an edge of `start`, what a person does.
    pub fn is_busy(&self, scan: u64, scenario: &Scenario) -> bool {
        let is_at_work_later = scenario.changes_by_hand().any(|change| change > scan);
        !self.had_permit || self.owes_start || scan < scenario.start_scan || is_at_work_later
    }
}

/// Whatever takes the permit away.
fn pauses(scenario: &Scenario) -> impl Iterator<Item = &Pause> {
    scenario.pauses.iter().chain(&scenario.power_offs)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn given(pauses: Vec<Pause>) -> (Vec<u64>, Vec<u64>) {
        let scenario = Scenario { pauses, ..Scenario::default() };
        let mut operator = Operator::new();
        let inputs: Vec<_> = (0..20).map(|scan| operator.inputs(scan, &scenario)).collect();
        let scans = |pick: fn(&SystemInputs) -> bool| {
            (0..20).filter(|&scan| pick(&inputs[scan as usize])).collect::<Vec<u64>>()
        };
        (scans(|i| i.start), scans(|i| !i.run_permit))
    }

    #[test]
    fn one_edge_starts() {
        assert_eq!(given(vec![]), (vec![2], vec![]));
    }

    #[test]
    fn every_pause_is_followed_by_an_edge() {
        let pauses = vec![Pause { at_scan: 5, scans: 3 }, Pause { at_scan: 12, scans: 1 }];
        assert_eq!(given(pauses), (vec![2, 9, 14], vec![5, 6, 7, 12]));
    }

    #[test]
    fn the_first_edge_waits_for_the_permit() {
        assert_eq!(given(vec![Pause { at_scan: 0, scans: 4 }]), (vec![5], vec![0, 1, 2, 3]));
    }
}
