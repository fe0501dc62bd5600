//! The page of a sweep: its rows, charts of them, and links to the pages of runs.

use super::{STYLE, within_script};
use crate::version;
use askama::Template;
use serde_json::{Value, json};
use std::collections::BTreeMap;

#[derive(Template)]
#[template(path = "report/sweep.html", escape = "html")]
struct Page<'a> {
    style: &'static str,
    data: &'a str,
    scripts: &'static [&'static str],
}

const SCRIPTS: &[&str] = &[part!("page.js"), part!("sweep.js")];

/// What varies in a sweep, as the rows have it.
#[derive(Clone, Debug)]
pub enum Name {
    /// A key of a row.
    Of(&'static str),
    /// A key of the object `set` of a row.
    Set(String),
}

/// `rows` are those of the sweep as JSON, in their order. `kept` has the paths of the pages of runs, from the folder of
/// this one, by the numbers of the rows from 1.
pub fn html(names: &[Name], rows: &[Value], kept: &BTreeMap<usize, String>) -> String {
    let names = names.iter().map(|name| match name {
        Name::Of(key) => json!({ "kind": "of", "key": key, "title": key }),
        Name::Set(key) => json!({ "kind": "set", "key": key, "title": key }),
    });
    let numbered = rows.iter().enumerate().map(|(index, row)| {
        let mut row = row.clone();
        row["row"] = json!(index + 1);
        row
    });
    let has = |key: &str| rows.iter().any(|row| row.get(key).is_some());
    let figure = if has("goal_s") {
        json!({ "key": "goal_s", "title": "Seconds until the goal", "done": "goals reached", "best": "least" })
    } else if has("items_per_hour") {
        json!({ "key": "items_per_hour", "title": "Items per hour", "done": "time limits reached", "best": "greatest" })
    } else {
        json!({ "key": "seconds_per_order", "title": "Seconds per order", "done": "all orders made", "best": "least" })
    };
    let data = json!({
        "figure": figure,
        "tool": format!("autogen {}", version::NUMBER),
        "names": names.collect::<Vec<_>>(),
        "rows": numbered.collect::<Vec<_>>(),
        "kept": kept.iter().map(|(row, path)| (row.to_string(), json!(path))).collect::<serde_json::Map<_, _>>(),
    });
    let data = within_script(&data.to_string());
    let page = Page { style: STYLE, data: &data, scripts: SCRIPTS };
    // Writing to memory does not fail.
    page.render().unwrap_or_default()
}
