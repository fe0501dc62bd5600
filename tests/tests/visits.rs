//! The stops at which a vehicle can be, as far as its text and the layout tell: round these a gantry plans its paths.

use autogen_tests::{Texts, ariac, prototype};

/// Of the first vehicle of the default layout, with these types.
fn visits(texts: Texts) -> Option<Vec<usize>> {
    let project = texts.project();
    let vehicle = project.plant.machines.iter().find(|machine| machine.name == "agv1");
    vehicle.expect("agv1").visits.clone()
}

/// A type of vehicle with this text, which serves nobody.
fn driver(text: &str) -> Texts {
    let agv = format!(
        "automaton Agv on vehicle is Tray accepts at stops[0] approach 0.5, Source offers at stops[1] approach 0.2 {{
            parameter capacity: int 1..12 := 8;
            parameter unloads_at: int 1..2 := 1;
            {text}
        }}"
    );
    Texts { specs: vec![agv], ..ariac("default") }
}

#[test]
fn a_parameter_tells_them_for_each_vehicle() {
    assert_eq!(visits(ariac("default")), Some(vec![0, 2]));
    assert_eq!(visits(ariac("default").set("agv1.unloads_at=1")), Some(vec![0, 1]));
    assert_eq!(visits(prototype("default")), Some(vec![0, 1]));
}

#[test]
fn all_goals_count() {
    let both = "initial -> Near { goto(stops[1]); }
        state Near { when done -> Far { goto(stops[unloads_at]); } }
        state Far { when failed -> Near { goto(stops[1]); } }";
    assert_eq!(visits(driver(both)), Some(vec![0, 1, 2]));
    let one_of_them = "local next: int 0..2;
        initial -> Going { goto(stops[0]); }
        state Going { when done, first i in 1..2 with i <> next -> Going { next := i; goto(stops[i]); } }";
    assert_eq!(visits(driver(one_of_them)), Some(vec![0, 1, 2]));
    let stays = "initial state Staying { when capacity > 20 -> Staying {} }";
    assert_eq!(visits(driver(stays)), Some(vec![0]));
}

#[test]
fn where_a_goal_is_not_known_it_can_be_at_any() {
    let from_cell = "shared next: point by owner;
        initial -> Going { goto(stops[0]); }
        state Going { when done -> Going { next := next + up(0.1); goto(next); } }";
    assert_eq!(visits(driver(from_cell)), None);
}
