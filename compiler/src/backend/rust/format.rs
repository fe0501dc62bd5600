//! From text that parses to text that reads well. Most of the time of this back end is spent here, so a text is laid out
//! once it is wanted.

use crate::plain;
use std::collections::{BTreeSet, HashSet};
use syn::visit::{Visit, visit_path};

/// Modules of the crate and what can be imported from each.
pub type Importable = Vec<(String, Vec<String>)>;

/// The text of a file.
pub enum Unformatted {
    AsItIs(String),
    /// Complete, and not laid out.
    Bare(String),
    /// Neither laid out nor with the imports that its code needs.
    Module(String, Importable),
    /// A module that is laid out but for its imports.
    Long(String, Importable),
}

impl Unformatted {
    /// What the text that is laid out is made from.
    pub fn source(&self) -> &str {
        match self {
            Self::AsItIs(text) | Self::Bare(text) | Self::Module(text, _) | Self::Long(text, _) => text,
        }
    }

    pub fn formatted(&self) -> String {
        match self {
            Self::AsItIs(text) => text.clone(),
            Self::Bare(text) => print(text),
            Self::Module(text, importable) => module(text, importable),
            Self::Long(text, importable) => with_head(text, importable),
        }
    }
}

/// A statement that becomes a comment.
pub fn comment(text: &str) -> String {
    format!("comment!({:?});\n", plain::line(text))
}

fn module(text: &str, importable: &Importable) -> String {
    let file = parse(text);
    let mut used = Used::default();
    used.visit_file(&file);
    for own in file.items.iter().filter_map(defined) {
        used.0.remove(&own);
    }
    let (head, _) = with_imports(text, |name| used.0.contains(name), importable);
    let mut items = parse(&head).items;
    items.extend(file.items.into_iter().filter(|item| !matches!(item, syn::Item::Use(_))));
    printed(&syn::File { items, ..file })
}

/// The imports stand before everything else. Nothing else is parsed: it may be long.
fn with_head(text: &str, importable: &Importable) -> String {
    let importable_names: HashSet<&str> =
        importable.iter().flat_map(|(_, names)| names).map(String::as_str).collect();
    let used: HashSet<&str> = names(text).filter(|word| importable_names.contains(word)).collect();
    let is_of_head =
        |line: &&str| line.starts_with("//!") || line.starts_with("use ") || line.trim().is_empty();
    let length: usize = text.split_inclusive('\n').take_while(is_of_head).map(str::len).sum();
    let (head, rest) = text.split_at(length);
    let (head, _) = with_imports(head, |name| used.contains(name), importable);
    [print(&head).as_str(), "\n", rest.trim(), "\n"].concat()
}

/// The comment of a module with all its imports, and the rest of its text.
fn with_imports(text: &str, is_used: impl Fn(&str) -> bool, importable: &Importable) -> (String, String) {
    let (own, rest): (Vec<&str>, Vec<&str>) = text.lines().partition(|line| line.starts_with("use "));
    let mut imports: Vec<String> = own.into_iter().map(String::from).collect();
    for (module, names) in importable {
        let names: Vec<&str> = names.iter().map(String::as_str).filter(|n| is_used(n)).collect();
        match names.as_slice() {
            [] => {}
            [one] => imports.push(format!("use {module}::{one};")),
            many => imports.push(format!("use {module}::{{{}}};", many.join(", "))),
        }
    }
    imports.sort();
    let head = rest.iter().take_while(|line| line.starts_with("//!") || line.trim().is_empty()).count();
    let (head, rest) = rest.split_at(head);
    (format!("{}\n{}", head.join("\n"), imports.join("\n")), rest.join("\n"))
}

/// The names with which paths begin, without what is in comments and texts. A text has no escapes.
fn names(text: &str) -> impl Iterator<Item = &str> {
    let code = text.lines().filter(|line| !line.trim_start().starts_with("//"));
    code.flat_map(|line| line.split('"').step_by(2)).flat_map(beginnings)
}

/// Of code on one line: neither the names of fields nor what stands behind `::`.
fn beginnings(code: &str) -> Vec<&str> {
    let is_of_word = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let mut found = Vec::new();
    let mut rest = code;
    while let Some(start) = rest.find(is_of_word) {
        let before = &code[..code.len() - rest.len() + start];
        let length = rest[start..].find(|c| !is_of_word(c)).unwrap_or(rest.len() - start);
        let (word, behind) = rest[start..].split_at(length);
        let is_of_field = before.ends_with('.') && !before.ends_with("..");
        let names_field = behind.starts_with(':') && !behind.starts_with("::");
        if !is_of_field && !names_field && !before.ends_with("::") {
            found.push(word);
        }
        rest = behind;
    }
    found
}

fn print(text: &str) -> String {
    printed(&parse(text))
}

fn printed(file: &syn::File) -> String {
    let printed = prettyplease::unparse(file);
    let mut out = String::new();
    let mut before = "";
    let mut is_import = false;
    let mut lines = printed.lines();
    while let Some(line) = lines.next() {
        let trimmed = line.trim_start();
        let indent = &line[..line.len() - trimmed.len()];
        if needs_blank(before, line, is_import) {
            out.push('\n');
        }
        if !indent.is_empty() || !trimmed.starts_with('}') {
            is_import = trimmed.starts_with("use ") || is_import && !indent.is_empty();
        }
        before = line;
        let Some(literal) = trimmed.strip_prefix("comment!(") else {
            out += line;
            out.push('\n');
            continue;
        };
        // A long literal has been put on a line of its own.
        let literal = if literal.is_empty() {
            let inner = lines.next().unwrap_or_default().trim();
            lines.next();
            inner
        } else {
            literal.trim_end_matches(");")
        };
        let text = syn::parse_str::<syn::LitStr>(literal).map(|l| l.value()).unwrap_or_default();
        put_comment(&mut out, indent, &text);
    }
    out
}

/// Lines of a comment; what follows the first is set in.
fn put_comment(out: &mut String, indent: &str, text: &str) {
    let mut line = format!("{indent}//");
    for word in text.split(' ') {
        if line.len() + 1 + word.len() > WIDTH && line.trim_start().len() > 2 {
            *out += &line;
            out.push('\n');
            line = format!("{indent}//   {word}");
        } else {
            line.push(' ');
            line += word;
        }
    }
    *out += &line;
    out.push('\n');
}

/// Longest line of a comment.
const WIDTH: usize = 100;

/// Whether a blank line belongs between two lines: before items, but for imports and modules in a row.
fn needs_blank(before: &str, line: &str, is_import: bool) -> bool {
    let level = |line: &str| line.len() - line.trim_start().len();
    if before.is_empty() || level(before) != level(line) || line.starts_with("//!") {
        return false;
    }
    let (first, next) = (before.trim_start(), line.trim_start());
    let begins = ["pub ", "impl", "fn ", "///", "#[", "const "].iter().any(|start| next.starts_with(start));
    let in_row = first.starts_with("///") || first.starts_with("#[");
    if level(line) > 0 {
        return begins && matches!(first, "}" | "};" | "];");
    }
    let modules = first.starts_with("pub mod ") && next.starts_with("pub mod ");
    if next.starts_with("use ") { !is_import } else { begins && !in_row && !modules }
}

/// The name that an item defines.
fn defined(item: &syn::Item) -> Option<String> {
    match item {
        syn::Item::Enum(item) => Some(item.ident.to_string()),
        syn::Item::Struct(item) => Some(item.ident.to_string()),
        _ => None,
    }
}

/// Unformatted that does not parse is a mistake of this back end, and nothing of it may be written.
fn parse(text: &str) -> syn::File {
    let title = text.lines().next().unwrap_or_default();
    syn::parse_file(text).unwrap_or_else(|error| panic!("what was printed is no Rust: {error}, in `{title}`"))
}

/// First names of all paths.
#[derive(Default)]
struct Used(BTreeSet<String>);

impl<'ast> Visit<'ast> for Used {
    fn visit_path(&mut self, path: &'ast syn::Path) {
        if let Some(first) = path.segments.first() {
            self.0.insert(first.ident.to_string());
        }
        visit_path(self, path);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn imports_are_those_of_the_code() {
        let importable =
            vec![("crate::types".to_string(), vec!["Array".to_string(), "Point".into(), "Rows".into()])];
        let text = "//! A module.\n\n/// A `Rows`.\npub const A: Point = made(\"Array\", Shape::Rows, B { Array: 3 });\n";
        let wanted = "//! A module.\n\nuse crate::types::Point;\n\n/// A `Rows`.\n";
        let found = Unformatted::Long(text.into(), importable).formatted();
        assert!(found.starts_with(wanted), "{found}");
    }

    #[test]
    #[should_panic(expected = "what was printed is no Rust")]
    fn what_is_no_rust_is_not_written() {
        Unformatted::Bare("//! A module.\nfn {}\n".into()).formatted();
    }
}
