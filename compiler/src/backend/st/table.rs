//! Tables as comma-separated values.

use crate::naming::st::Renamed;

/// A line of fields, in quotes where they need them.
pub fn row(fields: &[&str]) -> String {
    let field = |text: &&str| match text.contains([',', '"', '\n', ';']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_string(),
    };
    fields.iter().map(field).collect::<Vec<_>>().join(",") + "\n"
}

/// The names that could not stay as the specification has them.
pub fn renamed(names: &[(String, Renamed)]) -> String {
    let mut text = row(&["unit", "wanted", "name", "reason"]);
    for (unit, renamed) in names {
        text += &row(&[unit, &renamed.wanted, &renamed.name, renamed.reason]);
    }
    text
}
