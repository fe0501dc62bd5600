//! One system on two engines: the executor, and the compiled controllers, which replay what the executor was given.

use crate::trace;
use crate::workspace::Workspace;
use autogen::executor::Executor;
use autogen::ir::System;
use runtime_sim::device::Direction;
use runtime_sim::random::Random;
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};
use std::collections::BTreeSet;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

/// Inputs drawn by lot, of which some are beyond what a device may send: a line for each scan.
pub struct Lots {
    random: Random,
    pub images: Vec<Vec<f64>>,
    scan: u32,
    /// One in how many inputs changes in a scan when little happens, and one in how many commands is answered.
    calm: (u32, u32),
}

impl Lots {
    pub fn new(system: &System, seed: u64) -> Self {
        let words = |i: usize| system.automaton_of(i).device.words(Direction::Input, system.kinds());
        Self {
            random: Random::new(seed),
            images: (0..system.instances.len()).map(|i| vec![0.0; words(i)]).collect(),
            scan: 0,
            calm: (150, 60),
        }
    }

    /// Something happens always.
    pub fn lively(system: &System, seed: u64) -> Self {
        Self { calm: (20, 5), ..Self::new(system, seed) }
    }

    fn one_in(&mut self, count: u32) -> bool {
        self.random.up_to(count - 1) == 0
    }

    fn word(&mut self) -> f64 {
        match self.random.up_to(40) {
            0 => f64::NAN,
            1 => f64::INFINITY,
            2 => -0.0,
            3 => -1e300,
            4 => 70_000.5,
            30..32 => -1.0,
            5..12 => 1.0,
            12..20 => f64::from(self.random.up_to(32_767)),
            20..26 => f64::from(self.random.up_to(12)),
            26..30 => f64::from(self.random.up_to(8000)) / 1000.0 - 4.0,
            _ => 0.0,
        }
    }

    /// Inputs of the next scan; devices often answer the command that they see in the outputs.
    pub fn next(&mut self, system: &System, outputs: &[Vec<f64>]) -> SystemInputs {
        // Times in which much happens take turns with others in which little does.
        self.scan += 1;
        let (changes, answers) = if self.scan / 64 % 3 == 0 { (6, 2) } else { self.calm };
        for robot in 0..self.images.len() {
            let device = system.automaton_of(robot).device;
            for word in 0..self.images[robot].len() {
                if self.one_in(changes) {
                    self.images[robot][word] = self.word();
                }
            }
            if device.is_commanded() && self.one_in(answers) {
                let command = outputs[robot].first().copied().unwrap_or(0.0);
                let error = if self.one_in(4) { 2.0 } else { 0.0 };
                for (port, value) in [("got", command), ("ack", command), ("error", error)] {
                    let at = device.offset(port, system.kinds()).expect("a commanded device");
                    self.images[robot][at] = value;
                }
            }
        }
        SystemInputs { run_permit: !self.one_in(60), start: self.one_in(3), reset: self.one_in(4) }
    }
}

/// What an engine was given and what it answered, a line for each scan.
#[derive(Default)]
pub struct Recording {
    /// As `commissioning --replay` reads it.
    pub inputs: String,
    /// As it prints them: the bits of all that the system remembers and publishes.
    pub answers: Vec<String>,
    /// Scans in which the system ran.
    pub running: usize,
    /// Codes of the faults that were raised.
    pub faults: BTreeSet<i32>,
}

impl Recording {
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
        ];
        all.extend(outputs.iter().flatten());
        engine.trace(&mut all);
        self.answers.push(bits(&all));
        self.running += usize::from(answer.running);
        if answer.fault {
            self.faults.insert(answer.fault_code);
        }
        answer
    }
}

/// So many scans of the executor with inputs drawn by lot.
pub fn record(executor: &mut Executor, system: &System, scans: usize, mut lots: Lots) -> Recording {
    let mut recording = Recording::default();
    let mut outputs = vec![Vec::new(); system.instances.len()];
    for _ in 0..scans {
        let given = lots.next(system, &outputs);
        recording.scan(executor, given, &lots.images, &mut outputs);
    }
    recording
}

/// What the columns of an answer are.
pub fn columns(system: &System) -> Vec<String> {
    let mut names: Vec<String> = ["running", "fault", "fault_code", "fault_robot"].map(String::from).into();
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
            let end = state.transitions.iter().position(|t| t.text == "true").map_or(fired.len(), |i| i + 1);
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
