//! How far a run has come, and for how long nothing has happened.

use crate::carrier::Carrier;
use crate::event::{Event, OrderChange};
use crate::line::{Collected, Goal, Line};
use crate::plant::Plant;
use crate::shortage::shortage;

#[derive(Clone)]
pub struct Progress {
    made: usize,
    /// Of each sink that has a goal, items of each kind.
    collected: Vec<Vec<u32>>,
    /// What sinks have that none of them should have.
    surplus: Option<String>,
    /// The last scan in which something happened: an input or a word of the controllers changed, or was about to.
    alive: u64,
    /// The same, but for what is only about to.
    last_event: u64,
    /// Scans without anything that make a deadlock.
    stall: u64,
    /// The scan before which the run ends at the latest.
    limit: u64,
}

impl Progress {
    pub fn new(line: &Line) -> Self {
        let scans = |seconds: f64| (seconds * 1000.0 / f64::from(line.scan_ms)).ceil() as u64;
        let scenario = &line.scenario;
        Self {
            made: 0,
            collected: match &scenario.goal {
                Goal::Collected(sinks) => vec![vec![0; line.kinds.len()]; sinks.len()],
                Goal::AllOrders | Goal::TimeLimit => Vec::new(),
            },
            surplus: None,
            alive: 0,
            last_event: 0,
            stall: scans(scenario.stall_limit_s),
            limit: scans(scenario.time_limit_s).max(1),
        }
    }

    pub fn note(&mut self, scan: u64, happened: bool) {
        if happened {
            self.last_event = scan;
            self.is_alive(scan);
        }
    }

    /// Something is going to happen after this scan.
    pub fn is_alive(&mut self, scan: u64) {
        self.alive = scan;
    }

    pub fn last_event(&self) -> u64 {
        self.last_event
    }

    /// The scan at which the run ends at the latest if nothing happens before.
    pub fn limit(&self) -> u64 {
        self.limit
    }

    /// The scan at which it ends if nothing is about to happen any more.
    pub fn stalls_at(&self) -> u64 {
        self.alive.saturating_add(1).saturating_add(self.stall)
    }

    /// Events before this scan that were not counted yet.
    pub fn count(&mut self, line: &Line, plant: &Plant, scan: u64, events: &[Event]) {
        let made = |event: &&Event| matches!(event, Event::Order { change: OrderChange::Made, .. });
        self.made += events.iter().filter(made).count();
        self.surplus = self.collect(line, plant, events);
        self.note(scan, !events.is_empty());
    }

    /// Whether the run is over before this scan, and whether it has reached its goal.
    pub fn end(&mut self, line: &Line, plant: &Plant, scan: u64) -> Option<(bool, String)> {
        if let Some((machine, reason)) = plant.items().crashed() {
            let name = &line.machines[machine].name;
            return Some((false, format!("interlock of {name}: {reason}")));
        }
        if let Some(surplus) = self.surplus.take() {
            return Some((false, surplus));
        }
        if let Goal::Collected(sinks) = &line.scenario.goal
            && sinks.iter().zip(&self.collected).all(|(sink, items)| sink.items == *items)
        {
            return Some((true, "all items collected".into()));
        }
        let is_all = self.made == line.scenario.orders.len();
        if is_all && line.scenario.goal == Goal::AllOrders {
            Some((true, "all orders made".into()))
        } else if is_all && !line.scenario.orders.is_empty() {
            Some((false, format!("all {} orders made before the time limit", self.made)))
        } else if scan.saturating_sub(self.alive.saturating_add(1)) >= self.stall {
            Some((false, format!("deadlock: {}", self.lacks(line, plant))))
        } else if scan >= self.limit && line.scenario.goal == Goal::TimeLimit {
            Some((true, "time limit reached".into()))
        } else if scan >= self.limit {
            Some((false, format!("time limit: {}", self.lacks(line, plant))))
        } else {
            None
        }
    }

    /// Counts what sinks have collected; what none of them should have.
    fn collect(&mut self, line: &Line, plant: &Plant, events: &[Event]) -> Option<String> {
        let Goal::Collected(sinks) = &line.scenario.goal else { return None };
        for event in events {
            let Event::Item { item, to: Carrier::Sink { machine, part }, .. } = *event else { continue };
            let of_goal = sinks.iter().zip(&mut self.collected);
            let Some((sink, items)) =
                of_goal.into_iter().find(|(sink, _)| (sink.machine, sink.part) == (machine, part))
            else {
                continue;
            };
            let kind = plant.items()[item].kind;
            items[kind] += 1;
            if items[kind] > sink.items[kind] {
                let [wanted, name] = [sink.items[kind].to_string(), line.kinds[kind].name.clone()];
                return Some(format!("{} has collected more {name} than {wanted}", title(line, sink)));
            }
        }
        None
    }

    /// What the goal still lacks.
    fn lacks(&self, line: &Line, plant: &Plant) -> String {
        let Goal::Collected(sinks) = &line.scenario.goal else { return shortage(line, plant) };
        let lacks = sinks.iter().zip(&self.collected).flat_map(|(sink, items)| {
            let kinds = sink.items.iter().zip(items).zip(&line.kinds);
            let missing = kinds.filter(|((wanted, found), _)| found < wanted);
            missing.map(|((wanted, found), kind)| {
                format!("{} has {found} of {wanted} {}", title(line, sink), kind.name)
            })
        });
        lacks.collect::<Vec<_>>().join("; ")
    }
}

/// Such as `sorter.red_bin`.
fn title(line: &Line, sink: &Collected) -> String {
    let machine = &line.machines[sink.machine];
    format!("{}.{}", machine.name, machine.parts[sink.part].name)
}
