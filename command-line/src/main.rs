//! The program `autogen`.

use std::process::ExitCode;

fn main() -> ExitCode {
    autogen_command_line::run()
}
