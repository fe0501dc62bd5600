//! A layout as a stream of words, so that a compiled program can run another one.
//!
//! The order is that in which the generated `adapters.rs` reads: the period, the number of what is retained, for each
//! interface what its members show, the relations, and the robots in layout order.

use crate::ir::{InterfaceId, System, Value};
use std::fmt::{self, Display, Formatter, Write};

pub fn parameters_text(system: &System) -> String {
    parameters(system).to_string()
}

/// The same text, made while it is written.
pub fn parameters(system: &System) -> impl Display {
    Parameters(system)
}

struct Parameters<'a>(&'a System);

impl Display for Parameters<'_> {
    fn fmt(&self, to: &mut Formatter) -> fmt::Result {
        let Self(system) = self;
        let model = &system.model;
        write!(to, "parameters 2\nscan_ms {}\n", system.scan_ms)?;
        if model.retains() {
            writeln!(to, "retained_of {}", system.shape_of_retained())?;
        }
        for (id, interface) in model.interfaces.iter().enumerate() {
            let rows = system.members[id].len();
            writeln!(to, "{} {rows}", interface.name)?;
            for row in 0..rows {
                let mut entry = Entry::new(to);
                for number in 0..interface.parameters.len() {
                    entry.values(system.shown(InterfaceId(id), row, number))?;
                }
                entry.end()?;
            }
        }
        for (relation, rows) in model.relations.iter().zip(&system.reaches) {
            let name = |id: InterfaceId| &model.interface(id).name;
            writeln!(to, "{}_{} {}", name(relation.from), name(relation.to), rows.len())?;
            for row in rows {
                let mut entry = Entry::new(to);
                entry.word(row.len())?;
                row.iter().try_for_each(|reaches| entry.word(u8::from(*reaches)))?;
                entry.end()?;
            }
        }
        writeln!(to, "robots {}", system.instances.len())?;
        for instance in &system.instances {
            let mut entry = Entry::new(to);
            entry.word(&model.automaton(instance.automaton).name)?;
            entry.word(&instance.name)?;
            instance.parameters.iter().try_for_each(|values| entry.values(values))?;
            for rows in &instance.roles {
                entry.word(rows.len())?;
                rows.iter().try_for_each(|row| entry.word(row))?;
            }
            instance.rows.iter().try_for_each(|row| entry.word(row))?;
            entry.end()?;
        }
        to.write_str("end\n")
    }
}

/// Words on a line; no line without words.
struct Entry<'a, 'b> {
    to: &'a mut Formatter<'b>,
    between: &'static str,
}

impl<'a, 'b> Entry<'a, 'b> {
    fn new(to: &'a mut Formatter<'b>) -> Self {
        Self { to, between: "  " }
    }

    fn word(&mut self, word: impl Display) -> fmt::Result {
        self.to.write_str(self.between)?;
        self.between = " ";
        write!(self.to, "{word}")
    }

    fn values<'v>(&mut self, values: impl IntoIterator<Item = &'v Value>) -> fmt::Result {
        values.into_iter().try_for_each(|value| match *value {
            Value::Bool(b) => self.word(u8::from(b)),
            Value::Int(i) => self.word(i),
            Value::Real(r) => self.word(format_args!("{r:?}")),
            Value::Point([x, y, z]) => self.word(format_args!("{x:?} {y:?} {z:?}")),
        })
    }

    fn end(self) -> fmt::Result {
        if self.between == " " { self.to.write_char('\n') } else { Ok(()) }
    }
}
