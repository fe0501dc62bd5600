//! `automaton`: its head and the members that are not states.

use super::Parser;
use super::property::WORDS;
use crate::diagnostic::suggestion;
use crate::spec::ast;
use crate::spec::lexer::{Token, foreign};

/// The words with which the parts of an automaton begin.
pub(super) const MEMBERS: &[&str] = &[
    "parameter",
    "shared",
    "local",
    "define",
    "takes",
    "hands",
    "serves",
    "knows",
    "require",
    "retain",
    "invariant",
    "keep",
    "whenever",
    "answer",
    "initial",
    "any",
    "state",
    "final",
    "resume",
];

impl Parser {
    pub(super) fn parse_automaton(&mut self, doc: Vec<String>) -> Option<ast::Automaton> {
        self.next();
        let name = self.expect_name("the automaton")?;
        let device = match self.expect_word("on", "after the name of the automaton") {
            Some(()) => self.expect_name("the device"),
            None => None,
        };
        let device = device.unwrap_or(ast::Name { value: String::new(), span: name.span });
        let mut automaton = ast::Automaton {
            doc,
            name,
            device,
            implements: Vec::new(),
            parameters: Vec::new(),
            cells: Vec::new(),
            roles: Vec::new(),
            locals: Vec::new(),
            defines: Vec::new(),
            requires: Vec::new(),
            retain: None,
            properties: Vec::new(),
            initial: None,
            any: Vec::new(),
            states: Vec::new(),
        };
        if self.maybe_word("is") {
            while let Some(implements) = self.implements() {
                automaton.implements.push(implements);
                if !self.maybe_sign(",") {
                    break;
                }
            }
        }
        if self.expect_sign("{", "before the body of the automaton").is_none() {
            while !matches!(self.peek(), Token::Sign("{") | Token::End) && !self.at_word("automaton") {
                self.next();
            }
            if !self.maybe_sign("{") {
                return Some(automaton);
            }
        }
        loop {
            let doc = self.doc();
            if self.maybe_sign("}") {
                return Some(automaton);
            }
            if *self.peek() == Token::End || self.at_item() {
                self.error(
                    "E0205",
                    format!("`}}` is missing at the end of the automaton `{}`", automaton.name.value),
                    "close the automaton, or look for a block that is not closed",
                );
                return Some(automaton);
            }
            self.member(&mut automaton, doc);
        }
    }

    fn implements(&mut self) -> Option<ast::Implements> {
        let interface = self.expect_name("the interface")?;
        let direction = match self.word() {
            Some("accepts") => ast::Direction::Accepts,
            Some("offers") => ast::Direction::Offers,
            _ => return Some(ast::Implements { interface, handover: None }),
        };
        let span = self.span();
        self.next();
        self.expect_word("at", "before the place of the handover")?;
        let place = self.expect_name("the place of the handover")?;
        let index = if self.maybe_sign("[") {
            let index = self.parse_expr();
            self.expect_sign("]", "after the number of the place")?;
            Some(index)
        } else {
            None
        };
        let approach = if self.maybe_word("approach") { Some(self.parse_sum()) } else { None };
        let span = span.to(self.last_span());
        Some(ast::Implements {
            interface,
            handover: Some(ast::Handover { span, direction, place, index, approach }),
        })
    }

    fn member(&mut self, automaton: &mut ast::Automaton, doc: Vec<String>) {
        match self.word() {
            Some("parameter") => automaton.parameters.extend(self.parse_parameter(doc)),
            Some("shared") => automaton.cells.extend(self.parse_cell(doc)),
            Some("local") => automaton.locals.extend(self.parse_local(doc)),
            Some("define") => {
                self.next();
                let define = self.define(doc);
                self.end_of_declaration(define.is_some());
                automaton.defines.extend(define);
            }
            Some("takes") => self.role(automaton, doc, ast::RoleKind::Takes, Some("from")),
            Some("hands") => self.role(automaton, doc, ast::RoleKind::Hands, Some("to")),
            Some("serves") => self.role(automaton, doc, ast::RoleKind::Serves, None),
            Some("knows") => self.role(automaton, doc, ast::RoleKind::Knows, None),
            Some("require") => {
                let require = self.require();
                self.end_of_declaration(require.is_some());
                automaton.requires.extend(require);
            }
            Some("retain") => self.retain(automaton),
            Some(word) if WORDS.contains(&word) => automaton.properties.extend(self.parse_property()),
            Some("initial") if *self.peek_second() == Token::Sign("->") => {
                let span = self.span();
                self.next();
                self.next();
                if let Some(target) = self.expect_name("the first state") {
                    let updates = self.parse_updates();
                    let span = span.to(self.last_span());
                    self.set_initial(automaton, ast::Initial { span, target, updates });
                } else {
                    self.recover();
                }
            }
            Some("initial") => {
                let span = self.span();
                self.next();
                if !matches!(self.word(), Some("state" | "resume" | "final")) {
                    let found = self.found();
                    let help = format!(
                        "write `->` before {found} and the updates after it, or `state` before {found}"
                    );
                    self.error("E0205", "`->` or `state` is missing after `initial`".into(), help);
                    self.recover();
                } else if let Some(state) = self.parse_state(doc) {
                    let target = state.name.clone();
                    self.set_initial(automaton, ast::Initial { span, target, updates: Vec::new() });
                    automaton.states.push(state);
                }
            }
            Some("any") => automaton.any.extend(self.parse_any()),
            Some("state" | "final" | "resume") => automaton.states.extend(self.parse_state(doc)),
            _ => {
                let found = self.found();
                let near = match self.peek() {
                    Token::Word(w) => {
                        foreign::meant_among(w, MEMBERS).or_else(|| suggestion(w, MEMBERS.iter().copied()))
                    }
                    _ => None,
                };
                let help = match near {
                    Some(word) => format!("is `{word}` meant?"),
                    None if self.at_sign(";") => "remove it: nothing ends with `;` after its `}`".into(),
                    None => format!("an automaton has {}", MEMBERS.join(", ")),
                };
                self.error("E0204", format!("{found} is not allowed in an automaton"), help);
                if !self.maybe_sign(";") {
                    self.next();
                    self.recover();
                }
            }
        }
    }

    fn set_initial(&mut self, automaton: &mut ast::Automaton, initial: ast::Initial) {
        if let Some(before) = &automaton.initial {
            self.report(
                crate::diagnostic::Diagnostic::new(
                    "E0208",
                    initial.span,
                    "an automaton begins in one state only",
                )
                .other(before.span, "the first initial state is here")
                .help("remove one `initial`"),
            );
            return;
        }
        automaton.initial = Some(initial);
    }

    /// `retain all;` or `retain state, next;`
    fn retain(&mut self, automaton: &mut ast::Automaton) {
        let span = self.span();
        self.next();
        let mut names = Vec::new();
        loop {
            let name = if self.at_word("state") {
                let name = ast::Name { value: "state".into(), span: self.span() };
                self.next();
                Some(name)
            } else {
                self.expect_name("what is retained")
            };
            let is_named = name.is_some();
            names.extend(name);
            if !is_named || !self.maybe_sign(",") {
                self.end_of_declaration(is_named);
                break;
            }
        }
        if let Some(before) = &automaton.retain {
            self.report(
                crate::diagnostic::Diagnostic::new("E0208", span, "an automaton has one `retain`")
                    .other(before.span, "the first one is here")
                    .help("put the names into one list"),
            );
            return;
        }
        automaton.retain = Some(ast::Retain { span, names });
    }

    fn define(&mut self, doc: Vec<String>) -> Option<ast::Define> {
        let name = self.expect_name("the definition")?;
        self.expect_sign("=", "after the name of the definition")?;
        let errors = self.errors;
        let value = self.parse_expr();
        (self.errors == errors).then_some(ast::Define { doc, name, value })
    }

    pub(super) fn require(&mut self) -> Option<ast::Require> {
        let span = self.span();
        self.next();
        let errors = self.errors;
        let condition = self.parse_expr();
        if self.errors > errors {
            return None;
        }
        self.expect_word("else", "after the required condition")?;
        let Token::Text(text) = self.peek().clone() else {
            self.error(
                "E0205",
                "the reason of the requirement is missing".into(),
                "write a text for the user after `else`",
            );
            return None;
        };
        let start = self.span().start + 1;
        self.next();
        let text = self.shown_text(&text, start as usize);
        Some(ast::Require { span: span.to(self.last_span()), condition, text })
    }

    fn role(
        &mut self,
        automaton: &mut ast::Automaton,
        doc: Vec<String>,
        kind: ast::RoleKind,
        preposition: Option<&'static str>,
    ) {
        self.next();
        let role = self.role_rest(doc, kind, preposition);
        self.end_of_declaration(role.is_some());
        automaton.roles.extend(role);
    }

    fn role_rest(
        &mut self,
        doc: Vec<String>,
        kind: ast::RoleKind,
        preposition: Option<&'static str>,
    ) -> Option<ast::Role> {
        if let Some(word) = preposition {
            self.expect_word(word, "before the name of the role")?;
        }
        let name = self.expect_name("the role")?;
        self.expect_sign(":", "before the interface of the role")?;
        let mut also = Vec::new();
        let interface = if self.maybe_sign("(") {
            let interface = self.expect_name("the interface of the role")?;
            while self.maybe_word("and") {
                also.push(self.expect_name("the further interface of the role")?);
            }
            self.expect_sign(")", "after the interfaces of the role")?;
            interface
        } else {
            self.expect_name("the interface of the role")?
        };
        let (min, max) = self.cardinality()?;
        Some(ast::Role { doc, kind, name, interface, also, min, max })
    }

    fn cardinality(&mut self) -> Option<(usize, Option<usize>)> {
        if !self.maybe_sign("[") {
            return Some((1, Some(1)));
        }
        if self.maybe_sign("]") {
            return Some((0, None));
        }
        let min = self.count()?;
        let max = if self.maybe_sign("..") {
            if self.at_sign("]") { None } else { Some(self.count()?) }
        } else {
            Some(min)
        };
        self.expect_sign("]", "after the number of the role's members")?;
        Some((min, max))
    }

    fn count(&mut self) -> Option<usize> {
        if let Token::Int(value) = *self.peek() {
            self.next();
            return usize::try_from(value).ok();
        }
        let found = self.found();
        self.error(
            "E0205",
            format!("a number of members is missing before {found}"),
            "write `[1..]`, `[2..4]` or `[]`",
        );
        None
    }
}
