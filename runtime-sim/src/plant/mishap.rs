//! What comes down on another item, or off one.

use super::Plant;
use super::fall::{self, Falling};
use crate::carrier::Carrier;
use crate::item::block::Block;
use crate::point::Point;

/// Of an item that falls.
pub(super) struct Landing {
    item: usize,
    falling: Falling,
    ms: f64,
    pub carrier: Carrier,
    pub point: Point,
}

/// It cannot lie there.
pub(super) struct Mishap {
    pub machine: usize,
    pub reason: String,
}

impl Landing {
    fn is_at_place(&self) -> bool {
        matches!(self.carrier, Carrier::Place { .. })
    }
}

impl Plant {
    pub(super) fn landing(&self, item: usize, from: Point, ms: f64) -> Landing {
        let falling = self.falling(item, from);
        let (carrier, point) = fall::fall(self, item, &falling, ms);
        Landing { item, falling, ms, carrier, point }
    }

    pub(super) fn mishap(&mut self, landing: &Landing) -> Option<Mishap> {
        if let Carrier::On { item: under, .. } = landing.carrier {
            let on_deck = self.on_deck(landing.item, &landing.falling, landing.ms)?;
            let machine = self.base_carrier(under).machine()?;
            return Some(Mishap { machine, reason: self.mishap_on(landing.item, &on_deck)? });
        }
        let machine = landing.carrier.machine()?;
        let reason = if let Some(under) = self.is_in(landing) {
            format!(
                "{} comes down on {}, which lies there",
                self.names.name(landing.item),
                self.names.name(under)
            )
        } else if let Some(off) = self.tips_off(landing).filter(|_| landing.is_at_place()) {
            format!("{} tips off {}", self.names.name(landing.item), self.names.name(off))
        } else {
            let under = self.lies_under(landing.item, &landing.carrier, landing.ms)?;
            let [upper, lower] = [landing.item, under].map(|item| self.names.name(item));
            format!("{upper} comes down on {lower}, which lies on a conveyor")
        };
        Some(Mishap { machine, reason })
    }

    /// An item at a place of the machine in which another one would be: where both places stack items, as they are turned,
    /// else however they are turned.
    fn is_in(&self, landing: &Landing) -> Option<usize> {
        let Carrier::Place { machine, part, .. } = landing.carrier else { return None };
        let working = &self.machines[machine];
        let see = working.see(&self.items, &self.desk);
        if working.upper(&landing.carrier, &self.items, &self.desk).is_some() {
            return None;
        }
        let Falling { kind, turn, .. } = landing.falling;
        let block = Block::new(self.sizes[kind], landing.point, turn);
        let stacks = |part: usize| see.stack(part).is_some();
        let stacks_here = stacks(part);
        let others = self.items.borne_by(machine).iter().copied().filter(|other| *other != landing.item);
        let mut at_places =
            others.filter(|other| matches!(self.items[*other].carrier, Carrier::Place { .. }));
        at_places.find(|other| {
            let Some(lies) = working.block(*other, landing.ms, &see) else { return false };
            let of = self.items[*other].carrier.part().unwrap_or(part);
            match stacks_here && (of == part || stacks(of)) {
                true => block.is_in(&lies),
                false => block.is_surely_in(&lies),
            }
        })
    }

    /// The item off which one tips that comes down, wherever that lies; none if anything bears it there.
    fn tips_off(&self, landing: &Landing) -> Option<usize> {
        let Landing { falling, point, ms, .. } = landing;
        let mut off = Vec::new();
        for working in &self.machines {
            let see = working.see(&self.items, &self.desk);
            off.extend(working.tips_off(falling, point.z, *ms, &see));
        }
        off.into_iter().collect::<Option<Vec<usize>>>()?.first().copied()
    }

    /// An item on a conveyor on which another one comes down.
    fn lies_under(&mut self, item: usize, carrier: &Carrier, ms: f64) -> Option<usize> {
        self.convey(|conveying, among, _| conveying.lies_under(among, item, carrier, ms))
    }
}
