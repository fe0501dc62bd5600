//! Words that can stand only behind certain other words of the language.

use super::words::{Word, as_word, of_language};
use crate::spec::lexer::Token;

/// Nothing where the words before the place do not decide. `depth` is the number of braces that are open.
pub fn behind(item: &str, depth: usize, statement: &[Token]) -> Option<Vec<Word>> {
    let words: Vec<&str> = statement.iter().map(|token| as_word(token).unwrap_or_default()).collect();
    let next: &[&str] = match (item, depth, words.as_slice()) {
        ("automaton", 0, [.., "accepts" | "offers"]) => &["at"],
        ("automaton", 1, ["any" | "final" | "resume"] | ["initial", "resume" | "final"]) => &["state"],
        ("automaton", 1, ["initial"]) => &["->", "state", "resume state", "final state"],
        ("automaton", 1, ["any", "state"]) => &["except"],
        ("automaton", 1, ["takes"]) => &["from"],
        ("automaton", 1, ["hands"]) => &["to"],
        ("automaton" | "interface", 1, ["answer"]) => &["within"],
        ("automaton" | "interface", 1, ["shared", .., "by"]) => {
            &["owner", "handshake", "lock", "counter", "token"]
        }
        ("automaton" | "interface", 1, ["shared", .., "by", _]) => &[],
        ("automaton" | "interface", 1, [promise, .., "else", "stop"]) if is_promise(promise) => {
            &["machine", "line"]
        }
        ("automaton" | "interface", 1, [promise, .., "else"]) if is_promise(promise) => &["stop", "warn"],
        ("device" | "assembly", 1, ["out", _, _, "bool", .., "stop"]) => &["true", "false"],
        ("device" | "assembly", 1, ["out", .., "stop"]) => &[],
        _ => return None,
    };
    Some(of_language(next))
}

fn is_promise(word: &str) -> bool {
    ["invariant", "keep", "whenever", "answer"].contains(&word)
}
