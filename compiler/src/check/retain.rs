//! What of a machine outlasts a loss of power.

use super::context::{Context, Symbol};
use crate::diagnostic::{Diagnostic, suggestion};
use crate::spec::ast;
use runtime_sim::device::Direction;

impl Context<'_, '_> {
    pub(super) fn retain(&mut self, tree: &ast::Retain) {
        for (number, name) in tree.names.iter().enumerate() {
            if tree.names[..number].iter().any(|before| before.value == name.value) {
                self.report(
                    Diagnostic::new("E0301", name.span, format!("`{}` occurs here twice", name.value))
                        .help("remove one"),
                );
            }
            match name.value.as_str() {
                "all" => self.retain_all(),
                "state" => self.automaton.retained.state = true,
                _ => self.retain_one(name),
            }
        }
    }

    fn retain_all(&mut self) {
        let device = self.automaton.device.clone();
        let retained = &mut self.automaton.retained;
        retained.state = true;
        retained.locals.extend(0..self.automaton.locals.len());
        let cells = self.symbols.values().filter_map(|symbol| match symbol {
            Symbol::Cell(interface, cell) => Some((*interface, *cell)),
            _ => None,
        });
        retained.cells.extend(cells);
        retained.ports.extend((0..device.ports.len()).filter(|port| is_value(&device, *port)));
    }

    fn retain_one(&mut self, name: &ast::Name) {
        let device = self.automaton.device.clone();
        let symbol = self.symbols.get(&name.value);
        let what = match symbol {
            Some(symbol @ (Symbol::Local(_) | Symbol::Cell(..))) => {
                let symbol = *symbol;
                match symbol {
                    Symbol::Cell(interface, cell) => {
                        self.automaton.retained.cells.insert((interface, cell));
                    }
                    Symbol::Local(local) => {
                        self.automaton.retained.locals.insert(local);
                    }
                    _ => {}
                }
                return self.uses_symbol(&name.value, &symbol, name.span);
            }
            Some(Symbol::Port(port)) if is_value(&device, *port) => {
                let port = *port;
                self.automaton.retained.ports.insert(port);
                return self.uses_symbol(&name.value, &Symbol::Port(port), name.span);
            }
            Some(Symbol::Port(port)) if device.ports[*port].direction == Direction::Input => {
                "it is an input, which the device writes again"
            }
            Some(Symbol::Port(_)) => "it belongs to commands: retain `state`",
            Some(Symbol::Parameter(_) | Symbol::DeviceConstant(_)) => "the layout fixes it",
            Some(Symbol::Define(_)) => "it is evaluated where it is read",
            Some(Symbol::Role(_)) => "the layout fixes the members of a role",
            None if self.broken.contains(&name.value) => return,
            None => {
                let own = self.automaton.locals.iter().map(|local| local.name.as_str());
                let near = suggestion(&name.value, own);
                let help = near.map_or(
                    "retain `all`, `state`, locals, shared variables and outputs of the automaton".into(),
                    |near| format!("is `{near}` meant?"),
                );
                let message = format!("`{}` has no `{}`", self.automaton.name, name.value);
                return self.report(Diagnostic::new("E0337", name.span, message).help(help));
            }
        };
        self.report(
            Diagnostic::new("E0337", name.span, format!("`{}` cannot be retained: {what}", name.value))
                .help("remove it: `all`, `state`, locals, shared variables and outputs can be retained"),
        );
    }
}

/// An output that is not one of those that every device with commands has.
fn is_value(device: &crate::device::Device, port: usize) -> bool {
    let port = &device.ports[port];
    let is_head = device.is_commanded() && matches!(port.name.as_str(), "cmd" | "verb" | "hold");
    port.direction == Direction::Output && !is_head
}
