//! The process image: variables at addresses, and how values come from them and go to them.
//!
//! A scalar whose raw value is its value stands at the address itself. Every other point has a raw variable
//! beside it; the program converts inputs before everything else and outputs behind everything else.

use super::code::{Ex, Stmt, assign, binary, name, not, real};
use super::declaration::{Basic, Variable};
use super::name::Name;
use super::names::{Names, ROUNDED};
use super::points::{Terminal, terminals};
use crate::io_map::{Conversion, IoMap, Kind, Raw, Wire};
use crate::ir::System;
use crate::naming::st::Scope;
use runtime_sim::device::Direction;
use std::collections::BTreeMap;

#[derive(Default)]
pub struct Image {
    /// Addresses of variables that stand there themselves, by name.
    pub located: BTreeMap<Name, String>,
    pub raw: Vec<Variable>,
    pub inputs: Vec<Stmt>,
    pub outputs: Vec<Stmt>,
    pub wired: Vec<Wired>,
}

/// A variable that has the raw value of an address.
pub struct Wired {
    pub variable: Name,
    pub direction: Direction,
    pub wire: Wire,
}

/// The image of a line. Raw variables are named last, so that no other name depends on the table.
pub fn image(system: &System, names: &Names, map: &IoMap, program: &mut Scope) -> Image {
    let mut image = Image::default();
    if map.is_empty() {
        return image;
    }
    for (number, terminal) in terminals(system, names).enumerate() {
        let Some(wire) = map.wire(number) else { continue };
        let wired = |variable: &str| Wired {
            variable: variable.into(),
            direction: terminal.point.direction,
            wire: *wire,
        };
        if stands_there_itself(&terminal, wire) {
            image.located.insert(terminal.variable.clone(), wire.address.to_string());
            image.wired.push(wired(&terminal.variable));
            continue;
        }
        let element = terminal.element.map(|i| format!("_{i}")).unwrap_or_default();
        let raw = program.take_all(&format!("{}{element}", terminal.variable), &["_raw"]).concat();
        image.raw.push(variable(&terminal, wire, &raw));
        image.wired.push(wired(&raw));
        match terminal.point.direction {
            Direction::Input => {
                image.inputs.push(Stmt::Assign(terminal.place(), value(&terminal, wire, &raw)))
            }
            Direction::Output => image.outputs.extend(store(wire, terminal.place(), &raw)),
        }
    }
    image
}

fn stands_there_itself(terminal: &Terminal, wire: &Wire) -> bool {
    terminal.is_own
        && terminal.element.is_none()
        && wire.conversion == Conversion::None
        && terminal.basic() == Basic::from(wire.raw)
}

fn variable(terminal: &Terminal, wire: &Wire, raw: &str) -> Variable {
    let variable = Variable::new(raw, Basic::from(wire.raw)).with_address(wire.address.to_string());
    match &terminal.first {
        Some(first) => variable.with_initial(first_raw(wire, first)),
        None => variable,
    }
}

/// The raw value of a constant.
fn first_raw(wire: &Wire, first: &Ex) -> Ex {
    match (first, wire.conversion) {
        (Ex::Bool(b), conversion) => Ex::Bool(*b != (conversion == Conversion::Inverted)),
        (Ex::Int(i), Conversion::Shifted(offset)) => Ex::Int(i.saturating_sub(offset)),
        (Ex::Real(r), Conversion::Scaled { scale, offset }) => {
            Ex::Int(wire.raw.rounded((r - offset) / scale))
        }
        (other, _) => other.clone(),
    }
}

/// A raw value of a narrow type as DINT.
fn widened(raw: Raw, value: Ex) -> Ex {
    let function = match raw {
        Raw::Bool | Raw::Dint => return value,
        Raw::Sint => "SINT_TO_DINT",
        Raw::Usint => "USINT_TO_DINT",
        Raw::Int => "INT_TO_DINT",
        Raw::Uint => "UINT_TO_DINT",
    };
    Ex::Call(function, vec![("", value)])
}

/// A DINT within the bounds of a narrow type as one of it.
fn narrowed(raw: Raw, value: Ex) -> Ex {
    let function = match raw {
        Raw::Bool | Raw::Dint => return value,
        Raw::Sint => "DINT_TO_SINT",
        Raw::Usint => "DINT_TO_USINT",
        Raw::Int => "DINT_TO_INT",
        Raw::Uint => "DINT_TO_UINT",
    };
    Ex::Call(function, vec![("", value)])
}

/// The value of an input.
fn value(terminal: &Terminal, wire: &Wire, raw: &str) -> Ex {
    let read = widened(wire.raw, name(raw));
    match (wire.conversion, terminal.point.kind) {
        (Conversion::None, _) => read,
        (Conversion::Inverted, _) => not(read),
        (Conversion::Shifted(offset), kind) => {
            let read = match (wire.raw, kind) {
                // 32 bits may leave DINT; what is beyond the bounds of the port is limited anyway.
                (Raw::Dint, Kind::Int { lo, hi }) => {
                    let bounds = (lo.saturating_sub(offset), hi.saturating_sub(offset));
                    Ex::Call(
                        "F_limit",
                        vec![("low", Ex::Int(bounds.0)), ("value", read), ("high", Ex::Int(bounds.1))],
                    )
                }
                _ => read,
            };
            shifted(read, offset)
        }
        (Conversion::Scaled { scale, offset }, _) => {
            let mut value = real(read);
            if scale != 1.0 {
                value = binary("*", value, Ex::Real(scale));
            }
            if offset != 0.0 {
                let operator = if offset < 0.0 { "-" } else { "+" };
                value = binary(operator, value, Ex::Real(offset.abs()));
            }
            value
        }
    }
}

/// Stores an output in its raw variable.
fn store(wire: &Wire, value: Ex, raw: &str) -> Vec<Stmt> {
    let value = raw_value(wire, value);
    match (wire.conversion, wire.raw) {
        (Conversion::Inverted, _) | (_, Raw::Bool | Raw::Dint) => vec![assign(raw, value)],
        (Conversion::Scaled { .. }, _) => {
            vec![assign(ROUNDED, value), assign(raw, narrowed(wire.raw, name(ROUNDED)))]
        }
        _ => vec![assign(raw, narrowed(wire.raw, value))],
    }
}

/// The raw value of an output, as BOOL or DINT.
fn raw_value(wire: &Wire, value: Ex) -> Ex {
    match wire.conversion {
        Conversion::None => value,
        Conversion::Inverted => not(value),
        Conversion::Shifted(offset) => shifted(value, offset.saturating_neg()),
        Conversion::Scaled { scale, offset } => {
            let mut value = value;
            if offset != 0.0 {
                let operator = if offset < 0.0 { "+" } else { "-" };
                value = binary(operator, value, Ex::Real(offset.abs()));
            }
            if scale != 1.0 {
                value = binary("/", value, Ex::Real(scale));
            }
            let (low, high) = wire.raw.bounds();
            let rounded = vec![("low", Ex::Int(low)), ("value", value), ("high", Ex::Int(high))];
            Ex::Call("F_rounded", rounded)
        }
    }
}

/// A sum, as a difference if the constant is negative.
fn shifted(value: Ex, by: i32) -> Ex {
    match by {
        0 => value,
        1.. => binary("+", value, Ex::Int(by)),
        _ => binary("-", value, Ex::Int(by.saturating_neg())),
    }
}
