//! Properties, and the alarms that they raise.

use super::{Automaton, Expr, FaultId, System};
use crate::source::Span;
use runtime_sim::monitor::ALARM_WORDS;

#[derive(Clone, Debug)]
pub struct Property {
    pub place: Span,
    /// As written, on one line, without what a violation does: `keep at, kind while offer`.
    pub text: String,
    pub kind: PropertyKind,
    pub severity: Severity,
    /// Where it is violated, a line stops with this fault, or the alarm of this code is raised.
    pub site: FaultId,
    /// The type has a text for the operator: a stop that is meant.
    pub asks_operator: bool,
}

/// Numbers of locals are those that the property keeps.
#[derive(Clone, Debug)]
pub enum PropertyKind {
    Always(Expr),
    /// If the condition held when it was tested last, and holds now, the values are the same.
    Keep {
        condition: Expr,
        values: Vec<Kept>,
        /// All values are as before.
        same: Expr,
        /// Whether the condition held.
        held: usize,
    },
    Whenever {
        trigger: Expr,
        goal: Expr,
        within: Expr,
        /// For how many ms the goal has been waited for, -1 while it is not; saturates.
        waited: usize,
        /// The goal is waited for anew when this changes.
        anew: Option<Kept>,
    },
}

#[derive(Clone, Debug)]
pub struct Kept {
    pub value: Expr,
    /// What it was when it was tested last.
    pub before: usize,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Severity {
    /// It stops nothing.
    Warning,
    /// The instance makes no steps until the alarm is acknowledged, its cause gone, and the line started again.
    Machine,
    /// A fault.
    Line,
}

impl Property {
    /// All expressions that are evaluated for it.
    pub fn exprs(&self) -> Vec<&Expr> {
        match &self.kind {
            PropertyKind::Always(condition) => vec![condition],
            PropertyKind::Keep { condition, values, same, .. } => {
                [condition, same].into_iter().chain(values.iter().map(|kept| &kept.value)).collect()
            }
            PropertyKind::Whenever { trigger, goal, within, anew, .. } => {
                [trigger, goal, within].into_iter().chain(anew.iter().map(|kept| &kept.value)).collect()
            }
        }
    }

    /// It raises an alarm of the table, and no fault.
    pub fn is_alarm(&self) -> bool {
        self.severity != Severity::Line
    }
}

/// An entry of the table of alarms.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Entry {
    pub robot: usize,
    pub site: FaultId,
    pub severity: Severity,
}

impl Automaton {
    /// The properties that raise alarms, in the order of their entries.
    pub fn alarms(&self) -> impl Iterator<Item = &Property> {
        self.properties.iter().filter(|property| property.is_alarm())
    }

    /// Whether an instance can be stopped by itself.
    pub fn can_stop(&self) -> bool {
        self.modes.is_some() || self.properties.iter().any(|property| property.severity == Severity::Machine)
    }

    /// Some properties that do not stop an instance count for nothing while it is stopped.
    pub fn has_pauses(&self) -> bool {
        let pauses = |property: &Property| {
            property.severity != Severity::Machine && !matches!(property.kind, PropertyKind::Always(_))
        };
        self.can_stop() && self.properties.iter().any(pauses)
    }

    /// Words of the trace of its alarms: for each of them active, acknowledged, count, first, last; and before them
    /// whether the instance is stopped, if it can be.
    pub fn alarm_words(&self) -> usize {
        usize::from(self.can_stop()) + ALARM_WORDS * self.alarms().count()
    }
}

impl System {
    /// The table of alarms: those of each instance in layout order, of one in the order of the text.
    pub fn alarms(&self) -> Vec<Entry> {
        let instances = 0..self.instances.len();
        let of = |robot| {
            let alarms = self.automaton_of(robot).alarms();
            alarms.map(move |alarm| Entry { robot, site: alarm.site, severity: alarm.severity })
        };
        instances.flat_map(of).collect()
    }
}
