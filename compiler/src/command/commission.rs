//! `autogen commission`: the generated controllers, linked with the simulator, run the scenario.

use super::build::{self, Built};
use super::options::{CommissionOptions, Format};
use super::trajectories::Request;
use super::write;
use crate::Status;
use runtime_sim::line::IoDelay;
use serde_json::{Value, json};
use std::io::{IsTerminal, Read};
use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Instant;
use std::{env, fs, io};

pub fn run(options: &CommissionOptions) -> Status {
    let begin = Instant::now();
    let delay = match io_delay(&options.io_delay) {
        Some(delay) => delay,
        None => return fail(options, "--io-delay takes a number of scans, `random` or `random:SEED`".into()),
    };
    let trajectories = match Request::new(options) {
        Ok(request) => request,
        Err(text) => return fail(options, text),
    };
    let built = match build::build(&options.build) {
        Ok(built) => built,
        Err(status) => return status,
    };
    match commission(options, &built, delay, &trajectories) {
        Ok(mut report) => {
            name_fault(&mut report, &built);
            let status = match report["finished"].as_bool() {
                Some(true) => Status::Done,
                _ if report["reason"].as_str().is_some_and(|r| r.starts_with("bug: ")) => Status::Bug,
                _ => Status::NotReached,
            };
            show(options, &built, report, begin);
            status
        }
        Err(text) => fail(options, text),
    }
}

/// Adds to a fault what and where it is in the text: the simulator knows its number only.
fn name_fault(report: &mut Value, built: &Built) {
    let Some(code) = report["fault"]["code"].as_u64().filter(|code| *code > 0) else { return };
    let Some(site) = built.project.system.model.faults.get(code as usize - 1) else { return };
    let place =
        format!("{}:{}", built.sources.file(site.place.file).name, built.sources.position(site.place).0);
    let robot = report["fault"]["robot"].as_str().unwrap_or("").to_string();
    let state = report["robots"][&robot]["state"].as_str().unwrap_or("").to_string();
    report["reason"] = json!(format!("fault {code} of {robot}, in state {state}: {} ({place})", site.text));
    report["fault"]["text"] = json!(site.text);
    report["fault"]["place"] = json!(place);
    report["fault"]["state"] = json!(state);
}

fn fail(options: &CommissionOptions, text: String) -> Status {
    match options.build.input.format {
        Format::Json => say!("{}", json!({ "finished": false, "reason": text, "diagnostics": [] })),
        Format::Text => eprintln!("autogen: {text}"),
    }
    Status::WrongCommand
}

fn io_delay(text: &str) -> Option<IoDelay> {
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
    trajectories: &Request,
) -> Result<Value, String> {
    trajectories.check(&built.project.plant)?;
    let program = program(options, built)?;
    let mut line = built.project.plant.clone();
    line.io_delay = delay;
    let folder = env::temp_dir().join(format!("autogen-{}", std::process::id()));
    let io = |e: io::Error| format!("{}: {e}", folder.display());
    fs::create_dir_all(&folder).map_err(io)?;
    fs::write(folder.join("line.txt"), line.to_text()).map_err(io)?;
    let mut command = Command::new(&program);
    command.arg(folder.join("line.txt")).arg(built.folder.join("rust/commissioning/data/parameters.txt"));
    if let Some(path) = &options.hashes {
        command.arg("--hashes").arg(path);
    }
    trajectories.ask(&mut command, &folder);
    if is_chatty(options) {
        command.arg("--progress");
    }
    let result = simulate(command).and_then(|report| {
        trajectories.write(built, &folder)?;
        Ok(report)
    });
    let _ = fs::remove_dir_all(&folder);
    result
}

/// What the linked simulation reports.
fn simulate(mut command: Command) -> Result<Value, String> {
    let output = command.stderr(Stdio::inherit()).output();
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

/// The program in which controllers and simulator are linked. It depends on the types and the kinds of
/// part only, so it is compiled once for all layouts that have the same ones.
fn program(options: &CommissionOptions, built: &Built) -> Result<PathBuf, String> {
    let sources: write::Files = (built.files.iter())
        .filter_map(|(name, text)| Some((name.strip_prefix("rust/")?.to_string(), text.clone())))
        .filter(|(name, _)| !name.starts_with("controllers/src/robots") && !name.contains("/data/"))
        .collect();
    let key = write::hash(
        &sources
            .iter()
            .filter(|(n, _)| !is_of_layout(n))
            .map(|(n, t)| format!("{n}\n{t}\n"))
            .collect::<String>(),
    );
    let folder = cache().join(&key[..16]);
    let program = folder.join("commissioning").with_extension(env::consts::EXE_EXTENSION);
    if program.is_file() {
        return Ok(program);
    }
    let workspace = built.folder.join("rust");
    if !options.build.input.quiet && options.build.input.format == Format::Text {
        eprintln!("compiling the controllers and the simulator (once for these types) ...");
    }
    // Of this process alone: another one may be compiling the same.
    let target = folder.join(format!("target-{}", std::process::id()));
    let result = Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .args(["build", "--release", "--quiet", "-p", "commissioning", "--manifest-path"])
        .arg(workspace.join("Cargo.toml"))
        .arg("--target-dir")
        .arg(&target)
        .stdout(Stdio::null())
        .stderr(Stdio::piped())
        .spawn();
    let mut child = result
        .map_err(|e| format!("cargo cannot be started, and the controllers need it to be compiled: {e}"))?;
    let mut errors = String::new();
    if let Some(mut stderr) = child.stderr.take() {
        let _ = stderr.read_to_string(&mut errors);
    }
    let status = child.wait().map_err(|e| e.to_string())?;
    if !status.success() {
        return Err(format!("the controllers could not be compiled:\n{errors}"));
    }
    let made = target.join("release").join("commissioning").with_extension(env::consts::EXE_EXTENSION);
    fs::rename(&made, &program).map_err(|e| format!("{}: {e}", made.display()))?;
    let _ = fs::remove_dir_all(&target);
    Ok(program)
}

/// Files in which only the layout is written; the program reads its data at run time.
fn is_of_layout(name: &str) -> bool {
    name.starts_with("controllers/src/robots") || name == "controllers/src/line.rs" || name.contains("/data/")
}

/// Where compiled programs are kept: the user's cache.
fn cache() -> PathBuf {
    let set = |name: &str| env::var_os(name).filter(|value| !value.is_empty()).map(PathBuf::from);
    let base = set("XDG_CACHE_HOME").or_else(|| Some(set("HOME")?.join(".cache")));
    base.unwrap_or_else(env::temp_dir).join("autogen")
}

fn show(options: &CommissionOptions, built: &Built, mut report: Value, begin: Instant) {
    let wall = begin.elapsed().as_secs_f64();
    report["wall_s"] = json!((wall * 1000.0).round() / 1000.0);
    report["layout"] = json!(built.project.name);
    report["settings"] = json!(options.build.input.settings);
    report["order_seed"] = json!(options.build.input.order);
    report["io_delay"] = json!(options.io_delay);
    let path = built.folder.join(build::RESULTS);
    let mut kept = report.clone();
    if let Some(object) = kept.as_object_mut() {
        object.remove("wall_s");
    }
    let _ = fs::write(path, format!("{kept:#}\n"));
    match options.build.input.format {
        Format::Json => say!("{report}"),
        Format::Text if !options.build.input.quiet => {
            say_part!("{}", text(&report, wall, built));
            for path in &options.trajectories.files {
                say!("trajectories       {}", path.display());
            }
        }
        Format::Text if report["finished"] != true => {
            eprintln!("autogen: {}", report["reason"].as_str().unwrap_or(""))
        }
        Format::Text => {}
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
    out += &format!("collisions         {}\n\n", report["collisions"].as_str().unwrap_or(""));
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
