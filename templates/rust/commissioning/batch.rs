//! Many runs, one after another, in one process.
//!
//! A request is a line with the lengths, in bytes, of two texts, then the two: the line and its parameters.
//! The answer is a line: `report` and the report as JSON, or `refused` and why there was no run.
//! When the standard input ends the process ends too, in the midst of a run if need be: who asked is gone.

use crate::deployed::Deployed;
use runtime_sim::line::Line;
use runtime_sim::run::run;
use std::io::{self, BufRead, Read, Write};
use std::sync::mpsc::{SyncSender, sync_channel};
use std::{process, thread};

struct Request {
    line: String,
    parameters: String,
}

/// Answers requests until there are no more.
pub fn batch() -> Result<(), String> {
    let (give, take) = sync_channel(0);
    thread::spawn(move || match requests(&give) {
        Ok(()) => process::exit(0),
        Err(error) => {
            eprintln!("commissioning: {error}");
            process::exit(1)
        }
    });
    for request in take {
        let answer = match answer(&request) {
            Ok(report) => format!("report {report}"),
            Err(text) => format!("refused {text}"),
        };
        let mut out = io::stdout().lock();
        writeln!(out, "{answer}").and_then(|()| out.flush()).map_err(|e| e.to_string())?;
    }
    Ok(())
}

fn answer(request: &Request) -> Result<String, String> {
    let line = Line::from_text(&request.line)?;
    let mut deployed = Deployed::read(&request.parameters)?.of(&line)?;
    Ok(run(&line, &mut deployed, &mut |_| {})?.to_json())
}

/// Hands on what is asked for, until the input ends.
fn requests(give: &SyncSender<Request>) -> io::Result<()> {
    let mut input = io::stdin().lock();
    let mut head = String::new();
    loop {
        head.clear();
        if input.read_line(&mut head)? == 0 {
            return Ok(());
        }
        let lengths: Vec<u64> = head.split_whitespace().filter_map(|word| word.parse().ok()).collect();
        let [line, parameters] = lengths[..] else {
            return Err(io::Error::other("a request begins with two lengths"));
        };
        let mut text = |length: u64| {
            let mut text = String::new();
            input.by_ref().take(length).read_to_string(&mut text).map(|_| text)
        };
        let request = Request { line: text(line)?, parameters: text(parameters)? };
        if give.send(request).is_err() {
            return Ok(());
        }
    }
}
