//! Tables of values, printed as `prettyplease` would lay them out, without parsing them.

/// Longest line, as that of `prettyplease`.
const WIDTH: usize = 89;

/// `head` and `tail` around the entries: on one line if they fit, else each entry on its own.
pub fn list(indent: usize, head: &str, entries: &[String], tail: &str) -> String {
    if let Some(line) = on_one_line(indent, head, entries, tail) {
        return line;
    }
    let space = " ".repeat(indent);
    let mut out = format!("{space}{head}\n");
    for entry in entries {
        out += &format!("{space}    {entry},\n");
    }
    out + &format!("{space}{tail}\n")
}

/// `head` and `tail` around short entries: on one line if they fit, else as many on each line as there is room for.
pub fn filled(indent: usize, head: &str, entries: &[&str], tail: &str) -> String {
    if let Some(line) = on_one_line(indent, head, entries, tail) {
        return line;
    }
    let space = " ".repeat(indent);
    let mut out = format!("{space}{head}");
    let mut room = 0;
    for entry in entries {
        if room < entry.len() + 2 {
            out += &format!("\n{space}   ");
            room = WIDTH - indent - 3;
        }
        out += &format!(" {entry},");
        room -= entry.len() + 2;
    }
    out + &format!("\n{space}{tail}\n")
}

/// None if it does not fit.
fn on_one_line(indent: usize, head: &str, entries: &[impl AsRef<str>], tail: &str) -> Option<String> {
    let length: usize = entries.iter().map(|entry| entry.as_ref().len() + 2).sum();
    if indent + head.len() + length.saturating_sub(2) + tail.len() > WIDTH {
        return None;
    }
    let entries: Vec<&str> = entries.iter().map(AsRef::as_ref).collect();
    Some(format!("{}{head}{}{tail}\n", " ".repeat(indent), entries.join(", ")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_list_that_fits_stands_on_one_line() {
        let entries = |count: usize| vec!["12345678".to_string(); count];
        let fits = list(4, "a: [", &entries(7), "],");
        assert_eq!(fits.lines().map(str::len).collect::<Vec<_>>(), [4 + 4 + 7 * 10 - 2 + 2]);
        let broken = list(4, "a: [", &entries(9), "],");
        assert_eq!(broken.lines().count(), 11);
        assert!(broken.starts_with("    a: [\n        12345678,\n"), "{broken}");
        assert!(broken.ends_with("        12345678,\n    ],\n"), "{broken}");
    }

    #[test]
    fn short_entries_fill_lines_up_to_the_width() {
        let filled = filled(4, "&[", &["true"; 40], "],");
        assert!(filled.lines().all(|line| line.len() <= WIDTH), "{filled}");
        assert_eq!(filled.lines().count(), 2 + 40usize.div_ceil((WIDTH - 7) / 6), "{filled}");
        assert_eq!(filled.matches("true,").count(), 40);
    }
}
