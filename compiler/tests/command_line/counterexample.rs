//! `verify --report`: the page of a violation.

use super::*;

/// The page of a gate that must not open; `initial` says how it begins.
fn page(name: &str, initial: &str) -> String {
    let folder = folder(name);
    let specification = format!(
        "device gate {{
            part rod = cylinder {{ extend: 300 ms; retract: 300 ms; }};
            part up = button {{}};
            in out_there: bool = rod.is_out;
            in pressed: bool = up.on;
            out open: bool = rod.extend stop false;
        }}
        automaton Gate on gate {{
            initial -> {initial}
            state Closed {{ when pressed -> Open {{ open := true; }} }}
            state Open {{ when out_there -> Closed {{ open := false; }} }}
            invariant not out_there;
        }}"
    );
    let layout = r#"{"robots": [{"name": "gate", "type": "gate", "pose": [0, 0, 0]}], "specs": "gate.aut"}"#;
    fs::write(folder.join("gate.aut"), specification).expect("a file that can be written");
    fs::write(folder.join("line.json"), layout).expect("a file that can be written");
    let output = autogen(&folder, &["verify", "line.json", "--report", "page.html"]);
    assert_eq!(status(&output), 3, "{}", errors(&output));
    fs::read_to_string(folder.join("page.html")).expect("a page")
}

#[test]
fn a_violation_that_the_simulator_shows_is_the_page_of_a_run() {
    let page = page("violation", "Open { open := true; }");
    // The valve is on from the first scan, and the rod takes 300 ms.
    let (_, rest) = page.split_once(r#""violation":{"at_s":"#).expect("the violation");
    let at_s: f64 = rest.split(',').next().and_then(|number| number.parse().ok()).expect("a time");
    assert!((0.3..0.35).contains(&at_s), "{at_s}");
    assert!(rest.contains("fault of gate"), "{page}");
}

/// Nobody presses the button in the simulator.
#[test]
fn a_violation_that_it_does_not_show_is_drawn_from_the_search() {
    let page = page("steps", "Closed {}");
    for part in ["In the simulator", r#"class="violation""#, ">Open<", "when pressed", ">gate<"] {
        assert!(page.contains(part), "{part}: {page}");
    }
    assert!(!page.contains("<script"));
}
