//! Items, and the one carrier that each of them has at every moment.

pub mod block;
pub mod footprint;
mod solids;
mod states;

use crate::carrier::Carrier;
use crate::event::{Event, Log, OrderChange};
use crate::frame::Frame;
use crate::line::{Deck, Kind, Line};
use crate::part::place::{Floor, Stack};
use crate::point::Point;
use block::Block;
use states::States;
use std::collections::BTreeMap;
use std::ops::Index;
use std::sync::Arc;

#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Item {
    pub kind: usize,
    pub carrier: Carrier,
}

/// Of the items of a kind, m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dimensions {
    /// Along x and y as it appears on a belt, and upwards.
    pub size: Point,
    pub deck: Option<Deck>,
}

impl Dimensions {
    pub fn of(kind: &Kind) -> Self {
        Self { size: kind.lengths(), deck: kind.deck }
    }
}

/// What the items of a line's supply are called.
#[derive(Clone, Debug)]
pub struct Names {
    kinds: Arc<[String]>,
    /// Of each item its kind, and its number among those of this kind.
    items: Arc<[[u32; 2]]>,
}

impl Names {
    pub fn new(line: &Line) -> Self {
        let mut counts = vec![0; line.kinds.len()];
        let kinds = line.scenario.supply.iter().flat_map(|supply| supply.items.iter());
        let numbered = kinds.map(|&kind| {
            counts[kind] += 1;
            [kind as u32, counts[kind]]
        });
        Self { items: numbered.collect(), kinds: line.kinds.iter().map(|kind| kind.name.clone()).collect() }
    }

    /// The kind that an item has when it comes from the supply, and its number among those of this kind, from 1, such as
    /// `battery_1`.
    pub fn name(&self, item: usize) -> String {
        let [kind, number] = self.items[item];
        format!("{}_{number}", self.kinds[kind as usize])
    }

    /// The item of this kind and number; none if the supply has fewer.
    pub fn find(&self, kind: usize, number: u32) -> Option<usize> {
        self.items.iter().position(|item| *item == [kind as u32, number])
    }

    /// Of all items, in the order of the supply.
    pub fn all(&self) -> Vec<String> {
        (0..self.items.len()).map(|item| self.name(item)).collect()
    }
}

/// All items of a run, with the log of what became of them.
#[derive(Clone, Debug)]
pub struct Items {
    states: States,
    /// Of an item those that became parts of it, in the order in which they did.
    parts: BTreeMap<usize, Vec<usize>>,
    /// Of an item those that lie on it, in the order in which they came.
    loads: BTreeMap<usize, Vec<usize>>,
    /// Of the kinds.
    dimensions: Arc<[Dimensions]>,
    /// Of an item how it is turned about the vertical on what bears it, rad; left out if it is not.
    turns: BTreeMap<usize, f64>,
    /// Items that each machine bears, in the order in which they came.
    pub(crate) borne: Vec<Vec<usize>>,
    /// Items on the ground or on obstacles.
    fallen: Vec<usize>,
    log: Log,
    pub(crate) scan: u64,
    /// What broke a machine, and which.
    crash: Option<(usize, String)>,
}

impl Index<usize> for Items {
    type Output = Item;

    fn index(&self, item: usize) -> &Item {
        self.states.of(item)
    }
}

impl Items {
    /// The items of the line's supply, none of them on the line yet.
    pub fn new(line: &Line) -> Self {
        Self {
            states: States::new(line.scenario.supply.iter().flat_map(|supply| supply.items.iter().copied())),
            parts: BTreeMap::new(),
            loads: BTreeMap::new(),
            dimensions: line.kinds.iter().map(Dimensions::of).collect(),
            turns: BTreeMap::new(),
            borne: vec![Vec::new(); line.machines.len()],
            fallen: Vec::new(),
            log: Log::default(),
            scan: 0,
            crash: None,
        }
    }

    pub fn get(&self, item: usize) -> Option<&Item> {
        (item < self.count()).then(|| &self[item])
    }

    /// In the order of the supply.
    pub fn all(&self) -> impl DoubleEndedIterator<Item = &Item> + ExactSizeIterator {
        (0..self.count()).map(|item| &self[item])
    }

    pub fn count(&self) -> usize {
        self.states.count()
    }

    /// Items that became parts of another one, in the order in which they did.
    pub fn parts_of(&self, of: usize) -> Vec<usize> {
        self.parts.get(&of).cloned().unwrap_or_default()
    }

    /// Without what lies on other items.
    pub fn borne_by(&self, machine: usize) -> &[usize] {
        &self.borne[machine]
    }

    /// Items that have a place on the line, in no order that means anything.
    pub fn placed(&self) -> impl Iterator<Item = usize> {
        self.borne.iter().flatten().chain(&self.fallen).chain(self.loads.values().flatten()).copied()
    }

    /// Items that lie on this one, in the order in which they came.
    pub fn loads_of(&self, item: usize) -> &[usize] {
        self.loads.get(&item).map_or(&[], Vec::as_slice)
    }

    /// Whether any item lies on another one.
    pub fn has_loads(&self) -> bool {
        !self.loads.is_empty()
    }

    /// An item with all that lies on it, and on that, this one first.
    pub fn with_loads(&self, item: usize) -> impl Iterator<Item = usize> + use<> {
        let mut loads = self.loads_of(item).to_vec();
        let mut next = 0;
        while let Some(&load) = loads.get(next) {
            loads.extend(self.loads_of(load));
            next += 1;
        }
        std::iter::once(item).chain(loads)
    }

    /// The item at the bottom that bears this one, which is this one if it lies on no other.
    pub fn base_of(&self, item: usize) -> usize {
        let mut base = item;
        while let Some(under) = self[base].carrier.item() {
            base = under;
        }
        base
    }

    /// How many items bear it, one on another.
    pub fn depth(&self, item: usize) -> usize {
        std::iter::successors(self[item].carrier.item(), |under| self[*under].carrier.item()).count()
    }

    /// The frame of an item in that of the one at the bottom, with that one; both turned about the vertical.
    pub fn on_base(&self, item: usize) -> (usize, Frame) {
        let Carrier::On { item: under, offset } = self[item].carrier else { return (item, Frame::default()) };
        let (base, frame) = self.on_base(under);
        (base, frame.then(Frame::new(offset, self.turn(item).to_degrees())))
    }

    /// The items on the deck of one, in its frame; none if it has no deck.
    pub fn deck(&self, under: usize) -> Option<Stack> {
        let deck = self.dimensions(under).deck?;
        let [x, y] = deck.size.map(|length| [-length / 2.0, length / 2.0]);
        let floor = Floor { middle: Point::new(0.0, 0.0, deck.height), x, y, yaw: 0.0 };
        let loads = self.loads_of(under).iter().filter_map(|load| {
            let Carrier::On { offset, .. } = self[*load].carrier else { return None };
            Some((*load, Block::new(self.dimensions(*load).size, offset, self.turn(*load))))
        });
        Some(Stack::new(floor, loads.collect()))
    }

    /// As it is now: what a process makes of an item has those of its new kind.
    pub fn dimensions(&self, item: usize) -> Dimensions {
        self.dimensions[self[item].kind]
    }

    /// Number of machines that could bear items.
    pub fn machines(&self) -> usize {
        self.borne.len()
    }

    pub fn log(&self) -> &Log {
        &self.log
    }

    /// Everyone has read the first `read` events.
    pub(crate) fn forget_events(&mut self, read: usize) {
        self.log.forget(read);
    }

    /// Hands an item over to another carrier, at `point`.
    pub(crate) fn pass(&mut self, item: usize, to: Carrier, point: Point) {
        let from = self.states.carry(item, to);
        if let Some(machine) = from.machine() {
            self.borne[machine].retain(|&other| other != item);
        }
        if let Some(machine) = to.machine() {
            self.borne[machine].push(item);
        }
        if matches!(from, Carrier::Floor { .. }) {
            self.fallen.retain(|&other| other != item);
        }
        if matches!(to, Carrier::Floor { .. }) {
            self.fallen.push(item);
        }
        if let Carrier::Part { of } = from
            && let Some(parts) = self.parts.get_mut(&of)
        {
            parts.retain(|&other| other != item);
        }
        if let Carrier::Part { of } = to {
            self.parts.entry(of).or_default().push(item);
        } else if to.is_final() {
            self.parts.remove(&item);
            self.turns.remove(&item);
        }
        if let Some(under) = from.item()
            && let Some(loads) = self.loads.get_mut(&under)
        {
            loads.retain(|&other| other != item);
            if loads.is_empty() {
                self.loads.remove(&under);
            }
        }
        if let Some(under) = to.item() {
            self.loads.entry(under).or_default().push(item);
        }
        self.log.push(Event::Item { scan: self.scan, item, from, to, point });
        if to.is_final() {
            for load in self.loads.remove(&item).unwrap_or_default() {
                self.pass(load, to, point);
            }
        }
    }

    /// What bears an item bears it elsewhere.
    pub(crate) fn shift(&mut self, item: usize, to: Carrier, point: Point) {
        let from = self.states.carry(item, to);
        self.log.push(Event::Item { scan: self.scan, item, from, to, point });
    }

    /// How an item is turned about the vertical on what bears it, to the left as seen from above, rad. On a lane that turns
    /// items this is not asked.
    pub fn turn(&self, item: usize) -> f64 {
        self.turns.get(&item).copied().unwrap_or_default()
    }

    pub(crate) fn set_turn(&mut self, item: usize, turn: f64) {
        if turn == 0.0 {
            self.turns.remove(&item);
        } else {
            self.turns.insert(item, turn);
        }
    }

    /// An item becomes one of another kind.
    pub(crate) fn remake(&mut self, item: usize, kind: usize) {
        if self.states.remake(item, kind) != kind {
            self.log.push(Event::Kind { scan: self.scan, item, kind });
        }
    }

    /// Only the first counts.
    pub(crate) fn crash(&mut self, machine: usize, reason: String) {
        self.crash.get_or_insert((machine, reason));
    }

    pub fn crashed(&self) -> Option<(usize, &str)> {
        self.crash.as_ref().map(|(machine, reason)| (*machine, reason.as_str()))
    }

    pub(crate) fn note_order(&mut self, machine: usize, order: usize, change: OrderChange) {
        self.log.push(Event::Order { scan: self.scan, machine, order, change });
    }
}
