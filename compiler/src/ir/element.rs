//! The values of a running system, by name, with their places in images and in the trace.

use super::{Extent, InterfaceId, Scalar, System, Type};
use runtime_sim::device::Direction;

/// One value that the controllers remember.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Element {
    Local { robot: usize, local: usize, index: usize },
    Cell { interface: InterfaceId, row: usize, cell: usize, index: usize },
    Port { robot: usize, port: usize, index: usize },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Group {
    Input,
    Output,
    /// A variable of the automaton.
    Local,
    /// A shared variable that belongs to the machine.
    Cell,
}

/// A value of a machine.
#[derive(Clone, Debug)]
pub struct Named {
    /// As [`System::name_of`] says.
    pub name: String,
    pub element: Element,
    pub ty: Scalar,
    pub group: Group,
    /// First word in the machine's image of inputs or outputs; none for variables.
    pub image: Option<usize>,
    /// First word in the trace of all machines; none for inputs.
    pub trace: Option<usize>,
}

impl System {
    /// The machine to which a value belongs.
    pub fn owner(&self, element: Element) -> usize {
        match element {
            Element::Local { robot, .. } | Element::Port { robot, .. } => robot,
            Element::Cell { interface, row, .. } => self.members[interface.0][row],
        }
    }

    /// The port, local or cell of which this is an element: its name and its extent.
    pub fn array_of(&self, element: Element) -> (&str, Extent) {
        match element {
            Element::Local { robot, local, .. } => {
                let declared = &self.automaton_of(robot).locals[local];
                (&declared.name, declared.ty.extent)
            }
            Element::Port { robot, port, .. } => {
                let declared = &self.automaton_of(robot).device.ports[port];
                (&declared.name, declared.extent.into())
            }
            Element::Cell { interface, cell, .. } => {
                let declared = &self.model.interface(interface).cells[cell];
                (&declared.name, declared.ty.extent)
            }
        }
    }

    /// The name of a value within its machine, such as `at_stop` or `wanted[pump]`.
    pub fn name_of(&self, element: Element) -> String {
        let (name, extent) = self.array_of(element);
        let (Element::Local { index, .. } | Element::Port { index, .. } | Element::Cell { index, .. }) =
            element;
        match extent {
            Extent::One => name.to_string(),
            Extent::Count(_) => format!("{name}[{index}]"),
            Extent::By(id) => format!("{name}[{}]", self.model.enums[id.0].members[index]),
        }
    }

    /// Where the trace of each machine begins, and its end: the state, the time in it, locals, cells, outputs, alarms.
    pub fn traces(&self) -> Vec<usize> {
        let mut begins = vec![0];
        for machine in 0..self.instances.len() {
            let automaton = self.automaton_of(machine);
            let cells = automaton.implements.iter().flat_map(|i| &self.model.interface(i.interface).cells);
            let types = automaton.locals.iter().map(|l| l.ty).chain(cells.map(|c| c.ty));
            let variables: usize = types.map(|ty| ty.scalar.words() * self.model.elements(ty.extent)).sum();
            let outputs = automaton.device.words(Direction::Output, self.kinds());
            begins.push(begins[machine] + 2 + variables + outputs + automaton.alarm_words());
        }
        begins
    }

    /// Inputs, outputs, locals and cells of a machine whose trace begins at this word.
    pub fn values_of(&self, machine: usize, trace: usize) -> Vec<Named> {
        let automaton = self.automaton_of(machine);
        let mut values = Values { system: self, named: Vec::new(), at: trace + 2 };
        for (local, declared) in automaton.locals.iter().enumerate() {
            let element = |index| Element::Local { robot: machine, local, index };
            values.variable(Group::Local, declared.ty, element);
        }
        for (implements, row) in automaton.implements.iter().zip(&self.instances[machine].rows) {
            let (interface, row) = (implements.interface, *row);
            for (cell, declared) in self.model.interface(interface).cells.iter().enumerate() {
                let element = |index| Element::Cell { interface, row, cell, index };
                values.variable(Group::Cell, declared.ty, element);
            }
        }
        let outputs = values.at;
        values.ports(machine, Direction::Output, Some(outputs));
        values.ports(machine, Direction::Input, None);
        values.named
    }
}

struct Values<'a> {
    system: &'a System,
    named: Vec<Named>,
    /// The next word of the trace.
    at: usize,
}

impl Values<'_> {
    fn variable(&mut self, group: Group, ty: Type, element: impl Fn(usize) -> Element) {
        for index in 0..self.system.model.elements(ty.extent) {
            let element = element(index);
            let name = self.system.name_of(element);
            let trace = Some(self.at);
            self.named.push(Named { name, element, ty: ty.scalar, group, image: None, trace });
            self.at += ty.scalar.words();
        }
    }

    /// The ports of a direction, with the place of the first one in the trace.
    fn ports(&mut self, machine: usize, direction: Direction, trace: Option<usize>) {
        let system = self.system;
        let group = match direction {
            Direction::Input => Group::Input,
            Direction::Output => Group::Output,
        };
        let mut word = 0;
        let ports = system.automaton_of(machine).device.ports.iter().enumerate();
        for (port, declared) in ports.filter(|(_, port)| port.direction == direction) {
            for index in 0..declared.extent.elements(system.kinds()) {
                let element = Element::Port { robot: machine, port, index };
                let name = system.name_of(element);
                let (ty, image) = (Scalar::from(declared.ty), Some(word));
                let trace = trace.map(|trace| trace + word);
                self.named.push(Named { name, element, ty, group, image, trace });
                word += ty.words();
            }
        }
    }
}
