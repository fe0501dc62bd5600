//! What comes behind the steps: properties, and the alarms that they raise.

use super::{Executor, Robot};
use crate::ir::{Expr, FaultId, Property, PropertyKind, Severity, Value};
use runtime_sim::scan::SystemOutputs;

/// An entry of the table of alarms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Alarm {
    /// What raises it lasts.
    pub active: bool,
    pub acknowledged: bool,
    /// How often it was raised.
    pub count: i32,
    /// Scans in which it was raised first and last.
    pub first: i32,
    pub last: i32,
}

/// The outputs that are masked, as they were put out at the last check of properties; empty before the first one.
#[derive(Clone, Debug, Default)]
pub(super) struct Seen {
    by_stops: Vec<Vec<Value>>,
    by_others: Vec<Vec<Value>>,
}

impl Seen {
    fn of(&self, severity: Severity) -> &Vec<Vec<Value>> {
        match severity {
            Severity::Machine => &self.by_stops,
            Severity::Line | Severity::Warning => &self.by_others,
        }
    }

    fn of_mut(&mut self, severity: Severity) -> &mut Vec<Vec<Value>> {
        match severity {
            Severity::Machine => &mut self.by_stops,
            Severity::Line | Severity::Warning => &mut self.by_others,
        }
    }
}

impl Alarm {
    pub(super) const NONE: Self = Self { active: false, acknowledged: true, count: 0, first: 0, last: 0 };

    /// Those that are not acknowledged come first, of them the one that was raised first.
    fn order(&self) -> (bool, i32) {
        (self.acknowledged, self.last)
    }

    /// Whether it is raised in this scan.
    fn note(&mut self, violated: bool, scan: i32) -> bool {
        let raised = violated && !self.active;
        self.active = violated;
        if raised {
            if self.count == 0 {
                self.first = scan;
            }
            self.last = scan;
            self.count = self.count.saturating_add(1);
            self.acknowledged = false;
        }
        raised
    }

    pub(super) fn push_words(self, out: &mut Vec<f64>) {
        let truth = |value: bool| f64::from(u8::from(value));
        out.extend([truth(self.active), truth(self.acknowledged)]);
        out.extend([self.count, self.first, self.last].map(f64::from));
    }
}

impl Executor<'_> {
    /// The alarms of an instance, in the order of its type.
    pub fn alarms(&self, robot: usize) -> &[Alarm] {
        &self.robots[robot].alarms
    }

    pub fn is_stopped(&self, robot: usize) -> bool {
        self.robots[robot].stopped
    }

    /// All properties of an instance, which see what is put out: first those that stop it, then whether it continues, then
    /// the others. `starts` says whether there is an edge of `start`.
    pub(super) fn properties(&mut self, robot: usize, starts: bool) -> Result<(), FaultId> {
        let was_stopped = self.robots[robot].stopped;
        let raised =
            self.seeing_what_is_put_out(robot, Severity::Machine, |this| this.stops(robot, was_stopped));
        if raised {
            self.robots[robot].stopped = true;
        } else if starts && was_stopped && !self.is_held(robot) && self.may_go_on(robot) {
            self.robots[robot].stopped = false;
        }
        self.seeing_what_is_put_out(robot, Severity::Line, |this| this.others(robot, was_stopped))
    }

    /// Outputs are meanwhile as they are put out, and are kept so for [`Self::exchange_seen`].
    fn seeing_what_is_put_out<T>(
        &mut self,
        robot: usize,
        by: Severity,
        look: impl FnOnce(&mut Self) -> T,
    ) -> T {
        let masked = &self.system.automaton_of(robot).masked;
        let runs = !self.robots[robot].stopped;
        let put = masked.iter().map(|port| self.put_out(robot, *port, runs)).collect();
        *self.robots[robot].seen.of_mut(by) = put;
        self.exchange_seen(robot, by);
        let found = look(self);
        self.exchange_seen(robot, by);
        found
    }

    /// Exchanges the outputs with what properties of this severity saw at their last check, and back.
    pub(crate) fn exchange_seen(&mut self, robot: usize, by: Severity) {
        let masked = &self.system.automaton_of(robot).masked;
        let Robot { ports, seen, .. } = &mut self.robots[robot];
        for (port, values) in masked.iter().zip(seen.of_mut(by)) {
            std::mem::swap(&mut ports[*port], values);
        }
    }

    /// The other value of an output for [`Self::exchange_seen`].
    pub(crate) fn exchanged(&self, robot: usize, by: Severity, port: usize, index: usize) -> Option<Value> {
        let mut masked = self.system.automaton_of(robot).masked.iter();
        let number = masked.position(|masked| *masked == port)?;
        self.robots[robot].seen.of(by).get(number)?.get(index).copied()
    }

    /// The properties that stop the instance; whether one of them raises its alarm.
    fn stops(&mut self, robot: usize, is_at_rest: bool) -> bool {
        let system = self.system;
        let mut raises = false;
        for (alarm, property) in system.automaton_of(robot).alarms().enumerate() {
            if property.severity == Severity::Machine {
                raises |= self.is_raised(robot, property, alarm, is_at_rest);
            }
        }
        raises
    }

    /// The properties that do not stop it.
    fn others(&mut self, robot: usize, was_stopped: bool) -> Result<(), FaultId> {
        let system = self.system;
        let is_at_rest = was_stopped || self.robots[robot].stopped;
        let mut alarm = 0;
        for property in &system.automaton_of(robot).properties {
            match property.severity {
                Severity::Line if self.is_violated(robot, property, is_at_rest) => return Err(property.site),
                Severity::Warning => _ = self.is_raised(robot, property, alarm, is_at_rest),
                Severity::Line | Severity::Machine => {}
            }
            alarm += usize::from(property.is_alarm());
        }
        Ok(())
    }

    /// Whether the alarm of a property is raised in this scan.
    fn is_raised(&mut self, robot: usize, property: &Property, alarm: usize, is_at_rest: bool) -> bool {
        let violated = self.is_violated(robot, property, is_at_rest);
        let scan = self.scan;
        self.robots[robot].alarms[alarm].note(violated, scan)
    }

    /// An alarm that stops it is active or not acknowledged.
    fn is_held(&self, robot: usize) -> bool {
        let mut alarms = self.system.automaton_of(robot).alarms().zip(&self.robots[robot].alarms);
        alarms.any(|(p, a)| p.severity == Severity::Machine && (a.active || !a.acknowledged))
    }

    fn is_violated(&mut self, robot: usize, property: &Property, is_at_rest: bool) -> bool {
        match &property.kind {
            PropertyKind::Always(condition) => !self.holds(robot, condition),
            PropertyKind::Keep { condition, values, same, held } => {
                let holds = !is_at_rest && self.holds(robot, condition);
                let held_before = self.robots[robot].locals[*held][0] == Value::Bool(true);
                let violated = held_before && holds && !self.holds(robot, same);
                self.remember(robot, *held, Value::Bool(holds));
                if holds {
                    for kept in values {
                        let value = self.value(robot, &kept.value);
                        self.remember(robot, kept.before, value);
                    }
                }
                violated
            }
            PropertyKind::Whenever { trigger, goal, within, waited, anew } => {
                let before = self.counted(robot, *waited);
                let changed = anew.as_ref().is_some_and(|kept| {
                    let value = self.value(robot, &kept.value);
                    let differs = self.robots[robot].locals[kept.before][0] != value;
                    self.remember(robot, kept.before, value);
                    differs
                });
                let now = if is_at_rest || self.is_single(robot) || self.holds(robot, goal) {
                    -1
                } else if before >= 0 && !changed {
                    before.saturating_add(self.system.scan_ms)
                } else if self.holds(robot, trigger) {
                    0
                } else {
                    -1
                };
                self.remember(robot, *waited, Value::Int(now));
                now >= 0 && now >= self.milliseconds(robot, within)
            }
        }
    }

    fn milliseconds(&mut self, robot: usize, time: &Expr) -> i32 {
        match self.value(robot, time) {
            Value::Int(ms) => ms,
            other => unreachable!("a checked time is {other:?}"),
        }
    }

    fn counted(&self, robot: usize, waited: usize) -> i32 {
        match self.robots[robot].locals[waited][0] {
            Value::Int(ms) => ms,
            other => unreachable!("a counter is {other:?}"),
        }
    }

    fn remember(&mut self, robot: usize, local: usize, value: Value) {
        self.robots[robot].locals[local][0] = value;
    }

    /// What properties remember begins anew.
    pub(super) fn observe_anew(&mut self) {
        for robot in 0..self.robots.len() {
            for property in &self.system.automaton_of(robot).properties {
                match property.kind {
                    PropertyKind::Always(_) => {}
                    PropertyKind::Keep { held, .. } => self.remember(robot, held, Value::Bool(false)),
                    PropertyKind::Whenever { waited, .. } => self.remember(robot, waited, Value::Int(-1)),
                }
            }
        }
    }

    /// So many milliseconds pass in which nothing happens.
    pub(super) fn wait(&mut self, robot: usize, ms: i32) {
        for property in &self.system.automaton_of(robot).properties {
            if let PropertyKind::Whenever { waited, .. } = property.kind {
                let before = self.counted(robot, waited);
                if before >= 0 {
                    self.remember(robot, waited, Value::Int(before.saturating_add(ms)));
                }
            }
        }
    }

    pub(super) fn acknowledge(&mut self) {
        let alarms = self.robots.iter_mut().flat_map(|robot| &mut robot.alarms);
        alarms.for_each(|alarm| alarm.acknowledged = true);
    }

    /// The outputs that tell of alarms: of those that are active or not acknowledged, the first by [`Alarm::order`].
    pub(super) fn tell_alarms(&self, outputs: SystemOutputs) -> SystemOutputs {
        let mut told: Option<((bool, i32), FaultId, usize)> = None;
        for (robot, state) in self.robots.iter().enumerate() {
            for (property, entry) in self.system.automaton_of(robot).alarms().zip(&state.alarms) {
                let is_open = entry.active || !entry.acknowledged;
                if is_open && told.is_none_or(|(first, ..)| entry.order() < first) {
                    told = Some((entry.order(), property.site, robot));
                }
            }
        }
        SystemOutputs {
            alarm: told.is_some(),
            alarm_code: told.map_or(0, |(_, site, _)| site.0 as i32 + 1),
            alarm_robot: told.map_or(-1, |(_, _, robot)| robot as i32),
            ..outputs
        }
    }
}
