//! Machines with positioned axes: what their arms touch, what lies on what and becomes a part of what, and how long a
//! positioner takes.

use autogen::executor::Executor;
use autogen_tests::{Texts, side_by_side};
use runtime_sim::carrier::Carrier;
use runtime_sim::item::Item;
use runtime_sim::memory::Memory;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, run_again};

/// A scene with its text changed.
fn changed(scene: &str, changes: &[(&str, &str)]) -> Texts {
    let mut texts = side_by_side(&format!("scenes/{scene}"));
    for (from, to) in changes {
        assert!(texts.specs[0].contains(from), "{from}");
        texts.specs[0] = texts.specs[0].replace(from, to);
    }
    texts
}

/// The tending cell with an ABB IRB 2400/10 instead of its UR10e, for three parts. Lengths and offsets: the examples of the
/// library opw_kinematics. Limits: the maker's data sheet.
fn tending_by_abb() -> Texts {
    let mut texts = side_by_side("tending/tending");
    let text = &mut texts.specs[0];
    let cut = |text: &mut String, from: &str, to: &str, new: &str| {
        let begin = text.find(from).expect("the text of the arm");
        let end = begin + text[begin..].find(to).expect("its end");
        text.replace_range(begin..end, new);
    };
    cut(
        text,
        "lengths: [",
        "rest:",
        "opw: [0.100, -0.135, 0, 0.615, 0.705, 0.755, 0.085]; offsets: [0, 0, -90, 0, 0, 0]; tool_length: 0.15;
        lowest: [-180, -100, -60, -200, -120, -400]; highest: [180, 110, 65, 200, 120, 400];
        ",
    );
    cut(text, "joints: [shoulder_pan", "};", "");
    *text = text.replace("rest: pose + point(0.70, 0, 0.55)", "rest: pose + point(0.80, 0, 0.55)");
    let scenario = texts.scenario.as_mut().expect("a scenario");
    *scenario = scenario.replace("\"bracket\": 41", "\"bracket\": 3");
    texts
}

/// How far the wrist of that arm stays from what its upper arm and its forearm reach, from its measures: the tool points
/// down, fingers and flange are 0.235 m long, the base is 0.75 m high.
fn margin_by_abb(tool: [f64; 3]) -> f64 {
    let [x, y, z] = tool;
    let forearm = 0.135_f64.hypot(0.755);
    let height = z + 0.235 - 0.75 - 0.615;
    let slack = |ahead: f64| {
        let wrist = ahead.hypot(height);
        (0.705 + forearm - wrist).min(wrist - (0.705 - forearm).abs())
    };
    slack(x.hypot(y) - 0.1).max(slack(-x.hypot(y) - 0.1))
}

fn run(texts: &Texts, mut observer: impl FnMut(&Seen)) -> Report {
    let project = texts.project();
    let mut executor = Executor::new(&project.system);
    let memory = &mut Memory::default();
    let report = run_again(&project.plant, &mut executor, Stepping::Checked, memory, &mut observer);
    report.expect("a line that can be run")
}

fn reason(texts: &Texts) -> String {
    run(texts, |_| {}).reason.to_string()
}

#[test]
fn what_hangs_on_an_arm_touches_what_lies_on_its_own_machine() {
    // The second layer is put where the first one lies.
    let texts = changed("palletizer", &[("layers := layers + box_height;", "")]);
    assert!(
        reason(&texts).starts_with("collision of robot (box_1) with robot (box_5)"),
        "{}",
        reason(&texts)
    );
    // The boxes of the second layer fall into those of the first one.
    let texts = changed("palletizer", &[("stacks: true;", "")]);
    assert_eq!(reason(&texts), "interlock of robot: box_5 comes down on box_1, which lies there");
    // Straight from the infeed to a place beside another box, without a detour over it.
    let low = ("move(put_at + up(over));\n        move(put_at);", "move(put_at);");
    let straight =
        ("until attached at most 1 s;\n        move(pick_at + up(over));", "until attached at most 1 s;");
    let texts = changed("palletizer", &[low, straight]);
    assert!(
        reason(&texts).starts_with("collision of robot (box_1) with robot (box_2)"),
        "{}",
        reason(&texts)
    );
}

/// The tool stops 20 mm over the box, and its cup is so soft: the box hangs at the cup, and is put down where it belongs.
#[test]
fn what_is_gripped_from_a_little_above_hangs_at_the_tool() {
    let above = "move(pick_at + up(0.02));\n        grip := true;";
    let texts = changed("palletizer", &[("move(pick_at);\n        grip := true;", above)]);
    let mut hanging = 0;
    let report = run(&texts, |seen| {
        for (item, all) in seen.plant.items().all().enumerate() {
            let Carrier::Grip { machine, .. } = all.carrier else { continue };
            let places = [seen.plant.position(machine), seen.plant.place(item)];
            let [tool, place] = places.map(|place| place.expect("it is on the line"));
            assert!((tool.z - place.z - 0.15).abs() < 1e-9, "{tool:?} {place:?}");
            hanging += 1;
        }
    });
    assert!(hanging > 8, "{hanging}");
    assert_eq!(report.reason, "all orders made");
}

#[test]
fn what_moves_on_a_machine_without_its_arm_is_not_checked_against_itself() {
    // A door whose leaf is in its frame, and another one that overlaps it.
    let eye = "part eye = beam { across: infeed; at: 1.40; };";
    let doors = "part gate = cylinder { extend: 1 s; retract: 1 s; slides: point(0, 0, -0.2); };
    part leaf = body { on: gate; low: pose + point(1.9, -0.3, 0.0); high: pose + point(2.0, 0.3, 0.1); };
    part other = cylinder { extend: 1 s; retract: 1 s; slides: point(0, 0, -0.2); };
    part wing = body { on: other; low: pose + point(1.9, -0.4, 0.0); high: pose + point(1.95, 0.3, 0.1); };
    ";
    let texts = changed("palletizer", &[(eye, &format!("{doors}{eye}"))]);
    assert_eq!(reason(&texts), "all orders made");
}

/// The second time a bar is in the way, along the very path that was free the first time.
#[test]
fn an_arm_touches_what_a_cylinder_of_its_own_machine_has_moved_into_its_way() {
    let eye = "part eye = beam { across: infeed; at: 1.40; };";
    let gate = "part gate = cylinder { extend: 1 s; retract: 1 s; slides: point(0, 0.4, 0); };
    part bar = body { on: gate; low: pose + point(1.25, -0.45, 0.84); high: pose + point(1.35, -0.35, 0.88); };
    ";
    let run = "/// motor of the infeed";
    let extend = "/// moves the bar\n    out block: bool = gate.extend stop false;\n    ";
    let blocks = ("} -> Placing {} else", "} -> Placing { block := true; } else");
    // Straight down from a little higher, every time.
    let down = (
        "move(pick_at + up(over));\n        move(pick_at);",
        "move(pick_at + up(over + 0.1));\n        move(pick_at + up(over));\n        move(pick_at);",
    );
    let back = (
        "move(put_at + up(over));\n        move(pick_at + up(over));",
        "move(put_at + up(over));\n        move(pick_at + up(over + 0.1));",
    );
    let changes = [(eye, &*format!("{gate}{eye}")), (run, &*format!("{extend}{run}")), down, back, blocks];
    let reason = reason(&changed("palletizer", &changes));
    // Where the rod comes down on the bar: later on, every motion would find it in the bar.
    let is_found = reason.starts_with("collision of robot (bar) with robot (rod)");
    assert!(is_found && reason.ends_with(", 0.880)"), "{reason}");
    assert_eq!(self::reason(&changed("palletizer", &changes[..4])), "all orders made");
}

#[test]
fn an_item_is_not_taken_from_under_another_one() {
    // Without its rod nothing but the cup comes to the lower box.
    let rod =
        "part rod = body { on: lift; low: point(-0.02, -0.02, -0.08); high: point(0.02, 0.02, 0.85); };";
    let counts = "} -> Counting { placed := placed + 1; failures := 0; } else Placing { failures += 1; }";
    let takes_back = format!(
        "{counts}\n    state Taking = sequence {{\n        move(spots[0]);\n        grip := true;\n        until attached at most 1 s;\n    }} -> Counting {{}} else Counting {{}}"
    );
    let texts = changed(
        "palletizer",
        &[
            (rod, ""),
            (counts, &*takes_back),
            ("state Counting {", "state Counting {\n        when placed = 5 -> Taking {}"),
        ],
    );
    assert_eq!(reason(&texts), "interlock of robot: took an item on which another one lies");
}

#[test]
fn a_positioner_takes_its_way_over_its_speed() {
    // 2.0 m at 0.5 m/s, and a pause of 2 s on the way; then 2.0 m, 0.8 m and 0.8 m.
    let texts = side_by_side("scenes/elevator_advanced");
    // Words of the images: the number of the command, and that of the last one that has ended.
    let (cmd, ack) = (0, 2);
    let mut began: Option<f64> = None;
    let mut times: Vec<f64> = Vec::new();
    run(&texts, |seen: &Seen| {
        let now = seen.scan as f64 * 0.01;
        let [asked, answered] = [seen.outputs[0][cmd], seen.inputs[0][ack]];
        match began {
            None if asked != answered => began = Some(now),
            Some(from) if asked == answered => {
                times.push(now - from);
                began = None;
            }
            _ => {}
        }
    });
    let wanted = [6.0, 4.0, 1.6, 1.6, 4.0];
    assert!(times.len() >= wanted.len(), "{times:?}");
    for (time, wanted) in times.iter().zip(wanted) {
        // The command is read in the scan after it is given, and its answer in the scan after that.
        assert!((time - wanted).abs() <= 0.02 + 1e-9, "{times:?}");
    }
}

#[test]
fn an_arm_of_another_maker_tends_the_mill() {
    let texts = tending_by_abb();
    let project = texts.project();
    // Upper sides of a part at the stopper of the infeed, and 0.18 m over it.
    let at = [0.55, -2.55 + 1.92 - 0.02, 0.05 + 0.80 + 0.02];
    let over = [at[0], at[1], at[2] + 0.18];
    let wanted = margin_by_abb(at).min(margin_by_abb(over));
    let margin = project.edges[0].margin;
    // Its joints come to their limits before.
    assert!((0.1..wanted).contains(&margin), "{margin} {wanted}");
    assert_eq!(reason(&texts), "all items collected");
}

#[test]
fn limits_of_joints_put_places_out_of_reach() {
    // The second joint goes no farther than 20 degrees forwards: the mill and the conveyors are too far.
    let mut texts = tending_by_abb();
    texts.specs[0] = texts.specs[0].replace("highest: [180, 110,", "highest: [180, 20,");
    let outcome = texts.compile();
    assert!(outcome.project.is_none());
    assert!(outcome.diagnostics.iter().any(|found| found.code == "E0401"), "{:?}", outcome.diagnostics);
}

/// The box is taken apart again: base and lid are what they were, the lid on the free slot beside the base.
#[test]
fn a_process_frees_the_parts_of_an_item() {
    let taken_apart = |slots: &str| {
        changed(
            "assembler",
            &[
                ("slots: [point(0, 0, 0)]", slots),
                ("floor_y: [-0.08, 0.08]", "floor_y: [-0.08, 0.24]"),
                (
                    "part out_lane",
                    "part open = process { on: nest; time: 1 s; frees: true; makes: [box, base]; };\n part out_lane",
                ),
                (
                    "/// starts the press",
                    "in opening: bool = open.runs; in opened: bool = open.ended; out undo: bool = open.start stop false;\n /// starts the press",
                ),
                (
                    "when pressed and not pressing -> Unloading {} }",
                    "when pressed and not pressing -> Undoing { undo := true; }
                    when pressing and pressed -> Unloading {} }
                    state Undoing within 1 s { when opening -> Opening { undo := false; } }
                    state Opening within 5 s { when opened and not opening -> Ended; }
                    final state Ended;",
                ),
            ],
        )
    };
    let mut ends = Vec::new();
    let texts = taken_apart("slots: [point(0, 0, 0), point(0, 0.16, 0)]");
    run(&texts, |seen: &Seen| {
        let items = seen.plant.items().all();
        let ended = |item: &Item| (item.kind, item.carrier.offset().map(|at| [at.x, at.y, at.z]));
        ends = items.map(ended).collect();
    });
    // Kinds: 0 base, 1 lid.
    assert!(ends.contains(&(1, Some([0.0, 0.16, 0.0]))), "{ends:?}");
    let base = ends.iter().find(|(kind, at)| *kind == 0 && at.is_some()).expect("a base in the press");
    assert!(base.1.is_some_and(|at| at.iter().all(|along| along.abs() < 0.01)), "{ends:?}");

    let none = reason(&taken_apart("slots: [point(0, 0, 0)]"));
    assert_eq!(none, "interlock of assembler: the process open has no free slot for a lid");
}

#[test]
fn a_press_joins_what_lies_in_it_and_nothing_less() {
    let texts = side_by_side("scenes/assembler");
    let mut ends = Vec::new();
    run(&texts, |seen: &Seen| {
        let name = |item: usize| seen.plant.items()[item].kind;
        let part_of = |item: usize| match seen.plant.items()[item].carrier {
            Carrier::Part { of } => Some((name(item), name(of))),
            _ => None,
        };
        ends = (0..seen.plant.items().count()).map(part_of).collect();
    });
    // Kinds: 0 base, 1 lid, 2 box. Each lid is a part of a box.
    assert_eq!(ends, [None, None, Some((1, 2)), Some((1, 2))]);

    let lid = "move(lid_at + up(0.2)); move(lid_at); grip := true; until attached at most 1 s; move(lid_at + up(0.2));
        move(nest_at + up(0.2)); move(nest_at + up(0.101)); grip := false; until not attached at most 1 s;";
    let without = reason(&changed("assembler", &[(lid, "")]));
    assert_eq!(without, "interlock of assembler: the process press was started without a lid beside it");
}
