//! The head of every commanded machine: numbered commands and their answers.

use crate::device::error;
use crate::wiring::{Await, Command, Drives, Source, Wiring};
use std::sync::Arc;

/// The last command of a machine, and its answer.
#[derive(Clone, Debug)]
pub struct Head {
    wiring: Arc<Wiring>,
    /// Where in the image of the outputs they stand.
    cmd: usize,
    verb: usize,
    hold: usize,
    got: i32,
    /// The number of the last command is still there.
    is_given: bool,
    ack: i32,
    error: i32,
    accepted: u32,
    /// Halted on the path.
    pub held: bool,
    /// Which commands to refuse, counted from 1.
    refusals: Vec<u32>,
    answers: Vec<Answer>,
    /// The command has ended; its answer in this error comes at this time, ms from the start of the run.
    late: Option<(i32, u64)>,
    /// What the last command awaits does not come.
    in_vain: bool,
    task: Option<Task>,
}

/// A command under way.
#[derive(Clone, Copy, Debug)]
struct Task {
    /// Its number among those of the wiring.
    command: usize,
    /// The action has ended, and a signal is awaited for so long.
    waited_ms: Option<u64>,
}

/// What the outputs of a scan ask of a machine.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Asked {
    /// Nothing new.
    Nothing,
    /// The command with this number among those of the wiring; the one before it is void.
    Start(usize),
    /// A command came and was refused; the one before it is void.
    Refused,
    /// The last command is void: its number is there no longer.
    Withdrawn,
}

/// How the command of a number, from 1, is answered.
#[derive(Clone, Copy, Debug)]
pub struct Answer {
    pub command: u32,
    pub late_ms: u64,
    pub error: Option<i32>,
}

impl Head {
    /// None for a machine without commands.
    pub fn new(wiring: &Arc<Wiring>, kinds: usize, refusals: Vec<u32>, answers: Vec<Answer>) -> Option<Self> {
        wiring.is_commanded().then_some(())?;
        let at = |drives| wiring.output_at(drives, kinds);
        Some(Self {
            cmd: at(Drives::Command)?,
            verb: at(Drives::Verb)?,
            hold: at(Drives::Hold)?,
            wiring: wiring.clone(),
            got: 0,
            is_given: false,
            ack: 0,
            error: error::NONE,
            accepted: 0,
            held: false,
            refusals,
            answers,
            late: None,
            in_vain: false,
            task: None,
        })
    }

    /// Takes a command if the number is new. Number 0 is no command, and withdraws the last one.
    /// `ends_ms` is when a refusal is answered, ms from the start of the run.
    pub fn accept(&mut self, outputs: &[f64], ends_ms: u64) -> Asked {
        let number = outputs[self.cmd] as i32;
        if number == 0 {
            return self.withdraw();
        }
        if number == self.got {
            return Asked::Nothing;
        }
        self.got = number;
        self.is_given = true;
        self.accepted = self.accepted.saturating_add(1);
        let verb = outputs[self.verb] as i32;
        let known = self.wiring.commands.iter().position(|command| command.number == verb);
        self.late = None;
        let fault = self.answer().and_then(|answer| answer.error);
        let awaited = known.and_then(|command| self.wiring.commands[command].then).map(|then| then.error);
        self.in_vain = fault.is_some() && fault == awaited;
        let refused = match (known, fault) {
            (None, _) => Some(error::REFUSED),
            _ if self.refusals.contains(&self.accepted) => Some(error::REFUSED),
            (Some(_), fault) => fault.filter(|_| !self.in_vain),
        };
        match (refused, known) {
            (None, Some(command)) => Asked::Start(command),
            (refused, _) => {
                self.end(refused.unwrap_or(error::REFUSED), ends_ms);
                Asked::Refused
            }
        }
    }

    /// Answered at once, in [`error::WITHDRAWN`] if it had not ended.
    fn withdraw(&mut self) -> Asked {
        if !std::mem::take(&mut self.is_given) {
            return Asked::Nothing;
        }
        if self.is_under_way() {
            (self.ack, self.error) = (self.got, error::WITHDRAWN);
        }
        (self.task, self.late, self.in_vain) = (None, None, false);
        Asked::Withdrawn
    }

    /// Commands that were given, refused ones too.
    pub fn accepted(&self) -> u32 {
        self.accepted
    }

    /// What the scenario says of the last command.
    fn answer(&self) -> Option<Answer> {
        self.answers.iter().find(|answer| answer.command == self.accepted).copied()
    }

    /// What the last command awaits does not come.
    pub fn is_in_vain(&self) -> bool {
        self.in_vain
    }

    pub fn is_held_by(&self, outputs: &[f64]) -> bool {
        outputs[self.hold] != 0.0
    }

    /// The command has begun.
    pub fn start(&mut self, command: usize) {
        self.task = Some(Task { command, waited_ms: None });
    }

    pub fn is_under_way(&self) -> bool {
        self.got != self.ack
    }

    /// Answers the command under way: reached (0), or why not.
    /// It ends at this time, ms from the start of the run.
    pub fn end(&mut self, error: i32, ends_ms: u64) {
        self.task = None;
        match self.answer().filter(|answer| answer.late_ms > 0) {
            Some(answer) => self.late = Some((error, ends_ms.saturating_add(answer.late_ms))),
            None => {
                self.ack = self.got;
                self.error = error;
            }
        }
    }

    /// Gives an answer that was late, once its time has come.
    pub fn publish(&mut self, now_ms: u64) {
        if let Some((error, _)) = self.late.filter(|(_, due_ms)| *due_ms <= now_ms) {
            self.late = None;
            self.ack = self.got;
            self.error = error;
        }
    }

    /// The command whose action is under way, with its number among those of the wiring.
    pub fn acting(&self) -> Option<(usize, &Command)> {
        let task = self.task.filter(|task| task.waited_ms.is_none())?;
        Some((task.command, self.wiring.commands.get(task.command)?))
    }

    /// The part on which a command is under way.
    pub fn part_at_work(&self) -> Option<usize> {
        Some(self.wiring.commands.get(self.task?.command)?.part)
    }

    /// The action of the command under way has ended successfully.
    pub fn reach(&mut self, ends_ms: u64) {
        match (self.acting().and_then(|(_, command)| command.then), &mut self.task) {
            (Some(_), Some(task)) => task.waited_ms = Some(0),
            _ => self.end(error::NONE, ends_ms),
        }
    }

    /// That is under way, by its number among those of the wiring.
    pub fn command(&self) -> Option<usize> {
        Some(self.task?.command)
    }

    /// What is awaited, and for how long it has been.
    pub fn awaits(&self) -> Option<(Await, u64)> {
        let task = self.task?;
        Some((self.wiring.commands.get(task.command)?.then?, task.waited_ms?))
    }

    /// When it has waited long enough for what it awaits, ms from the start of the run.
    pub fn next_change(&self, now_ms: u64) -> f64 {
        let late = self.late.map_or(f64::INFINITY, |(_, due_ms)| due_ms as f64);
        match self.awaits().filter(|_| !self.held) {
            Some((awaited, waited_ms)) => {
                late.min((now_ms + awaited.within_ms.saturating_sub(waited_ms)) as f64)
            }
            None => late,
        }
    }

    pub fn wait(&mut self, dt_ms: u64) {
        if let Some(Task { waited_ms: Some(waited), .. }) = &mut self.task {
            *waited += dt_ms;
        }
    }

    /// A word of the head's inputs; none for a signal of a part.
    pub fn word(&self, source: Source) -> Option<f64> {
        match source {
            Source::Ready => Some(1.0),
            Source::Got => Some(f64::from(self.got)),
            Source::Ack => Some(f64::from(self.ack)),
            Source::Error => Some(f64::from(self.error)),
            Source::Signal { .. } => None,
        }
    }
}
