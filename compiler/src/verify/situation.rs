//! Where the items are at the end of an execution: on grippers, and at places.

use super::fed::Fed;
use super::story::Teller;
use autogen_search::plant::{Arm, Place};
use autogen_search::story::Execution;

impl Teller<'_> {
    /// Of each machine that has a gripper or items its state and these: `kitting in Placing: battery on its gripper`.
    pub fn situation(&self, execution: &Execution) -> Vec<String> {
        let Some(last) = execution.scans.last() else { return Vec::new() };
        let state = &last.after;
        let fed = Fed::of(&self.project.plant);
        let machines = self.model.machines.iter().enumerate();
        let lines = machines.filter_map(|(number, machine)| {
            let mut held: Vec<String> = machine.arm.iter().map(|arm| self.on_gripper(arm, state)).collect();
            for (place, name) in machine.places.iter().zip(self.names_of_places(number, &fed)) {
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
        match place.stray.map(|stray| stray.load(state)) {
            None | Some(0) => {}
            Some(stray) => {
                let item = self.kind(stray).map_or("perhaps items".into(), |kind| format!("one {kind}"));
                found.push(format!("{item} beside the places{of}"));
            }
        }
        found
    }

    /// In the order in which the model has them.
    fn names_of_places(&self, machine: usize, fed: &Fed) -> impl Iterator<Item = &str> {
        let line = &self.project.plant;
        let parts = line.machines[machine].parts.iter().enumerate();
        parts.filter(move |(part, _)| fed.is_known(line, machine, *part)).map(|(_, part)| part.name.as_str())
    }
}
