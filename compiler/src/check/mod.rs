//! From trees to a [`Model`]: names, types, proofs of indices and bounds, rules of writing.

mod automaton;
mod context;
mod decided;
mod declared;
mod devices;
mod expression;
mod facts;
mod implements;
pub mod names;
mod path;
mod property;
mod replaced;
mod retain;
mod rule;
mod sequence;
mod state;
mod types;
mod update;
mod used;
pub(crate) mod work;

pub use used::used;

use crate::device::{self, Device};
use crate::diagnostic::{Diagnostic, collect, suggestion};
use crate::ir::{self, Rule};
use crate::scenario::ANY;
use crate::source::{FileId, Sources, Span};
use crate::spec::ast;
use names::{Names, Space};
use replaced::Replaced;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// A model that has passed every check; only [`check`] makes one.
#[derive(Clone, Debug)]
pub struct Checked {
    model: ir::Model,
    lonely: Vec<Diagnostic>,
    remarks: Vec<Diagnostic>,
}

impl Checked {
    pub fn model(&self) -> &ir::Model {
        &self.model
    }

    pub fn into_model(self) -> ir::Model {
        self.model
    }

    /// Roles that nobody can have because a declaration of a later file has replaced those who could: an error if the
    /// types with these roles are used.
    pub fn lonely(&self) -> &[Diagnostic] {
        &self.lonely
    }

    /// Warnings that the bounds of values give.
    pub fn remarks(&self) -> &[Diagnostic] {
        &self.remarks
    }
}

/// Checks all types of the files. A type of a later file replaces one of the same name of an earlier file.
/// `kinds` are the kinds of part, from the scenario, at least one. `None`: they could not be read, so a name that
/// nobody declares may be one of them. It is not reported, but there is no model: nothing may be wrong then.
pub fn check(
    sources: &Sources,
    files: &[(FileId, ast::File)],
    kinds: Option<&[String]>,
) -> Result<Checked, Vec<Diagnostic>> {
    let mut checker = checked(sources, files, kinds, None);
    if checker.diagnostics.is_empty() && !checker.has_taken {
        Ok(Checked { model: checker.model, lonely: checker.lonely, remarks: checker.remarks })
    } else {
        replaced::explain(sources, &checker.declarations.replaced, &mut checker.diagnostics);
        crate::diagnostic::sort(&mut checker.diagnostics);
        Err(checker.diagnostics)
    }
}

/// What the names of the files mean, as far as [`check`] understands them: of files with errors too.
pub fn names(sources: &Sources, files: &[(FileId, ast::File)], kinds: Option<&[String]>) -> Names {
    checked(sources, files, kinds, Some(Names::default())).names.unwrap_or_default()
}

fn checked<'a>(
    sources: &'a Sources,
    files: &[(FileId, ast::File)],
    kinds: Option<&[String]>,
    names: Option<Names>,
) -> Checker<'a> {
    let mut diagnostics = Vec::new();
    let declarations = declarations(files, &mut diagnostics);
    let mut checker = Checker {
        sources,
        diagnostics,
        declarations,
        model: empty_model(kinds.unwrap_or(&[ANY.into()])),
        lacks_kinds: kinds.is_none(),
        has_taken: false,
        lonely: Vec::new(),
        remarks: Vec::new(),
        broken: BTreeSet::new(),
        devices: Vec::new(),
        refused: Vec::new(),
        names,
    };
    checker.devices();
    if checker.names.is_some() {
        checker.declared();
        checker.uses_of_devices();
    }
    checker.enums();
    checker.interfaces();
    for index in 0..checker.declarations.automata.len() {
        let automaton = checker.declarations.automata[index].clone();
        automaton::check(&mut checker, &automaton);
    }
    checker.lonely_roles();
    checker
}

fn empty_model(kinds: &[String]) -> ir::Model {
    let kind = ir::Enum {
        name: "Kind".into(),
        doc: vec!["The kinds of part, from the scenario.".into()],
        members: kinds.to_vec(),
    };
    ir::Model {
        enums: vec![kind],
        interfaces: Vec::new(),
        automata: Vec::new(),
        faults: Vec::new(),
        relations: Vec::new(),
    }
}

/// The declarations that count, after replacement.
#[derive(Clone, Debug, Default)]
struct Declarations {
    enums: Vec<ast::Enum>,
    interfaces: Vec<ast::Interface>,
    automata: Vec<ast::Automaton>,
    devices: Vec<ast::Device>,
    /// Those that do not count any more.
    replaced: Vec<Replaced>,
}

fn declarations(files: &[(FileId, ast::File)], diagnostics: &mut Vec<Diagnostic>) -> Declarations {
    let mut result = Declarations::default();
    let mut seen: BTreeMap<String, (FileId, Span)> = BTreeMap::new();
    for (file, tree) in files {
        let names = (tree.enums.iter().map(|e| &e.name))
            .chain(tree.interfaces.iter().map(|i| &i.name))
            .chain(tree.automata.iter().map(|a| &a.name));
        for name in names {
            if name.value == "Kind" {
                diagnostics.push(
                    Diagnostic::new(
                        "E0301",
                        name.span,
                        "`Kind` is the name of the enumeration of the kinds of part",
                    )
                    .help("the scenario declares the kinds; choose another name"),
                );
            }
            match seen.get(&name.value) {
                Some((before, span)) if before == file => diagnostics.push(
                    Diagnostic::new("E0301", name.span, format!("`{}` is declared twice", name.value))
                        .other(*span, "first here")
                        .help("rename or remove one of them"),
                ),
                _ => {
                    seen.insert(name.value.clone(), (*file, name.span));
                }
            }
        }
        for tree in &tree.enums {
            replace(&mut result, &tree.name);
            result.enums.push(tree.clone());
        }
        for tree in &tree.interfaces {
            replace(&mut result, &tree.name);
            result.interfaces.push(tree.clone());
        }
        for tree in &tree.automata {
            replace(&mut result, &tree.name);
            result.automata.push(tree.clone());
        }
        for (index, device) in tree.devices.iter().enumerate() {
            if tree.devices[..index].iter().any(|other| other.name.value == device.name.value) {
                diagnostics.push(
                    Diagnostic::new(
                        "E0301",
                        device.name.span,
                        format!("`{}` is declared twice", device.name.value),
                    )
                    .help("rename or remove one of them"),
                );
            }
            let before = result.devices.iter().position(|other| other.name.value == device.name.value);
            if let Some(before) = before.map(|before| result.devices.remove(before)) {
                result.replaced.push(Replaced::new("device", &before.name, &device.name));
            }
            result.devices.push(device.clone());
        }
    }
    result
}

fn replace(declarations: &mut Declarations, name: &ast::Name) {
    let Declarations { enums, interfaces, automata, replaced, .. } = declarations;
    for before in enums.extract_if(.., |e| e.name.value == name.value) {
        replaced.push(Replaced::new("enumeration", &before.name, name));
    }
    for before in interfaces.extract_if(.., |i| i.name.value == name.value) {
        replaced.push(Replaced::new("interface", &before.name, name));
    }
    for before in automata.extract_if(.., |a| a.name.value == name.value) {
        replaced.push(Replaced::automaton(&before, name));
    }
}

struct Checker<'a> {
    sources: &'a Sources,
    diagnostics: Vec<Diagnostic>,
    declarations: Declarations,
    model: ir::Model,
    /// The members of `Kind` could not be read; one stands for them in the model.
    lacks_kinds: bool,
    /// A name was taken for a kind, so the model is not whole.
    has_taken: bool,
    lonely: Vec<Diagnostic>,
    remarks: Vec<Diagnostic>,
    /// Members of interfaces whose declarations have errors; something stands for them in the model.
    broken: BTreeSet<(ir::InterfaceId, String)>,
    /// Devices by name, in the order of their declarations; none for one with errors.
    devices: Vec<(String, Option<Arc<Device>>)>,
    /// Properties of interfaces that have errors.
    refused: Vec<Span>,
    /// There if somebody asks what the names mean.
    names: Option<Names>,
}

impl Checker<'_> {
    /// Whether a name that is not known may be a member of this enumeration; then nothing is reported.
    fn takes_for_kind(&mut self, id: ir::EnumId) -> bool {
        let may_be_kind = self.lacks_kinds && self.model.enums[id.0].name == "Kind";
        self.has_taken |= may_be_kind;
        may_be_kind
    }

    fn report(&mut self, diagnostic: Diagnostic) {
        collect(&mut self.diagnostics, diagnostic);
    }

    fn devices(&mut self) {
        let trees = self.declarations.devices.clone();
        let declared = trees.iter().map(|tree| (tree.name.value.as_str(), tree)).collect();
        for tree in &trees {
            let checked = device::check(tree, &declared);
            let device = checked.map_err(|found| found.into_iter().for_each(|d| self.report(d))).ok();
            if !tree.is_assembly {
                self.devices.push((tree.name.value.clone(), device));
            }
        }
    }

    fn enums(&mut self) {
        for tree in self.declarations.enums.clone() {
            let mut members: Vec<String> = Vec::new();
            for member in &tree.members {
                if members.contains(&member.value) {
                    self.report(
                        Diagnostic::new(
                            "E0301",
                            member.span,
                            format!("`{}` is a member twice", member.value),
                        )
                        .help("remove one"),
                    );
                } else {
                    members.push(member.value.clone());
                }
            }
            if members.is_empty() {
                self.report(
                    Diagnostic::new(
                        "E0302",
                        tree.name.span,
                        format!("the enumeration `{}` has no members", tree.name.value),
                    )
                    .help("write its members between the braces"),
                );
                members.push("Nothing".into());
            }
            self.model.enums.push(ir::Enum { name: tree.name.value, doc: tree.doc, members });
        }
    }

    /// Declared interfaces, then one for each automaton that shows something of its own:
    /// its name is the automaton's.
    fn interfaces(&mut self) {
        let mut declared: Vec<(ast::Interface, bool)> =
            self.declarations.interfaces.iter().map(|i| (i.clone(), true)).collect();
        for automaton in &self.declarations.automata {
            if !automaton.cells.is_empty() || self.named_as_type(&automaton.name.value) {
                let own = ast::Interface {
                    doc: automaton.doc.clone(),
                    name: automaton.name.clone(),
                    parameters: automaton.parameters.clone(),
                    cells: automaton.cells.clone(),
                    properties: Vec::new(),
                };
                declared.push((own, false));
            }
        }
        for (tree, _) in &declared {
            self.model.interfaces.push(ir::Interface {
                name: tree.name.value.clone(),
                doc: tree.doc.clone(),
                parameters: Vec::new(),
                cells: Vec::new(),
            });
        }
        for (index, (tree, is_declared)) in declared.iter().enumerate() {
            let mut names: Vec<&ast::Name> = Vec::new();
            for name in tree.parameters.iter().map(|p| &p.name).chain(tree.cells.iter().map(|c| &c.name)) {
                if *is_declared && let Some(before) = names.iter().find(|n| n.value == name.value) {
                    let diagnostic =
                        Diagnostic::new("E0301", name.span, format!("`{}` is declared twice", name.value))
                            .other(before.span, "first here")
                            .help("rename or remove one of them");
                    self.report(diagnostic);
                }
                names.push(name);
            }
            for parameter in &tree.parameters {
                let name = parameter.name.value.clone();
                let ty = self.resolve_type(&parameter.ty).unwrap_or_else(|| {
                    self.broken.insert((ir::InterfaceId(index), name.clone()));
                    ir::Type { scalar: ir::Scalar::Bool, extent: ir::Extent::One }
                });
                let doc = parameter.doc.clone();
                self.model.interfaces[index].parameters.push(ir::Variable { name, doc, ty });
            }
            for tree in &tree.cells {
                let cell = self.cell(tree).unwrap_or_else(|| {
                    let name = tree.name.value.clone();
                    self.broken.insert((ir::InterfaceId(index), name.clone()));
                    let ty = ir::Type { scalar: ir::Scalar::Bool, extent: ir::Extent::One };
                    let initial = ir::Value::Bool(false);
                    ir::Cell { name, doc: Vec::new(), ty, initial, rule: Rule::Owner }
                });
                self.model.interfaces[index].cells.push(cell);
            }
            for (number, cell) in tree.cells.iter().enumerate() {
                let rule = self.rule(cell, tree, index);
                self.model.interfaces[index].cells[number].rule = rule;
            }
        }
    }

    fn is_broken(&self, interface: ir::InterfaceId, member: &str) -> bool {
        self.broken.contains(&(interface, member.to_string()))
    }

    fn named_as_type(&self, name: &str) -> bool {
        let in_type = |ty: &ast::Type| matches!(&ty.scalar, ast::Scalar::Named(n) if n.value == name);
        self.declarations
            .interfaces
            .iter()
            .any(|i| i.parameters.iter().any(|p| in_type(&p.ty)) || i.cells.iter().any(|c| in_type(&c.ty)))
            || self.declarations.automata.iter().any(|a| {
                a.roles.iter().any(|r| r.interface.value == name || r.also.iter().any(|n| n.value == name))
                    || a.locals.iter().any(|l| in_type(&l.ty))
                    || a.cells.iter().any(|c| in_type(&c.ty))
                    || a.parameters.iter().any(|p| in_type(&p.ty))
            })
    }

    fn cell(&mut self, tree: &ast::Cell) -> Option<ir::Cell> {
        let ty = self.resolve_type(&tree.ty)?;
        let initial = self.initial(ty, tree.initial.as_ref())?;
        let rule = Rule::Owner;
        Some(ir::Cell { name: tree.name.value.clone(), doc: tree.doc.clone(), ty, initial, rule })
    }

    fn rule(&mut self, cell: &ast::Cell, interface: &ast::Interface, index: usize) -> Rule {
        match &cell.rule {
            None | Some(ast::Rule::Owner) => Rule::Owner,
            Some(ast::Rule::Handshake) => {
                self.expect_bool_cell(cell, "handshake");
                Rule::Handshake
            }
            Some(ast::Rule::Lock) => {
                self.expect_bool_cell(cell, "lock");
                Rule::Lock
            }
            Some(ast::Rule::Counter) => {
                if !matches!(cell.ty.scalar, ast::Scalar::Int { .. }) {
                    let diagnostic =
                        Diagnostic::new("E0303", cell.name.span, "a counter counts whole numbers")
                            .help("give it a type such as `int 0..12`");
                    self.report(diagnostic);
                }
                Rule::Counter
            }
            Some(ast::Rule::With(name)) => {
                self.uses(name.span, Space::OfType, &interface.name.value, &name.value);
                match interface.cells.iter().position(|c| c.name.value == name.value) {
                    Some(other) if matches!(interface.cells[other].rule, Some(ast::Rule::Token(_))) => {
                        Rule::With(other)
                    }
                    _ => {
                        let known = interface.cells.iter().map(|c| c.name.value.as_str());
                        let help = suggestion(&name.value, known)
                            .map_or("name a cell of this interface that has a `token`".into(), |n| {
                                format!("is `{n}` meant?")
                            });
                        let diagnostic = Diagnostic::new(
                            "E0303",
                            name.span,
                            format!("`{}` is not a token of `{}`", name.value, interface.name.value),
                        )
                        .help(help);
                        self.report(diagnostic);
                        Rule::Owner
                    }
                }
            }
            Some(ast::Rule::Token(sides)) => self.token(cell, sides, index),
        }
    }

    fn expect_bool_cell(&mut self, cell: &ast::Cell, rule: &str) {
        let is_plain =
            matches!(cell.initial.as_ref().map(|e| &e.kind), None | Some(ast::ExprKind::Bool(false)));
        if !matches!(cell.ty.scalar, ast::Scalar::Bool) || !is_plain {
            let diagnostic = Diagnostic::new(
                "E0303",
                cell.name.span,
                format!("a {rule} is a `bool` that begins as false"),
            )
            .help("write `bool := false`, or choose another rule");
            self.report(diagnostic);
        }
    }

    fn token(&mut self, cell: &ast::Cell, sides: &[(ast::Name, ast::Side)], interface: usize) -> Rule {
        let found = self.model.interfaces[interface].cells.iter().find(|c| c.name == cell.name.value);
        if self.is_broken(ir::InterfaceId(interface), &cell.name.value) {
            return Rule::Owner;
        }
        let Some(ir::Scalar::Enum(id)) = found.map(|c| c.ty.scalar) else {
            let diagnostic =
                Diagnostic::new("E0303", cell.name.span, "a token has the type of an enumeration")
                    .help("declare an `enum` of its values");
            self.report(diagnostic);
            return Rule::Owner;
        };
        let ir::Enum { name: of, members, .. } = self.model.enums[id.0].clone();
        for (name, _) in sides {
            self.uses(name.span, Space::OfType, &of, &name.value);
            if !members.contains(&name.value) {
                let diagnostic = Diagnostic::new(
                    "E0303",
                    name.span,
                    format!("`{}` is not a value of `{}`", name.value, cell.name.value),
                )
                .help(format!("its values are {}", members.join(", ")));
                self.report(diagnostic);
            }
        }
        let side_of = |member: &String| sides.iter().find(|(n, _)| n.value == *member).map(|(_, s)| *s);
        if let Some(missing) = members.iter().find(|m| side_of(m).is_none()) {
            let diagnostic = Diagnostic::new(
                "E0303",
                cell.name.span,
                format!("the token does not say who may write when it is `{missing}`"),
            )
            .help(format!("add `{missing}: owner` or `{missing}: others`"));
            self.report(diagnostic);
        }
        Rule::Token(members.iter().map(|m| side_of(m).unwrap_or(ast::Side::Owner)).collect())
    }
}
