//! Tools that come from the side: the turning cell of the examples, whose arm takes blanks from above and puts them into a
//! chuck.

use autogen_tests::{Texts, lathe_on_a_rail, plain, side_by_side, stepped};
use runtime_sim::run::Seen;

/// The cell with one text of its types replaced.
fn cell(changes: &[(&str, &str)]) -> Texts {
    side_by_side("lathe/lathe").replaced(changes)
}

fn reason(changes: &[(&str, &str)]) -> String {
    stepped::report(&cell(changes), |_| {}).reason.to_string()
}

const LATHE: usize = 2;
const ARM: usize = 1;

/// With an ABB IRB 2400/10 instead of the UR10e: as in the example of docs/devices.md.
const ABB: [(&str, &str); 2] = [
    (
        "lengths: [0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655];",
        "opw: [0.100, -0.135, 0, 0.615, 0.705, 0.755, 0.085]; offsets: [0, 0, -90, 0, 0, 0];
         lowest: [-180, -100, -60, -200, -120, -400]; highest: [180, 110, 65, 200, 120, 400];",
    ),
    ("rest: pose + point(0.70, 0, 0.45)", "rest: pose + point(0.80, 0, 0.45)"),
];

#[test]
fn a_chuck_is_filled_and_emptied_from_the_side() {
    for changes in [&[][..], &ABB] {
        let mut in_chuck = 0;
        let mut off: f64 = 0.0;
        let report = stepped::report(&cell(changes), |seen: &Seen| {
            let plant = seen.plant;
            for item in plant.items().borne_by(LATHE) {
                let (place, upper) =
                    (plant.place(*item).expect("a place"), plant.upper(*item).expect("a direction"));
                assert_eq!([upper.x, upper.y, upper.z], [-1.0, 0.0, 0.0]);
                // Its underside is at the face of the chuck.
                let gap = [place.x - 1.15, place.y, place.z - 1.0];
                assert!(gap.iter().all(|gap| gap.abs() < 1e-6), "{gap:?}");
                in_chuck += 1;
            }
            // Goal, then direction: words of the outputs are those of `grip`, `goal`, `ahead` in this order.
            let tool = plant.position(ARM).expect("a tool");
            // Behind the bow of the motion to the approach, which all joints make together.
            let is_at_face = (1.04..1.15).contains(&tool.x) && tool.z > 0.9 && tool.y.abs() < 0.05;
            if is_at_face {
                off = off.max(tool.y.abs()).max((tool.z - 1.0).abs());
            }
        });
        assert_eq!(report.reason.to_string(), "all items collected");
        assert!(in_chuck > 5 * 3000, "{in_chuck}");
        // In front of the chuck the tool goes straight.
        assert!(off < 0.001, "{off}");
    }
}

/// The conveyors are out of reach of an arm that stands where it is.
#[test]
fn an_arm_on_a_rail_tends_the_lathe() {
    for arm in [None, Some(ABB[0].1)] {
        let texts = lathe_on_a_rail(arm);
        let mut goes = [f64::INFINITY, f64::NEG_INFINITY];
        let report = stepped::report(&texts, |seen: &Seen| {
            let tool = seen.plant.position(ARM).expect("a tool");
            goes = [goes[0].min(tool.y), goes[1].max(tool.y)];
        });
        assert_eq!(report.reason.to_string(), "all items collected");
        assert!(goes[0] < -1.6 && goes[1] > 1.6, "{goes:?}");
        let mut stands = texts;
        let from = "range: [-1.5, 1.2]";
        assert!(stands.specs[0].contains(from));
        stands.specs[0] = stands.specs[0].replace(from, "range: [-0.1, 0.1]");
        assert!(wrong(&stands).starts_with(r#"["E0401"#));
    }
}

/// How far the wrist of the UR10e stays from what its links reach, the tool level: from the maker's measures. The second link
/// of the wrist is then upright in the plane of the arm.
fn margin(tool: [f64; 3]) -> f64 {
    let [x, y, z] = tool;
    let wrist = x - 0.11655 - 0.15;
    let radius = wrist.hypot(y);
    let ahead = (radius * radius - 0.17415 * 0.17415).sqrt();
    let height = z - 0.75 - 0.1807;
    let slack = |height: f64| {
        let wrist = ahead.hypot(height);
        (0.6127 + 0.57155 - wrist).min(wrist - (0.6127 - 0.57155))
    };
    let slack = slack(height - 0.11985).max(slack(height + 0.11985));
    // To go past the first axis the plane of the arm, which is beside it, has to turn.
    radius - (ahead - slack).max(0.0).hypot(0.17415)
}

#[test]
fn the_margin_is_that_of_a_level_tool() {
    let project = cell(&[]).project();
    let at = |x: f64| [x, 0.0, 1.0];
    let wanted = margin(at(1.15 - 0.03)).min(margin(at(1.15 - 0.03 - 0.13)));
    let edges = project.edges.iter().filter(|edge| edge.from == LATHE || edge.to == LATHE);
    let found: Vec<f64> = edges.map(|edge| edge.margin).collect();
    assert!(
        found.len() == 2 && found.iter().all(|margin| (margin - wanted).abs() < 1e-6),
        "{found:?} {wanted}"
    );
    // No joint has limits.
    assert!(project.edges.iter().all(|edge| edge.wrist_room.is_none()));
}

#[test]
fn limits_of_the_wrist_are_told_in_degrees() {
    let project = cell(&ABB).project();
    let room = |to: usize| {
        let edge = project.edges.iter().find(|edge| edge.to == to).expect("an edge");
        edge.wrist_room.expect("limits")
    };
    // Before the arm, level: the forearm leans by so much against the tool, and the fifth joint turns back by 120 degrees at
    // most; the fourth and the sixth are at 0.
    let lean = |tool_x: f64| {
        let (ahead, height) = (tool_x - 0.235 - 0.1, 1.0 - 0.75 - 0.615);
        let (upper, forearm) = (0.705_f64, 0.135_f64.hypot(0.755));
        let square: f64 = ahead * ahead + height * height;
        let elbow = ((square - upper * upper - forearm * forearm) / (2.0 * upper * forearm)).acos();
        let shoulder = ahead.atan2(height) - (forearm * elbow.sin()).atan2(upper + forearm * elbow.cos());
        let bend = (-0.135_f64).atan2(0.755);
        (shoulder + elbow - bend).to_degrees()
    };
    let wanted = [1.12, 0.99].map(|x| 120.0 - (90.0 - lean(x)).abs());
    let wanted = wanted[0].min(wanted[1]);
    assert!((room(LATHE) - wanted).abs() < 1e-6, "{} {wanted}", room(LATHE));
    // With so little room that it is used up, the place is out of reach.
    let less = |degrees: f64| {
        let mut changes = ABB.to_vec();
        let high = format!("highest: [180, 110, 65, 200, {degrees}, 400]");
        let text = ABB[0].1.replace("highest: [180, 110, 65, 200, 120, 400]", &high);
        let text = text.replace(
            "lowest: [-180, -100, -60, -200, -120, -400]",
            &format!("lowest: [-180, -100, -60, -200, {}, -400]", -degrees),
        );
        changes[0].1 = &text;
        cell(&changes).compile().project.is_some()
    };
    let used = 120.0 - room(LATHE);
    let down = 120.0 - project.edges.iter().filter_map(|edge| edge.wrist_room).fold(f64::INFINITY, f64::min);
    assert!(less(down.max(used) + 0.01));
    assert!(!less(used - 0.01));
}

/// Blanks 30 mm high, gripped 20 mm over their undersides by a finger on each side.
#[test]
fn a_blank_is_gripped_below_its_upper_side() {
    let fingers = "part fingers = body { on: arm.wrist_3; low: point(-0.02, -0.05, -0.06); high: point(0.02, 0.05, 0); grips: true; };";
    let beside = "part left = body { on: arm.wrist_3; low: point(0.022, -0.02, -0.06); high: point(0.05, 0.02, 0.01); grips: true; };
        part right = body { on: arm.wrist_3; low: point(-0.05, -0.02, -0.06); high: point(-0.022, 0.02, 0.01); grips: true; };";
    let mut texts = cell(&[(fingers, beside)]).set("tender.height=0.02");
    texts.layout = texts.layout.replace("\"turn\": 30", "\"turn\": 30, \"length\": 0.02");
    let scenario = texts.scenario.as_mut().expect("a scenario");
    *scenario = scenario.replace("\"height\": 0.03", "\"height\": 0.03, \"grasp\": 0.02");
    let mut in_chuck = 0;
    let report = stepped::report(&texts, |seen: &Seen| {
        for item in seen.plant.items().borne_by(LATHE) {
            let place = seen.plant.place(*item).expect("a place");
            assert!((place.x - 1.15).abs() < 1e-6, "{place:?}");
            in_chuck += 1;
        }
    });
    assert_eq!(report.reason.to_string(), "all items collected");
    assert!(in_chuck > 5 * 3000, "{in_chuck}");
    let wanted = margin([1.15 - 0.02, 0.0, 1.0]).min(margin([1.15 - 0.02 - 0.13, 0.0, 1.0]));
    let project = texts.project();
    let edges = project.edges.iter().filter(|edge| edge.from == LATHE || edge.to == LATHE);
    let found: Vec<f64> = edges.map(|edge| edge.margin).collect();
    assert!(
        found.len() == 2 && found.iter().all(|margin| (margin - wanted).abs() < 1e-6),
        "{found:?} {wanted}"
    );
}

#[test]
fn what_is_let_go_beside_the_chuck_falls() {
    let beside = [(
        "constant grip_at: point unit \"m\" = origin * point(0 - length, 0, face)",
        "constant grip_at: point unit \"m\" = origin * point(0 - length - 0.02, 0, face)",
    )];
    assert_eq!(reason(&beside), "interlock of lathe: the process cycle was started without an item");
}

#[test]
fn a_part_in_the_chuck_lies_on_its_side() {
    // It is 40 mm wide there.
    let jaw = |low: f64| {
        let body = format!(
            "part jaw = body {{ at: origin; low: point(-0.02, {low}, 0.99); high: point(-0.01, {}, 1.01); }};\n part headstock",
            low + 0.005
        );
        reason(&[("part headstock", &body)])
    };
    assert_eq!(jaw(0.026), "all items collected");
    let touches = jaw(0.016);
    assert!(touches.starts_with("collision of arm (blank_1) with lathe (jaw)"), "{touches}");
}

fn wrong(texts: &Texts) -> String {
    let outcome = texts.compile();
    assert!(outcome.project.is_none());
    let codes: Vec<&str> = outcome.diagnostics.iter().map(|found| found.code).collect();
    format!("{codes:?}\n{}", plain(&outcome.sources, &outcome.diagnostics))
}

#[test]
fn directions_that_a_tool_cannot_have_are_refused() {
    let tilted =
        wrong(&cell(&[("define ahead = origin * point(1, 0, 0) - pose;", "define ahead = point(1, 0, 1);")]));
    assert!(
        tilted.starts_with(r#"["E0704", "E0709"]"#) || tilted.starts_with(r#"["E0709", "E0704"]"#),
        "{tilted}"
    );
    assert!(tilted.contains("the setting toward is neither down nor level"), "{tilted}");
    assert!(tilted.contains("this direction is neither down nor level"), "{tilted}");
    let number = wrong(&cell(&[("toward ahead;\n}", "toward 1.0;\n}")]));
    assert!(number.starts_with(r#"["E0709"]"#), "{number}");
    let stacked = wrong(&cell(&[("toward: ahead;", "toward: ahead; stacks: true;")]));
    assert!(stacked.contains("items are not stacked at a place that is filled from the side"), "{stacked}");
    let turns = wrong(&cell(&[(
        "part chuck = place {",
        "part table = cylinder { extend: 1 s; retract: 1 s; turns: 90; pivot: pose; };\n part chuck = place { on: table;",
    )]));
    assert!(turns.starts_with(r#"["E0711"]"#) && turns.contains("is on what turns"), "{turns}");
}

#[test]
fn an_arm_whose_tool_only_points_down_is_refused() {
    let axes = "part x = axis { from: origin * frame(0.2, 0, 0.6, 0); along: x; range: [-0.4, 1.6]; speed: 1.0; acceleration: 1.0; };
        part y = axis { on: x; along: y; range: [-1.5, 1.5]; speed: 1.0; acceleration: 1.0; };
        part z = axis { on: y; along: z; range: [-0.6, 0.4]; speed: 1.0; acceleration: 1.0; };
        part arm = chain { on: z; tool_length: 0.15; rest: pose + point(0.70, 0, 0.35); };
        part hand";
    let mut texts = cell(&[]);
    let text = &mut texts.specs[0];
    let begin = text.find("part arm = chain {").expect("the arm");
    let end = begin + text[begin..].find("part hand").expect("its end");
    text.replace_range(begin..end + "part hand".len(), axes);
    *text = text.replace("on: arm.wrist_3;", "on: z;");
    let outcome = texts.compile();
    let codes: Vec<&str> = outcome.diagnostics.iter().map(|found| found.code).collect();
    assert!(codes.contains(&"E0412"), "{}", plain(&outcome.sources, &outcome.diagnostics));
    assert!(!codes.contains(&"E0401"), "{}", plain(&outcome.sources, &outcome.diagnostics));
}
