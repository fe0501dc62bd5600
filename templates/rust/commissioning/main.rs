//! Runs the controllers against the simulator, and prints the report as JSON.
//!
//! `commissioning LINE PARAMETERS [OPTION...]`: both are texts that autogen wrote.
//! `--hashes FILE`: the hash of each scan's trace, a line each. `--progress`: seconds on standard error.
//! `--segments FILE`: the paths of the items as JSON. `--table FILE MS`: these paths sampled every MS milliseconds,
//! as comma-separated values; it may be given several times. `--items A,B`: the paths of these items only.
//! `commissioning --replay PARAMETERS`: no simulator. Each line of the standard input holds a scan:
//! `run_permit start reset`, then the inputs of all robots, the number of each robot's words before them.
//! Answered with a line of the bits, in hexadecimal, of the system's outputs, the published outputs and the
//! trace; all that is no number reads `nan`.

use commissioning::deployed::Deployed;
use commissioning::replay::replay;
use runtime_sim::item;
use runtime_sim::line::Line;
use runtime_sim::path::{Path, segments_json, table_csv};
use runtime_sim::run::{Seen, record, run};
use std::fmt::Write as _;
use std::process::ExitCode;
use std::{env, fs};

fn main() -> ExitCode {
    match start(&env::args().skip(1).collect::<Vec<_>>()) {
        Ok(()) => ExitCode::SUCCESS,
        Err(text) => {
            eprintln!("commissioning: {text}");
            ExitCode::FAILURE
        }
    }
}

#[derive(Default)]
struct Options {
    hashes: Option<String>,
    progress: bool,
    replays: bool,
    segments: Option<String>,
    /// Files and milliseconds.
    tables: Vec<(String, u64)>,
    items: Option<String>,
}

fn start(arguments: &[String]) -> Result<(), String> {
    let mut files = Vec::new();
    let mut options = Options::default();
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        let mut value = || rest.next().cloned().ok_or_else(|| format!("`{argument}` wants a value"));
        match argument.as_str() {
            "--hashes" => options.hashes = Some(value()?),
            "--progress" => options.progress = true,
            "--replay" => options.replays = true,
            "--segments" => options.segments = Some(value()?),
            "--table" => {
                let file = value()?;
                let every = value()?.parse().map_err(|e| format!("`--table` wants milliseconds: {e}"))?;
                options.tables.push((file, every));
            }
            "--items" => options.items = Some(value()?),
            _ => files.push(argument),
        }
    }
    match (files.as_slice(), options.replays) {
        ([parameters], true) => replay(&mut Deployed::read(&text(parameters)?)?),
        ([line, parameters], false) => {
            let line = Line::from_text(&text(line)?)?;
            let deployed = Deployed::read(&text(parameters)?)?;
            simulate(&line, deployed, &options)
        }
        _ => Err("wants LINE PARAMETERS [OPTION...], or --replay PARAMETERS".into()),
    }
}

fn text(path: &str) -> Result<String, String> {
    fs::read_to_string(path).map_err(|e| format!("{path}: {e}"))
}

fn write(path: &str, text: &str) -> Result<(), String> {
    fs::write(path, text).map_err(|e| format!("{path}: {e}"))
}

fn simulate(line: &Line, mut deployed: Deployed, options: &Options) -> Result<(), String> {
    if deployed.robots() != line.machines.len() {
        return Err(format!("{} robots for {} machines", deployed.robots(), line.machines.len()));
    }
    let items = chosen(line, options.items.as_deref())?;
    let mut kept = String::new();
    let mut shown = 0;
    let mut observe = |seen: &Seen| {
        if options.hashes.is_some() {
            let _ = writeln!(kept, "{:016x}", seen.hash);
        }
        let seconds = seen.scan * u64::from(line.scan_ms) / 1000;
        if options.progress && seconds >= shown + 10 {
            shown = seconds;
            eprint!("\r{seconds} s");
        }
    };
    let report = if options.segments.is_some() || !options.tables.is_empty() {
        let (report, paths) = record(line, &mut deployed, &mut observe)?;
        write_paths(line, &paths, &items, options)?;
        report
    } else {
        run(line, &mut deployed, &mut observe)?
    };
    if options.progress {
        eprintln!();
    }
    if let Some(path) = &options.hashes {
        write(path, &kept)?;
    }
    println!("{}", report.to_json());
    Ok(())
}

/// Numbers of the items whose names these are, or of all.
fn chosen(line: &Line, names: Option<&str>) -> Result<Vec<usize>, String> {
    let all = item::names(line);
    let Some(names) = names else { return Ok((0..all.len()).collect()) };
    let find = |name: &str| {
        all.iter().position(|known| known == name).ok_or_else(|| format!("there is no item `{name}`"))
    };
    names.split(',').map(find).collect()
}

fn write_paths(line: &Line, paths: &[Path], items: &[usize], options: &Options) -> Result<(), String> {
    if let Some(file) = &options.segments {
        write(file, &segments_json(line, paths, items))?;
    }
    for (file, every_ms) in &options.tables {
        write(file, &table_csv(line, paths, items, *every_ms))?;
    }
    Ok(())
}
