//! A run: controllers against the plant, scan by scan, until it is over.

use crate::account::{Account, Activity};
use crate::collision::{CollisionCheck, Contact};
use crate::conservation::conservation;
use crate::event::{Event, OrderChange};
use crate::hash::Hash;
use crate::line::Line;
use crate::path::{Path, Recorder};
use crate::plant::{self, Bus, Plant};
use crate::report::{Outcome, Report};
use crate::scan::{Controllers, SystemInputs, SystemOutputs};
use crate::shortage::{point_text, shortage};
use crate::system::Operator;
use crate::wiring::{Drives, Source};

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

/// Runs the line until all orders are made, a fault is reported, time is up or nothing changes any more.
/// In scan n the inputs are latched, the controllers stepped and their outputs published, which act from
/// then on; then the plant goes on to scan n+1. An error means that the line cannot be run at all.
pub fn run(
    line: &Line,
    controllers: &mut dyn Controllers,
    observer: &mut dyn FnMut(&Seen),
) -> Result<Report, String> {
    let (report, _) = simulate(line, controllers, observer, None)?;
    Ok(report)
}

/// The same run, and the paths of all items, in the order of the line's supply.
pub fn record(
    line: &Line,
    controllers: &mut dyn Controllers,
    observer: &mut dyn FnMut(&Seen),
) -> Result<(Report, Vec<Path>), String> {
    simulate(line, controllers, observer, Some(Recorder::new(line)))
}

fn simulate(
    line: &Line,
    controllers: &mut dyn Controllers,
    observer: &mut dyn FnMut(&Seen),
    mut recorder: Option<Recorder>,
) -> Result<(Report, Vec<Path>), String> {
    let mut plant = Plant::new(line)?;
    let mut check = CollisionCheck::new(line);
    let mut bus = Bus::new(line.io_delay.clone(), plant.images());
    let mut operator = Operator::new();
    let mut inputs = plant.images().to_vec();
    let mut outputs = plant::outputs(line);
    let output_words: Vec<usize> = outputs.iter().map(Vec::len).collect();
    let mut accounts = vec![Account::new(line); line.machines.len()];
    let mut states = vec![usize::MAX; line.machines.len()];
    let numbers: Vec<_> = (0..line.machines.len()).map(|machine| numbers(line, machine)).collect();
    let mut hash = Hash::default();
    let mut trace = Vec::new();
    let mut progress = Progress::default();
    let mut scan = 0;

    let mut fault = None;
    let (finished, reason) = loop {
        let mut changed = bus.exchange(scan, plant.images(), &mut inputs);
        let system = operator.inputs(scan, &line.scenario);
        let answer = controllers.scan(system, &inputs, &mut outputs);
        if outputs.len() != output_words.len()
            || outputs.iter().zip(&output_words).any(|(o, &n)| o.len() != n)
        {
            return Err(format!("the controllers changed the size of an output image in scan {scan}"));
        }
        trace.clear();
        controllers.trace(&mut trace);
        hash.take(&trace);
        outputs.iter().for_each(|image| hash.take(image));
        observer(&Seen {
            scan,
            system,
            answer,
            inputs: &inputs,
            outputs: &outputs,
            trace: &trace,
            hash: hash.value(),
            plant: &plant,
        });

        for (machine, account) in accounts.iter_mut().enumerate() {
            let state = controllers.state(machine);
            changed |= std::mem::replace(&mut states[machine], state) != state;
            let activity = if !answer.running {
                Activity::Stopped
            } else if numbers[machine].is_some_and(|(cmd, ack)| outputs[machine][cmd] != inputs[machine][ack])
            {
                Activity::Moving
            } else {
                Activity::InState(state)
            };
            account.book(line, machine, activity);
        }

        plant.obey(&outputs);
        if let Some(recorder) = &mut recorder {
            recorder.look(&plant);
        }
        let collision = check.look(&plant).map(collision_text);
        plant.proceed();
        scan += 1;
        changed |= plant.is_busy() || operator.is_busy(scan, &line.scenario);
        progress.quiet_scans = if changed { 0 } else { progress.quiet_scans + 1 };
        if answer.fault {
            let machine =
                usize::try_from(answer.fault_robot).ok().filter(|&robot| robot < line.machines.len());
            fault = Some((answer.fault_code, machine));
            break (false, fault_text(line, answer.fault_code, machine));
        }
        if let Some(reason) = collision {
            break (false, reason);
        }
        if let Some(end) = progress.end(line, &plant, scan) {
            break end;
        }
    };
    let (finished, reason) = match conservation(plant.items().log(), plant.items()) {
        Ok(()) => (finished, reason),
        Err(violation) => (false, format!("bug: {violation}")),
    };
    let outcome = Outcome {
        finished,
        reason,
        fault,
        scans: scan,
        accounts,
        states,
        trace_hash: hash.value(),
        collisions: check.into_contacts(),
    };
    let paths = recorder.map_or_else(Vec::new, |recorder| recorder.finish(&plant));
    Ok((Report::new(line, &plant, outcome), paths))
}

/// How far a run has come, and for how long nothing has happened.
#[derive(Default)]
struct Progress {
    made: usize,
    /// Events that were looked at.
    read: usize,
    quiet_scans: u64,
}

impl Progress {
    fn end(&mut self, line: &Line, plant: &Plant, scans: u64) -> Option<(bool, String)> {
        let log = plant.items().log();
        let made = |event: &&Event| matches!(event, Event::Order { change: OrderChange::Made, .. });
        self.made += log[self.read..].iter().filter(made).count();
        self.read = log.len();

        let scenario = &line.scenario;
        let reached = |scans: u64, limit_s: f64| (scans * u64::from(line.scan_ms)) as f64 >= limit_s * 1000.0;
        if self.made == scenario.orders.len() {
            Some((true, "all orders made".into()))
        } else if reached(self.quiet_scans, scenario.stall_limit_s) {
            Some((false, format!("deadlock: {}", shortage(line, plant))))
        } else if reached(scans, scenario.time_limit_s) {
            Some((false, format!("time limit: {}", shortage(line, plant))))
        } else {
            None
        }
    }
}

/// Where in the images of a machine the number of its last command stands, and the number answered. None for a
/// machine without commands.
fn numbers(line: &Line, machine: usize) -> Option<(usize, usize)> {
    let (wiring, kinds) = (&line.machines[machine].wiring, line.kinds.len());
    Some((wiring.output_at(Drives::Command, kinds)?, wiring.input_at(Source::Ack, kinds)?))
}

fn collision_text(contact: &Contact) -> String {
    let [a, b] = &contact.pair;
    let [of_a, of_b] = &contact.parts;
    let place = point_text(contact.place);
    format!("collision of {a} ({of_a}) with {b} ({of_b}) at {:.3} s, {place}", contact.time_s)
}

fn fault_text(line: &Line, code: i32, machine: Option<usize>) -> String {
    match machine {
        Some(machine) => format!("fault {code} of {}", line.machines[machine].name),
        None => format!("fault {code}"),
    }
}
