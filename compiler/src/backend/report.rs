//! What went on in a run, as one page that plays: `report.html`.
//!
//! The page fetches nothing. Its script is in `templates/report/`; what it shows stands in it as JSON.

macro_rules! part {
    ($name:literal) => {
        include_str!(concat!(env!("CARGO_MANIFEST_DIR"), "/../templates/report/", $name))
    };
}

mod acts;
mod alarms;
mod answers;
mod automata;
mod faults;
mod handovers;
mod limit;
mod long;
mod machine;
mod motions;
mod numbers;
mod paths;
mod signals;
mod standstills;
mod states;
pub mod story;
pub mod sweep;
mod throughput;

use crate::ir::System;
use crate::lower::Project;
use crate::source::Sources;
use crate::version;
use askama::Template;
use long::Long;
use runtime_sim::io_trace::Source;
use runtime_sim::item;
use runtime_sim::line::Line;
use runtime_sim::run::Recorded;
use serde_json::{Value, json};
use standstills::Standstills;

/// Of the data and its version.
pub const FORMAT: &str = "autogen report 3";

#[derive(Template)]
#[template(path = "report/report.html", escape = "html")]
struct Page<'a> {
    title: &'a str,
    style: &'static str,
    data: &'a str,
    /// Each may use what those before it define.
    scripts: &'static [&'static str],
}

const STYLE: &str = part!("report.css");
const SCRIPTS: &[&str] = &[
    part!("page.js"),
    part!("data.js"),
    part!("motion.js"),
    part!("scene.js"),
    part!("pen.js"),
    part!("conveyors.js"),
    part!("cylinders.js"),
    part!("plan.js"),
    part!("timeline.js"),
    part!("gantt.js"),
    part!("signals.js"),
    part!("tables.js"),
    part!("inspector.js"),
    part!("figures.js"),
    part!("player.js"),
];

/// How every page begins.
pub const MARK: &str = "<!doctype html>\n<html lang=\"en\">\n<!-- Written by autogen -->";

/// The words that a run has to be watched for.
pub fn watched(system: &System, line: &Line) -> Vec<Source> {
    let signals = signals::signals(system).into_iter().map(|signal| signal.source);
    signals.chain(alarms::watched(line)).collect()
}

/// The page of a run. `results` are those that are written beside it; the words of the history are [`watched`].
pub fn html(
    project: &Project,
    sources: &Sources,
    line: &Line,
    recorded: &Recorded,
    results: &Value,
) -> String {
    let data = data(project, sources, line, recorded, results);
    let page = Page { title: &project.name, style: STYLE, data: &within_script(&data), scripts: SCRIPTS };
    // Writing to memory does not fail.
    page.render().unwrap_or_default()
}

/// The same value as JSON that no browser takes for the end of a script, or for the beginning of a comment.
fn within_script(json: &str) -> String {
    json.replace('<', "\\u003c")
}

fn data(project: &Project, sources: &Sources, line: &Line, recorded: &Recorded, results: &Value) -> String {
    let Recorded { report, history, .. } = recorded;
    let system = &project.system;
    let signals = signals::signals(system);
    let end = history.words_until.unwrap_or(report.scans).min(report.scans);
    let acts = acts::acts(history, &signals, end);
    let standstills = Standstills::new(history, &signals, end);
    let path = limit::Run { line, events: &history.events, acts: &acts, end }.path();
    let types: Vec<usize> = system.instances.iter().map(|instance| instance.automaton.0).collect();
    let names = item::Names::new(line).all();
    let kinds = line.scenario.supply.iter().flat_map(|supply| supply.items.iter());
    let items = names.iter().zip(kinds).zip(&recorded.paths);
    let items: Vec<Value> = items.map(|((name, kind), path)| paths::item_json(name, *kind, path)).collect();
    let long = Long::new(line, recorded, &signals, &path);
    let mut machines = machine::machines(line, &signals);
    for (number, machine) in machines.iter_mut().enumerate() {
        let times = states::times(&history.machines[number], report.scans).into_iter();
        let seconds = |scans: u64| (scans * u64::from(line.scan_ms)) as f64 / 1000.0;
        machine["in_states"] = times.map(|(state, scans)| json!([state, seconds(scans)])).collect();
        machine["has_commands"] = json!(system.automaton_of(number).device.is_commanded());
    }
    let head = json!({
        "format": FORMAT,
        "tool": format!("autogen {}", version::NUMBER),
        "name": project.name,
        "scan_ms": line.scan_ms,
        "results": results,
        "kinds": line.kinds.iter().map(|kind| {
            json!({ "name": kind.name, "size": kind.size, "height": kind.height })
        }).collect::<Vec<_>>(),
        "automata": automata::automata(system, sources),
        "types": types,
        "machines": machines,
        "throughput": throughput::throughput(&history.events, u64::from(line.scan_ms), report.scans * u64::from(line.scan_ms)),
        "obstacles": machine::obstacles(line),
        "signals": signals::signals_json(line, &signals),
        "words_until_s": history.words_until.map(|scan| (scan * u64::from(line.scan_ms)) as f64 / 1000.0),
        "items": items,
        "alarms": alarms::alarms(line, recorded, &signals, results),
        "limit": limit::limit_json(line, &path, &standstills),
        "left_out": long.left_out,
        "drawn_until_s": long.drawn_until_s,
        "signals_until_s": long.signals_until_s,
        "lives": long.drawn_until_s.map(|_| paths::lives(&recorded.paths)),
    });
    let mut data = head.to_string();
    // The object stays open for what is long.
    data.pop();
    for (key, json) in long.parts {
        data += &format!(",\"{key}\":{json}");
    }
    data + "}"
}
