//! How far a run has come, and for how long nothing has happened.

use crate::event::{Event, OrderChange};
use crate::line::{Goal, Line};
use crate::plant::Plant;
use crate::shortage::shortage;

pub struct Progress {
    made: usize,
    /// Events that were looked at.
    read: usize,
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
            read: 0,
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

    /// Whether the run is over before this scan, and whether it has reached its goal.
    pub fn end(&mut self, line: &Line, plant: &Plant, scan: u64) -> Option<(bool, String)> {
        let log = plant.items().log();
        let made = |event: &&Event| matches!(event, Event::Order { change: OrderChange::Made, .. });
        self.made += log[self.read..].iter().filter(made).count();
        if self.read < log.len() {
            self.note(scan, true);
        }
        self.read = log.len();
        let is_all = self.made == line.scenario.orders.len();
        if is_all && line.scenario.goal == Goal::AllOrders {
            Some((true, "all orders made".into()))
        } else if is_all && !line.scenario.orders.is_empty() {
            Some((false, format!("all {} orders made before the time limit", self.made)))
        } else if scan.saturating_sub(self.alive.saturating_add(1)) >= self.stall {
            Some((false, format!("deadlock: {}", shortage(line, plant))))
        } else if scan >= self.limit && line.scenario.goal == Goal::TimeLimit {
            Some((true, "time limit reached".into()))
        } else if scan >= self.limit {
            Some((false, format!("time limit: {}", shortage(line, plant))))
        } else {
            None
        }
    }
}
