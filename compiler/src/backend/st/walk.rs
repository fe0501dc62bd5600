//! What expressions need: defines that they read, and whether they may be computed where no guard protects them.

use crate::ir::{Automaton, Domain, Expr, ExprKind, Model, Operator, Place, Scalar, Type, Value, VariableId};
use crate::layout::read::MOST_OBJECTS;
use std::collections::{BTreeMap, BTreeSet};

/// Whether a `define` is read in guards only: then it is computed before them.
pub fn is_for_guards_only(automaton: &Automaton, define: usize) -> bool {
    let mut elsewhere = BTreeSet::new();
    for state in &automaton.states {
        state.within.iter().for_each(|(longest, _)| defines(automaton, longest, &mut elsewhere));
        for update in state.transitions.iter().flat_map(|t| &t.updates) {
            update.kind.exprs().into_iter().for_each(|e| defines(automaton, e, &mut elsewhere));
        }
    }
    !elsewhere.contains(&define)
}

/// The defines that an expression reads, and those that these read.
pub fn defines(automaton: &Automaton, expr: &Expr, found: &mut BTreeSet<usize>) {
    if let ExprKind::Define(define) = expr.kind
        && found.insert(define)
    {
        defines(automaton, &automaton.defines[define].value, found);
    }
    expr.parts().for_each(|part| defines(automaton, part, found));
}

/// Whether an expression could index beyond an array, divide by zero, leave 32 bits or repeat more often than its bound
/// says if what stands before it did not hold: then it must not be computed where that is not tested first. The types of
/// expressions are no help, since guards have narrowed them: only what is declared counts.
pub fn may_fault(model: &Model, automaton: &Automaton, expr: &Expr) -> bool {
    let ranges = Ranges { model, automaton };
    ranges.may_fault(expr, &BTreeMap::new())
}

/// Whether a whole number could be the greatest of 32 bits, after which there is none.
pub fn may_be_greatest(model: &Model, automaton: &Automaton, expr: &Expr) -> bool {
    let range = Ranges { model, automaton }.range(expr, &BTreeMap::new());
    range.is_none_or(|(_, hi)| hi >= i64::from(i32::MAX))
}

/// How many numbers a range has at most where the guards before it hold.
pub fn narrowed_count(low: &Expr, high: &Expr) -> Option<i64> {
    match (low.ty, high.ty) {
        (Scalar::Int { lo, .. }, Scalar::Int { hi, .. }) => Some(i64::from(hi) - i64::from(lo) + 1),
        _ => None,
    }
}

/// Bounds of the variables of quantifiers around an expression.
type Bound = BTreeMap<VariableId, (i64, i64)>;

struct Ranges<'a> {
    model: &'a Model,
    automaton: &'a Automaton,
}

impl Ranges<'_> {
    fn may_fault(&self, expr: &Expr, bound: &Bound) -> bool {
        let is_in_32_bits = |(lo, hi): (i64, i64)| i32::try_from(lo).is_ok() && i32::try_from(hi).is_ok();
        let here = match &expr.kind {
            ExprKind::Read(place) => self.index_may_leave(place, bound),
            ExprKind::Binary(Operator::Divide | Operator::Modulo, _, divisor) => match divisor.kind {
                ExprKind::Constant(Value::Real(r)) => r == 0.0,
                _ => self.range(divisor, bound).is_none_or(|(lo, hi)| lo <= 0 && hi >= -1),
            },
            ExprKind::Negate(_)
            | ExprKind::Absolute(_)
            | ExprKind::Binary(Operator::Add | Operator::Subtract | Operator::Multiply, ..) => {
                self.range(expr, bound).is_some_and(|range| !is_in_32_bits(range))
            }
            // It was checked by itself: what it needs to hold it tests.
            ExprKind::Define(_) => false,
            ExprKind::Exists { variable, domain, body }
            | ExprKind::Forall { variable, domain, body }
            | ExprKind::Count { variable, domain, body }
            | ExprKind::Sum { variable, domain, body } => {
                let inner = self.inner(*variable, domain, bound);
                let leaves = matches!(expr.kind, ExprKind::Sum { .. })
                    && self.range(expr, bound).is_some_and(|range| !is_in_32_bits(range));
                let is_longer = match &**domain {
                    Domain::Range(low, high) => {
                        narrowed_count(low, high).is_some_and(|count| self.most(domain, bound) > count)
                    }
                    Domain::Role(_) | Domain::Enum(_) => false,
                };
                let in_part = |part: &Expr| {
                    let is_body = std::ptr::eq(part, &raw const **body);
                    self.may_fault(part, if is_body { &inner } else { bound })
                };
                return leaves || is_longer || expr.parts().any(in_part);
            }
            _ => false,
        };
        here || expr.parts().any(|part| self.may_fault(part, bound))
    }

    fn index_may_leave(&self, place: &Place, bound: &Bound) -> bool {
        let (Place::Local { index, .. }
        | Place::Port { index, .. }
        | Place::Parameter { index, .. }
        | Place::Cell { index, .. }
        | Place::Shown { index, .. }) = place;
        let Some(index) = index else { return false };
        let n = self.model.elements(self.declared(place).extent) as i64;
        self.range(index, bound).is_some_and(|(lo, hi)| lo < 0 || hi >= n)
    }

    fn declared(&self, place: &Place) -> Type {
        match place {
            Place::Local { local, .. } => self.automaton.locals[*local].ty,
            Place::Parameter { parameter, .. } => self.automaton.parameters[*parameter].ty,
            Place::Port { port, .. } => {
                let port = &self.automaton.device.ports[*port];
                Type { scalar: port.ty.into(), extent: port.extent.into() }
            }
            Place::Cell { interface, cell, .. } => self.model.interface(*interface).cells[*cell].ty,
            Place::Shown { interface, parameter, .. } => {
                self.model.interface(*interface).parameters[*parameter].ty
            }
        }
    }

    /// Bounds of a whole number or a time as far as declarations say; none for other types.
    fn range(&self, expr: &Expr, bound: &Bound) -> Option<(i64, i64)> {
        let of = |scalar: Scalar| match scalar {
            Scalar::Int { lo, hi } => Some((i64::from(lo), i64::from(hi))),
            Scalar::Time => Some((0, i64::from(i32::MAX))),
            _ => None,
        };
        let size = |(lo, hi): (i64, i64)| lo.saturating_abs().max(hi.saturating_abs());
        of(expr.ty)?;
        match &expr.kind {
            ExprKind::Constant(Value::Int(i)) => Some((i64::from(*i), i64::from(*i))),
            ExprKind::Read(place) => of(self.declared(place).scalar),
            ExprKind::Variable(id) => {
                bound.get(id).copied().or_else(|| of(self.automaton.variables[id.0].ty.scalar))
            }
            ExprKind::Define(define) => self.range(&self.automaton.defines[*define].value, &Bound::new()),
            ExprKind::Negate(inner) => self.range(inner, bound).map(|(lo, hi)| (-hi, -lo)),
            ExprKind::Min(a, b) | ExprKind::Max(a, b) => {
                let (a, b) = (self.range(a, bound)?, self.range(b, bound)?);
                Some((a.0.min(b.0), a.1.max(b.1)))
            }
            ExprKind::Binary(operator, a, b) => {
                let (a, b) = (self.range(a, bound)?, self.range(b, bound)?);
                match operator {
                    Operator::Add => Some((a.0.saturating_add(b.0), a.1.saturating_add(b.1))),
                    Operator::Subtract => Some((a.0.saturating_sub(b.1), a.1.saturating_sub(b.0))),
                    Operator::Multiply => {
                        let ends = [(a.0, b.0), (a.0, b.1), (a.1, b.0), (a.1, b.1)]
                            .map(|(x, y)| x.saturating_mul(y));
                        Some((ends.into_iter().min()?, ends.into_iter().max()?))
                    }
                    // Not greater than the left side, and with its sign; a remainder is less than what it is divided by.
                    Operator::Modulo => {
                        let most = size(a).min(size(b).saturating_sub(1).max(0));
                        Some((if a.0 < 0 { -most } else { 0 }, if a.1 > 0 { most } else { 0 }))
                    }
                    _ => Some((-size(a), size(a))),
                }
            }
            ExprKind::Absolute(inner) => {
                let (lo, hi) = self.range(inner, bound)?;
                Some((0, lo.saturating_abs().max(hi.saturating_abs())))
            }
            ExprKind::Count { domain, .. } => Some((0, self.most(domain, bound))),
            ExprKind::Sum { variable, domain, body } => {
                let (lo, hi) = self.range(body, &self.inner(*variable, domain, bound))?;
                let most = self.most(domain, bound);
                Some((lo.min(0).saturating_mul(most), hi.max(0).saturating_mul(most)))
            }
            _ => of(expr.ty),
        }
    }

    /// The bounds around the body of a quantifier.
    fn inner(&self, variable: VariableId, domain: &Domain, bound: &Bound) -> Bound {
        let mut inner = bound.clone();
        if let Domain::Range(low, high) = domain
            && let (Some(from), Some(to)) = (self.range(low, bound), self.range(high, bound))
        {
            inner.insert(variable, (from.0, to.1));
        }
        inner
    }

    /// How many members a domain has at most.
    fn most(&self, domain: &Domain, bound: &Bound) -> i64 {
        match domain {
            Domain::Role(_) => MOST_OBJECTS as i64,
            Domain::Enum(id) => self.model.enums[id.0].members.len() as i64,
            Domain::Range(low, high) => match (self.range(low, bound), self.range(high, bound)) {
                (Some(from), Some(to)) => to.1.saturating_sub(from.0).saturating_add(1).max(0),
                _ => i64::from(i32::MAX),
            },
        }
    }
}
