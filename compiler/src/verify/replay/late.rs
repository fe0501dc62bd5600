//! How long after its device has done what it was told each answer comes.

use runtime_sim::line::Answer;
use std::collections::HashMap;

pub struct Late {
    answers: Vec<Answer>,
    /// Where among these stands that of a machine to one of its commands.
    places: HashMap<(usize, u32), usize>,
    scan_ms: u64,
}

impl Late {
    /// `known`: commands that do not end well.
    pub fn new(known: &[Answer], scan_ms: u64) -> Self {
        let places = known.iter().enumerate();
        let places = places.rev().map(|(place, answer)| ((answer.machine, answer.command), place));
        Self { answers: known.to_vec(), places: places.collect(), scan_ms }
    }

    /// A command is answered so many scans late, and so many seconds more.
    pub fn put_off(&mut self, machine: usize, command: u32, scans: u64, more_s: f64) {
        let late_s = (scans * self.scan_ms) as f64 / 1000.0 + more_s;
        let place = *self.places.entry((machine, command)).or_insert_with(|| {
            self.answers.push(Answer { machine, command, late_s, error: None });
            self.answers.len() - 1
        });
        self.answers[place].late_s = late_s;
    }

    /// Those that come at once, and well, need no entry.
    pub fn answers(self) -> Vec<Answer> {
        let is_told = |answer: &Answer| answer.late_s > 0.0 || answer.error.is_some();
        self.answers.into_iter().filter(is_told).collect()
    }
}
