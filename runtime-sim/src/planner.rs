//! Plans the paths of a gantry round obstacles.
//!
//! Up as high as its goal or, if need be, over all obstacles; then with torso and rails round them; then down. All
//! of it is one path without a stop. The robot knows the layout: machines and obstacles, vehicles at the stops at which
//! they can be, and all trips between these. A vehicle over whose tray a path begins or ends waits there. The robot does
//! not know where others are at present, nor other arms.

mod check;
mod gap;
mod line;
mod member;
mod obstacle;
mod options;
mod plane;
mod scene;
mod seen;
mod timing;

use crate::kinematics::arm::{Arm, FINEST_TURN, Joints, Limits, Posture};
use crate::kinematics::gantry::{Stance, Wrist};
use crate::kinematics::straight::LINE_STEP;
use crate::kinematics::{nearest_equivalent, nearest_turn, wrapped};
use crate::motion::{Knot, Motion, Path};
use crate::point::Point;
pub use gap::Load;
use line::Line;
use options::Options;
use plane::{Plane, Rectangle, Start};

use scene::Scene;
use seen::Seen;
use std::f64::consts::PI;
use std::sync::Arc;
use timing::{Lift, Timing};

/// What a gantry knows of its surroundings.
#[derive(Debug)]
pub struct Planner {
    arm: Arm,
    scene: Scene,
    area: Rectangle,
    plane: Plane,
    seen: Seen,
}

/// Where the tool is to be brought.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transfer {
    /// Straight over `goal`.
    pub via: Point,
    pub goal: Point,
    pub end: End,
}

impl Transfer {
    /// How far the path goes straight down to the goal, m.
    fn clearance(&self) -> f64 {
        self.via.z - self.goal.z
    }
}

/// Where a path ends.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    /// At `via`, from where the tool can be lowered to `goal`.
    Above,
    AtGoal,
}

/// What a path is asked for.
struct Task<'a> {
    from: &'a Joints,
    load: Load,
    transfer: &'a Transfer,
    limits: &'a Limits,
    /// From where the path begins, to each height on which it may go over.
    rises: Vec<Vertical>,
}

/// How the robot may be over a place and at it.
struct Candidate {
    stance: Stance,
    over: Joints,
    at: Joints,
}

impl Candidate {
    fn end(&self, transfer: &Transfer) -> Joints {
        match transfer.end {
            End::Above => self.over,
            End::AtGoal => self.at,
        }
    }
}

/// The tool can go straight up from a place.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Vertical {
    /// To this height, m.
    top: f64,
    /// How far the robot is from all obstacles there, m; no less than [`MARGIN_AT_PLACE`], and not looked at beyond
    /// [`MARGIN`].
    gap: f64,
}

/// On a path nothing comes nearer, m.
const MARGIN: f64 = 0.015;
/// The same where the tool is lowered to a part or lifts it.
const MARGIN_AT_PLACE: f64 = 0.003;
/// A part that is lifted is clear of what it lay on when its underside is so high over it, m.
const LIFTED: f64 = 0.02;
/// The tool may be so far beyond the shoulder at a place, m; the best first.
const BEYOND: [f64; 5] = [0.45, 0.6, 0.3, 0.15, 0.0];
/// Turns of the torso at a place on either side of 0: steps of 22.5 degrees.
const TURNS: i32 = 8;

/// How much is tried before the next effort.
struct Effort {
    /// So many paths.
    tries: usize,
    /// How far the robot draws back at the beginning, and from how far back it comes at the end, m.
    backs: &'static [[f64; 2]],
}

const EFFORTS: [Effort; 2] = [
    Effort { tries: 100, backs: &[[0.0, 0.0]] },
    Effort {
        tries: 1000,
        backs: &[
            [0.4, 0.0],
            [0.0, 0.4],
            [0.4, 0.4],
            [0.8, 0.4],
            [0.4, 0.8],
            [0.2, 0.2],
            [0.2, 0.0],
            [0.0, 0.2],
            [0.8, 0.0],
            [0.0, 0.8],
            [0.8, 0.8],
            [1.2, 0.4],
            [0.4, 1.2],
            [1.2, 1.2],
        ],
    },
];
/// How far the tool is lifted before the torso sets out, and how high it still is when the torso arrives, m; the least first,
/// with which no path takes longer.
const CLEARS: [f64; 4] = [STRAIGHT, 0.4, 0.6, f64::INFINITY];
/// Pieces of a line by which it is timed, m.
const LIFT_STEP: f64 = 0.1;
/// A plan becomes joints so often, s.
const SAMPLE: f64 = 0.15;
/// So high over a place the tool goes straight up and down, m; beyond that its line is made of longer and longer
/// pieces, on which it is less and less straight.
const STRAIGHT: f64 = 0.25;
const WIDER_STEP: f64 = 1.3;
const WRISTS: [Wrist; 2] = [Wrist::Inside, Wrist::Outside];

/// When the robot is where between the ends of a path.
struct Plan {
    timing: Timing,
    line: Arc<Line>,
    stances: [Stance; 2],
    ends: [Joints; 2],
}

impl Plan {
    /// It becomes joints at so many times behind the begin.
    fn samples(&self) -> u32 {
        (self.timing.end / SAMPLE).ceil().max(1.0) as u32
    }

    /// Of a sample, s.
    fn time(&self, sample: u32) -> f64 {
        self.timing.end * f64::from(sample) / f64::from(self.samples())
    }
}

/// When the torso turns as it goes.
#[derive(Clone, Copy)]
pub enum Turning {
    Evenly,
    First,
    Last,
}

/// The first one takes no longer than the others.
const TURNINGS: [Turning; 3] = [Turning::Evenly, Turning::First, Turning::Last];

impl Planner {
    /// Of the machine of this number; none if it is no gantry.
    pub fn of(line: &crate::line::Line, index: usize) -> Option<Self> {
        let (scene, blocks) = Scene::of(line, index)?;
        let arm = line.machines[index].arm()?;
        let [x, y] = arm.gantry()?.rails();
        let area = Rectangle { low: Point::new(x[0], y[0], 0.0), high: Point::new(x[1], y[1], 0.0) };
        Some(Self { arm, scene, area, plane: Plane::new(blocks, area), seen: Seen::new() })
    }

    /// None if no path keeps off all obstacles. With a part on the tool the wrist stays on its side, and the part gets
    /// the direction that it has at `directed`, the same joints as those of the begin but for the last one.
    pub fn path(
        &self,
        [from, directed]: [&Joints; 2],
        load: Load,
        transfer: &Transfer,
        limits: &Limits,
    ) -> Option<Path> {
        let low = self.arm.tool(from).z.max(transfer.via.z);
        let mut tops = vec![low, low.max(self.scene.over_all)];
        tops.dedup();
        let rises = tops.iter().filter_map(|top| self.vertical(from, *top, load)).collect();
        let task = Task { from, load, transfer, limits, rises };
        let present = Wrist::of_angle(from[7]);
        let mut wrists = WRISTS.into_iter().filter(|wrist| load == Load::None || *wrist == present);
        wrists.find_map(|wrist| {
            let candidates = self.candidates(directed, wrist, transfer);
            EFFORTS.iter().find_map(|effort| {
                candidates.iter().find_map(|candidates| self.quickest(&task, candidates, effort))
            })
        })
    }

    /// The quickest path: the first one that is free of those that are next in time.
    fn quickest(&self, task: &Task, candidates: &[Candidate], effort: &Effort) -> Option<Path> {
        let Task { from, load, transfer, limits, rises } = task;
        let first = self.arm.stance(from)?;
        let mut options = Options::new(self, task, &first, candidates, effort);
        let mut tries = 0;
        let (mut suspect_time, mut suspect) = (0.5, 0.5);
        while let Some((choice, timing, line, fall)) = options.next() {
            let candidate = &candidates[choice.candidate];
            let (rise, end) = (&rises[choice.rise], candidate.end(transfer));
            tries += 1;
            if tries > effort.tries {
                return None;
            }
            let margin = MARGIN.min(rise.gap).min(fall.gap);
            let plan = Plan { timing, line, stances: [first, candidate.stance], ends: [**from, end] };
            if !self.may_be_free(&plan, *load, margin, &mut suspect_time) {
                continue;
            }
            let Some(knots) = self.sampled(&plan, *load) else { continue };
            let path = Path::new(**from, &knots, limits);
            if self.is_free([from, &end], &path, *load, margin, &mut suspect) {
                return Some(path);
            }
        }
        None
    }

    /// How the tool is lowered from the top of a rise; none if something is in the way.
    fn fall(&self, task: &Task, candidate: &Candidate, rise: &Vertical) -> Option<Vertical> {
        // What is fetched is lifted from there, as high as it may have to go.
        let (lifted, top) = match task.transfer.end {
            End::AtGoal => {
                (Load::Largest, rise.top.max(self.scene.highest_place + task.transfer.clearance()))
            }
            End::Above => (task.load, rise.top),
        };
        self.vertical(&candidate.end(task.transfer), top, lifted)
    }

    fn compute_lift(&self, from: &Joints, top: f64, limits: &Limits) -> Option<Lift> {
        let tool = self.arm.tool(from);
        let (mut z, mut last) = (tool.z, *from);
        let mut knots = Vec::new();
        while z < top {
            z = if z + 2.0 * LIFT_STEP < top { z + LIFT_STEP } else { top };
            last = self.arm.solve_standing(Point { z, ..tool }, &last)?;
            knots.push(Knot::new(last));
        }
        let motion = Motion::past(*from, &knots, limits, 0.0);
        Some(Lift::new(motion.rests_at(), |t| self.arm.tool(&motion.at(t)).z))
    }

    fn compute_line(
        &self,
        from: &Joints,
        start: &mut Start,
        to: &Joints,
        [back, forth]: [f64; 2],
    ) -> Option<Line> {
        let end = self.drawn_back(to, forth)?;
        let mut places = vec![axis(from)];
        if back > 0.0 {
            places.push(start.point());
        }
        places.extend(self.plane.shortest(start, end)?);
        if forth > 0.0 {
            places.push(end);
        }
        places.push(axis(to));
        Some(Line::new(&places))
    }

    /// All stances that the reach allows. Those in which the torso stands as far off obstacles as it keeps on its path
    /// are enough where there are any: it gets out of them again.
    fn candidates(&self, directed: &Joints, wrist: Wrist, transfer: &Transfer) -> [Vec<Candidate>; 2] {
        let (mut wide, mut narrow) = (Vec::new(), Vec::new());
        let directed = self.arm.posture(directed);
        for turn in (-TURNS..=TURNS).map(|step| f64::from(step) * PI / f64::from(TURNS)) {
            for beyond in BEYOND {
                let stance = Stance { turn, beyond, wrist };
                let joints = |tool| self.arm.solve_stance(tool, &stance, &directed);
                let (Some(over), Some(at)) = (joints(transfer.via), joints(transfer.goal)) else { continue };
                let list = if self.plane.keeps_off(axis(&over)) { &mut wide } else { &mut narrow };
                list.push(Candidate { stance, over, at });
            }
        }
        [wide, narrow]
    }

    fn compute_is_free_at_place(&self, Candidate { over, at, .. }: &Candidate) -> bool {
        let near = self.scene.near([over, at].map(axis), &[self.arm.tool(at)]);
        let gap = |joints, enough| self.scene.gap(&near, joints, Load::None, [enough; 2]);
        gap(at, MARGIN_AT_PLACE) >= MARGIN_AT_PLACE
            && gap(over, MARGIN_AT_PLACE) >= MARGIN_AT_PLACE
            && self.scene.gap_at_place(at, MARGIN_AT_PLACE) >= MARGIN_AT_PLACE
    }

    /// The joints at a time of a plan, with whole turns as they are at `near`; none where the reach forbids it. A wrist
    /// changes its side while the torso moves.
    fn at_time(&self, plan: &Plan, time: f64, near: &Posture) -> Option<Joints> {
        let (part, turned, height) = plan.timing.at(time);
        let ([first, last], [from, to]) = (&plan.stances, &plan.ends);
        let place = if part <= 0.0 {
            axis(from)
        } else if part >= 1.0 {
            axis(to)
        } else {
            plan.line.at(part * plan.line.length())
        };
        let standing = |wrist: Wrist, near: &Posture| {
            let turn = first.turn + turned * (last.turn - first.turn);
            let beyond = first.beyond + part * (last.beyond - first.beyond);
            self.arm.standing_at(place, height, &Stance { turn, beyond, wrist }, near)
        };
        if first.wrist == last.wrist {
            return standing(last.wrist, near);
        }
        let from = self.arm.posture(from);
        match plan.timing.passed(time) {
            0.0 => standing(first.wrist, &from),
            1.0 => standing(last.wrist, &from),
            share => {
                let (here, there) = (standing(first.wrist, &from)?, standing(last.wrist, &from)?);
                Some(here.map(|i, angle| angle + share * (there[i] - angle)))
            }
        }
    }

    /// The joints at regular times of a plan, and those at its end.
    fn sampled(&self, plan: &Plan, load: Load) -> Option<Vec<Knot>> {
        let [from, to] = &plan.ends;
        let count = plan.samples();
        let mut knots: Vec<Knot> = Vec::with_capacity(count as usize);
        for i in 1..count {
            let near = knots.last().map_or(from, |knot| &knot.joints);
            knots.push(Knot::new(self.at_time(plan, plan.time(i), &self.arm.posture(near))?));
        }
        let tool = to.len() - 1;
        let reached = knots.last().map_or(from[tool], |knot| knot.joints[tool]);
        let (end, turns) = match load {
            // There is no direction to be kept. Not wound up, the last joint can keep that of a part that is fetched.
            Load::None => (wrapped(to[tool]), wrapped(to[tool]) - from[tool]),
            // Where the limits of the last joint do not let it keep the direction of the part, it turns back while the
            // torso moves.
            Load::Largest => turned(to[tool], reached),
        };
        for (i, knot) in (1..count).zip(&mut knots) {
            let begin = if load == Load::None { from[tool] } else { knot.joints[tool] };
            let angle = begin + plan.timing.passed(plan.time(i)) * turns;
            knot.joints = knot.joints.map(|i, value| if i == tool { angle } else { value });
        }
        knots.push(Knot::new(to.map(|i, value| if i == tool { end } else { value })));
        Some(knots)
    }

    fn compute_vertical(&self, low: &Joints, top: f64, load: Load) -> Option<Vertical> {
        let tool = self.arm.tool(low);
        let near = self.scene.near([axis(low)], &[tool]);
        let gap = if tool.z < top {
            f64::INFINITY
        } else {
            self.scene.gap(&near, low, load, [MARGIN_AT_PLACE, MARGIN])
        };
        let mut vertical = Vertical { top, gap };
        let (mut z, mut step, mut last) = (tool.z, LINE_STEP, *low);
        while z < top {
            if z >= tool.z + STRAIGHT {
                step *= WIDER_STEP;
            }
            z = if z + 1.5 * step < top { z + step } else { top };
            last = self.arm.solve_standing(Point { z, ..tool }, &last)?;
            let lifted = z > tool.z + self.scene.load_height + LIFTED;
            let load = if lifted { load } else { Load::None };
            vertical.gap = self.scene.gap(&near, &last, load, [MARGIN_AT_PLACE, MARGIN]);
            if vertical.gap < MARGIN_AT_PLACE {
                return None;
            }
        }
        Some(vertical)
    }

    /// Where the torso is this much farther from what the arm points to, m; none if the rails end before.
    fn drawn_back(&self, joints: &Joints, distance: f64) -> Option<Point> {
        let (s, c) = libm::sincos(joints[2]);
        let there = axis(joints) + Point::new(s, -c, 0.0).scaled(distance);
        self.area.contains(there).then_some(there)
    }
}

/// The angle at which the last joint ends, and how far it has to turn to it beside keeping a part's direction.
fn turned(end: f64, reached: f64) -> (f64, f64) {
    let end = nearest_turn(end, reached);
    let back = nearest_equivalent(end, reached);
    // After a motion that was broken off it turns to the direction that the part should have.
    let begin = if (back - reached).abs() < 4.0 * FINEST_TURN { back } else { reached };
    (end, end - begin)
}

/// Where the torso's axis is.
fn axis(joints: &Joints) -> Point {
    Point::new(joints[0], joints[1], 0.0)
}
