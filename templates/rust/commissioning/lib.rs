//! The controllers of a line, linked with the simulator.

pub mod deployed;
pub mod replay;
