//! One module for each command, and what they share.

pub mod build;
pub mod check;
pub mod commission;
pub mod explain;
pub mod graph;
pub mod load;
pub mod options;
pub mod print;
pub mod write;
