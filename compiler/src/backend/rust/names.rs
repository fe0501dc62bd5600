//! The identifiers of one system in Rust.

use crate::ir::{Automaton, Clause, Enum, Interface, Relation, State, System, Transition};
use crate::naming::{NO_FILES, Scope, camel, screaming, snake};

/// Types that generated modules have beside those of the specification.
const TYPES: &[&str] = &[
    "A",
    "Add",
    "Alarm",
    "Array",
    "B",
    "C",
    "Cells",
    "Fault",
    "FromStr",
    "Image",
    "Index",
    "IndexMut",
    "Inputs",
    "Iter",
    "Kept",
    "Latch",
    "Layout",
    "Leaked",
    "N",
    "Output",
    "Outputs",
    "Parameters",
    "Point",
    "Put",
    "R",
    "Read",
    "Reader",
    "Reference",
    "Relation",
    "Robot",
    "Rows",
    "Session",
    "State",
    "Sub",
    "System",
    "SystemInputs",
    "SystemOutputs",
    "T",
    "Table",
    "Verb",
    "Wiring",
    "Words",
    "Retained",
    "Memory",
    "Deployed",
];
/// Modules and crates, and primitive types.
const MODULES: &[&str] = &[
    "alarm",
    "bool",
    "f64",
    "i32",
    "lib",
    "main",
    "retained",
    "runtime_sim",
    "str",
    "u16",
    "u8",
    "usize",
    "cells",
    "core",
    "kinds",
    "line",
    "robot",
    "robots",
    "std",
    "system",
    "types",
    "controllers",
    "commissioning",
];
const FIELDS: &[&str] = &["parameters", "inputs", "outputs", "state", "elapsed", "alarms", "stopped"];
const METHODS: &[&str] = &[
    "new",
    "step",
    "observe_anew",
    "properties",
    "check_others",
    "put_out",
    "stay",
    "published",
    "limit",
    "enter",
    "command",
    "command_done",
    "command_failed",
    "operate",
    "begin_anew",
    "is_single",
    "forget",
    "retain",
    "restore",
    "fmt",
    "clone",
    // Those of the prelude that take everything by value.
    "into",
    "try_into",
];
const PARAMETERS: &[&str] = &["name"];
const VARIABLES: &[&str] = &[
    "at_rest",
    "best",
    "cells",
    "chosen",
    "element",
    "greater",
    "holds",
    "kept",
    "key",
    "least",
    "lesser",
    "next_command",
    "place",
    "put",
    "quotient",
    "remainder",
    "row",
    "scan",
    "source",
    "start",
    "store_point",
    "store_real",
    "store_whole",
    "sum",
    "value",
    "waited",
    "wiring",
    "within",
    "words",
];
/// Fields of the wiring. No variable is named as an interface: generated code puts `rows_of_` before it.
const CELLS: &[&str] = &["retained_of", "scan_ms"];
const CONSTANTS: &[&str] = &["MEMORY", "ROBOTS", "WIRING"];

pub struct Names {
    pub enums: Vec<EnumNames>,
    pub interfaces: Vec<InterfaceNames>,
    pub relations: Vec<String>,
    pub automata: Vec<AutomatonNames>,
    /// Constants of the robots, each in the module of its type.
    pub robots: Vec<String>,
}

pub struct EnumNames {
    pub ty: String,
    pub members: Vec<String>,
}

pub struct InterfaceNames {
    /// In `Cells` and `Wiring`.
    pub field: String,
    pub reference: String,
    pub cells: String,
    pub parameters: String,
    pub cell: Vec<String>,
    pub parameter: Vec<String>,
    /// Constant of the line.
    pub constant: String,
}

pub struct AutomatonNames {
    pub module: String,
    pub ty: String,
    pub parameters: Vec<String>,
    pub roles: Vec<String>,
    /// The own row in each interface that is implemented.
    pub rows: Vec<String>,
    pub locals: Vec<String>,
    pub defines: Vec<String>,
    pub states: Vec<String>,
    /// The method of each state.
    pub methods: Vec<String>,
    /// For each state and transition the method that chooses the values of its binders.
    pub choices: Vec<Vec<String>>,
    pub ports: Vec<String>,
    pub verbs: Vec<String>,
    pub variables: Vec<String>,
}

pub fn names(system: &System) -> Names {
    let model = &system.model;
    let mut types = Scope::rust(TYPES);
    let enums = model.enums.iter().map(|e| enum_names(e, &mut types)).collect();
    let mut fields = Scope::rust(CELLS);
    let mut constants = Scope::rust(CONSTANTS);
    let interfaces: Vec<_> = (model.interfaces.iter())
        .map(|i| interface_names(i, &mut types, &mut fields, &mut constants))
        .collect();
    let relation =
        |r: &Relation| format!("{}_reaches_{}", interfaces[r.from.0].field, interfaces[r.to.0].field);
    let relations = model.relations.iter().map(|r| fields.take(relation(r))).collect();
    let mut modules = Scope::rust(&[MODULES, NO_FILES].concat());
    let automata =
        model.automata.iter().map(|a| automaton_names(a, &interfaces, &mut types, &mut modules)).collect();
    let mut robots = Scope::rust(&[]);
    let robots = system.instances.iter().map(|i| robots.take(screaming(&i.name))).collect();
    Names { enums, interfaces, relations, automata, robots }
}

fn enum_names(source: &Enum, types: &mut Scope) -> EnumNames {
    let mut members = Scope::rust(&[]);
    EnumNames {
        ty: types.take(camel(&source.name)),
        members: source.members.iter().map(|m| members.take(camel(m))).collect(),
    }
}

fn interface_names(
    source: &Interface,
    types: &mut Scope,
    fields: &mut Scope,
    constants: &mut Scope,
) -> InterfaceNames {
    let name = camel(&source.name);
    let (mut cell, mut parameter) = (Scope::rust(&[]), Scope::rust(&[]));
    InterfaceNames {
        field: fields.take(snake(&source.name)),
        reference: types.take(format!("{name}Ref")),
        cells: types.take(format!("{name}Cells")),
        parameters: types.take(format!("{name}Parameters")),
        cell: source.cells.iter().map(|c| cell.take(snake(&c.name))).collect(),
        parameter: source.parameters.iter().map(|p| parameter.take(snake(&p.name))).collect(),
        constant: constants.take(screaming(&source.name)),
    }
}

fn automaton_names(
    source: &Automaton,
    interfaces: &[InterfaceNames],
    types: &mut Scope,
    modules: &mut Scope,
) -> AutomatonNames {
    let mut parameters = Scope::rust(PARAMETERS);
    let mut methods = Scope::rust(METHODS);
    let (mut locals, mut states) = (Scope::rust(FIELDS), Scope::rust(&[]));
    let (mut ports, mut verbs) = (Scope::rust(&[]), Scope::rust(&[]));
    let method_of = |methods: &mut Scope, name: &str| methods.take(snake(name));
    AutomatonNames {
        module: modules.take(snake(&source.name)),
        ty: types.take(camel(&source.name)),
        parameters: source.parameters.iter().map(|p| parameters.take(snake(&p.name))).collect(),
        roles: source.roles.iter().map(|r| parameters.take(snake(&r.name))).collect(),
        rows: source
            .implements
            .iter()
            .map(|i| parameters.take(format!("as_{}", interfaces[i.interface.0].field)))
            .collect(),
        locals: source.locals.iter().map(|l| locals.take(snake(&l.name))).collect(),
        defines: source.defines.iter().map(|d| method_of(&mut methods, &d.name)).collect(),
        states: source.states.iter().map(|s| states.take(camel(&s.name))).collect(),
        methods: source.states.iter().map(|s| method_of(&mut methods, &s.name)).collect(),
        choices: source.states.iter().map(|s| choices(s, &mut methods)).collect(),
        ports: source.device.ports.iter().map(|p| ports.take(snake(&p.name))).collect(),
        verbs: source.device.verbs.iter().map(|v| verbs.take(camel(&v.name))).collect(),
        variables: variables(source),
    }
}

/// Transitions without binders have none.
fn choices(state: &State, methods: &mut Scope) -> Vec<String> {
    let is_binder = |clause: &Clause| matches!(clause, Clause::Bind(_));
    let name = format!("choose_in_{}", snake(&state.name));
    let mut choice = |t: &Transition| {
        if t.clauses.iter().any(is_binder) { methods.take(name.clone()) } else { String::new() }
    };
    state.transitions.iter().map(&mut choice).collect()
}

/// Variables of one name never meet, so they may share the identifier.
fn variables(source: &Automaton) -> Vec<String> {
    let mut scope = Scope::rust(VARIABLES);
    // Searches within others have numbers.
    let binders = |t: &Transition| t.clauses.iter().filter(|c| matches!(c, Clause::Bind(_))).count();
    let deepest = source.states.iter().flat_map(|s| &s.transitions).map(binders).max().unwrap_or(0);
    for rank in 2..=deepest {
        scope.take(format!("best{rank}"));
        scope.take(format!("key{rank}"));
    }
    let mut known: Vec<(&str, String)> = Vec::new();
    for variable in &source.variables {
        if !known.iter().any(|(name, _)| *name == variable.name) {
            known.push((&variable.name, scope.take(snake(&variable.name))));
        }
    }
    let find =
        |name: &str| known.iter().find(|(n, _)| *n == name).map(|(_, i)| i.clone()).unwrap_or_default();
    source.variables.iter().map(|v| find(&v.name)).collect()
}
