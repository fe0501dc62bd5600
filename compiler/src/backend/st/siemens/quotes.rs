//! Names that SCL takes in quotes alone.

/// Words of SCL that may be a name in quotes alone. Those of IEC 61131-3 are no names of a specification's text at all.
const WORDS: [&str; 32] = [
    "any",
    "begin",
    "block_db",
    "block_fb",
    "block_fc",
    "block_sdb",
    "cont",
    "const",
    "continue",
    "counter",
    "data_block",
    "db_any",
    "en",
    "eno",
    "end_const",
    "end_data_block",
    "end_label",
    "end_organization_block",
    "end_region",
    "goto",
    "label",
    "nil",
    "ok",
    "organization_block",
    "pointer",
    "region",
    "s5time",
    "timer",
    "title",
    "variant",
    "version",
    "void",
];

/// Whether a name stands in quotes.
pub fn is_word(name: &str) -> bool {
    WORDS.iter().any(|word| word.eq_ignore_ascii_case(name))
}

pub fn push_quoted(name: &str, text: &mut String) {
    match is_word(name) {
        true => text.extend(["\"", name, "\""]),
        false => *text += name,
    }
}

pub fn quoted(name: &str) -> String {
    let mut text = String::with_capacity(name.len() + 2);
    push_quoted(name, &mut text);
    text
}
