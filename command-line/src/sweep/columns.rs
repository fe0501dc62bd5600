//! Columns that stand in a table only if they are asked for.

use super::measured::Beside;
use super::rows::Row;
use serde_json::{Value, json};

/// Some columns of one row.
pub struct Columns {
    /// By their keys; of a table of values these are the titles.
    pub values: Vec<(&'static str, Value)>,
    /// Title, width and cell of each column of text.
    pub texts: Vec<(&'static str, usize, String)>,
}

impl Columns {
    /// Of items that sinks collect; their text stands where that of orders does.
    pub fn of_throughput(row: &Row) -> Self {
        let values = vec![("items", json!(row.outcome.items)), ("items_per_hour", json!(row.items_per_hour))];
        Self { values, texts: Vec::new() }
    }

    /// The same, if they have a goal.
    pub fn of_goal(row: &Row) -> Self {
        let outcome = &row.outcome;
        let values = vec![
            ("items", json!(outcome.items)),
            ("items_asked", json!(outcome.items_asked)),
            ("goal_s", json!(row.figure)),
            ("items_per_hour", json!(row.items_per_hour)),
        ];
        Self { values, texts: Vec::new() }
    }

    /// Of several runs of each point.
    pub fn of_runs(row: &Row) -> Self {
        Self {
            values: vec![
                ("runs", json!(row.runs)),
                ("finished_runs", json!(row.finished_runs)),
                ("half_width", json!(row.half_width)),
            ],
            texts: vec![
                ("+-", 6, if row.are_same { "same".into() } else { seconds(row.half_width) }),
                ("runs", 9, format!("{} of {}", row.finished_runs, row.runs)),
            ],
        }
    }

    /// Of orders that are cut.
    pub fn of_warm_up(row: &Row) -> Self {
        let cut = row.cut_orders;
        let text = cut.map_or_else(|| "-".into(), |cut| format!("{}", (cut * 10.0).round() / 10.0));
        Self {
            values: vec![("cut_orders", json!(cut)), ("measured_runs", json!(row.measured_runs))],
            texts: vec![("cut", 5, text)],
        }
    }

    /// Of the differences to the first point.
    pub fn of_comparison(row: &Row) -> Self {
        let differences = &row.differences;
        let (mean, half_width) = (differences.mean(), differences.half_width());
        let signed = mean.map_or_else(|| "-".into(), |mean| format!("{mean:+.2}"));
        Self {
            values: vec![
                ("difference", json!(mean)),
                ("difference_half_width", json!(half_width)),
                ("pairs", json!(differences.count)),
            ],
            texts: vec![
                ("difference", 10, signed),
                ("+-", 6, seconds(half_width)),
                ("pairs", 5, differences.count.to_string()),
            ],
        }
    }

    /// Of figures from elsewhere.
    pub fn of_measured(beside: Beside) -> Self {
        let ratio = beside.ratio.map_or_else(|| "-".into(), |ratio| format!("{ratio:.3}"));
        Self {
            values: vec![
                ("measured_seconds_per_order", json!(beside.seconds_per_order)),
                ("ratio", json!(beside.ratio)),
            ],
            texts: vec![("measured", 9, seconds(beside.seconds_per_order)), ("ratio", 6, ratio)],
        }
    }
}

/// With two places.
pub fn seconds(value: Option<f64>) -> String {
    value.map_or_else(|| "-".into(), |s| format!("{s:.2}"))
}
