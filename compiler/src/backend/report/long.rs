//! What grows with the time of a run, within bounds: what is least missed is left out first, and the page says so.

use super::limit::Leg;
use super::motions::motions;
use super::numbers::{List, list};
use super::paths::paths;
use super::signals::{Form, Signal, changes_json};
use runtime_sim::carrier::Carrier;
use runtime_sim::event::{Event, OrderChange};
use runtime_sim::history::{History, MachineHistory};
use runtime_sim::line::Line;
use runtime_sim::run::Recorded;

/// Bytes of all of it at most: a page of 30 MB is still shown by any browser.
const MOST_BYTES: usize = 26_000_000;
/// States have this part of it at most.
const STATES: usize = 2;
/// Signals have this part of the rest at least, if the drawing needs all of it.
const SIGNALS: usize = 4;
/// Signals that take less than this part of the room are not left out: it would help no more than the drawing of a short
/// time.
const SMALL: usize = 8;
/// Where the end of the drawing is looked for, it is missed by less than this part.
const CLOSE: f64 = 0.9;

/// Keys of the data with their values as JSON.
pub struct Long {
    pub parts: Vec<(&'static str, String)>,
    /// What is not there, a sentence each.
    pub left_out: Vec<String>,
    /// The time from which on nothing is drawn on the plan; none: all is.
    pub drawn_until_s: Option<f64>,
    /// The time from which on signals are not shown, but for those of the line; none: all are.
    pub signals_until_s: Option<f64>,
}

impl Long {
    /// `path` is the one that limits the run.
    pub fn new(line: &Line, recorded: &Recorded, signals: &[Signal], path: &[Leg]) -> Self {
        Self::within(MOST_BYTES, line, recorded, signals, path)
    }

    fn within(most: usize, line: &Line, recorded: &Recorded, signals: &[Signal], path: &[Leg]) -> Self {
        let history = &recorded.history;
        let end_ms = recorded.report.simulated_s * 1000.0;
        let mut left_out = Vec::new();
        let mut parts = vec![("made", made(&history.events)), ("collected", collected(&history.events))];
        let room = most.saturating_sub(bytes(&parts));
        let states_until = states_until(history, path, room / STATES);
        parts.extend(states(history, path, states_until));
        let seconds = |scan: u64| (scan * u64::from(line.scan_ms)) as f64 / 1000.0;
        if let Some(until) = states_until.map(seconds) {
            left_out.push(format!(
                "States, and the path that limits the run, are shown until {until:.0} s: the later ones are too much for one page. Figures and tables are those of the whole run."
            ));
        }
        let mut drawn = drawn(line, recorded, end_ms);
        let room = most.saturating_sub(bytes(&parts));
        let changes_of = |is_kept, until| changes_json(signals, &history.words, is_kept, until);
        let mut kept: fn(&Signal) -> bool = |_| true;
        let mut changes = changes_of(kept, u64::MAX);
        for (is_kept, text) in FEWER {
            if bytes(&drawn) + changes.len() <= room || changes.len() <= room / SMALL {
                break;
            }
            let fewer = changes_of(is_kept, u64::MAX);
            // There may be no such signals.
            if fewer.len() < changes.len() {
                left_out.push(text.to_string());
                (kept, changes) = (is_kept, fewer);
            }
        }
        let most_changes = room.saturating_sub(bytes(&drawn)).max(room / SIGNALS);
        let mut until = history.words_until.unwrap_or(recorded.report.scans);
        let mut signals_until_s = None;
        while changes.len() > most_changes && until > 0 {
            until = (until as f64 * (most_changes as f64 / changes.len() as f64) * CLOSE) as u64;
            signals_until_s = Some(seconds(until));
            changes = changes_of(kept, until);
        }
        if let Some(until) = signals_until_s {
            left_out.push(format!(
                "Signals are shown until {until:.0} s, but for those of the line: the later changes are too many for one page."
            ));
        }
        let room = room.saturating_sub(changes.len());
        let mut until_ms = end_ms;
        while bytes(&drawn) > room && until_ms > 1.0 {
            until_ms *= (room as f64 / bytes(&drawn) as f64).min(1.0) * CLOSE;
            drawn = self::drawn(line, recorded, until_ms);
        }
        let drawn_until_s = (until_ms < end_ms).then_some(until_ms / 1000.0);
        if let Some(until) = drawn_until_s {
            left_out.push(format!(
                "The plan is drawn until {until:.0} s: the later motions are too much for one page. The paths of items in their table and their events end there too; the times of items are those of the whole run."
            ));
        }
        parts.append(&mut drawn);
        parts.push(("changes", changes));
        Self { parts, left_out, drawn_until_s, signals_until_s }
    }
}

/// Which signals are kept, and what the page says of it.
type Fewer = (fn(&Signal) -> bool, &'static str);

/// Fewer and fewer.
const FEWER: [Fewer; 2] = [
    (
        |signal| signal.form != Form::Real,
        "Signals that are real numbers are left out, such as places of tools: there are too many changes for one page. The plan shows where everything is, and --io-trace writes each value.",
    ),
    (
        |signal| matches!(signal.form, Form::Truth | Form::Names(_)),
        "Signals that are whole numbers are left out, such as the numbers of commands.",
    ),
];

fn bytes(parts: &[(&'static str, String)]) -> usize {
    parts.iter().map(|(_, json)| json.len()).sum()
}

/// What the plan is drawn from, up to this time.
fn drawn(line: &Line, recorded: &Recorded, until_ms: f64) -> Vec<(&'static str, String)> {
    let motions = motions(&recorded.history, until_ms);
    let paths = paths(line, &recorded.paths, until_ms);
    vec![
        ("trajectories", motions.trajectories),
        ("motions", motions.machines),
        ("carriers", paths.carriers),
        ("paths", paths.items),
    ]
}

/// The scan up to which states have so many bytes at most; none: all have.
fn states_until(history: &History, path: &[Leg], most: usize) -> Option<u64> {
    let size = |until| bytes(&states(history, path, until));
    let last = |machine: &MachineHistory| machine.stays.last().map_or(0, |stay| stay.scan);
    let mut until = history.machines.iter().map(last).max().unwrap_or(0);
    let mut found = None;
    let mut bytes = size(None);
    while bytes > most && until > 0 {
        until = (until as f64 * (most as f64 / bytes as f64) * CLOSE) as u64;
        found = Some(until);
        bytes = size(found);
    }
    found
}

/// Number of a state that is not shown, and what it is counted as.
const NOT_SHOWN: [usize; 2] = [65_535, 4];

/// Of each machine, up to this scan: scans since the change before, number of the state, and what it is counted as; then
/// scans since the entry before, and times in states in ms that are not what the states say. Then the path that limits the
/// run: machine, begin and end of each leg, the first one first.
fn states(history: &History, path: &[Leg], until: Option<u64>) -> Vec<(&'static str, String)> {
    let last = until.unwrap_or(u64::MAX);
    let stays = list(history.machines.iter().map(|machine| {
        let mut stays = List::default();
        let mut before = 0;
        for stay in machine.stays.iter().take_while(|stay| stay.scan < last) {
            stays.put_whole(stay.scan - before).put_whole(stay.state).put_whole(stay.counted as usize);
            before = stay.scan;
        }
        if let Some(until) = until {
            let [state, counted] = NOT_SHOWN;
            stays.put_whole(until - before).put_whole(state).put_whole(counted);
        }
        stays.end()
    }));
    let times = list(history.machines.iter().map(|machine| {
        let mut times = List::default();
        let mut before = 0;
        for (scan, ms) in machine.times.set.iter().take_while(|(scan, _)| *scan < last) {
            times.put_whole(scan - before).put_whole(ms);
            before = *scan;
        }
        times.end()
    }));
    let legs = path.iter().rev().take_while(|leg| leg.begin < last);
    let path = list(legs.map(|leg| {
        let mut numbers = List::default();
        numbers.put_whole(leg.machine).put_whole(leg.begin).put_whole(leg.end.min(last)).end()
    }));
    vec![("stays", stays), ("times", times), ("path", path)]
}

/// Scan, machine and number of each order that was made.
fn made(events: &[Event]) -> String {
    let mut made = List::default();
    for event in events {
        if let Event::Order { scan, machine, order, change: OrderChange::Made } = event {
            made.put_whole(scan).put_whole(machine).put_whole(order + 1);
        }
    }
    made.end()
}

/// Scan, item, and machine of each item that came into a sink.
fn collected(events: &[Event]) -> String {
    let mut collected = List::default();
    for event in events {
        if let Event::Item { scan, item, to: Carrier::Sink { machine, .. }, .. } = event {
            collected.put_whole(scan).put_whole(item).put_whole(machine);
        }
    }
    collected.end()
}
