//! The method of a state: its transitions, tested in order.

use super::context::Context;
use super::doc::documented;
use super::format::comment;
use super::walk::Uses;
use crate::ir::{Clause, State, Transition, UpdateKind};
use crate::reads::{Gate, Reads, Whose};

/// Methods of one state.
pub struct Methods {
    /// The arm of `match self.state`.
    pub arm: String,
    /// The method of the state, and those that choose for its transitions.
    pub text: String,
    pub uses: Uses,
    pub commands: bool,
}

impl Context<'_> {
    pub fn state(&self, number: usize) -> Methods {
        let state = &self.automaton().states[number];
        let names = self.own();
        let variant = &names.states[number];
        let uses = self.state_uses(state);
        if state.transitions.is_empty() && state.within.is_none() {
            return Methods {
                arm: format!("State::{variant} => Ok(()),"),
                text: String::new(),
                uses,
                commands: false,
            };
        }
        let method = &names.methods[number];
        let end = state.within.as_ref().map_or_else(
            || "Ok(())".to_string(),
            |(longest, fault)| {
                let within = format!("within(self.elapsed, {}, {})", self.expr(longest), self.fault(*fault));
                match self.automaton().modes {
                    Some(_) => format!("if self.is_single() {{ Ok(()) }} else {{ {within} }}"),
                    None => within,
                }
            },
        );
        let mut body = String::new();
        let mut choices = String::new();
        let mut always = false;
        let mut commands = false;
        for (i, transition) in state.transitions.iter().enumerate() {
            let test = self.test(transition, &names.choices[number][i]);
            if let Some(choice) = test.method {
                choices += &format!(
                    "/// What the transition at {} chooses.\n{choice}\n",
                    documented(&self.line(transition.place))
                );
            }
            commands |= gives_command(transition);
            body += &comment(&self.title(number, i));
            let mut block: String = transition.updates.iter().map(|u| self.update(u)).collect();
            let target = transition.target.map(|t| &names.states[t.0]);
            if let Some(target) = target {
                block += &format!("self.enter(State::{target});");
            }
            let result = if target.is_some() { "Ok(())" } else { end.as_str() };
            let Some(condition) = test.condition else {
                body += &block;
                body += result;
                always = true;
                break;
            };
            // The last one may run on into the end of the method.
            let is_last = i + 1 == state.transitions.len() && result == end && !block.is_empty();
            let leave = if is_last { String::new() } else { format!("return {result};") };
            body += &format!("if {condition} {{ {block} {leave} }}\n");
        }
        if !always {
            body += &end;
        }
        let parameters = self.parameters(&uses);
        let separator = if parameters.is_empty() { "" } else { ", " };
        let title = if number == 0 {
            "/// The first step.\n".to_string()
        } else {
            format!("/// A step in [`State::{variant}`].\n{}", self.reads(state))
        };
        Methods {
            arm: format!("State::{variant} => self.{method}({}),", self.arguments(&uses)),
            text: format!(
                "{title}fn {method}(&mut self{separator}{parameters}) -> Result<(), Fault> {{ {body} }}\n{choices}"
            ),
            uses,
            commands,
        }
    }

    /// What has to change before a guard can begin to hold, as lines of documentation; nothing if one always holds.
    fn reads(&self, state: &State) -> String {
        if state.transitions.iter().any(Transition::is_unconditional) {
            return String::new();
        }
        let (automaton, model) = (self.automaton(), &self.system.model);
        let reads = Reads::of_state(automaton, state);
        let inputs = reads.inputs.iter().map(|port| format!("`{}`", automaton.device.ports[*port].name));
        let port = |port: usize| format!("`{}`", automaton.device.ports[port].name);
        let inputs_while = reads.inputs_while().map(|(number, gates)| {
            let gates = gates.iter().map(|Gate { port: gate, is }| format!("{} is {is}", port(*gate)));
            format!("{} while {}", port(number), gates.collect::<Vec<_>>().join(" and "))
        });
        let cells = reads.cells.iter().map(|cell| {
            let interface = model.interface(cell.interface);
            let of = if cell.of == Whose::Own { "" } else { " of others" };
            format!("`{}.{}`{of}", interface.name, interface.cells[cell.cell].name)
        });
        let timer = (!reads.timers.is_empty()).then(|| "the time in it".to_string());
        let all: Vec<String> = inputs.chain(inputs_while).chain(cells).chain(timer).collect();
        let text =
            if all.is_empty() { "Reads nothing.".into() } else { format!("Reads {}.", all.join(", ")) };
        format!("///\n/// {text}\n")
    }

    /// `agv.aut:12: when done -> Dropping`
    fn title(&self, state: usize, transition: usize) -> String {
        let automaton = self.automaton();
        let transition = &automaton.states[state].transitions[transition];
        let target =
            transition.target.map(|t| format!(" -> {}", automaton.states[t.0].name)).unwrap_or_default();
        format!("{}: {}{target}", self.line(transition.place), transition.title())
    }

    fn state_uses(&self, state: &State) -> Uses {
        let mut uses = Uses::default();
        for transition in &state.transitions {
            uses.join(Uses::of_transition(self.automaton(), transition));
            if self.conditions(&transition.clauses).is_empty() && is_plain(transition) {
                break;
            }
        }
        if let Some((longest, _)) = &state.within {
            uses.expr(self.automaton(), longest);
        }
        uses
    }
}

fn is_plain(transition: &Transition) -> bool {
    transition.clauses.iter().all(|c| matches!(c, Clause::Condition(_)))
}

fn gives_command(transition: &Transition) -> bool {
    transition.updates.iter().any(|u| matches!(u.kind, UpdateKind::Command { .. }))
}
