//! The function block of a type that looks at its properties behind the steps of all robots, and raises alarms.

use super::block::{
    Block, Candidate, Origin, begun_anew, candidates, elapsed, externals, inputs_and_kept, kept_values,
    locals, made, stopped,
};
use super::code::{self, Arm, Ex, Stmt, and, assign, binary, name, not, or, sum, when};
use super::context::{Lowering, Phase, Shared};
use super::dead;
use super::declaration::{Basic, Unit, Variable};
use super::expression::guarded;
use super::globals::Index;
use super::masks::{self, Masks};
use super::modes::{self, BEGUN_ANEW};
use crate::ir::{AutomatonId, Expr, KeptBy, Property, PropertyKind, Scalar, Severity};

/// Whether the property at hand is violated.
const VIOLATED: &str = "property_violated";
/// Whether the condition of a `keep` holds.
const HOLDS: &str = "condition_holds";
/// The robot is stopped, or was when the block was called.
const AT_REST: &str = "at_rest";
/// The number of the robot's first entry in the table of alarms.
pub const ENTRY: &str = "alarm_entry";
pub const STOPPED: &str = "robot_stopped";
pub const LOCAL: [&str; 4] = [VIOLATED, HOLDS, AT_REST, ENTRY];

pub fn block<'a>(shared: Shared, id: AutomatonId, globals: &Index) -> Option<Block<'a>> {
    let mut lowering = Lowering::new(shared, id);
    let automaton = lowering.automaton();
    if automaton.properties.is_empty() && automaton.modes.is_none() {
        return None;
    }
    let masks = Masks::new(&mut lowering);
    let tests = tests(&mut lowering, &masks.statements);
    let mut body = anew(&lowering);
    let begins = modes::tells_anew(automaton);
    body.push(when(stopped(), vec![Stmt::Return]));
    body.extend(dead::without_unread(tests, &made(&lowering)));
    let mut all = candidates(shared, id);
    let put_out = masks::put_out(&mut all, &masks.set);
    let used = code::names(&body);
    let kept: Vec<&Candidate> =
        all.iter().filter(|c| c.kept_by == KeptBy::Properties && used.contains(&c.variable.name)).collect();
    if !kept.is_empty() {
        let begun = if begins { name(BEGUN_ANEW) } else { Ex::Bool(false) };
        body.insert(0, when(or(vec![not(name("init_done")), begun]), kept_values(&kept)));
    }
    let used = code::names(&body);
    let mut variables: Vec<Variable> = kept.iter().map(|c| c.variable.clone()).collect();
    let own = [
        (VIOLATED, "the property does not hold"),
        (HOLDS, "its condition holds"),
        (AT_REST, "the robot is stopped, or was before the properties were checked"),
    ];
    let own = own.map(|(name, about)| Variable::new(name, Basic::Bool).with_comment(about));
    variables.extend(own.into_iter().filter(|variable| used.contains(&variable.name)));
    variables.extend(put_out);
    variables.extend(locals(shared, id, &lowering.temporaries, &used));
    let mut given: Vec<Candidate> = all.into_iter().filter(|c| c.kept_by != KeptBy::Properties).collect();
    given.push(begun_anew());
    given.push(elapsed());
    given.push(Candidate::given(
        Variable::new(ENTRY, Basic::Dint).with_comment("number of its first entry in the table of alarms"),
        Origin::AlarmEntry,
    ));
    let (inputs, arguments) = inputs_and_kept(given, &used);
    Some(Block {
        unit: Unit {
            name: lowering.own().properties.clone(),
            comments: vec![if automaton.properties.is_empty() {
                format!("Restart of each {} that was stopped, after the steps of all robots.", automaton.name)
            } else {
                format!("The properties of each {}, checked after the steps of all robots.", automaton.name)
            }],
            inputs,
            externals: externals(globals, &used),
            variables,
            body: body.into(),
            ..Unit::default()
        },
        arguments,
    })
}

/// All tests, for what they read.
pub fn body(lowering: &mut Lowering) -> Vec<Stmt> {
    tests(lowering, &[])
}

/// First the properties that stop the robot, then whether it continues, then the others. `put_out` comes before those that
/// it is for.
fn tests(lowering: &mut Lowering, put_out: &[Stmt]) -> Vec<Stmt> {
    let automaton = lowering.automaton();
    let stops = lowering.checks(|severity| severity == Severity::Machine);
    let mut out = Vec::new();
    if automaton.can_stop() {
        out.push(assign(AT_REST, own_stop()));
    }
    if !stops.is_empty() {
        out.extend(put_out.iter().cloned());
        out.extend(stops);
    }
    if automaton.can_stop() {
        lowering.continues(&mut out);
    }
    if automaton.has_pauses() {
        out.push(assign(AT_REST, or(vec![name(AT_REST), own_stop()])));
    }
    // The outputs may be others.
    lowering.known.clear();
    let others = lowering.checks(|severity| severity != Severity::Machine);
    if !others.is_empty() {
        out.extend(put_out.iter().cloned());
        out.extend(others);
    }
    out
}

fn entry(alarm: usize) -> Ex {
    sum(name(ENTRY), Ex::Int(alarm as i32))
}

pub fn own_stop() -> Ex {
    Ex::Element(STOPPED.into(), Box::new(name("robot")))
}

/// Raises an alarm if there is none, and says whether it lasts.
fn note(entry: Ex, severity: Severity) -> Vec<Stmt> {
    let of = |array: &str| Ex::Element(array.into(), Box::new(entry.clone()));
    let count = || of("alarms_count");
    let mut raised = vec![
        when(binary("=", count(), Ex::Int(0)), vec![Stmt::Assign(of("alarms_first"), name("scan_no"))]),
        Stmt::Assign(of("alarms_last"), name("scan_no")),
        when(
            binary("<", count(), Ex::Int(i32::MAX)),
            vec![Stmt::Assign(count(), binary("+", count(), Ex::Int(1)))],
        ),
        Stmt::Assign(of("alarms_acknowledged"), Ex::Bool(false)),
    ];
    if severity == Severity::Machine {
        raised.push(Stmt::Assign(own_stop(), Ex::Bool(true)));
    }
    vec![
        when(and(vec![name(VIOLATED), not(of("alarms_active"))]), raised),
        Stmt::Assign(of("alarms_active"), name(VIOLATED)),
    ]
}

/// Behind a reset that cleared a fault.
fn anew(lowering: &Lowering) -> Vec<Stmt> {
    let held = |local: usize| &lowering.own().locals[local][0];
    let properties = lowering.automaton().properties.iter();
    let statements = properties.filter_map(|property| match property.kind {
        PropertyKind::Always(_) => None,
        PropertyKind::Keep { held: local, .. } => Some(assign(held(local), Ex::Bool(false))),
        PropertyKind::Whenever { waited, .. } => Some(assign(held(waited), Ex::Int(-1))),
    });
    guarded(name("fault_cleared"), statements.collect())
}

impl Lowering<'_> {
    /// A condition as it is to be tested; `out` gets what comes before.
    fn condition(&mut self, expr: &Expr, out: &mut Vec<Stmt>) -> Ex {
        let mut before = Vec::new();
        let value = self.value(expr, &mut before);
        out.append(&mut self.hoisted);
        out.extend(before);
        value
    }

    /// The tests of the properties of these severities, in the order of the text.
    fn checks(&mut self, is_meant: impl Fn(Severity) -> bool) -> Vec<Stmt> {
        let mut out = Vec::new();
        let mut alarm = 0;
        for property in &self.automaton().properties {
            let number = alarm;
            alarm += usize::from(property.is_alarm());
            if !is_meant(property.severity) {
                continue;
            }
            self.phase = Phase::Update;
            self.release();
            out.push(Stmt::Comment(format!("{}   {}", property.text, self.line(property.place))));
            let violated = self.violated(property, &mut out);
            if !property.is_alarm() {
                out.extend(guarded(violated, self.raise(property.site)));
                continue;
            }
            // A `keep` has put it there.
            if !matches!(&violated, Ex::Name(name) if name == VIOLATED) {
                out.push(assign(VIOLATED, violated));
            }
            out.extend(note(entry(number), property.severity));
        }
        out
    }

    fn continues(&mut self, out: &mut Vec<Stmt>) {
        let automaton = self.automaton();
        let stops = automaton.alarms().enumerate().filter(|(_, p)| p.severity == Severity::Machine);
        let closed = stops.flat_map(|(number, _)| {
            let of = |array: &str| Ex::Element(array.into(), Box::new(entry(number)));
            [not(of("alarms_active")), of("alarms_acknowledged")]
        });
        out.push(Stmt::Comment("It continues: it makes its next step in the next scan.".into()));
        let enabled: Vec<Ex> =
            automaton.modes.iter().map(|modes| self.condition(&modes.may_go_on, out)).collect();
        let conditions = [name("start_edge"), name(AT_REST)].into_iter().chain(closed).chain(enabled);
        out.push(when(and(conditions.collect()), vec![Stmt::Assign(own_stop(), Ex::Bool(false))]));
    }

    fn violated(&mut self, property: &Property, out: &mut Vec<Stmt>) -> Ex {
        let locals = &self.own().locals;
        let can_stop = self.automaton().can_stop();
        match &property.kind {
            PropertyKind::Always(condition) => {
                let mut before = Vec::new();
                let fails = self.contrary(condition, &mut before);
                out.append(&mut self.hoisted);
                out.extend(before);
                fails
            }
            PropertyKind::Keep { condition, values, same, held } => {
                let held = &locals[*held][0];
                let condition = self.condition(condition, out);
                let holds = match can_stop {
                    true => and(vec![not(name(AT_REST)), condition]),
                    false => condition,
                };
                out.push(assign(HOLDS, holds));
                let same = self.condition(same, out);
                out.push(assign(VIOLATED, and(vec![name(held), name(HOLDS), not(same)])));
                out.push(assign(held, name(HOLDS)));
                let mut stores = Vec::new();
                for kept in values {
                    let mut before = Vec::new();
                    let parts = match kept.value.ty {
                        Scalar::Point => self.coordinates(&kept.value, &mut before),
                        _ => vec![self.value(&kept.value, &mut before)],
                    };
                    out.append(&mut self.hoisted);
                    out.extend(before);
                    let stored = locals[kept.before].iter().zip(parts);
                    stores.extend(stored.map(|(local, part)| assign(local, part)));
                }
                out.extend(guarded(name(HOLDS), stores));
                name(VIOLATED)
            }
            PropertyKind::Whenever { trigger, goal, within, waited, anew } => {
                let waited = &locals[*waited][0];
                let trigger = self.condition(trigger, out);
                let goal = self.condition(goal, out);
                let within = self.condition(within, out);
                let arm = |condition: Ex, body: Vec<Stmt>| Arm { comments: Vec::new(), condition, body };
                let goal = if can_stop { or(vec![name(AT_REST), goal]) } else { goal };
                let goal = match &self.automaton().modes {
                    Some(modes) => or(vec![self.condition(&modes.is_single, out), goal]),
                    None => goal,
                };
                let room = binary("-", Ex::Int(i32::MAX), name("dt_ms"));
                let grow = Stmt::If(
                    vec![arm(
                        binary("<", name(waited), room),
                        vec![assign(waited, binary("+", name(waited), name("dt_ms")))],
                    )],
                    vec![assign(waited, Ex::Int(i32::MAX))],
                );
                if let Some(kept) = anew {
                    let before = &locals[kept.before][0];
                    let value = self.condition(&kept.value, out);
                    let changed = binary("<>", name(before), value.clone());
                    out.push(when(changed, vec![assign(before, value), assign(waited, Ex::Int(-1))]));
                }
                out.push(Stmt::If(
                    vec![
                        arm(goal, vec![assign(waited, Ex::Int(-1))]),
                        arm(binary(">=", name(waited), Ex::Int(0)), vec![grow]),
                        arm(trigger, vec![assign(waited, Ex::Int(0))]),
                    ],
                    Vec::new(),
                ));
                binary(">=", name(waited), within)
            }
        }
    }
}
