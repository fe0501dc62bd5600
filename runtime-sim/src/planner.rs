//! Plans the paths of a gantry round obstacles.
//!
//! Up as high as its goal or, if need be, over all that stands; then with torso and rails round it; then down. The
//! robot knows the layout: machines and obstacles, vehicles at their stops and on the trip from the first to the
//! second. It does not know where others are at present, nor other arms.

mod plane;
mod scene;

use crate::kinematics::arm::{Arm, Joints, Limits};
use crate::kinematics::gantry::{Stance, Wrist};
use crate::kinematics::nearest_turn;
use crate::motion::Motion;
use crate::point::Point;
use plane::{Rectangle, keeps_off, shortest};
pub use scene::Load;
use scene::Scene;
use std::f64::consts::FRAC_PI_4;

/// What a gantry knows of its surroundings.
#[derive(Clone, Debug)]
pub struct Planner {
    arm: Arm,
    scene: Scene,
    area: Rectangle,
}

/// A part of a path, from rest to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Leg {
    To(Joints),
    /// To the second past the first.
    Past(Joints, Joints),
}

/// On a path, and at its end, nothing comes nearer, m.
const MARGIN: f64 = 0.015;
const MARGIN_AT_PLACE: f64 = 0.003;
/// What is farther than this is not looked at, m.
const ENOUGH: f64 = 0.12;
/// The tool may be so far beyond the shoulder at a place, m; the best first.
const BEYOND: [f64; 5] = [0.45, 0.6, 0.3, 0.15, 0.0];
/// How far the robot draws back at the beginning, and from how far back it comes at the end, m; the best first.
const BACK: [[f64; 2]; 6] = [[0.0, 0.0], [0.4, 0.0], [0.0, 0.4], [0.4, 0.4], [0.8, 0.4], [0.4, 0.8]];
/// The same where none of these leads to a path.
const FARTHER_BACK: [[f64; 2]; 9] = [
    [0.2, 0.2],
    [0.2, 0.0],
    [0.0, 0.2],
    [0.8, 0.0],
    [0.0, 0.8],
    [0.8, 0.8],
    [1.2, 0.4],
    [0.4, 1.2],
    [1.2, 1.2],
];
/// Paths to so many stances are tried at first.
const TRIES: usize = 8;
/// No point of the robot and its load goes farther for a metre of a rail or a radian of a joint, m: from the axis to
/// the end of the stretched arm, from the shoulder, from the elbow, from the wrists.
const RADII: [f64; 9] = [1.0, 1.0, 2.2, 1.6, 1.6, 1.0, 0.5, 0.4, 0.3];
/// A path is looked at again at the latest when some point may have gone so far, m: less than [`MARGIN`].
const SHORTEST_STEP: f64 = 0.01;
const WRISTS: [Wrist; 2] = [Wrist::Inside, Wrist::Outside];

/// Around the torso where it stands.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Clearance {
    Wide,
    Narrow,
}

/// When the torso turns as it goes.
#[derive(Clone, Copy)]
enum Turning {
    Evenly,
    First,
    Last,
}

impl Planner {
    /// Of the machine of this number; none if it is no gantry.
    pub fn of(line: &crate::line::Line, index: usize) -> Option<Self> {
        let scene = Scene::of(line, index)?;
        let arm = line.machines[index].arm()?;
        let [x, y] = arm.gantry()?.rails();
        let area = Rectangle { low: Point::new(x[0], y[0], 0.0), high: Point::new(x[1], y[1], 0.0) };
        Some(Self { arm, scene, area })
    }

    /// Legs that bring the tool to `via`, from where it can be lowered to `goal` while the torso stands; straight over
    /// if no path keeps off all obstacles, none if no stance does.
    pub fn legs(
        &self,
        from: &Joints,
        load: Load,
        [via, goal]: [Point; 2],
        limits: &Limits,
    ) -> Option<Vec<Leg>> {
        let stances = self.stances(from, via, goal, limits);
        let heights = |joints: &Joints| {
            let low = self.arm.tool(joints).z.max(via.z);
            [low, low.max(self.scene.over_all)]
        };
        let tops = heights(from);
        let search = |stances: &[Joints], backs: &[[f64; 2]]| {
            stances.iter().find_map(|to| {
                backs.iter().find_map(|back| {
                    tops.iter().find_map(|top| self.legs_to([from, to], load, *top, *back, limits))
                })
            })
        };
        search(&stances[..stances.len().min(TRIES)], &BACK)
            .or_else(|| search(&stances, &FARTHER_BACK))
            .or_else(|| self.straight(from, stances.first()?, tops[0]))
    }

    /// Up, straight over, and down, whatever stands there.
    fn straight(&self, from: &Joints, to: &Joints, top: f64) -> Option<Vec<Leg>> {
        let all = vec![self.at_height(from, top)?, self.at_height(to, top)?, *to];
        Some(moved(from, all).into_iter().map(Leg::To).collect())
    }

    /// Joints at `via` of stances that are free of obstacles, there and at `goal`: those first in which the torso
    /// stands as far off as it keeps on its path and so gets out again, then the quickest.
    fn stances(&self, from: &Joints, via: Point, goal: Point, limits: &Limits) -> Vec<Joints> {
        let mut found: Vec<(Clearance, f64, Joints)> = Vec::new();
        for turn in (0..8).map(|i| nearest_turn(f64::from(i) * FRAC_PI_4, from[2])) {
            for (wrist, beyond) in WRISTS.into_iter().flat_map(|w| BEYOND.map(|b| (w, b))) {
                let stance = Stance { turn, beyond, wrist };
                let joints = |tool| self.arm.solve_stance(tool, &stance, from);
                let (Some(over), Some(at)) = (joints(via), joints(goal)) else { continue };
                if self.is_free_at_place(&at) && self.scene.gap(&over, Load::None, MARGIN) >= MARGIN {
                    let clearance = if keeps_off(axis(&over), &self.scene.blocks) {
                        Clearance::Wide
                    } else {
                        Clearance::Narrow
                    };
                    found.push((clearance, Motion::undisturbed(*from, over, limits), over));
                    if clearance == Clearance::Wide {
                        break;
                    }
                }
            }
        }
        found.sort_by(|(a, t, _), (b, u, _)| a.cmp(b).then(t.total_cmp(u)));
        found.into_iter().map(|(.., joints)| joints).collect()
    }

    fn is_free_at_place(&self, joints: &Joints) -> bool {
        self.scene.gap(joints, Load::None, MARGIN_AT_PLACE) >= MARGIN_AT_PLACE
            && self.scene.gap_at_place(joints, MARGIN_AT_PLACE) >= MARGIN_AT_PLACE
    }

    fn legs_to(
        &self,
        [from, to]: [&Joints; 2],
        load: Load,
        top: f64,
        [back, forth]: [f64; 2],
        limits: &Limits,
    ) -> Option<Vec<Leg>> {
        let (up, down) = (self.at_height(from, top)?, self.at_height(to, top)?);
        let (start, end) = (self.drawn_back(&up, back)?, self.drawn_back(&down, forth)?);
        let between = shortest([&start, &end].map(axis), &self.scene.blocks, &self.area)?;
        [Turning::Evenly, Turning::First, Turning::Last].into_iter().find_map(|turning| {
            let passed = passed(&start, &end, &between, turning);
            let all = moved(from, [&[up, start], passed.as_slice(), &[end, down, *to]].concat());
            // Round its corners if there is space for that.
            [rounded(&all), all.into_iter().map(Leg::To).collect()]
                .into_iter()
                .find(|legs| self.are_free(from, load, legs, limits))
        })
    }

    /// The torso this much farther from what the arm points to, m; none if the rails end before.
    fn drawn_back(&self, joints: &Joints, distance: f64) -> Option<Joints> {
        let (s, c) = libm::sincos(joints[2]);
        let there = axis(joints) + Point::new(s, -c, 0.0).scaled(distance);
        self.area.contains(there).then(|| at(joints, there, joints[2]))
    }

    /// The same stance with the tool at this height, or as it is if it is there.
    fn at_height(&self, joints: &Joints, height: f64) -> Option<Joints> {
        let tool = self.arm.tool(joints);
        if tool.z == height {
            return Some(*joints);
        }
        self.arm.solve_standing(Point { z: height, ..tool }, joints)
    }

    /// Whether nothing on these legs comes near an obstacle; nearer at least than it was at the beginning.
    fn are_free(&self, from: &Joints, load: Load, legs: &[Leg], limits: &Limits) -> bool {
        let margin = self.scene.gap(from, load, MARGIN);
        let mut at = *from;
        legs.iter().all(|leg| {
            let motion = leg.motion(at, limits, 0.0);
            let rate: f64 = motion.rates().iter().zip(RADII).map(|(rate, radius)| rate * radius).sum();
            let mut place = 0.0;
            while place < 1.0 {
                let gap = self.scene.gap(&motion.along(place), load, ENOUGH);
                if gap < margin {
                    return false;
                }
                place += (gap - margin).max(SHORTEST_STEP) / rate;
            }
            at = motion.goal();
            true
        })
    }
}

impl Leg {
    /// From rest at time `begin`.
    pub fn motion(&self, from: Joints, limits: &Limits, begin: f64) -> Motion {
        match *self {
            Leg::To(to) => Motion::between(from, to, limits, begin),
            Leg::Past(via, to) => Motion::through(from, via, to, limits, begin),
        }
    }
}

/// Where the torso's axis is.
fn axis(joints: &Joints) -> Point {
    Point::new(joints[0], joints[1], 0.0)
}

/// The same arm with the torso elsewhere, at this turn, rad.
fn at(joints: &Joints, place: Point, turn: f64) -> Joints {
    joints.map(|i, value| [place.x, place.y, turn].get(i).copied().unwrap_or(value))
}

/// Joints at the places that the torso passes: the arm as at the beginning.
fn passed(from: &Joints, to: &Joints, places: &[Point], turning: Turning) -> Vec<Joints> {
    let ends = [from, to].map(axis);
    let all: Vec<Point> = [&ends[..1], places, &ends[1..]].concat();
    let lengths: Vec<f64> = all.windows(2).map(|pair| (pair[1] - pair[0]).length()).collect();
    let whole: f64 = lengths.iter().sum();
    let mut gone = 0.0;
    let mut joints = Vec::new();
    for (place, length) in places.iter().zip(&lengths) {
        gone += length;
        let part = match turning {
            Turning::Evenly => gone / whole,
            Turning::First => 1.0,
            Turning::Last => 0.0,
        };
        let turn = from[2] + part * (to[2] - from[2]);
        joints.push(at(from, *place, turn));
    }
    joints
}

/// Without those that are reached already.
fn moved(from: &Joints, mut all: Vec<Joints>) -> Vec<Joints> {
    let mut last = *from;
    all.retain(|joints| std::mem::replace(&mut last, *joints) != *joints);
    all
}

/// Past every second of these joints.
fn rounded(all: &[Joints]) -> Vec<Leg> {
    let pairs = all.chunks(2);
    pairs.map(|pair| if let [via, to] = *pair { Leg::Past(via, to) } else { Leg::To(pair[0]) }).collect()
}
