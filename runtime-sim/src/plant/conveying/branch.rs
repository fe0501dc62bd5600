//! What cylinders do to items on a lane.

use super::super::working::Working;
use super::ahead::LIES_ON;
use super::{AT_ONCE, SAME};
use crate::part::cylinder::End;
use crate::part::lane::Rider;

/// From when on a cylinder is at its ends.
#[derive(Clone, Debug)]
pub struct Ends {
    pub cylinder: usize,
    /// At the inner end and at the outer one, ms; infinity: it is not going there.
    in_ms: f64,
    out_ms: f64,
}

impl Ends {
    /// Not looked at yet.
    pub fn new(cylinder: usize) -> Self {
        Self { cylinder, in_ms: f64::NAN, out_ms: f64::NAN }
    }

    /// Takes note of the cylinder; whether that has changed.
    pub fn look(&mut self, machine: &Working, now_ms: u64) -> bool {
        let from = |end: End| {
            machine.cylinder(self.cylinder).map_or(f64::INFINITY, |cylinder| cylinder.is_at_from(end, now_ms))
        };
        let now = (from(End::In), from(End::Out));
        let has_changed = (self.in_ms, self.out_ms) != now;
        (self.in_ms, self.out_ms) = now;
        has_changed
    }

    pub fn is_at(&self, end: End, ms: f64) -> bool {
        let from_ms = match end {
            End::In => self.in_ms,
            End::Out => self.out_ms,
        };
        from_ms <= ms + AT_ONCE
    }

    /// It is at the outer end, or going there.
    pub fn goes_out(&self) -> bool {
        self.out_ms.is_finite()
    }

    /// When the cylinder next comes to an end, ms.
    pub fn next_ms(&self, ms: f64) -> f64 {
        let times = [self.in_ms, self.out_ms].into_iter();
        times.filter(|time| *time > ms + AT_ONCE).fold(f64::INFINITY, f64::min)
    }
}

/// A stopper, a diverter or a pusher on a lane.
#[derive(Clone, Debug)]
pub struct Branch {
    pub kind: Kind,
    /// On the centre line.
    pub place: f64,
    pub ends: Ends,
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
                (self.ends.is_at(End::Out, ms) && (place - self.place).abs() <= half).then_some(onto)
            }
        }
    }

    /// Whether a diverter has the front edge of an item before it.
    fn meets(&self, rider: &Rider, place: f64, ms: f64) -> bool {
        self.ends.is_at(End::Out, ms) && (place - rider.half - self.place).abs() <= SAME
    }

    /// Where the middle of an item stops that is at a place now; none if this is not in its way.
    pub fn stops(&self, rider: &Rider, place: f64, ms: f64) -> Option<f64> {
        let front_at = |edge: f64| (place - rider.half >= edge - LIES_ON).then_some(edge + rider.half);
        match self.kind {
            Kind::Stopper if !self.ends.is_at(End::In, ms) => front_at(self.place),
            // It has not gone over: there is no room.
            Kind::Diverter { .. } if self.meets(rider, place, ms) => Some(place),
            Kind::Pusher { half, .. } if !self.ends.is_at(End::In, ms) => {
                if (place - self.place).abs() <= half { Some(place) } else { front_at(self.place + half) }
            }
            _ => None,
        }
    }

    /// Place of the middle of an item at which a diverter may take it.
    pub fn awaits(&self, rider: &Rider) -> Option<f64> {
        match self.kind {
            Kind::Diverter { .. } if self.ends.goes_out() => Some(self.place + rider.half),
            _ => None,
        }
    }
}
