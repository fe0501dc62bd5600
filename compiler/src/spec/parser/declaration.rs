//! `enum`, `interface`, and the declarations that interfaces and automata share.

use super::Parser;
use super::automaton::MEMBERS;
use super::property::WORDS;
use crate::spec::ast;
use crate::spec::lexer::Token;

impl Parser {
    pub(super) fn parse_enum(&mut self, doc: Vec<String>) -> Option<ast::Enum> {
        self.next();
        let name = self.expect_name("the enumeration")?;
        let mut members = Vec::new();
        if self.expect_sign("{", "before the members of the enumeration").is_none() {
            self.recover();
            return None;
        }
        while !self.at_sign("}") && *self.peek() != Token::End {
            match self.expect_name("a member") {
                Some(member) => members.push(member),
                None => {
                    self.recover();
                    break;
                }
            }
            if !self.maybe_sign(",") {
                break;
            }
        }
        if self.expect_sign("}", "after the members of the enumeration").is_none() {
            self.recover();
            self.maybe_sign("}");
        }
        Some(ast::Enum { doc, name, members })
    }

    pub(super) fn parse_interface(&mut self, doc: Vec<String>) -> Option<ast::Interface> {
        self.next();
        let name = self.expect_name("the interface")?;
        let mut interface =
            ast::Interface { doc, name, parameters: Vec::new(), cells: Vec::new(), properties: Vec::new() };
        if self.expect_sign("{", "before the members of the interface").is_none() {
            self.recover();
            return Some(interface);
        }
        loop {
            let doc = self.doc();
            if self.maybe_sign("}") {
                return Some(interface);
            }
            if *self.peek() == Token::End || self.at_item() {
                let message =
                    format!("`}}` is missing at the end of the interface `{}`", interface.name.value);
                self.error("E0205", message, "close the interface");
                return Some(interface);
            }
            match self.word() {
                Some("parameter") => interface.parameters.extend(self.parse_parameter(doc)),
                Some("shared") => interface.cells.extend(self.parse_cell(doc)),
                Some(word) if WORDS.contains(&word) => interface.properties.extend(self.parse_property()),
                _ => {
                    let found = self.found();
                    self.error(
                        "E0204",
                        format!("{found} is not allowed in an interface"),
                        "an interface has `parameter`, `shared`, `invariant`, `keep` and `whenever`",
                    );
                    self.next();
                    self.recover_declaration();
                }
            }
        }
    }

    pub(super) fn parse_parameter(&mut self, doc: Vec<String>) -> Option<ast::Parameter> {
        self.next();
        let parameter = self.typed("the parameter", ":=").map(|(name, ty, default)| ast::Parameter {
            doc,
            name,
            ty,
            default,
        });
        self.end_of_declaration(parameter.is_some());
        parameter
    }

    pub(super) fn parse_cell(&mut self, doc: Vec<String>) -> Option<ast::Cell> {
        self.next();
        let cell = self.typed("the shared variable", ":=").and_then(|(name, ty, initial)| {
            let rule = if self.maybe_word("by") {
                Some(self.rule()?)
            } else if self.maybe_word("with") {
                Some(ast::Rule::With(self.expect_name("the cell whose rule this one follows")?))
            } else {
                None
            };
            Some(ast::Cell { doc, name, ty, initial, rule })
        });
        self.end_of_declaration(cell.is_some());
        cell
    }

    pub(super) fn parse_local(&mut self, doc: Vec<String>) -> Option<ast::Local> {
        self.next();
        let local = self.typed("the local variable", ":=").map(|(name, ty, initial)| ast::Local {
            doc,
            name,
            ty,
            initial,
        });
        self.end_of_declaration(local.is_some());
        local
    }

    pub(super) fn end_of_declaration(&mut self, whole: bool) {
        if !whole || self.expect_sign(";", "at the end of the declaration").is_none() {
            self.recover_declaration();
        }
    }

    /// To the next declaration or state on this level, or past a `;`.
    fn recover_declaration(&mut self) {
        loop {
            match self.peek() {
                Token::End | Token::Sign("}") | Token::Doc(_) => return,
                Token::Word(w) if MEMBERS.contains(&w.as_str()) => return,
                Token::Sign(";") => {
                    self.next();
                    return;
                }
                Token::Sign("{") => {
                    self.recover();
                    return;
                }
                _ => self.next(),
            }
        }
    }

    fn typed(&mut self, what: &str, sign: &'static str) -> Option<(ast::Name, ast::Type, Option<ast::Expr>)> {
        let errors = self.errors;
        let name = self.expect_name(what)?;
        self.expect_sign(":", "before the type")?;
        let ty = self.parse_type()?;
        if self.at_sign("=") && sign == ":=" {
            self.error("E0205", "`:=` is missing before the value".into(), "write `:=` instead of `=`");
            self.next();
            self.parse_expr();
        }
        let value = if self.maybe_sign(sign) { Some(self.parse_expr()) } else { None };
        (self.errors == errors).then_some((name, ty, value))
    }

    fn rule(&mut self) -> Option<ast::Rule> {
        let rule = match self.word() {
            Some("owner") => ast::Rule::Owner,
            Some("handshake") => ast::Rule::Handshake,
            Some("lock") => ast::Rule::Lock,
            Some("counter") => ast::Rule::Counter,
            Some("token") => {
                self.next();
                let rule = self.token_rule();
                if rule.is_none() {
                    self.skip_to(&[]);
                    self.maybe_sign("}");
                }
                return rule;
            }
            _ => {
                let found = self.found();
                self.error(
                    "E0207",
                    format!("{found} is not a rule of writing"),
                    "write `owner`, `handshake`, `lock`, `counter` or `token { Value: owner, ... }` after `by`",
                );
                return None;
            }
        };
        self.next();
        Some(rule)
    }

    fn token_rule(&mut self) -> Option<ast::Rule> {
        self.expect_sign("{", "before the values of the token")?;
        let mut sides = Vec::new();
        while !self.at_sign("}") {
            let value = self.expect_name("a value of the token")?;
            self.expect_sign(":", "between a value and who may write")?;
            let side = match self.word() {
                Some("owner") => ast::Side::Owner,
                Some("others") => ast::Side::Others,
                _ => {
                    let found = self.found();
                    self.error(
                        "E0207",
                        format!("{found} does not say who may write"),
                        "write `owner` or `others`",
                    );
                    return None;
                }
            };
            self.next();
            sides.push((value, side));
            if !self.maybe_sign(",") {
                break;
            }
        }
        self.expect_sign("}", "after the values of the token")?;
        Some(ast::Rule::Token(sides))
    }

    /// Whether something stands behind `int` that begins no bound.
    fn lacks_bounds(&self) -> bool {
        match self.peek() {
            Token::Word(w) => ["by", "with"].contains(&w.as_str()),
            Token::Sign(sign) => !["-", "("].contains(sign),
            Token::End => true,
            _ => false,
        }
    }

    fn no_second_size(&mut self) -> Option<()> {
        if !self.at_sign("[") {
            return Some(());
        }
        self.error(
            "E0205",
            "there are no arrays of arrays: `;` or a value is expected after the size".into(),
            "write one array with all elements, `bool[6]` for 3 rows of 2, and compute its index, `k[2 * row + column]`",
        );
        None
    }

    pub(super) fn parse_type(&mut self) -> Option<ast::Type> {
        let span = self.span();
        let name = self.expect_name("the type")?;
        let scalar = match name.value.as_str() {
            "bool" => ast::Scalar::Bool,
            "int" => {
                if self.lacks_bounds() {
                    self.error(
                        "E0205",
                        "the bounds of an `int` are missing".into(),
                        "an int has bounds: `int 0..12`",
                    );
                    return None;
                }
                let lo = self.parse_bound();
                self.expect_sign("..", "between the bounds of an `int`")?;
                let hi = self.parse_bound();
                ast::Scalar::Int { lo, hi }
            }
            "real" => ast::Scalar::Real,
            "time" => ast::Scalar::Time,
            "point" => ast::Scalar::Point,
            _ => ast::Scalar::Named(name),
        };
        let extent = if self.maybe_sign("[") {
            let extent = self.parse_expr();
            self.expect_sign("]", "after the size of the array")?;
            self.no_second_size()?;
            Some(extent)
        } else {
            None
        };
        Some(ast::Type { span: span.to(self.last_span()), scalar, extent })
    }
}
