//! The alarms of a run. A loss of power clears those of the controllers.

use crate::line::Line;
use crate::monitor::ALARM_WORDS;
use crate::report::{self, AlarmReport};

#[derive(Clone)]
pub struct Alarms<'a> {
    line: &'a Line,
    /// The scan in which the controllers had their power again last. They count theirs from there.
    powered_up: u64,
    /// Those of earlier power-ups that were raised, by machine and number.
    earlier: Vec<Vec<Option<AlarmReport>>>,
}

impl<'a> Alarms<'a> {
    pub fn new(line: &'a Line) -> Self {
        let of_machines = line.machines.iter().map(|machine| vec![None; machine.monitor.alarms.len()]);
        Self { line, powered_up: 0, earlier: of_machines.collect() }
    }

    /// Power is back in this scan; `trace` is the last one before it was lost.
    pub fn power_up(&mut self, trace: &[f64], scan: u64) {
        self.take(trace);
        for alarm in self.earlier.iter_mut().flatten().flatten() {
            (alarm.active, alarm.acknowledged) = (false, true);
        }
        self.powered_up = scan;
    }

    /// All alarms of the run that were raised, in layout order.
    pub fn until_end(mut self, trace: &[f64]) -> Vec<AlarmReport> {
        self.take(trace);
        self.earlier.into_iter().flatten().flatten().collect()
    }

    /// Adds those that this trace has as raised since the last power-up.
    fn take(&mut self, trace: &[f64]) {
        for machine in 0..self.line.machines.len() {
            for number in 0..self.earlier[machine].len() {
                if let Some(later) = self.raised(trace, machine, number) {
                    let alarm = &mut self.earlier[machine][number];
                    *alarm = Some(match alarm.take() {
                        Some(earlier) => in_sequence(earlier, later),
                        None => later,
                    });
                }
            }
        }
    }

    /// An alarm as the trace has it; none if it was not raised since the last power-up.
    fn raised(&self, trace: &[f64], machine: usize, number: usize) -> Option<AlarmReport> {
        let machine = &self.line.machines[machine];
        let alarm = &machine.monitor.alarms[number];
        let [active, acknowledged, count, first, last] =
            *trace.get(alarm.word..)?.first_chunk::<ALARM_WORDS>()?;
        let at = |scan: f64| report::seconds(self.powered_up + scan as u64, self.line.scan_ms);
        (count > 0.0).then(|| AlarmReport {
            machine: machine.name.clone(),
            code: alarm.code,
            count: count as u32,
            first_s: at(first),
            last_s: at(last),
            active: active != 0.0,
            acknowledged: acknowledged != 0.0,
        })
    }
}

/// An alarm that was raised before a loss of power and again after it.
fn in_sequence(earlier: AlarmReport, later: AlarmReport) -> AlarmReport {
    AlarmReport { count: earlier.count.saturating_add(later.count), first_s: earlier.first_s, ..later }
}
