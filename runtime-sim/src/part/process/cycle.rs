//! The cycles of a process.

use super::Process;
use super::settling::Ground;
use crate::carrier::Carrier;
use crate::item::Item;
use crate::line::Kind;
use crate::part::beam::Crossing;
use crate::part::cylinder::End;
use crate::part::place::Stack;
use crate::part::stroke::Carriage;
use crate::part::{Progress, Running, See, World};
use crate::point::Point;
use crate::random::Random;

/// An item this near to a slot lies on it, m.
const NEAR: f64 = 0.01;

/// What is drawn for a cycle.
enum Drawn {
    Time,
    Reject,
}

impl Drawn {
    const COUNT: u64 = 2;
}

/// A process at work.
#[derive(Clone, Debug)]
pub struct Cycle {
    pub(super) process: Process,
    /// Cylinders, the ends at which they have to be, and their names.
    pub(super) needs: Vec<(usize, End, String)>,
    /// For each kind the number of its time; none for a kind that it does not work on.
    times: Vec<Option<usize>>,
    /// What becomes of each kind.
    becomes: Vec<usize>,
    /// For each kind, what some of it become, and their share.
    rejects: Vec<Vec<(usize, f64)>>,
    /// Kinds of the items that are joined to the first one; none for a name that no kind has.
    joins: Vec<Option<usize>>,
    /// Their names.
    pub(super) kinds: Vec<String>,
    /// Of the place; empty on a lane.
    pub(super) slots: Vec<Point>,
    /// On a lane, what is at its place there.
    pub(super) crossing: Option<Crossing>,
    /// Of the part.
    pub(super) name: String,
    seed: u64,
    /// Of the names of its machine and of itself.
    place: [u64; 2],
    is_on: bool,
    /// An edge of `start` that has not been checked yet.
    is_asked: bool,
    works: Option<Work>,
    has_ended: bool,
    /// Cycles that were started.
    started: u32,
    /// Numbers of cycles, from 1, and by how much each takes longer.
    pub(super) longer_ms: Vec<(u32, u64)>,
}

/// A cycle under way.
#[derive(Clone, Debug)]
struct Work {
    item: usize,
    /// What is worked on: the item or what lies on it, each with its number among all that lay there at the start.
    pieces: Vec<(u64, usize)>,
    ready_ms: u64,
}

impl Cycle {
    /// `place` is made of the names of the machine and of the part: each draws times of its own.
    pub fn new(process: &Process, kinds: &[Kind], seed: u64, place: [u64; 2]) -> Self {
        let number = |name: &String| kinds.iter().position(|kind| kind.name == *name);
        let becomes = |kind: usize| {
            let rule = process.makes.iter().find(|[from, _]| *from == kinds[kind].name);
            rule.and_then(|[_, to]| number(to)).unwrap_or(kind)
        };
        let time = |kind: &Kind| match process.kinds.is_empty() {
            true => Some(0),
            false => process.kinds.iter().position(|name| *name == kind.name),
        };
        let rejects = |kind: &Kind| {
            let of_it = process.rejects.iter().filter(|reject| reject.kinds[0] == kind.name);
            of_it.filter_map(|reject| Some((number(&reject.kinds[1])?, reject.share))).collect()
        };
        Self {
            process: process.clone(),
            needs: Vec::new(),
            times: kinds.iter().map(time).collect(),
            becomes: (0..kinds.len()).map(becomes).collect(),
            rejects: kinds.iter().map(rejects).collect(),
            joins: process.joins.iter().map(number).collect(),
            kinds: kinds.iter().map(|kind| kind.name.clone()).collect(),
            slots: Vec::new(),
            crossing: None,
            name: "the process".into(),
            seed,
            place,
            is_on: false,
            is_asked: false,
            works: None,
            has_ended: false,
            started: 0,
            longer_ms: Vec::new(),
        }
    }

    /// How much longer than usual the last cycle that was started takes.
    fn longer_ms(&self) -> u64 {
        let longer = self.longer_ms.iter().filter(|(cycle, _)| *cycle == self.started);
        longer.map(|(_, ms)| ms).sum()
    }

    /// From 0 to less than 1. What is drawn for a cycle depends on no other cycle and no other process.
    fn drawn(&self, what: Drawn, number: u64) -> f64 {
        let [machine, part] = self.place;
        let what = Drawn::COUNT * number + what as u64;
        Random::at(self.seed, [machine, part, u64::from(self.started), what]).fraction()
    }

    /// Of the cycle that was started last, for an item of a kind on which it works; ms.
    fn time_ms(&self, kind: usize) -> u64 {
        let number = self.times[kind].unwrap_or(0).min(self.process.times.len() - 1);
        self.process.times[number].time_ms(self.drawn(Drawn::Time, 0))
    }

    /// Of an item and what lies on it those on which the process works, with their numbers among all.
    fn pieces(&self, item: usize, see: &See) -> Vec<(u64, usize)> {
        let all = (0..).zip(see.items.with_loads(item));
        all.filter(|(_, item)| self.times[see.items[*item].kind].is_some()).collect()
    }

    /// What an item of a kind becomes at the end of this cycle, as number `number` of those that are there.
    fn made_of(&self, kind: usize, number: u64) -> usize {
        let mut drawn = self.drawn(Drawn::Reject, number);
        for (becomes, share) in &self.rejects[kind] {
            if drawn < *share {
                return *becomes;
            }
            drawn -= share;
        }
        self.becomes[kind]
    }

    /// All that is at its place.
    fn there(&self, see: &See) -> impl Iterator<Item = usize> {
        let at_place = see.borne_by(self.process.on).filter(|_| self.crossing.is_none());
        self.crossing.iter().flat_map(|crossing| crossing.items(see)).chain(at_place)
    }

    /// Whether an item on a lane moves that should not, along it or with what carries it.
    fn slides(&self, item: usize, see: &See) -> bool {
        let Some(lane) = see.lane(self.process.on).filter(|_| !self.process.moving) else { return false };
        let motion = lane.motion(item, &see.items[item].carrier);
        let carriage = lane.lane().on.and_then(|carriage| see.carriage(carriage));
        let is_carried = |carriage: &dyn Carriage| {
            carriage.stroking(carriage.now_ms()).is_some_and(|stroking| stroking.moves())
        };
        motion.is_some_and(|motion| lane.speed_of(motion) > 0.0) || carriage.is_some_and(is_carried)
    }

    /// Whether the item is still at its place at a time of this scan, ms.
    fn is_there_at(&self, item: usize, ms: f64, see: &See) -> bool {
        self.crossing.as_ref().is_none_or(|crossing| crossing.is_crossed_by(item, ms, see))
    }

    /// The items that are joined to one, in the order of their kinds; the name of a kind of which none is there.
    fn joined(&self, item: usize, see: &See) -> Result<Vec<usize>, &str> {
        let mut joined = Vec::new();
        let beside = see.borne_by(self.process.on).filter(|_| self.crossing.is_none());
        let others: Vec<usize> = beside.chain(see.items.loads_of(item).iter().copied()).collect();
        for (kind, name) in self.joins.iter().zip(&self.process.joins) {
            let is_wanted = |other: &usize| {
                *other != item && !joined.contains(other) && Some(see.items[*other].kind) == *kind
            };
            joined.push(others.iter().copied().find(is_wanted).ok_or(name.as_str())?);
        }
        Ok(joined)
    }

    /// Of an item that is not there any more.
    fn left(&self, item: usize, see: &See) -> String {
        let is_on_lane = see.borne_by(self.process.on).any(|other| other == item);
        let left = if is_on_lane { "left" } else { "was taken from" };
        format!("{} {left} {} before its end", self.item_text(item, see), self.name)
    }

    fn item_text(&self, item: usize, see: &See) -> String {
        format!("a {}", self.kinds[see.items[item].kind])
    }

    /// The parts of an item come to lie on free slots; the error is why one cannot.
    fn free(&self, item: usize, world: &mut World) -> Result<(), String> {
        let place = self.process.on;
        // What was laid at one may have come to rest lower.
        let mut used = Vec::new();
        for other in world.items.parts_of(item) {
            let see = world.see();
            let is_taken = |slot: &Point| {
                let mut offsets = see.borne_by(place).filter_map(|item| see.items[item].carrier.offset());
                offsets.any(|offset| (offset - *slot).length() < NEAR)
            };
            let free = self.slots.iter().enumerate();
            let slot = free.filter(|(number, _)| !used.contains(number)).find(|(_, slot)| !is_taken(slot));
            let kind = &self.kinds[see.items[other].kind];
            let (number, offset) =
                slot.ok_or_else(|| format!("{} has no free slot for a {kind}", self.name))?;
            used.push(number);
            world.lay(other, place, *offset);
            self.lay_down(other, world)?;
        }
        Ok(())
    }

    /// An edge of `start` has come.
    fn begin_cycle(&mut self, world: &mut World) {
        let see = world.see();
        let item = self.there(&see).next();
        let lacks = self.lacks(item, world);
        let Some(item) = item.filter(|_| lacks.is_empty()) else {
            world.crash(format!("{} was started without {lacks}", self.name));
            return;
        };
        self.has_ended = false;
        self.started = self.started.saturating_add(1);
        let pieces = self.pieces(item, &see);
        let work_piece = pieces.first().map_or(item, |(_, first)| *first);
        let time_ms = self.time_ms(see.items[work_piece].kind);
        self.works = Some(Work { item, pieces, ready_ms: world.now_ms + time_ms + self.longer_ms() });
    }

    /// Why a cycle cannot go on, or cannot end in this scan, if it cannot.
    fn breaks(&self, work: &Work, world: &World) -> Option<String> {
        let (see, item) = (world.see(), work.item);
        if self.slides(item, &see) {
            return Some(format!("{} was moved during {}", self.item_text(item, &see), self.name));
        }
        let is_there = self.there(&see).any(|there| there == item);
        let ends_late =
            work.ready_ms <= world.next_ms() && !self.is_there_at(item, work.ready_ms as f64, &see);
        if !is_there || ends_late {
            return Some(self.left(item, &see));
        }
        let taken = work.pieces.iter().find(|(_, piece)| see.items.base_of(*piece) != item);
        taken.map(|(_, piece)| self.left(*piece, &see))
    }

    /// What becomes of all that was worked on. The error is why that ends the run.
    fn end_cycle(&self, work: &Work, world: &mut World) -> Result<(), String> {
        let item = work.item;
        let joined = self.joined(item, &world.see());
        let joined = joined.map_err(|kind| format!("a {kind} was taken from {}", self.name))?;
        let place = Ground::Place(self.process.on).stack(world);
        let trays: Vec<usize> = world.items.with_loads(item).collect();
        let decks = trays.iter().filter(|tray| !world.items.loads_of(**tray).is_empty());
        let deck = |tray: &usize| Some((*tray, Ground::Deck(*tray).stack(world)?));
        let decks: Vec<(usize, Stack)> = decks.filter_map(deck).collect();
        joined.iter().for_each(|other| world.join(*other, item));
        if self.process.frees {
            self.free(item, world)?;
        }
        for (number, piece) in &work.pieces {
            let Item { kind, carrier } = world.items[*piece];
            if matches!(carrier, Carrier::Part { .. }) {
                continue;
            }
            let before = world.items.dimensions(*piece).size;
            world.items.remake(*piece, self.made_of(kind, *number));
            let after = world.items.dimensions(*piece).size;
            let is_resized = (before.x, before.y) != (after.x, after.y);
            if is_resized && matches!(carrier, Carrier::Lane { .. }) {
                let [from, to] = [kind, world.items[*piece].kind].map(|kind| &self.kinds[kind]);
                let name = &self.name;
                return Err(format!(
                    "{name} makes a {to} of a {from} on a conveyor, which is of another size"
                ));
            }
        }
        for (tray, before) in &decks {
            self.settle_on_tray(*tray, before, world)?;
        }
        if let Some(before) = place {
            self.settle_at_place(item, &before, &joined, world)?;
        }
        self.check_apart(item, world)
    }

    /// What is missing for a start; empty if nothing is.
    fn lacks(&self, item: Option<usize>, world: &World) -> String {
        let see = world.see();
        let mut lacks = Vec::new();
        match item {
            None => lacks.push("an item".to_string()),
            Some(item) if self.pieces(item, &see).is_empty() => {
                lacks.push(format!("a time for a {}", self.kinds[see.items[item].kind]));
            }
            Some(_) => {}
        }
        if let Some(Err(kind)) = item.map(|item| self.joined(item, &see)) {
            let beside = if self.crossing.is_some() { "on" } else { "beside" };
            lacks.push(format!("a {kind} {beside} it"));
        }
        if item.is_some_and(|item| self.slides(item, &see)) {
            lacks.push("an item that stands".to_string());
        }
        for (cylinder, end, name) in &self.needs {
            let mut is_there = [0.0];
            see.read(*cylinder, end.stop(), &mut is_there);
            if is_there[0] == 0.0 {
                lacks.push(format!("its {name} {}", if *end == End::In { "in" } else { "out" }));
            }
        }
        lacks.join(" and ")
    }
}

impl Running for Cycle {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn cycles(&self) -> u32 {
        self.started
    }

    fn level(&mut self, _level: usize, value: &[f64]) {
        let is_on = value[0] != 0.0;
        self.is_asked |= is_on && !self.is_on;
        self.is_on = is_on;
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        if std::mem::take(&mut self.is_asked) && self.works.is_none() {
            self.begin_cycle(world);
        }
        if let Some(reason) = self.works.as_ref().and_then(|work| self.breaks(work, world)) {
            self.works = None;
            world.crash(reason);
        }
        if let Some(work) = self.works.take_if(|work| work.ready_ms <= world.next_ms()) {
            self.has_ended = true;
            if let Err(reason) = self.end_cycle(&work, world) {
                world.crash(reason);
            }
        }
        Progress::Going
    }

    fn next_change(&self, see: &See, now_ms: u64) -> f64 {
        let Some(Work { item, ready_ms, .. }) = &self.works else {
            return if self.is_asked { now_ms as f64 } else { f64::INFINITY };
        };
        if self.is_asked || self.slides(*item, see) {
            return now_ms as f64;
        }
        let leaves =
            self.crossing.as_ref().map_or(f64::INFINITY, |crossing| crossing.next_change(see, now_ms));
        leaves.min(*ready_ms as f64)
    }

    fn is_busy(&self, _see: &See) -> bool {
        self.is_asked || self.works.is_some()
    }

    fn signal(&self, signal: usize, _see: &See, out: &mut [f64]) {
        let shown = if signal == 0 { self.works.is_some() } else { self.has_ended };
        out[0] = f64::from(u8::from(shown));
    }
}

#[cfg(test)]
mod tests;
