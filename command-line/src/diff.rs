//! Differences of two texts, short enough to be read.

use similar::{Algorithm, TextDiff};
use std::time::Duration;

/// Lines that are shown of one difference.
const MOST_LINES: usize = 20;
/// Letters that are shown of a line.
const MOST_LETTERS: usize = 200;
/// A longer search gives a coarser difference.
const LONGEST: Duration = Duration::from_millis(500);

/// The lines that differ with one around them, `-` those of `old` and `+` those of `new`; the first ones, if there
/// are many.
pub fn short(old: &str, new: &str) -> String {
    let diff = TextDiff::configure().algorithm(Algorithm::Myers).timeout(LONGEST).diff_lines(old, new);
    let text = diff.unified_diff().context_radius(1).missing_newline_hint(false).to_string();
    let lines: Vec<&str> = text.lines().collect();
    let mut shown = String::new();
    for line in lines.iter().take(MOST_LINES) {
        shown.extend(line.chars().take(MOST_LETTERS));
        shown.push('\n');
    }
    match lines.len().saturating_sub(MOST_LINES) {
        0 => shown,
        more => shown + &format!("... {more} more lines\n"),
    }
}
