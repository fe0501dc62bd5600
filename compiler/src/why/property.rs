//! Properties at a time: those in whose fault the line stands, those with an alarm, and those that wait.

use super::guard::{Look, parts_of};
use super::{Node, Promise, Standing, Verdict};
use crate::ir::{Element, Expr, Property, PropertyKind, Value};

impl<'a> Look<'_, 'a> {
    /// The properties of the machine of which there is something to say.
    pub(super) fn promises(&mut self) -> Vec<Promise> {
        let system = self.watch.system;
        let properties = &system.automaton_of(self.robot).properties;
        let mut alarm = 0;
        let mut found = Vec::new();
        for property in properties {
            let standing = self.standing(property, alarm);
            alarm += usize::from(property.is_alarm());
            let waiting = self.waiting(property);
            for standing in standing.into_iter().chain(waiting) {
                self.seen_by = Some(property.severity);
                self.watch.executor.exchange_seen(self.robot, property.severity);
                let clauses = self.clauses(property);
                self.watch.executor.exchange_seen(self.robot, property.severity);
                self.seen_by = None;
                found.push(Promise {
                    text: property.text.clone(),
                    told: system.model.faults[property.site.0].text.clone(),
                    place: property.place,
                    standing,
                    clauses,
                });
            }
        }
        // What properties read is not what the machine waits for.
        self.awaits.clear();
        found
    }

    /// Whether it is the fault, or its alarm, by its number among those of the machine, stands.
    fn standing(&self, property: &Property, alarm: usize) -> Option<Standing> {
        if !property.is_alarm() {
            let fault =
                self.watch.fault.filter(|fault| fault.site == property.site && fault.robot == self.robot)?;
            return Some(Standing::Fault { at_ms: self.watch.ms(fault.scan) });
        }
        let alarm = self.watch.executor.alarms(self.robot)[alarm];
        (alarm.active || !alarm.acknowledged).then(|| Standing::Alarm {
            severity: property.severity,
            raised_ms: self.watch.ms_since_power_up(alarm.last),
            active: alarm.active,
            acknowledged: alarm.acknowledged,
        })
    }

    /// A `whenever` that waits and is not late yet.
    fn waiting(&mut self, property: &Property) -> Option<Standing> {
        let PropertyKind::Whenever { within, waited, .. } = &property.kind else { return None };
        let waited = Element::Local { robot: self.robot, local: *waited, index: 0 };
        let waited = self.watch.executor.element(waited);
        let (Value::Int(waited), Value::Int(within)) =
            (waited, self.watch.executor.value(self.robot, within))
        else {
            return None;
        };
        let since_ms = self.watch.ms(self.scan).checked_sub(u64::try_from(waited).ok()?)?;
        (waited < within).then(|| Standing::Waits { since_ms, until_ms: since_ms + within as u64 })
    }

    /// What decides whether it is violated: outputs as it has seen them, all else as it is now.
    fn clauses(&mut self, property: &'a Property) -> Vec<Node> {
        let mut nodes = Vec::new();
        let mut wanted = |look: &mut Self, condition: &'a Expr, word: &str| {
            for part in parts_of(condition) {
                let node = look.condition(part, true);
                nodes.push(Node { text: format!("{word}{}", node.text), ..node });
            }
        };
        let told = match &property.kind {
            PropertyKind::Always(condition) => {
                wanted(self, condition, "");
                Vec::new()
            }
            PropertyKind::Keep { condition, values, .. } => {
                wanted(self, condition, "while ");
                values.iter().map(|kept| ("keep ", &kept.value)).collect()
            }
            PropertyKind::Whenever { trigger, goal, .. } => {
                wanted(self, goal, "then ");
                vec![("whenever ", trigger)]
            }
        };
        for (word, expr) in told {
            let reads = self.reads(expr, true);
            let text = format!("{word}{}", self.words().expr(expr));
            nodes.push(Node { text, verdict: Verdict::NotTested, reads, parts: Vec::new() });
        }
        nodes
    }
}
