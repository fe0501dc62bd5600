//! An arm of six joints that stands where it is, its tool pointing down or to a side.

use super::arm::{Frames, Joints};
use super::facing::Facing;
use super::links::Link;
use super::opw::Opw;
use super::pose::Pose;
use super::room::room;
use super::solver::Solver;
use super::ur::{Angles, Lengths};
use super::{is_finite, nearest_turn, root};
use crate::frame::Frame;
use crate::point::Point;
use std::f64::consts::{FRAC_PI_2, PI, TAU};

pub const JOINTS: usize = 6;
/// The first joint of the wrist.
const WRIST: usize = 3;

/// More than a joint can go, rad.
const UNUSUAL: f64 = 4.0 * PI;

/// How Universal Robots draws it: upper arm up, forearm level, tool down.
const USUAL: Angles = [0.0, -FRAC_PI_2, FRAC_PI_2, -FRAC_PI_2, -FRAC_PI_2, 0.0];

/// The same with the tool away from the base.
const USUAL_HUNG: Angles = [0.0, -FRAC_PI_2, FRAC_PI_2, FRAC_PI_2, -FRAC_PI_2, 0.0];

/// The frame of the base is the maker's: z along the first joint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FixedArm {
    base: Frame,
    mounting: Mounting,
    geometry: Geometry,
    ranges: Option<[[f64; 2]; JOINTS]>,
}

/// How the base stands.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Mounting {
    #[default]
    Upright,
    /// Under a ceiling: turned about its x axis by half a turn.
    Hung,
}

impl Mounting {
    /// The frame of the maker in that of the mounting.
    fn pose(self) -> Pose {
        match self {
            Self::Upright => Pose::IDENTITY,
            Self::Hung => Facing::Down.pose(Point::default(), 1.0),
        }
    }
}

/// Links and joints, as far as the inverse kinematics has a closed form for them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Geometry {
    UniversalRobots(Lengths),
    OrthoParallel(Opw),
}

/// Joints for a place of the tool.
#[derive(Clone, Copy, Debug)]
struct Candidate {
    angles: Angles,
    is_usual: bool,
    /// By how much the limits of the joints forbid it: for each angle beyond its range, this angle times the distance of
    /// the tool from the joint; the greatest of these, m.
    beyond: f64,
}

impl FixedArm {
    /// `ranges` are the limits of the joints, rad; without them every joint turns once to either side.
    pub fn new(base: Frame, geometry: Geometry, ranges: Option<[[f64; 2]; JOINTS]>) -> Self {
        Self { base, mounting: Mounting::Upright, geometry, ranges }
    }

    /// The same arm, mounted otherwise.
    pub fn mounted(self, mounting: Mounting) -> Self {
        Self { mounting, ..self }
    }

    /// A place in the frame of the base.
    fn seen(&self, tool: Point) -> Point {
        self.mounting.pose().inverse().point(self.base.seen(tool))
    }

    /// The same direction in the frame in which the base stands.
    fn seen_facing(&self, facing: Facing) -> Facing {
        let seen =
            |x: f64, y: f64| Frame::new(Point::default(), -self.base.yaw).direction(Point::new(x, y, 0.0));
        match facing {
            Facing::Down => Facing::Down,
            Facing::Oriented { x, y } => {
                let Point { x, y, .. } = seen(x, y);
                Facing::Oriented { x, y }
            }
            Facing::Level { x, y } => {
                let Point { x, y, .. } = seen(x, y);
                Facing::Level { x, y }
            }
        }
    }

    /// The tool at a place, which is given in the frame of the base, as the direction is; `x` as in [`Facing::pose`].
    fn pointing(&self, seen: Point, facing: Facing, x: f64) -> Pose {
        let mounting = self.mounting.pose();
        mounting.inverse().then(&facing.pose(mounting.point(seen), x))
    }

    /// Limits of the joints, rad; none if each turns once to either side.
    pub fn ranges(&self) -> Option<&[[f64; 2]; JOINTS]> {
        self.ranges.as_ref()
    }

    pub fn base(&self) -> Pose {
        self.base.pose().then(&self.mounting.pose())
    }

    /// How far the tool may go from a place in any direction until the arm loses it, at least, while it points as it does;
    /// out of reach the distance of the wrist to what it reaches, negative, m. Where only limits of joints forbid the
    /// place: less than 0 by the angle that is lacking times the distance of the tool from this joint. If the tool points
    /// down, limits of all joints count; if it is level, those of the first three, and [`Self::wrist_room`] has the others.
    pub fn margin(&self, tool: Point, facing: Facing) -> f64 {
        if !is_finite(tool) {
            return f64::NEG_INFINITY;
        }
        let (seen, facing) = (self.seen(tool), self.seen_facing(facing));
        let pose = self.pointing(seen, facing, 1.0);
        let margin = match &self.geometry {
            Geometry::UniversalRobots(lengths) => margin(lengths, &pose, facing),
            Geometry::OrthoParallel(opw) => opw.margin(&pose),
        };
        let Some(ranges) = self.ranges.as_ref().filter(|_| margin >= 0.0) else { return margin };
        let found: Vec<Candidate> = self.candidates(seen, facing, &self.start()).collect();
        let least = found.iter().map(|found| found.beyond).fold(f64::INFINITY, f64::min);
        if least > 0.0 {
            return -least.min(self.longest());
        }
        let counted = match facing {
            Facing::Down | Facing::Oriented { .. } => *ranges,
            Facing::Level { .. } => {
                std::array::from_fn(|joint| if joint < WRIST { ranges[joint] } else { [-TAU, TAU] })
            }
        };
        let rooms = found.iter().filter(|found| found.beyond == 0.0).map(|found| {
            let bent = match &self.geometry {
                Geometry::UniversalRobots(lengths) => lengths.bent(&pose, &found.angles),
                Geometry::OrthoParallel(opw) => opw.bent(&pose, &found.angles),
            };
            bent.room(&found.angles, &counted)
        });
        rooms.fold(0.0, f64::max)
    }

    /// How far the fourth to the sixth joint are from their limits at a place, the nearest of them, rad; of several ways
    /// to reach the place the best one counts. None out of reach, and for an arm in which each of them turns once or more.
    pub fn wrist_room(&self, tool: Point, facing: Facing) -> Option<f64> {
        let ranges = self.ranges.as_ref()?;
        let limited: Vec<usize> =
            (WRIST..JOINTS).filter(|joint| ranges[*joint][1] - ranges[*joint][0] < TAU).collect();
        if limited.is_empty() || !is_finite(tool) {
            return None;
        }
        let start = self.start();
        let found = self.candidates(self.seen(tool), self.seen_facing(facing), &start);
        let rooms = found.filter(|found| found.beyond == 0.0).map(|found| {
            let room = |joint: &usize| {
                let ([low, high], angle) = (ranges[*joint], found.angles[*joint]);
                (angle - low).min(high - angle)
            };
            limited.iter().map(room).fold(f64::INFINITY, f64::min)
        });
        rooms.reduce(f64::max)
    }

    /// From the first joint to the tool at most, m.
    fn longest(&self) -> f64 {
        match &self.geometry {
            Geometry::UniversalRobots(Lengths { d1, a2, a3, d4, d5, tool }) => {
                [d1, a2, a3, d4, d5, tool].into_iter().map(|length| length.abs()).sum()
            }
            Geometry::OrthoParallel(Opw { a1, a2, b, c1, c2, c3, tool, .. }) => {
                [a1, a2, b, c1, c2, c3, tool].into_iter().map(|length| length.abs()).sum()
            }
        }
    }

    /// All joints that bring the tool, pointing there, to a place in the frame of the base, near `from`.
    fn candidates(&self, seen: Point, facing: Facing, from: &Angles) -> impl Iterator<Item = Candidate> {
        let solutions = facing.signs().iter().flat_map(move |&x| {
            let tool = self.pointing(seen, facing, x);
            match &self.geometry {
                Geometry::UniversalRobots(lengths) => {
                    let all = lengths.inverse(&tool).into_iter();
                    all.map(|angles| (angles, lengths.is_usual(&tool, &angles))).collect::<Vec<_>>()
                }
                Geometry::OrthoParallel(opw) => {
                    let all = opw.inverse(&tool).into_iter();
                    all.map(|solution| (solution.angles, solution.is_usual)).collect()
                }
            }
        });
        let from = *from;
        solutions.map(move |(angles, is_usual)| self.candidate(angles, is_usual, &from))
    }

    fn candidate(&self, angles: Angles, is_usual: bool, from: &Angles) -> Candidate {
        let Some(ranges) = &self.ranges else {
            let angles = std::array::from_fn(|joint| nearest_turn(angles[joint], from[joint]));
            return Candidate { angles, is_usual, beyond: 0.0 };
        };
        let near = std::array::from_fn(|joint| turn_within(angles[joint], ranges[joint], from[joint]));
        let frames = self.in_base(&near);
        let tool = frames[JOINTS - 1];
        let beyond = (0..JOINTS).map(|joint| {
            let [low, high] = ranges[joint];
            let lacks = (low - near[joint]).max(near[joint] - high);
            // A joint that turns the tool about its own axis moves nothing: it counts as a tenth of a metre.
            let reach = (frames[joint].position - tool.position).length().max(0.1);
            if lacks > ROUNDED { lacks * reach } else { 0.0 }
        });
        let beyond = beyond.fold(0.0, f64::max);
        let clamped = |joint: usize| near[joint].clamp(ranges[joint][0], ranges[joint][1]);
        let angles = if beyond > 0.0 { near } else { std::array::from_fn(clamped) };
        Candidate { angles, is_usual, beyond }
    }

    /// Joints that bring the tool, pointing there, to a place; some exactly when [`Self::margin`] is not negative. Pointing
    /// down its x lies along the base's x, one way or the other; level its x is vertical. Of the usual ways, with the elbow
    /// up and the arm over its front, else of all, the one on which the joint that goes farthest goes least.
    pub fn solve(&self, tool: Point, facing: Facing, from: &Angles) -> Option<Angles> {
        self.nearest(tool, facing, from, UNUSUAL)
    }

    /// [`Self::solve`], however the arm bends.
    pub fn solve_near(&self, tool: Point, facing: Facing, from: &Angles) -> Option<Angles> {
        self.nearest(tool, facing, from, 0.0)
    }

    /// An unusual way counts as if the joint that goes farthest went farther by this, rad.
    fn nearest(&self, tool: Point, facing: Facing, from: &Angles, unusual: f64) -> Option<Angles> {
        if self.margin(tool, facing) < 0.0 {
            return None;
        }
        let cost = |found: &Candidate| {
            let farthest = found.angles.iter().zip(from).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            if found.is_usual { farthest } else { farthest + unusual }
        };
        let found = self
            .candidates(self.seen(tool), self.seen_facing(facing), from)
            .filter(|found| found.beyond == 0.0);
        // Of equals the first.
        let best = found.reduce(|best, next| if cost(&next) < cost(&best) - 1e-9 { next } else { best });
        best.map(|found| found.angles)
    }

    fn in_base(&self, joints: &Angles) -> [Pose; JOINTS] {
        match &self.geometry {
            Geometry::UniversalRobots(lengths) => lengths.frames(joints),
            Geometry::OrthoParallel(opw) => opw.frames(joints),
        }
    }

    pub fn tool_pose(&self, joints: &Angles) -> Pose {
        let tool = match &self.geometry {
            Geometry::UniversalRobots(lengths) => lengths.forward(joints),
            Geometry::OrthoParallel(opw) => opw.forward(joints),
        };
        self.base().then(&tool)
    }

    pub fn frames(&self, joints: &Angles) -> [Pose; JOINTS] {
        let base = self.base();
        self.in_base(joints).map(|frame| base.then(&frame))
    }

    /// The joints, from the world on.
    pub fn links(&self) -> Vec<Link> {
        match &self.geometry {
            Geometry::UniversalRobots(lengths) => lengths.links(self.base()).into(),
            Geometry::OrthoParallel(opw) => opw.links(self.base()).into(),
        }
    }

    /// The joints, from a carriage on which the base stands at this frame.
    pub fn links_on(&self, mount: Frame) -> [Link; JOINTS] {
        let base = mount.pose().then(&self.mounting.pose());
        match &self.geometry {
            Geometry::UniversalRobots(lengths) => lengths.links(base),
            Geometry::OrthoParallel(opw) => opw.links(base),
        }
    }

    pub fn start(&self) -> Angles {
        match (&self.geometry, self.mounting) {
            (Geometry::UniversalRobots(_), Mounting::Upright) => USUAL,
            (Geometry::UniversalRobots(_), Mounting::Hung) => USUAL_HUNG,
            (Geometry::OrthoParallel(opw), Mounting::Upright) => opw.usual(FRAC_PI_2),
            (Geometry::OrthoParallel(opw), Mounting::Hung) => opw.usual(-FRAC_PI_2),
        }
    }
}

/// An angle beyond its range by less is rounding, rad.
pub(super) const ROUNDED: f64 = 1e-9;

/// Of the equivalents of an angle that are within a range the one nearest to `present`; if there is none, the one that
/// lacks least.
pub(super) fn turn_within(angle: f64, [low, high]: [f64; 2], present: f64) -> f64 {
    let lacks = |turn: f64| (low - turn).max(turn - high).max(ROUNDED);
    let turns = [angle, angle - TAU, angle + TAU, angle - 2.0 * TAU, angle + 2.0 * TAU];
    let cost = |turn: f64| (lacks(turn), (turn - present).abs());
    turns.into_iter().reduce(|best, next| if cost(next) < cost(best) { next } else { best }).unwrap_or(angle)
}

/// That of an arm of Universal Robots, the tool vertical or level in the frame of the base.
fn margin(lengths: &Lengths, tool: &Pose, facing: Facing) -> f64 {
    let Lengths { d1, a2, a3, d4, d5, .. } = *lengths;
    let wrist = lengths.wrist(tool);
    let from_axis = libm::hypot(wrist.x, wrist.y);
    if from_axis < d4.abs() {
        return from_axis - d4.abs();
    }
    let ahead = root((from_axis - d4) * (from_axis + d4));
    let height = wrist.z - d1;
    let (longest, shortest) = (a2.abs() + a3.abs(), (a2.abs() - a3.abs()).abs());
    let slack = |ahead: f64, height: f64| {
        let wrist = libm::hypot(ahead, height);
        (longest - wrist).min(wrist - shortest)
    };
    // The second link of the wrist is at right angles to the tool, in the plane of the arm.
    let [one, other] = match facing {
        Facing::Down | Facing::Oriented { .. } => [slack(ahead - d5, height), slack(ahead + d5, height)],
        Facing::Level { .. } => [slack(ahead, height - d5), slack(ahead, height + d5)],
    };
    room(ahead, d4, one.max(other))
}

impl Solver for FixedArm {
    fn margin_down(&self, tool: Point) -> f64 {
        FixedArm::margin(self, tool, Facing::Down)
    }

    fn solve_down(&self, tool: Point, from: &Joints) -> Option<Joints> {
        Solver::solve(self, tool, Facing::Down, from)
    }

    fn margin(&self, tool: Point, facing: Facing) -> f64 {
        FixedArm::margin(self, tool, facing)
    }

    fn solve(&self, tool: Point, facing: Facing, from: &Joints) -> Option<Joints> {
        FixedArm::solve(self, tool, facing, &from.array()).map(|joints| Joints::new(&joints))
    }

    fn solve_near(&self, tool: Point, facing: Facing, from: &Joints) -> Option<Joints> {
        FixedArm::solve_near(self, tool, facing, &from.array()).map(|joints| Joints::new(&joints))
    }

    fn tool_pose(&self, joints: &Joints) -> Pose {
        FixedArm::tool_pose(self, &joints.array())
    }

    fn frames(&self, joints: &Joints) -> Frames {
        Frames::of(FixedArm::frames(self, &joints.array()).into_iter())
    }

    fn links(&self) -> Vec<Link> {
        FixedArm::links(self)
    }

    fn start(&self) -> Joints {
        Joints::new(&FixedArm::start(self))
    }

    fn mount(&self) -> Pose {
        self.base()
    }

    fn standing(&self) -> Option<usize> {
        Some(0)
    }

    fn ranges(&self) -> Option<&[[f64; 2]]> {
        FixedArm::ranges(self).map(|ranges| &ranges[..])
    }

    fn wrist_room(&self, tool: Point, facing: Facing) -> Option<f64> {
        FixedArm::wrist_room(self, tool, facing)
    }
}

#[cfg(test)]
mod tests {
    use super::super::random::Random;
    use super::*;

    /// UR10e, lengths of the maker; finger tips 0.15 m from the flange.
    const UR10E: Lengths =
        Lengths { d1: 0.1807, a2: -0.6127, a3: -0.57155, d4: 0.17415, d5: 0.11985, tool: 0.11655 + 0.15 };

    #[test]
    fn what_is_in_reach_is_reached_and_nothing_else() {
        let mut random = Random::new(12);
        let base = Frame::new(Point::new(0.3, -0.2, 0.75), 30.0);
        let arm = FixedArm::new(base, Geometry::UniversalRobots(UR10E), None);
        let (mut reached, mut from) = (0, arm.start());
        for _ in 0..100_000 {
            let mut drawn = || random.between(-1.8, 1.8);
            let tool = Point::new(drawn(), drawn(), 0.5 + drawn());
            let found = arm.solve(tool, Facing::Down, &from);
            assert_eq!(found.is_some(), arm.margin(tool, Facing::Down) >= 0.0, "{tool:?}");
            let Some(joints) = found else { continue };
            let pose = arm.tool_pose(&joints);
            assert!((pose.position - tool).length() < 1e-6, "{tool:?} {joints:?}");
            assert!((pose.axis(2).z + 1.0).abs() < 1e-9, "{joints:?}");
            assert!(joints.iter().all(|joint| joint.abs() <= 2.0 * PI), "{joints:?}");
            (reached, from) = (reached + 1, joints);
        }
        assert!(reached > 15_000, "{reached}");
    }

    /// Away from the base, the elbow is above the line from the shoulder to the end of the forearm, on both sides of the base
    /// and under a ceiling.
    #[test]
    fn the_elbow_is_up_all_around() {
        let mut random = Random::new(15);
        let base = Frame::new(Point::new(0.3, -0.2, 0.75), 30.0);
        for (mounting, up) in [(Mounting::Upright, 1.0), (Mounting::Hung, -1.0)] {
            let arm = FixedArm::new(base, Geometry::UniversalRobots(UR10E), None).mounted(mounting);
            let (mut reached, mut from) = (0, arm.start());
            for i in 0..20_000 {
                let mut drawn = || random.between(-1.3, 1.3);
                let tool = Point::new(drawn(), drawn(), 0.75 + drawn());
                let turn = drawn();
                let facing =
                    if i % 3 == 0 { Facing::Level { x: turn.cos(), y: turn.sin() } } else { Facing::Down };
                let Some(joints) = arm.solve(tool, facing, &from) else { continue };
                let [shoulder, elbow, end, ..] = arm.frames(&joints).map(|frame| frame.position);
                let (line, bend) = (end - shoulder, elbow - shoulder);
                let off = bend - line.scaled(bend.dot(line) / line.dot(line));
                assert!(up * off.z >= -1e-9, "{mounting:?} {tool:?} {off:?}");
                (reached, from) = (reached + 1, joints);
            }
            assert!(reached > 3_000, "{reached}");
        }
    }

    /// The margin is that of the length of the links: it changes by no more than the tool goes.
    #[test]
    fn the_margin_changes_by_no_more_than_the_tool_goes() {
        let mut random = Random::new(13);
        let arm = FixedArm::new(Frame::default(), Geometry::UniversalRobots(UR10E), None);
        for _ in 0..100_000 {
            let mut drawn = || random.between(-1.8, 1.8);
            let (a, b) = (Point::new(drawn(), drawn(), drawn()), Point::new(drawn(), drawn(), drawn()));
            // Where the wrist is ahead of the axis, its distance is that of the tool.
            if libm::hypot(a.x, a.y) > 0.3 && libm::hypot(b.x, b.y) > 0.3 {
                let goes = (a - b).length();
                let stretched = 1.0 / (1.0 - (0.17415_f64 / 0.3).powi(2)).sqrt();
                assert!(
                    (arm.margin(a, Facing::Down) - arm.margin(b, Facing::Down)).abs()
                        <= stretched * goes + 1e-9,
                    "{a:?} {b:?}"
                );
            }
        }
    }

    const OPW: Opw = Opw {
        a1: 0.025,
        a2: -0.035,
        b: 0.0,
        c1: 0.400,
        c2: 0.315,
        c3: 0.365,
        tool: 0.180,
        offsets: [0.0, -FRAC_PI_2, 0.0, 0.0, 0.0, 0.0],
        signs: [-1.0, 1.0, 1.0, -1.0, 1.0, -1.0],
    };

    fn degrees(ranges: [[f64; 2]; 6]) -> Option<[[f64; 2]; 6]> {
        Some(ranges.map(|range| range.map(f64::to_radians)))
    }

    /// Limits of the maker, KUKA KR 6 R700 sixx.
    const KR6: [[f64; 2]; 6] =
        [[-170.0, 170.0], [-190.0, 45.0], [-120.0, 156.0], [-185.0, 185.0], [-120.0, 120.0], [-350.0, 350.0]];

    #[test]
    fn limits_of_joints_are_kept_and_only_they_forbid_places_in_reach() {
        let mut random = Random::new(14);
        let base = Frame::new(Point::new(0.3, -0.2, 0.4), 20.0);
        let geometry = Geometry::OrthoParallel(OPW);
        let (free, limited) =
            (FixedArm::new(base, geometry, None), FixedArm::new(base, geometry, degrees(KR6)));
        let (mut reached, mut forbidden, mut from) = (0, 0, limited.start());
        for _ in 0..50_000 {
            let mut drawn = || random.between(-0.9, 0.9);
            let tool = Point::new(0.3 + drawn(), drawn() - 0.2, 0.5 + drawn());
            let found = limited.solve(tool, Facing::Down, &from);
            assert_eq!(found.is_some(), limited.margin(tool, Facing::Down) >= 0.0, "{tool:?}");
            assert!(free.margin(tool, Facing::Down) >= limited.margin(tool, Facing::Down) - 1e-9);
            let Some(joints) = found else {
                forbidden += usize::from(free.margin(tool, Facing::Down) >= 0.0);
                continue;
            };
            let pose = limited.tool_pose(&joints);
            assert!((pose.position - tool).length() < 1e-6, "{tool:?} {joints:?}");
            assert!((pose.axis(2).z + 1.0).abs() < 1e-9, "{joints:?}");
            for (joint, [low, high]) in joints.iter().zip(KR6) {
                assert!((low.to_radians()..=high.to_radians()).contains(joint), "{joints:?}");
            }
            (reached, from) = (reached + 1, joints);
        }
        assert!(reached > 5_000 && forbidden > 500, "{reached} {forbidden}");
    }
}
