//! Constants that say what the program was made from: a screen shows them, and somebody compares.

use super::code::Ex;
use super::context::Shared;
use super::declaration::{Basic, Variable};
use crate::version;

pub fn globals(shared: Shared) -> [Variable; 2] {
    let constant = |name: &str, value: i32, about: &str| {
        Variable::new(name, Basic::Dint).with_initial(Ex::Int(value)).with_comment(about)
    };
    [
        constant("tool_version", version::number(), "version of autogen: 10203 is 1.2.3"),
        constant(
            "program_hash",
            shared.sources.hash(),
            "of the files that the program was made from: program_hash in manifest.json",
        ),
    ]
}
