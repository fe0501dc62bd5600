//! Whether something can happen in the scan after one in which something has happened, if nothing new comes.

use super::changes::Changes;
use crate::line::Line;
use crate::monitor::{ALARM_WORDS, Alarm};
use crate::wiring::Drives;

/// Nothing can, if each machine that has done something has given a new command, and is in a state that only the answer to
/// it leaves; no cell has changed, by which others could do something; and no alarm, which a check may raise for one scan.
#[derive(Clone)]
pub struct Settled<'a> {
    line: &'a Line,
    /// Where the words of each machine begin in the trace; empty if that is not known.
    begins: Vec<usize>,
    /// Where the number of the last command of each machine stands among the outputs of all.
    commands: Vec<Option<usize>>,
}

impl<'a> Settled<'a> {
    /// `stays` are the words of the times in states, by machine: the second ones of the machines.
    pub fn new(line: &'a Line, stays: &[usize]) -> Self {
        let kinds = line.kinds.len();
        let mut begin = 0;
        let commands = line.machines.iter().map(|machine| {
            let command = machine.wiring.output_at(Drives::Command, kinds).map(|word| begin + word);
            begin += machine.wiring.output_words(kinds);
            command
        });
        let commands = commands.collect();
        Self { line, begins: stays.iter().map(|stay| stay.saturating_sub(1)).collect(), commands }
    }

    /// Behind the scan that was taken last; the machines are in these states now.
    pub fn holds(&self, states: &[usize], changes: &Changes) -> bool {
        let awaits_answer = |word: usize| {
            let machine = self.begins.partition_point(|begin| *begin <= word).checked_sub(1)?;
            let described = self.line.machines.get(machine)?;
            let (state, command) = (described.states.get(*states.get(machine)?)?, self.commands[machine]?);
            let monitor = &described.monitor;
            let is_alarm = |alarm: &Alarm| (alarm.word..alarm.word + ALARM_WORDS).contains(&word);
            let is_own = !monitor.cells.contains(&word) && !monitor.alarms.iter().any(is_alarm);
            let may_go_on = monitor.stopped.is_some() || !state.awaits_answer;
            Some(is_own && !may_go_on && changes.has_changed_output(command))
        };
        !self.begins.is_empty() && changes.of_trace().all(|word| awaits_answer(word) == Some(true))
    }
}
