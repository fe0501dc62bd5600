//! `verify` says of what a proof says nothing, and what a counterexample reads of which nothing is known.

use super::sweep::printed;
use super::*;

/// A lamp that shines while a key is pressed.
fn verify(name: &str, properties: &str, more: &[&str]) -> (Output, PathBuf) {
    let folder = folder(name);
    let specification = format!(
        "device post {{
            part key = button {{}};
            part bulb = lamp {{ at: pose; colour: red; }};
            part rod = cylinder {{ extend: 300 ms; retract: 300 ms; }};
            in pressed: bool = key.on;
            in is_out: bool = rod.is_out;
            out shines: bool = bulb.on stop false;
            out push: bool = rod.extend stop false;
        }}
        automaton Post on post {{
            local is_late: bool := false;
            initial -> Dark {{}}
            state Dark {{ when pressed -> Bright {{ shines := true; }} }}
            state Bright {{ when not pressed -> Dark {{ shines := false; }} when is_out -> Out {{ is_late := true; }} }}
            final state Out;
            {properties}
        }}"
    );
    let layout = r#"{"robots": [{"name": "post", "type": "post", "pose": [0, 0, 0]}], "specs": "post.aut"}"#;
    fs::write(folder.join("post.aut"), specification).expect("a file that can be written");
    fs::write(folder.join("line.json"), layout).expect("a file that can be written");
    (autogen(&folder, &[&["verify", "line.json"], more].concat()), folder)
}

const EMPTY: &str = "invariant not is_late or not shines;";

#[test]
fn a_proof_says_what_never_happens() {
    let (output, _) = verify("unreached", EMPTY, &[]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let text = printed(&output);
    let begin = "proved within these bounds, but never reached: 1 of 4 states of the machines, \
                 1 of 1 actions of devices, 1 of 1 conditions of properties\n\n\
                 never reached, so nothing is proved of it\n  \
                 `rod` of post never moves\n  \
                 `invariant not is_late or not shines` of post: its condition never holds (post.aut:16:13)\n\n";
    assert!(text.starts_with(begin), "{text}");
    let (output, _) = verify("unreached_json", EMPTY, &["--format", "json"]);
    let answer = json(&output);
    assert_eq!(answer["verdict"], "proved within these bounds");
    assert_eq!(answer["never_happens"]["actions"], serde_json::json!(["`rod` of post never moves"]));
    assert_eq!(answer["never_happens"]["conditions"].as_array().map(Vec::len), Some(1));
    assert_eq!(answer["never_reached"], serde_json::json!({ "post": ["Out"] }));
}

/// What was not searched to the end may happen all the same.
#[test]
fn a_search_that_ends_early_does_not_say_what_never_happens() {
    let (output, _) = verify("unreached_cut", "invariant not shines;", &["--format", "json"]);
    assert_eq!(status(&output), 3, "{}", errors(&output));
    let answer = json(&output);
    assert_eq!(answer["never_happens"], serde_json::json!({ "actions": [], "conditions": [] }));
}

#[test]
fn a_counterexample_names_the_inputs_without_contract() {
    let broken = "invariant not shines;";
    let (output, folder) = verify("without_contract", broken, &["--report", "page.html"]);
    assert_eq!(status(&output), 3, "{}", errors(&output));
    let told = "`pressed` of post: any value in every scan, whether the device can do this or not";
    let text = printed(&output);
    assert!(text.contains(&format!("\nwithout contract   {told}\n")), "{text}");
    let page = fs::read_to_string(folder.join("page.html")).expect("a page");
    assert!(page.contains(told), "{page}");
    let (output, _) = verify("without_contract_json", broken, &["--format", "json"]);
    let violation = &json(&output)["violations"][0];
    assert_eq!(violation["without_contract"], serde_json::json!(["`pressed` of post"]));
    // It reads no input.
    let (output, _) = verify("with_contract", "invariant is_late;", &["--format", "json"]);
    let violation = &json(&output)["violations"][0];
    assert_eq!(violation["without_contract"], serde_json::json!([]));
}
