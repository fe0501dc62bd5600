//! What a person does at buttons and set-points.

use super::{lasts, name, part_name};
use crate::scenario::read::operator::OF_LINE;
use runtime_sim::line::{Line, Operation, Press, Removal};
use runtime_sim::part::Operated;
use serde_json::{Value, json};

pub fn json(line: &Line, operations: &[Operation], presses: &[Press], removals: &[Removal]) -> Value {
    let operations = operations.iter().map(|it| operation(line, it));
    let presses = presses.iter().map(|it| press(line, it));
    operations.chain(presses).chain(removals.iter().map(|it| removal(line, it))).collect()
}

fn operation(line: &Line, Operation { machine, part, at_s, for_s, value }: &Operation) -> Value {
    let mut operation =
        json!({"robot": name(line, *machine), "part": part_name(line, *machine, *part), "at_s": at_s});
    if let Some(for_s) = for_s {
        operation["for_s"] = json!(for_s);
    }
    if line.machines[*machine].parts[*part].schema().operated == Some(Operated::SetNumber) {
        operation["value"] = json!(value);
    }
    operation
}

fn press(line: &Line, Press { button, during }: &Press) -> Value {
    let part = OF_LINE.iter().find(|(_, of_line)| of_line == button).map(|(name, _)| name);
    let mut press = json!({ "part": part });
    lasts(line, during, &mut press);
    press
}

fn removal(line: &Line, Removal { kind, number, at_scan }: &Removal) -> Value {
    let at_s = (at_scan * u64::from(line.scan_ms)) as f64 / 1000.0;
    json!({"remove": format!("{}_{number}", line.kinds[*kind].name), "at_s": at_s})
}
