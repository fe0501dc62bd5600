//! What takes its time with an item at a place: milling, welding, testing.

use super::cylinder::End;
use super::settings::{Form, Setting, Settings};
use super::{Described, Level, Primitive, Progress, Running, Schema, See, Signal, Start, World, milliseconds};
use crate::device::{Extent, PortType};
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
        "Works on the item at a place after a rising edge of `start`: for `time`, or for a time drawn from the triangular distribution of `shortest`, `time` and `longest`. `ended` stays true until the next start. A start without an item, or without what it needs, ends the run: on the machine it would be a crash.",
        &[
            Setting::new("on", Form::Part(&["place"]), "", "the place of the item"),
            Setting::new("time", Form::Positive, "ms", "duration; with a triangular distribution the most likely one"),
            Setting::new("shortest", Form::Positive, "ms", "of a triangular distribution").optional(),
            Setting::new("longest", Form::Positive, "ms", "of a triangular distribution").optional(),
            Setting::new("needs_in", Form::Part(&["cylinder"]), "", "has to be at its inner end at the start").optional(),
            Setting::new("needs_out", Form::Part(&["cylinder"]), "", "has to be at its outer end at the start").optional(),
            Setting::new("makes", Form::Words, "", "pairs of a kind and the kind that it becomes; all others do not change").optional(),
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
    pub place: usize,
    /// Shortest, likeliest and longest.
    pub times_ms: [u64; 3],
    pub needs_in: Option<usize>,
    pub needs_out: Option<usize>,
    /// Names of kinds: what it was, and what it becomes.
    pub makes: Vec<[String; 2]>,
    /// Names of kinds.
    pub joins: Vec<String>,
    pub frees: bool,
}

impl Described for Process {
    fn new(settings: &Settings) -> Result<Self, String> {
        let time = settings.milliseconds("time")?;
        let shortest = settings.optional("shortest", Settings::milliseconds)?.unwrap_or(time);
        let longest = settings.optional("longest", Settings::milliseconds)?.unwrap_or(time);
        if shortest == 0 || shortest > time || time > longest {
            return Err("its times are not in order: shortest, time, longest".into());
        }
        let words = settings.optional("makes", Settings::words)?.unwrap_or_default();
        if words.len() % 2 != 0 {
            return Err("the setting makes names a kind without what becomes of it".into());
        }
        let makes = words.chunks_exact(2).map(|pair| [pair[0].clone(), pair[1].clone()]);
        Ok(Self {
            place: settings.part("on")?,
            times_ms: [shortest, time, longest],
            needs_in: settings.optional("needs_in", Settings::part)?,
            needs_out: settings.optional("needs_out", Settings::part)?,
            makes: makes.collect(),
            joins: settings.optional("joins", Settings::words)?.unwrap_or_default(),
            frees: settings.optional("frees", Settings::truth)?.unwrap_or(false),
        })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let place = [start.machine as u64, start.part as u64];
        let mut cycle = Cycle::new(self, &start.line.kinds, start.line.scenario.seed, place);
        let parts = &start.machine().parts;
        let mine = |slow: &&SlowCycle| (slow.machine, slow.part) == (start.machine, start.part);
        let slow = start.line.scenario.slow.iter().filter(mine);
        cycle.longer_ms = slow.map(|slow| (slow.cycle, milliseconds(slow.longer_s))).collect();
        let need = |part: Option<usize>, end: End| part.map(|part| (part, end, parts[part].name.clone()));
        let needs = [need(self.needs_in, End::In), need(self.needs_out, End::Out)];
        cycle.needs = needs.into_iter().flatten().collect();
        if let Primitive::Place(place) = &parts[self.place].primitive {
            cycle.slots = place.slots.clone();
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
    /// What becomes of each kind.
    becomes: Vec<usize>,
    /// Kinds of the items that are joined to the first one; none for a name that no kind has.
    joins: Vec<Option<usize>>,
    /// Their names.
    kinds: Vec<String>,
    /// Of the place.
    slots: Vec<Point>,
    random: Random,
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
    /// `place` is the number of the machine and of the part: each draws times of its own.
    pub fn new(process: &Process, kinds: &[Kind], seed: u64, place: [u64; 2]) -> Self {
        let number = |name: &String| kinds.iter().position(|kind| kind.name == *name);
        let becomes = |kind: usize| {
            let rule = process.makes.iter().find(|[from, _]| *from == kinds[kind].name);
            rule.and_then(|[_, to]| number(to)).unwrap_or(kind)
        };
        Self {
            process: process.clone(),
            needs: Vec::new(),
            becomes: (0..kinds.len()).map(becomes).collect(),
            joins: process.joins.iter().map(number).collect(),
            kinds: kinds.iter().map(|kind| kind.name.clone()).collect(),
            slots: Vec::new(),
            random: Random::at(seed, place),
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

    /// The next time, whole milliseconds.
    fn time_ms(&mut self) -> u64 {
        let [low, mode, high] = self.process.times_ms.map(|ms| ms as f64);
        if low == high {
            return self.process.times_ms[1];
        }
        // By the inverse of the distribution function.
        let drawn = self.random.next_u64() as f64 / u64::MAX as f64;
        let (rise, fall) = ((mode - low) * (high - low), (high - mode) * (high - low));
        let time = if drawn * (high - low) < mode - low {
            low + (drawn * rise).sqrt()
        } else {
            high - ((1.0 - drawn) * fall).sqrt()
        };
        libm::round(time) as u64
    }

    /// The items that are joined to one, in the order of their kinds; the name of a kind of which none is there.
    fn joined(&self, item: usize, see: &See) -> Result<Vec<usize>, &str> {
        let mut joined = Vec::new();
        for (kind, name) in self.joins.iter().zip(&self.process.joins) {
            let is_wanted = |other: &usize| {
                *other != item && !joined.contains(other) && Some(see.items.all()[*other].kind) == *kind
            };
            joined.push(see.borne_by(self.process.place).find(is_wanted).ok_or(name.as_str())?);
        }
        Ok(joined)
    }

    /// The parts of an item come to lie on free slots; the kind of one for which there is none.
    fn free(&self, item: usize, world: &mut World) -> Result<(), usize> {
        let place = self.process.place;
        for other in world.items.parts_of(item) {
            let see = world.see();
            let is_taken = |slot: &Point| {
                let mut offsets = see.borne_by(place).filter_map(|item| see.items.all()[item].carrier.offset());
                offsets.any(|offset| (offset - *slot).length() < NEAR)
            };
            let slot = self.slots.iter().find(|slot| !is_taken(slot)).copied();
            let offset = slot.ok_or(see.items.all()[other].kind)?;
            world.lay(other, place, offset);
        }
        Ok(())
    }

    /// What is missing for a start; empty if nothing is.
    fn lacks(&self, item: Option<usize>, world: &World) -> String {
        let see = world.see();
        let mut lacks = Vec::new();
        if item.is_none() {
            lacks.push("an item".to_string());
        }
        if let Some(Err(kind)) = item.map(|item| self.joined(item, &see)) {
            lacks.push(format!("a {kind} beside it"));
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

    fn level(&mut self, _level: usize, value: &[f64]) {
        let is_on = value[0] != 0.0;
        self.is_asked |= is_on && !self.is_on;
        self.is_on = is_on;
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        if std::mem::take(&mut self.is_asked) && self.works.is_none() {
            let item = world.see().borne_by(self.process.place).next();
            let lacks = self.lacks(item, world);
            match item.filter(|_| lacks.is_empty()) {
                Some(item) => {
                    self.has_ended = false;
                    self.started = self.started.saturating_add(1);
                    self.works = Some((item, world.now_ms + self.time_ms() + self.longer_ms()));
                }
                None => world.crash(format!("a process was started without {lacks}")),
            }
        }
        if let Some((item, ready_ms)) = self.works
            && ready_ms <= world.next_ms()
        {
            (self.works, self.has_ended) = (None, true);
            let joined = self.joined(item, &world.see()).map_err(|kind| format!("a {kind} was taken from a process"));
            match joined {
                Ok(joined) => joined.into_iter().for_each(|other| world.join(other, item)),
                Err(reason) => world.crash(reason),
            }
            if self.process.frees
                && let Err(kind) = self.free(item, world)
            {
                world.crash(format!("a process has no free slot for a {}", self.kinds[kind]));
            }
            let kind = world.items.all()[item].kind;
            world.items.remake(item, self.becomes[kind]);
        }
        Progress::Going
    }

    fn next_change(&self, _see: &See, now_ms: u64) -> f64 {
        let ready = self.works.map_or(f64::INFINITY, |(_, ready_ms)| ready_ms as f64);
        if self.is_asked { now_ms as f64 } else { ready }
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
mod tests {
    use super::*;

    /// Mean of a triangle: a third of the sum. Its variance: (a2 + b2 + c2 - ab - ac - bc) / 18.
    #[test]
    fn times_of_a_triangle_have_its_mean_and_its_spread() {
        let times_ms = [85_000, 90_000, 100_000];
        let process = Process { place: 0, times_ms, needs_in: None, needs_out: None, makes: Vec::new(), joins: Vec::new(), frees: false };
        let mut cycle = Cycle::new(&process, &[], 7, [1, 2]);
        let count = 200_000;
        let times: Vec<f64> = (0..count).map(|_| cycle.time_ms() as f64 / 1000.0).collect();
        assert!(times.iter().all(|time| (85.0..=100.0).contains(time)));
        let mean = times.iter().sum::<f64>() / f64::from(count);
        let spread = times.iter().map(|time| (time - mean) * (time - mean)).sum::<f64>() / f64::from(count);
        let (a, b, c) = (85.0_f64, 90.0, 100.0);
        let expected = (a * a + b * b + c * c - a * b - a * c - b * c) / 18.0;
        assert!((mean - (a + b + c) / 3.0).abs() < 0.03, "{mean}");
        assert!((spread - expected).abs() < 0.1, "{spread} {expected}");
    }
}
