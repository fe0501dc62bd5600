//! What has happened in no execution of a search.

use super::story::Teller;
use crate::ir::{Automaton, PropertyKind, UpdateKind};
use autogen_search::occurred::Occurred;
use autogen_search::program::Instance;
use autogen_search::stroke::position;

/// What never happens, of so many things that could.
#[derive(Debug, Default)]
pub struct Never {
    groups: Vec<Group>,
    pub all: usize,
}

/// The same of several machines: `` `plating` of ``, `cell1, cell2`, ` never begins`.
#[derive(Debug)]
struct Group {
    of: String,
    machines: Vec<String>,
    what: String,
}

impl Never {
    /// Something of a machine; none: it has happened.
    fn add(&mut self, machine: &str, never: Option<(String, String)>) {
        self.all += 1;
        let Some((of, what)) = never else { return };
        match self.groups.iter_mut().find(|group| group.of == of && group.what == what) {
            Some(group) => group.machines.push(machine.into()),
            None => self.groups.push(Group { of, machines: vec![machine.into()], what }),
        }
    }

    pub fn number(&self) -> usize {
        self.groups.iter().map(|group| group.machines.len()).sum()
    }

    pub fn told(&self) -> Vec<String> {
        let told = |Group { of, machines, what }: &Group| format!("{of} of {}{what}", machines.join(", "));
        self.groups.iter().map(told).collect()
    }
}

impl Teller<'_> {
    /// What devices never do: grippers first, then processes and cylinders, then the commands that automata give.
    pub fn never_done(&self, occurred: &Occurred) -> Never {
        let mut never = Never::default();
        for (machine, taken) in occurred.taken.iter().enumerate() {
            if self.project.plant.machines[machine].has("grip") {
                let what = || ("the gripper".into(), format!(" never takes an item{}", self.unknown()));
                never.add(self.name(machine), (!taken).then(what));
            }
        }
        for (process, (begun, completed)) in
            self.model.processes.iter().zip(occurred.begun.iter().zip(&occurred.completed))
        {
            let what = match (begun, completed) {
                (false, _) => Some("begins"),
                (true, false) => Some("ends"),
                (true, true) => None,
            };
            let part = self.part(process.machine, process.part);
            never.add(self.name(process.machine), what.map(|what| part_never(part, what)));
        }
        for (cylinder, strokes) in self.model.cylinders.iter().zip(&occurred.strokes) {
            let has_come = |position: i32| strokes[position as usize];
            let what = match (strokes.contains(&true), has_come(position::IN), has_come(position::OUT)) {
                (false, ..) => Some("moves"),
                (true, _, false) => Some("comes to its outer end"),
                (true, false, true) => Some("comes to its inner end"),
                (true, true, true) => None,
            };
            let part = self.part(cylinder.machine, cylinder.part);
            never.add(self.name(cylinder.machine), what.map(|what| part_never(part, what)));
        }
        for machine in 0..self.model.machines.len() {
            self.commands_never(machine, occurred, &mut never);
        }
        never
    }

    fn commands_never(&self, machine: usize, occurred: &Occurred, never: &mut Never) {
        let automaton = self.project.system.automaton_of(machine);
        for (command, wired) in self.project.plant.machines[machine].wiring.commands.iter().enumerate() {
            let verb = automaton.device.verbs.iter().find(|verb| verb.number == wired.number);
            let Some(verb) = verb.filter(|verb| gives(automaton, verb.number)) else { continue };
            let what = match (occurred.given[machine][command], occurred.succeeded[machine][command]) {
                (false, _) => Some(" is never given"),
                (true, false) => Some(" never ends successfully"),
                (true, true) => None,
            };
            let never_so = what.map(|what| (format!("`{}`", verb.name), what.into()));
            never.add(self.name(machine), never_so);
        }
    }

    /// Properties that ask for something only while a condition holds, and were never put to the test.
    pub fn never_tested(&self, occurred: &Occurred) -> Never {
        let mut never = Never::default();
        let instances = self.model.instances.iter().zip(&occurred.tested).enumerate();
        for (instance, (Instance { properties, .. }, tested)) in instances {
            for (searched, is_tested) in properties.iter().zip(tested) {
                let declared = &self.project.system.automaton_of(instance).properties;
                let property = declared.iter().find(|property| property.site.0 == searched.fault);
                let Some(property) = property.filter(|_| searched.is_conditional()) else { continue };
                let what = match property.kind {
                    PropertyKind::Whenever { .. } => "nothing ever has to follow",
                    PropertyKind::Keep { .. } | PropertyKind::Always(_) => "its condition never holds",
                };
                let place = self.place(property.place);
                let never_so = || (format!("`{}`", property.text), format!(": {what} ({place})"));
                never.add(self.name(instance), (!is_tested).then(never_so));
            }
        }
        never
    }

    /// Why a gripper may find nothing.
    fn unknown(&self) -> &'static str {
        match self.model.hides_items {
            true => ": items on conveyors without commands, cylinders, positioners and tracks are not known",
            false => "",
        }
    }
}

fn part_never(part: &str, what: &str) -> (String, String) {
    (format!("`{part}`"), format!(" never {what}"))
}

/// Whether an automaton has a transition with this command.
fn gives(automaton: &Automaton, number: i32) -> bool {
    let transitions = automaton.states.iter().flat_map(|state| &state.transitions);
    let mut updates = transitions.flat_map(|transition| &transition.updates);
    updates.any(|update| matches!(update.kind, UpdateKind::Command { verb, .. } if verb == number))
}
