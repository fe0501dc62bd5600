//! From the text of a file of tests to its tree. Words, numbers and comments are those of specifications.

mod row;

use super::{Body, Comparison, Expect, Figure, File, Setup, Test, What};
use crate::diagnostic::{Diagnostic, collect, sort};
use crate::source::{FileId, Span, Spanned};
use crate::spec::lexer::{self, Token};

/// Words and signs of one file.
const MOST_TOKENS: usize = 200_000;
/// The longest time of a row, ms: a day.
const LONGEST_MS: f64 = 86_400_000.0;

/// The tests of a file, or all that is wrong with it.
pub fn read(file: FileId, text: &str) -> Result<File, Vec<Diagnostic>> {
    let (tokens, diagnostics) = lexer::tokens(file, text, MOST_TOKENS + 1);
    if let Some((_, place)) = tokens.get(MOST_TOKENS + 1) {
        let message = format!("a file of tests has more than {MOST_TOKENS} tokens");
        return Err(vec![Diagnostic::new("E0901", *place, message).help("divide it into several files")]);
    }
    let mut reader = Reader { tokens, at: 0, diagnostics };
    let file = reader.file();
    if reader.diagnostics.is_empty() {
        return Ok(file);
    }
    sort(&mut reader.diagnostics);
    Err(reader.diagnostics)
}

struct Reader {
    tokens: Vec<(Token, Span)>,
    at: usize,
    diagnostics: Vec<Diagnostic>,
}

impl Reader {
    fn peek(&self) -> &Token {
        &self.tokens[self.at].0
    }

    fn span(&self) -> Span {
        self.tokens[self.at].1
    }

    fn next(&mut self) {
        if self.at + 1 < self.tokens.len() {
            self.at += 1;
        }
    }

    fn word(&self) -> Option<&str> {
        match self.peek() {
            Token::Word(word) => Some(word),
            _ => None,
        }
    }

    fn maybe_word(&mut self, word: &str) -> bool {
        let found = self.word() == Some(word);
        if found {
            self.next();
        }
        found
    }

    fn maybe_sign(&mut self, sign: &'static str) -> bool {
        let found = *self.peek() == Token::Sign(sign);
        if found {
            self.next();
        }
        found
    }

    fn report(&mut self, diagnostic: Diagnostic) {
        collect(&mut self.diagnostics, diagnostic);
    }

    /// `None` has been reported.
    fn wrong<T>(&mut self, wanted: &str, help: &str) -> Option<T> {
        let message = format!("{wanted} is missing here");
        self.report(Diagnostic::new("E0901", self.span(), message).help(help));
        None
    }

    fn sign(&mut self, sign: &'static str) -> Option<()> {
        match self.maybe_sign(sign) {
            true => Some(()),
            false => self.wrong(&format!("`{sign}`"), &format!("write `{sign}` before this")),
        }
    }

    fn text(&mut self, what: &str) -> Option<Spanned<String>> {
        let span = self.span();
        match self.peek().clone() {
            Token::Text(value) => {
                self.next();
                Some(Spanned { value, span })
            }
            _ => self.wrong(what, "write it in double quotes"),
        }
    }

    fn name(&mut self, what: &str) -> Option<Spanned<String>> {
        let span = self.span();
        match self.peek().clone() {
            Token::Word(value) => {
                self.next();
                Some(Spanned { value, span })
            }
            _ => self.wrong(&format!("the name of {what}"), "write a name"),
        }
    }

    /// To the end of a broken statement.
    fn recover(&mut self) {
        let mut depth = 0usize;
        loop {
            match self.peek() {
                Token::End => return,
                Token::Sign("}") if depth == 0 => return,
                Token::Sign("{") => depth += 1,
                Token::Sign("}") => depth -= 1,
                Token::Sign(";") if depth == 0 => {
                    self.next();
                    return;
                }
                _ => {}
            }
            self.next();
        }
    }

    fn file(&mut self) -> File {
        let mut file = File::default();
        loop {
            let begin = self.at;
            while matches!(self.peek(), Token::Doc(_)) {
                self.next();
            }
            if *self.peek() == Token::End {
                return file;
            }
            let done = match self.word() {
                Some("test") => self.test().map(|test| file.tests.push(test)),
                Some("layout" | "scenario" | "set") => self.setup(&mut file.set),
                _ => self.wrong("`layout`, `scenario`, `set` or `test`", "a file has these four"),
            };
            if done.is_none() {
                self.recover();
                self.maybe_sign("}");
            }
            if self.at == begin {
                self.next();
            }
        }
    }

    fn setup(&mut self, set: &mut Setup) -> Option<()> {
        let word = self.word().unwrap_or_default().to_string();
        self.next();
        match word.as_str() {
            "layout" => set.layout = Some(self.text("the file of the layout")?),
            "scenario" => set.scenario = Some(self.text("the file of the scenario")?),
            _ => set.settings.push(self.text("a parameter with its value, such as \"agv.capacity=4\",")?),
        }
        self.sign(";")
    }

    fn test(&mut self) -> Option<Test> {
        self.next();
        let title = self.text("the title of the test")?;
        let machine = match self.maybe_word("of") {
            true => Some(self.name("the machine")?),
            false => None,
        };
        self.sign("{")?;
        let mut set = Setup::default();
        let (mut rows, mut expected) = (Vec::new(), Vec::new());
        while !self.maybe_sign("}") {
            let begin = self.at;
            if *self.peek() == Token::End {
                return self.wrong("`}`", "close the test");
            }
            let done = match self.word() {
                Some("layout" | "scenario" | "set") => self.setup(&mut set),
                _ if machine.is_some() => self.row().map(|row| rows.push(row)),
                _ => self.expect().map(|expect| expected.push(expect)),
            };
            if done.is_none() {
                self.recover();
                if self.at == begin {
                    self.next();
                }
            }
        }
        let body = match machine {
            Some(name) => Body::Machine { name, rows },
            None => Body::Line(expected),
        };
        Some(Test { title, set, body })
    }

    fn duration(&mut self) -> Option<i64> {
        let span = self.span();
        let number = match *self.peek() {
            Token::Int(number) => number as f64,
            Token::Real(number) => number,
            _ => return self.wrong("a time", "write a time such as `100 ms` or `2.5 s`"),
        };
        self.next();
        let unit = match self.word() {
            Some("ms") => 1.0,
            Some("s") => 1000.0,
            Some("min") => 60_000.0,
            _ => return self.wrong("`ms`, `s` or `min`", "a time has a unit, such as `100 ms`"),
        };
        self.next();
        let ms = number * unit;
        if (ms - ms.round()).abs() > 1e-6 || ms > LONGEST_MS {
            let message = "this is not a whole number of milliseconds that a test can wait for";
            let help = "times go from 0 ms to 1440 min, in steps of 1 ms";
            self.report(Diagnostic::new("E0903", span, message).help(help));
            return None;
        }
        Some(ms.round() as i64)
    }

    fn expect(&mut self) -> Option<Expect> {
        let start = self.span();
        if !self.maybe_word("expect") {
            return self.wrong(
                "`expect`",
                "a test of a line holds `expect ...;`, one of a machine begins with `test \"...\" of NAME`",
            );
        }
        let what = match self.word() {
            Some("finished") => {
                self.next();
                What::Finished(true)
            }
            Some("not") => {
                self.next();
                match self.maybe_word("finished") {
                    true => What::Finished(false),
                    false => return self.wrong("`finished`", "write `expect not finished;`"),
                }
            }
            Some("reason") => {
                self.next();
                What::Reason(self.text("a part of the reason")?.value)
            }
            Some("fault") => {
                let (text, machine) = self.text_of_machine()?;
                What::Fault { text, machine }
            }
            Some("alarm") => {
                let (text, machine) = self.text_of_machine()?;
                What::Alarm { text, machine }
            }
            Some("never") => {
                self.next();
                let machine = self.name("the machine")?;
                self.in_state()?;
                What::Never { machine, state: self.state()? }
            }
            Some("orders") => self.figure(Figure::Orders)?,
            Some("seconds_per_order") => self.figure(Figure::SecondsPerOrder)?,
            Some("simulated") => self.figure(Figure::Simulated)?,
            Some("contacts") => self.figure(Figure::Contacts)?,
            Some("alarms") => self.figure(Figure::Alarms)?,
            Some("faults") => self.figure(Figure::Faults)?,
            _ => {
                let machine = self.name("a figure or of a machine")?;
                self.in_state()?;
                let state = self.state()?;
                let before_ms = match self.maybe_word("before") {
                    true => Some(self.duration()?),
                    false => None,
                };
                What::Reaches { machine, state, before_ms }
            }
        };
        self.sign(";")?;
        Some(Expect { span: start.to(self.tokens[self.at - 1].1), what })
    }

    /// Behind `fault` and `alarm`: `"text" of NAME`, both optional.
    fn text_of_machine(&mut self) -> Option<(Option<String>, Option<Spanned<String>>)> {
        self.next();
        let text = match self.peek() {
            Token::Text(_) => Some(self.text("")?.value),
            _ => None,
        };
        let machine = match self.maybe_word("of") {
            true => Some(self.name("the machine")?),
            false => None,
        };
        Some((text, machine))
    }

    fn in_state(&mut self) -> Option<()> {
        match self.maybe_word("in") {
            true => Some(()),
            false => self.wrong("`in`", "write `expect MACHINE in STATE;`; figures are orders, seconds_per_order, simulated, contacts, alarms and faults"),
        }
    }

    fn figure(&mut self, figure: Figure) -> Option<What> {
        self.next();
        let comparison = match self.peek() {
            Token::Sign("=") => Comparison::Equal,
            Token::Sign("<>") => Comparison::NotEqual,
            Token::Sign("<") => Comparison::Less,
            Token::Sign("<=") => Comparison::LessEqual,
            Token::Sign(">") => Comparison::Greater,
            Token::Sign(">=") => Comparison::GreaterEqual,
            _ => return self.wrong("a comparison", "write `=`, `<>`, `<`, `<=`, `>` or `>=`"),
        };
        self.next();
        let has_unit = matches!(&self.tokens[(self.at + 1).min(self.tokens.len() - 1)].0,
            Token::Word(unit) if ["ms", "s", "min"].contains(&unit.as_str()));
        let number = if has_unit { self.duration()? as f64 / 1000.0 } else { self.number()? };
        Some(What::Figure(figure, comparison, number))
    }
}
