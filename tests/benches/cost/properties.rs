//! What a property costs in a scan.

use autogen_tests::Texts;
use autogen_tests::workspace::Workspace;
use std::process::Command;

/// Machines that only watch.
const MACHINES: usize = 100;
/// Properties of each of them.
const PROPERTIES: usize = 10;

/// Machines with so many of these properties each. The machine changes its state in each scan.
fn line(property: &str) -> Texts {
    let robots: Vec<String> = (0..MACHINES)
        .map(|number| format!(r#"{{"name": "w{number}", "type": "watch", "pose": [{number}, 0, 0]}}"#))
        .collect();
    let of_each = |text: &str| -> String {
        (0..PROPERTIES).map(|number| text.replace('#', &number.to_string())).collect()
    };
    let [locals, properties] = ["local n#: int 0..1000 := 0;\n", property].map(of_each);
    let spec = format!(
        "device pad {{
            part key = button {{}};
            part plate = body {{ low: pose + point(-0.1, -0.1, 0); high: pose + point(0.1, 0.1, 0.1); }};
            in pressed: bool = key.on;
        }}
        automaton Watch on pad {{
            {locals}
            local is_odd: bool := false;
            {properties}
            initial -> Even {{}}
            state Even {{ when n0 < 900 or pressed -> Odd {{ is_odd := true; }} }}
            state Odd {{ when n0 < 900 or pressed -> Even {{ is_odd := false; }} }}
        }}"
    );
    let layout = format!("{{\"robots\": [{}]}}", robots.join(",\n"));
    Texts { layout, specs: vec![spec], ..Texts::default() }
}

pub fn measure() {
    let kinds = [
        ("without properties", ""),
        ("invariant", "invariant n# < 900 or is_odd;\n"),
        ("keep", "keep n# while not is_odd;\n"),
        ("whenever", "whenever is_odd then n# > 900 within 60 min else warn \"it waits #\";\n"),
    ];
    let workspace = Workspace::of_simulator("properties");
    let mut without = 0.0;
    for (name, property) in kinds {
        let outcome = line(property).compile();
        let project = outcome.project.expect("a line that is right");
        workspace.replace(&project.system, &outcome.sources);
        workspace.put("commissioning/examples/scans/main.rs", include_str!("scans.rs"));
        workspace.cargo(&["build", "--quiet", "--release", "-p", "commissioning", "--example", "scans"]);
        let output = Command::new(workspace.program("examples/scans"))
            .output()
            .expect("a program that can be started");
        let text = String::from_utf8_lossy(&output.stdout);
        let scan: f64 = text.trim().parse().expect("the nanoseconds of a scan");
        if property.is_empty() {
            without = scan;
        }
        let each = (scan - without) / (MACHINES * PROPERTIES) as f64;
        println!("  {name:44} {scan:10.0} ns a scan of {MACHINES} machines, {each:5.2} ns a property");
    }
}
