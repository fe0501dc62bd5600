//! Cells and locals that are written and never read, or read and never written; parameters that are never read; roles that
//! are never used.

use crate::diagnostic::Diagnostic;
use crate::ir::{
    Automaton, Binder, Clause, Domain, Expr, ExprKind, InterfaceId, Model, Parameter, Place, Property, Role,
    RoleKind, TextPart, UpdateKind, Value,
};
use crate::source::{FileId, Span};
use crate::spec::ast;
use std::collections::BTreeSet;

/// A local of the automaton at hand, or a cell of any.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Variable {
    Local(usize),
    Cell(InterfaceId, usize),
}

#[derive(Default)]
struct Uses {
    read: BTreeSet<Variable>,
    written: BTreeSet<Variable>,
    /// Parameters of the automaton at hand, by their numbers.
    parameters: BTreeSet<usize>,
    /// The same of roles.
    roles: BTreeSet<usize>,
}

pub fn check(model: &Model, files: &[(FileId, ast::File)], found: &mut Vec<Diagnostic>) {
    let mut all = Uses::default();
    for automaton in &model.automata {
        let mut uses = Uses::default();
        uses.automaton(model, automaton);
        let own = automaton.parameters.iter().enumerate().filter(|(_, parameter)| parameter.is_settable());
        found.extend(
            own.filter(|(number, _)| !uses.has_parameter(automaton, *number)).map(|(_, p)| unread(p)),
        );
        uses.requires(automaton);
        let roles = automaton.roles.iter().enumerate().filter(|(_, role)| is_told_only(role));
        found.extend(roles.filter(|(number, _)| !uses.roles.contains(number)).map(|(_, role)| unused(role)));
        for (number, local) in automaton.locals.iter().enumerate() {
            let place = place(files, &automaton.name, |a| &a.locals, |local| &local.name, &local.name);
            found.extend(uses.warning("W0105", "local", &local.name, Variable::Local(number), place));
        }
        all.read.append(&mut uses.read);
        all.written.append(&mut uses.written);
    }
    // What nobody shows to others is not in use at all, as an interface of the library may be beside types of one's own.
    let is_shown = |id: usize| model.automata.iter().any(|a| a.implementing(InterfaceId(id)).is_some());
    for (id, interface) in model.interfaces.iter().enumerate().filter(|(id, _)| is_shown(*id)) {
        for (number, cell) in interface.cells.iter().enumerate() {
            let own = place(files, &interface.name, |a| &a.cells, |cell| &cell.name, &cell.name);
            let interfaces = files.iter().flat_map(|(_, file)| &file.interfaces);
            let declared = interfaces.filter(|i| i.name.value == interface.name).flat_map(|i| &i.cells);
            let declared = declared.filter(|c| c.name.value == cell.name).map(|c| c.name.span).next_back();
            let variable = Variable::Cell(InterfaceId(id), number);
            found.extend(all.warning("W0104", "cell", &cell.name, variable, own.or(declared)));
        }
    }
}

/// Where something of an automaton is declared; none if it is in no text.
fn place<T>(
    files: &[(FileId, ast::File)],
    automaton: &str,
    list: fn(&ast::Automaton) -> &Vec<T>,
    name: fn(&T) -> &ast::Name,
    wanted: &str,
) -> Option<Span> {
    let automata = files.iter().flat_map(|(_, file)| &file.automata);
    let declared = automata.filter(|a| a.name.value == automaton).flat_map(|a| list(a).iter().map(name));
    declared.filter(|name| name.value == wanted).map(|name| name.span).last()
}

fn unread(parameter: &Parameter) -> Diagnostic {
    let message = format!("the parameter `{}` is never read", parameter.name);
    Diagnostic::new("W0108", parameter.place, message)
        .note("whatever the layout sets, the machine does the same; `require` does not count")
        .help("use it, or remove it")
}

/// Roles of the other kinds decide who hands over to whom.
fn is_told_only(role: &Role) -> bool {
    matches!(role.kind, RoleKind::Knows | RoleKind::Serves)
}

fn unused(role: &Role) -> Diagnostic {
    Diagnostic::new("W0116", role.place, format!("the role `{}` is never used", role.name))
        .note("the machine does the same whoever its members are")
        .help("use it, or remove it; `require` with `count` says how many there have to be")
}

impl Uses {
    /// Others may read a parameter that an interface shows.
    fn has_parameter(&self, automaton: &Automaton, number: usize) -> bool {
        let mut shown = automaton.implements.iter().flat_map(|implements| &implements.parameters);
        self.parameters.contains(&number) || shown.any(|shown| *shown == number)
    }

    fn warning(
        &self,
        code: &'static str,
        what: &str,
        name: &str,
        variable: Variable,
        place: Option<Span>,
    ) -> Option<Diagnostic> {
        let (wrong, help) = match (self.read.contains(&variable), self.written.contains(&variable)) {
            (true, true) => return None,
            (true, false) => (
                "keeps its first value: nothing else is written to it",
                "write to it where it has to change; if it never has to, read its value instead, as it stands or by a `define`, and remove it",
            ),
            (false, true) => (
                "is never read",
                "read it where it matters, or remove it and what is written to it; what people should see is an output on a `display`",
            ),
            (false, false) => ("is never used", "use it, or remove it"),
        };
        let message = format!("the {what} `{name}` {wrong}");
        Some(Diagnostic::new(code, place?, message).help(help))
    }

    fn automaton(&mut self, model: &Model, automaton: &Automaton) {
        automaton.defines.iter().for_each(|define| self.expr(&define.value));
        automaton.properties.iter().flat_map(Property::exprs).for_each(|expr| self.expr(expr));
        for state in &automaton.states {
            state.within.iter().for_each(|(longest, _)| self.expr(longest));
            for transition in &state.transitions {
                transition.clauses.iter().for_each(|clause| self.clause(clause));
                transition.updates.iter().for_each(|update| self.update(model, automaton, &update.kind));
            }
        }
    }

    fn requires(&mut self, automaton: &Automaton) {
        for require in &automaton.requires {
            self.expr(&require.condition);
            for part in &require.text {
                if let TextPart::Value(value) = part {
                    self.expr(value);
                }
            }
        }
    }

    fn clause(&mut self, clause: &Clause) {
        match clause {
            Clause::Condition(condition) => self.expr(condition),
            Clause::Bind(Binder { domain, condition, key, .. }) => {
                if let Domain::Range(low, high) = domain {
                    self.expr(low);
                    self.expr(high);
                }
                self.domain(domain);
                condition.iter().chain(key).for_each(|expr| self.expr(expr));
            }
        }
    }

    /// A variable to which its first value is written keeps it.
    fn update(&mut self, model: &Model, automaton: &Automaton, update: &UpdateKind) {
        match update {
            UpdateKind::Assign { target, value, .. } | UpdateKind::Fill { target, value, .. } => {
                let first = match &target.place {
                    Place::Local { local, .. } => Some(automaton.locals[*local].initial),
                    Place::Cell { interface, cell, .. } => {
                        Some(model.interfaces[interface.0].cells[*cell].initial)
                    }
                    _ => None,
                };
                match first.is_some() && constant(automaton, value) == first {
                    true => target.place.parts().for_each(|part| self.expr(part)),
                    false => self.write(&target.place),
                }
                self.value(value, &target.place);
            }
            UpdateKind::Copy { target, source, .. } => {
                self.write(&target.place);
                self.read(source);
            }
            UpdateKind::Command { arguments, .. } => arguments.iter().for_each(|a| self.expr(&a.value)),
        }
    }

    /// What is counted up or down is not read by that.
    fn value(&mut self, value: &Expr, target: &Place) {
        match &value.kind {
            ExprKind::Binary(_, old, by) if old.kind == ExprKind::Read(target.clone()) => self.expr(by),
            _ => self.expr(value),
        }
    }

    fn expr(&mut self, expr: &Expr) {
        if let ExprKind::Read(place) = &expr.kind {
            self.read.extend(variable(place));
            if let Place::Parameter { parameter, .. } = place {
                self.parameters.insert(*parameter);
            }
        }
        match &expr.kind {
            ExprKind::Members(role) | ExprKind::IsMember(_, role) => {
                self.roles.insert(role.0);
            }
            ExprKind::Exists { domain, .. }
            | ExprKind::Forall { domain, .. }
            | ExprKind::Count { domain, .. }
            | ExprKind::Sum { domain, .. } => self.domain(domain),
            _ => {}
        }
        expr.parts().for_each(|part| self.expr(part));
    }

    fn domain(&mut self, domain: &Domain) {
        if let Domain::Role(role) = domain {
            self.roles.insert(role.0);
        }
    }

    fn read(&mut self, place: &Place) {
        self.read.extend(variable(place));
        place.parts().for_each(|part| self.expr(part));
    }

    fn write(&mut self, place: &Place) {
        self.written.extend(variable(place));
        place.parts().for_each(|part| self.expr(part));
    }
}

/// The value of a constant, through definitions too.
fn constant(automaton: &Automaton, expr: &Expr) -> Option<Value> {
    match &expr.kind {
        ExprKind::Constant(value) => Some(*value),
        ExprKind::Define(define) => constant(automaton, &automaton.defines[*define].value),
        _ => None,
    }
}

fn variable(place: &Place) -> Option<Variable> {
    match place {
        Place::Local { local, .. } => Some(Variable::Local(*local)),
        Place::Cell { interface, cell, .. } => Some(Variable::Cell(*interface, *cell)),
        Place::Port { .. } | Place::Parameter { .. } | Place::Shown { .. } => None,
    }
}
