//! Identifiers of generated code, made from the names of a specification.

pub mod letters;
mod reserved;
pub mod st;

pub use reserved::is_reserved;
use std::collections::BTreeSet;

/// Keywords of Rust, reserved ones included.
const KEYWORDS: &[&str] = &[
    "abstract", "as", "async", "await", "become", "box", "break", "const", "continue", "crate", "do", "dyn",
    "else", "enum", "extern", "false", "final", "fn", "for", "gen", "if", "impl", "in", "let", "loop",
    "macro", "match", "mod", "move", "mut", "override", "priv", "pub", "ref", "return", "self", "static",
    "struct", "super", "trait", "true", "try", "type", "typeof", "unsafe", "unsized", "use", "virtual",
    "where", "while", "yield", "Self",
];

/// The names of the prelude of Rust, and the traits that generated code derives or writes: an import of the same name would
/// hide them, or count as used where only they are.
const PRELUDE: &str = "AsMut AsRef AsyncFn AsyncFnMut AsyncFnOnce Box Clone Copy Debug Default Display \
    DoubleEndedIterator Drop Eq Err ExactSizeIterator Extend Fn FnMut FnOnce From FromIterator Future Hash Into \
    IntoFuture IntoIterator Iterator None Ok Option Ord PartialEq PartialOrd Result Send Sized Some String Sync \
    ToOwned ToString TryFrom TryInto Vec";

/// Names that no file has on Windows, whatever stands behind a point.
pub const NO_FILES: &[&str] = &[
    "aux", "con", "nul", "prn", "com1", "com2", "com3", "com4", "com5", "com6", "com7", "com8", "com9",
    "lpt1", "lpt2", "lpt3", "lpt4", "lpt5", "lpt6", "lpt7", "lpt8", "lpt9",
];

/// What SDF itself or every written world calls something else.
const SDF: &[&str] = &["world", "ground_plane", "sun"];

/// The name of a thing of the layout in a world: its own wherever it can be.
/// (No name of a layout ends in an underscore.)
pub fn sdf(name: &str) -> String {
    if SDF.contains(&name) { format!("{name}_") } else { name.into() }
}

/// Names that stand side by side, all different.
#[derive(Clone, Debug, Default)]
pub struct Scope {
    reserved: Vec<&'static str>,
    taken: BTreeSet<String>,
}

impl Scope {
    /// A scope of Rust in which generated code has these names itself.
    pub fn rust(reserved: &[&'static str]) -> Self {
        let prelude: Vec<&str> = PRELUDE.split_whitespace().collect();
        Self::new(&[KEYWORDS, &prelude, reserved].concat())
    }

    /// A scope in which these names have another meaning.
    pub fn new(reserved: &[&'static str]) -> Self {
        Self { reserved: reserved.to_vec(), taken: BTreeSet::new() }
    }

    /// The wanted identifier; with an underscore behind it if it has another meaning,
    /// with a number behind it if it was given away before.
    pub fn take(&mut self, wanted: String) -> String {
        let is_used = |name: &str| self.reserved.contains(&name);
        let first = if is_used(&wanted) { format!("{wanted}_") } else { wanted.clone() };
        let name = std::iter::once(first)
            .chain((2..).map(|n| format!("{wanted}{n}")))
            .find(|name| !is_used(name) && !self.taken.contains(name))
            .unwrap_or_default();
        self.taken.insert(name.clone());
        name
    }
}

/// The words of a name: `seen_at`, `SeenAt` and `Seen.at` have the same two.
fn words(name: &str) -> Vec<String> {
    let mut words: Vec<String> = Vec::new();
    let mut begins = true;
    let letters: Vec<char> = name.chars().collect();
    for (i, &c) in letters.iter().enumerate() {
        if !c.is_ascii_alphanumeric() {
            begins = true;
            continue;
        }
        let before = i.checked_sub(1).map(|i| letters[i]);
        let after = letters.get(i + 1);
        let rises = c.is_ascii_uppercase()
            && (before.is_some_and(|b| b.is_ascii_lowercase() || b.is_ascii_digit())
                || (before.is_some_and(|b| b.is_ascii_uppercase())
                    && after.is_some_and(|a| a.is_ascii_lowercase())));
        if begins || rises {
            words.push(String::new());
        }
        begins = false;
        if let Some(word) = words.last_mut() {
            word.push(c.to_ascii_lowercase());
        }
    }
    if !words.first().is_some_and(|w| w.starts_with(|c: char| c.is_ascii_lowercase())) {
        words.insert(0, "n".into());
    }
    words
}

/// `seen_at`
pub fn snake(name: &str) -> String {
    words(name).join("_")
}

/// `SEEN_AT`
pub fn screaming(name: &str) -> String {
    snake(name).to_ascii_uppercase()
}

/// `SeenAt`
pub fn camel(name: &str) -> String {
    let capital = |word: String| {
        let mut letters = word.chars();
        letters.next().map(|c| c.to_ascii_uppercase()).into_iter().chain(letters).collect::<String>()
    };
    words(name).into_iter().map(capital).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_found_in_any_spelling() {
        let all = ["all_loaded", "AllLoaded", "Picking.1", "AGV", "UR10Arm", "agv1", "12V", "x__y"];
        let made: Vec<_> = all.iter().map(|n| (snake(n), camel(n), screaming(n))).collect();
        let made: Vec<_> = made.iter().map(|(s, c, u)| (s.as_str(), c.as_str(), u.as_str())).collect();
        assert_eq!(
            made,
            [
                ("all_loaded", "AllLoaded", "ALL_LOADED"),
                ("all_loaded", "AllLoaded", "ALL_LOADED"),
                ("picking_1", "Picking1", "PICKING_1"),
                ("agv", "Agv", "AGV"),
                ("ur10_arm", "Ur10Arm", "UR10_ARM"),
                ("agv1", "Agv1", "AGV1"),
                ("n_12_v", "N12V", "N_12_V"),
                ("x_y", "XY", "X_Y"),
            ]
        );
    }

    #[test]
    fn a_scope_gives_each_name_once() {
        let mut scope = Scope::rust(&["state"]);
        let given: Vec<_> =
            ["type", "state", "x", "x", "x", "Self", "Self"].map(|n| scope.take(n.into())).into();
        assert_eq!(given, ["type_", "state_", "x", "x2", "x3", "Self_", "Self2"]);
    }
}
