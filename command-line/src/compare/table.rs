//! What came of two runs, row by row.

use serde_json::Value;

/// A figure of both runs; none where one has no such thing.
pub struct Row {
    pub what: String,
    pub values: [Option<Value>; 2],
}

impl Row {
    /// What is null is not there.
    pub fn new(what: impl Into<String>, values: [Option<Value>; 2]) -> Self {
        Self { what: what.into(), values: values.map(|value| value.filter(|value| !value.is_null())) }
    }

    pub fn is_same(&self) -> bool {
        self.values[0] == self.values[1]
    }
}

/// Rows that are shown; a long run has thousands.
const MOST_ROWS: usize = 40;
/// Letters of one name or value.
const MOST_LETTERS: usize = 60;

fn shown(value: &Option<Value>) -> String {
    let text = match value {
        None => "-".into(),
        Some(Value::String(text)) => text.clone(),
        Some(value) => value.to_string(),
    };
    shortened(text)
}

fn shortened(text: String) -> String {
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
            [shortened(row.what.clone()), shown(&row.values[0]), shown(&row.values[1]), change]
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
