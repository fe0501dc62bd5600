//! The language of automata: text to tree. `docs/language.md` has the grammar.

pub mod ast;
pub mod format;
pub mod lexer;
pub mod parser;
pub(crate) mod written;
