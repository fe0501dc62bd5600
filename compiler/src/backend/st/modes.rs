//! Operating modes: what a person does with one robot at its panel.

use super::block::{Candidate, Origin, argument, kept_values};
use super::code::{Arm, Ex, Stmt, advance, and, assign, binary, name, not, or, when, within};
use super::context::{Lowering, Phase, Shared};
use super::globals::{Globals, Table};
use super::name::Name;
use super::names::ELEMENT;
use super::property::own_stop;
use crate::ir::{Action, Automaton, ByHand, Expr, ExprKind, Extent, KeptBy, Modes, Place};

/// The robot begins anew in this scan: properties are told so.
pub const BEGUN_ANEW: &str = "begun_anew";

/// Properties remember something, and begin anew with the steps.
pub fn tells_anew(automaton: &Automaton) -> bool {
    automaton.modes.is_some() && automaton.locals.iter().any(|local| local.kept_by == KeptBy::Properties)
}

impl Lowering<'_> {
    /// What comes before the step of every scan. `kept` is all that the block keeps.
    pub fn operate(&mut self, kept: &[&Candidate], globals: &Globals) -> Vec<Stmt> {
        let Some(modes) = &self.automaton().modes else { return Vec::new() };
        let anew = self.begin_anew(kept, globals);
        let mut out = Vec::new();
        if tells_anew(self.automaton()) {
            out.push(assign(BEGUN_ANEW, Ex::Bool(false)));
        }
        out.extend(self.actions(&modes.actions, &anew));
        out
    }

    fn actions(&mut self, actions: &[Action], anew: &[Stmt]) -> Vec<Stmt> {
        let mut out = Vec::new();
        for action in actions {
            self.phase = Phase::Update;
            self.known.clear();
            match action {
                Action::Update(update) => {
                    let statements = self.updates(std::slice::from_ref(update));
                    out.extend(statements.into_iter().filter(|s| !matches!(s, Stmt::Comment(_))));
                }
                Action::Stop => out.push(Stmt::Assign(own_stop(), Ex::Bool(true))),
                Action::BeginAnew => out.extend(anew.iter().cloned()),
                Action::If { about, condition, then, otherwise } => {
                    self.release();
                    let mut before = Vec::new();
                    let condition = self.value(condition, &mut before);
                    out.append(&mut self.hoisted);
                    if !about.is_empty() {
                        out.push(Stmt::Comment(about.to_string()));
                    }
                    out.extend(before);
                    let then = self.actions(then, anew);
                    let otherwise = self.actions(otherwise, anew);
                    out.push(Stmt::If(vec![Arm { comments: Vec::new(), condition, body: then }], otherwise));
                }
            }
        }
        out
    }

    fn begin_anew(&self, kept: &[&Candidate], globals: &Globals) -> Vec<Stmt> {
        let automaton = self.automaton();
        let own_ports = || self.own().ports.iter();
        let anew = self.outputs_that_stop();
        let begins = |candidate: &&&Candidate| {
            let name = &candidate.variable.name;
            let is_port = own_ports().flatten().any(|port| port == name);
            candidate.kept_by == KeptBy::Steps
                && if is_port { anew.contains(&name) } else { !candidate.variable.is_retained }
        };
        let begins: Vec<&Candidate> = kept.iter().filter(begins).copied().collect();
        let mut out =
            vec![assign("state", Ex::Member(self.state(self.id, 0))), assign("elapsed", Ex::Int(0))];
        if tells_anew(automaton) {
            out.push(assign(BEGUN_ANEW, Ex::Bool(true)));
        }
        out.extend(kept_values(&begins));
        out.extend(self.own_cells(globals, |table| !self.retains_own(&table.variable.name)));
        out
    }

    /// The variables of outputs that are as at power-up when the robot begins anew.
    pub fn outputs_that_stop(&self) -> Vec<&Name> {
        self.automaton().outputs_that_stop().flat_map(|port| &self.own().ports[port]).collect()
    }

    /// The initial values of its own elements of those arrays of cells.
    pub fn own_cells(&self, globals: &Globals, is_wanted: impl Fn(&Table) -> bool) -> Vec<Stmt> {
        let automaton = self.automaton();
        let mut out = Vec::new();
        for (number, implemented) in automaton.implements.iter().enumerate() {
            let interface = self.system.model.interface(implemented.interface);
            let row = || name(&self.own().rows[number]);
            for (cell, held) in
                interface.cells.iter().zip(&self.names.interfaces[implemented.interface.0].cells)
            {
                let elements = self.system.model.elements(cell.ty.extent);
                let values = self.shared.constants(cell.ty.scalar, cell.initial);
                let there = held.iter().zip(values);
                let there = there.filter(|(held, _)| {
                    globals.cells.iter().any(|table| table.variable.name == **held && is_wanted(table))
                });
                if cell.ty.extent == Extent::One {
                    out.extend(there.map(|(held, value)| {
                        Stmt::Assign(Ex::Element(held.clone(), Box::new(row())), value)
                    }));
                    continue;
                }
                let at = || within(row(), elements, name(ELEMENT));
                let stores =
                    there.map(|(held, value)| Stmt::Assign(Ex::Element(held.clone(), Box::new(at())), value));
                let mut body: Vec<Stmt> = stores.collect();
                if !body.is_empty() {
                    body.push(advance(ELEMENT));
                    let condition = binary("<", name(ELEMENT), Ex::Int(elements as i32));
                    out.push(assign(ELEMENT, Ex::Int(0)));
                    out.push(Stmt::While { condition, body, most: elements as u64 });
                }
            }
        }
        out
    }
}

/// Whether any robot has a panel.
pub fn any(shared: Shared) -> bool {
    shared.system.model.automata.iter().any(|automaton| automaton.modes.is_some())
}

/// A value that the block of a robot keeps for its modes.
pub fn field(shared: Shared, robot: usize, local: usize) -> Ex {
    let own = &shared.names.automata[shared.system.instances[robot].automaton.0];
    Ex::Field(shared.names.robots[robot].instance.clone(), own.locals[local][0].clone())
}

/// `hold` of a robot: also while the answer to its last command does not count.
pub fn hold(shared: Shared, robot: usize, runs: Ex) -> Ex {
    let of = |local: usize| field(shared, robot, local);
    let automaton = shared.system.automaton_of(robot);
    let Some(abandoned) = automaton.abandoned else { return not(runs) };
    let held = or(vec![not(runs), of(abandoned)]);
    match automaton.modes.as_ref().and_then(|modes| modes.commanded) {
        Some(commanded) => and(vec![not(of(commanded)), held]),
        None => held,
    }
}

/// What the panel gives for an output, one for each variable.
pub fn by_hand(shared: Shared, robot: usize, by_hand: &ByHand) -> Option<Vec<Ex>> {
    let ByHand::Panel(value) = by_hand else { return None };
    let of = |expr: &Expr| match expr.kind {
        ExprKind::Read(Place::Port { port, .. }) => {
            Some(argument(shared, robot, &Name::default(), &Origin::Input { port, part: 0 }))
        }
        _ => None,
    };
    match &value.kind {
        ExprKind::MakePoint(parts) => parts.iter().map(of).collect(),
        _ => Some(vec![of(value)?]),
    }
}

/// What is put out at outputs with stop values, by what decides it.
#[derive(Default)]
pub struct PutOut {
    running: Vec<Stmt>,
    by_hand: Vec<Stmt>,
    with_command: Vec<Stmt>,
    stopped: Vec<Stmt>,
}

impl PutOut {
    /// `to` gets what the steps have set, the stop value, or what the panel gives, if that is for this output.
    pub fn add(&mut self, to: &str, [set, stop]: [Ex; 2], published: Option<&ByHand>, panel: Option<Ex>) {
        if let Some(ByHand::Argument) = published {
            self.with_command.push(assign(to, set.clone()));
        }
        self.by_hand.push(assign(to, panel.unwrap_or_else(|| stop.clone())));
        self.running.push(assign(to, set));
        self.stopped.push(assign(to, stop));
    }

    /// `local` is the value of a local of the type.
    pub fn statements(self, runs: Ex, modes: Option<&Modes>, local: impl Fn(usize) -> Ex) -> Vec<Stmt> {
        if self.running.is_empty() {
            return Vec::new();
        }
        let arm = |condition: Ex, body: Vec<Stmt>| Arm { comments: Vec::new(), condition, body };
        let mut arms = vec![arm(runs, self.running)];
        let by_hand = modes.and_then(|modes| modes.by_hand);
        arms.extend(by_hand.map(|by_hand| arm(local(by_hand), self.by_hand)));
        let mut statements = vec![Stmt::If(arms, self.stopped)];
        if let Some(commanded) = modes.and_then(|modes| modes.commanded)
            && !self.with_command.is_empty()
        {
            statements.push(when(local(commanded), self.with_command));
        }
        statements
    }
}

/// Locals that the program reads.
pub fn told(automaton: &Automaton) -> Vec<usize> {
    let of_modes =
        |modes: &Modes| modes.by_hand.into_iter().chain([modes.moved_by_hand]).chain(modes.commanded);
    automaton.modes.iter().flat_map(of_modes).chain(automaton.abandoned).collect()
}

/// The step ends here unless transitions are tested.
pub fn without_steps(lowering: &Lowering) -> Option<Stmt> {
    let modes = lowering.automaton().modes.as_ref()?;
    Some(when(not(name(&lowering.own().locals[modes.steps][0])), vec![Stmt::Return]))
}
