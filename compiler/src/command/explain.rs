//! `autogen explain`.

use super::options::ExplainOptions;
use crate::Status;

pub fn run(options: &ExplainOptions) -> Status {
    let text = code(&options.code).and_then(|code| autogen::diagnostic::explain(&code));
    match text {
        Some(text) => {
            say!("{text}");
            Status::Done
        }
        None => {
            complain!(
                "autogen: there is no diagnostic {}; diagnostics have codes such as E0401",
                options.code
            );
            Status::WrongCommand
        }
    }
}

/// A code with its four digits, however it is typed: `e401` and `401` are E0401.
fn code(typed: &str) -> Option<String> {
    let digits = typed.trim().trim_start_matches(['E', 'e']);
    Some(format!("E{:04}", digits.parse::<u16>().ok()?))
}
