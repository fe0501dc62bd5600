//! SPIN counts the states of small lines too: a search of its own on the same models.

use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, End, explore};
use autogen_search::plant::Faults;
use autogen_search::promela::promela;
use autogen_search::successor::Orders;
use autogen_tests::{Texts, text};
use std::path::Path;
use std::process::Command;

/// Whether SPIN and a C compiler can be called; in a run of CI they have to be.
fn has_judge() -> bool {
    let can = |program: &str, option: &str| {
        Command::new(program).arg(option).output().is_ok_and(|o| o.status.success())
    };
    let answers = can("spin", "-V") && can("gcc", "--version");
    let is_required = std::env::var("AUTOGEN_JUDGES").is_ok_and(|judges| judges == "required");
    assert!(answers || !is_required, "`spin` or `gcc` is not installed: see .ci/run");
    if !answers {
        println!("skipped: `spin` or `gcc` is not installed (Debian: spin, gcc)");
    }
    answers
}

/// States and transitions, as SPIN counts them: every transition leads to a state that is new or known, and the first
/// state is one more.
fn counted_by_spin(folder: &Path, text: &str) -> (usize, u64) {
    std::fs::write(folder.join("line.pml"), text).expect("a folder that can be written");
    let call = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).current_dir(folder).output().expect(program);
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(output.status.success(), "{program}: {said}{}", String::from_utf8_lossy(&output.stderr));
        said
    };
    call("spin", &["-a", "line.pml"]);
    call("gcc", &["-O1", "-w", "-DSAFETY", "-DNOREDUCE", "-DVECTORSZ=4096", "-o", "pan", "pan.c"]);
    let said = call(folder.join("pan").to_str().expect("a path"), &["-m1000000"]);
    let number = |what: &str| -> u64 {
        let line = said.lines().find(|line| line.contains(what)).unwrap_or_else(|| panic!("{what}: {said}"));
        line.split_whitespace().next().and_then(|word| word.parse().ok()).expect("a number")
    };
    assert!(said.contains("errors: 0"), "{said}");
    (number("states, stored") as usize, number("transitions (=") - 1)
}

fn line(types: &[&str]) -> Texts {
    let robots: Vec<String> = types
        .iter()
        .enumerate()
        .map(|(number, of)| {
            let y = 3 * number;
            format!(
                r#"{{"name": "v{number}", "type": "{of}", "pose": [0, {y}, 0], "destinations": [[5, {y}, 0], [10, {y}, 0]]}}"#
            )
        })
        .collect();
    Texts {
        layout: format!("{{\"robots\": [{}]}}", robots.join(",\n")),
        specs: vec![text("tests/fixtures/verify/shuttles.aut")],
        ..Texts::default()
    }
}

#[test]
fn states_and_transitions_are_those_that_spin_counts() {
    if !has_judge() {
        return;
    }
    let lines: [(&[&str], Faults); 7] = [
        (&["doubter"], Faults::All),
        (&["doubter", "doubter"], Faults::None),
        (&["doubter", "doubter"], Faults::All),
        (&["gate", "shuttle"], Faults::All),
        (&["gate", "shuttle", "shuttle"], Faults::All),
        (&["shuttle", "gate", "shuttle", "shuttle"], Faults::None),
        (&["shuttle", "gate", "shuttle", "doubter"], Faults::All),
    ];
    for (number, (types, faults)) in lines.into_iter().enumerate() {
        let project = line(types).project();
        let model = model(&project, &Asked::with(faults)).expect("a line that can be searched").model;
        let bounds =
            Bounds { answers: None, orders: Orders::One, time: None, memory: 1_000_000_000, violations: 1 };
        let outcome = explore(&model, &bounds, &mut |_| true);
        assert_eq!(outcome.end, End::Complete);
        let folder = std::env::temp_dir().join(format!("autogen-spin-{}-{number}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder that can be made");
        let counted = counted_by_spin(&folder, &promela(&model).expect("a model that SPIN can count"));
        println!("{types:?}, faults {faults:?}: {counted:?}");
        assert_eq!((outcome.covered.states, outcome.covered.transitions), counted, "{types:?}");
        std::fs::remove_dir_all(&folder).expect("a folder that can be removed");
    }
}
