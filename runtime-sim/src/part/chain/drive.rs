//! The drives of an arm: its joints moving to a target of the tool.

use crate::kinematics::arm::{Arm, Joints, Limits};
use crate::motion::Motion;
use crate::point::Point;
use crate::planner::{Leg, Load, Planner};
use std::sync::Arc;

#[derive(Clone, Debug)]
pub struct Drive {
    arm: Arm,
    /// What a gantry knows of its surroundings.
    planner: Option<Arc<Planner>>,
    limits: Limits,
    joints: Joints,
    tool: Point,
    phase: Phase,
}

/// Where to go, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    Place(Point),
    /// A place, with the torso at exactly this turn, rad.
    Turned(Point, f64),
    /// The second place, past the first one without a stop.
    Past(Point, Point),
    /// The first place, round obstacles and with this on the tool, so that the tool can be lowered to the second
    /// from there.
    Round(Point, Point, Load),
}

#[derive(Clone, Debug)]
enum Phase {
    Rest,
    /// The motion, and the legs behind it, the last one first.
    Going(Motion, Vec<Leg>),
    /// The motion is void and brakes; then the next target, if there is one.
    Braking(Motion, Option<Target>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moved {
    Moving,
    Arrived,
    /// From where the motion before it came to rest the target cannot be reached.
    Lost,
}

impl Drive {
    /// At rest with the tool at this place; `None` if it is out of reach.
    pub fn new(arm: Arm, rest: Point, planner: Option<Planner>) -> Option<Self> {
        let start = arm.start();
        let joints = arm.solve(rest, &start)?;
        let (limits, tool) = (arm.limits(), arm.tool(&joints));
        Some(Self { arm, planner: planner.map(Arc::new), limits, joints, tool, phase: Phase::Rest })
    }

    pub fn tool(&self) -> Point {
        self.tool
    }

    pub fn joints(&self) -> Joints {
        self.joints
    }

    /// What moves the joints at present.
    pub fn under_way(&self) -> Option<&Motion> {
        match &self.phase {
            Phase::Rest => None,
            Phase::Going(motion, _) | Phase::Braking(motion, _) => Some(motion),
        }
    }

    /// The limits of all motions that begin from now on: a part of full speed, and m/s2 or rad/s2.
    pub fn set_pace(&mut self, speed: f64, acceleration: f64) {
        self.limits = self.arm.limits().at_speed(speed).at_gain(acceleration);
    }

    pub fn is_at_rest(&self) -> bool {
        matches!(self.phase, Phase::Rest)
    }

    pub fn has_torso(&self) -> bool {
        self.arm.has_torso()
    }

    /// Sets out for a target at `t`, in seconds; what moves still brakes first. `None` if no joints bring the
    /// tool there.
    pub fn start(&mut self, target: Target, t: f64) -> Option<()> {
        let phase = self.phase_to(target, t)?;
        self.phase = match std::mem::replace(&mut self.phase, Phase::Rest) {
            Phase::Rest => phase,
            Phase::Going(mut motion, _) | Phase::Braking(mut motion, _) => {
                motion.hold(t);
                Phase::Braking(motion, Some(target))
            }
        };
        Some(())
    }

    /// From the present joints, which stand.
    fn phase_to(&self, target: Target, t: f64) -> Option<Phase> {
        let (from, limits) = (self.joints, &self.limits);
        let straight = |goal| Some(Leg::To(self.arm.solve(goal, &from)?));
        let mut legs = match target {
            Target::Place(goal) => vec![straight(goal)?],
            Target::Turned(goal, turn) => vec![Leg::To(self.arm.solve_turned(goal, turn, &from)?)],
            Target::Past(via, goal) => {
                let via = self.arm.solve(via, &from)?;
                vec![Leg::Past(via, self.arm.solve(goal, &via)?)]
            }
            Target::Round(via, goal, load) => {
                match self.planner.as_ref().and_then(|planner| planner.legs(&from, load, [via, goal], limits)) {
                    Some(legs) => legs,
                    None => vec![straight(via)?],
                }
            }
        };
        legs.reverse();
        let first = legs.pop().unwrap_or(Leg::To(from));
        Some(Phase::Going(first.motion(from, limits, t), legs))
    }

    /// Brakes and forgets the target.
    pub fn stop(&mut self, t: f64) {
        self.phase = match std::mem::replace(&mut self.phase, Phase::Rest) {
            Phase::Rest => Phase::Rest,
            Phase::Going(mut motion, _) | Phase::Braking(mut motion, _) => {
                motion.hold(t);
                Phase::Braking(motion, None)
            }
        };
    }

    /// Brakes on the path and keeps the target.
    pub fn hold(&mut self, t: f64) {
        if let Phase::Going(motion, _) = &mut self.phase {
            motion.hold(t);
        }
    }

    pub fn resume(&mut self, t: f64) {
        if let Phase::Going(motion, _) = &mut self.phase {
            motion.resume(t);
        }
    }

    /// Goes on to the time `t`. It may arrive while it is held, if it was about to.
    pub fn advance(&mut self, t: f64) -> Moved {
        let (phase, moved) = match std::mem::replace(&mut self.phase, Phase::Rest) {
            Phase::Rest => (Phase::Rest, Moved::Arrived),
            Phase::Going(motion, mut legs) => {
                self.place(motion.at(t));
                if !motion.has_ended(t) {
                    (Phase::Going(motion, legs), Moved::Moving)
                } else if let Some(leg) = legs.pop() {
                    (Phase::Going(leg.motion(self.joints, &self.limits, t), legs), Moved::Moving)
                } else {
                    (Phase::Rest, Moved::Arrived)
                }
            }
            Phase::Braking(motion, next) => {
                self.place(motion.at(t));
                if t < motion.rests_at() {
                    (Phase::Braking(motion, next), Moved::Moving)
                } else {
                    match next.map(|target| self.phase_to(target, t)) {
                        None => (Phase::Rest, Moved::Arrived),
                        Some(None) => (Phase::Rest, Moved::Lost),
                        Some(Some(phase)) => (phase, Moved::Moving),
                    }
                }
            }
        };
        self.phase = phase;
        moved
    }

    fn place(&mut self, joints: Joints) {
        if joints != self.joints {
            self.joints = joints;
            self.tool = self.arm.tool(&joints);
        }
    }
}
