//! What grows with the time of a run, within bounds: what is least missed is left out first, and the page says so.

use super::motions::motions;
use super::numbers::{List, list};
use super::paths::paths;
use super::signals::{Form, Signal, changes_json};
use runtime_sim::carrier::Carrier;
use runtime_sim::event::{Event, OrderChange};
use runtime_sim::history::History;
use runtime_sim::line::Line;
use runtime_sim::run::Recorded;

/// Bytes of all of it at most: a page of 30 MB is still shown by any browser.
const MOST_BYTES: usize = 26_000_000;
/// Where the end of the drawing is looked for, it is missed by less than this part.
const CLOSE: f64 = 0.9;

/// Keys of the data with their values as JSON.
pub struct Long {
    pub parts: Vec<(&'static str, String)>,
    /// What is not there, a sentence each.
    pub left_out: Vec<String>,
    /// The time from which on nothing is drawn on the plan; none: all is.
    pub drawn_until_s: Option<f64>,
}

impl Long {
    pub fn new(line: &Line, recorded: &Recorded, signals: &[Signal]) -> Self {
        Self::within(MOST_BYTES, line, recorded, signals)
    }

    fn within(most: usize, line: &Line, recorded: &Recorded, signals: &[Signal]) -> Self {
        let history = &recorded.history;
        let end_ms = recorded.report.simulated_s * 1000.0;
        let mut left_out = Vec::new();
        let mut parts = vec![
            ("made", made(&history.events)),
            ("collected", collected(&history.events)),
            ("stays", stays(history)),
        ];
        let mut drawn = drawn(line, recorded, end_ms);
        let room = most.saturating_sub(bytes(&parts));
        let mut changes = changes_json(signals, &history.words, |_| true);
        for (is_kept, text) in FEWER {
            if bytes(&drawn) + changes.len() <= room {
                break;
            }
            left_out.push(text.to_string());
            changes = changes_json(signals, &history.words, is_kept);
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
                "The plan is drawn until {until:.0} s: the later motions are too much for one page. All other data are those of the whole run."
            ));
        }
        parts.append(&mut drawn);
        parts.push(("changes", changes));
        Self { parts, left_out, drawn_until_s }
    }
}

/// Which signals are kept, and what the page says of it.
type Fewer = (fn(&Signal) -> bool, &'static str);

/// Fewer and fewer.
const FEWER: [Fewer; 3] = [
    (
        |signal| signal.form != Form::Real,
        "Signals that are real numbers are left out, such as places of tools: there are too many changes for one page. The plan shows where everything is, and --io-trace writes each value.",
    ),
    (
        |signal| matches!(signal.form, Form::Truth | Form::Names(_)),
        "Signals that are whole numbers are left out too, such as the numbers of commands.",
    ),
    (|_| false, "All other signals are left out too."),
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

/// Of each machine: scans since the change before, number of the state, and what it is counted as.
fn stays(history: &History) -> String {
    list(history.machines.iter().map(|machine| {
        let mut stays = List::default();
        let mut last = 0;
        for stay in &machine.stays {
            stays.put_whole(stay.scan - last).put_whole(stay.state).put_whole(stay.counted as usize);
            last = stay.scan;
        }
        stays.end()
    }))
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
