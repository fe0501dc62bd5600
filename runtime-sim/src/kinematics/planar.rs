//! The UR10 with its tool straight down, in the vertical plane of its links.
//!
//! `u` is the tool's distance from the shoulder's axis along the arm, outward
//! positive; `dz` is the wrist's height over the shoulder. The second wrist link
//! (d5) lies level, so the wrist is d5 further out or further in than the tool.

use super::root;
use super::ur10::{A2, A3, D5, TOOL};
use crate::point::Point;
use std::f64::consts::FRAC_PI_2;

/// Longest and shortest distance from the shoulder to the wrist.
const LONGEST: f64 = -A2 - A3;
const SHORTEST: f64 = A3 - A2;
/// A solution is comfortable if the wrist could go this much further out or in:
/// with the arm stretched, small motions of the tool are large ones of the elbow.
const COMFORT: f64 = 0.01;

/// Where the wrist is as seen from the tool.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Wrist {
    /// Nearer to the shoulder's axis; fifth joint at -pi/2.
    Inside,
    /// Further out; fifth joint at pi/2.
    Outside,
}

/// How best to have the tool within an interval of `u`.
#[derive(Clone, Copy, Debug)]
pub struct Reach {
    /// How far the wrist is from both limits, negative when beyond one, m.
    pub margin: f64,
    pub wrist: Wrist,
    pub u: f64,
}

/// Second to fifth joint of an arm whose base stands upright, and its first joint turned to the plane.
pub struct Links {
    pub lift: f64,
    pub elbow: f64,
    pub wrist_1: f64,
    pub wrist_2: f64,
}

impl Wrist {
    fn offset(self) -> f64 {
        match self {
            Wrist::Inside => -D5,
            Wrist::Outside => D5,
        }
    }

    /// The one with this fifth joint, rad.
    pub fn of_angle(angle: f64) -> Self {
        if libm::sin(angle) < 0.0 { Wrist::Inside } else { Wrist::Outside }
    }

    fn angle(self) -> f64 {
        match self {
            Wrist::Inside => -FRAC_PI_2,
            Wrist::Outside => FRAC_PI_2,
        }
    }
}

/// Height of the wrist over a shoulder at height `shoulder`, for a tool that points down.
pub fn wrist_height(tool: Point, shoulder: f64) -> f64 {
    tool.z + TOOL - shoulder
}

fn slack(w: f64) -> f64 {
    (LONGEST - w).min(w - SHORTEST)
}

fn distance(out: f64, dz: f64) -> f64 {
    root(out * out + dz * dz)
}

/// The tool's `u` with the most room to both limits, in the interval `low..=high`; at equal room the first of `wrists`.
pub fn best(low: f64, high: f64, dz: f64, wrists: [Wrist; 2]) -> Reach {
    let [first, second] = wrists.map(|wrist| best_with(low, high, dz, wrist));
    if second.margin > first.margin { second } else { first }
}

fn best_with(low: f64, high: f64, dz: f64, wrist: Wrist) -> Reach {
    let (inner, outer) = (low + wrist.offset(), high + wrist.offset());
    let near = if inner <= 0.0 && outer >= 0.0 { 0.0 } else { inner.abs().min(outer.abs()) };
    let far = inner.abs().max(outer.abs());
    let (shortest, longest) = (distance(near, dz), distance(far, dz));
    let w = ((LONGEST + SHORTEST) / 2.0).clamp(shortest, longest);
    let out = if w == shortest {
        near
    } else if w == longest {
        far
    } else {
        root(w * w - dz * dz)
    };
    let out = if out >= inner && out <= outer { out } else { (-out).clamp(inner, outer) };
    Reach { margin: slack(w), wrist, u: out - wrist.offset() }
}

/// The first of `wrists` with which `u` is reached with room to spare.
pub fn comfortable(u: f64, dz: f64, wrists: [Wrist; 2]) -> Option<Wrist> {
    wrists.into_iter().find(|wrist| slack(distance(u + wrist.offset(), dz)) >= COMFORT)
}

/// Whether the wrist can be where `u` asks for it.
pub fn reaches(u: f64, dz: f64, wrist: Wrist) -> bool {
    slack(distance(u + wrist.offset(), dz)) >= 0.0
}

/// Joints with the elbow up. The wrist must be in reach; what rounding puts beyond is taken for stretched or folded.
pub fn links(u: f64, dz: f64, wrist: Wrist) -> Links {
    let out = u + wrist.offset();
    let c3 = ((out * out + dz * dz - A2 * A2 - A3 * A3) / (2.0 * A2 * A3)).clamp(-1.0, 1.0);
    let s3 = root((1.0 - c3) * (1.0 + c3));
    let elbow = libm::atan2(s3, c3);
    let lift = libm::atan2(-dz, out) - libm::atan2(-A3 * s3, -A2 - A3 * c3);
    Links { lift, elbow, wrist_1: wrist.angle() - lift - elbow, wrist_2: wrist.angle() }
}
