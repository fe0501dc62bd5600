//! Kinematic simulator of a factory line.
//!
//! Plain data and functions over it. It knows neither the compiler nor the
//! controllers it is linked with: the two meet in [`scan::Controllers`].
//! SI units, world frame (z up), unless a name says otherwise.

pub mod device;
pub mod geometry;
pub mod kinematics;
pub mod motion;
pub mod point;
pub mod scan;
