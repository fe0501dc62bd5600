//! Quantifiers, and what their variables go over.

use crate::check::Checker;
use crate::check::context::{Context, Symbol};
use crate::check::facts;
use crate::check::names::{Declaration, Space, What};
use crate::diagnostic::Diagnostic;
use crate::ir::{self, Domain, Expr, ExprKind, Extent, Scalar, VariableId};
use crate::spec::ast::{self, Quantifier};

/// Members that a role can have at most.
pub(super) const MEMBERS: i32 = 65_535;
/// Numbers that a range can have at most, so that the work of a scan stays bounded.
const LONGEST_RANGE: i32 = 4096;

impl Context<'_, '_> {
    pub(super) fn quantified(
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
                                format!("values of type {name} cannot be added up"),
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
    pub(in crate::check) fn domain(&mut self, tree: &ast::Domain) -> Option<(Domain, Scalar, i32)> {
        match tree {
            ast::Domain::Named(name) => {
                if let Some(id) = self.checker.enum_named(&name.value) {
                    self.checker.uses(name.span, Space::Types, "", &name.value);
                    let size = self.checker.model.elements(Extent::By(id)) as i32;
                    return Some((Domain::Enum(id), Scalar::Enum(id), size));
                }
                let id = self.role_named(name)?;
                Some((Domain::Role(id), Scalar::Ref(self.automaton.roles[id.0].interface), MEMBERS))
            }
            ast::Domain::Range(low, high) => {
                let (low_expr, high_expr) = (self.whole(low), self.whole(high));
                let (low_expr, high_expr) = (low_expr?, high_expr?);
                self.remark_empty(&low_expr, &high_expr, low.span.to(high.span));
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

    pub(super) fn role_named(&mut self, name: &ast::Name) -> Option<ir::RoleId> {
        if let Some(symbol @ Symbol::Role(id)) = self.symbols.get(&name.value).cloned() {
            self.uses_symbol(&name.value, &symbol, name.span);
            return Some(id);
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
    pub(in crate::check) fn bind(&mut self, name: &ast::Name, ty: Scalar) -> VariableId {
        if self.symbols.contains_key(&name.value) || self.variables.iter().any(|(n, _, _)| *n == name.value) {
            self.report(
                Diagnostic::new(
                    "E0301",
                    name.span,
                    format!("`{}` already has another meaning here", name.value),
                )
                .help("choose another name for the variable"),
            );
        }
        let id = self.new_variable(&name.value, ty);
        let declared = self.checker.type_name(ty);
        if let Some(names) = &mut self.checker.names {
            let number = names.declare(Declaration {
                what: What::Variable,
                name: name.value.clone(),
                owner: self.automaton.name.clone(),
                place: Some(name.span),
                ty: declared,
                doc: Vec::new(),
            });
            self.variable_names.insert(id, number);
        }
        self.variables.push((name.value.clone(), id, ty));
        id
    }

    pub(super) fn new_variable(&mut self, name: &str, ty: Scalar) -> VariableId {
        self.automaton.variables.push(ir::Variable {
            name: name.into(),
            doc: Vec::new(),
            ty: ir::Type { scalar: ty, extent: Extent::One },
        });
        VariableId(self.automaton.variables.len() - 1)
    }
}

impl Checker<'_> {
    /// The relation between two interfaces, made when it is first asked for.
    pub(in crate::check) fn relation(
        &mut self,
        from: ir::InterfaceId,
        to: ir::InterfaceId,
    ) -> ir::RelationId {
        let wanted = ir::Relation { from, to };
        let relations = &mut self.model.relations;
        let index = relations.iter().position(|r| *r == wanted).unwrap_or_else(|| {
            relations.push(wanted);
            relations.len() - 1
        });
        ir::RelationId(index)
    }
}
