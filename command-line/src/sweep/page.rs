//! The options `--report` and `--keep`: the page of a sweep, and those of some of its runs.

use super::super::interrupt;
use super::super::pending::{self, Content, Foreign, Pending};
use super::axis::Axis;
use super::design::{Asked, Design, RunNumber};
use super::plan::Plan;
use super::{facts, point};
use autogen::backend::report::sweep::{Fact, Figure, Name, Sweep, Table, Values};
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// What is asked for.
pub struct Request {
    file: Pending,
    keep: Keep,
}

enum Keep {
    All,
    /// Numbers from 1.
    Rows(BTreeSet<usize>),
}

impl Request {
    /// None if no page is asked for; an error says what is wrong with the options.
    pub fn new(report: Option<&Path>, keep: Option<&str>, design: &Design) -> Result<Option<Self>, String> {
        let Some(path) = report else { return Ok(None) };
        let points = design.points().unwrap_or(0);
        let number = |text: &str| text.trim().parse().ok().filter(|row| (1..=points).contains(row));
        let keep = match keep {
            None => Keep::Rows(BTreeSet::new()),
            Some("all") => Keep::All,
            Some(text) => {
                let rows = text.split(',').map(|text| {
                    number(text).ok_or_else(|| {
                        format!("--keep {text}: it takes `all`, or numbers of rows from 1 to {points}, such as 1,4")
                    })
                });
                Keep::Rows(rows.collect::<Result<_, _>>()?)
            }
        };
        let request = Self { file: Pending::new(path, Content::Report, Foreign::Stays)?, keep };
        // A sweep may be long, and it is better to know before it.
        for row in (1..=points).filter(|row| request.keeps(*row)) {
            pending::check(&page_of(path, row), Content::Report, Foreign::Stays)?;
        }
        Ok(Some(request))
    }

    fn keeps(&self, row: usize) -> bool {
        match &self.keep {
            Keep::All => true,
            Keep::Rows(rows) => rows.contains(&row),
        }
    }

    /// Runs again what is to be kept, and writes the pages of these runs; their addresses by the numbers of their rows.
    pub fn write_kept(&self, plan: &Plan, rows: usize) -> Result<BTreeMap<usize, String>, String> {
        let folder = folder(self.file.path());
        let mut kept = BTreeMap::new();
        for row in (1..=rows).filter(|row| self.keeps(*row)) {
            // A point that was refused has its reason in the table.
            let Ok(page) = point::page(plan, RunNumber { point: row - 1, replication: 0 }) else { continue };
            fs::create_dir_all(&folder).map_err(|e| format!("{}: {e}", folder.display()))?;
            let file = Pending::new(&page_of(self.file.path(), row), Content::Report, Foreign::Stays)?;
            file.write(&page)?;
            let _writing = interrupt::writing();
            file.keep()?;
            kept.insert(row, format!("{}/{}", encoded(&folder), name_of(row)));
        }
        Ok(kept)
    }

    /// Writes the page of the sweep.
    pub fn write(
        self,
        design: &Design,
        facts: Vec<Fact>,
        table: Table,
        kept: BTreeMap<usize, String>,
    ) -> Result<(), String> {
        let sweep = Sweep {
            title: facts::title(design),
            facts,
            figure: match design.asked {
                Asked::Orders => Figure::SecondsPerOrder,
                Asked::Items => Figure::SecondsUntilGoal,
                Asked::Throughput => Figure::ItemsPerHour,
            },
            names: names(design),
            table,
            kept,
        };
        self.file.write(&sweep.html())?;
        let _writing = interrupt::writing();
        self.file.keep()
    }
}

/// Beside the page: its name without the end, and `-runs`.
fn folder(page: &Path) -> PathBuf {
    let stem = page.file_stem().map_or_else(Default::default, |stem| stem.to_string_lossy().into_owned());
    page.with_file_name(format!("{stem}-runs"))
}

fn name_of(row: usize) -> String {
    format!("row-{row}.html")
}

fn page_of(page: &Path, row: usize) -> PathBuf {
    folder(page).join(name_of(row))
}

/// The name of the folder as an address has it.
fn encoded(folder: &Path) -> String {
    let name = folder.file_name().map_or_else(Default::default, |name| name.to_string_lossy().into_owned());
    let plain = |byte: u8| byte.is_ascii_alphanumeric() || b"-_.".contains(&byte);
    let address: String = (name.bytes())
        .map(|byte| if plain(byte) { char::from(byte).to_string() } else { format!("%{byte:02X}") })
        .collect();
    format!("./{address}")
}

/// What names the rows, in the order of the table's columns.
pub fn names(design: &Design) -> Vec<Name> {
    let name = |title: &str, values| Name { title: title.into(), values };
    let layouts = name("layout", Values::Words(design.layouts.clone()));
    let axes = design.axes.iter().map(|axis| name(&axis.name, values(axis)));
    let seeds = || Values::Words(design.orders.iter().map(u64::to_string).collect());
    let orders = (!design.orders.is_empty()).then(|| name("order_seed", seeds()));
    let delays = (!design.delays.is_empty()).then(|| name("io_delay", numbers_or_words(&design.delays)));
    [layouts].into_iter().chain(axes).chain(orders).chain(delays).collect()
}

/// A seed is a number that measures nothing.
fn values(axis: &Axis) -> Values {
    match axis.name.rsplit_once('.') {
        Some((_, "seed")) => Values::Words(axis.values.clone()),
        _ => numbers_or_words(&axis.values),
    }
}

fn numbers_or_words(values: &[String]) -> Values {
    let is_number = |text: &String| text.parse().is_ok_and(f64::is_finite);
    let of = if values.iter().all(is_number) { Values::Numbers } else { Values::Words };
    of(values.to_vec())
}
