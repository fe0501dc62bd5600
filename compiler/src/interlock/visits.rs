//! The stops to which automata drive their vehicles.

use super::region::{Bound, Given, Region, Regions};
use super::stay::motions;
use crate::ir::System;
use crate::parallel::{LEAST, in_parts};
use runtime_sim::line::Line;
use runtime_sim::point::Point;
use std::collections::BTreeSet;

/// Of each machine, by its number: the stops of its route at which it can be, as far as its text and the layout tell, in
/// ascending order; none: at any, or it has no route.
pub fn of_all(system: &System, line: &Line) -> Vec<Option<Vec<usize>>> {
    let instances: Vec<usize> = (0..line.machines.len()).collect();
    in_parts(&instances, LEAST, |instances| {
        let given = Given::new(system, line);
        instances.iter().map(|instance| of(&given, *instance)).collect()
    })
}

fn of(given: &Given, instance: usize) -> Option<Vec<usize>> {
    let route = given.line.machines[instance].route()?;
    // It starts at the first one.
    let mut visits = BTreeSet::from([0]);
    for motion in motions(given, instance) {
        let bound = Bound::default();
        let regions = Regions::new(given, instance, &bound, motion.transition);
        for (goal, _) in &motion.goals {
            let goals = regions.points(goal)?;
            let is_goal = |stop: &Point| goals.iter().any(|goal| holds(goal, *stop, route.tolerance));
            visits.extend(route.stops.iter().enumerate().filter(|(_, stop)| is_goal(stop)).map(|(i, _)| i));
        }
    }
    Some(visits.into_iter().collect())
}

fn holds(region: &Region, point: Point, tolerance: f64) -> bool {
    let point = [point.x, point.y, point.z];
    region.iter().zip(point).all(|([low, high], value)| (low - tolerance..=high + tolerance).contains(&value))
}
