//! The motions of an arm: what was asked for before is not computed again.

use super::drive::Target;
use crate::answers::Answers;
use crate::collision::reach::{Ball, Chain, Radii};
use crate::kinematics::arm::{Arm, Joints, Limits};
use crate::machine::Machine;
use crate::motion::{Knot, Motion, Path, Travel};
use crate::planner::{End, Load, Planner, Transfer};
use crate::point::Point;
use std::sync::Arc;

/// All motions of one machine, in all runs of the same line.
#[derive(Debug)]
pub struct Motions {
    arm: Arm,
    /// What a gantry knows of its surroundings.
    planner: Option<Planner>,
    /// How far the tool goes at most for a metre or a radian of each joint, m.
    radii: Radii,
    known: Answers<Question, Option<Planned>>,
}

/// A motion from rest to rest, and how far the tool goes at most along it.
#[derive(Clone, Debug, PartialEq)]
pub struct Planned {
    pub motion: Motion,
    pub tool: Arc<Travel>,
}

/// All that a motion depends on, to the bit.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
struct Question(Vec<u64>);

/// Twice as many are remembered at most: some 10 kB each.
const MOST: usize = 8_000;

impl Question {
    fn new([from, directed]: [&Joints; 2], target: &Target, limits: &Limits) -> Self {
        let mut words: Vec<u64> = Vec::with_capacity(40);
        let limits = limits.velocity.iter().chain(limits.acceleration.iter());
        words.extend(from.iter().chain(directed.iter().last()).chain(limits).map(|value| value.to_bits()));
        let mut point = |point: &Point| words.extend([point.x, point.y, point.z].map(f64::to_bits));
        let kind = match target {
            Target::Place(goal) => {
                point(goal);
                0
            }
            Target::Direct(goal) => {
                point(goal);
                7
            }
            Target::Facing(goal, facing) => {
                point(goal);
                point(&facing.direction());
                8
            }
            Target::Turned(goal, turn) => {
                point(goal);
                words.push(turn.to_bits());
                1
            }
            Target::Past(via, goal) => {
                point(via);
                point(goal);
                2
            }
            Target::Round(Transfer { via, goal, end }, load) => {
                point(via);
                point(goal);
                3 + 2 * u64::from(*end == End::AtGoal) + u64::from(*load == Load::Largest)
            }
        };
        words.push(kind);
        Self(words)
    }
}

impl Motions {
    pub fn new(arm: Arm, machine: &Machine, planner: Option<Planner>) -> Self {
        let chain = Chain::new(&arm, machine);
        let radii = chain.radii(chain.last(), &Ball { middle: Point::default(), radius: 0.0 });
        Self { arm, planner, radii, known: Answers::new(MOST) }
    }

    pub fn arm(&self) -> &Arm {
        &self.arm
    }

    /// From rest at joints, begun at `begin`; none if no joints bring the tool there, or no path is free. A part on the
    /// tool gets the direction that it has at `directed`, the same joints but for the last one.
    pub fn planned(
        &self,
        [from, directed]: [&Joints; 2],
        target: &Target,
        limits: &Limits,
        begin: f64,
    ) -> Option<Planned> {
        let question = Question::new([from, directed], target, limits);
        let planned = self.known.get(question, || {
            let motion = self.computed([from, directed], target, limits)?;
            Some(self.measured(motion))
        });
        planned.map(|Planned { motion, tool }| Planned { motion: motion.begun(begin), tool })
    }

    /// The same along a path that is known.
    pub fn along(&self, path: Path, limits: &Limits, begin: f64) -> Planned {
        self.measured(Motion::on(path, limits, begin))
    }

    fn measured(&self, motion: Motion) -> Planned {
        let tool = Arc::new(motion.travel(&self.radii));
        Planned { motion, tool }
    }

    fn computed(
        &self,
        [from, directed]: [&Joints; 2],
        target: &Target,
        limits: &Limits,
    ) -> Option<Motion> {
        let knots = match target {
            Target::Place(goal) => self.arm.line_to(*goal, directed).ok()?.into_iter().map(Knot::new).collect(),
            Target::Direct(goal) => vec![Knot::new(self.arm.solve(*goal, directed)?)],
            Target::Facing(goal, facing) => {
                self.arm.line_facing(*goal, *facing, directed).ok()?.into_iter().map(Knot::new).collect()
            }
            Target::Turned(goal, turn) => vec![Knot::new(self.arm.solve_turned(*goal, *turn, directed)?)],
            Target::Past(via, goal) => {
                let via = self.arm.solve(*via, directed)?;
                vec![Knot::new(via), Knot::new(self.arm.solve(*goal, &via)?)]
            }
            Target::Round(transfer, load) => {
                let path = self.planner.as_ref()?.path([from, directed], *load, transfer, limits)?;
                return Some(Motion::on(path, limits, 0.0));
            }
        };
        Some(Motion::past(*from, &knots, limits, 0.0))
    }
}
