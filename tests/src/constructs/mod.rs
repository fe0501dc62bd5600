//! Which constructs of the language an automaton has, and which of them it has executed.
//!
//! The matches over the representation are exhaustive: a new construct does not compile until it has a
//! name here, and is missed until automata that are made by lot contain it.

mod meaning;
mod text;

use autogen::executor::Executor;
use autogen::ir::{AutomatonId, FaultKind, Model, System};
use autogen::spec::ast;
use meaning::Names;
use std::collections::{BTreeMap, BTreeSet};

/// All names of constructs, one on each line.
const ALL: &str = include_str!("all.txt");

/// How often each transition has fired: `[automaton][state][transition]`.
pub type Fired = Vec<Vec<Vec<u64>>>;

/// In how many automata a construct was written, and in how many executed.
#[derive(Clone, Copy, Debug, Default)]
pub struct Count {
    pub written: usize,
    pub executed: usize,
}

#[derive(Default)]
pub struct Table {
    counts: BTreeMap<String, Count>,
}

impl Table {
    /// Counts the automata of a model; what is named in `unused` is left out.
    pub fn take(
        &mut self,
        model: &Model,
        tree: &ast::File,
        layouts: &[System],
        fired: &Fired,
        raised: &BTreeSet<i32>,
    ) {
        for (number, automaton) in model.automata.iter().enumerate() {
            let mut written = Names::new(model, automaton);
            let mut executed = Names::new(model, automaton);
            written.declarations();
            executed.declarations();
            let mut spans = Vec::new();
            let visited = visited(automaton, &fired[number]);
            for (state, counts) in automaton.states.iter().zip(&fired[number]) {
                written.state(state);
                let is_visited = visited.contains(&state.name);
                if is_visited {
                    executed.state(state);
                }
                for (transition, count) in state.transitions.iter().zip(counts) {
                    written.transition(state, transition);
                    if *count > 0 {
                        executed.transition(state, transition);
                        spans.push(transition.place);
                    }
                }
            }
            for property in &automaton.properties {
                written.property(property);
                executed.property(property);
            }
            for (system, instance) in instances(layouts, AutomatonId(number)) {
                for require in &automaton.requires {
                    written.require(require);
                    if Executor::new(system).holds(instance, &require.condition) {
                        executed.require(require);
                    }
                }
            }
            for (code, fault) in model.faults.iter().enumerate() {
                if fault.automaton.0 == number {
                    let name = fault_name(fault.kind);
                    written.add(name);
                    if raised.contains(&(code as i32 + 1)) {
                        executed.add(name);
                    }
                }
            }
            if let Some(tree) = tree.automata.iter().find(|a| a.name.value == automaton.name) {
                text::automaton(tree, &|_| true, &mut written);
                text::automaton(tree, &|span| spans.contains(&span), &mut executed);
            }
            for name in written.found {
                self.counts.entry(name).or_default().written += 1;
            }
            for name in executed.found {
                self.counts.entry(name).or_default().executed += 1;
            }
        }
    }

    /// Every construct with its counts, also those that were not found.
    pub fn counts(&self) -> BTreeMap<String, Count> {
        let mut counts = self.counts.clone();
        for name in ALL.lines() {
            counts.entry(name.into()).or_default();
        }
        counts
    }

    /// Constructs found that are not in the list of all.
    pub fn unknown(&self) -> Vec<&str> {
        self.counts.keys().map(String::as_str).filter(|n| !ALL.lines().any(|l| l == *n)).collect()
    }

    pub fn text(&self) -> String {
        let mut out = format!("{:52} {:>9} {:>9}\n", "construct", "written", "executed");
        for (name, count) in self.counts() {
            out += &format!("{name:52} {:9} {:9}\n", count.written, count.executed);
        }
        out
    }
}

fn fault_name(kind: FaultKind) -> &'static str {
    match kind {
        FaultKind::OutOfBounds => "fault: out of bounds",
        FaultKind::NotFinite => "fault: not finite",
        FaultKind::InvariantFails => "fault: invariant",
        FaultKind::NotKept => "fault: not kept",
        FaultKind::NotFollowed => "fault: not followed",
        FaultKind::TooLong => "fault: too long",
    }
}

/// Names of the states that were entered.
fn visited(automaton: &autogen::ir::Automaton, fired: &[Vec<u64>]) -> BTreeSet<String> {
    let transitions = automaton.states.iter().flat_map(|s| &s.transitions).zip(fired.iter().flatten());
    let targets = transitions.filter(|(_, count)| **count > 0).filter_map(|(t, _)| t.target);
    targets.map(|t| automaton.states[t.0].name.clone()).collect()
}

fn instances(layouts: &[System], id: AutomatonId) -> impl Iterator<Item = (&System, usize)> {
    layouts.iter().flat_map(move |system| {
        let all = system.instances.iter().enumerate();
        all.filter(move |(_, i)| i.automaton == id).map(move |(index, _)| (system, index))
    })
}
