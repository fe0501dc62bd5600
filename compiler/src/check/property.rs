//! Properties: what a type and its interfaces promise.

use super::context::{Context, Symbol};
use crate::diagnostic::Diagnostic;
use crate::ir::{
    self, Expr, ExprKind, Extent, FaultKind, Kept, KeptBy, Operator, Place, PropertyKind, Scalar, Severity,
    Type, Value,
};
use crate::plain;
use crate::source::Span;
use crate::spec::{ast, written};

impl Context<'_, '_> {
    /// Those of its interfaces, in the order in which it names them, then its own.
    pub(super) fn properties(&mut self, tree: &ast::Automaton) {
        for clause in &tree.implements {
            let declared = &self.checker.declarations.interfaces;
            let Some(interface) = declared.iter().find(|i| i.name.value == clause.interface.value) else {
                continue;
            };
            let interface = interface.clone();
            // A property of an interface knows what the interface shows, whatever else a member has.
            let is_shown = |name: &String| {
                let shown = interface.parameters.iter().map(|parameter| &parameter.name.value);
                shown.chain(interface.cells.iter().map(|cell| &cell.name.value)).any(|known| known == name)
            };
            let all = self.symbols.clone();
            self.symbols.retain(|name, _| is_shown(name));
            for property in &interface.properties {
                // What is wrong with it is told once, and not for each type that has the interface.
                let found = self.checker.diagnostics.len();
                if !self.checker.refused.contains(&property.span) {
                    self.property(property, &all);
                }
                if self.checker.diagnostics.len() > found {
                    self.checker.refused.push(property.span);
                }
            }
            self.symbols = all;
        }
        let all = self.symbols.clone();
        tree.properties.iter().for_each(|property| self.property(property, &all));
    }

    /// `taken` are the names that the values which it keeps cannot have.
    fn property(&mut self, tree: &ast::Property, taken: &std::collections::BTreeMap<String, Symbol>) {
        let number = self.automaton.properties.len() + 1;
        let first_kept = self.automaton.locals.len();
        let kind = match &tree.kind {
            ast::PropertyKind::Always(condition) => {
                self.typed(condition, Scalar::Bool).map(PropertyKind::Always)
            }
            ast::PropertyKind::Keep { values, condition } => {
                let values: Vec<_> = values.iter().map(|value| self.expr(value, None)).collect();
                let condition = self.typed(condition, Scalar::Bool);
                let values: Option<Vec<Expr>> = values.into_iter().collect();
                values.zip(condition).map(|(values, condition)| {
                    let held = self.keep(format!("property{number}_held"), Scalar::Bool, taken);
                    let kept = values.into_iter().enumerate().map(|(place, value)| {
                        let name = match place {
                            0 => format!("property{number}_before"),
                            _ => format!("property{number}_before{}", place + 1),
                        };
                        Kept { before: self.keep(name, value.ty, taken), value }
                    });
                    let values: Vec<Kept> = kept.collect();
                    let same = values.iter().map(same).reduce(and).unwrap_or(truth(true));
                    PropertyKind::Keep { condition, values, same, held }
                })
            }
            ast::PropertyKind::Whenever { trigger, goal, within } => {
                let trigger = self.typed(trigger, Scalar::Bool);
                let goal = self.typed(goal, Scalar::Bool);
                let within = self.typed(within, Scalar::Time);
                trigger.zip(goal).zip(within).map(|((trigger, goal), within)| {
                    let ty = Scalar::Int { lo: -1, hi: i32::MAX };
                    let waited = self.keep(format!("property{number}_waited"), ty, taken);
                    self.automaton.locals[waited].initial = Value::Int(-1);
                    PropertyKind::Whenever { trigger, goal, within, waited, anew: None }
                })
            }
            ast::PropertyKind::Answer { within } => {
                let within = self.typed(within, Scalar::Time);
                self.under_way(tree.span).zip(within).map(|((trigger, command), within)| {
                    let before = self.keep(format!("property{number}_command"), command.ty, taken);
                    let ty = Scalar::Int { lo: -1, hi: i32::MAX };
                    let waited = self.keep(format!("property{number}_waited"), ty, taken);
                    self.automaton.locals[waited].initial = Value::Int(-1);
                    let goal = Expr { ty: Scalar::Bool, kind: ExprKind::Not(Box::new(trigger.clone())) };
                    let anew = Some(Kept { value: command, before });
                    PropertyKind::Whenever { trigger, goal, within, waited, anew }
                })
            }
        };
        let Some(kind) = kind else { return };
        let text = written::on_one_line(self.checker.sources.text(tree.span));
        for kept in &mut self.automaton.locals[first_kept..] {
            kept.doc = vec![text.clone()];
        }
        let (severity, told) = match &tree.reaction {
            ast::Reaction::Fault => {
                (Severity::Line, format!("not: {}", text.strip_prefix("invariant ").unwrap_or(&text)))
            }
            ast::Reaction::Ask(told) | ast::Reaction::StopLine(told) => (Severity::Line, plain::line(told)),
            ast::Reaction::StopMachine(told) => (Severity::Machine, plain::line(told)),
            ast::Reaction::Warn(told) => (Severity::Warning, plain::line(told)),
        };
        let fault = match kind {
            PropertyKind::Always(_) => FaultKind::InvariantFails,
            PropertyKind::Keep { .. } => FaultKind::NotKept,
            PropertyKind::Whenever { .. } => FaultKind::NotFollowed,
        };
        let site = self.fault(fault, tree.span, told);
        self.checker.model.faults[site.0].severity = severity;
        let asks_operator = matches!(tree.reaction, ast::Reaction::Ask(_));
        let property = ir::Property { place: tree.span, text, kind, severity, site, asks_operator };
        self.automaton.properties.push(property);
    }

    /// Whether a command is under way, and its number.
    fn under_way(&mut self, place: Span) -> Option<(Expr, Expr)> {
        let ports = &self.automaton.device.ports;
        let read = |name: &str| {
            let port = ports.iter().position(|port| port.name == name)?;
            let ty = Scalar::from(ports[port].ty);
            Some(Expr { ty, kind: ExprKind::Read(Place::Port { port, index: None }) })
        };
        let Some((command, answered)) = read("cmd").zip(read("ack")) else {
            let message = format!("the device `{}` has no commands", self.automaton.device.name);
            let help = "write `answer within` in an automaton whose device has commands";
            self.report(Diagnostic::new("E0335", place, message).help(help));
            return None;
        };
        let zero = Expr { ty: Scalar::Int { lo: 0, hi: 0 }, kind: ExprKind::Constant(Value::Int(0)) };
        let differ = |a: Expr, b: Expr| Expr {
            ty: Scalar::Bool,
            kind: ExprKind::Binary(Operator::NotEqual, Box::new(a), Box::new(b)),
        };
        let under_way = and(differ(command.clone(), zero), differ(command.clone(), answered));
        Some((under_way, command))
    }

    /// A local that no transition writes.
    fn keep(
        &mut self,
        mut name: String,
        scalar: Scalar,
        taken: &std::collections::BTreeMap<String, Symbol>,
    ) -> usize {
        while taken.contains_key(&name) {
            name.push('_');
        }
        let scalar = match scalar {
            Scalar::Int { .. } => Scalar::Int { lo: i32::MIN, hi: i32::MAX },
            other => other,
        };
        let initial = match scalar {
            Scalar::Bool => Value::Bool(false),
            Scalar::Real => Value::Real(0.0),
            Scalar::Point => Value::Point([0.0; 3]),
            Scalar::Int { .. } | Scalar::Time | Scalar::Enum(_) | Scalar::Ref(_) => Value::Int(0),
        };
        let ty = Type { scalar, extent: Extent::One };
        let doc = Vec::new();
        self.automaton.locals.push(ir::Local { name, doc, ty, initial, kept_by: KeptBy::Properties });
        self.automaton.locals.len() - 1
    }
}

fn truth(value: bool) -> Expr {
    Expr { ty: Scalar::Bool, kind: ExprKind::Constant(Value::Bool(value)) }
}

fn and(a: Expr, b: Expr) -> Expr {
    Expr { ty: Scalar::Bool, kind: ExprKind::Binary(Operator::And, Box::new(a), Box::new(b)) }
}

/// The value is what it was: of a point each coordinate.
fn same(kept: &Kept) -> Expr {
    let before = Place::Local { local: kept.before, index: None };
    let before = Expr { ty: kept.value.ty, kind: ExprKind::Read(before) };
    let equal = |a: Expr, b: Expr| Expr {
        ty: Scalar::Bool,
        kind: ExprKind::Binary(Operator::Equal, Box::new(a), Box::new(b)),
    };
    if kept.value.ty != Scalar::Point {
        return equal(kept.value.clone(), before);
    }
    let coordinate =
        |of: &Expr, axis| Expr { ty: Scalar::Real, kind: ExprKind::Coordinate(Box::new(of.clone()), axis) };
    let equal = |axis| equal(coordinate(&kept.value, axis), coordinate(&before, axis));
    and(and(equal(0), equal(1)), equal(2))
}
