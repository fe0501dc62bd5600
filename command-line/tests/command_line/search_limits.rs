//! `verify`: limits, and what is printed.

use super::sweep::printed;
use super::*;

/// So many machines that have nothing to do with one another.
fn machines(name: &str, count: usize) -> PathBuf {
    let folder = folder(name);
    let types = "device lantern {
            part signal = lamp { at: pose; colour: red; };
            out shines: bool = signal.on stop false;
        }
        automaton Alone on lantern {
            initial state A { when after 1 s -> B { shines := true; } }
            state B { when after 1 s -> A { shines := false; } }
        }";
    let robot = |number: usize| {
        format!(r#"{{"name": "m{number}", "type": "alone", "pose": [{}, 0, 0]}}"#, 2 * number)
    };
    let robots: Vec<String> = (0..count).map(robot).collect();
    let layout = format!(r#"{{"robots": [{}], "specs": "alone.aut"}}"#, robots.join(", "));
    let scenario = r#"{"time_limit_s": 10}"#;
    for (file, text) in [("alone.aut", types), ("line.json", &layout), ("scenario.json", scenario)] {
        fs::write(folder.join(file), text).expect("a file that can be written");
    }
    folder
}

#[test]
fn a_state_with_too_many_successors_is_cut_by_the_limits() {
    let folder = machines("search_limits", 64);
    for (limits, end) in
        [(vec!["--limit", "1s"], "time limit"), (vec!["--limit", "10min", "--limit", "30MB"], "memory limit")]
    {
        let arguments = ["verify", "line.json", "--scenario", "scenario.json", "--orders", "all"];
        let output = autogen(&folder, &[&arguments[..], &limits].concat());
        assert_eq!(status(&output), 4, "{}", errors(&output));
        let said = printed(&output);
        assert!(said.contains(&format!("no: the {end} was reached")), "{said}");
    }
}

#[test]
fn a_cut_search_says_what_the_one_before_it_has_proved() {
    let folder = machines("search_before", 14);
    let arguments = ["verify", "line.json", "--scenario", "scenario.json", "--limit", "2s"];
    let output = autogen(&folder, &arguments);
    assert_eq!(status(&output), 4, "{}", errors(&output));
    let said = printed(&output);
    assert!(said.contains("with one answer    proved: 16385 states"), "{said}");
    let arguments = [&arguments[..4], &["--format", "json", "--answers", "1"]].concat();
    let json = printed(&autogen(&folder, &arguments));
    assert!(json.contains(r#""with_one_answer":null"#), "{json}");
}

#[test]
fn two_limits_of_a_kind_are_refused() {
    let folder = machines("search_two_limits", 1);
    for (limits, kind) in [(["1s", "5min"], "time"), (["1GB", "500MB"], "amount of memory")] {
        let limits = limits.map(|limit| format!("--limit={limit}"));
        let output = autogen(&folder, &["verify", "line.json", &limits[0], &limits[1]]);
        assert_eq!(status(&output), 2);
        let said = errors(&output);
        assert!(said.contains(&format!("--limit takes one {kind}, and there are two")), "{said}");
    }
}

#[test]
fn at_least_one_device_answers_in_a_scan() {
    let folder = machines("search_answers", 1);
    let arguments = ["verify", "line.json", "--scenario", "scenario.json", "--answers"];
    assert_eq!(status(&autogen(&folder, &[&arguments[..], &["0"]].concat())), 2);
    assert_eq!(status(&autogen(&folder, &[&arguments[..], &["1"]].concat())), 0);
}

#[test]
fn a_proof_is_quiet() {
    let folder = machines("search_quiet", 1);
    let output = autogen(&folder, &["verify", "line.json", "--scenario", "scenario.json", "-q"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    assert_eq!(printed(&output), "");
}

#[test]
fn a_role_whose_types_have_no_machine_names_them() {
    let folder = folder("role_without_machine");
    let layout = r#"{"robots": [{
        "name": "c", "type": "conveyor", "pose": [0, 0, 0], "orient": "y", "orient_range": [-5, 5]
    }]}"#;
    fs::write(folder.join("line.json"), layout).expect("a file that can be written");
    let output = autogen(&folder, &["check", "line.json"]);
    assert_eq!(status(&output), 1);
    let said = errors(&output);
    assert!(said.contains("no machine of the layout has the interface `Demand`"), "{said}");
    assert!(said.contains("add a machine of a type that has it: `Station`"), "{said}");
}

/// What `check` says of so many machines of a type `A`, which fit their places.
fn refused(name: &str, automaton: &str, count: usize) -> String {
    let folder = folder(name);
    let place = |number: usize| {
        format!(r#"{{"name": "s{number}", "type": "a", "pose": [{number}, 0, 0], "box": [0.1, 0.1, 0.1]}}"#)
    };
    let places: Vec<String> = (0..count).map(place).collect();
    let layout = format!(r#"{{"robots": [], "stationary": [{}], "specs": "a.aut"}}"#, places.join(", "));
    for (file, text) in [("a.aut", automaton), ("line.json", &layout)] {
        fs::write(folder.join(file), text).expect("a file that can be written");
    }
    let output = autogen(&folder, &["check", "line.json"]);
    assert_eq!(status(&output), 1);
    errors(&output)
}

#[test]
fn roles_count_with_the_members_that_they_have() {
    let interface = "interface I { shared c: int 0..9 := 0 by counter; }";
    let guard = format!(
        "{interface} automaton A on bin is I {{ knows all: I[];
            initial state S {{
                when exists x in all, y in all, z in all: x.c + y.c + z.c > 2 -> S {{ c := 0; }}
            }}
        }}"
    );
    let said = refused("search_guard", &guard, 100);
    assert!(said.contains("E0320") && said.contains("`all` has 99"), "{said}");
    let requirement = format!(
        "{interface} automaton A on bin is I {{ knows all: I[];
            require forall x in all, y in all: x = y or x <> y else \"never\";
            initial state S {{ when after 1 s -> S {{}} }}
        }}"
    );
    let said = refused("search_requirement", &requirement, 200);
    assert!(said.contains("E0320") && said.contains("the requirements of all machines"), "{said}");
}

#[test]
fn transitions_of_any_state_are_counted_in_each() {
    let states: String = (0..300).map(|n| format!("state S{n} {{ when after 1 s -> S0 {{}} }}")).collect();
    let any = "when after 1 s -> S0 {}".repeat(200);
    let automaton = format!("automaton A on bin {{ initial -> S0 {{}} {states} any state {{ {any} }} }}");
    let said = refused("search_any_state", &automaton, 1);
    assert!(said.contains("E0215") && said.contains("there are 60000"), "{said}");
}
