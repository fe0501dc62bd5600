//! What a command has begun goes with it when a signal ends the program: files that are not whole yet, temporary
//! folders, processes. Elsewhere than on Unix a signal ends the program at once.

use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::thread;
use std::time::Duration;

static BEGUN: Mutex<Begun> = Mutex::new(Begun { paths: Vec::new(), processes: Vec::new() });
/// The first SIGINT only asks; the next one ends the program.
static ASKS_FIRST: AtomicBool = AtomicBool::new(false);
static ASKED: AtomicBool = AtomicBool::new(false);
static WRITING: Mutex<()> = Mutex::new(());

struct Begun {
    paths: Vec<PathBuf>,
    /// Their numbers; of some of them also that of their group.
    processes: Vec<u32>,
}

fn begun() -> MutexGuard<'static, Begun> {
    BEGUN.lock().unwrap_or_else(PoisonError::into_inner)
}

/// While this lives, the first SIGINT asks to come to an end.
pub struct Asks(());

pub fn asks_first() -> Asks {
    ASKS_FIRST.store(true, Ordering::SeqCst);
    Asks(())
}

impl Asks {
    pub fn asked(&self) -> bool {
        ASKED.load(Ordering::SeqCst)
    }
}

impl Drop for Asks {
    fn drop(&mut self) {
        ASKS_FIRST.store(false, Ordering::SeqCst);
    }
}

/// While this is held a signal waits. It is for short sections, and none within another.
pub fn writing() -> MutexGuard<'static, ()> {
    WRITING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A file or folder, perhaps still to be made, that is removed when this is dropped or a signal ends the program.
#[derive(Debug)]
pub struct Temporary(PathBuf);

impl Temporary {
    pub fn new(path: PathBuf) -> Self {
        begun().paths.push(path.clone());
        Self(path)
    }

    pub fn path(&self) -> &Path {
        &self.0
    }

    /// It stays where it is.
    pub fn leave(self) {
        begun().paths.retain(|path| *path != self.0);
        std::mem::forget(self);
    }
}

impl Drop for Temporary {
    fn drop(&mut self) {
        let _ = remove(&self.0);
        begun().paths.retain(|path| *path != self.0);
    }
}

fn remove(path: &Path) -> io::Result<()> {
    match path.symlink_metadata()?.is_dir() {
        true => fs::remove_dir_all(path),
        false => fs::remove_file(path),
    }
}

/// Runs a process to its end and returns what it wrote. If its standard input is a pipe, it stays open until then.
pub fn output(command: &mut Command) -> io::Result<Output> {
    let mut child = {
        let _writing = writing();
        let child = command.spawn()?;
        begun().processes.push(child.id());
        child
    };
    let (process, _input) = (child.id(), child.stdin.take());
    let output = child.wait_with_output();
    begun().processes.retain(|other| *other != process);
    output
}

/// Gives a process and those that it starts a group of their own, so that they end together. On Linux the process
/// is killed too when this one is.
pub fn in_group(command: &mut Command) -> &mut Command {
    #[cfg(unix)]
    std::os::unix::process::CommandExt::process_group(command, 0);
    #[cfg(target_os = "linux")]
    end_with_this_process(command);
    command
}

#[cfg(target_os = "linux")]
#[allow(unsafe_code)] // What runs between fork and exec has no checked rules.
fn end_with_this_process(command: &mut Command) {
    use rustix::process::{Signal, getppid, set_parent_process_death_signal};
    let parent = rustix::process::getpid();
    let ask = move || {
        set_parent_process_death_signal(Some(Signal::KILL))?;
        // It may have died before it was asked.
        if getppid() == Some(parent) { Ok(()) } else { Err(io::ErrorKind::Interrupted.into()) }
    };
    // SAFETY: two system calls, which take no lock and no memory.
    unsafe { std::os::unix::process::CommandExt::pre_exec(command, ask) };
}

/// Ends all processes and removes all paths that were begun. Nothing can be begun any more: the program has to end.
pub fn abandon() {
    std::mem::forget(writing());
    let begun = begun();
    begun.processes.iter().for_each(|process| kill(*process));
    for path in &begun.paths {
        // What was killed may still be ending.
        for _ in 0..20 {
            let _ = remove(path);
            if path.symlink_metadata().is_err() {
                break;
            }
            thread::sleep(Duration::from_millis(50));
        }
    }
    std::mem::forget(begun);
}

#[cfg(unix)]
fn kill(process: u32) {
    use rustix::process::{Pid, Signal, kill_process, kill_process_group};
    if let Some(pid) = i32::try_from(process).ok().and_then(Pid::from_raw) {
        let _ = kill_process_group(pid, Signal::KILL);
        let _ = kill_process(pid, Signal::KILL);
    }
}

#[cfg(not(unix))]
fn kill(_: u32) {}

/// From now on SIGHUP, SIGINT and SIGTERM abandon what was begun before they end the program.
#[cfg(unix)]
pub fn install() {
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    let Ok(mut signals) = signal_hook::iterator::Signals::new([SIGHUP, SIGINT, SIGTERM]) else { return };
    thread::spawn(move || {
        for signal in signals.forever() {
            if signal == SIGINT && ASKS_FIRST.load(Ordering::SeqCst) && !ASKED.swap(true, Ordering::SeqCst) {
                continue;
            }
            abandon();
            let _ = signal_hook::low_level::emulate_default_handler(signal);
        }
    });
}

#[cfg(not(unix))]
pub fn install() {}
