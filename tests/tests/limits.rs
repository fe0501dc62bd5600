//! What is beyond a limit of `docs/limits.md` is refused with one diagnostic that names it, and what ends within it
//! is not held up.

use crate::long_lines;
use autogen::lower::Outcome;
use autogen_tests::{Texts, ariac, is_full_campaign};

fn codes(outcome: &Outcome) -> Vec<&'static str> {
    outcome.diagnostics.iter().map(|d| d.code).collect()
}

fn robots(count: usize, robot: impl Fn(usize) -> String) -> String {
    let robots: Vec<String> = (0..count).map(robot).collect();
    format!("{{\"robots\": [{}]}}", robots.join(","))
}

/// So many machines of an automaton `T` with these members.
fn many(count: usize, members: &str) -> Outcome {
    let layout = robots(count, |i| format!("{{\"name\": \"t{i}\", \"type\": \"t\", \"pose\": [0, 0, 0]}}"));
    let automaton =
        format!("automaton T on bin {{ {members} initial state A {{ when after 1 s -> A {{}} }} }}");
    Texts { layout, specs: vec![automaton], ..Texts::default() }.compile()
}

#[test]
fn values_of_a_text_are_counted() {
    let layout = format!("{{\"robots\": [{}0]}}", "0,".repeat(500_000));
    let found = Texts::of_layout(layout).compile();
    assert!(codes(&found).contains(&"E0142"), "{:?}", codes(&found));
}

#[test]
fn objects_are_counted() {
    assert!(codes(&many(12_001, "")).contains(&"E0143"));
    assert!(!codes(&many(12_000, "")).contains(&"E0143"));
}

#[test]
fn what_all_machines_have_together_is_bounded() {
    assert_eq!(codes(&many(3000, "local n: real[1024];")), ["E0508"]);
    assert_eq!(codes(&many(2000, "knows all: T[];")), ["E0508"]);
    assert!(!codes(&many(2000, "local n: real[1024];")).contains(&"E0508"));
}

#[test]
fn pairs_that_stand_near_one_another_are_bounded() {
    let further: String = (0..400)
        .map(|i| {
            format!(
                "{{\"name\": \"b{i}\", \"type\": \"conveyor\", \"pose\": [-0.6, 0, 0], \"orient\": \"y\", \"orient_range\": [-5, 5]}},
                 {{\"name\": \"k{i}\", \"type\": \"kitting\", \"pose\": [-1.3, 0, 1.127], \"rail_dim\": \"y\", \"rail_range\": [-4.8, 4.8]}},"
            )
        })
        .collect();
    let layout = ariac("default").layout.replacen("\"robots\": [", &format!("\"robots\": [{further}"), 1);
    assert_eq!(codes(&Texts::of_layout(layout).compile()), ["E0408"]);
}

#[test]
fn ten_thousand_robots_in_long_lines_stay_possible() {
    let robots = if is_full_campaign() { 10_000 } else { 1400 };
    for layout in [long_lines::long(robots), long_lines::copies(robots / 7)] {
        assert_eq!(codes(&Texts::of_layout(layout).compile()), [""; 0]);
    }
}

#[test]
fn definitions_that_double_are_read_once() {
    let doubling: String = (1..31).map(|i| format!("define d{i} = d{0} and d{0};\n", i - 1)).collect();
    let found = many(1, &format!("define d0 = true;\n{doubling} require d30 else \"no\";"));
    assert!(codes(&found).contains(&"E0320"), "{:?}", codes(&found));
}

#[test]
fn many_errors_are_told_in_part_and_it_is_said() {
    let found = Texts::of_layout(robots(3000, |i| format!("{{\"nam\": \"r{i}\"}}"))).compile();
    assert_eq!(found.diagnostics.len(), autogen::diagnostic::MOST);
    let notes = found.diagnostics.iter().flat_map(|d| &d.notes);
    assert_eq!(notes.filter(|note| note.contains("no more are reported")).count(), 1);
}
