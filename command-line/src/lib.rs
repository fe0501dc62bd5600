//! The command line, one module for each command and what they share; the only place that reads and writes files.
//!
//! The program is [`run`]. All else that is public reads options, for who tests it with texts.

// A reader that has gone must not end the program: `say!` and `complain!` write.
#![deny(clippy::print_stderr, clippy::print_stdout)]

/// A line on standard output.
macro_rules! say {
    ($($text:tt)*) => { $crate::print::out(format_args!("{}\n", format_args!($($text)*))) };
}

/// Text on standard output.
macro_rules! say_part {
    ($($text:tt)*) => { $crate::print::out(format_args!($($text)*)) };
}

/// A line on standard error.
macro_rules! complain {
    ($($text:tt)*) => { $crate::print::err(&format!("{}\n", format_args!($($text)*))) };
}

mod alarm;
mod build;
mod cache;
mod check;
mod commission;
mod compare;
mod completions;
mod contact;
mod controllers;
mod copies;
mod diff;
mod differences;
mod dropped;
mod explain;
mod fault;
mod fmt;
mod graph;
mod import;
mod interrupt;
mod io_error;
mod io_trace;
mod load;
mod lock;
mod lsp;
mod named;
mod new;
mod options;
mod output;
mod pending;
mod print;
mod progress;
mod read;
mod remembered;
mod results;
mod schema;
mod sweep;
mod test;
mod titles;
mod trajectories;
mod verify;
mod why;

pub use commission::io_delay;
/// The definition of the command line. Comments on its types and fields are the texts of `--help`.
pub use options::{Cli, Command, InputOptions, SweepOptions};
pub use sweep::axis::Axis;
pub use sweep::measured::{Beside, Measured};
pub use trajectories::milliseconds;
pub use why::scan;

use clap::Parser;
use std::process::ExitCode;

/// What a command came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Status {
    Done = 0,
    /// The input has errors; an infeasible layout is one.
    WrongInput = 1,
    /// The command line or a file it names cannot be used.
    WrongCommand = 2,
    /// The run did not reach its goal.
    NotReached = 3,
    /// A limit of time or memory came first.
    Undecided = 4,
    /// A bug in autogen.
    Bug = 70,
}

/// Does what the arguments of the process ask for; what it returns is the exit status of the program.
pub fn run() -> ExitCode {
    std::panic::set_hook(Box::new(|panic| {
        complain!("autogen: this is a bug in autogen, not in your input: {panic}");
        complain!("Please report it with the layout and the specifications that show it.");
    }));
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) if error.use_stderr() => {
            print::err(&error.render().to_string());
            return ExitCode::from(Status::WrongCommand as u8);
        }
        Err(help) => help.exit(),
    };
    interrupt::install();
    let status = std::panic::catch_unwind(|| match &cli.command {
        Command::New(options) => new::run(options),
        Command::Check(options) => check::run(options),
        Command::Build(options) => build::run(options),
        Command::Commission(options) => commission::run(options),
        Command::Sweep(options) => sweep::run(options),
        Command::Merge(options) => sweep::merge::run(options),
        Command::Verify(options) => verify::run(options),
        Command::Graph(options) => graph::run(options),
        Command::Explain(options) => explain::run(options),
        Command::Why(options) => why::run(options),
        Command::Compare(options) => compare::run(options),
        Command::Test(options) => test::run(options),
        Command::Import(options) => import::run(options),
        Command::Fmt(options) => fmt::run(options),
        Command::Schema(options) => schema::run(options),
        Command::Completions(options) => completions::run(options),
        Command::Lsp(_) => lsp::run(),
    });
    ExitCode::from(status.unwrap_or(Status::Bug) as u8)
}
