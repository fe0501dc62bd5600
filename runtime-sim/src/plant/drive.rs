//! The drives of an arm: its joints on their way to a goal of the tool.

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

#[derive(Clone, Debug)]
enum Course {
    Rest,
    Going(Motion),
    /// The motion is void and brakes; then the next goal, if there is one.
    Braking(Motion, Option<Point>),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Moved {
    OnTheWay,
    Arrived,
    /// From where the motion before it came to rest there is no way to the goal.
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
    pub fn motion(&self) -> Option<&Motion> {
        match &self.course {
            Course::Rest => None,
            Course::Going(motion) | Course::Braking(motion, _) => Some(motion),
        }
    }

    /// Sets out for a goal at `t`, in seconds; what moves still brakes first. `None` if no joints bring the
    /// tool there.
    pub fn start(&mut self, goal: Point, t: f64) -> Option<()> {
        if !(goal.x.is_finite() && goal.y.is_finite() && goal.z.is_finite()) {
            return None;
        }
        let to = self.arm.solve(goal, &self.joints)?;
        self.course = match std::mem::replace(&mut self.course, Course::Rest) {
            Course::Rest => Course::Going(Motion::between(self.joints, to, &self.limits, t)),
            Course::Going(mut motion) | Course::Braking(mut motion, _) => {
                motion.hold(t);
                Course::Braking(motion, Some(goal))
            }
        };
        Some(())
    }

    /// Brakes and forgets the goal.
    pub fn stop(&mut self, t: f64) {
        self.course = match std::mem::replace(&mut self.course, Course::Rest) {
            Course::Rest => Course::Rest,
            Course::Going(mut motion) | Course::Braking(mut motion, _) => {
                motion.hold(t);
                Course::Braking(motion, None)
            }
        };
    }

    /// Brakes on the path and keeps the goal.
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
                    match next.map(|goal| self.arm.solve(goal, &self.joints)) {
                        None => (Course::Rest, Moved::Arrived),
                        Some(None) => (Course::Rest, Moved::Lost),
                        Some(Some(to)) => {
                            let motion = Motion::between(self.joints, to, &self.limits, t);
                            (Course::Going(motion), Moved::OnTheWay)
                        }
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
