//! Inputs of which no contract says which values they have.

use super::story::Teller;
use autogen_search::story::Execution;
use runtime_sim::device::Direction;
use runtime_sim::wiring::Source;
use std::collections::BTreeSet;

impl Teller<'_> {
    /// Those that an execution reads, in words; nothing, if it reads none.
    pub fn told_without_contract(&self, execution: &Execution) -> Option<String> {
        let ports = self.without_contract(execution);
        let what = "any value in every scan, whether the device can do this or not";
        (!ports.is_empty()).then(|| format!("{}: {what}", ports.join(", ")))
    }

    /// The same, one by one: `` `pressed` of desk ``.
    pub fn without_contract(&self, execution: &Execution) -> Vec<String> {
        let read = execution.scans.iter().flat_map(|happened| &happened.told.read);
        let free = read.map(|(input, _)| *input).filter(|input| self.model.inputs[*input].stays.is_none());
        let free: BTreeSet<usize> = free.collect();
        let mut ports: Vec<String> = free.into_iter().map(|input| self.port_of(input)).collect();
        ports.dedup();
        ports
    }

    /// The port that shows an input that changes by itself.
    fn port_of(&self, input: usize) -> String {
        let machine = self.model.inputs[input].machine;
        let plant = &self.project.plant.machines[machine];
        let device = &self.project.system.automaton_of(machine).device;
        let name = self.input(input).split('[').next().unwrap_or_default();
        let shows = |source: &Source| {
            matches!(*source, Source::Signal { part, signal } if {
                let part = &plant.parts[part];
                name == format!("{}.({} {})", plant.name, part.name, part.schema().signals[signal].name)
            })
        };
        let ports = device.ports.iter().filter(|port| port.direction == Direction::Input);
        let mut ports = ports.zip(&plant.wiring.inputs).filter(|(_, wired)| shows(&wired.source));
        let port = ports.next().map_or(name, |(port, _)| port.name.as_str());
        format!("`{port}` of {}", plant.name)
    }
}
