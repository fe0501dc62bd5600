//! What limits a line: the path through the run on which each moment was needed for the end of it.
//!
//! From the end backwards. A machine left its last state in some scan. If an input of its own that the guards of that
//! state read had just changed, or a timer of the state was over, the machine itself needed this time: the stay is its
//! share. If an item had come since that another machine has put there, it needed only the time since then, and the path
//! continues with who has put it. Otherwise another machine has let it continue, which acted in this scan before it, or in the
//! one before: what the machine waited until then cost nothing by itself, and the path continues with the other one. So
//! the shares add up to the whole time, and whoever shortens a stay on the path shortens the run, by at most this time.
//! Scans in which the line does not run are the share of no machine.

use super::acts::{Acts, Stay};
use super::handovers::{Handover, Handovers};
use super::standstills::Standstills;
use runtime_sim::carrier::Carrier;
use runtime_sim::event::{Event, OrderChange};
use runtime_sim::line::{Line, State};
use runtime_sim::wiring::Source;
use serde_json::{Value, json};
use std::collections::BTreeMap;

/// A part of the path, in scans.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Leg {
    pub machine: usize,
    pub state: usize,
    pub begin: u64,
    pub end: u64,
}

/// Where the path has come to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum At {
    /// This machine did something in this scan.
    Act(usize, u64),
    /// This item was handed over.
    Handover(Handover),
}

/// A line with what is known of its run.
pub struct Run<'a> {
    pub line: &'a Line,
    pub events: &'a [Event],
    pub acts: &'a [Acts],
    /// The scan up to which it is known.
    pub end: u64,
}

impl Run<'_> {
    /// The path to what the run was for, the last leg first: the last order that was made, else the last item that was
    /// collected, else the last that any machine did.
    pub fn path(&self) -> Vec<Leg> {
        let handovers = Handovers::new(self.events, self.acts.len());
        let mut path = Path::default();
        let mut next = self.goal();
        while let Some(at) = next {
            next = match at {
                At::Act(machine, scan) => self.act(&handovers, &mut path, machine, scan),
                At::Handover(handover) => self.handover(&handovers, &mut path, handover),
            };
        }
        path.0
    }

    fn goal(&self) -> Option<At> {
        let is_known = |scan: u64| scan <= self.end;
        let made = self.events.iter().rev().find_map(|event| match *event {
            Event::Order { scan, machine, change: OrderChange::Made, .. } if is_known(scan) => {
                Some(At::Act(machine, scan))
            }
            _ => None,
        });
        let collected = || {
            self.events.iter().rev().find_map(|event| match *event {
                // What lies on an item goes with it.
                Event::Item { scan, item, from, to: Carrier::Sink { .. }, .. }
                    if is_known(scan) && from.item().is_none() =>
                {
                    Some(At::Handover(Handover { scan, item, from }))
                }
                _ => None,
            })
        };
        let acted = || {
            let last = |machine: usize| self.acts[machine].acted.last().map(|scan| (machine, *scan));
            let last = (0..self.acts.len()).filter_map(last).max_by_key(|(_, scan)| *scan);
            last.map(|(machine, scan)| At::Act(machine, scan))
        };
        made.or_else(collected).or_else(acted)
    }

    /// Why a machine did something in a scan.
    fn act(&self, handovers: &Handovers, path: &mut Path, machine: usize, scan: u64) -> Option<At> {
        let stay = self.acts[machine].before(scan)?;
        let leg = |begin: u64| Leg { machine, state: stay.state, begin, end: scan };
        if let Some((other, at)) = self.let_go(machine, stay, scan) {
            path.put(leg(at));
            return Some(At::Act(other, at));
        }
        let brought = handovers.last_to(machine, stay.begin, scan).filter(|handover| {
            let from = handover.from.machine();
            from.is_some_and(|from| from != machine) && self.sensor_changed(machine, stay.state, scan)
        });
        if let Some(handover) = brought {
            path.put(leg(handover.scan));
            return Some(At::Handover(handover));
        }
        path.put(leg(stay.begin));
        (stay.begin > 0).then_some(At::Act(machine, stay.begin))
    }

    /// Why an item was handed over when it was: its giver did something, or it has come there only then.
    fn handover(&self, handovers: &Handovers, path: &mut Path, handover: Handover) -> Option<At> {
        let machine = handover.from.machine()?;
        let acts = &self.acts[machine];
        let state = acts.before(handover.scan)?.state;
        let came = handovers.before(handover.item, handover.scan);
        let since = came.map_or(0, |came| came.scan);
        let acted = acts.last_act(handover.scan).filter(|act| *act >= since);
        let begin = acted.unwrap_or(since);
        path.put(Leg { machine, state, begin, end: handover.scan });
        match (acted, came) {
            (Some(act), _) => Some(At::Act(machine, act)),
            (None, Some(came)) if came.from.machine().is_some() => Some(At::Handover(came)),
            // The supply has brought it.
            (None, _) => Some(At::Act(machine, since)).filter(|_| since > 0),
        }
    }

    /// Which other machine has let a machine continue that did something in this scan, and when; none: its own device did.
    fn let_go(&self, machine: usize, stay: Stay, scan: u64) -> Option<(usize, u64)> {
        let state = self.line.machines[machine].states.get(stay.state)?;
        let own = &self.acts[machine];
        let scan_ms = u64::from(self.line.scan_ms);
        let stood = own.stopped.scans(stay.begin, scan);
        let passed = (scan - stay.begin).saturating_sub(stood) * scan_ms;
        // It was not yet one scan before.
        let is_over =
            |timer: &u32| (passed.saturating_sub(scan_ms) + 1..=passed).contains(&u64::from(*timer));
        if state.timers.iter().flatten().any(is_over)
            || words(state).any(|word| own.input_changed(word, scan))
        {
            return None;
        }
        // Earlier ones in this scan, all in the one before.
        let earlier = (0..machine).map(|other| (other, scan));
        let before = scan.checked_sub(1).filter(|before| *before > stay.begin);
        let last = (0..self.acts.len()).filter(|other| *other != machine).zip(before.into_iter().cycle());
        let others: Vec<(usize, u64)> =
            earlier.chain(last).filter(|(other, at)| self.acts[*other].has_acted(*at)).collect();
        // It awaits this one; this one has left a state.
        let fits =
            |(other, at): &(usize, u64)| (state.awaits.contains(other), self.acts[*other].has_left(*at));
        let ranks = [(true, true), (true, false), (false, true), (false, false)];
        ranks.into_iter().find_map(|rank| others.iter().copied().find(|other| fits(other) == rank))
    }

    /// Whether a signal of one of its parts, which the guards of this state read, changed in this scan: no answer to a
    /// command.
    fn sensor_changed(&self, machine: usize, state: usize, scan: u64) -> bool {
        let Some(read) = self.line.machines[machine].states.get(state) else { return false };
        let (wiring, kinds) = (&self.line.machines[machine].wiring, self.line.kinds.len());
        let answers = [Source::Ready, Source::Got, Source::Ack, Source::Error];
        let answers = answers.map(|source| wiring.input_at(source, kinds));
        let is_sensor = |word: &usize| !answers.contains(&Some(*word));
        let mut sensors = words(read).filter(is_sensor);
        sensors.any(|word| self.acts[machine].input_changed(word, scan))
    }
}

/// Words of the inputs that the guards of a state read.
fn words(state: &State) -> impl Iterator<Item = usize> {
    state.reads.iter().copied().chain(state.reads_while.iter().map(|read| read.word))
}

/// The last leg first.
#[derive(Default)]
struct Path(Vec<Leg>);

impl Path {
    fn put(&mut self, leg: Leg) {
        match self.0.last_mut() {
            _ if leg.begin >= leg.end => {}
            Some(last) if (last.machine, last.state, last.begin) == (leg.machine, leg.state, leg.end) => {
                last.begin = leg.begin;
            }
            _ => self.0.push(leg),
        }
    }
}

/// Shares of the machines and of their states, the greatest first, and that of standstills of the line.
pub fn limit_json(line: &Line, path: &[Leg], standstills: &Standstills) -> Value {
    let seconds = |scans: u64| (scans * u64::from(line.scan_ms)) as f64 / 1000.0;
    let mut shares: BTreeMap<usize, BTreeMap<usize, u64>> = BTreeMap::new();
    let mut stood = 0;
    for leg in path {
        let standing = standstills.scans(leg.begin, leg.end);
        stood += standing;
        let own = leg.end - leg.begin - standing;
        if own > 0 {
            *shares.entry(leg.machine).or_default().entry(leg.state).or_default() += own;
        }
    }
    let greatest_first = |states: &BTreeMap<usize, u64>| {
        let mut states: Vec<(usize, u64)> = states.iter().map(|(state, scans)| (*state, *scans)).collect();
        states.sort_by_key(|(_, scans)| std::cmp::Reverse(*scans));
        states.into_iter().map(|(state, scans)| json!([state, seconds(scans)])).collect::<Vec<_>>()
    };
    let mut machines: Vec<(usize, u64)> =
        shares.iter().map(|(machine, states)| (*machine, states.values().sum())).collect();
    machines.sort_by_key(|(_, scans)| std::cmp::Reverse(*scans));
    let machines = machines.into_iter().map(|(machine, scans)| {
        json!({ "machine": machine, "s": seconds(scans), "states": greatest_first(&shares[&machine]) })
    });
    json!({
        "from_s": path.last().map(|leg| seconds(leg.begin)),
        "to_s": path.first().map(|leg| seconds(leg.end)),
        "machines": machines.collect::<Vec<_>>(),
        "stands_s": seconds(stood),
    })
}
