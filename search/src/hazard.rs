//! Who is over what.

use crate::plant::{Arm, Route, motion};
use crate::scan::Scan;
use crate::surface;
use crate::value::Values;
use crate::violation::Violation;

/// A place where its machine stands: at a stop, if a vehicle carries it. A point is at it if it is over it, and at a
/// field over a conveyor if it is so low that items on it would be touched.
struct Site {
    machine: usize,
    /// At this stop of its vehicle.
    stop: Option<usize>,
    is_lane: bool,
}

fn sites(scan: &Scan) -> Vec<Site> {
    let mut sites = Vec::new();
    for (machine, plant) in scan.model.machines.iter().enumerate() {
        for place in &plant.places {
            match (place.stands, &plant.route) {
                (None, Some(route)) => {
                    let stops = 0..route.stops.len();
                    sites.extend(stops.map(|stop| Site { machine, stop: Some(stop), is_lane: false }));
                }
                _ => sites.push(Site { machine, stop: None, is_lane: false }),
            }
        }
        let zones = plant.lane.iter().flat_map(|lane| &lane.zones);
        sites.extend(zones.map(|_| Site { machine, stop: None, is_lane: true }));
    }
    sites
}

/// For each site whether a point is at it.
fn sites_at(scan: &Scan, number: i32) -> Vec<usize> {
    let model = scan.model;
    let point = scan.values.point(number);
    let tallest = model.heights.iter().copied().fold(0.0, f64::max);
    let mut all = Vec::new();
    for plant in &model.machines {
        for place in &plant.places {
            match (place.stands, &plant.route) {
                (None, Some(route)) => {
                    all.extend(route.stops.iter().map(|stop| surface::is_over(place, *stop, point)));
                }
                (stands, _) => all.push(surface::is_over(place, stands.unwrap_or_default(), point)),
            }
        }
        let zones = plant.lane.iter().flat_map(|lane| &lane.zones);
        all.extend(
            zones.map(|zone| surface::is_in(zone, point) && point[2] <= zone.surface + tallest + 0.001),
        );
    }
    all.iter().enumerate().filter(|(_, is_at)| **is_at).map(|(site, _)| site).collect()
}

impl Scan<'_> {
    /// What a command that has just been given makes dangerous.
    pub(crate) fn hazards(&mut self) -> Result<(), Violation> {
        let model = self.model;
        let mut at: [(usize, usize); 64] = [(0, 0); 64];
        let mut count = 0;
        for (machine, plant) in model.machines.iter().enumerate() {
            let Some(arm) = &plant.arm else { continue };
            for number in self.places_of(arm) {
                let known = self.values.sites.get(number as usize).and_then(Option::as_ref).is_some();
                if number != 0 && !known {
                    let found = sites_at(self, number);
                    self.values.note_sites(number, found);
                }
                for site in self.values.sites_of(number) {
                    if count < at.len() {
                        at[count] = (*site, machine);
                        count += 1;
                    }
                }
            }
        }
        if count == 0 {
            return Ok(());
        }
        let sites = sites(self);
        for (index, (site, arm)) in at[..count].iter().enumerate() {
            let Site { machine, stop, is_lane } = sites[*site];
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
            if let Some((_, other)) = at[..index].iter().find(|(s, other)| s == site && other != arm) {
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
