//! The rows of one parameter beside one another: layouts by values.

use super::design::{Asked, Design};
use super::rows::Row;

/// Values that fit beside one another on a page.
const MOST_VALUES: usize = 12;

/// The figure of each layout and value; `None` where no run did all.
pub struct Grid {
    asked: Asked,
    cells: Vec<Vec<Option<f64>>>,
}

impl Grid {
    /// If one parameter varies, in few numbers, and nothing else but the layout.
    pub fn of(design: &Design) -> Option<Self> {
        let [axis] = design.axes.as_slice() else { return None };
        let is_number = |value: &String| value.parse::<f64>().is_ok();
        let fits = (2..=MOST_VALUES).contains(&axis.values.len())
            && axis.values.iter().all(is_number)
            && design.orders.len() <= 1
            && design.delays.len() <= 1;
        fits.then(|| Self {
            asked: design.asked,
            cells: vec![vec![None; axis.values.len()]; design.layouts.len()],
        })
    }

    pub fn take(&mut self, row: &Row) {
        if let [value] = row.point.values[..] {
            self.cells[row.point.layout][value] = row.figure;
        }
    }

    pub fn text(&self, design: &Design) -> String {
        let Some(axis) = design.axes.first() else { return String::new() };
        let titles = design.layouts.iter().map(|title| title.chars().count());
        let figure = match self.asked {
            Asked::Orders => "s/order",
            Asked::Items => "goal at, s,",
            Asked::Throughput => "items/h",
        };
        let heading = format!("{figure} by {}", axis.name);
        let first = titles.chain([heading.len()]).max().unwrap_or(0);
        let widths: Vec<usize> = axis.values.iter().map(|value| value.len().max(8)).collect();
        let row = |title: &str, cells: Vec<String>| {
            let cells = cells.iter().zip(&widths).map(|(cell, width)| format!("  {cell:>width$}"));
            format!("{title:first$}{}\n", cells.collect::<String>())
        };
        let mut text = row(&heading, axis.values.clone());
        for (title, cells) in design.layouts.iter().zip(&self.cells) {
            let cells = cells.iter().map(|s| s.map_or_else(|| "-".into(), |s| format!("{s:.2}")));
            text += &row(title, cells.collect());
        }
        text
    }
}
