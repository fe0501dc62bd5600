//! The links of an arm one after the other, for whoever computes their frames elsewhere.

use super::pose::Pose;
use crate::point::{Direction, Point};

/// A joint with what is fixed before and behind it: its frame is that of the joint before (of the first: the world),
/// then `before`, then the joint's own motion, then `behind`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Link {
    pub before: Pose,
    pub joint: Joint,
    pub behind: Pose,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Joint {
    Slides(Direction),
    /// About z.
    Turns,
}

impl Link {
    pub fn slides(before: Pose, along: impl Into<Direction>, behind: Pose) -> Self {
        Self { before, joint: Joint::Slides(along.into()), behind }
    }

    pub fn turns(before: Pose, behind: Pose) -> Self {
        Self { before, joint: Joint::Turns, behind }
    }

    /// Its frame, in that of the joint before, at this value of the joint, m or rad.
    pub fn frame(&self, value: f64) -> Pose {
        let moved = match self.joint {
            Joint::Slides(along) => {
                Pose { position: Point::default().with_coordinate(along, value), ..Pose::IDENTITY }
            }
            Joint::Turns => Pose::turned(Point::default(), value),
        };
        self.before.then(&moved).then(&self.behind)
    }
}
