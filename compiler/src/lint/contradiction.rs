//! Guards whose conditions exclude each other, as far as their texts show it.

use super::implies::constant;
use crate::diagnostic::Diagnostic;
use crate::ir::{Automaton, Clause, Expr, ExprKind, KIND, Model, Operator, Scalar, Transition, Value};

pub fn check(model: &Model, automaton: &Automaton, found: &mut Vec<Diagnostic>) {
    for transition in automaton.states.iter().flat_map(|state| &state.transitions) {
        if never_holds(model, automaton, transition) {
            let message = format!("`{}` never fires: its conditions exclude each other", transition.title());
            found.push(
                Diagnostic::new("W0112", transition.place, message)
                    .note("whatever the inputs and variables are, one of the conditions does not hold")
                    .help("correct the guard, or remove the transition"),
            );
        }
    }
}

/// Never says so of a guard that may hold. One that is `false` as it stands is meant.
pub fn never_holds(model: &Model, automaton: &Automaton, transition: &Transition) -> bool {
    let mut literals = Literals { model, automaton, all: Vec::new(), left: MOST };
    for clause in &transition.clauses {
        match clause {
            Clause::Condition(condition) => literals.learn(condition, true),
            Clause::Bind(binder) => binder.condition.iter().for_each(|c| literals.learn(c, true)),
        }
    }
    literals.exclude_each_other()
}

/// Definitions of definitions can be long; a warning is not worth waiting for.
const MOST: u32 = 1000;

/// What holds, or does not, whenever a guard does: all parts of `and`, through definitions.
struct Literals<'a> {
    model: &'a Model,
    automaton: &'a Automaton,
    all: Vec<(&'a Expr, bool)>,
    left: u32,
}

impl<'a> Literals<'a> {
    fn learn(&mut self, expr: &'a Expr, holds: bool) {
        let Some(left) = self.left.checked_sub(1) else { return };
        self.left = left;
        match (&expr.kind, holds) {
            (ExprKind::Not(inner), _) => self.learn(inner, !holds),
            (ExprKind::Binary(Operator::And, a, b), true) | (ExprKind::Binary(Operator::Or, a, b), false) => {
                self.learn(a, holds);
                self.learn(b, holds);
            }
            (ExprKind::Define(define), _) => {
                self.all.push((expr, holds));
                self.learn(&self.automaton.defines[*define].value, holds);
            }
            _ => self.all.push((expr, holds)),
        }
    }

    fn exclude_each_other(&self) -> bool {
        let all = || self.all.iter().enumerate();
        let has = |kind: &ExprKind| self.all.iter().any(|(expr, holds)| *holds && expr.kind == *kind);
        let is_denied = |(number, (expr, holds)): (usize, &(&Expr, bool))| {
            self.all[..number].iter().any(|(other, of_other)| is_same(other, expr) && of_other != holds)
        };
        all().any(is_denied)
            || has(&ExprKind::Done) && has(&ExprKind::Failed)
            || self.lasts_longer_and_not()
            || all().any(|(number, _)| self.has_no_value(number))
    }

    /// `after 5 s and not after 2 s`
    fn lasts_longer_and_not(&self) -> bool {
        let times = |wanted: bool| {
            self.all.iter().filter_map(move |(expr, holds)| match &expr.kind {
                ExprKind::After(time) if *holds == wanted => constant(time),
                _ => None,
            })
        };
        times(true).max().zip(times(false).min()).is_some_and(|(longest, shortest)| longest >= shortest)
    }

    /// Whether a type has a value. Another scenario may have more kinds.
    fn exists(&self, ty: Scalar, value: Value) -> bool {
        match (ty, value) {
            (Scalar::Int { lo, hi }, Value::Int(int)) => (lo..=hi).contains(&int),
            (Scalar::Enum(id), Value::Int(member)) if id != KIND => {
                usize::try_from(member).is_ok_and(|member| member < self.model.enums[id.0].members.len())
            }
            _ => true,
        }
    }

    /// Whether the comparisons of something with constants leave it no value; it is looked at in the first of them.
    fn has_no_value(&self, first: usize) -> bool {
        let of = |number: usize| {
            let (expr, holds) = self.all[number];
            Comparison::of(expr, holds)
        };
        let Some(what) = of(first).map(|comparison| comparison.what) else { return false };
        let numbers = 0..self.all.len();
        let all: Vec<Comparison> =
            numbers.filter_map(of).filter(|comparison| is_same(comparison.what, what)).collect();
        all.len() > 1
            && !candidates(what.ty, &all)
                .into_iter()
                .filter(|value| self.exists(what.ty, *value))
                .any(|value| all.iter().all(|c| c.admits(value)))
    }
}

/// Whether both have the same value, as far as their texts show it. What is known of a number at one place narrows its type.
fn is_same(a: &Expr, b: &Expr) -> bool {
    match (&a.kind, &b.kind) {
        (ExprKind::Binary(of_a, a, b), ExprKind::Binary(of_b, c, d)) => {
            of_a == of_b && is_same(a, c) && is_same(b, d)
        }
        (a, b) => a == b,
    }
}

/// Something that is compared with a constant.
struct Comparison<'a> {
    what: &'a Expr,
    operator: Operator,
    constant: Value,
    holds: bool,
}

impl<'a> Comparison<'a> {
    fn of(expr: &'a Expr, holds: bool) -> Option<Self> {
        let ExprKind::Binary(operator, a, b) = &expr.kind else {
            // A condition by itself, beside one that is compared with `true` or `false`.
            return (expr.ty == Scalar::Bool).then_some(Self {
                what: expr,
                operator: Operator::Equal,
                constant: Value::Bool(true),
                holds,
            });
        };
        let mirrored = match operator {
            Operator::Equal | Operator::NotEqual => *operator,
            Operator::Less => Operator::Greater,
            Operator::Greater => Operator::Less,
            Operator::LessEqual => Operator::GreaterEqual,
            Operator::GreaterEqual => Operator::LessEqual,
            _ => return None,
        };
        match (&a.kind, &b.kind) {
            (ExprKind::Constant(_), ExprKind::Constant(_)) => None,
            (_, ExprKind::Constant(constant)) => {
                Some(Self { what: a, operator: *operator, constant: *constant, holds })
            }
            (ExprKind::Constant(constant), _) => {
                Some(Self { what: b, operator: mirrored, constant: *constant, holds })
            }
            _ => None,
        }
    }

    fn admits(&self, value: Value) -> bool {
        self.operator.apply(value, self.constant) == Some(Value::Bool(self.holds))
    }
}

/// Values of which one satisfies the comparisons if any value does: the constants, what is between them and beside them,
/// and what is no number.
fn candidates(ty: Scalar, comparisons: &[Comparison]) -> Vec<Value> {
    let constants = comparisons.iter().map(|comparison| comparison.constant);
    match ty {
        Scalar::Bool => vec![Value::Bool(false), Value::Bool(true)],
        Scalar::Real => {
            let mut reals: Vec<f64> = constants
                .filter_map(|constant| match constant {
                    Value::Real(real) => Some(real),
                    _ => None,
                })
                .collect();
            reals.sort_by(f64::total_cmp);
            let between: Vec<f64> = reals.windows(2).map(|pair| f64::midpoint(pair[0], pair[1])).collect();
            reals.extend(between);
            reals.extend([f64::NEG_INFINITY, f64::INFINITY, f64::NAN]);
            reals.into_iter().map(Value::Real).collect()
        }
        Scalar::Point => {
            let other = Value::Point([f64::NAN; 3]);
            constants.chain([other]).collect()
        }
        Scalar::Int { .. } | Scalar::Time | Scalar::Enum(_) | Scalar::Ref(_) => {
            let ints = constants.filter_map(|constant| match constant {
                Value::Int(int) => Some(int),
                _ => None,
            });
            ints.flat_map(|int| [int.saturating_sub(1), int, int.saturating_add(1)]).map(Value::Int).collect()
        }
    }
}
