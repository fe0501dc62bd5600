//! A controller that gives commands at any time, on a day on which everything happens: with any drive.

use super::ledger::{Answer, Ledger, Order, next_number};
use runtime_sim::random::Random;
use std::collections::BTreeMap;

/// What is around the block beside the controller.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Surroundings {
    /// Between the controller and the block.
    pub link_ok: bool,
    /// Between the block and the drive.
    pub bus_ok: bool,
    pub enable: bool,
    /// A person presses it.
    pub reset: bool,
}

impl Surroundings {
    pub const QUIET: Self = Self { link_ok: true, bus_ok: true, enable: true, reset: false };
}

/// A block, wired, with a model of the other side.
pub trait Drive: Sized {
    /// With its own delays and habits.
    fn drawn(random: &mut Random) -> Self;
    /// Without any.
    fn plain() -> Self;
    fn scan(&mut self, order: &Order, around: Surroundings) -> Answer;
    /// The controller of the block loses its memory; the other side goes on.
    fn power_up(&mut self);
    fn fault(&mut self);
    /// How fast it moves, without its sign.
    fn speed(&self) -> f64;
    /// The other side has done what the order asks for.
    fn has_reached(&self, order: &Order) -> bool;
    /// Scans after which the other side knows what the block wants.
    fn latency(&self) -> u32;
    /// Scans after which it does, if the block has to hear of it first.
    fn round_trip(&self) -> u32;
    /// A verb and arguments, mostly right ones.
    fn command(random: &mut Random) -> (i32, [f64; 8]);
    /// Right ones, which take more than 30 scans. Each differs from the one before.
    fn far(number: i32) -> (i32, [f64; 8]);
    /// Scans in which it is at rest, once the other side knows.
    const BRAKING: u32;
    /// Scans in which a command ends, if nothing is in its way.
    const PATIENCE: u32;
}

pub fn chance(random: &mut Random, of: u32) -> bool {
    random.up_to(of - 1) == 0
}

/// How many commands have ended in each error.
pub type Ends = BTreeMap<i32, u32>;

/// Checks all rules in each scan.
pub fn run<D: Drive>(seed: u64, scans: u32) -> Ends {
    let mut course = Course::<D>::new(seed);
    for scan in 0..scans {
        let before = (course.order.clone(), course.around, course.answer);
        let done = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| course.step()));
        assert!(
            done.is_ok(),
            "seed {seed}, scan {scan}: {before:?}, then {:?} {:?} {:?}",
            course.order,
            course.around,
            course.answer
        );
    }
    course.ends
}

struct Course<D> {
    random: Random,
    drive: D,
    order: Order,
    /// What the block has seen of it last.
    seen: Order,
    around: Surroundings,
    answer: Answer,
    ledger: Ledger,
    begins: bool,
    /// A number was given since the last event after which nothing may start by itself.
    is_permitted: bool,
    /// For how many scans it has been held.
    held: u32,
    /// For how many scans there has been no such number.
    forbidden: u32,
    /// For how many scans a command has been open with nothing in its way.
    waited: u32,
    speed: f64,
    ends: Ends,
}

impl<D: Drive> Course<D> {
    fn new(seed: u64) -> Self {
        let mut random = Random::new(seed);
        let drive = D::drawn(&mut random);
        // Numbers that are soon at their end, or a number from before.
        let cmd = [0, 0, 32760, 7][random.up_to(3) as usize];
        Self {
            drive,
            order: Order { cmd, hold: chance(&mut random, 2), ..Order::default() },
            seen: Order::default(),
            around: Surroundings::QUIET,
            answer: Answer::default(),
            ledger: Ledger::default(),
            begins: true,
            is_permitted: false,
            held: 0,
            forbidden: 0,
            waited: 0,
            speed: 0.0,
            ends: Ends::new(),
            random,
        }
    }

    fn step(&mut self) {
        self.happen();
        let fresh = !self.begins && self.command();
        // Arguments mean nothing without a new number.
        let mut order = self.order.clone();
        if !fresh && chance(&mut self.random, 3) {
            (order.verb, order.arguments) = D::command(&mut self.random);
        }
        self.answer = self.drive.scan(&order, self.around);
        self.follow(fresh);
        self.look();
    }

    /// What people, drives and cables do.
    fn happen(&mut self) {
        let random = &mut self.random;
        let around = &mut self.around;
        around.link_ok = if around.link_ok { !chance(random, 1500) } else { chance(random, 40) };
        around.bus_ok = if around.bus_ok { !chance(random, 1500) } else { chance(random, 40) };
        around.enable = if around.enable { !chance(random, 2000) } else { chance(random, 40) };
        around.reset = if around.reset { !chance(random, 15) } else { chance(random, 100) };
        self.order.hold = if self.order.hold { !chance(random, 40) } else { chance(random, 150) };
        if chance(random, 1500) {
            self.drive.fault();
            self.is_permitted = false;
        }
        if chance(random, 3000) {
            self.drive.power_up();
            self.begins = true;
        }
        if chance(random, 3000) {
            self.order.cmd = 0;
        }
        let has_all = around.link_ok && around.bus_ok && around.enable;
        self.is_permitted &= has_all && self.order.cmd != 0 && !self.begins;
    }

    /// Whether a new command is given.
    fn command(&mut self) -> bool {
        let often = match self.ledger.is_open() {
            true if self.waited == 1 => 10,
            true => 300,
            false => 20,
        };
        if !chance(&mut self.random, often) {
            return false;
        }
        self.order.cmd = next_number(&self.order, self.answer);
        (self.order.verb, self.order.arguments) = D::command(&mut self.random);
        true
    }

    fn follow(&mut self, fresh: bool) {
        if self.around.link_ok {
            self.seen = self.order.clone();
        }
        let (order, answer) = (&self.order, self.answer);
        if std::mem::take(&mut self.begins) {
            // Without the link it has seen no number.
            let cmd = if self.around.link_ok { order.cmd } else { 0 };
            self.ledger.power_up(cmd, answer);
            if !self.around.link_ok {
                self.ledger.scan_without_link(answer);
            }
            return;
        }
        let ended = match self.around.link_ok {
            true => self.ledger.scan(order.cmd, answer),
            false => self.ledger.scan_without_link(answer),
        };
        if let Some(error) = ended {
            *self.ends.entry(error).or_default() += 1;
            assert!(error != 0 || self.drive.has_reached(&self.seen), "ended well, and has not reached it");
        }
        if fresh {
            self.waited = 0;
            self.is_permitted = self.around.link_ok;
        }
        self.is_permitted &= ended.is_none_or(|error| error == 0);
    }

    fn look(&mut self) {
        let count = |so_far: u32, is_so: bool| if is_so { so_far + 1 } else { 0 };
        self.held = count(self.held, self.order.hold || !self.around.link_ok);
        self.forbidden = count(self.forbidden, !self.is_permitted);
        let speed = self.drive.speed();
        let late = [(self.held, self.drive.latency()), (self.forbidden, self.drive.round_trip())];
        let is_free = late.iter().all(|(scans, latency)| scans <= latency);
        assert!(is_free || speed <= self.speed + 1e-9, "speeds up while held, or without a new number");
        let rests = late.iter().any(|(scans, latency)| *scans > latency + D::BRAKING);
        assert!(!rests || speed == 0.0, "moves while held, or without a new number");
        self.speed = speed;
        let around = Surroundings { reset: false, ..self.around };
        let is_quiet = !self.order.hold && self.answer.ready && around == Surroundings::QUIET;
        self.waited = count(self.waited, self.ledger.is_open() && is_quiet);
        assert!(self.waited < D::PATIENCE, "has not ended");
    }
}

/// Courses with seeds that are always the same, and the commands that ended in them.
pub fn campaign<D: Drive>() -> Ends {
    let mut all = Ends::new();
    for seed in 0..100 {
        for (error, count) in run::<D>(seed, 6000) {
            *all.entry(error).or_default() += count;
        }
    }
    println!("600,000 scans, commands ended by error: {all:?}");
    all
}
