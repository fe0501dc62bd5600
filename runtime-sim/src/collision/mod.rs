//! Contact of what moves with the machines and obstacles about it.
//!
//! Everything is made of simple solids ([`crate::solid`]): what the check does not report is free of contact as
//! far as these go. It is no safety function.
//!
//! Surfaces touch where parts are handed over, so a contact is more than touching: solids that go more than
//! [`SKIN`] into one another. All are therefore taken for that much smaller, half of it on each side of a pair.

pub mod distance;

pub(crate) mod body;
mod bounds;
mod check;
mod driven;
mod free;
mod group;
mod load;
mod movement;
mod pair;
mod paths;
pub mod range;
mod standing;
mod sweep;

pub(crate) use group::Boxes;

/// How far the joints of an arm can carry what is fixed to it.
pub(crate) mod reach {
    pub use super::body::Ball;
    pub use super::bounds::{Chain, Radii};
}

pub use bounds::BoundingBox;
pub use check::{CollisionCheck, Contact};
pub use driven::{DrivenThrough, driven_through};
pub use paths::{Moving, Path};
pub use standing::{Overlap, overlaps};
pub use sweep::Sweep;

/// Solids may go so far into one another, m.
pub const SKIN: f64 = 0.001;
/// Shrunk solids that are no farther apart than this are in contact, m.
pub const TOLERANCE: f64 = 5e-5;

/// What joints and places that are the same to a micrometre and a microradian can differ by at any point of two arms, m:
/// the sum of the radii of the joints of each is less than 12 m. It also holds what a microsecond makes, of what is not
/// faster than 10 m/s.
const UNCERTAIN: f64 = 5e-5;
