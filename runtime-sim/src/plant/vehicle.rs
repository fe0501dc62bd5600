//! A guided vehicle with a tray.

use super::command::{Asked, Command, goal, is_held};
use super::course::Course;
use super::image::{in_vehicle, put_point};
use crate::carrier::Carrier;
use crate::device::error;
use crate::geometry::{TRAY, TRAY_MIDDLE, TRAY_SURFACE};
use crate::point::Point;

/// From the command to the start (animation of the competition's vehicle).
const LATENCY_MS: u64 = 750;
/// Speed in m/s: its animation from the start to the near stop takes 3.0 s for 3.334 m. The animation knows
/// no way back and takes the far stop faster; here every way is gone at this one speed.
const SPEED: f64 = 3.334 / 3.0;
/// A goal that is no farther from a stop means that stop.
const STOP_TOLERANCE: f64 = 0.001;

#[derive(Clone, Debug)]
pub struct Vehicle {
    pub command: Command,
    stops: Vec<Point>,
    position: Point,
    trip: Option<Trip>,
    motion: Motion,
    held: bool,
}

/// A way from where a command found the vehicle to a stop.
#[derive(Clone, Debug)]
struct Trip {
    from: Point,
    to: Point,
    length: f64,
    /// Since the command, without the time it was held.
    elapsed_ms: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Motion {
    Standing,
    Moving,
}

impl Vehicle {
    pub fn new(command: Command, stops: Vec<Point>, position: Point) -> Self {
        Self { command, stops, position, trip: None, motion: Motion::Standing, held: false }
    }

    pub fn position(&self) -> Point {
        self.position
    }

    /// A command is under way and not held.
    pub fn is_busy(&self) -> bool {
        self.command.is_under_way() && !self.held
    }

    pub fn obey(&mut self, outputs: &[f64]) {
        match self.command.accept(outputs) {
            Asked::Nothing => {}
            Asked::Start(1) => match self.stop_near(goal(outputs)) {
                Some(stop) => {
                    let (from, to) = (self.position, self.stops[stop]);
                    self.trip = Some(Trip { from, to, length: length(to - from), elapsed_ms: 0 });
                }
                None => {
                    self.trip = None;
                    self.command.end(error::UNREACHABLE);
                }
            },
            Asked::Start(_) => {
                self.trip = None;
                self.command.end(error::REFUSED);
            }
            Asked::Refused => self.trip = None,
        }
        self.held = is_held(outputs);
    }

    pub fn course(&self, now_ms: u64) -> Course {
        let Some(trip) = self.trip.as_ref().filter(|trip| !self.held && trip.length > 0.0) else {
            return Course::Rests;
        };
        let from_ms = (now_ms + LATENCY_MS) as f64 - trip.elapsed_ms as f64;
        let until_ms = from_ms + 1000.0 * trip.length / SPEED;
        Course::Drives { velocity: (trip.to - trip.from).scaled(SPEED / trip.length), from_ms, until_ms }
    }

    pub fn advance(&mut self, dt_ms: u64) {
        self.motion = Motion::Standing;
        if self.held {
            return;
        }
        let Some(trip) = &mut self.trip else { return };
        trip.elapsed_ms += dt_ms;
        let travelled = SPEED * trip.elapsed_ms.saturating_sub(LATENCY_MS) as f64 / 1000.0;
        if trip.elapsed_ms >= LATENCY_MS && travelled >= trip.length {
            self.position = trip.to;
            self.trip = None;
            self.command.end(error::NONE);
        } else if travelled > 0.0 {
            let share = travelled / trip.length;
            self.position = trip.from + (trip.to - trip.from).scaled(share);
            self.motion = Motion::Moving;
        }
    }

    /// What becomes of an item that comes down at this place, if it meets the tray.
    pub fn below(&self, machine: usize, point: Point) -> Option<(f64, Carrier)> {
        let from_middle = point - (self.position + TRAY_MIDDLE);
        let meets = from_middle.x.abs() <= TRAY[0] / 2.0 && from_middle.y.abs() <= TRAY[1] / 2.0;
        let surface = self.position.z + TRAY_SURFACE;
        let offset = Point { z: TRAY_SURFACE, ..point - self.position };
        meets.then_some((surface, Carrier::Tray { machine, offset }))
    }

    pub fn write(&self, image: &mut [f64]) {
        self.command.write(image);
        put_point(image, in_vehicle::POS, self.position);
        let stop = match self.motion {
            Motion::Standing => self.stop_near(self.position),
            Motion::Moving => None,
        };
        image[in_vehicle::AT_STOP] = stop.map_or(-1.0, |stop| stop as f64);
    }

    fn stop_near(&self, point: Point) -> Option<usize> {
        self.stops.iter().position(|&stop| length(stop - point) <= STOP_TOLERANCE)
    }
}

fn length(p: Point) -> f64 {
    libm::sqrt(p.x * p.x + p.y * p.y + p.z * p.z)
}
