//! What takes its time with an item at a place or on a lane: milling, welding, testing.

mod cycle;
mod distribution;
mod settling;

use cycle::Cycle;
use distribution::{Distribution, TIMES, Times};

use super::beam::{Beam, Crossing};
use super::cylinder::End;
use super::settings::{Form, Setting, Settings};
use super::{Described, Level, Primitive, Running, Schema, Signal, Start, milliseconds};
use crate::device::{Extent, PortType};
use crate::hash::of_name;
use crate::line::SlowCycle;

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
                "kinds of other items that have to be at the place, or lie on the item, at the start and at the end; at the end they become parts of the item that came first, and leave the line with what lies on them",
            )
            .optional(),
            Setting::new(
                "frees",
                Form::Truth,
                "",
                "at the end all parts of the item come to lie on free slots of the place again, each on another one, in the order in which they became its parts; too few free slots end the run",
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

impl Process {
    /// Whether an item is another one after a cycle, or more or fewer.
    pub fn changes_items(&self) -> bool {
        !self.makes.is_empty() || !self.rejects.is_empty() || !self.joins.is_empty() || self.frees
    }
}

/// Items of a kind of which some become another kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Reject {
    /// Names of kinds: what it was, and what it becomes.
    pub kinds: [String; 2],
    /// 0 to 1.
    pub share: f64,
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
    if let Some(twice) = makes
        .iter()
        .enumerate()
        .find(|(number, [kind, _])| makes[..*number].iter().any(|[other, _]| other == kind))
    {
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
        if let Some(times) =
            times.as_ref().filter(|times| times.is_empty() || ![1, kinds.len()].contains(&times.len()))
        {
            let count = times.len();
            return Err(match kinds.is_empty() {
                _ if count == 0 => {
                    format!("{name} is an empty list: write a time, or one for each of `kinds`")
                }
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
        return Err(format!(
            "the setting rejects has {} pairs, and shares {} numbers",
            pairs.len(),
            shares.len()
        ));
    }
    if let Some(share) = shares.iter().find(|share| !(0.0..=1.0).contains(*share)) {
        return Err(format!("a share is a number from 0 to 1, not {share}"));
    }
    let rejects: Vec<Reject> =
        pairs.into_iter().zip(shares).map(|(kinds, share)| Reject { kinds, share }).collect();
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
