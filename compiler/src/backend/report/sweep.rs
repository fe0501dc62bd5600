//! The page of a sweep: its rows, charts of them, and links to the pages of runs.

use super::{STYLE, within_script};
use crate::version;
use askama::Template;
use serde_json::{Value, json};
use std::collections::BTreeMap;

#[derive(Template)]
#[template(path = "report/sweep/page.html", escape = "html")]
struct Page<'a> {
    title: &'a str,
    facts: &'a [Fact],
    styles: [&'static str; 2],
    data: &'a str,
    tool: &'a str,
    scripts: &'static [&'static str],
}

const OWN_STYLE: &str = part!("sweep/page.css");
const SCRIPTS: &[&str] = &[
    part!("page.js"),
    part!("sweep/rows.js"),
    part!("sweep/labels.js"),
    part!("sweep/ticks.js"),
    part!("sweep/across.js"),
    part!("sweep/up.js"),
    part!("sweep/marks.js"),
    part!("sweep/series.js"),
    part!("sweep/chart.js"),
    part!("sweep/table.js"),
    part!("sweep/page.js"),
];

/// All that a page shows.
#[derive(Clone, Debug)]
pub struct Sweep {
    pub title: String,
    pub facts: Vec<Fact>,
    pub figure: Figure,
    /// What names a row.
    pub names: Vec<Name>,
    pub table: Table,
    /// Paths of the pages of runs, from the folder of this one, by the numbers of their rows from 1.
    pub kept: BTreeMap<usize, String>,
}

/// What the head of a page says of the sweep, or of a run of it.
#[derive(Clone, Debug)]
pub struct Fact {
    pub name: &'static str,
    pub value: String,
}

/// To what runs come.
#[derive(Clone, Copy, Debug)]
pub enum Figure {
    SecondsPerOrder,
    SecondsUntilGoal,
    ItemsPerHour,
}

/// A layout, a parameter, a seed: what a row has a value of.
#[derive(Clone, Debug)]
pub struct Name {
    pub title: String,
    pub values: Values,
}

/// As they were written.
#[derive(Clone, Debug)]
pub enum Values {
    Numbers(Vec<String>),
    /// They have no order and no distance: names, seeds.
    Words(Vec<String>),
}

/// The same as the table of text.
#[derive(Clone, Debug)]
pub struct Table {
    /// Beside those of the names, and before that of the reason.
    pub columns: Vec<Column>,
    pub rows: Vec<Row>,
}

#[derive(Clone, Debug)]
pub struct Column {
    pub title: &'static str,
    /// What it means.
    pub about: &'static str,
}

#[derive(Clone, Debug)]
pub struct Row {
    /// For each name the number of a value.
    pub at: Vec<usize>,
    /// One for each column.
    pub cells: Vec<String>,
    pub reason: String,
    /// What else is said of the reason, each a line.
    pub remarks: Vec<String>,
    pub runs: u32,
    pub finished_runs: usize,
    /// Those of them that are in the figure.
    pub measured_runs: usize,
    pub figure: Option<f64>,
    /// Half of the width of its 95 % interval.
    pub half_width: Option<f64>,
}

impl Sweep {
    pub fn html(&self) -> String {
        let data = json!({
            "figure": self.figure.json(),
            "names": self.names.iter().map(Name::json).collect::<Vec<_>>(),
            "columns": self.table.columns.iter().map(Column::json).collect::<Vec<_>>(),
            "rows": self.table.rows.iter().map(Row::json).collect::<Vec<_>>(),
            "kept": self.kept.iter().map(|(row, path)| (row.to_string(), json!(path))).collect::<serde_json::Map<_, _>>(),
        });
        let page = Page {
            title: &self.title,
            facts: &self.facts,
            styles: [STYLE, OWN_STYLE],
            data: &within_script(&data.to_string()),
            tool: &format!("autogen {}", version::NUMBER),
            scripts: SCRIPTS,
        };
        // Writing to memory does not fail.
        page.render().unwrap_or_default()
    }
}

impl Figure {
    fn json(self) -> Value {
        let (title, unit, done, best) = match self {
            Self::SecondsPerOrder => ("Seconds per order", "s", "all orders made", "least"),
            Self::SecondsUntilGoal => ("Seconds until the goal", "s", "goal reached", "least"),
            Self::ItemsPerHour => ("Items per hour", "items/h", "time limit reached", "greatest"),
        };
        json!({ "title": title, "unit": unit, "done": done, "best": best })
    }
}

impl Values {
    pub fn texts(&self) -> &[String] {
        let (Self::Numbers(texts) | Self::Words(texts)) = self;
        texts
    }
}

impl Name {
    fn json(&self) -> Value {
        let are_numbers = matches!(self.values, Values::Numbers(_));
        json!({ "title": self.title, "are_numbers": are_numbers, "values": self.values.texts() })
    }
}

impl Column {
    fn json(&self) -> Value {
        json!({ "title": self.title, "about": self.about })
    }
}

impl Row {
    fn json(&self) -> Value {
        json!({
            "at": self.at,
            "cells": self.cells,
            "reason": self.reason,
            "remarks": self.remarks,
            "runs": self.runs,
            "finished_runs": self.finished_runs,
            "measured_runs": self.measured_runs,
            "figure": self.figure,
            "half_width": self.half_width,
        })
    }
}
