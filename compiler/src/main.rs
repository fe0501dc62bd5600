//! The command line; the only place that reads and writes files.

// A reader that has gone must not end the program: `say!` and `complain!` write.
#![deny(clippy::print_stderr, clippy::print_stdout)]

#[macro_use]
mod command;

use clap::Parser;
use command::options::{Cli, Command};
use std::process::ExitCode;

/// What a command came to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Status {
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

fn main() -> ExitCode {
    std::panic::set_hook(Box::new(|panic| {
        complain!("autogen: this is a bug in autogen, not in your input: {panic}");
        complain!("Please report it with the layout and the specifications that show it.");
    }));
    let cli = match Cli::try_parse() {
        Ok(cli) => cli,
        Err(error) if error.use_stderr() => {
            command::print::err(&error.render().to_string());
            return ExitCode::from(Status::WrongCommand as u8);
        }
        Err(help) => help.exit(),
    };
    command::interrupt::install();
    let status = std::panic::catch_unwind(|| match &cli.command {
        Command::New(options) => command::new::run(options),
        Command::Check(options) => command::check::run(options),
        Command::Build(options) => command::build::run(options),
        Command::Commission(options) => command::commission::run(options),
        Command::Sweep(options) => command::sweep::run(options),
        Command::Merge(options) => command::sweep::merge::run(options),
        Command::Verify(options) => command::verify::run(options),
        Command::Graph(options) => command::graph::run(options),
        Command::Explain(options) => command::explain::run(options),
        Command::Why(options) => command::why::run(options),
        Command::Compare(options) => command::compare::run(options),
        Command::Test(options) => command::test::run(options),
        Command::Import(options) => command::import::run(options),
        Command::Fmt(options) => command::fmt::run(options),
        Command::Schema(options) => command::schema::run(options),
        Command::Completions(options) => command::completions::run(options),
        Command::Lsp(_) => command::lsp::run(),
    });
    ExitCode::from(status.unwrap_or(Status::Bug) as u8)
}
