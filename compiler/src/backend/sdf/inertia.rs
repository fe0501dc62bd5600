//! Mass, its centre and its moments, of a link whose solids all have the same density.

use super::number;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::point::Point;
use runtime_sim::solid::{Shape, Solid};
use std::f64::consts::PI;

/// As SDF writes it: moments about the centre, axes of the link.
pub struct Inertial {
    pub pose: String,
    pub mass: String,
    pub ixx: String,
    pub ixy: String,
    pub ixz: String,
    pub iyy: String,
    pub iyz: String,
    pub izz: String,
}

type Tensor = [[f64; 3]; 3];

/// Of a link without solids, a cube about its origin, m.
const UNKNOWN: Shape = Shape::Box { size: Point::new(0.1, 0.1, 0.1) };

/// `mass` in kg, spread evenly over the solids; where solids overlap it counts twice.
pub fn inertial(mass: f64, solids: &[Solid]) -> Inertial {
    let body = |shape: Shape, pose: &Pose| (volume(shape), turned(moments(shape), pose), pose.position);
    let mut bodies: Vec<(f64, Tensor, Point)> = solids.iter().map(|s| body(s.shape, &s.pose)).collect();
    if bodies.is_empty() {
        bodies.push(body(UNKNOWN, &Pose::IDENTITY));
    }
    let whole: f64 = bodies.iter().map(|(volume, ..)| volume).sum();
    let along = |coordinate: fn(&Point) -> f64| -> f64 {
        bodies.iter().map(|(volume, _, at)| volume * coordinate(at)).sum::<f64>() / whole
    };
    let centre = Point::new(along(|p| p.x), along(|p| p.y), along(|p| p.z));
    let mut sum: Tensor = [[0.0; 3]; 3];
    for (volume, moments, at) in &bodies {
        let d = *at - centre;
        let d = [d.x, d.y, d.z];
        let square: f64 = d.iter().map(|c| c * c).sum();
        for (i, row) in sum.iter_mut().enumerate() {
            for (j, value) in row.iter_mut().enumerate() {
                let shift = if i == j { square } else { 0.0 } - d[i] * d[j];
                *value += (moments[i][j] + volume * shift) * mass / whole;
            }
        }
    }
    Inertial {
        pose: number::pose(&Pose { position: centre, ..Pose::IDENTITY }),
        mass: number::digits(mass),
        ixx: number::digits(sum[0][0]),
        ixy: number::digits(sum[0][1]),
        ixz: number::digits(sum[0][2]),
        iyy: number::digits(sum[1][1]),
        iyz: number::digits(sum[1][2]),
        izz: number::digits(sum[2][2]),
    }
}

fn volume(shape: Shape) -> f64 {
    match shape {
        Shape::Box { size } => size.x * size.y * size.z,
        Shape::Capsule { length, radius } => cylinder(length, radius) + ball(radius),
    }
}

fn cylinder(length: f64, radius: f64) -> f64 {
    PI * radius * radius * length
}

fn ball(radius: f64) -> f64 {
    4.0 / 3.0 * PI * radius * radius * radius
}

/// Of the shape with density 1, about its own axes.
fn moments(shape: Shape) -> [f64; 3] {
    match shape {
        Shape::Box { size } => {
            let (xx, yy, zz) = (size.x * size.x, size.y * size.y, size.z * size.z);
            [yy + zz, xx + zz, xx + yy].map(|squares| volume(shape) / 12.0 * squares)
        }
        Shape::Capsule { length, radius } => {
            let (tube, ends) = (cylinder(length, radius), ball(radius));
            let (rr, ll) = (radius * radius, length * length);
            let across =
                tube * (ll / 12.0 + rr / 4.0) + ends * (0.4 * rr + ll / 4.0 + 3.0 / 8.0 * length * radius);
            [across, across, tube * rr / 2.0 + ends * 0.4 * rr]
        }
    }
}

/// From the shape's own axes to those of its link.
fn turned(moments: [f64; 3], pose: &Pose) -> Tensor {
    let r = &pose.rotation;
    std::array::from_fn(|i| {
        std::array::from_fn(|j| (0..3).map(|k| r[i][k] * moments[k] * r[j][k]).sum::<f64>())
    })
}
