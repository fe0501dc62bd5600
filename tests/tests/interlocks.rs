//! Arms that can be in one place at the same time, and what keeps them apart.

use autogen::diagnostic::Diagnostic;
use autogen::interlock::warnings;
use autogen::layout;
use autogen::source::Sources;
use autogen_tests::machines::{gantry, machine, rail_arm, vehicle};
use autogen_tests::{Texts, examples, on_all_processors};
use runtime_sim::collision::Moving;
use runtime_sim::kinematics::facing::Facing;
use runtime_sim::point::{Axis, Point};
use runtime_sim::random::Random;

const TYPES: &str = "
    device hand {
        part arm = chain {
            from: origin; lengths: [0.1807, -0.6127, -0.57155, 0.17415, 0.11985, 0.11655]; tool_length: 0.15;
            rest: pose + point(-0.7, 0, 0.3); speeds: [1.0, 1.0, 1.0, 1.0, 1.0, 1.0]; acceleration: 1.0;
        };
        part wrist = body { on: arm.wrist_3; low: point(-0.05, -0.05, -0.20); high: point(0.05, 0.05, 0); };
        in tool: point unit \"m\" = arm.tool;
        out goal: point unit \"m\";
        command 1 move(goal) = arm.direct(goal);
        constant rest: point unit \"m\" = arm.rest;
    }
    device stand { constant place: point unit \"m\" = pose; }
    interface Desk { parameter place: point; shared held: bool := false by lock; }
    automaton Stand on stand is Desk { initial state Idle { when false -> Idle {} } }";

/// A worker who goes to the desk and back, and what it does with the lock as it comes and as it goes.
fn worker(name: &str, [take, give]: [&str; 2], goal: &str) -> String {
    format!(
        "automaton {name} on hand {{
            knows desks: Desk[1];
            local desk: Desk;
            initial -> Away {{ move(rest); }}
            state Away {{ when done, first d in desks{take} move({goal}); }} }}
            state There {{ when done -> Leaving {{ move(rest); }} }}
            state Leaving {{ when done -> Back {{ {give} }} }}
            final state Back;
            any state except Back, Stuck {{ when failed -> Stuck {{}} }}
            final state Stuck;
        }}"
    )
}

const LOCKED: [&str; 2] = [" with not d.held -> There { desk := d; d.held := true;", "desk.held := false;"];
const FREE: [&str; 2] = [" -> There { desk := d;", ""];
/// It gives the lock back as soon as it has turned round.
const HASTY: [&str; 2] = [" with not d.held -> There { desk := d; d.held := true; d.held := false;", ""];
const AT_DESK: &str = "d.place + up(0.3)";

fn found(left: &str, right: &str, more: &str) -> Vec<String> {
    let layout = format!(
        r#"{{"robots": [
            {{"name": "left", "type": "left", "pose": [-0.8, 0, 0.5]}},
            {{"name": "right", "type": "right", "pose": [0.8, 0.1, 0.5]}},
            {{"name": "desk", "type": "stand", "pose": [0, 0, 0.5]}}]{more}}}"#
    );
    let specs = vec![TYPES.into(), left.into(), right.into()];
    of(&Texts { layout, specs, ..Texts::default() }).into_iter().map(|found| text(&found)).collect()
}

fn text(found: &Diagnostic) -> String {
    format!("{}: {}; {}", found.code, found.message, found.notes.join("; "))
}

fn of(texts: &Texts) -> Vec<Diagnostic> {
    let project = texts.project();
    let mut sources = Sources::default();
    let file = sources.add("layout.json", texts.layout.as_str());
    let (layout, _) = layout::parse(&sources, file);
    warnings(&layout.expect("it compiles").names(), &project)
}

#[test]
fn two_arms_over_one_place_need_a_lock() {
    let pair = |left, right| found(&worker("Left", left, AT_DESK), &worker("Right", right, AT_DESK), "");
    for (left, right) in [(FREE, FREE), (LOCKED, FREE), (FREE, LOCKED), (LOCKED, HASTY)] {
        let found = pair(left, right);
        assert_eq!(found.len(), 1, "{found:?}");
        let says = "W0202: left and right can be in one place at the same time: no lock keeps them apart; both come to x ";
        assert!(found[0].starts_with(says), "{found:?}");
    }
    assert_eq!(pair(LOCKED, LOCKED), [""; 0]);
}

#[test]
fn the_volume_is_where_both_come() {
    let found = found(&worker("Left", FREE, AT_DESK), &worker("Right", FREE, AT_DESK), "");
    // The wrists are 0.1 m square, and end 0.3 m over the desk; both come from the side of positive y: the left one turns
    // round its base, the right one rests 0.1 m beside.
    assert!(
        found[0].ends_with("both come to x -0.05 to 0.05, y -0.05 to 0.12, z 0.80 to 1.00 m"),
        "{found:?}"
    );
}

#[test]
fn arms_that_do_not_meet_need_none() {
    let aside = "d.place + point(0.4, 0.1, 0.3)";
    assert_eq!(found(&worker("Left", FREE, "rest"), &worker("Right", FREE, aside), ""), [""; 0]);
}

#[test]
fn a_layout_may_say_why_they_do_not_meet() {
    let more = r#", "may_touch": [{"pair": ["right", "left"], "reason": "a person sends them one after the other"}]"#;
    assert_eq!(found(&worker("Left", FREE, AT_DESK), &worker("Right", FREE, AT_DESK), more), [""; 0]);
}

#[test]
fn of_a_goal_that_nobody_knows_the_whole_range_is_taken() {
    let types = TYPES
        .replace("in tool", "part dial = setpoint { begins: 0.0; }; in dialled: real = dial.value; in tool");
    let layout = r#"{"robots": [
        {"name": "left", "type": "left", "pose": [-0.8, 0, 0.5]},
        {"name": "right", "type": "right", "pose": [0.8, 0.1, 0.5]},
        {"name": "desk", "type": "stand", "pose": [0, 0, 0.5]}]}"#;
    let left = worker("Left", FREE, "point(dialled, 0, 0.8)");
    let specs = vec![types, left, worker("Right", FREE, AT_DESK)];
    let found = of(&Texts { layout: layout.into(), specs, ..Texts::default() });
    assert!(
        text(&found[0]).ends_with("the goals of left are not known: all that it reaches is taken"),
        "{found:?}"
    );
}

#[test]
fn vehicles_that_pass_beside_one_another_are_apart() {
    let beside = |y: f64| {
        let at = |x: f64| Point::new(x, y, 0.0);
        let vehicle = machine("vehicle", &vehicle(at(0.0), [at(-3.3), at(-8.0)]));
        Moving::new(&vehicle).expect("it moves").whole()
    };
    // Its bumper is 0.67 m wide.
    assert!(beside(0.0).is_apart(&beside(0.7)));
    assert!(!beside(0.0).is_apart(&beside(0.6)));
}

#[test]
fn a_path_leads_to_each_place_that_is_reached_and_to_no_other_one() {
    let arms = [
        rail_arm(Point::new(-1.3, 0.7, 1.127), Axis::Y, [0.4, 4.8]),
        gantry(Point::new(0.0, 0.0, 2.0), [-3.0, 3.0], [-2.0, 4.0]),
    ];
    let mut random = Random::new(5);
    let mut reached = 0;
    for arm in arms.map(|arm| Moving::new(&machine("arm", &arm)).expect("it moves")) {
        for _ in 0..2000 {
            let mut drawn = |low: f64, high: f64| low + random.fraction() * (high - low);
            let goal = Point::new(drawn(-5.0, 5.0), drawn(-4.0, 6.0), drawn(0.0, 2.0));
            let leads = arm.path(&[(goal, Facing::Down)]).is_some();
            assert_eq!(arm.reaches(goal, Facing::Down), leads, "{goal:?}");
            reached += usize::from(leads);
        }
    }
    assert!((500..3500).contains(&reached), "{reached}");
}

#[test]
fn the_examples_need_none_that_they_lack() {
    let lines = examples();
    for ((name, _), found) in lines.iter().zip(on_all_processors(&lines, |(_, texts)| of(texts))) {
        assert!(found.is_empty(), "{name}: {found:?}");
    }
}
