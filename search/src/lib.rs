//! Explicit-state search of a line: automata and what their devices may do, breadth first.
//!
//! A [`model::Model`] is the line; `docs/verify.md` says what one step is. Nothing here knows of layouts or texts.

mod act;
mod choice;
mod cut;
mod decision;
mod evaluate;
pub mod event;
mod expanded;
pub mod explore;
mod footprint;
mod hazard;
pub mod model;
pub mod occurred;
mod order;
pub mod plant;
mod possible;
mod postponed;
pub mod program;
pub mod promela;
pub mod property;
pub mod reached;
mod refinement;
mod remark;
mod representative;
mod scan;
pub mod start;
mod stop;
pub mod store;
pub mod story;
pub mod stroke;
pub mod successor;
mod surface;
pub mod unread;
pub mod value;
pub mod violation;

pub use scan::{Fired, Told};
