//! A run: controllers against the plant, scan by scan, until it is over.

mod accounts;
mod agenda;
mod alarms;
mod branch;
mod changes;
mod faults;
mod order_times;
mod power;
mod progress;
mod recorders;
mod settled;
mod simulation;
mod variant;

use crate::history::History;
use crate::io_trace::Source as Word;
use crate::line::Line;
use crate::memory::Memory;
use crate::path::Path;
use crate::plant::Plant;
use crate::report::Report;
use crate::scan::{Controllers, SystemInputs, SystemOutputs};
use branch::Branch;
pub(crate) use order_times::OrderTimes;
use recorders::Recorders;

/// What an observer is shown of a scan, once its outputs are published.
pub struct Seen<'a> {
    pub scan: u64,
    pub system: SystemInputs,
    pub answer: SystemOutputs,
    /// The images that the controllers latched.
    pub inputs: &'a [Vec<f64>],
    pub outputs: &'a [Vec<f64>],
    /// What [`Controllers::trace`] gave.
    pub trace: &'a [f64],
    /// Over all scans up to this one: where two runs differ first, it differs first.
    pub hash: u64,
    /// The plant at the start of the scan.
    pub plant: &'a Plant,
}

/// Which scans a run executes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stepping {
    /// Those in which something may happen. In all others nothing changes but times in states, and places on paths.
    Events,
    EveryScan,
    /// Every scan; an error, if something happens in one that [`Stepping::Events`] leaves out.
    Checked,
}

/// Runs the line until all orders are made, a fault is reported that nothing clears later, time is up or nothing changes
/// any more.
/// In scan n the inputs are latched, the controllers stepped and their outputs published, which act from
/// then on; then the plant continues to scan n+1. The observer is shown the scans that are executed. An error means that
/// the line cannot be run at all.
pub fn run(
    line: &Line,
    controllers: &mut dyn Controllers,
    stepping: Stepping,
    observer: &mut dyn FnMut(&Seen),
) -> Result<Report, String> {
    run_again(line, controllers, stepping, &mut Memory::default(), observer)
}

/// The same with what earlier runs have found about these machines: the same events, sooner.
pub fn run_again(
    line: &Line,
    controllers: &mut dyn Controllers,
    stepping: Stepping,
    memory: &mut Memory,
    observer: &mut dyn FnMut(&Seen),
) -> Result<Report, String> {
    let (report, _) = simulate(line, controllers, stepping, memory, observer, None)?;
    Ok(report)
}

/// A run with all that went on in it.
#[derive(Clone, Debug)]
pub struct Recorded {
    pub report: Report,
    /// Of all items, in the order of the line's supply.
    pub paths: Vec<Path>,
    pub history: History,
}

/// The same run, and what went on in it; of the words of the controllers those that are `watched`.
pub fn record(
    line: &Line,
    controllers: &mut dyn Controllers,
    stepping: Stepping,
    watched: &[Word],
    observer: &mut dyn FnMut(&Seen),
) -> Result<Recorded, String> {
    record_again(line, controllers, stepping, &mut Memory::default(), watched, observer)
}

/// The same with what earlier runs have found about these machines.
pub fn record_again(
    line: &Line,
    controllers: &mut dyn Controllers,
    stepping: Stepping,
    memory: &mut Memory,
    watched: &[Word],
    observer: &mut dyn FnMut(&Seen),
) -> Result<Recorded, String> {
    let mut recorders = Recorders::new(line, watched);
    let (report, plant) = simulate(line, controllers, stepping, memory, observer, Some(&mut recorders))?;
    let (paths, history) = recorders.finish(&plant);
    Ok(Recorded { report, paths, history })
}

/// The runs of a line and of others that have its plant ([`Line::has_plant_of`]), each as [`run_again`] makes it. As long
/// as their controllers do the same, scan by scan, they are one run. The reports are in the order of the lines; an error is
/// that of one of them, and there is no report of any.
pub fn run_together<'a>(
    line: &'a Line,
    controllers: &'a mut dyn Controllers,
    others: Vec<(&'a Line, &'a mut dyn Controllers)>,
    memory: &mut Memory,
) -> Result<Vec<Report>, String> {
    let mut reports = vec![None; 1 + others.len()];
    let mut branches = vec![Branch::new(line, controllers, others, Stepping::Events, memory)?];
    while let Some(mut branch) = branches.pop() {
        let end = branch.run(memory, &mut |_| {}, None, &mut branches)?;
        let numbers = branch.numbers();
        let (report, _) = branch.report(end);
        numbers.into_iter().for_each(|number| reports[number] = Some(report.clone()));
    }
    // Each variant is in one branch.
    Ok(reports.into_iter().flatten().collect())
}

/// The report, and the plant at the end.
fn simulate(
    line: &Line,
    controllers: &mut dyn Controllers,
    stepping: Stepping,
    memory: &mut Memory,
    observer: &mut dyn FnMut(&Seen),
    recorders: Option<&mut Recorders>,
) -> Result<(Report, Plant), String> {
    let mut branch = Branch::new(line, controllers, Vec::new(), stepping, memory)?;
    let end = branch.run(memory, observer, recorders, &mut Vec::new())?;
    Ok(branch.report(end))
}
