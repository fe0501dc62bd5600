//! Properties as they are searched: small lines of which each keeps its promises or breaks them, with the executions that do.

use autogen::verify::story::Teller;
use autogen::verify::{Asked, Remembered, Searched, Warnings, model};
use autogen_search::explore::{Bounds, End, Outcome, explore};
use autogen_search::model::{Model, Reductions};
use autogen_search::plant::Faults;
use autogen_search::successor::Orders;
use autogen_tests::{Texts, bounds, fixtures, text};
use std::fmt::Write;

const BOUNDS: Bounds = Bounds { violations: 100, ..bounds::BOUNDS };

/// A line by its type: the first line of the text has its layout, the second one may have its scenario.
fn line(name: &str) -> Texts {
    of_text(&text(&format!("tests/fixtures/verify/properties/{name}.aut")))
}

fn of_text(text: &str) -> Texts {
    let is_object = |line: &&str| line.starts_with('{');
    let mut objects = text.lines().map_while(|line| line.strip_prefix("// ").filter(is_object));
    let layout = objects.next().expect("a layout in a comment").to_string();
    Texts {
        layout,
        scenario: objects.next().map(str::to_string),
        specs: vec![text.to_string()],
        ..Texts::default()
    }
}

fn names() -> Vec<String> {
    fixtures("verify/properties", "aut").into_iter().map(|(name, _)| name).collect()
}

/// If nothing fails, two items are the order of two, one of them beside the slots; and not the order of one.
#[test]
fn an_item_beside_the_slots_is_one_of_the_order() {
    for (asked, is_right) in [(1, false), (2, true)] {
        let mut texts = line("not_the_order_with_one_beside");
        let scenario = texts.scenario.expect("a scenario");
        let order = format!("\"bolt\": {asked}");
        texts.scenario = Some(scenario.replace("\"bolt\": 1", &order));
        let Searched { model, .. } = model(&texts.project(), &Asked::with(Faults::None)).expect("a model");
        let found = explore(&model, &BOUNDS, &mut |_| true);
        assert_eq!(found.violations.is_empty(), is_right, "{asked}: {:?}", found.violations);
    }
}

/// What is found, with its executions.
fn told(name: &str) -> String {
    let outcome = line(name).compile();
    let project = outcome.project.as_ref().unwrap_or_else(|| {
        panic!("{name}: {}", autogen_tests::plain(&outcome.sources, &outcome.diagnostics))
    });
    let asked = Asked { warnings: Warnings::Own(&outcome.sources), ..Asked::with(Faults::All) };
    let Searched { model, skipped } = model(project, &asked).expect("a line that can be searched");
    let teller = Teller { project, model: &model, sources: &outcome.sources };
    let found = explore(&model, &BOUNDS, &mut |_| true);
    assert_eq!(found.end, End::Complete, "{name}");
    let mut text = format!("{} states, {} stops\n", found.covered.states, found.covered.stops);
    for skipped in &skipped {
        let _ = writeln!(text, "not searched: {}", teller.skipped(skipped));
    }
    for (violation, execution) in &found.violations {
        let _ = write!(text, "\n{}\n{}", teller.title(violation), teller.tell(execution));
    }
    text
}

#[test]
fn promises_that_are_kept_and_promises_that_are_broken() {
    for name in names() {
        let text = told(&name);
        let breaks = name.starts_with("not_") || name.starts_with("never_");
        assert_eq!(text.lines().count() > 1, breaks, "{name}:\n{text}");
        insta::assert_snapshot!(format!("searched_{name}"), text);
    }
}

/// A state of a machine that a counterexample shows is not one that no sequence leads to.
#[test]
fn the_states_in_which_a_counterexample_ends_are_entered() {
    for name in names() {
        let outcome = line(&name).compile();
        let project = outcome.project.as_ref().expect("a right line");
        let searched = model(project, &Asked::with(Faults::All)).expect("a line that can be searched");
        let found = explore(&searched.model, &BOUNDS, &mut |_| true);
        for (_, execution) in &found.violations {
            let Some(last) = execution.scans.last() else { continue };
            for (instance, program) in searched.model.instances.iter().enumerate() {
                let state = |bytes: &[u8]| program.state.load(bytes) as usize;
                let end = state(&last.after);
                let mut reached = (0..found.reached.len()).map(|number| state(&found.reached.state(number)));
                let is_entered =
                    found.entered.contains(&(instance, end)) || reached.any(|state| state == end);
                assert!(is_entered, "{name}: machine {instance} in state {end}");
            }
        }
    }
}

/// More times of `after` in one state than a byte counts.
#[test]
fn no_time_of_many_is_lost() {
    let times = (1..=255).map(|number| format!("when x, after {} ms -> Waiting {{}}\n", number * 20));
    let text = format!(
        r#"// {{"robots": [{{"name": "pad", "type": "pad", "pose": [0, 0, 0]}}]}}
device pad {{ part button = button {{}}; in x: bool = button.on; }}
automaton Pad on pad {{
    local is_late: bool;
    initial state Waiting {{
        {}
        when after 5200 ms -> Late {{ is_late := true; }}
    }}
    final state Late;
    invariant not is_late;
}}"#,
        times.collect::<String>()
    );
    let project = of_text(&text).project();
    let searched = model(&project, &Asked::with(Faults::All)).expect("a line that can be searched");
    assert_eq!(explore(&searched.model, &BOUNDS, &mut |_| true).violations.len(), 1);
}

/// What a file expects to be noticed stands behind `//~`.
#[test]
fn what_is_hardly_meant_is_noticed() {
    for (name, text) in fixtures("verify/noticed", "aut") {
        let outcome = of_text(&text).compile();
        let project = outcome.project.as_ref().expect("a right line");
        let Searched { model, .. } =
            model(project, &Asked::with(Faults::All)).expect("a line that can be searched");
        let teller = Teller { project, model: &model, sources: &outcome.sources };
        let found = explore(&model, &BOUNDS, &mut |_| true);
        assert!(found.is_proved(), "{name}");
        let told: Vec<String> = found.remarks.iter().map(|(remark, _)| teller.title(remark)).collect();
        let expected: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("//~ ")).collect();
        assert_eq!(told, expected, "{name}");
    }
}

/// What a file expects never to happen stands behind `//~`: what devices never do, then the properties.
#[test]
fn what_never_happens_is_told() {
    for (name, text) in fixtures("verify/unreached", "aut") {
        let outcome = of_text(&text).compile();
        let project = outcome.project.as_ref().unwrap_or_else(|| {
            panic!("{name}: {}", autogen_tests::plain(&outcome.sources, &outcome.diagnostics))
        });
        let expected: Vec<&str> = text.lines().filter_map(|line| line.strip_prefix("//~ ")).collect();
        for (answers, orders, jobs) in [
            (None, Orders::One, 1),
            (Some(1), Orders::One, 2),
            (None, Orders::All, 1),
            (None, Orders::One, 5),
        ] {
            let asked = Asked { warnings: Warnings::Own(&outcome.sources), ..Asked::with(Faults::All) };
            let model = model(project, &asked).expect("a line that can be searched").model;
            let teller = Teller { project, model: &model, sources: &outcome.sources };
            let found = explore(&model, &Bounds { answers, orders, jobs, ..BOUNDS }, &mut |_| true);
            assert_eq!((found.end, found.violations.len()), (End::Complete, 0), "{name}");
            let (done, tested) = (teller.never_done(&found.occurred), teller.never_tested(&found.occurred));
            assert_eq!([done.told(), tested.told()].concat(), expected, "{name}, {answers:?}, {orders:?}");
            assert!(done.all >= done.number() && tested.all >= tested.number(), "{name}");
        }
    }
}

/// The message that a file expects stands behind `//~`, in the line to which it points.
#[test]
fn lines_that_cannot_be_searched_are_refused() {
    for (name, text) in fixtures("verify/refused", "aut") {
        let outcome = of_text(&text).compile();
        let project = outcome.project.as_ref().expect("a right line");
        let Err(found) = model(project, &Asked::with(Faults::All)) else { panic!("{name} is searched") };
        let told =
            found.iter().map(|d| (outcome.sources.position(d.place).0, format!("{} {}", d.code, d.message)));
        let told: Vec<(usize, String)> = told.collect();
        let expected = text
            .lines()
            .enumerate()
            .filter_map(|(number, line)| Some((number + 1, line.split_once("//~ ")?.1.to_string())));
        assert_eq!(told, expected.collect::<Vec<_>>(), "{name}");
    }
}

fn verdict(outcome: &Outcome) -> (End, Vec<String>) {
    let mut violations: Vec<String> = outcome.violations.iter().map(|(v, _)| format!("{v:?}")).collect();
    violations.sort();
    (outcome.end, violations)
}

/// A state remembers only what makes a difference: with all that the controller remembers the same is found. It is found too
/// if every instance steps in every scan, in every order.
#[test]
fn remembering_everything_changes_no_verdict() {
    for name in names() {
        let outcome = line(&name).compile();
        let project = outcome.project.as_ref().expect("a right line");
        for (faults, orders) in [(Faults::All, Orders::One), (Faults::None, Orders::All)] {
            let search = |remembered, reductions| {
                let warnings = Warnings::Own(&outcome.sources);
                let asked = Asked { faults, warnings, remembered };
                let searched = model(project, &asked).expect("a line that can be searched");
                let model = Model { reductions, ..searched.model };
                explore(&model, &Bounds { orders, ..BOUNDS }, &mut |_| true)
            };
            let least = search(Remembered::Least, Reductions::All);
            let whole = search(Remembered::Whole, Reductions::All);
            let plain = search(Remembered::Least, Reductions::Off);
            assert_eq!(verdict(&least), verdict(&plain), "{name}, {faults:?}, {orders:?}");
            assert_eq!(least.covered.states, plain.covered.states, "{name}, {faults:?}, {orders:?}");
            assert_eq!(least.occurred, plain.occurred, "{name}, {faults:?}, {orders:?}");
            assert_eq!(least.occurred, whole.occurred, "{name}, {faults:?}, {orders:?}");
            assert_eq!(verdict(&least), verdict(&whole), "{name}, {faults:?}, {orders:?}");
            assert!(least.covered.states <= whole.covered.states, "{name}, {faults:?}, {orders:?}");
            println!("{name}: {} states, {} with all", least.covered.states, whole.covered.states);
        }
    }
}
