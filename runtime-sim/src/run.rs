//! A run: controllers against the plant, scan by scan, until it is over.

mod accounts;
mod agenda;
mod alarms;
mod changes;
mod faults;
mod order_times;
mod power;
mod progress;
mod recorders;
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
pub(crate) use order_times::OrderTimes;
use recorders::Recorders;
use simulation::Simulation;
use variant::Variant;

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

/// The report, and the plant at the end.
fn simulate(
    line: &Line,
    controllers: &mut dyn Controllers,
    stepping: Stepping,
    memory: &mut Memory,
    observer: &mut dyn FnMut(&Seen),
    mut recorders: Option<&mut Recorders>,
) -> Result<(Report, Plant), String> {
    let mut simulation = Simulation::new(line, controllers, stepping, memory)?;
    let mut variant = Variant::new(line, controllers);
    let end = loop {
        let mut begun = simulation.begin(&mut variant)?;
        simulation.take(&mut begun, &variant)?;
        let recorders = recorders.as_deref_mut();
        if let Some(end) = simulation.proceed(begun, &variant, memory, observer, recorders)? {
            break end;
        }
    };
    Ok(simulation.report(end, &mut variant))
}
