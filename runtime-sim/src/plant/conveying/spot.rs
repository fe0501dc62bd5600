//! Where an item is to come onto a lane.

use super::tracks::Track;
use super::{Among, SAME, View};
use crate::part::lane::Rider;

/// The place of the middle of an item on a lane that it is not on yet.
#[derive(Clone, Copy, Debug)]
pub struct Spot {
    /// The number of the lane.
    pub track: usize,
    pub place: f64,
    pub item: usize,
    /// Of the item.
    pub half: f64,
}

impl Spot {
    /// At the beginning of a lane.
    pub fn at_beginning(tracks: &[Track], among: &Among, track: usize, rider: &Rider) -> Self {
        let place = among.lane(&tracks[track]).lane().centre_line.begin();
        Self { track, place, item: rider.item, half: rider.half }
    }

    /// From when on there is room, if all continues as it does, ms: `ms` if there is now.
    pub fn free_ms(&self, tracks: &[Track], view: View, ms: f64) -> f64 {
        if self.is_under_one_from_a_joint(tracks, view, ms) {
            return f64::INFINITY;
        }
        let lane = view.lane(&tracks[self.track]);
        let there = lane.riders.iter().filter(|rider| self.meets(rider, lane.place_at(rider.motion, ms)));
        let leaves = |rider: &Rider| lane.comes_to(rider.motion, self.place - self.half - rider.half, ms);
        there.map(leaves).fold(ms, f64::max)
    }

    fn meets(&self, rider: &Rider, place: f64) -> bool {
        (place - self.place).abs() < self.half + rider.half - SAME
    }

    /// Whether one reaches to it that is still on the lane before. It is in nobody's way as long as its front is not over
    /// the joint.
    fn is_under_one_from_a_joint(&self, tracks: &[Track], view: View, ms: f64) -> bool {
        let begin = view.lane(&tracks[self.track]).lane().centre_line.begin();
        tracks[self.track].inputs.iter().any(|input| {
            let lane = view.lane(&tracks[*input]);
            let Some(rider) = lane.riders.first().filter(|rider| rider.item != self.item) else {
                return false;
            };
            let left = lane.place_at(rider.motion, ms) - lane.lane().centre_line.end();
            left < rider.half - SAME && self.meets(rider, begin + left)
        })
    }
}
