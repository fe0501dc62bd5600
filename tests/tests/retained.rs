//! What is retained is of one program and one layout: the number by which the controllers find that.

use autogen::backend::{rust, st};
use autogen::lower::Outcome;
use autogen_tests::st::Emitted;
use autogen_tests::{Texts, ariac, plain};

fn compiled(texts: &Texts) -> Outcome {
    let outcome = texts.compile();
    assert!(outcome.project.is_some(), "{}", plain(&outcome.sources, &outcome.diagnostics));
    outcome
}

fn number(texts: &Texts) -> u32 {
    compiled(texts).project.expect("a layout that can be built").system.shape_of_retained()
}

/// Where items are is remembered by places and numbers of slots: another layout has others.
#[test]
fn it_is_of_the_layout() {
    let own = number(&ariac("default"));
    assert_eq!(own, number(&ariac("default")));
    assert_ne!(own, number(&ariac("default").set("agv.capacity=4")));
    assert_ne!(own, number(&ariac("default").set("kitting.speed=0.5")));
}

/// The Structured Text, the compiled Rust, and the Rust of a layout that is read have the same number.
#[test]
fn all_controllers_have_it() {
    let outcome = compiled(&ariac("default"));
    let project = outcome.project.expect("a layout that can be built");
    let system = &project.system;
    let number = system.shape_of_retained();
    let text = Emitted::of(&st::files(system, &outcome.sources)).main;
    assert!(text.contains(&format!("retained_of = {number}")), "Structured Text");
    let line = &rust::files(system, &outcome.sources)["controllers/src/line.rs"];
    assert!(line.contains(&format!("retained_of: {number},")), "Rust");
    assert!(rust::parameters_text(system).contains(&format!("\nretained_of {number}\n")), "parameters");
}

/// Two types of which one machine could be the other: states, values and signals have the same names.
const FILLER_AND_VENT: &str = r#"device drive {
    part pedal = button {};
    part motor = lamp { at: pose; colour: green; };
    in wanted: bool = pedal.on;
    out turn: bool = motor.on;
}
automaton Filler on drive {
    retain all;
    local n: int 0..100;
    initial -> Closed {}
    resume state Closed { when wanted -> Open { turn := true; n := n + 1; } }
    resume state Open { when not wanted -> Closed { turn := false; } }
    invariant n < 90 else "the tank is full";
}
automaton Vent on drive {
    retain all;
    local n: int 0..100;
    initial -> Open { turn := true; n := 7; }
    resume state Open { when wanted -> Closed { turn := false; n := n + 1; } }
    resume state Closed { when not wanted -> Open { turn := true; } }
}
"#;

fn pair(text: &str, types: [&str; 2]) -> Texts {
    let robots = [("m1", types[0], 0), ("m2", types[1], 1)];
    let robots =
        robots.map(|(name, ty, x)| format!(r#"{{"name": "{name}", "type": "{ty}", "pose": [{x}, 0, 0]}}"#));
    Texts {
        layout: format!(r#"{{"robots": [{}]}}"#, robots.join(", ")),
        specs: vec![text.into()],
        scenario: Some(r#"{"time_limit_s": 1}"#.into()),
        ..Texts::default()
    }
}

#[test]
fn it_is_of_the_types_of_the_machines() {
    let of = |types| number(&pair(FILLER_AND_VENT, types));
    assert_ne!(of(["filler", "vent"]), of(["vent", "filler"]));
    assert_ne!(of(["filler", "filler"]), of(["filler", "vent"]));
}

/// The code of a fault is retained: with another program it would be shown with another cause.
#[test]
fn it_is_of_the_causes_of_faults() {
    let of = |text: &str| number(&pair(text, ["filler", "vent"]));
    let own = of(FILLER_AND_VENT);
    let full = r#"else "the tank is full""#;
    let closes = "when not wanted -> Closed { turn := false; }";
    let changes = [
        ("another text", full, r#"else "the tank runs over""#.into()),
        ("another effect", full, r#"else warn "the tank is full""#.into()),
        ("one more before", "invariant", "invariant n < 95;\n    invariant".into()),
        ("one more place", closes, closes.replace("false;", "false; n := n + 1;")),
        (
            "another guard",
            "when wanted -> Open { turn := true;",
            "when wanted or false -> Open { turn := true;".into(),
        ),
    ];
    for (change, from, to) in changes {
        assert!(FILLER_AND_VENT.contains(from), "{change}");
        assert_ne!(own, of(&FILLER_AND_VENT.replacen(from, &to, 1)), "{change}");
    }
    // Lines of the text are no cause.
    assert_eq!(own, of(&FILLER_AND_VENT.replace("    retain all;\n", "\n\n    retain all;\n")));
}
