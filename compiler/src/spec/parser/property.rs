//! What a type promises: `invariant`, `keep`, `whenever`, `answer`, and what a violation does.

use super::Parser;
use crate::spec::ast::{Property, PropertyKind, Reaction};
use crate::spec::lexer::Token;

/// The words with which a property begins.
pub(super) const WORDS: [&str; 4] = ["answer", "invariant", "keep", "whenever"];

/// Values of one `keep`: what compares them is one expression.
const MOST_KEPT: usize = 32;

impl Parser {
    pub(super) fn parse_property(&mut self) -> Option<Property> {
        let property = self.property();
        self.end_of_declaration(property.is_some());
        property
    }

    fn property(&mut self) -> Option<Property> {
        let begin = self.span();
        let errors = self.errors;
        let word = self.word().map(str::to_string);
        self.next();
        let kind = match word.as_deref() {
            Some("keep") => {
                let mut values = vec![self.parse_expr()];
                while self.errors == errors && self.maybe_sign(",") {
                    if values.len() == MOST_KEPT {
                        self.error(
                            "E0211",
                            format!("a `keep` has at most {MOST_KEPT} values"),
                            "make several of it",
                        );
                        break;
                    }
                    values.push(self.parse_expr());
                }
                if self.errors == errors {
                    self.expect_word("while", "after what is kept")?;
                }
                PropertyKind::Keep { values, condition: self.parse_expr() }
            }
            Some("whenever") => {
                let trigger = self.parse_expr();
                if self.errors == errors {
                    self.expect_word("then", "before what follows")?;
                }
                let goal = self.parse_expr();
                if self.errors == errors {
                    self.expect_word("within", "before the time in which it follows")?;
                }
                PropertyKind::Whenever { trigger, goal, within: self.parse_expr() }
            }
            Some("answer") => {
                self.expect_word("within", "after `answer`")?;
                PropertyKind::Answer { within: self.parse_expr() }
            }
            _ => PropertyKind::Always(self.parse_expr()),
        };
        if self.errors > errors {
            return None;
        }
        let span = begin.to(self.last_span());
        Some(Property { span, kind, reaction: self.reaction()? })
    }

    fn reaction(&mut self) -> Option<Reaction> {
        if !self.maybe_word("else") {
            return Some(Reaction::Fault);
        }
        let reaction = if self.maybe_word("warn") {
            Reaction::Warn
        } else if self.maybe_word("stop") {
            match self.word() {
                Some("machine") => {
                    self.next();
                    Reaction::StopMachine
                }
                Some("line") => {
                    self.next();
                    Reaction::StopLine
                }
                _ => {
                    let found = self.found();
                    self.error(
                        "E0205",
                        format!("`machine` or `line` is missing before {found}"),
                        "write `else stop machine \"text\"` or `else stop line \"text\"`",
                    );
                    return None;
                }
            }
        } else {
            Reaction::Ask
        };
        let Token::Text(text) = self.peek().clone() else {
            self.error(
                "E0205",
                "the text of the property is missing".into(),
                "write a text for the operator; or remove `else`, and it is a fault",
            );
            return None;
        };
        self.next();
        Some(reaction(text))
    }
}
