//! Rows of a table, names and values.

use super::Reader;
use crate::diagnostic::Diagnostic;
use crate::source::Spanned;
use crate::spec::lexer::Token;
use crate::testing::{Expected, Given, Literal, LiteralKind, Path, Row, Time};

/// A day of scans of 10 ms.
const MOST_SCANS: i64 = 8_640_000;

impl Reader {
    pub(super) fn row(&mut self) -> Option<Row> {
        let start = self.span();
        let time = match self.word() {
            Some("after") => {
                self.next();
                Time::After(self.duration()?)
            }
            Some("within") => {
                self.next();
                Time::Within(self.duration()?)
            }
            Some("scan") => {
                self.next();
                let span = self.span();
                let Token::Int(number) = *self.peek() else {
                    return self.wrong("the number of a scan", "write `scan 3`; the first one is 0");
                };
                self.next();
                if number > MOST_SCANS {
                    let help = format!("scans go from 0 to {MOST_SCANS}");
                    self.report(
                        Diagnostic::new("E0903", span, "this is longer than a test can last").help(help),
                    );
                    return None;
                }
                Time::Scan(number)
            }
            _ => Time::At(self.duration()?),
        };
        self.sign(":")?;
        let (mut given, mut expected) = (Vec::new(), Vec::new());
        if !matches!(self.peek(), Token::Sign("->" | ";")) {
            given.push(self.given()?);
            while self.maybe_sign(",") {
                given.push(self.given()?);
            }
        }
        if self.maybe_sign("->") {
            expected.push(self.expected()?);
            while self.maybe_sign(",") {
                expected.push(self.expected()?);
            }
        }
        self.sign(";")?;
        let span = start.to(self.tokens[self.at - 1].1);
        Some(Row { span, time, given, expected })
    }

    fn given(&mut self) -> Option<Given> {
        let span = self.span();
        let ends = |token: &Token| matches!(token, Token::Sign("," | ";" | "->"));
        let follows = &self.tokens[(self.at + 1).min(self.tokens.len() - 1)].0;
        match self.word() {
            Some("done") if ends(follows) => {
                self.next();
                return Some(Given::Answer(span, 0));
            }
            Some("power") if *follows == Token::Word("off".into()) => {
                self.next();
                self.next();
                return Some(Given::PowerOff);
            }
            Some("failed") => {
                self.next();
                let error = match *self.peek() {
                    Token::Int(error) => {
                        self.next();
                        error as i32
                    }
                    _ => runtime_sim::device::error::REFUSED,
                };
                return Some(Given::Answer(span, error));
            }
            _ => {}
        }
        let path = self.path()?;
        self.sign("=")?;
        Some(Given::Value(path, self.literal()?))
    }

    fn expected(&mut self) -> Option<Expected> {
        let span = self.span();
        let follows = &self.tokens[(self.at + 1).min(self.tokens.len() - 1)].0;
        if *follows == Token::Sign("=") {
            let path = self.path()?;
            self.sign("=")?;
            return Some(Expected::Value(path, self.literal()?));
        }
        if self.maybe_word("fault") {
            let text = match self.peek() {
                Token::Text(_) => self.text("")?.value.into(),
                _ => None,
            };
            return Some(Expected::Fault(span, text));
        }
        if self.maybe_word("alarm") {
            let text = match self.peek() {
                Token::Text(_) => Some(self.text("")?.value),
                _ => None,
            };
            return Some(Expected::Alarm(text));
        }
        if self.maybe_word("no") {
            return match self.maybe_word("alarm") {
                true => Some(Expected::NoAlarm),
                false => self.wrong("`alarm`", "write `no alarm`"),
            };
        }
        let path = self.path()?;
        if self.maybe_sign("=") {
            return Some(Expected::Value(path, self.literal()?));
        }
        match (path.machine, path.index) {
            (None, None) => Some(Expected::State(Spanned { value: path.name, span: path.span })),
            _ => self.wrong("`=`", "write a state, or `name = value`"),
        }
    }

    /// A state of a sequence is `Picking.2`.
    pub(super) fn state(&mut self) -> Option<Spanned<String>> {
        let path = self.path()?;
        Some(Spanned { value: path.name, span: path.span })
    }

    pub(super) fn path(&mut self) -> Option<Path> {
        let first = self.name("a state, a port, a cell or a variable")?;
        let mut path = Path { span: first.span, machine: None, name: first.value, index: None };
        // What looks like a number behind a state is its step: `Picking.2`.
        if self.maybe_sign(".") {
            match self.peek().clone() {
                Token::Int(step) => {
                    path.name = format!("{}.{step}", path.name);
                    path.span = path.span.to(self.span());
                    self.next();
                }
                _ => {
                    let name = self.name("what is meant of the machine")?;
                    path.machine = Some(std::mem::replace(&mut path.name, name.value));
                    path.span = path.span.to(name.span);
                }
            }
        }
        if self.maybe_sign("[") {
            path.index = Some(self.literal()?);
            path.span = path.span.to(self.span());
            self.sign("]")?;
        }
        Some(path)
    }

    pub(super) fn number(&mut self) -> Option<f64> {
        let sign = if self.maybe_sign("-") { -1.0 } else { 1.0 };
        let number = match *self.peek() {
            Token::Int(number) => number as f64,
            Token::Real(number) => number,
            _ => return self.wrong("a number", "write a number"),
        };
        self.next();
        Some(sign * number)
    }

    fn literal(&mut self) -> Option<Literal> {
        let span = self.span();
        let kind = match self.peek().clone() {
            Token::Word(word) if word == "point" => {
                self.next();
                self.sign("(")?;
                let x = self.number()?;
                self.sign(",")?;
                let y = self.number()?;
                self.sign(",")?;
                let z = self.number()?;
                self.sign(")")?;
                LiteralKind::Point([x, y, z])
            }
            Token::Word(word) => {
                self.next();
                LiteralKind::Word(word)
            }
            _ => {
                let has_unit = matches!(&self.tokens[(self.at + 1).min(self.tokens.len() - 1)].0,
                    Token::Word(unit) if ["ms", "s", "min"].contains(&unit.as_str()));
                match has_unit {
                    true => LiteralKind::Duration(self.duration()?),
                    false => LiteralKind::Number(self.number()?),
                }
            }
        };
        Some(Literal { span, kind })
    }
}
