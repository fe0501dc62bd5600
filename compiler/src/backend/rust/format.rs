//! From text that parses to text that reads well.

use std::collections::BTreeSet;
use syn::visit::{Visit, visit_path};

/// Modules of the crate and what can be imported from each.
pub type Importable = [(String, Vec<String>)];

/// A statement that becomes a comment.
pub fn comment(text: &str) -> String {
    format!("comment!({text:?});\n")
}

/// Lays out a module, with the imports that its code needs.
pub fn module(text: &str, importable: &Importable) -> String {
    let file = parse(text);
    let mut used = Used::default();
    used.visit_file(&file);
    let mut imports = String::new();
    for (module, names) in importable {
        let names: Vec<&str> = names.iter().map(String::as_str).filter(|n| used.0.contains(*n)).collect();
        match names.as_slice() {
            [] => {}
            [one] => imports += &format!("use {module}::{one};\n"),
            many => imports += &format!("use {module}::{{{}}};\n", many.join(", ")),
        }
    }
    let inner = text.lines().take_while(|line| line.starts_with("//!") || line.trim().is_empty()).count();
    let lines: Vec<&str> = text.lines().collect();
    let (head, rest) = lines.split_at(inner);
    print(&format!("{}\n{imports}\n{}", head.join("\n"), rest.join("\n")))
}

/// Lays out a file that is complete.
pub fn print(text: &str) -> String {
    let printed = prettyplease::unparse(&parse(text));
    let mut out = String::new();
    let mut before = "";
    for line in printed.lines() {
        let trimmed = line.trim_start();
        let indent = &line[..line.len() - trimmed.len()];
        // A blank line between items, and between a head of documentation and what follows.
        let is_item = ["pub ", "impl", "fn ", "///", "#[", "use ", "mod ", "const "]
            .iter()
            .any(|s| trimmed.starts_with(s));
        let ends_item = before.trim_end() == "}" || before.ends_with("};") || before.starts_with("//!");
        if is_item && ends_item && !line.starts_with("//!") && is_between(before, indent) {
            out.push('\n');
        }
        match trimmed.strip_prefix("comment!(").and_then(|t| t.strip_suffix(");")) {
            Some(literal) => {
                let text = syn::parse_str::<syn::LitStr>(literal).map(|l| l.value()).unwrap_or_default();
                out += &format!("{indent}// {text}\n");
            }
            None => {
                out += line;
                out.push('\n');
            }
        }
        before = line;
    }
    out
}

/// The line before ends an item of the same level, or a file's head.
fn is_between(before: &str, indent: &str) -> bool {
    let trimmed = before.trim_start();
    before.starts_with("//!") || before.len() - trimmed.len() == indent.len()
}

/// Text that does not parse is a mistake of this back end; it comes out as it is, for the compiler of Rust to point at.
fn parse(text: &str) -> syn::File {
    match syn::parse_file(text) {
        Ok(file) => file,
        Err(error) => {
            let message = format!("autogen printed what is no Rust: {error}\n{text}");
            syn::File {
                shebang: None,
                attrs: Vec::new(),
                items: vec![syn::parse_quote!(compile_error!(#message);)],
            }
        }
    }
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
