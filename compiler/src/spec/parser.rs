//! Tokens to tree, by recursive descent. It continues after an error: at the next
//! `;`, `}` or keyword of an item. `parse_*` reports what is wrong and returns
//! what could be read.

mod automaton;
mod declaration;
mod device;
mod expression;
mod limits;
mod property;
mod state;

use crate::diagnostic::{Diagnostic, collect, suggestion};
use crate::source::{FileId, Span, Spanned};
use crate::spec::ast;
use crate::spec::lexer::{self, CAPITALS, Token};

/// Words that cannot be names, since an expression or a clause begins with them.
pub const RESERVED: &[&str] = &[
    "after", "and", "count", "done", "else", "exists", "failed", "false", "first", "forall", "in", "least",
    "mod", "nearest", "not", "or", "reaches", "state", "sum", "true", "until", "wait", "when", "with",
];

/// Whether a name of the scenario has another meaning where an automaton writes it.
pub fn is_word(name: &str) -> bool {
    RESERVED.contains(&name) || name == "self" || CAPITALS.iter().any(|(capitals, _)| *capitals == name)
}

/// Nesting of expressions beyond which a text is refused.
const DEEPEST: usize = 64;

/// Operators, accesses and variables of one expression beyond which a text is refused.
/// It bounds the depth of a tree, and with it the stack that the compiler needs.
const LONGEST: usize = 256;

/// Words, numbers, texts and signs that all files of automata of a line have together; the library has 3 % of it.
pub const MOST_TOKENS: usize = 200_000;

/// Pieces of a text that shows values.
const MOST_SHOWN: usize = 200;

/// Reads a whole file. What is wrong is in the list; the tree holds the rest.
pub fn parse(file: FileId, text: &str) -> (ast::File, Vec<Diagnostic>) {
    parse_within(file, text, &mut MOST_TOKENS.clone())
}

/// Reads one of several files, as [`parse`] does; `left` is what is left of [`MOST_TOKENS`].
pub fn parse_within(file: FileId, text: &str, left: &mut usize) -> (ast::File, Vec<Diagnostic>) {
    let (tokens, mut diagnostics) = lexer::tokens(file, text, *left + 1);
    let count = tokens.len() - 1;
    if count > *left {
        let (_, place) = tokens[count - 1];
        let message = format!("the files of automata have more than {MOST_TOKENS} tokens");
        diagnostics.push(Diagnostic::new("E0215", place, message).label("the first that is too many").help(
            "give --specs only the types that the line needs, or divide a long type into several types",
        ));
        return (ast::File::default(), diagnostics);
    }
    *left -= count;
    let mut parser = Parser::new(tokens, diagnostics);
    let tree = parser.file();
    parser.bounded(&tree);
    (tree, parser.diagnostics)
}

/// Words that begin an item of a file.
const ITEMS: [&str; 5] = ["enum", "interface", "automaton", "device", "assembly"];

pub(super) struct Parser {
    tokens: Vec<(Token, Span)>,
    position: usize,
    diagnostics: Vec<Diagnostic>,
    /// Nesting of the expression that is being read.
    depth: usize,
    /// What it has used of [`LONGEST`].
    length: usize,
    /// The token at which the last error was found: what else is wrong there follows from it.
    error_at: Option<usize>,
    /// Errors found so far, reported or not.
    errors: usize,
}

/// One of these is often written for another one.
const CONFUSED: [&str; 3] = [":", "=", ":="];

impl Parser {
    fn new(tokens: Vec<(Token, Span)>, diagnostics: Vec<Diagnostic>) -> Self {
        Self { tokens, position: 0, diagnostics, depth: 0, length: 0, error_at: None, errors: 0 }
    }

    fn file(&mut self) -> ast::File {
        let mut file = ast::File::default();
        loop {
            let doc = self.doc();
            match self.word() {
                Some("enum") => file.enums.extend(self.parse_enum(doc)),
                Some("interface") => file.interfaces.extend(self.parse_interface(doc)),
                Some("automaton") => file.automata.extend(self.parse_automaton(doc)),
                Some("device" | "assembly") => file.devices.extend(self.parse_device(doc)),
                _ if *self.peek() == Token::End => return file,
                _ => {
                    let found = self.found();
                    let near = match self.peek() {
                        Token::Word(w) => suggestion(w, ITEMS),
                        _ => None,
                    };
                    let help = near.map_or(
                        "a file has `enum`, `interface`, `automaton`, `device` and `assembly`".to_string(),
                        |w| format!("is `{w}` meant?"),
                    );
                    self.error("E0204", format!("{found} cannot begin an item"), help);
                    self.recover_to_item();
                }
            }
        }
    }

    /// The pieces of a text that begins at `start` of the file: words, and in braces values to show.
    fn shown_text(&mut self, text: &str, start: usize) -> Vec<ast::TextPart> {
        let mut parts = Vec::new();
        let mut at = 0;
        while let Some(opens) = text[at..].find('{').map(|i| at + i) {
            if parts.len() > MOST_SHOWN {
                let message = format!("a text shows more than {} values", MOST_SHOWN / 2);
                self.error("E0211", message, "divide this requirement into several");
                return parts;
            }
            if opens > at {
                parts.push(ast::TextPart::Words(text[at..opens].into()));
            }
            let closes = text[opens..].find('}').map(|i| opens + i);
            let end = closes.unwrap_or(text.len());
            let (mut tokens, mut diagnostics) =
                lexer::tokens(self.span().file, &text[opens + 1..end], MOST_TOKENS);
            tokens.iter_mut().for_each(|(_, span)| *span = span.after(start + opens + 1));
            diagnostics.iter_mut().for_each(|d| d.place = d.place.after(start + opens + 1));
            let mut inner = Parser::new(tokens, diagnostics);
            if *inner.peek() == Token::End {
                inner.error(
                    "E0205",
                    "there is nothing between the braces".into(),
                    "an expression in a text is between two braces",
                );
            }
            let value = inner.parse_expr();
            if *inner.peek() != Token::End {
                let found = inner.found();
                inner.error(
                    "E0205",
                    format!("`}}` is missing before {found}"),
                    "a text has one expression between two braces",
                );
            } else if closes.is_none() {
                inner.error(
                    "E0205",
                    "`}` is missing after the value".into(),
                    "an expression in a text is between two braces",
                );
            }
            self.errors += inner.errors;
            self.diagnostics.append(&mut inner.diagnostics);
            parts.push(ast::TextPart::Value(value));
            at = (end + 1).min(text.len());
        }
        if at < text.len() {
            parts.push(ast::TextPart::Words(text[at..].into()));
        }
        parts
    }

    fn recover_to_item(&mut self) {
        let mut depth = 0usize;
        self.next();
        loop {
            match self.peek() {
                Token::End => return,
                Token::Sign("{") => depth += 1,
                Token::Sign("}") => depth = depth.saturating_sub(1),
                Token::Word(w) if depth == 0 && ITEMS.contains(&w.as_str()) => {
                    return;
                }
                _ => {}
            }
            self.next();
        }
    }

    /// Skips to the end of a broken member: past a `;` or a whole block, or before the closing brace of the one around it.
    fn recover(&mut self) {
        let mut depth = 0usize;
        loop {
            match self.peek() {
                Token::End => return,
                Token::Sign("}") if depth == 0 => return,
                Token::Sign("}") => {
                    depth -= 1;
                    if depth == 0 {
                        self.next();
                        return;
                    }
                }
                Token::Sign("{") => depth += 1,
                Token::Sign(";") if depth == 0 => {
                    self.next();
                    return;
                }
                _ => {}
            }
            self.next();
        }
    }

    fn peek(&self) -> &Token {
        &self.tokens[self.position.min(self.tokens.len() - 1)].0
    }

    fn peek_second(&self) -> &Token {
        &self.tokens[(self.position + 1).min(self.tokens.len() - 1)].0
    }

    fn span(&self) -> Span {
        self.tokens[self.position.min(self.tokens.len() - 1)].1
    }

    /// End of the token before this one.
    fn last_span(&self) -> Span {
        self.tokens[self.position.saturating_sub(1).min(self.tokens.len() - 1)].1
    }

    fn next(&mut self) {
        if self.position < self.tokens.len() - 1 {
            self.position += 1;
        }
    }

    fn word(&self) -> Option<&str> {
        match self.peek() {
            Token::Word(w) => Some(w),
            _ => None,
        }
    }

    fn at_word(&self, word: &str) -> bool {
        self.word() == Some(word)
    }

    fn at_sign(&self, sign: &'static str) -> bool {
        *self.peek() == Token::Sign(sign)
    }

    fn maybe_word(&mut self, word: &str) -> bool {
        let found = self.at_word(word);
        if found {
            self.next();
        }
        found
    }

    fn maybe_sign(&mut self, sign: &'static str) -> bool {
        let found = self.at_sign(sign);
        if found {
            self.next();
        }
        found
    }

    /// `None` has been reported.
    fn expect_sign(&mut self, sign: &'static str, after: &str) -> Option<()> {
        if self.maybe_sign(sign) {
            return Some(());
        }
        let found = self.found();
        let is_confused = CONFUSED.contains(&sign) && CONFUSED.iter().any(|other| self.at_sign(other));
        let (place, help) = match sign {
            ";" => (self.last_span(), "write `;` after this".to_string()),
            _ if is_confused => (self.span(), format!("write `{sign}` instead of {found}")),
            _ => (self.span(), format!("write `{sign}` before {found}")),
        };
        let missing = Diagnostic::new("E0205", place, format!("`{sign}` is missing {after}"))
            .label(if sign == ";" { format!("then comes {found}") } else { String::new() })
            .help(help);
        if sign == ";" && self.is_before_description_of_next() {
            self.note(missing);
            return Some(());
        }
        self.report(missing);
        is_confused.then(|| self.next())
    }

    /// Whether a description stands here, and behind it no `;`.
    fn is_before_description_of_next(&self) -> bool {
        let from_here = self.tokens[self.position.min(self.tokens.len() - 1)..].iter();
        let mut rest = from_here.skip_while(|(token, _)| matches!(token, Token::Doc(_)));
        matches!(self.peek(), Token::Doc(_))
            && rest.next().is_none_or(|(token, _)| *token != Token::Sign(";"))
    }

    fn expect_word(&mut self, word: &str, after: &str) -> Option<()> {
        if self.maybe_word(word) {
            return Some(());
        }
        let found = self.found();
        self.error(
            "E0205",
            format!("`{word}` is missing {after}"),
            match self.peek() {
                Token::Sign(_) | Token::End => format!("write `{word}` before {found}"),
                _ => format!("write `{word}` instead of {found}"),
            },
        );
        None
    }

    fn expect_name(&mut self, what: &str) -> Option<ast::Name> {
        let span = self.span();
        match self.peek().clone() {
            Token::Word(w) if RESERVED.contains(&w.as_str()) && w != "in" => {
                self.error(
                    "E0206",
                    format!("`{w}` is a word of the language and cannot name {what}"),
                    format!("choose another name, such as `{w}_1`"),
                );
                self.next();
                Some(Spanned { value: w, span })
            }
            Token::Word(w) if w != "in" => {
                self.next();
                Some(Spanned { value: w, span })
            }
            _ => {
                let found = self.found();
                self.error(
                    "E0205",
                    format!("the name of {what} is missing"),
                    format!("write a name before {found}"),
                );
                None
            }
        }
    }

    /// Whether an item of a file begins here.
    fn at_item(&self) -> bool {
        self.word().is_some_and(|word| ITEMS.contains(&word)) && matches!(self.peek_second(), Token::Word(_))
    }

    /// What is here, for a message.
    fn found(&self) -> String {
        match self.peek() {
            Token::Word(w) => format!("`{w}`"),
            Token::Int(i) => format!("`{i}`"),
            Token::Real(r) => format!("`{r}`"),
            Token::Text(_) => "a text".into(),
            Token::Doc(_) => "a `///` comment".into(),
            Token::Sign(s) => format!("`{s}`"),
            Token::End => "the end of the file".into(),
        }
    }

    fn error(&mut self, code: &'static str, message: String, help: impl Into<String>) {
        let span = self.span();
        self.report(Diagnostic::new(code, span, message).help(help));
    }

    /// Of several errors at one token only the first is reported. A description that stands here is passed over.
    fn report(&mut self, diagnostic: Diagnostic) {
        let diagnostic = self.misplaced_description().unwrap_or(diagnostic);
        self.note(diagnostic);
        if !self.doc().is_empty() {
            self.error_at = Some(self.position);
        }
    }

    /// As [`Self::report`], where a description may stand.
    fn note(&mut self, diagnostic: Diagnostic) {
        if self.error_at != Some(self.position) {
            collect(&mut self.diagnostics, diagnostic);
        }
        self.error_at = Some(self.position);
        self.errors += 1;
    }

    /// What is wrong if a description stands here, where something else is expected.
    fn misplaced_description(&self) -> Option<Diagnostic> {
        let message = "a `///` comment describes what follows it, and cannot stand here";
        let help = "begin it with `//`, or put it above the declaration";
        matches!(self.peek(), Token::Doc(_))
            .then(|| Diagnostic::new("E0204", self.span(), message).help(help))
    }

    /// Skips to one of these signs, past whole parentheses; not past a brace or a `;`.
    fn skip_to(&mut self, signs: &[&str]) {
        let mut depth = 0usize;
        loop {
            match self.peek() {
                Token::End | Token::Sign("{" | "}" | ";") => break,
                Token::Sign(sign) if depth == 0 && signs.contains(sign) => break,
                Token::Sign("(" | "[") => depth += 1,
                Token::Sign(")" | "]") => depth = depth.saturating_sub(1),
                _ => {}
            }
            self.next();
        }
        self.error_at = Some(self.position);
    }

    /// The `///` lines that stand here.
    fn doc(&mut self) -> Vec<String> {
        let mut lines = Vec::new();
        while let Token::Doc(line) = self.peek() {
            lines.push(line.clone());
            self.next();
        }
        lines
    }
}
