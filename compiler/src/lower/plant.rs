//! What the simulator needs of a system.

use super::role::Line;
use crate::diagnostic::Diagnostic;
use crate::ir::{Clause, Domain, Expr, ExprKind, InterfaceId, Place, RoleKind, State, System};
use crate::scenario::{self, ResolvedScenario, Scenario};
use runtime_sim::line;
use runtime_sim::machine::Machine;
use std::collections::BTreeSet;

pub fn resolve(scenario: &Scenario, line: &Line) -> Result<ResolvedScenario, Vec<Diagnostic>> {
    let named = |wanted: &dyn Fn(usize) -> bool| -> Vec<(&str, usize)> {
        (0..line.robots.len())
            .filter(|r| wanted(*r))
            .map(|r| (line.robots[r].object.name.value.as_str(), r))
            .collect()
    };
    let has = |r: usize, primitive: &str| line.automaton(r).device.has(primitive);
    scenario::resolve(
        scenario,
        &scenario::Line {
            stations: &named(&|r| has(r, "orders")),
            belts: &named(&|r| has(r, "source")),
            arms: &named(&|r| has(r, "grip")),
            commanded: &named(&|r| line.automaton(r).device.is_commanded()),
        },
    )
}

pub fn line(
    system: &System,
    line: &Line,
    obstacles: Vec<line::Obstacle>,
    scenario: ResolvedScenario,
    scan_ms: u32,
    machines: Vec<Machine>,
) -> line::Line {
    let scans = |seconds: f64| (seconds * 1000.0 / f64::from(scan_ms)).round() as u64;
    let arms = arms(system);
    line::Line {
        scan_ms,
        kinds: scenario
            .kinds
            .iter()
            .map(|kind| line::Kind { name: kind.name.value.clone(), height: kind.height, size: kind.size })
            .collect(),
        machines: machines
            .into_iter()
            .enumerate()
            .map(|(i, machine)| Machine {
                states: system.automaton_of(i).states.iter().map(|s| state(system, &arms, i, s)).collect(),
                ..machine
            })
            .collect(),
        obstacles,
        may_touch: line.layout.may_touch.iter().map(|m| m.pair.each_ref().map(|n| n.value.clone())).collect(),
        scenario: line::Scenario {
            orders: scenario
                .orders
                .into_iter()
                .map(|(stations, parts)| line::Order { stations, parts })
                .collect(),
            supply: scenario.supply.into_iter().map(|(belt, items)| line::Supply { belt, items }).collect(),
            spawn_first_s: scenario.spawn_first_s,
            spawn_every_s: scenario.spawn_every_s,
            time_limit_s: scenario.time_limit_s,
            slips: (scenario.slips.iter())
                .map(|s| line::Slip { machine: s.robot, pick: s.pick, after_s: s.after_s })
                .collect(),
            refusals: (scenario.refusals.iter())
                .map(|r| line::Refusal { machine: r.robot, command: r.command })
                .collect(),
            pauses: (scenario.pauses.iter())
                .map(|p| line::Pause { at_scan: scans(p.at_s), scans: scans(p.for_s) })
                .collect(),
            ..line::Scenario::default()
        },
        io_delay: line::IoDelay::Fixed(0),
    }
}

/// The arms that take from or hand to an instance, with the interface for which they come.
type Arms = Vec<(InterfaceId, usize)>;

fn arms(system: &System) -> Vec<Arms> {
    let mut arms = vec![Arms::new(); system.instances.len()];
    for (arm, instance) in system.instances.iter().enumerate() {
        for (role, rows) in system.automaton_of(arm).roles.iter().zip(&instance.roles) {
            if matches!(role.kind, RoleKind::Takes | RoleKind::Hands) {
                let members = &system.members[role.interface.0];
                rows.iter().for_each(|row| arms[members[*row]].push((role.interface, arm)));
            }
        }
    }
    arms
}

/// What is awaited in a state: own timer and ports, or the owners of the cells that its guards read.
fn state(system: &System, arms: &[Arms], instance: usize, state: &State) -> line::State {
    let mut reads =
        Reads { system, arms, instance, working: false, owners: BTreeSet::new(), seen: BTreeSet::new() };
    for transition in &state.transitions {
        for clause in &transition.clauses {
            match clause {
                Clause::Condition(condition) => reads.expr(condition),
                Clause::Bind(binder) => {
                    reads.domain(&binder.domain);
                    binder.condition.iter().for_each(|c| reads.expr(c));
                }
            }
        }
    }
    reads.owners.remove(&instance);
    line::State {
        name: state.name.clone(),
        working: reads.working,
        awaits: reads.owners.into_iter().collect(),
    }
}

struct Reads<'a> {
    system: &'a System,
    arms: &'a [Arms],
    instance: usize,
    working: bool,
    owners: BTreeSet<usize>,
    /// Definitions that were read already, as each may be used many times.
    seen: BTreeSet<usize>,
}

impl Reads<'_> {
    fn domain(&mut self, domain: &Domain) {
        if let Domain::Range(low, high) = domain {
            self.expr(low);
            self.expr(high);
        }
    }

    fn expr(&mut self, expr: &Expr) {
        match &expr.kind {
            ExprKind::After(time) => {
                self.working = true;
                self.expr(time);
            }
            ExprKind::Done | ExprKind::Failed => self.working = true,
            ExprKind::Read(place) => self.place(place),
            ExprKind::Define(define) if !self.seen.insert(*define) => {}
            ExprKind::Define(define) => {
                let system = self.system;
                self.expr(&system.automaton_of(self.instance).defines[*define].value);
            }
            ExprKind::Not(a)
            | ExprKind::Negate(a)
            | ExprKind::Absolute(a)
            | ExprKind::ToReal(a)
            | ExprKind::Coordinate(a, _)
            | ExprKind::IsMember(a, _) => self.expr(a),
            ExprKind::Binary(_, a, b)
            | ExprKind::Min(a, b)
            | ExprKind::Max(a, b)
            | ExprKind::SquaredDistance(a, b)
            | ExprKind::Reaches(_, a, b) => {
                self.expr(a);
                self.expr(b);
            }
            ExprKind::MakePoint(parts) => parts.iter().for_each(|p| self.expr(p)),
            ExprKind::Exists { domain, body, .. }
            | ExprKind::Forall { domain, body, .. }
            | ExprKind::Count { domain, body, .. }
            | ExprKind::Sum { domain, body, .. } => {
                self.domain(domain);
                self.expr(body);
            }
            ExprKind::Constant(_) | ExprKind::Variable(_) | ExprKind::Own(_) | ExprKind::Members(_) => {}
        }
    }

    /// A cell of its own is awaited from the arms that come here: they write it too.
    fn partners(&mut self, interface: InterfaceId) {
        let come_here = self.arms[self.instance].iter().filter(|(i, _)| *i == interface);
        self.owners.extend(come_here.map(|(_, arm)| arm));
    }

    fn place(&mut self, place: &Place) {
        let index = match place {
            Place::Port { index, .. } => {
                self.working = true;
                index
            }
            Place::Cell { interface, of: None, index, .. } => {
                self.partners(*interface);
                index
            }
            Place::Cell { interface, of: Some(_), index, .. } => {
                let roles = &self.system.automaton_of(self.instance).roles;
                let rows = roles
                    .iter()
                    .zip(&self.system.instances[self.instance].roles)
                    .filter(|(role, _)| role.interface == *interface && role.kind != RoleKind::Knows)
                    .flat_map(|(_, rows)| rows);
                self.owners.extend(rows.map(|row| self.system.members[interface.0][*row]));
                index
            }
            Place::Local { index, .. } | Place::Parameter { index, .. } | Place::Shown { index, .. } => index,
        };
        if let Some(index) = index {
            self.expr(index);
        }
    }
}
