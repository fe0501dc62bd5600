//! How far the tool of an arm may go from a place, in any direction, until the arm loses it. The tool keeps its direction,
//! and the arm the way in which it bends.

use super::fixed::JOINTS;
use super::ur::Angles;
use std::f64::consts::{PI, TAU};

/// A length below this is none, m.
const NOTHING: f64 = 1e-9;

/// The wrist moves in a plane that turns about the first axis, `beside` it by so much; it is `ahead` of the axis, and may
/// go so far in the plane. How far the tool may go in space: to go past an axis beside which the plane lies, the plane has
/// to turn, and the way in it is longer than that of the tool. The same if `slack` is less than 0, m.
pub fn room(ahead: f64, beside: f64, slack: f64) -> f64 {
    if slack <= 0.0 || beside.abs() < NOTHING {
        return slack;
    }
    let (ahead, radius) = (ahead.abs(), libm::hypot(ahead, beside));
    // Within the circle about the axis there is no place at all.
    (radius - libm::hypot((ahead - slack).max(0.0), beside)).max(0.0)
}

/// Upper arm and forearm in the plane, for one way in which the arm bends. Angles are from straight ahead, upwards, rad.
pub struct Bent {
    /// Of the wrist from the first axis, seen from above, in the frame of the base: that of a vertical tool is the tool's.
    pub place: [f64; 2],
    /// Where the plane points, and how far it is beside the axis, to the left.
    pub first: f64,
    pub beside: f64,
    /// Of the wrist's place in the plane; less than 0 if the arm leans over its back.
    pub ahead: f64,
    pub lengths: [f64; 2],
    pub upper_arm: f64,
    pub forearm: f64,
    /// How much these turn with each joint while the tool keeps its direction: 1 or -1. The first and the sixth turn the
    /// plane, the third the forearm against the upper arm; one joint of the wrist the forearm.
    pub rates: Angles,
    /// Which joint of the wrist that is.
    pub wrist: usize,
}

impl Bent {
    /// Until a joint comes to its limit or the arm is stretched or folded, at least, m. `angles` are within `ranges`.
    pub fn room(&self, angles: &Angles, ranges: &[[f64; 2]; JOINTS]) -> f64 {
        let [long, short] = self.lengths;
        let wrist = add(along(self.upper_arm, long), along(self.forearm, short));
        let distance = libm::hypot(wrist[0], wrist[1]);
        let mut slack = (long + short - distance).min(distance - (long - short).abs());
        let bend = super::wrapped(self.forearm - self.upper_arm);
        let side = if bend < 0.0 { -1.0 } else { 1.0 };
        // The upper arm at its limit: the wrist is on a half circle about the elbow.
        for angle in self.limits(1, angles, ranges).map(|turn| self.upper_arm + turn) {
            slack = slack.min(from_half_circle(wrist, along(angle, long), short, angle, side));
        }
        // The forearm at its limit: on one about where the elbow would be if they were exchanged.
        for angle in self.limits(self.wrist, angles, ranges).map(|turn| self.forearm + turn) {
            slack = slack.min(from_half_circle(wrist, along(angle, short), long, angle, -side));
        }
        for limit in self.limits(2, angles, ranges).map(|turn| bend + turn) {
            // On the other side of the stretched or folded arm it bends the other way.
            if limit * side > 0.0 && limit * side < PI {
                let square = long * long + short * short + 2.0 * long * short * libm::cos(limit);
                slack = slack.min((distance - super::root(square)).abs());
            }
        }
        let turns = self.limits(0, angles, ranges).chain(self.limits(5, angles, ranges));
        let turned =
            turns.map(|turn| self.distance_of_plane(self.first + turn)).fold(f64::INFINITY, f64::min);
        room(self.ahead, self.beside, slack.max(0.0)).min(turned)
    }

    /// By how much what a joint turns can still be turned, one way and the other; nothing if the joint turns once or more.
    fn limits(
        &self,
        joint: usize,
        angles: &Angles,
        ranges: &[[f64; 2]; JOINTS],
    ) -> impl Iterator<Item = f64> {
        let [low, high] = ranges[joint];
        let (angle, rate) = (angles[joint], self.rates[joint]);
        (high - low < TAU).then_some([rate * (low - angle), rate * (high - angle)]).into_iter().flatten()
    }

    /// Distance of the wrist to the half of a plane in which it can be while that points there.
    fn distance_of_plane(&self, first: f64) -> f64 {
        let (sin, cos) = libm::sincos(first);
        let seen = [self.place[0] + self.beside * sin, self.place[1] - self.beside * cos];
        let side = if self.ahead < 0.0 { -1.0 } else { 1.0 };
        match side * (seen[0] * cos + seen[1] * sin) >= 0.0 {
            true => (seen[1] * cos - seen[0] * sin).abs(),
            false => libm::hypot(seen[0], seen[1]),
        }
    }
}

fn along(angle: f64, length: f64) -> [f64; 2] {
    let (sin, cos) = libm::sincos(angle);
    [length * cos, length * sin]
}

fn add(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0] + b[0], a[1] + b[1]]
}

/// Distance of a point to the half of a circle that is on the left (1) or on the right (-1) of the line through its middle
/// with this direction.
pub(super) fn from_half_circle(
    point: [f64; 2],
    middle: [f64; 2],
    radius: f64,
    direction: f64,
    side: f64,
) -> f64 {
    let [x, y] = [point[0] - middle[0], point[1] - middle[1]];
    let (sin, cos) = libm::sincos(direction);
    let (out, left) = (x * cos + y * sin, y * cos - x * sin);
    match left * side >= 0.0 {
        true => (libm::hypot(x, y) - radius).abs(),
        false => libm::hypot(out.abs() - radius, left),
    }
}
