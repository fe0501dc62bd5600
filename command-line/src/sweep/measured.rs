//! Figures from elsewhere, to stand beside the rows of a sweep.

use super::super::load;
use super::plan::Refusal;
use autogen::csv::{self, Field};
use autogen::source::Sources;
use std::collections::BTreeMap;
use std::path::Path;

const FIGURE: &str = "seconds_per_order";

/// A table that names points as the sweep's own CSV does, by some of its columns, and gives seconds per order.
pub struct Measured {
    name: String,
    /// By what a point is called, in the order of [`Self::keys`].
    rows: BTreeMap<Vec<String>, Given>,
    keys: Vec<String>,
    /// Squares of what the ratios of here and there differ from 1, their sum and number.
    squares: f64,
    ratios: u32,
}

/// A line of the table.
struct Given {
    line: usize,
    figure: Option<f64>,
    /// It stands beside a row of the sweep.
    is_used: bool,
}

/// What stands beside a row.
#[derive(Clone, Copy, Debug, Default)]
pub struct Beside {
    pub seconds_per_order: Option<f64>,
    /// Here by there.
    pub ratio: Option<f64>,
}

impl Measured {
    /// Every column but that of the figures has to be one of `columns`, by which a sweep names its points;
    /// no two rows may name the same point.
    pub(crate) fn read(path: &Path, columns: &[&str]) -> Result<Self, Refusal> {
        let text = load::text_of_table(path).map_err(Refusal::Failure)?;
        Self::parse(&path.display().to_string(), &text, columns).map_err(Refusal::Said)
    }

    /// The text of a table; an error says what is wrong with it, and begins with its name.
    pub fn parse(name: &str, text: &str, columns: &[&str]) -> Result<Self, String> {
        let said = |text: String| format!("{name}: {text}");
        let mut sources = Sources::default();
        let file = sources.add(name, text);
        let mut found = Vec::new();
        let table = csv::parse(file, &sources.file(file).text, &mut found);
        if let Some(wrong) = found.first() {
            return Err(said(format!("line {}: {}", sources.position(wrong.place).0, wrong.message)));
        }
        let texts = |record: &[Field]| record.iter().map(|field| field.text.clone()).collect::<Vec<_>>();
        let mut records = table.records.iter();
        let head = records.next().map_or_else(Vec::new, |record| texts(record));
        let figure = head.iter().position(|column| column == FIGURE);
        let figure = figure.ok_or_else(|| said(format!("the first line has no column `{FIGURE}`")))?;
        let mut keys = head.clone();
        keys.remove(figure);
        for (i, key) in keys.iter().enumerate() {
            if !columns.contains(&key.as_str()) {
                let known = columns.join(", ");
                return Err(said(format!(
                    "the sweep has no column `{key}`; its points are named by {known}"
                )));
            }
            if keys[..i].contains(key) {
                return Err(said(format!("the column `{key}` occurs twice")));
            }
        }
        let mut rows = BTreeMap::new();
        for record in records {
            let number = || sources.position(record[0].span).0;
            let mut point = texts(record);
            if point.len() != head.len() {
                let (found, wanted) = (point.len(), head.len());
                return Err(said(format!("line {}: {found} fields, {wanted} columns", number())));
            }
            let written = point.remove(figure);
            let figure =
                match written.as_str() {
                    "" => None,
                    text => Some(text.parse::<f64>().ok().filter(|s| s.is_finite() && *s > 0.0).ok_or_else(
                        || said(format!("line {}: `{text}` is not a number of seconds above 0", number())),
                    )?),
                };
            let given = Given { line: number(), figure, is_used: false };
            if rows.insert(point, given).is_some() {
                return Err(said(format!("line {}: this point occurs twice", number())));
            }
        }
        Ok(Self { name: name.into(), rows, keys, squares: 0.0, ratios: 0 })
    }

    /// What stands beside a point that came to `seconds_per_order`; `cell` gives what it is called in a column.
    pub fn beside(&mut self, seconds_per_order: Option<f64>, cell: impl Fn(&str) -> String) -> Beside {
        let point: Vec<String> = self.keys.iter().map(|key| cell(key)).collect();
        let found = self.rows.get_mut(&point).and_then(|given| {
            given.is_used = true;
            given.figure
        });
        let ratio = found.zip(seconds_per_order).map(|(there, here)| here / there);
        if let Some(ratio) = ratio {
            self.squares += (ratio - 1.0) * (ratio - 1.0);
            self.ratios += 1;
        }
        Beside { seconds_per_order: found, ratio }
    }

    /// The first line whose point is none of the sweep so far; none if there is no such line.
    pub(crate) fn unused(&self) -> Option<String> {
        let unused = || self.rows.iter().filter(|(_, given)| !given.is_used);
        let (point, Given { line, .. }) = unused().min_by_key(|(_, given)| given.line)?;
        let point: Vec<String> =
            self.keys.iter().zip(point).map(|(key, value)| format!("{key} {value}")).collect();
        let more = match unused().count() {
            1 => String::new(),
            lines => format!(" (and {} more lines)", lines - 1),
        };
        let Self { name, .. } = self;
        Some(format!("{name}: line {line}: the sweep has no point with {}{more}", point.join(", ")))
    }

    /// Root mean square of what the ratios so far differ from 1, and their number; none without a ratio.
    pub fn rms(&self) -> Option<(f64, u32)> {
        (self.ratios > 0).then(|| ((self.squares / f64::from(self.ratios)).sqrt(), self.ratios))
    }
}
