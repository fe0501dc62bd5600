//! Where a robot's tool is, and which joints bring it to a place.
//!
//! Trigonometry and roots come from `libm` or are exact IEEE operations, so that
//! every build computes the same bits.

pub mod arm;
pub mod cartesian;
pub mod facing;
pub mod fixed;
pub mod gantry;
pub mod links;
pub mod opw;
mod planar;
pub mod pose;
pub mod rail_arm;
pub mod riding;
mod room;
pub mod scara;
pub mod solver;
pub mod straight;
pub mod ur;
pub mod ur10;

#[cfg(test)]
pub(crate) mod random;
#[cfg(test)]
mod tests;

use std::f64::consts::{PI, TAU};

/// The same angle in (-pi, pi].
pub fn wrapped(angle: f64) -> f64 {
    let turned = angle - TAU * ((angle - PI) / TAU).ceil();
    if turned <= -PI { turned + TAU } else { turned.min(PI) }
}

/// The equivalent of `angle` nearest to `present`, whatever the limits of the joint.
pub fn nearest_equivalent(angle: f64, present: f64) -> f64 {
    present + wrapped(angle - present)
}

/// One turn and what rounding may have added, rad.
const MOST_TURN: f64 = TAU + 1e-9;

/// Among the equivalents of `angle` within one joint's limits (-2 pi to 2 pi) the one nearest to `present`.
pub fn nearest_turn(angle: f64, present: f64) -> f64 {
    let base = wrapped(angle);
    let distance = |candidate: f64| (candidate - present).abs();
    [base - TAU, base + TAU]
        .into_iter()
        .filter(|candidate| candidate.abs() <= MOST_TURN)
        .map(|candidate| candidate.clamp(-TAU, TAU))
        .fold(base, |best, candidate| if distance(candidate) < distance(best) { candidate } else { best })
}

/// Root of a difference that rounding may have brought below zero.
fn root(square: f64) -> f64 {
    square.max(0.0).sqrt()
}

fn is_finite(point: crate::point::Point) -> bool {
    point.x.is_finite() && point.y.is_finite() && point.z.is_finite()
}
