//! Faults of the plant at random times, on the lines of the examples.
//!
//! The long form: `AUTOGEN_CAMPAIGN=full cargo test --profile optimized -p autogen-tests fault_campaign:: -- --nocapture`.

use autogen::executor::Executor;
use autogen_tests::{Texts, examples, is_full_campaign, on_all_processors};
use runtime_sim::device::PortType;
use runtime_sim::line::{During, IoDelay, Jam, Line, Pause, SlowCycle, Stuck};
use runtime_sim::memory::Memory;
use runtime_sim::random::Random;
use runtime_sim::report::Report;
use runtime_sim::run::{Stepping, run_again};
use runtime_sim::scan::Controllers;
use runtime_sim::wiring::Source;
use std::collections::BTreeMap;

/// Orders, and time, s, of a run.
const MOST_ORDERS: usize = 1;
const LONGEST_S: f64 = 400.0;

/// A draw that has found an input which changed in a scan that was left out: a gripper with a sensor that sticks takes
/// an item off a lane.
const ONCE_WRONG: [(&str, u64); 1] = [("palletizer", 22)];

/// Faults of one run.
fn draw(line: &mut Line, random: &mut Random, scans: u64) {
    for _ in 0..=random.up_to(2) {
        let during = During {
            at_scan: random.next_u64() % scans,
            scans: (random.up_to(3) > 0).then(|| 1 + u64::from(random.up_to(2500))),
        };
        let machine = random.up_to(line.machines.len() as u32 - 1) as usize;
        match random.up_to(5) {
            0..=2 => line.scenario.sensors.extend(sensor(line, random, machine, during)),
            3..=4 => line.scenario.jams.extend(jam(line, random, machine, during)),
            _ => line.scenario.slow.extend(slow_cycle(line, random)),
        }
    }
    if random.up_to(3) == 0 {
        line.io_delay = IoDelay::Random { max: 4, seed: random.next_u64() };
    }
    if random.up_to(3) == 0 {
        let pause = Pause { at_scan: random.next_u64() % scans, scans: 1 + u64::from(random.up_to(900)) };
        let all =
            if random.up_to(1) == 0 { &mut line.scenario.pauses } else { &mut line.scenario.power_offs };
        all.push(pause);
    }
}

fn sensor(line: &Line, random: &mut Random, machine: usize, during: During) -> Option<Stuck> {
    let (of, kinds) = (&line.machines[machine], line.kinds.len());
    let last = of.wiring.inputs.len().checked_sub(1)?;
    let number = random.up_to(last as u32) as usize;
    let input = &of.wiring.inputs[number];
    let ty = match input.source {
        Source::Signal { part, signal } => of.parts[part].schema().signals[signal].ty,
        Source::Ready => PortType::Bool,
        Source::Got | Source::Ack => PortType::Int { lo: 0, hi: 32_767 },
        Source::Error => PortType::Int { lo: 0, hi: 255 },
    };
    let value = match ty {
        PortType::Bool => f64::from(random.up_to(1)),
        PortType::Int { lo, hi } => {
            let range = (i64::from(hi) - i64::from(lo)).min(20) as u32;
            f64::from(lo.max(-3)) + f64::from(random.up_to(range))
        }
        PortType::Real => f64::from(random.up_to(2000)) / 1000.0 - 0.5,
        PortType::Point => return None,
    };
    let first: usize = of.wiring.inputs[..number].iter().map(|input| input.size.words(kinds)).sum();
    let all = input.size.words(kinds);
    let (word, words) = match random.up_to(1) {
        0 => (first, all),
        _ => (first + random.up_to(all as u32 - 1) as usize, 1),
    };
    Some(Stuck { machine, word, words, value, during })
}

fn jam(line: &Line, random: &mut Random, machine: usize, during: During) -> Option<Jam> {
    let parts = line.machines[machine].parts.iter().enumerate();
    let parts: Vec<usize> = parts.filter(|(_, part)| part.schema().can_jam).map(|(part, _)| part).collect();
    let last = parts.len().checked_sub(1)?;
    Some(Jam { machine, part: parts[random.up_to(last as u32) as usize], during })
}

/// Of the first process of the line.
fn slow_cycle(line: &Line, random: &mut Random) -> Option<SlowCycle> {
    let mut all = line.machines.iter().enumerate().flat_map(|(machine, of)| {
        let parts = of.parts.iter().enumerate();
        parts.filter(|(_, part)| part.schema().name == "process").map(move |(part, _)| (machine, part))
    });
    let (machine, part) = all.next()?;
    Some(SlowCycle {
        machine,
        part,
        cycle: 1 + random.up_to(2),
        longer_s: f64::from(1 + random.up_to(30_000)) / 1000.0,
    })
}

/// How a run ended, in a word.
fn ending(report: &Report) -> &'static str {
    let is = |start: &str| report.reason.starts_with(start);
    match report.finished {
        true => "goal reached",
        false if is("fault") => "fault",
        false if is("collision") => "collision",
        false if is("interlock") => "interlock",
        false if is("deadlock") => "nothing changes",
        false if is("time limit") => "time limit",
        false if report.reason.contains("has collected more") => "wrong sink",
        false => panic!("a run ended for no known reason: {}", report.reason),
    }
}

#[test]
fn whatever_fails_a_run_ends_for_a_reason_and_steppings_agree() {
    let draws = if is_full_campaign() { 60 } else { 3 };
    let lines = examples();
    let is_drawn = |name: &str, seed: u64| seed < draws || ONCE_WRONG.contains(&(name, seed));
    let cases: Vec<(&(String, Texts), u64)> = lines
        .iter()
        .flat_map(|line| (0..60).filter(move |seed| is_drawn(&line.0, *seed)).map(move |seed| (line, seed)))
        .collect();
    let endings = on_all_processors(&cases, |((name, texts), seed)| {
        let project = texts.project();
        let mut line = project.plant.clone();
        line.scenario.orders.truncate(MOST_ORDERS);
        line.scenario.time_limit_s = line.scenario.time_limit_s.min(LONGEST_S);
        let execute = |line: &Line, stepping| {
            let mut executor = Executor::new(&project.system);
            let executor: &mut dyn Controllers = &mut executor;
            run_again(line, executor, stepping, &mut Memory::default(), &mut |_| {})
                .unwrap_or_else(|error| panic!("{name}, {seed}: {error}"))
        };
        let usual = execute(&line, Stepping::Events);
        let mut random = Random::at(2026, [*seed, name.len() as u64]);
        draw(&mut line, &mut random, usual.scans);
        assert_eq!(Line::from_text(&line.to_text()).as_ref(), Ok(&line), "{name}, {seed}");
        let faults = format!("{:?} {:?} {:?}", line.scenario.sensors, line.scenario.jams, line.scenario.slow);
        let every = execute(&line, Stepping::EveryScan);
        for stepping in [Stepping::Events, Stepping::Checked] {
            assert_eq!(execute(&line, stepping), every, "{name}, {seed}, {stepping:?}: {faults}");
        }
        println!("{name}, {seed}: {}", every.reason);
        ending(&every)
    });
    let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
    endings.iter().for_each(|ending| *counts.entry(ending).or_default() += 1);
    println!("{counts:?}");
    // Some faults are caught, and some do no harm.
    assert!(counts.get("fault").is_some_and(|count| *count * 20 >= cases.len()), "{counts:?}");
    assert!(counts.get("goal reached").is_some_and(|count| *count * 20 >= cases.len()), "{counts:?}");
}
