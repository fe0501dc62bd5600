//! `autogen why`: what each machine waits for at a time of a run of the reference executor.

use super::commission::io_delay;
use super::options::{Format, WhyOptions};
use super::progress::Progress;
use super::remembered::remembering;
use super::{load, print};
use crate::Status;
use autogen::ir::{FaultKind, Severity};
use autogen::lower::{Project, compile};
use autogen::source::{Sources, Span};
use autogen::why::{self, Await, How, Later, Node, Picture, Promise, Read, Standing, Verdict, Waits, Watch};
use runtime_sim::carrier::Carrier;
use runtime_sim::line::{IoDelay, Line};
use runtime_sim::machine::Machine;
use runtime_sim::part::{Primitive, source};
use runtime_sim::report::Report;
use runtime_sim::run::{Seen as SeenScan, Stepping, run_again};
use serde_json::{Value, json};
use std::io::{self, IsTerminal};

pub fn run(options: &WhyOptions) -> Status {
    let input = match load::load(&options.input) {
        Ok(input) => input,
        Err(failure) => return print::failure(&options.input, &failure),
    };
    let outcome = compile(input);
    let Some(project) = outcome.project else {
        return print::refused(&options.input, &outcome.sources, &outcome.diagnostics);
    };
    let is_shown = !options.input.quiet && options.input.format == Format::Text && io::stderr().is_terminal();
    let seen = match question(options, &project) {
        Ok(question) => look(&project, question, Progress::new(is_shown)),
        Err(why) => Err(why),
    };
    match seen {
        Ok(seen) => {
            match options.input.format {
                Format::Text if !options.input.quiet => say_text(options, &seen, &outcome.sources),
                Format::Text => {}
                Format::Json => say!("{}", json_of(&seen, &outcome.sources)),
            }
            Status::Done
        }
        Err(why) => print::unusable(&options.input, &why),
    }
}

/// What is asked of a run.
struct Question {
    at: Option<u64>,
    /// All, if none is named.
    machines: Vec<usize>,
    is_until: bool,
    delay: IoDelay,
}

struct Seen {
    picture: Picture,
    machines: Vec<usize>,
    later: Option<Later>,
    report: Report,
    /// The picture is that of the end of the run.
    is_end: bool,
}

impl Seen {
    fn waits(&self) -> Waits<'_> {
        Waits::new(&self.picture, self.is_end && is_stalled(&self.report))
    }
}

fn is_stalled(report: &Report) -> bool {
    report.reason.starts_with("deadlock: ")
}

/// The scan in which a time lies, as `--at` says it; none if it is no time from 0 to 1e9 s.
pub fn scan(seconds: &str, scan_ms: u32) -> Option<u64> {
    let seconds = seconds.parse::<f64>().ok().filter(|s| (0.0..=1e9).contains(s))?;
    // What is a whole number of scans may be a little less as a number.
    Some((seconds * 1000.0 / f64::from(scan_ms) + 1e-6).floor() as u64)
}

fn question(options: &WhyOptions, project: &Project) -> Result<Question, String> {
    let delay = io_delay(&options.io_delay)
        .ok_or("--io-delay takes a number of scans up to 1000, `random` or `random:SEED`")?;
    let at = options.at.as_ref().map(|text| {
        scan(text, project.plant.scan_ms)
            .ok_or_else(|| format!("--at {text}: it takes seconds of the run, such as 120.5"))
    });
    let instances = &project.system.instances;
    let machines = options.robot.iter().map(|name| {
        let found = instances.iter().position(|instance| instance.name == *name);
        found.ok_or_else(|| {
            let known: Vec<&str> =
                instances.iter().take(100).map(|instance| instance.name.as_str()).collect();
            format!("--robot {name}: there is no such machine; there are {}", known.join(", "))
        })
    });
    let machines = machines.collect::<Result<Vec<_>, _>>()?;
    let machines = if machines.is_empty() { (0..instances.len()).collect() } else { machines };
    Ok(Question { at: at.transpose()?, machines, is_until: options.until, delay })
}

/// Which sources of a line have no more parts, and since when, ms.
struct Supplies(Vec<(usize, Option<usize>, Option<u64>)>);

impl Supplies {
    /// Each machine with a source, and the last item that it brings.
    fn of(line: &Line) -> Self {
        let has_source = |machine: &Machine| {
            machine.parts.iter().any(|part| matches!(part.primitive, Primitive::Source(_)))
        };
        let machines = line.machines.iter().enumerate().filter(|(_, machine)| has_source(machine));
        Self(
            machines
                .map(|(number, _)| (number, source::supply(line, number).last().copied(), None))
                .collect(),
        )
    }

    fn look(&mut self, seen: &SeenScan, ms: u64) {
        let items = seen.plant.items();
        for (_, last, since) in self.0.iter_mut().filter(|(.., since)| since.is_none()) {
            match last {
                None => *since = Some(0),
                Some(last) if items[*last].carrier != Carrier::Supply => *since = Some(ms),
                Some(_) => {}
            }
        }
    }

    fn empty_at(&self, ms: u64) -> Vec<(usize, u64)> {
        let empty = self.0.iter().filter_map(|(machine, _, since)| Some((*machine, (*since)?)));
        empty.filter(|(_, since)| *since <= ms).collect()
    }
}

fn look(project: &Project, question: Question, mut progress: Progress) -> Result<Seen, String> {
    let Question { at, machines, is_until, delay } = question;
    let mut line = project.plant.clone();
    line.io_delay = delay;
    let mut watch = Watch::new(&project.system, at.unwrap_or(u64::MAX));
    if is_until {
        watch = watch.until_left(machines.clone());
    } else if let Some(at) = at {
        // One scan more: a run that has ended before it has ended by itself.
        let limit_s = (at + 2) as f64 * f64::from(line.scan_ms) / 1000.0;
        line.scenario.time_limit_s = line.scenario.time_limit_s.min(limit_s);
    }
    let mut sources = Supplies::of(&line);
    let mut observe = |seen: &SeenScan| {
        let ms = seen.scan * u64::from(line.scan_ms);
        progress.show(ms / 1000);
        sources.look(seen, ms);
    };
    let run = |memory: &mut _| run_again(&line, &mut watch, Stepping::Events, memory, &mut observe);
    let report = remembering(&line, run)?;
    progress.end();
    let is_end = at.is_none_or(|at| at + 1 >= report.scans);
    let (mut picture, later) = watch.finish(report.scans);
    picture.empty = sources.empty_at(picture.at_ms);
    Ok(Seen { picture, machines, later, report, is_end })
}

/// For the report of a run that ended otherwise than well: who waited for whom at its end, as lines. The same run once
/// more, on the reference executor. None for an end that nobody waited for: a collision, a value out of bounds.
pub fn at_the_end(project: &Project, delay: IoDelay, report: &Value) -> Result<Option<Vec<String>>, String> {
    let reason = report["reason"].as_str().unwrap_or("");
    let is_late = ["deadlock: ", "time limit: "].iter().any(|begin| reason.starts_with(begin));
    let fault =
        report["fault"]["code"].as_u64().and_then(|code| project.system.model.faults.get(code as usize - 1));
    let is_long = fault.is_some_and(|site| site.kind == FaultKind::TooLong);
    if report["finished"] == true || !(is_late || is_long) {
        return Ok(None);
    }
    let seen = look(
        project,
        Question { at: None, machines: Vec::new(), is_until: false, delay },
        Progress::new(false),
    )?;
    let waits = seen.waits();
    let faulted = report["fault"]["robot"].as_str().filter(|_| is_long);
    let faulted =
        faulted.and_then(|name| seen.picture.machines.iter().position(|machine| machine.name == name));
    let text = match faulted {
        Some(machine) => why::chain_of(&seen.picture, &waits, machine),
        None => why::chains(&seen.picture, &waits),
    };
    let text = text + &why::empty_sources(&seen.picture);
    Ok(Some(text.lines().map(String::from).collect()))
}

fn say_text(options: &WhyOptions, seen: &Seen, sources: &Sources) {
    let Seen { picture, machines, later, report, is_end } = seen;
    let waits = seen.waits();
    say!("at {:.2} s", picture.at_ms as f64 / 1000.0);
    if *is_end {
        say!("the run ends here: {}", report.reason);
    }
    if let Some(fault) = &picture.fault {
        let (name, at) = (&picture.machines[fault.machine].name, fault.at_ms as f64 / 1000.0);
        say!("the line is stopped since {at:.2} s by a fault of {name}: {}", fault.text);
    } else if !picture.is_running {
        say!("the line does not run: no transition is tested until it is started");
    }
    for machine in machines {
        say!("\n{}", why::machine(&picture.machines[*machine], sources).trim_end());
    }
    say!("");
    match options.robot.is_empty() {
        true => say_part!("{}", why::chains(picture, &waits)),
        false => {
            machines.iter().for_each(|machine| say_part!("{}", why::chain_of(picture, &waits, *machine)))
        }
    }
    say_part!("{}", why::empty_sources(picture));
    if let Some(later) = later {
        say_part!("\n{}", why::later(picture, later));
    }
}

fn json_of(seen: &Seen, sources: &Sources) -> Value {
    let Seen { picture, machines, later, report, is_end } = seen;
    let waits = seen.waits();
    let name = |machine: usize| &picture.machines[machine].name;
    let shown = machines.iter().map(|machine| {
        let seen = &picture.machines[*machine];
        let transitions = seen.transitions.iter().map(|tested| {
            let place = place_text(sources, tested.place);
            let clauses: Vec<Value> = tested.clauses.iter().map(node_json).collect();
            json!({ "guard": tested.title, "target": tested.target, "place": place, "holds": tested.holds, "clauses": clauses })
        });
        let chain = waits.chain(*machine);
        let chain: Vec<&String> = chain.iter().map(|(machine, _)| name(*machine)).collect();
        json!({
            "name": seen.name, "state": seen.state, "stay_s": seen.stay_ms as f64 / 1000.0,
            "stopped": seen.is_stopped,
            "at_panel": seen.at_panel,
            "properties": seen.properties.iter().map(|promise| promise_json(promise, sources)).collect::<Vec<_>>(),
            "transitions": transitions.collect::<Vec<_>>(),
            "waits_for": seen.awaits.iter().map(|awaited| await_json(picture, awaited)).collect::<Vec<_>>(),
            "chain": chain,
        })
    });
    let fault = picture.fault.as_ref().map(|fault| {
        json!({ "robot": name(fault.machine), "at_s": fault.at_ms as f64 / 1000.0, "text": fault.text })
    });
    let empty = picture.empty.iter();
    let empty = empty.map(|(at, ms)| json!({ "robot": name(*at), "since_s": *ms as f64 / 1000.0 }));
    let circles = waits.circles().into_iter();
    let circles = circles.map(|circle| circle.into_iter().map(name).collect::<Vec<_>>());
    let mut answer = json!({
        "at_s": picture.at_ms as f64 / 1000.0, "running": picture.is_running, "fault": fault,
        "ended": is_end.then_some(&report.reason), "machines": shown.collect::<Vec<_>>(),
        "deadlocks": circles.collect::<Vec<_>>(), "empty_sources": empty.collect::<Vec<_>>(), "diagnostics": [],
    });
    if let Some(later) = later {
        answer["until"] = later.machines.iter().map(|became| later_json(picture, became)).collect();
    }
    answer
}

fn place_text(sources: &Sources, place: Span) -> String {
    format!("{}:{}", sources.file(place.file).name, sources.position(place).0)
}

fn promise_json(promise: &Promise, sources: &Sources) -> Value {
    let seconds = |ms: u64| ms as f64 / 1000.0;
    let standing = match promise.standing {
        Standing::Fault { at_ms } => json!({ "fault_s": seconds(at_ms) }),
        Standing::Alarm { severity, raised_ms, active, acknowledged } => json!({
            "alarm_s": seconds(raised_ms), "active": active, "acknowledged": acknowledged,
            "stops": severity == Severity::Machine,
        }),
        Standing::Waits { since_ms, until_ms } => {
            json!({ "waits_since_s": seconds(since_ms), "waits_until_s": seconds(until_ms) })
        }
    };
    let mut answer = json!({
        "property": promise.text, "text": promise.told, "place": place_text(sources, promise.place),
        "clauses": promise.clauses.iter().map(node_json).collect::<Vec<_>>(),
    });
    if let (Value::Object(answer), Value::Object(standing)) = (&mut answer, standing) {
        answer.extend(standing);
    }
    answer
}

fn later_json(picture: &Picture, became: &why::Became) -> Value {
    let seconds = |ms: u64| ms as f64 / 1000.0;
    let transitions = became.transitions.iter().map(|(title, clauses)| {
        let clauses: Vec<Value> = clauses
            .iter()
            .map(|(text, since)| json!({ "text": text, "true_s": since.map(seconds) }))
            .collect();
        json!({ "guard": title, "clauses": clauses })
    });
    let (to, begins_anew) = match became.left.as_ref().map(|left| &left.how) {
        None => (None, None),
        Some(How::Fired(_, to)) => (Some(to), None),
        Some(How::MovedByHand) => (None, Some("moved by hand")),
        Some(How::PowerLost) => (None, Some("loss of power")),
    };
    json!({
        "name": picture.machines[became.machine].name,
        "left_s": became.left.as_ref().map(|left| seconds(left.at_ms)),
        "to": to,
        "begins_anew": begins_anew,
        "transitions": transitions.collect::<Vec<_>>(),
    })
}

fn node_json(node: &Node) -> Value {
    let holds = match node.verdict {
        Verdict::Holds => json!(true),
        Verdict::Fails => json!(false),
        Verdict::NotTested => Value::Null,
    };
    let reads: Vec<Value> = node.reads.iter().map(read_json).collect();
    let parts: Vec<Value> = node.parts.iter().map(node_json).collect();
    json!({ "text": node.text, "holds": holds, "reads": reads, "parts": parts })
}

fn read_json(read: &Read) -> Value {
    json!({
        "name": read.name, "value": read.value, "set": read.set, "writers": read.writers,
        "changed_s": read.changed.as_ref().map(|changed| changed.at_ms as f64 / 1000.0),
        "changed_by": read.changed.as_ref().map(|changed| &changed.by),
    })
}

fn await_json(picture: &Picture, awaited: &Await) -> Value {
    match awaited {
        Await::Machine(other, read) => {
            json!({ "machine": picture.machines[*other].name, "reads": read_json(read) })
        }
        Await::Command { text } => json!({ "command": text }),
        Await::Time { text, left_ms, .. } => json!({ "time": text, "left_s": *left_ms as f64 / 1000.0 }),
        Await::Input(read) => json!({ "input": read_json(read) }),
        Await::Own(read) => json!({ "own": read_json(read) }),
    }
}
