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

/// A code with its four digits, however it is typed: `e401` and `401` are E0401, `w201` is W0201.
fn code(typed: &str) -> Option<String> {
    let typed = typed.trim().to_uppercase();
    let (letter, digits) = match typed.strip_prefix('W') {
        Some(digits) => ('W', digits),
        None => ('E', typed.trim_start_matches('E')),
    };
    Some(format!("{letter}{:04}", digits.parse::<u16>().ok()?))
}
