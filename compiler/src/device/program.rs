//! The parts of a device with their assemblies taken apart, and what each name means where.

use crate::spec::ast;
use runtime_sim::part::Schema;
use runtime_sim::value::Value;
use rustc_hash::FxHashMap;
use std::sync::Arc;

/// What is evaluated for each machine.
#[derive(Debug, Default)]
pub struct Program {
    /// The first is that of the device, the others are those of its assemblies.
    pub scopes: Vec<Scope>,
    /// Those of assemblies stand where the assembly does.
    pub parts: Vec<Part>,
    pub places: Vec<ast::Place>,
    pub requires: Vec<ast::Require>,
    /// The parameters of the device that are times, by their numbers.
    pub times: Vec<usize>,
    /// The parameter of the device that is routes.
    pub routes: Option<usize>,
}

#[derive(Debug, Default)]
pub struct Scope {
    /// Where the arguments of an assembly are evaluated.
    pub parent: Option<usize>,
    pub names: FxHashMap<String, Symbol>,
}

#[derive(Debug)]
pub enum Symbol {
    /// Given by the layout: the number of the device's parameter.
    Parameter(usize),
    /// In the scope itself.
    Define(ast::Expr),
    /// Given by the device that uses the assembly.
    Argument(ast::Expr),
    Part(usize),
    /// The scope of an assembly.
    Assembly(usize),
}

#[derive(Debug)]
pub struct Part {
    pub name: ast::Name,
    pub schema: &'static Schema,
    pub settings: Vec<Setting>,
    pub scope: usize,
    /// The part, if it is the same for all machines.
    pub known: Option<Arc<runtime_sim::part::Part>>,
}

/// What a device gives a setting of a part.
#[derive(Debug)]
pub struct Setting {
    pub name: ast::Name,
    pub value: ast::Expr,
    /// The value, if it is the same for all machines.
    pub known: Option<Value>,
}

impl Program {
    /// Whether a name stands in one of its expressions.
    pub fn mentions(&self, name: &str) -> bool {
        let symbols = self.scopes.iter().flat_map(|scope| scope.names.values());
        let defined = symbols.filter_map(|symbol| match symbol {
            Symbol::Define(expr) | Symbol::Argument(expr) => Some(expr),
            Symbol::Parameter(_) | Symbol::Part(_) | Symbol::Assembly(_) => None,
        });
        let settings = self.parts.iter().flat_map(|part| part.settings.iter().map(|given| &given.value));
        let places = self.places.iter().flat_map(ast::Place::expressions);
        defined.chain(settings).chain(places).any(|expr| mentions(expr, name))
    }
}

/// Whether a name stands in an expression.
pub fn mentions(expr: &ast::Expr, name: &str) -> bool {
    use ast::ExprKind as Kind;
    match &expr.kind {
        Kind::Name(word) => word == name,
        Kind::Member(a, _) | Kind::Negate(a) | Kind::Not(a) => mentions(a, name),
        Kind::Index(a, b) | Kind::Binary(_, a, b) => mentions(a, name) || mentions(b, name),
        Kind::Call(_, all) | Kind::List(all) => all.iter().any(|part| mentions(part, name)),
        _ => false,
    }
}
