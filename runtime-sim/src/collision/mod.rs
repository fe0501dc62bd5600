//! Contact of what moves with what is in its way.

pub mod distance;
