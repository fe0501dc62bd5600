//! Expressions, by precedence: `or`, `and`, `not`, comparisons, sums, products, signs, accesses.

use super::{DEEPEST, LONGEST, Parser};
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use crate::spec::ast::{self, Expr, ExprKind, Operator, Quantifier};
use crate::spec::lexer::{Token, foreign};

impl Parser {
    pub(super) fn parse_expr(&mut self) -> Expr {
        self.nested(Self::disjunction)
    }

    /// A sum or anything that binds closer: no comparison, no `and`.
    pub(super) fn parse_sum(&mut self) -> Expr {
        self.nested(Self::sum)
    }

    pub(super) fn parse_domain(&mut self) -> ast::Domain {
        let low = self.parse_sum();
        if self.maybe_sign("..") {
            let high = self.parse_sum();
            return ast::Domain::Range(low, high);
        }
        match low.kind {
            ExprKind::Name(value) => ast::Domain::Named(ast::Name { value, span: low.span }),
            ExprKind::Error => ast::Domain::Range(error(low.span), error(low.span)),
            _ => {
                self.report(
                    crate::diagnostic::Diagnostic::new(
                        "E0210",
                        low.span,
                        "there are no values to choose from",
                    )
                    .help("write a role, an enumeration or a range such as `0..capacity - 1`"),
                );
                ast::Domain::Range(error(low.span), error(low.span))
            }
        }
    }

    pub(super) fn nested(&mut self, parse: impl FnOnce(&mut Self) -> Expr) -> Expr {
        if self.depth >= DEEPEST {
            return self.too_large("this expression is nested too deeply");
        }
        if self.depth == 0 {
            self.length = 0;
        }
        self.depth += 1;
        let result = parse(self);
        self.depth -= 1;
        result
    }

    /// Whether the expression may grow by one more operator; otherwise it has been reported.
    fn grows(&mut self) -> bool {
        self.length += 1;
        if self.length > LONGEST {
            self.too_large("this expression is too long");
        }
        self.length <= LONGEST
    }

    fn too_large(&mut self, message: &str) -> Expr {
        let span = self.span();
        self.error("E0211", message.into(), "name its parts with `define`");
        self.skip_to(&["->"]);
        error(span)
    }

    fn disjunction(&mut self) -> Expr {
        let mut left = self.conjunction();
        while self.at_word("or") && self.grows() {
            self.next();
            let right = self.conjunction();
            left = binary(Operator::Or, left, right);
        }
        left
    }

    fn conjunction(&mut self) -> Expr {
        let mut left = self.negation();
        while self.at_word("and") && self.grows() {
            self.next();
            let right = self.negation();
            left = binary(Operator::And, left, right);
        }
        left
    }

    fn negation(&mut self) -> Expr {
        let span = self.span();
        if self.maybe_word("not") {
            let operand = self.nested(Self::negation);
            return Expr { span: span.to(operand.span), kind: ExprKind::Not(Box::new(operand)) };
        }
        self.comparison()
    }

    fn comparison(&mut self) -> Expr {
        let left = self.sum();
        let operator = match self.peek() {
            Token::Sign("=") => Operator::Equal,
            Token::Sign("<>") => Operator::NotEqual,
            Token::Sign("<") => Operator::Less,
            Token::Sign("<=") => Operator::LessEqual,
            Token::Sign(">") => Operator::Greater,
            Token::Sign(">=") => Operator::GreaterEqual,
            Token::Word(w) if w == "in" => {
                self.next();
                let Some(role) = self.expect_name("the role") else { return error(left.span) };
                return Expr { span: left.span.to(role.span), kind: ExprKind::In(Box::new(left), role) };
            }
            Token::Word(w) if w == "reaches" => {
                self.next();
                let right = self.sum();
                return Expr {
                    span: left.span.to(right.span),
                    kind: ExprKind::Reaches(Box::new(left), Box::new(right)),
                };
            }
            _ => return left,
        };
        self.next();
        let right = self.sum();
        let whole = binary(operator, left, right);
        if matches!(self.peek(), Token::Sign("=" | "<>" | "<" | "<=" | ">" | ">=")) {
            self.error(
                "E0212",
                "comparisons cannot be chained".into(),
                "join two comparisons with `and`, or put one in parentheses",
            );
            self.next();
            self.sum();
        }
        whole
    }

    fn sum(&mut self) -> Expr {
        let mut left = self.product();
        loop {
            let operator = match self.peek() {
                Token::Sign("+") => Operator::Add,
                Token::Sign("-") => Operator::Subtract,
                _ => return left,
            };
            if !self.grows() {
                return left;
            }
            self.next();
            let right = self.product();
            left = binary(operator, left, right);
        }
    }

    fn product(&mut self) -> Expr {
        let mut left = self.sign();
        loop {
            let operator = match self.peek() {
                Token::Sign("*") => Operator::Multiply,
                Token::Sign("/") => Operator::Divide,
                Token::Word(w) if w == "mod" => Operator::Modulo,
                _ => return left,
            };
            if !self.grows() {
                return left;
            }
            self.next();
            let right = self.sign();
            left = binary(operator, left, right);
        }
    }

    /// A bound of a type: no index may follow, since `[` begins the size of an array.
    pub(super) fn parse_bound(&mut self) -> Expr {
        let span = self.span();
        if self.maybe_sign("-") {
            let operand = self.primary();
            return Expr { span: span.to(operand.span), kind: ExprKind::Negate(Box::new(operand)) };
        }
        self.primary()
    }

    fn sign(&mut self) -> Expr {
        let span = self.span();
        if self.maybe_sign("-") {
            let operand = self.nested(Self::sign);
            return Expr { span: span.to(operand.span), kind: ExprKind::Negate(Box::new(operand)) };
        }
        self.parse_postfix()
    }

    pub(super) fn parse_postfix(&mut self) -> Expr {
        let mut base = self.primary();
        loop {
            if matches!(self.peek(), Token::Sign("." | "[")) && !self.grows() {
                return error(base.span);
            }
            if self.maybe_sign(".") {
                let Some(member) = self.expect_member() else { return error(base.span) };
                base =
                    Expr { span: base.span.to(member.span), kind: ExprKind::Member(Box::new(base), member) };
            } else if self.maybe_sign("[") {
                let index = self.parse_expr();
                if self.expect_sign("]", "after the index").is_none() {
                    return error(base.span);
                }
                let span = base.span.to(self.last_span());
                base = Expr { span, kind: ExprKind::Index(Box::new(base), Box::new(index)) };
            } else {
                return base;
            }
        }
    }

    fn expect_member(&mut self) -> Option<ast::Name> {
        let span = self.span();
        if let Token::Word(w) = self.peek().clone() {
            self.next();
            return Some(ast::Name { value: w, span });
        }
        self.error("E0205", "a name is missing after `.`".into(), "write the cell or parameter to read");
        None
    }

    fn primary(&mut self) -> Expr {
        let span = self.span();
        match self.peek().clone() {
            Token::Int(value) => {
                self.next();
                self.with_unit(span, value as f64, ExprKind::Int(value))
            }
            Token::Real(value) => {
                self.next();
                self.with_unit(span, value, ExprKind::Real(value))
            }
            Token::Sign("(") => {
                self.next();
                let inner = self.parse_expr();
                if self.expect_sign(")", "to close the parenthesis").is_none() {
                    return error(span);
                }
                Expr { span: span.to(self.last_span()), kind: inner.kind }
            }
            Token::Word(w) => self.word_expr(w, span),
            Token::Sign("[") => {
                self.next();
                let elements = self.list("]");
                if self.expect_sign("]", "after the elements of the list").is_none() {
                    return error(span);
                }
                Expr { span: span.to(self.last_span()), kind: ExprKind::List(elements) }
            }
            _ => {
                let found = self.found();
                self.error(
                    "E0213",
                    format!("{found} is not a value"),
                    "write a name, a number or an expression in parentheses",
                );
                if !matches!(self.peek(), Token::Sign("}" | ";" | ")" | "]" | "->" | ",") | Token::End) {
                    self.next();
                }
                error(span)
            }
        }
    }

    fn word_expr(&mut self, word: String, span: Span) -> Expr {
        match word.as_str() {
            "true" | "false" => {
                self.next();
                Expr { span, kind: ExprKind::Bool(word == "true") }
            }
            "after" => {
                self.next();
                let time = self.parse_sum();
                Expr { span: span.to(time.span), kind: ExprKind::After(Box::new(time)) }
            }
            "exists" => self.quantified(Quantifier::Exists, span),
            "forall" => self.quantified(Quantifier::Forall, span),
            "count" if *self.peek_second() != Token::Sign("(") => self.quantified(Quantifier::Count, span),
            "sum" => self.quantified(Quantifier::Sum, span),
            "and" | "or" | "when" | "in" | "with" | "else" | "reaches" | "mod" | "first" | "nearest"
            | "least" | "state" | "until" | "wait" => {
                let is_binder = ["first", "nearest", "least"].contains(&word.as_str())
                    && matches!(self.peek_second(), Token::Word(_));
                let help = match is_binder {
                    true => format!("binders are joined with a comma: `when ready, {word} x in ...`"),
                    false => "write a name, a number or an expression".into(),
                };
                self.error("E0213", format!("`{word}` is not a value"), help);
                self.next();
                error(span)
            }
            _ => {
                self.next();
                let name = ast::Name { value: word, span };
                if !self.maybe_sign("(") {
                    return Expr { span, kind: ExprKind::Name(name.value) };
                }
                let arguments = self.list(")");
                if self.at_sign(":=")
                    && let Some(help) = foreign::function_block(&name.value)
                {
                    let message = format!("`{}` is no function of the language", name.value);
                    self.report(Diagnostic::new("E0311", name.span, message).help(help));
                    self.skip_to(&[")"]);
                    self.maybe_sign(")");
                    return error(span);
                }
                if self.expect_sign(")", "after the arguments").is_none() {
                    return error(span);
                }
                Expr { span: span.to(self.last_span()), kind: ExprKind::Call(name, arguments) }
            }
        }
    }

    /// Expressions between commas, up to the sign that closes them.
    fn list(&mut self, close: &'static str) -> Vec<Expr> {
        let mut elements = Vec::new();
        while !self.at_sign(close) && *self.peek() != Token::End {
            elements.push(self.parse_expr());
            if !self.maybe_sign(",") {
                break;
            }
        }
        elements
    }

    fn quantified(&mut self, quantifier: Quantifier, span: Span) -> Expr {
        self.next();
        self.nested(|parser| parser.quantified_rest(quantifier, span))
    }

    fn quantified_rest(&mut self, quantifier: Quantifier, span: Span) -> Expr {
        let Some(variable) = self.expect_name("the variable") else { return error(span) };
        if self.expect_word("in", "after the variable").is_none() {
            return error(span);
        }
        let domain = self.parse_domain();
        let body = if self.maybe_sign(",") {
            self.nested(|parser| parser.quantified_rest(quantifier, span))
        } else {
            if self.expect_sign(":", "before what is said of the variable").is_none() {
                return error(span);
            }
            self.parse_expr()
        };
        Expr {
            span: span.to(body.span),
            kind: ExprKind::Quantified {
                quantifier,
                variable,
                domain: Box::new(domain),
                body: Box::new(body),
            },
        }
    }

    /// A number, or a duration if a unit of time follows.
    fn with_unit(&mut self, span: Span, value: f64, plain: ExprKind) -> Expr {
        let factor = match self.word() {
            Some("ms") => 1.0,
            Some("s") => 1000.0,
            Some("min") => 60_000.0,
            Some(word) => match foreign::unit(word) {
                Some((factor, unit)) => {
                    let message = format!("`{word}` is no unit of time");
                    // To the millisecond, whatever is rounded on the way.
                    let number = (value * factor * 60_000.0).round() / 60_000.0;
                    let help = format!("units are `ms`, `s` and `min`: write `{number} {unit}`");
                    self.error("E0214", message, help);
                    self.next();
                    return Expr { span: span.to(self.last_span()), kind: ExprKind::Duration(0) };
                }
                None => return Expr { span, kind: plain },
            },
            None => return Expr { span, kind: plain },
        };
        let span = span.to(self.span());
        self.next();
        let milliseconds = value * factor;
        if milliseconds.fract() != 0.0 || milliseconds > f64::from(i32::MAX) {
            self.report(
                crate::diagnostic::Diagnostic::new(
                    "E0214",
                    span,
                    "this duration is not a whole number of milliseconds that a timer can hold",
                )
                .help("durations go from 0 ms to 2147483647 ms, in steps of 1 ms"),
            );
            return Expr { span, kind: ExprKind::Duration(0) };
        }
        Expr { span, kind: ExprKind::Duration(milliseconds as i64) }
    }
}

/// Stands for what could not be read.
fn error(span: Span) -> Expr {
    Expr { span, kind: ExprKind::Error }
}

fn binary(operator: Operator, left: Expr, right: Expr) -> Expr {
    Expr { span: left.span.to(right.span), kind: ExprKind::Binary(operator, Box::new(left), Box::new(right)) }
}
