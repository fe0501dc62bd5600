//! How much a line may have of what each machine brings along.

use super::role::Line;
use crate::diagnostic::Diagnostic;
use crate::ir::{Automaton, Relation, RoleKind};
use crate::source::Span;

/// Values, states, words of alarms and members of roles that all machines have together, and the entries of the tables that say
/// from which machine items get to which: 10,000 machines of the library have about a third of it, 400 lines
/// beside one another too.
const MOST: usize = 3_000_000;

impl Line<'_> {
    /// Whether more than that would be written; it has been reported then.
    pub fn is_too_large(&mut self) -> bool {
        let of_type: Vec<usize> = self.model.automata.iter().map(|a| self.size_of(a)).collect();
        let sizes = (0..self.robots.len()).map(|robot| of_type[self.automaton_id(robot).0]);
        let Some((robot, largest)) = sizes.clone().enumerate().max_by_key(|(_, size)| *size) else {
            return false;
        };
        let pairs =
            |relation: &Relation| self.members[relation.from.0].len() * self.members[relation.to.0].len();
        let pairs: usize = self.model.relations.iter().map(pairs).sum();
        let all: usize = sizes.sum::<usize>() + pairs;
        if all > MOST {
            let name = &self.automaton(robot).name;
            let place = Span::new(self.layout.file, 0, 0);
            let message = format!(
                "the machines have more than {MOST} values, states, words of alarms, members of roles and pairs together"
            );
            self.diagnostics.push(
                Diagnostic::new("E0508", place, message)
                    .note(format!("they have {all}; each `{name}` has {largest}, `reaches` compares {pairs} pairs"))
                    .help("use smaller arrays, fewer states, roles with fewer members, or fewer machines; independent lines may each have a layout"),
            );
        }
        all > MOST
    }

    /// What one machine of a type has.
    fn size_of(&self, automaton: &Automaton) -> usize {
        let elements = |extent| self.model.elements(extent);
        let own = automaton.parameters.iter().map(|p| elements(p.ty.extent));
        let own = own.chain(automaton.locals.iter().map(|l| elements(l.ty.extent)));
        let shown = automaton.implements.iter().flat_map(|i| &self.model.interfaces[i.interface.0].cells);
        let shown = shown.map(|c| elements(c.ty.extent));
        let known = automaton.roles.iter().filter(|r| r.kind == RoleKind::Knows);
        let known = known.map(|r| self.members[r.interface.0].len());
        own.chain(shown).chain(known).sum::<usize>() + automaton.states.len() + automaton.alarm_words()
    }
}
