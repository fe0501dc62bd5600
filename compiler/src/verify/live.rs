//! What of an instance is of no use in a state: whatever it holds, it is written before it is read.

use super::properties::{read_by, searched};
use super::{Asked, Remembered};
use crate::ir::{Automaton, Clause, Domain, Expr, ExprKind, Place, Transition, Update, UpdateKind};
use std::collections::BTreeSet;

/// What an automaton remembers, and what its device does for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Remembers {
    Local(usize),
    /// Whether the last command has ended, and how.
    Answer,
    /// What the port `error` shows: with a new command it stays until that has ended.
    Error,
    /// What is seen over a conveyor, which stays as it is until the conveyor moves.
    Seen,
    /// Where an item was found there.
    Found,
}

type Set = BTreeSet<Remembers>;

/// The ports of an automaton that tell what lies on its conveyor, and the commands that move this.
#[derive(Debug)]
pub struct Sight {
    /// Numbers of ports.
    pub seen: Vec<usize>,
    pub found: Vec<usize>,
    /// Numbers of commands, as on the bus.
    pub moves: Vec<i32>,
}

/// For each state what may be read before it is written.
pub fn live(automaton: &Automaton, sight: &Sight, asked: &Asked) -> Vec<Set> {
    let uses = Uses { automaton, sight };
    let mut always = Set::new();
    searched(automaton, asked).flat_map(read_by).for_each(|read| uses.expr(read, &mut always));
    if asked.remembered == Remembered::Whole {
        always.extend((0..automaton.locals.len()).map(Remembers::Local).chain([
            Remembers::Answer,
            Remembers::Error,
            Remembers::Seen,
        ]));
    }
    let mut live = vec![always; automaton.states.len()];
    loop {
        let mut has_changed = false;
        for (number, state) in automaton.states.iter().enumerate() {
            let mut found = live[number].clone();
            for transition in &state.transitions {
                let mut before = live[transition.target.map_or(number, |target| target.0)].clone();
                uses.transition(transition, &mut before);
                found.extend(before);
            }
            has_changed |= found.len() > live[number].len();
            live[number] = found;
        }
        if !has_changed {
            return live;
        }
    }
}

/// Of each state whether it may be entered after an item was found on the conveyor, and before this has moved.
pub fn told(automaton: &Automaton, sight: &Sight) -> Vec<bool> {
    let uses = Uses { automaton, sight };
    let mut told = vec![false; automaton.states.len()];
    loop {
        let mut has_changed = false;
        for (number, state) in automaton.states.iter().enumerate() {
            for transition in &state.transitions {
                let target = transition.target.map_or(number, |target| target.0);
                let is_told = uses.finds(transition) || told[number] && !uses.moves(transition);
                has_changed |= is_told && !told[target];
                told[target] |= is_told;
            }
        }
        if !has_changed {
            return told;
        }
    }
}

/// What expressions and updates read and write.
struct Uses<'a> {
    automaton: &'a Automaton,
    sight: &'a Sight,
}

impl Uses<'_> {
    fn finds(&self, transition: &Transition) -> bool {
        let mut read = Set::new();
        self.transition(transition, &mut read);
        read.contains(&Remembers::Found)
    }

    fn moves(&self, transition: &Transition) -> bool {
        transition.updates.iter().any(|update| match &update.kind {
            UpdateKind::Command { verb, .. } => self.sight.moves.contains(verb),
            _ => false,
        })
    }

    /// What is live before a transition, from what is live after it.
    fn transition(&self, transition: &Transition, live: &mut Set) {
        transition.updates.iter().rev().for_each(|update| self.update(update, live));
        transition.clauses.iter().for_each(|clause| self.clause(clause, live));
    }

    /// What is live before an update, from what is live after it.
    fn update(&self, update: &Update, live: &mut Set) {
        match &update.kind {
            UpdateKind::Assign { target, value, .. } => {
                if let Place::Local { local, index: None } = &target.place {
                    live.remove(&Remembers::Local(*local));
                }
                target.place.parts().for_each(|part| self.expr(part, live));
                self.expr(value, live);
            }
            UpdateKind::Fill { target, value, .. } => {
                if let Place::Local { local, .. } = &target.place {
                    live.remove(&Remembers::Local(*local));
                }
                target.place.parts().for_each(|part| self.expr(part, live));
                self.expr(value, live);
            }
            UpdateKind::Copy { target, source, .. } => {
                if let Place::Local { local, .. } = &target.place {
                    live.remove(&Remembers::Local(*local));
                }
                target.place.parts().for_each(|part| self.expr(part, live));
                self.place(source, live);
            }
            UpdateKind::Command { verb, arguments } => {
                live.remove(&Remembers::Answer);
                if self.sight.moves.contains(verb) {
                    live.remove(&Remembers::Seen);
                }
                arguments.iter().for_each(|argument| self.expr(&argument.value, live));
            }
        }
    }

    fn clause(&self, clause: &Clause, live: &mut Set) {
        match clause {
            Clause::Condition(condition) => self.expr(condition, live),
            Clause::Bind(binder) => {
                if let Domain::Range(low, high) = &binder.domain {
                    self.expr(low, live);
                    self.expr(high, live);
                }
                binder.condition.iter().chain(&binder.key).for_each(|part| self.expr(part, live));
            }
        }
    }

    fn expr(&self, of: &Expr, live: &mut Set) {
        match &of.kind {
            ExprKind::Done | ExprKind::Failed => {
                live.insert(Remembers::Answer);
            }
            ExprKind::Define(define) => self.expr(&self.automaton.defines[*define].value, live),
            ExprKind::Read(read) => self.place(read, live),
            _ => of.parts().for_each(|part| self.expr(part, live)),
        }
    }

    fn place(&self, read: &Place, live: &mut Set) {
        match read {
            Place::Local { local, .. } => {
                live.insert(Remembers::Local(*local));
            }
            Place::Port { port, .. } if self.automaton.device.ports[*port].name == "error" => {
                live.insert(Remembers::Error);
            }
            Place::Port { port, .. } if self.sight.seen.contains(port) => {
                live.insert(Remembers::Seen);
            }
            Place::Port { port, .. } if self.sight.found.contains(port) => {
                live.insert(Remembers::Found);
            }
            Place::Port { .. } | Place::Cell { .. } | Place::Parameter { .. } | Place::Shown { .. } => {}
        }
        read.parts().for_each(|part| self.expr(part, live));
    }
}
