//! Guards taken apart: which clauses fail, and what they read.

use super::text::Words;
use super::watch::{Stopped, Watch};
use super::writers::Writers;
use super::{Await, Fault, Machine, Node, Picture, Read, Tested, Verdict};
use crate::device::panel;
use crate::ir::{Binder, Clause, Domain, Expr, ExprKind, Operator, Severity, Value, VariableId};
use runtime_sim::scan::Controllers;

/// Candidates of a binder or a quantifier that are checked one by one.
const MOST_CANDIDATES: usize = 6;
/// Parts of the guards of one machine.
const MOST_NODES: usize = 500;

/// All machines as they are now, after this scan.
pub fn picture(watch: &mut Watch, scan: u64) -> Picture {
    let writers = Writers::new(watch.system);
    let machines = (0..watch.system.instances.len()).map(|robot| {
        let mut look = Look {
            watch,
            writers: &writers,
            robot,
            scan,
            clauses: &[],
            awaits: Vec::new(),
            nodes: 0,
            seen_by: None,
        };
        look.machine()
    });
    let machines = machines.collect();
    let fault = watch.fault.map(|Stopped { site, robot, scan }| Fault {
        machine: robot,
        at_ms: watch.ms(scan),
        text: watch.system.model.faults[site.0].text.clone(),
    });
    Picture {
        at_ms: watch.ms(scan),
        is_running: watch.executor.is_running(),
        fault,
        empty: Vec::new(),
        machines,
    }
}

/// One machine, and what it was found to wait for.
pub(super) struct Look<'w, 'a> {
    pub(super) watch: &'w mut Watch<'a>,
    pub(super) writers: &'w Writers,
    pub(super) robot: usize,
    pub(super) scan: u64,
    /// The guard that is taken apart.
    pub(super) clauses: &'a [Clause],
    pub(super) awaits: Vec<Await>,
    nodes: usize,
    /// Outputs are as the properties of this severity have seen them.
    pub(super) seen_by: Option<Severity>,
}

/// The sides of `a and b and c`, or of the same with `or`.
fn joined<'e>(expr: &'e Expr, by: Operator, found: &mut Vec<&'e Expr>) {
    match &expr.kind {
        ExprKind::Binary(operator, a, b) if *operator == by => {
            joined(a, by, found);
            joined(b, by, found);
        }
        _ => found.push(expr),
    }
}

/// The conditions of which one is made by `and`.
pub(super) fn parts_of(expr: &Expr) -> Vec<&Expr> {
    let mut found = Vec::new();
    joined(expr, Operator::And, &mut found);
    found
}

impl<'a> Look<'_, 'a> {
    pub(super) fn words(&self) -> Words<'a> {
        let system = self.watch.system;
        Words { model: &system.model, automaton: system.automaton_of(self.robot) }
    }

    fn machine(&mut self) -> Machine {
        let (system, robot) = (self.watch.system, self.robot);
        let automaton = system.automaton_of(robot);
        let state = &automaton.states[self.watch.state(robot)];
        let transitions = state.transitions.iter().map(|transition| {
            let saved = self.watch.executor.variables(robot);
            let holds = self.watch.executor.guard_holds(robot, &transition.clauses);
            self.watch.executor.restore(robot, saved);
            self.clauses = &transition.clauses;
            Tested {
                title: transition.title(),
                target: transition.target.map(|target| automaton.states[target.0].name.clone()),
                place: transition.place,
                holds,
                clauses: self.guard(&transition.clauses),
            }
        });
        let transitions: Vec<Tested> = transitions.collect();
        let awaits = std::mem::take(&mut self.awaits);
        let is_stopped = self.watch.executor.is_stopped(robot);
        Machine {
            name: system.instances[robot].name.clone(),
            state: state.name.clone(),
            stay_ms: self.watch.executor.elapsed(robot) as u64,
            is_final: state.is_final,
            is_stopped,
            at_panel: self.at_panel(),
            properties: self.promises(),
            // It makes no steps, so nothing that its guards read brings it on.
            transitions: if is_stopped { Vec::new() } else { transitions },
            awaits: if is_stopped { Vec::new() } else { awaits },
        }
    }

    fn at_panel(&self) -> Vec<&'static str> {
        let (executor, robot) = (&self.watch.executor, self.robot);
        if self.watch.system.automaton_of(robot).modes.is_none() {
            return Vec::new();
        }
        let is_enabled = executor.is_true(robot, panel::ENABLE);
        let mode = executor.port_of(robot, panel::MODE);
        let steps = [
            (!is_enabled, "set `panel_enable`"),
            (mode == panel::MANUAL, "leave manual, `panel_mode` 2"),
            (
                mode == panel::SINGLE_STEP,
                "press `panel_step` for each transition, or leave single step, `panel_mode` 1",
            ),
        ];
        steps.into_iter().filter(|(is_due, _)| *is_due).map(|(_, step)| step).collect()
    }

    fn guard(&mut self, clauses: &'a [Clause]) -> Vec<Node> {
        match clauses.split_first() {
            None => Vec::new(),
            Some((Clause::Condition(condition), rest)) => {
                let mut nodes: Vec<Node> =
                    parts_of(condition).into_iter().map(|part| self.condition(part, true)).collect();
                nodes.extend(self.guard(rest));
                nodes
            }
            Some((Clause::Bind(binder), rest)) => self.binder(binder, rest),
        }
    }

    fn binder(&mut self, binder: &'a Binder, rest: &'a [Clause]) -> Vec<Node> {
        let robot = self.robot;
        let text = self.binder_text(binder);
        let candidates = self.watch.executor.candidates(robot, &binder.domain);
        let mut suitable = Vec::new();
        for candidate in &candidates {
            self.watch.executor.bind(robot, binder.variable, *candidate);
            if binder.condition.as_ref().is_none_or(|c| self.watch.executor.holds(robot, c)) {
                suitable.push(*candidate);
            }
        }
        if suitable.is_empty() {
            let shown = candidates.iter().take(MOST_CANDIDATES).map(|candidate| {
                self.watch.executor.bind(robot, binder.variable, *candidate);
                let parts = binder.condition.iter().flat_map(parts_of);
                let parts = parts.map(|part| self.condition(part, true)).collect();
                self.node(self.bound(binder, *candidate), Verdict::Fails, Vec::new(), parts)
            });
            let mut parts: Vec<Node> = shown.collect();
            if candidates.is_empty() {
                parts.push(self.node(
                    "there is nothing to choose from".into(),
                    Verdict::Fails,
                    vec![],
                    vec![],
                ));
            } else if candidates.len() > MOST_CANDIDATES {
                let more = format!("{} more candidates", candidates.len() - MOST_CANDIDATES);
                parts.push(self.node(more, Verdict::Fails, Vec::new(), Vec::new()));
            }
            let mut nodes = vec![self.node(text, Verdict::Fails, Vec::new(), parts)];
            nodes.extend(rest.iter().map(|clause| self.untested(clause)));
            return nodes;
        }
        let fitting = suitable.iter().position(|candidate| {
            self.watch.executor.bind(robot, binder.variable, *candidate);
            self.watch.executor.guard_holds(robot, rest)
        });
        let first = suitable[fitting.unwrap_or(0)];
        let chosen = self.bound(binder, first);
        let mut nodes = vec![self.node(format!("{text}: {chosen}"), Verdict::Holds, Vec::new(), Vec::new())];
        self.watch.executor.bind(robot, binder.variable, first);
        nodes.extend(self.guard(rest));
        if fitting.is_none() {
            for candidate in suitable.iter().skip(1).take(MOST_CANDIDATES) {
                self.watch.executor.bind(robot, binder.variable, *candidate);
                let parts = self.guard(rest);
                nodes.push(self.node(self.bound(binder, *candidate), Verdict::Fails, Vec::new(), parts));
            }
        }
        nodes
    }

    fn binder_text(&self, binder: &Binder) -> String {
        let words = self.words();
        let name = &words.automaton.variables[binder.variable.0].name;
        let how = if binder.key.is_some() { "least" } else { "first" };
        let key = binder.key.as_ref().map_or(String::new(), |key| format!(" by {}", words.expr(key)));
        let with = binder.condition.as_ref().map_or(String::new(), |c| format!(" with {}", words.expr(c)));
        format!("{how} {name} in {}{key}{with}", words.domain(&binder.domain))
    }

    /// `s = conveyor_belt`
    fn bound(&self, binder: &Binder, value: Value) -> String {
        let variable = &self.words().automaton.variables[binder.variable.0];
        format!("{} = {}", variable.name, self.watch.system.shown_value(variable.ty.scalar, value))
    }

    fn untested(&mut self, clause: &Clause) -> Node {
        let text = match clause {
            Clause::Condition(condition) => self.words().expr(condition),
            Clause::Bind(binder) => self.binder_text(binder),
        };
        self.node(text, Verdict::NotTested, Vec::new(), Vec::new())
    }

    fn node(&mut self, text: String, verdict: Verdict, reads: Vec<Read>, parts: Vec<Node>) -> Node {
        self.nodes += 1;
        Node { text, verdict, reads, parts }
    }

    /// A condition that should be `wanted`.
    pub(super) fn condition(&mut self, expr: &'a Expr, wanted: bool) -> Node {
        let text = match wanted {
            true => self.words().expr(expr),
            false => self.words().negated(expr),
        };
        let holds = self.watch.executor.holds(self.robot, expr) == wanted;
        let verdict = if holds { Verdict::Holds } else { Verdict::Fails };
        let parts = match holds || self.nodes > MOST_NODES {
            true => Vec::new(),
            false => self.reasons(expr, wanted),
        };
        let reads = match parts.is_empty() && !matches!(expr.kind, ExprKind::Constant(_)) {
            true => self.reads(expr, holds),
            false => Vec::new(),
        };
        self.node(text, verdict, reads, parts)
    }

    /// The parts of a condition that keep it from being `wanted`.
    fn reasons(&mut self, expr: &'a Expr, wanted: bool) -> Vec<Node> {
        match &expr.kind {
            ExprKind::Not(inner) => self.reasons(inner, !wanted),
            ExprKind::Binary(operator @ (Operator::And | Operator::Or), ..) => {
                let mut sides = Vec::new();
                joined(expr, *operator, &mut sides);
                sides.retain(|side| self.watch.executor.holds(self.robot, side) != wanted);
                sides.into_iter().map(|side| self.condition(side, wanted)).collect()
            }
            ExprKind::Define(define) => {
                let value = &self.words().automaton.defines[*define].value;
                match (&value.kind, wanted) {
                    (ExprKind::Binary(Operator::And, ..), true) => {
                        parts_of(value).into_iter().map(|part| self.condition(part, true)).collect()
                    }
                    _ => vec![self.condition(value, wanted)],
                }
            }
            ExprKind::Exists { variable, domain, body } | ExprKind::Forall { variable, domain, body } => {
                self.candidates(variable.0, domain, body, wanted)
            }
            _ => Vec::new(),
        }
    }

    /// The candidates of a quantifier for which its body is not as it should be.
    fn candidates(&mut self, variable: usize, domain: &'a Domain, body: &'a Expr, wanted: bool) -> Vec<Node> {
        let robot = self.robot;
        let declared = &self.words().automaton.variables[variable];
        let mut nodes = Vec::new();
        for candidate in self.watch.executor.candidates(robot, domain) {
            self.watch.executor.bind(robot, VariableId(variable), candidate);
            if self.watch.executor.holds(robot, body) == wanted {
                continue;
            }
            if nodes.len() == MOST_CANDIDATES {
                nodes.push(self.node("and more".into(), Verdict::Fails, Vec::new(), Vec::new()));
                break;
            }
            let value = self.watch.system.shown_value(declared.ty.scalar, candidate);
            let mut node = self.condition(body, wanted);
            node.text = format!("{} = {value}: {}", declared.name, node.text);
            nodes.push(node);
        }
        nodes
    }
}
