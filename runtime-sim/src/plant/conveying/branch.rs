//! What cylinders do to items on a lane.

use super::super::working::Working;
use super::ahead::LIES_ON;
use super::{AT_ONCE, SAME};
use crate::machine::Machine;
use crate::part::lane::Rider;

/// From when on a cylinder or a positioner is at each of its stops.
#[derive(Clone, Debug)]
pub struct Stops {
    /// Of the machine.
    pub part: usize,
    /// Of each stop, ms; infinity: it is not going there.
    from_ms: Vec<f64>,
}

/// Stops of a cylinder.
const IN: usize = 0;
const OUT: usize = 1;

impl Stops {
    /// Not looked at yet.
    pub fn of(machine: &Machine, part: usize) -> Self {
        let stops = machine.parts[part].strokes().map_or(0, |strokes| strokes.stops.len());
        Self { part, from_ms: vec![f64::NAN; stops] }
    }

    /// Takes note of where it is; whether that has changed.
    pub fn look(&mut self, machine: &Working, now_ms: u64) -> bool {
        let carriage = machine.carriage(self.part);
        let mut has_changed = false;
        for (stop, known) in self.from_ms.iter_mut().enumerate() {
            let from_ms = carriage.map_or(f64::INFINITY, |carriage| carriage.is_at_from(stop, now_ms));
            has_changed |= *known != from_ms;
            *known = from_ms;
        }
        has_changed
    }

    pub fn is_at(&self, stop: usize, ms: f64) -> bool {
        self.from_ms[stop] <= ms + AT_ONCE
    }

    /// A cylinder is at the outer end, or going there.
    pub fn goes_out(&self) -> bool {
        self.from_ms[OUT].is_finite()
    }

    /// When it next comes to a stop, ms.
    pub fn next_ms(&self, ms: f64) -> f64 {
        let times = self.from_ms.iter().copied();
        times.filter(|time| *time > ms + AT_ONCE).fold(f64::INFINITY, f64::min)
    }
}

/// A stopper, a diverter or a pusher on a lane.
#[derive(Clone, Debug)]
pub struct Branch {
    /// Of the machine.
    pub part: usize,
    pub kind: Kind,
    /// On the centre line.
    pub place: f64,
    pub stops: Stops,
}

#[derive(Clone, Copy, Debug)]
pub enum Kind {
    Stopper,
    /// Onto the lane of this number.
    Diverter {
        onto: usize,
    },
    Pusher {
        onto: usize,
        half: f64,
    },
}

impl Branch {
    /// The lane onto which it brings an item that is there now, if there is room.
    pub fn takes(&self, rider: &Rider, place: f64, ms: f64) -> Option<usize> {
        match self.kind {
            Kind::Stopper => None,
            Kind::Diverter { onto } => self.meets(rider, place, ms).then_some(onto),
            Kind::Pusher { onto, half } => {
                (self.stops.is_at(OUT, ms) && (place - self.place).abs() <= half + SAME).then_some(onto)
            }
        }
    }

    /// Whether a diverter has the front edge of an item before it.
    fn meets(&self, rider: &Rider, place: f64, ms: f64) -> bool {
        self.stops.is_at(OUT, ms) && (place - rider.half - self.place).abs() <= SAME
    }

    /// Where the middle of an item stops that is at a place now; none if this is not in its way.
    pub fn stops(&self, rider: &Rider, place: f64, ms: f64) -> Option<f64> {
        let front_at = |edge: f64| (place - rider.half >= edge - LIES_ON).then_some(edge + rider.half);
        match self.kind {
            Kind::Stopper if !self.stops.is_at(IN, ms) => front_at(self.place),
            // It has not gone over: there is no room.
            Kind::Diverter { .. } if self.meets(rider, place, ms) => Some(place),
            Kind::Pusher { half, .. } if !self.stops.is_at(IN, ms) => {
                let edge = self.place + half;
                if (place - self.place).abs() <= half + SAME {
                    Some(place)
                } else {
                    // Too late to stop before it, it goes on until its middle is there.
                    front_at(edge).or_else(|| (place > edge).then_some(edge))
                }
            }
            _ => None,
        }
    }

    /// Place of the middle of an item at which a diverter may take it.
    pub fn awaits(&self, rider: &Rider) -> Option<f64> {
        match self.kind {
            Kind::Diverter { .. } if self.stops.goes_out() => Some(self.place + rider.half),
            _ => None,
        }
    }
}
