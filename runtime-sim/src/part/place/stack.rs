//! How the items of a place lie on one another.

use super::floor::Floor;
use crate::item::block::{Block, SAME_HEIGHT};
use crate::point::Point;

/// Where an item comes to rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rest {
    pub height: f64,
    /// The item on which it does not stay.
    pub tips_off: Option<usize>,
}

/// The items of a place on its floor, as seen from its origin.
#[derive(Clone, Debug)]
pub struct Stack {
    floor: Floor,
    /// In the order in which they came.
    items: Vec<(usize, Block)>,
}

impl Stack {
    pub fn new(floor: Floor, items: Vec<(usize, Block)>) -> Self {
        Self { floor, items }
    }

    /// Whether what has its underside there does not lie on the floor.
    pub fn is_over_floor(&self, at: Point) -> bool {
        at.z > self.floor.middle.z + SAME_HEIGHT
    }

    pub fn block(&self, item: usize) -> Option<&Block> {
        self.items.iter().find(|(other, _)| *other == item).map(|(_, block)| block)
    }

    /// Of an item from above: on the highest of those under any part of it whose upper sides are no higher than this, else
    /// on the floor. None: it falls past the place.
    pub fn rest(&self, block: &Block, highest: f64) -> Option<Rest> {
        self.rest_on(block, |_, under| under.top() <= highest)
    }

    /// Of an item at this place, where only some bear it.
    pub fn rest_on(&self, block: &Block, bears: impl Fn(usize, &Block) -> bool) -> Option<Rest> {
        let is_over_floor = self.floor.is_under(block.at());
        let may_bear = |(item, under): &&(usize, Block)| bears(*item, under) && block.overlaps(under);
        let under: Vec<_> = self.items.iter().filter(may_bear).collect();
        let Some(height) = under.iter().map(|(_, under)| under.top()).reduce(f64::max) else {
            let height = self.floor.middle.z;
            return is_over_floor.then_some(Rest { height, tips_off: None });
        };
        let bearers = || under.iter().filter(|(_, under)| under.top() > height - SAME_HEIGHT);
        let stays = is_over_floor || bearers().any(|(_, under)| under.is_under_middle_of(block));
        let tips_off = bearers().next().filter(|_| !stays).map(|(item, _)| *item);
        Some(Rest { height, tips_off })
    }

    /// An item that lies on this one.
    pub fn lies_on(&self, item: usize) -> Option<usize> {
        let under = self.block(item)?;
        self.items.iter().find(|(_, block)| block.lies_on(under)).map(|(upper, _)| *upper)
    }

    /// An item that is in this one.
    pub fn is_in(&self, item: usize) -> Option<usize> {
        let block = self.block(item)?;
        let found = self.items.iter().find(|(other, others)| *other != item && others.is_in(block));
        found.map(|(other, _)| *other)
    }

    /// The items that may come to rest at another height if one changes and others go, the lowest first: all that lie on
    /// these, or on others that do, and the one that changes if it lies on any.
    pub fn shaken(&self, changes: usize, gone: &[usize]) -> Vec<usize> {
        let mut lowest_first: Vec<&(usize, Block)> = self.items.iter().collect();
        lowest_first.sort_by(|(_, one), (_, other)| one.at().z.total_cmp(&other.at().z));
        let mut bearing: Vec<usize> = gone.iter().copied().chain([changes]).collect();
        let mut shaken = Vec::new();
        for (item, block) in lowest_first.into_iter().filter(|(item, _)| !gone.contains(item)) {
            let counts = |other: usize| *item == changes || bearing.contains(&other);
            if self.items.iter().any(|(other, under)| counts(*other) && block.lies_on(under)) {
                bearing.push(*item);
                shaken.push(*item);
            }
        }
        shaken
    }
}

#[cfg(test)]
mod tests;
