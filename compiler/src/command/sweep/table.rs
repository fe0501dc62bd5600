//! Rows on standard output, as they come.

use super::super::options::{SweepOptions, TableFormat};
use super::grid::Grid;
use super::plan::Plan;
use super::row::Row;
use serde_json::{Value, json};

pub struct Table<'a> {
    plan: &'a Plan,
    format: TableFormat,
    quiet: bool,
    rows: usize,
    columns: Vec<Column<'a>>,
    grid: Option<Grid>,
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
    pub fn new(plan: &'a Plan, options: &SweepOptions) -> Self {
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
        Self { plan, format, quiet, rows: 0, columns, grid }
    }

    pub fn begin(&self) {
        match self.format {
            TableFormat::Json => say_part!("{{\"rows\":["),
            TableFormat::Csv => {
                let of_point = self.columns.iter().map(|c| c.name);
                let names = of_point.chain(CSV_COLUMNS).map(quoted).collect::<Vec<_>>();
                say!("{}", names.join(","));
            }
            TableFormat::Text if !self.quiet => {
                let (orders, each, simulated) = ("orders", "s/order", "simulated");
                let names = self.text(|c| c.name.into());
                say!("{names}  {orders:>11}  {each:>9}  {simulated:>12}  reason");
            }
            TableFormat::Text | TableFormat::Jsonl => {}
        }
    }

    pub fn row(&mut self, row: &Row) {
        match self.format {
            TableFormat::Json => {
                let before = if self.rows == 0 { "\n" } else { ",\n" };
                say_part!("{before}{}", row.to_json(self.plan));
            }
            TableFormat::Jsonl => say!("{}", row.to_json(self.plan)),
            TableFormat::Csv => {
                let of_point = self.columns.iter().map(|c| (c.cell)(row));
                let cells: Vec<String> = of_point.chain(csv_cells(row)).map(|c| quoted(&c)).collect();
                say!("{}", cells.join(","));
            }
            TableFormat::Text if self.quiet && row.finished => {}
            TableFormat::Text => {
                let point = self.text(|c| (c.cell)(row));
                let orders = row.orders.map_or_else(|| "-".into(), |n| format!("{} of {n}", row.orders_done));
                let seconds = |value: Option<f64>| value.map_or_else(|| "-".into(), |s| format!("{s:.2}"));
                let (each, simulated) = (seconds(row.seconds_per_order), seconds(row.simulated_s));
                say!("{point}  {orders:>11}  {each:>9}  {simulated:>12}  {}", row.reason);
            }
        }
        if let Some(grid) = &mut self.grid {
            grid.take(row);
        }
        self.rows += 1;
    }

    pub fn end(&self) {
        if self.format == TableFormat::Json {
            say!("\n]}}");
        }
        if let Some(grid) = &self.grid {
            say_part!("\n{}", grid.text(self.plan));
        }
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

/// A field of CSV (RFC 4180).
fn quoted(cell: impl AsRef<str>) -> String {
    let cell = cell.as_ref();
    if cell.contains(['"', ',', '\n', '\r']) {
        format!("\"{}\"", cell.replace('"', "\"\""))
    } else {
        cell.into()
    }
}
