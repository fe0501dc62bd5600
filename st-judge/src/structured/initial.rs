//! Values of arrays and structures in declarations, which the grammar does not take.

use std::collections::VecDeque;

#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Single(String),
    List(Vec<Value>),
    Fields(Vec<(String, Value)>),
}

/// The text with blanks for the values of lists of globals, and these by the places of their `:=`.
pub fn taken_out(text: &str) -> (String, Vec<(usize, Value)>) {
    let mut out = text.to_string();
    let mut found = Vec::new();
    if !text.contains("VAR_GLOBAL") {
        return (out, found);
    }
    let mut from = 0;
    while let Some(at) = out[from..].find(":= ").map(|at| from + at) {
        from = at + 2;
        let behind = out[from..].trim_start();
        let Some(end) = out[from..].find(';').map(|end| from + end) else { break };
        if !behind.starts_with(['[', '(']) || out[at..end].contains("*)") {
            continue;
        }
        let mut tokens = tokens(&out[from..end]);
        let Some(value) = value(&mut tokens).filter(|_| tokens.is_empty()) else { continue };
        found.push((at, value));
        let blank = out[at..end].chars().map(|c| if c == '\n' { '\n' } else { ' ' }).collect::<String>();
        out.replace_range(at..end, &blank);
    }
    (out, found)
}

fn tokens(text: &str) -> VecDeque<String> {
    let mut tokens = VecDeque::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let is_word = |c: char| c.is_ascii_alphanumeric() || "_.+-#".contains(c);
        let end = match is_word(first) {
            true => rest.find(|c| !is_word(c)).unwrap_or(rest.len()),
            false if rest.starts_with(":=") => 2,
            false => first.len_utf8(),
        };
        tokens.push_back(rest[..end].to_string());
        rest = rest[end..].trim_start();
    }
    tokens
}

fn value(tokens: &mut VecDeque<String>) -> Option<Value> {
    let first = tokens.pop_front()?;
    match first.as_str() {
        "[" => {
            let mut values = Vec::new();
            loop {
                let is_repeated = tokens.get(1).is_some_and(|token| token == "(");
                let times = match is_repeated {
                    true => {
                        let times = tokens.pop_front()?.parse::<usize>().ok()?;
                        tokens.pop_front();
                        times
                    }
                    false => 1,
                };
                let single = value(tokens)?;
                if is_repeated && tokens.pop_front()? != ")" {
                    return None;
                }
                values.extend(std::iter::repeat_n(single, times));
                match tokens.pop_front()?.as_str() {
                    "," => {}
                    "]" => return Some(Value::List(values)),
                    _ => return None,
                }
            }
        }
        "(" => {
            let mut fields = Vec::new();
            loop {
                let field = tokens.pop_front()?;
                if tokens.pop_front()? != ":=" {
                    return None;
                }
                fields.push((field, value(tokens)?));
                match tokens.pop_front()?.as_str() {
                    "," => {}
                    ")" => return Some(Value::Fields(fields)),
                    _ => return None,
                }
            }
        }
        _ => Some(Value::Single(first)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lists_and_structures_are_read() {
        let text = "VAR_GLOBAL\na : T := [1, 2(0), (x := -1.5E7, y := E.m)]; b : DINT := 3;\nEND_VAR";
        let (left, found) = taken_out(text);
        assert_eq!(left.len(), text.len());
        assert!(left.contains("b : DINT := 3;") && !left.contains('['), "{left}");
        let single = |text: &str| Value::Single(text.into());
        let point = Value::Fields(vec![("x".into(), single("-1.5E7")), ("y".into(), single("E.m"))]);
        let list = Value::List(vec![single("1"), single("0"), single("0"), point]);
        assert_eq!(found, vec![(text.find(":=").unwrap(), list)]);
    }
}
