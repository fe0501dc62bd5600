//! The figures of two runs, each beside the other one.

use super::table::Row;
use serde_json::Value;
use std::collections::BTreeMap;

/// The keys that stand first.
const HEAD: [&str; 9] = [
    "finished",
    "reason",
    "simulated_s",
    "scans",
    "orders",
    "orders_done",
    "seconds_per_order",
    "items_collected",
    "items_asked",
];

/// From which settings a run came, how long it took, and what other keys say too.
const NOT_COMPARED: [&str; 9] =
    ["layout", "settings", "order_seed", "io_delay", "wall_s", "waits", "notes", "fault", "trace_hash"];

/// Figures of one run by what they are.
type Figures = Vec<(String, Value)>;

/// A key of the results, and its figures.
type Part = (&'static str, fn(&Value) -> Figures);

const PARTS: [Part; 7] = [
    ("order_times", orders),
    ("robots", machines),
    ("items", items),
    ("sinks", sinks),
    ("alarms", alarms),
    ("faults", faults),
    ("collisions", contacts),
];

/// All that is compared, in the order of the first run.
pub fn rows(a: &Value, b: &Value) -> Vec<Row> {
    let mut rows: Vec<Row> =
        HEAD.into_iter().map(|key| Row::new(key, [a, b].map(|report| report.get(key).cloned()))).collect();
    let count = |report: &Value| Some(Value::from(report["collisions"].as_array().map_or(0, Vec::len)));
    rows.push(Row::new("contacts", [count(a), count(b)]));
    for (key, figures) in PARTS {
        rows.extend(merged(figures(&a[key]), figures(&b[key])));
    }
    rows.extend(merged(others(a), others(b)));
    rows
}

fn merged(a: Figures, b: Figures) -> Vec<Row> {
    let order: Vec<String> = b.iter().map(|(what, _)| what.clone()).collect();
    let mut b: BTreeMap<String, Value> = b.into_iter().collect();
    let mut rows: Vec<Row> = a
        .into_iter()
        .map(|(what, value)| {
            let other = b.remove(&what);
            Row::new(what, [Some(value), other])
        })
        .collect();
    let only_b = order.into_iter().filter_map(|what| b.remove(&what).map(|value| (what, value)));
    rows.extend(only_b.map(|(what, value)| Row::new(what, [None, Some(value)])));
    rows
}

/// A value, or those of an object one by one.
fn put(what: String, value: &Value, figures: &mut Figures) {
    match value {
        Value::Null => {}
        Value::Object(values) => {
            values.iter().for_each(|(key, value)| put(format!("{what} {key}"), value, figures));
        }
        value => figures.push((what, value.clone())),
    }
}

fn list(value: &Value) -> impl Iterator<Item = &Value> {
    value.as_array().into_iter().flatten()
}

fn entries(value: &Value) -> impl Iterator<Item = (&String, &Value)> {
    value.as_object().into_iter().flatten()
}

fn text<'v>(value: &'v Value, key: &str) -> &'v str {
    value[key].as_str().unwrap_or("?")
}

fn orders(times: &Value) -> Figures {
    let mut figures = Figures::new();
    for (place, order) in list(times).enumerate() {
        let number = order["order"].as_u64().unwrap_or(place as u64 + 1);
        for key in ["station", "opened_s", "made_s"] {
            put(format!("order {number} {key}"), &order[key], &mut figures);
        }
    }
    figures
}

fn machines(robots: &Value) -> Figures {
    let mut figures = Figures::new();
    entries(robots).for_each(|(name, robot)| put(name.clone(), robot, &mut figures));
    figures
}

/// What the items are, and where they are in the end.
fn items(items: &Value) -> Figures {
    let mut figures = Figures::new();
    for item in list(items) {
        let name = text(item, "name");
        put(format!("{name} at the end"), &item["carrier"], &mut figures);
        put(format!("{name} kind"), &item["kind"], &mut figures);
        put(format!("{name} place"), &item["place"], &mut figures);
    }
    figures
}

fn sinks(sinks: &Value) -> Figures {
    let mut figures = Figures::new();
    entries(sinks).for_each(|(sink, kinds)| put(sink.clone(), kinds, &mut figures));
    figures
}

/// Neither codes nor places in the text: a change elsewhere in a specification moves them.
fn alarms(alarms: &Value) -> Figures {
    told(alarms, "alarm", &["count", "first_s", "last_s", "active", "acknowledged", "stops"])
}

fn faults(faults: &Value) -> Figures {
    told(faults, "fault", &["state", "at_s", "cleared_s"])
}

/// By machine and text, the same ones in their order.
fn told(value: &Value, what: &str, keys: &[&str]) -> Figures {
    let mut figures = Figures::new();
    let mut seen: BTreeMap<(&str, String), usize> = BTreeMap::new();
    for one in list(value) {
        let machine = text(one, "robot");
        let said = one["text"].as_str().map_or_else(|| format!("code {}", one["code"]), String::from);
        let number = seen.entry((machine, said.clone())).or_default();
        *number += 1;
        let which = if *number == 1 { String::new() } else { format!(" {number}") };
        for key in keys {
            put(format!("{machine} {what}{which} {key}: {said}"), &one[key], &mut figures);
        }
    }
    figures
}

fn contacts(collisions: &Value) -> Figures {
    let mut figures = Figures::new();
    for contact in list(collisions) {
        let pair: Vec<&str> = list(&contact["pair"]).filter_map(Value::as_str).collect();
        let pair = pair.join(" and ");
        for key in ["time_s", "place", "parts", "count", "allowed"] {
            put(format!("contact of {pair} {key}"), &contact[key], &mut figures);
        }
    }
    figures
}

/// Keys that nothing above knows, so that no difference is lost.
fn others(report: &Value) -> Figures {
    let is_known = |key: &str| {
        HEAD.contains(&key) || NOT_COMPARED.contains(&key) || PARTS.iter().any(|(part, _)| *part == key)
    };
    let mut figures = Figures::new();
    entries(report).filter(|(key, _)| !is_known(key)).for_each(|(key, value)| {
        put(key.clone(), value, &mut figures);
    });
    figures
}
