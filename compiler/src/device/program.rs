//! The parts of a device with their assemblies taken apart, and what each name means where.

use crate::spec::ast;
use runtime_sim::part::Schema;
use runtime_sim::value::Value;
use std::collections::HashMap;
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
}

#[derive(Debug, Default)]
pub struct Scope {
    /// Where the arguments of an assembly are evaluated.
    pub parent: Option<usize>,
    pub names: HashMap<String, Symbol>,
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
