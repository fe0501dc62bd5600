//! What was seen over a conveyor at rest and is forgotten: a grip there may find an item or none, and nothing is concluded from
//! it.

use autogen::library;
use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, Outcome, explore};
use autogen_search::plant::Faults;
use autogen_search::violation::Violation;
use autogen_tests::{Texts, bounds, own_line};

const BOUNDS: Bounds = Bounds { answers: Some(1), ..bounds::BOUNDS };

const TWO_PARTS: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}, {"name": "pump", "height": 0.11}],
    "orders": [{"station": "as1", "parts": {"battery": 1, "pump": 1}}]
}"#;

/// A type of the library with texts replaced.
fn changed(name: &str, changes: &[(&str, &str)]) -> String {
    let file = library::FILES.iter().find(|(file, _)| *file == format!("library/{name}.aut"));
    let mut text = file.expect("a type of the library").1.to_string();
    for (from, to) in changes {
        assert!(text.contains(from), "{from}");
        text = text.replacen(from, to, 1);
    }
    text
}

/// The belt offers its second part where the first one was. In `Again` it has not read where a part is since it stands, and
/// does not read whether it sees one.
fn conveyor(property: &str) -> String {
    let begins =
        "    /// The place of the part is known when the belt is at rest.\n    resume state Stopping {\n";
    let again = "    resume state Again {
        when taken -> Running { taken := false; claimed := false; offer := false; drive(); }
        when missed -> Passing { missed := false; claimed := false; offer := false; goes_to.coming[kind] -= 1; drive(); }
    }
    resume state Stopping {
        when done and sees[sought] and at.z > 0.0,
            first station in stations with station.wants[sought] > station.coming[sought]
            -> Again { station.coming[sought] += 1; kind := sought; goes_to := station; offer := true; }
";
    let local = "    local sought: Kind;\n";
    changed("conveyor", &[(begins, again), (local, &format!("{local}    {property}\n"))])
}

fn search(types: Vec<String>, faults: Faults) -> Outcome {
    let mut texts = Texts { scenario: Some(TWO_PARTS.into()), ..own_line("buffer") };
    texts.specs.extend(types);
    let model = model(&texts.project(), &Asked::with(faults)).expect("a line that can be searched").model;
    explore(&model, &BOUNDS, &mut |_| true)
}

fn first(outcome: &Outcome) -> Option<&Violation> {
    outcome.violations.first().map(|(violation, _)| violation)
}

#[test]
fn that_the_orders_can_be_made_is_not_concluded_from_such_a_grip() {
    let without_waiting = changed("kitting", &[("pick(grip_point);", "move(grip_point);")]);
    for types in [vec![conveyor("")], vec![conveyor(""), without_waiting]] {
        let outcome = search(types, Faults::None);
        assert_eq!(first(&outcome), Some(&Violation::NeverMade));
    }
}

/// It is no fault of the gripper: it happens before any fault, and without faults.
#[test]
fn such_a_grip_may_find_nothing() {
    for faults in [Faults::None, Faults::All] {
        let outcome = search(vec![conveyor("invariant not missed or at.z = 0.0;")], faults);
        assert!(matches!(first(&outcome), Some(Violation::Fault { .. })), "{:?}", first(&outcome));
        assert_eq!(outcome.covered.failing, None);
    }
}
