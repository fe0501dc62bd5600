//! How one machine moves from now on, until a motion changes.

use super::group::{Anchor, Body};
use crate::motion::Motion;
use crate::part::track::Ride;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;

/// Times are seconds from now.
#[derive(Clone, Debug)]
pub enum Movement {
    Still,
    Slides {
        velocity: Point,
        from: f64,
        until: f64,
    },
    /// `now_ms` is now on the ride's clock.
    Rides {
        ride: Ride,
        now_ms: f64,
    },
    /// `begin` is now on the motion's clock.
    Swings {
        motion: Motion,
        begin: f64,
    },
}

impl Movement {
    /// Of what is not over yet.
    pub fn new(trajectory: &Trajectory, now_ms: f64) -> Self {
        match trajectory {
            Trajectory::Rests => Self::Still,
            Trajectory::Drives { velocity, from_ms, until_ms } => Self::Slides {
                velocity: *velocity,
                from: (from_ms - now_ms) / 1000.0,
                until: (until_ms - now_ms) / 1000.0,
            },
            Trajectory::Rides(ride) => Self::Rides { ride: ride.clone(), now_ms },
            Trajectory::Swings(motion) => Self::Swings { motion: motion.clone(), begin: now_ms / 1000.0 },
        }
    }

    /// Whether its path is known from its beginning to its end: not of what rests, does not come to rest by itself, or
    /// is no arm and has set out.
    pub fn has_whole_path(&self) -> bool {
        match self {
            Self::Still | Self::Rides { .. } => false,
            Self::Slides { until, .. } => self.is_about_to_slide() && until.is_finite(),
            Self::Swings { .. } => true,
        }
    }

    /// When what slides comes to rest; 0 for all else.
    pub fn end(&self) -> f64 {
        match self {
            Self::Slides { until, .. } => *until,
            Self::Still | Self::Rides { .. } | Self::Swings { .. } => 0.0,
        }
    }

    /// Seconds from now; infinity if it rests, or does not come to rest by itself.
    pub fn rests_after(&self) -> f64 {
        match self {
            Self::Still => f64::INFINITY,
            Self::Slides { until, .. } => *until,
            Self::Rides { ride, now_ms } => (ride.end_ms() - now_ms) / 1000.0,
            Self::Swings { motion, begin } => motion.rests_at() - begin,
        }
    }

    /// It has not set out yet.
    fn is_about_to_slide(&self) -> bool {
        matches!(self, Self::Slides { from, .. } if *from >= 0.0)
    }

    /// Both are motions along the same path.
    pub fn goes_on(&self, last: &Self) -> bool {
        matches!(
            (self, last),
            (Self::Swings { motion, .. }, Self::Swings { motion: last, .. }) if motion.is_along(last)
        )
    }

    /// Between two times: metres of what slides, both times of what rides, or both places on the path of an arm.
    pub fn span(&self, from: f64, to: f64) -> [f64; 2] {
        match self {
            Self::Still => [0.0; 2],
            Self::Slides { .. } => [0.0, (self.shift(to) - self.shift(from)).length()],
            Self::Rides { now_ms, .. } => [now_ms + 1000.0 * from, now_ms + 1000.0 * to],
            Self::Swings { motion, begin } => [motion.place(begin + from), motion.place(begin + to)],
        }
    }

    /// Metres that no point of the body goes more than in this span.
    pub fn path(&self, body: &Body, [from, to]: [f64; 2]) -> f64 {
        match (self, body.anchor) {
            (Self::Still, _) | (_, Anchor::World) => 0.0,
            (Self::Slides { .. }, _) => to - from,
            (Self::Rides { ride, .. }, _) => {
                ride.path(body.ball.middle.length() + body.ball.radius, from, to)
            }
            (Self::Swings { motion, .. }, _) => {
                let travel = body.travel(motion);
                travel.to(to) - travel.to(from)
            }
        }
    }

    /// How far it has slid by then; zero for what rides along a track: what lies on it is a body of it.
    pub fn shift(&self, time: f64) -> Point {
        match self {
            Self::Slides { velocity, from, until } => {
                velocity.scaled((time.min(*until) - from.max(0.0)).max(0.0))
            }
            Self::Still | Self::Rides { .. } | Self::Swings { .. } => Point::default(),
        }
    }
}
