//! Automata by lot, as text of the language, so that the whole front end is in play.
//!
//! A system is some automata that share enumerations and interfaces, and several small layouts of them.
//! Automata that the checker refuses are left out and counted.

mod automaton;
mod expression;
mod guard;
mod layout;
mod lot;
mod property;
mod update;
mod world;
mod writer;

pub use lot::Lot;

use crate::trace;
use autogen::ir::System;
use autogen::source::Sources;
use autogen::spec::{ast, parser};
use std::collections::BTreeMap;
use world::World;

/// Automata of a layout, beside the anchor.
const AT_ONCE: usize = 4;

/// Automata that compile, and layouts of them that share a model.
pub struct Generated {
    pub text: String,
    pub sources: Sources,
    pub tree: ast::File,
    pub layouts: Vec<System>,
    pub automata: usize,
    /// Refused by the checker: how often each code.
    pub refused: BTreeMap<String, usize>,
    /// For each code a text that was refused, with what the checker said.
    pub examples: BTreeMap<String, String>,
}

/// A system of so many automata, and an anchor.
pub fn generate(seed: u64, automata: usize) -> Generated {
    let mut lot = Lot::new(seed);
    let world = World::new(&mut lot);
    let kinds = world.members("Kind").to_vec();
    let mut refused = BTreeMap::new();
    let mut examples = BTreeMap::new();
    let mut accepted = |lot: &mut Lot, before: &str, write: &dyn Fn(&mut Lot) -> String| loop {
        let text = write(lot);
        match trace::model(&format!("{before}{text}"), &kinds) {
            Ok(_) => return text,
            Err(found) => {
                let code = found.split(['[', ']']).nth(1).unwrap_or("?").to_string();
                *refused.entry(code.clone()).or_insert(0) += 1;
                examples.insert(code, format!("{text}\n{found}"));
            }
        }
    };
    let anchor = accepted(&mut lot, &world.text, &|lot| automaton::anchor(lot, &world));
    let shared = format!("{}{anchor}", world.text);
    let mut text = shared.clone();
    for number in 0..automata {
        let name = format!("A{number}");
        text += &accepted(&mut lot, &shared, &|lot| automaton::automaton(lot, &world, &name));
    }
    let (sources, model) = trace::model(&text, &kinds).expect("what was accepted one by one");
    let tree = parser::parse(Sources::default().add("spec.aut", text.as_str()), &text).0;
    let numbers: Vec<usize> = (0..model.automata.len()).collect();
    let (anchors, others): (Vec<usize>, Vec<usize>) =
        numbers.into_iter().partition(|n| model.automata[*n].name == "Anchor");
    let layouts = others.chunks(AT_ONCE).map(|some| {
        let automata: Vec<usize> = anchors.iter().chain(some).copied().collect();
        let layout = layout::layout(&mut lot, &model, &automata);
        trace::system(&layout, &model).unwrap_or_else(|e| panic!("{e}\n{layout}"))
    });
    let layouts = layouts.collect();
    Generated { text, sources, tree, layouts, automata: automata + 1, refused, examples }
}
