//! An arm that was read from a file, whatever the format.

pub mod fit;

use fit::Fit;
use runtime_sim::frame::Frame;
use runtime_sim::kinematics::facing::Facing;
use runtime_sim::kinematics::fixed::{FixedArm, Geometry};
use runtime_sim::kinematics::opw::Opw;
use runtime_sim::kinematics::ur::Lengths;
use runtime_sim::point::Point;
use std::f64::consts::FRAC_PI_4;

#[derive(Debug)]
pub struct Arm {
    /// Name of the device.
    pub device: String,
    /// Its name in the file.
    pub title: String,
    pub file: String,
    /// What the file calls the end of the last joint.
    pub flange: String,
    pub fit: Fit,
    /// From the base to the flange; six, or none where the file says nothing of them.
    pub joints: Vec<Joint>,
    pub bodies: Vec<Body>,
    /// What the file lacks and what was made of it, for the user.
    pub notes: Vec<String>,
}

#[derive(Debug)]
pub struct Joint {
    pub name: String,
    pub link: String,
    /// rad
    pub range: Option<[f64; 2]>,
    /// rad/s
    pub speed: Option<f64>,
    /// kg
    pub mass: Option<f64>,
    /// N m
    pub effort: Option<f64>,
    /// N m s/rad
    pub damping: Option<f64>,
    /// N m
    pub friction: Option<f64>,
}

type Of = fn(&Joint) -> Option<f64>;

/// What a chain has for all its joints or for none, by the names of its settings.
pub const LISTS: [(&str, Of); 4] = [
    ("masses", |joint| joint.mass),
    ("efforts", |joint| joint.effort),
    ("damping", |joint| joint.damping),
    ("friction", |joint| joint.friction),
];

#[derive(Debug)]
pub struct Body {
    /// Of the link, in the file.
    pub link: String,
    /// Which frame of the chain it is on; none for what stands still.
    pub on: Option<usize>,
    pub form: Form,
}

/// In the frame that the body is on, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    Box {
        low: Point,
        high: Point,
    },
    /// From the first end of the segment along an axis of the frame: 0 is x.
    Capsule {
        from: Point,
        axis: usize,
        length: f64,
        radius: f64,
    },
}

impl Fit {
    /// The arm in the frame of its machine, with the flange as its tool.
    fn fixed(&self, joints: &[Joint]) -> FixedArm {
        let base = Frame::new(self.base, self.yaw.to_degrees());
        let ranges: Option<Vec<[f64; 2]>> = joints.iter().map(|joint| joint.range).collect();
        FixedArm::new(base, self.geometry, ranges.and_then(|ranges| ranges.try_into().ok()))
    }

    /// From the base to the flange at most, m.
    fn longest(&self) -> f64 {
        let lengths = match self.geometry {
            Geometry::OrthoParallel(Opw { a1, a2, b, c1, c2, c3, tool, .. }) => {
                vec![a1, a2, b, c1, c2, c3, tool]
            }
            Geometry::UniversalRobots(Lengths { d1, a2, a3, d4, d5, tool }) => vec![d1, a2, a3, d4, d5, tool],
        };
        lengths.into_iter().map(f64::abs).sum()
    }
}

/// A place of the flange for the start, in the frame of the machine, that the arm reaches with its tool pointing down: with
/// the upper arm up and the forearm level, or else, of many places on one side of it, the one with the greatest margin.
pub fn rest(arm: &Arm) -> Option<Point> {
    /// Bearings, distances and heights that are tried.
    const BEARINGS: usize = 8;
    const STEPS: usize = 12;
    let fixed = arm.fit.fixed(&arm.joints);
    let longest = arm.fit.longest();
    let reaches = |place: &Point| {
        fixed.margin(*place, Facing::Down) > 0.0
            && fixed.solve(*place, Facing::Down, &fixed.start()).is_some()
    };
    let usual = rounded(fixed.tool_pose(&fixed.start()).position);
    if reaches(&usual) {
        return Some(usual);
    }
    let ahead = usual - arm.fit.base;
    let ahead = ahead.y.atan2(ahead.x);
    let steps = |count: usize| (1..=count).map(move |i| i as f64 / count as f64);
    for bearing in (0..BEARINGS).map(|i| ahead + FRAC_PI_4 * i as f64) {
        let places = steps(STEPS).flat_map(|out| steps(STEPS).map(move |up| (out, up)));
        let tried = places.map(|(out, up)| {
            let (sin, cos) = bearing.sin_cos();
            let place = Point::new(out * longest * cos, out * longest * sin, (2.0 * up - 1.0) * longest);
            let place = rounded(arm.fit.base + place);
            (place, fixed.margin(place, Facing::Down))
        });
        let best = tried.reduce(|best, next| if next.1 > best.1 { next } else { best });
        if let Some((place, _)) = best.filter(|(place, _)| reaches(place)) {
            return Some(place);
        }
    }
    None
}

/// To the millimetre.
fn rounded(point: Point) -> Point {
    let round = |value: f64| (value * 1000.0).round() / 1000.0;
    Point::new(round(point.x), round(point.y), round(point.z))
}
