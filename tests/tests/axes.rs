//! Machines with positioned axes: what their arms touch, what lies on what, and how long a positioner takes.

use autogen::executor::Executor;
use autogen_tests::{Texts, side_by_side};
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
    assert!(reason(&texts).starts_with("collision of robot (box_1) with robot (box_5)"), "{}", reason(&texts));
    // Straight from the infeed to a place beside another box, without a detour over it.
    let low = ("move(put_at + up(over));\n        move(put_at);", "move(put_at);");
    let straight = ("until attached at most 1 s;\n        move(pick_at + up(over));", "until attached at most 1 s;");
    let texts = changed("palletizer", &[low, straight]);
    assert!(reason(&texts).starts_with("collision of robot (box_1) with robot (box_2)"), "{}", reason(&texts));
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

#[test]
fn an_item_is_not_taken_from_under_another_one() {
    // Without its rod nothing but the cup comes to the lower box.
    let rod = "part rod = body { on: lift; low: point(-0.02, -0.02, -0.08); high: point(0.02, 0.02, 0.85); };";
    let takes_back = "} -> Counting { placed := placed + 1; } else Stopped {}\n    state Taking = sequence {\n        move(spots[0]);\n        grip := true;\n        until attached at most 1 s;\n    } -> Counting {} else Stopped {}";
    let texts = changed(
        "palletizer",
        &[
            (rod, ""),
            ("} -> Counting { placed := placed + 1; } else Stopped {}", takes_back),
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
