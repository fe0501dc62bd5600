//! Standard functions that all compilers know and compute alike. They are called by position.

use crate::types::{Scalar, Type};

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
    let numbers = |scalars: &[Scalar]| same(scalars) && !scalars.contains(&Bool);
    let result = match (name.to_ascii_uppercase().as_str(), scalars.as_slice()) {
        ("SQRT" | "SIN" | "COS" | "TAN" | "ASIN" | "ACOS" | "ATAN" | "EXP" | "LN", [Lreal]) => Lreal,
        ("EXPT", [Lreal, Lreal]) => Lreal,
        ("ABS", [one]) if *one != Bool => *one,
        ("MIN" | "MAX", [one, _]) if numbers(&scalars) => *one,
        ("LIMIT", [one, _, _]) if numbers(&scalars) => *one,
        ("SEL", [Bool, one, other]) if one == other => *one,
        ("TRUNC", [Lreal]) => Dint,
        ("DINT_TO_LREAL", [Dint]) => Lreal,
        ("BOOL_TO_DINT", [Bool]) => Dint,
        _ => return None,
    };
    Some(Type::Scalar(result))
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
    NAMES.iter().any(|n| n.eq_ignore_ascii_case(name))
}
