//! The examples of `docs/layout.md` are right.

use autogen_tests::{Texts, plain, side_by_side, text};

/// Line, what stands behind the backquotes, and text of each block of a document.
fn blocks(document: &str) -> Vec<(usize, String, String)> {
    let mut found: Vec<(usize, String, String)> = Vec::new();
    let mut inside = false;
    for (number, line) in document.lines().enumerate() {
        match line.strip_prefix("```") {
            Some(kind) => {
                inside = !inside;
                if inside {
                    found.push((number + 1, kind.into(), String::new()));
                }
            }
            None if inside => {
                if let Some((_, _, text)) = found.last_mut() {
                    *text += line;
                    *text += "\n";
                }
            }
            None => {}
        }
    }
    found
}

/// A block `json` is a whole layout or a whole scenario, `json stationary` and `json may_touch` an object of
/// these lists, `json operator` a scenario for a desk,
/// `json tending` one for that example.
/// Objects and scenarios are tried in the first layout, with the types of the document.
#[test]
fn examples_are_right() {
    const STATIONARY: &str = "\"stationary\": [";
    const DESK: &str = r#"{"robots": [{"name": "desk", "type": "desk", "pose": [0, 0, 0]}]}"#;
    let document = text("docs/layout.md");
    let blocks = blocks(&document);
    let specs: Vec<String> =
        blocks.iter().filter(|(_, kind, _)| kind == "aut").map(|(_, _, text)| text.clone()).collect();
    let (_, _, frame) = blocks
        .iter()
        .find(|(_, kind, text)| kind == "json" && text.contains("\"robots\""))
        .expect("the document has a layout");
    let tending = side_by_side("tending/tending");
    let mut cases = 0;
    for (line, kind, text) in &blocks {
        let (layout, scenario) = match kind.as_str() {
            "json" if text.contains("\"kinds\"") => (frame.clone(), Some(text.clone())),
            "json" => (text.clone(), None),
            "json tending" => (tending.layout.clone(), Some(text.clone())),
            "json operator" => (DESK.into(), Some(text.clone())),
            "json stationary" => {
                (frame.replacen(STATIONARY, &format!("{STATIONARY}\n{},", text.trim_end()), 1), None)
            }
            "json may_touch" => {
                let before = frame.trim_end().strip_suffix("\n}").expect("the end of the layout");
                (format!("{before},\n  \"may_touch\": [{text}]\n}}"), None)
            }
            "aut" => continue,
            _ => panic!("line {line}: what is a block `{kind}`?"),
        };
        cases += 1;
        let specs = if kind == "json tending" { &tending.specs } else { &specs };
        let outcome = Texts { layout, specs: specs.clone(), scenario, ..Texts::default() }.compile();
        let is_right = outcome.diagnostics.is_empty() && outcome.project.is_some();
        assert!(is_right, "docs/layout.md:{line}\n{}", plain(&outcome.sources, &outcome.diagnostics));
    }
    assert!(cases >= 5, "{cases} cases");
}

#[test]
fn the_built_in_scenario_is_shown() {
    let document = text("docs/layout.md");
    let shown = blocks(&document).into_iter().any(|(_, _, text)| text == autogen::scenario::DEFAULT);
    assert!(shown, "docs/layout.md shows another scenario than the built-in one");
}

/// Two modules, with what the second one says of its place; the types of `docs/layout.md`.
fn told(second: &str) -> Vec<(&'static str, String)> {
    let document = text("docs/layout.md");
    let mut specs: Vec<String> =
        blocks(&document).into_iter().filter(|(_, kind, _)| kind == "aut").map(|(_, _, text)| text).collect();
    specs.push(
        "device two { part one = lane { from: origin; length: 1.0; width: 0.4; speed: 0.3; };
           part other = lane { from: pose_frame; length: 1.0; width: 0.4; speed: 0.3; };
           define pose_frame = frame(0, 3, 0, 0); out run: bool = one.run; out go: bool = other.run; }
         automaton Two on two { initial -> Running { run := true; go := true; } state Running { when false -> Running {} } }
         device bare { part light = lamp { at: pose; colour: red; }; out on: bool = light.on; }
         automaton Bare on bare { initial -> Lit { on := true; } state Lit { when false -> Lit {} } }"
            .into(),
    );
    let layout = format!(
        r#"{{"robots": [{{"name": "first", "type": "module", "pose": [0, 0, 0]}}, {second}],
            "stationary": [{{"name": "stone", "type": "box", "pose": [9, 9, 0]}}]}}"#
    );
    let texts = Texts { specs, ..Texts::of_layout(layout) };
    texts.compile().diagnostics.into_iter().map(|d| (d.code, format!("{} {}", d.message, d.help))).collect()
}

#[test]
fn a_place_that_cannot_be_found_is_told() {
    let module = |at: &str| format!(r#"{{"name": "second", "type": "module", "at": {at}}}"#);
    let cases = [
        (module(r#""first""#), "E0148", "names no lane of a machine"),
        (module(r#""fist.belt""#), "E0148", "did you mean \"first\"?"),
        (module(r#""first.belt_2""#), "E0148", "its lane is \"belt\""),
        (module(r#"["bet", "first.belt"]"#), "E0148", "\"second\" has no lane \"bet\""),
        (module(r#"["belt"]"#), "E0113", "at must have 2 elements"),
        (module("7"), "E0110", "at must be a text"),
        (module(r#""stone.belt""#), "E0148", "\"stone\" has no lane"),
        (module(r#""second.belt""#), "E0149", "the place of \"second\" depends on itself"),
        (module(r#""first.belt", "pose": [0, 0, 0]"#), "E0148", "leave out one of the two"),
        (
            r#"{"name": "a", "type": "module", "at": "b.belt"}, {"name": "b", "type": "module", "at": "a.belt"}"#.into(),
            "E0149",
            "depends on itself",
        ),
        (r#"{"name": "second", "type": "two", "at": "first.belt"}"#.into(), "E0148", "has 2 lanes"),
        (r#"{"name": "second", "type": "two", "at": ["other", "first.belt"]}"#.into(), "E0148", "does not move and turn"),
        (module(r#""first.belt", "turn": "left""#), "E0110", "turn"),
        (r#"{"name": "second", "type": "nobody", "at": "first.belt"}"#.into(), "E0126", "no automaton `Nobody`"),
        (r#"{"name": "second", "type": "bare", "at": "first.belt"}"#.into(), "E0148", "it has no lane"),
    ];
    for (second, code, words) in cases {
        let told = told(&second);
        assert!(
            told.iter().any(|(found, text)| *found == code && text.contains(words)),
            "{second}: {told:?}"
        );
    }
}

/// A layout writes its types in small letters, so it can name only automata whose words begin with a capital letter.
#[test]
fn an_automaton_that_no_type_names_is_to_be_renamed() {
    for (automaton, kind, other) in [
        ("mm", "mm", "Mm"),
        ("pushButton", "push_button", "PushButton"),
        ("Filler_2", "filler_2", "Filler2"),
        ("Push_Button", "push_button", "PushButton"),
        ("Push_Button", "push__button", "PushButton"),
    ] {
        let spec = |name: &str| {
            format!(
                "device bench {{ part key = button {{}}; in on: bool = key.on; }}
                automaton {name} on bench {{ initial state S {{ when on -> S {{}} }} }}"
            )
        };
        let told = |name: &str, kind: &str| -> Vec<String> {
            let layout = format!(r#"{{"robots": [{{"name": "it", "type": "{kind}", "pose": [0, 0, 0]}}]}}"#);
            let texts = Texts { specs: vec![spec(name)], ..Texts::of_layout(layout) };
            texts.compile().diagnostics.into_iter().map(|d| format!("{} {}", d.code, d.help)).collect()
        };
        let help = told(automaton, kind);
        let start = format!("E0126 a layout cannot name the automaton `{automaton}`: ");
        let new_type = help[0].split('"').nth(1).expect("a type");
        let end = format!("rename it `{other}`, whose type is \"{new_type}\"");
        assert!(help[0].starts_with(&start) && help[0].ends_with(&end), "{help:?}");
        assert_eq!(told(other, new_type), Vec::<String>::new());
    }
    let unnamed = Texts {
        specs: vec!["automaton _ on bin { initial state S { when false -> S {} } }".into()],
        ..Texts::of_layout(r#"{"robots": [{"name": "it", "type": "_", "pose": [0, 0, 0]}]}"#)
    };
    let found = unnamed.compile().diagnostics;
    assert!(
        found[0].code == "E0126" && found[0].help.ends_with("without underscores; rename it"),
        "{found:?}"
    );
}

/// A lane with a wrong setting is the cause, and not that there is no lane.
#[test]
fn a_wrong_lane_at_which_others_begin_is_told() {
    let device = "device module {
        parameter speed: real;
        part belt = lane { from: origin; length: 1.0; width: 0.4; speed: speed; };
        out run: bool = belt.run stop false;
    }
    automaton Module on module { initial -> Running { run := true; } state Running { when false -> Running {} } }";
    let told = |speeds: [&str; 3]| -> Vec<String> {
        let [a, b, c] = speeds;
        let layout = format!(
            r#"{{"robots": [
                {{"name": "c1", "type": "module", "pose": [0, 0, 0], "speed": {a}}},
                {{"name": "c2", "type": "module", "at": "c1.belt", "speed": {b}}},
                {{"name": "c3", "type": "module", "at": "c2.belt", "speed": {c}}}
            ]}}"#
        );
        let texts = Texts { specs: vec![device.into()], ..Texts::of_layout(layout) };
        let outcome = texts.compile();
        let machine =
            |place: autogen::source::Span| outcome.sources.text(place).chars().skip(10).take(2).collect();
        let all = outcome.diagnostics.iter();
        all.map(|found| {
            let of: Vec<String> = found.others.iter().map(|(place, _)| machine(*place)).collect();
            format!("{} {} {}", found.code, of.join(" "), found.message)
        })
        .collect()
    };
    let wrong = |machine: &str| format!("E0704 {machine} `speed` has to be a number over 0");
    assert_eq!(told(["0.3", "0.3", "0.3"]), [""; 0]);
    assert_eq!(told(["0", "0.3", "0.3"]), [wrong("c1")]);
    assert_eq!(told(["0.3", "0", "0.3"]), [wrong("c2")]);
    assert_eq!(told(["0.3", "0.3", "0"]), [wrong("c3")]);
}

/// Two nodes and what a vehicle on them is told.
#[test]
fn routes_that_are_wrong_are_told() {
    let device = "device cart {
        parameter hall: routes; parameter home: node;
        part drive = track {
            nodes: hall.nodes; edges: hall.edges; speeds: hall.speeds; begins: home;
            speed: 1.5; acceleration: 0.5; mass: 10.0;
        };
        in stands: bool = drive.stands;
        constant home_at: int 0..255 = home;
    }
    automaton Cart on cart { initial state S { when stands and home_at = 1 -> S {} } }";
    let told = |routes: &str, keys: &str| -> Vec<(&'static str, String)> {
        let layout = format!(
            r#"{{"robots": [{{"name": "cart", "type": "cart", "pose": [0, 0, 0], {keys}}}], "routes": {routes}}}"#
        );
        let texts = Texts { specs: vec![device.into()], ..Texts::of_layout(layout) };
        let all = texts.compile().diagnostics.into_iter();
        all.map(|d| (d.code, format!("{} {} {}", d.message, d.notes.join(" "), d.help))).collect()
    };
    let nodes = r#""nodes": {"a": [0, 0, 0], "b": [5, 0, 0]}"#;
    let both = r#"[{"from": "a", "to": "b", "speed": 0.5, "both_ways": true}]"#;
    let right = format!(r#"{{"one": {{{nodes}, "edges": {both}}}}}"#);
    let here = r#""hall": "one", "home": "b""#;
    assert_eq!(told(&right, here), []);
    let of_edges = |edges: &str| format!(r#"{{"one": {{{nodes}, "edges": {edges}}}}}"#);
    let cases = [
        (right.clone(), r#""hall": "two", "home": "b""#, "E0155", "the layout has no routes \"two\""),
        (right.clone(), r#""hall": "one", "home": "c""#, "E0155", "the nodes are a and b"),
        (right.clone(), r#""hall": 1, "home": "a""#, "E0110", "hall must be a text"),
        (right, r#""hall": "one""#, "E0112", "has no key \"home\""),
        ("{}".into(), here, "E0155", "beside `robots`"),
        ("[]".into(), here, "E0110", "routes must be an object"),
        (of_edges(r#"[{"from": "a", "to": "bb"}]"#), here, "E0155", "there is no node \"bb\""),
        (of_edges(r#"[{"from": "a"}]"#), here, "E0112", "has no key \"to\""),
        (
            of_edges(r#"[{"from": "a", "to": "b", "speed": 0}]"#),
            here,
            "E0114",
            "speed must be a number from 0.001",
        ),
        (
            of_edges(r#"[{"from": "a", "to": "b", "both_ways": 1}]"#),
            here,
            "E0110",
            "both_ways must be true or false",
        ),
        (
            of_edges(r#"[{"from": "a", "to": "b"}]"#),
            here,
            "E0704",
            "no way leads from node 1, where it begins, to node 0",
        ),
        (of_edges(r#"[{"from": "a", "to": "a"}]"#), here, "E0704", "has no length"),
        (
            r#"{"one": {"nodes": {"a": [0, 0], "b": [1, 0, 0]}, "edges": []}}"#.into(),
            here,
            "E0113",
            "must have 3 elements",
        ),
        (r#"{"one": {"edges": []}}"#.into(), here, "E0112", "has no key \"nodes\""),
        (r#"{"o_": {"nodes": {}, "edges": [], "way": 1}}"#.into(), here, "E0111", "has no key \"way\""),
    ];
    for (routes, keys, code, words) in cases {
        let told = told(&routes, keys);
        assert!(
            told.iter().any(|(found, text)| *found == code && text.contains(words)),
            "{routes} {keys}: {told:?}"
        );
    }
}

#[test]
fn machines_in_any_order_begin_where_others_end() {
    // A quarter of a circle of 1 m, then one more: 2/pi m ahead and to the left each time.
    let layout = r#"{"robots": [
        {"name": "third", "type": "module", "at": "second.belt"},
        {"name": "second", "type": "module", "at": "first.belt", "turn": 90},
        {"name": "first", "type": "module", "pose": [1, 2, 0.1, 90], "turn": 90}
    ]}"#;
    let document = text("docs/layout.md");
    let specs = blocks(&document).into_iter().filter(|(_, kind, _)| kind == "aut").map(|(_, _, text)| text);
    let project = Texts { specs: specs.collect(), ..Texts::of_layout(layout) }.project();
    let radius = 2.0 / std::f64::consts::PI;
    let wanted = [[1.0 - 2.0 * radius, 2.0], [1.0 - radius, 2.0 + radius], [1.0, 2.0]];
    for (machine, [x, y]) in project.plant.machines.iter().zip(wanted) {
        let pose = machine.pose;
        assert!(
            (pose.x - x).abs() < 1e-9 && (pose.y - y).abs() < 1e-9 && (pose.z - 0.1).abs() < 1e-9,
            "{pose:?}"
        );
    }
}

/// What is said of a device with these ports and commands in a layout with panels.
fn told_with_panels(ports: &str) -> Vec<(&'static str, String, String)> {
    let device = format!(
        "device rig {{
             part l = lamp {{ at: pose; colour: red; }};
             {ports}
         }}
         automaton Rig on rig {{ initial -> Lit {{ }} state Lit {{ when after 1 s -> Lit {{ }} }} }}"
    );
    let layout = r#"{"panel": "machines", "robots": [{"name": "a", "type": "rig", "pose": [0, 0, 0]}]}"#;
    let outcome = Texts { specs: vec![device], ..Texts::of_layout(layout) }.compile();
    let errors = outcome.diagnostics.into_iter();
    let told = errors.map(|d| {
        let word = outcome.sources.text(d.place).to_string();
        (d.code, word, format!("{} {}", d.message, d.help))
    });
    told.collect()
}

/// One error at the output that the text has, and no other.
#[test]
fn an_output_whose_value_by_hand_has_a_name_of_the_panel_is_told() {
    let cases = [
        ("out enable: bool = l.on stop false;", "enable", "`panel_enable` is an input of every panel"),
        ("out mode: bool = l.on stop false;", "mode", "rename the output `mode`"),
        ("out step: bool = l.on;", "step", "the panel cannot give `step` by hand"),
        ("out jog: bool = l.on;", "jog", "`panel_jog`"),
        (
            "part x = axis { from: origin; along: x; range: [-0.5, 0.5]; speed: 0.5; acceleration: 2.0; };
             part arm = chain { on: x; tool_length: 0.1; rest: pose; };
             out goal: point; out goal_x: bool = l.on; command 1 move(goal) = arm.joints(goal);",
            "goal_x",
            "`panel_goal_x` is the value by hand of the output `goal`",
        ),
        (
            "out panel_step: bool = l.on;",
            "panel_step",
            "names that begin with `panel_` are those of the panel",
        ),
    ];
    for (ports, word, words) in cases {
        let told = told_with_panels(ports);
        assert_eq!(told.len(), 1, "{ports}: {told:?}");
        let (code, found, text) = &told[0];
        assert_eq!((*code, found.as_str()), ("E0701", word), "{text}");
        assert!(text.contains(words), "{text}");
    }
    assert_eq!(told_with_panels("out verb: bool = l.on;"), []);
}

/// Names are wider than the machines here; a character is taken for no wider than it is in wide fonts.
#[test]
fn the_names_of_a_plan_are_within_the_picture() {
    let names = ["a", "the_lamp_at_the_left_of_the_line", "the_lamp_at_the_end_of_the_line"];
    let lamps = names.iter().zip([0.0, 0.2, 1.0]);
    let lamps =
        lamps.map(|(name, x)| format!(r#"{{"name": "{name}", "type": "signal", "pose": [{x:?}, 0, 0]}}"#));
    let texts = Texts {
        layout: format!(r#"{{"robots": [{}]}}"#, lamps.collect::<Vec<_>>().join(", ")),
        specs: vec![
            "device signal { part lamp = lamp { at: pose; colour: green; }; out on: bool = lamp.on; }
            automaton Signal on signal { initial -> Lit { on := true; } state Lit { when false -> Lit {} } }"
                .into(),
        ],
        scenario: Some(r#"{"time_limit_s": 1}"#.into()),
        ..Texts::default()
    };
    let project = texts.project();
    let svg = autogen::backend::plan::svg(&project.plant, &project.edges);
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let view = svg.split_once("viewBox=\"").and_then(|(_, rest)| rest.split_once('"')).expect("a view box").0;
    let view: Vec<f64> = view.split(' ').map(number).collect();
    let [left, _, width, _] = view[..] else { panic!("{view:?}") };
    let mut found = 0;
    for text in svg.split("<text class=\"name\" x=\"").skip(1) {
        let (x, rest) = text.split_once('"').expect("a place");
        let name = rest.split_once('>').and_then(|(_, rest)| rest.split_once('<')).expect("a name").0;
        let half = name.len() as f64 * 0.7 * 16.0 / 2.0;
        assert!((left + half..=left + width - half).contains(&number(x)), "{name} at {x} of {view:?}");
        found += 1;
    }
    assert_eq!(found, names.len());
}
