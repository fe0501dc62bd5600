//! `verify --report`: the page of a violation.

use super::sweep::printed;
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

/// Two parts for one place of the vehicle: the arm is about to let the second one go where the first one lies.
#[test]
fn it_is_told_who_has_which_item_at_the_violation() {
    let folder = folder("who_has_what");
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let arm = fs::read_to_string(root.join("compiler/library/kitting.aut")).expect("the type");
    let place = "tray.places[n] + up(heights[k])";
    assert!(arm.contains(place));
    fs::write(folder.join("kitting.aut"), arm.replace(place, "tray.places[0] + up(heights[k])"))
        .expect("a file");
    let scenario = r#"{"kinds": [{"name": "battery", "height": 0.053}, {"name": "pump", "height": 0.11}],
        "orders": [{"station": "as1", "parts": {"battery": 1, "pump": 1}}]}"#;
    fs::write(folder.join("two.json"), scenario).expect("a file");
    let layout = example("ariac2021/less_agv.json");
    let verify = |more: &[&str]| {
        let line = ["verify", &layout, "--specs", "kitting.aut", "--scenario", "two.json", "--jobs", "1"];
        let output = autogen(&folder, &[&line[..], more].concat());
        assert_eq!(status(&output), 3, "{}", errors(&output));
        output
    };
    let answer = json(&verify(&["--format", "json", "--report", "page.html"]));
    let violation = &answer["violations"][0];
    let title = violation["violation"].as_str().expect("a text");
    let vehicle =
        title.strip_prefix("kitting puts an item onto another one, at place 0 of ").expect("the title");
    let lines: Vec<&str> =
        violation["at_that_moment"].as_array().expect("a list").iter().filter_map(Value::as_str).collect();
    let [arm, tray, gantry] = lines[..] else { panic!("{lines:#?}") };
    let holds = |kind: &str| arm == format!("kitting in Releasing: {kind} on its gripper");
    let lies = |kind: &str| tray == format!("{vehicle} in Loading: {kind} at place 0");
    assert!(holds("battery") && lies("pump") || holds("pump") && lies("battery"), "{lines:#?}");
    assert!(gantry.starts_with("gantry in ") && gantry.ends_with(": nothing on its gripper"), "{gantry}");
    let text = printed(&verify(&[]));
    assert!(text.contains(&format!("\nat that moment\n  {}\n", lines.join("\n  "))), "{text}");
    let page = fs::read_to_string(folder.join("page.html")).expect("a page");
    assert_eq!(page.contains("At that moment"), !page.contains("id=\"data\""));
}
