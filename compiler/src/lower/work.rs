//! How much a scan of a line, and its requirements, may have to do: by now it is known how many members roles have.

use crate::check::work::{MOST, Work};
use crate::diagnostic::Diagnostic;
use crate::ir::{AutomatonId, System};
use crate::source::Span;

/// Operations that the requirements of all machines may take together: a line is checked in time.
const MOST_REQUIRED: u64 = 10_000_000;

/// Whether that would take too long; it has been reported then.
pub fn is_too_much(system: &System, diagnostics: &mut Vec<Diagnostic>) -> bool {
    let before = diagnostics.len();
    for number in 0..system.model.automata.len() {
        diagnostics.extend(of_scans(system, AutomatonId(number)));
    }
    diagnostics.extend(of_requirements(system));
    diagnostics.len() > before
}

/// With the most members that the roles of any machine of this type have.
fn of_scans(system: &System, id: AutomatonId) -> Option<Diagnostic> {
    let automaton = system.model.automaton(id);
    let mut members = vec![0; automaton.roles.len()];
    for instance in system.instances.iter().filter(|instance| instance.automaton == id) {
        for (most, rows) in members.iter_mut().zip(&instance.roles) {
            *most = (*most).max(rows.len() as u64);
        }
    }
    let work = Work::new(&system.model, automaton, members.clone());
    let (place, operations) = work.of_scans().into_iter().max_by_key(|(_, operations)| *operations)?;
    (operations > MOST).then(|| {
        let roles = automaton.roles.iter().zip(&members);
        let roles: Vec<String> =
            roles.map(|(role, members)| format!("`{}` has {members}", role.name)).collect();
        too_much(place, "this could take too long for one scan of this line", operations, MOST)
            .note(format!("members of roles: {}", roles.join(", ")))
            .help("give roles a greatest number of members, or nest fewer of them")
    })
}

fn of_requirements(system: &System) -> Option<Diagnostic> {
    let mut all: u64 = 0;
    let mut most: Option<(Span, u64)> = None;
    for instance in &system.instances {
        let automaton = system.model.automaton(instance.automaton);
        if automaton.requires.is_empty() {
            continue;
        }
        let members = instance.roles.iter().map(|rows| rows.len() as u64).collect();
        let work = Work::new(&system.model, automaton, members);
        for require in &automaton.requires {
            let operations = work.of(&require.condition);
            all = all.saturating_add(operations);
            if most.is_none_or(|(_, most)| operations > most) {
                most = Some((require.place, operations));
            }
        }
    }
    let (place, operations) = most.filter(|_| all > MOST_REQUIRED)?;
    let diagnostic = too_much(place, "the requirements of all machines take too long", all, MOST_REQUIRED);
    Some(diagnostic.note(format!("this one takes {operations} for one machine")).help("nest fewer loops"))
}

fn too_much(place: Span, message: &str, operations: u64, most: u64) -> Diagnostic {
    let label = format!("up to {operations} operations, {most} are allowed");
    Diagnostic::new("E0320", place, message).label(label)
}
