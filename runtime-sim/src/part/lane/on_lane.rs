//! What lies on a lane, and on other items there: what sensors see, and what goes on with it.

use super::CentreLine;
use super::moving::{Motion, Moving};
use crate::carrier::Carrier;
use crate::frame::Frame;
use crate::item::Items;
use crate::item::block::Block;
use crate::part::{Running, See};
use crate::point::{Axis, Point};

/// An item on a lane, or one that lies on such an item, with which it goes.
#[derive(Clone, Copy, Debug)]
pub struct OnLane {
    pub item: usize,
    /// On the lane.
    base: usize,
    /// Of the base.
    motion: Motion,
    /// How far ahead of the middle of the base its own is, m.
    ahead: f64,
    /// Half of its length along the lane, m.
    pub half: f64,
    /// Of its upper side over the surface of the lane, m.
    pub top: f64,
}

impl Moving {
    /// An item on this lane, then all that lies on it.
    pub fn on_lane(&self, base: usize, motion: Motion, items: &Items) -> impl Iterator<Item = OnLane> + use<> {
        std::iter::once(self.base_on_lane(base, motion, items)).chain(self.loads_on_lane(base, motion, items))
    }

    /// An item on this lane.
    pub fn base_on_lane(&self, base: usize, motion: Motion, items: &Items) -> OnLane {
        let size = items.dimensions(base).size;
        let half = self.lane().lengths_of([size.x, size.y])[0] / 2.0;
        OnLane { item: base, base, motion, ahead: 0.0, half, top: size.z }
    }

    /// All that lies on an item on this lane, and on that.
    pub fn loads_on_lane(&self, base: usize, motion: Motion, items: &Items) -> Vec<OnLane> {
        if items.loads_of(base).is_empty() {
            return Vec::new();
        }
        let on_lane = |(item, block): (usize, Block)| {
            let [half, _] = block.half_extents();
            OnLane { item, base, motion, ahead: block.at().x, half, top: block.top() }
        };
        items.with_loads(base).skip(1).zip(self.blocks_on(base, items).into_iter().skip(1)).map(on_lane).collect()
    }

    /// An item on this lane and all that lies on it, as it is turned there: x ahead of its middle, y to the left of the middle
    /// line, from its underside up.
    pub fn blocks_on(&self, base: usize, items: &Items) -> Vec<Block> {
        let centre_line = &self.lane().centre_line;
        let turn = match centre_line.turns_items() {
            true => 0.0,
            false => items.turn(base).to_degrees() - centre_line.frame(0.0).yaw,
        };
        let left = match (items[base].carrier, centre_line) {
            // Across is along the other axis of the world.
            (Carrier::Lane { across, .. }, CentreLine::Axis { along: Axis::X, .. }) => -across,
            (Carrier::Lane { across, .. }, _) => across,
            _ => 0.0,
        };
        let on_lane = Frame::new(Point::new(0.0, left, 0.0), turn);
        let block = |item: usize| {
            let frame = on_lane.then(items.on_base(item).1);
            Block::new(items.dimensions(item).size, frame.position, frame.yaw.to_radians())
        };
        items.with_loads(base).map(block).collect()
    }
}

impl OnLane {
    /// The place of its middle now.
    pub fn place(&self, moving: &Moving) -> f64 {
        moving.place_at(self.motion, moving.now_ms()) - self.ahead
    }

    /// As [`Moving::comes_to`], of its middle.
    pub fn comes_to(&self, place: f64, moving: &Moving, now_ms: f64) -> f64 {
        moving.comes_to(self.motion, place + self.ahead, now_ms)
    }

    /// Where its underside is now.
    pub fn point(&self, moving: &Moving, see: &See) -> Option<Point> {
        let base = Running::block(moving, self.base, moving.now_ms(), see)?;
        Some(base.frame().point(see.items.on_base(self.item).1.position))
    }
}
