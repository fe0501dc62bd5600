//! The generated Rust: how it reads, that it compiles without a warning, that no path leads to a panic,
//! and that it does what the reference executor does.

use autogen::backend::rust;
use autogen::executor::Executor;
use autogen::ir::System;
use autogen::source::Sources;
use autogen_tests::instances::instantiate;
use autogen_tests::lots::Lots;
use autogen_tests::workspace::Workspace;
use autogen_tests::{ariac, root};
use runtime_sim::device::Direction;
use runtime_sim::run::{Seen, run as simulate};
use runtime_sim::scan::Controllers;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// Names and texts of the fixtures.
fn fixtures() -> Vec<(String, String)> {
    let folder = root().join("tests/fixtures/rust");
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .expect("a folder of fixtures")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let text = |name: String| (name.clone(), autogen_tests::text(&format!("tests/fixtures/rust/{name}")));
    names.into_iter().map(text).collect()
}

#[test]
fn fixtures_read_well() {
    for (name, text) in fixtures() {
        let (system, sources) = instantiate(&[(name.clone(), text.clone())]);
        let files = rust::files(&system, &sources);
        let mut shown = text;
        for automaton in &system.model.automata {
            let module = autogen::naming::snake(&automaton.name);
            let path = files
                .keys()
                .find(|path| path.starts_with(&format!("controllers/src/{module}")))
                .expect("its module");
            shown += &format!("\n---- {path}\n{}", files[path]);
        }
        insta::assert_snapshot!(name.trim_end_matches(".aut"), shown);
    }
}

/// All fixtures in one system.
fn together() -> (System, Sources) {
    instantiate(&fixtures())
}

/// What the executor answers to so many scans of inputs drawn by lot: the inputs as the replay reads them,
/// and the bits as it prints them.
fn executed(system: &System, scans: usize, seed: u64) -> (String, Vec<String>) {
    let mut executor = Executor::new(system);
    let mut lots = Lots::new(system, seed);
    let mut outputs = vec![Vec::new(); system.instances.len()];
    let (mut inputs, mut answers) = (String::new(), Vec::new());
    for _ in 0..scans {
        let given = lots.next(system, &outputs);
        let flag = |b: bool| u8::from(b);
        inputs += &format!("{} {} {}", flag(given.run_permit), flag(given.start), flag(given.reset));
        for image in &lots.images {
            inputs += &format!(" {}", image.len());
            image.iter().for_each(|word| inputs += &format!(" {word:?}"));
        }
        inputs.push('\n');
        let answer = executor.scan(given, &lots.images, &mut outputs);
        let mut all = vec![
            f64::from(flag(answer.running)),
            f64::from(flag(answer.fault)),
            f64::from(answer.fault_code),
            f64::from(answer.fault_robot),
        ];
        all.extend(outputs.iter().flatten());
        executor.trace(&mut all);
        answers.push(bits(&all));
    }
    let silent = silent(system, &executor);
    assert!(silent.is_empty(), "never fired:\n{}", silent.join("\n"));
    (inputs, answers)
}

/// Transitions that have not fired.
fn silent(system: &System, executor: &Executor) -> Vec<String> {
    let mut silent = Vec::new();
    for (automaton, fired) in system.model.automata.iter().zip(executor.fired()) {
        for (state, fired) in automaton.states.iter().zip(fired) {
            // What stands behind `when true` cannot fire.
            let end = state.transitions.iter().position(|t| t.text == "true").map_or(fired.len(), |i| i + 1);
            for (transition, _) in state.transitions.iter().zip(&fired[..end]).filter(|(_, n)| **n == 0) {
                silent.push(format!("{}.{}: {}", automaton.name, state.name, transition.text));
            }
        }
    }
    silent
}

/// NaN has many bit patterns, and which one an operation yields is nobody's promise.
fn bits(words: &[f64]) -> String {
    let bits = |word: &f64| if word.is_nan() { "nan".into() } else { format!("{:x}", word.to_bits()) };
    words.iter().map(bits).collect::<Vec<String>>().join(" ")
}

fn run(program: &Path, arguments: &[&str], folder: &Path, input: &str) -> String {
    let mut child = Command::new(program)
        .args(arguments)
        .current_dir(folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .expect("a program that can be started");
    let mut stdin = child.stdin.take().expect("a pipe");
    let input = input.to_string();
    let writer = std::thread::spawn(move || stdin.write_all(input.as_bytes()));
    let output = child.wait_with_output().expect("a program that ends");
    writer.join().expect("no panic").expect("a program that reads its input");
    assert!(output.status.success(), "{program:?} {arguments:?}: {}", output.status);
    String::from_utf8(output.stdout).expect("text")
}

#[test]
fn fixtures_run_as_on_the_executor() {
    let (system, sources) = together();
    let workspace = Workspace::write("fixtures", &system, &sources);
    workspace.cargo(&["clippy", "--quiet", "--all-targets", "--", "-D", "warnings"]);
    workspace.cargo(&["build", "--quiet", "--release", "-p", "commissioning", "--bins", "--examples"]);
    let (inputs, expected) = executed(&system, 30_000, 1);

    let replay =
        run(&workspace.program("commissioning"), &["--replay", "parameters.txt"], &workspace.folder, &inputs);
    let replayed: Vec<&str> = replay.lines().collect();
    assert_eq!(replayed.len(), expected.len());
    for (scan, (found, wanted)) in replayed.iter().zip(&expected).enumerate() {
        assert_eq!(found, wanted, "scan {scan}");
    }

    // The constants of the layout make the same controllers as the words.
    let host = run(&workspace.program("examples/host"), &[], &workspace.folder, &inputs);
    let outputs: usize = (0..system.instances.len())
        .map(|i| system.automaton_of(i).device.words(Direction::Output, system.kinds()))
        .sum();
    for (scan, (found, wanted)) in host.lines().zip(&expected).enumerate() {
        let words: Vec<f64> = found.split(' ').map(|w| w.parse().expect("a number")).collect();
        let wanted: Vec<&str> = wanted.split(' ').collect();
        let wanted = [&wanted[..1], &wanted[2..3], &wanted[4..4 + outputs]].concat().join(" ");
        assert_eq!(bits(&words), wanted, "scan {scan}");
    }
}

#[test]
fn the_line_runs_as_on_the_executor() {
    let outcome = ariac("default").compile();
    let project = outcome.project.expect("a line that is right");
    let workspace = Workspace::write("default", &project.system, &outcome.sources);
    workspace.put("line.txt", &project.plant.to_text());
    workspace.cargo(&["clippy", "--quiet", "--all-targets", "--", "-D", "warnings"]);
    workspace.cargo(&["build", "--quiet", "--release", "-p", "commissioning", "--bins"]);
    let arguments = ["line.txt", "parameters.txt", "--hashes", "hashes.txt"];
    let report = run(&workspace.program("commissioning"), &arguments, &workspace.folder, "");

    let mut hashes = String::new();
    let mut executor = Executor::new(&project.system);
    let observe = &mut |seen: &Seen| hashes += &format!("{:016x}\n", seen.hash);
    let expected = simulate(&project.plant, &mut executor, observe).expect("a line that can be run");
    let found = std::fs::read_to_string(workspace.folder.join("hashes.txt")).expect("the hashes");
    for (scan, (found, wanted)) in found.lines().zip(hashes.lines()).enumerate() {
        assert_eq!(found, wanted, "scan {scan}");
    }
    assert_eq!(report.trim_end(), expected.to_json());
    assert_eq!(found.len(), hashes.len());
    links_without_a_panic(&workspace);
}

/// A program for a controller without an operating system, whose panic handler does not exist.
const BARE: &str = r#"#![no_std]
#![no_main]

use controllers::line;
use controllers::system::{System, SystemInputs};

unsafe extern "C" {
    fn there_is_a_path_to_a_panic() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    unsafe { there_is_a_path_to_a_panic() }
}

#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    let mut memory = line::Memory::NEW;
    let mut cells = memory.cells();
    let mut robots = line::robots();
    let mut system = System::new();
    loop {
        let read = |at: usize| unsafe { core::ptr::read_volatile((0x4000_0000 + at) as *const u32) } != 0;
        let inputs = SystemInputs { run_permit: read(0), start: read(4), reset: read(8) };
        let answer = system.scan(inputs, &line::WIRING, &mut robots, &mut cells);
        unsafe { core::ptr::write_volatile(0x4000_0010 as *mut i32, answer.fault_code) };
    }
}
"#;

const BARE_MANIFEST: &str = r#"[package]
name = "bare"
version = "0.1.0"
edition = "2024"

[workspace]

[dependencies]
controllers = { path = "../controllers" }

[profile.release]
opt-level = 2
lto = true
panic = "abort"
overflow-checks = false
"#;

fn links_without_a_panic(workspace: &Workspace) {
    workspace.put("bare/Cargo.toml", BARE_MANIFEST);
    workspace.put("bare/src/main.rs", BARE);
    for level in ["2", "\"s\""] {
        workspace
            .put("bare/Cargo.toml", &BARE_MANIFEST.replace("opt-level = 2", &format!("opt-level = {level}")));
        workspace.cargo(&[
            "rustc",
            "--quiet",
            "--release",
            "--manifest-path",
            "bare/Cargo.toml",
            "--target",
            "thumbv7em-none-eabihf",
        ]);
    }
}

#[test]
fn no_path_of_the_fixtures_leads_to_a_panic() {
    let (system, sources) = together();
    links_without_a_panic(&Workspace::write("bare", &system, &sources));
}
