//! Variables that stand outside the blocks: the system's, ports, shared cells, tables of parameters.
//!
//! A shared cell is one array over the rows of its interface, which a reference indexes: `tray_open[t]` is as
//! short as `t.open` of the specification, and nothing is copied into blocks and back. The comment at its
//! declaration says which robot has which element. Elements of arrays follow each other row by row.

use super::alarm;
use super::attributes::{Attribute, OF_WHAT_IS_SHOWN};
use super::code::Ex;
use super::context::Shared;
use super::declaration::{Basic, Variable, constants};
use super::image::Image;
use super::modes;
use super::name::Name;
use super::names::RobotNames;
use super::restart;
use super::role::Members;
use super::value::{first_value, stop_value};
use super::values::Values;
use super::version;
use super::watchdog;
use crate::ir::{AutomatonId, Extent, InterfaceId, RoleId, Scalar, Type};
use runtime_sim::device::Direction;
use std::collections::{BTreeMap, HashMap, HashSet};
use std::sync::Arc;

/// A global array and what its elements are at power-up.
pub struct Table {
    pub variable: Variable,
    pub values: Arc<Values>,
}

/// Globals by what they are.
pub struct Globals {
    pub system: Vec<Variable>,
    /// For each robot its ports.
    pub ports: Arc<Vec<Vec<Arc<Variable>>>>,
    /// Raw values at their addresses.
    pub raw: Vec<Variable>,
    pub cells: Vec<Table>,
    pub parameters: Vec<Table>,
    /// The table of alarms, an array for each column.
    pub alarms: Vec<Table>,
    /// Parameters that nothing reads.
    pub unread: Vec<Table>,
}

impl Table {
    /// The values stand in the declaration.
    pub fn declared(variable: Variable) -> Self {
        Self { variable, values: Arc::new(Values::Any(Vec::new())) }
    }
}

pub struct List<'a> {
    pub name: &'static str,
    pub about: &'static str,
    pub attributes: &'static [Attribute],
    pub variables: Vec<&'a Variable>,
    /// They outlast a loss of power.
    pub is_retained: bool,
}

impl Globals {
    pub fn new(shared: Shared, image: &Image) -> Self {
        let located = |v: Variable| Variable { address: image.located.get(&v.name).cloned(), ..v };
        Self {
            system: system(shared).into_iter().map(located).collect(),
            ports: Arc::new(ports(shared, image)),
            raw: image.raw.clone(),
            cells: cells(shared),
            parameters: parameters(shared),
            alarms: alarm::tables(shared),
            unread: Vec::new(),
        }
    }

    /// Without the cells and parameters that nothing reads or writes.
    pub fn retain(&mut self, is_used: impl Fn(&str) -> bool) {
        self.cells.retain(|table| is_used(&table.variable.name));
        self.unread = self.parameters.extract_if(.., |table| !is_used(&table.variable.name)).collect();
    }

    /// The globals as lists that have a name.
    pub fn lists(&self) -> Vec<List<'_>> {
        fn tables(tables: &[Table]) -> Vec<&Variable> {
            tables.iter().map(|table| &table.variable).collect()
        }
        fn list<'a>(
            name: &'static str,
            about: &'static str,
            attributes: &'static [Attribute],
            mut variables: Vec<&'a Variable>,
        ) -> List<'a> {
            variables.retain(|variable| !variable.is_retained);
            List { name, about, attributes, variables, is_retained: false }
        }
        let retained = self.all().filter(|variable| variable.is_retained).collect();
        let lists = [
            list(
                "GVL_System",
                "inputs and outputs of the line",
                OF_WHAT_IS_SHOWN,
                self.system.iter().collect(),
            ),
            List {
                name: "GVL_Retained",
                about: "retained values",
                attributes: OF_WHAT_IS_SHOWN,
                variables: retained,
                is_retained: true,
            },
            list("GVL_Ports", "ports of the robots", OF_WHAT_IS_SHOWN, self.ports().collect()),
            list("GVL_Raw", "raw values of the process image", &[], self.raw.iter().collect()),
            list("GVL_Cells", "shared cells", OF_WHAT_IS_SHOWN, tables(&self.cells)),
            list("GVL_Alarms", "the table of alarms", OF_WHAT_IS_SHOWN, tables(&self.alarms)),
            list("GVL_Parameters", "parameters", &[], tables(&self.parameters)),
        ];
        lists.into_iter().filter(|list| !list.variables.is_empty()).collect()
    }

    pub fn all(&self) -> impl Iterator<Item = &Variable> {
        self.system.iter().chain(self.ports()).chain(self.behind_ports())
    }

    fn all_but_ports(&self) -> impl Iterator<Item = &Variable> {
        self.system.iter().chain(self.behind_ports())
    }

    fn behind_ports(&self) -> impl Iterator<Item = &Variable> {
        let tables = self.cells.iter().chain(&self.parameters).chain(&self.alarms).map(|t| &t.variable);
        self.raw.iter().chain(tables)
    }

    fn ports(&self) -> impl Iterator<Item = &Variable> {
        self.ports.iter().flatten().map(|variable| &**variable)
    }
}

/// The globals that blocks may name, in their order, to be found by their names. Ports are given to them.
pub struct Index<'a> {
    pub globals: &'a Globals,
    all: Vec<&'a Variable>,
    numbers: HashMap<&'a str, usize>,
}

impl<'a> Index<'a> {
    pub fn new(globals: &'a Globals) -> Self {
        let all: Vec<&Variable> = globals.all_but_ports().collect();
        let numbers = all.iter().enumerate().map(|(number, variable)| (variable.name.as_str(), number));
        Self { globals, numbers: numbers.collect(), all }
    }

    /// Those that are among these.
    pub fn among(&self, names: &HashSet<Name>) -> impl Iterator<Item = &'a Variable> {
        let mut numbers: Vec<usize> =
            names.iter().filter_map(|name| self.numbers.get(name.as_str()).copied()).collect();
        numbers.sort_unstable();
        numbers.into_iter().map(|number| self.all[number])
    }
}

fn system(shared: Shared) -> Vec<Variable> {
    let variable = |name: &str, initial: Ex, about: &str| {
        let basic = match initial {
            Ex::Bool(_) => Basic::Bool,
            _ => Basic::Dint,
        };
        Variable::new(name, basic).with_initial(initial).with_comment(about)
    };
    let mut variables = vec![
        variable(
            "run_permit",
            Ex::Bool(false),
            "line input: false when the emergency stop has acted or the fieldbus is lost",
        ),
        variable("start", Ex::Bool(false), "line input: its rising edge starts the line"),
        variable("reset", Ex::Bool(false), "line input: its rising edge clears a fault"),
        variable("running", Ex::Bool(false), "line output: the line runs"),
        variable("fault", Ex::Bool(false), "line output: a fault is latched"),
        variable("fault_code", Ex::Int(0), "line output: see alarms.csv; 0 without a fault"),
        variable(
            "fault_robot",
            Ex::Int(-1),
            "line output: number of the robot in the order of the calls, the first is 0; -1 without a fault, or for one of no robot",
        ),
        variable(
            "fault_cleared",
            Ex::Bool(false),
            "a reset has cleared the fault in this scan: the time in each state begins anew",
        ),
        variable("init_done", Ex::Bool(false), "false in the first scan"),
        variable("dt_ms", Ex::Int(shared.system.scan_ms), "length of a scan, ms: the INTERVAL of the task"),
    ];
    variables.extend(watchdog::globals(shared));
    variables.extend(version::globals(shared));
    let retains = shared.system.model.retains();
    for variable in variables.iter_mut().filter(|v| matches!(v.name.as_str(), "fault_code" | "fault_robot")) {
        variable.is_retained = retains;
    }
    variables.extend(restart::variables(shared));
    if alarm::any(shared) {
        variables.extend([
            variable("alarm", Ex::Bool(false), "line output: an alarm is active, or not acknowledged"),
            variable(
                "alarm_code",
                Ex::Int(0),
                "line output: first raised alarm that is not acknowledged, see alarms.csv; 0: none",
            ),
            variable("alarm_robot", Ex::Int(-1), "line output: number of its robot; -1: none"),
            variable("scan_no", Ex::Int(0), "scans since power-up"),
        ]);
    }
    if modes::any(shared) {
        variables.push(variable(
            watchdog::PANEL_PERMIT,
            Ex::Bool(false),
            "run_permit, in a scan that is not late: without it no robot is moved by hand",
        ));
    }
    if alarm::can_stop(shared) {
        variables.push(variable("start_edge", Ex::Bool(false), "start has risen in this scan"));
    }
    variables
}

/// For each robot its ports. Those of a type differ by their names.
fn ports(shared: Shared, image: &Image) -> Vec<Vec<Arc<Variable>>> {
    let mut of_types: BTreeMap<AutomatonId, Vec<Variable>> = BTreeMap::new();
    let mut of_robot = |(robot, names): (usize, &RobotNames)| {
        let id = shared.system.instances[robot].automaton;
        let of_type = of_types.entry(id).or_insert_with(|| ports_of(shared, robot));
        let mut variables = Vec::with_capacity(of_type.len());
        variables.extend(names.ports.iter().flatten().zip(of_type).map(|(name, variable)| {
            let address = image.located.get(name).cloned();
            Arc::new(Variable { name: name.clone(), address, ..variable.clone() })
        }));
        variables
    };
    shared.names.robots.iter().enumerate().map(&mut of_robot).collect()
}

fn ports_of(shared: Shared, robot: usize) -> Vec<Variable> {
    let automaton = shared.system.automaton_of(robot);
    let names = &shared.names.robots[robot].ports;
    let mut variables = Vec::new();
    for (port, held) in automaton.device.ports.iter().zip(names) {
        let count = (port.extent != runtime_sim::device::Extent::One)
            .then(|| port.extent.elements(shared.system.kinds()));
        let word = if port.direction == Direction::Input { "input" } else { "output" };
        let said = port.about(", ");
        let said = if said.is_empty() { word.into() } else { format!("{word}: {said}") };
        let first = stop_value(port).unwrap_or(first_value(port.ty));
        for (name, first) in held.iter().zip(constants(first)) {
            let mut variable = Variable::new(name, Basic::of(Scalar::from(port.ty))).with_elements(count);
            if *name == held[0] {
                variable.comments.push(said.as_str().into());
            }
            variable.comments.extend(about(&[], elements(shared, port.extent.into())));
            let has_initial = port.direction == Direction::Output && count.is_none();
            variables.push(if has_initial { variable.with_initial(first) } else { variable });
        }
    }
    variables
}

/// `0 agv1, 1 agv2`, or `12 for each of agv1, agv2`
pub fn rows(shared: Shared, interface: InterfaceId, each: Option<usize>) -> String {
    let members: Vec<&str> = shared.system.members[interface.0]
        .iter()
        .map(|i| shared.system.instances[*i].name.as_str())
        .collect();
    match each {
        None => members.iter().enumerate().map(|(i, m)| format!("{i} {m}")).collect::<Vec<_>>().join(", "),
        Some(n) => {
            let of = |(i, m): (usize, &&str)| format!("{} {m}", i * n);
            format!("{n} each, from {}", members.iter().enumerate().map(of).collect::<Vec<_>>().join(", "))
        }
    }
}

/// The texts of [`rows`] of an interface, each once: they are as long as the line.
#[derive(Default)]
struct Rows(BTreeMap<Option<usize>, Arc<str>>);

impl Rows {
    fn of(&mut self, shared: Shared, interface: InterfaceId, each: Option<usize>) -> Arc<str> {
        self.0.entry(each).or_insert_with(|| rows(shared, interface, each).into()).clone()
    }
}

/// `0 agv1, 3 agv4`
fn named_rows(shared: Shared, interface: InterfaceId, rows: &[usize]) -> String {
    let name = |row: usize| &shared.system.instances[shared.system.members[interface.0][row]].name;
    rows.iter().map(|row| format!("{row} {}", name(*row))).collect::<Vec<_>>().join(", ")
}

fn each(shared: Shared, ty: Type) -> Option<usize> {
    (ty.extent != Extent::One).then(|| shared.system.model.elements(ty.extent))
}

/// Tables name all rows. What refers to a row of many names the first few and the last one.
const MOST_NAMED: usize = 50;
const FIRST_NAMED: usize = 3;

/// `0 agv1, 1 agv2`; of many members `0 agv1, 1 agv2, 2 agv3, ... 99 agv100`.
fn rows_in_short(shared: Shared, interface: InterfaceId) -> String {
    let count = shared.system.members[interface.0].len();
    if count <= MOST_NAMED {
        return rows(shared, interface, None);
    }
    let first = named_rows(shared, interface, &Vec::from_iter(0..FIRST_NAMED));
    format!("{first}, ... {}", named_rows(shared, interface, &[count - 1]))
}

/// The members of an enumeration by number, or to what a reference refers.
pub fn meaning(shared: Shared, scalar: Scalar) -> String {
    match scalar {
        Scalar::Enum(id) => {
            let members = &shared.system.model.enums[id.0].members;
            members.iter().enumerate().map(|(i, m)| format!("{i} {m}")).collect::<Vec<_>>().join(", ")
        }
        Scalar::Ref(id) => rows_in_short(shared, id),
        Scalar::Time => "ms".into(),
        _ => String::new(),
    }
}

/// To what the elements of an array belong that has one for each member of an enumeration.
pub fn elements(shared: Shared, extent: Extent) -> String {
    match extent {
        Extent::By(id) => format!("elements: {}", meaning(shared, Scalar::Enum(id))),
        Extent::One | Extent::Count(_) => String::new(),
    }
}

pub fn about(doc: &[String], meaning: impl Into<Arc<str>>) -> Vec<Arc<str>> {
    let text = doc.iter().map(|l| l.trim()).collect::<Vec<_>>().join(" ");
    [text.into(), meaning.into()].into_iter().filter(|t| !t.is_empty()).collect()
}

fn cells(shared: Shared) -> Vec<Table> {
    let mut tables = Vec::new();
    for (i, interface) in shared.system.model.interfaces.iter().enumerate() {
        let members = shared.system.members[i].len().max(1);
        let mut rows = Rows::default();
        for (number, (cell, held)) in
            interface.cells.iter().zip(&shared.names.interfaces[i].cells).enumerate()
        {
            let is_retained = restart::retains_cell(shared, InterfaceId(i), number);
            let n = members * shared.system.model.elements(cell.ty.extent);
            let mut comments = about(&cell.doc, rows.of(shared, InterfaceId(i), each(shared, cell.ty)));
            comments.extend(about(&[], meaning(shared, cell.ty.scalar)));
            for (name, first) in held.iter().zip(shared.constants(cell.ty.scalar, cell.initial)) {
                let variable = Variable::new(name, Basic::of(cell.ty.scalar)).with_elements(Some(n));
                let comments = if *name == held[0] { comments.clone() } else { Vec::new() };
                let variable = Variable { comments, ..variable }.retained(is_retained);
                tables.push(Table { variable, values: Arc::new(Values::Alike(Box::new(first), n)) });
            }
        }
    }
    tables
}

fn parameters(shared: Shared) -> Vec<Table> {
    let mut tables = shown(shared);
    tables.extend(relations(shared));
    for id in (0..shared.system.model.automata.len()).map(AutomatonId) {
        tables.extend(own(shared, id));
    }
    tables
}

/// Parameters that members of an interface show to others.
fn shown(shared: Shared) -> Vec<Table> {
    let mut tables = Vec::new();
    for (i, interface) in shared.system.model.interfaces.iter().enumerate() {
        let id = InterfaceId(i);
        let members = shared.system.members[i].len();
        let mut rows = Rows::default();
        for (number, (parameter, held)) in
            interface.parameters.iter().zip(&shared.names.interfaces[i].parameters).enumerate()
        {
            let values = (0..members)
                .flat_map(|row| shared.system.shown(id, row, number))
                .map(|v| shared.constants(parameter.ty.scalar, *v));
            let each = each(shared, parameter.ty);
            let comments = about(&parameter.doc, rows.of(shared, id, each));
            let of = table(parameter.ty.scalar, held, values, &comments).into_iter();
            tables.extend(of.map(|t| Table { variable: Variable { each, ..t.variable }, ..t }));
        }
    }
    tables
}

/// One array for each variable of a value.
fn table(
    scalar: Scalar,
    held: &[Name],
    values: impl Iterator<Item = Vec<Ex>> + Clone,
    comments: &[Arc<str>],
) -> Vec<Table> {
    let basic = Basic::of(scalar);
    let count = values.clone().count();
    (held.iter().enumerate())
        .map(|(part, name)| Table {
            variable: Variable {
                comments: if part == 0 { comments.to_vec() } else { Vec::new() },
                ..Variable::new(name, basic)
            }
            .with_elements(Some(count.max(1))),
            values: Arc::new(values.clone().map(|mut v| v.swap_remove(part)).collect()),
        })
        .collect()
}

fn relations(shared: Shared) -> Vec<Table> {
    let relations =
        shared.system.model.relations.iter().zip(&shared.system.reaches).zip(&shared.names.relations);
    relations
        .map(|((relation, reaches), name)| {
            let n = reaches.iter().map(Vec::len).sum::<usize>();
            let width = reaches.first().map_or(0, Vec::len);
            let comments = vec![
                "whether items get from the first robot to the second".into(),
                rows(shared, relation.from, Some(width)).into(),
                rows(shared, relation.to, None).into(),
            ];
            Table {
                variable: Variable { comments, each: Some(width), ..Variable::new(name, Basic::Bool) }
                    .with_elements(Some(n.max(1))),
                values: Arc::new(Values::Bool(reaches.iter().flatten().copied().collect())),
            }
        })
        .collect()
}

/// Arrays that robots of a type are given: one for all if they are alike, else one for each robot.
fn own(shared: Shared, id: AutomatonId) -> Vec<Table> {
    let automaton = shared.system.model.automaton(id);
    let robots = shared.instances(id);
    let mut tables = Vec::new();
    for (number, parameter) in
        automaton.parameters.iter().enumerate().filter(|(_, p)| p.ty.extent != Extent::One)
    {
        let mut comments = about(&parameter.doc, meaning(shared, parameter.ty.scalar));
        comments.extend(about(&[], elements(shared, parameter.ty.extent)));
        let is_common = !shared.names.automata[id.0].tables[number].is_empty();
        for robot in robots.iter().take(if is_common { 1 } else { usize::MAX }) {
            let held = array_names(shared, *robot, number);
            let values = &shared.system.instances[*robot].parameters[number];
            let values = values.iter().map(|v| shared.constants(parameter.ty.scalar, *v));
            tables.extend(table(parameter.ty.scalar, held, values, &comments));
        }
    }
    for (number, role) in automaton.roles.iter().enumerate() {
        let Members::Listed(most) = shared.members(id, RoleId(number)) else { continue };
        for robot in &robots {
            let list = &shared.system.instances[*robot].roles[number];
            let value = |i: usize| Ex::Int(list.get(i).map_or(0, |row| *row as i32));
            let comments = about(&role.doc, named_rows(shared, role.interface, list));
            let variable = Variable::new(&shared.names.robots[*robot].roles[number], Basic::Dint);
            tables.push(Table {
                variable: Variable { comments, ..variable }.with_elements(Some(most.max(1))),
                values: Arc::new((0..most).map(value).collect()),
            });
        }
    }
    tables
}

/// The globals that hold an array of parameters of a robot.
pub fn array_names<'a>(shared: Shared<'a>, robot: usize, parameter: usize) -> &'a [Name] {
    let id = shared.system.instances[robot].automaton;
    let table = &shared.names.automata[id.0].tables[parameter];
    if table.is_empty() { &shared.names.robots[robot].parameters[parameter] } else { table }
}
