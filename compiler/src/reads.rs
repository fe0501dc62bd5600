//! What a state reads: the ports, cells and timers that decide whether a guard holds.

use crate::ir::{
    Action, Automaton, Binder, ByHand, Clause, Domain, Expr, ExprKind, InterfaceId, Place, Property, State,
    Update, UpdateKind,
};
use runtime_sim::device::Direction;
use std::collections::BTreeSet;

/// What something depends on. What only says which of several comes first is not among what a guard reads: a key of
/// `nearest` changes what is chosen, and not whether something is.
pub struct Reads<'a> {
    automaton: &'a Automaton,
    /// Inputs of the device, by their numbers among its ports.
    pub inputs: BTreeSet<usize>,
    pub cells: BTreeSet<ReadCell>,
    /// Times of `after` and `within`.
    pub timers: Vec<&'a Expr>,
    /// Definitions that were read already, as each may be used many times.
    seen: BTreeSet<usize>,
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
            cells: BTreeSet::new(),
            timers: Vec::new(),
            seen: BTreeSet::new(),
        }
    }

    /// What the guards of a state read.
    pub fn of_guards(automaton: &'a Automaton, state: &'a State) -> Self {
        let mut reads = Self::new(automaton);
        for clause in state.transitions.iter().flat_map(|transition| &transition.clauses) {
            match clause {
                Clause::Condition(condition) => reads.expr(condition),
                Clause::Bind(binder) => {
                    reads.domain(&binder.domain);
                    binder.condition.iter().for_each(|condition| reads.expr(condition));
                }
            }
        }
        reads
    }

    /// What has to change before an instance in this state does anything, if it did nothing in the scan before: what its
    /// guards read; what can become a fault, a stay that is too long and properties; and all that a transition reads
    /// which stays in the state, since it may fire in every scan and change nothing as long as this is the same.
    pub fn of_state(automaton: &'a Automaton, state: &'a State) -> Self {
        let mut reads = Self::of_guards(automaton, state);
        for transition in state.transitions.iter().filter(|transition| transition.target.is_none()) {
            for clause in &transition.clauses {
                if let Clause::Bind(Binder { key: Some(key), .. }) = clause {
                    reads.expr(key);
                }
            }
            transition.updates.iter().for_each(|update| reads.update(update));
        }
        if let Some((longest, _)) = &state.within {
            reads.timers.push(longest);
            reads.expr(longest);
        }
        automaton.properties.iter().flat_map(Property::exprs).for_each(|expr| reads.expr(expr));
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

    fn action(&mut self, action: &'a Action) {
        match action {
            Action::Update(update) => self.update(update),
            Action::If { condition, then, otherwise, .. } => {
                self.expr(condition);
                then.iter().chain(otherwise).for_each(|action| self.action(action));
            }
            Action::Stop | Action::StayAnew | Action::BeginAnew => {}
        }
    }

    fn update(&mut self, update: &'a Update) {
        match &update.kind {
            UpdateKind::Assign { target, value, .. } | UpdateKind::Fill { target, value, .. } => {
                self.expr(value);
                target.place.parts().into_iter().for_each(|part| self.expr(part));
            }
            UpdateKind::Copy { target, source, .. } => {
                self.place(source);
                target.place.parts().into_iter().for_each(|part| self.expr(part));
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
            ExprKind::Define(define) => {
                if self.seen.insert(*define) {
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
            _ => expr.parts().into_iter().for_each(|part| self.expr(part)),
        }
    }

    fn input(&mut self, name: &str) {
        self.inputs.extend(self.automaton.device.ports.iter().position(|port| port.name == name));
    }

    fn place(&mut self, place: &'a Place) {
        match place {
            Place::Port { port, .. } => {
                if self.automaton.device.ports[*port].direction == Direction::Input {
                    self.inputs.insert(*port);
                }
            }
            Place::Cell { interface, cell, of, .. } => {
                let of = if of.is_none() { Whose::Own } else { Whose::Others };
                self.cells.insert(ReadCell { interface: *interface, cell: *cell, of });
            }
            Place::Local { .. } | Place::Parameter { .. } | Place::Shown { .. } => {}
        }
        place.parts().into_iter().for_each(|part| self.expr(part));
    }

    /// The inputs as words of the process image; `kinds` is the number of kinds of part.
    pub fn words(&self, kinds: usize) -> Vec<usize> {
        let mut words = Vec::new();
        let mut begin = 0;
        for (number, port) in self.automaton.device.ports.iter().enumerate() {
            if port.direction == Direction::Input {
                let end = begin + port.ty.words() * port.extent.elements(kinds);
                if self.inputs.contains(&number) {
                    words.extend(begin..end);
                }
                begin = end;
            }
        }
        words
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
        | ExprKind::ToReal(_) => expr.parts().into_iter().all(|part| is_fixed(automaton, part)),
        _ => false,
    }
}
