//! How a machine is going to move, as far as its last command says.

use crate::motion::Motion;
use crate::part::track::Ride;
use crate::point::Point;

/// The movement of whatever lies or hangs on a machine, until a command, a hold or the end of it changes it.
/// Times are counted from the start of the run.
#[derive(Clone, Debug, PartialEq)]
pub enum Trajectory {
    Rests,
    /// Straight on with one velocity, in m/s, between two times; before and after it rests.
    Drives {
        velocity: Point,
        from_ms: f64,
        until_ms: f64,
    },
    /// Along a track.
    Rides(Ride),
    /// The joints of an arm; its times are seconds.
    Swings(Motion),
}

impl Trajectory {
    /// Whether it is under way at this time and ends by itself.
    pub fn comes_to_rest(&self, ms: f64) -> bool {
        match self {
            Trajectory::Rests => false,
            Trajectory::Drives { until_ms, .. } => until_ms.is_finite() && *until_ms > ms,
            Trajectory::Rides(ride) => ride.end_ms() > ms,
            Trajectory::Swings(motion) => motion.rests_at() * 1000.0 > ms,
        }
    }

    /// Of what is carried along, m/s; 0 for an arm.
    pub fn speed(&self) -> f64 {
        match self {
            Trajectory::Drives { velocity, .. } => velocity.length(),
            Trajectory::Rides(ride) => ride.top_speed(),
            Trajectory::Rests | Trajectory::Swings(_) => 0.0,
        }
    }

    /// What is left of it at this time.
    pub fn since(self, ms: f64) -> Self {
        let is_over = match &self {
            Trajectory::Rests => true,
            Trajectory::Drives { until_ms, .. } => *until_ms <= ms,
            Trajectory::Rides(ride) => ride.end_ms() <= ms,
            Trajectory::Swings(motion) => motion.rests_at() * 1000.0 <= ms,
        };
        if is_over { Trajectory::Rests } else { self }
    }
}
