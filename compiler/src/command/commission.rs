//! `autogen commission`: the generated controllers, linked with the simulator, run the scenario.

use super::build::{self, Built};
use super::contact;
use super::fault;
use super::interrupt::{self, Temporary};
use super::options::{CommissionOptions, Format};
use super::pending::{Content, Pending};
use super::program::{self, Notice};
use super::trajectories::Request;
use super::write;
use crate::Status;
use runtime_sim::line::{IoDelay, Line};
use serde_json::{Value, json};
use std::io::IsTerminal;
use std::path::{self, Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;
use std::{env, fs, io};

pub fn run(options: &CommissionOptions) -> Status {
    let begin = Instant::now();
    let delay = match io_delay(&options.io_delay) {
        Some(delay) => delay,
        None => return fail(options, "--io-delay takes a number of scans, `random` or `random:SEED`".into()),
    };
    let overwrite = options.build.overwrite();
    let pending = |path: &Option<PathBuf>, content: Content| {
        path.as_ref().map(|path| Pending::new(path, content, overwrite)).transpose()
    };
    if let Err(text) = are_different(options) {
        return fail(options, text);
    }
    let io_trace = match pending(&options.io_trace, Content::IoTrace) {
        Ok(io_trace) => io_trace,
        Err(text) => return fail(options, text),
    };
    let hashes = match pending(&options.hashes, Content::Hashes) {
        Ok(hashes) => hashes,
        Err(text) => return fail(options, text),
    };
    let trajectories = match Request::new(options) {
        Ok(request) => request,
        Err(text) => return fail(options, text),
    };
    let built = match build::build(&options.build) {
        Ok(built) => built,
        Err(status) => return status,
    };
    let results = match are_free(options, &built)
        .and_then(|()| Pending::new(&built.folder.join(build::RESULTS), Content::Results, overwrite))
    {
        Ok(results) => results,
        Err(text) => return fail(options, text),
    };
    match commission(options, &built, delay, [io_trace, hashes], trajectories) {
        Ok(mut report) => {
            fault::name(&mut report, &built.project.system, &built.sources);
            contact::name_reasons(&mut report, &built.project.may_touch);
            let status = match report["finished"].as_bool() {
                Some(true) => Status::Done,
                _ if report["reason"].as_str().is_some_and(|r| r.starts_with("bug: ")) => Status::Bug,
                _ => Status::NotReached,
            };
            match show(options, &built, results, report, begin) {
                Ok(()) => status,
                Err(text) => fail(options, text),
            }
        }
        Err(text) => fail(options, text),
    }
}

fn fail(options: &CommissionOptions, text: String) -> Status {
    match options.build.input.format {
        Format::Json => say!("{}", json!({ "finished": false, "reason": text, "diagnostics": [] })),
        Format::Text => complain!("autogen: {text}"),
    }
    Status::WrongCommand
}

/// How late devices answer, as `--io-delay` says it.
pub fn io_delay(text: &str) -> Option<IoDelay> {
    let random = |seed| Some(IoDelay::Random { max: 5, seed });
    match text.strip_prefix("random") {
        Some("") => random(1),
        Some(rest) => random(rest.strip_prefix(':')?.parse().ok()?),
        None => text.parse().ok().filter(|n| *n <= 1000).map(IoDelay::Fixed),
    }
}

fn commission(
    options: &CommissionOptions,
    built: &Built,
    delay: IoDelay,
    [io_trace, hashes]: [Option<Pending>; 2],
    trajectories: Request,
) -> Result<Value, String> {
    trajectories.check(&built.project.plant)?;
    let input = &options.build.input;
    let notice = match input.format {
        Format::Text if !input.quiet => Notice::Compiling,
        _ => Notice::None,
    };
    let program = program::linked(&built.project.system, &built.sources, notice)?;
    let mut line = built.project.plant.clone();
    line.io_delay = delay;
    let temporary = Temporary::new(env::temp_dir().join(format!("autogen-{}", std::process::id())));
    let folder = temporary.path();
    put_line(folder, &line).map_err(|e| format!("{}: {e}", folder.display()))?;
    let mut command = Command::new(&program);
    let data = built.folder.join("rust/commissioning/data");
    command.arg(folder.join("line.txt")).arg(data.join("parameters.txt"));
    if let Some(io_trace) = &io_trace {
        command.arg("--io-trace").arg(data.join("columns.txt")).arg(io_trace.partial());
    }
    if let Some(hashes) = &hashes {
        command.arg("--hashes").arg(hashes.partial());
    }
    trajectories.ask(&mut command, folder);
    if is_chatty(options) {
        command.arg("--progress");
    }
    let result = simulate(command).and_then(|report| {
        trajectories.write(&built.project, folder)?;
        Ok(report)
    });
    if result.is_ok() {
        io_trace.into_iter().chain(hashes).try_for_each(Pending::keep)?;
    }
    result
}

fn put_line(folder: &Path, line: &Line) -> io::Result<()> {
    let _writing = interrupt::writing();
    fs::create_dir_all(folder)?;
    fs::write(folder.join("line.txt"), line.to_text())
}

/// What the linked simulation reports.
fn simulate(mut command: Command) -> Result<Value, String> {
    command.arg("--attended").stdin(Stdio::piped()).stdout(Stdio::piped());
    let output = interrupt::output(&mut command);
    let output = output.map_err(|e| format!("{}: {e}", command.get_program().display()))?;
    if !output.status.success() {
        return Err(format!("the linked simulation did not run: {}", output.status));
    }
    serde_json::from_slice(&output.stdout).map_err(|e| format!("the linked simulation did not report: {e}"))
}

fn is_chatty(options: &CommissionOptions) -> bool {
    let input = &options.build.input;
    !input.quiet && input.format == Format::Text && io::stderr().is_terminal()
}

fn show(
    options: &CommissionOptions,
    built: &Built,
    results: Pending,
    mut report: Value,
    begin: Instant,
) -> Result<(), String> {
    let wall = begin.elapsed().as_secs_f64();
    report["wall_s"] = json!((wall * 1000.0).round() / 1000.0);
    report["layout"] = json!(built.project.name);
    report["settings"] = json!(options.build.input.settings);
    report["order_seed"] = json!(options.build.input.order);
    report["io_delay"] = json!(options.io_delay);
    let mut kept = report.clone();
    if let Some(object) = kept.as_object_mut() {
        object.remove("wall_s");
    }
    let failed = |e: io::Error| format!("{}: {e}", results.path().display());
    fs::write(results.partial(), format!("{kept:#}\n")).map_err(failed)?;
    results.keep()?;
    match options.build.input.format {
        Format::Json => say!("{report}"),
        Format::Text if !options.build.input.quiet => {
            say_part!("{}", text(&report, wall, built));
            for path in &options.trajectories.files {
                say!("trajectories       {}", path.display());
            }
        }
        Format::Text if report["finished"] != true => {
            complain!("autogen: {}", report["reason"].as_str().unwrap_or(""))
        }
        Format::Text => {}
    }
    Ok(())
}

/// The files that the options name, where they are.
fn named(options: &CommissionOptions) -> Vec<PathBuf> {
    let single = options.io_trace.iter().chain(&options.hashes);
    let all = single.chain(&options.trajectories.files);
    all.map(|path| path::absolute(path).unwrap_or_else(|_| path.clone())).collect()
}

/// No file is named for two things.
fn are_different(options: &CommissionOptions) -> Result<(), String> {
    let named = named(options);
    match (1..named.len()).find(|i| named[..*i].contains(&named[*i])) {
        Some(i) => Err(format!("{}: this file is named twice; choose another name", named[i].display())),
        None => Ok(()),
    }
}

/// No file is named that the build has written.
fn are_free(options: &CommissionOptions, built: &Built) -> Result<(), String> {
    let own = built.files.keys().map(String::as_str).chain([write::MANIFEST, build::RESULTS]);
    let folder = path::absolute(&built.folder).unwrap_or_else(|_| built.folder.clone());
    let own: Vec<PathBuf> = own.map(|name| folder.join(name)).collect();
    match named(options).into_iter().find(|path| own.contains(path)) {
        Some(path) => Err(format!("{}: this is a file of the output; choose another name", path.display())),
        None => Ok(()),
    }
}

/// The report for people.
fn text(report: &Value, wall: f64, built: &Built) -> String {
    let number = |v: &Value| v.as_f64().unwrap_or(0.0);
    let mut out = format!("{}\n\n", report["reason"].as_str().unwrap_or("").replace("; ", "\n  "));
    out += &format!("orders made        {} of {}\n", report["orders_done"], report["orders"]);
    let per_order = report["seconds_per_order"].as_f64().map_or("-".into(), |s| format!("{s:.2}"));
    out += &format!("seconds per order  {per_order}\n");
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
    out += &format!("\nitems              {} ({})\n", items.len(), places.join(", "));
    out += &format!("written to         {}\n", built.folder.display());
    out
}
