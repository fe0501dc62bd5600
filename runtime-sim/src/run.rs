//! A run: controllers against the plant, scan by scan, until it is over.

mod accounts;
mod agenda;
mod alarms;
mod changes;
mod faults;
mod order_times;
mod power;
mod progress;

use crate::account::Activity;
use crate::collision::{CollisionCheck, Contact};
use crate::conservation::Conservation;
use crate::history::{History, Stay};
use crate::io_trace::Source as Word;
use crate::line::Line;
use crate::memory::Memory;
use crate::path::{Path, Recorder};
use crate::plant::{self, Arrived, Bus, Plant};
use crate::report::{Outcome, Report};
use crate::scan::{Controllers, SystemInputs, SystemOutputs};
use crate::shortage::point_text;
use crate::system::Operator;
use crate::wiring::{Drives, Source};
use accounts::Accounts;
use agenda::Agenda;
use alarms::Alarms;
use changes::Changes;
use faults::Faults;
pub(crate) use order_times::OrderTimes;
use power::Unpowered;
use progress::Progress;

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

/// Why a run ends that has reached its goal at its time limit, but for a fault.
const TIME_IN_FAULT: &str = "time limit: the line is in a fault";

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
    let recorders = Some(Recorders { paths: Recorder::new(line), history: History::new(line, watched) });
    let (report, recorders) = simulate(line, controllers, stepping, memory, observer, recorders)?;
    let Recordings { paths, history } = recorders.unwrap_or_default();
    Ok(Recorded { report, paths, history })
}

/// What the recorders have at the end.
#[derive(Default)]
struct Recordings {
    paths: Vec<Path>,
    history: History,
}

/// What a run that is recorded is recorded by.
struct Recorders {
    paths: Recorder,
    history: History,
}

fn simulate(
    line: &Line,
    controllers: &mut dyn Controllers,
    stepping: Stepping,
    memory: &mut Memory,
    observer: &mut dyn FnMut(&Seen),
    mut recorders: Option<Recorders>,
) -> Result<(Report, Option<Recordings>), String> {
    let mut plant = Plant::remembering(line, memory)?;
    let mut check = CollisionCheck::new(line);
    let kinds = line.kinds.len();
    let analogue: Vec<_> = line.machines.iter().map(|machine| machine.analogue_inputs(kinds)).collect();
    let mut bus = Bus::new(line.io_delay.clone(), plant.images(), analogue.clone());
    let mut operator = Operator::new();
    let mut inputs = plant.images().to_vec();
    let mut outputs = plant::outputs(line);
    let output_words: Vec<usize> = outputs.iter().map(Vec::len).collect();
    let mut accounts = Accounts::new(line);
    let mut states: Vec<usize> = (0..line.machines.len()).map(|machine| controllers.state(machine)).collect();
    let numbers: Vec<_> = (0..line.machines.len()).map(|machine| numbers(line, machine)).collect();
    let stays = controllers.stays();
    let times = stays.clone();
    let mut changes = Changes::new(&stays, line);
    let mut agenda = Agenda::new(line, stays, &inputs, analogue);
    let mut unpowered = Unpowered::new(line);
    let mut answer = SystemOutputs::default();
    // The scan after which an edge of `start` would make the line run that does not.
    let mut stands_since = Some(0);
    let mut trace = Vec::new();
    let mut alarms = Alarms::new(line);
    let mut faults = Faults::new(line);
    let mut progress = Progress::new(line);
    let mut conservation = Conservation::new(plant.items());
    let mut order_times = vec![OrderTimes::default(); line.scenario.orders.len()];
    // Events that were handled.
    let mut read = 0;
    let mut scan = 0;
    // In `Checked`: before this scan nothing happens.
    let mut quiet_until = 0;

    let (finished, reason, fault) = loop {
        let arrived = bus.exchange(scan, plant.images(), |machine| plant.moves(machine), &mut inputs);
        let system = operator.inputs(scan, &line.scenario);
        let is_powered = line.scenario.is_powered(scan);
        if line.scenario.powers_up(scan) {
            lose_power(line, controllers, &agenda, scan);
            controllers.power_up();
            alarms.power_up(&trace, scan);
            agenda.power_up();
        }
        agenda.arrive(arrived);
        let is_due = is_powered && agenda.is_due(scan, system, &inputs, &states, &changes);
        let mut acted = false;
        let is_stepped = is_due || is_powered && stepping != Stepping::Events;
        if is_stepped {
            let scans = agenda.scans_since(scan);
            controllers.skip(scans - 1);
            let before = std::mem::replace(&mut answer, controllers.scan(system, &inputs, &mut outputs));
            if outputs.len() != output_words.len()
                || outputs.iter().zip(&output_words).any(|(o, &n)| o.len() != n)
            {
                return Err(format!("the controllers changed the size of an output image in scan {scan}"));
            }
            let is_ready = !answer.running && !answer.fault && system.run_permit;
            stands_since = if is_ready { stands_since.or(Some(scan)) } else { None };
            trace.clear();
            controllers.trace(&mut trace);
            let running = if answer.running { scans } else { 0 };
            acted = changes.take(scan, running, &trace, &outputs) || answer != before;
            for (machine, state) in states.iter_mut().enumerate() {
                *state = controllers.state(machine);
            }
            if acted && stepping == Stepping::Checked && (!is_due || scan < quiet_until) {
                return Err(format!("something happens in scan {scan}, which would be left out"));
            }
            agenda.step(scan, system, &inputs, answer, acted);
            faults.note(scan, answer, &states);
        }
        let fault = faults.last(scan);
        let seen = Seen {
            scan,
            system,
            answer,
            inputs: &inputs,
            outputs: &outputs,
            trace: &trace,
            hash: changes.hash(),
            plant: &plant,
        };
        if is_due || stepping != Stepping::Events {
            observer(&seen);
        }
        if let Some(recorders) = &mut recorders {
            recorders.history.line_words(&seen);
            if acted || arrived == Arrived::Events {
                recorders.history.words(&seen);
            }
        }
        if stepping == Stepping::Checked && arrived == Arrived::Events && scan < quiet_until {
            return Err(format!("an input changes in scan {scan}, which would be left out"));
        }
        progress.note(scan, acted || arrived == Arrived::Events);

        check.follow_items(&plant);
        plant.obey(if is_powered { &outputs } else { unpowered.outputs(&outputs) });
        if let Some(recorders) = &mut recorders {
            recorders.paths.look(&plant);
            recorders.history.look(&plant);
        }
        let is_alive = plant.is_busy()
            || operator.is_busy(scan, &line.scenario)
            || agenda.is_timed(scan, &states, &changes)
            || faults.is_present();
        if is_alive {
            progress.is_alive(scan);
        }
        let mut next = scan + 1;
        let looks_ahead = match stepping {
            _ if fault.is_some() => false,
            Stepping::Events => true,
            Stepping::EveryScan => false,
            Stepping::Checked => scan >= quiet_until,
        };
        if looks_ahead {
            let events = [
                agenda.next_step(scan, &states, &changes, &plant),
                plant.next_change(),
                operator.next_change(scan, &line.scenario),
                line.scenario.next_without_power(scan),
                Some(progress.limit()),
                (!is_alive).then(|| progress.stalls_at()),
            ];
            let quiet = events.into_iter().flatten().min().unwrap_or(scan + 1);
            quiet_until = bus.next_exchange(scan, quiet.max(scan + 1), progress.last_event());
            if stepping == Stepping::Events && !check.touches() {
                next = quiet_until;
            }
        }
        let (next, collision) = check.look_until(&plant, memory, scan, next);
        let collision = collision.map(collision_text);
        let logged = plant.items().log().count();
        plant.proceed_to(next);
        if stepping == Stepping::Checked && next < quiet_until && plant.items().log().count() > logged {
            return Err(format!("an item or an order changes before scan {next}, which would be left out"));
        }
        if is_alive {
            progress.is_alive(next - 1);
        }
        if is_stepped || arrived != Arrived::Nothing || scan == 0 {
            for machine in 0..line.machines.len() {
                let is_stopped = line.machines[machine].monitor.is_stopped(&trace);
                let activity = if !answer.running || is_stopped {
                    Activity::Stopped
                } else if numbers[machine]
                    .is_some_and(|(cmd, ack)| outputs[machine][cmd] != inputs[machine][ack])
                {
                    Activity::Moving
                } else {
                    Activity::InState(states[machine])
                };
                accounts.note(machine, activity, scan);
                if let Some(recorders) = &mut recorders {
                    let stay =
                        Stay { scan, state: states[machine], counted: activity.counted(line, machine) };
                    recorders.history.stay(machine, stay);
                    if let Some(word) = times.get(machine).filter(|_| is_stepped) {
                        recorders.history.time(machine, stay, changes.stay(*word) as u64);
                    }
                }
            }
        }
        scan = next;
        let events = plant.items().log().since(read);
        conservation.take(events);
        order_times::note(&mut order_times, events);
        progress.count(line, &plant, scan, events);
        // Those of this round are read in the next one too.
        plant.forget_events(read);
        read = plant.items().log().count();
        if let Some((code, machine)) = fault {
            break (false, fault_text(line, code, machine), fault);
        }
        if let Some(reason) = collision {
            break (false, reason, None);
        }
        match progress.end(line, &plant, scan) {
            // The goal does not count while the line is in a fault.
            Some((true, _)) if faults.is_present() && scan < progress.limit() => {}
            Some((true, _)) if faults.is_present() => break (false, TIME_IN_FAULT.into(), None),
            Some((finished, reason)) => break (finished, reason, None),
            None => {}
        }
    };
    lose_power(line, controllers, &agenda, scan);
    let (finished, reason) = match conservation.end(plant.items()) {
        Ok(()) => (finished, reason),
        Err(violation) => (false, format!("bug: {violation}")),
    };
    let (faults, fault_at) = faults.until_end(fault);
    let outcome = Outcome {
        finished,
        reason,
        stands_since: stands_since
            .filter(|_| fault.is_none() && !answer.fault && operator.has_started(scan, &line.scenario)),
        fault,
        fault_at,
        scans: scan,
        accounts: accounts.until(scan),
        order_times,
        states,
        trace_hash: changes.hash(),
        collisions: check.into_contacts(),
        alarms: alarms.until_end(&trace),
        faults,
    };
    let recorded = recorders.map(|recorders| Recordings {
        paths: recorders.paths.finish(&plant),
        history: recorders.history.finish(&plant),
    });
    Ok((Report::new(line, &plant, outcome), recorded))
}

/// The scans before this one that the controllers have not executed: first those that were left out, then those without
/// power.
fn lose_power(line: &Line, controllers: &mut dyn Controllers, agenda: &Agenda, scan: u64) {
    let without_power = line.scenario.scans_without_power(scan);
    if without_power > 0 {
        controllers.skip((agenda.scans_since(scan) - 1).saturating_sub(without_power));
        controllers.lose_power(without_power);
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
