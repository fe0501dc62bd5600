//! Types of expressions.

use super::automaton::{Context, Symbol};
use super::facts::{self, Interval};
use super::path::Path;
use crate::diagnostic::Diagnostic;
use crate::ir::{self, Domain, Expr, ExprKind, Extent, Place, Scalar, Value, VariableId};
use crate::source::Span;
use crate::spec::ast::{self, Operator, Quantifier};

impl Context<'_, '_> {
    /// An expression of any scalar type; `None` has been reported.
    pub(super) fn expr(&mut self, tree: &ast::Expr, expected: Option<Scalar>) -> Option<Expr> {
        use ast::ExprKind as Tree;
        match &tree.kind {
            Tree::Error => None,
            Tree::Bool(b) => Some(constant(Scalar::Bool, Value::Bool(*b))),
            Tree::Int(i) => {
                let value = *i as i32;
                if expected == Some(Scalar::Real) {
                    return Some(constant(Scalar::Real, Value::Real(f64::from(value))));
                }
                Some(constant(Scalar::Int { lo: value, hi: value }, Value::Int(value)))
            }
            Tree::Real(r) => Some(constant(Scalar::Real, Value::Real(*r))),
            Tree::Duration(ms) => Some(constant(Scalar::Time, Value::Int(*ms as i32))),
            Tree::Name(_) | Tree::Member(..) | Tree::Index(..) => match self.path(tree, expected)? {
                Path::Value(expr) => Some(expr),
                Path::Place(place, ty) if ty.extent == Extent::One => Some(self.read(place, ty.scalar)),
                Path::Place(..) => {
                    self.report(
                        Diagnostic::new("E0312", tree.span, "this is a whole array, not one value")
                            .help("write an index, such as `[i]`"),
                    );
                    None
                }
            },
            Tree::Call(name, arguments) => self.call(name, arguments, tree.span),
            Tree::Not(inner) => {
                let inner = self.typed(inner, Scalar::Bool)?;
                Some(Expr { ty: Scalar::Bool, kind: ExprKind::Not(Box::new(inner)) })
            }
            Tree::Negate(inner) => self.negate(inner, expected, tree.span),
            Tree::Binary(operator, left, right) => self.binary(*operator, left, right, expected, tree.span),
            Tree::Quantified { quantifier, variable, domain, body } => {
                self.quantified(*quantifier, variable, domain, body)
            }
            Tree::After(time) => {
                if !self.in_guard {
                    self.report(
                        Diagnostic::new("E0314", tree.span, "`after` can stand in a guard only")
                            .help("move it behind `when`"),
                    );
                    return None;
                }
                let time = self.typed(time, Scalar::Time)?;
                Some(Expr { ty: Scalar::Bool, kind: ExprKind::After(Box::new(time)) })
            }
            Tree::In(value, role) => {
                let id = self.role_named(role)?;
                let value = self.typed(value, Scalar::Ref(self.automaton.roles[id.0].interface))?;
                Some(Expr { ty: Scalar::Bool, kind: ExprKind::IsMember(Box::new(value), id) })
            }
            Tree::Reaches(from, to) => {
                let (from, to) = (self.reference(from)?, self.reference(to)?);
                let (Scalar::Ref(a), Scalar::Ref(b)) = (from.ty, to.ty) else { return None };
                let relation = self.checker.relation(a, b);
                let kind = ExprKind::Reaches(relation, Box::new(from), Box::new(to));
                Some(Expr { ty: Scalar::Bool, kind })
            }
        }
    }

    /// `done` or `failed`.
    pub(super) fn answer(&mut self, name: &str, span: Span) -> Option<Expr> {
        if !self.automaton.device.is_commanded() {
            let message = format!("the device `{}` obeys no commands", self.automaton.device.name);
            self.report(Diagnostic::new("E0314", span, message).help("`done` and `failed` answer a command"));
            return None;
        }
        let kind = if name == "done" { ExprKind::Done } else { ExprKind::Failed };
        Some(Expr { ty: Scalar::Bool, kind })
    }

    fn reference(&mut self, tree: &ast::Expr) -> Option<Expr> {
        let expr = self.expr(tree, None)?;
        if matches!(expr.ty, Scalar::Ref(_)) {
            return Some(expr);
        }
        let name = self.checker.type_name(expr.ty);
        self.report(
            Diagnostic::new("E0315", tree.span, format!("this has type {name}, a robot is wanted"))
                .help("`reaches` stands between two robots"),
        );
        None
    }

    /// An expression of a given type; whole numbers become reals where a real is wanted.
    pub(super) fn typed(&mut self, tree: &ast::Expr, wanted: Scalar) -> Option<Expr> {
        let expr = self.expr(tree, Some(wanted))?;
        match (expr.ty, wanted) {
            (Scalar::Int { .. }, Scalar::Int { .. }) => Some(expr),
            (Scalar::Int { .. }, Scalar::Real) => Some(to_real(expr)),
            (a, b) if a == b => Some(expr),
            (found, _) => {
                let (found, wanted) = (self.checker.type_name(found), self.checker.type_name(wanted));
                self.report(
                    Diagnostic::new("E0315", tree.span, format!("this has type {found}, {wanted} is wanted"))
                        .help(type_help(&found, &wanted, tree)),
                );
                None
            }
        }
    }

    /// A whole number.
    pub(super) fn whole(&mut self, tree: &ast::Expr) -> Option<Expr> {
        self.typed(tree, Scalar::Int { lo: i32::MIN, hi: i32::MAX })
    }

    fn read(&self, place: Place, ty: Scalar) -> Expr {
        let mut expr = Expr { ty, kind: ExprKind::Read(place) };
        if let Scalar::Int { lo, hi } = ty {
            let known = self.facts.of(&expr);
            if known.lo <= known.hi {
                expr.ty = Scalar::Int {
                    lo: known.lo.max(f64::from(lo)) as i32,
                    hi: known.hi.min(f64::from(hi)) as i32,
                };
            }
        }
        expr
    }

    fn negate(&mut self, tree: &ast::Expr, expected: Option<Scalar>, span: Span) -> Option<Expr> {
        let inner = self.expr(tree, expected)?;
        match (&inner.kind, inner.ty) {
            (ExprKind::Constant(Value::Int(v)), Scalar::Int { .. }) => {
                Some(constant(Scalar::Int { lo: -v, hi: -v }, Value::Int(-v)))
            }
            (ExprKind::Constant(Value::Real(v)), _) => Some(constant(Scalar::Real, Value::Real(-v))),
            (_, Scalar::Int { lo, hi }) => {
                let ty = self.fitting(-i64::from(hi), -i64::from(lo), span)?;
                Some(Expr { ty, kind: ExprKind::Negate(Box::new(inner)) })
            }
            (_, Scalar::Real) => Some(Expr { ty: Scalar::Real, kind: ExprKind::Negate(Box::new(inner)) }),
            (_, other) => {
                let name = self.checker.type_name(other);
                self.report(
                    Diagnostic::new("E0315", span, format!("a value of type {name} has no sign"))
                        .help("negate numbers only"),
                );
                None
            }
        }
    }

    /// The type of whole numbers in an interval, which must fit into 32 bits.
    fn fitting(&mut self, lo: i64, hi: i64, span: Span) -> Option<Scalar> {
        match (i32::try_from(lo), i32::try_from(hi)) {
            (Ok(lo), Ok(hi)) => Some(Scalar::Int { lo, hi }),
            _ => {
                self.report(
                    Diagnostic::new("E0316", span, "this whole number is not proved to fit into 32 bits")
                        .label(format!("it is in {lo}..{hi} for all that is known"))
                        .help("declare the variables with narrower bounds"),
                );
                None
            }
        }
    }

    fn binary(
        &mut self,
        operator: Operator,
        left: &ast::Expr,
        right: &ast::Expr,
        expected: Option<Scalar>,
        span: Span,
    ) -> Option<Expr> {
        match operator {
            Operator::And | Operator::Or => self.logical(operator, left, right),
            Operator::Equal
            | Operator::NotEqual
            | Operator::Less
            | Operator::LessEqual
            | Operator::Greater
            | Operator::GreaterEqual => self.comparison(operator, left, right, span),
            _ => self.arithmetic(operator, left, right, expected, span),
        }
    }

    fn logical(&mut self, operator: Operator, left: &ast::Expr, right: &ast::Expr) -> Option<Expr> {
        let left = self.typed(left, Scalar::Bool);
        let before = self.facts.clone();
        if let Some(left) = &left {
            self.facts.learn(left, operator == Operator::And);
        }
        let right = self.typed(right, Scalar::Bool);
        self.facts = before;
        Some(binary(lowered(operator), Scalar::Bool, left?, right?))
    }

    /// Both operands in one type: whole numbers become reals, members of enumerations are found by the other side.
    fn pair(
        &mut self,
        left: &ast::Expr,
        right: &ast::Expr,
        expected: Option<Scalar>,
    ) -> Option<(Expr, Expr)> {
        let is_bare = |tree: &ast::Expr| matches!(tree.kind, ast::ExprKind::Name(_));
        let (a, b) = if is_bare(left) && !is_bare(right) {
            let b = self.expr(right, expected)?;
            (self.expr(left, Some(b.ty))?, b)
        } else {
            let a = self.expr(left, expected)?;
            let b = self.expr(right, Some(a.ty))?;
            (a, b)
        };
        Some(match (a.ty, b.ty) {
            (Scalar::Int { .. }, Scalar::Real) => (to_real(a), b),
            (Scalar::Real, Scalar::Int { .. }) => (a, to_real(b)),
            _ => (a, b),
        })
    }

    fn comparison(
        &mut self,
        operator: Operator,
        left: &ast::Expr,
        right: &ast::Expr,
        span: Span,
    ) -> Option<Expr> {
        let (a, b) = self.pair(left, right, None)?;
        let is_equality = matches!(operator, Operator::Equal | Operator::NotEqual);
        let fits = match (a.ty, b.ty) {
            (Scalar::Int { .. }, Scalar::Int { .. })
            | (Scalar::Real, Scalar::Real)
            | (Scalar::Time, Scalar::Time) => true,
            (Scalar::Bool, Scalar::Bool) => is_equality,
            (Scalar::Enum(x), Scalar::Enum(y)) => is_equality && x == y,
            (Scalar::Ref(x), Scalar::Ref(y)) => is_equality && x == y,
            (Scalar::Point, Scalar::Point) => {
                self.report(
                    Diagnostic::new("E0317", span, "points cannot be compared")
                        .help("whether a machine is in position its device answers: use `done`"),
                );
                return None;
            }
            _ => false,
        };
        if !fits {
            let help = match (a.ty, b.ty) {
                (Scalar::Time, Scalar::Int { .. } | Scalar::Real) => unit_help(right),
                (Scalar::Int { .. } | Scalar::Real, Scalar::Time) => unit_help(left),
                _ => "numbers and times have an order; other values are equal or not".into(),
            };
            let (left, right) = (self.checker.type_name(a.ty), self.checker.type_name(b.ty));
            self.report(
                Diagnostic::new("E0315", span, format!("{left} and {right} cannot be compared in this way"))
                    .help(help),
            );
            return None;
        }
        Some(binary(lowered(operator), Scalar::Bool, a, b))
    }

    fn arithmetic(
        &mut self,
        operator: Operator,
        left: &ast::Expr,
        right: &ast::Expr,
        expected: Option<Scalar>,
        span: Span,
    ) -> Option<Expr> {
        let hint = if expected == Some(Scalar::Real) { expected } else { None };
        let (a, b) = self.pair(left, right, hint)?;
        let lowered = lowered(operator);
        match (a.ty, b.ty, operator) {
            (Scalar::Int { .. }, Scalar::Int { .. }, _) => {
                self.whole_arithmetic(operator, a, b, right.span, span)
            }
            (Scalar::Real, Scalar::Real, Operator::Add | Operator::Subtract | Operator::Multiply) => {
                Some(binary(lowered, Scalar::Real, a, b))
            }
            (Scalar::Real, Scalar::Real, Operator::Divide) => {
                self.prove_divisor(&b, right.span)?;
                Some(binary(lowered, Scalar::Real, a, b))
            }
            (Scalar::Point, Scalar::Point, Operator::Add | Operator::Subtract) => {
                Some(binary(lowered, Scalar::Point, a, b))
            }
            (Scalar::Time, Scalar::Int { lo, .. }, Operator::Multiply) => self.time_product(a, b, lo, span),
            (Scalar::Int { lo, .. }, Scalar::Time, Operator::Multiply) => self.time_product(b, a, lo, span),
            (Scalar::Time, Scalar::Time, Operator::Add) => self.time_sum(a, b, span),
            (a, b, _) => {
                let help = match (a, b, operator) {
                    (Scalar::Time, Scalar::Int { .. } | Scalar::Real, Operator::Add) => unit_help(right),
                    (Scalar::Int { .. } | Scalar::Real, Scalar::Time, Operator::Add) => unit_help(left),
                    _ => "`+ - * /` join numbers; `+ -` points; a time can be added to a time or multiplied by a whole number".into(),
                };
                let (left, right) = (self.checker.type_name(a), self.checker.type_name(b));
                self.report(
                    Diagnostic::new(
                        "E0315",
                        span,
                        format!("{left} and {right} cannot be joined in this way"),
                    )
                    .help(help),
                );
                None
            }
        }
    }

    fn time_sum(&mut self, a: Expr, b: Expr, span: Span) -> Option<Expr> {
        let (x, y) = (self.facts.of(&a), self.facts.of(&b));
        self.fitting(0, (x.hi + y.hi) as i64, span)?;
        Some(binary(ir::Operator::Add, Scalar::Time, a, b))
    }

    fn time_product(&mut self, time: Expr, factor: Expr, lo: i32, span: Span) -> Option<Expr> {
        if lo < 0 {
            self.report(
                Diagnostic::new("E0316", span, "this duration could be negative")
                    .help("multiply by a number that is 0 or more"),
            );
            return None;
        }
        let (x, y) = (self.facts.of(&time), self.facts.of(&factor));
        self.fitting(0, (x.hi * y.hi) as i64, span)?;
        Some(binary(ir::Operator::Multiply, Scalar::Time, time, factor))
    }

    fn prove_divisor(&mut self, divisor: &Expr, span: Span) -> Option<()> {
        if self.facts.of(divisor).holds(0.0) {
            self.report(Diagnostic::new("E0318", span, "this divisor is not proved to differ from 0").help(
                "compare it in the guard of this transition, such as `x > 0`, or declare bounds without 0",
            ));
            return None;
        }
        Some(())
    }

    fn whole_arithmetic(
        &mut self,
        operator: Operator,
        a: Expr,
        b: Expr,
        divisor: Span,
        span: Span,
    ) -> Option<Expr> {
        let (x, y) = (self.facts.of(&a), self.facts.of(&b));
        if matches!(operator, Operator::Divide | Operator::Modulo) {
            self.prove_divisor(&b, divisor)?;
        }
        let corners = |f: fn(f64, f64) -> f64| {
            let all = [f(x.lo, y.lo), f(x.lo, y.hi), f(x.hi, y.lo), f(x.hi, y.hi)];
            all.iter().fold(Interval::new(f64::INFINITY, f64::NEG_INFINITY), |i, v| {
                Interval::new(i.lo.min(*v), i.hi.max(*v))
            })
        };
        let result = match operator {
            Operator::Add => corners(|a, b| a + b),
            Operator::Subtract => corners(|a, b| a - b),
            Operator::Multiply => corners(|a, b| a * b),
            Operator::Divide => {
                let largest = x.lo.abs().max(x.hi.abs());
                Interval::new(if x.lo < 0.0 || y.lo < 0.0 { -largest } else { 0.0 }, largest)
            }
            _ => {
                // The quotient must fit too: not every machine divides the least number by -1.
                self.fitting((-x.lo) as i64, 0, span)?;
                let largest = y.lo.abs().max(y.hi.abs()) - 1.0;
                Interval::new(if x.lo < 0.0 { -largest } else { 0.0 }, largest)
            }
        };
        let ty = self.fitting(result.lo as i64, result.hi as i64, span)?;
        Some(binary(lowered(operator), ty, a, b))
    }

    fn call(&mut self, name: &ast::Name, arguments: &[ast::Expr], span: Span) -> Option<Expr> {
        match (name.value.as_str(), arguments) {
            ("count", [_] | [_, _]) => self.count_call(arguments, span),
            ("min" | "max", [a, b]) => {
                let (a, b) = self.pair(a, b, None)?;
                let least = name.value == "min";
                let ty = match (a.ty, b.ty) {
                    (Scalar::Int { lo: a, hi: b }, Scalar::Int { lo: c, hi: d }) => {
                        if least {
                            Scalar::Int { lo: a.min(c), hi: b.min(d) }
                        } else {
                            Scalar::Int { lo: a.max(c), hi: b.max(d) }
                        }
                    }
                    (Scalar::Real, Scalar::Real) => Scalar::Real,
                    (Scalar::Time, Scalar::Time) => Scalar::Time,
                    _ => return self.wrong_arguments(name, span),
                };
                let (a, b) = (Box::new(a), Box::new(b));
                Some(Expr { ty, kind: if least { ExprKind::Min(a, b) } else { ExprKind::Max(a, b) } })
            }
            ("abs", [a]) => {
                let a = self.expr(a, None)?;
                let ty = match a.ty {
                    Scalar::Int { lo, hi } => {
                        let (x, y) = (i64::from(lo).abs(), i64::from(hi).abs());
                        let least = if lo <= 0 && hi >= 0 { 0 } else { x.min(y) };
                        self.fitting(least, x.max(y), span)?
                    }
                    Scalar::Real => Scalar::Real,
                    _ => return self.wrong_arguments(name, span),
                };
                Some(Expr { ty, kind: ExprKind::Absolute(Box::new(a)) })
            }
            ("point", [x, y, z]) => {
                let parts =
                    [self.typed(x, Scalar::Real), self.typed(y, Scalar::Real), self.typed(z, Scalar::Real)];
                let [Some(x), Some(y), Some(z)] = parts else { return None };
                Some(Expr { ty: Scalar::Point, kind: ExprKind::MakePoint(Box::new([x, y, z])) })
            }
            ("up", [height]) => {
                let height = self.typed(height, Scalar::Real)?;
                let zero = || constant(Scalar::Real, Value::Real(0.0));
                Some(Expr {
                    ty: Scalar::Point,
                    kind: ExprKind::MakePoint(Box::new([zero(), zero(), height])),
                })
            }
            ("squared_distance", [a, b]) => {
                let (a, b) = (self.typed(a, Scalar::Point)?, self.typed(b, Scalar::Point)?);
                Some(Expr { ty: Scalar::Real, kind: ExprKind::SquaredDistance(Box::new(a), Box::new(b)) })
            }
            ("count" | "min" | "max" | "abs" | "point" | "up" | "squared_distance", _) => {
                self.wrong_arguments(name, span)
            }
            _ => {
                let known = ["count", "min", "max", "abs", "point", "up", "squared_distance"];
                let help = match self.automaton.device.verbs.iter().find(|v| v.name == name.value) {
                    Some(verb) => format!("`{}` is a command: it stands in updates", verb.name),
                    None => crate::diagnostic::suggestion(&name.value, known)
                        .map_or(format!("functions are {}", known.join(", ")), |n| {
                            format!("is `{n}` meant?")
                        }),
                };
                self.report(
                    Diagnostic::new("E0311", name.span, format!("there is no function `{}`", name.value))
                        .help(help),
                );
                None
            }
        }
    }

    fn wrong_arguments(&mut self, name: &ast::Name, span: Span) -> Option<Expr> {
        self.report(
            Diagnostic::new("E0319", span, format!("`{}` does not take these arguments", name.value)).help(
                "min(a, b), max(a, b), abs(a) of numbers; point(x, y, z); up(height); squared_distance(p, q); count(role) or count(array, value)",
            ),
        );
        None
    }

    /// `count(role)` and `count(array, value)`.
    fn count_call(&mut self, arguments: &[ast::Expr], span: Span) -> Option<Expr> {
        if let [ast::Expr { kind: ast::ExprKind::Name(name), .. }] = arguments
            && let Some(Symbol::Role(id)) = self.symbols.get(name).cloned()
        {
            return Some(Expr { ty: Scalar::Int { lo: 0, hi: MEMBERS }, kind: ExprKind::Members(id) });
        }
        let [array, value] = arguments else {
            return self.wrong_arguments(&ast::Name { value: "count".into(), span }, span);
        };
        let Path::Place(mut place, ty) = self.path(array, None)? else {
            self.report(
                Diagnostic::new("E0312", array.span, "this is no array").help("count a role or an array"),
            );
            return None;
        };
        let value = self.typed(value, ty.scalar)?;
        let (domain, scalar, size) = match ty.extent {
            Extent::One => {
                self.report(
                    Diagnostic::new("E0312", array.span, "this is no array").help("count a role or an array"),
                );
                return None;
            }
            Extent::By(id) => (Domain::Enum(id), Scalar::Enum(id), self.checker.model.elements(ty.extent)),
            Extent::Count(n) => {
                let whole = |v: i32| constant(Scalar::Int { lo: v, hi: v }, Value::Int(v));
                let last = n as i32 - 1;
                (Domain::Range(whole(0), whole(last)), Scalar::Int { lo: 0, hi: last }, n)
            }
        };
        let variable = self.new_variable("element", scalar);
        let index = Some(Box::new(Expr { ty: scalar, kind: ExprKind::Variable(variable) }));
        match &mut place {
            Place::Local { index: i, .. }
            | Place::Cell { index: i, .. }
            | Place::Port { index: i, .. }
            | Place::Parameter { index: i, .. }
            | Place::Shown { index: i, .. } => *i = index,
        }
        let element = Expr { ty: ty.scalar, kind: ExprKind::Read(place) };
        let body = Box::new(binary(ir::Operator::Equal, Scalar::Bool, element, value));
        let kind = ExprKind::Count { variable, domain: Box::new(domain), body };
        Some(Expr { ty: Scalar::Int { lo: 0, hi: size as i32 }, kind })
    }

    fn quantified(
        &mut self,
        quantifier: Quantifier,
        variable: &ast::Name,
        domain: &ast::Domain,
        body: &ast::Expr,
    ) -> Option<Expr> {
        let Some((domain, scalar, size)) = self.domain(domain) else {
            self.broken.insert(variable.value.clone());
            return None;
        };
        let id = self.bind(variable, scalar);
        let wanted = if quantifier == Quantifier::Sum {
            Scalar::Int { lo: i32::MIN, hi: i32::MAX }
        } else {
            Scalar::Bool
        };
        let typed = match quantifier {
            Quantifier::Sum => self.expr(body, None),
            _ => self.typed(body, wanted),
        };
        self.variables.pop();
        let body = Box::new(typed?);
        let domain = Box::new(domain);
        let (ty, kind) = match quantifier {
            Quantifier::Exists => (Scalar::Bool, ExprKind::Exists { variable: id, domain, body }),
            Quantifier::Forall => (Scalar::Bool, ExprKind::Forall { variable: id, domain, body }),
            Quantifier::Count => {
                (Scalar::Int { lo: 0, hi: size }, ExprKind::Count { variable: id, domain, body })
            }
            Quantifier::Sum => {
                let ty = match body.ty {
                    Scalar::Real => Scalar::Real,
                    Scalar::Int { lo, hi } => {
                        let size = i64::from(size);
                        self.fitting(
                            (size * i64::from(lo)).min(0),
                            (size * i64::from(hi)).max(0),
                            variable.span,
                        )?
                    }
                    other => {
                        let name = self.checker.type_name(other);
                        self.report(
                            Diagnostic::new(
                                "E0315",
                                variable.span,
                                format!("values of type {name} have no sum"),
                            )
                            .help("sum numbers, or count with `count x in ...: condition`"),
                        );
                        return None;
                    }
                };
                (ty, ExprKind::Sum { variable: id, domain, body })
            }
        };
        Some(Expr { ty, kind })
    }

    /// A domain, the type of a variable that runs over it, and the greatest number of its values.
    pub(super) fn domain(&mut self, tree: &ast::Domain) -> Option<(Domain, Scalar, i32)> {
        match tree {
            ast::Domain::Named(name) => {
                if let Some(id) = self.checker.enum_named(&name.value) {
                    let size = self.checker.model.elements(Extent::By(id)) as i32;
                    return Some((Domain::Enum(id), Scalar::Enum(id), size));
                }
                let id = self.role_named(name)?;
                Some((Domain::Role(id), Scalar::Ref(self.automaton.roles[id.0].interface), MEMBERS))
            }
            ast::Domain::Range(low, high) => {
                let (low_expr, high_expr) = (self.whole(low), self.whole(high));
                let (low_expr, high_expr) = (low_expr?, high_expr?);
                let domain = Domain::Range(low_expr, high_expr);
                let known = facts::of_domain(&domain, &self.facts)?;
                let size = (known.hi - known.lo + 1.0).max(0.0);
                if size > f64::from(LONGEST_RANGE) {
                    self.report(
                        Diagnostic::new(
                            "E0320",
                            low.span.to(high.span),
                            "this range could have too many numbers for one scan",
                        )
                        .label(format!("up to {size}"))
                        .help(format!("declare its bounds so that it has {LONGEST_RANGE} at most")),
                    );
                    return None;
                }
                let ty = if known.lo <= known.hi {
                    Scalar::Int { lo: known.lo as i32, hi: known.hi as i32 }
                } else {
                    Scalar::Int { lo: known.lo as i32, hi: known.lo as i32 }
                };
                Some((domain, ty, size as i32))
            }
        }
    }

    fn role_named(&mut self, name: &ast::Name) -> Option<ir::RoleId> {
        if let Some(Symbol::Role(id)) = self.symbols.get(&name.value) {
            return Some(*id);
        }
        if self.broken.contains(&name.value) {
            return None;
        }
        if self.symbols.contains_key(&name.value) {
            let message = format!("`{}` is neither a role nor an enumeration", name.value);
            self.report(
                Diagnostic::new("E0311", name.span, message)
                    .help("write a role, an enumeration or a range such as `0..capacity - 1`"),
            );
            return None;
        }
        let mut known: Vec<String> = self.automaton.roles.iter().map(|r| r.name.clone()).collect();
        known.extend(self.checker.model.enums.iter().map(|e| e.name.clone()));
        let help = crate::diagnostic::suggestion(&name.value, known.iter().map(String::as_str))
            .map_or("write a role, an enumeration or a range such as `0..capacity - 1`".into(), |n| {
                format!("is `{n}` meant?")
            });
        self.report(
            Diagnostic::new("E0311", name.span, format!("there is no role `{}`", name.value)).help(help),
        );
        None
    }

    /// Brings a variable into scope; the caller takes it out again.
    pub(super) fn bind(&mut self, name: &ast::Name, ty: Scalar) -> VariableId {
        if self.symbols.contains_key(&name.value) || self.variables.iter().any(|(n, _, _)| *n == name.value) {
            self.report(
                Diagnostic::new(
                    "E0301",
                    name.span,
                    format!("`{}` has another meaning here already", name.value),
                )
                .help("choose another name for the variable"),
            );
        }
        let id = self.new_variable(&name.value, ty);
        self.variables.push((name.value.clone(), id, ty));
        id
    }

    fn new_variable(&mut self, name: &str, ty: Scalar) -> VariableId {
        self.automaton.variables.push(ir::Variable {
            name: name.into(),
            doc: Vec::new(),
            ty: ir::Type { scalar: ty, extent: Extent::One },
        });
        VariableId(self.automaton.variables.len() - 1)
    }
}

/// Members that a role can have at most.
const MEMBERS: i32 = 65_535;
/// Numbers that a range can have at most, so that the work of a scan stays bounded.
const LONGEST_RANGE: i32 = 4096;

fn constant(ty: Scalar, value: Value) -> Expr {
    Expr { ty, kind: ExprKind::Constant(value) }
}

fn to_real(expr: Expr) -> Expr {
    match expr.kind {
        ExprKind::Constant(Value::Int(v)) => constant(Scalar::Real, Value::Real(f64::from(v))),
        _ => Expr { ty: Scalar::Real, kind: ExprKind::ToReal(Box::new(expr)) },
    }
}

fn binary(operator: ir::Operator, ty: Scalar, left: Expr, right: Expr) -> Expr {
    Expr { ty, kind: ExprKind::Binary(operator, Box::new(left), Box::new(right)) }
}

fn lowered(operator: Operator) -> ir::Operator {
    match operator {
        Operator::Or => ir::Operator::Or,
        Operator::And => ir::Operator::And,
        Operator::Equal => ir::Operator::Equal,
        Operator::NotEqual => ir::Operator::NotEqual,
        Operator::Less => ir::Operator::Less,
        Operator::LessEqual => ir::Operator::LessEqual,
        Operator::Greater => ir::Operator::Greater,
        Operator::GreaterEqual => ir::Operator::GreaterEqual,
        Operator::Add => ir::Operator::Add,
        Operator::Subtract => ir::Operator::Subtract,
        Operator::Multiply => ir::Operator::Multiply,
        Operator::Divide => ir::Operator::Divide,
        Operator::Modulo => ir::Operator::Modulo,
    }
}

/// How a number becomes a duration.
pub(super) fn unit_help(tree: &ast::Expr) -> String {
    match &tree.kind {
        ast::ExprKind::Int(number) => format!("write a unit: `{number} s`"),
        ast::ExprKind::Real(number) => format!("write a unit: `{number} s`"),
        _ => "write a duration with its unit, such as `60 s` or `300 ms`".into(),
    }
}

fn type_help(found: &str, wanted: &str, tree: &ast::Expr) -> String {
    match (found, wanted) {
        (_, "time") => unit_help(tree),
        ("real", _) if wanted.starts_with("int") => {
            "a real does not become a whole number; compute with whole numbers".into()
        }
        _ => format!("write a value of type {wanted}"),
    }
}

impl super::Checker<'_> {
    /// The relation between two interfaces, made when it is first asked for.
    pub(super) fn relation(&mut self, from: ir::InterfaceId, to: ir::InterfaceId) -> ir::RelationId {
        let wanted = ir::Relation { from, to };
        let relations = &mut self.model.relations;
        let index = relations.iter().position(|r| *r == wanted).unwrap_or_else(|| {
            relations.push(wanted);
            relations.len() - 1
        });
        ir::RelationId(index)
    }
}
