//! What went wrong or was stopped in a run, with its times.

use super::faults;
use super::signals::Signal;
use runtime_sim::device::error;
use runtime_sim::history::Word;
use runtime_sim::io_trace::Source;
use runtime_sim::line::Line;
use runtime_sim::run::Recorded;
use runtime_sim::wiring;
use serde_json::{Value, json};

/// Time in s, number of the machine or -1, and what happened; in the order of time.
pub fn alarms(line: &Line, recorded: &Recorded, signals: &[Signal], results: &Value) -> Vec<Value> {
    let kinds = line.kinds.len();
    let errors: Vec<Option<usize>> =
        line.machines.iter().map(|machine| machine.wiring.input_at(wiring::Source::Error, kinds)).collect();
    let end = recorded.report.scans;
    let mut alarms: Vec<(u64, i64, String)> = faults::faults(line, signals);
    alarms.retain(|(scan, ..)| *scan < end);
    for (signal, word) in signals.iter().zip(&recorded.history.words) {
        let machine = signal.machine.map_or(-1, |machine| machine as i64);
        let mut put = |scan: u64, text: String| alarms.push((scan, machine, text));
        match signal.source {
            Source::Input { machine, word: at } if errors[machine] == Some(at) => {
                let mut last_ms = None;
                for (scan, code) in answers(word) {
                    let at_ms = scan * u64::from(line.scan_ms);
                    put(scan, answer_text(code, reason(recorded, machine, code, last_ms, at_ms)));
                    last_ms = Some(at_ms);
                }
            }
            Source::RunPermit => {
                for (scan, permit) in word.changes.iter().skip(1) {
                    let text = if *permit == 0.0 {
                        "run_permit falls: the line stops"
                    } else {
                        "run_permit is back"
                    };
                    put(*scan, text.into());
                }
            }
            _ => {}
        }
    }
    let seconds = |scan: u64| (scan * u64::from(line.scan_ms)) as f64 / 1000.0;
    let alarms = alarms.into_iter().map(|(scan, machine, text)| (seconds(scan), machine, text));
    let of_controllers = of_controllers(line, results).chain(raised(line, results));
    let mut all: Vec<(f64, i64, String)> = alarms.chain(of_controllers).collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0).then_with(|| (a.1, &a.2).cmp(&(b.1, &b.2))));
    all.into_iter().map(|(time, machine, text)| json!([time, machine, text])).collect()
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
            count => format!(", {count} times until {:.2} s", alarm["last_s"].as_f64()?),
        };
        let text = format!("alarm {}: {}{again}", alarm["code"], alarm["text"].as_str()?);
        Some((alarm["first_s"].as_f64()?, machine(line, alarm), text))
    };
    alarms.filter_map(one).collect()
}

/// When a word became other than 0.
fn answers(word: &Word) -> impl Iterator<Item = (u64, i32)> {
    word.changes.iter().filter(|(_, value)| *value != 0.0).map(|(scan, value)| (*scan, *value as i32))
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
