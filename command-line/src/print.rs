//! Diagnostics and verdicts, for people and for scripts.

use super::interrupt;
use super::load::Failure;
use super::options::{Format, InputOptions};
use crate::Status;
use autogen::diagnostic::{self, Diagnostic, Severity};
use autogen::lower::{Apart, Handover, Loss, Lost, Passage, Passes, Verdict};
use autogen::plain;
use autogen::source::Sources;
use serde_json::{Value, json};
use std::io::{self, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};

/// Somebody waits for a file, whether or not standard output is read.
static GOES_ON: AtomicBool = AtomicBool::new(false);

/// From now on the program goes on where the reader of standard output has enough.
pub fn go_on_without_reader() {
    GOES_ON.store(true, Ordering::Relaxed);
}

/// Writes to standard output, as escapes what a terminal would obey. A reader that has enough ends the program
/// quietly, if nobody waits for a file.
pub fn out(text: std::fmt::Arguments) {
    let text = text.to_string();
    let bytes = plain::escaped(&text);
    if let Err(error) = io::stdout().write_all(bytes.as_bytes()).and_then(|()| io::stdout().flush()) {
        if error.kind() == io::ErrorKind::BrokenPipe {
            if GOES_ON.load(Ordering::Relaxed) {
                return;
            }
            interrupt::abandon();
            std::process::exit(Status::Done as i32);
        }
        interrupt::abandon();
        complain!("autogen: standard output: {error}");
        std::process::exit(Status::WrongCommand as i32);
    }
}

/// Writes to standard error, as escapes what a terminal would obey.
pub fn err(text: &str) {
    err_styled(&plain::escaped(text));
}

/// Writes to standard error what may hold escapes of its own. Nobody is left to be told if that fails.
pub fn err_styled(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}

/// Nobody reads more of them; all are in the JSON form.
const MOST_DIAGNOSTICS: usize = 1000;

/// Diagnostics on standard error.
pub fn diagnostics(sources: &Sources, found: &[Diagnostic]) {
    let shown = &found[..found.len().min(MOST_DIAGNOSTICS)];
    let text = match std::io::stderr().is_terminal() {
        true => diagnostic::render_styled(sources, shown),
        false => diagnostic::render_plain(sources, shown),
    };
    err_styled(&text);
    if shown.len() < found.len() {
        complain!("and {} more, with `--format json`", found.len() - shown.len());
    }
    for severity in [Severity::Error, Severity::Warning, Severity::Note] {
        let what = severity.name();
        match found.iter().filter(|found| found.severity() == severity).count() {
            0 => {}
            1 => complain!("1 {what}"),
            n => complain!("{n} {what}s"),
        }
    }
}

pub fn diagnostics_json(sources: &Sources, found: &[Diagnostic]) -> Value {
    found
        .iter()
        .map(|d| {
            let (line, column) = sources.position(d.place);
            json!({
                "code": d.code, "severity": d.severity().name(), "message": d.message, "file": sources.file(d.place.file).name,
                "line": line, "column": column, "help": d.help, "notes": d.notes,
            })
        })
        .collect()
}

/// What stopped a command before anything was compiled.
pub fn failure(options: &InputOptions, failure: &Failure) -> Status {
    failure_in(options.format, failure)
}

/// What stopped a command before anything was compiled.
pub fn failure_in(format: Format, failure: &Failure) -> Status {
    match (failure, format) {
        (Failure::Unreadable(text) | Failure::Unfit(text), Format::Text) => complain!("autogen: {text}"),
        (Failure::Unreadable(text) | Failure::Unfit(text), Format::Json) => {
            say!("{}", json!({ "feasible": false, "finished": false, "reason": text, "diagnostics": [] }));
        }
        (Failure::Wrong(sources, found) | Failure::Refused(sources, found), Format::Text) => {
            diagnostics(sources, found)
        }
        (Failure::Wrong(sources, found) | Failure::Refused(sources, found), Format::Json) => {
            say!(
                "{}",
                json!({ "feasible": false, "finished": false, "diagnostics": diagnostics_json(sources, found) })
            );
        }
    }
    match failure {
        Failure::Refused(..) | Failure::Unfit(_) => Status::WrongInput,
        Failure::Unreadable(_) | Failure::Wrong(..) => Status::WrongCommand,
    }
}

/// What a command is refused for that needs a line without errors.
pub fn refused(options: &InputOptions, sources: &Sources, found: &[Diagnostic]) -> Status {
    match options.format {
        Format::Text => diagnostics(sources, found),
        Format::Json => {
            let reason = "the input has errors";
            say!(
                "{}",
                json!({ "finished": false, "reason": reason, "diagnostics": diagnostics_json(sources, found) })
            );
        }
    }
    Status::WrongInput
}

/// What is wrong with the command line.
pub fn unusable(options: &InputOptions, why: &str) -> Status {
    match options.format {
        Format::Text => complain!("autogen: {why}"),
        Format::Json => say!("{}", json!({ "finished": false, "reason": why, "diagnostics": [] })),
    }
    Status::WrongCommand
}

pub fn verdict_json(verdict: Option<&Verdict>, sources: &Sources, found: &[Diagnostic]) -> Value {
    let empty = Verdict::default();
    let v = verdict.unwrap_or(&empty);
    json!({
        "feasible": v.feasible && found.iter().all(|d| d.severity() != Severity::Error),
        "robots": v.robots,
        "edges": v.edges.iter().map(handover_json).collect::<Vec<_>>(),
        "sources": v.sources,
        "destinations": v.destinations,
        "conveyors": v.passages.iter().map(passage_json).collect::<Vec<_>>(),
        "losses": v.losses.iter().map(loss_json).collect::<Vec<_>>(),
        "sinks": v.sinks,
        "single_points": v.single_points,
        "unreachable": v.unreachable,
        "dead_ends": v.dead_ends,
        "apart": v.apart.iter().filter(|a| is_missed(a, v)).map(apart_json).collect::<Vec<_>>(),
        "diagnostics": diagnostics_json(sources, found),
    })
}

/// Degrees only where there are limits.
fn handover_json(Handover { from, to, margin, wrist_room }: &Handover) -> Value {
    match wrist_room {
        Some(degrees) => json!([from, to, margin, degrees]),
        None => json!([from, to, margin]),
    }
}

fn passage_json(Passage { from, to, by }: &Passage) -> Value {
    match by {
        Passes::Joint([off, turn]) => {
            json!({ "from": from, "to": to, "by": "joint", "margin_mm": 1000.0 * off, "margin_deg": turn })
        }
        Passes::Branch(part) => json!({ "from": from, "to": to, "by": "branch", "part": part }),
        Passes::Fall => json!({ "from": from, "to": to, "by": "fall" }),
    }
}

fn loss_json(loss: &Loss) -> Value {
    let goals =
        loss.goals.iter().map(|lost| json!({ "at": lost.at, "kinds": lost.kinds, "others": lost.others }));
    json!({ "without": loss.machine, "lost": goals.collect::<Vec<_>>() })
}

/// Whether a machine is cut off that this handover could have connected.
fn is_missed(apart: &Apart, verdict: &Verdict) -> bool {
    verdict.unreachable.contains(&apart.to) || verdict.dead_ends.contains(&apart.from)
}

fn apart_json(apart: &Apart) -> Value {
    let misses: Vec<Value> = (apart.misses.iter())
        .map(|m| json!({ "place": m.place, "kind": m.kind, "stage": format!("{:?}", m.stage).to_lowercase(), "missing_mm": m.missing_mm }))
        .collect();
    let suggestion = apart.suggestion.as_ref().map(|(robot, path, present, value)| {
        json!({ "robot": robot, "number": path, "present": present, "value": value })
    });
    let turn = apart
        .turn
        .as_ref()
        .map(|(robot, present, value)| json!({ "robot": robot, "present_deg": present, "value_deg": value }));
    json!({ "from": apart.from, "to": apart.to, "poses_tested": apart.tested, "misses": misses, "suggested_change": suggestion, "suggested_turn": turn })
}

/// The verdict in text.
pub fn verdict(v: &Verdict) -> String {
    let mut text = String::new();
    let has_ends = !v.sources.is_empty() || !v.destinations.is_empty();
    if v.edges.is_empty() && v.passages.is_empty() && v.robots.len() > 1 {
        text += "no machine hands anything over to another\n";
    }
    if !v.edges.is_empty() || !v.destinations.is_empty() {
        text += &format!(
            "{} edges (margin: how far the arm stays within its reach at the worst pose{})\n",
            v.edges.len(),
            match v.edges.iter().any(|edge| edge.wrist_room.is_some()) {
                true => ", and joints 4 to 6 from their limits",
                false => "",
            }
        );
    }
    let width = v.edges.iter().map(|edge| edge.from.len()).max().unwrap_or(0);
    let to_width = v.edges.iter().map(|edge| edge.to.len()).max().unwrap_or(0);
    for Handover { from, to, margin, wrist_room } in &v.edges {
        let degrees = wrist_room.map_or(String::new(), |degrees| format!(", {degrees:.1} degrees"));
        text += &format!("  {from:width$} -> {to:to_width$}  {margin:6.3} m{degrees}\n");
    }
    if !v.passages.is_empty() {
        text += "conveyors (margin of a joint: by how much more the ends could be apart and turned)\n";
        let width = |of: fn(&Passage) -> &String| v.passages.iter().map(|p| of(p).len()).max().unwrap_or(0);
        let (width, to_width) = (width(|p| &p.from), width(|p| &p.to));
        for Passage { from, to, by } in &v.passages {
            let by = match by {
                Passes::Joint([off, turn]) => format!("{:.1} mm, {turn:.2} degrees", 1000.0 * off),
                Passes::Branch(part) => format!("by {part}"),
                Passes::Fall => "may fall".into(),
            };
            text += &format!("  {from:width$} -> {to:to_width$}  {by}\n");
        }
    }
    if has_ends {
        text += &format!("sources       {}\n", list(&v.sources));
    }
    if !v.destinations.is_empty() || has_ends && v.sinks.is_empty() {
        text += &format!("destinations  {}\n", list(&v.destinations));
    }
    if !v.sinks.is_empty() {
        text += &format!("sinks         {}\n", list(&v.sinks));
    }
    if !v.edges.is_empty() || !v.single_points.is_empty() {
        let passed = if v.single_points.is_empty() { "" } else { " (every item passes each of them)" };
        text += &format!("single points {}{passed}\n", list(&v.single_points));
    }
    if !v.losses.is_empty() {
        text += "lost without\n";
        let width = v.losses.iter().map(|loss| loss.machine.len()).max().unwrap_or(0);
        for loss in &v.losses {
            let goals = loss.goals.iter().map(|Lost { at, kinds, others }| match others.is_empty() {
                true => format!("all at {at}"),
                false => format!("{} at {at}", kinds.join(" and ")),
            });
            text += &format!("  {:width$}  {}\n", loss.machine, goals.collect::<Vec<_>>().join(", "));
        }
    }
    text + &format!("step order    {}\n", list(&v.robots))
}

fn list(names: &[String]) -> String {
    if names.is_empty() { "none".into() } else { names.join(", ") }
}
