//! Texts of a specification as comments of documentation.

use crate::plain;

/// Lines of documentation.
pub fn doc(lines: &[String]) -> String {
    let lines: Vec<String> = lines.iter().map(|line| documented(line)).collect();
    if lines.iter().all(String::is_empty) {
        return String::new();
    }
    lines.iter().map(|line| format!("/// {line}\n")).collect()
}

/// A line of text from outside as rustdoc shows it: as it stands, but no blocks of code and no tags begin in it.
pub fn documented(line: &str) -> String {
    let line = plain::line(line);
    // Code is set in, also behind the sign of a list.
    let line = line.split(' ').filter(|word| !word.is_empty()).collect::<Vec<_>>().join(" ");
    // A piece of code begins and ends on its line.
    if line.contains("```") || line.matches('`').count() % 2 == 1 {
        return escaped(&line).replace('`', "\\`");
    }
    let parts = line.split('`').enumerate();
    let parts = parts.map(|(number, part)| if number % 2 == 0 { escaped(part) } else { part.into() });
    parts.collect::<Vec<_>>().join("`")
}

/// Text without code, whose signs are not those of a tag.
fn escaped(text: &str) -> String {
    let mut out = String::with_capacity(text.len());
    let mut letters = text.chars().peekable();
    while let Some(letter) = letters.next() {
        let begins_tag = |next: &char| next.is_ascii_alphabetic() || matches!(next, '/' | '!' | '?');
        if letter == '\\' || letter == '<' && letters.peek().is_some_and(begins_tag) {
            out.push('\\');
        }
        out.push(letter);
    }
    out.replace("~~~", "\\~~~")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_begin_neither_code_nor_tags() {
        for (text, shown) in [
            ("speed [m/s] < 3, `a < b`", "speed [m/s] < 3, `a < b`"),
            ("```rust", "\\`\\`\\`rust"),
            ("- ~~~~", "- \\~~~~"),
            ("-      code {", "- code {"),
            ("a <T> and `<T>`", "a \\<T> and `<T>`"),
            ("</b>, <!-- and `", "\\</b>, \\<!-- and \\`"),
            ("a \\` <b> `", "a \\\\` <b> `"),
            ("\t  in\u{1b} ", "in\u{241b}"),
        ] {
            assert_eq!(documented(text), shown, "{text}");
        }
    }
}
