//! `FB_RobotDrive` at a robot that waits for program numbers, with telegrams that come late and torn.

use super::course::{self, Drive, Surroundings, chance};
use super::ledger::{Answer, Order};
use super::program::machine;
use super::told::Told;
use super::wire::Wire;
use autogen_st_judge::machine::Machine;
use runtime_sim::random::Random;
use std::collections::HashMap;

/// From the block: arguments, program number, number, valid, move_enable, cancel.
type ToRobot = [f64; 13];

const PROGRAM_NUMBER: usize = 8;
const NUMBER: usize = 9;
const VALID: usize = 10;
const MOVE_ENABLE: usize = 11;
const CANCEL: usize = 12;

#[derive(Clone, Copy, Debug, Default)]
struct FromRobot {
    ready: bool,
    request: bool,
    run: bool,
    echo: i32,
    outcome: i32,
}

/// Where its program stands that calls the others.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Phase {
    Waiting,
    /// It has read the number, the program number and the arguments, and compares after so many scans.
    Reading(u32),
    /// For so many scans with permission to move.
    Working(u32),
    /// Until `valid` falls; then it has this outcome.
    Leaving(i32),
}

pub struct Robot {
    machine: Machine,
    to: Wire<ToRobot>,
    from: Wire<FromRobot>,
    to_scans: usize,
    from_scans: usize,
    /// The telegram before, of which a torn one has parts.
    before: ToRobot,
    is_torn: bool,
    /// Scans in which it reads.
    reading_scans: u32,
    phase: Phase,
    /// What it has read.
    read: ToRobot,
    /// For so many scans nothing has disturbed it: no fault, no power-up, no lost fieldbus.
    calm: u32,
    /// Nothing has disturbed it since it began to read, or shortly before.
    is_undisturbed: bool,
    shows: FromRobot,
    /// For so many scans there is a fault, longer if nobody acknowledges it.
    fault_scans: Option<u32>,
    was_pressed: bool,
    /// The program that it took: number, program number, arguments.
    taken: (i32, i32, [f64; 8]),
    has_finished: bool,
    moves: bool,
    /// Some programs end in an outcome other than 0.
    fails: bool,
    /// The last number that was commanded, and what was commanded under each.
    number: i32,
    given: HashMap<i32, (i32, [f64; 8])>,
    random: Random,
}

impl Robot {
    /// Telegrams take so many scans.
    fn with(to_scans: usize, from_scans: usize) -> Self {
        Self {
            machine: machine("Kitting_wiring"),
            to: Wire::new(to_scans, [0.0; 13]),
            from: Wire::new(from_scans, FromRobot::default()),
            to_scans,
            from_scans,
            before: [0.0; 13],
            is_torn: false,
            reading_scans: 0,
            phase: Phase::Waiting,
            read: [0.0; 13],
            calm: 0,
            is_undisturbed: false,
            shows: FromRobot { ready: true, ..FromRobot::default() },
            fault_scans: None,
            taken: (0, 0, [0.0; 8]),
            has_finished: false,
            moves: false,
            fails: true,
            number: 0,
            given: HashMap::new(),
            was_pressed: true,
            random: Random::new(1),
        }
    }

    fn send(&mut self, bus_ok: bool) -> ToRobot {
        let mut telegram = [0.0; 13];
        for (i, word) in telegram.iter_mut().take(8).enumerate() {
            *word = self.machine.get(&format!("to_robot_p[{i}]"));
        }
        telegram[PROGRAM_NUMBER] = self.machine.get("to_robot_program_number");
        telegram[NUMBER] = self.machine.get("to_robot_number");
        telegram[VALID] = self.machine.get("to_robot_valid");
        telegram[MOVE_ENABLE] = self.machine.get("to_robot_move_enable");
        telegram[CANCEL] = self.machine.get("to_robot_cancel");
        if !bus_ok {
            self.blank();
            return self.to.is_cut();
        }
        let now = self.to.pass(telegram);
        let before = std::mem::replace(&mut self.before, now);
        let mut seen = now;
        if self.is_torn {
            for (word, old) in seen.iter_mut().zip(before) {
                if chance(&mut self.random, 2) {
                    *word = old;
                }
            }
        }
        seen
    }

    /// On a lost fieldbus its inputs are FALSE.
    fn blank(&mut self) {
        self.to.is_cut();
        self.to.blank([0.0; 13]);
        self.before = [0.0; 13];
    }

    /// Permission to move is given to the program of the command alone.
    fn look(&self, order: &Order, around: Surroundings, seen: FromRobot) {
        let is_its_own =
            seen.run && seen.echo == order.cmd && self.machine.get("to_robot_number") as i32 == order.cmd;
        let may_move = is_its_own && !order.hold && around.link_ok && around.bus_ok && seen.ready;
        assert!(may_move || !self.is_shown("move_enable"), "{order:?} {around:?} {seen:?}");
    }

    /// To the robot.
    fn is_shown(&self, name: &str) -> bool {
        self.machine.get(&format!("to_robot_{name}")) != 0.0
    }

    fn work(&mut self, seen: ToRobot) {
        let is = |word: usize| seen[word] != 0.0;
        self.moves = false;
        let is_waiting = self.phase == Phase::Waiting;
        assert!(
            is_waiting || !self.is_undisturbed || seen[..VALID] == self.read[..VALID],
            "the data changes before it waits: {:?}, {:?}",
            self.read,
            seen
        );
        match self.phase {
            _ if !self.shows.ready => {}
            Phase::Waiting if is(VALID) && !is(CANCEL) => {
                self.read = seen;
                self.is_undisturbed = self.calm > 20;
                self.phase = Phase::Reading(self.reading_scans);
                if self.reading_scans == 0 {
                    self.take();
                }
            }
            Phase::Waiting => self.shows.request = true,
            Phase::Reading(_) if seen[NUMBER] != self.read[NUMBER] || !is(VALID) => {
                self.phase = Phase::Waiting
            }
            Phase::Reading(0) => self.take(),
            Phase::Reading(rest) => self.phase = Phase::Reading(rest - 1),
            Phase::Working(_) if is(CANCEL) => self.phase = Phase::Leaving(255),
            Phase::Working(0) => {
                let fails = self.fails && chance(&mut self.random, 10);
                let outcome = if fails { 1 + self.random.up_to(9) as i32 } else { 0 };
                self.has_finished = outcome == 0;
                self.phase = Phase::Leaving(outcome);
            }
            Phase::Working(rest) if is(MOVE_ENABLE) => {
                self.moves = true;
                self.phase = Phase::Working(rest - 1);
            }
            Phase::Leaving(outcome) if !is(VALID) => {
                self.shows.outcome = outcome;
                self.shows.run = false;
                self.phase = Phase::Waiting;
            }
            Phase::Working(_) | Phase::Leaving(_) => {}
        }
    }

    fn take(&mut self) {
        let number = self.read[NUMBER] as i32;
        let arguments = std::array::from_fn(|i| self.read[i]);
        self.taken = (number, self.read[PROGRAM_NUMBER] as i32, arguments);
        assert_eq!(
            self.given.get(&number),
            Some(&(self.taken.1, arguments)),
            "{number} comes with its own arguments"
        );
        self.has_finished = false;
        self.shows = FromRobot { ready: true, request: false, run: true, echo: number, outcome: 255 };
        let shortest = if self.fails { 0 } else { 40 };
        self.phase = Phase::Working(shortest + self.random.up_to(20));
    }
}

impl Drive for Robot {
    fn drawn(random: &mut Random) -> Self {
        let (to_scans, from_scans) = (random.up_to(4) as usize, random.up_to(4) as usize);
        let is_torn = chance(random, 2);
        let reading_scans = random.up_to(3);
        Self {
            is_torn,
            reading_scans,
            random: Random::new(random.next_u64()),
            ..Self::with(to_scans, from_scans)
        }
    }

    fn plain() -> Self {
        Self { fails: false, ..Self::with(0, 0) }
    }

    fn scan(&mut self, order: &Order, around: Surroundings) -> Answer {
        if order.cmd != std::mem::replace(&mut self.number, order.cmd) {
            self.given.insert(order.cmd, (order.verb, order.arguments));
        }
        let ports = ["goal_x", "goal_y", "goal_z", "via_x", "via_y", "via_z", "top_speed", "gain"];
        for (port, value) in ports.iter().zip(order.arguments) {
            self.machine.set(&format!("kitting_{port}"), value);
        }
        self.machine.set("kitting_cmd", order.cmd.into());
        self.machine.set("kitting_verb", order.verb.into());
        self.machine.set("kitting_hold", order.hold.into());
        // A person at the pendant acknowledges.
        let was_pressed = std::mem::replace(&mut self.was_pressed, around.reset);
        self.fault_scans = match self.fault_scans {
            Some(0) if around.reset && !was_pressed => None,
            scans => scans.map(|rest| rest.saturating_sub(1)),
        };
        self.shows.ready = self.fault_scans.is_none() && around.enable;
        let shows = self.shows;
        let seen = if around.bus_ok { self.from.pass(shows) } else { self.from.is_cut() };
        self.machine.set("kitting_link_ok", around.link_ok.into());
        self.machine.set("from_robot_bus_ok", around.bus_ok.into());
        self.machine.set("from_robot_ready", seen.ready.into());
        self.machine.set("from_robot_request", seen.request.into());
        self.machine.set("from_robot_run", seen.run.into());
        self.machine.set("from_robot_echo", seen.echo.into());
        self.machine.set("from_robot_outcome", seen.outcome.into());
        self.machine.scan().expect("a scan");
        self.look(order, around, seen);
        self.calm = if self.shows.ready && around.bus_ok { self.calm + 1 } else { 0 };
        self.is_undisturbed &= self.calm > 0;
        let seen = self.send(around.bus_ok);
        self.work(seen);
        let whole = |name: &str| self.machine.get(name) as i32;
        Answer {
            ready: whole("kitting_ready") != 0,
            got: whole("kitting_got"),
            ack: whole("kitting_ack"),
            error: whole("kitting_error"),
        }
    }

    /// Then the fieldbus is lost too.
    fn power_up(&mut self) {
        self.machine = machine("Kitting_wiring");
        self.blank();
        self.calm = 0;
        self.is_undisturbed = false;
    }

    /// It stands; its program goes on after a person has been there, or was left.
    fn fault(&mut self) {
        self.fault_scans = Some(10);
        if chance(&mut self.random, 2) {
            self.phase = Phase::Waiting;
            self.shows = FromRobot { outcome: 255, echo: self.shows.echo, ..FromRobot::default() };
        }
    }

    fn speed(&self) -> f64 {
        f64::from(self.moves)
    }

    fn has_reached(&self, order: &Order) -> bool {
        self.has_finished && self.taken == (order.cmd, order.verb, order.arguments)
    }

    fn latency(&self) -> u32 {
        self.to_scans as u32 + 1
    }

    fn round_trip(&self) -> u32 {
        (self.to_scans + self.from_scans) as u32 + 2
    }

    fn command(random: &mut Random) -> (i32, [f64; 8]) {
        let verb = if chance(random, 30) { 0 } else { 1 + random.up_to(8) as i32 };
        let mut arguments = std::array::from_fn(|_| f64::from(random.up_to(1000)));
        if chance(random, 60) {
            arguments[random.up_to(7) as usize] = f64::NAN;
        }
        (verb, arguments)
    }

    fn far(number: i32) -> (i32, [f64; 8]) {
        (1 + number % 9, std::array::from_fn(|i| f64::from(number * 8) + i as f64))
    }

    const BRAKING: u32 = 1;
    const PATIENCE: u32 = 200;
}

#[test]
fn commands_at_any_time_are_carried_out_by_the_rules() {
    let ends = course::campaign::<Robot>();
    assert!([0, 1, 3, 4, 5, 6, 10].iter().all(|error| ends[error] > 20), "{ends:?}");
}

#[test]
fn an_argument_that_is_not_a_number_is_refused() {
    for place in 0..8 {
        let mut told = Told::<Robot>::new();
        let (verb, mut arguments) = Robot::far(1);
        arguments[place] = f64::NAN;
        told.give(verb, arguments);
        assert_eq!(told.end(), 1, "argument {place}");
        told.rests(20);
        told.goes_on();
    }
}

#[test]
fn it_may_not_move_before_it_shows_the_number() {
    let mut told = Told::<Robot>::new();
    told.drive.reading_scans = 50;
    told.give_far();
    told.scans(20);
    assert!(matches!(told.drive.phase, Phase::Reading(_)));
    assert!(told.drive.is_shown("valid") && !told.drive.is_shown("move_enable"));
    assert_eq!(told.end(), 0);
}

#[test]
fn what_was_offered_stands_until_it_is_taken() {
    let mut told = Told::<Robot>::new();
    told.drive.reading_scans = 50;
    told.give_far();
    told.scans(20);
    // The data stays while it is read, and the program that is replaced does not move.
    told.give_far();
    told.rests(40);
    assert_eq!((told.drive.taken.0, told.answer.ack), (1, 0));
    told.drive.reading_scans = 0;
    assert_eq!((told.end(), told.answer.ack), (0, 2));
}

#[test]
fn another_program_that_runs_is_cancelled_and_then_the_command_is_carried_out() {
    let mut told = Told::<Robot>::new();
    told.drive.reading_scans = 50;
    told.give_far();
    told.scans(20);
    told.drive.reading_scans = 0;
    told.drive.phase = Phase::Working(100);
    told.drive.shows = FromRobot { ready: true, request: false, run: true, echo: 999, outcome: 255 };
    assert_eq!((told.end(), told.drive.taken.0), (0, 1));
}

#[test]
fn a_command_under_hold_is_not_offered() {
    let mut told = Told::<Robot>::new();
    told.order.hold = true;
    told.give_far();
    for _ in 0..50 {
        told.scans(1);
        assert!(!told.drive.is_shown("valid"));
    }
    told.order.hold = false;
    assert_eq!(told.end(), 0);
}

#[test]
fn without_the_link_its_program_is_held_and_then_cancelled() {
    let mut told = Told::<Robot>::new();
    told.give_far();
    told.scans(20);
    told.around.link_ok = false;
    for _ in 0..50 {
        told.scans(1);
        assert!(!told.drive.is_shown("cancel") && !told.drive.is_shown("move_enable"));
    }
    told.around.link_ok = true;
    told.scans(1);
    assert!(told.drive.is_shown("cancel") && !told.drive.is_shown("move_enable"));
}
