//! Whether a gantry keeps off obstacles on its path: first at a few times of a plan, then along the whole path.

use super::gap::{Load, Nearby, Pair};
use super::{LIFTED, MARGIN_AT_PLACE, Plan, Planner, axis, turned};
use crate::kinematics::arm::Joints;
use crate::motion::{Path, Travel};
use crate::point::Point;

/// A path rounds the corners of its plan: it keeps off obstacles where the plan does not keep off quite as far.
const ROUNDED: f64 = 0.5;
/// A plan is checked between so many equal parts.
const FIRST_LOOKS: u32 = 32;
/// Two are measured again at the latest when they have gone this part of what is kept.
const SHORTEST_STEP: f64 = 0.6;
/// Two are measured with others that have to be measured, if this part of what they may go is left or less.
const SOON: f64 = 0.5;
/// Distances are measured up to this, m.
const ENOUGH: f64 = 0.15;
/// Joints that differ by less are the same, m or rad.
const SAME: f64 = 1e-9;

/// What is near the robot between the ends of a path.
struct Around<'a> {
    near: Nearby<'a>,
    ends: [&'a Joints; 2],
    /// On the verticals at the ends the tool carries its load from these heights on, m.
    lifted: [f64; 2],
    load: Load,
    margin: f64,
}

/// What is asked at one place of a path.
struct Asked {
    load: Load,
    /// How far everything has to be apart, m.
    margin: f64,
}

/// Two on a path.
struct Checked<'a> {
    pair: &'a Pair,
    /// As seen from one another.
    travel: Travel,
    /// The place where they were measured, and up to which they keep so far apart, m.
    free: [f64; 2],
    margin: f64,
}

impl<'a> Checked<'a> {
    /// Not measured yet.
    fn new(pair: &'a Pair, path: &Path) -> Self {
        Self { pair, travel: Travel::new(path.sections(&pair.radii)), free: [0.0; 2], margin: 0.0 }
    }
}

impl Around<'_> {
    fn asked(&self, planner: &Planner, joints: &Joints) -> Asked {
        let stands = |end: usize| (0..3).all(|i| (joints[i] - self.ends[end][i]).abs() < SAME);
        let Some(end) = [0, 1].into_iter().find(|end| stands(*end)) else {
            return Asked { load: self.load, margin: self.margin };
        };
        let lies = planner.arm.tool(joints).z < self.lifted[end];
        Asked { load: if lies { Load::None } else { self.load }, margin: MARGIN_AT_PLACE }
    }
}

impl Planner {
    /// False if the robot comes too near to something at one of a few times of a plan. That is found out without a path,
    /// and nearly all plans that lead to no free path are of this kind. `suspect` as for [`Self::is_free`].
    pub(super) fn may_be_free(&self, plan: &Plan, load: Load, margin: f64, suspect: &mut f64) -> bool {
        let [from, to] = &plan.ends;
        let last = plan.samples() - 1;
        if last == 0 {
            return true;
        }
        let posture = self.arm.posture(from);
        let Some(reached) = self.at_time(plan, plan.time(last), &posture) else { return false };
        let tool = to.len() - 1;
        // What turns on its path has another direction there than here.
        let load = if turned(to[tool], reached[tool]).1 == 0.0 { load } else { Load::None };
        let around = self.around([from, to], plan.line.places().iter().copied(), load, margin);
        let is_apart = |part: f64| {
            let sample = libm::round(part * f64::from(plan.samples())) as u32;
            let time = plan.time(sample.clamp(1, last));
            let Some(joints) = self.at_time(plan, time, &posture) else { return false };
            let Asked { load, margin } = around.asked(self, &joints);
            let margin = margin * ROUNDED;
            self.scene.gap(&around.near, &joints, load, [margin; 2]) >= margin
        };
        let found = [*suspect].into_iter().chain(first_looks()).find(|part| !is_apart(*part));
        *suspect = found.unwrap_or(*suspect);
        found.is_none()
    }

    /// What the gap is asked of on a path between two ends, with the torso at these places.
    fn around<'a>(
        &'a self,
        ends: [&'a Joints; 2],
        places: impl IntoIterator<Item = Point>,
        load: Load,
        margin: f64,
    ) -> Around<'a> {
        let lifted = ends.map(|end| self.arm.tool(end).z + self.scene.load_height + LIFTED);
        let near = self.scene.near(places, &ends.map(|end| self.arm.tool(end)));
        Around { near, ends, lifted, load, margin }
    }

    /// Whether nothing on this path comes nearer to an obstacle than `margin`. On the verticals at its ends it may come
    /// nearer, and the load touches what it lies on. `suspect` is the place, 0 to 1, at which it is checked first: the
    /// last one that was not free, of paths that are much alike.
    pub(super) fn is_free(
        &self,
        ends: [&Joints; 2],
        path: &Path,
        load: Load,
        margin: f64,
        suspect: &mut f64,
    ) -> bool {
        let around = self.around(ends, path.knots().iter().map(axis), load, margin);
        let joints = path.at(*suspect);
        let asked = around.asked(self, &joints);
        if self.scene.gap(&around.near, &joints, asked.load, [asked.margin; 2]) < asked.margin {
            return false;
        }
        let mut all: Vec<Checked> =
            self.scene.links.pairs(load).map(|pair| Checked::new(pair, path)).collect();
        let mut place = 0.0;
        while place < 1.0 {
            let Some(next) = self.check_due(&mut all, place, &around, path) else {
                *suspect = place;
                return false;
            };
            place = next;
        }
        true
    }

    /// Measures all pairs that are due at a place of a path. The place at which the next one is due; none if one is too near.
    fn check_due(&self, all: &mut [Checked], place: f64, around: &Around, path: &Path) -> Option<f64> {
        let joints = path.at(place);
        let Asked { load, margin } = around.asked(self, &joints);
        let links = self.scene.links.at(&joints);
        let section = all.first().map_or(0, |checked| checked.travel.section(place));
        let mut next = 1.0_f64;
        for checked in all.iter_mut() {
            let [from, to] = checked.free;
            if margin > checked.margin || to - place <= SOON * (to - from) {
                let is_there = load == Load::Largest || !self.scene.links.is_of_load(checked.pair);
                let (kept, least) = if is_there {
                    let distance = links.distance(checked.pair, &around.near, ENOUGH);
                    if distance < margin {
                        return None;
                    }
                    (margin, (distance - margin).max(margin * SHORTEST_STEP))
                } else {
                    (0.0, LIFTED)
                };
                checked.free = [place, checked.travel.after(section, place, least)];
                checked.margin = kept;
            }
            next = next.min(checked.free[1]);
        }
        Some(next)
    }
}

/// A plan is checked at these parts of its time.
fn first_looks() -> impl Iterator<Item = f64> {
    // Far from one another at first.
    let turned = |i: u32| i.reverse_bits() >> (FIRST_LOOKS.leading_zeros() + 1);
    (1..FIRST_LOOKS).map(move |i| f64::from(turned(i)) / f64::from(FIRST_LOOKS))
}
