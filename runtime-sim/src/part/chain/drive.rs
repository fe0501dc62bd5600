//! The drives of an arm: its joints moving to a target of the tool.

use super::missed::Missed;
use super::motions::{Motions, Planned};
use crate::kinematics::arm::{Joints, Limits};
use crate::kinematics::facing::Facing;
use crate::kinematics::pose::Pose;
use crate::motion::{Motion, Path, Travel};
use crate::planner::{Load, Transfer};
use crate::plant::EARLY_MS;
use crate::point::Point;
use std::sync::Arc;

/// A time is not distinguished from one that is so much later, s.
const EARLY: f64 = EARLY_MS / 1000.0;

#[derive(Clone, Debug)]
pub struct Drive {
    motions: Arc<Motions>,
    limits: Limits,
    joints: Joints,
    tool: Pose,
    /// Of a part on the tool where the last motion arrived: one that is broken off does not change what a part keeps.
    direction: f64,
    phase: Phase,
    /// Of the motion under way, or of the last one.
    target: Option<Target>,
    /// What is left of a path round obstacles on which the robot has come to rest: the same command goes on along it.
    /// Another path begins at a place; between places there may be none.
    left: Option<Path>,
    /// How far the tool goes at most along the path under way.
    travel: Arc<Travel>,
}

/// Where to go, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    Place(Point),
    /// The same, each joint by the same part of its way at a time.
    Direct(Point),
    /// The same with the tool pointing there, in a straight line if it goes along where it points.
    Facing(Point, Facing),
    /// A place, with the torso at exactly this turn, rad.
    Turned(Point, f64),
    /// The second place, past the first one without a stop.
    Past(Point, Point),
    /// Round obstacles, with this on the tool.
    Round(Transfer, Load),
}

#[derive(Clone, Debug)]
enum Phase {
    Rest,
    Going(Motion),
    /// The motion is void and brakes; then the next target, if there is one.
    Braking(Motion, Option<Target>),
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Moved {
    Moving,
    Arrived,
    /// From where the motion before it came to rest the target cannot be reached.
    Lost(Missed),
}

impl Drive {
    /// At rest with the tool at this place; `None` if it is out of reach.
    pub fn new(motions: Arc<Motions>, rest: Point) -> Option<Self> {
        let arm = motions.arm();
        let joints = arm.at_rest(rest)?;
        let (limits, tool, direction) = (arm.limits(), arm.tool_pose(&joints), arm.direction(&joints));
        Some(Self {
            motions,
            limits,
            joints,
            tool,
            direction,
            phase: Phase::Rest,
            target: None,
            left: None,
            travel: Arc::default(),
        })
    }

    /// Its frame, world frame.
    pub fn tool(&self) -> Pose {
        self.tool
    }

    pub fn joints(&self) -> Joints {
        self.joints
    }

    /// What moves the joints at present.
    pub fn under_way(&self) -> Option<&Motion> {
        match &self.phase {
            Phase::Rest => None,
            Phase::Going(motion) | Phase::Braking(motion, _) => Some(motion),
        }
    }

    /// The limits of all motions that begin from now on: a part of full speed, and m/s2 or rad/s2.
    pub fn set_pace(&mut self, speed: f64, acceleration: f64) {
        self.limits = self.motions.arm().limits().at_speed(speed).at_gain(acceleration);
    }

    /// The motion is void.
    pub fn is_braking(&self) -> bool {
        matches!(self.phase, Phase::Braking(..))
    }

    pub fn is_at_rest(&self) -> bool {
        matches!(self.phase, Phase::Rest)
    }

    pub fn has_torso(&self) -> bool {
        self.motions.arm().has_torso()
    }

    /// Sets out for a target at `t`, in seconds; what moves still brakes first.
    pub fn start(&mut self, target: Target, t: f64) -> Result<(), Missed> {
        if self.is_at_rest() {
            let planned = self.planned_to(target, t)?;
            self.set_out(target, planned);
            return Ok(());
        }
        if self.target != Some(target) {
            self.planned_to(target, t)?;
        }
        self.brake(t, Some(target));
        Ok(())
    }

    fn set_out(&mut self, target: Target, planned: Planned) {
        let Planned { motion, tool } = planned;
        self.phase = Phase::Going(motion);
        self.travel = tool;
        self.target = Some(target);
        self.left = None;
    }

    /// From the present joints, which stand.
    fn planned_to(&self, target: Target, t: f64) -> Result<Planned, Missed> {
        if self.target == Some(target)
            && let Some(path) = &self.left
        {
            return Ok(self.motions.along(path.clone(), &self.limits, t));
        }
        let directed = self.motions.arm().directed(&self.joints, self.direction);
        self.motions.planned([&self.joints, &directed], &target, &self.limits, t)
    }

    /// Metres that the tool goes at most between two times.
    pub fn tool_goes(&self, from: f64, to: f64) -> f64 {
        self.under_way().map_or(0.0, |motion| {
            let [from, to] = [from, to].map(|time| self.travel.to(motion.place(time)));
            to - from
        })
    }

    /// Where the tool is at a time of the motion under way.
    pub fn tool_at(&self, time: f64) -> Point {
        self.under_way().map_or(self.tool.position, |motion| self.motions.arm().tool(&motion.at(time)))
    }

    /// Brakes and forgets the target.
    pub fn stop(&mut self, t: f64) {
        self.brake(t, None);
    }

    fn brake(&mut self, t: f64, next: Option<Target>) {
        self.phase = match std::mem::replace(&mut self.phase, Phase::Rest) {
            Phase::Rest => Phase::Rest,
            Phase::Going(mut motion) | Phase::Braking(mut motion, _) => {
                motion.hold(t);
                Phase::Braking(motion, next)
            }
        };
    }

    /// Brakes on the path and keeps the target.
    pub fn hold(&mut self, t: f64) {
        if let Phase::Going(motion) = &mut self.phase {
            motion.hold(t);
        }
    }

    pub fn resume(&mut self, t: f64) {
        if let Phase::Going(motion) = &mut self.phase {
            motion.resume(t);
        }
    }

    /// Goes on to the time `t`. It may arrive while it is held, if it was about to.
    pub fn advance(&mut self, t: f64) -> Moved {
        match std::mem::replace(&mut self.phase, Phase::Rest) {
            Phase::Rest => Moved::Arrived,
            Phase::Going(motion) => {
                let has_ended = motion.has_ended(t + EARLY);
                self.place(motion.at(if has_ended { t + EARLY } else { t }));
                if has_ended {
                    self.direction = self.motions.arm().direction(&self.joints);
                    Moved::Arrived
                } else {
                    self.phase = Phase::Going(motion);
                    Moved::Moving
                }
            }
            Phase::Braking(motion, next) => {
                self.place(motion.at(t));
                if t + EARLY < motion.rests_at() {
                    self.phase = Phase::Braking(motion, next);
                    return Moved::Moving;
                }
                let place = motion.place(t);
                let leads_on = matches!(self.target, Some(Target::Round(..))) && place < 1.0;
                self.left = leads_on.then(|| motion.path().rest(place, &self.limits));
                let Some(target) = next else { return Moved::Arrived };
                match self.planned_to(target, t) {
                    Ok(planned) => self.set_out(target, planned),
                    Err(missed) => return Moved::Lost(missed),
                }
                Moved::Moving
            }
        }
    }

    fn place(&mut self, joints: Joints) {
        if joints != self.joints {
            self.joints = joints;
            self.tool = self.motions.arm().tool_pose(&joints);
        }
    }
}
