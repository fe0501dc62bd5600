//! How far the joints of an arm can carry what is fixed to its links.

use super::body::Ball;
use crate::kinematics::arm::{Arm, Frames, Joints, MOST_JOINTS};
use crate::machine::Machine;
use crate::point::{Axis, Point, greater, lesser};
use std::f64::consts::PI;

/// For each joint a bound on how far it moves any point of a body, for each metre or radian of its own travel.
pub type Radii = [f64; MOST_JOINTS];

/// What something is in, now or at any time, by two opposite corners.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct BoundingBox {
    low: Point,
    high: Point,
}

impl BoundingBox {
    #[inline]
    pub fn around(ball: &Ball) -> Self {
        let corner = Point::new(ball.radius, ball.radius, ball.radius);
        Self { low: ball.middle - corner, high: ball.middle + corner }
    }

    #[inline]
    pub fn with(&self, other: &BoundingBox) -> Self {
        Self {
            low: by_coordinate(other.low, self.low, lesser),
            high: by_coordinate(other.high, self.high, greater),
        }
    }

    /// That of nothing.
    pub const NOTHING: Self = Self {
        low: Point::new(f64::INFINITY, f64::INFINITY, f64::INFINITY),
        high: Point::new(f64::NEG_INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY),
    };

    /// From where to where along a horizontal axis, m.
    pub fn along(&self, axis: Axis) -> [f64; 2] {
        [self.low, self.high].map(|corner| corner.coordinate(axis))
    }

    /// Both opposite corners, the one with the least coordinates first.
    pub fn corners(&self) -> [Point; 2] {
        [self.low, self.high]
    }

    /// What is in both, of two that are not apart.
    pub fn common(&self, other: &BoundingBox) -> Self {
        Self {
            low: by_coordinate(other.low, self.low, greater),
            high: by_coordinate(other.high, self.high, lesser),
        }
    }

    /// m3
    pub fn volume(&self) -> f64 {
        let Point { x, y, z } = self.high - self.low;
        x * y * z
    }

    #[inline]
    pub fn between(low: Point, high: Point) -> Self {
        Self { low, high }
    }

    pub fn shifted(&self, offset: Point) -> Self {
        Self { low: self.low + offset, high: self.high + offset }
    }

    /// By so much on each side, m.
    #[inline]
    pub fn wider(&self, by: f64) -> Self {
        let corner = Point::new(by, by, by);
        Self { low: self.low - corner, high: self.high + corner }
    }

    /// A distance that nothing within the ball is nearer to it than, m; less than 0 if they meet.
    #[inline]
    pub fn gap(&self, ball: &Ball) -> f64 {
        self.square_gap(ball.middle).sqrt() - ball.radius
    }

    /// The square of the distance of a point, m2; 0 within.
    #[inline]
    pub fn square_gap(&self, point: Point) -> f64 {
        let outside = |at: f64, low: f64, high: f64| greater(greater(low - at, at - high), 0.0);
        let x = outside(point.x, self.low.x, self.high.x);
        let y = outside(point.y, self.low.y, self.high.y);
        let z = outside(point.z, self.low.z, self.high.z);
        x * x + y * y + z * z
    }

    #[inline]
    pub fn is_apart(&self, other: &BoundingBox) -> bool {
        let beyond = |low: Point, high: Point| low.x > high.x || low.y > high.y || low.z > high.z;
        beyond(self.low, other.high) || beyond(other.low, self.high)
    }
}

#[inline]
fn by_coordinate(a: Point, b: Point, rule: fn(f64, f64) -> f64) -> Point {
    Point::new(rule(a.x, b.x), rule(a.y, b.y), rule(a.z, b.z))
}

/// The chain of an arm's joints: distances that no motion changes.
#[derive(Clone, Debug)]
pub struct Chain {
    frames: Frames,
    /// For each joint that turns, a point on its axis, seen when all joints are at their start.
    pivots: Vec<Option<Point>>,
    /// For each joint that slides how far it goes from its start at most, m.
    strokes: [f64; MOST_JOINTS],
    /// The frames with the rails at their ends, such that these are corners of all places.
    ends: Vec<Frames>,
}

impl Chain {
    pub fn new(arm: &Arm, machine: &Machine) -> Self {
        let start = arm.start();
        let frames = arm.frames(&start);
        let at =
            |joint: usize, value: f64| arm.frames(&start.map(|i, q| if i == joint { q + value } else { q }));
        let pivots = (0..frames.len()).map(|joint| {
            let turned = at(joint, PI);
            let (here, there) = (frames[joint].position, turned[joint].position);
            let turns = frames[joint].rotation != turned[joint].rotation;
            // The origin behind a joint lies on its axis, or the origin before it does.
            let on_axis = (there - here).length() < 1e-9;
            turns.then(|| if on_axis { here } else { frames[joint - 1].position })
        });
        let mut strokes = [0.0; MOST_JOINTS];
        let axes = machine.axes();
        let of_axes = axes.iter().map_while(|axis| axis.range());
        let own = arm.ranges().unwrap_or_default().iter().copied();
        let ranges = of_axes.enumerate().chain(own.enumerate().map(|(i, range)| (axes.len() + i, range)));
        for (joint, [low, high]) in ranges {
            strokes[joint] = (high - start[joint]).max(start[joint] - low);
        }
        Self { pivots: pivots.collect(), frames, strokes, ends: ends(arm, machine, &start) }
    }

    /// The link that bears the tool.
    pub fn last(&self) -> usize {
        self.frames.len() - 1
    }

    /// For a body within `ball`, given in the frame of link `link`.
    pub fn radii(&self, link: usize, ball: &Ball) -> Radii {
        let mut radii = [0.0; MOST_JOINTS];
        let place = self.frames[link].point(ball.middle);
        let mut arm: Option<(Point, f64)> = None;
        let mut slid = 0.0;
        for joint in (0..=link).rev() {
            radii[joint] = match self.pivots[joint] {
                // What slides is farther from the joints before it then.
                None => {
                    arm = arm.map(|(from, beyond)| (from, beyond + self.strokes[joint]));
                    slid += self.strokes[joint];
                    1.0
                }
                Some(pivot) => {
                    let (from, beyond) = arm.unwrap_or((place, ball.radius + slid));
                    let length = (pivot - from).length() + beyond;
                    arm = Some((pivot, length));
                    length
                }
            };
        }
        radii
    }

    /// Where a body within `ball`, given in the frame of link `link`, can ever be.
    pub fn bounds(&self, link: usize, ball: &Ball) -> BoundingBox {
        let radii = self.radii(link, ball);
        let first = (0..=link).find_map(|joint| Some((joint, self.pivots[joint]?)));
        let boxes = self.ends.iter().map(|frames| match first {
            Some((joint, pivot)) => {
                let shift = frames[joint].position - self.frames[joint].position;
                BoundingBox::around(&Ball { middle: pivot + shift, radius: radii[joint] })
            }
            None => BoundingBox::around(&ball.within(&frames[link])),
        });
        boxes.reduce(|a, b| a.with(&b)).unwrap_or(BoundingBox::around(ball))
    }
}

fn ends(arm: &Arm, machine: &Machine, start: &Joints) -> Vec<Frames> {
    let ranges: Vec<[f64; 2]> = machine.axes().iter().map_while(|axis| axis.range()).collect();
    // Each bit of the number is an end of one axis.
    let at = |corner: usize| {
        let end = |i: usize| corner >> i & 1;
        arm.frames(&start.map(|i, value| ranges.get(i).map_or(value, |range| range[end(i)])))
    };
    (0..1 << ranges.len()).map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::frame::Frame;
    use crate::kinematics::random::Random;
    use crate::kinematics::scara::Arms;
    use crate::part::chain::{Chain as Joined, Geometry, Joint};

    /// A SCARA: its quill slides behind two joints that turn, and a joint turns behind the quill.
    fn scara() -> Arm {
        let joint = |name: &str| Joint {
            name: name.into(),
            link: name.into(),
            speed: 1.0,
            mass: 1.0,
            effort: 1.0,
            damping: 0.0,
            friction: 0.0,
        };
        let arms = Arms {
            lengths: [0.3, 0.2],
            tool: 0.1,
            ranges: [[-2.0, 2.0], [-2.5, 2.5], [-0.8, 0.4], [-PI, PI]],
        };
        let chain = Joined {
            on: None,
            base: Some(Frame::new(Point::new(1.0, -2.0, 0.9), 30.0)),
            mount: Frame::default(),
            mounting: Default::default(),
            geometry: Geometry::Scara(Box::new(arms)),
            rest: Point::default(),
            joints: ["a", "b", "c", "d"].map(joint).into(),
            acceleration: 1.0,
            envelope: None,
            clearances: Vec::new(),
        };
        Arm::new(&[], &chain).expect("a SCARA")
    }

    #[test]
    fn a_slide_behind_joints_that_turn_is_within_the_bounds() {
        let (arm, mut random) = (scara(), Random::new(7));
        let machine = Machine {
            name: "scara".into(),
            pose: Point::default(),
            parts: Vec::new(),
            wiring: Default::default(),
            states: Vec::new(),
            monitor: Default::default(),
            visits: None,
        };
        let chain = Chain::new(&arm, &machine);
        let ranges = arm.ranges().expect("limits").to_vec();
        for _ in 0..20_000 {
            let link = (random.between(0.0, 3.99)) as usize;
            let mut drawn = || random.between(-0.5, 0.5);
            // A point of a body that is within a ball about the origin of its link, far from its axis.
            let ball = Ball { middle: Point::new(drawn(), drawn(), drawn()), radius: 0.0 };
            let joints: Vec<f64> = ranges.iter().map(|[low, high]| random.between(*low, *high)).collect();
            let joints = Joints::new(&joints);
            let at = |joints: &Joints| arm.frames(joints)[link].point(ball.middle);
            let here = at(&joints);
            let bounds = chain.bounds(link, &ball).wider(1e-9);
            assert!(!bounds.is_apart(&BoundingBox::between(here, here)), "link {link}: {here:?} {bounds:?}");
            let radii = chain.radii(link, &ball);
            for (joint, radius) in radii.iter().enumerate().take(link + 1) {
                let by = 1e-3;
                let moved = at(&joints.map(|i, value| if i == joint { value + by } else { value }));
                assert!((moved - here).length() <= radius * by + 1e-12, "link {link}, joint {joint}");
            }
        }
    }
}
