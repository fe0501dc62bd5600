//! The columns of a table, found by the names in its first line.

use crate::csv::{Field, Table};
use crate::diagnostic::{Diagnostic, suggestion};
use crate::source::{FileId, Span};

/// Columns that a table must have.
const NEEDED: [&str; 7] = ["robot", "name", "address", "raw type", "scale", "offset", "inversion"];
/// Columns that are compared with the line if they are there.
const KNOWN: [&str; 2] = ["direction", "type"];

/// Where each column stands. Columns of other names are the user's own.
pub struct Columns {
    at: Vec<(&'static str, usize)>,
    /// Number of fields of the first line.
    width: usize,
}

/// A row by the names of its columns.
pub struct Record<'r> {
    columns: &'r Columns,
    pub fields: &'r [Field],
}

impl Columns {
    pub fn find(file: FileId, table: &Table, found: &mut Vec<Diagnostic>) -> Option<Self> {
        let Some(header) = table.records.first() else {
            let place = Span::new(file, 0, 0);
            found.push(Diagnostic::new("E0602", place, "the table is empty").help(form()));
            return None;
        };
        let count = found.len();
        let mut at = Vec::new();
        for name in NEEDED.into_iter().chain(KNOWN) {
            let mut places = (0..header.len()).filter(|i| header[*i].text.eq_ignore_ascii_case(name));
            match (places.next(), places.next()) {
                (Some(_), Some(second)) => found.push(
                    Diagnostic::new("E0602", header[second].span, format!("two columns are named `{name}`"))
                        .label("the second one")
                        .help("rename or remove one of them"),
                ),
                (Some(only), None) => at.push((name, only)),
                (None, _) if KNOWN.contains(&name) => {}
                (None, _) => found.push(missing(name, header)),
            }
        }
        (found.len() == count).then_some(Self { at, width: header.len() })
    }

    /// The row, if it has no fields beyond the columns.
    pub fn row<'r>(&'r self, fields: &'r [Field], found: &mut Vec<Diagnostic>) -> Option<Record<'r>> {
        match fields.iter().skip(self.width).find(|f| !f.text.is_empty()) {
            None => Some(Record { columns: self, fields }),
            Some(extra) => {
                found.push(
                    Diagnostic::new("E0601", extra.span, "the row has more fields than the first line has columns")
                        .label(format!("field {}, of {}", self.width + 1, self.width))
                        .help("put a text that contains the separator into quotes; if commas separate fields, write decimals with a point"),
                );
                None
            }
        }
    }
}

impl<'r> Record<'r> {
    /// None if the column is not there, the row is too short, or the field is empty.
    pub fn get(&self, name: &str) -> Option<&'r Field> {
        let at = self.columns.at.iter().find(|(known, _)| *known == name)?.1;
        self.fields.get(at).filter(|field| !field.text.is_empty())
    }

    pub fn text(&self, name: &str) -> &'r str {
        self.get(name).map_or("", |field| field.text.as_str())
    }

    /// The place of a field, or of the whole row if it is empty.
    pub fn place(&self, name: &str) -> Option<Span> {
        let row = || Some(self.fields.first()?.span.to(self.fields.last()?.span));
        self.get(name).map(|field| field.span).or_else(row)
    }
}

fn missing(name: &str, header: &[Field]) -> Diagnostic {
    let others = header.iter().map(|f| f.text.as_str()).filter(|t| !NEEDED.contains(t) && !t.is_empty());
    let near = suggestion(name, others).and_then(|near| header.iter().find(|f| f.text == near));
    let place = near.map_or(header[0].span.to(header[header.len() - 1].span), |f| f.span);
    let help = match near {
        Some(field) => format!("call the column `{name}` instead of `{}`", field.text),
        None => form(),
    };
    Diagnostic::new("E0602", place, format!("the table has no column `{name}`"))
        .label("the names of the columns")
        .help(help)
}

fn form() -> String {
    format!(
        "begin with plc/io.csv as `build` writes it; its first line names the columns {}",
        NEEDED.join(", ")
    )
}
