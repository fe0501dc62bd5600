//! Pieces of a specification in reports, comments and tables.

use crate::plain;

/// The words of a piece with a blank between two, without comments. A piece does not begin or end within a text in
/// quotes.
pub fn on_one_line(piece: &str) -> String {
    let words: Vec<&str> = piece.lines().map(without_comment).flat_map(str::split_whitespace).collect();
    plain::line(&words.join(" "))
}

fn without_comment(line: &str) -> &str {
    let is_quoted = |at: &usize| line[..*at].matches('"').count() % 2 == 1;
    let comment = line.match_indices("//").map(|(at, _)| at).find(|at| !is_quoted(at));
    &line[..comment.unwrap_or(line.len())]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_are_left_out_and_texts_are_not() {
        let piece = "mode > 3 // \"quoted\" *) (*\n    and not (mode < 5) // end";
        assert_eq!(on_one_line(piece), "mode > 3 and not (mode < 5)");
        let piece = "invariant x else warn \"see // http://a\" // c";
        assert_eq!(on_one_line(piece), "invariant x else warn \"see // http://a\"");
    }
}
