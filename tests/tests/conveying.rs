//! Items on conveyors: what a calculation by hand says, and the same from event to event as with every scan, whatever the
//! lengths and times are.

use autogen::executor::Executor;
use autogen_tests::{Texts, is_full_campaign, on_all_processors, scenes};
use runtime_sim::memory::Memory;
use runtime_sim::random::Random;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, record, run_again};

/// The report of a run, which is the same however it is stepped; none if the texts are no line.
fn run(texts: &Texts) -> Option<Result<Report, String>> {
    let project = texts.compile().project?;
    let execute = |stepping| {
        let (mut executor, mut memory) = (Executor::new(&project.system), Memory::default());
        run_again(&project.plant, &mut executor, stepping, &mut memory, &mut |_| {})
    };
    let all = [Stepping::Checked, Stepping::EveryScan, Stepping::Events].map(execute);
    let [checked, every, events] = all;
    Some(checked.and_then(|_| {
        let (every, events) = (every?, events?);
        if events == every { Ok(every) } else { Err(format!("{events:#?}\nbut with every scan {every:#?}")) }
    }))
}

/// Two conveyors with a gap between, and how far the second stands below the first.
fn with_gap(gap: f64, step: f64) -> Texts {
    let device = format!(
        "device gap {{
            part first_lane = lane {{ from: origin * frame(0, 0, 0.7, 0); length: 1.0; width: 0.4; speed: 0.5; }};
            part entry = source {{ on: first_lane; inset: 0.2; }};
            part second_lane = lane {{
                from: origin * frame(1.0 + {gap:?}, 0, 0.7 - {step:?}, 0); length: 1.0; width: 0.4; speed: 0.25;
            }};
            part end = sink {{ of: second_lane; inset: 0; }};
            out run: bool = first_lane.run;
            out run_second: bool = second_lane.run;
        }}
        automaton Gap on gap {{
            initial -> Running {{ run := true; run_second := true; }}
            state Running {{ when false -> Running {{}} }}
        }}"
    );
    let scenario = r#"{
        "kinds": [{"name": "box", "height": 0.2, "size": [0.3, 0.3]}],
        "supply": {"items": ["box", "box"], "every_s": 3},
        "goal": {"gap.end": {"box": 2}}
    }"#;
    Texts {
        layout: r#"{"robots": [{"name": "gap", "type": "gap", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![device],
        scenario: Some(scenario.into()),
        ..Texts::default()
    }
}

/// The second box appears 6.02 s after the start and is at the end of the first conveyor 1.6 s later. It falls half of its
/// length farther and goes on with the second conveyor, from that moment on.
#[test]
fn what_falls_on_a_conveyor_goes_on_with_it_at_once() {
    for (gap, step) in [(0.006, 0.0), (0.1, 0.0), (0.006, 0.3)] {
        let report = run(&with_gap(gap, step)).expect("a line").expect("the same however it is stepped");
        let seconds = 6.02 + 0.8 / 0.5 + (1.0 - (0.15 - gap)) / 0.25;
        assert_eq!(report.reason, "all items collected");
        assert!((report.simulated_s - seconds).abs() <= 0.011, "{} s, not {seconds} s", report.simulated_s);
    }
}

/// An item comes from one place only, and nothing is seen or stopped where there is no conveyor.
/// The second conveyor carries the first box 0.25 * 3 m on until the second one comes down, more than its length; at 0.05 m/s
/// it carries it 0.15 m on, and at 0.11 m/s 0.33 m.
#[test]
fn what_falls_onto_an_item_on_a_conveyor_ends_the_run() {
    let reason = |speed: &str, at: &str| {
        let mut texts = with_gap(0.0, 0.3);
        let device = texts.specs[0].replace("speed: 0.25", speed).replace("0.7 - 0.3, 0", at);
        assert_ne!(device, texts.specs[0]);
        texts.specs[0] = device;
        run(&texts).expect("a line that can be compiled").expect("a line that can be run").reason
    };
    let at = "0.7 - 0.3, 0";
    let below = "0.7 - 0.3, 90";
    assert_eq!(reason("speed: 0.25 ", at), "all items collected");
    let touches = "interlock of gap: box_2 comes down on box_1, which lies on a conveyor";
    assert_eq!(reason("speed: 0.05", at), touches);
    assert_eq!(reason("speed: 0.0999", at), touches);
    assert_eq!(reason("speed: 0.11", at), "all items collected");
    // The second one lies across the first one, which is 0.3 m wide.
    assert_eq!(reason("speed: 0.11", below), "all items collected");
    assert_eq!(reason("speed: 0.05", below), touches);
}

#[test]
fn devices_whose_parts_cannot_be_there_are_refused() {
    let refused = |part: &str| {
        let mut texts = with_gap(0.0, 0.0);
        texts.specs[0] = texts.specs[0].replacen("out run:", &format!("{part} out run:"), 1);
        let outcome = texts.compile();
        assert!(outcome.project.is_none(), "{part}");
        outcome.diagnostics.iter().map(|found| found.message.clone()).collect::<Vec<_>>().join("; ")
    };
    let pin = "part pin = cylinder { extend: 100 ms; retract: 100 ms; };";
    for (part, message) in [
        ("part other = source { on: second_lane; inset: 0.2; };", "two parts are a source"),
        (
            "part eye = beam { across: first_lane; at: 1.2; };",
            "eye is 1.200 m from the beginning of a lane of 1.000 m",
        ),
        (
            "part scale = gauge { across: first_lane; at: -0.1; };",
            "scale is -0.100 m from the beginning of a lane of 1.000 m",
        ),
        (
            &format!("{pin} part gate = stopper {{ of: second_lane; at: 1.01; by: pin; }};"),
            "gate is 1.010 m from the beginning of a lane of 1.000 m",
        ),
    ] {
        let found = refused(part);
        assert_eq!(found, format!("`gap` cannot be built from its device: {message}"));
    }
}

/// The numbers with a decimal point and the times of a text, some of them by up to a third greater or less.
fn shaken(text: &str, random: &mut Random, one_in: u32) -> String {
    let mut shaken = String::new();
    let mut left = text;
    while let Some(begin) = left.find(|c: char| c.is_ascii_alphanumeric() || c == '_') {
        let (before, word) = left.split_at(begin);
        let is_number = word.starts_with(|c: char| c.is_ascii_digit());
        let in_word = |c: char| c.is_ascii_alphanumeric() || c == '_' || is_number && c == '.';
        let (word, after) = word.split_at(word.find(|c| !in_word(c)).unwrap_or(word.len()));
        shaken += before;
        let factor = 0.7 + 0.6 * f64::from(random.up_to(1000)) / 1000.0;
        match word.parse::<f64>() {
            Ok(number) if is_number && random.up_to(one_in - 1) == 0 => {
                let (is_time, number) = (after.starts_with(" ms"), number * factor);
                if is_time {
                    shaken += &format!("{}", number.round());
                } else if word.contains('.') {
                    shaken += &format!("{number:.3}");
                } else {
                    shaken += word;
                }
            }
            _ => shaken += word,
        }
        left = after;
    }
    shaken + left
}

/// Of each scene many that were built wrong: stoppers beyond the end, gaps, beams off the conveyor, pushers too early.
#[test]
fn scenes_that_are_built_wrong_are_stepped_right() {
    let rounds: u64 = if is_full_campaign() { 400 } else { 6 };
    let scenes = scenes();
    let is_long = |name: &str| matches!(name, "level_control" | "crossing_lights");
    let cases: Vec<_> = scenes.iter().filter(|(name, _)| !is_long(name)).collect();
    let wrong = on_all_processors(&cases, |(name, texts)| {
        let round = |round: u64| {
            let mut random = Random::new(round);
            let one_in = [10, 3, 1][(round % 3) as usize];
            let mut shake = |text: &str| shaken(text, &mut random, one_in);
            let specs = texts.specs.iter().map(|text| shake(text)).collect();
            let scenario = texts.scenario.as_deref().map(&mut shake).map(|text| {
                let limit = if text.contains("time_limit_s") { "{" } else { "{\"time_limit_s\": 100, " };
                text.replacen('{', limit, 1)
            });
            let texts = Texts { specs, scenario, ..texts.clone() };
            let error = run(&texts)?.err()?;
            Some(format!("{name}, round {round}: {error}\n{}", texts.specs.join("\n")))
        };
        (0..rounds).filter_map(round).collect::<Vec<_>>()
    });
    let wrong: Vec<String> = wrong.into_iter().flatten().collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// A lane on a table that turns while it conveys: a line, or an arc.
fn turned(arc: f64, moves: &str) -> Texts {
    let device = format!(
        "device table {{
            part rotor = cylinder {{ {moves} extend: 3 s; retract: 2 s; }};
            part bed = lane {{
                on: rotor; from: origin * frame(0, 0, 0.7, 0); length: 2.0; width: 0.4; turn: {arc:?}; rise: 0.2; speed: 0.5;
            }};
            part entry = source {{ on: bed; inset: 0.3; }};
            part end = sink {{ of: bed; inset: 0; }};
            out run: bool = bed.run;
            out out: bool = rotor.extend;
        }}
        automaton Table on table {{
            initial -> Running {{ run := true; }}
            state Running {{ when after 3 s -> Turning {{ out := true; }} }}
            state Turning {{ when after 1 s -> Halting {{ run := false; }} }}
            state Halting {{ when after 1 s -> Back {{ run := true; }} }}
            state Back {{ when after 500 ms -> Returning {{ out := false; }} }}
            state Returning {{ when after 3 s -> Running {{}} }}
        }}"
    );
    Texts {
        layout: r#"{"robots": [{"name": "table", "type": "table", "pose": [1, 2, 0, 30]}]}"#.into(),
        specs: vec![device],
        scenario: Some(
            r#"{
                "kinds": [{"name": "box", "height": 0.2, "size": [0.1, 0.1]}],
                "supply": {"items": ["box", "box", "box"], "every_s": 3},
                "goal": {"table.end": {"box": 3}}
            }"#
            .into(),
        ),
        ..Texts::default()
    }
}

/// At the start of each scan the recorded paths are where the simulator has the items.
#[test]
fn recorded_paths_are_where_the_items_are() {
    let slides = "slides: point(0.3, 0.1, 0.4);";
    let turns = "turns: 90; pivot: origin * point(1, 0, 0);";
    let mut lines = Vec::new();
    for arc in [0.0, 120.0] {
        lines.extend([slides, turns].map(|moves| (format!("{arc} {moves}"), turned(arc, moves))));
    }
    lines.extend(scenes());
    for (name, texts) in lines {
        let outcome = texts.compile();
        let project = outcome.project.unwrap_or_else(|| panic!("{name}: {:?}", outcome.diagnostics));
        let mut seen = Vec::new();
        let mut observe = |scan: &Seen| {
            let items = scan.plant.items().all();
            let places: Vec<_> =
                items.iter().enumerate().map(|(i, item)| (item.carrier, scan.plant.place(i))).collect();
            seen.push((scan.scan * u64::from(project.plant.scan_ms), places));
        };
        let mut executor = Executor::new(&project.system);
        let recorded = record(&project.plant, &mut executor, Stepping::EveryScan, &[], &mut observe).unwrap();
        let mut compared = 0;
        for (ms, places) in seen {
            for (path, (carrier, place)) in recorded.paths.iter().zip(places) {
                let Some(place) = place else { continue };
                let at = path.at(ms as f64).find(|segment| segment.carrier == carrier);
                let at = at.unwrap_or_else(|| panic!("{name}: nothing on {carrier:?} at {ms} ms: {path:?}"));
                let off = (at.place(ms as f64) - place).length();
                assert!(off < 1e-8, "{name}: {off} m off at {ms} ms: {at:?}, {place:?}");
                compared += 1;
            }
        }
        assert!(compared > 1000 || recorded.paths.is_empty(), "{name}: {compared} places");
    }
}
