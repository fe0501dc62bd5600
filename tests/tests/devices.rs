//! Devices that are right as texts and wrong for a machine: what a line with one of them is told.

use autogen::device::{self, Heights, Placed};
use autogen::source::Sources;
use autogen::spec::parser;
use autogen_tests::{Texts, devices, side_by_side};
use runtime_sim::frame::Frame;
use runtime_sim::point::Point;

const AUTOMATON: &str = "automaton Thing on thing { initial state S { when false -> S {} } }";

/// Codes and messages for a layout with one `thing`, beside the default line's.
fn told(device: &str, keys: &str) -> Vec<(&'static str, String)> {
    let layout = format!(r#"{{"robots": [{{"name": "thing", "type": "thing", "pose": [0, 0, 0]{keys}}}]}}"#);
    let texts = Texts { specs: vec![format!("{device}\n{AUTOMATON}")], ..Texts::of_layout(layout) };
    texts.compile().diagnostics.into_iter().map(|d| (d.code, d.message)).collect()
}

#[test]
fn a_chain_on_axes_without_inverse_kinematics_is_told() {
    let device = "device thing {
        part spin = axis { at: pose; speed: 1.0; acceleration: 1.0; joint: j; link: l; mass: 1.0; effort: 1.0; damping: 0.0; friction: 0.0; };
        part arm = ur10 { on: spin; rest: pose; envelope: []; clearances: []; };
        in tool: point = arm.joints.tool;
    }";
    let told = told(device, "");
    assert!(
        told.iter().any(|(code, text)| *code == "E0711" && text.contains("no inverse kinematics")),
        "{told:?}"
    );
}

/// The valve would obey the last one.
#[test]
fn two_outputs_for_one_valve_are_told() {
    let device = "device thing {
        part stop = cylinder { extend: 100 ms; retract: 100 ms; };
        in is_out: bool = stop.is_out;
        out slow: bool = stop.extend stop false;
        out fast: bool = stop.extend stop false;
    }";
    let expected = "`thing` cannot be built from its device: two outputs drive stop.extend: take one of them";
    assert_eq!(told(device, ""), [("E0711", expected.to_string())]);
    let one = device.replace("fast: bool = stop.extend", "fast: bool = stop.retract");
    assert_eq!(told(&one, ""), []);
}

/// What is wrong with an arm, an axis or a positioner: the settings, the code, and words of the message.
const WRONG: &[(&str, &str, &str)] = &[
    ("part x = axis { from: origin; along: x; range: [0, 1]; speed: 1; acceleration: 1; };
      part y = axis { on: x; along: x; range: [0, 1]; speed: 1; acceleration: 1; };
      part arm = chain { on: y; tool_length: 0.1; rest: pose; };", "E0711", "no inverse kinematics"),
    ("part x = axis { from: origin; speed: 1; acceleration: 1; };
      part arm = chain { on: x; tool_length: 0.1; rest: pose; };", "E0711", "no inverse kinematics"),
    ("part x = axis { from: origin; along: x; range: [0, 1]; speed: 1; acceleration: 1; };
      part arm = chain { on: x; tool_length: 0.1; rest: pose; };", "E0711", "cannot reach its own rest position"),
    ("part x = axis { from: origin; at: pose; along: x; range: [0, 1]; speed: 1; acceleration: 1; };
      part arm = chain { on: x; tool_length: 0.1; rest: pose; };", "E0704", "on, at and from"),
    ("part x = axis { from: origin; along: w; range: [0, 1]; speed: 1; acceleration: 1; };
      part arm = chain { on: x; tool_length: 0.1; rest: pose; };", "E0710", "there is no `w`"),
    ("part x = axis { from: origin; along: x; range: [0, 1]; speed: 1; acceleration: 1; };
      part arm = chain { on: x; rest: pose; };", "E0704", "tool_length is missing"),
    ("part x = axis { from: origin; along: x; range: [-1, 1]; speed: 1; acceleration: 1; };
      part arm = chain { on: x; tool_length: 0.1; rest: pose - point(0, 0, 0.1); };
      part hand = body { on: arm.wrist_1; low: pose; high: pose + point(1, 1, 1); };", "E0711", "cannot refer to arm"),
    ("part arm = chain { from: origin; tool_length: 0.1; rest: pose; };", "E0704", "speeds is missing"),
    ("part x = axis { from: origin; along: x; range: [0, 1]; speed: 1; acceleration: 1; };
      part arm = chain { on: x; hung: true; tool_length: 0.1; rest: pose; };", "E0704", "hung is for a chain with lengths or opw"),
    ("part arm = chain { from: origin; opw: [0.1, 0, 0, 0.6, 0.7]; tool_length: 0; speeds: [1, 1, 1, 1, 1, 1]; acceleration: 1; rest: pose; };",
     "E0704", "a1, a2, b, c1, c2, c3, c4"),
    ("part arm = chain { from: origin; opw: [0.1, 0, 0, 0.6, 0.7, 0.7, 0]; lengths: [1, 1, 1, 1, 1, 1]; tool_length: 0;
      speeds: [1, 1, 1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0704", "has lengths or opw"),
    ("part arm = chain { from: origin; opw: [0.1, 0, 0, 0.6, 0.7, 0.7, 0]; signs: [1, 1, 1, 0, 1, 1]; tool_length: 0;
      speeds: [1, 1, 1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0704", "neither 1 nor -1"),
    ("part arm = chain { from: origin; opw: [0.1, 0, 0, 0.6, 0.7, 0.7, 0]; lowest: [0, 0, 0, 0, 0, 400]; tool_length: 0;
      speeds: [1, 1, 1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0704", "the range of joint 6, 400 to 360 degrees"),
    ("part arm = chain { from: origin; opw: [0.1, 0, 0, 0.6, 0.7, 0.7, 0]; tool_length: 0.1;
      speeds: [1, 1, 1, 1, 1, 1]; acceleration: 1; rest: pose + point(9, 0, 0); };", "E0711", "cannot reach its own rest position"),
    ("part arm = chain { from: origin; mount: origin; opw: [0.1, 0, 0, 0.6, 0.7, 0.7, 0]; tool_length: 0.1;
      speeds: [1, 1, 1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0704", "mount is for a chain on an axis"),
    ("part x = axis { from: origin; along: z; range: [0, 1]; speed: 1; acceleration: 1; };
      part arm = chain { on: x; opw: [0.1, 0, 0, 0.6, 0.7, 0.7, 0]; tool_length: 0.1;
      speeds: [1, 1, 1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0711", "no inverse kinematics"),
    ("part arm = chain { from: origin; scara: [0.3]; lowest: [-90, -90, -0.2, -360]; highest: [90, 90, 0, 360]; tool_length: 0;
      speeds: [1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0704", "the lengths of two arms"),
    ("part arm = chain { from: origin; scara: [0.3, 0.3]; highest: [90, 90, 0, 360]; tool_length: 0;
      speeds: [1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0704", "lowest is missing"),
    ("part arm = chain { from: origin; scara: [0.3, 0.3]; lowest: [-90, -90, 0.2, -360]; highest: [90, 90, 0, 360]; tool_length: 0;
      speeds: [1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0704", "the range of the quill"),
    ("part arm = chain { from: origin; scara: [0.3, 0.3]; lowest: [-90, -90, -0.2, -80]; highest: [90, 90, 0, 80]; tool_length: 0;
      speeds: [1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0704", "turns by 180 degrees at least"),
    ("part arm = chain { from: origin; scara: [0.3, 0.3]; lowest: [-90, -90, -0.2, -360]; highest: [90, 90, 0, 360]; tool_length: 0;
      speeds: [1, 1, 1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0704", "a number for each of 4 joints"),
    ("part arm = chain { from: origin; scara: [0.3, 0.3]; opw: [0.1, 0, 0, 0.6, 0.7, 0.7, 0]; tool_length: 0;
      speeds: [1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0704", "opw is not for a chain with scara"),
    ("part arm = chain { from: origin; scara: [0.3, 0.3]; lowest: [-90, -90, -0.2, -360]; highest: [90, 90, 0, 360]; tool_length: 0;
      speeds: [1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0711", "cannot reach its own rest position"),
    ("part arm = chain { from: origin; scara: [0.3, 0.3]; lowest: [-90, -90, -0.2, -360]; highest: [90, 90, 0, 360]; tool_length: 0;
      speeds: [1, 1, 1, 1]; acceleration: 1; rest: pose + point(0.4, 0, -0.1); };
      part hand = body { on: arm.wrist_3; low: pose; high: pose + point(1, 1, 1); };", "E0711", "cannot refer to arm"),
    ("part x = axis { from: origin; along: x; range: [0, 1]; speed: 1; acceleration: 1; };
      part arm = chain { on: x; scara: [0.3, 0.3]; lowest: [-90, -90, -0.2, -360]; highest: [90, 90, 0, 360]; tool_length: 0;
      speeds: [1, 1, 1, 1]; acceleration: 1; rest: pose; };", "E0704", "has from, and no axis"),
    ("part seat = place { at: pose; slots: [point(0, 0, 0)]; by_kind: false; floor: point(0, 0, 0); floor_x: [-0.1, 0.1]; floor_y: [-0.1, 0.1]; };
      part none = process { on: seat; time: []; };", "E0704", "time is an empty list"),
    ("part lift = positioner { slides: point(0, 0, 1); positions: [0, 1.5]; speed: 1; };", "E0704", "1.5 is not within the stroke, 0 to 1"),
    ("part lift = positioner { slides: point(0, 0, 1); positions: [0, 1, 0]; speed: 1; };", "E0704", "two positions are the same"),
    ("part lift = positioner { slides: point(0, 0, 1); positions: []; speed: 1; };", "E0704", "1 to 32 positions"),
    ("part lift = positioner { slides: point(0, 0, 0); positions: [0]; speed: 1; };", "E0704", "not over 0"),
    ("part lift = positioner { positions: [0]; speed: 1; };", "E0704", "slides, or turns about a pivot"),
    ("part lift = positioner { slides: point(0, 0, 1); positions: [0, 1]; speed: 1; begins: 2; };", "E0704", "no number of a position, 0 to 1"),
];

#[test]
fn arms_and_positioners_that_are_wrong_are_told() {
    for (parts, code, words) in WRONG {
        let device = format!(
            "device thing {{ {parts} part light = lamp {{ at: pose; colour: red; }}; out on: bool = light.on; }}"
        );
        let told = told(&device, "");
        assert!(told.iter().any(|(found, text)| found == code && text.contains(words)), "{parts}: {told:?}");
    }
}

#[test]
fn a_limit_that_the_layout_breaks_is_told() {
    let device = "device thing {
        parameter width: real;
        part belt = lane { along: x; range: [0.0, 1.0]; surface: pose; width: width - 1.0; outline: 1.0; speed: 0.2; };
        in moves: bool = belt.moves;
    }";
    let told = told(device, r#", "width": 0.5"#);
    assert!(told.iter().any(|(code, text)| *code == "E0704" && text.contains("a number over 0")), "{told:?}");
    let told = self::told(device, "");
    assert!(told.iter().any(|(code, text)| *code == "E0112" && text.contains("width")), "{told:?}");
}

#[test]
fn a_lane_that_two_run_is_told() {
    let device = "device thing {
        part belt = lane { from: origin; length: 2.0; width: 0.5; speed: 0.2; };
        out run: bool = belt.run;
        in moves: bool = belt.moves;
        command 1 go() = belt.run();
    }";
    let told = told(device, "");
    assert!(
        told.iter().any(|(code, text)| *code == "E0711" && text.contains("take one of them")),
        "{told:?}"
    );
}

#[test]
fn a_constant_for_each_kind_has_enough_elements() {
    let device = "device thing {
        part lamp = lamp { at: pose; colour: red; };
        out on: bool = lamp.on;
        constant places: point[Kind] = [pose, pose];
    }";
    let told = told(device, "");
    assert!(
        told.iter().any(|(code, text)| *code == "E0709" && text.contains("`places` of thing")),
        "{told:?}"
    );
}

/// A lamp, so that there is something beside what is tried.
fn with_constant(constant: &str) -> Vec<(&'static str, String)> {
    told(
        &format!(
            "device thing {{
                parameter width: real;
                part lamp = lamp {{ at: pose; colour: red; }};
                out on: bool = lamp.on;
                constant {constant};
            }}"
        ),
        r#", "width": 3.5"#,
    )
}

#[test]
fn constants_keep_their_types_for_each_machine() {
    let fits = |constant: &str| with_constant(constant).iter().all(|(code, _)| !code.starts_with("E07"));
    assert!(fits("n: int 0..7 = width * 2.0"));
    assert!(fits("x: real = 1.0 / width"));
    for (constant, code) in [
        ("n: int 0..6 = width * 2.0", "E0709"),
        ("n: int 0..6 = width", "E0709"),
        ("x: real = 1.0 / (width - 3.5)", "E0710"),
        ("x: real = 1.0 / 0.0", "E0710"),
        ("p: point = pose + point(1e308 * 10.0, 0.0, 0.0)", "E0710"),
    ] {
        let told = with_constant(constant);
        assert!(told.iter().any(|(found, _)| *found == code), "{constant}: {told:?}");
    }
}

/// The check of connectivity and the simulator have the same arm, whatever other axes stand among the parts.
#[test]
fn an_axis_that_does_not_carry_the_chain_changes_nothing() {
    let text = "device thing {
        part aside = axis { at: pose; along: x; range: [0.0, 9.0]; speed: 1.0; acceleration: 1.0; joint: a; link: a; mass: 1.0; effort: 1.0; damping: 0.0; friction: 0.0; };
        part rails = axis { at: pose; along: y; range: [-3.0, 3.0]; speed: 1.0; acceleration: 1.0; joint: r; link: r; mass: 1.0; effort: 1.0; damping: 0.0; friction: 0.0; };
        part arm = ur10 { on: rails; rest: pose + point(0.574, 0.163, 0.402); envelope: []; clearances: []; };
        in tool: point = arm.joints.tool;
    }";
    let mut sources = Sources::default();
    let mut trees: Vec<_> = devices(&mut sources).into_iter().flat_map(|(_, file)| file.devices).collect();
    trees.extend(parser::parse(sources.add("thing.aut", text), text).0.devices);
    let declared = trees.iter().map(|tree| (tree.name.value.as_str(), tree)).collect();
    let device = device::check(trees.last().unwrap(), &declared).unwrap();
    let placed = Placed { device, pose: Frame::new(Point::new(0.0, 0.0, 1.1), 0.0), arguments: Vec::new() };
    let (machine, _) = placed.machine("m", &[Heights { top: 0.1, grasp: 0.1 }], placed.device.place).unwrap();
    assert!(machine.arm().is_some());
    assert_eq!(placed.arm(), machine.arm());
}

/// What is told of machines stands where it can be changed: a part in its device, a conveyor of a loop in the loop.
#[test]
fn what_does_not_fit_is_told_where_it_stands() {
    let device = "device thing {
        part arm = chain { from: origin; opw: [0.1, 0, 0, 0.6, 0.7, 0.7, 0]; tool_length: 0.1;
            speeds: [1, 1, 1, 1, 1, 1]; acceleration: 1; rest: pose + point(9, 0, 0); };
        in tool: point = arm.tool;
    }";
    let layout = r#"{"robots": [{"name": "thing", "type": "thing", "pose": [0, 0, 0]}]}"#;
    let texts = Texts { specs: vec![format!("{device}\n{AUTOMATON}")], ..Texts::of_layout(layout) };
    let outcome = texts.compile();
    let misfit = outcome.diagnostics.iter().find(|d| d.code == "E0711").expect("the arm does not fit");
    assert_eq!((outcome.sources.text(misfit.place), outcome.sources.position(misfit.place).0), ("arm", 2));
    assert_eq!(misfit.others.len(), 1);

    let mut texts = side_by_side("loop/loop");
    let (from, to) = (r#""c1.bed", "length": 0.785398"#, r#""c1.bed", "length": 0.8"#);
    assert!(texts.layout.contains(from));
    texts.layout = texts.layout.replacen(from, to, 1);
    let outcome = texts.compile();
    let [gap] = &outcome.warnings[..] else { panic!("{:?}", outcome.warnings) };
    assert_eq!((gap.code, outcome.sources.text(gap.place)), ("W0201", "\"feed_end.bed\""));
    assert!(gap.help.contains("change a length or a turn"), "{}", gap.help);

    let device = "device thing {
        part one = lane { from: origin; length: 1.0; width: 0.4; speed: 0.3; };
        part other = lane { from: origin * frame(1.03, 0, 0, 0); length: 1.0; width: 0.4; speed: 0.3; };
        out run: bool = one.run stop false;
        out run_second: bool = other.run stop false;
    }
    automaton Thing on thing { initial -> Runs { run := true; run_second := true; } final state Runs; }";
    let texts = Texts { specs: vec![device.into()], ..Texts::of_layout(layout) };
    let outcome = texts.compile();
    let [gap] = &outcome.warnings[..] else { panic!("{:?} {:?}", outcome.warnings, outcome.diagnostics) };
    assert_eq!((gap.code, outcome.sources.text(gap.place)), ("W0201", "other"));
}

/// The pose that is proposed joins the conveyors again.
#[test]
fn a_conveyor_that_nearly_meets_another_one_is_told_with_the_pose_that_joins_them() {
    let warnings = |from: &str, to: &str| -> Vec<(String, String)> {
        let mut texts = side_by_side("loop/loop");
        for (at, pose) in [
            (r#""module", "at": "c2.bed""#, r#""module", "pose": [6, 1, 0, 180]"#),
            (r#""at": "s7.bed""#, r#""pose": [5, 1, 0, 180]"#),
            (r#""at": ["bed", "s8.bed"]"#, r#""pose": [4, 1, 0, 180]"#),
        ] {
            assert!(texts.layout.contains(at), "{at}");
            texts.layout = texts.layout.replacen(at, pose, 1);
        }
        assert!(texts.layout.contains(from), "{from}");
        texts.layout = texts.layout.replacen(from, to, 1);
        let warnings = texts.compile().warnings.into_iter();
        warnings.map(|warning| (format!("{} {}", warning.code, warning.message), warning.help)).collect()
    };
    assert_eq!(warnings("[6, 1, 0, 180]", "[6, 1, 0, 180]"), []);
    let found = warnings(
        "\"s8\", \"type\": \"module\", \"pose\": [5, 1, 0, 180]",
        "\"s8\", \"type\": \"module\", \"pose\": [4.97, 1, 0, 180]",
    );
    let told: Vec<&str> = found.iter().map(|(message, _)| message.as_str()).collect();
    assert_eq!(
        told,
        [
            "W0201 the conveyor `bed` of s7 ends 30 mm from where `bed` of s8 begins: they are not joined, and items fall where the first one ends",
            "W0201 the conveyor `bed` of s8 ends 30 mm from where `bed` of s9 begins: they are not joined, and items fall where the first one ends",
        ]
    );
    assert!(found[0].1.contains("\"pose\": [5, 1, 0, 180] for s8"), "{}", found[0].1);
    let turned = warnings("[6, 1, 0, 180]", "[6, 1, 0, 175]");
    assert!(turned.iter().any(|(_, help)| help.contains("\"pose\": [6, 1, 0, -180] for s7")), "{turned:?}");
    // Farther away it was not meant.
    assert_eq!(
        warnings(
            "\"s8\", \"type\": \"module\", \"pose\": [5, 1,",
            "\"s8\", \"type\": \"module\", \"pose\": [5, 1.2,"
        ),
        []
    );
}
