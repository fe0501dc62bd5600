//! How grippers look for items, and take them.

use super::Plant;
use crate::carrier::Carrier;
use crate::kinematics::pose::Pose;
use crate::part::Looks;
use crate::part::place::OPPOSITE;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;

/// The direction of the vertical.
const UP: Point = Point::new(0.0, 0.0, 1.0);
/// A gripper that finds nothing is asked again after so many looks at the latest.
const MOST_LOOKS: u32 = 1000;
/// What is rounded in a distance, m.
const ROUNDED: f64 = 1e-6;

/// How far items are from the tool of a gripper at a time, at least.
struct Nearest {
    /// Of those that rest, m; infinity if there are none.
    at_rest: f64,
    /// Of those on machines that move, m, and how fast they go at most, m/s.
    moving: Vec<(f64, f64)>,
}

/// Items that a gripper may find.
struct Candidates {
    /// Where those are gripped that rest, as far as the tool may get there.
    at_rest: Vec<Point>,
    moving: Vec<Carried>,
}

/// An item on a machine that moves.
struct Carried {
    /// Where it is gripped now.
    grip: Point,
    /// How far it may go at once, m.
    leap: f64,
    /// How fast it goes otherwise, m/s.
    speed: f64,
}

impl Candidates {
    /// How far they are from the tool at a place, from where it goes so far at most until its motion ends, m. Those that
    /// rest and are out of its reach are left out from now on.
    fn nearest(&mut self, tool: Point, reach: f64) -> Nearest {
        let square = |grip: &Point| {
            let gap = *grip - tool;
            gap.dot(gap)
        };
        self.at_rest.retain(|grip| square(grip) <= reach * reach);
        let at_rest = self.at_rest.iter().map(square).fold(f64::INFINITY, f64::min).sqrt();
        let distance = |item: &Carried| (item.grip - tool).length() - item.leap;
        Nearest { at_rest, moving: self.moving.iter().map(|item| (distance(item), item.speed)).collect() }
    }
}

impl Nearest {
    fn is_none(&self) -> bool {
        self.at_rest == f64::INFINITY && self.moving.is_empty()
    }

    /// So many seconds after their places were looked up.
    fn after(&self, seconds: f64) -> f64 {
        let moving = self.moving.iter().map(|(distance, speed)| distance - speed * seconds);
        moving.fold(self.at_rest, f64::min)
    }

    /// Seconds from then until one of them can be so near; infinity: never.
    fn until(&self, near: f64) -> f64 {
        let at_rest = if self.at_rest <= near { 0.0 } else { f64::INFINITY };
        let moving = self.moving.iter().map(|(distance, speed)| (distance - near).max(0.0) / speed);
        moving.fold(at_rest, f64::min)
    }
}

/// When a gripper of a machine next looks and could find an item, as long as nothing of this changes.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct NextLook {
    looks: Vec<Looks>,
    motion: Trajectory,
    /// Of each machine.
    speeds: Vec<f64>,
    /// Events of items.
    logged: usize,
    ms: f64,
}

/// Where items lie, as long as nothing of this changes.
#[derive(Clone, Debug)]
pub(super) struct Lying {
    /// Of each machine.
    speeds: Vec<f64>,
    /// Events of items.
    logged: usize,
    /// Where those are gripped that rest.
    at_rest: Vec<Point>,
    /// Those on machines that move.
    moving: Vec<usize>,
}

/// The least number of which this holds, which also holds of all that are greater; `most` if there is none below.
fn first(most: u32, holds: impl Fn(u32) -> bool) -> u32 {
    // It does not hold of what is below.
    let (mut below, mut step) = (0, 1);
    loop {
        let number = (below + step - 1).min(most);
        if number == most || holds(number) {
            break bisected(below, number, holds);
        }
        below = number + 1;
        step *= 2;
    }
}

/// The same of those from `low` to `high`, which is the last that it could be.
fn bisected(mut low: u32, mut high: u32, holds: impl Fn(u32) -> bool) -> u32 {
    while low < high {
        let middle = low + (high - low) / 2;
        if holds(middle) {
            high = middle;
        } else {
            low = middle + 1;
        }
    }
    low
}

/// Whether the upper side of an item that faces there, none for up, faces the tool.
pub(super) fn faces(tool: &Pose, upper: Option<Point>) -> bool {
    tool.axis(2).dot(upper.unwrap_or(UP)) < OPPOSITE
}

impl Plant {
    /// When a gripper next looks and could find an item, ms; infinity: never, as everything moves now.
    pub(super) fn next_look(&mut self, now_ms: u64) -> f64 {
        let phases = self.phases();
        if self.next_look.0 != phases || self.next_look.1 <= now_ms as f64 {
            self.next_look = (phases, self.find_next_look(now_ms));
        }
        self.next_look.1
    }

    fn find_next_look(&mut self, now_ms: u64) -> f64 {
        if self.grippers.iter().all(|(machine, _)| self.machines[*machine].looks().next().is_none()) {
            // What moves now is not seen to.
            self.lying = None;
            return f64::INFINITY;
        }
        let speeds: Vec<f64> = self.machines.iter().map(|machine| machine.speed(now_ms)).collect();
        let logged = self.items.log().count();
        if self.lying.as_ref().is_some_and(|known| known.logged != logged || known.speeds != speeds) {
            self.lying = None;
        }
        let mut next_ms = f64::INFINITY;
        for number in 0..self.grippers.len() {
            let (machine, _) = self.grippers[number];
            next_ms = next_ms.min(self.next_look_of(machine, &speeds, now_ms));
        }
        next_ms
    }

    fn next_look_of(&mut self, machine: usize, speeds: &[f64], now_ms: u64) -> f64 {
        let all: Vec<Looks> = self.machines[machine].looks().collect();
        if all.is_empty() {
            return f64::INFINITY;
        }
        let (motion, logged) = (self.machines[machine].trajectory(now_ms), self.items.log().count());
        let has_found = all.iter().any(|looks| looks.has_found);
        if let Some(known) = &self.next_looks[machine]
            && !has_found
            && known.ms > now_ms as f64
            && (known.logged, &known.motion) == (logged, &motion)
            && known.speeds == speeds
            && known.looks == all
        {
            return known.ms;
        }
        let lying = match self.lying.take() {
            Some(lying) => lying,
            None => self.lying(speeds),
        };
        let of_one = |looks: Looks| self.next_look_with(machine, looks, &lying, now_ms);
        let ms = all.iter().copied().map(of_one).fold(f64::INFINITY, f64::min);
        self.lying = Some(lying);
        let next = NextLook { looks: all, motion, speeds: speeds.to_vec(), logged, ms };
        self.next_looks[machine] = (!has_found).then_some(next);
        ms
    }

    fn next_look_with(&self, machine: usize, looks: Looks, lying: &Lying, now_ms: u64) -> f64 {
        let working = &self.machines[machine];
        let mut look = (now_ms / looks.period_ms + 1) * looks.period_ms;
        if looks.has_found {
            return look as f64;
        }
        let Some(tool) = working.see(&self.items, &self.desk).tool(looks.chain) else { return f64::INFINITY };
        let near = looks.near + ROUNDED;
        let now = now_ms as f64 / 1000.0;
        let mut candidates = self.candidates(lying);
        let (mut from, mut left) = (now, MOST_LOOKS);
        let mut goes = working.tool_goes(looks.chain, from, f64::MAX);
        let mut nearest = candidates.nearest(tool.position, goes + near);
        // A look is done at the end of its scan.
        let time_of = |look: u64| (look.div_ceil(self.scan_ms) * self.scan_ms) as f64 / 1000.0;
        while left > 0 {
            if goes == 0.0 || nearest.is_none() {
                let soonest_ms = 1000.0 * (now + nearest.until(near)) - self.scan_ms as f64;
                let periods = (soonest_ms / looks.period_ms as f64).floor();
                return (periods * looks.period_ms as f64).max(look as f64);
            }
            // What it may meet by then, it may meet later.
            let may_meet = |count: u32| {
                let at = time_of(look + u64::from(count) * looks.period_ms);
                nearest.after(at - now) - working.tool_goes(looks.chain, from, at) <= near
            };
            let passed = first(left, may_meet);
            look += u64::from(passed) * looks.period_ms;
            left -= passed;
            if left == 0 {
                break;
            }
            from = time_of(look);
            let Some(tool) = working.tool_at(looks.chain, from) else { break };
            goes = working.tool_goes(looks.chain, from, f64::MAX);
            nearest = candidates.nearest(tool, goes + near);
            if nearest.after(from - now) <= near {
                break;
            }
            look += looks.period_ms;
            left -= 1;
        }
        look as f64
    }

    /// Of all items that are not gripped, with the speed of each machine.
    fn lying(&self, speeds: &[f64]) -> Lying {
        let (mut at_rest, mut moving) = (Vec::new(), Vec::new());
        for index in self.items.placed() {
            let carrier = self.base_carrier(index);
            match carrier.machine() {
                _ if matches!(carrier, Carrier::Grip { .. }) => {}
                Some(machine) if speeds[machine] > 0.0 => moving.push(index),
                _ => at_rest.extend(self.grip_point(index)),
            }
        }
        Lying { speeds: speeds.to_vec(), logged: self.items.log().count(), at_rest, moving }
    }

    /// What a gripper may find as it lies now.
    fn candidates(&self, Lying { speeds, at_rest, moving, .. }: &Lying) -> Candidates {
        let carried = |item: &usize| {
            let machine = self.base_carrier(*item).machine()?;
            let speed = speeds[machine].max(self.speed_of_load(*item));
            Some(Carried { grip: self.grip_point(*item)?, leap: self.leap(*item), speed })
        };
        Candidates { at_rest: at_rest.clone(), moving: moving.iter().filter_map(carried).collect() }
    }

    /// Metres per second that an item on another one goes at most, which may lie beyond the edge of a conveyor or of a place; 0
    /// of others.
    fn speed_of_load(&self, item: usize) -> f64 {
        let load = self.items[item].carrier.item().and_then(|_| self.conveyed(item));
        load.map_or(0.0, |load| load.speed_within(libm::hypot(load.offset.x, load.offset.y)))
    }

    /// How far an item that lies on a vehicle on a track goes at once at most, where this turns at corners, m.
    fn leap(&self, item: usize) -> f64 {
        let (Some(vehicle), Some(place)) = (self.vehicle_under(item), self.place(item)) else { return 0.0 };
        2.0 * libm::hypot(place.x - vehicle.position.x, place.y - vehicle.position.y)
    }

    /// In the last scan before this one.
    pub(super) fn grip(&mut self, scan: u64) {
        let next_ms = scan * self.scan_ms;
        let now_ms = next_ms - self.scan_ms;
        for number in 0..self.grippers.len() {
            let (machine, part) = self.grippers[number];
            let working = &self.machines[machine];
            let see = working.see(&self.items, &self.desk);
            let Some((tool, near)) = working.seeks(part, &see, now_ms, next_ms) else { continue };
            let contact = self.contact(&tool, near);
            if let Some(item) = self.machines[machine].meets(part, contact, now_ms, next_ms)
                && let Some(place) = self.place(item)
            {
                self.take_from_under(machine, item, next_ms as f64);
                let hang = Point { z: self.grasp(item), ..tool.inverse().point(place) };
                let (carrier, point) = (Carrier::Grip { machine, part, hang }, tool.point(hang));
                self.hand_over(item, self.turn(item), carrier, point, next_ms as f64);
            }
        }
    }

    /// An item on which another one lies is not lifted alone.
    fn take_from_under(&mut self, machine: usize, item: usize, ms: f64) {
        if self.lies_on(item, ms).is_some() {
            self.items.crash(machine, "took an item on which another one lies".into());
        }
    }

    /// How far over its underside an item is gripped, m.
    pub fn grasp(&self, item: usize) -> f64 {
        self.grasps[self.items[item].kind]
    }

    /// Where an item is gripped: over the middle of its underside.
    fn grip_point(&self, item: usize) -> Option<Point> {
        let (place, grasp) = (self.place(item)?, self.grasp(item));
        Some(match self.upper(item) {
            Some(upper) => place + upper.scaled(grasp),
            None => place.up(grasp),
        })
    }

    /// Of all items that no gripper holds.
    pub(super) fn grip_points(&self) -> impl Iterator<Item = (usize, Point)> {
        let lies = |item: &usize| !matches!(self.base_carrier(*item), Carrier::Grip { .. });
        self.items.placed().filter(lies).filter_map(|item| Some((item, self.grip_point(item)?)))
    }

    /// The item nearest to the tool among those that are gripped no farther from it and face it; the first of equals.
    fn contact(&self, tool: &Pose, near: f64) -> Option<usize> {
        let mut nearest: Option<(f64, usize)> = None;
        for (index, grip) in self.grip_points() {
            let gap = grip - tool.position;
            let square = gap.x * gap.x + gap.y * gap.y + gap.z * gap.z;
            if square <= near * near
                && faces(tool, self.upper(index))
                && nearest.is_none_or(|least| (square, index) < least)
            {
                nearest = Some((square, index));
            }
        }
        nearest.map(|(_, item)| item)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_first_number_is_found_without_a_look_at_each() {
        for most in 0..40 {
            for from in 0..45 {
                assert_eq!(first(most, |number| number >= from), from.min(most), "{from} of {most}");
            }
        }
    }
}
