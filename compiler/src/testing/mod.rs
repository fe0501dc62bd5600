//! Tests that a user writes beside the specifications: an automaton alone against a table of inputs and of what has
//! to come of them, and a line with what has to come of its run. `docs/tools.md` has the language.

mod apart;
mod bench;
mod line;
mod machine;
mod read;
mod structured_text;
mod value;

pub use apart::is_for_any_engine;
pub use line::{Watched, judge};
pub use machine::{Engine, Played, play};
pub use read::read;
pub use structured_text::{Emitted, StructuredText};
pub use value::instance;

use crate::source::{Span, Spanned};

/// A file of tests.
#[derive(Clone, Debug, Default)]
pub struct File {
    pub set: Setup,
    pub tests: Vec<Test>,
}

/// What a line is compiled from; names of files begin at the folder of the test file.
#[derive(Clone, Debug, Default)]
pub struct Setup {
    pub layout: Option<Spanned<String>>,
    pub scenario: Option<Spanned<String>>,
    pub settings: Vec<Spanned<String>>,
}

#[derive(Clone, Debug)]
pub struct Test {
    pub title: Spanned<String>,
    /// It stands above that of the file.
    pub set: Setup,
    pub body: Body,
}

#[derive(Clone, Debug)]
pub enum Body {
    /// One machine of the layout; the test plays its device and the other machines.
    Machine {
        name: Spanned<String>,
        rows: Vec<Row>,
    },
    Line(Vec<Expect>),
}

/// A row of a table.
#[derive(Clone, Debug)]
pub struct Row {
    pub span: Span,
    pub time: Time,
    pub given: Vec<Given>,
    pub expected: Vec<Expected>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Time {
    /// ms since the line was started.
    At(i64),
    /// ms since the row before.
    After(i64),
    /// At the first scan, at most so many ms after the row before, in which all that is expected holds.
    Within(i64),
    /// Scans since the line was started.
    Scan(i64),
}

#[derive(Clone, Debug)]
pub enum Given {
    Value(Path, Literal),
    /// The device answers the last command: it has ended successfully, or with this error.
    Answer(Span, i32),
    /// The controller loses its power before the scan, and has it again.
    PowerOff,
}

#[derive(Clone, Debug)]
pub enum Expected {
    State(Spanned<String>),
    Value(Path, Literal),
    /// With this in its text.
    Fault(Span, Option<String>),
    /// One that is active or not acknowledged, with this in its text.
    Alarm(Option<String>),
    NoAlarm,
}

/// `slot[3]`, `agv1.held`
#[derive(Clone, Debug)]
pub struct Path {
    pub span: Span,
    pub machine: Option<String>,
    pub name: String,
    pub index: Option<Literal>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Literal {
    pub span: Span,
    pub kind: LiteralKind,
}

#[derive(Clone, Debug, PartialEq)]
pub enum LiteralKind {
    Number(f64),
    /// ms
    Duration(i64),
    /// `true`, a member of an enumeration, a machine.
    Word(String),
    Point([f64; 3]),
}

/// What has to come of a run.
#[derive(Clone, Debug)]
pub struct Expect {
    pub span: Span,
    pub what: What,
}

#[derive(Clone, Debug)]
pub enum What {
    Finished(bool),
    /// A part of the reason with which the run ends.
    Reason(String),
    Figure(Figure, Comparison, f64),
    /// The machine is in the state at some time, before so many ms if that is said.
    Reaches {
        machine: Spanned<String>,
        state: Spanned<String>,
        before_ms: Option<i64>,
    },
    Never {
        machine: Spanned<String>,
        state: Spanned<String>,
    },
    /// An alarm that was raised.
    Alarm {
        text: Option<String>,
        machine: Option<Spanned<String>>,
    },
    Fault {
        text: Option<String>,
        machine: Option<Spanned<String>>,
    },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Figure {
    Orders,
    SecondsPerOrder,
    Simulated,
    /// Pairs that touched, those too that may.
    Contacts,
    /// How often alarms were raised.
    Alarms,
    /// The one that ended the run, and those before it.
    Faults,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    Equal,
    NotEqual,
    Less,
    LessEqual,
    Greater,
    GreaterEqual,
}

/// Why a test failed: what happened before, with its times, and what was expected instead.
#[derive(Clone, Debug, PartialEq)]
pub struct Failure {
    pub place: Span,
    pub at_ms: Option<u64>,
    /// What happened, with its time in ms, the last events.
    pub events: Vec<(u64, String)>,
    pub expected: Vec<String>,
    pub found: Vec<String>,
}

fn seconds(ms: u64) -> String {
    format!("{:8.3} s", ms as f64 / 1000.0)
}

impl Failure {
    /// On a time line: what happened, then what was expected, marked with `-`, and what was found, with `+`.
    pub fn text(&self) -> String {
        let mut out = String::new();
        for (ms, text) in &self.events {
            out += &format!("    {}  {text}\n", seconds(*ms));
        }
        let time = self.at_ms.map_or(" ".repeat(10), seconds);
        for (sign, lines) in [('-', &self.expected), ('+', &self.found)] {
            lines.iter().for_each(|line| out += &format!("  {sign} {time}  {line}\n"));
        }
        out
    }
}
