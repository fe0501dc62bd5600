//! Values of JSON by choices.

use crate::dictionary::NUMBERS;
use arbitrary::{Result, Unstructured};

/// `"key": value` of each, with now and then one left out, twice, or of another value.
pub fn object(u: &mut Unstructured, members: &[(&str, String)]) -> Result<String> {
    let mut written = Vec::new();
    for (key, value) in members {
        match u.int_in_range(0..=60)? {
            0 => {}
            1 => written.push(format!("\"{key}\": {}", any(u, 2)?)),
            2 => written.extend([format!("\"{key}\": {value}"), format!("\"{key}\": {value}")]),
            _ => written.push(format!("\"{key}\": {value}")),
        }
    }
    Ok(format!("{{{}}}", written.join(", ")))
}

/// A list of so many at most.
pub fn list(
    u: &mut Unstructured,
    most: usize,
    mut element: impl FnMut(&mut Unstructured) -> Result<String>,
) -> Result<String> {
    let count = u.int_in_range(0..=most)?;
    let elements = (0..count).map(|_| element(u)).collect::<Result<Vec<_>>>()?;
    Ok(format!("[{}]", elements.join(", ")))
}

pub fn any(u: &mut Unstructured, depth: usize) -> Result<String> {
    Ok(match u.int_in_range(0..=if depth == 0 { 4 } else { 6 })? {
        0 => "null".into(),
        1 => "true".into(),
        2 | 3 => u.choose(&NUMBERS)?.to_string(),
        4 => name(u)?,
        5 => list(u, 3, |u| any(u, depth - 1))?,
        _ => {
            let value = any(u, depth - 1)?;
            object(u, &[("name", value)])?
        }
    })
}

/// A number near those of a factory, now and then one far from them.
pub fn metres(u: &mut Unstructured) -> Result<String> {
    Ok(match u.int_in_range(0..=40)? {
        0 => u.choose(&NUMBERS)?.to_string(),
        1 => "1000.0".into(),
        _ => format!("{}", f64::from(u.int_in_range(-1200..=800)?) / 100.0),
    })
}

/// A name of a few, so that two are the same now and then.
pub fn name(u: &mut Unstructured) -> Result<String> {
    const NAMES: [&str; 14] = [
        "belt", "kitting", "agv1", "agv2", "gantry", "as1", "as2", "bin1", "x", "AGV1", "é", "end_if",
        "a__b", "",
    ];
    Ok(format!("\"{}\"", u.choose(&NAMES)?))
}
