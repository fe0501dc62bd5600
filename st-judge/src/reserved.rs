//! Words that no name may be: the union of what the compilers reserve, in lower case and sorted.

pub fn is_reserved(name: &str) -> bool {
    WORDS.binary_search(&name.to_ascii_lowercase().as_str()).is_ok()
}

/// One compiler ends a unit where it finds such a word, in the middle of a name too.
pub fn keyword_inside(name: &str) -> Option<&'static str> {
    let name = name.to_ascii_lowercase();
    let ends = ["end_program", "end_function", "end_configuration", "end_action", "end_transition"];
    ends.into_iter().find(|keyword| name.contains(keyword))
}

#[rustfmt::skip]
const WORDS: &[&str] = &[
    "abs", "abs_", "abstract", "acos", "action", "add", "adr", "and", "andn", "any", "any_bit", "any_char",
    "any_chars", "any_date", "any_derived", "any_elementary", "any_int", "any_magnitude", "any_num",
    "any_real", "any_string", "array", "asin", "at", "atan", "atan2", "bool", "bool_to_dint", "by", "byte",
    "cal", "calc", "calcn", "case", "ceil", "char", "class", "concat", "config", "configuration",
    "constant", "continue", "cos", "ctd", "ctu", "ctud", "date", "date_and_time", "delete", "dint",
    "dint_to_lreal", "div", "do", "dt", "dword", "else", "elsif", "en", "end_action", "end_case",
    "end_class", "end_configuration", "end_for", "end_function", "end_function_block", "end_get", "end_if",
    "end_interface", "end_method", "end_namespace", "end_program", "end_property", "end_repeat",
    "end_resource", "end_set", "end_step", "end_struct", "end_transition", "end_type", "end_var",
    "end_while", "eno", "eq", "exit", "exp", "expt", "extends", "f_edge", "f_trig", "false", "final",
    "find", "floor", "for", "from", "function", "function_block", "ge", "gt", "if", "implements",
    "initial_step", "insert", "int", "interface", "internal", "interval", "jmp", "jmpc", "jmpcn", "ldate",
    "ldt", "le", "left", "len", "limit", "lint", "ln", "log", "lreal", "lt", "ltime", "ltod", "lword",
    "max", "method", "mid", "min", "mod", "move", "mul", "mux", "namespace", "ne", "new", "non_retain",
    "not", "not_", "null", "of", "on", "or", "orn", "overlap", "override", "pointer", "priority", "private",
    "program", "property", "protected", "public", "r_edge", "r_trig", "read_only", "read_write", "real",
    "ref", "ref_to", "repeat", "replace", "resource", "ret", "retain", "retc", "retcn", "return", "right",
    "rol", "ror", "round", "rs", "sel", "shl", "shr", "sin", "single", "sint",
    "sizeof", "sqrt", "sr", "step", "string", "struct", "sub", "super", "tan", "task", "then", "this",
    "time", "time_of_day", "to", "tod", "tof", "ton", "tp", "transition", "true", "trunc", "type", "udint",
    "uint", "ulint", "until", "using", "usint", "var", "var_access", "var_config", "var_external",
    "var_global", "var_in_out", "var_input", "var_output", "var_temp", "wchar", "while", "with", "word",
    "wstring", "xor", "xorn",
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_words_are_sorted() {
        assert!(WORDS.is_sorted());
        assert!(is_reserved("Step") && !is_reserved("step_1"));
    }
}
