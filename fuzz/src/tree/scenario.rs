//! Scenarios by choices.

use super::json::{any, list, name, object};
use crate::dictionary::NUMBERS;
use arbitrary::{Result, Unstructured};

const SIGNALS: [&str; 4] = ["attached", "at_stop", "sees", "ack"];
const PARTS: [&str; 4] = ["drive", "conveyor", "joints", "cycle"];
const KINDS: [&str; 5] = ["battery", "sensor", "regulator", "pump", "kitting"];

pub fn scenario(u: &mut Unstructured) -> Result<String> {
    let count = u.int_in_range(1..=KINDS.len())?;
    let mut kinds = Vec::new();
    for name in &KINDS[..count] {
        kinds.push(kind(u, name)?);
    }
    let orders = match u.ratio(1, 2)? {
        true => {
            let members = [("count", whole(u, 12)?), ("parts", parts(u, count)?), ("stations", stations(u)?)];
            object(u, &members)?
        }
        false => list(u, 5, |u| {
            let mut members = vec![("parts", parts(u, count)?)];
            if u.ratio(1, 2)? {
                let station = u.choose(&["\"as1\"", "[\"as1\"]", "\"as9\"", "[\"as1\", \"as1\"]", "[]"])?;
                members.push(("station", station.to_string()));
            }
            object(u, &members)
        })?,
    };
    let mut members = vec![("kinds", format!("[{}]", kinds.join(", "))), ("orders", orders)];
    if u.ratio(3, 4)? {
        members.push(("supply", supply(u, count)?));
    }
    if u.ratio(1, 4)? {
        members.push(("time_limit_s", seconds(u)?));
    }
    if u.ratio(1, 3)? {
        members.push(("faults", faults(u)?));
    }
    object(u, &members)
}

fn kind(u: &mut Unstructured, name: &str) -> Result<String> {
    let mut members = vec![("name", format!("\"{name}\"")), ("height", length(u)?)];
    if u.ratio(1, 2)? {
        members.push(("size", format!("[{}, {}]", length(u)?, length(u)?)));
    }
    object(u, &members)
}

fn parts(u: &mut Unstructured, kinds: usize) -> Result<String> {
    let mut members = Vec::new();
    for kind in &KINDS[..kinds] {
        members.push((*kind, whole(u, 3)?));
    }
    object(u, &members)
}

fn stations(u: &mut Unstructured) -> Result<String> {
    Ok(u.choose(&["\"in turn\"", "[\"as1\"]", "[]", "[\"as1\", \"as2\"]", "\"as1\""])?.to_string())
}

fn supply(u: &mut Unstructured, kinds: usize) -> Result<String> {
    let mut members = vec![("every_s", seconds(u)?)];
    if u.ratio(1, 4)? {
        members.push(("first_s", seconds(u)?));
    }
    if u.ratio(1, 3)? {
        members.push(("surplus", format!("[{}, {}]", whole(u, 100)?, whole(u, 100)?)));
    }
    if u.ratio(1, 3)? {
        members.push(("seed", whole(u, 9)?));
    }
    if u.ratio(1, 4)? {
        let items = list(u, 40, |u| Ok(format!("\"{}\"", u.choose(&KINDS[..kinds])?)))?;
        members.push(("items", if u.ratio(1, 2)? { items } else { format!("{{\"belt\": {items}}}") }));
    }
    object(u, &members)
}

fn faults(u: &mut Unstructured) -> Result<String> {
    let slips = list(u, 2, |u| {
        let members = [("robot", name(u)?), ("pick", whole(u, 9)?), ("after_s", seconds(u)?)];
        object(u, &members)
    })?;
    let refusals = list(u, 2, |u| {
        let members = [("robot", name(u)?), ("command", whole(u, 9)?)];
        object(u, &members)
    })?;
    let answers = list(u, 2, |u| {
        let members = [
            ("robot", name(u)?),
            ("command", whole(u, 9)?),
            ("late_s", seconds(u)?),
            ("error", whole(u, 4)?),
        ];
        object(u, &members)
    })?;
    let mut pauses = || {
        list(u, 2, |u| {
            let members = [("at_s", seconds(u)?), ("for_s", seconds(u)?)];
            object(u, &members)
        })
    };
    let (pauses, power_offs) = (pauses()?, pauses()?);
    let sensors = list(u, 2, |u| {
        let mut members = vec![
            ("robot", name(u)?),
            ("signal", format!("\"{}\"", u.choose(&SIGNALS)?)),
            ("reads", if u.ratio(1, 2)? { "true".into() } else { whole(u, 3)? }),
            ("at_s", seconds(u)?),
        ];
        if u.ratio(1, 3)? {
            members.push(("element", whole(u, 4)?));
        }
        if u.ratio(1, 2)? {
            members.push(("for_s", seconds(u)?));
        }
        object(u, &members)
    })?;
    let jams = list(u, 2, |u| {
        let members =
            [("robot", name(u)?), ("part", part(u)?), ("at_s", seconds(u)?), ("for_s", seconds(u)?)];
        object(u, &members)
    })?;
    let slow = list(u, 1, |u| {
        let members =
            [("robot", name(u)?), ("part", part(u)?), ("cycle", whole(u, 3)?), ("longer_s", seconds(u)?)];
        object(u, &members)
    })?;
    let members = [
        ("slips", slips),
        ("refusals", refusals),
        ("answers", answers),
        ("pauses", pauses),
        ("power_offs", power_offs),
        ("sensors", sensors),
        ("jams", jams),
        ("slow", slow),
    ];
    object(u, &members)
}

fn part(u: &mut Unstructured) -> Result<String> {
    Ok(format!("\"{}\"", u.choose(&PARTS)?))
}

fn whole(u: &mut Unstructured, most: u32) -> Result<String> {
    match u.ratio(1, 30)? {
        true => any(u, 1),
        false => Ok(u.int_in_range(0..=most)?.to_string()),
    }
}

fn seconds(u: &mut Unstructured) -> Result<String> {
    match u.ratio(1, 20)? {
        true => Ok(u.choose(&NUMBERS)?.to_string()),
        false => Ok(format!("{}", f64::from(u.int_in_range(1..=9000)?) / 1000.0)),
    }
}

fn length(u: &mut Unstructured) -> Result<String> {
    match u.ratio(1, 20)? {
        true => Ok(u.choose(&["0.001", "1", "0.0009", "1.001", "0"])?.to_string()),
        false => Ok(format!("{}", f64::from(u.int_in_range(10..=300)?) / 1000.0)),
    }
}
