//! The rows of one parameter beside one another: layouts by values.

use super::plan::Plan;
use super::row::Row;

/// Values that fit beside one another on a page.
const MOST_VALUES: usize = 12;

/// Seconds per order of each layout and value; `None` where not all orders were made.
pub struct Grid {
    cells: Vec<Vec<Option<f64>>>,
}

impl Grid {
    /// If one parameter varies, in few numbers, and nothing else but the layout.
    pub fn of(plan: &Plan) -> Option<Self> {
        let [axis] = plan.axes.as_slice() else { return None };
        let is_number = |value: &String| value.parse::<f64>().is_ok();
        let fits = (2..=MOST_VALUES).contains(&axis.values.len())
            && axis.values.iter().all(is_number)
            && plan.orders.len() == 1
            && plan.delays.len() == 1;
        fits.then(|| Self { cells: vec![vec![None; axis.values.len()]; plan.lines.len()] })
    }

    pub fn take(&mut self, row: &Row) {
        if row.finished
            && let [value] = row.point.values[..]
        {
            self.cells[row.point.line][value] = row.seconds_per_order;
        }
    }

    pub fn text(&self, plan: &Plan) -> String {
        let Some(axis) = plan.axes.first() else { return String::new() };
        let titles = plan.lines.iter().map(|line| line.title.chars().count());
        let heading = format!("s/order by {}", axis.name);
        let first = titles.chain([heading.len()]).max().unwrap_or(0);
        let widths: Vec<usize> = axis.values.iter().map(|value| value.len().max(8)).collect();
        let row = |title: &str, cells: Vec<String>| {
            let cells = cells.iter().zip(&widths).map(|(cell, width)| format!("  {cell:>width$}"));
            format!("{title:first$}{}\n", cells.collect::<String>())
        };
        let mut text = row(&heading, axis.values.clone());
        for (line, cells) in plan.lines.iter().zip(&self.cells) {
            let cells = cells.iter().map(|s| s.map_or_else(|| "-".into(), |s| format!("{s:.2}")));
            text += &row(&line.title, cells.collect());
        }
        text
    }
}
