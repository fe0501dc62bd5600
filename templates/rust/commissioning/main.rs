//! Runs the controllers against the simulator, and prints the report as JSON.
//!
//! `commissioning LINE PARAMETERS [--hashes FILE] [--io-trace COLUMNS FILE] [--progress]`: LINE, PARAMETERS and
//! COLUMNS are texts that autogen wrote. The I/O trace is written while the run goes on.
//! `--segments FILE` writes the paths of the items as JSON, `--table FILE MS` as values sampled every MS
//! milliseconds; `--items A,B` those of these items only.
//! `--attended`: the run ends when the standard input does; who asked for it is gone.
//! `commissioning --batch`: one run after another, asked for on the standard input (see [`batch`]).
//! `commissioning --replay PARAMETERS`: no simulator. Each line of the standard input holds a scan:
//! `run_permit start reset`, then the inputs of all robots, the number of each robot's words before them.
//! Answered with a line of the bits, in hexadecimal, of the system's outputs, the published outputs and the
//! trace; all that is no number reads `nan`.

use commissioning::batch::batch;
use commissioning::deployed::Deployed;
use commissioning::replay::replay;
use commissioning::trajectories::Trajectories;
use runtime_sim::io_trace::Columns;
use runtime_sim::line::Line;
use runtime_sim::run::{Seen, record, run};
use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Write as _};
use std::process::ExitCode;
use std::{env, fs, process, thread};

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
    let (mut hashes, mut io_trace) = (None, None);
    let (mut progress, mut replays, mut batches) = (false, false, false);
    let mut trajectories = Trajectories::default();
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.as_str() {
            "--hashes" => hashes = Some(rest.next().ok_or("`--hashes` wants a file")?),
            "--io-trace" => {
                let columns = rest.next().ok_or("`--io-trace` wants two files")?;
                let path = rest.next().ok_or("`--io-trace` wants two files")?;
                io_trace = Some(IoTrace::new(&text(columns)?, path)?);
            }
            "--attended" => end_with_input(),
            "--progress" => progress = true,
            "--replay" => replays = true,
            "--batch" => batches = true,
            option if trajectories.take(option, &mut rest)? => {}
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
            simulate(&line, deployed, hashes, io_trace, &trajectories, progress)
        }
        _ => Err("wants LINE PARAMETERS [--hashes FILE] [--io-trace COLUMNS FILE] [--segments FILE] [--table FILE MS] [--items NAMES] [--progress] [--attended], --batch, or --replay PARAMETERS".into()),
    }
}

fn end_with_input() {
    thread::spawn(|| {
        let _ = io::copy(&mut io::stdin().lock(), &mut io::sink());
        process::exit(1)
    });
}

fn text(path: &str) -> Result<String, String> {
    fs::read_to_string(path).map_err(|e| format!("{path}: {e}"))
}

/// The file that takes a row for each scan.
struct IoTrace {
    columns: Columns,
    path: String,
    file: BufWriter<File>,
    row: String,
    written: io::Result<()>,
}

impl IoTrace {
    fn new(columns: &str, path: &str) -> Result<Self, String> {
        let columns = Columns::from_text(columns)?;
        let file = File::create(path).map_err(|e| format!("{path}: {e}"))?;
        let mut file = BufWriter::new(file);
        let written = file.write_all(columns.header().as_bytes());
        Ok(Self { columns, path: path.into(), file, row: String::new(), written })
    }

    /// After an error nothing more is written.
    fn take(&mut self, seen: &Seen) {
        if self.written.is_ok() {
            self.row.clear();
            self.columns.row(seen, &mut self.row);
            self.written = self.file.write_all(self.row.as_bytes());
        }
    }

    fn end(mut self) -> Result<(), String> {
        self.written.and_then(|()| self.file.flush()).map_err(|e| format!("{}: {e}", self.path))
    }
}

fn simulate(
    line: &Line,
    mut deployed: Deployed,
    hashes: Option<&String>,
    mut io_trace: Option<IoTrace>,
    trajectories: &Trajectories,
    progress: bool,
) -> Result<(), String> {
    let mut kept = String::new();
    let mut shown = 0;
    let mut observe = |seen: &Seen| {
        if hashes.is_some() {
            let _ = writeln!(kept, "{:016x}", seen.hash);
        }
        if let Some(io_trace) = &mut io_trace {
            io_trace.take(seen);
        }
        let seconds = seen.scan * u64::from(line.scan_ms) / 1000;
        if progress && seconds >= shown + 10 {
            shown = seconds;
            eprint!("\r{seconds} s");
        }
    };
    let report = if trajectories.are_wanted() {
        let (report, paths) = record(line, &mut deployed, &mut observe)?;
        trajectories.write(line, &paths)?;
        report
    } else {
        run(line, &mut deployed, &mut observe)?
    };
    if progress {
        eprintln!();
    }
    if let Some(path) = hashes {
        fs::write(path, kept).map_err(|e| format!("{path}: {e}"))?;
    }
    if let Some(io_trace) = io_trace {
        io_trace.end()?;
    }
    println!("{}", report.to_json());
    Ok(())
}
