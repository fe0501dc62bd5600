//! Functions that generated code calls.

/// Fixed text, and the most statements that a call executes.
pub struct Function {
    pub name: &'static str,
    pub text: &'static str,
    pub calls: &'static [&'static str],
    pub statements: u64,
}

macro_rules! function {
    ($name:literal, $calls:expr, $statements:literal) => {
        Function {
            name: $name,
            text: include_str!(concat!("../../../../templates/plc/functions/", $name, ".st")),
            calls: $calls,
            statements: $statements,
        }
    };
}

/// Those that are called stand first.
const FUNCTIONS: &[Function] = &[
    function!("F_following", &[], 2),
    function!("F_next_command", &["F_following"], 12),
    function!("F_limit", &[], 2),
    function!("F_lesser", &[], 2),
    function!("F_greater", &[], 2),
    function!("F_lesser_real", &[], 2),
    function!("F_greater_real", &[], 2),
    function!("F_absolute", &[], 2),
    function!("F_magnitude", &[], 2),
    function!("F_real", &[], 1),
    function!("F_is_finite", &[], 1),
    function!("F_is_finite_point", &["F_is_finite"], 4),
    function!("F_squared_distance", &[], 4),
    function!("F_rounded", &[], 2),
];

/// The functions of these names and those that they call.
pub fn needed(names: &[&str]) -> Vec<&'static Function> {
    let callers = FUNCTIONS.iter().filter(|f| names.contains(&f.name));
    let called: Vec<&str> = callers.flat_map(|f| f.calls).copied().collect();
    FUNCTIONS.iter().filter(|f| names.contains(&f.name) || called.contains(&f.name)).collect()
}

/// The most statements that a call executes; none for functions of the standard.
pub fn statements(name: &str) -> u64 {
    FUNCTIONS.iter().find(|f| f.name == name).map_or(0, |f| f.statements)
}
