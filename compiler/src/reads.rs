//! What a state reads: the ports, cells and timers that decide whether a guard holds.

use crate::ir::{
    Action, Automaton, Binder, ByHand, Clause, Domain, Expr, ExprKind, InterfaceId, Operator, Place,
    Property, State, Transition, Update, UpdateKind,
};
use runtime_sim::device::{Direction, Extent, PortType};
use runtime_sim::line::ReadWhile;
use std::collections::BTreeSet;
use std::ops::Range;

/// What something depends on. What only says which of several comes first is not among what a guard reads: a key of
/// `nearest` changes what is chosen, and not whether something is.
pub struct Reads<'a> {
    automaton: &'a Automaton,
    /// Inputs of the device, by their numbers among its ports.
    pub inputs: BTreeSet<usize>,
    /// Inputs that are read only behind conditions that have to hold first, with these.
    behind: BTreeSet<(usize, Vec<Gate>)>,
    pub cells: BTreeSet<ReadCell>,
    /// Times of `after` and `within`.
    pub timers: Vec<&'a Expr>,
    /// Conditions that hold where is being read.
    gates: Vec<Gate>,
    /// Definitions that were read already, as each may be used many times.
    seen: BTreeSet<(usize, Vec<Gate>)>,
}

/// An input of the device with one bit, by its number among the ports, and what it has to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct Gate {
    pub port: usize,
    pub is: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct ReadCell {
    pub interface: InterfaceId,
    /// Its number among the cells of the interface.
    pub cell: usize,
    pub of: Whose,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Whose {
    Own,
    Others,
}

impl<'a> Reads<'a> {
    fn new(automaton: &'a Automaton) -> Self {
        Self {
            automaton,
            inputs: BTreeSet::new(),
            behind: BTreeSet::new(),
            cells: BTreeSet::new(),
            timers: Vec::new(),
            gates: Vec::new(),
            seen: BTreeSet::new(),
        }
    }

    /// What the guards of a state read.
    pub fn of_guards(automaton: &'a Automaton, state: &'a State) -> Self {
        let mut reads = Self::new(automaton);
        for transition in &state.transitions {
            reads.guard(&transition.clauses);
            reads.gates.clear();
        }
        reads
    }

    /// What has to change before an instance in this state does anything, if it did nothing in the scan before: what its
    /// guards read; what can become a fault, a stay that is too long and properties; and all that a transition reads
    /// which stays in the state, since it may fire in every scan and change nothing as long as this is the same.
    pub fn of_state(automaton: &'a Automaton, state: &'a State) -> Self {
        let mut reads = Self::of_guards(automaton, state);
        let stays = state.transitions.iter().filter(|transition| transition.target.is_none());
        stays.for_each(|transition| reads.transition(transition));
        reads.longest_stay(state);
        automaton.properties.iter().flat_map(Property::exprs).for_each(|expr| reads.expr(expr));
        reads
    }

    /// All that an instance reads, in whatever state and mode it is.
    pub fn of_type(automaton: &'a Automaton) -> Self {
        let mut reads = Self::of_modes(automaton);
        for state in &automaton.states {
            state.transitions.iter().for_each(|transition| reads.transition(transition));
            reads.longest_stay(state);
        }
        automaton.properties.iter().flat_map(Property::exprs).for_each(|expr| reads.expr(expr));
        if let Some(modes) = &automaton.modes {
            [&modes.is_single, &modes.may_go_on].into_iter().for_each(|expr| reads.expr(expr));
        }
        reads
    }

    /// What operating modes read, in whatever state an instance is, and whether the line runs or not.
    pub fn of_modes(automaton: &'a Automaton) -> Self {
        let mut reads = Self::new(automaton);
        let Some(modes) = &automaton.modes else { return reads };
        modes.actions.iter().for_each(|action| reads.action(action));
        for by_hand in modes.published.iter().flatten() {
            if let ByHand::Panel(value) = by_hand {
                reads.expr(value);
            }
        }
        reads
    }

    /// Reads a guard, what it chooses by, and what is done when it holds.
    fn transition(&mut self, transition: &'a Transition) {
        self.guard(&transition.clauses);
        for clause in &transition.clauses {
            if let Clause::Bind(Binder { key: Some(key), .. }) = clause {
                self.expr(key);
            }
        }
        transition.updates.iter().for_each(|update| self.update(update));
        self.gates.clear();
    }

    fn longest_stay(&mut self, state: &'a State) {
        if let Some((longest, _)) = &state.within {
            self.timers.push(longest);
            self.expr(longest);
        }
    }

    /// Reads a guard, and leaves behind what holds when it does.
    fn guard(&mut self, clauses: &'a [Clause]) {
        for clause in clauses {
            match clause {
                Clause::Condition(condition) => {
                    self.expr(condition);
                    self.assume(condition);
                }
                Clause::Bind(binder) => {
                    self.domain(&binder.domain);
                    binder.condition.iter().for_each(|condition| self.expr(condition));
                }
            }
        }
    }

    /// What is read next is read only if this holds.
    fn assume(&mut self, condition: &'a Expr) {
        match &condition.kind {
            ExprKind::Binary(Operator::And, left, right) => {
                self.assume(left);
                self.assume(right);
            }
            ExprKind::Define(define) => self.assume(&self.automaton.defines[*define].value),
            ExprKind::Not(negated) => self.gate(negated, false),
            _ => self.gate(condition, true),
        }
    }

    fn gate(&mut self, bit: &'a Expr, is: bool) {
        let ExprKind::Read(Place::Port { port, index: None, .. }) = &bit.kind else { return };
        let gate = Gate { port: *port, is };
        let declared = &self.automaton.device.ports[*port];
        let is_bit = declared.ty == PortType::Bool && declared.extent == Extent::One;
        if declared.direction == Direction::Input && is_bit && !self.gates.contains(&gate) {
            self.gates.push(gate);
        }
    }

    fn action(&mut self, action: &'a Action) {
        match action {
            Action::Update(update) => self.update(update),
            Action::If { condition, then, otherwise, .. } => {
                self.expr(condition);
                then.iter().chain(otherwise).for_each(|action| self.action(action));
            }
            Action::Stop | Action::BeginAnew => {}
        }
    }

    fn update(&mut self, update: &'a Update) {
        match &update.kind {
            UpdateKind::Assign { target, value, .. } | UpdateKind::Fill { target, value, .. } => {
                self.expr(value);
                target.place.parts().for_each(|part| self.expr(part));
            }
            UpdateKind::Copy { target, source, .. } => {
                self.place(source);
                target.place.parts().for_each(|part| self.expr(part));
            }
            UpdateKind::Command { arguments, .. } => {
                arguments.iter().for_each(|argument| self.expr(&argument.value));
            }
        }
    }

    fn domain(&mut self, domain: &'a Domain) {
        if let Domain::Range(low, high) = domain {
            self.expr(low);
            self.expr(high);
        }
    }

    fn expr(&mut self, expr: &'a Expr) {
        match &expr.kind {
            ExprKind::After(time) => {
                self.timers.push(time);
                self.expr(time);
            }
            ExprKind::Done | ExprKind::Failed => {
                self.input("ack");
                self.input("error");
            }
            ExprKind::Read(place) => self.place(place),
            ExprKind::Binary(Operator::And, left, right) => {
                self.expr(left);
                let known = self.gates.len();
                self.assume(left);
                self.expr(right);
                self.gates.truncate(known);
            }
            ExprKind::Define(define) => {
                if self.seen.insert((*define, self.gates.clone())) {
                    self.expr(&self.automaton.defines[*define].value);
                }
            }
            ExprKind::Exists { domain, body, .. }
            | ExprKind::Forall { domain, body, .. }
            | ExprKind::Count { domain, body, .. }
            | ExprKind::Sum { domain, body, .. } => {
                self.domain(domain);
                self.expr(body);
            }
            _ => expr.parts().for_each(|part| self.expr(part)),
        }
    }

    fn input(&mut self, name: &str) {
        self.inputs.extend(self.automaton.device.ports.iter().position(|port| port.name == name));
    }

    fn place(&mut self, place: &'a Place) {
        match place {
            Place::Port { port, .. } => {
                let declared = &self.automaton.device.ports[*port];
                let moves = matches!(declared.ty, PortType::Real | PortType::Point);
                if declared.direction == Direction::Input && moves && !self.gates.is_empty() {
                    self.behind.insert((*port, self.gates.clone()));
                } else if declared.direction == Direction::Input {
                    self.inputs.insert(*port);
                }
            }
            Place::Cell { interface, cell, of, .. } => {
                let of = if of.is_none() { Whose::Own } else { Whose::Others };
                self.cells.insert(ReadCell { interface: *interface, cell: *cell, of });
            }
            Place::Local { .. } | Place::Parameter { .. } | Place::Shown { .. } => {}
        }
        place.parts().for_each(|part| self.expr(part));
    }

    /// Numbers that change while something moves, and the conditions under which they are read; not those that are also
    /// read without.
    pub fn inputs_while(&self) -> impl Iterator<Item = (usize, &[Gate])> {
        let behind = self.behind.iter().filter(|(port, _)| !self.inputs.contains(port));
        behind.map(|(port, gates)| (*port, gates.as_slice()))
    }

    /// Names of all inputs that are read, behind conditions or not.
    pub fn names_of_inputs(&self) -> impl Iterator<Item = &'a str> {
        let all = self.inputs.iter().copied().chain(self.inputs_while().map(|(port, _)| port));
        all.map(|port| self.automaton.device.ports[port].name.as_str())
    }

    /// The inputs as words of the process image; `kinds` is the number of kinds of part.
    pub fn words(&self, kinds: usize) -> Vec<usize> {
        self.inputs.iter().flat_map(|port| self.words_of(*port, kinds)).collect()
    }

    /// The same of those that are read under conditions.
    pub fn words_while(&self, kinds: usize) -> Vec<ReadWhile> {
        let words = self.inputs_while().flat_map(|(port, gates)| {
            let gates = gates.iter().map(|gate| (self.words_of(gate.port, kinds).start, gate.is));
            let gates: Vec<(usize, bool)> = gates.collect();
            self.words_of(port, kinds).map(move |word| ReadWhile { word, gates: gates.clone() })
        });
        words.collect()
    }

    fn words_of(&self, input: usize, kinds: usize) -> Range<usize> {
        let ports = self.automaton.device.ports.iter();
        let before = ports.take(input).filter(|port| port.direction == Direction::Input);
        let begin = before.map(|port| port.words(kinds)).sum();
        begin..begin + self.automaton.device.ports[input].words(kinds)
    }
}

/// Whether the layout fixes what this is.
pub fn is_fixed(automaton: &Automaton, expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Constant(_) => true,
        ExprKind::Define(define) => is_fixed(automaton, &automaton.defines[*define].value),
        ExprKind::Read(Place::Parameter { index, .. }) => {
            index.iter().all(|index| is_fixed(automaton, index))
        }
        ExprKind::Negate(_)
        | ExprKind::Binary(..)
        | ExprKind::Min(..)
        | ExprKind::Max(..)
        | ExprKind::Absolute(_)
        | ExprKind::ToReal(_) => expr.parts().all(|part| is_fixed(automaton, part)),
        _ => false,
    }
}
