//! Automata. Those of an input stand above the library's, so one of the same name runs in the small line;
//! of each other one the line has a machine.

use super::Effort;
use super::line::{small, text};
use crate::judge;
use autogen::check;
use autogen::source::Sources;
use autogen::spec::{ast, parser};
use autogen::{library, naming};
use autogen_tests::Texts;
use std::collections::BTreeSet;
use std::sync::OnceLock;

/// Machines that a line gets beside those that it has.
const MOST_MACHINES: usize = 6;

pub fn answer(input: &[u8], effort: Effort) {
    let text = text(input);
    let mut sources = Sources::default();
    let file = sources.add("own.aut", text.as_str());
    let (tree, found) = parser::parse(file, &text);
    judge::diagnostics(&sources, &found, input, effort);
    let mut is_right = found.is_empty();
    let layout = small(&machines(&tree));
    if is_right && !is_of_library(&text) {
        let kinds = ["battery", "sensor", "regulator", "pump"].map(String::from);
        if let Err(found) = check::check(&sources, &[(file, tree)], Some(&kinds)) {
            assert!(!found.is_empty(), "refused without a word");
            judge::diagnostics(&sources, &found, input, effort);
            is_right = false;
        }
    }
    if effort.takes(input, if is_right { 1 } else { 64 }) {
        judge::line(&Texts { specs: vec![text], ..Texts::of_layout(layout) }, input, effort);
    }
}

/// Whether a text names a type of the library, without which it could not be checked.
fn is_of_library(text: &str) -> bool {
    static NAMES: OnceLock<BTreeSet<String>> = OnceLock::new();
    let names = NAMES.get_or_init(|| {
        let mut names = BTreeSet::new();
        for (name, text) in library::FILES {
            let tree = parser::parse(Sources::default().add(*name, *text), text).0;
            names.extend(tree.enums.into_iter().map(|e| e.name.value));
            names.extend(tree.interfaces.into_iter().map(|i| i.name.value));
            names.extend(tree.automata.into_iter().map(|a| a.name.value));
        }
        names
    });
    let is_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    text.split(|c| !is_word(c)).any(|word| names.contains(word))
}

/// A machine of each automaton, on its device, as a list that goes on.
fn machines(tree: &ast::File) -> String {
    let known = ["Conveyor", "Kitting", "Agv", "Gantry", "Station"];
    let own = tree.automata.iter().filter(|a| !known.contains(&a.name.value.as_str()));
    let machines = own.take(MOST_MACHINES).enumerate().map(|(number, automaton)| {
        let y = 0.7 * number as f64 - 2.0;
        let place = match automaton.device.value.as_str() {
            "belt" => format!(r#""pose": [1.5, {y}, 0], "orient": "y", "orient_range": [-9, 9]"#),
            "vehicle" => {
                format!(r#""pose": [-2.2, {y}, 0], "destinations": [[-5.6, {y}, 0], [-10.6, {y}, 0]]"#)
            }
            "rail_arm" => {
                format!(r#""pose": [-1.3, {y}, 1.127], "rail_dim": "y", "rail_range": [-4.8, 4.8]"#)
            }
            "gantry" => {
                let ranges = r#""x_rail_range": [-14.4, 0.4], "y_rail_range": [-4.5, 4.5]"#;
                format!(r#""pose": [-4, {y}, 2], {ranges}"#)
            }
            _ => format!(r#""pose": [-2.2, {y}, 0]"#),
        };
        let kind = naming::snake(&automaton.name.value);
        format!(
            ", {{\"name\": \"m{number}\", \"type\": \"{kind}\", {place}, \"parameters\": {{{}}}}}\n",
            parameters(automaton)
        )
    });
    machines.collect()
}

/// Values of the parameters that have no default.
fn parameters(automaton: &ast::Automaton) -> String {
    let missing = automaton.parameters.iter().filter(|p| p.default.is_none() && p.ty.extent.is_none());
    let values = missing.filter_map(|parameter| {
        let value = match &parameter.ty.scalar {
            ast::Scalar::Bool => "true",
            ast::Scalar::Int { .. } | ast::Scalar::Real | ast::Scalar::Time => "1",
            ast::Scalar::Point => "[0, 1, 1]",
            ast::Scalar::Named(_) => return None,
        };
        Some(format!("\"{}\": {value}", parameter.name.value))
    });
    values.collect::<Vec<_>>().join(", ")
}
