//! The compiler: layout and automata in, controllers out. Pure: nothing here reads or writes files.

#![deny(clippy::print_stderr, clippy::print_stdout)]

/// Test files that this crate shares with others name it so.
#[cfg(test)]
extern crate self as autogen;

pub mod backend;
pub mod check;
pub mod connect;
pub mod csv;
pub mod device;
pub mod diagnostic;
pub mod executor;
pub mod fault;
pub mod import;
pub mod interlock;
pub mod io_map;
pub mod ir;
pub mod layout;
pub mod library;
pub mod lint;
pub mod lower;
pub mod lsp;
pub mod naming;
pub mod overlap;
pub mod parallel;
pub mod plain;
pub mod reads;
pub mod scenario;
pub mod schema;
pub mod simulator;
pub mod source;
pub mod spec;
pub mod testing;
pub mod translation;
pub mod verify;
pub mod version;
pub mod why;
