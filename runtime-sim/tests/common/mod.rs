//! A small line, and controllers that follow a written list of steps.
#![allow(dead_code)] // each test file uses a part of it

#[path = "../../../tests/src/machines.rs"]
pub mod machines;

use machines::{belt, bin, gantry, machine, rail_arm, station, vehicle};
use runtime_sim::conservation::Conservation;
use runtime_sim::device::LAST_COMMAND;
use runtime_sim::event::Event;
use runtime_sim::item::Items;
use runtime_sim::line::{IoDelay, Kind, Line, Order, Scenario, State, Supply};
use runtime_sim::plant::{self, Plant};
use runtime_sim::point::{Axis, Point};
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};

pub const BELT: usize = 0;
pub const KITTING: usize = 1;
pub const AGV: usize = 2;
pub const GANTRY: usize = 3;
pub const STATION: usize = 4;
pub const BIN: usize = 5;

pub const BATTERY: usize = 0;
pub const PUMP: usize = 1;

pub const START: Point = Point::new(-2.265685, 1.367643, 0.0);
pub const NEAR: Point = Point::new(-5.6, 1.367643, 0.0);
pub const BATTERY_HEIGHT: f64 = 0.053;
pub const PUMP_HEIGHT: f64 = 0.11;

/// Belt, kitting robot, vehicle, gantry, station and bin of the default line; one order of a battery and a
/// pump, which the belt brings in this order.
pub fn line() -> Line {
    Line {
        scan_ms: 10,
        kinds: vec![
            Kind {
                name: "battery".into(),
                height: BATTERY_HEIGHT,
                grasp: BATTERY_HEIGHT,
                size: [0.135, 0.06],
                is: Vec::new(),
                mass: 0.1,
                deck: None,
            },
            Kind {
                name: "pump".into(),
                height: PUMP_HEIGHT,
                grasp: PUMP_HEIGHT,
                size: [0.11, 0.11],
                is: Vec::new(),
                mass: 0.1,
                deck: None,
            },
        ],
        machines: vec![
            machine("belt", &belt(Point::new(-0.573076, 0.0, 0.0), Axis::Y, [-5.0, 5.0])),
            machine("kitting", &rail_arm(Point::new(-1.3, 0.0, 1.127), Axis::Y, [-4.8, 4.8])),
            machine("agv", &vehicle(START, [NEAR, Point::new(-10.590274, 1.367643, 0.0)])),
            machine("gantry", &gantry(Point::new(-4.0, 0.0, 2.0), [-14.4, 0.4], [-4.5, 4.5])),
            machine("as1", &station(Point::new(-7.3, 3.0, 0.0))),
            machine("bin", &bin(Point::new(-1.899, 2.565, 0.0))),
        ],
        obstacles: vec![],
        // The scripts go straight from place to place.
        may_touch: [["gantry", "agv"], ["gantry", "as1"], ["kitting", "belt"]]
            .map(|pair| pair.map(Into::into))
            .to_vec(),
        scenario: Scenario {
            orders: vec![Order { stations: vec![STATION], parts: vec![1, 1] }],
            supply: vec![Supply { belt: BELT, items: vec![BATTERY, PUMP] }],
            ..Scenario::default()
        },
        io_delay: IoDelay::Fixed(0),
    }
}

/// Where the tool grips a part of this kind that rests at `place`.
pub fn grip_point(place: Point, kind: usize) -> Point {
    place.up([BATTERY_HEIGHT, PUMP_HEIGHT][kind])
}

pub mod input {
    pub const GOT: usize = 1;
    pub const ACK: usize = 2;
    pub const ERROR: usize = 3;
    pub const MOVING: usize = 4;
    pub const SEES: usize = 5;
    pub const SEEN_AT: usize = 7;
    pub const POS: usize = 4;
    pub const AT_STOP: usize = 7;
    pub const ATTACHED: usize = 4;
    pub const TOOL: usize = 5;
    pub const ORDER_OPEN: usize = 0;
}

pub mod output {
    pub const CMD: usize = 0;
    pub const VERB: usize = 1;
    pub const HOLD: usize = 2;
    pub const GOAL: usize = 3;
    pub const GRIP: usize = 6;
    pub const TOP_SPEED: usize = 7;
    pub const GAIN: usize = 8;
    pub const VIA: usize = 9;
    pub const TURN: usize = 12;
    pub const COMPLETE: usize = 0;
}

pub const DRIVE: f64 = 1.0;
pub const HALT: f64 = 2.0;
pub const MOVE: f64 = 1.0;
pub const PICK: f64 = 2.0;
pub const PACE: f64 = 3.0;
pub const TURN_TO: f64 = 4.0;
pub const THROUGH: f64 = 5.0;

/// Gives a command its number, verb and goal.
pub fn command(outputs: &mut [f64], verb: f64, goal: Option<Point>) {
    let number = outputs[output::CMD];
    outputs[output::CMD] = if number >= f64::from(LAST_COMMAND) { 1.0 } else { number + 1.0 };
    outputs[output::VERB] = verb;
    if let Some(goal) = goal {
        outputs[output::GOAL..output::GOAL + 3].copy_from_slice(&[goal.x, goal.y, goal.z]);
    }
}

pub fn point(image: &[f64], at: usize) -> Point {
    Point::new(image[at], image[at + 1], image[at + 2])
}

/// The plant alone, driven by hand.
pub struct Rig {
    pub plant: Plant,
    /// The same, in which idle machines are left out.
    from_event_to_event: Plant,
    /// The outputs of the last scan: in the next one more may follow from them than the plant says.
    obeyed: Vec<Vec<f64>>,
    pub outputs: Vec<Vec<f64>>,
}

impl Rig {
    pub fn new(line: &Line) -> Self {
        let plant = Plant::new(line).unwrap();
        Self { from_event_to_event: plant.clone(), plant, outputs: plant::outputs(line), obeyed: Vec::new() }
    }

    pub fn command(&mut self, machine: usize, verb: f64, goal: Option<Point>) {
        command(&mut self.outputs[machine], verb, goal);
    }

    pub fn step(&mut self, scans: usize) {
        for _ in 0..scans {
            self.plant.advance(&self.outputs);
            let other = &mut self.from_event_to_event;
            other.obey(&self.outputs);
            let (logged, next) = (other.items().log().count(), other.next_change());
            other.proceed_to(self.plant.scan());
            if self.obeyed == self.outputs && next.is_none_or(|next| next > other.scan()) {
                assert_eq!(other.items().log().since(logged), [], "before scan {next:?}");
            }
            self.obeyed.clone_from(&self.outputs);
            assert_eq!(other.images(), self.plant.images());
            assert_eq!(other.items().log().since(0), self.plant.items().log().since(0));
        }
    }

    pub fn image(&self, machine: usize) -> &[f64] {
        &self.plant.images()[machine]
    }

    pub fn is_ended(&self, machine: usize) -> bool {
        self.image(machine)[input::ACK] == self.outputs[machine][output::CMD]
    }

    /// Scans until the last command has ended.
    pub fn finish(&mut self, machine: usize) -> usize {
        for scans in 0..100_000 {
            if self.is_ended(machine) {
                return scans;
            }
            self.step(1);
        }
        panic!("command of machine {machine} does not end");
    }

    pub fn go(&mut self, machine: usize, verb: f64, goal: Point) -> f64 {
        self.command(machine, verb, Some(goal));
        self.finish(machine);
        self.image(machine)[input::ERROR]
    }

    /// Sets the limits of an arm's motions; the answer comes in the next scan.
    pub fn pace(&mut self, arm: usize, speed: f64, gain: f64) -> f64 {
        self.outputs[arm][output::TOP_SPEED] = speed;
        self.outputs[arm][output::GAIN] = gain;
        self.command(arm, PACE, None);
        self.step(1);
        assert!(self.is_ended(arm));
        self.image(arm)[input::ERROR]
    }

    /// Drives the belt until a part of this kind lies in the pick zone, and halts it; where it lies.
    pub fn bring(&mut self, kind: usize) -> Point {
        self.command(BELT, DRIVE, None);
        let sees = input::SEES + kind;
        assert!((0..10_000).any(|_| {
            self.step(1);
            self.image(BELT)[sees] != 0.0
        }));
        self.command(BELT, HALT, None);
        self.finish(BELT);
        point(self.image(BELT), input::SEEN_AT + 3 * kind)
    }

    /// Picks the part of this kind from the belt and lifts it.
    pub fn pick_from_belt(&mut self, kind: usize) {
        let at = grip_point(self.bring(kind), kind);
        assert_eq!(self.go(KITTING, MOVE, at.up(0.2)), 0.0);
        self.outputs[KITTING][output::GRIP] = 1.0;
        assert_eq!(self.go(KITTING, PICK, at), 0.0);
        assert_eq!(self.go(KITTING, MOVE, at.up(0.3)), 0.0);
    }

    pub fn let_go(&mut self, machine: usize) {
        self.outputs[machine][output::GRIP] = 0.0;
        self.step(1);
    }
}

#[derive(Clone, Debug)]
pub enum Step {
    /// A command of a machine: verb and goal.
    Command(usize, f64, Option<Point>),
    /// A command whose goal is so far over where the belt sees a part of this kind.
    CommandSeen(usize, f64, usize, f64),
    /// The machine has ended its command well.
    Done(usize),
    Sees(usize),
    Write(usize, usize, f64),
    /// Until an input of a machine has this value.
    Until(usize, usize, f64),
    Fault(i32, i32),
}

/// One list of steps for the whole line. A step is taken in each scan at the earliest.
pub struct Script {
    steps: Vec<Step>,
    next: usize,
    running: bool,
    last_start: bool,
}

impl Script {
    pub fn new(steps: Vec<Step>) -> Self {
        Self { steps, next: 0, running: false, last_start: false }
    }
}

impl Controllers for Script {
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        self.running = system.run_permit && (self.running || system.start && !self.last_start);
        self.last_start = system.start;
        let mut fault = None;
        if self.running
            && let Some(step) = self.steps.get(self.next)
        {
            let taken = match *step {
                Step::Command(machine, verb, goal) => {
                    command(&mut outputs[machine], verb, goal);
                    true
                }
                Step::CommandSeen(machine, verb, kind, up) => {
                    let seen = point(&inputs[BELT], input::SEEN_AT + 3 * kind);
                    command(&mut outputs[machine], verb, Some(grip_point(seen, kind).up(up)));
                    true
                }
                Step::Done(machine) => {
                    inputs[machine][input::ACK] == outputs[machine][output::CMD]
                        && inputs[machine][input::ERROR] == 0.0
                }
                Step::Sees(kind) => inputs[BELT][input::SEES + kind] != 0.0,
                Step::Write(machine, port, value) => {
                    outputs[machine][port] = value;
                    true
                }
                Step::Until(machine, port, value) => inputs[machine][port] == value,
                Step::Fault(code, robot) => {
                    fault = Some((code, robot));
                    true
                }
            };
            self.next += usize::from(taken);
        }
        for machine in [BELT, KITTING, AGV, GANTRY] {
            outputs[machine][output::HOLD] = f64::from(u8::from(!self.running));
        }
        let (fault_code, fault_robot) = fault.unwrap_or((0, -1));
        SystemOutputs {
            running: self.running,
            fault: fault.is_some(),
            fault_code,
            fault_robot,
            ..SystemOutputs::default()
        }
    }

    fn state(&self, machine: usize) -> usize {
        // The machine is in its second state while the step to be taken is about it.
        match self.steps.get(self.next) {
            Some(Step::Done(m) | Step::Until(m, ..)) if *m == machine => 1,
            _ => 0,
        }
    }

    fn trace(&self, out: &mut Vec<f64>) {
        out.push(self.next as f64);
    }

    fn stays(&self) -> Vec<usize> {
        Vec::new()
    }

    fn power_up(&mut self) {}

    fn skip(&mut self, _: u64) {}
}

/// The states that [`Script::state`] tells of: waiting for all others, and working.
pub fn states(others: Vec<usize>) -> Vec<State> {
    vec![
        State {
            name: "Waiting".into(),
            working: false,
            awaits: others,
            reads: vec![],
            reads_while: vec![],
            timers: None,
            awaits_answer: false,
        },
        State {
            name: "Working".into(),
            working: true,
            awaits: vec![],
            reads: vec![],
            reads_while: vec![],
            timers: None,
            awaits_answer: false,
        },
    ]
}

/// Takes a part of this kind from the belt to the slot of the tray.
pub fn load(kind: usize, slot: Point) -> Vec<Step> {
    let at = grip_point(START + slot, kind);
    let go = |verb, goal| [Step::Command(KITTING, verb, Some(goal)), Step::Done(KITTING)];
    let seen = |verb, up| [Step::CommandSeen(KITTING, verb, kind, up), Step::Done(KITTING)];
    let mut steps = vec![Step::Command(BELT, DRIVE, None), Step::Sees(kind)];
    steps.extend([Step::Command(BELT, HALT, None), Step::Done(BELT)]);
    steps.extend(seen(MOVE, 0.3));
    steps.push(Step::Write(KITTING, output::GRIP, 1.0));
    steps.extend(seen(PICK, 0.0));
    // The part hangs on the gripper now: where it was seen it is seen no more.
    steps.extend(go(MOVE, at.up(0.5)));
    steps.extend(go(MOVE, at));
    steps.push(Step::Write(KITTING, output::GRIP, 0.0));
    steps.push(Step::Until(KITTING, input::ATTACHED, 0.0));
    steps.extend(go(MOVE, at.up(0.5)));
    steps
}

/// Takes a part of this kind from the slot of the tray at the near stop to its place in the briefcase.
pub fn unload(kind: usize, slot: Point, place: Point) -> Vec<Step> {
    let go = |verb, goal| [Step::Command(GANTRY, verb, Some(goal)), Step::Done(GANTRY)];
    let (from, to) = (grip_point(NEAR + slot, kind), grip_point(place, kind));
    let mut steps = vec![];
    steps.extend(go(MOVE, from.up(0.1)));
    steps.push(Step::Write(GANTRY, output::GRIP, 1.0));
    steps.extend(go(PICK, from));
    steps.extend(go(MOVE, from.up(0.1)));
    steps.extend(go(MOVE, to.up(0.1)));
    steps.extend(go(MOVE, to));
    steps.push(Step::Write(GANTRY, output::GRIP, 0.0));
    steps.push(Step::Until(GANTRY, input::ATTACHED, 0.0));
    steps.extend(go(MOVE, to.up(0.1)));
    steps
}

/// Everything that it takes to make the order of [`line`].
pub fn whole_order() -> Vec<Step> {
    let slots = |machine: usize| line().machines[machine].places().next().unwrap().slots.clone();
    let (tray, case) = (slots(AGV), slots(STATION));
    let station = Point::new(-7.3, 3.0, 0.0);
    let mut steps = load(BATTERY, tray[0]);
    steps.extend(load(PUMP, tray[1]));
    steps.extend([Step::Command(AGV, MOVE, Some(NEAR)), Step::Done(AGV)]);
    steps.extend(unload(BATTERY, tray[0], station + case[0]));
    steps.extend(unload(PUMP, tray[1], station + case[1]));
    steps.push(Step::Write(STATION, output::COMPLETE, 1.0));
    steps.push(Step::Until(STATION, input::ORDER_OPEN, 0.0));
    steps.push(Step::Write(STATION, output::COMPLETE, 0.0));
    steps
}

/// What a log proves of the items at its end.
pub fn conservation(log: &[Event], items: &Items) -> Result<(), String> {
    let mut conservation = Conservation::new(items);
    conservation.take(log);
    conservation.end(items)
}
