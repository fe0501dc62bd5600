//! Rows on standard output, as they come.

use super::super::options::{TableFormat, TableOptions};
use super::columns::Columns;
use super::design::{Asked, Design};
use super::grid::Grid;
use super::measured::{Beside, Measured};
use super::plan::Refusal;
use super::rows::Row;
use autogen::backend::report::sweep as page;
use autogen::csv;
use serde_json::{Value, json};

pub struct Table<'a> {
    design: &'a Design,
    format: TableFormat,
    quiet: bool,
    compare: bool,
    rows: usize,
    names: Vec<Name<'a>>,
    grid: Option<Grid>,
    measured: Option<Measured>,
    /// The rows so far, if a page is made of them.
    kept: Option<page::Table>,
    noted: Noted,
}

/// The rows with notes.
#[derive(Default)]
struct Noted {
    rows: usize,
    /// The point of the first one, and its first note.
    first: Option<(String, String)>,
}

impl Noted {
    fn text(&self) -> Option<String> {
        let (point, note) = self.first.as_ref()?;
        Some(match self.rows {
            1 => format!("note on {point}: {note}"),
            rows => format!("note on {rows} rows, the first {point}: {note}"),
        })
    }
}

/// A column that says which point a row is.
struct Name<'a> {
    title: &'a str,
    /// Characters of the widest of its cells, its title among them.
    width: usize,
    cell: Box<dyn Fn(&Row) -> String + 'a>,
}

impl<'a> Name<'a> {
    fn new(title: &'a str, cells: Vec<String>, index: impl Fn(&Row) -> usize + 'a) -> Self {
        let width = cells.iter().map(|c| c.chars().count()).chain([title.len()]).max().unwrap_or(0);
        Self { title, width, cell: Box::new(move |row| cells[index(row)].clone()) }
    }
}

impl<'a> Table<'a> {
    pub fn new(design: &'a Design, options: &TableOptions) -> Result<Self, Refusal> {
        let mut names = vec![Name::new("layout", design.layouts.clone(), |row| row.point.layout)];
        for (number, axis) in design.axes.iter().enumerate() {
            names.push(Name::new(&axis.name, axis.values.clone(), move |row| row.point.values[number]));
        }
        if !design.orders.is_empty() {
            let seeds = design.orders.iter().map(u64::to_string).collect();
            names.push(Name::new("order_seed", seeds, |row| row.point.order));
        }
        if !design.delays.is_empty() {
            names.push(Name::new("io_delay", design.delays.clone(), |row| row.point.delay));
        }
        let (format, quiet) = (options.format, options.quiet);
        let grid = if format == TableFormat::Text && !quiet { Grid::of(design) } else { None };
        let titles: Vec<&str> = names.iter().map(|name| name.title).collect();
        let measured = options.beside.as_ref().map(|path| Measured::read(path, &titles)).transpose()?;
        Ok(Self {
            design,
            format,
            quiet,
            compare: options.compare,
            rows: 0,
            names,
            grid,
            measured,
            kept: None,
            noted: Noted::default(),
        })
    }

    /// It has the table of a page when it has ended.
    pub fn keeping(self) -> Self {
        let columns = self.columns(&Row::empty(self.design), self.empty_beside());
        let columns = columns.into_iter().flat_map(|columns| columns.texts);
        let columns = columns.map(|text| page::Column { title: text.title_on_page, about: text.about });
        let table = page::Table { columns: columns.collect(), rows: Vec::new() };
        Self { kept: Some(table), ..self }
    }

    fn empty_beside(&self) -> Option<Beside> {
        self.measured.as_ref().map(|_| Beside::default())
    }

    /// Whether its rows say what they differ from the first.
    pub fn compares(&self) -> bool {
        self.compare
    }

    /// Those that are asked for. `beside` is there if there are figures from elsewhere.
    fn columns(&self, row: &Row, beside: Option<Beside>) -> Vec<Columns> {
        let mut columns = vec![match self.design.asked {
            Asked::Orders => Columns::of_orders(row),
            Asked::Items => Columns::of_goal(row),
            Asked::Throughput => Columns::of_throughput(row),
        }];
        if self.design.has_means() {
            columns.push(Columns::of_runs(row));
        }
        if self.design.warm_up.is_some() {
            columns.push(Columns::of_warm_up(row));
        }
        if self.compare {
            columns.push(Columns::of_comparison(row));
        }
        columns.extend(beside.map(Columns::of_measured));
        columns.push(Columns::of_time(row));
        columns
    }

    pub fn begin(&self) {
        let columns = self.columns(&Row::empty(self.design), self.empty_beside());
        match self.format {
            TableFormat::Json => say_part!("{{\"rows\":["),
            TableFormat::Csv => {
                let names = self.names.iter().map(|name| name.title).chain(CSV_COLUMNS);
                let values =
                    columns.iter().flat_map(|columns| columns.values.iter().map(|(title, _)| *title));
                say!("{}", names.chain(values).map(csv::field).collect::<Vec<_>>().join(","));
            }
            TableFormat::Text if !self.quiet => {
                let names = self.text(|name| name.title.into());
                let more: String = (columns.iter().flat_map(|columns| &columns.texts))
                    .map(|text| format!("  {:>width$}", text.title, width = text.width))
                    .collect();
                say!("{names}{more}  reason");
            }
            TableFormat::Text | TableFormat::Jsonl => {}
        }
    }

    pub fn row(&mut self, row: &Row) {
        if let Some(note) = row.outcome.notes.first() {
            let cells: Vec<String> = self.names.iter().map(|name| (name.cell)(row)).collect();
            self.noted.rows += 1;
            self.noted.first.get_or_insert_with(|| (cells.join(" "), note.clone()));
        }
        let beside = self.beside(row);
        let columns = self.columns(row, beside);
        if let Some(kept) = &mut self.kept {
            kept.rows.push(row.on_page(self.design, &columns));
        }
        match self.format {
            TableFormat::Json => {
                let before = if self.rows == 0 { "\n" } else { ",\n" };
                say_part!("{before}{}", self.json(row, columns));
            }
            TableFormat::Jsonl => say!("{}", self.json(row, columns)),
            TableFormat::Csv => {
                let values = columns.iter().flat_map(|columns| columns.values.iter().map(|(_, value)| value));
                let cells: Vec<String> = (self.names.iter().map(|name| (name.cell)(row)))
                    .chain(csv_cells(row))
                    .chain(values.map(number))
                    .map(|cell| csv::field(&cell).into_owned())
                    .collect();
                say!("{}", cells.join(","));
            }
            TableFormat::Text if self.quiet && row.outcome.finished => {}
            TableFormat::Text => {
                let point = self.text(|name| (name.cell)(row));
                let more: String = (columns.iter().flat_map(|columns| &columns.texts))
                    .map(|text| format!("  {:>width$}", text.cell, width = text.width))
                    .collect();
                say!("{point}{more}  {}", row.outcome.reason);
            }
        }
        if let Some(grid) = &mut self.grid {
            grid.take(row);
        }
        self.rows += 1;
    }

    /// The table of a page, if it was [`Self::keeping`] one.
    pub fn end(self) -> Option<page::Table> {
        let rms = self.measured.as_ref().and_then(Measured::rms);
        if self.format == TableFormat::Json {
            let rms = rms.map_or_else(String::new, |(rms, _)| format!(",\"rms\":{}", json!(rms)));
            say!("\n]{rms}}}");
        }
        if let Some(grid) = &self.grid {
            say_part!("\n{}", grid.text(self.design));
        }
        if self.format == TableFormat::Text
            && let Some((rms, ratios)) = rms
        {
            let of = if ratios == 1 { "the ratio".into() } else { format!("the {ratios} ratios") };
            say!("\nRMS of the difference between {of} and 1: {:.1} %", rms * 100.0);
        }
        if let Some(note) = self.noted.text().filter(|_| self.format == TableFormat::Text && !self.quiet) {
            say!("\n{note}");
        }
        if let Some(unused) = self.measured.as_ref().and_then(Measured::unused) {
            complain!("{unused}");
        }
        self.kept
    }

    /// What the measured figures say of a row's point; none without such figures.
    fn beside(&mut self, row: &Row) -> Option<Beside> {
        let names = &self.names;
        let cell = |title: &str| {
            names.iter().find(|name| name.title == title).map_or_else(String::new, |name| (name.cell)(row))
        };
        let figure = row.figure.filter(|_| self.design.asked == Asked::Orders);
        self.measured.as_mut().map(|measured| measured.beside(figure, cell))
    }

    fn json(&self, row: &Row, columns: Vec<Columns>) -> Value {
        let mut json = self.design.names(&row.point);
        json.extend(row.outcome.to_json());
        json.extend(columns.into_iter().flat_map(|c| c.values).map(|(key, value)| (key.into(), value)));
        Value::Object(json)
    }

    /// Cells of the columns that name points, each as wide as its column.
    fn text(&self, cell: impl Fn(&Name) -> String) -> String {
        let mut names = self.names.iter();
        let layout = names.next().map(|name| format!("{:width$}", cell(name), width = name.width));
        let values = names.map(|name| format!("{:>width$}", cell(name), width = name.width));
        layout.into_iter().chain(values).collect::<Vec<_>>().join("  ")
    }
}

const CSV_COLUMNS: [&str; 7] =
    ["finished", "reason", "orders_done", "orders", "seconds_per_order", "simulated_s", "trace_hash"];

/// Empty where there is nothing.
fn number(value: &Value) -> String {
    if value.is_null() { String::new() } else { value.to_string() }
}

/// In the order of [`CSV_COLUMNS`].
fn csv_cells(row: &Row) -> [String; 7] {
    let outcome = &row.outcome;
    [
        outcome.finished.to_string(),
        outcome.reason.clone(),
        outcome.orders_done.to_string(),
        number(&json!(outcome.orders)),
        number(&json!(outcome.seconds_per_order)),
        number(&json!(outcome.simulated_s)),
        outcome.trace_hash.clone().unwrap_or_default(),
    ]
}
