//! What goes wrong in a run.

use super::{lasts, name, part_name, seconds};
use crate::ir::System;
use runtime_sim::device::PortType;
use runtime_sim::line::{Answer, Jam, Line, Pause, Refusal, Slip, SlowCycle, Stuck};
use serde_json::{Map, Value, json};

pub struct Faults<'a> {
    pub slips: &'a [Slip],
    pub refusals: &'a [Refusal],
    pub answers: &'a [Answer],
    pub pauses: &'a [Pause],
    pub power_offs: &'a [Pause],
    pub sensors: &'a [Stuck],
    pub jams: &'a [Jam],
    pub slow: &'a [SlowCycle],
}

impl Faults<'_> {
    /// Those of which there are any.
    pub fn json(&self, system: &System, line: &Line) -> Value {
        let Self { slips, refusals, answers, pauses, power_offs, sensors, jams, slow } = self;
        let all: [(&str, Vec<Value>); 8] = [
            ("slips", slips.iter().map(|it| slip(line, it)).collect()),
            ("refusals", refusals.iter().map(|it| refusal(line, it)).collect()),
            ("answers", answers.iter().map(|it| answer(line, it)).collect()),
            ("pauses", pauses.iter().map(|it| pause(line, it)).collect()),
            ("power_offs", power_offs.iter().map(|it| pause(line, it)).collect()),
            ("sensors", sensors.iter().filter_map(|it| sensor(system, line, it)).collect()),
            ("jams", jams.iter().map(|it| jam(line, it)).collect()),
            ("slow", slow.iter().map(|it| slow_cycle(line, it)).collect()),
        ];
        let some = all.into_iter().filter(|(_, list)| !list.is_empty());
        some.map(|(key, list)| (key.to_string(), Value::from(list))).collect::<Map<_, _>>().into()
    }
}

fn slip(line: &Line, Slip { machine, pick, after_s }: &Slip) -> Value {
    json!({"robot": name(line, *machine), "pick": pick, "after_s": after_s})
}

fn refusal(line: &Line, Refusal { machine, command }: &Refusal) -> Value {
    json!({"robot": name(line, *machine), "command": command})
}

fn answer(line: &Line, Answer { machine, command, late_s, error }: &Answer) -> Value {
    let mut answer = json!({"robot": name(line, *machine), "command": command, "late_s": late_s});
    if let Some(error) = error {
        answer["error"] = json!(error);
    }
    answer
}

fn pause(line: &Line, Pause { at_scan, scans }: &Pause) -> Value {
    json!({"at_s": seconds(line, *at_scan), "for_s": seconds(line, *scans)})
}

/// None of what no device has.
fn sensor(system: &System, line: &Line, stuck: &Stuck) -> Option<Value> {
    let Stuck { machine, word, words, value, during } = stuck;
    let kinds = line.kinds.len();
    let mut inputs = system.automaton_of(*machine).device.inputs(kinds);
    let (first, port) = inputs.find(|(first, port)| (*first..first + port.words(kinds)).contains(word))?;
    let reads = if port.ty == PortType::Bool { json!(*value != 0.0) } else { json!(value) };
    let mut sensor = json!({"robot": name(line, *machine), "signal": port.name, "reads": reads});
    if *words != port.words(kinds) {
        sensor["element"] = json!(word - first);
    }
    lasts(line, during, &mut sensor);
    Some(sensor)
}

fn jam(line: &Line, Jam { machine, part, during }: &Jam) -> Value {
    let mut jam = json!({"robot": name(line, *machine), "part": part_name(line, *machine, *part)});
    lasts(line, during, &mut jam);
    jam
}

fn slow_cycle(line: &Line, SlowCycle { machine, part, cycle, longer_s }: &SlowCycle) -> Value {
    let [robot, part] = [name(line, *machine), part_name(line, *machine, *part)];
    json!({"robot": robot, "part": part, "cycle": cycle, "longer_s": longer_s})
}
