//! What the numbers of states mean, for who shows them on a screen.

use super::context::Shared;
use super::screen::{Translate, Use};
use super::table::row;
use crate::ir::AutomatonId;

/// `states.csv`: a row for each state of each type that has robots, with its number in the output `state`.
pub fn table(shared: Shared, translate: &mut Translate) -> String {
    let mut text = row(&["type", "robots", "number", "state", "meaning"]);
    for (id, automaton) in shared.system.model.automata.iter().enumerate() {
        let robots: Vec<&str> = (shared.instances(AutomatonId(id)).iter())
            .map(|r| shared.system.instances[*r].name.as_str())
            .collect();
        if robots.is_empty() {
            continue;
        }
        for (number, state) in automaton.states.iter().enumerate() {
            let meaning = if number == 0 { "before the first step".into() } else { state.doc.join(" ") };
            let [name, meaning] =
                [translate(Use::State, &state.name), translate(Use::Meaning, meaning.trim())];
            text += &row(&[&automaton.name, &robots.join(" "), &number.to_string(), &name, &meaning]);
        }
    }
    text
}
