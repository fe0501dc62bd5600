//! How long after its device has done what it was told each answer comes.

use runtime_sim::line::Answer;

pub struct Late {
    answers: Vec<Answer>,
    scan_ms: u64,
}

impl Late {
    /// `known`: commands that do not end well.
    pub fn new(known: &[Answer], scan_ms: u64) -> Self {
        Self { answers: known.to_vec(), scan_ms }
    }

    /// A command is answered so many scans late, and so many seconds more.
    pub fn put_off(&mut self, machine: usize, command: u32, scans: u64, more_s: f64) {
        let late_s = (scans * self.scan_ms) as f64 / 1000.0 + more_s;
        let is_it = |answer: &&mut Answer| (answer.machine, answer.command) == (machine, command);
        match self.answers.iter_mut().find(is_it) {
            Some(answer) => answer.late_s = late_s,
            None => self.answers.push(Answer { machine, command, late_s, error: None }),
        }
    }

    /// Those that come at once, and well, need no entry.
    pub fn answers(self) -> Vec<Answer> {
        let is_told = |answer: &Answer| answer.late_s > 0.0 || answer.error.is_some();
        self.answers.into_iter().filter(is_told).collect()
    }
}
