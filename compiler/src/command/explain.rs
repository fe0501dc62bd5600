//! `autogen explain`.

use super::options::ExplainOptions;
use crate::Status;

pub fn run(options: &ExplainOptions) -> Status {
    match autogen::diagnostic::explain(&options.code.to_uppercase()) {
        Some(text) => {
            say!("{text}");
            Status::Done
        }
        None => {
            eprintln!("autogen: there is no diagnostic {}; they go by codes such as E0401", options.code);
            Status::WrongCommand
        }
    }
}
