//! What went wrong or was stopped in a run, with its times.

use super::answers::{self, Head};
use super::faults;
use super::signals::Signal;
use runtime_sim::device::error;
use runtime_sim::io_trace::Source;
use runtime_sim::line::Line;
use runtime_sim::run::Recorded;
use runtime_sim::wiring::{self, Drives};
use serde_json::{Value, json};
use std::collections::HashMap;

/// The words of alarms that a run has to be watched for besides the signals: whether each is active, by machine.
pub fn watched(line: &Line) -> Vec<Source> {
    let alarms = line.machines.iter().flat_map(|machine| &machine.monitor.alarms);
    alarms.map(|alarm| Source::Trace(alarm.word)).collect()
}

/// Time in s, number of the machine or -1, and what happened; in the order of time.
pub fn alarms(line: &Line, recorded: &Recorded, signals: &[Signal], results: &Value) -> Vec<Value> {
    let end = recorded.report.scans;
    let words = &recorded.history.words;
    let mut alarms: Vec<(u64, i64, String)> = faults::faults(line, signals);
    alarms.retain(|(scan, ..)| *scan < end);
    let numbers: HashMap<Source, usize> =
        words.iter().enumerate().map(|(number, word)| (word.source, number)).collect();
    let word = |source: Source| numbers.get(&source).map(|number| &words[*number]);
    for (machine, described) in line.machines.iter().enumerate() {
        let input = |of| described.wiring.input_at(of, line.kinds.len());
        let read = |of| word(Source::Input { machine, word: input(of)? });
        let cmd = described.wiring.output_at(Drives::Command, line.kinds.len());
        let cmd = cmd.and_then(|at| word(Source::Output { machine, word: at }));
        let (Some(cmd), Some(ack), Some(error)) =
            (cmd, read(wiring::Source::Ack), read(wiring::Source::Error))
        else {
            continue;
        };
        let mut last_ms = None;
        for (scan, code) in answers::errors(&Head { cmd, ack, error }) {
            let at_ms = scan * u64::from(line.scan_ms);
            let text = answer_text(code, reason(recorded, machine, code, last_ms, at_ms));
            alarms.push((scan, machine as i64, text));
            last_ms = Some(at_ms);
        }
    }
    for (scan, permit) in word(Source::RunPermit).into_iter().flat_map(|word| word.changes.iter().skip(1)) {
        let text = if *permit == 0.0 { "run_permit falls: the line stops" } else { "run_permit is back" };
        alarms.push((*scan, -1, text.into()));
    }
    for (machine, described) in line.machines.iter().enumerate() {
        for alarm in &described.monitor.alarms {
            if is_active(results, &described.name, alarm.code) {
                continue;
            }
            let active = word(Source::Trace(alarm.word)).map(|word| word.changes.as_slice());
            if let Some((scan, 0.0)) = active.filter(|changes| changes.len() > 1).and_then(|all| all.last()) {
                alarms.push((*scan, machine as i64, format!("alarm {} is not active any more", alarm.code)));
            }
        }
    }
    let seconds = |scan: u64| (scan * u64::from(line.scan_ms)) as f64 / 1000.0;
    let alarms = alarms.into_iter().map(|(scan, machine, text)| (seconds(scan), machine, text));
    let of_controllers = of_controllers(line, results).chain(raised(line, results));
    let mut all: Vec<(f64, i64, String)> = alarms.chain(of_controllers).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| (a.1, &a.2).cmp(&(b.1, &b.2))));
    all.into_iter().map(|(time, machine, text)| json!([time, machine, text])).collect()
}

/// Whether an alarm is active at the end, by the table of alarms.
fn is_active(results: &Value, robot: &str, code: i32) -> bool {
    let mut alarms = results["alarms"].as_array().into_iter().flatten();
    alarms.any(|alarm| {
        alarm["robot"] == robot && alarm["code"] == code.unsigned_abs() && alarm["active"] == true
    })
}

/// The faults of the controllers, and when they were cleared. The one that ended the run is its reason.
fn of_controllers<'a>(line: &'a Line, results: &'a Value) -> impl Iterator<Item = (f64, i64, String)> + 'a {
    let cleared = results["faults"].as_array().into_iter().flatten().flat_map(|fault| {
        let machine = machine(line, fault);
        let what = format!("fault {} in {}: {}", fault["code"], text(fault, "state"), text(fault, "text"));
        let came = fault["at_s"].as_f64().map(|at_s| (at_s, machine, what));
        let cleared = fault["cleared_s"].as_f64();
        let cleared = cleared.map(|at_s| (at_s, machine, format!("fault {} is cleared", fault["code"])));
        [came, cleared]
    });
    let last = results.get("fault").map(|fault| {
        Some((fault["at_s"].as_f64()?, machine(line, fault), text(results, "reason").to_string()))
    });
    cleared.chain(last).flatten()
}

fn text<'v>(value: &'v Value, key: &str) -> &'v str {
    value[key].as_str().unwrap_or("")
}

/// Number of the robot that is named here; -1 if it is none.
fn machine(line: &Line, of: &Value) -> i64 {
    let named = line.machines.iter().position(|machine| of["robot"] == machine.name.as_str());
    named.map_or(-1, |machine| machine as i64)
}

/// The alarms of the table, each at its first time.
fn raised(line: &Line, results: &Value) -> Vec<(f64, i64, String)> {
    let alarms = results["alarms"].as_array().into_iter().flatten();
    let one = |alarm: &Value| {
        let again = match alarm["count"].as_u64()? {
            1 => String::new(),
            count => format!(", {count} times until {} s", alarm["last_s"].as_f64()?),
        };
        let lasts = if alarm["active"] == true { ", active at the end" } else { "" };
        let text = format!("alarm {}: {}{again}{lasts}", alarm["code"], alarm["text"].as_str()?);
        Some((alarm["first_s"].as_f64()?, machine(line, alarm), text))
    };
    alarms.filter_map(one).collect()
}

/// Why the last command that ended in this error by then, and after the answer before, did.
fn reason(
    recorded: &Recorded,
    machine: usize,
    error: i32,
    after_ms: Option<u64>,
    by_ms: u64,
) -> Option<&str> {
    let mut all = recorded.report.missed.iter().rev();
    let last = all.find(|missed| {
        let is_of_answer = missed.at_ms <= by_ms && after_ms.is_none_or(|after| missed.at_ms > after);
        (missed.machine, missed.error) == (machine, error) && is_of_answer
    });
    last.map(|missed| missed.text.as_str())
}

fn answer_text(code: i32, why: Option<&str>) -> String {
    let meaning = match code {
        error::UNREACHABLE => why.unwrap_or("the goal cannot be reached"),
        error::NO_PART => why.unwrap_or("nothing was gripped"),
        error::REFUSED => "the device refused it",
        error::WITHDRAWN => "it was withdrawn",
        _ => why.unwrap_or("see the type of the device"),
    };
    format!("a command ended in error {code}: {meaning}")
}
