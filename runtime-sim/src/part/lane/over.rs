//! What sensors over a lane may see: the items on it, and what lies on these.

use super::moving::{Motion, Moving};
use crate::frame::Frame;
use crate::item::Items;
use crate::item::block::Block;
use crate::part::{Running, See};
use crate::point::Point;

/// An item on a lane, or one that lies on such an item, with which it goes.
#[derive(Clone, Copy, Debug)]
pub struct Over {
    pub item: usize,
    /// On the lane.
    pub base: usize,
    /// Of the base.
    pub motion: Motion,
    /// How far ahead of the middle of the base its own is, m.
    pub ahead: f64,
    /// Half of its length along the lane, m.
    pub half: f64,
    /// Of its upper side over the surface of the lane, m.
    pub top: f64,
}

impl Moving {
    /// An item on this lane, then all that lies on it.
    pub fn over(&self, base: usize, motion: Motion, items: &Items) -> impl Iterator<Item = Over> + use<> {
        let loads = match items.loads_of(base) {
            [] => Vec::new(),
            _ => self.over_loads(base, motion, items),
        };
        std::iter::once(self.over_itself(base, motion, items)).chain(loads)
    }

    /// An item on this lane.
    pub fn over_itself(&self, base: usize, motion: Motion, items: &Items) -> Over {
        let size = items.shape(base).size;
        let half = self.lane().lengths_of([size.x, size.y])[0] / 2.0;
        Over { item: base, base, motion, ahead: 0.0, half, top: size.z }
    }

    /// All that lies on an item on this lane, and on that.
    pub fn over_loads(&self, base: usize, motion: Motion, items: &Items) -> Vec<Over> {
        let centre_line = &self.lane().centre_line;
        // Turned as the base is on the lane, x ahead.
        let turn = match centre_line.turns_items() {
            true => 0.0,
            false => items.turn(base).to_degrees() - centre_line.frame(0.0).yaw,
        };
        let on_lane = Frame::new(Point::default(), turn);
        let over = |item: usize| {
            let frame = on_lane.then(items.on_base(item).1);
            let size = items.shape(item).size;
            let [half, _] = Block::new(size, frame.position, frame.yaw.to_radians()).half_extents();
            let Point { x: ahead, z, .. } = frame.position;
            Over { item, base, motion, ahead, half, top: z + size.z }
        };
        items.with_loads(base).into_iter().skip(1).map(over).collect()
    }

    /// The place of its middle now.
    pub fn place_of_over(&self, over: &Over) -> f64 {
        self.place_at(over.motion, self.now_ms()) - over.ahead
    }

    /// As [`Moving::comes_to`], of its middle.
    pub fn over_comes_to(&self, over: &Over, place: f64, now_ms: f64) -> f64 {
        self.comes_to(over.motion, place + over.ahead, now_ms)
    }

    /// Where its underside is now.
    pub fn point_of_over(&self, over: &Over, see: &See) -> Option<Point> {
        let base = Running::block(self, over.base, self.now_ms(), see)?;
        Some(base.frame().point(see.items.on_base(over.item).1.position))
    }
}
