//! How far an executor has done what an execution says, machine by machine.

use crate::executor::{Entry, Executor};
use crate::ir::{Automaton, Element, KeptBy, System, Transition, UpdateKind};
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};
use std::collections::VecDeque;

/// A transition that has fired in an execution.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Mark {
    pub scan: usize,
    pub state: usize,
    pub transition: usize,
}

/// An executor, with what each machine has still to do.
pub struct Followed<'a> {
    system: &'a System,
    executor: Executor<'a>,
    left: Vec<VecDeque<Mark>>,
    astray: Option<usize>,
}

impl<'a> Followed<'a> {
    pub fn new(system: &'a System, marks: &[Vec<Mark>]) -> Self {
        let mut executor = Executor::new(system);
        executor.keep_journal();
        let left = marks.iter().map(|marks| marks.iter().copied().collect()).collect();
        Self { system, executor, left, astray: None }
    }

    /// The machine that was the first to do something else while it had still something to do.
    pub fn astray(&self) -> Option<usize> {
        self.astray
    }

    /// Machines that have still something to do.
    pub fn unfinished(&self) -> impl Iterator<Item = usize> {
        let machines = self.left.iter().enumerate();
        machines.filter(|(_, marks)| !marks.is_empty()).map(|(machine, _)| machine)
    }

    /// The scan of the execution that comes next.
    pub fn frontier(&self) -> Option<usize> {
        self.left.iter().filter_map(|marks| marks.front()).map(|mark| mark.scan).min()
    }

    fn follow(&mut self, mut states: Vec<usize>) {
        let journal = self.executor.take_journal();
        for (at, entry) in journal.iter().enumerate() {
            match *entry {
                Entry::Changed { .. } => {}
                Entry::BeganAnew { robot } => states[robot] = 0,
                Entry::Fired { robot, transition } => {
                    let fired = (states[robot], transition);
                    self.fire(robot, fired, &journal[at + 1..]);
                }
            }
        }
    }

    /// With what has happened since.
    fn fire(&mut self, machine: usize, fired: (usize, usize), since: &[Entry]) {
        let automaton = self.system.automaton_of(machine);
        let stays = stays(automaton, fired);
        let left = &mut self.left[machine];
        let is_it = |mark: &Mark| (mark.state, mark.transition) == fired;
        match left.front() {
            Some(mark) if is_it(mark) => {
                left.pop_front();
                // As often as it fires again, it changes nothing again.
                let is_last = !stays || changes(automaton, machine, since);
                while !is_last && left.front().is_some_and(is_it) {
                    left.pop_front();
                }
            }
            // How often a machine does what leaves it where it is depends on times.
            Some(_) if !stays => self.astray = self.astray.or(Some(machine)),
            Some(_) | None => {}
        }
    }
}

/// Whether a transition leaves a machine in its state, with its command.
fn stays(automaton: &Automaton, (state, transition): (usize, usize)) -> bool {
    let Transition { target, updates, .. } = &automaton.states[state].transitions[transition];
    let gives = |kind: &UpdateKind| matches!(kind, UpdateKind::Command { .. });
    target.is_none_or(|target| target.0 == state) && !updates.iter().any(|update| gives(&update.kind))
}

/// Whether a step of a machine has changed a value.
fn changes(automaton: &Automaton, machine: usize, since: &[Entry]) -> bool {
    let of_step = since.iter().take_while(|entry| !matches!(entry, Entry::Fired { .. }));
    of_step.into_iter().any(|entry| match *entry {
        Entry::Changed { robot, what: Element::Local { local, .. } } => {
            robot == machine && automaton.locals[local].kept_by == KeptBy::Steps
        }
        Entry::Changed { robot, .. } => robot == machine,
        Entry::Fired { .. } | Entry::BeganAnew { .. } => false,
    })
}

impl Controllers for Followed<'_> {
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        let states = (0..self.left.len()).map(|machine| self.executor.state(machine)).collect();
        let answer = self.executor.scan(system, inputs, outputs);
        self.follow(states);
        answer
    }

    fn state(&self, machine: usize) -> usize {
        self.executor.state(machine)
    }

    fn trace(&self, out: &mut Vec<f64>) {
        self.executor.trace(out);
    }

    fn stays(&self) -> Vec<usize> {
        self.executor.stays()
    }

    fn power_up(&mut self) {
        self.executor.power_up();
    }

    fn skip(&mut self, scans: u64) {
        self.executor.skip(scans);
    }
}
