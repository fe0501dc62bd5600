//! Devices that are right as texts and wrong for a machine: what a line with one of them is told.

use autogen_tests::Texts;

const AUTOMATON: &str = "automaton Thing on thing { initial state S { when false -> S {} } }";

/// Codes and messages for a layout with one `thing`, beside the default line's.
fn told(device: &str, keys: &str) -> Vec<(&'static str, String)> {
    let layout = format!(r#"{{"robots": [{{"name": "thing", "type": "thing", "pose": [0, 0, 0]{keys}}}]}}"#);
    let texts = Texts { specs: vec![format!("{device}\n{AUTOMATON}")], ..Texts::of_layout(layout) };
    texts.compile().diagnostics.into_iter().map(|d| (d.code, d.message)).collect()
}

#[test]
fn a_chain_on_axes_without_inverse_kinematics_is_told() {
    let device = "device thing {
        part spin = axis { at: pose; speed: 1.0; acceleration: 1.0; joint: j; link: l; mass: 1.0; effort: 1.0; damping: 0.0; friction: 0.0; };
        part arm = ur10 { on: spin; rest: pose; envelope: []; clearances: []; };
        in tool: point = arm.joints.tool;
    }";
    let told = told(device, "");
    assert!(
        told.iter().any(|(code, text)| *code == "E0711" && text.contains("no inverse kinematics")),
        "{told:?}"
    );
}

#[test]
fn a_limit_that_the_layout_breaks_is_told() {
    let device = "device thing {
        parameter width: real;
        part belt = lane { along: x; range: [0.0, 1.0]; surface: pose; width: width - 1.0; outline: 1.0; speed: 0.2; };
        in moves: bool = belt.moves;
    }";
    let told = told(device, r#", "width": 0.5"#);
    assert!(told.iter().any(|(code, text)| *code == "E0704" && text.contains("a number over 0")), "{told:?}");
    let told = self::told(device, "");
    assert!(told.iter().any(|(code, text)| *code == "E0112" && text.contains("width")), "{told:?}");
}

#[test]
fn a_constant_for_each_kind_has_enough_elements() {
    let device = "device thing {
        part lamp = lamp { at: pose; colour: red; };
        out on: bool = lamp.on;
        constant places: point[Kind] = [pose, pose];
    }";
    let told = told(device, "");
    assert!(
        told.iter().any(|(code, text)| *code == "E0709" && text.contains("`places` of thing")),
        "{told:?}"
    );
}
