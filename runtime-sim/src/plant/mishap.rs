//! What comes down on another item, or off one.

use super::Plant;
use super::fall::{self, Falling};
use super::loads::OnDeck;
use crate::carrier::Carrier;
use crate::frame::Frame;
use crate::item::Dimensions;
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

/// An item where it stands.
struct Stands {
    item: usize,
    carrier: Carrier,
    of: Dimensions,
    frame: Frame,
}

impl Stands {
    fn block(&self) -> Block {
        Block::new(self.of.size, self.frame.position, self.frame.yaw.to_radians())
    }

    fn solids(&self) -> Vec<Block> {
        self.of.solids_in(self.frame)
    }
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
    pub(super) fn landing(&self, item: usize, falling: Falling, ms: f64) -> Landing {
        let (carrier, point) = fall::fall(self, item, &falling, ms);
        Landing { item, falling, ms, carrier, point }
    }

    pub(super) fn mishap(&mut self, landing: &Landing) -> Option<Mishap> {
        let under = landing.carrier.item();
        let bearer = self.machine_under(landing.carrier);
        // What has fallen on the floor bears this one.
        let machine = bearer.or_else(|| under.and(self.items[landing.item].carrier.machine()))?;
        let reason = match under {
            Some(under) => self.mishap_on(landing, under),
            None => self.mishap_at(landing),
        };
        Some(Mishap { machine, reason: reason? })
    }

    fn comes_down_on(&self, pair: [usize; 2]) -> String {
        let [item, other] = pair.map(|item| self.names.name(item));
        format!("{item} comes down on {other}, which lies there")
    }

    fn text_of_tipping(&self, landing: &Landing, off: usize) -> String {
        format!("{} tips off {}", self.names.name(landing.item), self.names.name(off))
    }

    /// Why an item cannot lie where it comes down on a conveyor or at a place.
    fn mishap_at(&mut self, landing: &Landing) -> Option<String> {
        if let Some(pair) = self.meets(landing).next() {
            return Some(self.comes_down_on(pair));
        }
        if let Some(off) = self.tips_off(landing).filter(|_| landing.is_at_place()) {
            return Some(self.text_of_tipping(landing, off));
        }
        let under = self.lies_under(landing.item, &landing.carrier, landing.ms)?;
        let [upper, lower] = [landing.item, under].map(|item| self.names.name(item));
        let on = if self.items.dimensions(under).deck.is_some() { "beside the deck of" } else { "on" };
        Some(format!("{upper} comes down {on} {lower}, which lies on a conveyor"))
    }

    /// Why an item cannot lie where it comes down on another one.
    fn mishap_on(&self, landing: &Landing, under: usize) -> Option<String> {
        let OnDeck { rest, .. } = self.on_deck(landing.item, &landing.falling, landing.ms)?;
        if let Some(pair) = self.meets(landing).find(|[_, other]| *other != under) {
            return Some(self.comes_down_on(pair));
        }
        if let Some(off) = rest.tips_off {
            return Some(self.text_of_tipping(landing, off));
        }
        let is_on_wall = self.meets(landing).any(|[_, other]| other == under);
        let [upper, lower] = [landing.item, under].map(|item| self.names.name(item));
        is_on_wall.then(|| format!("{upper} comes down on the edge of {lower}"))
    }

    /// An item that comes down, or one on it, with each item of the machine, or on the item on the floor, in which it would be.
    fn meets(&self, landing: &Landing) -> impl Iterator<Item = [usize; 2]> {
        let Landing { item, falling, point, carrier, ms } = *landing;
        let bases = match (self.machine_under(carrier), carrier.item()) {
            _ if matches!(carrier, Carrier::Lane { .. }) && !self.items.has_loads() => Vec::new(),
            (Some(machine), _) => self.items.borne_by(machine).to_vec(),
            (None, Some(under)) => vec![self.items.base_of(under)],
            (None, None) => Vec::new(),
        };
        let turn = self.heading(&carrier, point, ms).unwrap_or(falling.turn);
        let lands_as = Frame::new(point, turn.to_degrees());
        let own = self.items.with_loads(item).map(|own| {
            let carrier = if own == item { carrier } else { self.items[own].carrier };
            let of = self.items.dimensions(own);
            Stands { item: own, carrier, of, frame: lands_as.then(self.items.on_base(own).1) }
        });
        let own: Vec<Stands> = own.collect();
        let lands_upright = self.lands_upright(&carrier);
        let bases = bases.into_iter().filter(move |base| lands_upright && *base != item);
        bases.flat_map(|base| self.items.with_loads(base)).filter_map(move |item| {
            let (lies, carrier) = (self.block(item, ms)?, self.items[item].carrier);
            let other = Stands { item, carrier, of: self.items.dimensions(item), frame: lies.frame() };
            let own = own.iter().find(|own| self.are_in_one_another(own, &other))?;
            Some([own.item, item])
        })
    }

    /// How a lane turns what comes onto it there at a time, ms, about the vertical, rad; none of what keeps its turn.
    fn heading(&self, carrier: &Carrier, point: Point, ms: f64) -> Option<f64> {
        let Carrier::Lane { machine, part, .. } = *carrier else { return None };
        let working = &self.machines[machine];
        working.lane(part)?.heading(point, ms, &working.see(&self.items, &self.desk))
    }

    /// What is held on its side is not seen to.
    fn lands_upright(&self, carrier: &Carrier) -> bool {
        if let Some(under) = carrier.item() {
            return self.upper(under).is_none();
        }
        let bearer = carrier.machine().map(|machine| &self.machines[machine]);
        bearer.is_none_or(|bearer| bearer.upper(carrier, &self.items, &self.desk).is_none())
    }

    /// On places where items do not lie on one another they may be turned as they like; what lies on a conveyor itself is not
    /// asked here.
    fn are_in_one_another(&self, one: &Stands, other: &Stands) -> bool {
        let stacks = |machine: usize, part: usize| {
            self.machines[machine].see(&self.items, &self.desk).stack(part).is_some()
        };
        match (one.carrier, other.carrier) {
            (Carrier::On { .. }, _) | (_, Carrier::On { .. }) => {
                Block::are_in_one_another(&one.solids(), &other.solids())
            }
            (Carrier::Place { machine, part, .. }, Carrier::Place { part: of, .. }) => {
                match stacks(machine, part) && (part == of || stacks(machine, of)) {
                    true => one.block().is_in(&other.block()),
                    false => one.block().is_surely_in(&other.block()),
                }
            }
            _ => false,
        }
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
