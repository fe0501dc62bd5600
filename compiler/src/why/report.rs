//! A picture as text.

use super::reads::{COMMAND, STAY};
use super::{
    Await, Changed, How, Later, Left, Machine, Node, Picture, Promise, Read, Standing, Tested, Verdict, Waits,
};
use crate::ir::Severity;
use crate::source::{Sources, Span};
use std::fmt::Write;

fn seconds(ms: u64) -> String {
    format!("{:.2} s", ms as f64 / 1000.0)
}

fn place(sources: &Sources, span: Span) -> String {
    format!("{}:{}", sources.file(span.file).name, sources.position(span).0)
}

/// A machine with every transition of its state, and every clause of them.
pub fn machine(machine: &Machine, sources: &Sources) -> String {
    let Machine { name, state, stay_ms, transitions, properties, is_final, is_stopped, at_panel, .. } =
        machine;
    let mut out = match is_stopped {
        true => format!("{name} is stopped, in {state}\n"),
        false => format!("{name} is in {state}, for {}\n", seconds(*stay_ms)),
    };
    at_panel.iter().for_each(|step| out += &format!("  at its panel: {step}\n"));
    properties.iter().for_each(|promise| self::promise(promise, sources, &mut out));
    if *is_final {
        out += "  a final state: no transition leaves it\n";
    }
    for tested in transitions {
        let Tested { title, target, place: span, holds, clauses } = tested;
        let target = target.as_ref().map_or("stays".to_string(), |target| format!("-> {target}"));
        let verdict = if *holds { "fires next" } else { "does not hold" };
        let _ = writeln!(out, "  {title} {target}: {verdict} ({})", place(sources, *span));
        clauses.iter().for_each(|clause| node(clause, 2, &mut out));
    }
    out
}

fn promise(promise: &Promise, sources: &Sources, out: &mut String) {
    let Promise { text, told, place: span, standing, clauses } = promise;
    let place = place(sources, *span);
    let _ = match standing {
        Standing::Fault { at_ms } => writeln!(out, "  fault since {}: {told} ({place})", seconds(*at_ms)),
        Standing::Alarm { raised_ms, .. } => {
            writeln!(
                out,
                "  alarm raised at {}, {}: {told} ({place})",
                seconds(*raised_ms),
                of_alarm(standing)
            )
        }
        Standing::Waits { since_ms, until_ms } => writeln!(
            out,
            "  waits since {}, until {} at the latest, or: {told} ({place})",
            seconds(*since_ms),
            seconds(*until_ms)
        ),
    };
    let _ = writeln!(out, "    {text}");
    clauses.iter().for_each(|clause| node(clause, 3, out));
}

/// `active, not acknowledged; it stops the machine`
fn of_alarm(standing: &Standing) -> String {
    let Standing::Alarm { severity, active, acknowledged, .. } = standing else { return String::new() };
    let active = if *active { "active" } else { "no longer active" };
    let acknowledged = if *acknowledged { "acknowledged" } else { "not acknowledged" };
    let stops = match severity {
        Severity::Machine => "it stops the machine",
        Severity::Warning | Severity::Line => "it stops nothing",
    };
    format!("{active}, {acknowledged}; {stops}")
}

/// What a machine that is stopped needs to continue, from its alarms and its panel.
fn stopped(machine: &Machine) -> String {
    let alarms = machine.properties.iter().filter_map(|promise| match promise.standing {
        Standing::Alarm { severity: Severity::Machine, active, acknowledged, .. } => {
            Some((promise.told.as_str(), active, acknowledged))
        }
        _ => None,
    });
    let alarms: Vec<_> = alarms.collect();
    let texts: Vec<&str> = alarms.iter().map(|(told, ..)| *told).collect();
    let steps = [
        (alarms.iter().any(|(_, active, _)| *active), "remove the cause"),
        (alarms.iter().any(|(.., acknowledged)| !*acknowledged), "acknowledge"),
        (true, "start"),
    ];
    let steps = steps.into_iter().filter(|(is_due, _)| *is_due).map(|(_, step)| step);
    let steps: Vec<&str> = machine.at_panel.iter().copied().chain(steps).collect();
    match texts.is_empty() {
        true if !machine.at_panel.is_empty() => {
            format!("is stopped at its panel; to continue: {}", steps.join(", "))
        }
        true => format!("is stopped, the cause is gone: {}", steps.join(", ")),
        false => format!("is stopped by its alarm: {}; to continue: {}", texts.join("; "), steps.join(", ")),
    }
}

fn node(part: &Node, depth: usize, out: &mut String) {
    let Node { text, verdict, reads, parts } = part;
    let verdict = match verdict {
        Verdict::Holds => "ok   ",
        Verdict::Fails => "FAILS",
        Verdict::NotTested => "-    ",
    };
    let indent = "  ".repeat(depth);
    let _ = writeln!(out, "{indent}{verdict}  {text}");
    for read in reads {
        let _ = writeln!(out, "{indent}         {}", read_text(read));
    }
    parts.iter().for_each(|part| node(part, depth + 1, out));
}

/// `agv2.held is true, by gantry at 118.30 s; gantry writes it`
fn read_text(read: &Read) -> String {
    let writers = match read.writers.as_slice() {
        [] => String::new(),
        [one] => format!("; {one} writes it"),
        many => format!("; {} write it", many.join(", ")),
    };
    value_text(read) + &writers
}

/// `agv2.held is true, by gantry at 118.30 s`
fn value_text(read: &Read) -> String {
    let Read { name, value, set, changed, .. } = read;
    if let Some(set) = set {
        let set = Read {
            name: format!("{name} is put out as {value}; set"),
            value: set.clone(),
            set: None,
            ..read.clone()
        };
        return value_text(&set);
    }
    match (name.as_str(), changed) {
        (COMMAND, Some(Changed { at_ms, .. })) => format!("{name}: {value}, at {}", seconds(*at_ms)),
        (COMMAND, None) => format!("{name}: {value}"),
        (_, Some(Changed { at_ms, by })) => format!("{name} is {value}, by {by} at {}", seconds(*at_ms)),
        (STAY, None) => format!("{name} is {value}"),
        (_, None) => format!("{name} is {value}, since the beginning"),
    }
}

/// What a machine waits for that waits for no other machine.
fn alone(machine: &Machine) -> String {
    if let Some(tested) = machine.transitions.iter().find(|tested| tested.holds) {
        let target = tested.target.as_ref().map_or(String::new(), |target| format!(" to {target}"));
        return format!("continues{target} in its next step: {} holds", tested.title);
    }
    if machine.is_stopped {
        return stopped(machine);
    }
    if machine.is_final {
        return format!("waits for no machine: {} is a final state", machine.state);
    }
    let mut awaited: Vec<String> = Vec::new();
    let mut inputs: Vec<String> = Vec::new();
    for one in &machine.awaits {
        match one {
            Await::Machine(..) => {}
            Await::Command { text } => awaited.push(text.clone()),
            Await::Time { text, left_ms, .. } => awaited.push(format!("`{text}`, in {}", seconds(*left_ms))),
            Await::Own(read) => awaited.push(format!("itself: {}", value_text(read))),
            Await::Input(read) => inputs.push(value_text(read)),
        }
    }
    inputs.truncate(MOST_NAMED);
    awaited.truncate(MOST_NAMED);
    if !inputs.is_empty() {
        awaited.push(format!("its device: {}", inputs.join("; ")));
    }
    match awaited.is_empty() {
        true => "waits for no machine, and nothing can let it continue".into(),
        false => format!("waits for no other machine, only for {}", awaited.join("; for ")),
    }
}

/// Things that one line names.
const MOST_NAMED: usize = 3;

/// Who waits for whom, from one machine on.
pub fn chain_of(picture: &Picture, waits: &Waits, machine: usize) -> String {
    let mut out = String::new();
    let chain = waits.chain(machine);
    for (number, (at, awaited)) in chain.iter().enumerate() {
        let Machine { name, state, .. } = &picture.machines[*at];
        let _ = match awaited {
            Some(Await::Machine(other, read)) => {
                let other = &picture.machines[*other].name;
                writeln!(out, "{name} ({state}) waits for {other}: {}", value_text(read))
            }
            _ if chain[..number].iter().any(|(before, _)| before == at) => {
                writeln!(out, "and {name} waits, as above: a circle")
            }
            _ => writeln!(out, "{name} ({state}) {}", alone(&picture.machines[*at])),
        };
    }
    out
}

/// Who waits for parts of these waits for nothing.
pub fn empty_sources(picture: &Picture) -> String {
    let mut out = String::new();
    for (machine, since_ms) in picture.empty.iter().take(MOST_LINES) {
        let name = &picture.machines[*machine].name;
        let _ = match since_ms {
            0 => writeln!(out, "{name}: the source has no parts in this scenario"),
            ms => writeln!(out, "{name}: the source has no more parts, since {}", seconds(*ms)),
        };
    }
    out
}

/// Lines about all machines; there may be thousands.
const MOST_LINES: usize = 30;

/// The circles first, then who waits for whom, each machine once. One in a final state, for which nobody waits, is left
/// out.
pub fn chains(picture: &Picture, waits: &Waits) -> String {
    let mut out = String::new();
    for machines in waits.circles() {
        let mut names: Vec<&str> = machines.iter().map(|m| picture.machines[*m].name.as_str()).collect();
        names.push(names[0]);
        let _ = writeln!(out, "deadlock: {} wait for each other", names.join(" -> "));
    }
    let mut told: Vec<usize> = Vec::new();
    let mut lines = 0;
    for machine in waits.beginnings() {
        for (at, awaited) in waits.chain(machine) {
            if told.contains(&at) {
                continue;
            }
            told.push(at);
            let Machine { name, state, is_final, .. } = &picture.machines[at];
            if *is_final && at == machine {
                continue;
            }
            lines += 1;
            if lines > MOST_LINES {
                continue;
            }
            let _ = match awaited {
                Some(Await::Machine(other, read)) => {
                    let other = &picture.machines[*other].name;
                    writeln!(out, "{name} ({state}) waits for {other}: {}", value_text(read))
                }
                _ => writeln!(out, "{name} ({state}) {}", alone(&picture.machines[at])),
            };
        }
    }
    if lines > MOST_LINES {
        let _ = writeln!(out, "and {} more machines", lines - MOST_LINES);
    }
    out
}

/// When the clauses of the states became true.
pub fn later(picture: &Picture, later: &Later) -> String {
    let mut out = String::new();
    for became in &later.machines {
        let Machine { name, state, .. } = &picture.machines[became.machine];
        let _ = match &became.left {
            Some(Left { at_ms, how }) => {
                let how = match how {
                    How::Fired(by, to) => format!(" for {to}: {}", became.transitions[*by].0),
                    How::MovedByHand => ": it was moved by hand, and begins anew".into(),
                    How::PowerLost => ": it has lost its power, and begins anew".into(),
                };
                writeln!(out, "{name} leaves {state} at {}{how}", seconds(*at_ms))
            }
            None => writeln!(out, "{name} stays in {state} to the end of the run"),
        };
        for (title, clauses) in &became.transitions {
            let _ = writeln!(out, "  {title}");
            for (text, since) in clauses {
                let since = match since {
                    Some(ms) if *ms == picture.at_ms => "true already".into(),
                    Some(ms) => format!("true at {}", seconds(*ms)),
                    None => "never true".to_string(),
                };
                let _ = writeln!(out, "    {since:18}  {text}");
            }
        }
    }
    out
}
