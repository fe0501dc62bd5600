//! What the robot has found at a place, or between two: many paths begin or end there.

use super::line::Line;
use super::plane::Start;
use super::timing::Lift;
use super::{Candidate, Load, Planner, Vertical};
use crate::answers::Answers;
use crate::kinematics::arm::{Joints, Limits, MOST_JOINTS};
use std::sync::Arc;

/// Joints to the bit.
type Bits = [u64; MOST_JOINTS];
/// Its place on both rails and its turn.
type Torso = [u64; 3];

/// From torso to torso, and how far it draws back at either end.
type Trip = ([Torso; 2], [u64; 2]);

/// By all that it depends on.
#[derive(Debug)]
pub struct Seen {
    /// From joints, up to a height, with a load.
    verticals: Answers<(Bits, u64, Load), Option<Vertical>>,
    /// Over a place and at it.
    free: Answers<[Bits; 2], bool>,
    /// From joints, up to a height, with limits of velocity and acceleration.
    lifts: Answers<(Bits, u64, [Bits; 2]), Option<Arc<Lift>>>,
    lines: Answers<Trip, Option<Arc<Line>>>,
}

/// Twice as many are remembered at most: 150 bytes each.
const MOST: usize = 20_000;
/// The same of what has some hundred numbers: 1 kB each.
const MOST_LONG: usize = 5_000;

impl Seen {
    pub fn new() -> Self {
        Self {
            verticals: Answers::new(MOST),
            free: Answers::new(MOST),
            lifts: Answers::new(MOST_LONG),
            lines: Answers::new(MOST_LONG),
        }
    }
}

impl Planner {
    /// The straight line of the tool up to a height, from these joints; none if something is in the way.
    pub(super) fn vertical(&self, low: &Joints, top: f64, load: Load) -> Option<Vertical> {
        let question = (low.bits(), top.to_bits(), load);
        self.seen.verticals.get(question, || self.compute_vertical(low, top, load))
    }

    pub(super) fn is_free_at_place(&self, candidate: &Candidate) -> bool {
        let question = [&candidate.over, &candidate.at].map(Joints::bits);
        self.seen.free.get(question, || self.compute_is_free_at_place(candidate))
    }

    /// How the tool is lifted to a height, as fast as the limits allow; none if the reach forbids it.
    pub(super) fn lift(&self, from: &Joints, top: f64, limits: &Limits) -> Option<Arc<Lift>> {
        let Limits { velocity, acceleration } = limits;
        let question = (from.bits(), top.to_bits(), [velocity, acceleration].map(Joints::bits));
        self.seen.lifts.get(question, || self.compute_lift(from, top, limits).map(Arc::new))
    }

    /// The line of the torso's axis, which draws back to `start` first; none if nothing leads round the obstacles.
    pub(super) fn line(
        &self,
        from: &Joints,
        start: &mut Start,
        to: &Joints,
        backs: [f64; 2],
    ) -> Option<Arc<Line>> {
        let torso = |joints: &Joints| -> Torso { [0, 1, 2].map(|i| joints[i].to_bits()) };
        let question = ([torso(from), torso(to)], backs.map(f64::to_bits));
        self.seen.lines.get(question, || self.compute_line(from, start, to, backs).map(Arc::new))
    }
}
