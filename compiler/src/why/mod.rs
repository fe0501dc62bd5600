//! Why machines are at rest: what each of them waits for at a time of a run, and who waits for whom.
//!
//! A run of the reference executor is watched. At the time that is asked for, every guard of the present state of
//! each machine is taken apart: [`Picture`].

mod chain;
mod guard;
mod property;
mod reads;
mod report;
mod text;
mod until;
mod watch;
mod writers;

pub use chain::Waits;
pub use report::{chain_of, chains, empty_sources, later, machine};
pub use until::{Became, How, Later, Left};
pub use watch::Watch;

use crate::ir::Severity;
use crate::source::Span;

/// What all machines wait for at a time, in the order of their steps.
#[derive(Clone, Debug)]
pub struct Picture {
    pub at_ms: u64,
    /// The system runs: otherwise no transition is tested.
    pub is_running: bool,
    /// In which the line stands.
    pub fault: Option<Fault>,
    /// Machines whose source has no more parts, and since when, ms.
    pub empty: Vec<(usize, u64)>,
    pub machines: Vec<Machine>,
}

#[derive(Clone, Debug)]
pub struct Fault {
    pub machine: usize,
    pub at_ms: u64,
    pub text: String,
}

#[derive(Clone, Debug)]
pub struct Machine {
    pub name: String,
    pub state: String,
    /// Time in its state, ms.
    pub stay_ms: u64,
    pub is_final: bool,
    /// By an alarm or at its panel: it makes no steps.
    pub is_stopped: bool,
    /// What has to be done at its panel before it steps: nothing if it is enabled and in automatic, or has no panel.
    pub at_panel: Vec<&'static str>,
    /// Those of its properties that are violated or wait.
    pub properties: Vec<Promise>,
    /// Those of its state, in the order in which they are tested; none of a machine that is stopped.
    pub transitions: Vec<Tested>,
    /// What would have to change before one of them fires.
    pub awaits: Vec<Await>,
}

/// A transition as it would be tested next.
#[derive(Clone, Debug)]
pub struct Tested {
    /// `when all_loaded`
    pub title: String,
    pub target: Option<String>,
    pub place: Span,
    pub holds: bool,
    pub clauses: Vec<Node>,
}

/// A property of which there is something to say.
#[derive(Clone, Debug)]
pub struct Promise {
    /// `invariant not is_open`
    pub text: String,
    /// What its violation tells the operator.
    pub told: String,
    pub place: Span,
    pub standing: Standing,
    pub clauses: Vec<Node>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Standing {
    /// The line stands, since this time.
    Fault { at_ms: u64 },
    /// Its alarm is active or not acknowledged.
    Alarm { severity: Severity, raised_ms: u64, active: bool, acknowledged: bool },
    /// A `whenever` whose goal is awaited. It is violated if it does not hold by then, the line running all the time.
    Waits { since_ms: u64, until_ms: u64 },
}

/// A part of a guard.
#[derive(Clone, Debug)]
pub struct Node {
    pub text: String,
    pub verdict: Verdict,
    /// What decides it, if it has no parts.
    pub reads: Vec<Read>,
    pub parts: Vec<Node>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// It is as it has to be for the guard to hold.
    Holds,
    Fails,
    /// It is about a variable that no clause before it has bound.
    NotTested,
}

/// A value that is read.
#[derive(Clone, Debug, PartialEq)]
pub struct Read {
    /// `agv2.held`, `slot[3]`
    pub name: String,
    pub value: String,
    /// What the automaton has set, of an output at which another value is put out.
    pub set: Option<String>,
    /// What has changed it last; none: it is as it was at the beginning.
    pub changed: Option<Changed>,
    /// Who may change it as it is now.
    pub writers: Vec<String>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Changed {
    pub at_ms: u64,
    /// A machine, or its device.
    pub by: String,
}

#[derive(Clone, Debug, PartialEq)]
pub enum Await {
    /// That this machine, by its number, changes what was read.
    Machine(usize, Read),
    /// That the device ends a command.
    Command { text: String },
    /// That time passes; and whether that is enough for a guard to hold, as all else is now.
    Time { text: String, left_ms: u64, suffices: bool },
    /// That the device changes an input.
    Input(Read),
    /// That the machine itself changes a cell, which it does in other states.
    Own(Read),
}
