//! Inputs that nobody would write: each is answered without a panic, and whatever is made of it is judged by
//! readers that know nothing of its writer. A violated property is a panic.
//!
//! Two drivers work on the same targets: `cargo test`, with fixed seeds, and libFuzzer, without end
//! (`docs/development.md`).

pub mod dictionary;
pub mod files;
mod judge;
pub mod memory;
pub mod mutation;
pub mod target;
mod tree;

pub use target::{Effort, Target};
