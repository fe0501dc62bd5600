//! What takes its time with an item at a place or on a lane: milling, welding, testing.

mod distribution;
mod loaded;
mod stacked;

use distribution::{Distribution, TIMES, Times};

use super::beam::{Beam, Crossing};
use super::cylinder::End;
use super::settings::{Form, Setting, Settings};
use super::stroke::Carriage;
use super::{Described, Level, Primitive, Progress, Running, Schema, See, Signal, Start, World, milliseconds};
use crate::device::{Extent, PortType};
use crate::hash::of_name;
use crate::line::{Kind, SlowCycle};
use crate::point::Point;
use crate::random::Random;

/// An item this near to a slot lies on it, m.
const NEAR: f64 = 0.01;

pub const SCHEMA: Schema = Schema {
    signals: &[
        Signal { name: "runs", ty: PortType::Bool, extent: Extent::One },
        Signal { name: "ended", ty: PortType::Bool, extent: Extent::One },
    ],
    levels: &[Level { name: "start", ty: PortType::Bool }],
    ..Schema::new(
        "process",
        "Works on the item at a place, or at a place of a lane, after a rising edge of `start`, for a time that is fixed or drawn. `ended` stays true until the next start. A start without an item, or without what it needs, and an item that is taken away before the end, end the run: on the machine it would be a crash. On a lane it works on the foremost item that is over or under `at`, from its front edge to its rear edge. If that item moves before the end, the run ends; with `moving` it may, as under a printer, as long as it stays there.",
        &[
            Setting::new("on", Form::Part(&["place", "lane"]), "", "the place of the item, or the lane on which it lies"),
            Setting::new("at", Form::Number, "m", "on a lane: from its beginning").optional(),
            Setting::new("moving", Form::Truth, "", "on a lane: the item may move meanwhile").optional(),
            Setting::new("time", Form::Times, "ms", "duration; the likeliest of a triangular distribution, the mean of a normal one").optional(),
            Setting::new("shortest", Form::Times, "ms", "no time is shorter").optional(),
            Setting::new("longest", Form::Times, "ms", "no time is longer").optional(),
            Setting::new("deviation", Form::Times, "ms", "standard deviation of a normal distribution").optional(),
            Setting::new("distribution", Form::Word, "", "fixed, triangular, uniform, normal or exponential; without it fixed, or triangular with `shortest` or `longest`").optional(),
            Setting::new("kinds", Form::Words, "", "kinds that it works on; a list of times has one for each of them").optional(),
            Setting::new("needs_in", Form::Part(&["cylinder"]), "", "has to be at its inner end at the start").optional(),
            Setting::new("needs_out", Form::Part(&["cylinder"]), "", "has to be at its outer end at the start").optional(),
            Setting::new("makes", Form::Words, "", "pairs of a kind and the kind that it becomes; all others do not change").optional(),
            Setting::new("rejects", Form::Words, "", "pairs of a kind and the kind that some of its items become instead").optional(),
            Setting::new("shares", Form::Numbers, "", "share of the items, 0 to 1, for each pair of `rejects`").optional(),
            Setting::new(
                "joins",
                Form::Words,
                "",
                "kinds of other items that have to be at the place at the start and at the end; at the end they become parts of the item that came first, and leave the line",
            )
            .optional(),
            Setting::new(
                "frees",
                Form::Truth,
                "",
                "at the end all parts of the item come to lie on free slots of the place again, in the order in which they became its parts; too few free slots end the run",
            )
            .optional(),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Process {
    /// A place or a lane.
    pub on: usize,
    /// On a lane, from its beginning, m.
    pub at: Option<f64>,
    /// On a lane the item may move during a cycle.
    pub moving: bool,
    /// Names of kinds; empty for all kinds, with one time.
    pub kinds: Vec<String>,
    /// One, or one for each of `kinds`.
    pub times: Vec<Distribution>,
    pub needs_in: Option<usize>,
    pub needs_out: Option<usize>,
    /// Names of kinds: what it was, and what it becomes.
    pub makes: Vec<[String; 2]>,
    pub rejects: Vec<Reject>,
    /// Names of kinds.
    pub joins: Vec<String>,
    pub frees: bool,
}

/// Items of a kind of which some become another kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Reject {
    /// Names of kinds: what it was, and what it becomes.
    pub kinds: [String; 2],
    /// 0 to 1.
    pub share: f64,
}

/// What is drawn for a cycle.
enum Drawn {
    Time,
    Reject,
}

impl Drawn {
    const COUNT: u64 = 2;
}

impl Process {
    /// No cycle takes less, ms.
    pub fn shortest_ms(&self) -> u64 {
        self.times.iter().map(Distribution::shortest_ms).min().unwrap_or(0)
    }

    /// Whether the seed of a run decides how long its cycles take, or what becomes of items.
    pub fn is_drawn(&self) -> bool {
        let is_open = |reject: &Reject| reject.share > 0.0 && reject.share < 1.0;
        self.times.iter().any(Distribution::is_drawn) || self.rejects.iter().any(is_open)
    }

    /// Pairs of a kind and one that its items may become, by name.
    pub fn made(&self) -> impl Iterator<Item = [&str; 2]> {
        let all = self.makes.iter().chain(self.rejects.iter().map(|reject| &reject.kinds));
        all.map(|pair| pair.each_ref().map(String::as_str))
    }
}

/// What can never happen with these kinds.
fn check_kinds(kinds: Option<&[String]>, makes: &[[String; 2]], rejects: &[Reject]) -> Result<(), String> {
    if kinds.is_some_and(|kinds| kinds.is_empty()) {
        return Err("kinds is an empty list: name kinds, or leave it out for all kinds".into());
    }
    if let Some(twice) = makes.iter().enumerate().find(|(number, [kind, _])| {
        makes[..*number].iter().any(|[other, _]| other == kind)
    }) {
        return Err(format!("the setting makes says twice what becomes of {}", twice.1[0]));
    }
    let pairs = makes.iter().map(|pair| ("makes", pair));
    let pairs = pairs.chain(rejects.iter().map(|reject| ("rejects", &reject.kinds)));
    for (setting, [kind, becomes]) in pairs {
        if kinds.is_some_and(|kinds| !kinds.contains(kind)) {
            return Err(format!("{setting} says what becomes of {kind}, which is not among the kinds"));
        }
        let stays = makes.iter().all(|[made, _]| made != kind);
        if setting == "rejects" && kind == becomes && stays {
            return Err(format!("rejects says that some of {kind} become {kind}"));
        }
    }
    Ok(())
}

/// What is rounded in a sum of shares.
const ROUNDED: f64 = 1e-9;

/// Each of the kinds has a time of its own, or all of them have one.
fn times(settings: &Settings, kinds: &[String]) -> Result<Vec<Distribution>, String> {
    let word = Distribution::word(settings)?;
    let mut given = Vec::new();
    for name in TIMES {
        let times = settings.optional(name, Settings::times)?;
        if let Some(times) = times.as_ref().filter(|times| times.is_empty() || ![1, kinds.len()].contains(&times.len())) {
            let count = times.len();
            return Err(match kinds.is_empty() {
                _ if count == 0 => format!("{name} is an empty list: write a time, or one for each of `kinds`"),
                true => format!("{name} has {count} times: name their kinds in `kinds`"),
                false => format!("{name} has {count} times for {} kinds", kinds.len()),
            });
        }
        given.push(times);
    }
    let of = |name: usize, kind: usize| given[name].as_ref().map(|times| times[kind.min(times.len() - 1)]);
    let distribution = |kind: usize| {
        let [time, shortest, longest, deviation] = [0, 1, 2, 3].map(|name| of(name, kind));
        Distribution::new(word, &Times { time, shortest, longest, deviation })
    };
    (0..kinds.len().max(1)).map(distribution).collect()
}

fn pairs(settings: &Settings, name: &str) -> Result<Vec<[String; 2]>, String> {
    let words = settings.optional(name, Settings::words)?.unwrap_or_default();
    if words.len() % 2 != 0 {
        let last = words.last().map_or("", String::as_str);
        return Err(format!("the setting {name} names {last} without what becomes of it"));
    }
    Ok(words.chunks_exact(2).map(|pair| [pair[0].clone(), pair[1].clone()]).collect())
}

fn rejects(settings: &Settings) -> Result<Vec<Reject>, String> {
    let pairs = pairs(settings, "rejects")?;
    let shares = settings.optional("shares", Settings::numbers)?.unwrap_or_default();
    if pairs.len() != shares.len() {
        return Err(format!("the setting rejects has {} pairs, and shares {} numbers", pairs.len(), shares.len()));
    }
    if let Some(share) = shares.iter().find(|share| !(0.0..=1.0).contains(*share)) {
        return Err(format!("a share is a number from 0 to 1, not {share}"));
    }
    let rejects: Vec<Reject> = pairs.into_iter().zip(shares).map(|(kinds, share)| Reject { kinds, share }).collect();
    for Reject { kinds: [kind, _], .. } in &rejects {
        let all: f64 = rejects.iter().filter(|other| other.kinds[0] == *kind).map(|other| other.share).sum();
        if all > 1.0 + ROUNDED {
            return Err(format!("the shares of the kind {kind} are more than 1 together"));
        }
    }
    Ok(rejects)
}

impl Described for Process {
    fn new(settings: &Settings) -> Result<Self, String> {
        let given = settings.optional("kinds", Settings::words)?;
        let (makes, rejects) = (pairs(settings, "makes")?, rejects(settings)?);
        check_kinds(given.as_deref(), &makes, &rejects)?;
        let kinds = given.unwrap_or_default();
        if let Some(twice) = kinds.iter().enumerate().find(|(number, kind)| kinds[..*number].contains(kind)) {
            return Err(format!("the setting kinds names {} twice", twice.1));
        }
        Ok(Self {
            on: settings.part("on")?,
            at: settings.optional("at", Settings::number)?,
            moving: settings.optional("moving", Settings::truth)?.unwrap_or(false),
            times: times(settings, &kinds)?,
            kinds,
            needs_in: settings.optional("needs_in", Settings::part)?,
            needs_out: settings.optional("needs_out", Settings::part)?,
            makes,
            rejects,
            joins: settings.optional("joins", Settings::words)?.unwrap_or_default(),
            frees: settings.optional("frees", Settings::truth)?.unwrap_or(false),
        })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let parts = &start.machine().parts;
        let place = [&start.machine().name, &parts[start.part].name].map(|name| of_name(name));
        let mut cycle = Cycle::new(self, &start.line.kinds, start.line.scenario.seed, place);
        let mine = |slow: &&SlowCycle| (slow.machine, slow.part) == (start.machine, start.part);
        let slow = start.line.scenario.slow.iter().filter(mine);
        cycle.longer_ms = slow.map(|slow| (slow.cycle, milliseconds(slow.longer_s))).collect();
        cycle.name = format!("the process {}", parts[start.part].name);
        let need = |part: Option<usize>, end: End| part.map(|part| (part, end, parts[part].name.clone()));
        let needs = [need(self.needs_in, End::In), need(self.needs_out, End::Out)];
        cycle.needs = needs.into_iter().flatten().collect();
        match (&parts[self.on].primitive, self.at) {
            (Primitive::Place(place), _) => cycle.slots = place.slots.clone(),
            (_, Some(at)) => {
                let beam = Beam { lane: self.on, at, over: 0.0, only: None };
                cycle.crossing = Some(Crossing::new(&beam, &start.line.kinds));
            }
            _ => {}
        }
        Ok(Some(Box::new(cycle)))
    }
}

/// A process at work.
#[derive(Clone, Debug)]
pub struct Cycle {
    process: Process,
    /// Cylinders, the ends at which they have to be, and their names.
    needs: Vec<(usize, End, String)>,
    /// For each kind the number of its time; none for a kind that it does not work on.
    times: Vec<Option<usize>>,
    /// What becomes of each kind.
    becomes: Vec<usize>,
    /// For each kind, what some of it become, and their share.
    rejects: Vec<Vec<(usize, f64)>>,
    /// Kinds of the items that are joined to the first one; none for a name that no kind has.
    joins: Vec<Option<usize>>,
    /// Their names.
    kinds: Vec<String>,
    /// Of the place; empty on a lane.
    slots: Vec<Point>,
    /// On a lane, what is at its place there.
    crossing: Option<Crossing>,
    /// Of the part.
    name: String,
    seed: u64,
    /// Of the names of its machine and of itself.
    place: [u64; 2],
    is_on: bool,
    /// An edge of `start` that has not been checked yet.
    is_asked: bool,
    /// The item, and when it is ready.
    works: Option<(usize, u64)>,
    has_ended: bool,
    /// Cycles that were started.
    started: u32,
    /// Numbers of cycles, from 1, and by how much each takes longer.
    longer_ms: Vec<(u32, u64)>,
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

    /// Of an item and what lies on it the first on which the process works.
    fn work_piece(&self, item: usize, see: &See) -> Option<usize> {
        let mut all = see.items.with_loads(item).into_iter();
        all.find(|item| self.times[see.items[*item].kind].is_some())
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
        for other in world.items.parts_of(item) {
            let see = world.see();
            let is_taken = |slot: &Point| {
                let mut offsets = see.borne_by(place).filter_map(|item| see.items[item].carrier.offset());
                offsets.any(|offset| (offset - *slot).length() < NEAR)
            };
            let slot = self.slots.iter().find(|slot| !is_taken(slot)).copied();
            let kind = &self.kinds[see.items[other].kind];
            let offset = slot.ok_or_else(|| format!("{} has no free slot for a {kind}", self.name))?;
            world.lay(other, place, offset);
            self.lay_down(other, world)?;
        }
        Ok(())
    }

    /// What is missing for a start; empty if nothing is.
    fn lacks(&self, item: Option<usize>, world: &World) -> String {
        let see = world.see();
        let mut lacks = Vec::new();
        match item {
            None => lacks.push("an item".to_string()),
            Some(item) if self.work_piece(item, &see).is_none() => {
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
            let item = self.there(&world.see()).next();
            let lacks = self.lacks(item, world);
            match item.filter(|_| lacks.is_empty()) {
                Some(item) => {
                    self.has_ended = false;
                    self.started = self.started.saturating_add(1);
                    let work_piece = self.work_piece(item, &world.see()).unwrap_or(item);
                    let kind = world.items[work_piece].kind;
                    self.works = Some((item, world.now_ms + self.time_ms(kind) + self.longer_ms()));
                }
                None => world.crash(format!("{} was started without {lacks}", self.name)),
            }
        }
        if let Some((item, _)) = self.works {
            let see = world.see();
            let crash = match () {
                () if self.slides(item, &see) => {
                    Some(format!("{} was moved during {}", self.item_text(item, &see), self.name))
                }
                () if self.there(&see).any(|there| there == item) => None,
                () => Some(self.left(item, &see)),
            };
            if let Some(reason) = crash {
                self.works = None;
                world.crash(reason);
            }
        }
        if let Some((item, ready_ms)) = self.works
            && ready_ms <= world.next_ms()
            && !self.is_there_at(item, ready_ms as f64, &world.see())
        {
            self.works = None;
            world.crash(self.left(item, &world.see()));
        }
        if let Some((item, ready_ms)) = self.works
            && ready_ms <= world.next_ms()
        {
            (self.works, self.has_ended) = (None, true);
            let joined = self.joined(item, &world.see());
            let joined = joined.map_err(|kind| format!("a {kind} was taken from {}", self.name));
            let before = world.see().stack(self.process.on);
            let trays = world.items.with_loads(item).into_iter();
            let trays = trays.filter(|tray| !world.items.loads_of(*tray).is_empty());
            let decks: Vec<_> = trays.filter_map(|tray| Some((tray, world.items.deck(tray)?))).collect();
            let joined = joined.unwrap_or_else(|reason| {
                world.crash(reason);
                Vec::new()
            });
            joined.iter().for_each(|other| world.join(*other, item));
            if self.process.frees
                && let Err(reason) = self.free(item, world)
            {
                world.crash(reason);
            }
            for (number, item) in world.items.with_loads(item).into_iter().enumerate() {
                let kind = world.items[item].kind;
                if self.times[kind].is_some() {
                    world.items.remake(item, self.made_of(kind, number as u64));
                }
            }
            for (tray, before) in decks {
                if let Err(reason) = self.settle_on_deck(tray, &before, world) {
                    world.crash(reason);
                }
            }
            if let Some(before) = before
                && let Err(reason) = self.settle(item, &before, &joined, world)
            {
                world.crash(reason);
            }
        }
        Progress::Going
    }

    fn next_change(&self, see: &See, now_ms: u64) -> f64 {
        let Some((item, ready_ms)) = self.works else {
            return if self.is_asked { now_ms as f64 } else { f64::INFINITY };
        };
        if self.is_asked || self.slides(item, see) {
            return now_ms as f64;
        }
        let leaves = self.crossing.as_ref().map_or(f64::INFINITY, |crossing| crossing.next_change(see, now_ms));
        leaves.min(ready_ms as f64)
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
