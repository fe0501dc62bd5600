//! The linked program, kept running for one point after another.

use serde_json::Value;
use std::io::{self, BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

/// Bytes of parameters after which a process is replaced: what it has read of layouts lives as long as it does.
const MOST_READ: usize = 1 << 20;

/// Runs points in a process of its own, which is started when it is needed and again if it has died.
#[derive(Default)]
pub struct Runner {
    process: Option<Process>,
}

impl Runner {
    /// The report of a run, or why there is none.
    pub fn run(&mut self, program: &Path, line: &str, parameters: &str) -> Result<Value, String> {
        if self.process.as_ref().is_some_and(|p| p.program != program || p.read > MOST_READ) {
            self.process = None;
        }
        let mut process = match self.process.take() {
            Some(process) => process,
            None => Process::start(program).map_err(|e| format!("{}: {e}", program.display()))?,
        };
        let answer = match process.ask(line, parameters) {
            Ok(answer) => answer,
            Err(error) => return Err(process.died(&error)),
        };
        self.process = Some(process);
        match answer.trim_end().split_once(' ') {
            Some(("report", json)) => {
                serde_json::from_str(json).map_err(|e| format!("the linked simulation did not report: {e}"))
            }
            Some(("refused", text)) => Err(format!("the linked simulation did not run: {text}")),
            _ => Err("the linked simulation did not answer".into()),
        }
    }
}

struct Process {
    program: PathBuf,
    child: Child,
    requests: ChildStdin,
    answers: BufReader<ChildStdout>,
    /// Bytes of parameters.
    read: usize,
}

impl Process {
    fn start(program: &Path) -> io::Result<Self> {
        let mut child =
            Command::new(program).arg("--batch").stdin(Stdio::piped()).stdout(Stdio::piped()).spawn()?;
        let missing = || io::Error::other("the process has no pipes");
        let requests = child.stdin.take().ok_or_else(missing)?;
        let answers = BufReader::new(child.stdout.take().ok_or_else(missing)?);
        Ok(Self { program: program.into(), child, requests, answers, read: 0 })
    }

    fn ask(&mut self, line: &str, parameters: &str) -> io::Result<String> {
        self.read += parameters.len();
        let request = format!("{} {}\n{line}{parameters}", line.len(), parameters.len());
        self.requests.write_all(request.as_bytes())?;
        self.requests.flush()?;
        let mut answer = String::new();
        self.answers.read_line(&mut answer)?;
        match answer.ends_with('\n') {
            true => Ok(answer),
            false => Err(io::ErrorKind::UnexpectedEof.into()),
        }
    }

    fn died(mut self, error: &io::Error) -> String {
        match self.child.wait() {
            Ok(status) => format!("the linked simulation ended during this run: {status}"),
            Err(_) => format!("the linked simulation ended during this run: {error}"),
        }
    }
}

impl Drop for Process {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
