//! The controllers of a line, linked with the simulator.

pub mod adapters;
pub mod batch;
pub mod deployed;
pub mod image;
pub mod read;
pub mod replay;
pub mod trajectories;
