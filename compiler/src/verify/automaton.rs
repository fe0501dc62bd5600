//! The automaton of one instance.

use super::expression::Stored;
use super::live::{Remembers, Sight, live, told};
use super::memory::Memory;
use super::plant::{Plant, Signal};
use super::{Asked, Skipped};
use crate::executor::Executor;
use crate::ir::{
    self, Automaton, Expr, ExprKind, FaultId, InterfaceId, Place, RoleId, Scalar, System, UpdateKind, Value,
};
use crate::reads::{ReadCell, Reads, Whose, is_fixed};
use autogen_search::plant::{Action, Machine, sight};
use autogen_search::program::{
    After, Argument, Bounds, Cells, Clause, Command, Int, Key, Operator, State, Target, Transition, Unread,
    Update,
};
use autogen_search::value::Var;
use runtime_sim::device::Direction;
use std::collections::{BTreeSet, HashMap};
use std::sync::Arc;

/// Where values stand: each element, and how much less the state holds.
pub type Vars = (Vec<Var>, i32);

/// What all instances share.
pub struct Line<'a> {
    pub system: &'a System,
    pub plant: &'a runtime_sim::line::Line,
    /// Of each instance: the automaton's state, and how many times have come.
    pub states: Vec<(Var, Option<Var>)>,
    /// Of each instance how long its state lasts, as far as times tell that the layout does not fix.
    pub elapsed: Vec<Option<Var>>,
    /// Whether each is stopped by itself, if anything can stop it.
    pub stopped: Vec<Option<Var>>,
    pub locals: Vec<Vec<Vars>>,
    /// `[interface][row][cell]`.
    pub cells: Vec<Vec<Vec<Vars>>>,
    pub plants: Vec<Plant>,
    /// Of each instance the places of the outputs that it reads, by their ports.
    pub outputs: Vec<Vec<Option<Vars>>>,
    /// Of each instance what is seen over its conveyor and stays so while this is at rest.
    pub seen: Vec<Vec<Var>>,
    /// The first state.
    pub initial: &'a [u8],
}

/// An instance on its way into the model.
pub struct Instance<'a> {
    pub line: &'a Line<'a>,
    pub number: usize,
    pub automaton: &'a Automaton,
    /// Of the state whose expressions are read, in scans, ascending.
    times: Vec<i32>,
    defines: HashMap<usize, Arc<Int>>,
    /// Variables of quantifiers that stand for one value each, and how many copies of an expression that makes.
    pub fixed_variables: HashMap<usize, i32>,
    pub copies: usize,
    /// Whether an input was read since [`Instance::begin_anew`] that the state does not tell behind the scan.
    pub asks_inputs: bool,
    /// Outputs are read as they are put out.
    pub sees_what_is_put_out: bool,
    /// Names of inputs of which nothing is known that could be searched.
    pub refused: Vec<String>,
}

impl Line<'_> {
    /// The number of a cell among those of all interfaces.
    pub fn column(&self, interface: InterfaceId, cell: usize) -> usize {
        let before = self.system.model.interfaces[..interface.0].iter();
        before.map(|interface| interface.cells.len()).sum::<usize>() + cell
    }

    /// A cell of all members of an interface, or of one of them.
    pub fn cells_read(&self, interface: InterfaceId, cell: usize, of: Option<usize>) -> Cells {
        let column = self.column(interface, cell);
        match of {
            Some(owner) => Cells::of(owner, column),
            None => {
                let members = self.system.members[interface.0].iter();
                members.fold(Cells::default(), |all, member| all | Cells::of(*member, column))
            }
        }
    }

    /// Of an enumeration, or of an interface to whose rows a reference refers.
    pub fn members(&self, ty: Scalar) -> usize {
        match ty {
            Scalar::Enum(id) => self.system.model.enums[id.0].members.len(),
            Scalar::Ref(id) => self.system.members[id.0].len(),
            _ => 0,
        }
    }
}

impl<'a> Instance<'a> {
    pub fn new(line: &'a Line<'a>, number: usize) -> Self {
        let automaton = line.system.automaton_of(number);
        Self {
            line,
            number,
            automaton,
            times: Vec::new(),
            defines: HashMap::new(),
            fixed_variables: HashMap::new(),
            copies: 1,
            asks_inputs: false,
            sees_what_is_put_out: false,
            refused: Vec::new(),
        }
    }

    pub fn instance(&self) -> &'a ir::Instance {
        &self.line.system.instances[self.number]
    }

    pub fn machine(&self) -> &'a Machine {
        &self.line.plants[self.number].machine
    }

    pub fn own_row(&self, interface: InterfaceId) -> usize {
        self.automaton.implementing(interface).map_or(0, |position| self.instance().rows[position])
    }

    pub fn role(&self, role: RoleId) -> &'a [usize] {
        &self.instance().roles[role.0]
    }

    pub fn define(&mut self, define: usize) -> Int {
        if let Some(known) = self.defines.get(&define) {
            return Int::Shared(known.clone());
        }
        let value = &self.automaton.defines[define].value;
        let copies = std::mem::replace(&mut self.copies, 1);
        let value = Arc::new(self.int(value));
        self.copies = copies;
        self.defines.insert(define, value.clone());
        Int::Shared(value)
    }

    /// What was read before is of no importance to the next expressions.
    pub fn begin_anew(&mut self) {
        self.defines.clear();
        self.times.clear();
        self.asks_inputs = false;
    }

    /// What stands at a port of the device.
    pub fn port(&mut self, port: usize) -> Stored {
        let ports = &self.automaton.device.ports;
        let direction = ports[port].direction;
        if direction == Direction::Output {
            return match &self.line.outputs[self.number][port] {
                Some((vars, low)) => Stored::Vars(vars.clone(), *low),
                None => Stored::Signal(Signal::Unbounded),
            };
        }
        let before = ports[..port].iter().filter(|other| other.direction == direction).count();
        Stored::Signal(self.line.plants[self.number].inputs[before].clone())
    }

    /// An input is read of which nothing is known that could be searched.
    pub fn refuse(&mut self, place: &Place) {
        if let Place::Port { port, .. } = place {
            let name = self.automaton.device.ports[*port].name.clone();
            if !self.refused.contains(&name) {
                self.refused.push(name);
            }
        }
    }

    /// A time that the layout fixes comes in its turn; of another one it is asked when it is read whether it has passed.
    pub fn after(&mut self, time: &Expr) -> Int {
        let unfixed =
            |this: &mut Self| Int::After(Box::new(After { instance: this.number, time: this.int(time) }));
        let Some(ms) = self.fixed(time) else { return unfixed(self) };
        let scans = self.scans(ms);
        if scans <= 1 {
            return Int::Constant(1);
        }
        let (Ok(rank), Some(come)) = (self.times.binary_search(&scans), self.line.states[self.number].1)
        else {
            return unfixed(self);
        };
        Int::Binary(Operator::GreaterEqual, Box::new([Int::Load(come, 0), Int::Constant(rank as i32 + 1)]))
    }

    /// In the test of which number in its state a time has passed.
    fn scans(&self, ms: i32) -> i32 {
        ms.max(0).unsigned_abs().div_ceil(self.line.system.scan_ms.unsigned_abs()) as i32
    }

    fn fixed(&self, time: &Expr) -> Option<i32> {
        if !is_fixed(self.automaton, time) {
            return None;
        }
        let mut executor = Executor::new(self.line.system);
        let value = executor.can_evaluate(self.number, time).then(|| executor.value(self.number, time))?;
        match value {
            Value::Int(ms) => Some(ms),
            _ => None,
        }
    }

    /// What its properties remember is laid out in the state.
    pub fn program(
        &mut self,
        asked: &Asked,
        memory: &mut Memory,
        skipped: &mut Vec<Skipped>,
    ) -> autogen_search::program::Instance {
        let (state, times_come) = self.line.states[self.number];
        let automaton = self.automaton;
        let sight = self.sight();
        let live = live(automaton, &sight, asked);
        // What is held instead of a sight that nobody reads. Where no place of an item was told since the conveyor stands, no
        // arm goes to one.
        let unread = told(automaton, &sight).into_iter().map(|is_told| match is_told {
            true => [sight::OPEN, sight::NOT_SEEN],
            false => [sight::FORGOTTEN; 2],
        });
        let states = automaton.states.iter().zip(live.iter().zip(unread));
        let states = states.map(|(state, (live, unread))| self.state(state, live, unread)).collect();
        let properties = self.properties(asked, memory, skipped);
        autogen_search::program::Instance {
            state,
            stopped: self.line.stopped[self.number],
            times_come,
            elapsed: self.line.elapsed[self.number],
            states,
            property_reads: autogen_search::property::Property::reads_of_all(&properties),
            properties,
            variables: automaton.variables.len(),
        }
    }

    fn sight(&mut self) -> Sight {
        let (head, wiring) =
            (&self.line.plants[self.number].machine.head, &self.line.plant.machines[self.number].wiring);
        let commands = head.iter().flat_map(|head| &head.commands).zip(&wiring.commands);
        let moves =
            commands.filter(|(asked, _)| asked.action == Action::Run).map(|(_, command)| command.number);
        let moves = moves.collect();
        let mut sight = Sight { seen: Vec::new(), found: Vec::new(), moves };
        for port in 0..self.automaton.device.ports.len() {
            match self.port(port) {
                Stored::Signal(Signal::Free(_)) => sight.seen.push(port),
                Stored::Signal(Signal::Found(_)) => sight.found.push(port),
                _ => {}
            }
        }
        sight
    }

    fn state(
        &mut self,
        state: &ir::State,
        live: &BTreeSet<Remembers>,
        [seen_is, not_seen]: [i32; 2],
    ) -> State {
        let automaton = self.automaton;
        let guards = Reads::of_guards(automaton, state);
        let times = guards.timers.iter().filter_map(|time| self.fixed(time));
        let mut times: Vec<i32> = times.map(|ms| self.scans(ms)).filter(|scans| *scans > 1).collect();
        times.sort_unstable();
        times.dedup();
        self.times = times.clone();
        self.defines.clear();
        let reads = guards.cells.iter().map(|ReadCell { interface, cell, of }| {
            self.line.cells_read(*interface, *cell, (*of == Whose::Own).then_some(self.number))
        });
        let reads = reads.fold(Cells::default(), |all, cells| all | cells);
        let transitions = state.transitions.iter().map(|transition| self.transition(transition)).collect();
        let locals = self.line.locals[self.number].iter().enumerate();
        let dead = locals.filter(|(local, _)| !live.contains(&Remembers::Local(*local)));
        let dead = dead.flat_map(|(_, (vars, _))| vars);
        let dead = dead.map(|var| (*var, var.load(self.line.initial))).collect();
        let seen = self.line.seen[self.number].iter().filter(|_| !live.contains(&Remembers::Seen));
        let unread = seen.map(|input| Unread { input: *input, seen: seen_is, not_seen }).collect();
        let [is_answer_dead, is_error_dead] =
            [Remembers::Answer, Remembers::Error].map(|remembers| !live.contains(&remembers));
        State { transitions, reads, times, dead, unread, is_answer_dead, is_error_dead }
    }

    fn transition(&mut self, transition: &ir::Transition) -> Transition {
        let clauses = transition.clauses.iter().map(|clause| match clause {
            ir::Clause::Condition(condition) => Clause::Condition(self.int(condition)),
            ir::Clause::Bind(binder) => Clause::Bind {
                variable: binder.variable.0,
                domain: self.domain(&binder.domain),
                condition: binder.condition.as_ref().map(|condition| self.int(condition)),
                key: binder.key.as_ref().map(|key| match key.ty {
                    Scalar::Real => Key::Real(self.real(key)),
                    _ => Key::Int(self.int(key)),
                }),
            },
        });
        let clauses = clauses.collect();
        let updates = transition.updates.iter().filter_map(|update| self.update(&update.kind)).collect();
        Transition { clauses, target: transition.target.map(|target| target.0), updates }
    }

    /// None for what nobody reads.
    fn update(&mut self, update: &UpdateKind) -> Option<Update> {
        match update {
            UpdateKind::Assign { target, value, check } => {
                let (vars, index) = self.target(&target.place, *check)?;
                let place = Target { vars: vars.0.into(), index };
                Some(self.store(place, target.ty.scalar, value, vars.1, check.map(|fault| fault.0)))
            }
            UpdateKind::Fill { target, value, check } => {
                let (vars, begin) = self.target(&target.place, *check)?;
                let (low, vars): (i32, Arc<[Var]>) = (vars.1, vars.0.into());
                let elements = self.line.system.model.elements(target.ty.extent);
                let updates = (0..elements).map(|element| {
                    let place = Target { vars: vars.clone(), index: offset(&begin, element) };
                    self.store(place, target.ty.scalar, value, low, check.map(|fault| fault.0))
                });
                Some(Update::Copy(updates.collect()))
            }
            UpdateKind::Copy { target, source, check } => {
                let (vars, begin) = self.target(&target.place, *check)?;
                let (low, vars): (i32, Arc<[Var]>) = (vars.1, vars.0.into());
                let elements = self.line.system.model.elements(target.ty.extent);
                let updates = (0..elements).map(|element| {
                    let place = Target { vars: vars.clone(), index: offset(&begin, element) };
                    let value =
                        Expr { ty: target.ty.scalar, kind: ExprKind::Read(with_index(source, element)) };
                    self.store(place, target.ty.scalar, &value, low, check.map(|fault| fault.0))
                });
                Some(Update::Copy(updates.collect()))
            }
            UpdateKind::Command { verb, arguments } => Some(self.command(*verb, arguments)),
        }
    }

    fn store(&mut self, target: Target, ty: Scalar, value: &Expr, base: i32, fault: Option<usize>) -> Update {
        match ty {
            Scalar::Real => Update::Real(target, self.real(value), fault),
            Scalar::Point => Update::Point(target, self.point(value), fault),
            Scalar::Int { lo, hi } => {
                Update::Int(target, self.int(value), Bounds { low: lo, high: hi, base, fault })
            }
            Scalar::Time => {
                Update::Int(target, self.int(value), Bounds { low: 0, high: i32::MAX, base, fault })
            }
            Scalar::Bool | Scalar::Enum(_) | Scalar::Ref(_) => {
                let bounds = Bounds { low: i32::MIN, high: i32::MAX, base, fault: None };
                Update::Int(target, self.int(value), bounds)
            }
        }
    }

    /// What nobody reads is evaluated all the same where it may fault.
    fn target(&mut self, place: &Place, check: Option<FaultId>) -> Option<(Vars, Int)> {
        match self.stored(place) {
            (Stored::Vars(vars, low), index) => Some(((vars, low), index)),
            _ if check.is_some() => Some(((Vec::new(), 0), Int::Constant(0))),
            _ => None,
        }
    }

    fn command(&mut self, verb: i32, arguments: &[ir::Argument]) -> Update {
        let machine = &self.line.plant.machines[self.number];
        let commands = &machine.wiring.commands;
        let command = commands.iter().position(|command| command.number == verb).unwrap_or(0);
        let places = super::plant::places_of_commands(machine)[command];
        let ports = &self.automaton.device.ports;
        let mut left = places;
        let arguments = arguments.iter().filter_map(|argument| {
            let ty = Scalar::from(ports[argument.port].ty);
            let is_place = ty == Scalar::Point && left > 0;
            left -= usize::from(is_place);
            let (vars, low) = match self.port(argument.port) {
                Stored::Vars(vars, low) => (vars, low),
                _ if is_place || argument.check.is_some() => (Vec::new(), 0),
                _ => return None,
            };
            let target = Target { vars: vars.into(), index: Int::Constant(0) };
            let fault = argument.check.map(|fault| fault.0);
            Some(match is_place {
                true => Argument::Place(target, self.point(&argument.value), fault),
                false => Argument::Output(self.store(target, ty, &argument.value, low, fault)),
            })
        });
        Update::Command(Command { command, arguments: arguments.collect() })
    }
}

fn offset(begin: &Int, element: usize) -> Int {
    match begin {
        Int::Constant(begin) => Int::Constant(begin.wrapping_add(element as i32)),
        begin => Int::Binary(Operator::Add, Box::new([begin.clone(), Int::Constant(element as i32)])),
    }
}

/// The element of an array with this number.
fn with_index(place: &Place, element: usize) -> Place {
    let mut place = place.clone();
    let number = Expr {
        ty: Scalar::Int { lo: element as i32, hi: element as i32 },
        kind: ExprKind::Constant(Value::Int(element as i32)),
    };
    match &mut place {
        Place::Local { index, .. }
        | Place::Cell { index, .. }
        | Place::Port { index, .. }
        | Place::Parameter { index, .. }
        | Place::Shown { index, .. } => *index = Some(Box::new(number)),
    }
    place
}
