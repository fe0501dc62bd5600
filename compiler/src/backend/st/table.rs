//! Tables as comma-separated values.

use super::context::Shared;
use super::points::{Terminal, terminals};
use crate::csv;
use crate::io_map::{Conversion, IoMap, Wire};
use crate::naming::st::Renamed;
use runtime_sim::device::Direction;
use std::fmt::{self, Formatter};

/// A line of fields.
pub fn row(fields: &[&str]) -> String {
    let mut line = String::new();
    for (i, text) in fields.iter().enumerate() {
        if i > 0 {
            line.push(',');
        }
        line += &csv::field(text);
    }
    line.push('\n');
    line
}

/// The names that could not stay as the specification has them.
pub fn renamed(names: &[(String, Renamed)]) -> String {
    let mut text = row(&["unit", "wanted", "name", "reason"]);
    for (unit, renamed) in names {
        text += &row(&[unit, &renamed.wanted, &renamed.name, renamed.reason]);
    }
    text
}

const IO: [&str; 12] = [
    "robot",
    "name",
    "direction",
    "type",
    "unit",
    "stop value",
    "meaning",
    "address",
    "raw type",
    "scale",
    "offset",
    "inversion",
];

/// Every point of I/O by the name of its variable. The columns behind the meaning are for a person to fill;
/// they hold what the map says.
pub fn io(shared: Shared, map: &IoMap, to: &mut Formatter) -> fmt::Result {
    to.write_str(&row(&IO))?;
    for (number, Terminal { point, .. }) in terminals(shared.system, shared.names).enumerate() {
        let direction = if point.direction == Direction::Input { "input" } else { "output" };
        let about = [&point.robot, &point.name, direction, point.kind.name(), &point.unit, &point.stop];
        let wired = map.wire(number).map(wire).unwrap_or_default();
        let fields: Vec<&str> = about
            .into_iter()
            .chain([point.meaning.as_str()])
            .chain(wired.iter().map(String::as_str))
            .collect();
        to.write_str(&row(&fields))?;
    }
    Ok(())
}

/// Address, raw type, scale, offset, inversion.
fn wire(wire: &Wire) -> [String; 5] {
    let (scale, offset, inversion) = match wire.conversion {
        Conversion::None => (String::new(), String::new(), ""),
        Conversion::Inverted => (String::new(), String::new(), "TRUE"),
        Conversion::Shifted(offset) => (String::new(), offset.to_string(), ""),
        Conversion::Scaled { scale, offset } => (unless(scale, 1.0), unless(offset, 0.0), ""),
    };
    [wire.address.to_string(), wire.raw.name().into(), scale, offset, inversion.into()]
}

/// A number, or nothing if it is the one that an empty field stands for.
fn unless(number: f64, empty: f64) -> String {
    if number == empty { String::new() } else { format!("{number:?}") }
}
