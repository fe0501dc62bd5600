//! The line as it is searched for executions that must not be.

mod automaton;
mod expression;
mod live;
mod memory;
mod model;
mod plant;
mod properties;
pub mod replay;
pub mod scenario;
pub mod story;

pub use model::model;
