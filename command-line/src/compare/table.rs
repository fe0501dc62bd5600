//! What came of two runs, row by row.

use serde_json::Value;

/// A figure of both runs; none where one has no such thing.
pub struct Row {
    pub what: String,
    pub values: [Option<Value>; 2],
}

impl Row {
    pub fn is_same(&self) -> bool {
        self.values[0] == self.values[1]
    }
}

/// Orders, times and machines, in the order of the first run.
pub fn rows(a: &Value, b: &Value) -> Vec<Row> {
    let keys = ["finished", "reason", "simulated_s", "orders", "orders_done", "seconds_per_order"];
    let mut rows: Vec<Row> = keys.into_iter().map(|key| row(key, a.get(key), b.get(key))).collect();
    rows.push(row("contacts", Some(&count(a, "collisions")), Some(&count(b, "collisions"))));
    orders(a, b, &mut rows);
    machines(a, b, &mut rows);
    items(a, b, &mut rows);
    rows
}

fn row(what: impl Into<String>, a: Option<&Value>, b: Option<&Value>) -> Row {
    Row { what: what.into(), values: [a, b].map(|value| value.filter(|v| !v.is_null()).cloned()) }
}

fn count(report: &Value, key: &str) -> Value {
    report[key].as_array().map_or(0, Vec::len).into()
}

fn orders(a: &Value, b: &Value, rows: &mut Vec<Row>) {
    let list = |report: &Value| report["order_times"].as_array().cloned().unwrap_or_default();
    let (a, b) = (list(a), list(b));
    for number in 0..a.len().max(b.len()) {
        for key in ["station", "opened_s", "made_s"] {
            let of = |list: &[Value]| list.get(number).and_then(|order| order.get(key)).cloned();
            rows.push(row(format!("order {} {key}", number + 1), of(&a).as_ref(), of(&b).as_ref()));
        }
    }
}

fn machines(a: &Value, b: &Value, rows: &mut Vec<Row>) {
    let names = |report: &Value| -> Vec<String> {
        report["robots"].as_object().map_or_else(Vec::new, |robots| robots.keys().cloned().collect())
    };
    let mut all = names(a);
    all.extend(names(b).into_iter().filter(|name| a["robots"].get(name).is_none()));
    for name in all {
        for key in ["moving_s", "working_s", "waiting_s", "stopped_s", "state"] {
            let of = |report: &Value| report["robots"].get(&name).and_then(|robot| robot.get(key)).cloned();
            rows.push(row(format!("{name} {key}"), of(a).as_ref(), of(b).as_ref()));
        }
    }
}

/// Where the items are in the end.
fn items(a: &Value, b: &Value, rows: &mut Vec<Row>) {
    let list = |report: &Value| report["items"].as_array().cloned().unwrap_or_default();
    let (a, b) = (list(a), list(b));
    let find = |list: &[Value], name: &Value| list.iter().find(|item| item["name"] == *name).cloned();
    let names = a.iter().chain(b.iter().filter(|item| find(&a, &item["name"]).is_none()));
    for name in names.map(|item| &item["name"]) {
        let carrier = |list: &[Value]| find(list, name).and_then(|item| item.get("carrier").cloned());
        let what = format!("{} at the end", name.as_str().unwrap_or("?"));
        rows.push(row(what, carrier(&a).as_ref(), carrier(&b).as_ref()));
    }
}

/// Rows that are shown; a long run has thousands.
const MOST_ROWS: usize = 40;
/// Letters of one value.
const MOST_LETTERS: usize = 60;

fn shown(value: &Option<Value>) -> String {
    let text = match value {
        None => "-".into(),
        Some(Value::String(text)) => text.clone(),
        Some(value) => value.to_string(),
    };
    match text.char_indices().nth(MOST_LETTERS) {
        Some((end, _)) => format!("{}...", &text[..end]),
        None => text,
    }
}

/// What is first in a table, and all that differs.
pub fn text(rows: &[Row]) -> String {
    let head = ["simulated_s", "orders_done", "seconds_per_order"];
    let all: Vec<&Row> =
        rows.iter().filter(|row| !row.is_same() || head.contains(&row.what.as_str())).collect();
    let cells: Vec<[String; 4]> = all
        .iter()
        .take(MOST_ROWS)
        .map(|row| {
            let [a, b] = row.values.each_ref().map(|value| value.as_ref().and_then(Value::as_f64));
            let change = match (a, b) {
                (Some(a), Some(b)) if a != b => format!("{:+.2}", b - a),
                _ => String::new(),
            };
            [row.what.clone(), shown(&row.values[0]), shown(&row.values[1]), change]
        })
        .collect();
    let width = |column: usize| cells.iter().map(|row| row[column].chars().count()).max().unwrap_or(0).max(6);
    let (what, a, b) = (width(0), width(1), width(2));
    let mut out = format!("{:what$}  {:>a$}  {:>b$}\n", "", "first", "second");
    for [name, first, second, change] in &cells {
        let line = format!("{name:what$}  {first:>a$}  {second:>b$}  {change}");
        out += &format!("{}\n", line.trim_end());
    }
    match all.len().saturating_sub(MOST_ROWS) {
        0 => out,
        more => out + &format!("and {more} more that differ\n"),
    }
}
