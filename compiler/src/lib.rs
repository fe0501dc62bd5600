//! The compiler: layout and automata in, controllers out. Pure: nothing here reads or writes files.

pub mod diagnostic;
pub mod layout;
pub mod scenario;
pub mod source;
