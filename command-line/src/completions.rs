//! `autogen completions`.

use super::options::{Cli, CompletionsOptions};
use crate::Status;
use clap::CommandFactory;

pub fn run(options: &CompletionsOptions) -> Status {
    let mut text = Vec::new();
    clap_complete::generate(options.shell, &mut Cli::command(), "autogen", &mut text);
    say_part!("{}", String::from_utf8_lossy(&text));
    Status::Done
}
