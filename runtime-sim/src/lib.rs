//! Kinematic simulator of a factory line.
//!
//! Plain data and functions over it. It knows neither the compiler nor the
//! controllers it is linked with: the two meet in [`scan::Controllers`].
//! SI units, world frame (z up), unless a name says otherwise.
//!
//! It may be compiled in several pieces. So what is called in the loops of planner and collision check is `inline` where
//! it is small, and arrays are not mapped there: `map` calls its closure across pieces.

pub mod account;
mod answers;
pub mod carrier;
pub mod collision;
pub mod conservation;
pub mod device;
pub mod event;
mod fingerprint;
pub mod frame;
pub mod hash;
pub mod history;
mod image;
pub mod io_trace;
pub mod item;
mod json;
pub mod kinematics;
pub mod line;
pub mod machine;
pub mod memory;
pub mod monitor;
pub mod motion;
mod notes;
pub mod part;
pub mod path;
mod planner;
pub mod plant;
pub mod point;
pub mod random;
pub mod report;
pub mod run;
pub mod scan;
mod shortage;
pub mod solid;
mod system;
pub mod value;
pub mod wiring;
pub mod words;
