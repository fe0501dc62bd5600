//! Scenarios: the fixtures, resolved against the default line, and what the default scenario means.

mod fixture;

use autogen::diagnostic::Diagnostic;
use autogen::scenario::{self, Input, Line, MachinePart, Number, Panel, ResolvedScenario, Words};
use autogen::source::{FileId, Sources};
use fixture::{root, walk};
use runtime_sim::device::{Extent, PortType};
use runtime_sim::part::{Operated, Schema, button, place, process, route};

const STOPS: PortType = PortType::Int { lo: -1, hi: 2 };

const fn part(
    robot: &'static str,
    part: &'static str,
    numbers: [usize; 2],
    primitive: &'static Schema,
) -> MachinePart<'static> {
    MachinePart { robot, part, primitive, numbers }
}

const fn panel(part: &'static str, number: usize, operated: Operated, ty: PortType) -> Panel<'static> {
    Panel { robot: "desk", part, numbers: [11, number], operated, ty, commands: None }
}

const LINE: Line = Line {
    stations: &[("as1", 7), ("as2", 8), ("as3", 9), ("as4", 10)],
    belts: &[("conveyor_belt", 0)],
    arms: &[("kitting", 1), ("gantry", 6)],
    commanded: &[
        ("conveyor_belt", 0),
        ("kitting", 1),
        ("agv1", 2),
        ("agv2", 3),
        ("agv3", 4),
        ("agv4", 5),
        ("gantry", 6),
    ],
    sinks: &[],
    inputs: &[
        Input {
            robot: "kitting",
            signal: "attached",
            ty: PortType::Bool,
            extent: Extent::One,
            machine: 1,
            word: 0,
        },
        Input {
            robot: "kitting",
            signal: "tool",
            ty: PortType::Point,
            extent: Extent::One,
            machine: 1,
            word: 1,
        },
        Input { robot: "agv1", signal: "at_stop", ty: STOPS, extent: Extent::One, machine: 2, word: 3 },
        Input {
            robot: "desk",
            signal: "speed",
            ty: PortType::Real,
            extent: Extent::Times(3),
            machine: 11,
            word: 4,
        },
        Input {
            robot: "conveyor_belt",
            signal: "sees",
            ty: PortType::Bool,
            extent: Extent::PerKind,
            machine: 0,
            word: 1,
        },
    ],
    parts: &[
        part("agv1", "drive", [2, 0], &route::SCHEMA),
        part("agv1", "load", [2, 1], &place::SCHEMA),
        part("desk", "start", [11, 0], &button::SCHEMA),
        part("desk", "cycle", [11, 2], &process::SCHEMA),
    ],
    panels: &[
        panel("start", 0, Operated::Press, PortType::Bool),
        panel("speed", 1, Operated::SetNumber, PortType::Real),
        panel("panel_mode", 3, Operated::SetNumber, PortType::Int { lo: 0, hi: 2 }),
        Panel {
            commands: Some(&[]),
            ..panel("panel_verb", 4, Operated::SetNumber, PortType::Int { lo: 0, hi: 32767 })
        },
    ],
    made: &[],
};

fn resolve(text: &str, line: &Line) -> Result<ResolvedScenario, Vec<Diagnostic>> {
    let mut sources = Sources::default();
    let file = sources.add("scenario.json", text);
    match scenario::parse(&sources, file) {
        (Some(scenario), _) => scenario::resolve(&scenario, line),
        (None, diagnostics) => Err(diagnostics),
    }
}

fn check(sources: &Sources, file: FileId) -> Vec<Diagnostic> {
    let (scenario, diagnostics) = scenario::parse(sources, file);
    match scenario {
        Some(scenario) => scenario::resolve(&scenario, &LINE).err().unwrap_or_default(),
        None => diagnostics,
    }
}

#[test]
fn fixtures() {
    walk("scenario", check);
}

#[test]
fn a_line_without_a_source_or_a_station_is_told_so() {
    let bare = Line { belts: &[], stations: &[], ..LINE };
    let codes = |text: &str| -> Vec<String> {
        let told = resolve(text, &bare).unwrap_err();
        told.into_iter().map(|d| format!("{} {}", d.code, d.message)).collect()
    };
    let kinds = r#""kinds": [{"name": "bolt", "height": 0.05}]"#;
    let supply = format!(r#"{{{kinds}, "supply": {{"items": ["bolt"]}}}}"#);
    assert_eq!(codes(&supply), ["E0135 the layout has no source"]);
    let orders = format!(r#"{{{kinds}, "orders": {{"count": 1, "parts": {{"bolt": 1}}}}}}"#);
    assert_eq!(codes(&orders), ["E0135 the layout has no source", "E0135 the layout has no station"]);
}

#[test]
fn the_example_is_the_built_in_scenario() {
    let text = std::fs::read_to_string(root().join("examples/ariac2021/scenario.json")).unwrap();
    assert_eq!(text, scenario::DEFAULT);
}

#[test]
fn default_scenario() {
    let resolved = resolve(scenario::DEFAULT, &LINE).unwrap();
    let kinds: Vec<&str> = resolved.kinds.iter().map(|kind| kind.name.value.as_str()).collect();
    assert_eq!(kinds, ["battery", "sensor", "regulator", "pump"]);
    let stations: Vec<&[usize]> = resolved.orders.iter().map(|(stations, _)| &stations[..]).collect();
    assert_eq!(stations, [[7], [8], [9], [10], [7], [8], [9], [10]]);
    assert!(resolved.orders.iter().all(|(_, parts)| *parts == [1, 1, 1, 1]));
    let [(0, items)] = &resolved.supply[..] else { panic!("{:?}", resolved.supply) };
    assert_eq!(items.len(), 4 * (8 + 3));
    let times = [resolved.spawn_first_s, resolved.spawn_every_s, resolved.time_limit_s];
    assert_eq!(times, [2.0, 2.0, 3600.0]);
    assert_eq!(resolved, resolve(scenario::DEFAULT, &LINE).unwrap());
    // Before order n+1 can be wanted, n whole orders have been brought.
    for kind in 0..4 {
        let brought = |n: usize| items[..n].iter().filter(|k| **k == kind).count();
        assert!(brought(items.len() / 2) >= 3);
    }
}

#[test]
fn what_a_person_operates_is_found_by_its_names() {
    let text = r#"{"time_limit_s": 9, "operator": [
        {"robot": "desk", "part": "speed", "at_s": 2, "value": -0.5},
        {"robot": "desk", "part": "start", "at_s": 1.5, "for_s": 0.25}]}"#;
    let resolved = resolve(text, &LINE).unwrap();
    assert_eq!((resolved.number, resolved.orders.len(), resolved.time_limit_s), (Number::None, 0, 9.0));
    let operations: Vec<_> = resolved.operations.iter().map(|o| (o.part, o.at_s, o.for_s, o.value)).collect();
    assert_eq!(operations, [([11, 1], 2.0, None, -0.5), ([11, 0], 1.5, Some(0.25), 1.0)]);
}

#[test]
fn orders_without_end_are_as_many_as_the_belts_can_feed() {
    let text = r#"{"kinds": [{"name": "part", "height": 0.1}],
        "orders": {"count": "without end", "parts": {"part": 2}},
        "supply": {"every_s": 10, "surplus": [0, 1]}, "time_limit_s": LIMIT}"#;
    let resolved = |limit: &str, line: &Line| resolve(&text.replace("LIMIT", limit), line).unwrap();
    // A belt brings parts at 10 s, 20 s and so on to 100 s: five orders, and four stations stand open.
    let short = resolved("100", &LINE);
    assert_eq!(short.number, Number::WithoutEnd);
    assert_eq!((short.orders.len(), short.supply[0].1.len()), (9, 18));
    let two = Line { belts: &[("one", 0), ("two", 1)], ..LINE };
    assert_eq!(resolved("100", &two).orders.len(), 14);
    assert_eq!(resolved("5", &LINE).orders.len(), 5);
    // The numbers of orders end.
    assert_eq!(resolved("1000000", &LINE).orders.len(), 32767);
}

#[test]
fn lots_are_dealt_to_several_belts_in_turn() {
    let line = Line { belts: &[("a", 3), ("b", 5)], ..LINE };
    let resolved = resolve(scenario::DEFAULT, &line).unwrap();
    let [(3, a), (5, b)] = &resolved.supply[..] else { panic!("{:?}", resolved.supply) };
    assert_eq!(a.len() + b.len(), 44);
    assert!((0..4).all(|kind| a.iter().filter(|k| **k == kind).count() >= 4));
}

#[test]
fn a_list_of_parts_needs_one_belt_or_one_list_for_each() {
    let text = r#"{"kinds": [{"name": "pump", "height": 0.11}], "orders": [{"parts": {"pump": 1}}],
        "supply": {"items": ["pump", "pump"]}}"#;
    assert_eq!(resolve(text, &LINE).unwrap().supply, [(0, vec![0, 0])]);
    let two = Line { belts: &[("a", 3), ("b", 5)], ..LINE };
    assert_eq!(resolve(text, &two).unwrap_err()[0].code, "E0136");
    let dealt = text.replace(r#"["pump", "pump"]"#, r#"{"b": ["pump"], "a": []}"#);
    assert_eq!(resolve(&dealt, &two).unwrap().supply, [(5, vec![0]), (3, vec![])]);
}

#[test]
fn a_line_without_station_or_belt() {
    let bare = Line { stations: &[], belts: &[], ..LINE };
    let codes: Vec<&str> = resolve(scenario::DEFAULT, &bare).unwrap_err().iter().map(|d| d.code).collect();
    assert_eq!(codes, ["E0135", "E0135"]);
    let nothing = scenario::DEFAULT.replace("\"count\": 8", "\"count\": 0");
    assert!(resolve(&nothing, &bare).is_ok());
}

#[test]
fn every_prefix_is_refused() {
    let text = scenario::DEFAULT.trim_end();
    for end in 0..text.len() {
        assert!(resolve(&text[..end], &LINE).is_err(), "prefix of {end} bytes");
    }
}

#[test]
fn faults_find_their_machines() {
    let faults = r#""faults": {"slips": [{"robot": "kitting", "pick": 3, "after_s": 0.5}],
        "refusals": [{"robot": "agv3", "command": 2}], "pauses": [{"at_s": 60, "for_s": 3}]}, "time"#;
    let resolved = resolve(&scenario::DEFAULT.replace("\"time", faults), &LINE).unwrap();
    assert_eq!((resolved.slips[0].robot, resolved.slips[0].pick), (1, 3));
    assert_eq!((resolved.refusals[0].robot, resolved.refusals[0].command), (4, 2));
    assert_eq!((resolved.pauses[0].at_s, resolved.pauses[0].for_s), (60.0, 3.0));
}

/// The words of an input are those of its elements: two kinds after `moving`.
#[test]
fn sensors_find_the_words_of_their_inputs() {
    let stuck = |members: &str, rest: &str| format!(r#"{{"robot": {members}, "at_s": 2{rest}}}"#);
    let of = |members: &str, rest: &str| {
        let faults = format!(r#""faults": {{"sensors": [{}]}}, "time"#, stuck(members, rest));
        let resolved = resolve(&scenario::DEFAULT.replace("\"time", &faults), &LINE).unwrap();
        let stuck = &resolved.sensors[0];
        (stuck.input, stuck.reads, stuck.for_s)
    };
    let words = |robot, first, count| Words { robot, first, count };
    assert_eq!(
        of(r#""kitting", "signal": "attached", "reads": true"#, r#", "for_s": 3"#),
        (words(1, 0, 1), 1.0, Some(3.0))
    );
    assert_eq!(of(r#""agv1", "signal": "at_stop", "reads": -1"#, ""), (words(2, 3, 1), -1.0, None));
    assert_eq!(of(r#""conveyor_belt", "signal": "sees", "reads": true"#, ""), (words(0, 1, 4), 1.0, None));
    assert_eq!(
        of(r#""conveyor_belt", "signal": "sees", "element": "pump", "reads": false"#, ""),
        (words(0, 4, 1), 0.0, None)
    );
    assert_eq!(
        of(r#""desk", "signal": "speed", "element": 1, "reads": 0.3"#, ""),
        (words(11, 5, 1), 0.3, None)
    );
}

#[test]
fn jams_and_slow_cycles_find_their_parts() {
    let faults = r#""faults": {"jams": [{"robot": "agv1", "part": "drive", "at_s": 3}],
        "slow": [{"robot": "desk", "part": "cycle", "cycle": 2, "longer_s": 30}]}, "time"#;
    let resolved = resolve(&scenario::DEFAULT.replace("\"time", faults), &LINE).unwrap();
    let jam = &resolved.jams[0];
    assert_eq!((jam.part, jam.at_s, jam.for_s), ([2, 0], 3.0, None));
    let slow = &resolved.slow[0];
    assert_eq!((slow.part, slow.cycle, slow.longer_s), ([11, 2], 2, 30.0));
}

#[test]
fn an_order_at_one_of_several_stations() {
    let orders = r#"[{"station": ["as3", "as1"], "parts": {"pump": 1}}, {"parts": {"pump": 1}},
        {"station": "as4", "parts": {"pump": 1}}]"#;
    let text =
        format!(r#"{{"kinds": [{{"name": "pump", "height": 0.11}}], "orders": {orders}, "supply": {{}}}}"#);
    let resolved = resolve(&text, &LINE).unwrap();
    let stations: Vec<&[usize]> = resolved.orders.iter().map(|(stations, _)| &stations[..]).collect();
    assert_eq!(stations, [&[9, 7][..], &[7], &[10]]);
}

#[test]
fn the_first_part_comes_when_it_is_told_and_otherwise_as_late_as_the_next() {
    for (supply, first, every) in [
        ("", 2.0, 2.0),
        (r#", "supply": {}"#, 2.0, 2.0),
        (r#", "supply": {"every_s": 3}"#, 3.0, 3.0),
        (r#", "supply": {"first_s": 8}"#, 8.0, 2.0),
        (r#", "supply": {"first_s": 0, "every_s": 3}"#, 0.0, 3.0),
        (r#", "supply": {"first_s": 8.5, "items": ["pump"]}"#, 8.5, 2.0),
    ] {
        let text = format!(
            r#"{{"kinds": [{{"name": "pump", "height": 0.11}}], "orders": [{{"parts": {{"pump": 1}}}}] {supply}}}"#
        );
        let resolved = resolve(&text, &LINE).unwrap();
        assert_eq!((resolved.spawn_first_s, resolved.spawn_every_s), (first, every), "{supply}");
    }
}
