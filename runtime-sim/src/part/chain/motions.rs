//! The motions of an arm: what was asked for before is not computed again.

use super::drive::Target;
use super::missed::{Missed, Why};
use crate::answers::Answers;
use crate::collision::reach::{Ball, Chain, Radii};
use crate::kinematics::arm::{Arm, Joints, Limits, MOST_JOINTS};
use crate::kinematics::facing::Facing;
use crate::machine::Machine;
use crate::memory::take;
use crate::motion::{Knot, Motion, Path, Travel};
use crate::planner::{End, Load, Planner, Transfer};
use crate::point::Point;
use std::collections::HashMap;
use std::ops::RangeInclusive;
use std::sync::Arc;

/// All motions of one machine, in all runs of the same line.
#[derive(Debug)]
pub struct Motions {
    arm: Arm,
    /// What a gantry knows of its surroundings.
    planner: Option<Planner>,
    /// How far the tool goes at most for a metre or a radian of each joint, m.
    radii: Radii,
    known: Answers<Question, Result<Planned, Missed>>,
    /// What other processes have planned.
    stored: Stored,
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
/// The last words of questions for the planner.
const PLANNED: RangeInclusive<u64> = 3..=6;

/// Paths of a planner, by what it was asked: past these joints from where the question begins. None where nothing
/// leads.
#[derive(Clone, Debug, Default)]
pub struct Stored(HashMap<Question, Option<Vec<Joints>>>);

impl Stored {
    pub fn write(&self, words: &mut Vec<u64>) {
        words.push(self.0.len() as u64);
        for (question, knots) in &self.0 {
            words.push(question.0.len() as u64);
            words.extend(&question.0);
            let knots = knots.as_deref().unwrap_or_default();
            words.push(knots.len() as u64);
            for joints in knots {
                words.push(joints.len() as u64);
                words.extend(joints.iter().map(|value| value.to_bits()));
            }
        }
    }

    /// None if these are other words.
    pub fn read(words: &mut &[u64]) -> Option<Self> {
        let mut paths = HashMap::new();
        for _ in 0..take(words)? {
            let question = (0..take(words)?).map(|_| take(words)).collect::<Option<Vec<_>>>()?;
            let knots = (0..take(words)?).map(|_| read_joints(words)).collect::<Option<Vec<_>>>()?;
            paths.insert(Question(question), Some(knots).filter(|knots| !knots.is_empty()));
        }
        Some(Self(paths))
    }
}

fn read_joints(words: &mut &[u64]) -> Option<Joints> {
    let count = usize::try_from(take(words)?).ok().filter(|count| *count <= MOST_JOINTS)?;
    let values = (0..count).map(|_| take(words).map(f64::from_bits)).collect::<Option<Vec<_>>>()?;
    Some(Joints::new(&values))
}

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
                match facing {
                    Facing::Oriented { x, y } => {
                        words.extend([x, y].map(|value| value.to_bits()));
                        9
                    }
                    Facing::Down | Facing::Level { .. } => {
                        point(&facing.direction());
                        8
                    }
                }
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
    pub fn new(arm: Arm, machine: &Machine, planner: Option<Planner>, stored: Stored) -> Self {
        let chain = Chain::new(&arm, machine);
        let radii = chain.radii(chain.last(), &Ball { middle: Point::default(), radius: 0.0 });
        Self { arm, planner, radii, known: Answers::new(MOST), stored }
    }

    /// So many at most of the paths of the planner, those of late first.
    pub fn to_store(&self, most: usize) -> Stored {
        let is_planned = |Question(words): &Question| words.last().is_some_and(|kind| PLANNED.contains(kind));
        let known = self.known.of_late(most, is_planned).into_iter();
        let mut paths: HashMap<_, _> = known
            .map(|(question, planned)| (question, planned.ok().map(|it| it.motion.path().knots()[1..].to_vec())))
            .collect();
        for (question, knots) in &self.stored.0 {
            if paths.len() < most && !paths.contains_key(question) {
                paths.insert(question.clone(), knots.clone());
            }
        }
        Stored(paths)
    }

    pub fn arm(&self) -> &Arm {
        &self.arm
    }

    /// From rest at joints, begun at `begin`. A part on the
    /// tool gets the direction that it has at `directed`, the same joints but for the last one.
    pub fn planned(
        &self,
        [from, directed]: [&Joints; 2],
        target: &Target,
        limits: &Limits,
        begin: f64,
    ) -> Result<Planned, Missed> {
        let question = Question::new([from, directed], target, limits);
        let stored = self.stored.0.get(&question);
        let planned = self.known.get(question, || {
            let motion = self.computed([from, directed], target, limits, stored)?;
            Ok(self.measured(motion))
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
        stored: Option<&Option<Vec<Joints>>>,
    ) -> Result<Motion, Missed> {
        let arm = &self.arm;
        let knots = |joints: Vec<Joints>| joints.into_iter().map(Knot::new).collect();
        let out_of_reach = |place: Point| Missed::out_of_reach(place, arm.margin(place));
        let solve =
            |place: Point, from: &Joints| arm.solve(place, from).ok_or_else(|| out_of_reach(place));
        let knots: Vec<Knot> = match target {
            Target::Place(goal) => {
                let line = arm.line_to(*goal, directed);
                knots(line.map_err(|why| Missed::new(arm, *goal, Facing::Down, why))?)
            }
            Target::Direct(goal) => vec![Knot::new(solve(*goal, directed)?)],
            Target::Facing(goal, facing) => {
                let line = arm.line_facing(*goal, *facing, directed);
                knots(line.map_err(|why| Missed::new(arm, *goal, *facing, why))?)
            }
            Target::Turned(goal, turn) => {
                let joints = arm.solve_turned(*goal, *turn, directed);
                vec![Knot::new(joints.ok_or_else(|| Missed::turned(arm, *goal))?)]
            }
            Target::Past(via, goal) => {
                let via = solve(*via, directed)?;
                vec![Knot::new(via), Knot::new(solve(*goal, &via)?)]
            }
            Target::Round(transfer, load) => {
                if let Some(Some(stored)) = stored {
                    knots(stored.clone())
                } else {
                    let planner = self.planner.as_ref().filter(|_| stored.is_none());
                    let path =
                        planner.and_then(|planner| planner.path([from, directed], *load, transfer, limits));
                    let path = path.ok_or_else(|| self.without_path(transfer))?;
                    return Ok(Motion::on(path, limits, 0.0));
                }
            }
        };
        Ok(Motion::past(*from, &knots, limits, 0.0))
    }

    /// The first of its places that is out of reach, else there is no path.
    fn without_path(&self, transfer: &Transfer) -> Missed {
        let beyond = |place: &Point| {
            let margin = self.arm.margin(*place);
            (margin.is_nan() || margin < 0.0).then(|| Missed::out_of_reach(*place, margin))
        };
        let Transfer { via, goal, .. } = transfer;
        [via, goal].into_iter().find_map(beyond).unwrap_or(Missed { place: *goal, why: Why::NoPath })
    }
}
