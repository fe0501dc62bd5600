//! When clauses that failed at a time became true after it.

use super::guard::parts_of;
use super::text::Words;
use super::watch::Watch;
use crate::executor::Entry;
use crate::ir::{Automaton, Clause, Expr, ExprKind};
use runtime_sim::scan::Controllers;

/// What became of the state in which each of some machines was.
#[derive(Clone, Debug)]
pub struct Later {
    pub machines: Vec<Became>,
}

#[derive(Clone, Debug)]
pub struct Became {
    pub machine: usize,
    state: usize,
    /// For each transition of the state its title and its clauses, each with the time at which it first held.
    pub transitions: Vec<(String, Vec<Since>)>,
    pub left: Option<Left>,
}

/// How a machine left its state.
#[derive(Clone, Debug)]
pub struct Left {
    pub at_ms: u64,
    pub how: How,
}

#[derive(Clone, Debug)]
pub enum How {
    /// By one of [`Became::transitions`], for this state.
    Fired(usize, String),
    /// It began anew because a person had moved it.
    MovedByHand,
    /// It began anew because power was lost.
    PowerLost,
}

/// A clause, with the time at which it first held, ms.
pub type Since = (String, Option<u64>);

/// A clause, or a part of a condition joined by `and`.
enum Part<'a> {
    Condition(&'a Expr),
    Whole(&'a [Clause]),
}

impl Later {
    pub(super) fn new(machines: Vec<usize>) -> Self {
        let became = |machine| Became { machine, state: 0, transitions: Vec::new(), left: None };
        Self { machines: machines.into_iter().map(became).collect() }
    }

    pub fn is_done(&self) -> bool {
        self.machines.iter().all(|became| became.left.is_some())
    }

    pub(super) fn begin(&mut self, watch: &mut Watch) {
        for became in &mut self.machines {
            became.state = watch.state(became.machine);
            let automaton = watch.system.automaton_of(became.machine);
            let words = Words { model: &watch.system.model, automaton };
            let state = &words.automaton.states[became.state];
            became.transitions = (state.transitions.iter())
                .map(|transition| {
                    let parts = parts(automaton, &transition.clauses).into_iter();
                    let texts = parts.map(|part| match part {
                        Part::Condition(condition) => words.expr(condition),
                        Part::Whole(clauses) if clauses.len() == transition.clauses.len() => {
                            "all clauses".into()
                        }
                        Part::Whole(_) => "the choices, and clauses that depend on them".into(),
                    });
                    (transition.title(), texts.map(|text| (text, None)).collect())
                })
                .collect();
        }
        let now = watch.now();
        self.look(watch, now);
    }

    /// A scan was executed.
    pub(super) fn take(&mut self, watch: &mut Watch, scan: u64, journal: &[Entry]) {
        for became in self.machines.iter_mut().filter(|became| became.left.is_none()) {
            let automaton = watch.system.automaton_of(became.machine);
            let ms = watch.ms(scan);
            let fired = journal.iter().find_map(|entry| match entry {
                Entry::Fired { robot, transition } if *robot == became.machine => Some(Some(*transition)),
                Entry::BeganAnew { robot } if *robot == became.machine => Some(None),
                _ => None,
            });
            let fired = match fired {
                Some(Some(fired)) => fired,
                Some(None) => {
                    became.left = Some(Left { at_ms: ms, how: How::MovedByHand });
                    continue;
                }
                None => continue,
            };
            became.transitions[fired].1.iter_mut().for_each(|(_, since)| {
                since.get_or_insert(ms);
            });
            if let Some(target) = automaton.states[became.state].transitions[fired].target {
                let how = How::Fired(fired, automaton.states[target.0].name.clone());
                became.left = Some(Left { at_ms: ms, how });
            }
        }
        self.look(watch, watch.ms(scan));
    }

    /// Power was lost and is back.
    pub(super) fn lose_power(&mut self, at_ms: u64, journal: &[Entry]) {
        for became in self.machines.iter_mut().filter(|became| became.left.is_none()) {
            if journal.contains(&Entry::BeganAnew { robot: became.machine }) {
                became.left = Some(Left { at_ms, how: How::PowerLost });
            }
        }
    }

    fn look(&mut self, watch: &mut Watch, ms: u64) {
        for became in self.machines.iter_mut().filter(|became| became.left.is_none()) {
            let robot = became.machine;
            let automaton = watch.system.automaton_of(robot);
            let saved = watch.executor.variables(robot);
            for (transition, (_, clauses)) in
                automaton.states[became.state].transitions.iter().zip(&mut became.transitions)
            {
                for (part, (_, since)) in parts(automaton, &transition.clauses).into_iter().zip(clauses) {
                    let holds = match part {
                        _ if since.is_some() => continue,
                        Part::Condition(condition) => watch.executor.holds(robot, condition),
                        Part::Whole(clauses) => watch.executor.guard_holds(robot, clauses),
                    };
                    *since = holds.then_some(ms);
                }
            }
            watch.executor.restore(robot, saved);
        }
    }
}

/// The conditions before the first binder one by one, those of definitions too, and the rest as a whole.
fn parts<'a>(automaton: &'a Automaton, clauses: &'a [Clause]) -> Vec<Part<'a>> {
    let mut found = Vec::new();
    for (number, clause) in clauses.iter().enumerate() {
        match clause {
            Clause::Condition(condition) => conditions(automaton, condition, &mut found),
            Clause::Bind(_) => {
                found.push(Part::Whole(&clauses[number..]));
                break;
            }
        }
    }
    found
}

fn conditions<'a>(automaton: &'a Automaton, condition: &'a Expr, found: &mut Vec<Part<'a>>) {
    for part in parts_of(condition) {
        match part.kind {
            ExprKind::Define(define) => conditions(automaton, &automaton.defines[define].value, found),
            _ => found.push(Part::Condition(part)),
        }
    }
}
