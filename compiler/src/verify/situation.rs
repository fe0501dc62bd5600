//! Where the items are at the end of an execution: on grippers, and at places.

use super::plant::is_known;
use super::story::Teller;
use autogen_search::plant::{Arm, Place};
use autogen_search::story::Execution;
use runtime_sim::part::Primitive;

impl Teller<'_> {
    /// Of each machine that has a gripper or items its state and these: `kitting in Placing: battery on its gripper`.
    pub fn situation(&self, execution: &Execution) -> Vec<String> {
        let Some(last) = execution.scans.last() else { return Vec::new() };
        let state = &last.after;
        let machines = self.model.machines.iter().enumerate();
        let lines = machines.filter_map(|(number, machine)| {
            let mut held: Vec<String> = machine.arm.iter().map(|arm| self.on_gripper(arm, state)).collect();
            for (place, name) in machine.places.iter().zip(self.names_of_places(number)) {
                let of_several = (machine.places.len() > 1).then_some(name);
                held.extend(self.at_place(place, of_several, state));
            }
            let name_of_state =
                || self.state(number, self.model.instances[number].state.load(state) as usize);
            (!held.is_empty())
                .then(|| format!("{} in {}: {}", self.name(number), name_of_state(), held.join(", ")))
        });
        lines.collect()
    }

    fn on_gripper(&self, arm: &Arm, state: &[u8]) -> String {
        let item = self.kind(arm.holds.load(state));
        format!("{} on its gripper", item.unwrap_or("nothing"))
    }

    /// What lies there, by slots or by kinds as the search knows it.
    fn at_place(&self, place: &Place, of_several: Option<&str>, state: &[u8]) -> Vec<String> {
        let of = of_several.map_or_else(String::new, |name| format!(" of `{name}`"));
        let mut found = Vec::new();
        for (number, item) in place.items.iter().enumerate() {
            let value = item.load(state);
            match (place.by_kind, self.kind(value)) {
                (false, Some(kind)) => found.push(format!("{kind} at place {number}{of}")),
                (true, _) if value > 0 => {
                    let kind = &self.project.plant.kinds[number].name;
                    let more = if value == place.most { " or more" } else { "" };
                    found.push(format!("{value}{more} {kind}{of}"));
                }
                _ => {}
            }
        }
        if place.stray.is_some_and(|stray| stray.load(state) != 0) {
            found.push(format!("an item beside the places{of}"));
        }
        found
    }

    /// In the order in which the model has them.
    fn names_of_places(&self, machine: usize) -> impl Iterator<Item = &str> {
        let machine = &self.project.plant.machines[machine];
        machine.parts.iter().filter_map(|part| match &part.primitive {
            Primitive::Place(place) if is_known(machine, place) => Some(part.name.as_str()),
            _ => None,
        })
    }
}
