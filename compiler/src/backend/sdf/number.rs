//! Numbers as SDF writes them.

use runtime_sim::kinematics::pose::Pose;
use runtime_sim::point::Point;

/// Lengths and angles are written to so many decimals: a hair over what the arithmetic itself loses.
const DECIMALS: f64 = 1e12;

/// A length or an angle.
pub fn length(value: f64) -> String {
    let scaled = value * DECIMALS;
    // Beyond that there are no decimals left to round away.
    let rounded = if scaled.abs() < 9e15 { scaled.round() / DECIMALS } else { value };
    // Adding nothing turns -0 into 0.
    (rounded + 0.0).to_string()
}

/// A moment of inertia or a mass, to nine digits.
pub fn digits(value: f64) -> String {
    let rounded: f64 = format!("{value:.8e}").parse().unwrap_or(value);
    (rounded + 0.0).to_string()
}

pub fn list(values: &[f64]) -> String {
    values.iter().map(|value| length(*value)).collect::<Vec<_>>().join(" ")
}

pub fn point(point: Point) -> String {
    list(&[point.x, point.y, point.z])
}

/// Position, then roll, pitch and yaw.
pub fn pose(pose: &Pose) -> String {
    let Point { x, y, z } = pose.position;
    let [roll, pitch, yaw] = pose.roll_pitch_yaw();
    list(&[x, y, z, roll, pitch, yaw])
}
