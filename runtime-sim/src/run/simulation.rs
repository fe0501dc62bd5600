//! The plant of a run and all that is known of it, from scan to scan. Its controllers may be several that have done the
//! same so far.

use super::accounts::Accounts;
use super::agenda::{After, Agenda, Waits};
use super::alarms::Alarms;
use super::changes::Changes;
use super::faults::Faults;
use super::order_times::{self, OrderTimes};
use super::power::Unpowered;
use super::progress::Progress;
use super::recorders::Recorders;
use super::settled::Settled;
use super::variant::{Alike, Variant};
use super::{Seen, Stepping};
use crate::account::Activity;
use crate::collision::{CollisionCheck, Contact};
use crate::conservation::Conservation;
use crate::history::Stay;
use crate::line::Line;
use crate::memory::Memory;
use crate::plant::{Arrived, Bus, Plant};
use crate::report::{Outcome, Report};
use crate::scan::{Controllers, SystemInputs, SystemOutputs};
use crate::shortage::point_text;
use crate::system::Operator;
use crate::wiring::{Drives, Source};

/// Why a run ends that has reached its goal at its time limit, but for a fault.
const TIME_IN_FAULT: &str = "time limit: the line is in a fault";

#[derive(Clone)]
pub struct Simulation<'a> {
    line: &'a Line,
    stepping: Stepping,
    plant: Plant,
    check: CollisionCheck,
    bus: Bus,
    operator: Operator,
    /// What the bus has delivered.
    inputs: Vec<Vec<f64>>,
    agenda: Agenda,
    changes: Changes,
    settled: Settled<'a>,
    /// The last answer of the controllers, and the states of their automata.
    answer: SystemOutputs,
    states: Vec<usize>,
    /// Words of the times in states, by machine.
    stays: Vec<usize>,
    /// Where in the images of each machine its command stands.
    numbers: Vec<Option<(usize, usize)>>,
    unpowered: Unpowered,
    accounts: Accounts<'a>,
    alarms: Alarms<'a>,
    faults: Faults<'a>,
    progress: Progress,
    conservation: Conservation,
    order_times: Vec<OrderTimes>,
    /// The scan after which an edge of `start` would make the line run that does not.
    stands_since: Option<u64>,
    /// Events that were handled.
    read: usize,
    scan: u64,
    /// In [`Stepping::Checked`]: before this scan nothing happens.
    quiet_until: u64,
}

/// A scan that has begun.
#[derive(Clone, Copy)]
pub struct Begun {
    arrived: Arrived,
    system: SystemInputs,
    is_powered: bool,
    /// Something may happen in it.
    is_due: bool,
    /// The controllers have executed it.
    is_executed: bool,
    /// Scans since they executed one.
    scans: u64,
    /// Something has happened in it.
    acted: bool,
}

/// How a run ends.
pub struct End {
    finished: bool,
    reason: String,
    /// Code and machine of the fault that ends it.
    fault: Option<(i32, Option<usize>)>,
}

impl<'a> Simulation<'a> {
    /// Before scan 0.
    pub fn new(
        line: &'a Line,
        controllers: &dyn Controllers,
        stepping: Stepping,
        memory: &mut Memory,
    ) -> Result<Self, String> {
        let plant = Plant::remembering(line, memory)?;
        let kinds = line.kinds.len();
        let analogue: Vec<_> = line.machines.iter().map(|machine| machine.analogue_inputs(kinds)).collect();
        let stays = controllers.stays();
        Ok(Self {
            line,
            stepping,
            check: CollisionCheck::new(line),
            bus: Bus::new(line.io_delay.clone(), plant.images(), analogue.clone()),
            operator: Operator::new(),
            inputs: plant.images().to_vec(),
            agenda: Agenda::new(stays.clone(), plant.images(), analogue),
            changes: Changes::new(&stays, line),
            settled: Settled::new(line, &stays),
            answer: SystemOutputs::default(),
            states: (0..line.machines.len()).map(|machine| controllers.state(machine)).collect(),
            stays,
            numbers: (0..line.machines.len()).map(|machine| numbers(line, machine)).collect(),
            unpowered: Unpowered::new(line),
            accounts: Accounts::new(line),
            alarms: Alarms::new(line),
            faults: Faults::new(line),
            progress: Progress::new(line),
            conservation: Conservation::new(plant.items()),
            order_times: vec![OrderTimes::default(); line.scenario.orders.len()],
            stands_since: Some(0),
            read: 0,
            scan: 0,
            quiet_until: 0,
            plant,
        })
    }

    /// The inputs of the scan are latched, and the controllers execute it if something may happen in it.
    pub fn begin(&mut self, variants: &mut Alike) -> Result<Begun, String> {
        let (scan, scenario) = (self.scan, &self.line.scenario);
        let plant = &self.plant;
        let arrived =
            self.bus.exchange(scan, plant.images(), |machine| plant.moves(machine), &mut self.inputs);
        let system = self.operator.inputs(scan, scenario);
        let is_powered = scenario.is_powered(scan);
        if scenario.powers_up(scan) {
            for variant in variants.iter_mut() {
                self.lose_power(variant);
                variant.controllers.power_up();
            }
            self.alarms.power_up(&variants.first.trace, scan);
            self.agenda.power_up();
        }
        self.agenda.arrive(arrived);
        let is_due_for = |waits: &Waits| {
            self.agenda.is_due(waits, scan, system, &self.inputs, &self.states, &self.changes)
        };
        let is_due = is_powered && variants.all_waits().any(is_due_for);
        let is_executed = is_due || is_powered && self.stepping != Stepping::Events;
        let scans = self.agenda.scans_since(scan);
        if is_executed {
            variants.waits.step();
            for variant in variants.iter_mut() {
                variant.execute(scan, scans, system, &self.inputs)?;
            }
        }
        Ok(Begun { arrived, system, is_powered, is_due, is_executed, scans, acted: false })
    }

    /// Takes what the controllers gave in the scan.
    pub fn take(&mut self, begun: &mut Begun, variant: &Variant) -> Result<(), String> {
        if !begun.is_executed {
            return Ok(());
        }
        let (scan, system) = (self.scan, begun.system);
        let answer = variant.answer;
        let before = std::mem::replace(&mut self.answer, answer);
        let is_ready = !answer.running && !answer.fault && system.run_permit;
        self.stands_since = if is_ready { self.stands_since.or(Some(scan)) } else { None };
        let running = if answer.running { begun.scans } else { 0 };
        begun.acted = self.changes.take(scan, running, &variant.trace, &variant.outputs) || answer != before;
        for (machine, state) in self.states.iter_mut().enumerate() {
            *state = variant.controllers.state(machine);
        }
        if begun.acted && self.stepping == Stepping::Checked && (!begun.is_due || scan < self.quiet_until) {
            return Err(format!("something happens in scan {scan}, which would be left out"));
        }
        let after = match begun.acted {
            false => After::Nothing,
            true if answer == before && self.settled.holds(&self.states, &self.changes) => After::Devices,
            true => After::Anything,
        };
        self.agenda.step(scan, system, &self.inputs, answer, after);
        self.faults.note(scan, answer, &self.states);
        Ok(())
    }

    /// Whether a timer of controllers that wait for this is running, which ends after this scan.
    pub fn is_timed(&self, waits: &Waits) -> bool {
        self.agenda.is_timed(waits, self.scan, &self.states, &self.changes)
    }

    /// The outputs are published, and the plant goes on to the next scan in which something may happen. How the run ends,
    /// if it does before that scan. All of these gave the same, and timers run of all or of none.
    pub fn proceed(
        &mut self,
        begun: Begun,
        variants: &Alike,
        memory: &mut Memory,
        observer: &mut dyn FnMut(&Seen),
        mut recorders: Option<&mut Recorders>,
    ) -> Result<Option<End>, String> {
        let variant = &variants.first;
        let (line, scan) = (self.line, self.scan);
        let Begun { arrived, system, is_powered, is_due, is_executed, acted, .. } = begun;
        let fault = self.faults.last(scan);
        let seen = Seen {
            scan,
            system,
            answer: self.answer,
            inputs: &self.inputs,
            outputs: &variant.outputs,
            trace: &variant.trace,
            hash: self.changes.hash(),
            plant: &self.plant,
        };
        if is_due || self.stepping != Stepping::Events {
            observer(&seen);
        }
        if let Some(recorders) = &mut recorders {
            recorders.history.line_words(&seen);
            if acted || arrived == Arrived::Events {
                recorders.history.words(&seen);
            }
        }
        if self.stepping == Stepping::Checked && arrived == Arrived::Events && scan < self.quiet_until {
            return Err(format!("an input changes in scan {scan}, which would be left out"));
        }
        self.progress.note(scan, acted || arrived == Arrived::Events);

        self.check.follow_items(&self.plant);
        let outputs = &variant.outputs;
        self.plant.obey(if is_powered { outputs } else { self.unpowered.outputs(outputs) });
        if let Some(recorders) = &mut recorders {
            recorders.paths.look(&self.plant);
            recorders.history.look(&self.plant);
        }
        let is_alive = self.plant.is_busy()
            || self.operator.is_busy(scan, &line.scenario)
            || self.is_timed(&variants.waits)
            || self.faults.is_present();
        if is_alive {
            self.progress.is_alive(scan);
        }
        let mut next = scan + 1;
        let looks_ahead = match self.stepping {
            _ if fault.is_some() => false,
            Stepping::Events => true,
            Stepping::EveryScan => false,
            Stepping::Checked => scan >= self.quiet_until,
        };
        if looks_ahead {
            let next_step =
                |waits: &Waits| self.agenda.next_step(waits, scan, &self.states, &self.changes, &self.plant);
            let events = [
                variants.all_waits().filter_map(next_step).min(),
                self.plant.next_change(),
                self.operator.next_change(scan, &line.scenario),
                line.scenario.next_without_power(scan),
                Some(self.progress.limit()),
                (!is_alive).then(|| self.progress.stalls_at()),
            ];
            let quiet = events.into_iter().flatten().min().unwrap_or(scan + 1);
            self.quiet_until = self.bus.next_exchange(scan, quiet.max(scan + 1), self.progress.last_event());
            if self.stepping == Stepping::Events && !self.check.touches() {
                next = self.quiet_until;
            }
        }
        let (next, collision) = self.check.look_until(&self.plant, memory, scan, next);
        let collision = collision.map(collision_text);
        let logged = self.plant.items().log().count();
        self.plant.proceed_to(next);
        if self.stepping == Stepping::Checked
            && next < self.quiet_until
            && self.plant.items().log().count() > logged
        {
            return Err(format!("an item or an order changes before scan {next}, which would be left out"));
        }
        if is_alive {
            self.progress.is_alive(next - 1);
        }
        if is_executed || arrived != Arrived::Nothing || scan == 0 {
            self.account(&begun, variant, recorders);
        }
        self.scan = next;
        self.count_events();
        Ok(self.end(fault, collision))
    }

    /// What each machine does from this scan on.
    fn account(&mut self, begun: &Begun, variant: &Variant, mut recorders: Option<&mut Recorders>) {
        let (line, scan) = (self.line, self.scan);
        for (machine, outputs) in variant.outputs.iter().enumerate() {
            let is_stopped = line.machines[machine].monitor.is_stopped(&variant.trace);
            let activity = if !self.answer.running || is_stopped {
                Activity::Stopped
            } else if self.numbers[machine]
                .is_some_and(|(cmd, ack)| outputs[cmd] != self.inputs[machine][ack])
            {
                Activity::Moving
            } else {
                Activity::InState(self.states[machine])
            };
            self.accounts.note(machine, activity, scan);
            if let Some(recorders) = &mut recorders {
                let stay =
                    Stay { scan, state: self.states[machine], counted: activity.counted(line, machine) };
                recorders.history.stay(machine, stay);
                if let Some(word) = self.stays.get(machine).filter(|_| begun.is_executed) {
                    recorders.history.time(machine, stay, self.changes.stay(*word) as u64);
                }
            }
        }
    }

    fn count_events(&mut self) {
        let events = self.plant.items().log().since(self.read);
        self.conservation.take(events);
        order_times::note(&mut self.order_times, events);
        self.progress.count(self.line, &self.plant, self.scan, events);
        // Those of this round are read in the next one too.
        self.plant.forget_events(self.read);
        self.read = self.plant.items().log().count();
    }

    fn end(&mut self, fault: Option<(i32, Option<usize>)>, collision: Option<String>) -> Option<End> {
        if let Some((code, machine)) = fault {
            return Some(End { finished: false, reason: fault_text(self.line, code, machine), fault });
        }
        if let Some(reason) = collision {
            return Some(End { finished: false, reason, fault });
        }
        let (finished, reason) = self.progress.end(self.line, &self.plant, self.scan)?;
        // The goal does not count while the line is in a fault.
        let (finished, reason) = match self.faults.is_present() && finished {
            true if self.scan < self.progress.limit() => return None,
            true => (false, TIME_IN_FAULT.into()),
            false => (finished, reason),
        };
        Some(End { finished, reason, fault })
    }

    /// The scans before this one that the controllers have not executed: first those that were left out, then those
    /// without power.
    fn lose_power(&self, variant: &mut Variant) {
        let without_power = self.line.scenario.scans_without_power(self.scan);
        if without_power > 0 {
            let left_out = (self.agenda.scans_since(self.scan) - 1).saturating_sub(without_power);
            variant.controllers.skip(left_out);
            variant.controllers.lose_power(without_power);
        }
    }

    /// What came of the run, and the plant at its end.
    pub fn report(self, end: End, variants: &mut Alike) -> (Report, Plant) {
        variants.iter_mut().for_each(|variant| self.lose_power(variant));
        let End { finished, reason, fault } = end;
        let (finished, reason) = match self.conservation.end(self.plant.items()) {
            Ok(()) => (finished, reason),
            Err(violation) => (false, format!("bug: {violation}")),
        };
        let (faults, fault_at) = self.faults.until_end(fault);
        let has_started = self.operator.has_started(self.scan, &self.line.scenario);
        let outcome = Outcome {
            finished,
            reason,
            stands_since: self.stands_since.filter(|_| fault.is_none() && !self.answer.fault && has_started),
            fault,
            fault_at,
            scans: self.scan,
            accounts: self.accounts.until(self.scan),
            order_times: self.order_times,
            states: self.states,
            trace_hash: self.changes.hash(),
            collisions: self.check.into_contacts(),
            alarms: self.alarms.until_end(&variants.first.trace),
            faults,
        };
        (Report::new(self.line, &self.plant, outcome), self.plant)
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
