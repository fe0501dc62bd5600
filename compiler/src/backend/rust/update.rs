//! Updates of a transition, as statements.

use super::context::Context;
use crate::ir::{Expr, ExprKind, Extent, FaultId, Operator, Place, Scalar, Type, Update, UpdateKind};

impl Context<'_> {
    pub fn update(&self, update: &Update) -> String {
        let text = self.statements(update);
        if text.starts_with("let ") { format!("{{ {text} }}\n") } else { text }
    }

    /// Those that begin with `let` want a block of their own.
    fn statements(&self, update: &Update) -> String {
        match &update.kind {
            UpdateKind::Assign { target, value, check } => {
                let (hoisted, place) = self.target(&target.place);
                format!("{hoisted}{}", self.assignment(&place, target.ty.scalar, value, *check))
            }
            UpdateKind::Fill { target, value, check } => {
                let (hoisted, place) = self.target(&target.place);
                let value = self.expr(value);
                match check.and_then(|fault| self.store(target.ty.scalar, "value", "place", fault)) {
                    None => format!("{hoisted}{place} = {};", array_of(target.ty, &value)),
                    Some(store) => {
                        format!("let value = {value}; {hoisted} for place in &mut {place}.0 {{ {store} }}")
                    }
                }
            }
            UpdateKind::Copy { target, source, check } => {
                let (hoisted, place) = self.target(&target.place);
                let source = self.place(source);
                match check.and_then(|fault| self.store(target.ty.scalar, "value", "place", fault)) {
                    None => format!("{hoisted}{place} = {source};"),
                    Some(store) => format!(
                        "let source = {source}; {hoisted} for (place, value) in {place}.0.iter_mut().zip(source.0) {{ {store} }}"
                    ),
                }
            }
            UpdateKind::Command { verb, arguments } => {
                let device = &self.automaton().device;
                let mut text = String::new();
                for argument in arguments {
                    let place = self.place(&Place::Port { port: argument.port, index: None });
                    let ty = Scalar::from(device.ports[argument.port].ty);
                    text += &self.assignment(&place, ty, &argument.value, argument.check);
                }
                let verb = device.verbs.iter().position(|v| v.number == *verb).unwrap_or_default();
                text + &format!("self.command(Verb::{});", self.own().verbs[verb])
            }
        }
    }

    fn assignment(&self, place: &str, ty: Scalar, value: &Expr, check: Option<FaultId>) -> String {
        let text = self.expr(value);
        if let Some(store) = check.and_then(|fault| self.store(ty, &text, &format!("&mut {place}"), fault)) {
            return store;
        }
        self.compound(place, value).unwrap_or_else(|| format!("{place} = {text};"))
    }

    /// `place += value` for `place = place + value`.
    fn compound(&self, place: &str, value: &Expr) -> Option<String> {
        let ExprKind::Binary(operator, a, b) = &value.kind else { return None };
        let is_place = |expr: &Expr| matches!(&expr.kind, ExprKind::Read(p) if self.place(p) == place);
        let is_whole = matches!(value.ty, Scalar::Int { .. } | Scalar::Time);
        let sign = match operator {
            Operator::Add => "+=",
            Operator::Subtract => "-=",
            Operator::Multiply => "*=",
            Operator::Divide if !is_whole => "/=",
            _ => return None,
        };
        if value.ty == Scalar::Point {
            return None;
        }
        let commutes = matches!(operator, Operator::Add | Operator::Multiply);
        if is_place(a) {
            Some(format!("{place} {sign} {};", self.expr(b)))
        } else if commutes && is_place(b) {
            Some(format!("{place} {sign} {};", self.expr(a)))
        } else {
            None
        }
    }

    /// A store that can fault; `None` for types whose values always fit.
    fn store(&self, ty: Scalar, value: &str, place: &str, fault: FaultId) -> Option<String> {
        let fault = self.fault(fault);
        match ty {
            Scalar::Int { lo, hi } => Some(format!("store_whole({value}, [{lo}, {hi}], {place}, {fault})?;")),
            Scalar::Time => Some(format!("store_whole({value}, [0, i32::MAX], {place}, {fault})?;")),
            Scalar::Real => Some(format!("store_real({value}, {place}, {fault})?;")),
            Scalar::Point => Some(format!("store_point({value}, {place}, {fault})?;")),
            Scalar::Bool | Scalar::Enum(_) | Scalar::Ref(_) => None,
        }
    }

    pub fn fault(&self, id: FaultId) -> String {
        let site = &self.system.model.faults[id.0];
        let text = format!("{}: {}", self.line(site.place), site.text);
        format!("Fault::new({}, {text:?})", id.0 + 1)
    }

    /// Statements that come first, and the place. What is computed to find the place is computed
    /// before the place is borrowed.
    fn target(&self, place: &Place) -> (String, String) {
        let mut hoisted = String::new();
        let text = self.place_at(place, |name, part| {
            if is_simple(part) {
                return self.expr(part);
            }
            hoisted += &format!("let {name} = {};", self.expr(part));
            name.into()
        });
        (hoisted, text)
    }
}

/// Reading it borrows nothing that a target could be part of.
fn is_simple(expr: &Expr) -> bool {
    match &expr.kind {
        ExprKind::Constant(_) | ExprKind::Variable(_) | ExprKind::Own(_) => true,
        ExprKind::Read(Place::Local { index: None, .. } | Place::Parameter { index: None, .. }) => true,
        ExprKind::Binary(_, a, b) => is_simple(a) && is_simple(b),
        _ => false,
    }
}

fn array_of(ty: Type, value: &str) -> String {
    if ty.extent == Extent::One { value.to_string() } else { format!("Array::all({value})") }
}
