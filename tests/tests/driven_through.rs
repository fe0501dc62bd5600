//! Vehicles that drive through conveyors and places: no contact is found there, so `check` warns.

use autogen_tests::Texts;

const DEVICES: &str = "
device cart {
    parameter length: real := 6;
    part drive = track {
        corners: [pose, pose + point(length, 0, 0)]; places: [0, length]; speed: 1; acceleration: 1; mass: 50;
    };
    part hull = body { on: drive; low: point(-0.3, -0.3, 0.05); high: point(0.3, 0.3, 0.9); };
    in stands: bool = drive.stands;
}
device tram {
    part drive = track {
        corners: [pose, pose + point(6, 0, 0)]; places: [2, 4]; begins: 3; speed: 1; acceleration: 1; mass: 50;
    };
    part hull = body { on: drive; low: point(-0.3, -0.3, 0.05); high: point(0.3, 0.3, 0.9); };
    in stands: bool = drive.stands;
}
device shuttle {
    part drive = route {
        stops: [pose, pose + point(6, 0, 0)]; speed: 1; latency: 0 ms; tolerance: 0.1; mass: 50;
    };
    part hull = body { on: drive; low: point(-0.3, -0.3, 0.05); high: point(0.3, 0.3, 0.9); };
    in at_stop: int -1..2 = drive.at_stop;
}
device conv {
    parameter height: real := 0.8;
    parameter turn: real := 0;
    part belt = lane { from: origin * frame(0, 0, height, 0); length: 4; turn: turn; width: 0.4; speed: 0.3; };
    in moves: bool = belt.moves;
}
device framed {
    part belt = lane { from: origin * frame(0, 0, 0.8, 0); length: 4; width: 0.4; speed: 0.3; };
    part frame = body { at: origin; low: point(0, -0.25, 0); high: point(4, 0.25, 0.8); };
    in moves: bool = belt.moves;
}
device lifted {
    part lift = cylinder { slides: point(0, 0, -0.5); extend: 1 s; retract: 1 s; };
    part belt = lane { on: lift; from: origin * frame(0, 0, 0.8, 0); length: 4; width: 0.4; speed: 0.3; };
    in moves: bool = belt.moves;
    out down: bool = lift.extend;
}
device table {
    part top = place {
        at: pose; slots: [point(0, 0, 0.8)]; by_kind: false; floor: point(0, 0, 0.8); floor_x: [-0.5, 0.5];
        floor_y: [-0.5, 0.5];
    };
    part light = lamp { at: pose; colour: red; };
    out lit: bool = light.on;
}
device bench {
    part top = place {
        at: origin * frame(0, 0, 0.8, 0); slots: [point(0, 0, 0)]; by_kind: false; floor: point(0, 0, 0);
        floor_x: [-1, 1]; floor_y: [-0.1, 0.1];
    };
    part light = lamp { at: pose; colour: red; };
    out lit: bool = light.on;
}
automaton Bench on bench { initial -> S { lit := true; } state S { when false -> S {} } }
automaton Cart on cart { initial state S { when false -> S {} } }
automaton Tram on tram { initial state S { when false -> S {} } }
automaton Shuttle on shuttle { initial state S { when false -> S {} } }
automaton Conv on conv { initial state S { when false -> S {} } }
automaton Framed on framed { initial state S { when false -> S {} } }
automaton Lifted on lifted { initial -> S { down := true; } state S { when false -> S {} } }
automaton Table on table { initial -> S { lit := true; } state S { when false -> S {} } }
";

/// What is told of this of a vehicle along the x axis, at y = 0, and of another machine.
fn told(vehicle: &str, machine: &str, more: &str) -> Vec<String> {
    let layout = format!(
        r#"{{"robots": [{{"name": "v", "type": "{vehicle}", "pose": [0, 0, 0]}}, {{"name": "m", {machine}}}]{more}}}"#
    );
    let texts = Texts { specs: vec![DEVICES.into()], ..Texts::of_layout(layout) };
    let outcome = texts.compile();
    assert_eq!(outcome.diagnostics, []);
    let found = outcome.warnings.iter().filter(|found| found.code == "W0204");
    found.map(|found| found.message.clone()).collect()
}

#[test]
fn a_vehicle_through_a_surface_is_told() {
    let cases = [
        ("cart", r#""type": "conv", "pose": [3, -2, 0, 90]"#, "lane `belt`"),
        ("shuttle", r#""type": "conv", "pose": [3, -2, 0, 90]"#, "lane `belt`"),
        // A quarter of a circle that begins beside the track and ends across it.
        ("cart", r#""type": "conv", "pose": [2, -1, 0, 60], "turn": 60"#, "lane `belt`"),
        ("cart", r#""type": "table", "pose": [3, 0.7, 0]"#, "place `top`"),
        ("cart", r#""type": "bench", "pose": [3, 0.9, 0, 90]"#, "place `top`"),
    ];
    for (vehicle, machine, what) in cases {
        let expected = format!("`hull` of v drives through the {what} of m");
        assert_eq!(told(vehicle, machine, ""), [expected], "{machine}");
    }
}

#[test]
fn what_is_not_on_the_path_or_has_a_body_is_not_told() {
    let cases = [
        // Over it, under it, beside it, beyond its end.
        ("cart", r#""type": "conv", "pose": [3, -2, 0, 90], "height": 0.95"#),
        ("cart", r#""type": "conv", "pose": [3, -2, 0, 90], "height": 0.04"#),
        ("cart", r#""type": "conv", "pose": [1, 0.51, 0]"#),
        ("cart", r#""type": "conv", "pose": [6.3, 0, 0]"#),
        // A run finds the contact, or would have to look where the cylinder is.
        ("cart", r#""type": "framed", "pose": [3, -2, 0, 90]"#),
        ("cart", r#""type": "lifted", "pose": [3, -2, 0, 90]"#),
        ("shuttle", r#""type": "table", "pose": [3, 0.81, 0]"#),
        ("cart", r#""type": "bench", "pose": [3, 0.9, 0]"#),
    ];
    for (vehicle, machine) in cases {
        assert_eq!(told(vehicle, machine, ""), [""; 0], "{machine}");
    }
    let allowed = r#", "may_touch": [{"pair": ["v", "m"], "reason": "a gate in the conveyor opens"}]"#;
    assert_eq!(told("cart", r#""type": "conv", "pose": [3, -2, 0, 90]"#, allowed), [""; 0]);
}

#[test]
fn on_an_open_track_a_vehicle_comes_from_the_first_place_to_the_last_one() {
    let is_told = |x: f64| {
        let machine = format!(r#""type": "conv", "pose": [{x}, -2, 0, 90]"#);
        !told("tram", &machine, "").is_empty()
    };
    // Half of the belt and half of the vehicle are 0.5 m.
    assert_eq!([1.4, 1.6, 4.4, 4.6].map(is_told), [false, true, true, false]);
}

#[test]
fn each_of_two_vehicles_on_the_same_track_is_looked_at() {
    let machine =
        r#""type": "conv", "pose": [3, -2, 0, 90]}, {"name": "w", "type": "cart", "pose": [0, 0, 0]"#;
    let told_of = |allowed: &[[&str; 2]]| {
        let pair = |[a, b]: &[&str; 2]| format!(r#"{{"pair": ["{a}", "{b}"], "reason": "a gate opens"}}"#);
        // Both begin at the same place.
        let pairs: Vec<String> = [["v", "w"]].iter().chain(allowed).map(pair).collect();
        told("cart", machine, &format!(r#", "may_touch": [{}]"#, pairs.join(", ")))
    };
    let through = |vehicle: &str| [format!("`hull` of {vehicle} drives through the lane `belt` of m")];
    assert_eq!(told_of(&[]), through("v"));
    assert_eq!(told_of(&[["v", "m"]]), through("w"));
    assert_eq!(told_of(&[["v", "m"], ["w", "m"]]), [""; 0]);
}

#[test]
fn of_vehicles_on_two_tracks_the_first_one_is_told() {
    // The second one comes from farther away.
    let machine =
        r#""type": "conv", "pose": [3, -2, 0, 90]}, {"name": "w", "type": "shuttle", "pose": [-3, 1, 0]"#;
    let told_of = |allowed: &[&str]| {
        let pair = |vehicle: &&str| format!(r#"{{"pair": ["{vehicle}", "m"], "reason": "a gate opens"}}"#);
        let pairs: Vec<String> = allowed.iter().map(pair).collect();
        told("cart", machine, &format!(r#", "may_touch": [{}]"#, pairs.join(", ")))
    };
    let through = |vehicle: &str| [format!("`hull` of {vehicle} drives through the lane `belt` of m")];
    assert_eq!(told_of(&[]), through("v"));
    assert_eq!(told_of(&["v"]), through("w"));
    assert_eq!(told_of(&["v", "w"]), [""; 0]);
}
