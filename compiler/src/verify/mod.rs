//! The line as it is searched for executions that must not be.

mod asked;
mod automaton;
mod contract;
mod expression;
mod fed;
mod followed;
pub mod gantt;
mod live;
mod memory;
mod model;
mod never;
mod plant;
mod properties;
mod put_out;
pub mod replay;
pub mod scenario;
mod situation;
pub mod story;
mod strokes;
pub mod under_way;
mod unread;
mod unsearched;

pub use asked::{Asked, Remembered, Warnings};
pub use model::{Searched, model};
pub use never::Never;
pub use properties::Skipped;
