//! One system on two engines: the executor, and the compiled controllers, which replay what the executor was given.

use crate::lots::Lots;
use crate::trace;
use crate::workspace::Workspace;
use autogen::executor::Executor;
use autogen::ir::System;
use runtime_sim::device::Direction;
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};
use std::collections::BTreeSet;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// What an engine was given and what it answered, a line for each scan.
#[derive(Default)]
pub struct Recording {
    /// As `commissioning --replay` reads it.
    pub inputs: String,
    /// As it prints them: the bits of all that the system remembers and publishes.
    pub answers: Vec<String>,
    /// Scans in which the system ran.
    pub running: usize,
    /// Codes of the faults, and of the alarms that were told.
    pub faults: BTreeSet<i32>,
}

impl Recording {
    /// Power is lost and comes back.
    pub fn power_up(&mut self, engine: &mut dyn Controllers) {
        engine.power_up();
        self.inputs += "power\n";
    }

    /// One scan of an engine.
    pub fn scan(
        &mut self,
        engine: &mut dyn Controllers,
        given: SystemInputs,
        images: &[Vec<f64>],
        outputs: &mut [Vec<f64>],
    ) -> SystemOutputs {
        let flag = |b: bool| u8::from(b);
        self.inputs += &format!("{} {} {}", flag(given.run_permit), flag(given.start), flag(given.reset));
        for image in images {
            self.inputs += &format!(" {}", image.len());
            image.iter().for_each(|word| self.inputs += &format!(" {word:?}"));
        }
        self.inputs.push('\n');
        let answer = engine.scan(given, images, outputs);
        let mut all = vec![
            f64::from(flag(answer.running)),
            f64::from(flag(answer.fault)),
            f64::from(answer.fault_code),
            f64::from(answer.fault_robot),
            f64::from(flag(answer.alarm)),
            f64::from(answer.alarm_code),
            f64::from(answer.alarm_robot),
        ];
        all.extend(outputs.iter().flatten());
        engine.trace(&mut all);
        self.answers.push(bits(&all));
        self.running += usize::from(answer.running);
        if answer.fault {
            self.faults.insert(answer.fault_code);
        }
        if answer.alarm_code > 0 {
            self.faults.insert(answer.alarm_code);
        }
        answer
    }
}

/// So many scans of the executor with inputs drawn by lot.
pub fn record(executor: &mut Executor, system: &System, scans: usize, mut lots: Lots) -> Recording {
    let mut recording = Recording::default();
    let mut outputs = vec![Vec::new(); system.instances.len()];
    for _ in 0..scans {
        if lots.powers_up() {
            recording.power_up(executor);
        }
        let given = lots.next(system, &outputs);
        recording.scan(executor, given, &lots.images, &mut outputs);
    }
    recording
}

/// The scans of a hand-written trace on an engine.
pub fn record_trace(engine: &mut dyn Controllers, fixture: &trace::Fixture) -> Recording {
    let mut recording = Recording::default();
    let mut outputs = vec![Vec::new(); fixture.system.instances.len()];
    for scan in &fixture.scans {
        if scan.powers_up {
            recording.power_up(engine);
        }
        recording.scan(engine, scan.system, &scan.inputs, &mut outputs);
    }
    recording
}

/// What the columns of an answer are.
pub fn columns(system: &System) -> Vec<String> {
    let mut names: Vec<String> =
        ["running", "fault", "fault_code", "fault_robot", "alarm", "alarm_code", "alarm_robot"]
            .map(String::from)
            .into();
    for (index, instance) in system.instances.iter().enumerate() {
        let ports = system.automaton_of(index).device.ports.iter();
        for port in ports.filter(|p| p.direction == Direction::Output) {
            let words = 0..port.words(system.kinds());
            names.extend(words.map(|w| format!("{}: {}, published, word {w}", instance.name, port.name)));
        }
    }
    names.extend(trace::columns(system));
    names
}

/// The first column of the first scan in which two answers differ, or `None`.
pub fn difference(system: &System, expected: &[String], found: &str) -> Option<String> {
    let lines: Vec<&str> = found.lines().collect();
    for (scan, (wanted, found)) in expected.iter().zip(&lines).enumerate() {
        if wanted == found {
            continue;
        }
        let names = columns(system);
        let (wanted, found): (Vec<&str>, Vec<&str>) =
            (wanted.split(' ').collect(), found.split(' ').collect());
        let at = wanted.iter().zip(&found).position(|(a, b)| a != b).unwrap_or(wanted.len().min(found.len()));
        let value = |words: &[&str]| {
            let word = words.get(at).copied().unwrap_or("nothing");
            let number = u64::from_str_radix(word, 16).map(f64::from_bits);
            number.map_or(word.to_string(), |n| format!("{n:?} ({word})"))
        };
        let name = names.get(at).map_or("beyond the columns", |n| n);
        return Some(format!(
            "scan {scan}, column {at}, {name}: the executor has {}, the controllers have {}",
            value(&wanted),
            value(&found)
        ));
    }
    (expected.len() != lines.len()).then(|| format!("{} scans and {}", expected.len(), lines.len()))
}

/// Has the compiled controllers replay a recording; the parameters are a file of the workspace.
pub fn replay(program: &Path, workspace: &Workspace, parameters: &str, recording: &Recording) -> String {
    run(program, &["--replay", parameters], &workspace.folder, &recording.inputs)
}

/// Transitions that have not fired.
pub fn silent(system: &System, executor: &Executor) -> Vec<String> {
    let mut silent = Vec::new();
    for (automaton, fired) in system.model.automata.iter().zip(executor.fired()) {
        for (state, fired) in automaton.states.iter().zip(fired) {
            // What stands behind `when true` cannot fire.
            let end =
                state.transitions.iter().position(|t| t.is_unconditional()).map_or(fired.len(), |i| i + 1);
            for (transition, _) in state.transitions.iter().zip(&fired[..end]).filter(|(_, n)| **n == 0) {
                silent.push(format!("{}.{}: {}", automaton.name, state.name, transition.text));
            }
        }
    }
    silent
}

/// NaN has many bit patterns, and which one an operation yields is nobody's promise.
pub fn bits(words: &[f64]) -> String {
    let bits = |word: &f64| if word.is_nan() { "nan".into() } else { format!("{:x}", word.to_bits()) };
    words.iter().map(bits).collect::<Vec<String>>().join(" ")
}

/// Runs a program that has to succeed; what it prints.
pub fn run(program: &Path, arguments: &[&str], folder: &Path, input: &str) -> String {
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
