//! A UR10 that stands on a rail: the kitting robot.

use super::arm::{self, Frames};
use super::links::Link;
use super::planar::{self, Wrist};
use super::pose::Pose;
use super::room::room;
use super::solver::Solver;
use super::ur10::{self, D1, D4};
use super::{is_finite, nearest_turn, root};
use crate::point::{Axis, Point};
use std::f64::consts::{FRAC_PI_2, PI};

/// Place on the rail (m, world frame), then the angles of the UR10 (rad), whose first is 0 when the arm points along x.
pub type Joints = [f64; JOINTS];
pub const JOINTS: usize = 7;

/// The wrist towards the rail comes first: it reaches further.
const WRISTS: [Wrist; 2] = [Wrist::Inside, Wrist::Outside];

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RailArm {
    rail: Axis,
    range: [f64; 2],
    /// Coordinate of the rail across its direction.
    line: f64,
    shoulder: f64,
}

/// A tool's place as seen from the rail.
struct View {
    along: f64,
    /// Signed: positive towards the higher coordinate.
    across: f64,
    dz: f64,
    /// Shortest and longest horizontal distance that places on the rail give.
    distance: [f64; 2],
}

impl RailArm {
    /// `pose` is a point of the rail, at the height of the shoulder; `range` goes along the rail, in the world.
    pub fn new(pose: Point, rail: Axis, range: [f64; 2]) -> Self {
        let line = match rail {
            Axis::X => pose.y,
            Axis::Y => pose.x,
        };
        Self { rail, range, line, shoulder: pose.z }
    }

    fn view(&self, tool: Point) -> View {
        let (along, other) = match self.rail {
            Axis::X => (tool.x, tool.y),
            Axis::Y => (tool.y, tool.x),
        };
        let across = other - self.line;
        let [low, high] = self.range;
        let nearest = along - along.clamp(low, high);
        let farthest = (along - low).abs().max((along - high).abs());
        let distance = [nearest, farthest].map(|dy| root(across * across + dy * dy));
        View { along, across, dz: planar::wrist_height(tool, self.shoulder), distance }
    }

    fn best(&self, view: &View) -> planar::Reach {
        let [low, high] = view.distance.map(|rho| root((rho - D4) * (rho + D4)));
        planar::best(low, high, view.dz, WRISTS)
    }

    /// How far the tool, pointing down, may go in any direction with the rail where it is best; out of reach the distance of
    /// the wrist to what it reaches, negative, m.
    pub fn margin(&self, tool: Point) -> f64 {
        if !is_finite(tool) {
            return f64::NEG_INFINITY;
        }
        let view = self.view(tool);
        if view.distance[1] < D4 {
            return view.distance[1] - D4;
        }
        let best = self.best(&view);
        room(best.u, D4, best.margin)
    }

    /// Joints that bring the tool, pointing down, to a place; some exactly when [`Self::margin`] is not negative.
    /// The arm stands square to the rail where it can; angles take the turn nearest to `from`.
    pub fn solve(&self, tool: Point, from: &Joints) -> Option<Joints> {
        if self.margin(tool) < 0.0 {
            return None;
        }
        let view = self.view(tool);
        let [low, high] = self.range;
        let square = (view.along - self.lead(view.across)).clamp(low, high);
        let ahead = self.ahead(&view, square);
        if let Some(wrist) = ahead.and_then(|u| planar::comfortable(u, view.dz, WRISTS)) {
            return Some(self.joints(&view, square, wrist, from));
        }
        let best = self.best(&view);
        let aside = root(best.u * best.u + D4 * D4 - view.across * view.across);
        let places = [view.along - aside, view.along + aside].map(|place| place.clamp(low, high));
        let miss = |place: f64| ((view.along - place).abs() - aside).abs();
        let [lower, upper] = places;
        let lower_first = match (miss(lower) < 1e-9, miss(upper) < 1e-9) {
            (true, true) => (lower - from[0]).abs() <= (upper - from[0]).abs(),
            _ => miss(lower) <= miss(upper),
        };
        Some(self.joints(&view, if lower_first { lower } else { upper }, best.wrist, from))
    }

    /// How much further along the rail the tool is than the base when the arm stands square to the rail.
    fn lead(&self, across: f64) -> f64 {
        let side = if across < 0.0 { -D4 } else { D4 };
        match self.rail {
            Axis::Y => side,
            Axis::X => -side,
        }
    }

    /// The tool's distance along the arm with the base at `place`; none where the tool is too near to the base's axis.
    fn ahead(&self, view: &View, place: f64) -> Option<f64> {
        let dy = view.along - place;
        let rest = view.across * view.across + dy * dy - D4 * D4;
        (rest >= 0.0).then(|| rest.sqrt())
    }

    fn joints(&self, view: &View, place: f64, wrist: Wrist, from: &Joints) -> Joints {
        let u = self.ahead(view, place).unwrap_or(0.0);
        let dy = view.along - place;
        let bearing = match self.rail {
            Axis::Y => libm::atan2(dy, view.across),
            Axis::X => libm::atan2(view.across, dy),
        };
        let pan = bearing - libm::atan2(D4, u);
        let links = planar::links(u, view.dz, wrist);
        let angles = [pan, links.lift, links.elbow, links.wrist_1, links.wrist_2, from[6]];
        std::array::from_fn(|i| match i {
            0 => place,
            _ => nearest_turn(angles[i - 1], from[i]),
        })
    }

    /// Pose of the tool, world frame.
    pub fn tool_pose(&self, joints: &Joints) -> Pose {
        let [_, angles @ ..] = joints;
        self.base(joints).then(&ur10::forward(angles))
    }

    /// Of each link behind a joint, world frame: the carriage with the arm's base, then [`ur10::frames`].
    pub fn frames(&self, joints: &Joints) -> Frames {
        let [_, angles @ ..] = joints;
        let base = self.base(joints);
        Frames::of([base].into_iter().chain(ur10::frames(angles).iter().map(|link| base.then(link))))
    }

    /// The joints, from the world on.
    pub fn links(&self) -> Vec<Link> {
        let rail = Pose { position: self.base_at(0.0), ..Pose::IDENTITY };
        let carriage = Link::slides(rail, self.rail, Pose::turned(Point::default(), PI));
        [carriage].into_iter().chain(ur10::LENGTHS.links(Pose::IDENTITY)).collect()
    }

    fn base(&self, joints: &Joints) -> Pose {
        // The description's base and the one of the link table differ by half a turn.
        Pose::turned(self.base_at(joints[0]), PI)
    }

    fn base_at(&self, place: f64) -> Point {
        let height = self.shoulder - D1;
        match self.rail {
            Axis::X => Point::new(place, self.line, height),
            Axis::Y => Point::new(self.line, place, height),
        }
    }

    pub fn tool(&self, joints: &Joints) -> Point {
        self.tool_pose(joints).position
    }

    /// A pose to start from: middle of the rail, the arm lifted on the side of the higher coordinate.
    /// (Start joints of the prototype's kitting robot, with the tool turned down.)
    pub fn start(&self) -> Joints {
        let middle = (self.range[0] + self.range[1]) / 2.0;
        let pan = match self.rail {
            Axis::X => FRAC_PI_2,
            Axis::Y => 0.0,
        };
        [middle, pan, -1.25, 1.74, -FRAC_PI_2 + 1.25 - 1.74, -FRAC_PI_2, 0.0]
    }
}

impl Solver for RailArm {
    fn margin_down(&self, tool: Point) -> f64 {
        RailArm::margin(self, tool)
    }

    fn solve_down(&self, tool: Point, from: &arm::Joints) -> Option<arm::Joints> {
        RailArm::solve(self, tool, &from.array()).map(|joints| arm::Joints::new(&joints))
    }

    fn tool_pose(&self, joints: &arm::Joints) -> Pose {
        RailArm::tool_pose(self, &joints.array())
    }

    fn frames(&self, joints: &arm::Joints) -> Frames {
        RailArm::frames(self, &joints.array())
    }

    fn links(&self) -> Vec<Link> {
        RailArm::links(self)
    }

    fn start(&self) -> arm::Joints {
        arm::Joints::new(&RailArm::start(self))
    }

    fn mount(&self) -> Pose {
        Pose::IDENTITY
    }

    fn standing(&self) -> Option<usize> {
        Some(1)
    }

    fn keeps_direction(&self) -> bool {
        true
    }
}
