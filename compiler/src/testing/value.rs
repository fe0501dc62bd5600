//! Names and values of a test, as those of a system.

use super::{Literal, LiteralKind, Path};
use crate::diagnostic::{Diagnostic, suggestion};
use crate::ir::{Extent, Group, Named, Scalar, System, Value};
use crate::source::Span;

/// The value that a path of a test of this machine names.
pub fn named(system: &System, machine: usize, path: &Path) -> Result<Named, Box<Diagnostic>> {
    let robot = match &path.machine {
        None => machine,
        Some(name) => instance(system, name, path.span)?,
    };
    let mut values = system.values_of(robot, system.traces()[robot]);
    // Of another machine only what it shows.
    values.retain(|value| robot == machine || value.group == Group::Cell);
    let elements: Vec<Named> =
        values.iter().filter(|value| system.array_of(value.element).0 == path.name).cloned().collect();
    let Some(first) = elements.first() else {
        let name = &system.instances[robot].name;
        let message = format!("`{name}` has no port, cell or variable `{}`", path.name);
        let mut known: Vec<&str> = values.iter().map(|value| system.array_of(value.element).0).collect();
        known.dedup();
        return Err(unknown(path.span, message, &path.name, &known));
    };
    let count = elements.len();
    let index = match (&path.index, system.array_of(first.element).1) {
        (None, Extent::One) => 0,
        (Some(index), Extent::By(id)) => literal(system, Scalar::Enum(id), index).map(ordinal)?,
        (Some(index), Extent::Count(_)) => {
            literal(system, Scalar::Int { lo: 0, hi: count as i32 - 1 }, index).map(ordinal)?
        }
        (Some(index), Extent::One) => {
            let message = format!("`{}` is not an array", path.name);
            return Err(Diagnostic::new("E0903", index.span, message).help("remove the index").into());
        }
        (None, _) => {
            let message = format!("`{}` is an array of {count}", path.name);
            let help = format!("name an element, such as `{}[0]`", path.name);
            return Err(Diagnostic::new("E0903", path.span, message).help(help).into());
        }
    };
    Ok(elements[index].clone())
}

fn ordinal(value: Value) -> usize {
    match value {
        Value::Int(ordinal) => ordinal as usize,
        _ => 0,
    }
}

/// A machine by its name.
pub fn instance(system: &System, name: &str, span: Span) -> Result<usize, Box<Diagnostic>> {
    let known: Vec<&str> = system.instances.iter().map(|instance| instance.name.as_str()).collect();
    let found = known.iter().position(|known| *known == name);
    found.ok_or_else(|| unknown(span, format!("the layout has no machine `{name}`"), name, &known))
}

/// A state of a machine by its name.
pub fn state(system: &System, machine: usize, name: &str, span: Span) -> Result<usize, Box<Diagnostic>> {
    let automaton = system.automaton_of(machine);
    let known: Vec<&str> = automaton.states.iter().map(|state| state.name.as_str()).collect();
    let found = known.iter().position(|known| *known == name);
    found.ok_or_else(|| unknown(span, format!("`{}` has no state `{name}`", automaton.name), name, &known))
}

/// Names that a message lists.
const MOST_LISTED: usize = 40;

fn unknown(span: Span, message: String, name: &str, known: &[&str]) -> Box<Diagnostic> {
    let help = match suggestion(name, known.iter().copied()) {
        Some(near) => format!("is `{near}` meant?"),
        None => format!("there are {}", known[..known.len().min(MOST_LISTED)].join(", ")),
    };
    Diagnostic::new("E0902", span, message).help(help).into()
}

fn wrong(literal: &Literal, wanted: &str) -> Box<Diagnostic> {
    Diagnostic::new("E0903", literal.span, format!("this is not {wanted}"))
        .help(format!("write {wanted}"))
        .into()
}

/// A value of this type.
pub fn literal(system: &System, ty: Scalar, literal: &Literal) -> Result<Value, Box<Diagnostic>> {
    use LiteralKind::{Duration, Number, Point, Word};
    let whole = |number: f64| (number.fract() == 0.0).then_some(number);
    match (ty, &literal.kind) {
        (Scalar::Bool, Word(word)) if word == "true" => Ok(Value::Bool(true)),
        (Scalar::Bool, Word(word)) if word == "false" => Ok(Value::Bool(false)),
        (Scalar::Bool, _) => Err(wrong(literal, "`true` or `false`")),
        (Scalar::Int { lo, hi }, Number(number)) => whole(*number)
            .filter(|number| (f64::from(lo)..=f64::from(hi)).contains(number))
            .map(|number| Value::Int(number as i32))
            .ok_or_else(|| wrong(literal, &format!("a whole number from {lo} to {hi}"))),
        (Scalar::Int { lo, hi }, _) => Err(wrong(literal, &format!("a whole number from {lo} to {hi}"))),
        (Scalar::Real, Number(number)) => Ok(Value::Real(*number)),
        (Scalar::Real, _) => Err(wrong(literal, "a number")),
        (Scalar::Time, Duration(ms)) => {
            i32::try_from(*ms).map(Value::Int).map_err(|_| wrong(literal, "a shorter time"))
        }
        (Scalar::Time, _) => Err(wrong(literal, "a time such as `100 ms`")),
        (Scalar::Point, Point(point)) => Ok(Value::Point(*point)),
        (Scalar::Point, _) => Err(wrong(literal, "a point such as `point(1, 2.5, 0)`")),
        (Scalar::Enum(id), Word(word)) => {
            let members: Vec<&str> = system.model.enums[id.0].members.iter().map(String::as_str).collect();
            let found = members.iter().position(|member| member == word);
            let name = &system.model.enums[id.0].name;
            found.map(|ordinal| Value::Int(ordinal as i32)).ok_or_else(|| {
                unknown(literal.span, format!("`{name}` has no member `{word}`"), word, &members)
            })
        }
        (Scalar::Enum(id), _) => {
            Err(wrong(literal, &format!("a member of `{}`", system.model.enums[id.0].name)))
        }
        (Scalar::Ref(id), Word(word)) => {
            let machine = instance(system, word, literal.span)?;
            let row = system.members[id.0].iter().position(|member| *member == machine);
            row.map(|row| Value::Int(row as i32)).ok_or_else(|| {
                wrong(literal, &format!("a machine that is `{}`", system.model.interfaces[id.0].name))
            })
        }
        (Scalar::Ref(_), _) => Err(wrong(literal, "the name of a machine")),
    }
}
