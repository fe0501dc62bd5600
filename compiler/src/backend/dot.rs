//! Graphs in the language of Graphviz: who hands over to whom, and the automata.

use super::Files;
use crate::ir::{Automaton, Model};
use crate::lower::Project;
use crate::naming::{self, Scope};
use runtime_sim::plant::By;
use std::collections::BTreeMap;
use std::fmt::Write;

/// Names of graphs that are not those of an automaton.
pub const CONNECTIVITY: &str = "connectivity";
pub const PLAN: &str = "plan";

/// `connectivity.dot`, and a file for each automaton.
pub fn files(project: &Project) -> Files {
    let system = &project.system;
    let mut files = Files::new();
    files.insert(format!("{CONNECTIVITY}.dot"), connectivity(project));
    for (automaton, name) in system.model.automata.iter().zip(names(&system.model)) {
        files.insert(format!("{name}.dot"), states(automaton));
    }
    files
}

/// Of the graph of each automaton: that of its file.
pub fn names(model: &Model) -> Vec<String> {
    let mut names = Scope::new(&[&[CONNECTIVITY, PLAN], naming::NO_FILES].concat());
    model.automata.iter().map(|automaton| names.take(naming::snake(&automaton.name))).collect()
}

fn connectivity(Project { system, edges, transfers, .. }: &Project) -> String {
    let mut text = String::from("digraph connectivity {\n    rankdir = LR;\n    node [shape = box];\n");
    for instance in &system.instances {
        let automaton = &system.model.automaton(instance.automaton).name;
        let _ = writeln!(
            text,
            "    {} [label = {}];",
            quoted(&instance.name),
            quoted(&format!("{}\n{automaton}", instance.name))
        );
    }
    for edge in edges {
        let (from, to) = (&system.instances[edge.from].name, &system.instances[edge.to].name);
        let _ = writeln!(text, "    {} -> {} [label = \"{:.3} m\"];", quoted(from), quoted(to), edge.margin);
    }
    let mut passages: BTreeMap<[usize; 2], bool> = BTreeMap::new();
    for transfer in transfers.iter().filter(|transfer| transfer.from.0 != transfer.to.0) {
        let falls = matches!(transfer.by, By::Fall);
        let ends = [transfer.from.0, transfer.to.0];
        passages.entry(ends).and_modify(|only_falls| *only_falls &= falls).or_insert(falls);
    }
    for (ends, only_falls) in passages {
        let label = if only_falls { "may fall" } else { "conveyor" };
        let [from, to] = ends.map(|machine| quoted(&system.instances[machine].name));
        let _ = writeln!(text, "    {from} -> {to} [label = \"{label}\", style = dashed];");
    }
    text + "}\n"
}

fn states(automaton: &Automaton) -> String {
    let mut text =
        format!("digraph {} {{\n    node [shape = box, style = rounded];\n", quoted(&automaton.name));
    for (i, state) in automaton.states.iter().enumerate() {
        let shape = match (i, state.is_final) {
            (0, _) => ", shape = point",
            (_, true) => ", peripheries = 2",
            _ => "",
        };
        let _ = writeln!(text, "    {} [label = {}{shape}];", quoted(&state.name), quoted(&state.name));
    }
    for state in &automaton.states {
        for transition in &state.transitions {
            let target = transition.target.map_or(&state.name, |t| &automaton.states[t.0].name);
            let _ = writeln!(
                text,
                "    {} -> {} [label = {}];",
                quoted(&state.name),
                quoted(target),
                quoted(&transition.text)
            );
        }
    }
    text + "}\n"
}

fn quoted(text: &str) -> String {
    format!("\"{}\"", text.replace('\\', "\\\\").replace('"', "\\\"").replace('\n', "\\n"))
}
