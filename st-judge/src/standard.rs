//! Standard functions that all compilers know and compute alike. They are called by position.

use crate::types::{Narrow, Scalar, Type};

/// The type of the result for arguments of these types; None if the function does not take them.
pub fn result(name: &str, arguments: &[Type]) -> Option<Type> {
    use Scalar::{Bool, Dint, Lreal};
    let scalars: Vec<Scalar> = arguments
        .iter()
        .map(|ty| match ty {
            Type::Scalar(scalar) => Some(*scalar),
            _ => None,
        })
        .collect::<Option<_>>()?;
    let same = |scalars: &[Scalar]| scalars.windows(2).all(|pair| pair[0] == pair[1]);
    let numbers = |scalars: &[Scalar]| same(scalars) && scalars.iter().all(|s| s.is_number());
    let result = match (name.to_ascii_uppercase().as_str(), scalars.as_slice()) {
        ("SQRT" | "SIN" | "COS" | "TAN" | "ASIN" | "ACOS" | "ATAN" | "EXP" | "LN", [Lreal]) => Lreal,
        ("EXPT", [Lreal, Lreal]) => Lreal,
        ("ABS", [one]) if one.is_number() => *one,
        ("MIN" | "MAX", [one, _]) if numbers(&scalars) => *one,
        ("LIMIT", [one, _, _]) if numbers(&scalars) => *one,
        ("SEL", [Bool, one, other]) if one == other => *one,
        ("TRUNC", [Lreal]) => Dint,
        ("DINT_TO_LREAL", [Dint]) => Lreal,
        ("BOOL_TO_DINT", [Bool]) => Dint,
        (name, [from]) => match (narrow(name)?, *from) {
            (Narrowing::From(narrow), Scalar::Narrow(found)) if found == narrow => Dint,
            (Narrowing::To(narrow), Dint) => Scalar::Narrow(narrow),
            _ => return None,
        },
        _ => return None,
    };
    Some(Type::Scalar(result))
}

/// Conversions between DINT and a type of the process image. That to DINT keeps the value; that from DINT is
/// the same everywhere for what the narrow type holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Narrowing {
    From(Narrow),
    To(Narrow),
}

/// The conversion of this name, in capital letters.
pub fn narrow(name: &str) -> Option<Narrowing> {
    match name.split_once("_TO_")? {
        ("DINT", to) => Narrow::named(to).map(Narrowing::To),
        (from, "DINT") => Narrow::named(from).map(Narrowing::From),
        _ => None,
    }
}

const NAMES: [&str; 18] = [
    "SQRT",
    "ABS",
    "SIN",
    "COS",
    "TAN",
    "ATAN",
    "ASIN",
    "ACOS",
    "EXP",
    "LN",
    "EXPT",
    "TRUNC",
    "MIN",
    "MAX",
    "LIMIT",
    "SEL",
    "DINT_TO_LREAL",
    "BOOL_TO_DINT",
];

pub fn is_standard(name: &str) -> bool {
    NAMES.iter().any(|n| n.eq_ignore_ascii_case(name)) || narrow(&name.to_ascii_uppercase()).is_some()
}
