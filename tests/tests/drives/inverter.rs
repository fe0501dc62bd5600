//! `FB_InverterDrive` at a frequency converter with the states S1 to S5 of PROFIdrive.

use super::course::{self, Drive, Surroundings, chance};
use super::ledger::{Answer, Order};
use super::program::{machine, machine_with};
use super::told::Told;
use super::wire::Wire;
use autogen_st_judge::machine::Machine;
use runtime_sim::random::Random;
use std::collections::VecDeque;

/// Speed units a scan.
const RAMP: f64 = 400.0;
/// After OFF2, OFF3 or a fault.
const FAST_RAMP: f64 = 800.0;
const REFERENCE: f64 = 16384.0;
const WINDOW: f64 = 82.0;

/// Of STW1.
const ON: i32 = 1;
const NO_OFF2: i32 = 1 << 1;
const NO_OFF3: i32 = 1 << 2;
const ENABLE: i32 = 1 << 3;
const RAMP_AND_SETPOINT: i32 = 0b111 << 4;
const ACKNOWLEDGE: i32 = 1 << 7;
const CONTROL: i32 = 1 << 10;

#[derive(Clone, Copy, Debug, PartialEq)]
enum State {
    SwitchingOnInhibited,
    ReadyForSwitchingOn,
    SwitchedOn,
    Operation,
    SwitchingOff,
    Fault,
}

pub struct Inverter {
    machine: Machine,
    to: Wire<(i32, f64)>,
    from: Wire<(i32, f64)>,
    to_scans: usize,
    from_scans: usize,
    state: State,
    speed: f64,
    /// The control word that it has obeyed last.
    obeyed: (i32, f64),
    /// A lost telegram is a fault, else it switches off.
    faults_without_telegram: bool,
    /// While it switches off operation is still enabled.
    is_enabled_to_standstill: bool,
    /// Of the scans before, the latest last.
    speeds: VecDeque<f64>,
    /// Scans since a person has pressed reset.
    since_reset: u32,
    was_pressed: bool,
}

impl Inverter {
    /// Telegrams take so many scans.
    fn with(to_scans: usize, from_scans: usize) -> Self {
        Self {
            machine: machine("Belt_wiring"),
            to: Wire::new(to_scans, (0, 0.0)),
            from: Wire::new(from_scans, (0, 0.0)),
            to_scans,
            from_scans,
            state: State::SwitchingOnInhibited,
            speed: 0.0,
            obeyed: (0, 0.0),
            faults_without_telegram: true,
            is_enabled_to_standstill: false,
            speeds: VecDeque::new(),
            since_reset: u32::MAX,
            was_pressed: true,
        }
    }

    /// A telegram has arrived.
    fn obey(&mut self, telegram: (i32, f64)) {
        let (word, _) = telegram;
        if word & CONTROL == 0 {
            return;
        }
        let acknowledges = word & ACKNOWLEDGE != 0 && self.obeyed.0 & ACKNOWLEDGE == 0;
        self.obeyed = telegram;
        let has = |bit: i32| word & bit == bit;
        let may_run = has(NO_OFF2 | NO_OFF3);
        self.state = match self.state {
            State::Fault if acknowledges => {
                let within = self.to_scans as u32 + 1;
                assert!(self.since_reset <= within, "a fault is acknowledged, and nobody pressed reset");
                State::SwitchingOnInhibited
            }
            State::SwitchingOnInhibited if may_run && !has(ON) => State::ReadyForSwitchingOn,
            State::ReadyForSwitchingOn | State::SwitchedOn | State::Operation if !may_run => {
                State::SwitchingOnInhibited
            }
            State::ReadyForSwitchingOn if has(ON) => State::SwitchedOn,
            State::SwitchedOn if !has(ON) => State::ReadyForSwitchingOn,
            State::SwitchedOn if has(ENABLE) => State::Operation,
            State::Operation if !has(ON) => State::SwitchingOff,
            State::Operation if !has(ENABLE) => State::SwitchedOn,
            State::SwitchingOff if has(ON) => State::Operation,
            State::SwitchingOff if self.speed == 0.0 => State::ReadyForSwitchingOn,
            state => state,
        };
    }

    /// No telegram has arrived.
    fn miss(&mut self) {
        self.obeyed = (0, 0.0);
        self.state = match self.state {
            State::Fault => State::Fault,
            _ if self.faults_without_telegram => State::Fault,
            _ => State::SwitchingOnInhibited,
        };
    }

    fn turn(&mut self) {
        let (wanted, ramp) = match self.state {
            State::Operation if self.obeyed.0 & RAMP_AND_SETPOINT == RAMP_AND_SETPOINT => {
                (self.obeyed.1, RAMP)
            }
            State::Operation | State::SwitchingOff => (0.0, RAMP),
            _ => (0.0, FAST_RAMP),
        };
        self.speed = wanted.clamp(self.speed - ramp, self.speed + ramp);
        self.speeds.push_back(self.speed);
        if self.speeds.len() > self.from_scans + 1 {
            self.speeds.pop_front();
        }
    }

    fn status(&self) -> i32 {
        use State::*;
        let at = |bit: i32, holds: bool| if holds { 1 << bit } else { 0 };
        let state = self.state;
        at(0, matches!(state, ReadyForSwitchingOn | SwitchedOn | Operation | SwitchingOff))
            | at(1, matches!(state, SwitchedOn | Operation | SwitchingOff))
            | at(2, state == Operation || (state == SwitchingOff && self.is_enabled_to_standstill))
            | at(3, state == Fault)
            | at(4, self.obeyed.0 & NO_OFF2 != 0)
            | at(5, self.obeyed.0 & NO_OFF3 != 0)
            | at(6, state == SwitchingOnInhibited)
            | at(9, true)
    }
}

impl Drive for Inverter {
    fn drawn(random: &mut Random) -> Self {
        let (to_scans, from_scans) = (random.up_to(4) as usize, random.up_to(4) as usize);
        let mut drawn = Self::with(to_scans, from_scans);
        drawn.faults_without_telegram = chance(random, 2);
        drawn.is_enabled_to_standstill = chance(random, 2);
        drawn
    }

    fn plain() -> Self {
        Self::with(0, 0)
    }

    fn scan(&mut self, order: &Order, around: Surroundings) -> Answer {
        let presses = around.reset && !self.was_pressed && around.bus_ok;
        self.was_pressed = around.reset;
        self.since_reset = if presses { 0 } else { self.since_reset.saturating_add(1) };
        let status = (self.status(), self.speed.round());
        let (zsw1, nist) = if around.bus_ok { self.from.pass(status) } else { self.from.is_cut() };
        self.machine.set("conveyor_belt_cmd", order.cmd.into());
        self.machine.set("conveyor_belt_verb", order.verb.into());
        self.machine.set("conveyor_belt_hold", order.hold.into());
        self.machine.set("belt_speed", order.arguments[0]);
        self.machine.set("belt_link_ok", around.link_ok.into());
        self.machine.set("belt_enable", around.enable.into());
        self.machine.set("belt_bus_ok", around.bus_ok.into());
        self.machine.set("belt_reset", around.reset.into());
        self.machine.set("belt_zsw1", zsw1.into());
        self.machine.set("belt_nist", nist);
        self.machine.scan().expect("a scan");
        let telegram = (self.machine.get("belt_stw1") as i32, self.machine.get("belt_nsoll"));
        let (word, setpoint) = telegram;
        assert_eq!(word & !(ON | ACKNOWLEDGE), 0x047E);
        let is_held = order.hold || !around.link_ok;
        assert!(!is_held || word & ON == 0, "ON while held");
        assert!((-REFERENCE..=REFERENCE).contains(&setpoint));
        if around.bus_ok {
            let telegram = self.to.pass(telegram);
            self.obey(telegram);
        } else {
            self.to.is_cut();
            self.to.blank((0, 0.0));
            self.miss();
        }
        self.turn();
        let whole = |name: &str| self.machine.get(name) as i32;
        Answer {
            ready: whole("conveyor_belt_ready") != 0,
            got: whole("conveyor_belt_got"),
            ack: whole("conveyor_belt_ack"),
            error: whole("conveyor_belt_error"),
        }
    }

    /// Then no telegram arrives either.
    fn power_up(&mut self) {
        self.machine = machine("Belt_wiring");
        self.to.is_cut();
        self.to.blank((0, 0.0));
        self.miss();
    }

    fn fault(&mut self) {
        self.state = State::Fault;
    }

    fn speed(&self) -> f64 {
        self.speed.abs()
    }

    /// As far as the block can know.
    fn has_reached(&self, order: &Order) -> bool {
        let wanted = if order.verb == 1 { order.arguments[0] * REFERENCE } else { 0.0 };
        (self.speeds.front().copied().unwrap_or(0.0) - wanted).abs() <= WINDOW + 2.0
    }

    fn latency(&self) -> u32 {
        self.to_scans as u32 + 1
    }

    fn round_trip(&self) -> u32 {
        (self.to_scans + self.from_scans) as u32 + 2
    }

    fn command(random: &mut Random) -> (i32, [f64; 8]) {
        let verb = match random.up_to(20) {
            0 => 3,
            1..=8 => 2,
            _ => 1,
        };
        let speed = match random.up_to(60) {
            0 => 1.5,
            1 => f64::NAN,
            _ => f64::from(random.up_to(20)) / 10.0 - 1.0,
        };
        (verb, [speed, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    fn far(number: i32) -> (i32, [f64; 8]) {
        (1, [if number % 2 == 0 { -0.9 } else { 0.9 }, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    const BRAKING: u32 = 42;
    const PATIENCE: u32 = 150;
}

#[test]
fn commands_at_any_time_are_carried_out_by_the_rules() {
    let ends = course::campaign::<Inverter>();
    assert!([0, 1, 3, 4, 5, 6].iter().all(|error| ends[error] > 20), "{ends:?}");
}

#[test]
fn a_speed_that_is_not_a_number_is_refused() {
    for speed in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -1.001, 1.001] {
        let mut told = Told::<Inverter>::new();
        told.give(1, [speed, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(told.end(), 1, "{speed}");
        told.rests(20);
        told.goes_on();
    }
}

#[test]
fn a_motor_that_ran_stands_after_the_link_was_lost() {
    let mut told = Told::<Inverter>::new();
    told.goes_on();
    assert!(told.drive.speed() > 0.0);
    told.around.link_ok = false;
    told.scans(Inverter::BRAKING + 3);
    told.around.link_ok = true;
    told.rests(100);
    assert_eq!(told.answer.error, 0, "the command has ended well before");
    told.goes_on();
}

#[test]
fn without_calls_an_end_wants_the_speed_once() {
    for calls in ["0", "-5", "1"] {
        let mut told = Told::<Inverter>::new();
        told.drive.machine = machine_with("Belt_wiring", "calls := 10", &format!("calls := {calls}"));
        told.order.cmd = 0;
        (0..20).for_each(|_| {
            told.drive.scan(&told.order, told.around);
        });
        let (verb, arguments) = Inverter::far(1);
        let order = Order { cmd: 1, verb, arguments, hold: false };
        let scans =
            (0..Inverter::PATIENCE).take_while(|_| told.drive.scan(&order, told.around).ack != 1).count();
        assert!(scans > 30 && told.drive.has_reached(&order), "{calls}: {scans} scans");
    }
}
