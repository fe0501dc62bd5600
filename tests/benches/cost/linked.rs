//! What a run costs, and where: `cost LINE PARAMETERS`. Compiled beside the generated controllers.
//!
//! A run is recorded once. Then its parts are replayed alone, on the very same numbers, and timed; what
//! handling the record costs is timed as well and taken off. Of several rounds the least counts, and the
//! parts take turns, so that another load on the machine does not fall on one of them.

mod by_hand;

use by_hand::Vehicle;
use adapters::layout::{Layout, latch};
use adapters::read::Reader;
use commissioning::deployed::Deployed;
use controllers::agv::{Agv, State};
use controllers::cells::{DemandCells, SourceCells, TrayCells};
use controllers::robot::Robot;
use runtime_sim::hash::Hash;
use runtime_sim::kinematics::arm::{Arm, Joints};
use runtime_sim::line::Line;
use runtime_sim::plant::Plant;
use runtime_sim::point::Point;
use runtime_sim::memory::Memory;
use runtime_sim::random::Random;
use runtime_sim::run::{Stepping, run, run_again, run_together};
use runtime_sim::scan::{Controllers, SystemInputs};
use std::fs;
use std::hint::black_box;
use std::time::Instant;

const ROUNDS: usize = 7;
/// Runs of the same line with other orders of its supply.
const SEEDS: u64 = 20;
/// Runs that are made together.
const TOGETHER: usize = 16;
/// Times that a step is repeated where that changes nothing, so that it is long beside what goes before it.
const AGAIN: usize = 50;

/// All images of one direction in all scans, scan after scan.
struct Images {
    words: Vec<f64>,
    lengths: Vec<usize>,
}

impl Images {
    fn like(images: &[Vec<f64>]) -> Self {
        Self { words: Vec::new(), lengths: images.iter().map(Vec::len).collect() }
    }

    fn take(&mut self, images: &[Vec<f64>]) {
        images.iter().for_each(|image| self.words.extend(image));
    }

    fn buffers(&self) -> Vec<Vec<f64>> {
        self.lengths.iter().map(|&length| vec![0.0; length]).collect()
    }

    /// Each scan's images in turn.
    fn each(&self, mut see: impl FnMut(&mut [Vec<f64>])) {
        let mut buffers = self.buffers();
        for scan in self.words.chunks_exact(self.lengths.iter().sum()) {
            let mut rest = scan;
            for buffer in &mut buffers {
                let (image, after) = rest.split_at(buffer.len());
                buffer.copy_from_slice(image);
                rest = after;
            }
            see(&mut buffers);
        }
    }
}

/// An arm's path: what its kinematics are asked during the run.
struct Path {
    arm: Arm,
    /// Joints in each scan in which the tool moved.
    moving: Vec<Joints>,
    /// Goals of its commands.
    goals: Vec<(Point, Joints)>,
}

struct Record {
    scans: u64,
    system: Vec<SystemInputs>,
    inputs: Images,
    outputs: Images,
    trace: Vec<f64>,
    paths: Vec<Path>,
}

fn main() {
    let files: Vec<String> = std::env::args().skip(1).collect();
    let text = |path: &str| fs::read_to_string(path).unwrap_or_else(|e| panic!("{path}: {e}"));
    let line = Line::from_text(&text(&files[0])).expect("a line");
    let parameters = text(&files[1]);
    let deployed = || Deployed::read(&parameters).expect("parameters");
    let record = record(&line, deployed());

    let mut least = [f64::INFINITY; 8];
    let mut plants: Vec<Plant> =
        (0..ROUNDS).map(|_| Plant::new(&line).expect("a line that can be run")).collect();
    for _ in 0..ROUNDS {
        let mut keep = |part: usize, seconds: f64| least[part] = least[part].min(seconds);
        let mut controllers = deployed();
        keep(0, timed(|| drop(black_box(run(&line, &mut controllers, Stepping::EveryScan, &mut |_| {})))));
        keep(1, timed(|| record.inputs.each(|images| _ = black_box(images))));
        keep(2, timed(|| record.outputs.each(|images| _ = black_box(images))));
        let mut controllers = deployed();
        keep(3, timed(|| scan(&record, &mut controllers, |_| {})));
        let mut controllers = deployed();
        let mut trace = Vec::new();
        keep(
            4,
            timed(|| {
                scan(&record, &mut controllers, |controllers| {
                    trace.clear();
                    controllers.trace(&mut trace);
                    black_box(&trace);
                })
            }),
        );
        let mut plant = plants.pop().expect("one for each round");
        keep(5, timed(|| record.outputs.each(|images| plant.advance(images))));
        keep(6, timed(|| kinematics(&record)));
        keep(7, timed(|| hash(&record)));
    }
    let report = run(&line, &mut deployed(), Stepping::EveryScan, &mut |_| {}).expect("a line that can be run");
    let written =
        (0..ROUNDS).map(|_| timed(|| drop(black_box(report.to_json())))).fold(f64::INFINITY, f64::min);

    let [whole, read_inputs, read_outputs, scans, traced, plant, kinematics, hashed] = least;
    let controllers = (scans - read_inputs).max(0.0);
    let trace = (traced - scans).max(0.0);
    let plant = (plant - read_outputs).max(0.0);
    let rest = whole - controllers - trace - plant - hashed - written;
    let each = |seconds: f64| seconds / record.scans as f64 * 1e9;
    println!(
        "a run: {:.1} ms, {:.0} ns a scan; {:.1} runs/s on one processor; {} scans of {} ms, {} times real time",
        whole * 1e3,
        each(whole),
        1.0 / whole,
        record.scans,
        line.scan_ms,
        (report.simulated_s / whole).round()
    );
    let row = |name: &str, seconds: f64| {
        println!(
            "  {name:44} {:8.2} ms {:7.1} ns/scan {:5.1} %",
            seconds * 1e3,
            each(seconds),
            seconds / whole * 100.0
        );
    };
    row("plant", plant);
    row("  of it kinematics of the arms", kinematics);
    row("controllers, with latching and publishing", controllers);
    row("trace: gathering what controllers remember", trace);
    row("trace: hash of it and of the outputs", hashed);
    row("report as JSON", written);
    row("rest: collision check, bus, accounts", rest);

    events(&line, deployed, files.get(2).and_then(|figure| figure.parse().ok()));
    vehicle(&record, &parameters);
}

/// Runs that go from event to event, with contacts, accounts and report. `simpy`: what a model in SimPy simulates, s per s.
fn events(line: &Line, deployed: impl Fn() -> Deployed, simpy: Option<f64>) {
    let run = |line: &Line, memory: &mut Memory| {
        let report = run_again(line, &mut deployed(), Stepping::Events, memory, &mut |_| {});
        report.expect("a line that can be run").simulated_s
    };
    let row = |name: &str, simulated: f64, seconds: f64, runs: usize| {
        let rate = simulated / seconds;
        let beside = simpy.map_or_else(String::new, |simpy| format!(", {:.4} of SimPy", rate / simpy));
        println!("  {name:44} {:8.2} ms a run {rate:10.0} simulated s/s{beside}", seconds / runs as f64 * 1e3);
    };
    println!("\nfrom event to event, on one processor");
    let mut memory = Memory::default();
    let mut simulated = 0.0;
    let first = timed(|| simulated = run(line, &mut memory));
    row("first run of a layout", simulated, first, 1);
    let again = (0..ROUNDS).map(|_| timed(|| simulated = run(line, &mut memory))).fold(f64::INFINITY, f64::min);
    row("the same run again", simulated, again, 1);
    let mut together = |runs: usize| {
        let mut all: Vec<Deployed> = (0..runs).map(|_| deployed()).collect();
        timed(|| {
            let mut all = all.iter_mut().map(|it| (line, it as &mut dyn Controllers));
            let (line, controllers) = all.next().expect("a run");
            let reports = run_together(line, controllers, all.collect(), &mut memory);
            assert_eq!(reports.map(|all| all.len()), Ok(runs));
        })
    };
    let [one, several] =
        [1, TOGETHER].map(|runs| (0..ROUNDS).map(|_| together(runs)).fold(f64::INFINITY, f64::min));
    let others = TOGETHER - 1;
    row("more runs whose controllers do the same", simulated * others as f64, several - one, others);
    let lines: Vec<Line> = (1..=SEEDS).map(|seed| shuffled(line, seed)).collect();
    let mut all = 0.0;
    let seconds = timed(|| all = lines.iter().map(|line| run(line, &mut memory)).sum());
    row(&format!("{SEEDS} runs with other orders of the supply"), all, seconds, lines.len());
    if simpy.is_none() {
        println!("  no model in SimPy beside it: python3 with the package simpy is needed");
    }
}

/// The parts of each belt in another order.
fn shuffled(line: &Line, seed: u64) -> Line {
    let mut line = line.clone();
    let mut random = Random::new(seed);
    for supply in &mut line.scenario.supply {
        for last in (1..supply.items.len()).rev() {
            let other = random.up_to(last as u32) as usize;
            supply.items.swap(last, other);
        }
    }
    line
}

fn timed(work: impl FnOnce()) -> f64 {
    let begin = Instant::now();
    work();
    begin.elapsed().as_secs_f64()
}

fn record(line: &Line, mut controllers: Deployed) -> Record {
    let mut record: Option<Record> = None;
    let arms: Vec<Option<Arm>> = line.machines.iter().map(|m| m.arm()).collect();
    let mut before: Vec<(Option<Point>, f64)> = vec![(None, 0.0); arms.len()];
    let report = run(line, &mut controllers, Stepping::EveryScan, &mut |seen| {
        let record = record.get_or_insert_with(|| Record {
            scans: 0,
            system: Vec::new(),
            inputs: Images::like(seen.inputs),
            outputs: Images::like(seen.outputs),
            trace: seen.trace.to_vec(),
            paths: arms
                .iter()
                .flatten()
                .map(|arm| Path { arm: *arm, moving: Vec::new(), goals: Vec::new() })
                .collect(),
        });
        record.scans += 1;
        record.system.push(seen.system);
        record.inputs.take(seen.inputs);
        record.outputs.take(seen.outputs);
        let machines = arms.iter().enumerate().filter_map(|(machine, arm)| Some((machine, arm.as_ref()?)));
        for ((machine, arm), path) in machines.zip(&mut record.paths) {
            let (tool_before, number_before) = before[machine];
            let tool = seen.plant.position(machine);
            let joints = |place: Point, near: &Joints| arm.solve(place, near).unwrap_or(*near);
            let near = path.moving.last().copied().unwrap_or_else(|| arm.start());
            if let Some(tool) = tool.filter(|_| tool_before.is_some() && tool != tool_before) {
                path.moving.push(joints(tool, &near));
            }
            let number = seen.outputs[machine][0];
            if number != number_before {
                path.goals.push((tool.unwrap_or(Point::new(0.0, 0.0, 0.0)), near));
            }
            before[machine] = (tool, number);
        }
    });
    report.expect("a line that can be run");
    record.expect("a run has scans")
}

/// The controllers alone, given what they were given.
fn scan(record: &Record, controllers: &mut Deployed, mut after: impl FnMut(&Deployed)) {
    let mut outputs = record.outputs.buffers();
    let mut scan = 0;
    record.inputs.each(|images| {
        black_box(controllers.scan(record.system[scan], images, &mut outputs));
        after(controllers);
        scan += 1;
    });
}

/// Where the tools are whenever they move, and the joints for each command.
fn kinematics(record: &Record) {
    for path in &record.paths {
        for joints in &path.moving {
            black_box(path.arm.tool(black_box(joints)));
        }
        for (goal, near) in &path.goals {
            black_box(path.arm.solve(black_box(*goal), near));
        }
    }
}

fn hash(record: &Record) {
    let mut hash = Hash::default();
    for (scan, outputs) in (0..).zip(record.outputs.words.chunks_exact(record.outputs.lengths.iter().sum())) {
        for (place, word) in record.trace.iter().chain(outputs).enumerate() {
            hash.change(scan, place, *word);
        }
    }
    black_box(hash.value());
}

/// What a vehicle finds before its step.
#[derive(Clone)]
struct Found {
    inputs: controllers::agv::Inputs,
    tray: TrayCells,
    source: SourceCells,
    demand: Vec<DemandCells>,
    /// Of the generated controller, to tell whether its step changed anything.
    state: State,
    command: i32,
}

/// One vehicle's steps by the generated controller and by one written by hand, on what it found in the run.
fn vehicle(record: &Record, parameters: &str) {
    let mut layout = Layout::read(&mut Reader::new(parameters)).expect("parameters");
    let busiest = "agv2";
    let number = layout.robots.iter().position(|r| r.name() == busiest).expect("the vehicle that goes most");
    let demands: Vec<_> = layout
        .robots
        .iter()
        .filter_map(|robot| match robot {
            Robot::Station(station) => Some(station.parameters.as_demand),
            _ => None,
        })
        .collect();

    // All robots step as they did in the run; before and after each step of the vehicle its cells are kept.
    let (mut found, mut left): (Vec<Found>, Vec<Found>) = (Vec::new(), Vec::new());
    let mut runs = false;
    let mut begun: Option<Agv> = None;
    let mut scan = 0;
    record.inputs.each(|images| {
        for (robot, image) in layout.robots.iter_mut().zip(images.iter()) {
            latch(robot, image);
            robot.limit_inputs();
        }
        runs |= record.system[scan].start;
        scan += 1;
        if !runs {
            return;
        }
        for index in 0..layout.robots.len() {
            let is_it = index == number;
            if is_it {
                let Robot::Agv(agv) = &layout.robots[index] else { panic!("{busiest} is a vehicle") };
                begun.get_or_insert_with(|| agv.clone());
                found.push(seen(agv, &layout, &demands));
            }
            layout.robots[index].step(&layout.wiring, &mut layout.cells).expect("a step without a fault");
            if is_it {
                let Robot::Agv(agv) = &layout.robots[index] else { panic!("{busiest} is a vehicle") };
                left.push(seen(agv, &layout, &demands));
            }
        }
    });
    let begun = begun.expect("a run that begins");
    let (tray, source) = (begun.parameters.as_tray, begun.parameters.as_source);

    // Both do the same, in every scan.
    let (mut agv, mut vehicle) = (begun.clone(), Vehicle::new(begun.parameters));
    for (scan, (found, left)) in found.iter().zip(&left).enumerate() {
        let mut now = found.clone();
        vehicle.step(&now.inputs, &mut now.tray, &mut now.source, &now.demand);
        agv.inputs = found.inputs;
        layout.cells.tray[tray] = found.tray.clone();
        layout.cells.source[source] = found.source.clone();
        demands.iter().zip(&found.demand).for_each(|(&row, cells)| layout.cells.demand[row] = cells.clone());
        agv.step(&layout.wiring, &mut layout.cells).expect("a step without a fault");
        let by_hand = (&now.tray, &now.source, vehicle.cmd, vehicle.verb, vehicle.goal);
        let outputs = agv.outputs;
        assert_eq!(
            by_hand,
            (&left.tray, &left.source, outputs.cmd, outputs.verb, outputs.goal),
            "step {scan}"
        );
        assert_eq!((&layout.cells.tray[tray], &layout.cells.source[source]), (&left.tray, &left.source));
    }

    // Where nothing is written a step may be made again and again; elsewhere it is made once.
    let again: Vec<usize> = (found.iter().zip(&left))
        .map(|(found, left)| if found.is_left_alone(left) { AGAIN } else { 1 })
        .collect();
    let steps: usize = again.iter().sum();
    let mut least = [f64::INFINITY; 4];
    for _ in 0..ROUNDS {
        for (part, is_stepped) in [(0, false), (1, true)] {
            let mut agv = begun.clone();
            let seconds = timed(|| {
                for (found, &again) in found.iter().zip(&again) {
                    agv.inputs = found.inputs;
                    put(&mut layout, &begun, &demands, found);
                    for _ in 0..if is_stepped { again } else { 0 } {
                        // As the scan does, this looks at whether there is a fault, and copies none.
                        black_box(black_box(&mut agv).step(&layout.wiring, &mut layout.cells).is_ok());
                    }
                    black_box(&layout.cells);
                }
            });
            least[part] = least[part].min(seconds);
        }
        for (part, is_stepped) in [(2, false), (3, true)] {
            let mut vehicle = Vehicle::new(begun.parameters);
            let mut now = found[0].clone();
            let seconds = timed(|| {
                for (found, &again) in found.iter().zip(&again) {
                    now.clone_from(found);
                    for _ in 0..if is_stepped { again } else { 0 } {
                        let Found { inputs, tray, source, demand, .. } = black_box(&mut now);
                        black_box(&mut vehicle).step(inputs, tray, source, demand);
                    }
                    black_box(&now);
                }
            });
            least[part] = least[part].min(seconds);
        }
    }
    let each = |seconds: f64| seconds / steps as f64 * 1e9;
    let (generated, by_hand) = (each(least[1] - least[0]), each(least[3] - least[2]));
    let waiting = again.iter().filter(|&&again| again == AGAIN).count();
    println!(
        "\na step of {busiest}, {} steps of the run, in {waiting} of them nothing is written; the same cells and \
         outputs after each\n  generated  {generated:6.2} ns\n  by hand    {by_hand:6.2} ns\n  ratio      {:6.2}",
        found.len(),
        generated / by_hand
    );
}

impl Found {
    fn is_left_alone(&self, left: &Found) -> bool {
        self.tray == left.tray
            && self.source == left.source
            && self.command == left.command
            && self.state == left.state
    }
}

fn seen(agv: &Agv, layout: &Layout, demands: &[controllers::cells::DemandRef]) -> Found {
    Found {
        inputs: agv.inputs,
        state: agv.state,
        command: agv.outputs.cmd,
        tray: layout.cells.tray[agv.parameters.as_tray].clone(),
        source: layout.cells.source[agv.parameters.as_source].clone(),
        demand: demands.iter().map(|&row| layout.cells.demand[row].clone()).collect(),
    }
}

/// The cells as they were found.
fn put(layout: &mut Layout, agv: &Agv, demands: &[controllers::cells::DemandRef], found: &Found) {
    layout.cells.tray[agv.parameters.as_tray].clone_from(&found.tray);
    layout.cells.source[agv.parameters.as_source].clone_from(&found.source);
    for (&row, cells) in demands.iter().zip(&found.demand) {
        layout.cells.demand[row].clone_from(cells);
    }
}
