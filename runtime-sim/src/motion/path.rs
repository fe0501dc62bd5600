//! Paths of all joints together: a straight line, or two with a rounded corner.
//!
//! The place on a path is one number from 0 to 1. On a line the joints change evenly with
//! it. Over a corner they follow a parabola that touches both lines, so that their change
//! with the place has no jump.

use super::profile::Zone;
use crate::kinematics::arm::{Joints, Limits};

/// At the middle of a corner no joint is further than this from where both lines meet, m or rad.
pub const CORNER_NEAR: f64 = 0.05;
/// Part of every joint's acceleration that a corner may use for turning off; the rest is
/// left for gaining and losing speed on it. With this much of it a corner, however sharp, takes no longer
/// than a stop.
const CORNER_SHARE: f64 = 0.9;

#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    from: Joints,
    to: Joints,
    corner: Option<Corner>,
}

#[derive(Clone, Debug, PartialEq)]
struct Corner {
    /// Change of the joints with the place, on the first and on the second line.
    rates: [Joints; 2],
    begin: f64,
    end: f64,
}

impl Path {
    /// The straight line, and what its joints' limits allow on it; no zone if no joint moves.
    pub fn straight(from: Joints, to: Joints, limits: &Limits) -> (Self, Vec<Zone>) {
        let changes = difference(&to, &from);
        let zone = Zone {
            end: 1.0,
            top: least(&limits.velocity, &changes),
            gain: least(&limits.acceleration, &changes),
        };
        let zones = if zone.top.is_finite() { vec![zone] } else { Vec::new() };
        (Self { from, to, corner: None }, zones)
    }

    /// To `to` past `via`. Each line's share of the place is its share of the time at full speed.
    ///
    /// The corner is as long as passing it at full speed asks for; but no longer than
    /// [`CORNER_NEAR`] allows, and it takes at most half of either line.
    pub fn past(from: Joints, via: Joints, to: Joints, limits: &Limits) -> (Self, Vec<Zone>) {
        let changes = [difference(&via, &from), difference(&to, &via)];
        let times = changes.each_ref().map(|change| 1.0 / least(&limits.velocity, change));
        let whole = times[0] + times[1];
        if times.contains(&0.0) {
            return Self::straight(from, to, limits);
        }
        let rates: [Joints; 2] =
            std::array::from_fn(|i| changes[i].map(|_, change| change * (whole / times[i])));
        let change = difference(&rates[1], &rates[0]);
        let share = limits.acceleration.map(|_, gain| gain * CORNER_SHARE);
        let top = rates.each_ref().map(|rate| least(&limits.velocity, rate));
        let gain = rates.each_ref().map(|rate| least(&limits.acceleration, rate));

        let meeting = times[0] / whole;
        let (full, bend) = (top[0].min(top[1]), least(&share, &change));
        let asked = full * full / bend;
        let near = least(&change.map(|_, _| 8.0 * CORNER_NEAR), &change);
        let longest = near.min(meeting).min(1.0 - meeting);
        let (length, over) =
            if asked <= longest { (asked, full) } else { (longest, (longest * bend).sqrt()) };
        let (begin, end) = (meeting - length / 2.0, meeting + length / 2.0);
        let zones = vec![
            Zone { end: begin, top: top[0], gain: gain[0] },
            Zone { end, top: over, gain: gain[0].min(gain[1]) * (1.0 - CORNER_SHARE) },
            Zone { end: 1.0, top: top[1], gain: gain[1] },
        ];
        (Self { from, to, corner: Some(Corner { rates, begin, end }) }, zones)
    }

    /// Joints at a place; exact at both ends.
    pub fn at(&self, place: f64) -> Joints {
        if place <= 0.0 {
            return self.from;
        }
        if place >= 1.0 {
            return self.to;
        }
        let Some(Corner { rates: [first, second], begin, end }) = &self.corner else {
            return self.from.map(|i, start| start + place * (self.to[i] - start));
        };
        if place >= *end {
            return self.to.map(|i, goal| goal - (1.0 - place) * second[i]);
        }
        let beyond = (place - begin).max(0.0);
        let turned = if beyond > 0.0 { beyond * beyond / (2.0 * (end - begin)) } else { 0.0 };
        self.from.map(|i, start| start + place * first[i] + turned * (second[i] - first[i]))
    }

    /// Joints near a place as powers of the place: what to multiply its powers 0, 1 and 2 with.
    pub fn powers(&self, place: f64) -> Vec<[f64; 3]> {
        let joints = 0..self.from.len();
        let straight = |i: usize| [self.from[i], self.to[i] - self.from[i], 0.0];
        let Some(Corner { rates: [first, second], begin, end }) = &self.corner else {
            return joints.map(straight).collect();
        };
        let bent = |i: usize| {
            let turn = (second[i] - first[i]) / (2.0 * (end - begin));
            [self.from[i] + turn * begin * begin, first[i] - 2.0 * turn * begin, turn]
        };
        joints
            .map(|i| match place {
                _ if place < *begin => [self.from[i], first[i], 0.0],
                _ if place < *end => bent(i),
                _ => [self.to[i] - second[i], second[i], 0.0],
            })
            .collect()
    }

    /// The greatest change of each joint with the place, on the whole path.
    pub fn rates(&self) -> Joints {
        match &self.corner {
            None => difference(&self.to, &self.from).map(|_, change| change.abs()),
            // Over the corner it goes from the one to the other.
            Some(Corner { rates: [first, second], .. }) => {
                first.map(|i, rate| rate.abs().max(second[i].abs()))
            }
        }
    }

    pub fn goal(&self) -> Joints {
        self.to
    }
}

fn difference(to: &Joints, from: &Joints) -> Joints {
    to.map(|i, value| value - from[i])
}

/// The least that a joint's limit is of its rate; infinite if no joint moves.
fn least(limits: &Joints, rates: &Joints) -> f64 {
    (rates.iter().map(|rate| rate.abs()).zip(limits.iter()))
        .filter(|(rate, _)| *rate > 0.0)
        .fold(f64::INFINITY, |least, (rate, limit)| least.min(limit / rate))
}
