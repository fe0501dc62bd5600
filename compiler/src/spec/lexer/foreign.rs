//! Words and literals of Structured Text: reported, and read as what is meant.

use super::Token;
use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// Words of Structured Text that are the same in the language, but in small letters. They cannot be names.
pub const CAPITALS: [(&str, &str); 6] =
    [("AND", "and"), ("FALSE", "false"), ("MOD", "mod"), ("NOT", "not"), ("OR", "or"), ("TRUE", "true")];

/// Words that stand behind a number for a unit of time, with the unit that is meant and its number in one of them.
const UNITS: [(&[&str], f64, &str); 4] = [
    (&["msec", "millis", "milliseconds", "MS", "Ms", "mS"], 1.0, "ms"),
    (&["sec", "secs", "second", "seconds", "S", "Sec", "SEC"], 1.0, "s"),
    (&["mins", "minute", "minutes", "MIN", "Min"], 1.0, "min"),
    (&["h", "H", "hr", "hrs", "hour", "hours"], 60.0, "min"),
];

/// How many of which unit a word behind a number means; none if it is no unit of time.
pub fn unit(word: &str) -> Option<(f64, &'static str)> {
    let of = UNITS.iter().find(|(words, ..)| words.contains(&word));
    of.map(|(_, number, unit)| (*number, *unit))
}

/// What is written instead of a word of other languages that begins a declaration or a block.
const WORDS: [(&str, &str); 8] = [
    ("const", "parameter"),
    ("input", "in"),
    ("output", "out"),
    ("step", "state"),
    ("var", "local"),
    ("variable", "local"),
    ("var_input", "in"),
    ("var_output", "out"),
];

/// Of these the one that is meant by a word of other languages.
pub fn meant_among<'a>(word: &str, words: &[&'a str]) -> Option<&'a str> {
    let (_, meant) = WORDS.iter().find(|(foreign, _)| word.eq_ignore_ascii_case(foreign))?;
    words.iter().copied().find(|word| word == meant)
}

/// Whether an address such as `%IX0.3` or `%Q4` begins here.
pub fn is_address(rest: &str) -> bool {
    let Some(behind) = rest.strip_prefix(['%']).and_then(|rest| rest.strip_prefix(['I', 'Q', 'M'])) else {
        return false;
    };
    behind.strip_prefix(['X', 'B', 'W', 'D']).unwrap_or(behind).starts_with(|c: char| c.is_ascii_digit())
}

/// What does the work of a function block of Structured Text.
pub fn function_block(name: &str) -> Option<&'static str> {
    match name.to_ascii_uppercase().as_str() {
        "TON" | "TOF" | "TP" => Some("a time in a state is `after 3 s`: `when after 3 s -> Next {}`"),
        "R_TRIG" | "F_TRIG" => {
            Some("an edge is two states: one waits for `not pressed`, the next one for `pressed`")
        }
        "CTU" | "CTD" | "CTUD" => {
            Some("a counter is a variable: `local n: int 0..100 := 0;`, and `n += 1;` in a transition")
        }
        "SR" | "RS" => Some("a state remembers; so does a variable: `local is_full: bool := false;`"),
        _ => None,
    }
}

/// The word that is meant.
pub fn word<'a>(word: &'a str, span: Span, diagnostics: &mut Vec<Diagnostic>) -> &'a str {
    let Some((_, meant)) = CAPITALS.iter().find(|(foreign, _)| *foreign == word) else { return word };
    diagnostics.push(
        Diagnostic::new("E0201", span, format!("`{word}` is written in small letters"))
            .help(format!("write `{meant}`")),
    );
    meant
}

/// Length of what stands behind `T`, such as `#1m30s`.
pub fn literal_length(rest: &str) -> usize {
    rest[1..].find(|c: char| !c.is_ascii_alphanumeric() && c != '_' && c != '.').map_or(rest.len(), |n| n + 1)
}

/// The tokens of a duration that is written as `T#3s` or `TIME#1m30s`.
pub fn duration(text: &str, span: Span, diagnostics: &mut Vec<Diagnostic>) -> Vec<(Token, Span)> {
    let written = text.split_once('#').map_or("", |(_, written)| written);
    let meant = meant(written);
    let help = match &meant {
        Some((number, unit)) => format!("write `{number} {unit}`"),
        None => "write a number and `ms`, `s` or `min`, such as `3 s`".into(),
    };
    diagnostics
        .push(Diagnostic::new("E0201", span, format!("a duration is not written as `{text}`")).help(help));
    let (number, unit) = meant.unwrap_or((0.0, "s"));
    vec![(Token::Real(number), span), (Token::Word(unit.into()), span)]
}

/// `3s` is 3 s, `1m30s` is 90 s; none if it is no duration.
fn meant(written: &str) -> Option<(f64, &'static str)> {
    let lower = written.to_lowercase().replace('_', "");
    let mut rest = lower.as_str();
    let mut parts = Vec::new();
    while !rest.is_empty() {
        let digits = rest.find(|c: char| !c.is_ascii_digit() && c != '.')?;
        let number: f64 = rest[..digits].parse().ok()?;
        let units = &rest[digits..];
        let length = units.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(units.len());
        parts.push(match &units[..length] {
            "ms" => (number, "ms", 1.0),
            "s" => (number, "s", 1000.0),
            "m" => (number, "min", 60_000.0),
            "h" => (number * 60.0, "min", 60_000.0),
            "d" => (number * 1440.0, "min", 60_000.0),
            _ => return None,
        });
        rest = &units[length..];
    }
    if let [(number, unit, _)] = parts[..] {
        return Some((number, unit));
    }
    let whole: f64 = parts.iter().map(|(number, _, factor)| number * factor).sum();
    match (parts.is_empty(), whole % 1000.0 == 0.0) {
        (true, _) => None,
        (_, true) => Some((whole / 1000.0, "s")),
        (_, false) => Some((whole, "ms")),
    }
}

#[cfg(test)]
mod tests {
    use super::{meant, unit};

    #[test]
    fn units_of_time_that_are_written_otherwise() {
        assert_eq!(unit("sec"), Some((1.0, "s")));
        assert_eq!(unit("h"), Some((60.0, "min")));
        for other in ["s", "ms", "min", "mod", "m"] {
            assert_eq!(unit(other), None, "{other}");
        }
    }

    #[test]
    fn durations_of_structured_text() {
        assert_eq!(meant("3s"), Some((3.0, "s")));
        assert_eq!(meant("500MS"), Some((500.0, "ms")));
        assert_eq!(meant("1.5s"), Some((1.5, "s")));
        assert_eq!(meant("2m"), Some((2.0, "min")));
        assert_eq!(meant("2h"), Some((120.0, "min")));
        assert_eq!(meant("1m30s"), Some((90.0, "s")));
        assert_eq!(meant("1m_30s_5ms"), Some((90_005.0, "ms")));
        for wrong in ["", "3", "s", "3x", "1.2.3s", "3us"] {
            assert_eq!(meant(wrong), None, "{wrong}");
        }
    }
}
