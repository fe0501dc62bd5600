//! Rows on standard output, as they come.

use super::super::options::{SweepOptions, TableFormat};
use super::grid::Grid;
use super::measured::{Beside, Measured};
use super::plan::{Plan, Refusal};
use super::row::Row;
use autogen::csv;
use serde_json::{Value, json};

pub struct Table<'a> {
    plan: &'a Plan,
    format: TableFormat,
    quiet: bool,
    rows: usize,
    columns: Vec<Column<'a>>,
    grid: Option<Grid>,
    measured: Option<Measured>,
    replications: u32,
}

/// What says which point a row is.
struct Column<'a> {
    name: &'a str,
    /// Characters of the widest of its cells, its name among them.
    width: usize,
    cell: Box<dyn Fn(&Row) -> String + 'a>,
}

impl<'a> Column<'a> {
    fn new(name: &'a str, cells: Vec<String>, index: impl Fn(&Row) -> usize + 'a) -> Self {
        let width = cells.iter().map(|c| c.chars().count()).chain([name.len()]).max().unwrap_or(0);
        Self { name, width, cell: Box::new(move |row| cells[index(row)].clone()) }
    }
}

impl<'a> Table<'a> {
    pub fn new(plan: &'a Plan, options: &SweepOptions) -> Result<Self, Refusal> {
        let titles = plan.lines.iter().map(|line| line.title.clone()).collect();
        let mut columns = vec![Column::new("layout", titles, |row| row.point.line)];
        for (number, axis) in plan.axes.iter().enumerate() {
            columns.push(Column::new(&axis.name, axis.values.clone(), move |row| row.point.values[number]));
        }
        if !options.order.is_empty() {
            let seeds = options.order.iter().map(u64::to_string).collect();
            columns.push(Column::new("order_seed", seeds, |row| row.point.order));
        }
        if !options.io_delay.is_empty() {
            columns.push(Column::new("io_delay", options.io_delay.clone(), |row| row.point.delay));
        }
        let (format, quiet) = (options.format, options.quiet);
        let grid = if format == TableFormat::Text && !quiet { Grid::of(plan) } else { None };
        let names: Vec<&str> = columns.iter().map(|c| c.name).collect();
        let measured = options.beside.as_ref().map(|path| Measured::read(path, &names)).transpose()?;
        let replications = options.replications.get();
        Ok(Self { plan, format, quiet, rows: 0, columns, grid, measured, replications })
    }

    pub fn begin(&self) {
        match self.format {
            TableFormat::Json => say_part!("{{\"rows\":["),
            TableFormat::Csv => {
                let of_point = self.columns.iter().map(|c| c.name);
                let of_measured = self.measured.iter().flat_map(|_| MEASURED_COLUMNS);
                let of_runs = if self.replications > 1 { &RUNS_COLUMNS[..] } else { &[] };
                let names = of_point
                    .chain(CSV_COLUMNS)
                    .chain(of_runs.iter().copied())
                    .chain(of_measured)
                    .map(csv::field)
                    .collect::<Vec<_>>();
                say!("{}", names.join(","));
            }
            TableFormat::Text if !self.quiet => {
                let (orders, each, simulated) = ("orders", "s/order", "simulated");
                let names = self.text(|c| c.name.into());
                let beside =
                    self.measured.as_ref().map_or_else(String::new, |_| beside_text("measured", "ratio"));
                let runs = if self.replications > 1 { runs_text("+-", "runs") } else { String::new() };
                say!("{names}  {orders:>11}  {each:>9}{runs}{beside}  {simulated:>12}  reason");
            }
            TableFormat::Text | TableFormat::Jsonl => {}
        }
    }

    pub fn row(&mut self, row: &Row) {
        let beside = self.beside(row);
        match self.format {
            TableFormat::Json => {
                let before = if self.rows == 0 { "\n" } else { ",\n" };
                say_part!("{before}{}", self.json(row, beside));
            }
            TableFormat::Jsonl => say!("{}", self.json(row, beside)),
            TableFormat::Csv => {
                let of_point = self.columns.iter().map(|c| (c.cell)(row));
                let cells: Vec<String> = of_point
                    .chain(csv_cells(row))
                    .chain(if self.replications > 1 { runs_cells(row).to_vec() } else { Vec::new() })
                    .chain(beside.into_iter().flat_map(beside_cells))
                    .map(|c| csv::field(&c))
                    .collect();
                say!("{}", cells.join(","));
            }
            TableFormat::Text if self.quiet && row.finished => {}
            TableFormat::Text => {
                let point = self.text(|c| (c.cell)(row));
                let orders = row.orders.map_or_else(|| "-".into(), |n| format!("{} of {n}", row.orders_done));
                let seconds = |value: Option<f64>| value.map_or_else(|| "-".into(), |s| format!("{s:.2}"));
                let (each, simulated) = (seconds(row.seconds_per_order), seconds(row.simulated_s));
                let beside = beside.map_or_else(String::new, |beside| {
                    let ratio = beside.ratio.map_or_else(|| "-".into(), |r| format!("{r:.3}"));
                    beside_text(&seconds(beside.seconds_per_order), &ratio)
                });
                let runs = if self.replications > 1 {
                    runs_text(&seconds(row.half_width), &format!("{} of {}", row.finished_runs, row.runs))
                } else {
                    String::new()
                };
                say!("{point}  {orders:>11}  {each:>9}{runs}{beside}  {simulated:>12}  {}", row.reason);
            }
        }
        if let Some(grid) = &mut self.grid {
            grid.take(row);
        }
        self.rows += 1;
    }

    pub fn end(&self) {
        let rms = self.measured.as_ref().and_then(Measured::rms);
        if self.format == TableFormat::Json {
            let rms = rms.map_or_else(String::new, |(rms, _)| format!(",\"rms\":{}", json!(rms)));
            say!("\n]{rms}}}");
        }
        if let Some(grid) = &self.grid {
            say_part!("\n{}", grid.text(self.plan));
        }
        if self.format == TableFormat::Text
            && let Some((rms, ratios)) = rms
        {
            say!("\nRMS of what the {ratios} ratios differ from 1: {:.1} %", rms * 100.0);
        }
    }

    /// What the measured figures say of a row's point; none without such figures.
    fn beside(&mut self, row: &Row) -> Option<Beside> {
        let columns = &self.columns;
        let cell =
            |name: &str| columns.iter().find(|c| c.name == name).map_or_else(String::new, |c| (c.cell)(row));
        let seconds = row.seconds_per_order.filter(|_| row.finished);
        self.measured.as_mut().map(|measured| measured.beside(seconds, cell))
    }

    fn json(&self, row: &Row, beside: Option<Beside>) -> Value {
        let mut json = row.to_json(self.plan);
        if let Some(beside) = beside {
            json["measured_seconds_per_order"] = json!(beside.seconds_per_order);
            json["ratio"] = json!(beside.ratio);
        }
        json
    }

    /// Cells of the columns of text, each as wide as its column.
    fn text(&self, cell: impl Fn(&Column) -> String) -> String {
        let mut cells = self.columns.iter();
        let layout = cells.next().map(|c| format!("{:width$}", cell(c), width = c.width));
        let values = cells.map(|c| format!("{:>width$}", cell(c), width = c.width));
        layout.into_iter().chain(values).collect::<Vec<_>>().join("  ")
    }
}

const CSV_COLUMNS: [&str; 7] =
    ["finished", "reason", "orders_done", "orders", "seconds_per_order", "simulated_s", "trace_hash"];

/// Columns that stand there if there are measured figures.
const MEASURED_COLUMNS: [&str; 2] = ["measured_seconds_per_order", "ratio"];

fn beside_cells(beside: Beside) -> [String; 2] {
    [beside.seconds_per_order, beside.ratio].map(|value| value.map_or_else(String::new, |v| v.to_string()))
}

/// Columns that stand there if there are several runs of each point.
const RUNS_COLUMNS: [&str; 3] = ["runs", "finished_runs", "half_width"];

fn runs_cells(row: &Row) -> [String; 3] {
    let half_width = row.half_width.map_or_else(String::new, |half| half.to_string());
    [row.runs.to_string(), row.finished_runs.to_string(), half_width]
}

fn runs_text(half_width: &str, runs: &str) -> String {
    format!("  {half_width:>6}  {runs:>9}")
}

fn beside_text(measured: &str, ratio: &str) -> String {
    format!("  {measured:>9}  {ratio:>6}")
}

/// In the order of [`CSV_COLUMNS`]; empty where there is nothing.
fn csv_cells(row: &Row) -> [String; 7] {
    let number = |value: Value| if value.is_null() { String::new() } else { value.to_string() };
    [
        row.finished.to_string(),
        row.reason.clone(),
        row.orders_done.to_string(),
        number(json!(row.orders)),
        number(json!(row.seconds_per_order)),
        number(json!(row.simulated_s)),
        row.trace_hash.clone().unwrap_or_default(),
    ]
}
