//! Items on conveyors: what a calculation by hand says, and the same from event to event as with every scan, whatever the
//! lengths and times are.

use autogen::executor::Executor;
use autogen_tests::{Texts, is_full_campaign, on_all_processors, scenes};
use runtime_sim::memory::Memory;
use runtime_sim::path::Path;
use runtime_sim::point::Point;
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

/// A belt of full speed 0.4 m/s whose box appears at 2.02 s, 0.2 m from its beginning. `rate` is set by these transitions
/// after this.
fn at_rates(lane: &str, outputs: &str, states: &str) -> Texts {
    let device = format!(
        "device unit {{
            part bed = lane {{ from: origin * frame(0, 0, 0.7, 0); length: 2.0; width: 0.4; speed: 0.4; }};
            {lane}
            part entry = source {{ on: bed; inset: 0.2; }};
            part eye = beam {{ across: bed; at: 1.0; }};
            out rate: real = bed.run_by stop 0;
            in passes: bool = eye.sees;
            {outputs}
        }}
        automaton Unit on unit {{ {states} }}"
    );
    let scenario = r#"{"kinds": [{"name": "box", "height": 0.2, "size": [0.3, 0.3]}],
        "supply": {"items": ["box", "box"], "every_s": 2}, "goal": {"unit.end": {"box": 2}}, "time_limit_s": 60}"#;
    Texts {
        layout: r#"{"robots": [{"name": "unit", "type": "unit", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![device],
        scenario: Some(scenario.into()),
        ..Texts::default()
    }
}

/// Boxes appear at 2.02 s and 4.02 s in a run that starts at 0.02 s and never stands, whatever the speed.
#[test]
fn a_conveyor_runs_at_the_rate_of_its_level() {
    let end = "part end = sink { of: bed; inset: 0; };";
    let reaches = |states: &str, seconds: f64| {
        let report =
            run(&at_rates(end, "", states)).expect("a line").expect("the same however it is stepped");
        assert_eq!(report.reason, "all items collected", "{states}");
        assert!((report.simulated_s - seconds).abs() <= 0.011, "{} s, not {seconds} s", report.simulated_s);
    };
    let always = |rate: &str| format!("initial -> Runs {{ rate := {rate}; }} final state Runs;");
    reaches(&always("1.0"), 4.02 + 1.8 / 0.4);
    reaches(&always("0.5"), 4.02 + 1.8 / 0.2);
    reaches(&always("7.5"), 4.02 + 1.8 / 0.4);
    // From 6.02 s on at a quarter.
    let slower = "initial -> Runs { rate := 0.5; } state Runs { when after 6 s -> Slow { rate := 0.25; } }
        final state Slow;";
    reaches(slower, 6.02 + (1.8 - 2.0 * 0.2) / 0.1);
    // From 6.02 s to 9.02 s it stands: a rate below 0 is none.
    let stands = "initial -> Runs { rate := 0.5; } state Runs { when after 6 s -> Stands { rate := -1.0; } }
        state Stands { when after 3 s -> Again { rate := 1.0; } } final state Again;";
    reaches(stands, 9.02 + (1.8 - 2.0 * 0.2) / 0.4);
    // A ramp of 0.01 in each scan for 1 s, from 5.02 s on.
    let ramp = "local n: int 0..100 := 0; local r: real := 0.0;
        initial -> Runs { rate := 0.0; }
        state Runs { when after 5 s -> Ramp {} }
        state Ramp { when n < 100 -> Ramp { n := n + 1; r := r + 0.01; rate := r; } }";
    let report = run(&at_rates(end, "", ramp)).expect("a line").expect("the same however it is stepped");
    // It stood for the first 5 s, so the boxes came 2 s and 4 s after that.
    let seconds = 5.02 + 4.0 + 1.8 / 0.4;
    assert!((report.simulated_s - seconds).abs() <= 0.03, "{} s, not {seconds} s", report.simulated_s);
}

/// With `run` or commands the rate acts while these let it run.
#[test]
fn a_rate_acts_while_the_conveyor_runs() {
    let end = "part end = sink { of: bed; inset: 0; };";
    let seconds = |outputs: &str, states: &str| {
        let report =
            run(&at_rates(end, outputs, states)).expect("a line").expect("the same however it is stepped");
        assert_eq!(report.reason, "all items collected");
        report.simulated_s
    };
    let by_level = seconds(
        "out run: bool = bed.run stop false;",
        "initial -> Waits { rate := 0.5; } state Waits { when after 10 s -> Runs { run := true; } } final state Runs;",
    );
    let by_command = seconds(
        "command 1 go() = bed.run();",
        "initial -> Waits { rate := 0.5; } state Waits { when after 10 s -> Runs { go(); } } final state Runs;",
    );
    for found in [by_level, by_command] {
        assert!((found - (10.02 + 4.0 + 1.8 / 0.2)).abs() <= 0.011, "{found}");
    }
}

/// A belt that slows down lets the boxes of the one before it close up, and pulls them apart when it is fast again.
#[test]
fn items_keep_to_what_the_conveyor_after_theirs_does() {
    let lane =
        "part next = lane { from: origin * frame(2.0, 0, 0.7, 0); length: 2.0; width: 0.4; speed: 0.4; };
        part end = sink { of: next; inset: 0; };";
    let outputs = "out next_rate: real = next.run_by stop 0;";
    let states = "initial -> Runs { rate := 1.0; next_rate := 0.25; }
        state Runs { when after 14 s -> Fast { next_rate := 1.0; } } final state Fast;";
    let report =
        run(&at_rates(lane, outputs, states)).expect("a line").expect("the same however it is stepped");
    assert_eq!(report.reason, "all items collected");
    // The first box is over the joint at 6.52 s, at 0.1 m/s from then on. The second one comes up to it, 0.3 m behind, and
    // goes on with it: at 14.02 s it is 0.75 - 0.3 m behind the joint.
    let seconds = 14.02 + (2.0 - 0.45) / 0.4;
    assert!((report.simulated_s - seconds).abs() <= 0.02, "{} s, not {seconds} s", report.simulated_s);
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
        (
            "part bin = sink { of: second_lane; inset: 0.3; };",
            "end and bin are both a sink of second_lane: one of them takes all items",
        ),
        (
            "part low = lane { from: origin * frame(5, 0, 0.1, 0); length: 1; rise: -0.3; width: 0.4; speed: 0.5; };",
            "low ends 0.200 m below the floor",
        ),
        (
            "part box = sink { of: first_lane; inset: 1.2; };",
            "box is 1.200 m from the end of a lane of 1.000 m",
        ),
        (
            "part box = sink { of: first_lane; inset: -0.1; };",
            "box is -0.100 m from the end of a lane of 1.000 m",
        ),
    ] {
        let found = refused(part);
        assert_eq!(found, format!("`gap` cannot be built from its device: {message}"));
    }
    for (inset, at) in [("1.1", "1.100"), ("-0.2", "-0.200")] {
        let mut texts = with_gap(0.0, 0.0);
        texts.specs[0] = texts.specs[0].replacen("inset: 0.2", &format!("inset: {inset}"), 1);
        let found = &texts.compile().diagnostics[0];
        let message = format!("entry is {at} m from the beginning of a lane of 1.000 m");
        assert_eq!((found.code, found.message.ends_with(&message)), ("E0711", true), "{}", found.message);
    }
}

/// Both middle lines may be 0.4 m apart, half of both widths, and 0.1 m more for the frames.
#[test]
fn what_is_pushed_comes_onto_a_lane_that_begins_beside() {
    let found = |part: &str, side: &str| {
        let mut texts = with_branch(part, "1 s");
        texts.specs[0] = texts.specs[0].replace("frame(0.95, -0.2, 0.7, -90)", side);
        let outcome = texts.compile();
        outcome
            .diagnostics
            .into_iter()
            .map(|found| (found.code, found.message, found.help))
            .collect::<Vec<_>>()
    };
    let pusher = "pusher { of: bed; at: 0.95; width: 0.3;";
    let diverter = "diverter { of: bed; at: 1.05;";
    for side in ["frame(0.95, -0.5, 0.7, -90)", "frame(0.95, 0.3, 0.2, 0)", "frame(0.95, -0.2, 0.705, 0)"] {
        assert_eq!(found(pusher, side), [], "{side}");
    }
    let side = "frame(1.35, -0.4, 0.7, -90)";
    assert_eq!(found(diverter, side), [], "{side}");
    for (part, side, message) in [
        (
            pusher,
            "frame(0.95, -0.51, 0.7, -90)",
            "plate at (0.950, 0.000, 0.700) brings items onto side, which begins at (0.950, -0.510, 0.700), 0.510 m beside it: 0.500 m are the most",
        ),
        (
            diverter,
            "frame(-5, 6, 1.9, 90)",
            "plate at (1.050, 0.000, 0.700) brings items onto side, which begins at (-5.000, 6.000, 1.900), 8.521 m beside it: 0.500 m are the most",
        ),
        (
            pusher,
            "frame(0.95, -0.2, 0.72, -90)",
            "plate at (0.950, 0.000, 0.700) brings items onto side, which begins at (0.950, -0.200, 0.720), 0.020 m higher: 0.005 m are the most",
        ),
    ] {
        let found = found(part, side);
        let fix = "let the other lane begin beside the place at `at`, and no higher; or change `at`";
        let message = format!("`rig` cannot be built from its device: {message}");
        assert_eq!(found, [("E0711", message, fix.to_string())], "{side}");
    }
}

#[test]
fn a_conveyor_rises_by_less_than_its_length() {
    for (rise, told) in [("1.2", "1.200"), ("-1.0", "-1.000")] {
        let mut texts = with_gap(0.0, 0.0);
        texts.specs[0] = texts.specs[0].replacen("length: 1.0", &format!("length: 1.0; rise: {rise}"), 1);
        let found: Vec<_> = texts.compile().diagnostics.into_iter().map(|f| (f.code, f.message)).collect();
        let message = format!("it rises by {told} m over a length of 1.000 m along its middle line");
        assert!(matches!(&found[..], [("E0704", told)] if told.ends_with(&message)), "{found:?}");
    }
}

#[test]
fn nothing_is_pushed_onto_its_own_lane() {
    let mut texts = with_branch("pusher { of: bed; at: 0.95; width: 0.3;", "1 s");
    texts.specs[0] = texts.specs[0].replace("onto: side", "onto: bed");
    let messages: Vec<_> = texts.compile().diagnostics.into_iter().map(|found| found.message).collect();
    assert_eq!(messages, ["`rig` cannot be built from its device: plate brings items from bed onto bed"]);
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
    let mut cases: Vec<_> = scenes.into_iter().filter(|(name, _)| !is_long(name)).collect();
    cases.extend([
        ("diverter".into(), with_branch("diverter { of: bed; at: 1.05;", "1 s")),
        ("pusher".into(), with_branch("pusher { of: bed; at: 0.95; width: 0.6;", "10 s")),
        ("narrow pusher".into(), with_pusher(8500, "8.802")),
        ("joint".into(), with_joint("1.51")),
        ("source at a joint".into(), with_source_at_joint(4400)),
    ]);
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

/// Three boxes, the second and the third without a gap. The first one stands over a joint, until its conveyor starts again
/// after so many milliseconds: about when the others come up to it.
fn with_stop(wait: u32) -> Texts {
    let device = format!(
        "device twin {{
            part inlet = lane {{ from: origin; length: 1.0; width: 0.2; speed: 0.299; }};
            part outlet = lane {{ from: origin * frame(1, 0, 0, 0); length: 1.0; width: 0.2; speed: 0.3; }};
            part magazine = source {{ on: inlet; inset: 0.1; }};
            part box = sink {{ of: outlet; inset: 0.1; }};
            out run_inlet: bool = inlet.run stop false;
            out run_outlet: bool = outlet.run stop false;
            out release: bool = magazine.release stop false;
        }}
        automaton Twin on twin {{
            initial -> First {{ run_inlet := true; run_outlet := true; release := true; }}
            state First {{ when after 1 s -> Between {{ release := false; }} }}
            state Between {{ when after 20 ms -> Second {{ release := true; }} }}
            state Second {{ when after 20 ms -> Again {{ release := false; }} }}
            state Again {{ when after 20 ms -> Third {{ release := true; }} }}
            state Third {{ when after 2040 ms -> Standing {{ run_outlet := false; }} }}
            state Standing {{ when after {wait} ms -> Going {{ run_outlet := true; }} }}
            state Going {{ when false -> Going {{}} }}
        }}"
    );
    let robots = r#"{"name": "twin", "type": "twin", "pose": [0, 0, 0]}"#;
    let kinds = r#""kinds": [{"name": "box", "height": 0.1, "size": [0.1, 0.1]}]"#;
    line(
        &device,
        robots,
        &format!(r#"{{{kinds}, "supply": {{"items": ["box"], "times": 3}}, "time_limit_s": 6}}"#),
    )
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
    // What comes to rest within a scan may go on in the next one.
    lines.extend((600..800).step_by(10).map(|wait| (format!("a stop, {wait} ms"), with_stop(wait))));
    // Times that are no round numbers of seconds.
    let mut slow = with_stop(700);
    slow.layout = slow.layout.replacen('{', r#"{"scan_ms": 7, "#, 1);
    lines.push(("scans of 7 ms".into(), slow));
    for (name, texts) in lines {
        let outcome = texts.compile();
        let project = outcome.project.unwrap_or_else(|| panic!("{name}: {:?}", outcome.diagnostics));
        let mut seen = Vec::new();
        let mut observe = |scan: &Seen| {
            let items = scan.plant.items();
            // What lies on an item is on what bears that.
            let place = |item: usize| (scan.plant.base_carrier(item), scan.plant.place(item));
            let places: Vec<_> = (0..items.count()).map(place).collect();
            seen.push((scan.scan * u64::from(project.plant.scan_ms), places));
        };
        let mut executor = Executor::new(&project.system);
        let recorded = record(&project.plant, &mut executor, Stepping::EveryScan, &[], &mut observe).unwrap();
        let mut executor = Executor::new(&project.system);
        let of_events = record(&project.plant, &mut executor, Stepping::Events, &[], &mut |_| {}).unwrap();
        for (one, other) in of_events.paths.iter().zip(&recorded.paths) {
            let times = |path: &Path| -> Vec<[f64; 2]> {
                path.segments.iter().map(|segment| [segment.begin_ms, segment.end_ms]).collect()
            };
            assert_eq!(times(one), times(other), "{name}: other times from event to event");
        }
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

/// Two half circles of 1 mm that lead onto one another: an item would go round a million times in each scan.
#[test]
fn an_item_that_passes_on_too_often_in_a_scan_ends_the_run() {
    let device = "device half {
            part belt = lane { from: origin * frame(0, 0, 0.8, 0); length: 0.001; turn: 180; width: 0.2; speed: 1000000; };
            part feed = source { on: belt; inset: 0; };
            out run: bool = belt.run stop false;
        }
        automaton Half on half { initial -> Runs { run := true; } state Runs { when false -> Runs {} } }";
    let robots = r#"{"name": "first", "type": "half", "pose": [0, 0, 0]},
        {"name": "second", "type": "half", "at": "first.belt"}"#;
    let scenario = r#"{
        "kinds": [{"name": "bead", "height": 0.001, "size": [0.001, 0.001]}], "time_limit_s": 10,
        "supply": {"items": {"first": ["bead"], "second": []}, "times": 1, "every_s": 0.1}
    }"#;
    let report =
        run(&line(device, robots, scenario)).expect("a line").expect("the same however it is stepped");
    assert_eq!(
        report.reason,
        "interlock of first: items on the conveyors of the line go on at more than 100000 times in a scan"
    );
}

/// A line of these automata and devices.
fn line(device: &str, robots: &str, scenario: &str) -> Texts {
    Texts {
        layout: format!(r#"{{"robots": [{robots}]}}"#),
        specs: vec![device.into()],
        scenario: Some(scenario.into()),
        ..Texts::default()
    }
}

/// Why the run ends, which is the same however it is stepped, and where the items on the line are at each scan.
fn places(texts: &Texts) -> (String, Vec<Vec<Option<Point>>>) {
    let project = texts.project();
    let report = run(texts).expect("a line").expect("the same however it is stepped");
    let mut places = Vec::new();
    let mut observe = |scan: &Seen| {
        let items = 0..scan.plant.items().all().len();
        places.push(items.map(|item| scan.plant.place(item)).collect());
    };
    let (mut executor, mut memory) = (Executor::new(&project.system), Memory::default());
    run_again(&project.plant, &mut executor, Stepping::EveryScan, &mut memory, &mut observe).expect("a run");
    (report.reason, places)
}

/// Two boxes 0.2 m long, 0.3 m apart, that a diverter or a pusher brings onto a slower conveyor.
fn with_branch(branch: &str, push: &str) -> Texts {
    let device = format!(
        "device rig {{
            part bed = lane {{ from: origin * frame(0, 0, 0.7, 0); length: 2.0; width: 0.4; speed: 0.2; }};
            part feed = source {{ on: bed; inset: 0.2; }};
            part pin = cylinder {{ extend: 100 ms; retract: 100 ms; begins_out: true; }};
            part gate = stopper {{ of: bed; at: 1.2; by: pin; }};
            part arm = cylinder {{ extend: 300 ms; retract: 300 ms; }};
            part side = lane {{
                from: origin * frame(0.95, -0.2, 0.7, -90); length: 3.0; width: 0.4; speed: 0.1;
            }};
            part plate = {branch} by: arm; onto: side; }};
            part bin = sink {{ of: side; inset: 0; }};
            part end = sink {{ of: bed; inset: 0; }};
            out run: bool = bed.run;
            out run_side: bool = side.run;
            out shut: bool = pin.extend;
            out push: bool = arm.extend;
        }}
        automaton Rig on rig {{
            initial -> Waiting {{ run := true; run_side := true; shut := true; }}
            state Waiting {{ when after {push} -> Pushing {{ push := true; }} }}
            state Pushing {{ when false -> Pushing {{}} }}
        }}"
    );
    let scenario = r#"{
        "kinds": [{"name": "box", "height": 0.1, "size": [0.2, 0.2]}],
        "supply": {"items": ["box", "box"], "every_s": 1.5},
        "goal": {"rig.bin": {"box": 2}}
    }"#;
    line(&device, r#"{"name": "rig", "type": "rig", "pose": [0, 0, 0]}"#, scenario)
}

/// The second box waits until the first one has cleared the beginning of the other conveyor, and goes then: they touch.
#[test]
fn what_waits_for_room_on_another_conveyor_goes_as_soon_as_there_is_room() {
    for (branch, push) in
        [("diverter { of: bed; at: 1.05;", "1 s"), ("pusher { of: bed; at: 0.95; width: 0.6;", "10 s")]
    {
        let (reason, places) = places(&with_branch(branch, push));
        assert_eq!(reason, "all items collected", "{branch}");
        let along = |place: Option<Point>| place.map(|place| -0.2 - place.y).filter(|along| *along > 0.02);
        let pairs = places.iter().filter_map(|places| along(places[0]).zip(along(places[1])));
        let gaps: Vec<f64> = pairs.map(|(first, second)| (first - second).abs()).collect();
        assert!(gaps.len() > 1000, "{branch}: {} scans", gaps.len());
        let off = gaps.iter().map(|gap| (gap - 0.2).abs()).fold(0.0, f64::max);
        assert!(off < 1e-6, "{branch}: {off} m between them");
    }
}

/// Boxes 0.3 m long on conveyors along x that meet at 0: what reaches over the joint is no farther than up to the next one.
fn none_is_in_another(places: &[Vec<Option<Point>>]) {
    for (scan, places) in places.iter().enumerate() {
        let mut along: Vec<f64> =
            places.iter().flatten().filter(|place| place.y.abs() < 1e-9).map(|place| place.x).collect();
        along.sort_by(f64::total_cmp);
        for pair in along.windows(2).filter(|pair| pair[0] + 0.15 > 1e-6) {
            assert!(pair[1] - pair[0] > 0.3 - 1e-6, "scan {scan}: {along:?}");
        }
    }
}

/// Nobody asks for the second item, though the conveyor goes on.
#[test]
fn a_source_that_waits_for_a_release_does_not_keep_a_run_alive() {
    let device = "device magazine {
            part belt = lane { from: origin * frame(0, 0, 0.7, 0); length: 1.0; width: 0.3; speed: 0.2; };
            part feed = source { on: belt; inset: 0.1; };
            part end = sink { of: belt; inset: 0; };
            out run: bool = belt.run;
            out release: bool = feed.release;
        }
        automaton Magazine on magazine {
            initial -> Asks { run := true; release := true; }
            state Asks { when after 100 ms -> Rests { release := false; } }
            final state Rests;
        }";
    let scenario = r#"{
        "kinds": [{"name": "box", "height": 0.1}],
        "supply": {"items": ["box"], "times": 2},
        "goal": {"magazine.end": {"box": 2}}
    }"#;
    let robots = r#"{"name": "magazine", "type": "magazine", "pose": [0, 0, 0]}"#;
    assert_stalls_after(&line(device, robots, scenario), 4.5);
}

/// The first item stands where the source is, so that there is no room for the second one, which is due after 6 s.
#[test]
fn a_source_without_room_does_not_keep_a_run_alive() {
    let device = "device queue {
            part belt = lane { from: origin * frame(0, 0, 0.7, 0); length: 1.0; width: 0.3; speed: 0.2; };
            part feed = source { on: belt; inset: 0.2; };
            part pin = cylinder { extend: 100 ms; retract: 100 ms; begins_out: true; };
            part gate = stopper { of: belt; at: 0.4; by: pin; };
            part end = sink { of: belt; inset: 0; };
            out run: bool = belt.run;
            out shut: bool = pin.extend;
        }
        automaton Queue on queue {
            initial -> Rests { run := true; shut := true; }
            final state Rests;
        }";
    let scenario = r#"{
        "kinds": [{"name": "box", "height": 0.1, "size": [0.3, 0.2]}],
        "supply": {"items": ["box"], "times": 2, "every_s": 3},
        "goal": {"queue.end": {"box": 2}}
    }"#;
    let robots = r#"{"name": "queue", "type": "queue", "pose": [0, 0, 0]}"#;
    assert_stalls_after(&line(device, robots, scenario), 6.0);
}

/// The last thing happens at a time, in s; then it is only waited for more.
fn assert_stalls_after(texts: &Texts, seconds: f64) {
    let stall = texts.project().plant.scenario.stall_limit_s;
    let report = run(texts).expect("a line").expect("the same however it is stepped");
    assert!(report.reason.starts_with("deadlock"), "{}", report.reason);
    let since = report.simulated_s - stall;
    assert!((since - seconds).abs() < 1.0, "{since} s");
}

/// A feeder with a conveyor 1 m long.
const FEEDER: &str = "device feeder {
        part belt = lane { from: origin * frame(0, 0, 0.7, 0); length: 1.0; width: 0.4; speed: 0.2; };
        part feed = source { on: belt; inset: 0.2; };
        out run: bool = belt.run;
    }
    automaton Feeder on feeder { initial -> Running { run := true; } state Running { when false -> Running {} } }";

/// A conveyor leads over a joint onto another one, and a diverter brings boxes there from the side.
fn with_joint(every: &str) -> Texts {
    let rig = "device rig {
            part a = lane { from: origin * frame(-1, 0, 0.7, 0); length: 1.0; width: 0.4; speed: 0.2; };
            part feed = source { on: a; inset: 0.2; };
            part c = lane { from: origin * frame(0, 0, 0.7, 0); length: 1.0; width: 0.4; speed: 0.2; };
            part bin = sink { of: c; inset: 0; };
            part m = lane { from: origin * frame(0, -1, 0.7, 90); length: 1.5; width: 0.4; speed: 0.2; };
            part arm = cylinder { extend: 300 ms; retract: 300 ms; begins_out: true; };
            part gate = diverter { of: m; at: 0.9; by: arm; onto: c; };
            out run: bool = a.run;
            out push: bool = arm.extend;
        }
        automaton Rig on rig {
            initial -> Running { run := true; push := true; }
            state Running { when false -> Running {} }
        }";
    let robots = r#"{"name": "rig", "type": "rig", "pose": [0, 0, 0]},
        {"name": "feeder", "type": "feeder", "pose": [0, -2, 0, 90]}"#;
    let boxes = r#"["box", "box", "box", "box", "box"]"#;
    let scenario = format!(
        r#"{{"kinds": [{{"name": "box", "height": 0.1, "size": [0.3, 0.2]}}],
        "supply": {{"items": {{"rig": {boxes}, "feeder": {boxes}}}, "every_s": {every}}},
        "goal": {{"rig.bin": {{"box": 10}}}}}}"#
    );
    line(&format!("{FEEDER} {rig}"), robots, &scenario)
}

#[test]
fn what_a_diverter_brings_goes_between_what_comes_over_the_joint() {
    for every in ["2.5", "1.7", "1.6", "1.51", "0.3"] {
        let (reason, places) = places(&with_joint(every));
        assert_eq!(reason, "all items collected", "every {every} s");
        none_is_in_another(&places);
    }
}

/// A conveyor with a source near its beginning, onto which another one leads. The first box of that comes to the joint after
/// 4.27 s. A box from the source, which reaches 0.05 m behind the beginning, goes before it or after it.
fn with_source_at_joint(release: u32) -> Texts {
    let rig = format!(
        "device rig {{
                part a = lane {{ from: origin * frame(0, 0, 0.7, 0); length: 1.0; width: 0.4; speed: 0.2; }};
                part feed = source {{ on: a; inset: 0.1; }};
                part bin = sink {{ of: a; inset: 0; }};
                out run: bool = a.run;
                out release: bool = feed.release;
            }}
            automaton Rig on rig {{
                initial -> Waiting {{ run := true; }}
                state Waiting {{ when after {release} ms -> Released {{ release := true; }} }}
                state Released {{ when false -> Released {{}} }}
            }}"
    );
    let robots = r#"{"name": "rig", "type": "rig", "pose": [0, 0, 0]},
        {"name": "feeder", "type": "feeder", "pose": [-1, 0, 0]}"#;
    let scenario = r#"{"kinds": [{"name": "box", "height": 0.1, "size": [0.3, 0.3]}],
        "supply": {"items": {"rig": ["box"], "feeder": ["box", "box"]}, "first_s": 1, "every_s": 1.6},
        "goal": {"rig.bin": {"box": 3}}}"#;
    line(&format!("{FEEDER} {rig}"), robots, scenario)
}

#[test]
fn a_source_near_a_joint_puts_items_on_between_those_that_come() {
    for release in (3800..7000).step_by(100) {
        let (reason, places) = places(&with_source_at_joint(release));
        assert_eq!(reason, "all items collected", "released after {release} ms");
        none_is_in_another(&places);
    }
}

/// It comes to the joint while the box from the source still reaches behind it, and goes on when that is over: they touch.
#[test]
fn what_waits_at_a_joint_for_a_source_goes_as_soon_as_there_is_room() {
    for release in [4050, 4100, 4150, 4200] {
        let (_, places) = places(&with_source_at_joint(release));
        let gap = places.iter().find_map(|scan| match scan[..] {
            [Some(a), Some(b), _] if b.x > 0.0 => Some(a.x - b.x),
            _ => None,
        });
        let gap = gap.expect("both on the conveyor");
        assert!((gap - 0.3).abs() < 1e-6, "released after {release} ms: {gap} m");
    }
}

/// A box 0.3 m long has its middle before a pusher 9.02 s after the start, and its front 1.5 s earlier.
fn with_pusher(push: u32, every: &str) -> Texts {
    let device = format!(
            "device rig {{
                part bed = lane {{ from: origin * frame(0, 0, 0.7, 0); length: 3.0; width: 0.4; speed: 0.1; }};
                part feed = source {{ on: bed; inset: 0.2; }};
                part arm = cylinder {{ extend: 300 ms; retract: 300 ms; }};
                part side = lane {{
                    from: origin * frame(1.0, -0.2, 0.7, -90); length: 1.0; width: 0.4; speed: 0.1;
                }};
                part plate = pusher {{ of: bed; at: 1.0; width: 0.1; by: arm; onto: side; }};
                part bin = sink {{ of: side; inset: 0; }};
                part end = sink {{ of: bed; inset: 0; }};
                out run: bool = bed.run;
                out run_side: bool = side.run;
                out push: bool = arm.extend;
            }}
            automaton Rig on rig {{
                initial -> Filling {{ run := true; run_side := true; }}
                state Filling {{ when after {push} ms -> Pushing {{ push := true; }} }}
                state Pushing {{ when after 10 s -> Back {{ push := false; }} }}
                state Back {{ when false -> Back {{}} }}
            }}"
        );
    let scenario = format!(
        r#"{{"kinds": [{{"name": "box", "height": 0.1, "size": [0.3, 0.2]}}],
        "supply": {{"items": ["box", "box"], "first_s": 1.5, "every_s": {every}}}, "time_limit_s": 18}}"#
    );
    line(&device, r#"{"name": "rig", "type": "rig", "pose": [0, 0, 0]}"#, &scenario)
}

/// It stays there, and goes to the other conveyor as soon as the plate is out, whatever happens elsewhere.
#[test]
fn what_has_its_front_before_a_pusher_stays_when_its_middle_is_there() {
    for (push, every, goes) in
        [(8500, "8.802", 902), (8500, "8.1", 902), (8500, "30", 902), (8950, "8.802", 927), (8950, "30", 927)]
    {
        let (_, places) = places(&with_pusher(push, every));
        let scan = places.iter().position(|places| places[0].is_some_and(|place| place.y < -0.1));
        let scan = scan.unwrap_or_else(|| panic!("pushed at {push} ms, every {every} s: never"));
        assert!(scan.abs_diff(goes) <= 2, "pushed at {push} ms, every {every} s: in scan {scan}");
        let far = places[..scan].iter().filter_map(|places| places[0]).map(|place| place.x);
        let far = far.fold(0.0, f64::max);
        assert!(far < 0.95 + 1e-6, "pushed at {push} ms, every {every} s: {far}");
    }
}

/// A conveyor with a pusher and a diverter onto two others; the first ends at the second one's beginning. Items are 0.26 m
/// long.
fn with_branches(parts: &str, operator: &str, supply: &str) -> Texts {
    let device = format!(
        "device cell {{
            part go_on = button {{}}; part turn = button {{}}; part push = button {{}};
            part main = lane {{ from: origin * frame(0, 0, 0.8, 0); length: 1.5; width: 0.4; speed: 0.5; }};
            part feed = source {{ on: main; inset: 0.2; }};
            part arm = cylinder {{ extend: 100 ms; retract: 100 ms; }};
            part rod = cylinder {{ extend: 100 ms; retract: 100 ms; }};
            part outfeed = lane {{ from: origin * frame(1.5, 0, 0.8, 0); length: 1.0; width: 0.4; speed: 0.1; }};
            part end = sink {{ of: outfeed; inset: 0; }};
            part side = lane {{ from: origin * frame(1.0, -0.2, 0.8, -90); length: 0.8; width: 0.4; speed: 0.3; }};
            part side_end = sink {{ of: side; inset: 0; }};
            {parts}
            in goes: bool = go_on.on; in turns: bool = turn.on; in pushes: bool = push.on;
            out run: bool = main.run; out run_after: bool = outfeed.run; out run_side: bool = side.run;
            out extend: bool = arm.extend; out extend_rod: bool = rod.extend;
        }}
        automaton Cell on cell {{
            initial -> Runs {{ run := true; run_side := true; }}
            state Runs {{
                when goes <> run_after or turns <> extend or pushes <> extend_rod
                -> Runs {{ run_after := goes; extend := turns; extend_rod := pushes; }}
            }}
        }}"
    );
    let scenario = format!(
        r#"{{"kinds": [{{"name": "box", "height": 0.2, "size": [0.26, 0.05]}}],
            "supply": {{"items": ["box", "box"], {supply}}}, "time_limit_s": 12, "operator": [{operator}]}}"#
    );
    line(&device, r#"{"name": "cell", "type": "cell", "pose": [0, 0, 0]}"#, &scenario)
}

/// Two boxes 0.3 m apart. The second one is turned onto the conveyor that follows while the first one comes to the joint:
/// this waits there until the other one has left.
#[test]
fn what_comes_over_a_joint_waits_for_what_a_diverter_has_put_there() {
    let diverter = "part gate = diverter { of: main; at: 1.1; by: arm; onto: outfeed; };";
    let operator = r#"{"robot": "cell", "part": "turn", "at_s": 2.6, "for_s": 3},
        {"robot": "cell", "part": "go_on", "at_s": 6}"#;
    let texts = with_branches(diverter, operator, r#""first_s": 1, "every_s": 0.6"#);
    let (_, places) = places(&texts);
    let along = |scan: &Vec<Option<Point>>| [0, 1].map(|item: usize| scan[item].map_or(f64::NAN, |p| p.x));
    let waits = along(&places[550]);
    assert!((waits[1] - 1.5).abs() < 1e-9 && (waits[0] - 1.37).abs() < 1e-9, "{waits:?}");
    let follows = along(&places[1150]);
    assert!(follows[1] > 1.9 && (follows[1] - follows[0] - 0.26).abs() < 1e-6, "{follows:?}");
}

/// The conveyor of the diverter is full; the pusher before it has room.
#[test]
fn a_diverter_without_room_does_not_stop_a_pusher() {
    let branches = "part gate = diverter { of: main; at: 1.13; by: arm; onto: outfeed; };
        part out = pusher { of: main; at: 1.0; width: 0.3; by: rod; onto: side; };";
    let operator = r#"{"robot": "cell", "part": "turn", "at_s": 0.6},
        {"robot": "cell", "part": "push", "at_s": 8}"#;
    let texts = with_branches(branches, operator, r#""first_s": 1, "every_s": 3"#);
    let (_, places) = places(&texts);
    let across = |scan: usize| [0, 1].map(|item: usize| places[scan][item].map_or(f64::NAN, |p| p.y));
    assert_eq!(across(800), [0.0, 0.0]);
    assert!(across(850)[1] < -0.2, "{:?}", across(850));
}

/// A box 0.05 m long and 0.3 m wide is wholly in a field of 0.4 m for 0.35 m, at 0.1 m/s.
#[test]
fn a_zone_sees_items_by_their_lengths_along_the_conveyor() {
    let device = "device eye {
            part bed = lane { from: origin * frame(0, 0, 0.8, 0); length: 2.0; width: 0.4; speed: 0.1; };
            part feed = source { on: bed; inset: 0; };
            part end = sink { of: bed; inset: 0; };
            part field = zone { over: bed; middle: origin * point(1, 0, 0.8); half: 0.2; part_half: 0.01; };
            in sees: bool[Kind] = field.sees;
            out run: bool = bed.run;
        }
        automaton Eye on eye {
            initial -> Runs { run := true; }
            state Runs { when sees[box] -> Sees {} }
            state Sees { when not sees[box] -> Stopped { run := false; } }
            final state Stopped;
        }";
    let scenario = r#"{"kinds": [{"name": "box", "height": 0.05, "size": [0.05, 0.3]}],
        "supply": {"items": ["box"], "first_s": 0}, "time_limit_s": 30}"#;
    let texts = line(device, r#"{"name": "eye", "type": "eye", "pose": [0, 0, 0]}"#, scenario);
    let (_, places) = places(&texts);
    let stops = places.last().and_then(|scan| scan[0]).expect("the box");
    // Seen to have left a scan late, stopped in the next one.
    assert!((1.175..1.178).contains(&stops.x), "{stops:?}");
}
