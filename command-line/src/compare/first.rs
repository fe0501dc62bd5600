//! Where two runs differ first. Both continue side by side, so that nothing has to be kept of either.

use super::super::progress::Progress;
use super::super::remembered::remembering;
use super::seen::{self, Seen};
use autogen::executor::Executor;
use autogen::ir::{Group, Named, System};
use autogen::lower::Project;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen as SeenScan, Stepping, run_again};
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};
use serde_json::{Value, json};
use std::collections::{BTreeMap, BTreeSet};
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::thread;

/// Scans that one run may be ahead.
const AHEAD: usize = 1000;

/// The first scan after which values differ.
pub struct First {
    pub scan: u64,
    pub at_ms: u64,
    /// What is called so, in the first run and in the second one.
    pub values: Vec<(String, String, String)>,
}

pub struct Found {
    pub reports: [Report; 2],
    pub first: Option<First>,
    pub only: [Vec<String>; 2],
}

/// What has changed in a scan, by name.
struct Changes {
    scan: u64,
    at_ms: u64,
    values: BTreeMap<String, String>,
}

/// Names that both lines have.
pub struct Common {
    pub machines: BTreeSet<String>,
    pub values: BTreeSet<String>,
}

pub fn find(projects: [&Project; 2], progress: Progress) -> Result<Found, String> {
    let names = projects.map(|project| all(&project.system));
    let values = names.each_ref().map(|names| -> BTreeSet<String> { names.keys().cloned().collect() });
    let machines = projects.map(|project| -> BTreeSet<String> {
        project.system.instances.iter().map(|instance| instance.name.clone()).collect()
    });
    let only = |own: usize, other: usize| -> Vec<String> {
        let machines = machines[own].difference(&machines[other]);
        machines.chain(values[own].difference(&values[other])).cloned().collect()
    };
    let only = [only(0, 1), only(1, 0)];
    let common = Common { machines: &machines[0] & &machines[1], values: &values[0] & &values[1] };
    thread::scope(|scope| {
        let (to_a, from_a) = sync_channel(AHEAD);
        let (to_b, from_b) = sync_channel(AHEAD);
        let [names_a, names_b] = &names;
        let common = &common;
        let a = scope.spawn(move || run(projects[0], names_a, common, to_a, progress));
        let b = scope.spawn(move || run(projects[1], names_b, common, to_b, Progress::new(false)));
        let first = difference(from_a, from_b);
        let joined = |run: thread::ScopedJoinHandle<'_, Result<Report, String>>| {
            run.join().unwrap_or_else(|panic| std::panic::resume_unwind(panic))
        };
        Ok(Found { reports: [joined(a)?, joined(b)?], first, only })
    })
}

/// Ends both channels with the first difference; the runs continue without them.
fn difference(a: Receiver<Changes>, b: Receiver<Changes>) -> Option<First> {
    loop {
        match (a.recv().ok(), b.recv().ok()) {
            (None, None) => return None,
            (Some(changes), None) => return Some(one_sided(changes, true)),
            (None, Some(changes)) => return Some(one_sided(changes, false)),
            (Some(a), Some(b)) if a.at_ms < b.at_ms => return Some(one_sided(a, true)),
            (Some(a), Some(b)) if b.at_ms < a.at_ms => return Some(one_sided(b, false)),
            (Some(a), Some(b)) if a.values != b.values => return Some(both(&a, &b)),
            _ => {}
        }
    }
}

const UNCHANGED: &str = "unchanged";

fn one_sided(changes: Changes, is_first: bool) -> First {
    let values = changes.values.into_iter().map(|(name, value)| match is_first {
        true => (name, value, UNCHANGED.to_string()),
        false => (name, UNCHANGED.to_string(), value),
    });
    First { scan: changes.scan, at_ms: changes.at_ms, values: values.collect() }
}

fn both(a: &Changes, b: &Changes) -> First {
    let names: BTreeSet<&String> = a.values.keys().chain(b.values.keys()).collect();
    let of = |changes: &Changes, name: &String| changes.values.get(name).map_or(UNCHANGED, |v| v).to_string();
    let values = names.into_iter().map(|name| (name.clone(), of(a, name), of(b, name)));
    First { scan: a.scan, at_ms: a.at_ms, values: values.filter(|(_, a, b)| a != b).collect() }
}

fn run(
    project: &Project,
    names: &BTreeMap<String, Named>,
    common: &Common,
    to: SyncSender<Changes>,
    mut progress: Progress,
) -> Result<Report, String> {
    let system = &project.system;
    let mut side = Side {
        system,
        executor: Executor::new(system),
        seen: Seen::new(system, names, common),
        next_scan: 0,
        to: Some(to),
    };
    let mut observe = |seen: &SeenScan| progress.show(seen.scan * u64::from(project.plant.scan_ms) / 1000);
    let plant = &project.plant;
    let run = |memory: &mut _| run_again(plant, &mut side, Stepping::Events, memory, &mut observe);
    let report = remembering(plant, run)?;
    progress.end();
    Ok(report)
}

struct Side<'a> {
    system: &'a System,
    executor: Executor<'a>,
    seen: Seen<'a>,
    next_scan: u64,
    /// None, once nobody asks any more.
    to: Option<SyncSender<Changes>>,
}

impl Side<'_> {
    fn tell(&mut self, scan: u64) {
        let Some(to) = &self.to else { return };
        let values = self.seen.changes(&self.executor);
        let at_ms = scan * self.system.scan_ms as u64;
        if !values.is_empty() && to.send(Changes { scan, at_ms, values }).is_err() {
            self.to = None;
        }
    }
}

impl Controllers for Side<'_> {
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        let scan = self.next_scan;
        self.next_scan += 1;
        let answer = self.executor.scan(system, inputs, outputs);
        self.tell(scan);
        answer
    }

    fn lose_power(&mut self, scans: u64) {
        self.next_scan += scans;
    }

    fn power_up(&mut self) {
        self.executor.power_up();
    }

    fn state(&self, machine: usize) -> usize {
        self.executor.state(machine)
    }

    fn trace(&self, out: &mut Vec<f64>) {
        self.executor.trace(out);
    }

    fn stays(&self) -> Vec<usize> {
        self.executor.stays()
    }

    fn skip(&mut self, scans: u64) {
        self.next_scan += scans;
        self.executor.skip(scans);
    }
}

/// Locals, cells and outputs of all machines, by name: `agv1.at_stop`.
fn all(system: &System) -> BTreeMap<String, Named> {
    let values = |(machine, begin): (usize, usize)| {
        let machine_name = &system.instances[machine].name;
        let values = system.values_of(machine, begin).into_iter().filter(|v| v.group != Group::Input);
        values.map(move |value| (format!("{machine_name}.{}", value.name), value))
    };
    (0..system.instances.len()).zip(system.traces()).flat_map(values).collect()
}

/// Values that are shown.
const MOST_SHOWN: usize = 20;

impl First {
    pub fn text(&self) -> String {
        let mut out = format!(
            "first difference at {:.2} s, in scan {}: first, second\n",
            self.at_ms as f64 / 1000.0,
            self.scan
        );
        for (name, a, b) in self.values.iter().take(MOST_SHOWN) {
            out += &format!("  {name}: {a}, {b}\n");
        }
        match self.values.len().saturating_sub(MOST_SHOWN) {
            0 => out,
            more => out + &format!("  and {more} more\n"),
        }
    }

    pub fn json(&self) -> Value {
        let values = self.values.iter().map(|(name, a, b)| {
            let (machine, value) = seen::parts(name);
            json!({ "machine": machine, "value": value, "first": a, "second": b })
        });
        json!({ "scan": self.scan, "at_s": self.at_ms as f64 / 1000.0, "values": values.collect::<Vec<_>>() })
    }
}
