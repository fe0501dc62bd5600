//! The operating modes of a model whose machines have panels, as `docs/semantics.md` says.

use super::restart;
use crate::device::{Port, panel};
use crate::ir::{
    Action, Argument, Automaton, ByHand, Expr, ExprKind, Extent, Model, Modes, Operator, Place, Scalar,
    StateId, Target, Type, Update, UpdateKind, Value,
};
use crate::source::Span;
use runtime_sim::device::{Direction, PortType, Stop};

/// Adds the modes to every automaton; its device has a panel, see [`panel::add`].
pub fn add(model: &mut Model) {
    model.automata.iter_mut().for_each(|automaton| {
        let modes = Builder { automaton }.modes();
        automaton.modes = Some(modes);
    });
}

struct Builder<'a> {
    automaton: &'a mut Automaton,
}

impl Builder<'_> {
    fn modes(&mut self) -> Modes {
        let enable = self.input(panel::ENABLE);
        let mode = self.input(panel::MODE);
        let (step, jog) = (self.input(panel::STEP), self.input(panel::JOG));
        let is_manual = equal(mode.clone(), panel::MANUAL);
        let is_not_manual = unequal(mode.clone(), panel::MANUAL);
        let is_single = equal(mode.clone(), panel::SINGLE_STEP);
        let is_not_single = unequal(mode, panel::SINGLE_STEP);
        let steps = self.truth("steps", false, "Transitions are tested in this scan.");
        let step_before = self.truth("step_before", true, "`panel_step` in the scan before.");
        let stopped_before = self.truth("stopped_before", false, "It was stopped before this scan.");
        let single_before =
            self.truth("single_before", false, "Single step was selected in the scan before.");
        let jog_ready = self.truth(
            "jog_ready",
            false,
            "`panel_jog` was released in the scan before, where pressing it would have counted.",
        );
        let has_levels = self.automaton.device.ports.iter().any(|port| self.is_level(port));
        let by_hand = has_levels.then(|| self.truth("by_hand", false, "Outputs are those of the panel."));
        let moved_by_hand = self.truth(
            "moved_by_hand",
            false,
            "It was moved by hand: it continues in a state that says `resume`, else it begins anew.",
        );
        let commanded = self.automaton.device.is_commanded().then(|| {
            self.truth(
                "commanded_by_hand",
                false,
                "The panel has given a command since its button was pressed.",
            )
        });
        restart::add_abandoned(self.automaton);
        let mut actions = vec![
            self.set(stopped_before, truth_of(ExprKind::Stopped)),
            when(
                "Not enabled, or in manual: it is stopped until start.",
                or(not(enable.clone()), is_manual.clone()),
                vec![Action::Stop],
            ),
            when(
                "Single step has ended: it is stopped until start.",
                and(vec![self.read(single_before), is_not_single.clone()]),
                vec![Action::Stop],
            ),
        ];
        let edge = and(vec![step.clone(), not(self.read(step_before))]);
        actions.extend([
            self.set(steps, or(is_not_single, edge)),
            self.set(step_before, step),
            self.set(single_before, is_single.clone()),
        ]);
        let mut allowed = vec![jog.clone(), enable.clone(), is_manual.clone(), truth_of(ExprKind::Permit)];
        allowed.extend(self.reals_by_hand());
        let begins = self.begin_by_hand(by_hand, moved_by_hand, commanded);
        let mut ends: Vec<Action> =
            by_hand.map(|by_hand| self.set(by_hand, constant(false))).into_iter().collect();
        ends.extend(commanded.map(|commanded| self.set(commanded, constant(false))));
        actions.push(Action::If {
            about: "By hand: from the edge of the button, while it is pressed.",
            condition: and(allowed),
            then: vec![when("", self.read(jog_ready), begins)],
            otherwise: ends,
        });
        let is_ready = and(vec![not(jog), enable.clone(), is_manual, truth_of(ExprKind::Permit)]);
        actions.push(self.set(jog_ready, is_ready));
        let kept = self.outputs_that_stay();
        if let Some(by_hand) = by_hand
            && !kept.is_empty()
        {
            let without_command =
                commanded.map(|commanded| not(self.read(commanded))).into_iter().chain([self.read(by_hand)]);
            let condition = and(without_command.collect());
            actions.push(when("Outputs that keep their values, unless a command is given.", condition, kept));
        }
        actions.push(self.go_on(moved_by_hand));
        Modes {
            actions,
            steps,
            is_single,
            may_go_on: and(vec![self.read(stopped_before), enable, is_not_manual]),
            by_hand,
            moved_by_hand,
            commanded,
            published: self.published(),
        }
    }

    /// At the edge of the button.
    fn begin_by_hand(&self, by_hand: Option<usize>, moved: usize, commanded: Option<usize>) -> Vec<Action> {
        let begun = by_hand.into_iter().chain([moved]);
        let mut actions: Vec<Action> = begun.map(|local| self.set(local, constant(true))).collect();
        let (Some(commanded), Some(abandoned), Some(interrupted)) =
            (commanded, self.automaton.abandoned, self.automaton.interrupted)
        else {
            return actions;
        };
        let verb = self.input(panel::VERB);
        for known in &self.automaton.device.verbs {
            let arguments = known.arguments.iter().filter_map(|name| {
                let port = self.port(name)?;
                Some(Argument { port, value: self.by_hand(&self.automaton.device.ports[port])?, check: None })
            });
            let command = UpdateKind::Command { verb: known.number, arguments: arguments.collect() };
            let given = vec![self.update(command), self.set(commanded, constant(true))];
            actions.push(when("", equal(verb.clone(), known.number), given));
        }
        actions.push(self.set(abandoned, unequal(self.output("cmd"), 0)));
        actions.push(self.set(interrupted, constant(false)));
        actions
    }

    /// Outputs of the panel that could be infinite or NaN are not.
    fn reals_by_hand(&self) -> Vec<Expr> {
        let ports = self.automaton.device.ports.iter().filter(|port| port.direction == Direction::Output);
        let reals = ports.filter(|port| matches!(port.ty, PortType::Real | PortType::Point));
        reals.filter_map(|port| Some(truth_of(ExprKind::IsFinite(Box::new(self.by_hand(port)?))))).collect()
    }

    /// Levels without a stop value become those of the panel, and stay so when the button is released.
    fn outputs_that_stay(&self) -> Vec<Action> {
        let ports = self.automaton.device.ports.iter().enumerate();
        let kept = ports.filter(|(_, port)| self.is_level(port) && port.stop == Stop::Hold);
        kept.filter_map(|(number, port)| {
            let target =
                Target { place: Place::Port { port: number, index: None }, ty: one(Scalar::from(port.ty)) };
            Some(self.update(UpdateKind::Assign { target, value: self.by_hand(port)?, check: None }))
        })
        .collect()
    }

    fn go_on(&self, moved_by_hand: usize) -> Action {
        let resumable: Vec<StateId> = self.automaton.resumable().map(StateId).collect();
        let goes_on = match (self.automaton.abandoned, self.automaton.interrupted) {
            (Some(abandoned), Some(interrupted)) => vec![self.set(interrupted, self.read(abandoned))],
            _ => Vec::new(),
        };
        let is_resumable = truth_of(ExprKind::InState(resumable.clone()));
        let begins = match (resumable.is_empty(), goes_on.is_empty()) {
            (true, _) => Action::BeginAnew,
            (false, true) => when("", not(is_resumable), vec![Action::BeginAnew]),
            (false, false) => Action::If {
                about: "",
                condition: is_resumable,
                then: goes_on,
                otherwise: vec![Action::BeginAnew],
            },
        };
        when(
            "It continues after it was moved by hand.",
            and(vec![self.read(moved_by_hand), not(truth_of(ExprKind::Stopped))]),
            vec![self.set(moved_by_hand, constant(false)), begins],
        )
    }

    fn published(&self) -> Vec<Option<ByHand>> {
        let of = |port: &Port| match port.stop {
            _ if port.direction == Direction::Input => None,
            Stop::Hold => None,
            Stop::Value(_) if self.is_level(port) => self.by_hand(port).map(ByHand::Panel),
            Stop::Value(_) if port.name == "hold" && self.automaton.device.is_commanded() => {
                Some(ByHand::Hold)
            }
            Stop::Value(_) => Some(ByHand::Argument),
        };
        self.automaton.device.ports.iter().map(of).collect()
    }

    /// An output that is neither part of a command nor one of those that every device with commands has.
    fn is_level(&self, port: &Port) -> bool {
        let device = &self.automaton.device;
        let is_head = device.is_commanded() && matches!(port.name.as_str(), "cmd" | "verb" | "hold");
        let is_argument = device.verbs.iter().flat_map(|verb| &verb.arguments).any(|name| *name == port.name);
        port.direction == Direction::Output && !is_head && !is_argument
    }

    /// What the panel gives for an output.
    fn by_hand(&self, output: &Port) -> Option<Expr> {
        let inputs = panel::inputs_for(&output.name, output.ty == PortType::Point);
        let ports = inputs.iter().map(|name| self.port(name));
        let values: Vec<Expr> = ports.map(|port| port.map(|port| self.at(port))).collect::<Option<_>>()?;
        Some(match <[Expr; 3]>::try_from(values) {
            Ok(coordinates) => Expr { ty: Scalar::Point, kind: ExprKind::MakePoint(Box::new(coordinates)) },
            Err(values) => values.into_iter().next()?,
        })
    }

    fn port(&self, name: &str) -> Option<usize> {
        self.automaton.device.ports.iter().position(|port| port.name == name)
    }

    fn at(&self, port: usize) -> Expr {
        let ty = Scalar::from(self.automaton.device.ports[port].ty);
        Expr { ty, kind: ExprKind::Read(Place::Port { port, index: None }) }
    }

    fn input(&self, name: &str) -> Expr {
        self.port(name).map_or_else(|| unreachable!("a panel has {name}"), |port| self.at(port))
    }

    fn output(&self, name: &str) -> Expr {
        self.input(name)
    }

    fn truth(&mut self, name: &str, initial: bool, about: &str) -> usize {
        restart::add_local(self.automaton, name, Scalar::Bool, Value::Bool(initial), about)
    }

    fn read(&self, local: usize) -> Expr {
        let ty = self.automaton.locals[local].ty.scalar;
        Expr { ty, kind: ExprKind::Read(Place::Local { local, index: None }) }
    }

    fn set(&self, local: usize, value: Expr) -> Action {
        let target =
            Target { place: Place::Local { local, index: None }, ty: self.automaton.locals[local].ty };
        self.update(UpdateKind::Assign { target, value, check: None })
    }

    fn update(&self, kind: UpdateKind) -> Action {
        let place: Span = self.automaton.place;
        Action::Update(Update { place, kind })
    }
}

fn one(scalar: Scalar) -> Type {
    Type { scalar, extent: Extent::One }
}

fn when(about: &'static str, condition: Expr, then: Vec<Action>) -> Action {
    Action::If { about, condition, then, otherwise: Vec::new() }
}

fn truth_of(kind: ExprKind) -> Expr {
    Expr { ty: Scalar::Bool, kind }
}

fn constant(value: bool) -> Expr {
    truth_of(ExprKind::Constant(Value::Bool(value)))
}

fn whole(value: i32) -> Expr {
    Expr { ty: Scalar::Int { lo: value, hi: value }, kind: ExprKind::Constant(Value::Int(value)) }
}

fn binary(operator: Operator, a: Expr, b: Expr) -> Expr {
    truth_of(ExprKind::Binary(operator, Box::new(a), Box::new(b)))
}

fn equal(a: Expr, value: i32) -> Expr {
    binary(Operator::Equal, a, whole(value))
}

fn unequal(a: Expr, value: i32) -> Expr {
    binary(Operator::NotEqual, a, whole(value))
}

fn not(inner: Expr) -> Expr {
    truth_of(ExprKind::Not(Box::new(inner)))
}

fn or(a: Expr, b: Expr) -> Expr {
    binary(Operator::Or, a, b)
}

fn and(all: Vec<Expr>) -> Expr {
    all.into_iter().reduce(|a, b| binary(Operator::And, a, b)).unwrap_or_else(|| constant(true))
}
