//! Where a machine bears items, and how.

use super::Working;
use crate::carrier::Carrier;
use crate::item::Items;
use crate::item::block::{Block, SAME_HEIGHT};
use crate::part::orders::Desk;
use crate::part::{Running, See};
use crate::plant::conveyed::Conveyed;
use crate::plant::fall::{Falling, SINK};
use crate::point::Point;

impl Working {
    pub fn below(&self, falling: &Falling, ms: f64, items: &Items, desk: &Desk) -> Option<(f64, Carrier)> {
        let see = self.see(items, desk);
        let surfaces = self.parts.iter().flatten().filter_map(|part| part.below(falling, ms, &see));
        // What is over the item does not bear it.
        surfaces
            .filter(|(height, _)| *height <= falling.point.z + SINK)
            .reduce(|best, other| if other.0 > best.0 { other } else { best })
    }

    /// Of each part that bears an item at this height which comes down, the item off which it tips there.
    pub fn tips_off(
        &self,
        falling: &Falling,
        height: f64,
        ms: f64,
        see: &See,
    ) -> impl Iterator<Item = Option<usize>> {
        let meets = move |part: &&dyn Running| {
            part.below(falling, ms, see).is_some_and(|(surface, _)| (surface - height).abs() < SAME_HEIGHT)
        };
        self.running().filter(meets).map(move |part| part.tips_off(falling, ms, see))
    }

    /// What an item takes up at a time, ms, that stands at one of its places.
    pub fn block(&self, item: usize, ms: f64, see: &See) -> Option<Block> {
        self.parts.get(see.items[item].carrier.part()?)?.as_ref()?.block(item, ms, see)
    }

    pub fn place(&self, item: usize, carrier: &Carrier, items: &Items, desk: &Desk) -> Option<Point> {
        let part = self.parts.get(carrier.part()?)?.as_ref()?;
        part.place(item, carrier, &self.see(items, desk))
    }

    /// Where the upper side of an item that it bears faces; none for up.
    pub fn upper(&self, carrier: &Carrier, items: &Items, desk: &Desk) -> Option<Point> {
        let part = self.parts.get(carrier.part()?)?.as_ref()?;
        part.upper(carrier, &self.see(items, desk))
    }

    /// How what bears an item is turned about the vertical, rad; 0 for what does not turn.
    pub fn turn(&self, carrier: &Carrier, items: &Items, desk: &Desk) -> f64 {
        let part = carrier.part().and_then(|part| self.parts.get(part)?.as_ref());
        part.map_or(0.0, |part| part.tool_turn(&self.see(items, desk)))
    }

    /// How an item that it bears continues, if it is conveyed or carried.
    pub fn conveyed(
        &self,
        item: usize,
        carrier: &Carrier,
        items: &Items,
        desk: &Desk,
        now_ms: u64,
    ) -> Option<Conveyed> {
        let part = self.parts.get(carrier.part()?)?.as_ref()?;
        let conveyed = part.conveyed(item, carrier, &self.see(items, desk))?;
        let carriage = part.on().and_then(|carriage| self.carriage(carriage));
        Some(Conveyed { carried: carriage.and_then(|carriage| carriage.stroking(now_ms)), ..conveyed })
    }
}
