//! Arms over places that stand, move, or are not there: what is dangerous, and what is not.

use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, End, explore};
use autogen_search::plant::Faults;
use autogen_search::violation::Violation;
use autogen_tests::Texts;
use autogen_tests::bounds;

const BOUNDS: Bounds = Bounds { violations: 100, ..bounds::BOUNDS };

const NOTHING_ORDERED: &str = r#"{"kinds": [{"name": "battery", "height": 0.053}], "orders": []}"#;

/// A tool on two axes. It rests beside its pose, and comes over it when `told` is set.
const HAND: &str = "device hand {
        part slide = axis { from: origin * frame(0.15, 0, 1.6, 0); along: y; range: [-2, 2]; speed: 1.0; acceleration: 1.0; };
        part lift = axis { on: slide; along: z; range: [-1.2, 0]; speed: 1.0; acceleration: 1.0; };
        part robot = chain { on: lift; tool_length: 0.1; rest: origin * point(0.15, 1.5, 1.5); };
        out goal: point unit \"m\";
        command 1 move(goal) = robot.joints(goal);
        constant over: point unit \"m\" = origin * point(0.15, 0, 0.9);
    }
    interface Sign { shared told: bool := false by owner; }
    automaton Hand on hand {
        knows signs: Sign[1..];
        initial -> Resting {}
        state Resting { when first sign in signs with sign.told -> Reaching { move(over); } }
        state Reaching {
            when done -> Over {}
            when failed -> Reaching { move(over); }
        }
        final state Over;
    }";

/// One machine of the type `mover`, and so many hands at its pose.
fn found(mover: &str, hands: usize, automaton: &str) -> Vec<Violation> {
    let hands = (0..hands).map(|n| format!(r#", {{"name": "hand{n}", "type": "hand", "pose": [0, 0, 0]}}"#));
    let hands: String = hands.collect();
    let layout =
        format!(r#"{{"robots": [{{"name": "mover", "type": "mover", "pose": [0, 0, 0], {mover}}}{hands}]}}"#);
    let texts = Texts {
        layout,
        specs: vec![HAND.into(), automaton.into()],
        scenario: Some(NOTHING_ORDERED.into()),
        ..Texts::default()
    };
    let model =
        model(&texts.project(), &Asked::with(Faults::None)).expect("a line that can be searched").model;
    let outcome = explore(&model, &BOUNDS, &mut |_| true);
    assert_eq!(outcome.end, End::Complete);
    outcome.violations.into_iter().map(|(violation, _)| violation).collect()
}

const VEHICLE: &str = r#""destinations": [[3, 0, 0], [6, 0, 0]]"#;

/// A vehicle that leaves its first stop, and has arrived at the second one.
fn vehicle(leaving: &str, away: &str, property: &str) -> String {
    format!(
        "automaton Mover on vehicle is Sign {{
            {property}
            initial -> Leaving {{ {leaving} goto(stops[1]); }}
            state Leaving {{
                when done -> Away {{ {away} }}
                when failed -> Leaving {{ goto(stops[1]); }}
            }}
            state Away {{ when failed -> Away {{ goto(stops[0]); }} }}
        }}"
    )
}

const BELT: &str = r#""orient": "y", "orient_range": [-5, 5]"#;

/// A belt that is started.
fn belt(property: &str) -> String {
    format!(
        "automaton Mover on belt is Sign {{
            {property}
            initial -> Starting {{ drive(); }}
            state Starting {{ when done or failed -> Running {{ told := true; }} }}
            final state Running;
        }}"
    )
}

const STOPS_ITSELF: &str = "invariant not told else stop machine \"it has to stand\";";

fn two_arms(violation: &Violation) -> bool {
    matches!(violation, Violation::TwoArms { .. })
}

fn moves_under(violation: &Violation) -> bool {
    matches!(violation, Violation::MovesUnder { .. })
}

#[test]
fn two_arms_are_over_a_place_that_is_there() {
    let stays = "automaton Mover on vehicle is Sign {
        initial -> Here { told := true; }
        final state Here;
    }";
    assert!(found(VEHICLE, 2, stays).iter().any(two_arms));
    assert_eq!(found(VEHICLE, 1, stays), []);
}

#[test]
fn two_arms_may_be_where_a_place_has_been() {
    assert_eq!(found(VEHICLE, 2, &vehicle("", "told := true;", "")), []);
}

/// It never comes back, so nothing but its departure is dangerous.
#[test]
fn a_vehicle_departs_under_an_arm() {
    assert!(found(VEHICLE, 1, &vehicle("told := true;", "", "")).iter().any(moves_under));
}

/// It has left before the arm comes, so nothing but its arrival is dangerous.
#[test]
fn a_vehicle_arrives_under_an_arm() {
    assert!(found(VEHICLE, 1, &vehicle("", "told := true; goto(stops[0]);", "")).iter().any(moves_under));
}

#[test]
fn a_conveyor_runs_under_an_arm() {
    assert!(found(BELT, 1, &belt("")).iter().any(moves_under));
}

/// It stands in the middle of its trip, or with its belt on.
#[test]
fn what_is_stopped_by_itself_moves_under_no_arm() {
    for found in
        [found(VEHICLE, 1, &vehicle("told := true;", "", STOPS_ITSELF)), found(BELT, 1, &belt(STOPS_ITSELF))]
    {
        assert!(matches!(found[..], [Violation::MachineStops { .. }]), "{found:?}");
    }
}
