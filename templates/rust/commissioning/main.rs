//! Runs the controllers against the simulator, and prints the report as JSON.
//!
//! `commissioning LINE PARAMETERS [--hashes FILE] [--io-trace COLUMNS FILE]`: LINE, PARAMETERS and
//! COLUMNS are texts that autogen wrote. The I/O trace is written during the run.
//! `commissioning --replay PARAMETERS`: no simulator. Each line of the standard input is a scan:
//! `run_permit start reset`, then the inputs of all robots, the number of each robot's words before them.
//! The answer is a line of the bits, in hexadecimal, of the system's outputs, the published outputs and the
//! trace; a value that is not a number is `nan`.

use commissioning::deployed::Deployed;
use commissioning::replay::replay;
use runtime_sim::io_trace::Columns;
use runtime_sim::line::Line;
use runtime_sim::run::{Seen, Stepping, run};
use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, BufWriter, Write as _};
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
    let (mut hashes, mut io_trace) = (None, None);
    let mut replays = false;
    let mut rest = arguments.iter();
    while let Some(argument) = rest.next() {
        match argument.as_str() {
            "--hashes" => hashes = Some(rest.next().ok_or("`--hashes` needs a file")?),
            "--io-trace" => {
                let columns = rest.next().ok_or("`--io-trace` needs two files")?;
                let path = rest.next().ok_or("`--io-trace` needs two files")?;
                io_trace = Some(IoTrace::new(&text(columns)?, path)?);
            }
            "--replay" => replays = true,
            _ => files.push(argument),
        }
    }
    match (files.as_slice(), replays) {
        ([parameters], true) => replay(&mut Deployed::read(&text(parameters)?)?),
        ([line, parameters], false) => {
            let line = Line::from_text(&text(line)?)?;
            let deployed = Deployed::read(&text(parameters)?)?.of(&line)?;
            simulate(&line, deployed, hashes, io_trace)
        }
        _ => Err("usage: LINE PARAMETERS [--hashes FILE] [--io-trace COLUMNS FILE], or --replay PARAMETERS".into()),
    }
}

fn text(path: &str) -> Result<String, String> {
    fs::read_to_string(path).map_err(|e| format!("{path}: {e}"))
}

/// The file with a row for each scan.
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

    /// After an error no more rows are written.
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
) -> Result<(), String> {
    let mut kept = String::new();
    // A row or a line for each scan needs every scan.
    let stepping = match hashes.is_some() || io_trace.is_some() {
        true => Stepping::EveryScan,
        false => Stepping::Events,
    };
    let mut observe = |seen: &Seen| {
        if hashes.is_some() {
            let _ = writeln!(kept, "{:016x}", seen.hash);
        }
        if let Some(io_trace) = &mut io_trace {
            io_trace.take(seen);
        }
    };
    let report = run(line, &mut deployed, stepping, &mut observe)?;
    if let Some(path) = hashes {
        fs::write(path, kept).map_err(|e| format!("{path}: {e}"))?;
    }
    if let Some(io_trace) = io_trace {
        io_trace.end()?;
    }
    println!("{}", report.to_json());
    Ok(())
}
