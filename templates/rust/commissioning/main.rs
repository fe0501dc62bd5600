//! Runs the controllers against the simulator, and prints the report as JSON.
//!
//! `commissioning LINE PARAMETERS [--hashes FILE] [--progress]`: both are texts that autogen wrote.
//! `commissioning --batch`: one run after another, asked for on the standard input (see [`batch`]).
//! `commissioning --replay PARAMETERS`: no simulator. Each line of the standard input holds a scan:
//! `run_permit start reset`, then the inputs of all robots, the number of each robot's words before them.
//! Answered with a line of the bits, in hexadecimal, of the system's outputs, the published outputs and the
//! trace; all that is no number reads `nan`.

use commissioning::batch::batch;
use commissioning::deployed::Deployed;
use commissioning::replay::replay;
use runtime_sim::line::Line;
use runtime_sim::run::{Seen, run};
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

fn start(arguments: &[String]) -> Result<(), String> {
    let mut files = Vec::new();
    let mut hashes = None;
    let (mut progress, mut replays, mut batches) = (false, false, false);
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.as_str() {
            "--hashes" => hashes = Some(rest.next().ok_or("`--hashes` wants a file")?),
            "--progress" => progress = true,
            "--replay" => replays = true,
            "--batch" => batches = true,
            _ => files.push(argument),
        }
    }
    if batches {
        return batch();
    }
    match (files.as_slice(), replays) {
        ([parameters], true) => replay(&mut Deployed::read(&text(parameters)?)?),
        ([line, parameters], false) => {
            let line = Line::from_text(&text(line)?)?;
            let deployed = Deployed::read(&text(parameters)?)?.of(&line)?;
            simulate(&line, deployed, hashes, progress)
        }
        _ => Err("wants LINE PARAMETERS [--hashes FILE] [--progress], --batch, or --replay PARAMETERS".into()),
    }
}

fn text(path: &str) -> Result<String, String> {
    fs::read_to_string(path).map_err(|e| format!("{path}: {e}"))
}

fn simulate(line: &Line, mut deployed: Deployed, hashes: Option<&String>, progress: bool) -> Result<(), String> {
    let mut kept = String::new();
    let mut shown = 0;
    let mut observe = |seen: &Seen| {
        if hashes.is_some() {
            let _ = writeln!(kept, "{:016x}", seen.hash);
        }
        let seconds = seen.scan * u64::from(line.scan_ms) / 1000;
        if progress && seconds >= shown + 10 {
            shown = seconds;
            eprint!("\r{seconds} s");
        }
    };
    let report = run(line, &mut deployed, &mut observe)?;
    if progress {
        eprintln!();
    }
    if let Some(path) = hashes {
        fs::write(path, kept).map_err(|e| format!("{path}: {e}"))?;
    }
    println!("{}", report.to_json());
    Ok(())
}
