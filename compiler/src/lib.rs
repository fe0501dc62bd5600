//! The compiler: layout and automata in, controllers out. Pure: nothing here reads or writes files.

pub mod connect;
pub mod diagnostic;
pub mod source;
