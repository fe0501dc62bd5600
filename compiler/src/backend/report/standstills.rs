//! When the line did not run: before a start, without the permit, in a fault, without power; and when a machine was stopped.

use super::signals::Signal;
use runtime_sim::account::Counted;
use runtime_sim::history::{History, MachineHistory};
use runtime_sim::io_trace::Source;

/// First scans, and those in which it runs again; in the order of time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Standstills(Vec<(u64, u64)>);

impl Standstills {
    /// Of the line, up to this scan.
    pub fn new(history: &History, signals: &[Signal], end: u64) -> Self {
        let running = signals.iter().position(|signal| signal.source == Source::Running);
        let Some(running) = running.and_then(|number| history.words.get(number)) else {
            return Self::default();
        };
        let ends = running.changes.iter().skip(1).map(|(scan, _)| *scan).chain([end]);
        let all = running.changes.iter().zip(ends);
        Self(all.filter(|((_, runs), _)| *runs == 0.0).map(|((begin, _), end)| (*begin, end)).collect())
    }

    /// Of one machine: with the line, or by itself.
    pub fn of_machine(history: &MachineHistory, end: u64) -> Self {
        let ends = history.stays.iter().skip(1).map(|stay| stay.scan).chain([end]);
        let all = history.stays.iter().zip(ends).filter(|(stay, _)| stay.counted == Counted::Stopped);
        Self(
            all.map(|(stay, until)| (stay.scan, until.min(end))).filter(|(begin, end)| begin < end).collect(),
        )
    }

    /// Scans from one on and before another in which it did not run.
    pub fn scans(&self, from: u64, to: u64) -> u64 {
        let first = self.0.partition_point(|(_, end)| *end <= from);
        let within = self.0[first..].iter().take_while(|(begin, _)| *begin < to);
        within.map(|(begin, end)| (*end).min(to) - (*begin).max(from)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::Standstills;

    #[test]
    fn scans_of_standstills_within_a_time_are_counted() {
        let all = Standstills(vec![(0, 2), (10, 20), (30, 31)]);
        assert_eq!(
            [(0, 40), (2, 10), (5, 12), (12, 15), (19, 31)].map(|(a, b)| all.scans(a, b)),
            [13, 0, 2, 3, 2]
        );
    }
}
