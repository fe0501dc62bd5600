//! Inputs by choices: bytes choose what stands where, so each of them is a text of the grammar or nearly so.

pub mod command_line;
pub mod import;
mod json;
pub mod layout;
pub mod scenario;
pub mod specification;
pub mod table;
