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
    let mut taken: Vec<String> = Vec::new();
    for name in names {
        let numbered = (2..).map(|number| {
            let end = format!("_{number}");
            let begin: String = name.chars().take(32 - end.len()).collect();
            format!("{}{end}", begin.trim_end_matches('_'))
        });
        let is_free = |name: &String| !taken.iter().any(|other| other.eq_ignore_ascii_case(name));
        let free = std::iter::once(name.clone()).chain(numbered).find(is_free);
        taken.extend(free);
    }
    taken
}
