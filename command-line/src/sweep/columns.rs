//! Columns of a table, beside those that name a point.

use super::measured::Beside;
use super::rows::Row;
use serde_json::{Value, json};

/// Some columns of one row.
pub struct Columns {
    /// By their keys; of a table of values these are the titles.
    pub values: Vec<(&'static str, Value)>,
    pub texts: Vec<Text>,
}

/// A column of text, and its cell.
pub struct Text {
    pub title: &'static str,
    /// Where two columns of a page would have the same title.
    pub title_on_page: &'static str,
    /// What it means, for a page.
    pub about: &'static str,
    pub width: usize,
    pub cell: String,
}

impl Text {
    fn new(title: &'static str, about: &'static str, width: usize, cell: String) -> Self {
        Self { title, title_on_page: title, about, width, cell }
    }
}

impl Columns {
    /// Of orders.
    pub fn of_orders(row: &Row) -> Self {
        let outcome = &row.outcome;
        let texts = vec![
            Text::new(
                "orders",
                "orders made; of several runs the least",
                11,
                of(outcome.orders_done, outcome.orders),
            ),
            Text::new("s/order", "seconds per order", 9, seconds(outcome.seconds_per_order)),
        ];
        Self { values: Vec::new(), texts }
    }

    /// Of items that sinks collect.
    pub fn of_throughput(row: &Row) -> Self {
        let values = vec![("items", json!(row.outcome.items)), ("items_per_hour", json!(row.items_per_hour))];
        let texts = vec![
            Text::new(
                "items",
                "items that the sinks have; of several runs the least",
                11,
                row.outcome.items.to_string(),
            ),
            Text::new("items/h", "items that the sinks collect in an hour", 8, per_hour(row)),
        ];
        Self { values, texts }
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
        let texts = vec![
            Text::new(
                "items",
                "items that the sinks of the goal have; of several runs the least",
                11,
                of(outcome.items, outcome.items_asked),
            ),
            Text::new(
                "items/h",
                "items that these sinks collect in an hour, over all runs",
                8,
                per_hour(row),
            ),
            Text::new("goal at s", "time until the goal is reached, in seconds", 9, seconds(row.figure)),
        ];
        Self { values, texts }
    }

    /// Of several runs of each point.
    pub fn of_runs(row: &Row) -> Self {
        let half_width = if row.are_same { "same".into() } else { seconds(row.half_width) };
        Self {
            values: vec![
                ("runs", json!(row.runs)),
                ("finished_runs", json!(row.finished_runs)),
                ("half_width", json!(row.half_width)),
            ],
            texts: vec![
                Text::new("+-", "half of the width of the 95 % interval", 6, half_width),
                Text::new(
                    "runs",
                    "runs that finished, of all",
                    9,
                    format!("{} of {}", row.finished_runs, row.runs),
                ),
            ],
        }
    }

    /// Of orders that are cut.
    pub fn of_warm_up(row: &Row) -> Self {
        let cut = row.cut_orders;
        let text = cut.map_or_else(|| "-".into(), |cut| format!("{}", (cut * 10.0).round() / 10.0));
        Self {
            values: vec![("cut_orders", json!(cut)), ("measured_runs", json!(row.measured_runs))],
            texts: vec![Text::new("cut", "orders of the warm-up, which do not count", 5, text)],
        }
    }

    /// Of the differences to the first point.
    pub fn of_comparison(row: &Row) -> Self {
        let differences = &row.differences;
        let (mean, half_width) = (differences.mean(), differences.half_width());
        let signed = mean.map_or_else(|| "-".into(), |mean| format!("{mean:+.2}"));
        let half_width_text = Text::new(
            "+-",
            "half of the width of the 95 % interval of the difference",
            6,
            seconds(half_width),
        );
        Self {
            values: vec![
                ("difference", json!(mean)),
                ("difference_half_width", json!(half_width)),
                ("pairs", json!(differences.count)),
            ],
            texts: vec![
                Text::new("difference", "to the first row, in the mean of the pairs", 10, signed),
                Text { title_on_page: "+- of difference", ..half_width_text },
                Text::new(
                    "pairs",
                    "runs with the same seeds, of this row and the first one, of which both finished",
                    5,
                    differences.count.to_string(),
                ),
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
            texts: vec![
                Text::new("measured", "seconds per order, measured", 9, seconds(beside.seconds_per_order)),
                Text::new("ratio", "seconds per order by those measured", 6, ratio),
            ],
        }
    }

    /// Of the length of the run, which is a value of every row.
    pub fn of_time(row: &Row) -> Self {
        let about = "simulated time in seconds; of several runs the mean of those that finished";
        let texts = vec![Text::new("simulated", about, 12, seconds(row.outcome.simulated_s))];
        Self { values: Vec::new(), texts }
    }
}

fn of(done: u64, all: Option<u64>) -> String {
    all.map_or("-".into(), |all| format!("{done} of {all}"))
}

fn per_hour(row: &Row) -> String {
    row.items_per_hour.map_or("-".into(), |n| format!("{n:.1}"))
}

/// With two places.
fn seconds(value: Option<f64>) -> String {
    value.map_or_else(|| "-".into(), |s| format!("{s:.2}"))
}
