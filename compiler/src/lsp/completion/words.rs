//! Words that are offered: of the language, and names of declarations.

use crate::check::names::{Declaration, What};
use crate::lsp::hover::signature;
use crate::lsp::specs::Specs;
use crate::spec::lexer::Token;

/// One word that can be there.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    pub text: String,
    /// None for a word of the language.
    pub what: Option<What>,
    /// The declaration; empty for a word of the language.
    pub detail: String,
    pub doc: String,
}

/// Names of one kind that are offered.
pub const MOST_WORDS: usize = 1000;

const TYPES: &[&str] = &["bool", "int", "real", "time", "point"];

pub fn of_language(words: &[&str]) -> Vec<Word> {
    let word =
        |text: &&str| Word { text: (*text).into(), what: None, detail: String::new(), doc: String::new() };
    words.iter().map(word).collect()
}

pub fn types(specs: &Specs) -> Vec<Word> {
    let mut words = of_language(TYPES);
    words.extend(named(specs, &[What::Enumeration, What::Interface], ""));
    words
}

/// Declarations of these kinds in a type or device.
pub fn named(specs: &Specs, what: &[What], owner: &str) -> Vec<Word> {
    all(specs, |declaration| what.contains(&declaration.what) && declaration.owner == owner)
}

pub fn all(specs: &Specs, wanted: impl Fn(&Declaration) -> bool) -> Vec<Word> {
    let found = specs.names.declarations().iter().filter(|declaration| wanted(declaration));
    let word = |declaration: &Declaration| Word {
        text: declaration.name.clone(),
        what: Some(declaration.what),
        detail: signature(specs, declaration),
        doc: declaration.doc.join(" "),
    };
    found.take(MOST_WORDS).map(word).collect()
}

pub fn declared<'s>(specs: &'s Specs, name: &str, owner: &str) -> Option<&'s Declaration> {
    specs
        .names
        .declarations()
        .iter()
        .find(|declaration| declaration.name == name && declaration.owner == owner)
}

pub fn interfaces(specs: &Specs, automaton: &str) -> Vec<String> {
    let mut trees = specs.files.iter().rev().flat_map(|(_, file)| &file.automata);
    let tree = trees.find(|tree| tree.name.value == automaton);
    let implemented = tree.into_iter().flat_map(|tree| &tree.implements);
    implemented.map(|clause| clause.interface.value.clone()).collect()
}

pub fn device(specs: &Specs, automaton: &str) -> String {
    let ty = declared(specs, automaton, "").map_or("", |declaration| declaration.ty.as_str());
    ty.trim_start_matches("on ").into()
}

pub fn type_of_domain(specs: &Specs, automaton: &str, domain: &Token) -> String {
    let Some(name) = as_word(domain) else { return "int".into() };
    match declared(specs, name, automaton).filter(|declaration| declaration.what == What::Role) {
        Some(role) => first_word(&role.ty).into(),
        None => name.into(),
    }
}

/// Of a type, its name.
pub fn first_word(ty: &str) -> &str {
    ty.split(|c: char| !c.is_ascii_alphanumeric() && c != '_').next().unwrap_or_default()
}

pub fn as_word(token: &Token) -> Option<&str> {
    match token {
        Token::Word(word) => Some(word),
        _ => None,
    }
}
