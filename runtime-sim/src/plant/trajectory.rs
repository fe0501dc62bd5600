//! How a machine is going to move, as far as its last command says.

use crate::motion::Motion;
use crate::point::Point;

/// The movement of whatever lies or hangs on a machine, until a command, a hold or the end of it changes it.
/// Times are counted from the start of the run.
#[derive(Clone, Debug, PartialEq)]
#[expect(clippy::large_enum_variant)] // one for each machine
pub enum Trajectory {
    Rests,
    /// Straight on with one velocity, in m/s, between two times; before and after it rests.
    Drives {
        velocity: Point,
        from_ms: f64,
        until_ms: f64,
    },
    /// The joints of an arm; its times are seconds.
    Swings(Motion),
}

impl Trajectory {
    /// What is left of it at this time.
    pub fn since(self, ms: f64) -> Self {
        let is_over = match &self {
            Trajectory::Rests => true,
            Trajectory::Drives { until_ms, .. } => *until_ms <= ms,
            Trajectory::Swings(motion) => motion.rests_at() * 1000.0 <= ms,
        };
        if is_over { Trajectory::Rests } else { self }
    }
}
