//! When faults of the scenario began and ended.

use super::signals::{Form, Signal};
use runtime_sim::io_trace::Source;
use runtime_sim::line::{During, Line, Stuck};

/// Scan, number of the machine, and what happened.
pub fn faults(line: &Line, signals: &[Signal]) -> Vec<(u64, i64, String)> {
    let mut faults = Vec::new();
    for stuck in &line.scenario.sensors {
        let name = name(signals, stuck);
        let texts = [format!("{name} sticks: it reads {}", value(signals, stuck)), format!("{name} is free")];
        put(&mut faults, stuck.machine, stuck.during, texts);
    }
    for jam in &line.scenario.jams {
        let name = &line.machines[jam.machine].parts[jam.part].name;
        put(&mut faults, jam.machine, jam.during, [format!("{name} jams"), format!("{name} is free")]);
    }
    faults
}

fn put(faults: &mut Vec<(u64, i64, String)>, machine: usize, during: During, texts: [String; 2]) {
    faults.extend(during.changes().zip(texts).map(|(scan, text)| (scan, machine as i64, text)));
}

fn of<'a>(signals: &'a [Signal], Stuck { machine, word, .. }: &Stuck) -> Option<&'a Signal> {
    signals.iter().find(|signal| signal.source == Source::Input { machine: *machine, word: *word })
}

/// Of several elements the name of all.
fn name<'a>(signals: &'a [Signal], stuck: &Stuck) -> &'a str {
    let name = of(signals, stuck).map_or("", |signal| signal.name.as_str());
    let name = name.split_once('.').map_or(name, |(_, name)| name);
    if stuck.words > 1 { name.split('[').next().unwrap_or(name) } else { name }
}

fn value(signals: &[Signal], stuck: &Stuck) -> String {
    match of(signals, stuck).map(|signal| &signal.form) {
        Some(Form::Truth) => (stuck.value != 0.0).to_string(),
        _ => stuck.value.to_string(),
    }
}
