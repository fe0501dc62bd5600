//! Cylinders and processes: what the simulator does is what their contracts allow.

use autogen::executor::Executor;
use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, End, explore};
use autogen_search::model::Model;
use autogen_search::plant::{Faults, Watch};
use autogen_search::stroke::position;
use autogen_search::successor::Orders;
use autogen_search::value::Var;
use autogen_tests::searched::Common;
use autogen_tests::{Texts, side_by_side};
use runtime_sim::line::{IoDelay, Line};
use runtime_sim::random::Random;
use runtime_sim::run::{Stepping, run};
use runtime_sim::wiring::Source;
use std::collections::HashSet;

/// A switch: where the controller reads it, and where the search has it.
struct Switch {
    machine: usize,
    word: usize,
    var: Var,
    is: i32,
}

fn switches(line: &Line, model: &Model) -> Vec<Switch> {
    let mut found = Vec::new();
    let kinds = line.kinds.len();
    let mut add = |machine: usize, part: usize, signal: usize, var: Var, is: i32| {
        let wiring = &line.machines[machine].wiring;
        let word = wiring.input_at(Source::Signal { part, signal }, kinds);
        found.extend(word.map(|word| Switch { machine, word, var, is }));
    };
    for cylinder in &model.cylinders {
        add(cylinder.machine, cylinder.part, 0, cylinder.position, position::IN);
        add(cylinder.machine, cylinder.part, 1, cylinder.position, position::OUT);
    }
    for process in &model.processes {
        add(process.machine, process.part, 0, process.runs, 1);
        add(process.machine, process.part, 1, process.ended, 1);
    }
    found
}

/// With a bus that is late too: each scan is a state that the search reached, with all its switches.
fn stays_within(name: &str, texts: &Texts, delays: &[IoDelay]) -> usize {
    let project = texts.project();
    let mut model = model(&project, &Asked::with(Faults::All)).expect("a line that can be searched").model;
    assert!(!model.cylinders.is_empty(), "{name} has no cylinder that its automaton looks at");
    model.watch = Watch::Faults;
    let memory = 1_000_000_000;
    let bounds = Bounds {
        answers: None,
        orders: Orders::One,
        time: None,
        memory,
        states: usize::MAX,
        violations: usize::MAX,
        jobs: 1,
    };
    let outcome = explore(&model, &bounds, &mut |_| true);
    assert_eq!(outcome.end, End::Complete, "{name}");
    let common = Common::new(&project, &model);
    let switches = switches(&project.plant, &model);
    let of_state = |state: &[u8]| {
        let mut values = common.of_state(state);
        values.extend(switches.iter().map(|switch| i32::from(switch.var.load(state) == switch.is)));
        values
    };
    let reached = (0..outcome.reached.len()).map(|state| of_state(&outcome.reached.state(state)));
    let reached: HashSet<Vec<i32>> = reached.collect();
    let (mut scans, mut met) = (0, HashSet::new());
    for io_delay in delays {
        let mut line = project.plant.clone();
        line.scenario.time_limit_s = line.scenario.time_limit_s.min(600.0);
        line.io_delay = io_delay.clone();
        // Pauses are not searched.
        line.scenario.pauses.clear();
        let mut outside = None;
        run(&line, &mut Executor::new(&project.system), Stepping::Events, &mut |seen| {
            scans += 1;
            let mut values = common.of_trace(seen.trace);
            let is_on = |switch: &Switch| seen.inputs[switch.machine][switch.word] != 0.0;
            values.extend(switches.iter().map(|switch| i32::from(is_on(switch))));
            if seen.answer.running {
                if outside.is_none() && !reached.contains(&values) {
                    outside = Some((seen.scan, common.difference(&values, &reached)));
                }
                met.insert(values);
            }
        })
        .expect("a line that can be run");
        assert_eq!(outside, None, "{name}, {io_delay:?}");
    }
    println!(
        "{name}: {} states, {} transitions; {scans} simulated scans with {} different values of {}",
        outcome.covered.states,
        outcome.covered.transitions,
        met.len(),
        reached.len()
    );
    met.len()
}

/// Delays of the bus; the last one lets a motion that is shorter than its differences pass unseen.
const DELAYS: [IoDelay; 3] = [IoDelay::Fixed(0), IoDelay::Fixed(3), IoDelay::Random { max: 5, seed: 7 }];

/// Lines with cylinders whose inputs can be searched.
const SCENES: [&str; 4] = ["elevator", "lifting_table", "separating_station", "sorting_by_height"];

#[test]
fn simulated_strokes_stay_within_the_states() {
    for name in SCENES {
        assert!(stays_within(name, &side_by_side(&format!("scenes/{name}")), &DELAYS) >= 8, "{name}");
    }
    assert!(stays_within("sorting", &side_by_side("sorting/sorting"), &DELAYS) >= 5);
}

/// A cylinder whose valves a person switches. Its controller remembers what it was two scans before, so that the order in
/// which things happen is compared too.
fn rig(cylinder: &str, has_retract: bool, presses: &[String]) -> Texts {
    let (port, update) = match has_retract {
        true => ("out inwards: bool = slide.retract stop false;", "inwards := second_key;"),
        false => ("", ""),
    };
    let text = format!(
        "device rig {{
            part slide = cylinder {{ {cylinder} }};
            part outer = button {{}};
            part inner = button {{}};
            part plate = body {{ low: pose; high: pose + point(0.1, 0.1, 0.1); }};
            in is_in: bool = slide.is_in;
            in is_out: bool = slide.is_out;
            in first_key: bool = outer.on;
            in second_key: bool = inner.on;
            out outwards: bool = slide.extend stop false;
            {port}
        }}
        automaton Rig on rig {{
            local in_now: bool := false;
            local in_before: bool := false;
            local out_now: bool := false;
            local out_before: bool := false;
            local sent_now: bool := false;
            local sent_before: bool := false;
            local back_now: bool := false;
            local back_before: bool := false;
            invariant not (in_now and out_now) and not (in_before and out_before);
            invariant sent_before and back_before or not (sent_before and back_before);
            initial -> Following {{}}
            state Following {{
                when is_in or not is_in {{
                    in_before := in_now; in_now := is_in;
                    out_before := out_now; out_now := is_out;
                    sent_before := sent_now; sent_now := first_key;
                    back_before := back_now; back_now := second_key;
                    outwards := first_key; {update}
                }}
            }}
        }}"
    );
    Texts {
        layout: r#"{"robots": [{"name": "rig", "type": "rig", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![text],
        scenario: Some(format!(r#"{{"time_limit_s": 60, "operator": [{}]}}"#, presses.join(", "))),
        ..Texts::default()
    }
}

/// Valves are switched at any time, also while it moves and twice within the delay of the bus.
#[test]
fn a_cylinder_whose_valves_are_switched_at_random_stays_within_its_contract() {
    let mut random = Random::new(3);
    let strokes =
        [("extend: 300 ms; retract: 200 ms;", &DELAYS[..]), ("extend: 10 ms; retract: 20 ms;", &DELAYS[..2])];
    for (times, delays) in strokes {
        for (centre, has_retract) in [("", false), ("", true), ("closed_centre: true;", true)] {
            for begins in ["", "begins_out: true;"] {
                let mut presses = Vec::new();
                for part in ["outer", "inner"] {
                    let mut at_ms = 500;
                    while at_ms < 55_000 {
                        let for_ms = 10 + random.up_to(30) * 10;
                        let (at_s, for_s) = (f64::from(at_ms) / 1000.0, f64::from(for_ms) / 1000.0);
                        presses.push(format!(
                            r#"{{"robot": "rig", "part": "{part}", "at_s": {at_s}, "for_s": {for_s}}}"#
                        ));
                        at_ms += for_ms + 10 + random.up_to(60) * 10;
                    }
                }
                let cylinder = format!("{times} {centre} {begins}");
                assert!(
                    stays_within(&cylinder, &rig(&cylinder, has_retract, &presses), delays) >= 20,
                    "{cylinder}"
                );
            }
        }
    }
}
