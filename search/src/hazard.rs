//! Who is over what.

use crate::plant::{Arm, Route, motion};
use crate::scan::Scan;
use crate::surface;
use crate::value::Values;
use crate::violation::Violation;

/// A place where its machine stands: at a stop, if a vehicle carries it. A point is at it if it is over it, and at a
/// field over a conveyor if it is so low that items on it would be touched.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Site {
    number: usize,
    machine: usize,
    /// At this stop of its vehicle.
    stop: Option<usize>,
    is_lane: bool,
}

/// The sites at which a point is.
fn sites_at(scan: &Scan, number: i32) -> Vec<Site> {
    let model = scan.model;
    let point = scan.values.point(number);
    let tallest = model.heights.iter().copied().fold(0.0, f64::max);
    let mut all = Vec::new();
    let mut number = 0;
    for (machine, plant) in model.machines.iter().enumerate() {
        let mut add = |stop, is_lane, is_at| {
            if is_at {
                all.push(Site { number, machine, stop, is_lane });
            }
            number += 1;
        };
        for place in &plant.places {
            match (place.stands, &plant.route) {
                (None, Some(route)) => {
                    for (stop, at) in route.stops.iter().enumerate() {
                        add(Some(stop), false, surface::is_over(place, *at, point));
                    }
                }
                (stands, _) => add(None, false, surface::is_over(place, stands.unwrap_or_default(), point)),
            }
        }
        for zone in plant.lane.iter().flat_map(|lane| &lane.zones) {
            let is_low = point[2] <= zone.surface + tallest + 0.001;
            add(None, true, surface::is_in(zone, point) && is_low);
        }
    }
    all
}

impl Scan<'_> {
    /// What a command that has just been given makes dangerous.
    pub(crate) fn hazards(&mut self) -> Result<(), Violation> {
        let model = self.model;
        let mut at: Vec<(Site, usize)> = Vec::new();
        for (machine, plant) in model.machines.iter().enumerate() {
            let Some(arm) = &plant.arm else { continue };
            for number in self.places_of(arm) {
                let known = self.values.sites.get(number as usize).and_then(Option::as_ref).is_some();
                if number != 0 && !known {
                    let found = sites_at(self, number);
                    self.values.note_sites(number, found);
                }
                at.extend(self.values.sites_of(number).iter().map(|site| (*site, machine)));
            }
        }
        for (index, (site, arm)) in at.iter().enumerate() {
            let Site { number, machine, stop, is_lane } = *site;
            let plant = &model.machines[machine];
            if is_lane {
                let lane = plant.lane.as_ref().map(|lane| lane.motion.load(self.bytes));
                if matches!(lane, Some(motion::RUNS | motion::STARTS)) && !model.stands(self.bytes, machine) {
                    return Err(Violation::MovesUnder { machine, arm: *arm });
                }
                continue;
            }
            if let (Some(stop), Some(route)) = (stop, &plant.route) {
                let (is_here, is_coming) = stands_at(self.values, self.bytes, route, stop);
                let moves =
                    surface::is_driving(model, self.bytes, machine) && !model.stands(self.bytes, machine);
                if moves && (is_here || is_coming) {
                    return Err(Violation::MovesUnder { machine, arm: *arm });
                }
                if !is_here {
                    continue;
                }
            }
            if let Some((_, other)) =
                at[..index].iter().find(|(site, other)| site.number == number && other != arm)
            {
                return Err(Violation::TwoArms { arms: [*other, *arm], machine });
            }
        }
        Ok(())
    }

    /// Where an arm is, or may be on the way.
    fn places_of(&self, arm: &Arm) -> [i32; 3] {
        [arm.tool, arm.via, arm.goal].map(|var| var.load(self.bytes))
    }
}

/// Whether a vehicle is or was at a stop, and whether it is going there.
fn stands_at(values: &Values, state: &[u8], route: &Route, stop: usize) -> (bool, bool) {
    let is_stop = |number: i32| values.point(number) == route.stops[stop];
    (is_stop(route.at.load(state)), is_stop(route.goal.load(state)))
}
