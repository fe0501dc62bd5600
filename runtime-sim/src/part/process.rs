//! What takes its time with an item at a place or on a lane: milling, welding, testing.

mod distribution;
mod stacked;

use distribution::{Distribution, TIMES, Times};

use super::beam::{Beam, Crossing};
use super::cylinder::End;
use super::settings::{Form, Setting, Settings};
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
        return Err(format!("the setting {name} names a kind without what becomes of it"));
    }
    Ok(words.chunks_exact(2).map(|pair| [pair[0].clone(), pair[1].clone()]).collect())
}

fn rejects(settings: &Settings) -> Result<Vec<Reject>, String> {
    let pairs = pairs(settings, "rejects")?;
    let shares = settings.optional("shares", Settings::numbers)?.unwrap_or_default();
    if pairs.len() != shares.len() {
        return Err(format!("the setting rejects has {} pairs, and shares {} numbers", pairs.len(), shares.len()));
    }
    if shares.iter().any(|share| !(0.0..=1.0).contains(share)) {
        return Err("a share is a number from 0 to 1".into());
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
        let kinds = settings.optional("kinds", Settings::words)?.unwrap_or_default();
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
            makes: pairs(settings, "makes")?,
            rejects: rejects(settings)?,
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
    fn drawn(&self, what: Drawn) -> f64 {
        let [machine, part] = self.place;
        Random::at(self.seed, [machine, part, u64::from(self.started), what as u64]).fraction()
    }

    /// Of the cycle that was started last, for an item of a kind on which it works; ms.
    fn time_ms(&self, kind: usize) -> u64 {
        let number = self.times[kind].unwrap_or(0).min(self.process.times.len() - 1);
        self.process.times[number].time_ms(self.drawn(Drawn::Time))
    }

    /// What an item of a kind becomes at the end of this cycle.
    fn made_of(&self, kind: usize) -> usize {
        let mut drawn = self.drawn(Drawn::Reject);
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

    /// Whether an item moves that should not.
    fn slides(&self, item: usize, see: &See) -> bool {
        let lane = see.lane(self.process.on).filter(|_| !self.process.moving);
        let motion = lane.and_then(|lane| Some((lane, lane.motion(item, &see.items[item].carrier)?)));
        motion.is_some_and(|(lane, motion)| lane.speed_of(motion) > 0.0)
    }

    /// The items that are joined to one, in the order of their kinds; the name of a kind of which none is there.
    fn joined(&self, item: usize, see: &See) -> Result<Vec<usize>, &str> {
        let mut joined = Vec::new();
        for (kind, name) in self.joins.iter().zip(&self.process.joins) {
            let is_wanted = |other: &usize| {
                *other != item && !joined.contains(other) && Some(see.items[*other].kind) == *kind
            };
            joined.push(see.borne_by(self.process.on).find(is_wanted).ok_or(name.as_str())?);
        }
        Ok(joined)
    }

    /// The parts of an item come to lie on free slots; the kind of one for which there is none.
    fn free(&self, item: usize, world: &mut World) -> Result<(), usize> {
        let place = self.process.on;
        for other in world.items.parts_of(item) {
            let see = world.see();
            let is_taken = |slot: &Point| {
                let mut offsets = see.borne_by(place).filter_map(|item| see.items[item].carrier.offset());
                offsets.any(|offset| (offset - *slot).length() < NEAR)
            };
            let slot = self.slots.iter().find(|slot| !is_taken(slot)).copied();
            let offset = slot.ok_or(see.items[other].kind)?;
            world.lay(other, place, offset);
        }
        Ok(())
    }

    /// What is missing for a start; empty if nothing is.
    fn lacks(&self, item: Option<usize>, world: &World) -> String {
        let see = world.see();
        let mut lacks = Vec::new();
        match item.map(|item| see.items[item].kind) {
            None => lacks.push("an item".to_string()),
            Some(kind) if self.times[kind].is_none() => lacks.push(format!("a time for a {}", self.kinds[kind])),
            Some(_) => {}
        }
        if let Some(Err(kind)) = item.map(|item| self.joined(item, &see)) {
            lacks.push(format!("a {kind} beside it"));
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
                    let kind = world.items[item].kind;
                    self.works = Some((item, world.now_ms + self.time_ms(kind) + self.longer_ms()));
                }
                None => world.crash(format!("a process was started without {lacks}")),
            }
        }
        if let Some((item, _)) = self.works {
            let see = world.see();
            let kind = &self.kinds[see.items[item].kind];
            let crash = match () {
                () if self.slides(item, &see) => Some(format!("a {kind} was moved during a process")),
                () if self.there(&see).any(|there| there == item) => None,
                () if self.crossing.is_some() => Some(format!("a {kind} left a process before its end")),
                () => Some(format!("a {kind} was taken from a process")),
            };
            if let Some(reason) = crash {
                self.works = None;
                world.crash(reason);
            }
        }
        if let Some((item, ready_ms)) = self.works
            && ready_ms <= world.next_ms()
        {
            (self.works, self.has_ended) = (None, true);
            let joined = self.joined(item, &world.see()).map_err(|kind| format!("a {kind} was taken from a process"));
            let before = world.see().stack(self.process.on);
            let joined = joined.unwrap_or_else(|reason| {
                world.crash(reason);
                Vec::new()
            });
            joined.iter().for_each(|other| world.join(*other, item));
            if self.process.frees
                && let Err(kind) = self.free(item, world)
            {
                world.crash(format!("a process has no free slot for a {}", self.kinds[kind]));
            }
            let kind = world.items[item].kind;
            world.items.remake(item, self.made_of(kind));
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
