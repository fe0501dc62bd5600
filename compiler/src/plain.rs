//! Which text from outside may be in what is written and shown: text that reads as it runs.
//!
//! Controls move the cursor of a terminal and are no XML; marks of direction and separators of lines let a text
//! read otherwise than a compiler takes it. Each is shown by a sign in its place.

use std::borrow::Cow;

/// Whether a character does nothing but stand where it is.
fn is_plain(c: char) -> bool {
    let turns =
        matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let breaks = matches!(c, '\u{2028}' | '\u{2029}');
    let is_no_character = matches!(c, '\u{fdd0}'..='\u{fdef}') || c as u32 & 0xfffe == 0xfffe;
    !(c.is_control() || turns || breaks || is_no_character)
}

/// What is shown for a character that is not plain.
fn sign(c: char) -> char {
    match c {
        '\0'..='\u{1f}' => char::from_u32(0x2400 + c as u32).unwrap_or(char::REPLACEMENT_CHARACTER),
        '\u{7f}' => '\u{2421}',
        _ => char::REPLACEMENT_CHARACTER,
    }
}

fn replaced(text: &str, keeps: fn(char) -> bool) -> Cow<'_, str> {
    match text.chars().all(|c| is_plain(c) || keeps(c)) {
        true => Cow::Borrowed(text),
        false => text.chars().map(|c| if is_plain(c) || keeps(c) { c } else { sign(c) }).collect(),
    }
}

/// As it may be in a comment, a title or a name: on one line. White space of any kind is a blank.
pub fn line(text: &str) -> String {
    on_a_line(text).into_owned()
}

/// The same as [`line`], which most texts are already.
pub fn on_a_line(text: &str) -> Cow<'_, str> {
    if text.bytes().all(|byte| (b' '..=b'~').contains(&byte)) {
        return Cow::Borrowed(text);
    }
    text.chars()
        .map(|c| match c {
            c if c.is_whitespace() => ' ',
            c if is_plain(c) => c,
            c => sign(c),
        })
        .collect()
}

/// As it may be in a report, line breaks and tabs included.
pub fn lines(text: &str) -> Cow<'_, str> {
    replaced(text, |c| c == '\n' || c == '\t')
}

/// With only those characters replaced of which the rendering of diagnostics does not take care itself.
pub(crate) fn excerpt(text: &str) -> Cow<'_, str> {
    replaced(text, |c| c.is_ascii())
}

/// As it may be in XML, in attributes too, if its characters may.
pub fn xml(text: &str) -> String {
    if !text.contains(['&', '<', '>', '"']) {
        return text.to_string();
    }
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

/// As it may be on a terminal, line breaks and tabs included, each character that is not plain as an escape of
/// JSON. The texts of JSON keep their value by it.
pub fn escaped(text: &str) -> Cow<'_, str> {
    let keeps = |c: char| is_plain(c) || c == '\n' || c == '\t';
    if text.chars().all(keeps) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len());
    let mut units = [0; 2];
    for c in text.chars() {
        match keeps(c) {
            true => out.push(c),
            false => out.extend(c.encode_utf16(&mut units).iter().map(|unit| format!("\\u{unit:04x}"))),
        }
    }
    Cow::Owned(out)
}

/// Bytes of a message; what is longer nobody reads.
const LONGEST: usize = 2000;

/// The beginning of a text that is too long to be read.
pub(crate) fn shortened(mut text: String) -> String {
    if text.len() > LONGEST {
        text.truncate(boundary(&text, LONGEST));
        text.push_str(" ...");
    }
    text
}

/// The place itself, or the beginning of the character in which it lies.
pub(crate) fn boundary(text: &str, place: usize) -> usize {
    let mut place = place.min(text.len());
    while !text.is_char_boundary(place) {
        place -= 1;
    }
    place
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One of each kind that is not plain.
    const ODD: [(char, char); 14] = [
        ('\u{1b}', '\u{241b}'),
        ('\0', '\u{2400}'),
        ('\u{8}', '\u{2408}'),
        ('\u{7f}', '\u{2421}'),
        ('\u{9b}', '\u{fffd}'),
        ('\u{61c}', '\u{fffd}'),
        ('\u{200e}', '\u{fffd}'),
        ('\u{200f}', '\u{fffd}'),
        ('\u{202e}', '\u{fffd}'),
        ('\u{2069}', '\u{fffd}'),
        ('\u{fffe}', '\u{fffd}'),
        ('\u{ffff}', '\u{fffd}'),
        ('\u{1fffe}', '\u{fffd}'),
        ('\u{fdd0}', '\u{fffd}'),
    ];

    #[test]
    fn what_is_not_plain_is_shown_by_a_sign() {
        for (c, sign) in ODD {
            assert_eq!(line(&format!("a{c}b")), format!("a{sign}b"), "{c:?}");
            assert_eq!(lines(&format!("a{c}b\n")), format!("a{sign}b\n"), "{c:?}");
        }
        for c in ['\t', '\r', '\n', '\u{85}', '\u{2028}', '\u{2029}', '\u{a0}'] {
            assert_eq!(line(&format!("a{c}b")), "a b", "{c:?}");
        }
        let plain = "caf\u{e9} \u{2014} \u{65e5}\u{672c} \u{1f600} (* <&>\" -- ]]>";
        assert_eq!(line(plain), plain);
        assert_eq!(lines(plain), plain);
    }

    #[test]
    fn json_keeps_its_value() {
        let odd: String = ODD.iter().map(|(c, _)| *c).chain(['\u{2028}', '\u{e9}', '"', '\n']).collect();
        let text = escaped(&serde_json::to_string(&odd).expect("a text")).into_owned();
        assert_eq!(lines(&text), text.as_str());
        assert_eq!(serde_json::from_str::<String>(&text).expect("JSON"), odd);
    }
}
