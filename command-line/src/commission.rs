//! `autogen commission`: the generated controllers run the scenario in the simulator.

use super::alarm;
use super::build::{self, Built};
use super::contact;
use super::controllers::{self, Notice, SharedLibrary};
use super::dropped;
use super::io_trace::IoTrace;
use super::options::{CommissionOptions, Format};
use super::output::{self, OF_A_RUN, Output};
use super::pending::{Content, Pending};
use super::progress::Progress;
use super::read;
use super::remembered::remembering;
use super::results::results;
use super::trajectories::Request;
use super::why;
use crate::Status;
use autogen::backend::rust::parameters_text;
use autogen::backend::{Files, Sink, report as page};
use autogen::parallel::STACK;
use runtime_sim::line::{Goal, IoDelay, Line};
use runtime_sim::report::Report;
use runtime_sim::run::{Recorded, Seen, Stepping, record_again, run_again};
use serde_json::{Value, json};
use std::fmt::Write;
use std::io::{self, IsTerminal};
use std::panic::resume_unwind;
use std::path::{self, Path, PathBuf};
use std::thread;
use std::time::Instant;

pub fn run(options: &CommissionOptions) -> Status {
    match commission(options) {
        Ok(status) => status,
        Err(End::Said(status)) => status,
        Err(End::Failed(text)) => {
            match options.build.input.format {
                Format::Json => say!("{}", json!({ "finished": false, "reason": text, "diagnostics": [] })),
                Format::Text => complain!("autogen: {text}"),
            }
            Status::WrongCommand
        }
    }
}

/// Why there is no run.
enum End {
    /// It was printed.
    Said(Status),
    Failed(String),
}

impl From<String> for End {
    fn from(text: String) -> Self {
        End::Failed(text)
    }
}

/// What a run writes beside the output folder.
struct Requested {
    io_trace: Option<Pending>,
    hashes: Option<Pending>,
    trajectories: Request,
}

fn commission(options: &CommissionOptions) -> Result<Status, End> {
    let begin = Instant::now();
    let delay = io_delay(&options.io_delay).ok_or_else(|| {
        "--io-delay takes a number of scans up to 1000, `random` or `random:SEED`".to_string()
    })?;
    are_different(options)?;
    let overwrite = options.build.overwrite();
    let pending = |path: &Option<PathBuf>, content: Content| {
        path.as_ref().map(|path| Pending::new(path, content, overwrite.into())).transpose()
    };
    let files = Requested {
        io_trace: pending(&options.io_trace, Content::IoTrace)?,
        hashes: pending(&options.hashes, Content::Hashes)?,
        trajectories: Request::new(options)?,
    };
    let built = build::build(&options.build).map_err(End::Said)?;
    let built_files = built.files();
    are_free(options, &built, &built_files)?;
    files.trajectories.check(&built.project.plant)?;
    let refused = |refusal| End::Said(build::refused(&options.build, &refusal));
    // Until the results are written, so that they are those of what is in the folder.
    let output = build::open(&options.build, &built).map_err(refused)?;
    let of_last_run = output.of_a_run();
    let make = |files: &mut dyn Sink| built_files.iter().for_each(|(name, text)| files.file(name, text));
    let compile = || controllers::compiled(&built.project.system, &built.sources, notice(options));
    let library = thread::scope(|scope| {
        let thread = thread::Builder::new().stack_size(STACK);
        let library = thread.spawn_scoped(scope, compile).map_err(|error| error.to_string())?;
        build::write(&options.build, &built, &[&make], &output).map_err(refused)?;
        library.join().unwrap_or_else(|panic| resume_unwind(panic)).map_err(End::Failed)
    })?;
    let names = if options.no_report { &OF_A_RUN[..1] } else { &OF_A_RUN[..] };
    output.may_write_results(names, overwrite).map_err(refused)?;

    let (report, recorded) = report(options, &built, &library, &built_files, delay.clone(), files)?;
    let mut report = results(&report, &built.project, &built.sources)?;
    if let Some(waits) = why::at_the_end(&built.project, delay.clone(), &report)? {
        report["waits"] = json!(waits);
    }
    if let Some(note) = asks_nothing(&built) {
        let mut notes = report["notes"].as_array().cloned().unwrap_or_default();
        notes.push(json!(note));
        report["notes"] = json!(notes);
    }
    report["layout"] = json!(built.project.name);
    report["settings"] = json!(options.build.input.settings);
    report["order_seed"] = json!(options.build.input.order);
    report["io_delay"] = json!(options.io_delay);
    let mut results = Files::from([(output::RESULTS.to_string(), format!("{report:#}\n"))]);
    if let Some(recorded) = recorded.filter(|_| !options.no_report) {
        let line = Line { io_delay: delay, ..built.project.plant.clone() };
        let page = page::html(&built.project, &built.sources, &line, &recorded, &report);
        results.insert(output::REPORT.into(), page);
    }
    output.write_results(&results, overwrite).map_err(refused)?;
    let wall = begin.elapsed().as_secs_f64();
    report["wall_s"] = json!((wall * 1000.0).round() / 1000.0);
    show(options, &output, &report, wall);
    if let Some(removed) = dropped::of_a_run(&of_last_run, &output.of_a_run())
        && options.build.input.format == Format::Text
        && !options.build.input.quiet
    {
        say!("{removed}");
    }
    Ok(match report["finished"].as_bool() {
        Some(true) => Status::Done,
        _ if report["reason"].as_str().is_some_and(|r| r.starts_with("bug: ")) => Status::Bug,
        _ => Status::NotReached,
    })
}

/// Stations that wait for orders, and a scenario that has none: it may have been meant to add to the built-in one.
fn asks_nothing(built: &Built) -> Option<String> {
    let scenario = &built.project.plant.scenario;
    let is_asked = !scenario.orders.is_empty() || matches!(scenario.goal, Goal::Collected(_));
    let system = &built.project.system;
    let mut robots = system.instances.iter().enumerate();
    let (_, station) = robots.find(|(robot, _)| system.automaton_of(*robot).device.has("orders"))?;
    (!is_asked).then(|| {
        format!(
            "the scenario has neither orders nor a goal, so {} and the other stations have nothing to do; \
             a scenario of your own adds nothing to the built-in one: write its \"orders\"",
            station.name
        )
    })
}

/// How late devices answer, as `--io-delay` says it; none if it says something else.
pub fn io_delay(text: &str) -> Option<IoDelay> {
    let random = |seed| Some(IoDelay::Random { max: 5, seed });
    match text.strip_prefix("random") {
        Some("") => random(1),
        Some(rest) => random(rest.strip_prefix(':')?.parse().ok()?),
        None => text.parse().ok().filter(|n| *n <= 1000).map(IoDelay::Fixed),
    }
}

fn notice(options: &CommissionOptions) -> Notice {
    let input = &options.build.input;
    let is_quiet = input.quiet || input.format != Format::Text;
    if is_quiet { Notice::None } else { Notice::Compiling }
}

/// Runs the scenario and writes what was asked for of it.
fn report(
    options: &CommissionOptions,
    built: &Built,
    library: &SharedLibrary,
    built_files: &Files,
    delay: IoDelay,
    files: Requested,
) -> Result<(Report, Option<Recorded>), String> {
    let system = &built.project.system;
    let mut line = built.project.plant.clone();
    line.io_delay = delay;
    let mut controllers = library.controllers(&line, &parameters_text(system))?;

    let Requested { io_trace, hashes, trajectories } = files;
    let columns = &built_files[build::COLUMNS];
    let mut io_trace = io_trace.map(|file| IoTrace::new(columns, file)).transpose()?;
    let mut hash_list = String::new();
    // A row or a line for each scan wants every scan.
    let every_scan = options.every_scan || io_trace.is_some() || hashes.is_some();
    let stepping = if every_scan { Stepping::EveryScan } else { Stepping::Events };
    let says = notice(options) == Notice::Compiling;
    let mut progress = Progress::new(says && io::stderr().is_terminal());
    let mut observe = |seen: &Seen| {
        if let Some(io_trace) = &mut io_trace {
            io_trace.take(seen);
        }
        if hashes.is_some() {
            let _ = writeln!(hash_list, "{:016x}", seen.hash);
        }
        progress.show(seen.scan * u64::from(line.scan_ms) / 1000);
    };
    let is_recorded = !options.no_report || !trajectories.is_empty();
    let (report, recorded) = match is_recorded {
        false => {
            let run = |memory: &mut _| run_again(&line, &mut controllers, stepping, memory, &mut observe);
            (remembering(&line, run)?, None)
        }
        true => {
            let watched = if options.no_report { Vec::new() } else { page::watched(system, &line) };
            let run = |memory: &mut _| {
                record_again(&line, &mut controllers, stepping, memory, &watched, &mut observe)
            };
            let recorded = remembering(&line, run)?;
            if !trajectories.is_empty() {
                trajectories.write(&built.project, &line, &recorded.paths)?;
            }
            (recorded.report.clone(), Some(recorded))
        }
    };
    progress.end();
    io_trace.map_or(Ok(()), IoTrace::end)?;
    if let Some(hashes) = hashes {
        hashes.write(&hash_list)?;
        hashes.keep()?;
    }
    Ok((report, recorded))
}

fn show(options: &CommissionOptions, output: &Output, report: &Value, wall: f64) {
    match options.build.input.format {
        Format::Json => say!("{report}"),
        Format::Text if !options.build.input.quiet => {
            say_part!("{}", text(report, wall, output));
            if !options.no_report {
                say!("report             {}", output.folder().join(output::REPORT).display());
            }
            for path in &options.trajectories.files {
                say!("trajectories       {}", path.display());
            }
        }
        Format::Text if report["finished"] != true => {
            complain!("autogen: {}", report["reason"].as_str().unwrap_or(""))
        }
        Format::Text => {}
    }
}

/// The files that the options name, where they are.
fn named(options: &CommissionOptions) -> Vec<PathBuf> {
    let single = options.io_trace.iter().chain(&options.hashes);
    let all = single.chain(&options.trajectories.files);
    all.map(|path| place(path)).collect()
}

/// Where a file is or will be, without symbolic links but for the file itself.
fn place(path: &Path) -> PathBuf {
    let absolute = path::absolute(path).unwrap_or_else(|_| path.into());
    let folder = absolute.parent().and_then(|folder| folder.canonicalize().ok());
    match (folder, absolute.file_name()) {
        (Some(folder), Some(name)) => folder.join(name),
        _ => absolute,
    }
}

/// No file is named for two things.
fn are_different(options: &CommissionOptions) -> Result<(), String> {
    let named = named(options);
    match (1..named.len()).find(|i| named[..*i].contains(&named[*i])) {
        Some(i) => Err(format!("{}: this file is named twice; choose another name", named[i].display())),
        None => Ok(()),
    }
}

/// No file is named that was read or that the build writes.
fn are_free(options: &CommissionOptions, built: &Built, built_files: &Files) -> Result<(), String> {
    let own = built_files.keys().map(String::as_str).chain([output::MANIFEST]).chain(OF_A_RUN);
    let own: Vec<PathBuf> = own.map(|name| place(&built.folder.join(name))).collect();
    let inputs = read::files();
    for path in named(options) {
        if own.contains(&path) {
            return Err(format!("{}: this is a file of the output; choose another name", path.display()));
        }
        if path.canonicalize().is_ok_and(|path| inputs.contains(&path)) {
            return Err(format!("{}: this is a file of the input; choose another name", path.display()));
        }
    }
    Ok(())
}

/// The report for people.
fn text(report: &Value, wall: f64, output: &Output) -> String {
    let number = |v: &Value| v.as_f64().unwrap_or(0.0);
    let mut out = format!("{}\n\n", report["reason"].as_str().unwrap_or("").replace("; ", "\n  "));
    let notes = report["notes"].as_array().map_or(&[][..], Vec::as_slice);
    for note in notes.iter().filter_map(Value::as_str) {
        out += &format!("note: {note}\n\n");
    }
    let is_ordered = report["orders"] != 0;
    if is_ordered {
        out += &format!("orders made        {} of {}\n", report["orders_done"], report["orders"]);
        let per_order = report["seconds_per_order"].as_f64().map_or("-".into(), |s| format!("{s:.2}"));
        out += &format!("seconds per order  {per_order}\n");
    }
    out += &format!("simulated          {:.2} s, in {wall:.2} s\n", number(&report["simulated_s"]));
    out += &format!("collisions         {}\n\n", contact::text(report));
    let empty = serde_json::Map::new();
    let robots = report["robots"].as_object().unwrap_or(&empty);
    let width = robots.keys().map(String::len).max().unwrap_or(5).max(5);
    let (moving, working, waiting, stopped) = ("moving", "working", "waiting", "stopped");
    out += &format!(
        "{:width$}  {moving:>9} {working:>9} {waiting:>9} {stopped:>9}  {:12}  waited for\n",
        "robot", "at the end"
    );
    for (name, robot) in robots {
        let seconds = |key: &str| format!("{:9.2}", number(&robot[key]));
        let owners: Vec<String> = (robot["waiting_for"].as_object().unwrap_or(&empty).iter())
            .filter(|(_, s)| number(s) > 0.0)
            .map(|(owner, _)| owner.clone())
            .collect();
        out += &format!(
            "{name:width$}  {} {} {} {}  {:12}  {}\n",
            seconds("moving_s"),
            seconds("working_s"),
            seconds("waiting_s"),
            seconds("stopped_s"),
            robot["state"].as_str().unwrap_or(""),
            owners.join(", ")
        );
    }
    let items = report["items"].as_array().cloned().unwrap_or_default();
    let mut places: std::collections::BTreeMap<String, usize> = std::collections::BTreeMap::new();
    for item in &items {
        let carrier = item["carrier"].as_str().unwrap_or("");
        let carrier = if carrier.starts_with("order ") { "orders" } else { carrier };
        *places.entry(carrier.to_string()).or_default() += 1;
    }
    let places: Vec<String> = places.iter().map(|(place, n)| format!("{n} {place}")).collect();
    out += "\n";
    if is_ordered || !items.is_empty() {
        out += &format!("items              {} ({})\n", items.len(), listed(places, ", "));
    }
    if !is_ordered && let Some(sinks) = report["sinks"].as_object() {
        let counts = |kinds: &Value| -> Vec<String> {
            let kinds = kinds.as_object().into_iter().flatten();
            kinds.map(|(kind, count)| format!("{count} {kind}")).collect()
        };
        let sinks = sinks.iter().map(|(sink, kinds)| format!("{} in {sink}", counts(kinds).join(", ")));
        out += &format!("collected          {}\n", listed(sinks.collect(), "; "));
    }
    out += &alarm::text(report);
    out += &format!("written to         {}\n", output.folder().display());
    if let Some(waits) = report["waits"].as_array() {
        out += "\nwhich machine waits for which at the end (more with `autogen why`)\n";
        waits.iter().filter_map(Value::as_str).for_each(|line| out += &format!("  {line}\n"));
    }
    out
}

/// Places that a line of the text names at most.
const MOST_LISTED: usize = 20;

/// The first ones; the results have all.
fn listed(mut parts: Vec<String>, between: &str) -> String {
    let more = parts.len().saturating_sub(MOST_LISTED);
    if more > 0 {
        parts.truncate(MOST_LISTED);
        parts.push(format!("and {more} more, in {}", output::RESULTS));
    }
    parts.join(between)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_list_ends_with_how_many_more_there_are() {
        let all = |count: usize| (1..=count).map(|number| number.to_string()).collect::<Vec<_>>();
        assert_eq!(listed(all(MOST_LISTED), ", "), all(MOST_LISTED).join(", "));
        let of_more = listed(all(MOST_LISTED + 3), "; ");
        assert_eq!(of_more, all(MOST_LISTED).join("; ") + "; and 3 more, in results.json");
    }
}
