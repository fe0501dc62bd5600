//! Both robots alike: joints, reach, limits.

use super::cartesian::{Cartesian, Slide};
use super::facing::Facing;
use super::fixed::FixedArm;
use super::gantry::{Gantry, Stance};
use super::links::Link;
use super::pose::Pose;
use super::rail_arm::RailArm;
use super::riding::RidingArm;
use super::scara::Scara;
use super::solver::Solver;
use super::{nearest_equivalent, nearest_turn};
use crate::frame::Frame;
use crate::part::axis::{Axis, Motion, Place};
use crate::part::chain::{Chain, Geometry};
use crate::point::{Direction, Point};
use std::f64::consts::PI;
use std::ops::Deref;

/// The joint of a torso.
pub(super) const TORSO: usize = 2;
/// Most joints that a robot has.
pub const MOST_JOINTS: usize = 9;

/// A value for each joint of one robot: rails first (m), then angles (rad).
#[derive(Clone, Copy, PartialEq)]
pub struct Joints {
    values: [f64; MOST_JOINTS],
    count: usize,
}

/// A pose for each link of one robot, see [`Arm::frames`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frames {
    poses: [Pose; MOST_JOINTS],
    count: usize,
}

/// Joints of a robot, and the pose of its tool at them.
#[derive(Clone, Copy, Debug)]
pub struct Posture {
    pub joints: Joints,
    pub tool: Pose,
}

/// What a robot's joints can do at most.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Limits {
    /// m/s or rad/s.
    pub velocity: Joints,
    /// m/s2 or rad/s2.
    pub acceleration: Joints,
}

/// A chain and the axes that carry it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arm {
    family: Family,
    limits: Limits,
}

/// The arms for which there is a closed form.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Family {
    Cartesian(Cartesian),
    Scara(Scara),
    /// Upright where it is.
    Fixed(FixedArm),
    /// The same on one rail.
    Riding(RidingArm),
    /// A UR10 upright on one rail.
    Rail(RailArm),
    /// Sideways at a torso that turns, on two rails that cross.
    Gantry(Gantry),
}

/// Turns of the last joint differ by a multiple of this, rad: 0.2 um at a metre.
pub const FINEST_TURN: f64 = PI / 16_777_216.0;

impl Joints {
    /// # Panics
    /// With more than [`MOST_JOINTS`] values.
    #[inline]
    pub fn new(values: &[f64]) -> Self {
        let mut joints = Self { values: [0.0; MOST_JOINTS], count: values.len() };
        joints.values[..values.len()].copy_from_slice(values);
        joints
    }

    /// Each value by the same rule.
    #[inline]
    pub fn map(&self, rule: impl Fn(usize, f64) -> f64) -> Self {
        let mut joints = *self;
        for (i, value) in joints.values[..self.count].iter_mut().enumerate() {
            *value = rule(i, *value);
        }
        joints
    }

    /// To tell them apart exactly; missing ones are 0.
    #[inline]
    pub fn bits(&self) -> [u64; MOST_JOINTS] {
        std::array::from_fn(|i| if i < self.count { self.values[i].to_bits() } else { 0 })
    }

    /// The first values as an array; missing ones are 0.
    #[inline]
    pub(super) fn array<const N: usize>(&self) -> [f64; N] {
        std::array::from_fn(|i| self.values[i])
    }
}

impl Frames {
    /// Of these links, the first [`MOST_JOINTS`] at most.
    #[inline]
    pub(super) fn of(links: impl Iterator<Item = Pose>) -> Self {
        let mut frames = Self { poses: [Pose::IDENTITY; MOST_JOINTS], count: 0 };
        for (frame, link) in frames.poses.iter_mut().zip(links) {
            *frame = link;
            frames.count += 1;
        }
        frames
    }
}

impl Deref for Frames {
    type Target = [Pose];
    #[inline]
    fn deref(&self) -> &[Pose] {
        &self.poses[..self.count]
    }
}

impl Deref for Joints {
    type Target = [f64];
    #[inline]
    fn deref(&self) -> &[f64] {
        &self.values[..self.count]
    }
}

impl std::fmt::Debug for Joints {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(self.iter()).finish()
    }
}

impl Limits {
    /// The same robot at a part of its speed; accelerations stay.
    pub fn at_speed(&self, part: f64) -> Self {
        Self { velocity: self.velocity.map(|_, v| v * part), ..*self }
    }

    /// The same robot with this acceleration of every joint, m/s2 or rad/s2.
    pub fn at_gain(&self, gain: f64) -> Self {
        Self { acceleration: self.acceleration.map(|_, _| gain), ..*self }
    }
}

impl Arm {
    /// `axes` carry the chain, the first one first. None if there is no closed form for it.
    pub fn new(axes: &[&Axis], chain: &Chain) -> Option<Self> {
        let motions: Vec<Motion> = axes.iter().map(|axis| axis.motion).collect();
        let family = match &chain.geometry {
            Geometry::Fixed(geometry, ranges) => {
                let at = |base: Frame| {
                    FixedArm::new(base, **geometry, ranges.as_deref().copied()).mounted(chain.mounting)
                };
                match chain.base {
                    Some(base) => Family::Fixed(at(base)),
                    None => Family::Riding(riding(axes, chain.mount, at)?),
                }
            }
            Geometry::Scara(arms) => Family::Scara(Scara::new(chain.base?, **arms)),
            Geometry::Tool(length) => Family::Cartesian(cartesian(axes, *length)?),
            Geometry::Ur10 => {
                let at = axes.first()?.at()?;
                match motions[..] {
                    [Motion::Slides { along, range }] => {
                        Family::Rail(RailArm::new(at, along.level()?, range))
                    }
                    [
                        Motion::Slides { along: Direction::X, range: x },
                        Motion::Slides { along: Direction::Y, range: y },
                        Motion::Turns,
                    ] => Family::Gantry(Gantry::new(at, x, y)),
                    _ => return None,
                }
            }
        };
        let velocities: Vec<f64> =
            axes.iter().map(|axis| axis.speed).chain(chain.joints.iter().map(|joint| joint.speed)).collect();
        let velocity = Joints::new(&velocities);
        let acceleration =
            velocity.map(|i, _| axes.get(i).map_or(chain.acceleration, |axis| axis.acceleration));
        Some(Self { family, limits: Limits { velocity, acceleration } })
    }

    pub(super) fn solver(&self) -> &dyn Solver {
        match &self.family {
            Family::Cartesian(robot) => robot,
            Family::Scara(arm) => arm,
            Family::Fixed(arm) => arm,
            Family::Riding(arm) => arm,
            Family::Rail(arm) => arm,
            Family::Gantry(arm) => arm,
        }
    }

    /// Limits of the joints behind its axes, rad or m; none if each turns once to either side.
    pub fn ranges(&self) -> Option<&[[f64; 2]]> {
        self.solver().ranges()
    }

    /// None for an arm with joints of its own.
    pub fn cartesian(&self) -> Option<&Cartesian> {
        match &self.family {
            Family::Cartesian(robot) => Some(robot),
            _ => None,
        }
    }

    /// Both ends of its base, for an arm on a rail that may lie in any direction.
    pub fn riding(&self) -> Option<[Point; 2]> {
        match &self.family {
            Family::Riding(arm) => Some(arm.ground()),
            _ => None,
        }
    }

    /// Its two rails and its torso, if it has them.
    pub fn gantry(&self) -> Option<&Gantry> {
        match &self.family {
            Family::Gantry(gantry) => Some(gantry),
            _ => None,
        }
    }

    /// See [`Solver::mount`].
    pub fn mount(&self) -> Pose {
        self.solver().mount()
    }

    /// How far the wrist stays within its reach when the tool, pointing down, is at a place; negative out of reach, m.
    pub fn margin(&self, tool: Point) -> f64 {
        self.solver().margin(tool, Facing::Down)
    }

    /// [`Self::margin`] with the tool pointing there; minus infinity for an arm whose tool only points down.
    pub fn margin_facing(&self, tool: Point, facing: Facing) -> f64 {
        self.solver().margin(tool, facing)
    }

    /// How far the last three joints are from their limits at a place, the nearest of them, rad; none out of reach, and if
    /// they have no limits.
    pub fn wrist_room(&self, tool: Point, facing: Facing) -> Option<f64> {
        self.solver().wrist_room(tool, facing)
    }

    /// Joints for a place of the tool, near `from`; some exactly when [`Self::margin`] is not negative.
    pub fn solve(&self, tool: Point, from: &Joints) -> Option<Joints> {
        self.solve_facing(tool, Facing::Down, from)
    }

    /// [`Self::solve`] with the tool pointing there; some exactly when [`Self::margin_facing`] is not negative. Without a
    /// turn of its own, a part on the tool keeps its direction, if that is for the last joint to do: it turns back what the
    /// others turn.
    pub fn solve_facing(&self, tool: Point, facing: Facing, from: &Joints) -> Option<Joints> {
        let joints = self.solver().solve(tool, facing, from)?;
        Some(self.with_part_of(from, || self.direction(from), facing, joints))
    }

    /// [`Self::solve_facing`] from where the tool is known.
    pub(crate) fn solve_from(&self, tool: Point, facing: Facing, from: &Posture) -> Option<Joints> {
        let joints = self.solver().solve(tool, facing, &from.joints)?;
        Some(self.with_part_of(&from.joints, || direction_of(&from.tool), facing, joints))
    }

    /// [`Self::solve_facing`], however the arm bends: the joints nearest to `from`.
    pub(super) fn solve_near(&self, tool: Point, facing: Facing, from: &Joints) -> Option<Joints> {
        let joints = self.solver().solve_near(tool, facing, from)?;
        Some(self.with_part_of(from, || self.direction(from), facing, joints))
    }

    /// The same joints but for the last one, which gives a part the direction that it has to have, if that is for it to do.
    /// `direction` is the one that it has at `from`.
    fn with_part_of(
        &self,
        from: &Joints,
        direction: impl FnOnce() -> f64,
        facing: Facing,
        joints: Joints,
    ) -> Joints {
        if !self.solver().keeps_direction() {
            return joints;
        }
        Self::within_limits(match facing {
            Facing::Oriented { x, y } => self.with_direction(from, libm::atan2(y, x), joints),
            Facing::Down | Facing::Level { .. } => self.with_direction(from, direction(), joints),
        })
    }

    /// The direction of a part on the tool, seen from above, rad.
    pub fn direction(&self, joints: &Joints) -> f64 {
        direction_of(&self.tool_pose(joints))
    }

    /// The same joints but for the last one, which gives a part on the tool this direction. For an arm that keeps the
    /// direction of a part.
    pub fn directed(&self, joints: &Joints, direction: f64) -> Joints {
        let off = self.direction(joints) - direction;
        if off == 0.0 || !self.solver().keeps_direction() {
            return *joints;
        }
        let last = joints.len() - 1;
        // The last joint's axis points down.
        joints.map(|i, value| if i == last { nearest_equivalent(value + off, value) } else { value })
    }

    /// The same place of the tool, and a part on it with this direction.
    fn with_direction(&self, from: &Joints, direction: f64, joints: Joints) -> Joints {
        let last = joints.len() - 1;
        // The last joint's axis points down.
        let angle = joints[last] + self.direction(&joints) - direction;
        // As far as the torso turns, the last joint turns too.
        let turned = if self.has_torso() { joints[TORSO] - from[TORSO] } else { 0.0 };
        let kept = nearest_equivalent(angle, from[last] + turned);
        // What is rounded would add up: the same place has the same joints, however the arm has come there.
        let kept = libm::round(kept / FINEST_TURN) * FINEST_TURN;
        joints.map(|i, value| if i == last { kept } else { value })
    }

    /// The same with the last joint within its limits, as near to where it is as they allow.
    fn within_limits(joints: Joints) -> Joints {
        let last = joints.len() - 1;
        joints.map(|i, value| if i == last { nearest_turn(value, value) } else { value })
    }

    /// Joints for a place of the tool at this stance, near `from`; a part keeps its direction. None where the limits
    /// forbid it, and for a robot without a torso.
    pub fn solve_stance(&self, tool: Point, stance: &Stance, from: &Posture) -> Option<Joints> {
        let near = (&from.joints.array(), from.tool.position);
        let joints = Joints::new(&self.gantry()?.solve_stance(tool, stance, near)?);
        Some(Self::within_limits(self.with_direction(&from.joints, direction_of(&from.tool), joints)))
    }

    /// How the robot stands at these joints; none for a robot without a torso.
    pub fn stance(&self, joints: &Joints) -> Option<Stance> {
        Some(self.gantry()?.stance(&joints.array()))
    }

    /// Joints at this stance with the torso's axis here and the tool at this height, near `from`; a part keeps its
    /// direction, whatever the limits of the last joint. None where the reach forbids it, and for a robot without a torso.
    pub fn standing_at(&self, torso: Point, height: f64, stance: &Stance, from: &Posture) -> Option<Joints> {
        let near = (&from.joints.array(), from.tool.position);
        let joints = self.gantry()?.standing_near(torso, height, stance, near)?;
        Some(self.with_direction(&from.joints, direction_of(&from.tool), Joints::new(&joints)))
    }

    /// Joints for a place of the tool with rails, torso and the direction of the wrist as they are; none where the
    /// reach forbids it, and for a robot without a torso.
    pub fn solve_standing(&self, tool: Point, from: &Joints) -> Option<Joints> {
        self.gantry()?.solve_standing(tool, &from.array()).map(|joints| Joints::new(&joints))
    }

    /// Joints for a place of the tool, straight under the shoulder, with the torso at exactly this turn (rad);
    /// none where the limits forbid it, and for a robot without a torso.
    pub fn solve_turned(&self, tool: Point, turn: f64, from: &Joints) -> Option<Joints> {
        self.gantry()?.solve_turned(tool, turn, &from.array()).map(|joints| Joints::new(&joints))
    }

    pub fn has_torso(&self) -> bool {
        self.gantry().is_some()
    }

    pub fn posture(&self, joints: &Joints) -> Posture {
        Posture { joints: *joints, tool: self.tool_pose(joints) }
    }

    pub fn tool_pose(&self, joints: &Joints) -> Pose {
        self.solver().tool_pose(joints)
    }

    /// Pose of the link behind each joint, world frame, in the order of the joints; the last is the tool's.
    pub fn frames(&self, joints: &Joints) -> Frames {
        self.solver().frames(joints)
    }

    /// The joints, from the world on: those of [`Arm::frames`].
    pub fn links(&self) -> Vec<Link> {
        self.solver().links()
    }

    pub fn tool(&self, joints: &Joints) -> Point {
        self.tool_pose(joints).position
    }

    /// Joints to start from, the tool pointing down.
    pub fn start(&self) -> Joints {
        self.solver().start()
    }

    /// The joints with which a run begins, whose tool is at `rest`; none out of reach.
    pub fn at_rest(&self, rest: Point) -> Option<Joints> {
        self.solve(rest, &self.start())
    }

    pub fn limits(&self) -> Limits {
        self.limits
    }
}

/// The direction of a part on a tool, seen from above, rad.
pub fn direction_of(tool: &Pose) -> f64 {
    let along = tool.axis(0);
    libm::atan2(along.y, along.x)
}

/// An arm of six joints on one level axis, its base on the carriage at `mount`; none on other axes.
fn riding(axes: &[&Axis], mount: Frame, arm: impl Fn(Frame) -> FixedArm) -> Option<RidingArm> {
    let [axis] = axes else { return None };
    let Motion::Slides { along, range } = axis.motion else { return None };
    Some(RidingArm::new(base_of(axis, &[along])?, along.level()?, range, mount, arm))
}

/// Where the carriages of axes in these directions are while all are at 0.
fn base_of(first: &Axis, along: &[Direction]) -> Option<Frame> {
    Some(match first.place? {
        Place::From(frame) => frame,
        // Ranges in the world begin at its origin.
        Place::At(point) => {
            let at = along.iter().fold(point, |at, along| at.with_coordinate(*along, 0.0));
            Frame::new(at, 0.0)
        }
    })
}

/// The axes of a Cartesian robot, its tool so far below the last one; none if they are not at right angles.
fn cartesian(axes: &[&Axis], tool_length: f64) -> Option<Cartesian> {
    let slide = |axis: &&Axis| match axis.motion {
        Motion::Slides { along, range } => Some(Slide { along, range }),
        Motion::Turns => None,
    };
    let slides: Vec<Slide> = axes.iter().map(slide).collect::<Option<_>>()?;
    let along: Vec<Direction> = slides.iter().map(|slide| slide.along).collect();
    let base = base_of(axes.first()?, &along)?;
    Cartesian::new(base, &slides, tool_length)
}
