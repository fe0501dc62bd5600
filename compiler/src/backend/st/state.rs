//! The branch of a state: its transitions, tested in order.

use super::code::{Arm, Ex, Member, Stmt, and, assign, binary, name, not, when};
use super::context::{Lowering, Phase};
use crate::ir::{ExprKind, State, Transition, Value};

impl Lowering<'_> {
    pub fn branches(&mut self) -> Vec<(Member, Vec<Stmt>)> {
        let automaton = self.automaton();
        (automaton.states.iter().enumerate())
            .map(|(number, state)| (self.state(self.id, number), self.branch(number, state)))
            .collect()
    }

    fn branch(&mut self, number: usize, state: &State) -> Vec<Stmt> {
        self.known.clear();
        let mut body = self.chain(number, &state.transitions);
        body.extend(self.within(state));
        if body.is_empty() {
            let text = if state.is_final { "final state" } else { "no transition leaves it" };
            body.push(Stmt::Comment(text.into()));
            body.push(assign("state", Ex::Member(self.state(self.id, number))));
        }
        self.enclosed(body)
    }

    /// STruC++ declares a variable for each assignment to an element of a global array, and C++ takes no such
    /// declaration directly in a branch. `running` is true wherever a block steps.
    fn enclosed(&self, body: Vec<Stmt>) -> Vec<Stmt> {
        let cells = || self.shared.names.interfaces.iter().flat_map(|i| &i.cells).flatten();
        let is_cell =
            |s: &Stmt| matches!(s, Stmt::Assign(Ex::Element(array, _), _) if cells().any(|c| c == array));
        if body.iter().any(is_cell) { vec![when(name("running"), body)] } else { body }
    }

    /// The first transition whose guard holds; the others stand in its ELSE.
    fn chain(&mut self, number: usize, transitions: &[Transition]) -> Vec<Stmt> {
        let Some((transition, others)) = transitions.split_first() else { return Vec::new() };
        let title = self.title(transition);
        let known_before = self.known.clone();
        let (mut out, condition) = self.guard(transition);
        let known = self.known.clone();
        let mut body = self.firing(transition);
        self.known = known;
        if body.is_empty() {
            body.push(assign("state", Ex::Member(self.state(self.id, number))));
        }
        match condition {
            Ex::Bool(true) => {
                out.insert(0, Stmt::Comment(title));
                out.extend(body);
                return out;
            }
            // It never fires: what stands behind it decides.
            Ex::Bool(false) => {
                self.known = known_before;
                return self.chain(number, others);
            }
            _ => {}
        }
        let mut comments = Vec::new();
        if out.is_empty() {
            comments.push(title);
        } else {
            out.insert(0, Stmt::Comment(title));
        }
        let mut arms = vec![Arm { comments, condition, body }];
        let mut otherwise = self.chain(number, others);
        if let [Stmt::If(more, rest)] = otherwise.as_mut_slice() {
            arms.append(more);
            otherwise = std::mem::take(rest);
        }
        out.push(Stmt::If(arms, otherwise));
        out
    }

    fn firing(&mut self, transition: &Transition) -> Vec<Stmt> {
        let mut body = self.updates(&transition.updates);
        if let Some(target) = transition.target {
            body.push(assign("state", Ex::Member(self.state(self.id, target.0))));
            body.push(assign("elapsed", Ex::Int(0)));
        }
        body
    }

    /// `when done -> Dropping   agv.aut:24`
    fn title(&self, transition: &Transition) -> String {
        let states = &self.automaton().states;
        let target = transition.target.map(|t| format!(" -> {}", states[t.0].name)).unwrap_or_default();
        format!("{}{target}   {}", transition.title(), self.line(transition.place))
    }

    /// The longest stay. A state that was entered in this step has `elapsed` 0.
    fn within(&mut self, state: &State) -> Vec<Stmt> {
        let Some((longest, fault)) = &state.within else { return Vec::new() };
        self.phase = Phase::Update;
        self.release();
        self.known.clear();
        let mut out = Vec::new();
        let time = self.value(longest, &mut out);
        let is_positive = matches!(longest.kind, ExprKind::Constant(Value::Int(ms)) if ms > 0);
        let is_over = binary(">=", name("elapsed"), time);
        let condition = match is_positive {
            true => is_over,
            false => and(vec![binary(">", name("elapsed"), Ex::Int(0)), is_over]),
        };
        let condition = match &self.automaton().modes {
            Some(modes) => {
                let is_single = self.value(&modes.is_single, &mut out);
                and(vec![condition, not(is_single)])
            }
            None => condition,
        };
        out.push(when(condition, self.raise(*fault)));
        let mut first = std::mem::take(&mut self.hoisted);
        first.extend(out);
        first
    }
}
