//! Judges and runs Structured Text.
//!
//! Written from the rules of IEC 61131-3 and of the portable core (what six real
//! compilers accept and run alike), never from the emitter whose text it judges:
//! the two share no code.

pub mod check;
pub mod dead;
pub mod faults;
pub mod finding;
mod literal;
pub mod machine;
pub mod parse;
mod read;
mod reserved;
pub mod scl;
mod standard;
pub mod structured;
pub mod types;
pub mod view;

use check::Checked;
use finding::Finding;

/// The checked text, or all that is wrong with it.
pub fn judge(source: &str) -> Result<Checked, Vec<Finding>> {
    let tree = parse::parse(source)?;
    let (text, findings) = read::read(&tree, source);
    check::check(text, findings)
}

/// Findings with their places, one on a line.
pub fn listed(findings: &[Finding], source: &str) -> String {
    findings.iter().map(|f| f.located(source) + "\n").collect()
}
