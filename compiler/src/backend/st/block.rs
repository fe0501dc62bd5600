//! The function block of a type that makes its steps, and what all blocks of a type are called with.

use super::code::{self, Ex, Member, Stmt, advance, assign, binary, name, not, or, when};
use super::context::{Lowering, Shared};
use super::dead;
use super::declaration::{Basic, Unit, Variable, constants};
use super::expression::limited;
use super::externals::Externals;
use super::globals::{Index, about, array_names, elements, meaning};
use super::modes;
use super::name::Name;
use super::names::ELEMENT;
use super::property;
use super::restart;
use super::role::Members;
use super::value::{NO_SUCH_STATE, first_value};
use crate::ir::{Automaton, AutomatonId, Extent, KeptBy, RoleId, Scalar, Value};
use runtime_sim::device::{Direction, PortType};
use std::collections::{BTreeSet, HashSet};

/// Where a variable of a block comes from.
#[derive(Clone, Debug)]
pub enum Origin {
    Robot,
    Row(usize),
    Parameter {
        parameter: usize,
        part: usize,
    },
    Members(usize),
    MemberCount(usize),
    Input {
        port: usize,
        part: usize,
    },
    /// Kept in the block of the steps, under the same name.
    Kept,
    /// Kept in the block of the steps, under this name.
    KeptAs(Name),
    /// Its first entry in the table of alarms.
    AlarmEntry,
}

impl Origin {
    /// The parameter of which it is a part.
    pub fn parameter(&self) -> Option<usize> {
        match self {
            Origin::Parameter { parameter, .. } => Some(*parameter),
            _ => None,
        }
    }
}

/// A variable that a block of a type may need.
pub struct Candidate {
    pub variable: Variable,
    origin: Origin,
    initial: Option<Ex>,
    is_output: bool,
    pub kept_by: KeptBy,
}

impl Candidate {
    pub fn given(variable: Variable, origin: Origin) -> Self {
        Self { variable, origin, initial: None, is_output: false, kept_by: KeptBy::Steps }
    }
}

impl Candidate {
    /// Kept in the block of the steps.
    fn is_of_steps(&self) -> bool {
        matches!(self.origin, Origin::Kept) && self.kept_by != KeptBy::Properties
    }
}

/// A function block with what it is called with.
pub struct Block<'a> {
    pub unit: Unit<'a>,
    pub arguments: Vec<(Name, Origin)>,
}

pub fn steps<'a>(shared: Shared, id: AutomatonId, index: &Index) -> Block<'a> {
    let globals = index.globals;
    let mut lowering = Lowering::new(shared, id);
    let branches = lowering.branches();
    let automaton = lowering.automaton();
    let own = lowering.own();
    let state = name("state");
    let unknown = Member { value: NO_SUCH_STATE, note: "no such state".into(), qualified: None };
    let otherwise = vec![assign("fault_code", Ex::Member(unknown)), assign("fault_robot", name("robot"))];
    let anew = when(name("fault_cleared"), vec![assign("elapsed", Ex::Int(0))]);
    let candidates = candidates(shared, id);
    let own_steps: Vec<&Candidate> = candidates.iter().filter(|c| c.is_of_steps()).collect();
    let mut body = lowering.operate(&own_steps, globals);
    body.push(when(stopped(), vec![anew, Stmt::Return]));
    if automaton.can_stop() {
        let is_stopped = Ex::Element(property::STOPPED.into(), Box::new(name("robot")));
        body.push(when(is_stopped, vec![assign("elapsed", Ex::Int(0)), Stmt::Return]));
    }
    body.push(elapse());
    body.extend(modes::without_steps(&lowering));
    let case = vec![Stmt::Case { selector: state, branches, otherwise }];
    let mut case = dead::without_unread(case, &made(&lowering));
    let used = code::names(&case);
    let is_asked = |s: &Stmt| matches!(s, Stmt::Assign(Ex::Name(n), _) if used.contains(n));
    body.extend(lowering.answer().into_iter().filter(is_asked));
    body.append(&mut case);
    let used = code::names(&body);
    let asked = code::names(&property::body(&mut Lowering::new(shared, id)));
    let is_kept = |c: &&Candidate| {
        let is_used = used.contains(&c.variable.name) || asked.contains(&c.variable.name);
        c.is_of_steps() && (is_used || c.kept_by == KeptBy::Modes)
    };
    let kept: Vec<&Candidate> = candidates.iter().filter(is_kept).collect();
    let mut first = lowering.power_up(&kept, globals);
    let retains = automaton.retained.state || kept.iter().any(|c| c.variable.is_retained);
    first.extend(retains.then(|| assign(restart::KEPT, Ex::Bool(true))));
    body.insert(0, when(not(name("init_done")), first));
    let used = code::names(&body);
    let mut outputs = vec![
        state_variable(shared, id),
        Variable::new("elapsed", Basic::Dint).with_comment("ms in this state"),
    ];
    if modes::tells_anew(automaton) {
        outputs.push(begun_anew().variable);
    }
    outputs.extend(retains.then(restart::mark));
    let mut variables = Vec::new();
    for candidate in kept {
        let is_seen = candidate.is_output || asked.contains(&candidate.variable.name);
        if is_seen { &mut outputs } else { &mut variables }.push(candidate.variable.clone());
    }
    variables.extend(locals(shared, id, &lowering.temporaries, &used));
    let (inputs, arguments) = inputs(candidates, &used);
    let mut comments = automaton.doc.clone();
    let device = &automaton.device;
    if !device.purpose.is_empty() {
        comments.push(format!("On the device {}: {}", device.name, device.purpose));
    }
    Block {
        unit: Unit {
            name: own.block.clone(),
            comments,
            inputs,
            outputs,
            externals: externals(index, &used),
            variables,
            references: Vec::new(),
            instances: Vec::new(),
            body: body.into(),
        },
        arguments,
    }
}

/// Not running, or faulted earlier in this scan.
pub fn stopped() -> Ex {
    or(vec![not(name("running")), binary("<>", name("fault_code"), Ex::Int(0))])
}

/// Time in the state, which stops at its greatest value.
fn elapse() -> Stmt {
    let room = binary("-", Ex::Int(i32::MAX), name("dt_ms"));
    Stmt::If(
        vec![code::Arm {
            comments: Vec::new(),
            condition: binary("<", name("elapsed"), room),
            body: vec![assign("elapsed", binary("+", name("elapsed"), name("dt_ms")))],
        }],
        vec![assign("elapsed", Ex::Int(i32::MAX))],
    )
}

fn state_variable(shared: Shared, id: AutomatonId) -> Variable {
    let states = &shared.system.model.automaton(id).states;
    let retained = &shared.system.model.automaton(id).retained;
    let mut variable = Variable::new("state", Basic::Dint).retained(retained.state);
    for (number, state) in states.iter().enumerate() {
        let about = if number == 0 { "before the first step".into() } else { state.doc.join(" ") };
        let about = if about.is_empty() { about } else { format!(": {}", about.trim()) };
        variable = variable.with_comment(format!("{number} {}{about}", state.name));
    }
    variable
}

/// What these hold at power-up.
pub fn kept_values(kept: &[&Candidate]) -> Vec<Stmt> {
    let mut body = Vec::new();
    for candidate in kept {
        let Some(initial) = &candidate.initial else { continue };
        match candidate.variable.elements {
            None => body.push(assign(&candidate.variable.name, initial.clone())),
            Some(n) => {
                let target = Ex::Element(candidate.variable.name.clone(), Box::new(name(ELEMENT)));
                let stores = vec![Stmt::Assign(target, initial.clone()), advance(ELEMENT)];
                let condition = binary("<", name(ELEMENT), Ex::Int(n as i32));
                body.push(assign(ELEMENT, Ex::Int(0)));
                body.push(Stmt::While { condition, body: stores, most: n as u64 });
            }
        }
    }
    body
}

pub fn externals(globals: &Index, used: &HashSet<Name>) -> Externals {
    Externals::Declared(globals.among(used).map(Variable::external).collect())
}

/// Everything that a block of the type may be given or keep.
pub fn candidates(shared: Shared, id: AutomatonId) -> Vec<Candidate> {
    let automaton = shared.system.model.automaton(id);
    let own = &shared.names.automata[id.0];
    let given = Candidate::given;
    let mut all = vec![given(
        Variable::new("robot", Basic::Dint).with_comment("its number, for fault_robot"),
        Origin::Robot,
    )];
    for (i, implemented) in automaton.implements.iter().enumerate() {
        let interface = &shared.system.model.interface(implemented.interface).name;
        let about = format!("its own row as {interface}");
        all.push(given(Variable::new(&own.rows[i], Basic::Dint).with_comment(about), Origin::Row(i)));
    }
    for (i, parameter) in automaton.parameters.iter().enumerate() {
        let count = array(shared, parameter.ty.extent);
        for (part, held) in own.parameters[i].iter().enumerate() {
            let mut variable = Variable::new(held, Basic::of(parameter.ty.scalar)).with_elements(count);
            if part == 0 {
                variable.comments = about(&parameter.doc, meaning(shared, parameter.ty.scalar));
                variable.comments.extend(about(&[], elements(shared, parameter.ty.extent)));
            }
            all.push(given(variable, Origin::Parameter { parameter: i, part }));
        }
    }
    for (i, role) in automaton.roles.iter().enumerate() {
        let Members::Listed(most) = shared.members(id, RoleId(i)) else { continue };
        let interface = &shared.system.model.interface(role.interface).name;
        let list = Variable::new(&own.roles[i].members, Basic::Dint).with_elements(Some(most.max(1)));
        all.push(given(
            list.with_comment(format!("rows of its {}: {interface}", role.name)),
            Origin::Members(i),
        ));
        let count = Variable::new(&own.roles[i].count, Basic::Dint).with_comment("number of them");
        all.push(given(count, Origin::MemberCount(i)));
    }
    all.extend(ports(shared, automaton, id));
    let told = modes::told(automaton);
    for (i, local) in automaton.locals.iter().enumerate() {
        let initial = shared.constants(local.ty.scalar, local.initial);
        for (part, (held, initial)) in own.locals[i].iter().zip(initial).enumerate() {
            let mut variable =
                Variable::new(held, Basic::of(local.ty.scalar)).with_elements(array(shared, local.ty.extent));
            variable.is_retained = automaton.retained.locals.contains(&i);
            if part == 0 {
                variable.comments = about(&local.doc, meaning(shared, local.ty.scalar));
                variable.comments.extend(about(&[], elements(shared, local.ty.extent)));
            }
            all.push(Candidate {
                variable,
                origin: Origin::Kept,
                initial: Some(initial),
                is_output: told.contains(&i),
                kept_by: local.kept_by,
            });
        }
    }
    all
}

fn array(shared: Shared, extent: Extent) -> Option<usize> {
    (extent != Extent::One).then(|| shared.system.model.elements(extent))
}

fn ports(shared: Shared, automaton: &Automaton, id: AutomatonId) -> Vec<Candidate> {
    let mut all = Vec::new();
    for (i, port) in automaton.device.ports.iter().enumerate() {
        let count = array(shared, port.extent.into());
        let held = &shared.names.automata[id.0].ports[i];
        for (part, (held, first)) in held.iter().zip(constants(first_value(port.ty))).enumerate() {
            let mut variable = Variable::new(held, Basic::of(Scalar::from(port.ty)))
                .with_elements(count)
                .with_comment(if part == 0 { port.about(", ") } else { String::new() });
            variable.comments.extend(about(&[], elements(shared, port.extent.into())));
            all.push(match port.direction {
                Direction::Input => Candidate::given(variable, Origin::Input { port: i, part }),
                Direction::Output => Candidate {
                    variable: variable.retained(is_retained(automaton, i)),
                    origin: Origin::Kept,
                    initial: Some(first),
                    is_output: true,
                    kept_by: KeptBy::Steps,
                },
            });
        }
    }
    all
}

/// Whether an output outlasts a loss of power.
fn is_retained(automaton: &Automaton, port: usize) -> bool {
    let name = automaton.device.ports[port].name.as_str();
    let is_command = automaton.device.is_commanded() && matches!(name, "cmd" | "verb");
    automaton.retained.ports.contains(&port) || automaton.retained.state && is_command
}

/// Names of variables that no specification declares.
pub fn made(lowering: &Lowering) -> BTreeSet<Name> {
    let own = lowering.own();
    let temporaries = lowering.temporaries.iter().map(|variable| variable.name.clone());
    temporaries.chain(own.variables.iter().cloned()).chain(own.defines.iter().flatten().cloned()).collect()
}

/// Variables that a block computes anew in each step.
pub fn locals(
    shared: Shared,
    id: AutomatonId,
    temporaries: &[Variable],
    used: &HashSet<Name>,
) -> Vec<Variable> {
    let automaton = shared.system.model.automaton(id);
    let own = &shared.names.automata[id.0];
    let mut all = vec![
        Variable::new("done", Basic::Bool).with_comment("the last command has ended successfully"),
        Variable::new("failed", Basic::Bool).with_comment("the last command has ended in error"),
    ];
    let defines = automaton.defines.iter().zip(&own.defines).map(|(define, held)| {
        let variable = Variable::new(&held[0], Basic::of(define.ty));
        Variable { comments: about(&define.doc, String::new()), ..variable }
    });
    all.extend(defines);
    all.push(Variable::new("found", Basic::Bool).with_comment("the guard with loops holds"));
    for (i, held) in own.variables.iter().enumerate() {
        if all.iter().all(|v| v.name != *held) {
            let about = meaning(shared, automaton.variables[i].ty.scalar);
            all.push(Variable::new(held, Basic::Dint).with_comment(about));
        }
    }
    all.push(Variable::new(ELEMENT, Basic::Dint).with_comment("number of an element"));
    all.extend(temporaries.iter().cloned());
    all.retain(|v| used.contains(&v.name));
    all
}

fn inputs(candidates: Vec<Candidate>, used: &HashSet<Name>) -> (Vec<Variable>, Vec<(Name, Origin)>) {
    let candidates = candidates.into_iter().filter(|c| !matches!(c.origin, Origin::Kept)).collect();
    inputs_and_kept(candidates, used)
}

pub fn inputs_and_kept(
    candidates: Vec<Candidate>,
    used: &HashSet<Name>,
) -> (Vec<Variable>, Vec<(Name, Origin)>) {
    candidates
        .into_iter()
        .filter(|c| used.contains(&c.variable.name))
        .map(|c| (c.variable.clone().retained(false), (c.variable.name, c.origin)))
        .unzip()
}

impl Block<'_> {
    /// The call of this block for a robot; what the robot keeps is read from the instance of its steps.
    pub fn call(&self, shared: Shared, instance: &Name, robot: usize) -> Stmt {
        let arguments = self.arguments.iter();
        let arguments =
            arguments.map(|(input, origin)| (input.clone(), argument(shared, robot, input, origin)));
        Stmt::Call { instance: instance.clone(), arguments: arguments.collect() }
    }
}

/// What a block of a robot is called with.
pub fn argument(shared: Shared, robot: usize, input: &Name, origin: &Origin) -> Ex {
    let instance = &shared.system.instances[robot];
    let automaton = shared.system.automaton_of(robot);
    let names = &shared.names.robots[robot];
    match *origin {
        Origin::Robot => Ex::Int(robot as i32),
        Origin::Row(i) => Ex::Int(instance.rows[i] as i32),
        Origin::Parameter { parameter, part } if automaton.parameters[parameter].ty.extent == Extent::One => {
            let scalar = automaton.parameters[parameter].ty.scalar;
            let value = instance.parameters[parameter].first().copied().unwrap_or(Value::Int(0));
            shared.constants(scalar, value).into_iter().nth(part).unwrap_or(Ex::Int(0))
        }
        Origin::Parameter { parameter, part } => name(&array_names(shared, robot, parameter)[part]),
        Origin::Members(role) => name(&names.roles[role]),
        Origin::MemberCount(role) => Ex::Int(instance.roles[role].len() as i32),
        Origin::Input { port, part } => {
            let value = name(&names.ports[port][part]);
            let device_port = &automaton.device.ports[port];
            match device_port.ty {
                PortType::Int { lo, hi } if device_port.extent == runtime_sim::device::Extent::One => {
                    limited(value, (lo, hi))
                }
                _ => value,
            }
        }
        Origin::AlarmEntry => Ex::Int(shared.names.alarms_before[robot] as i32),
        Origin::Kept => Ex::Field(names.instance.clone(), input.clone()),
        Origin::KeptAs(ref name) => Ex::Field(names.instance.clone(), name.clone()),
    }
}

/// The time in the state, of the block of the steps.
pub fn elapsed() -> Candidate {
    let variable = Variable::new("elapsed", Basic::Dint).with_comment("ms in this state");
    Candidate { is_output: true, ..Candidate::given(variable, Origin::Kept) }
}

/// Whether the robot has begun anew in this scan, of the block of the steps.
pub fn begun_anew() -> Candidate {
    let variable = Variable::new(modes::BEGUN_ANEW, Basic::Bool).with_comment("it begins anew in this scan");
    Candidate { is_output: true, ..Candidate::given(variable, Origin::Kept) }
}

/// Whether the block of the steps has such an output.
pub fn publishes(block: &Block, output: &str) -> bool {
    block.unit.outputs.iter().any(|v| v.name == output)
}
