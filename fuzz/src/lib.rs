//! Inputs that nobody would write: each is answered without a panic, and whatever is made of it is judged by
//! readers that know nothing of its writer. A violated property is a panic.
//!
//! Two drivers work on the same targets: `cargo test`, with fixed seeds, and libFuzzer, without end
//! (`docs/development.md`).

/// The modules of the command line as the binary has them: they are in no library, and only what reads
/// options is used here.
#[path = "../../compiler/src/command/mod.rs"]
#[allow(dead_code)]
mod command;
pub mod dictionary;
pub mod files;
mod judge;
pub mod memory;
pub mod mutation;
pub mod target;
mod tree;

pub use target::{Effort, Target};

/// What a command came to; the modules of the command line name it.
#[allow(dead_code)]
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Status {
    Done = 0,
    WrongInput = 1,
    WrongCommand = 2,
    NotReached = 3,
    Undecided = 4,
    Bug = 70,
}
