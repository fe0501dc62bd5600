//! What runs, scans and builds cost: `cargo bench -p autogen-tests`.
//!
//! No harness that repeats a closure until its mean is firm: the figures are parts of one whole, differences
//! within one run, and single builds of many seconds.

mod build;
mod lines;
mod properties;

use autogen_tests::ariac;
use autogen_tests::workspace::Workspace;
use mimalloc::MiMalloc;
use std::process::Command;

/// That of the program.
#[global_allocator]
static MEMORY: MiMalloc = MiMalloc;

fn main() {
    println!("The default line, on the generated controllers\n");
    run();
    println!("\nProperties, in the generated controllers\n");
    properties::measure();
    println!("\nBuild, from texts to files in memory\n");
    build::measure();
}

/// Simulated seconds per second of a model of the same line in SimPy; none where Python or SimPy is missing.
fn simpy() -> Option<String> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/cost/line.py");
    let output = Command::new("python3").arg(script).output().ok()?;
    let figure = String::from_utf8_lossy(&output.stdout).trim().to_string();
    output.status.success().then_some(figure)
}

/// A program beside the generated controllers does it: only there they are linked.
fn run() {
    let outcome = ariac("default").compile();
    let project = outcome.project.expect("a line that is right");
    let workspace = Workspace::write("cost", &project.system, &outcome.sources);
    workspace.put("line.txt", &project.plant.to_text());
    workspace.put("commissioning/examples/cost/main.rs", include_str!("linked.rs"));
    workspace.put("commissioning/examples/cost/by_hand.rs", include_str!("by_hand.rs"));
    workspace.cargo(&["build", "--quiet", "--release", "-p", "commissioning", "--example", "cost"]);
    let mut arguments = vec!["line.txt".to_string(), "parameters.txt".to_string()];
    arguments.extend(simpy());
    let status = Command::new(workspace.program("examples/cost"))
        .args(arguments)
        .current_dir(&workspace.folder)
        .status()
        .expect("a program that can be started");
    assert!(status.success());
}
