//! Device texts from files of other programs: arms from URDF and from OPW parameters, tracks of vehicles from LIF.
//!
//! What is written is an ordinary device text, which a person reads, completes and keeps.

mod arm;
pub mod lif;
pub mod opw;
mod text;
pub mod urdf;
mod xml;

use crate::diagnostic::Diagnostic;
use crate::layout::decode::make_identifier;
use crate::spec::parser::RESERVED;
use std::collections::{BTreeMap, BTreeSet};

/// A device text, and what the file lacks or what the language cannot say.
#[derive(Clone, Debug, PartialEq)]
pub struct Imported {
    pub text: String,
    /// Facts for the user, a line each; the text has them as comments too.
    pub notes: Vec<String>,
}

/// An error that ends the reading.
fn stop<T>(error: Diagnostic) -> Result<T, Box<Diagnostic>> {
    Err(error.into())
}

/// A name of the language that is as near to `name` as possible.
fn identifier(name: &str, otherwise: &str) -> String {
    let name = make_identifier(name, otherwise);
    match RESERVED.contains(&name.as_str()) {
        true => make_identifier(&format!("{otherwise}_{name}"), otherwise),
        false => name,
    }
}

/// The same names, where they are alike with numbers behind them.
fn distinct(names: Vec<String>) -> Vec<String> {
    let mut taken: BTreeSet<String> = BTreeSet::new();
    // The number from which one is sought, by name.
    let mut next: BTreeMap<String, u32> = BTreeMap::new();
    let one = |name: String| {
        let number = next.entry(name.to_ascii_lowercase()).or_insert(1);
        loop {
            let free = numbered(&name, *number);
            *number += 1;
            if taken.insert(free.to_ascii_lowercase()) {
                return free;
            }
        }
    };
    names.into_iter().map(one).collect()
}

/// The first one has no number.
fn numbered(name: &str, number: u32) -> String {
    if number == 1 {
        return name.into();
    }
    let end = format!("_{number}");
    let begin: String = name.chars().take(32 - end.len()).collect();
    format!("{}{end}", begin.trim_end_matches('_'))
}
