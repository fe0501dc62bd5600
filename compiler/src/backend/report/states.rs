//! How long each machine was in which state.

use runtime_sim::account::Counted;
use runtime_sim::history::MachineHistory;
use std::collections::BTreeMap;

/// Scans in each state while the line ran, by its number, the longest first.
pub fn times(machine: &MachineHistory, scans: u64) -> Vec<(usize, u64)> {
    let mut sums: BTreeMap<usize, u64> = BTreeMap::new();
    for (number, stay) in machine.stays.iter().enumerate() {
        let end = machine.stays.get(number + 1).map_or(scans, |next| next.scan);
        if stay.counted != Counted::Stopped {
            *sums.entry(stay.state).or_default() += end.saturating_sub(stay.scan);
        }
    }
    let mut times: Vec<_> = sums.into_iter().filter(|(_, scans)| *scans > 0).collect();
    times.sort_by_key(|(_, scans)| std::cmp::Reverse(*scans));
    times
}

#[cfg(test)]
mod tests {
    use super::times;
    use runtime_sim::account::Counted;
    use runtime_sim::history::{MachineHistory, Stay};

    #[test]
    fn times_in_states_are_those_in_which_the_line_ran() {
        let stay = |scan, state, counted| Stay { scan, state, counted };
        let stays = vec![
            stay(0, 0, Counted::Stopped),
            stay(2, 1, Counted::Working),
            stay(10, 2, Counted::Waiting),
            stay(40, 1, Counted::Working),
            stay(45, 1, Counted::Stopped),
            stay(60, 1, Counted::Working),
        ];
        let machine = MachineHistory { stays, ..MachineHistory::default() };
        // 8 and 5 scans, and 10 to the end.
        assert_eq!(times(&machine, 70), [(2, 30), (1, 23)]);
    }
}
