//! A UR10 that hangs sideways from a torso which travels on two rails and turns.

use super::arm::{self, Frames, TORSO};
use super::links::Link;
pub use super::planar::Wrist;
use super::planar::{self, Links};
use super::pose::Pose;
use super::room::room;
use super::solver::Solver;
use super::ur10::{self, D1, D4};
use super::{is_finite, nearest_turn, root};
use crate::point::{Axis, Point};
use std::f64::consts::{FRAC_PI_2, PI, TAU};

/// Torso on both rails (m, world frame), its turn (0: the arm is mounted on the side of +y), then the angles of the UR10 (rad).
pub type Joints = [f64; JOINTS];
pub const JOINTS: usize = 9;

/// From the torso's axis to the arm's base (`gantry.urdf.xacro`: mounted at 0.51 m).
const OUTREACH: f64 = 0.51;
/// The arm's base in the torso's frame (x outward): its axes point up, to the right, and outward.
pub const MOUNT: Pose = Pose {
    rotation: [[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]],
    position: Point::new(OUTREACH, 0.0, 0.0),
};
/// From the torso's axis to the arm's shoulder.
const SHOULDER: f64 = OUTREACH + D1;
/// The wrist outside comes first, as in the prototype.
const WRISTS: [Wrist; 2] = [Wrist::Outside, Wrist::Inside];
/// A tool is in the plane of the arm that stands if it is not farther from it than this, m.
const STANDS: f64 = 1e-6;
/// Turns tried on either side of the present one when the torso must turn: steps of 15 degrees.
const TURN_STEPS: i32 = 12;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gantry {
    x: [f64; 2],
    y: [f64; 2],
    shoulder: f64,
}

/// How the robot stands while its tool is somewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stance {
    /// Of the torso, rad.
    pub turn: f64,
    /// How far the tool is beyond the shoulder, m.
    pub beyond: f64,
    pub wrist: Wrist,
}

/// A tool's place as seen from all places of the torso.
struct View {
    tool: Point,
    dz: f64,
    /// Nearest and farthest place of the torso, and their distances from the tool.
    ends: [Point; 2],
    distance: [f64; 2],
}

impl Gantry {
    /// `pose.z` is the height of the shoulder; the ranges are those of the torso's axis in the world.
    pub fn new(pose: Point, x_range: [f64; 2], y_range: [f64; 2]) -> Self {
        Self { x: x_range, y: y_range, shoulder: pose.z }
    }

    fn view(&self, tool: Point) -> View {
        let far_end = |[low, high]: [f64; 2], t: f64| if t - low > high - t { low } else { high };
        let nearest = Point::new(tool.x.clamp(self.x[0], self.x[1]), tool.y.clamp(self.y[0], self.y[1]), 0.0);
        let farthest = Point::new(far_end(self.x, tool.x), far_end(self.y, tool.y), 0.0);
        let ends = [nearest, farthest];
        let distance = ends.map(|end| level_distance(tool, end));
        View { tool, dz: planar::wrist_height(tool, self.shoulder), ends, distance }
    }

    fn best(&self, view: &View) -> planar::Reach {
        let [low, high] = view.distance.map(|rho| root((rho - D4) * (rho + D4)) - SHOULDER);
        planar::best(low, high, view.dz, WRISTS)
    }

    /// How far the tool, pointing down ahead of the torso's axis, may go in any direction with the torso where it is best;
    /// out of reach the distance of the wrist to what it reaches, negative, m.
    pub fn margin(&self, tool: Point) -> f64 {
        if !is_finite(tool) {
            return f64::NEG_INFINITY;
        }
        let view = self.view(tool);
        if view.distance[1] < D4 {
            return view.distance[1] - D4;
        }
        let best = self.best(&view);
        room(best.u + SHOULDER, D4, best.margin)
    }

    /// Joints that bring the tool, pointing down, to a place; some exactly when [`Self::margin`] is not negative.
    /// The torso is at rest if that suffices. Else the tool is under the shoulder where it can be, and the torso
    /// keeps its turn where it can.
    pub fn solve(&self, tool: Point, from: &Joints) -> Option<Joints> {
        if self.margin(tool) < 0.0 {
            return None;
        }
        if let Some(joints) = self.solve_standing(tool, from) {
            return Some(joints);
        }
        let view = self.view(tool);
        if let Some(wrist) = planar::comfortable(0.0, view.dz, WRISTS)
            && let Some((x, y)) = self.torso(&view, SHOULDER, from[2])
        {
            return Some(self.joints(&view, (x, y), wrist, from));
        }
        let best = self.best(&view);
        let ahead = (best.u + SHOULDER).max(0.0);
        let place =
            self.torso(&view, ahead, from[2]).unwrap_or_else(|| self.between(&view, level_radius(ahead)));
        Some(self.joints(&view, place, best.wrist, from))
    }

    /// Joints for a tool straight under the shoulder with the torso at exactly `turn`, the wrist outside;
    /// none if the limits of the rails, of the torso or of the reach forbid it.
    /// (The prototype's formula: torso at x + 0.637 sin r, y - 0.637 cos r, and d4 aside.)
    pub fn solve_turned(&self, tool: Point, turn: f64, from: &Joints) -> Option<Joints> {
        if !is_finite(tool) || !within([-TAU, TAU], turn) {
            return None;
        }
        let dz = planar::wrist_height(tool, self.shoulder);
        let wrist = Wrist::Outside;
        let (x, y) = self.torso_at(tool, SHOULDER, turn)?;
        planar::reaches(0.0, dz, wrist).then(|| arm_joints([x, y, turn], planar::links(0.0, dz, wrist), from))
    }

    /// Joints for a tool at this stance, with room to spare; none if rails, torso or reach forbid it. They depend on
    /// tool and stance alone but for the whole turns that the joints of the arm have at `from`, and the last joint,
    /// which is that of `from`.
    pub fn solve_stance(&self, tool: Point, stance: &Stance, from: (&Joints, Point)) -> Option<Joints> {
        let (x, y) = self.torso_at(tool, SHOULDER + stance.beyond, stance.turn)?;
        self.standing_near(Point::new(x, y, 0.0), tool.z, stance, from)
    }

    /// Joints for a tool with rails, torso and the direction of the wrist as they are.
    pub fn solve_standing(&self, tool: Point, from: &Joints) -> Option<Joints> {
        let [x, y, turn, ..] = *from;
        let (dx, dy) = (tool.x - x, tool.y - y);
        let (s, c) = libm::sincos(turn);
        let (ahead, aside) = (dy * c - dx * s, -dx * c - dy * s);
        let wrist = Wrist::of_angle(from[7]);
        let dz = planar::wrist_height(tool, self.shoulder);
        let beyond = ahead - SHOULDER;
        if (aside - D4).abs() > STANDS || planar::comfortable(beyond, dz, [wrist; 2]).is_none() {
            return None;
        }
        Some(arm_joints([x, y, turn], planar::links(beyond, dz, wrist), from))
    }

    /// How the robot stands at these joints, the tool pointing down.
    pub fn stance(&self, joints: &Joints) -> Stance {
        self.stance_below(joints, self.tool(joints))
    }

    /// The same, with the tool here at these joints.
    fn stance_below(&self, joints: &Joints, tool: Point) -> Stance {
        let [x, y, turn, ..] = *joints;
        let (s, c) = libm::sincos(turn);
        let ahead = (tool.y - y) * c - (tool.x - x) * s;
        Stance { turn, beyond: ahead - SHOULDER, wrist: Wrist::of_angle(joints[7]) }
    }

    /// Joints at this stance with the torso's axis here and the tool at this height, as [`Self::solve_stance`] has them, near
    /// joints at which the tool is there; none if the reach forbids it.
    pub fn standing_near(
        &self,
        torso: Point,
        height: f64,
        stance: &Stance,
        (from, tool): (&Joints, Point),
    ) -> Option<Joints> {
        let Stance { turn, beyond, wrist } = *stance;
        let dz = planar::wrist_height(Point { z: height, ..torso }, self.shoulder);
        planar::comfortable(beyond, dz, [wrist; 2])?;
        let angles = angles(planar::links(beyond, dz, wrist));
        // Joints that go on and on without a jump are those of the formula, and whole turns.
        let present = self.stance_below(from, tool);
        let present_dz = planar::wrist_height(tool, self.shoulder);
        let known = angles_at(&present, present_dz);
        Some(std::array::from_fn(|i| match i {
            0 => torso.x,
            1 => torso.y,
            2 => turn,
            3..8 => angles[i - 3] + TAU * libm::round((from[i] - known[i - 3]) / TAU),
            _ => from[8],
        }))
    }

    /// Where the torso's axis may be: the lower and the upper end of x and of y.
    pub fn rails(&self) -> [[f64; 2]; 2] {
        [self.x, self.y]
    }

    /// The place of the torso at this turn with the tool `ahead` of its axis, if the rails allow it.
    fn torso_at(&self, tool: Point, ahead: f64, turn: f64) -> Option<(f64, f64)> {
        let (s, c) = libm::sincos(turn);
        let (x, y) = (tool.x + ahead * s + D4 * c, tool.y - ahead * c + D4 * s);
        (within(self.x, x) && within(self.y, y)).then_some((x, y))
    }

    /// A place of the torso with the tool `ahead` of its axis, and as little turning as the rails allow.
    fn torso(&self, view: &View, ahead: f64, turn: f64) -> Option<(f64, f64)> {
        let [near, far] = view.distance;
        let radius = level_radius(ahead);
        if radius < near || radius > far {
            return None;
        }
        let mut turns =
            (0..=TURN_STEPS).flat_map(|step| [step, -step]).map(|step| turn + f64::from(step) * PI / 12.0);
        let on_rails = turns.find_map(|turn| self.torso_at(view.tool, ahead, turn));
        Some(on_rails.unwrap_or_else(|| self.between(view, radius)))
    }

    /// The place at a distance from the tool, on the line from the nearest to the farthest place of the torso.
    fn between(&self, view: &View, radius: f64) -> (f64, f64) {
        let [near, far] = view.ends;
        let (start, span) = (near - view.tool, far - near);
        let a = span.x * span.x + span.y * span.y;
        let b = start.x * span.x + start.y * span.y;
        let c = start.x * start.x + start.y * start.y - radius * radius;
        let part = if a > 0.0 { ((root(b * b - a * c) - b) / a).clamp(0.0, 1.0) } else { 0.0 };
        let place = |near: f64, span: f64, range: [f64; 2]| (near + part * span).clamp(range[0], range[1]);
        (place(near.x, span.x, self.x), place(near.y, span.y, self.y))
    }

    fn joints(&self, view: &View, (x, y): (f64, f64), wrist: Wrist, from: &Joints) -> Joints {
        let (dx, dy) = (view.tool.x - x, view.tool.y - y);
        let ahead = root(dx * dx + dy * dy - D4 * D4);
        let turn = libm::atan2(dy, dx) - libm::atan2(D4, ahead) - FRAC_PI_2;
        let links = planar::links(ahead - SHOULDER, view.dz, wrist);
        arm_joints([x, y, nearest_turn(turn, from[2])], links, from)
    }

    /// Pose of the tool, world frame.
    pub fn tool_pose(&self, joints: &Joints) -> Pose {
        let [_, _, _, angles @ ..] = joints;
        self.torso_pose(joints).then(&MOUNT).then(&ur10::forward(angles))
    }

    /// Of each link behind a joint, world frame: the bridge and the trolley, which do not turn, and the torso,
    /// all at the height of the shoulder and the bridge at y = 0; then [`ur10::frames`].
    pub fn frames(&self, joints: &Joints) -> Frames {
        let [x, y, _, angles @ ..] = joints;
        let torso = self.torso_pose(joints);
        let base = torso.then(&MOUNT);
        let rail = |y: f64| Pose { position: Point::new(*x, y, self.shoulder), ..Pose::IDENTITY };
        let carriers = [rail(0.0), rail(*y), torso].into_iter();
        Frames::of(carriers.chain(ur10::frames(angles).iter().map(|link| base.then(link))))
    }

    /// The joints, from the world on.
    pub fn links(&self) -> Vec<Link> {
        let rails = Pose { position: Point::new(0.0, 0.0, self.shoulder), ..Pose::IDENTITY };
        let carriers = [
            Link::slides(rails, Axis::X, Pose::IDENTITY),
            Link::slides(Pose::IDENTITY, Axis::Y, Pose::IDENTITY),
            Link::turns(Pose::turned(Point::default(), FRAC_PI_2), Pose::IDENTITY),
        ];
        carriers.into_iter().chain(ur10::LENGTHS.links(MOUNT)).collect()
    }

    fn torso_pose(&self, &[x, y, turn, ..]: &Joints) -> Pose {
        Pose::turned(Point::new(x, y, self.shoulder), turn + FRAC_PI_2)
    }

    pub fn tool(&self, joints: &Joints) -> Point {
        self.tool_pose(joints).position
    }

    /// A pose to start from: middle of both rails (start joints of the prototype's gantry, the tool turned straight down).
    pub fn start(&self) -> Joints {
        let middle = |range: [f64; 2]| (range[0] + range[1]) / 2.0;
        [middle(self.x), middle(self.y), 0.0, 0.0, -1.13, 1.88, 1.13 - 1.88, FRAC_PI_2, 0.0]
    }
}

/// All joints for a place and a turn of the torso; the angles of the arm take the turn nearest to `from`.
fn arm_joints(torso: [f64; 3], links: Links, from: &Joints) -> Joints {
    let angles = angles(links);
    std::array::from_fn(|i| match i {
        0..3 => torso[i],
        8 => from[8],
        _ => nearest_turn(angles[i - 3], from[i]),
    })
}

/// The first five joints of the arm. Its base lies on its side: what is level in its own plane is a quarter turn back.
fn angles(links: Links) -> [f64; 5] {
    [0.0, links.lift - FRAC_PI_2, links.elbow, links.wrist_1, links.wrist_2]
}

/// The same at a stance with the wrist so high over the shoulder; beyond its reach those at its limit.
fn angles_at(stance: &Stance, dz: f64) -> [f64; 5] {
    angles(planar::links(stance.beyond, dz, stance.wrist))
}

fn within(range: [f64; 2], value: f64) -> bool {
    range[0] <= value && value <= range[1]
}

/// Level distance from the torso's axis of a tool that is `ahead` of it.
fn level_radius(ahead: f64) -> f64 {
    root(ahead * ahead + D4 * D4)
}

fn level_distance(a: Point, b: Point) -> f64 {
    let d = a - b;
    root(d.x * d.x + d.y * d.y)
}

impl Solver for Gantry {
    fn margin_down(&self, tool: Point) -> f64 {
        Gantry::margin(self, tool)
    }

    fn solve_down(&self, tool: Point, from: &arm::Joints) -> Option<arm::Joints> {
        Gantry::solve(self, tool, &from.array()).map(|joints| arm::Joints::new(&joints))
    }

    fn tool_pose(&self, joints: &arm::Joints) -> Pose {
        Gantry::tool_pose(self, &joints.array())
    }

    fn frames(&self, joints: &arm::Joints) -> Frames {
        Gantry::frames(self, &joints.array())
    }

    fn links(&self) -> Vec<Link> {
        Gantry::links(self)
    }

    fn start(&self) -> arm::Joints {
        arm::Joints::new(&Gantry::start(self))
    }

    fn mount(&self) -> Pose {
        MOUNT
    }

    fn standing(&self) -> Option<usize> {
        Some(TORSO + 1)
    }

    fn keeps_direction(&self) -> bool {
        true
    }
}
