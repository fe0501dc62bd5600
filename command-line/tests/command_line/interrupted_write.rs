//! A process that is killed while it writes, and a disk that fails: the output is the old one or the new one, and
//! the next process needs no `--force`.

use super::{autogen, contents, errors, example, folder, status};
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};
use std::time::Duration;
use std::{env, fs, thread};

type Contents = Vec<(PathBuf, Vec<u8>)>;

const UNFINISHED: &str = "autogen-unfinished";

fn is_full_campaign() -> bool {
    env::var("AUTOGEN_CAMPAIGN").is_ok_and(|campaign| campaign == "full")
}

/// The library that makes system calls fail, compiled.
fn failing_disk(folder: &Path) -> PathBuf {
    let library = folder.join("failing_disk.so");
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/command_line/failing_disk.c");
    let compiled = Command::new("cc")
        .args(["-shared", "-fPIC", "-O1", "-w", "-o"])
        .args([&library, &source])
        .arg("-ldl")
        .status();
    assert!(compiled.is_ok_and(|status| status.success()), "a C compiler, which Rust needs as well");
    library
}

/// What can befall a call.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Fate {
    Killed,
    /// Once.
    NoSpace,
    /// From then on.
    ReadOnly,
    InputOutputError,
}

struct Disk {
    folder: PathBuf,
    library: PathBuf,
}

impl Disk {
    fn new(name: &str) -> Self {
        let folder = folder(name);
        let library = failing_disk(&folder);
        Self { folder, library }
    }

    fn arguments(&self, capacity: usize) -> Vec<String> {
        let layout = example("ariac2021/less_agv.json");
        let set = format!("agv.capacity={capacity}");
        ["build", &layout, "-o", "made", "--set", &set].map(String::from).to_vec()
    }

    fn build(&self, capacity: usize) -> Output {
        let arguments = self.arguments(capacity);
        autogen(&self.folder, &arguments.iter().map(String::as_str).collect::<Vec<_>>())
    }

    fn made(&self) -> PathBuf {
        self.folder.join("made")
    }

    fn contents(&self) -> Contents {
        if self.made().exists() { contents(&self.made()) } else { Vec::new() }
    }

    /// Files as they were once, which is quicker than to build them.
    fn restore(&self, files: &Contents) {
        let _ = fs::remove_dir_all(self.made());
        for (path, bytes) in files {
            fs::create_dir_all(path.parent().expect("a file in a folder")).expect("a folder");
            fs::write(path, bytes).expect("a file");
        }
    }

    fn build_on_failing(&self, capacity: usize, fate: Fate, call: usize) -> Output {
        let mut command = Command::new(env!("CARGO_BIN_EXE_autogen"));
        command.args(self.arguments(capacity)).current_dir(&self.folder);
        let error = match fate {
            Fate::Killed => "kill",
            Fate::NoSpace => "28",
            Fate::InputOutputError => "5",
            Fate::ReadOnly => {
                command.env("DISK_FOREVER", "1");
                "30"
            }
        };
        command
            .env("LD_PRELOAD", &self.library)
            .env("DISK_BELOW", "made")
            .env("DISK_AT", call.to_string())
            .env("DISK_ERROR", error)
            .env("DISK_COUNT", self.folder.join("calls"));
        command.output().expect("autogen can be started")
    }

    /// Calls that write of the last process, which has ended by itself.
    fn calls(&self) -> usize {
        let text = fs::read_to_string(self.folder.join("calls")).expect("the number of calls");
        text.trim().parse().expect("a number")
    }
}

/// Tries a fate at calls so many apart, from the old output to the new one; an old capacity of 0 is none at all.
fn try_each(disk: &Disk, old: usize, new: usize, fate: Fate, apart: usize) {
    assert_eq!(status(&disk.build(new)), 0);
    let after = disk.contents();
    match old {
        0 => fs::remove_dir_all(disk.made()).expect("a folder"),
        _ => {
            let output = disk.build(old);
            assert_eq!(status(&output), 0, "{}", errors(&output));
        }
    }
    let before = disk.contents();
    assert_eq!(status(&disk.build_on_failing(new, fate, usize::MAX)), 0);
    let calls = disk.calls();
    assert!(calls > 50, "{calls} calls of the library were seen");
    // Other calls for each fate.
    for call in (1 + fate as usize * 25 % apart..=calls).step_by(apart) {
        let what = format!("{fate:?} at call {call} of {calls}, from {old} to {new}");
        disk.restore(&before);
        assert!(disk.contents() == before, "{what}: the state to begin with");
        let output = disk.build_on_failing(new, fate, call);
        let found = disk.contents();
        let is_unfinished = disk.made().join(UNFINISHED).join("journal.json").exists();
        match fate {
            Fate::Killed => assert!(output.status.code().is_none(), "{what}"),
            _ => assert!([0, 2].contains(&status(&output)), "{what}: {}", errors(&output)),
        }
        assert!(status_of(&output) != Some(2) || !errors(&output).is_empty(), "{what}");
        if is_unfinished {
            assert!(matches!(fate, Fate::Killed | Fate::ReadOnly), "{what}: an error is undone at once");
        } else {
            let whole: Contents = found
                .into_iter()
                .filter(|(path, _)| !path.starts_with(disk.made().join(UNFINISHED)))
                .collect();
            assert!(whole == before || whole == after, "{what}: the old or the new");
            assert!(status_of(&output) != Some(0) || whole == after, "{what}: it said that it was done");
        }
        let output = disk.build(new);
        assert_eq!(status(&output), 0, "{what}: {}", errors(&output));
        assert!(disk.contents() == after, "{what}: the next process");
    }
}

fn status_of(output: &Output) -> Option<i32> {
    output.status.code()
}

#[test]
fn a_write_that_ends_at_any_call_leaves_the_old_or_the_new_output() {
    let disk = Disk::new("interrupted_write");
    let apart = if is_full_campaign() { 1 } else { 211 };
    for fate in [Fate::Killed, Fate::NoSpace, Fate::ReadOnly, Fate::InputOutputError] {
        try_each(&disk, 2, 3, fate, apart);
    }
    try_each(&disk, 0, 3, Fate::Killed, apart * 3);
    try_each(&disk, 0, 3, Fate::NoSpace, apart * 3);
}

#[test]
fn an_unfinished_write_is_undone_and_a_change_by_hand_is_seen() {
    let disk = Disk::new("interrupted_then_changed");
    assert_eq!(status(&disk.build(2)), 0);
    let before = disk.contents();
    disk.build_on_failing(3, Fate::Killed, usize::MAX);
    // Near the end, where files have changed places.
    let call = (1..=disk.calls()).rev().step_by(5).find(|call| {
        disk.restore(&before);
        let output = disk.build_on_failing(3, Fate::Killed, *call);
        assert!(output.status.code().is_none());
        disk.made().join(UNFINISHED).join("journal.json").exists()
    });
    assert!(call.is_some() && disk.contents() != before);
    let changed = disk.made().join("plc/portable/main.st");
    fs::write(&changed, "changed by hand").expect("a file");
    let output = disk.build(2);
    assert_eq!(status(&output), 2);
    assert!(errors(&output).contains("main.st"), "{}", errors(&output));
    assert_eq!(fs::read_to_string(&changed).expect("a file"), "changed by hand");
    assert!(!disk.made().join(UNFINISHED).exists());
}

/// Kills at drawn moments, which fall between calls too.
#[test]
fn a_process_killed_at_any_time_leaves_the_old_or_the_new_output() {
    let disk = Disk::new("killed_at_any_time");
    assert_eq!(status(&disk.build(3)), 0);
    let after = disk.contents();
    assert_eq!(status(&disk.build(2)), 0);
    let before = disk.contents();
    let begin = std::time::Instant::now();
    assert_eq!(status(&disk.build(3)), 0);
    let whole = begin.elapsed();
    let mut drawn = 0x2545_f491_4f6c_dd1d_u64;
    for _ in 0..if is_full_campaign() { 300 } else { 15 } {
        disk.restore(&before);
        drawn = drawn.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        let moment: Duration = whole.mul_f64((drawn >> 11) as f64 / (1_u64 << 53) as f64);
        let mut child = Command::new(env!("CARGO_BIN_EXE_autogen"))
            .args(disk.arguments(3))
            .current_dir(&disk.folder)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("autogen can be started");
        thread::sleep(moment);
        let _ = child.kill();
        let _ = child.wait();
        if !disk.made().join(UNFINISHED).join("journal.json").exists() {
            let unfinished = disk.made().join(UNFINISHED);
            let found: Contents =
                disk.contents().into_iter().filter(|(path, _)| !path.starts_with(&unfinished)).collect();
            assert!(found == before || found == after, "after {moment:?}");
        }
    }
}
