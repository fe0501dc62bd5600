//! Random lines of conveyors: from event to event against scan by scan, and against items moved in small steps.
//!
//! The long form: `AUTOGEN_CAMPAIGN=full cargo test --release -p runtime-sim --lib conveying`.

use super::super::{Plant, outputs};
use crate::carrier::Carrier;
use crate::device::Extent;
use crate::frame::Frame;
use crate::line::{IoDelay, Kind, Line, Scenario, Supply};
use crate::machine::Machine;
use crate::part::lane::{RUN, RUN_BY};
use crate::part::{Part, Schema, Settings};
use crate::point::Point;
use crate::random::Random;
use crate::value::Value;
use crate::wiring::{Drives, Input, Output, Size, Source, Wiring};
use std::sync::Arc;

const SCAN_MS: u64 = 10;
const SCANS: u64 = 6000;
const ONE: Size = Size { each: 1, extent: Extent::One };

/// What a line consists of, in numbers, for both ways of moving items.
struct Design {
    lanes: Vec<Belt>,
    stoppers: Vec<Pin>,
    beams: Vec<(usize, f64)>,
    /// Lengths of the kinds.
    lengths: Vec<f64>,
    supply: Vec<usize>,
    first_ms: u64,
    every_ms: u64,
    /// Whether the lanes have rates: outputs after those of the stoppers.
    has_rates: bool,
    /// Scan, output, value.
    script: Vec<(u64, usize, f64)>,
}

struct Belt {
    length: f64,
    speed: f64,
    turn: f64,
    /// The lane that it leads onto; none: a sink.
    onto: Option<usize>,
}

struct Pin {
    lane: usize,
    at: f64,
    extend_ms: u64,
    retract_ms: u64,
}

/// The middle lanes stand in a row; sometimes another one leads to the beginning of the second.
fn design(random: &mut Random) -> Design {
    let row = 1 + random.up_to(3) as usize;
    let merges = row > 1 && random.up_to(2) == 0;
    let mut between = |low: f64, high: f64| low + (high - low) * f64::from(random.up_to(999_999)) / 1e6;
    let mut lanes: Vec<Belt> = (0..row)
        .map(|lane| Belt {
            length: between(0.5, 1.6),
            speed: between(0.1, 0.6),
            turn: if between(0.0, 1.0) < 0.3 { between(-170.0, 170.0) } else { 0.0 },
            onto: (lane + 1 < row).then_some(lane + 1),
        })
        .collect();
    if merges {
        lanes.push(Belt { length: between(0.5, 1.6), speed: between(0.1, 0.6), turn: 0.0, onto: Some(1) });
    }
    let lengths: Vec<f64> = (0..3).map(|_| between(0.05, 0.2)).collect();
    let stoppers: Vec<Pin> = (0..between(0.0, 4.0) as usize)
        .map(|_| {
            let lane = between(0.0, lanes.len() as f64) as usize;
            let at = between(0.3, lanes[lane].length - 0.05);
            let (extend_ms, retract_ms) = (between(1.0, 400.0) as u64, between(1.0, 400.0) as u64);
            Pin { lane, at, extend_ms, retract_ms }
        })
        .collect();
    let beams = (0..2).map(|_| {
        let lane = between(0.0, lanes.len() as f64) as usize;
        (lane, between(0.0, lanes[lane].length))
    });
    let beams = beams.collect();
    let has_rates = between(0.0, 1.0) < 0.5;
    let rates = lanes.len() + stoppers.len()..lanes.len() + stoppers.len() + lanes.len();
    let outputs = if has_rates { rates.end } else { rates.start };
    let begins = (0..lanes.len()).chain(rates.start..outputs);
    let mut script: Vec<(u64, usize, f64)> = begins.map(|output| (0, output, 1.0)).collect();
    let mut scan = 0;
    while scan < SCANS {
        scan += between(5.0, 250.0) as u64;
        let output = between(0.0, outputs as f64) as usize;
        let is_on = |share: bool| f64::from(u8::from(share));
        script.push((
            scan,
            output,
            match output {
                _ if rates.contains(&output) => {
                    [0.0, 0.25, between(0.1, 1.0), 1.0][between(0.0, 4.0) as usize]
                }
                _ if output < lanes.len() => is_on(between(0.0, 1.0) < 0.8),
                _ => is_on(between(0.0, 1.0) < 0.4),
            },
        ));
    }
    let supply = (0..30).map(|_| between(0.0, 3.0) as usize).collect();
    let (first_ms, every_ms) = (between(0.0, 900.0) as u64, between(200.0, 2500.0) as u64);
    Design { lanes, stoppers, beams, lengths, supply, first_ms, every_ms, has_rates, script }
}

impl Design {
    /// With sources on the first lane and on the one that joins, each with half of the items.
    fn line(&self) -> Line {
        let mut frames: Vec<Frame> = Vec::new();
        let mut machines = Vec::new();
        let mut next = Frame::default();
        for (number, belt) in self.lanes.iter().enumerate() {
            let joins = number > 0 && self.lanes[number - 1].onto != Some(number);
            let from = if joins {
                frames[1].then(Frame::new(Point::new(-belt.length, 0.0, 0.0), 0.0))
            } else {
                next
            };
            frames.push(from);
            let (machine, end) = self.machine(number, belt, from);
            machines.push(machine);
            next = end;
        }
        let of = |lane: usize, half: usize| Supply {
            belt: lane,
            items: self.supply.iter().copied().skip(half).step_by(2).collect(),
        };
        let last = self.lanes.len() - 1;
        let joins = last > 0 && self.lanes[last - 1].onto != Some(last);
        let supply = if joins { vec![of(0, 0), of(last, 1)] } else { vec![of(0, 0)] };
        Line {
            scan_ms: SCAN_MS as u32,
            kinds: self
                .lengths
                .iter()
                .enumerate()
                .map(|(number, length)| Kind {
                    name: format!("kind_{number}"),
                    height: 0.1,
                    grasp: 0.1,
                    size: [*length, 0.05],
                    is: Vec::new(),
                    mass: 0.1,
                    deck: None,
                })
                .collect(),
            machines,
            obstacles: Vec::new(),
            may_touch: Vec::new(),
            scenario: Scenario {
                supply,
                spawn_first_s: self.first_ms as f64 / 1000.0,
                spawn_every_s: self.every_ms as f64 / 1000.0,
                ..Scenario::default()
            },
            io_delay: IoDelay::Fixed(0),
        }
    }

    /// A lane with its sensors and stoppers; and the frame of its end.
    fn machine(&self, number: usize, belt: &Belt, from: Frame) -> (Machine, Frame) {
        let value = Value::Number;
        let part = |name: &str, primitive: &str, settings: Vec<(&'static str, Value)>| {
            Arc::new(Part::new(name, primitive, Settings::new(settings)).unwrap_or_else(|e| panic!("{e}")))
        };
        let lane = Value::Part { part: 0, frame: 0 };
        let mut parts = vec![part(
            "belt",
            "lane",
            vec![
                ("from", Value::Frame(from)),
                ("length", value(belt.length)),
                ("turn", value(belt.turn)),
                ("width", value(0.3)),
                ("speed", value(belt.speed)),
            ],
        )];
        let feeds = number == 0 || self.lanes[number - 1].onto != Some(number);
        if feeds {
            parts.push(part("feed", "source", vec![("on", lane.clone()), ("inset", value(0.1))]));
        }
        if belt.onto.is_none() {
            parts.push(part("end", "sink", vec![("of", lane.clone()), ("inset", value(0.0))]));
        }
        let mut drives = vec![Drives::Level { part: 0, level: RUN }];
        drives.extend(self.has_rates.then_some(Drives::Level { part: 0, level: RUN_BY }));
        for (pin, stopper) in self.stoppers.iter().enumerate().filter(|(_, pin)| pin.lane == number) {
            let cylinder = parts.len();
            let ms = |ms: u64| value(ms as f64);
            let times = vec![("extend", ms(stopper.extend_ms)), ("retract", ms(stopper.retract_ms))];
            parts.push(part(&format!("pin_{pin}"), "cylinder", times));
            let by = Value::Part { part: cylinder, frame: 0 };
            let at = value(stopper.at);
            let settings = vec![("of", lane.clone()), ("at", at), ("by", by)];
            parts.push(part(&format!("stop_{pin}"), "stopper", settings));
            drives.push(Drives::Level { part: cylinder, level: 0 });
        }
        let mut inputs = Vec::new();
        for (beam, (_, at)) in self.beams.iter().enumerate().filter(|(_, (lane, _))| *lane == number) {
            inputs.push(Input { size: ONE, source: Source::Signal { part: parts.len(), signal: 0 } });
            let settings = vec![("across", lane.clone()), ("at", value(*at))];
            parts.push(part(&format!("beam_{beam}"), "beam", settings));
        }
        assert!(parts.iter().all(|part| Schema::find(part.schema().name).is_some()));
        let end = parts.first().and_then(|part| match &part.primitive {
            crate::part::Primitive::Lane(lane) => Some(lane.centre_line.frame(lane.centre_line.end())),
            _ => None,
        });
        let outputs = drives.into_iter().map(|drives| Output { size: ONE, drives }).collect();
        let wiring = Arc::new(Wiring { inputs, outputs, commands: Vec::new() });
        let (name, pose) = (format!("lane_{number}"), from.position);
        (
            Machine {
                name,
                pose,
                parts,
                wiring,
                states: Vec::new(),
                monitor: Default::default(),
                visits: None,
            },
            end.unwrap_or_default(),
        )
    }

    /// Machine and output of each number in the script.
    fn output(&self, number: usize) -> (usize, usize) {
        match number.checked_sub(self.lanes.len()) {
            None => (number, 0),
            Some(rate) if rate >= self.stoppers.len() => (rate - self.stoppers.len(), 1),
            Some(pin) => {
                let lane = self.stoppers[pin].lane;
                let before = self.stoppers[..pin].iter().filter(|other| other.lane == lane).count();
                (lane, 1 + usize::from(self.has_rates) + before)
            }
        }
    }

    fn apply(&self, scan: u64, outputs: &mut [Vec<f64>]) {
        for (_, output, value) in self.script.iter().filter(|(at, _, _)| *at == scan) {
            let (machine, word) = self.output(*output);
            outputs[machine][word] = *value;
        }
    }
}

fn bits(plant: &Plant) -> Vec<u64> {
    let places = (0..plant.items().count()).filter_map(|item| plant.place(item));
    let places = places.flat_map(|Point { x, y, z }| [x, y, z]);
    plant.images().iter().flatten().copied().chain(places).map(f64::to_bits).collect()
}

/// Items moved by a small step at a time.
struct Steps<'a> {
    design: &'a Design,
    /// Lane and place of the middle from the lane's beginning, of each item that is on one.
    items: Vec<Option<(usize, f64)>>,
    /// The lane from which each has come onto its lane.
    from: Vec<Option<usize>>,
    kinds: Vec<usize>,
    /// Items of each lane that are still to come, and full-speed times.
    queues: Vec<Vec<usize>>,
    spawned: Vec<u64>,
    /// Steps in which the lane moved, however fast.
    travel: Vec<u64>,
    on: Vec<f64>,
    /// Out by this part, for each stopper.
    out: Vec<f64>,
    /// It depends on less than a step what happens.
    is_close: bool,
}

/// Of a millisecond.
const STEPS: u64 = 4;
/// m: what the steps may be off after a minute of waiting and continuing.
const CLOSE: f64 = 0.004;

impl Steps<'_> {
    fn half(&self, item: usize) -> f64 {
        self.design.lengths[self.kinds[item]] / 2.0
    }

    /// The part of its full speed at which a lane runs.
    fn rate(&self, lane: usize) -> f64 {
        let rates = self.design.lanes.len() + self.design.stoppers.len();
        if self.on[lane] != 0.0 && self.design.has_rates { self.on[rates + lane] } else { self.on[lane] }
    }

    fn switch(&mut self, output: usize, value: f64) {
        let changes = std::mem::replace(&mut self.on[output], value) != value;
        let is_at_joint =
            |(lane, place): (usize, f64)| place < CLOSE || self.design.lanes[lane].length - place < CLOSE;
        let lanes = self.design.lanes.len();
        let is_stopper = (lanes..lanes + self.design.stoppers.len()).contains(&output);
        self.is_close |= changes && !is_stopper && self.items.iter().flatten().any(|at| is_at_joint(*at));
    }

    fn step(&mut self) {
        for (pin, out) in self.design.stoppers.iter().zip(0..) {
            let was_in = self.out[out] <= 0.0;
            let is_on = self.on[self.design.lanes.len() + out] != 0.0;
            let stroke_ms = if is_on { pin.extend_ms as f64 } else { -(pin.retract_ms as f64) };
            let step = 1.0 / stroke_ms / STEPS as f64;
            self.out[out] = (self.out[out] + step).clamp(0.0, 1.0);
            if was_in && self.out[out] > 0.0 {
                let front = |item: usize, place: f64| place + self.half(item) - pin.at;
                let items = self.items.iter().enumerate();
                let near = items.filter_map(|(item, at)| {
                    at.filter(|(lane, _)| *lane == pin.lane).map(|(_, p)| front(item, p))
                });
                self.is_close |= near.into_iter().any(|gap| gap.abs() < CLOSE);
            }
        }
        // From the end of the line to its beginning, the foremost first.
        let mut order: Vec<usize> =
            (0..self.items.len()).filter(|item| self.items[*item].is_some()).collect();
        order.sort_by(|a, b| {
            let key =
                |item: usize| self.items[item].map_or((0, 0.0), |(lane, place)| (self.rank(lane), place));
            let ((rank_a, place_a), (rank_b, place_b)) = (key(*a), key(*b));
            rank_b.cmp(&rank_a).then(place_b.total_cmp(&place_a))
        });
        for item in order {
            self.advance(item);
        }
        for lane in 0..self.design.lanes.len() {
            if self.rate(lane) > 0.0 {
                self.travel[lane] += 1;
            }
            self.spawn(lane);
        }
    }

    /// Lanes that lead to no other are last.
    fn rank(&self, lane: usize) -> usize {
        self.design.lanes[lane].onto.map_or(usize::MAX, |onto| self.rank(onto) - 1)
    }

    fn advance(&mut self, item: usize) {
        let Some((lane, place)) = self.items[item] else { return };
        let belt = &self.design.lanes[lane];
        let half = self.half(item);
        let mut goal = place + self.rate(lane) * belt.speed / 1000.0 / STEPS as f64;
        for (pin, out) in self.design.stoppers.iter().zip(&self.out) {
            if pin.lane == lane && *out > 0.0 && place + half <= pin.at + 1e-6 {
                goal = goal.min(pin.at - half);
            }
        }
        for (other, at) in self.items.iter().enumerate().filter(|(other, _)| *other != item) {
            let Some((on, at)) = *at else { continue };
            let rear = at - self.half(other);
            let rear = if on == lane && at > place {
                rear
            } else if Some(on) == belt.onto {
                // On its way over from another lane it is in nobody's way before the joint.
                belt.length + if self.from[other] == Some(lane) { rear } else { rear.max(0.0) }
            } else {
                continue;
            };
            goal = goal.min(rear - half);
        }
        if let Some(onto) = belt.onto {
            for (other, at) in self.items.iter().enumerate() {
                let Some((on, at)) = *at else { continue };
                if on == lane || self.design.lanes[on].onto != Some(onto) {
                    continue;
                }
                let over = at + self.half(other) - self.design.lanes[on].length;
                let own_over = place + half - belt.length;
                self.is_close |= over.abs() < CLOSE && own_over.abs() < CLOSE;
                if over > 1e-9 && own_over <= 1e-9 {
                    goal = goal.min(belt.length - half);
                }
            }
        }
        let goal = goal.max(place);
        if goal >= belt.length {
            self.from[item] = Some(lane);
        }
        self.items[item] = match belt.onto {
            _ if goal < belt.length => Some((lane, goal)),
            Some(onto) => Some((onto, goal - belt.length)),
            None => None,
        };
    }

    fn spawn(&mut self, lane: usize) {
        let Some(&item) = self.queues[lane].last() else { return };
        let due = STEPS * (self.design.first_ms + self.spawned[lane] * self.design.every_ms);
        if self.rate(lane) == 0.0 || self.travel[lane] < due {
            return;
        }
        let half = self.half(item);
        let gaps = self.items.iter().enumerate().filter_map(|(other, at)| {
            at.filter(|(on, _)| *on == lane).map(|(_, place)| (place - 0.1).abs() - half - self.half(other))
        });
        let gap = gaps.fold(f64::INFINITY, f64::min);
        self.is_close |= gap.abs() < CLOSE && gap < 0.0 && self.travel[lane] <= due + 20 * STEPS;
        if gap >= -1e-6 {
            self.items[item] = Some((lane, 0.1));
            self.queues[lane].pop();
            self.spawned[lane] += 1;
        }
    }
}

#[test]
fn events_are_those_of_every_scan_and_of_small_steps() {
    let (mut compared, mut whole) = (0_u64, 0_u64);
    let is_full = std::env::var("AUTOGEN_CAMPAIGN").is_ok_and(|form| form == "full");
    let (seeds, stepped) = if is_full { (20_000, 2000) } else { (200, 30) };
    for seed in 0..seeds {
        let design = design(&mut Random::new(seed));
        let line = design.line();
        let mut by_scan = Plant::new(&line).unwrap_or_else(|error| panic!("{seed}: {error}"));
        let mut by_event = by_scan.clone();
        let mut images = outputs(&line);
        let kinds: Vec<usize> = line.scenario.supply.iter().flat_map(|supply| supply.items.clone()).collect();
        let mut first = 0;
        let mut queues = vec![Vec::new(); design.lanes.len()];
        for supply in &line.scenario.supply {
            queues[supply.belt] = (first..first + supply.items.len()).rev().collect();
            first += supply.items.len();
        }
        let mut steps = Steps {
            design: &design,
            items: vec![None; kinds.len()],
            from: vec![None; kinds.len()],
            kinds,
            queues,
            spawned: vec![0; design.lanes.len()],
            travel: vec![0; design.lanes.len()],
            on: vec![0.0; 2 * design.lanes.len() + design.stoppers.len()],
            out: vec![0.0; design.stoppers.len()],
            is_close: seed >= stepped,
        };
        let mut next = 0;
        for scan in 0..SCANS {
            design.apply(scan, &mut images);
            if scan == next {
                by_event.obey(&images);
                let script = design.script.iter().map(|(at, _, _)| *at).filter(|at| *at > scan).min();
                let quiet = by_event.next_change().unwrap_or(SCANS).min(script.unwrap_or(SCANS)).min(SCANS);
                next = quiet.max(scan + 1);
                by_event.proceed_to(next);
            }
            by_scan.advance(&images);
            if scan + 1 == next {
                assert_eq!(bits(&by_event), bits(&by_scan), "{seed}: scan {scan}");
            }
            if steps.is_close {
                continue;
            }
            for (_, output, value) in design.script.iter().filter(|(at, _, _)| *at == scan) {
                steps.switch(*output, *value);
            }
            (0..SCAN_MS * STEPS).for_each(|_| steps.step());
            if steps.is_close {
                continue;
            }
            compared += 1;
            compare(seed, scan, &steps, &by_scan);
        }
        whole += u64::from(!steps.is_close);
    }
    assert!(
        compared > 2000 * stepped && whole > stepped / 10,
        "{compared} scans compared, {whole} lines to the end"
    );
}

fn compare(seed: u64, scan: u64, steps: &Steps, plant: &Plant) {
    for (item, at) in steps.items.iter().enumerate() {
        let carrier = plant.items()[item].carrier;
        let conveyed = plant.conveyed(item).map(|conveyed| conveyed.centre_line.begin() - conveyed.place);
        let found = carrier.machine().zip(conveyed);
        let is_same = match (*at, found) {
            (None, None) => true,
            (Some((lane, place)), Some((machine, there))) if lane == machine => (place - there).abs() < CLOSE,
            // One of them is over the joint already.
            (Some((lane, place)), Some((machine, there))) => {
                let along =
                    |lane: usize, place: f64| (place - steps.design.lanes[lane].length).min(0.0).abs();
                let (before, after) = if steps.rank(lane) < steps.rank(machine) {
                    (along(lane, place), there)
                } else {
                    (along(machine, there), place)
                };
                before < CLOSE && after < CLOSE
            }
            (Some((lane, place)), None) => {
                let length = steps.design.lanes[lane].length;
                (length - place).abs() < CLOSE
                    || matches!(carrier, Carrier::Supply) && (place - 0.1).abs() < CLOSE
            }
            (None, Some((machine, there))) => {
                let length = steps.design.lanes[machine].length;
                (length - there).abs() < CLOSE || (there - 0.1).abs() < CLOSE
            }
        };
        assert!(is_same, "{seed}: item {item} after scan {scan}: {at:?} in steps, {found:?}");
    }
}
