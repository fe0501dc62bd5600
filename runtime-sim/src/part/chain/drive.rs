//! The drives of an arm: its joints on their way to a target of the tool.

use crate::kinematics::arm::{Arm, Joints, Limits};
use crate::motion::Motion;
use crate::point::Point;
use crate::way::{Leg, Load, Ways};
use std::sync::Arc;

#[derive(Clone, Debug)]
pub struct Drive {
    arm: Arm,
    /// What a gantry knows of its surroundings.
    ways: Option<Arc<Ways>>,
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
    /// The first place, round what stands and with this on the tool, so that the tool can be lowered to the second
    /// from there.
    Round(Point, Point, Load),
}

#[derive(Clone, Debug)]
enum Course {
    Rest,
    /// The motion, and the legs behind it, the last one first.
    Going(Motion, Vec<Leg>),
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
    /// At rest with the tool at this place; `None` if it is out of reach.
    pub fn new(arm: Arm, rest: Point, ways: Option<Ways>) -> Option<Self> {
        let start = arm.start();
        let joints = arm.solve(rest, &start)?;
        let (limits, tool) = (arm.limits(), arm.tool(&joints));
        Some(Self { arm, ways: ways.map(Arc::new), limits, joints, tool, course: Course::Rest })
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
            Course::Going(motion, _) | Course::Braking(motion, _) => Some(motion),
        }
    }

    /// The limits of all motions that begin from now on: a part of full speed, and m/s2 or rad/s2.
    pub fn set_pace(&mut self, speed: f64, acceleration: f64) {
        self.limits = self.arm.limits().at_speed(speed).at_gain(acceleration);
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
        let course = self.course_to(target, t)?;
        self.course = match std::mem::replace(&mut self.course, Course::Rest) {
            Course::Rest => course,
            Course::Going(mut motion, _) | Course::Braking(mut motion, _) => {
                motion.hold(t);
                Course::Braking(motion, Some(target))
            }
        };
        Some(())
    }

    /// From the present joints, which stand.
    fn course_to(&self, target: Target, t: f64) -> Option<Course> {
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
                match self.ways.as_ref().and_then(|ways| ways.legs(&from, load, [via, goal], limits)) {
                    Some(legs) => legs,
                    None => vec![straight(via)?],
                }
            }
        };
        legs.reverse();
        let first = legs.pop().unwrap_or(Leg::To(from));
        Some(Course::Going(first.motion(from, limits, t), legs))
    }

    /// Brakes and forgets the target.
    pub fn stop(&mut self, t: f64) {
        self.course = match std::mem::replace(&mut self.course, Course::Rest) {
            Course::Rest => Course::Rest,
            Course::Going(mut motion, _) | Course::Braking(mut motion, _) => {
                motion.hold(t);
                Course::Braking(motion, None)
            }
        };
    }

    /// Brakes on the path and keeps the target.
    pub fn hold(&mut self, t: f64) {
        if let Course::Going(motion, _) = &mut self.course {
            motion.hold(t);
        }
    }

    pub fn resume(&mut self, t: f64) {
        if let Course::Going(motion, _) = &mut self.course {
            motion.resume(t);
        }
    }

    /// Goes on to the time `t`. It may arrive while it is held, if it was about to.
    pub fn advance(&mut self, t: f64) -> Moved {
        let (course, moved) = match std::mem::replace(&mut self.course, Course::Rest) {
            Course::Rest => (Course::Rest, Moved::Arrived),
            Course::Going(motion, mut legs) => {
                self.place(motion.at(t));
                if !motion.has_ended(t) {
                    (Course::Going(motion, legs), Moved::OnTheWay)
                } else if let Some(leg) = legs.pop() {
                    (Course::Going(leg.motion(self.joints, &self.limits, t), legs), Moved::OnTheWay)
                } else {
                    (Course::Rest, Moved::Arrived)
                }
            }
            Course::Braking(motion, next) => {
                self.place(motion.at(t));
                if t < motion.rests_at() {
                    (Course::Braking(motion, next), Moved::OnTheWay)
                } else {
                    match next.map(|target| self.course_to(target, t)) {
                        None => (Course::Rest, Moved::Arrived),
                        Some(None) => (Course::Rest, Moved::Lost),
                        Some(Some(course)) => (course, Moved::OnTheWay),
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
