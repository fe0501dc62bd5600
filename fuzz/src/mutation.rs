//! Changes of a text by its tokens: what comes out is nearer to the grammar than changed bytes are.

use crate::dictionary::NUMBERS;
use autogen_tests::generate::Lot;

/// Changes made of one input at most.
const MOST_CHANGES: usize = 4;
/// No input grows beyond this, bytes.
const LONGEST: usize = 64 << 10;

/// An input from `input`, perhaps with a piece of `other`.
pub fn mutated(input: &[u8], other: &[u8], words: &[String], lot: &mut Lot) -> Vec<u8> {
    let text = String::from_utf8_lossy(input).into_owned();
    let other = String::from_utf8_lossy(other).into_owned();
    let mut tokens: Vec<&str> = tokens(&text);
    let others = self::tokens(&other);
    for _ in 0..1 + lot.below(MOST_CHANGES) {
        change(&mut tokens, &others, words, lot);
    }
    let mut bytes = tokens.concat().into_bytes();
    if lot.one_in(16) {
        noise(&mut bytes, lot);
    }
    bytes.truncate(LONGEST);
    bytes
}

fn change<'t>(tokens: &mut Vec<&'t str>, others: &[&'t str], words: &'t [String], lot: &mut Lot) {
    if tokens.is_empty() {
        tokens.extend(others.iter().chain(&[" "]).take(64));
    }
    let at = lot.below(tokens.len().max(1));
    let piece = piece(tokens, at, lot);
    match lot.below(12) {
        0 => drop(tokens.drain(piece)),
        1 => {
            let copy = tokens[piece.clone()].to_vec();
            tokens.splice(piece.start..piece.start, copy);
        }
        2 => {
            let to = lot.below(tokens.len());
            tokens.swap(at, to);
        }
        3 | 4 => tokens[at] = lot.pick(words).as_str(),
        5 => tokens.insert(at, lot.pick(words).as_str()),
        6 | 7 => {
            let number = *lot.pick::<&str>(&NUMBERS);
            replace(tokens, is_number, number, lot);
        }
        8 => {
            let name: &str = tokens[lot.below(tokens.len())];
            replace(tokens, is_word, name, lot);
        }
        9 | 10 if !others.is_empty() => {
            let from = lot.below(others.len());
            let taken = self::piece(others, from, lot);
            tokens.splice(piece, others[taken].iter().copied());
        }
        9 | 10 => tokens.truncate(at),
        _ => {
            let copy = tokens[piece.clone()].to_vec();
            let to = lot.below(tokens.len());
            tokens.splice(to..to, copy);
        }
    }
}

/// Puts a token in the place of one of a kind, if there is any.
fn replace<'t>(tokens: &mut [&'t str], is_of: fn(&str) -> bool, by: &'t str, lot: &mut Lot) {
    let places: Vec<usize> = (0..tokens.len()).filter(|i| is_of(tokens[*i])).collect();
    if !places.is_empty() {
        tokens[*lot.pick(&places)] = by;
    }
}

/// A bracketed group, the rest of a line, or some tokens.
fn piece(tokens: &[&str], at: usize, lot: &mut Lot) -> std::ops::Range<usize> {
    let few = at..(at + 1 + lot.below(4)).min(tokens.len());
    match lot.below(3) {
        0 => {
            let opens = (at..tokens.len()).find(|i| matches!(tokens[*i], "{" | "[" | "("));
            let Some(opens) = opens else { return few };
            let mut depth = 0_i32;
            for (i, token) in tokens.iter().enumerate().skip(opens) {
                match *token {
                    "{" | "[" | "(" => depth += 1,
                    "}" | "]" | ")" => depth -= 1,
                    _ => {}
                }
                if depth == 0 {
                    return opens..i + 1;
                }
            }
            few
        }
        1 => {
            let end = (at..tokens.len()).find(|i| tokens[*i].contains('\n'));
            at..end.map_or(tokens.len(), |end| end + 1)
        }
        _ => few,
    }
}

fn is_number(token: &str) -> bool {
    token.starts_with(|c: char| c.is_ascii_digit())
}

fn is_word(token: &str) -> bool {
    token.starts_with(|c: char| c.is_ascii_alphabetic() || c == '"')
}

/// Words, numbers, quoted texts, white space and signs; together they are the text.
fn tokens(text: &str) -> Vec<&str> {
    let mut tokens = Vec::new();
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let word = |c: char| c.is_ascii_alphanumeric() || c == '_';
        let length = match c {
            '"' => {
                let end = rest[1..].find(['"', '\n']).map_or(rest.len(), |n| n + 1);
                if rest[end..].starts_with('"') { end + 1 } else { end }
            }
            c if c.is_ascii_digit() => rest.find(|c| !(word(c) || c == '.')).unwrap_or(rest.len()),
            c if word(c) => rest.find(|c| !word(c)).unwrap_or(rest.len()),
            c if c.is_whitespace() => rest.find(|c: char| !c.is_whitespace()).unwrap_or(rest.len()),
            c => match [":=", "+=", "-=", "->", "..", "<>", "<=", ">=", "--"]
                .iter()
                .find(|s| rest.starts_with(**s))
            {
                Some(sign) => sign.len(),
                None => c.len_utf8(),
            },
        };
        tokens.push(&rest[..length]);
        rest = &rest[length..];
    }
    tokens
}

/// Some bytes that mean nothing.
fn noise(bytes: &mut Vec<u8>, lot: &mut Lot) {
    const BYTES: [&[u8]; 12] = [
        b"\0",
        b"\xff",
        b"\xc3",
        b"\xef\xbb\xbf",
        "é".as_bytes(),
        "😀".as_bytes(),
        b"\r",
        b"\x1b[31m",
        b"\"",
        b"\\",
        "\u{202e}".as_bytes(),
        b"\x7f",
    ];
    for _ in 0..1 + lot.below(3) {
        let at = lot.below(bytes.len() + 1);
        bytes.splice(at..at, lot.pick(&BYTES).iter().copied());
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tokens_are_the_text() {
        let text = "{\"a b\": [1.5, -2e3], x := y_1 -> é \"open\n // z";
        assert_eq!(tokens(text).concat(), text);
        assert!(tokens(text).contains(&"\"a b\""));
    }

    #[test]
    fn the_same_lot_gives_the_same_input() {
        let words = ["when".to_string()];
        let inputs = |seed| {
            let mut lot = Lot::new(seed);
            (0..50).map(|_| mutated(b"a { b := 1; }", b"[2]", &words, &mut lot)).collect::<Vec<_>>()
        };
        assert_eq!(inputs(1), inputs(1));
        assert_ne!(inputs(1), inputs(2));
    }
}
