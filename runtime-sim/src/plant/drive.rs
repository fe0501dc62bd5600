//! The drives of an arm: its joints on their way to a target of the tool.

use crate::geometry::Geometry;
use crate::kinematics::arm::{Arm, Joints, Limits};
use crate::motion::Motion;
use crate::point::Point;

#[derive(Clone, Debug)]
pub struct Drive {
    arm: Arm,
    limits: Limits,
    joints: Joints,
    tool: Point,
    course: Course,
}

/// Where to go, and how.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Target {
    Place(Point),
    /// A place, with the torso at exactly this turn, rad.
    Turned(Point, f64),
    /// The second place, past the first one without a stop.
    Past(Point, Point),
}

#[derive(Clone, Debug)]
enum Course {
    Rest,
    Going(Motion),
    /// The motion is void and brakes; then the next target, if there is one.
    Braking(Motion, Option<Target>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moved {
    OnTheWay,
    Arrived,
    /// From where the motion before it came to rest there is no way to the target.
    Lost,
}

impl Drive {
    /// At rest, the rail at its middle; `None` for a machine without joints, or one that has no
    /// such place.
    pub fn new(geometry: &Geometry) -> Option<Self> {
        let arm = Arm::from_geometry(geometry)?;
        let start = arm.start();
        let joints = arm.solve(geometry.rest(), &start)?;
        let (limits, tool) = (arm.limits(), arm.tool(&joints));
        Some(Self { arm, limits, joints, tool, course: Course::Rest })
    }

    pub fn tool(&self) -> Point {
        self.tool
    }

    pub fn joints(&self) -> Joints {
        self.joints
    }

    /// What moves the joints at present.
    pub fn under_way(&self) -> Option<&Motion> {
        match &self.course {
            Course::Rest => None,
            Course::Going(motion) | Course::Braking(motion, _) => Some(motion),
        }
    }

    /// The limits of all motions that begin from now on: a part of full speed, and m/s2 or rad/s2.
    pub fn set_pace(&mut self, speed: f64, gain: f64) {
        self.limits = self.arm.limits().at_speed(speed).at_gain(gain);
    }

    pub fn is_at_rest(&self) -> bool {
        matches!(self.course, Course::Rest)
    }

    pub fn has_torso(&self) -> bool {
        self.arm.has_torso()
    }

    /// Sets out for a target at `t`, in seconds; what moves still brakes first. `None` if no joints bring the
    /// tool there.
    pub fn start(&mut self, target: Target, t: f64) -> Option<()> {
        let motion = self.motion(target, t)?;
        self.course = match std::mem::replace(&mut self.course, Course::Rest) {
            Course::Rest => Course::Going(motion),
            Course::Going(mut motion) | Course::Braking(mut motion, _) => {
                motion.hold(t);
                Course::Braking(motion, Some(target))
            }
        };
        Some(())
    }

    /// The motion from the present joints, which stand.
    fn motion(&self, target: Target, t: f64) -> Option<Motion> {
        let (from, limits) = (self.joints, &self.limits);
        Some(match target {
            Target::Place(goal) => Motion::between(from, self.arm.solve(goal, &from)?, limits, t),
            Target::Turned(goal, turn) => {
                Motion::between(from, self.arm.solve_turned(goal, turn, &from)?, limits, t)
            }
            Target::Past(via, goal) => {
                let via = self.arm.solve(via, &from)?;
                Motion::through(from, via, self.arm.solve(goal, &via)?, limits, t)
            }
        })
    }

    /// Brakes and forgets the target.
    pub fn stop(&mut self, t: f64) {
        self.course = match std::mem::replace(&mut self.course, Course::Rest) {
            Course::Rest => Course::Rest,
            Course::Going(mut motion) | Course::Braking(mut motion, _) => {
                motion.hold(t);
                Course::Braking(motion, None)
            }
        };
    }

    /// Brakes on the path and keeps the target.
    pub fn hold(&mut self, t: f64) {
        if let Course::Going(motion) = &mut self.course {
            motion.hold(t);
        }
    }

    pub fn resume(&mut self, t: f64) {
        if let Course::Going(motion) = &mut self.course {
            motion.resume(t);
        }
    }

    /// Goes on to the time `t`. It may arrive while it is held, if it was about to.
    pub fn advance(&mut self, t: f64) -> Moved {
        let (course, moved) = match std::mem::replace(&mut self.course, Course::Rest) {
            Course::Rest => (Course::Rest, Moved::Arrived),
            Course::Going(motion) => {
                self.place(motion.at(t));
                if motion.has_ended(t) {
                    (Course::Rest, Moved::Arrived)
                } else {
                    (Course::Going(motion), Moved::OnTheWay)
                }
            }
            Course::Braking(motion, next) => {
                self.place(motion.at(t));
                if t < motion.rests_at() {
                    (Course::Braking(motion, next), Moved::OnTheWay)
                } else {
                    match next.map(|target| self.motion(target, t)) {
                        None => (Course::Rest, Moved::Arrived),
                        Some(None) => (Course::Rest, Moved::Lost),
                        Some(Some(motion)) => (Course::Going(motion), Moved::OnTheWay),
                    }
                }
            }
        };
        self.course = course;
        moved
    }

    fn place(&mut self, joints: Joints) {
        if joints != self.joints {
            self.joints = joints;
            self.tool = self.arm.tool(&joints);
        }
    }
}
