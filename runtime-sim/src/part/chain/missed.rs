//! Why a motion of an arm does not come to its goal.

use crate::kinematics::arm::Arm;
use crate::kinematics::facing::Facing;
use crate::kinematics::straight;
use crate::point::Point;
use crate::shortage::point_text;
use std::fmt::{Display, Formatter, Result};

/// What was asked of the arm, and why it does not do it.
#[derive(Clone, Copy, Debug)]
pub struct Missed {
    /// The goal, or the place to pass that is missed.
    pub place: Point,
    pub why: Why,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Why {
    /// By so much, m, if that is known.
    OutOfReach(Option<f64>),
    /// The tool comes there, but not turned as it should be.
    Turn,
    /// The arm would have to bend in another way on a straight line.
    NotStraight,
    /// The planner found no path that keeps off all obstacles.
    NoPath,
    /// A direction that is neither down nor level.
    Direction,
}

impl PartialEq for Missed {
    /// To the bit: a place that is none is equal to itself.
    fn eq(&self, other: &Self) -> bool {
        let bits = |place: Point| [place.x, place.y, place.z].map(f64::to_bits);
        bits(self.place) == bits(other.place) && self.why == other.why
    }
}

impl Missed {
    /// On a straight line.
    pub fn new(arm: &Arm, place: Point, facing: Facing, why: straight::Missed) -> Self {
        match why {
            straight::Missed::OutOfReach if facing.is_oriented() => Self::turned(arm, place),
            straight::Missed::OutOfReach => Self::out_of_reach(place, arm.margin_facing(place, facing)),
            straight::Missed::NotStraight => Self { place, why: Why::NotStraight },
        }
    }

    /// `margin` is that of the place, m.
    pub fn out_of_reach(place: Point, margin: f64) -> Self {
        let by = (margin.is_finite() && margin < 0.0).then_some(-margin);
        Self { place, why: Why::OutOfReach(by) }
    }

    /// Of a tool that points down and should have a turn.
    pub fn turned(arm: &Arm, place: Point) -> Self {
        match arm.margin(place) {
            margin if margin >= 0.0 => Self { place, why: Why::Turn },
            margin => Self::out_of_reach(place, margin),
        }
    }
}

impl Display for Missed {
    fn fmt(&self, f: &mut Formatter<'_>) -> Result {
        let place = point_text(self.place);
        match self.why {
            Why::OutOfReach(Some(by)) => write!(f, "{place} is out of reach by {:.0} mm", (1000.0 * by).ceil()),
            Why::OutOfReach(None) => write!(f, "{place} is out of reach"),
            Why::Turn => write!(f, "{place} is in reach, but not with the tool turned so: a joint would pass its limit"),
            Why::NotStraight => write!(
                f,
                "{place} is in reach, but not in a straight line: on the way the arm would have to bend in another way"
            ),
            Why::NoPath => write!(f, "the planner found no path to {place} that keeps off all obstacles"),
            Why::Direction => write!(f, "the direction at {place} is neither down nor level"),
        }
    }
}
