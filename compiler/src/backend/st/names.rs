//! The identifiers of one system in Structured Text.

use super::alarm::OLDEST_ACKNOWLEDGED;
use super::declaration::suffixes;
use super::name::Name;
use super::restart::{KEPT, VALUES_OF};
use super::role::{self, Members};
use super::walk;
use super::watchdog::PANEL_PERMIT;
use crate::device::Port;
use crate::ir::{
    Automaton, AutomatonId, Domain, Enum, Expr, ExprKind, Extent, Instance, Interface, RoleId, Scalar,
    System, Type,
};
use crate::naming::st::{Renamed, Scope};
use crate::naming::{camel, snake};
use std::collections::BTreeMap;
use std::ops::Deref;

const TAKEN: &[&str] = &[
    "F_following",
    "F_next_command",
    "F_limit",
    "F_lesser",
    "F_greater",
    "F_lesser_real",
    "F_greater_real",
    "F_magnitude",
    "F_is_finite",
    "F_is_finite_point",
    "F_absolute",
    "F_squared_distance",
    "F_rounded",
    "F_real",
    "MAIN",
    "FB_Layout",
    "FB_Watchdog",
    "GVL_System",
    "GVL_Retained",
    "GVL_Constants",
    "GVL_Ports",
    "GVL_Raw",
    "GVL_Cells",
    "GVL_Alarms",
    "GVL_Parameters",
    "Config0",
    "Res0",
    "Scan",
    "Main_program",
    "run_permit",
    "start",
    "reset",
    "running",
    "fault",
    "fault_code",
    "fault_robot",
    "fault_cleared",
    "alarm",
    "alarm_code",
    "alarm_robot",
    "alarms_acknowledged",
    "alarms_active",
    "alarms_code",
    "alarms_count",
    "alarms_first",
    "alarms_last",
    "alarms_robot",
    "alarms",
    "ST_Alarm",
    "ST_Point",
    "robot_stopped",
    "scan_no",
    "start_edge",
    PANEL_PERMIT,
    "init_done",
    "dt_ms",
    "clock_ms",
    "late_ms",
    "tool_version",
    "program_hash",
    "warm_start",
    "retained_of",
    "retained_whole",
];
/// The counter over the elements of an array.
pub const ELEMENT: &str = "element_no";
const LOCAL: &[&str] = &["robot", "state", "elapsed", "done", "failed", "found", KEPT, ELEMENT];
const PROGRAM: &[&str] = &[
    VALUES_OF,
    "start_now",
    "reset_now",
    "start_before",
    "reset_before",
    "had_fault",
    "layout",
    "watchdog",
    "oldest",
    OLDEST_ACKNOWLEDGED,
    ELEMENT,
    ROUNDED,
];
/// A raw value before it becomes one of its narrow type.
pub const ROUNDED: &str = "rounded";

pub struct Names {
    pub enums: Vec<EnumNames>,
    /// Of each device that has robots and commands.
    pub commands: BTreeMap<String, EnumNames>,
    pub interfaces: Vec<InterfaceNames>,
    pub relations: Vec<Name>,
    pub automata: Vec<AutomatonNames>,
    pub robots: Vec<RobotNames>,
    /// The entries of the table of alarms before those of each robot.
    pub alarms_before: Vec<usize>,
    /// The names of MAIN, for raw variables.
    pub program: Scope,
    /// What could not stay as it was, with the unit in which it stands.
    pub renamed: Vec<(String, Renamed)>,
}

pub struct EnumNames {
    pub ty: String,
    pub members: Vec<String>,
    pub values: Vec<i32>,
}

/// The variables that hold one value: one, or three for a point.
#[derive(Default)]
pub struct Held {
    names: Vec<Name>,
    /// Of a point, where it is one variable: a structure.
    pub whole: Option<Name>,
}

impl<'a> IntoIterator for &'a Held {
    type Item = &'a Name;
    type IntoIter = std::slice::Iter<'a, Name>;

    fn into_iter(self) -> Self::IntoIter {
        self.names.iter()
    }
}

impl Deref for Held {
    type Target = Vec<Name>;

    fn deref(&self) -> &Vec<Name> {
        &self.names
    }
}

#[derive(Default)]
pub struct InterfaceNames {
    /// The array of its rows and the type of one, where they are structures.
    pub rows: Name,
    pub structure: String,
    /// The cells as fields of it.
    pub fields: Vec<Name>,
    pub cells: Vec<Held>,
    pub parameters: Vec<Held>,
}

pub struct AutomatonNames {
    pub block: String,
    /// The block that looks at its properties.
    pub properties: String,
    /// The enumeration of the states, and its members.
    pub states: EnumNames,
    pub parameters: Vec<Held>,
    /// Arrays of parameters that are alike for all robots of the type.
    pub tables: Vec<Held>,
    pub roles: Vec<RoleNames>,
    /// The own row in each interface.
    pub rows: Vec<Name>,
    pub locals: Vec<Held>,
    pub defines: Vec<Held>,
    pub ports: Vec<Held>,
    pub variables: Vec<Name>,
    /// For temporary variables.
    pub scope: Scope,
}

pub struct RoleNames {
    pub members: Name,
    pub count: Name,
}

pub struct RobotNames {
    pub instance: Name,
    pub properties: Name,
    pub ports: Vec<Held>,
    pub parameters: Vec<Held>,
    pub roles: Vec<Name>,
}

pub fn names(system: &System) -> Names {
    let model = &system.model;
    let mut global = Scope::new(TAKEN);
    let mut renamed = Vec::new();
    let enums: Vec<_> = model.enums.iter().map(|e| enum_names(e, &mut global, &mut renamed)).collect();
    let blocks: Vec<_> = (model.automata.iter())
        .map(|a| {
            let block = global.take(&format!("FB_{}", camel(&a.name)));
            let properties = global.take(&format!("FB_{}_properties", camel(&a.name)));
            (block, properties, states(a, &mut global, &mut renamed))
        })
        .collect();
    let mut interfaces: Vec<_> = model.interfaces.iter().map(|i| interface_names(i, &mut global)).collect();
    let relations = (model.relations.iter())
        .map(|r| {
            let (from, to) = (model.interface(r.from), model.interface(r.to));
            global.take(&format!("{}_reaches_{}", snake(&from.name), snake(&to.name))).into()
        })
        .collect();
    let tables: Vec<_> =
        (0..blocks.len()).map(|id| table_names(system, AutomatonId(id), &mut global)).collect();
    let members: Vec<Vec<Members>> = (system.model.automata.iter().enumerate())
        .map(|(id, a)| {
            (0..a.roles.len()).map(|r| role::members(system, AutomatonId(id), RoleId(r))).collect()
        })
        .collect();
    let robots: Vec<_> = (system.instances.iter())
        .map(|i| robot_names(system, i, &tables[i.automaton.0], &members[i.automaton.0], &mut global))
        .collect();
    for (source, names) in model.interfaces.iter().zip(&mut interfaces).filter(|(i, _)| !i.cells.is_empty()) {
        structure_names(source, names, &mut global, &mut renamed);
    }
    let commands = commands(system, &mut global, &mut renamed);
    // A block declares the globals that it uses beside its own variables.
    let automata: Vec<_> = (blocks.into_iter().zip(tables).enumerate())
        .map(|(id, (names, tables))| {
            automaton_names(system, AutomatonId(id), names, tables, &global, &mut renamed)
        })
        .collect();
    let mut program = global.inner();
    PROGRAM.iter().for_each(|name| drop(program.take(name)));
    let robots = (robots.into_iter().zip(&system.instances))
        .map(|(robot, i)| RobotNames {
            instance: program.take(&i.name).into(),
            properties: program.take(&format!("{}_properties", i.name)).into(),
            ..robot
        })
        .collect();
    let log = |unit: &str, scope: &Scope| -> Vec<_> {
        scope.renamed().iter().map(|r| (unit.to_string(), r.clone())).collect()
    };
    renamed.extend(log("globals", &global));
    renamed.extend(log("MAIN", &program));
    let alarms_before = alarms_before(system);
    Names { enums, commands, interfaces, relations, automata, robots, alarms_before, program, renamed }
}

fn alarms_before(system: &System) -> Vec<usize> {
    let counts: Vec<usize> = system.model.automata.iter().map(|a| a.alarms().count()).collect();
    let mut sum = 0;
    let mut before = |instance: &Instance| {
        let before = sum;
        sum += counts[instance.automaton.0];
        before
    };
    system.instances.iter().map(&mut before).collect()
}

fn enum_names(source: &Enum, global: &mut Scope, renamed: &mut Vec<(String, Renamed)>) -> EnumNames {
    members(global.take(&format!("E_{}", camel(&source.name))), source.members.iter().cloned(), renamed)
}

fn members(
    ty: String,
    wanted: impl Iterator<Item = String>,
    renamed: &mut Vec<(String, Renamed)>,
) -> EnumNames {
    let mut scope = Scope::default();
    let members: Vec<String> = wanted.map(|member| scope.take(&member)).collect();
    renamed.extend(scope.renamed().iter().map(|r| (ty.clone(), r.clone())));
    let values = (0..).take(members.len()).collect();
    EnumNames { ty, members, values }
}

/// The commands of the devices that have robots, by the name of the device.
fn commands(
    system: &System,
    global: &mut Scope,
    renamed: &mut Vec<(String, Renamed)>,
) -> BTreeMap<String, EnumNames> {
    let mut known = BTreeMap::new();
    for instance in &system.instances {
        let device = &system.model.automaton(instance.automaton).device;
        if device.verbs.is_empty() || known.contains_key(&device.name) {
            continue;
        }
        let ty = global.take(&format!("E_{}Command", camel(&device.name)));
        let names = members(ty, device.verbs.iter().map(|verb| verb.name.clone()), renamed);
        let values = device.verbs.iter().map(|verb| verb.number).collect();
        known.insert(device.name.clone(), EnumNames { values, ..names });
    }
    known
}

fn states(automaton: &Automaton, global: &mut Scope, renamed: &mut Vec<(String, Renamed)>) -> EnumNames {
    let wanted = automaton.states.iter().map(|s| s.name.replace('.', "_"));
    members(global.take(&format!("E_{}State", camel(&automaton.name))), wanted, renamed)
}

fn held(scope: &mut Scope, wanted: &str, scalar: Scalar) -> Held {
    let names = scope.take_all(wanted, suffixes(scalar));
    let beginning = names[0].strip_suffix("_x").filter(|_| scalar == Scalar::Point);
    let whole = beginning.map(|beginning| scope.take_whole(wanted, beginning).into());
    Held { names: names.into_iter().map(Name::from).collect(), whole }
}

fn interface_names(source: &Interface, global: &mut Scope) -> InterfaceNames {
    let mut take = |name: &str, ty: Type| held(global, &format!("{}_{name}", snake(&source.name)), ty.scalar);
    InterfaceNames {
        cells: source.cells.iter().map(|c| take(&c.name, c.ty)).collect(),
        parameters: source.parameters.iter().map(|p| take(&p.name, p.ty)).collect(),
        ..InterfaceNames::default()
    }
}

/// The names of what an interface is where there are structures.
fn structure_names(
    source: &Interface,
    names: &mut InterfaceNames,
    global: &mut Scope,
    renamed: &mut Vec<(String, Renamed)>,
) {
    names.rows = global.take(&format!("{}_cells", snake(&source.name))).into();
    names.structure = global.take(&format!("ST_{}", camel(&source.name)));
    let mut scope = Scope::new(&[KEPT]);
    names.fields = source.cells.iter().map(|cell| scope.take(&cell.name).into()).collect();
    renamed.extend(scope.renamed().iter().map(|r| (names.structure.clone(), r.clone())));
}

/// Arrays of parameters that all robots of a type have alike.
fn table_names(system: &System, id: AutomatonId, global: &mut Scope) -> Vec<Held> {
    let source = system.model.automaton(id);
    let prefix = snake(&source.name);
    (source.parameters.iter().enumerate())
        .map(|(i, p)| match role::is_alike(system, id, i) {
            true => held(global, &format!("{prefix}_{}", p.name), p.ty.scalar),
            false => Held::default(),
        })
        .collect()
}

fn automaton_names(
    system: &System,
    id: AutomatonId,
    (block, properties, states): (String, String, EnumNames),
    tables: Vec<Held>,
    global: &Scope,
    renamed: &mut Vec<(String, Renamed)>,
) -> AutomatonNames {
    let source = system.model.automaton(id);
    let mut scope = global.inner();
    LOCAL.iter().chain(&super::property::LOCAL).for_each(|name| drop(scope.take(name)));
    let parameters = source.parameters.iter().map(|p| held(&mut scope, &p.name, p.ty.scalar)).collect();
    let port = |p: &Port, scope: &mut Scope| held(scope, &p.name, Scalar::from(p.ty));
    let ports = source.device.ports.iter().map(|p| port(p, &mut scope)).collect();
    let locals = source.locals.iter().map(|l| held(&mut scope, &l.name, l.ty.scalar)).collect();
    let roles = (source.roles.iter())
        .map(|r| {
            let names = scope.take_all(&r.name, &["", "_count"]);
            RoleNames { members: Name::from(&names[0]), count: Name::from(&names[1]) }
        })
        .collect();
    let rows = (source.implements.iter())
        .map(|i| scope.take(&format!("own_{}", snake(&system.model.interface(i.interface).name))).into())
        .collect();
    let defines = source.defines.iter().map(|d| held(&mut scope, &d.name, d.ty)).collect();
    let variables = variables(source, &mut scope);
    renamed.extend(scope.renamed().iter().map(|r| (block.clone(), r.clone())));
    AutomatonNames {
        block,
        properties,
        states,
        parameters,
        tables,
        roles,
        rows,
        locals,
        defines,
        ports,
        variables,
        scope,
    }
}

/// Variables of one name never meet within a transition, so they share the identifier. Those of a `define` too, if it is
/// computed before the loops of guards only; others are computed while a transition's are in use. A point is computed
/// where it is read.
fn variables(source: &Automaton, scope: &mut Scope) -> Vec<Name> {
    let mut owners = vec![0; source.variables.len()];
    for (i, define) in source.defines.iter().enumerate() {
        if define.ty == Scalar::Point || !walk::is_for_guards_only(source, i) {
            own(&define.value, i + 1, &mut owners);
        }
    }
    let mut known: BTreeMap<(usize, &str), Name> = BTreeMap::new();
    let mut order: Vec<usize> = (0..owners.len()).collect();
    order.sort_by_key(|i| owners[*i]);
    for i in order {
        let wanted = &source.variables[i].name;
        known.entry((owners[i], wanted)).or_insert_with(|| scope.take(wanted).into());
    }
    (source.variables.iter().zip(&owners))
        .map(|(v, owner)| known[&(*owner, v.name.as_str())].clone())
        .collect()
}

fn own(expr: &Expr, owner: usize, owners: &mut [usize]) {
    if let ExprKind::Exists { variable, domain, .. }
    | ExprKind::Forall { variable, domain, .. }
    | ExprKind::Count { variable, domain, .. }
    | ExprKind::Sum { variable, domain, .. } = &expr.kind
    {
        owners[variable.0] = owner;
        if let Domain::Range(low, high) = &**domain {
            own(low, owner, owners);
            own(high, owner, owners);
        }
    }
    expr.parts().for_each(|part| own(part, owner, owners));
}

/// `tables` are the arrays that all robots of its type have alike, `members` those of its type's roles.
fn robot_names(
    system: &System,
    robot: &Instance,
    tables: &[Held],
    members: &[Members],
    global: &mut Scope,
) -> RobotNames {
    let automaton = system.model.automaton(robot.automaton);
    let own = |part: &str| format!("{}_{part}", robot.name);
    let ports =
        automaton.device.ports.iter().map(|p| held(global, &own(&p.name), Scalar::from(p.ty))).collect();
    let parameters = (automaton.parameters.iter().enumerate())
        .map(|(i, p)| match p.ty.extent != Extent::One && tables[i].is_empty() {
            true => held(global, &own(&p.name), p.ty.scalar),
            false => Held::default(),
        })
        .collect();
    let roles = (automaton.roles.iter().zip(members))
        .map(|(r, members)| match members {
            Members::Listed(_) => global.take(&own(&r.name)).into(),
            Members::All(_) => Name::default(),
        })
        .collect();
    RobotNames { instance: Name::default(), properties: Name::default(), ports, parameters, roles }
}
