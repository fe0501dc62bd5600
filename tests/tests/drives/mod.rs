//! The reference blocks for drives, with the wiring of `docs/drives.md`, against models of the other side.

mod axis;
mod course;
mod inverter;
mod ledger;
mod program;
mod robot;
mod told;
mod wire;
