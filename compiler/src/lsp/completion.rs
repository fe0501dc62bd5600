//! What can be at a place of a file of automata. The text there is being typed and has errors, so the words before the
//! place say what is wanted; what names there are is from all that could be read.

mod phrases;
mod words;

pub use words::{MOST_WORDS, Word};

use super::specs::Specs;
use crate::check::names::What;
use crate::source::FileId;
use crate::spec::lexer::{self, Token};
use crate::spec::parser::MOST_TOKENS;
use words::{
    all, as_word, declared, device, first_word, interfaces, named, of_language, type_of_domain, types,
};

const ITEMS: &[&str] = &["automaton", "device", "assembly", "interface", "enum"];
const OF_AUTOMATON: &[&str] = &[
    "parameter",
    "shared",
    "local",
    "define",
    "takes from",
    "hands to",
    "serves",
    "knows",
    "require",
    "retain",
    "invariant",
    "keep",
    "whenever",
    "answer within",
    "initial",
    "any state",
    "state",
    "final state",
    "resume state",
];
const OF_DEVICE: &[&str] =
    &["parameter", "part", "define", "in", "out", "command", "constant", "handover", "require"];
const OF_INTERFACE: &[&str] = &["parameter", "shared", "invariant", "keep", "whenever", "answer within"];
const IN_EXPRESSIONS: &[&str] = &[
    "true",
    "false",
    "and",
    "or",
    "not",
    "mod",
    "in",
    "reaches",
    "after",
    "done",
    "failed",
    "exists",
    "forall",
    "count",
    "sum",
    "min",
    "max",
    "abs",
    "point",
    "up",
    "squared_distance",
    "self",
    "first",
    "least",
    "nearest",
    "with",
];

/// The words for a place, in bytes, of a file.
pub fn completion(specs: &Specs, file: FileId, offset: usize) -> Vec<Word> {
    let text = &specs.sources.file(file).text;
    let Some(before) = text.get(..offset) else { return Vec::new() };
    if in_comment_or_text(before) {
        return Vec::new();
    }
    let word = before
        .rfind(|c: char| !c.is_ascii_alphanumeric() && c != '_')
        .map_or(0, |at| at + before[at..].chars().next().map_or(1, char::len_utf8));
    let (mut tokens, _) = lexer::tokens(file, &before[..word], MOST_TOKENS);
    tokens.retain(|(token, _)| !matches!(token, Token::Doc(_) | Token::End));
    let tokens: Vec<Token> = tokens.into_iter().map(|(token, _)| token).collect();
    let mut found = Place::of(&tokens).words(specs);
    found.sort_by(|a, b| a.text.cmp(&b.text));
    found.dedup_by(|a, b| a.text == b.text);
    found
}

fn in_comment_or_text(before: &str) -> bool {
    let line = before.rsplit('\n').next().unwrap_or_default();
    let mut in_text = false;
    let mut last = ' ';
    for c in line.chars() {
        match c {
            '"' => in_text = !in_text,
            '/' if !in_text && last == '/' => return true,
            _ => {}
        }
        last = c;
    }
    in_text
}

/// Where the words before the cursor lead.
struct Place<'t> {
    /// Before the cursor.
    tokens: &'t [Token],
    /// `automaton`, and its name; none outside of all items.
    item: Option<(&'t str, &'t str)>,
    /// Braces that are open, each with the beginning of the statement that it belongs to.
    open: Vec<&'t [Token]>,
    /// What stands of the statement.
    statement: &'t [Token],
    /// What the last braces that were closed, or the last semicolon, belong to.
    closed: &'t [Token],
}

impl<'t> Place<'t> {
    fn of(tokens: &'t [Token]) -> Self {
        let mut item = None;
        let mut open: Vec<&[Token]> = Vec::new();
        let mut start = 0;
        let mut closed: &[Token] = &[];
        for (at, token) in tokens.iter().enumerate() {
            let goes_on = [Token::Sign("->"), Token::Word("else".into())].contains(token);
            if at == start + 1 && is_outcome(&tokens[start..at]) && !goes_on {
                start = at;
            }
            match token {
                Token::Word(word) if open.is_empty() && at == start && ITEMS.contains(&word.as_str()) => {
                    let name = tokens.get(at + 1).and_then(as_word).unwrap_or_default();
                    item = Some((word.as_str(), name));
                }
                Token::Sign("{") => {
                    open.push(&tokens[start..at]);
                    start = at + 1;
                }
                Token::Sign("}") => {
                    closed = open.pop().unwrap_or_default();
                    if open.is_empty() {
                        item = None;
                    }
                    start = if may_go_on(closed) { at } else { at + 1 };
                }
                Token::Sign(";") => {
                    closed = &tokens[start..at];
                    start = if is_outcome(closed) && may_go_on(closed) { at } else { at + 1 };
                }
                _ => {}
            }
        }
        Self { tokens, item, open, statement: &tokens[start..], closed }
    }

    fn words(&self, specs: &Specs) -> Vec<Word> {
        let Some((item, name)) = self.item else { return of_language(ITEMS) };
        if self.tokens.last() == Some(&Token::Sign(".")) {
            return self.members(specs, item, name);
        }
        if let Some(words) = phrases::behind(item, self.open.len(), self.statement) {
            return words;
        }
        let first = self.statement.first().and_then(as_word).unwrap_or_default();
        let last = self.statement.last();
        let declares = ["parameter", "shared", "local", "in", "out", "constant"].contains(&first);
        match (item, self.open.len(), last) {
            ("automaton", 0, Some(Token::Word(word))) if word == "on" => named(specs, &[What::Device], ""),
            ("automaton", 0, Some(Token::Word(word))) if word == "at" => {
                named(specs, &[What::Handover], device_of_head(self.statement))
            }
            ("automaton", 0, _) => {
                let mut words = of_language(&["on", "is", "accepts at", "offers at", "approach"]);
                words.extend(named(specs, &[What::Interface], ""));
                words
            }
            (_, 0, _) => Vec::new(),
            ("automaton", 1, None) => of_language(OF_AUTOMATON),
            ("automaton", 1, _) if self.statement.len() == 1 && is_outcome(self.statement) => {
                if is_sequence(self.closed) {
                    return Vec::new();
                }
                let mut words = of_language(OF_AUTOMATON);
                words.extend(of_language(&["else"]));
                words
            }
            ("device" | "assembly", 1, None) => of_language(OF_DEVICE),
            ("interface", 1, None) => of_language(OF_INTERFACE),
            (item, _, Some(Token::Sign(":"))) if declares => {
                let mut words = types(specs);
                if item == "automaton" {
                    words.extend(named(specs, &[What::Automaton], ""));
                }
                words
            }
            ("automaton", _, Some(Token::Sign(":" | "("))) if is_role(first) => {
                named(specs, &[What::Interface, What::Automaton], "")
            }
            ("automaton", _, Some(Token::Sign("->"))) => named(specs, &[What::State], name),
            ("automaton", 1, Some(Token::Sign(","))) if is_any_state(self.statement) => {
                named(specs, &[What::State], name)
            }
            ("automaton" | "interface", 1, Some(last))
                if first == "shared" && self.statement.contains(&Token::Sign(":")) && ends_value(last) =>
            {
                of_language(&["by"])
            }
            ("interface", 1, _)
                if self.statement.contains(&Token::Sign(":=")) || first != "shared" && !declares =>
            {
                let mut words = of_language(IN_EXPRESSIONS);
                words.extend(named(specs, &[What::Parameter, What::Cell], name));
                words.extend(values(specs));
                words
            }
            ("automaton", _, Some(Token::Word(word))) if ["except", "else"].contains(&word.as_str()) => {
                named(specs, &[What::State], name)
            }
            ("automaton", _, Some(Token::Word(word))) if word == "in" => {
                let mut words = named(specs, &[What::Role], name);
                words.extend(named(specs, &[What::Enumeration], ""));
                words
            }
            ("automaton", _, _) => self.of_automaton(specs, name),
            ("device" | "assembly", _, _) => self.of_device(specs, name),
            _ => types(specs),
        }
    }

    /// What the statement of an automaton may hold.
    fn of_automaton(&self, specs: &Specs, name: &str) -> Vec<Word> {
        let mut words = match (self.statement.is_empty(), self.in_updates()) {
            (true, true) if self.open.last().is_some_and(|statement| is_sequence(statement)) => {
                of_language(&["until", "wait"])
            }
            (true, true) => Vec::new(),
            (true, false) => return of_language(&["when"]),
            (false, _) => of_language(IN_EXPRESSIONS),
        };
        let of_type = [What::Parameter, What::Cell, What::Role, What::Local, What::Define];
        words.extend(named(specs, &of_type, name));
        for interface in interfaces(specs, name) {
            words.extend(named(specs, &[What::Cell], &interface));
        }
        let device = device(specs, name);
        words.extend(named(specs, &[What::Port, What::Constant, What::Command], &device));
        words.extend(self.variables(specs, name));
        if !self.statement.is_empty() {
            words.extend(values(specs));
        }
        words
    }

    /// Within the braces of a transition or a sequence.
    fn in_updates(&self) -> bool {
        let of = self.open.last().and_then(|statement| statement.first()).and_then(as_word);
        of == Some("when")
            || of == Some("initial") && self.open.len() == 2 && !self.opens_state()
            || self.open.last().is_some_and(|statement| is_sequence(statement) || is_outcome(statement))
    }

    fn opens_state(&self) -> bool {
        self.open.last().is_some_and(|statement| statement.get(1).and_then(as_word) == Some("state"))
    }

    /// Bound in the statement, or in that whose updates are written.
    fn variables(&self, specs: &Specs, name: &str) -> Vec<Word> {
        let statements = self.open.iter().copied().chain([self.statement]);
        let mut words = Vec::new();
        for statement in statements {
            for (variable, domain) in bound(statement) {
                let ty = type_of_domain(specs, name, domain);
                let detail = format!("{variable}: {ty}");
                words.push(Word {
                    text: variable.into(),
                    what: Some(What::Variable),
                    detail,
                    doc: String::new(),
                });
            }
        }
        words
    }

    fn of_device(&self, specs: &Specs, name: &str) -> Vec<Word> {
        let part =
            self.open.last().filter(|_| self.open.len() > 1).and_then(|statement| kind_of_part(statement));
        if let (Some(kind), true) = (part, self.statement.is_empty()) {
            let mut words = named(specs, &[What::Setting], kind);
            words.extend(named(specs, &[What::Key], kind));
            return words;
        }
        let is_part = self.statement.first().and_then(as_word) == Some("part");
        if is_part && self.statement.last() == Some(&Token::Sign("=")) {
            return named(specs, &[What::Primitive, What::Assembly], "");
        }
        let own = [What::Key, What::DeviceDefine, What::Part, What::Port, What::Constant];
        let mut words = named(specs, &own, name);
        words.extend(of_language(&["pose", "origin", "kind_heights", "kind_grasps", "pi", "point", "frame"]));
        words
    }

    /// Behind a point.
    fn members(&self, specs: &Specs, item: &str, name: &str) -> Vec<Word> {
        let before = &self.tokens[..self.tokens.len() - 1];
        let Some(base) = base(before) else { return Vec::new() };
        if item != "automaton" {
            let kind = declared(specs, base, name).map(|declaration| declaration.ty.clone());
            let kind = kind.unwrap_or_default();
            let mut words = named(specs, &[What::Wire, What::Setting], &kind);
            words.extend(named(specs, &[What::Part, What::DeviceDefine, What::Key], &kind));
            return words;
        }
        if specs.names.declarations().iter().any(|d| d.what == What::Enumeration && d.name == base) {
            return named(specs, &[What::Member], base);
        }
        let statements = self.open.iter().copied().chain([self.statement]);
        let domains: Vec<_> = statements.flat_map(bound).filter(|(variable, _)| *variable == base).collect();
        let ty = match domains.last() {
            Some((_, domain)) => type_of_domain(specs, name, domain),
            None => {
                let mut owners = vec![name.to_string(), device(specs, name)];
                owners.extend(interfaces(specs, name));
                let found = owners.iter().find_map(|owner| declared(specs, base, owner));
                found.map_or_else(String::new, |declaration| first_word(&declaration.ty).to_string())
            }
        };
        match ty.as_str() {
            "point" => of_language(&["x", "y", "z"]),
            ty => named(specs, &[What::Cell, What::Parameter], ty),
        }
    }
}

/// Of enumerations.
fn values(specs: &Specs) -> Vec<Word> {
    let mut words = all(specs, |declaration| declaration.what == What::Member);
    words.extend(named(specs, &[What::Enumeration], ""));
    words
}

/// In `automaton Mill on mill is ...`, the word behind `on`.
fn device_of_head(statement: &[Token]) -> &str {
    let on = statement.iter().position(|token| as_word(token) == Some("on"));
    on.and_then(|on| statement.get(on + 1)).and_then(as_word).unwrap_or_default()
}

fn is_any_state(statement: &[Token]) -> bool {
    let words = ["any", "state", "except"];
    statement.len() > 3 && statement.iter().zip(words).all(|(token, word)| as_word(token) == Some(word))
}

/// Whether a value, a type or a name can end with this.
fn ends_value(token: &Token) -> bool {
    matches!(token, Token::Word(word) if !["not", "and", "or", "mod", "by", "shared"].contains(&word.as_str()))
        || matches!(token, Token::Sign(")" | "]"))
        || !matches!(token, Token::Word(_) | Token::Sign(_))
}

/// That of the steps of a sequence, before their braces.
fn is_sequence(statement: &[Token]) -> bool {
    statement.last().and_then(as_word) == Some("sequence")
}

/// What stands behind the steps of a sequence begins with the end of what is before it.
fn is_outcome(statement: &[Token]) -> bool {
    matches!(statement.first(), Some(Token::Sign("}" | ";")))
}

/// Whether the sequence that a statement belongs to may have more behind it.
fn may_go_on(statement: &[Token]) -> bool {
    let has_else = || statement.iter().any(|token| as_word(token) == Some("else"));
    is_sequence(statement) || is_outcome(statement) && !has_else()
}

fn is_role(word: &str) -> bool {
    ["takes", "hands", "serves", "knows"].contains(&word)
}

/// Variables and their domains: `first s in stations`, `exists i in 0..3`.
fn bound(statement: &[Token]) -> impl Iterator<Item = (&str, &Token)> {
    statement.windows(3).filter_map(|three| match three {
        [Token::Word(variable), Token::Word(word), domain] if word == "in" => {
            Some((variable.as_str(), domain))
        }
        _ => None,
    })
}

/// The name before a point, past an index: of `slot[i].` it is `slot`.
fn base(before: &[Token]) -> Option<&str> {
    let mut depth = 0usize;
    for token in before.iter().rev() {
        match token {
            Token::Sign("]") => depth += 1,
            Token::Sign("[") => depth = depth.checked_sub(1)?,
            Token::Word(word) if depth == 0 => return Some(word),
            _ if depth > 0 => {}
            _ => return None,
        }
    }
    None
}

/// In `part drive = route`, the last word.
fn kind_of_part(statement: &[Token]) -> Option<&str> {
    match statement {
        [Token::Word(part), _, Token::Sign("="), Token::Word(kind)] if part == "part" => Some(kind),
        _ => None,
    }
}
