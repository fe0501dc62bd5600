//! What went wrong or was stopped in a run, with its times.

use super::signals::Signal;
use runtime_sim::device::error;
use runtime_sim::history::{History, Word};
use runtime_sim::io_trace::Source;
use runtime_sim::line::Line;
use runtime_sim::wiring;
use serde_json::{Value, json};

/// Time in s, number of the machine or -1, and what happened; in the order of time.
pub fn alarms(line: &Line, history: &History, signals: &[Signal]) -> Vec<Value> {
    let kinds = line.kinds.len();
    let errors: Vec<Option<usize>> =
        line.machines.iter().map(|machine| machine.wiring.input_at(wiring::Source::Error, kinds)).collect();
    let mut alarms: Vec<(u64, i64, String)> = Vec::new();
    for (signal, word) in signals.iter().zip(&history.words) {
        let machine = signal.machine.map_or(-1, |machine| machine as i64);
        let mut put = |scan: u64, text: String| alarms.push((scan, machine, text));
        match signal.source {
            Source::Input { machine, word: at } if errors[machine] == Some(at) => {
                answers(word).for_each(|(scan, code)| put(scan, answer_text(code)));
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
            Source::FaultCode => {
                answers(word).for_each(|(scan, code)| put(scan, format!("fault {code}")));
            }
            _ => {}
        }
    }
    alarms.sort();
    let seconds = |scan: u64| (scan * u64::from(line.scan_ms)) as f64 / 1000.0;
    alarms.into_iter().map(|(scan, machine, text)| json!([seconds(scan), machine, text])).collect()
}

/// When a word became other than 0.
fn answers(word: &Word) -> impl Iterator<Item = (u64, i64)> {
    word.changes.iter().filter(|(_, value)| *value != 0.0).map(|(scan, value)| (*scan, *value as i64))
}

fn answer_text(code: i64) -> String {
    let meaning = match i32::try_from(code) {
        Ok(error::UNREACHABLE) => "the goal is out of reach",
        Ok(error::NO_PART) => "nothing was gripped",
        Ok(error::REFUSED) => "the device refused it",
        _ => "see the type of the device",
    };
    format!("a command ended in error {code}: {meaning}")
}
