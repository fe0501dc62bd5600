//! A signal to autogen alone, as `kill` and `timeout` send it.

use super::{contents, example, folder};
use std::fs;
use std::os::unix::process::ExitStatusExt;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

/// A run of half a minute at least.
const LONG: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}],
    "orders": {"count": 1000, "parts": {"battery": 1}},
    "time_limit_s": 1000000
}"#;

fn begin(folder: &Path, cache: &Path, arguments: &[&str]) -> Child {
    fs::create_dir_all(folder.join("made")).expect("a folder");
    fs::write(folder.join("long.json"), LONG).expect("a file");
    fs::write(folder.join("short.json"), LONG.replace("1000,", "1,")).expect("a file");
    Command::new(env!("CARGO_BIN_EXE_autogen"))
        .args(arguments)
        .args(["--scenario", "long.json"])
        .current_dir(folder)
        .env("XDG_CACHE_HOME", cache)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn()
        .expect("autogen can be started")
}

fn wait_until(child: &mut Child, is_so: impl Fn() -> bool) {
    let begin = Instant::now();
    while !is_so() {
        assert!(begin.elapsed() < Duration::from_secs(300));
        assert!(child.try_wait().is_ok_and(|status| status.is_none()), "it ended by itself");
        sleep(Duration::from_millis(20));
    }
}

/// Sends a signal, and awaits the end of all processes: each of them has the standard error.
fn end(child: Child, signal: &str) -> i32 {
    let kill = Command::new("kill").args(["-s", signal, &child.id().to_string()]).status();
    assert!(kill.is_ok_and(|status| status.success()));
    let begin = Instant::now();
    let output = child.wait_with_output().expect("it ends");
    assert!(begin.elapsed() < Duration::from_secs(10), "a process went on");
    assert!(output.status.code().is_none(), "{}", output.status);
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    let is_expected =
        |line: &str| ["compiling ", "waiting for another "].iter().any(|begin| line.starts_with(begin));
    assert!(said.lines().all(is_expected), "{said}");
    output.status.signal().expect("a signal")
}

/// Whether a path within the folder contains the text; files may vanish meanwhile.
fn has(folder: &Path, text: &str) -> bool {
    fs::read_dir(folder)
        .into_iter()
        .flatten()
        .flatten()
        .any(|entry| entry.path().display().to_string().contains(text) || has(&entry.path(), text))
}

/// Runs, and has written nothing of it yet.
fn is_in_progress(folder: &Path) -> impl Fn() -> bool {
    let made = folder.join("made");
    move || made.join("manifest.json").exists() && !made.join("autogen-unfinished").exists()
}

#[test]
fn nothing_is_left_of_a_run_that_a_signal_ends() {
    let folder = folder("interrupt_run");
    let layout = example("ariac2021/default.json");
    let cache = folder.with_file_name("cache");
    let io = ["--io-trace", "trace.csv", "--trajectories", "paths.csv"];
    let commission = [&["commission", &layout, "-o", "made"][..], &io].concat();
    for (signal, number) in [("INT", 2), ("TERM", 15)] {
        let mut child = begin(&folder, &cache, &commission);
        wait_until(&mut child, is_in_progress(&folder));
        sleep(Duration::from_millis(300));
        assert!(has(&folder, ".partial"));
        assert_eq!(end(child, signal), number);
        assert!(!has(&folder, ".partial") && !has(&folder, "unfinished"));
        assert!(!folder.join("made/results.json").exists() && folder.join("made/manifest.json").exists());
    }
}

/// Whether a process has its working folder there.
#[cfg(target_os = "linux")]
fn is_worked_in(folder: &Path) -> bool {
    let processes = fs::read_dir("/proc").expect("a list of processes").flatten();
    processes
        .filter_map(|entry| fs::read_link(entry.path().join("cwd")).ok())
        .any(|cwd| cwd.starts_with(folder))
}

#[test]
#[cfg(target_os = "linux")]
fn what_a_killed_process_has_begun_goes_with_it_or_with_the_next_one() {
    let folder = folder("interrupt_kill");
    let (layout, cache) = (example("ariac2021/default.json"), folder.join("cache"));
    let commission = ["commission", &layout, "-o", "made", "--io-trace", "trace.csv"];
    let mut child = begin(&folder, &cache, &commission);
    wait_until(&mut child, || has(&cache, "release/deps"));
    assert_eq!(end(child, "KILL"), 9);
    let begin = Instant::now();
    while is_worked_in(&cache) {
        assert!(begin.elapsed() < Duration::from_secs(20), "a compiler went on");
        sleep(Duration::from_millis(20));
    }
    assert!(has(&cache, "workspace") && has(&folder, ".partial"));
    let output =
        super::autogen_in(&folder, &cache, &[&commission[..], &["--scenario", "short.json"]].concat());
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(!has(&cache, "workspace") && !has(&folder, ".partial"));
    assert!(folder.join("trace.csv").exists() && folder.join("made/results.json").exists());
}

#[test]
fn nothing_is_left_of_a_compilation_that_a_signal_ends() {
    let folder = folder("interrupt_compilation");
    let (layout, cache) = (example("ariac2021/default.json"), folder.join("cache"));
    let commission: &[&str] = &["commission", &layout, "-o", "made"];
    let sweep: &[&str] = &["sweep", &layout, "--set", "agv.capacity=2,4"];
    for (command, signal, number) in [(commission, "TERM", 15), (sweep, "INT", 2)] {
        fs::create_dir_all(&cache).expect("a folder");
        let mut child = begin(&folder, &cache, command);
        wait_until(&mut child, || has(&cache, "release/deps"));
        assert_eq!(end(child, signal), number);
        assert!(contents(&cache).is_empty(), "{:?}", contents(&cache).first().map(|(path, _)| path.clone()));
    }
}

#[test]
fn nothing_is_left_of_a_sweep_that_a_signal_ends() {
    let folder = folder("interrupt_sweep");
    let (layout, cache) = (example("ariac2021/default.json"), folder.with_file_name("cache"));
    for signal in ["INT", "TERM"] {
        let long = ["--set", "agv.capacity=2,4", "--replications", "1000"];
        let mut child = begin(&folder, &cache, &[&["sweep", layout.as_str()][..], &long].concat());
        wait_until(&mut child, || has(&cache, "library.sha256") && !has(&cache, "workspace"));
        sleep(Duration::from_secs(2));
        end(child, signal);
        assert!(contents(&folder.join("made")).is_empty());
    }
}
