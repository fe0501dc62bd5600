//! Items that lie on other items: in a tray, on a pallet, in a box.

use super::Plant;
use super::fall::{Falling, SINK};
use crate::carrier::Carrier;
use crate::frame::Frame;
use crate::item::block::{Block, SAME_HEIGHT};
use crate::part::place::Rest;
use crate::plant::conveyed::Conveyed;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;

/// Where an item comes to rest on another one.
pub(super) struct OnDeck {
    pub under: usize,
    /// In the frame of that item.
    pub block: Block,
    pub rest: Rest,
    /// Of where it comes to rest, over the floor of the hall.
    pub height: f64,
    /// Of the upper side of that item, over the floor of the hall.
    pub rim: f64,
}

impl Plant {
    /// What bears an item, or all that is under it; what lies on a gripped item hangs from the tool as that does.
    pub fn base_carrier(&self, item: usize) -> Carrier {
        let carrier = self.items[item].carrier;
        if carrier.item().is_none() {
            return carrier;
        }
        let (base, frame) = self.items.on_base(item);
        match self.items[base].carrier {
            Carrier::Grip { machine, part, hang } => {
                let on_tool = Frame::new(Point::default(), self.items.turn(base).to_degrees());
                // The tool points down.
                let Point { x, y, z } = on_tool.point(frame.position);
                Carrier::Grip { machine, part, hang: hang + Point::new(x, -y, -z) }
            }
            carrier => carrier,
        }
    }

    /// The machine that bears this, or the item on which it lies.
    pub(super) fn machine_under(&self, carrier: Carrier) -> Option<usize> {
        carrier.item().map_or(carrier, |under| self.base_carrier(under)).machine()
    }

    /// What an item takes up at a time, ms, that lies somewhere, not in a gripper and not on its side.
    pub(super) fn block(&self, item: usize, ms: f64) -> Option<Block> {
        let size = self.items.dimensions(item).size;
        match self.items[item].carrier {
            Carrier::On { item: under, offset } => {
                let under = self.block(under, ms)?;
                let turn = under.turn() + self.items.turn(item);
                Some(Block::new(size, under.frame().point(offset), turn))
            }
            Carrier::Floor { point } => Some(Block::new(size, point, self.items.turn(item))),
            carrier => {
                let working = self.machines.get(carrier.machine()?)?;
                working.block(item, ms, &working.see(&self.items, &self.desk))
            }
        }
    }

    /// The highest deck under an item that falls at a time, ms, and where it comes to rest there; of decks at the same height
    /// one off which it does not tip, and the uppermost of trays on trays.
    pub(super) fn on_deck(&self, item: usize, falling: &Falling, ms: f64) -> Option<OnDeck> {
        let own: Vec<usize> = self.items.with_loads(item).collect();
        let decks = self.items.placed().filter(|under| self.items.dimensions(*under).deck.is_some());
        let found = decks.filter(|under| !own.contains(under)).filter_map(|under| {
            let block = self.block(under, ms)?;
            let rim = block.top();
            let seen = block.frame().seen(falling.point);
            let block = Block::new(falling.size, seen, falling.turn - block.turn());
            let rest = self.items.deck(under)?.rest(&block, seen.z + SINK)?;
            let height = falling.point.z - seen.z + rest.height;
            let at = Point { z: rest.height, ..seen };
            let is_below = rest.height <= seen.z + SINK;
            is_below.then(|| OnDeck { under, block: block.moved_to(at), rest, height, rim })
        });
        let rank = |on: &OnDeck| (on.rest.tips_off.is_none(), self.items.depth(on.under));
        found.reduce(|best, other| {
            let is_level = (other.height - best.height).abs() < SAME_HEIGHT;
            let is_better = if is_level { rank(&other) > rank(&best) } else { other.height > best.height };
            if is_better { other } else { best }
        })
    }

    /// An item that lies on this one at a time, ms, and not with it.
    pub(super) fn lies_on(&self, item: usize, ms: f64) -> Option<usize> {
        let on_deck = self.items[item].carrier.item().and_then(|under| self.items.deck(under)?.lies_on(item));
        on_deck.or_else(|| self.lies_across(item, ms))
    }

    /// The same of items on others, and at all places where they lie on one another: not those on the floor of a place, or on
    /// a tray itself.
    fn lies_across(&self, item: usize, ms: f64) -> Option<usize> {
        if !self.items.has_loads() && !matches!(self.items[item].carrier, Carrier::Place { .. }) {
            return None;
        }
        let under = self.block(item, ms)?;
        let own: Vec<usize> = self.items.with_loads(item).collect();
        let here = self.machine_under(self.items[item].carrier).filter(|_| self.items.has_loads());
        let machines = self.stacking.iter().copied().chain(here);
        let others = machines.flat_map(|machine| self.items.borne_by(machine));
        let mut others =
            others.flat_map(|base| self.items.with_loads(*base)).filter(|other| !own.contains(other));
        others.find(|other| {
            self.lies_on_items(*other) && self.block(*other, ms).is_some_and(|other| other.lies_on(&under))
        })
    }

    fn lies_on_items(&self, item: usize) -> bool {
        let (stack, offset) = match self.items[item].carrier {
            Carrier::Place { machine, part, offset } => {
                (self.machines[machine].see(&self.items, &self.desk).stack(part), offset)
            }
            Carrier::On { item: under, offset } => (self.items.deck(under), offset),
            _ => return false,
        };
        stack.is_some_and(|stack| stack.is_over_floor(offset))
    }

    /// Where the underside of an item is that lies on another one; it is rigid with a tool that has gripped that.
    pub(super) fn place_of_load(&self, item: usize) -> Option<Point> {
        let (base, frame) = self.items.on_base(item);
        match self.base_carrier(item) {
            Carrier::Grip { machine, part, hang } => {
                let carrier = Carrier::Grip { machine, part, hang };
                self.machines.get(machine)?.place(base, &carrier, &self.items, &self.desk)
            }
            _ => Some(Frame::new(self.place(base)?, self.turn(base).to_degrees()).point(frame.position)),
        }
    }

    /// As [`Plant::turn`], of an item that lies on another one.
    pub(super) fn turn_of_load(&self, item: usize) -> f64 {
        let (base, frame) = self.items.on_base(item);
        self.turn(base) + frame.yaw.to_radians()
    }

    /// As [`Plant::conveyed`], of an item that lies on another one.
    pub(super) fn load_conveyed(&self, item: usize) -> Option<Conveyed> {
        let (base, frame) = self.items.on_base(item);
        let conveyed = self.conveyed(base)?;
        Some(conveyed.with(frame.position, self.items.turn(base).to_degrees()))
    }

    /// What lies on an item slides off, if a tool comes to rest that holds this on its side.
    pub(super) fn spill(&mut self, scan: u64) {
        if !self.items.has_loads() {
            return;
        }
        let ms = (scan * self.scan_ms) as f64;
        for number in 0..self.grippers.len() {
            let (machine, part) = self.grippers[number];
            let held = self.items.borne_by(machine).iter().copied();
            let mut held = held.filter(|item| self.items[*item].carrier.part() == Some(part));
            let Some(tray) = held.find(|item| !self.items.loads_of(*item).is_empty()) else { continue };
            let rests = self.machines[machine].trajectory(ms as u64).since(ms) == Trajectory::Rests;
            if rests && self.upper(tray).is_some() {
                let [load, tray] = [self.items.loads_of(tray)[0], tray].map(|item| self.names.name(item));
                self.items.crash(machine, format!("{load} slides off {tray}, which is on its side"));
            }
        }
    }
}
