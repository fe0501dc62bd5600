//! What a run shows of itself after a scan, to be compared with another run.

use super::first::Common;
use autogen::executor::Executor;
use autogen::ir::{Element, KeptBy, Named, Scalar, System, Value};
use runtime_sim::scan::Controllers;
use std::collections::BTreeMap;

/// The values of a run as they were when it was looked at last.
pub struct Seen<'a> {
    system: &'a System,
    values: Vec<Followed<'a>>,
    machines: Vec<Machine>,
}

struct Followed<'a> {
    name: &'a str,
    element: Element,
    ty: Scalar,
    last: Option<Value>,
}

struct Machine {
    number: usize,
    /// Its state, whether it is stopped, and its alarms; none before the first look.
    last: Option<[String; 3]>,
}

/// What is told of a machine beside its values, in the order of [`Machine::last`].
const OF_MACHINES: [&str; 3] = ["in state", "stopped", "alarms"];

impl<'a> Seen<'a> {
    /// `names` are those of the values of the system.
    pub fn new(system: &'a System, names: &'a BTreeMap<String, Named>, common: &Common) -> Self {
        let is_followed = |(name, value): &(&String, &Named)| {
            common.values.contains(*name) && !is_remembered(system, value.element)
        };
        let followed = |(name, value): (&'a String, &'a Named)| Followed {
            name,
            element: value.element,
            ty: value.ty,
            last: None,
        };
        let is_common = |number: &usize| common.machines.contains(&system.instances[*number].name);
        let machines = (0..system.instances.len()).filter(is_common);
        Self {
            system,
            values: names.iter().filter(is_followed).map(followed).collect(),
            machines: machines.map(|number| Machine { number, last: None }).collect(),
        }
    }

    /// What differs from the last look, by name; at the first one that is everything.
    pub fn changes(&mut self, executor: &Executor) -> BTreeMap<String, String> {
        let mut changes = BTreeMap::new();
        for Followed { name, element, ty, last } in &mut self.values {
            let value = executor.element(*element);
            if last.replace(value) != Some(value) {
                changes.insert(name.to_string(), self.system.shown_value(*ty, value));
            }
        }
        for Machine { number, last } in &mut self.machines {
            let now = standing(self.system, executor, *number);
            let before = last.replace(now.clone());
            for (which, text) in now.into_iter().enumerate() {
                if before.as_ref().is_none_or(|before| before[which] != text) {
                    let machine = &self.system.instances[*number].name;
                    changes.insert(format!("{machine}, {}", OF_MACHINES[which]), text);
                }
            }
        }
        changes
    }
}

/// The machine and the value of a name in [`Seen::changes`].
pub fn parts(name: &str) -> (&str, &str) {
    let (machine, value) = name.split_once(", ").or_else(|| name.split_once('.')).unwrap_or((name, ""));
    (machine, value.strip_prefix("in ").unwrap_or(value))
}

/// What properties remember changes in scans in which nothing happens: it says nothing that the alarms do not say.
fn is_remembered(system: &System, element: Element) -> bool {
    match element {
        Element::Local { robot, local, .. } => {
            system.automaton_of(robot).locals[local].kept_by == KeptBy::Properties
        }
        Element::Cell { .. } | Element::Port { .. } => false,
    }
}

fn standing(system: &System, executor: &Executor, machine: usize) -> [String; 3] {
    let automaton = system.automaton_of(machine);
    let state = automaton.states[executor.state(machine)].name.clone();
    let alarms = automaton.alarms().zip(executor.alarms(machine));
    let alarms = alarms.filter(|(_, alarm)| alarm.active || !alarm.acknowledged);
    let texts = alarms.map(|(property, alarm)| {
        let text = &system.model.faults[property.site.0].text;
        let active = if alarm.active { "active" } else { "no longer active" };
        let acknowledged = if alarm.acknowledged { "acknowledged" } else { "not acknowledged" };
        format!("{text} ({active}, {acknowledged})")
    });
    let texts: Vec<String> = texts.collect();
    let alarms = if texts.is_empty() { "none".into() } else { texts.join("; ") };
    [state, executor.is_stopped(machine).to_string(), alarms]
}
