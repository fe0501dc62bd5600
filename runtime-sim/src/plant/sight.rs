//! What the scanners of vehicles see: the other vehicles.

use super::Plant;
use super::working::Working;
use crate::part::scanner::Scanner;
use crate::part::track::Driving;

/// How often it is looked ahead for when a scanner begins or ceases to see a vehicle, before it is asked again.
const MOST_LOOKS: u32 = 24;
/// What happens sooner is not looked for any closer, ms.
const SOON_MS: f64 = 0.01;

impl Plant {
    /// Every scanner looks.
    pub(super) fn sight(&mut self) {
        let now_ms = self.now_ms() as f64;
        let mut told = Vec::new();
        for &machine in &self.scanning {
            let working = &self.machines[machine];
            for (part, scanning) in working.scanners() {
                let Some(vehicle) = working.vehicle(scanning.scanner.track) else { continue };
                let field = Field { vehicle, scanner: &scanning.scanner };
                told.push((
                    machine,
                    part,
                    self.others(machine).any(|other| field.outside(other, now_ms) <= 0.0),
                ));
            }
        }
        for (machine, part, sees) in told {
            self.machines[machine].tell(part, sees);
        }
    }

    /// When a scanner of a machine sees something next, or no longer, ms: not later, if no command changes anything.
    pub(super) fn next_sight(&self, machine: usize) -> f64 {
        let working = &self.machines[machine];
        let now_ms = self.now_ms() as f64;
        let next = working.scanners().filter_map(|(_, scanning)| {
            let field =
                Field { vehicle: working.vehicle(scanning.scanner.track)?, scanner: &scanning.scanner };
            self.others(machine).map(|other| field.next_change(other, now_ms)).reduce(f64::min)
        });
        next.fold(f64::INFINITY, f64::min)
    }

    /// The vehicles of all other machines.
    fn others(&self, machine: usize) -> impl Iterator<Item = &Driving> {
        let others = self.machines.iter().enumerate().filter(move |(other, _)| *other != machine);
        others.filter_map(|(_, working): (_, &Working)| working.first_vehicle())
    }
}

/// Where a scanner sees.
struct Field<'a> {
    vehicle: &'a Driving,
    scanner: &'a Scanner,
}

impl Field<'_> {
    /// How far the middle of another vehicle is from the field at a time, m; less than 0 inside. It changes no faster than
    /// both vehicles move.
    fn outside(&self, other: &Driving, ms: f64) -> f64 {
        let Scanner { range, width, .. } = self.scanner;
        let point = other.frame(ms).position;
        let least = (point - self.vehicle.frame(ms).position).length() - range - width;
        if least > 0.0 { least } else { self.vehicle.distance(point, *range, ms) - width }
    }

    /// When it begins or ceases to see the other one, ms, or earlier.
    fn next_change(&self, other: &Driving, now_ms: f64) -> f64 {
        let speed = self.vehicle.speed_limit() + other.speed_limit();
        let rest_ms = self.vehicle.rests_ms().max(other.rests_ms());
        let mut ms = now_ms;
        for _ in 0..MOST_LOOKS {
            if speed == 0.0 || ms >= rest_ms {
                return f64::INFINITY;
            }
            let step_ms = 1000.0 * self.outside(other, ms).abs() / speed;
            ms += step_ms;
            if step_ms < SOON_MS {
                break;
            }
        }
        ms
    }
}
