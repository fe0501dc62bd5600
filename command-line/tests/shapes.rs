//! Inputs of many shapes that grow where an algorithm or a memory could grow with their square: each is answered
//! in bounded time and memory, whatever the verdict is. `AUTOGEN_CAMPAIGN=full` takes files of nearly 10 MB; with
//! a release build that is at most 2 s and 500 MB for each, one after another (`-- --test-threads 1`).

#[path = "shapes/automata.rs"]
mod automata;
#[path = "shapes/layouts.rs"]
mod layouts;
#[path = "shapes/scenarios.rs"]
mod scenarios;

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};
use std::{env, fs};

/// Texts of one line; what is empty is not given.
#[derive(Default)]
pub struct Shape {
    pub name: &'static str,
    pub layout: String,
    pub automata: String,
    pub scenario: String,
}

/// So many repetitions of what a number makes that the text has about so many bytes.
pub fn repeated(bytes: usize, item: impl Fn(usize) -> String) -> String {
    let mut text = String::new();
    for number in 0.. {
        let next = item(number);
        if text.len() + next.len() > bytes {
            break;
        }
        text += &next;
    }
    text
}

fn is_full() -> bool {
    env::var("AUTOGEN_CAMPAIGN").is_ok_and(|campaign| campaign == "full")
}

fn write(folder: &Path, shape: &Shape) -> Vec<String> {
    fs::create_dir_all(folder).expect("a folder");
    let put = |name: &str, text: &str| {
        let path = folder.join(name);
        fs::write(&path, text).expect("a file");
        path.display().to_string()
    };
    let small = "{\"robots\": [{\"name\": \"t\", \"type\": \"t\", \"pose\": [0, 0, 0]}]}";
    let layout = if shape.layout.is_empty() { small } else { &shape.layout };
    let mut arguments = vec![put("layout.json", layout)];
    if !shape.automata.is_empty() {
        arguments.extend(["--specs".into(), put("types.aut", &shape.automata)]);
    }
    if !shape.scenario.is_empty() {
        arguments.extend(["--scenario".into(), put("made.json", &shape.scenario)]);
    }
    arguments
}

/// Runs it in so much memory and returns its status; `None` if it did not end by itself in time.
fn run(command: &str, arguments: &[String], kilobytes: usize, longest: Duration) -> Option<i32> {
    let begin = Instant::now();
    let mut child = Command::new("sh")
        .args(["-c", &format!("ulimit -v {kilobytes}; exec \"$@\" > /dev/null 2> /dev/null"), "sh"])
        .args([env!("CARGO_BIN_EXE_autogen"), command])
        .args(arguments)
        .spawn()
        .expect("a shell");
    loop {
        if let Some(status) = child.try_wait().expect("a child") {
            return status.code();
        }
        if begin.elapsed() > longest {
            child.kill().expect("a child");
            child.wait().expect("a child");
            return None;
        }
        std::thread::sleep(Duration::from_millis(5));
    }
}

#[test]
#[cfg(target_os = "linux")]
fn every_shape_of_a_layout_is_answered() {
    is_answered("layouts", layouts::ALL);
}

#[test]
#[cfg(target_os = "linux")]
fn every_shape_of_automata_is_answered() {
    is_answered("automata", automata::ALL);
}

#[test]
#[cfg(target_os = "linux")]
fn every_shape_of_a_scenario_is_answered() {
    is_answered("scenarios", scenarios::ALL);
}

#[cfg(target_os = "linux")]
fn is_answered(group: &str, makers: &[fn(usize) -> Shape]) {
    // Below the limits of types, below those of layouts, and above all.
    let sizes: &[usize] = if is_full() { &[30_000, 1_100_000, 9_900_000] } else { &[30_000, 300_000] };
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("shapes").join(group);
    let _ = fs::remove_dir_all(&folder);
    let mut bad = Vec::new();
    for (make, bytes) in makers.iter().flat_map(|make| sizes.iter().map(move |bytes| (make, *bytes))) {
        let shape = make(bytes);
        let arguments = write(&folder.join(shape.name), &shape);
        let output = folder.join(shape.name).join("out").display().to_string();
        let build = [&arguments[..], &["-o".into(), output]].concat();
        for (command, arguments) in [("check", &arguments), ("build", &build), ("graph", &arguments)] {
            let begin = Instant::now();
            let status = run(command, arguments, 500_000, Duration::from_secs(60));
            let seconds = begin.elapsed().as_secs_f64();
            println!("{:30} {bytes:8} {command:6} {status:?} {seconds:.2} s", shape.name);
            if !matches!(status, Some(0..=2)) || is_full() && seconds > 2.0 && !cfg!(debug_assertions) {
                bad.push(format!("{} {bytes} {command}: {status:?} {seconds:.2} s", shape.name));
            }
        }
        let _ = fs::remove_dir_all(folder.join(shape.name));
    }
    assert!(bad.is_empty(), "{}", bad.join("\n"));
}
