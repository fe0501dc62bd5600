//! The simulator's source, carried by the binary and written beside the controllers.

/// Paths within the crate and texts.
pub const SOURCES: &[(&str, &str)] = include!(concat!(env!("OUT_DIR"), "/runtime_sim.rs"));

/// The crate's manifest outside of this project's workspace.
pub const MANIFEST: &str = include_str!("simulator/Cargo.toml");

/// The target for which the simulator was compiled, and for which the controllers have to be that it loads.
pub const TARGET: &str = env!("AUTOGEN_TARGET");
