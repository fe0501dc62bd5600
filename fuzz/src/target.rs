//! What is fuzzed: a reader of inputs with all that is behind it.

mod command_line;
mod import;
mod layout;
mod line;
mod scenario;
mod specification;
mod table;

use crate::{dictionary, files, tree};
use arbitrary::Unstructured;

/// How much of an input is looked at.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effort {
    /// All that can be.
    Whole,
    /// What is dear only for some inputs, which the input itself decides.
    Sampled,
    /// For far fewer, as it is right for millions of inputs.
    Rare,
}

impl Effort {
    /// Whether to do what pays for one in so many inputs.
    pub(crate) fn takes(self, input: &[u8], one_in: u64) -> bool {
        match self {
            Effort::Whole => true,
            Effort::Sampled => files::hash(input).is_multiple_of(one_in),
            Effort::Rare => files::hash(input).is_multiple_of(8 * one_in),
        }
    }
}

/// A reader of inputs.
pub struct Target {
    /// Also of its folders of corpus and findings.
    pub name: &'static str,
    /// Answers an input and judges the answer; a panic is a finding.
    pub answer: fn(&[u8], Effort),
    /// Words of its grammar.
    pub words: fn() -> Vec<String>,
    /// An input by choices, nearer to the grammar than mutation comes.
    pub tree: fn(&mut Unstructured) -> arbitrary::Result<String>,
}

pub static ALL: [Target; 6] = [
    Target { name: "layout", answer: layout::answer, words: dictionary::layout, tree: tree::layout::layout },
    Target {
        name: "specification",
        answer: specification::answer,
        words: dictionary::specification,
        tree: tree::specification::specification,
    },
    Target {
        name: "scenario",
        answer: scenario::answer,
        words: dictionary::scenario,
        tree: tree::scenario::scenario,
    },
    Target { name: "table", answer: table::answer, words: dictionary::table, tree: tree::table::table },
    Target {
        name: "command_line",
        answer: command_line::answer,
        words: dictionary::command_line,
        tree: tree::command_line::command_line,
    },
    Target { name: "import", answer: import::answer, words: dictionary::import, tree: tree::import::import },
];

impl Target {
    pub fn find(name: &str) -> Option<&'static Target> {
        ALL.iter().find(|target| target.name == name)
    }

    /// Inputs to begin with: those of its folders, examples and fixtures.
    pub fn seeds(&self) -> Vec<Vec<u8>> {
        files::seeds(self.name)
    }
}
