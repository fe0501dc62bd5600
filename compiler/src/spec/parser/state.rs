//! States, transitions, updates, sequences.

use super::Parser;
use crate::source::{Span, Spanned};
use crate::spec::ast;
use crate::spec::lexer::Token;

/// Clauses of one guard; they are nested loops.
const MOST_CLAUSES: usize = 32;

/// What to write instead of an `else` of a transition.
const OTHERWISE: &str =
    "only a sequence has an `else`: write another transition for the other case, `when not ... -> State {}`";

impl Parser {
    pub(super) fn parse_any(&mut self) -> Option<ast::AnyState> {
        self.next();
        if self.expect_word("state", "after `any`").is_none() {
            self.recover();
            return None;
        }
        let mut except = Vec::new();
        if self.maybe_word("except") {
            loop {
                except.extend(self.expect_name("the excepted state"));
                if !self.maybe_sign(",") {
                    break;
                }
            }
        }
        Some(ast::AnyState { except, transitions: self.transitions() })
    }

    pub(super) fn parse_state(&mut self, doc: Vec<String>) -> Option<ast::State> {
        let is_resumable = self.maybe_word("resume");
        let is_final = self.maybe_word("final");
        let name = match self.expect_word("state", "before the name of the state") {
            Some(()) => self.expect_name("the state"),
            None => None,
        };
        let Some(name) = name else {
            self.recover();
            return None;
        };
        let within = if self.maybe_word("within") { Some(self.parse_sum()) } else { None };
        let body = if self.maybe_sign("=") {
            if self.expect_word("sequence", "after `=`").is_none() {
                self.recover();
                return None;
            }
            // With its name the state is known, even if its steps are not.
            self.sequence().map_or_else(|| ast::Body::Transitions(Vec::new()), ast::Body::Sequence)
        } else if is_final && self.maybe_sign(";") {
            ast::Body::Transitions(Vec::new())
        } else {
            ast::Body::Transitions(self.transitions())
        };
        Some(ast::State { doc, name, is_final, is_resumable, within, body })
    }

    fn transitions(&mut self) -> Vec<ast::Transition> {
        let mut transitions = Vec::new();
        if self.word().is_some() && !self.at_state() {
            let found = self.found();
            let help = if self.at_word("else") {
                "`within` has no text; that of a property is shown: `whenever P then Q within 10 s else \"text\";`"
            } else {
                "write the transitions in braces: `state Name within 10 s { when done -> Next {} }`"
            };
            self.error("E0205", format!("{found} cannot stand before the transitions of a state"), help);
            self.skip_to(&[]);
        }
        if self.expect_sign("{", "before the transitions").is_none() {
            self.recover();
            return transitions;
        }
        loop {
            self.doc();
            if self.maybe_sign("}") || *self.peek() == Token::End {
                return transitions;
            }
            if self.at_state() {
                self.error(
                    "E0205",
                    "`}` is missing at the end of the state".into(),
                    "close the state before the next one",
                );
                return transitions;
            }
            if self.at_word("else") {
                self.error("E0204", "a transition has no `else`".into(), OTHERWISE);
                self.otherwise();
                continue;
            }
            if self.at_sign(";") {
                let help = "remove it: nothing ends with `;` after its `}`";
                self.error("E0204", "`;` is not allowed in a state".into(), help);
                self.next();
                continue;
            }
            if !self.at_word("when") {
                let found = self.found();
                self.error(
                    "E0204",
                    format!("{found} is not allowed in a state"),
                    "a state has transitions, such as `when done -> Next { }`",
                );
                if !self.at_sign("{") {
                    self.next();
                }
                self.recover();
                continue;
            }
            match self.transition() {
                Some(transition) => transitions.push(transition),
                None => self.recover(),
            }
        }
    }

    /// Whether a state or an item begins here, so that a block before it was not closed.
    fn at_state(&self) -> bool {
        match self.word() {
            Some("state") => true,
            Some("any" | "final" | "initial" | "resume") => {
                matches!(self.peek_second(), Token::Word(w) if matches!(w.as_str(), "state" | "resume"))
            }
            _ => self.at_item(),
        }
    }

    fn transition(&mut self) -> Option<ast::Transition> {
        let start = self.span();
        self.next();
        let guard_start = self.span();
        let errors = self.errors;
        let mut clauses: Vec<_> = self.clause().into_iter().collect();
        while self.errors == errors && self.maybe_sign(",") {
            if clauses.len() == MOST_CLAUSES {
                let message = format!("a guard has at most {MOST_CLAUSES} clauses");
                self.error("E0211", message, "join conditions with `and`, or split the transition");
                break;
            }
            clauses.extend(self.clause());
        }
        let guard = ast::Guard::Written(guard_start.to(self.last_span()));
        if self.errors == errors {
            self.foreign_behind_guard();
        }
        if self.errors > errors {
            self.skip_to(&["->"]);
        }
        let goes_to = self.at_word("goto") && matches!(self.peek_second(), Token::Word(_));
        if goes_to && self.errors == errors {
            self.error(
                "E0205",
                "`->` is missing before the next state".into(),
                "write `-> State {}` instead of `goto State`",
            );
            self.next();
        }
        let names_a_state =
            matches!(self.peek(), Token::Word(_)) && matches!(self.peek_second(), Token::Sign("{" | ";"));
        if names_a_state && !goes_to && self.errors == errors {
            let found = self.found();
            let help = format!("write `->` before {found}");
            self.error("E0205", "`->` is missing before the next state".into(), help);
        }
        let target = if goes_to || names_a_state || self.maybe_sign("->") {
            Some(self.expect_name("the next state")?)
        } else {
            None
        };
        if let Some(target) = &target
            && !self.at_sign("{")
            && !self.at_sign(";")
        {
            if self.at_word("else") {
                let help = format!("write `{{}}` or `;` after `{}`; {OTHERWISE}", target.value);
                self.error("E0205", "`{` is missing before the updates".into(), help);
                self.otherwise();
            } else {
                self.without_updates(target);
            }
            let span = start.to(self.last_span());
            return Some(ast::Transition {
                span,
                clauses,
                guard,
                target: Some(target.clone()),
                updates: Vec::new(),
            });
        }
        let updates =
            if target.is_some() && self.maybe_sign(";") { Vec::new() } else { self.parse_updates() };
        Some(ast::Transition { span: start.to(self.last_span()), clauses, guard, target, updates })
    }

    /// Reports what is written behind a guard in other languages.
    fn foreign_behind_guard(&mut self) {
        let found = self.found();
        if self.at_sign(":=") {
            let help =
                "two values are compared with `=`; a `bool` stands alone: `when sensor`, `when not sensor`";
            self.error("E0205", "`:=` does not compare, it assigns".into(), help);
        } else if self
            .word()
            .is_some_and(|word| ["then", "do"].iter().any(|of| word.eq_ignore_ascii_case(of)))
        {
            let help = "leave it out: `when GUARD -> State {}`";
            self.error("E0204", format!("{found} is not written behind a guard"), help);
        }
    }

    fn without_updates(&mut self, target: &ast::Name) {
        let help = format!("write `{{}}` or `;` after `{}`", target.value);
        self.error("E0205", "`{` is missing before the updates".into(), help);
    }

    /// Skips an `else` that is not allowed, with its state and its updates.
    fn otherwise(&mut self) {
        self.next();
        if self.word().is_some() && !self.at_state() {
            self.next();
        }
        if self.at_sign("{") {
            self.parse_updates();
        } else {
            self.maybe_sign(";");
        }
    }

    fn clause(&mut self) -> Option<ast::Clause> {
        let span = self.span();
        let how = match self.word() {
            Some(w @ ("first" | "nearest" | "least")) => w.to_string(),
            _ => return Some(ast::Clause::Condition(self.parse_expr())),
        };
        self.next();
        let variable = self.expect_name("the variable")?;
        self.expect_word("in", "after the variable")?;
        let domain = self.parse_domain();
        let choice = match how.as_str() {
            "first" => ast::Choice::First,
            "least" => {
                self.expect_word("by", "before what is to be least")?;
                ast::Choice::Least(self.parse_sum())
            }
            _ => {
                self.expect_word("by", "before the point of the candidate")?;
                let from = self.parse_sum();
                self.expect_word("to", "before the point to be near to")?;
                ast::Choice::Nearest(from, self.parse_sum())
            }
        };
        let condition = if self.maybe_word("with") { Some(self.parse_expr()) } else { None };
        let span = span.to(self.last_span());
        Some(ast::Clause::Bind(Box::new(ast::Binder { span, choice, variable, domain, condition })))
    }

    pub(super) fn parse_updates(&mut self) -> Vec<ast::Update> {
        let mut updates = Vec::new();
        if self.expect_sign("{", "before the updates").is_none() {
            self.recover();
            return updates;
        }
        while !self.maybe_sign("}") {
            if *self.peek() == Token::End || self.at_word("when") || self.at_state() {
                self.error("E0205", "`}` is missing after the updates".into(), "close the updates");
                return updates;
            }
            match self.update() {
                Some(update) => updates.push(update),
                None => self.recover(),
            }
        }
        updates
    }

    fn update(&mut self) -> Option<ast::Update> {
        let start = self.span();
        let errors = self.errors;
        let target = self.nested(Self::parse_postfix);
        let how = match self.peek() {
            Token::Sign(":=") => ast::Assign::Set,
            Token::Sign("+=") => ast::Assign::Add,
            Token::Sign("-=") => ast::Assign::Subtract,
            _ => return self.command(start, target),
        };
        self.next();
        let value = self.parse_expr();
        if self.errors > errors {
            return None;
        }
        let span = start.to(self.last_span());
        self.expect_sign(";", "after the update")?;
        Some(ast::Update { span, kind: ast::UpdateKind::Assign { target, how, value } })
    }

    fn command(&mut self, start: Span, target: ast::Expr) -> Option<ast::Update> {
        let ast::ExprKind::Call(verb, arguments) = target.kind else {
            if !matches!(target.kind, ast::ExprKind::Error) {
                let found = self.found();
                let help = if self.at_sign("=") {
                    "an assignment is written with `:=`"
                } else if matches!(&target.kind, ast::ExprKind::Name(n) if n == "goto") {
                    "write the next state after the guard: `when done -> State {}`; a command has parentheses: `goto(place);`"
                } else if matches!(&target.kind, ast::ExprKind::Name(n) if n.eq_ignore_ascii_case("if")) {
                    "there is no `if`: write two transitions with different guards"
                } else {
                    "an update is `name := value;` or a command such as `move(place);`"
                };
                self.error("E0209", format!("{found} is not allowed here"), help);
            }
            return None;
        };
        let span = start.to(self.last_span());
        self.expect_sign(";", "after the command")?;
        Some(ast::Update { span, kind: ast::UpdateKind::Command { verb, arguments } })
    }

    fn sequence(&mut self) -> Option<ast::Sequence> {
        let mut steps = Vec::new();
        if self.expect_sign("{", "before the steps of the sequence").is_none() {
            self.recover();
            return None;
        }
        while !self.maybe_sign("}") {
            if *self.peek() == Token::End || self.at_state() {
                self.error("E0205", "`}` is missing after the steps".into(), "close the sequence");
                return None;
            }
            match self.step() {
                Some(step) => steps.push(step),
                None => self.recover(),
            }
        }
        let span = self.span();
        if self.expect_sign("->", "after the steps of a sequence").is_none() {
            self.recover();
            return None;
        }
        let then = self.outcome(span);
        let otherwise = self.at_word("else").then(|| {
            let span = self.span();
            self.next();
            self.outcome(span)
        });
        match otherwise {
            None => Some(ast::Sequence { steps, then: then?, otherwise: None }),
            Some(otherwise) => Some(ast::Sequence { steps, then: then?, otherwise: Some(otherwise?) }),
        }
    }

    /// Of a sequence whose next state is not written yet.
    fn no_target(&mut self) -> Option<Spanned<String>> {
        let found = self.found();
        let help = format!("write a name before {found}");
        self.error("E0205", "the name of the next state is missing".into(), help);
        None
    }

    fn outcome(&mut self, span: Span) -> Option<ast::Outcome> {
        let named = !self.at_word("else") && !self.at_state();
        let target = if named { self.expect_name("the next state") } else { self.no_target() };
        let updates = if self.maybe_sign(";") {
            Vec::new()
        } else if self.at_word("else") || self.at_sign("}") || self.at_state() {
            target.iter().for_each(|target| self.without_updates(target));
            Vec::new()
        } else {
            self.parse_updates()
        };
        let target = target?;
        Some(ast::Outcome { span: span.to(target.span), target, updates })
    }

    fn step(&mut self) -> Option<ast::Step> {
        let start = self.span();
        let errors = self.errors;
        if self.maybe_word("until") {
            let condition = self.parse_expr();
            if self.errors > errors {
                return None;
            }
            let at_most = if self.maybe_word("at") {
                self.expect_word("most", "after `at`")?;
                Some(self.parse_sum())
            } else {
                None
            };
            let span = start.to(self.last_span());
            self.expect_sign(";", "after the step")?;
            return Some(ast::Step::Until { span, condition, at_most });
        }
        if self.maybe_word("wait") {
            let time = self.parse_sum();
            if self.errors > errors {
                return None;
            }
            let span = start.to(self.last_span());
            self.expect_sign(";", "after the step")?;
            return Some(ast::Step::Wait { span, time });
        }
        Some(ast::Step::Act(self.update()?))
    }
}
