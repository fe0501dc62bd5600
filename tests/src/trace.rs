//! Hand-written traces: a specification, a small system, inputs scan by scan and what must come out.
//!
//! A file has three parts, each headed by a line `== spec`, `== layout`, `== scans`.
//! `#` begins a comment in the last two. The layout is given directly, without
//! geometry:
//!
//! ```text
//! scan_ms 20                      # 10 if it is left out
//! kinds bolt nut                  # `part` if it is left out
//! a1: Lamp limit=3 wait=500       # instance, type, parameters and device constants (0 if left out)
//! a1.others = b1 c1               # members of a role; `knows` has all others if it is left out
//! reaches a1 b1                   # items get from a1 to b1
//! panel machines                  # each machine has a panel
//! ```
//!
//! A scan begins with a line `scan`, behind it those of `permit start reset` that
//! are true, and `power` if power was lost before it; `run N` stands for N scans that are not compared. Then, as needed:
//!
//! ```text
//! in a1.ack=1 a1.error=2          # input ports; they stay so
//! out running                     # or `stopped`, or `fault a1 TEXT`: the fault whose description has TEXT
//! a1 Waiting 20 n=3 slot[1]=Full  # state, elapsed ms, and what has changed: locals, cells, outputs before masking
//! image a1.hold=1                 # an output as published; without a panel only what the table of devices says
//! alarm a1 TEXT                   # the alarm that is told, or `none`
//! ```
//!
//! What properties keep is `property1_waited` and the like, an alarm `alarm1_count` and the like, and `stopped`.
//!
//! What is not written has not changed; an instance without a line has changed in
//! nothing, its elapsed time included. Everything is compared in every scan, and
//! published outputs with the stop values of the table of devices too.
//! Times are in ms, points `(x,y,z)`, references names of instances, arrays
//! `[a,b,c]` or one value for all elements.

use crate::plain;
use autogen::ir::{self, InterfaceId, RoleKind, Scalar, Value};
use autogen::layout::Panel;
use autogen::source::Sources;
use autogen::{check, device, lower, spec};
use runtime_sim::device::{Direction, Stop};
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};

/// A trace, ready to be run on any engine.
pub struct Fixture {
    pub sources: Sources,
    pub system: ir::System,
    pub scans: Vec<Scan>,
}

/// One scan: what comes in, and what must come out unless it is not compared.
pub struct Scan {
    pub line: usize,
    /// Power was lost before it, and is back.
    pub powers_up: bool,
    pub system: SystemInputs,
    pub inputs: Vec<Vec<f64>>,
    pub expected: Option<Expected>,
}

pub struct Expected {
    pub outputs: SystemOutputs,
    /// As [`Controllers::trace`] gives it.
    pub trace: Vec<f64>,
    /// Published images.
    pub images: Vec<Vec<f64>>,
}

/// Runs an engine through a trace; the first scan that differs is described.
pub fn compare(fixture: &Fixture, engine: &mut dyn Controllers) -> Result<(), String> {
    let names = columns(&fixture.system);
    let mut images: Vec<Vec<f64>> = (0..fixture.system.instances.len())
        .map(|i| {
            let device = &fixture.system.automaton_of(i).device;
            vec![0.0; device.words(Direction::Output, fixture.system.kinds())]
        })
        .collect();
    for (number, scan) in fixture.scans.iter().enumerate() {
        if scan.powers_up {
            engine.power_up();
        }
        let outputs = engine.scan(scan.system, &scan.inputs, &mut images);
        let Some(expected) = &scan.expected else { continue };
        let mut trace = Vec::new();
        engine.trace(&mut trace);
        let mut wrong = Vec::new();
        if outputs != expected.outputs {
            wrong.push(format!("system: expected {:?}, found {outputs:?}", expected.outputs));
        }
        if trace.len() != expected.trace.len() {
            wrong.push(format!("trace of {} numbers, found {}", expected.trace.len(), trace.len()));
        }
        for (name, (e, f)) in names.iter().zip(expected.trace.iter().zip(&trace)) {
            if e != f {
                wrong.push(format!("{name}: expected {e}, found {f}"));
            }
        }
        for (i, (e, f)) in expected.images.iter().zip(&images).enumerate() {
            if e != f {
                let name = &fixture.system.instances[i].name;
                wrong.push(format!("image of {name}: expected {e:?}, found {f:?}"));
            }
        }
        if !wrong.is_empty() {
            return Err(format!("line {}, scan {number}:\n  {}", scan.line, wrong.join("\n  ")));
        }
    }
    Ok(())
}

/// Reads a trace.
pub fn load(text: &str) -> Result<Fixture, String> {
    let part = |name: &str| -> Result<(usize, String), String> {
        let head = format!("== {name}");
        let start = text.lines().position(|l| l.trim_end() == head).ok_or(format!("no line `{head}`"))?;
        let lines: Vec<&str> = text.lines().skip(start + 1).take_while(|l| !l.starts_with("== ")).collect();
        Ok((start + 2, lines.join("\n")))
    };
    let (_, spec_text) = part("spec")?;
    let (first, layout_text) = part("layout")?;
    let layout = Layout::read(first, &layout_text)?;
    let (sources, model) = panelled(&spec_text, &layout.kinds, layout.panel)?;
    let system = layout.system(&model)?;
    let (first, scans_text) = part("scans")?;
    let scans = Script::new(&system).read(first, &scans_text)?;
    Ok(Fixture { sources, system, scans })
}

/// The model of a specification.
pub fn model(spec_text: &str, kinds: &[String]) -> Result<(Sources, ir::Model), String> {
    panelled(spec_text, kinds, Panel::Line)
}

/// The same, of machines with such panels.
fn panelled(spec_text: &str, kinds: &[String], panel: Panel) -> Result<(Sources, ir::Model), String> {
    let mut sources = Sources::default();
    let file = sources.add("spec.aut", spec_text);
    let (tree, found) = spec::parser::parse(file, spec_text);
    if !found.is_empty() {
        return Err(plain(&sources, &found));
    }
    let mut trees = crate::devices(&mut sources);
    trees.push((file, tree));
    if panel == Panel::Machines {
        device::panel::add(&mut trees);
    }
    let checked = check::check(&sources, &trees, Some(kinds)).map_err(|d| plain(&sources, &d))?;
    let mut model = checked.into_model();
    lower::complete(&mut model, panel);
    Ok((sources, model))
}

/// A model with the instances of a layout.
pub fn system(layout_text: &str, model: &ir::Model) -> Result<ir::System, String> {
    Layout::read(1, layout_text)?.system(model)
}

fn lines(first: usize, text: &str) -> impl Iterator<Item = (usize, Vec<&str>)> {
    text.lines().enumerate().filter_map(move |(i, line)| {
        let words: Vec<&str> = line.split('#').next().unwrap_or("").split_whitespace().collect();
        (!words.is_empty()).then_some((first + i, words))
    })
}

/// Parameters and device constants with their values, as written.
type Settings = Vec<(String, String)>;

#[derive(Default)]
struct Layout {
    scan_ms: i32,
    kinds: Vec<String>,
    /// Name, type, settings.
    machines: Vec<(String, String, Settings)>,
    /// Machine, role, members.
    roles: Vec<(String, String, Vec<String>)>,
    reaches: Vec<(String, String)>,
    panel: Panel,
}

impl Layout {
    fn read(first: usize, text: &str) -> Result<Self, String> {
        let mut layout = Layout { scan_ms: 10, kinds: vec!["part".into()], ..Layout::default() };
        for (line, words) in lines(first, text) {
            let own = |words: &[&str]| words.iter().map(|w| w.to_string()).collect::<Vec<_>>();
            match words.as_slice() {
                ["scan_ms", ms] => {
                    layout.scan_ms = ms.parse().map_err(|_| format!("line {line}: no number"))?
                }
                ["panel", "machines"] => layout.panel = Panel::Machines,
                ["kinds", kinds @ ..] => layout.kinds = own(kinds),
                ["reaches", a, b] => layout.reaches.push((a.to_string(), b.to_string())),
                [role, "=", members @ ..] if role.contains('.') => {
                    let (machine, role) = role.split_once('.').unwrap_or_default();
                    layout.roles.push((machine.into(), role.into(), own(members)));
                }
                [name, kind, settings @ ..] if name.ends_with(':') => {
                    let pairs = settings.iter().filter_map(|s| s.split_once('='));
                    let pairs = pairs.map(|(a, b)| (a.to_string(), b.to_string())).collect();
                    layout.machines.push((name.trim_end_matches(':').into(), kind.to_string(), pairs));
                }
                _ => return Err(format!("line {line}: what is this?")),
            }
        }
        Ok(layout)
    }

    fn system(&self, model: &ir::Model) -> Result<ir::System, String> {
        let number = |name: &str| {
            self.machines.iter().position(|m| m.0 == name).ok_or(format!("there is no instance `{name}`"))
        };
        let mut types = Vec::new();
        for (_, kind, _) in &self.machines {
            let id =
                model.automata.iter().position(|a| a.name == *kind).ok_or(format!("no type `{kind}`"))?;
            types.push(ir::AutomatonId(id));
        }
        let members: Vec<Vec<usize>> = (0..model.interfaces.len())
            .map(|i| {
                let is_member = |m: &usize| model.automaton(types[*m]).implementing(InterfaceId(i)).is_some();
                (0..types.len()).filter(is_member).collect()
            })
            .collect();
        let row =
            |interface: InterfaceId, machine: usize| members[interface.0].iter().position(|m| *m == machine);
        let mut system = ir::System {
            scan_ms: self.scan_ms,
            instances: Vec::new(),
            members: members.clone(),
            reaches: Vec::new(),
            model: model.clone(),
        };
        for (index, (name, _, settings)) in self.machines.iter().enumerate() {
            let automaton = model.automaton(types[index]);
            let mut roles = Vec::new();
            for role in &automaton.roles {
                let given = self.roles.iter().find(|r| r.0 == *name && r.1 == role.name);
                let mut found = match given {
                    Some((_, _, names)) => names.iter().map(|n| number(n)).collect::<Result<Vec<_>, _>>()?,
                    None if role.kind == RoleKind::Knows => {
                        (0..types.len()).filter(|m| *m != index).collect()
                    }
                    None => return Err(format!("the members of `{name}.{}` are missing", role.name)),
                };
                found.sort_unstable();
                let has_all = |m: &usize| role.also.iter().all(|i| row(*i, *m).is_some());
                roles.push(
                    found.iter().filter(|m| has_all(m)).filter_map(|m| row(role.interface, *m)).collect(),
                );
            }
            let rows = automaton.implements.iter().filter_map(|i| row(i.interface, index)).collect();
            let id = types[index];
            let instance =
                ir::Instance { name: name.clone(), automaton: id, parameters: Vec::new(), roles, rows };
            system.instances.push(instance);
            for (key, _) in settings {
                if !automaton.parameters.iter().any(|p| p.name == *key) {
                    return Err(format!("`{name}` reads no parameter `{key}`"));
                }
            }
        }
        for (index, (name, _, settings)) in self.machines.iter().enumerate() {
            let mut values = Vec::new();
            for parameter in &model.automaton(types[index]).parameters {
                let first = match parameter.source {
                    ir::ParameterSource::Layout(Some(value)) => value,
                    _ => first(parameter.ty.scalar),
                };
                let mut elements = vec![first; model.elements(parameter.ty.extent)];
                if let Some((_, text)) = settings.iter().find(|s| s.0 == parameter.name) {
                    set(&system, parameter.ty.scalar, &mut elements, text)
                        .map_err(|e| format!("{name}: {e}"))?;
                }
                values.push(elements);
            }
            system.instances[index].parameters = values;
        }
        for relation in &model.relations {
            let mut table = vec![vec![false; members[relation.to.0].len()]; members[relation.from.0].len()];
            for (a, b) in &self.reaches {
                if let (Some(a), Some(b)) = (row(relation.from, number(a)?), row(relation.to, number(b)?)) {
                    table[a][b] = true;
                }
            }
            system.reaches.push(table);
        }
        Ok(system)
    }
}

fn first(ty: Scalar) -> Value {
    match ty {
        Scalar::Bool => Value::Bool(false),
        Scalar::Int { lo, hi } => Value::Int(0.clamp(lo, hi)),
        Scalar::Time | Scalar::Enum(_) | Scalar::Ref(_) => Value::Int(0),
        Scalar::Real => Value::Real(0.0),
        Scalar::Point => Value::Point([0.0; 3]),
    }
}

/// Sets all elements from `v`, or from `[a,b,c]`.
fn set(system: &ir::System, ty: Scalar, elements: &mut [Value], text: &str) -> Result<(), String> {
    let Some(inner) = text.strip_prefix('[').and_then(|t| t.strip_suffix(']')) else {
        elements.fill(value(system, ty, text)?);
        return Ok(());
    };
    // Commas within points do not part elements.
    let mut depth = 0;
    let parts = inner.split(|c| {
        depth += i32::from(c == '(') - i32::from(c == ')');
        c == ',' && depth == 0
    });
    let parts: Vec<&str> = parts.collect();
    if parts.len() != elements.len() {
        return Err(format!("`{text}` has {} elements, not {}", parts.len(), elements.len()));
    }
    for (element, part) in elements.iter_mut().zip(parts) {
        *element = value(system, ty, part)?;
    }
    Ok(())
}

fn value(system: &ir::System, ty: Scalar, text: &str) -> Result<Value, String> {
    let wrong = || format!("`{text}` is no value of type {ty:?}");
    let real = |t: &str| t.parse::<f64>().map_err(|_| wrong());
    Ok(match ty {
        Scalar::Bool => match text {
            "1" | "true" => Value::Bool(true),
            "0" | "false" => Value::Bool(false),
            _ => return Err(wrong()),
        },
        Scalar::Int { .. } | Scalar::Time => Value::Int(text.parse().map_err(|_| wrong())?),
        Scalar::Real => Value::Real(real(text)?),
        Scalar::Enum(id) => {
            let members = &system.model.enums[id.0].members;
            Value::Int(members.iter().position(|m| m == text).ok_or_else(wrong)? as i32)
        }
        Scalar::Ref(id) => {
            let is_meant = |m: &usize| system.instances[*m].name == text;
            Value::Int(system.members[id.0].iter().position(is_meant).ok_or_else(wrong)? as i32)
        }
        Scalar::Point => {
            let inner = text.strip_prefix('(').and_then(|t| t.strip_suffix(')')).ok_or_else(wrong)?;
            let parts = inner.split(',').map(real).collect::<Result<Vec<_>, _>>()?;
            Value::Point(<[f64; 3]>::try_from(parts).map_err(|_| wrong())?)
        }
    })
}

/// A variable of an instance, with what it is expected to hold.
#[derive(Clone)]
struct Variable {
    name: String,
    ty: ir::Type,
    elements: Vec<Value>,
    /// Of a port: the value published while the system does not run.
    stop: Option<Stop>,
}

#[derive(Clone)]
struct Machine {
    state: usize,
    elapsed: i32,
    /// Locals, cells, outputs, in the order of a trace.
    variables: Vec<Variable>,
    inputs: Vec<Variable>,
}

struct Script<'a> {
    system: &'a ir::System,
    machines: Vec<Machine>,
    outputs: SystemOutputs,
}

impl<'a> Script<'a> {
    fn new(system: &'a ir::System) -> Self {
        let machines = (0..system.instances.len()).map(|i| machine(system, i)).collect();
        let outputs = SystemOutputs::default();
        Self { system, machines, outputs }
    }

    fn read(mut self, first: usize, text: &str) -> Result<Vec<Scan>, String> {
        let mut scans: Vec<Scan> = Vec::new();
        let mut blocks: Vec<(usize, Vec<Vec<&str>>)> = Vec::new();
        for (line, words) in lines(first, text) {
            match words[0] {
                "scan" | "run" => blocks.push((line, vec![words])),
                _ => blocks.last_mut().ok_or(format!("line {line}: before the first scan"))?.1.push(words),
            }
        }
        for (line, block) in blocks {
            let at = |e: String| format!("the scan of line {line}: {e}");
            let (head, rest) = block.split_first().ok_or("no scan")?;
            let (count, flags) = match head[0] {
                "run" => (head[1].parse::<usize>().map_err(|_| at("run how often?".into()))?, &head[2..]),
                _ => (1, &head[1..]),
            };
            if let Some(odd) = flags.iter().find(|f| !["permit", "start", "reset", "power"].contains(f)) {
                return Err(at(format!("`{odd}` is no input of the system")));
            }
            let system = SystemInputs {
                run_permit: flags.contains(&"permit"),
                start: flags.contains(&"start"),
                reset: flags.contains(&"reset"),
            };
            let mut published = Vec::new();
            for words in rest {
                self.line(words, &mut published).map_err(at)?;
            }
            let is_compared = head[0] == "scan";
            for number in 0..count {
                let powers_up = number == 0 && flags.contains(&"power");
                let mut expected = is_compared.then(|| self.expected());
                if let Some(expected) = &mut expected {
                    self.published(&published, expected).map_err(at)?;
                }
                let inputs = self.machines.iter().map(|m| image(&m.inputs, true)).collect();
                scans.push(Scan { line, powers_up, system, inputs, expected });
            }
        }
        Ok(scans)
    }

    fn line<'t>(&mut self, words: &[&'t str], published: &mut Vec<&'t str>) -> Result<(), String> {
        match words[0] {
            "in" => {
                for word in &words[1..] {
                    let (name, rest) = word.split_once('.').ok_or(format!("`{word}` names no port"))?;
                    let machine = self.machine(name)?;
                    assign(self.system, &mut self.machines[machine].inputs, rest)?;
                }
            }
            "image" => published.extend(&words[1..]),
            "out" => {
                let outputs = SystemOutputs {
                    running: false,
                    fault: false,
                    fault_code: 0,
                    fault_robot: -1,
                    ..self.outputs
                };
                self.outputs = match words[1..] {
                    ["running"] => SystemOutputs { running: true, ..outputs },
                    ["stopped"] => outputs,
                    ["fault", name, ref fragment @ ..] => {
                        let (fault_code, fault_robot) = self.site(name, fragment)?;
                        SystemOutputs { running: false, fault: true, fault_code, fault_robot, ..outputs }
                    }
                    _ => return Err("out what?".into()),
                };
            }
            "alarm" => {
                let (alarm_code, alarm_robot) = match words[1..] {
                    ["none"] => (0, -1),
                    [name, ref fragment @ ..] => self.site(name, fragment)?,
                    [] => return Err("which alarm?".into()),
                };
                let alarm = words[1] != "none";
                self.outputs = SystemOutputs { alarm, alarm_code, alarm_robot, ..self.outputs };
            }
            name => {
                let machine = self.machine(name)?;
                let [_, state, elapsed, changes @ ..] = words else {
                    return Err(format!("`{name}` needs a state and a time"));
                };
                let states = &self.system.automaton_of(machine).states;
                self.machines[machine].state =
                    states.iter().position(|s| s.name == *state).ok_or(format!("no state `{state}`"))?;
                self.machines[machine].elapsed =
                    elapsed.parse().map_err(|_| format!("`{elapsed}` is no time"))?;
                for change in changes {
                    assign(self.system, &mut self.machines[machine].variables, change)?;
                }
            }
        }
        Ok(())
    }

    /// Code and instance of the fault or alarm of a machine whose description has these words.
    fn site(&self, name: &str, fragment: &[&str]) -> Result<(i32, i32), String> {
        let fragment = fragment.join(" ");
        let machine = self.machine(name)?;
        let automaton = self.system.instances[machine].automaton;
        let sites = self.system.model.faults.iter().enumerate();
        let found: Vec<usize> = sites
            .filter(|(_, f)| f.automaton == automaton && f.text.contains(&fragment))
            .map(|(i, _)| i)
            .collect();
        let [site] = found[..] else {
            return Err(format!("{} faults have `{fragment}`", found.len()));
        };
        Ok((site as i32 + 1, machine as i32))
    }

    fn machine(&self, name: &str) -> Result<usize, String> {
        let found = self.system.instances.iter().position(|i| i.name == name);
        found.ok_or(format!("there is no instance `{name}`"))
    }

    fn expected(&self) -> Expected {
        let mut trace = Vec::new();
        let mut images = Vec::new();
        for machine in &self.machines {
            trace.extend([machine.state as f64, f64::from(machine.elapsed)]);
            trace.extend(image(&machine.variables, true));
            let ports: Vec<Variable> =
                machine.variables.iter().filter(|v| v.stop.is_some()).cloned().collect();
            let is_stopped = |v: &Variable| {
                matches!(v.name.as_str(), "stopped" | "moved_by_hand") && v.elements == [Value::Bool(true)]
            };
            let runs = self.outputs.running && !machine.variables.iter().any(is_stopped);
            let is_abandoned =
                machine.variables.iter().any(|v| v.name == "abandoned" && v.elements == [Value::Bool(true)]);
            let published =
                |v: &Variable| image(std::slice::from_ref(v), runs && !(is_abandoned && v.name == "hold"));
            images.push(ports.iter().flat_map(published).collect());
        }
        Expected { outputs: self.outputs, trace, images }
    }

    /// What a scan says of outputs: with a panel that is what is expected, without one it follows from the rest.
    fn published(&self, published: &[&str], expected: &mut Expected) -> Result<(), String> {
        for word in published {
            let (name, rest) = word.split_once('.').ok_or(format!("`{word}` names no port"))?;
            let machine = self.machine(name)?;
            let mut ports: Vec<Variable> = self.machines[machine].variables.clone();
            ports.retain(|v| v.stop.is_some());
            let (port, _) = rest.split_once('=').ok_or(format!("`{word}` has no value"))?;
            let offset: usize = ports
                .iter()
                .take_while(|v| v.name != port)
                .map(|v| image(std::slice::from_ref(v), true).len())
                .sum();
            assign(self.system, &mut ports, rest)?;
            let wanted: Vec<Variable> = ports.into_iter().filter(|v| v.name == port).collect();
            let wanted = image(&wanted, true);
            let found = &mut expected.images[machine][offset..offset + wanted.len()];
            if self.system.automaton_of(machine).modes.is_some() {
                found.copy_from_slice(&wanted);
            } else if *found != wanted {
                return Err(format!("`{word}` is not what the table of devices says"));
            }
        }
        Ok(())
    }
}

fn machine(system: &ir::System, index: usize) -> Machine {
    let automaton = system.automaton_of(index);
    let model = &system.model;
    let filled = |name: &str, ty: ir::Type, value: Value, stop| Variable {
        name: name.into(),
        ty,
        elements: vec![value; model.elements(ty.extent)],
        stop,
    };
    let mut variables: Vec<Variable> =
        automaton.locals.iter().map(|l| filled(&l.name, l.ty, l.initial, None)).collect();
    for implemented in &automaton.implements {
        let cells = &model.interface(implemented.interface).cells;
        variables.extend(cells.iter().map(|c| filled(&c.name, c.ty, c.initial, None)));
    }
    let mut inputs = Vec::new();
    for port in &automaton.device.ports {
        let ty = ir::Type { scalar: port.ty.into(), extent: port.extent.into() };
        match port.direction {
            Direction::Output => variables.push(filled(&port.name, ty, first(ty.scalar), Some(port.stop))),
            // Inputs come as words of the image, whatever their type.
            Direction::Input => inputs.push(filled(&port.name, ty, first(ty.scalar), None)),
        }
    }
    if automaton.can_stop() {
        let ty = ir::Type { scalar: Scalar::Bool, extent: ir::Extent::One };
        variables.push(filled("stopped", ty, Value::Bool(false), None));
    }
    for number in 1..=automaton.alarms().count() {
        let mut word = |name: &str, scalar, first| {
            let ty = ir::Type { scalar, extent: ir::Extent::One };
            variables.push(filled(&format!("alarm{number}_{name}"), ty, first, None));
        };
        word("active", Scalar::Bool, Value::Bool(false));
        word("acknowledged", Scalar::Bool, Value::Bool(true));
        for name in ["count", "first", "last"] {
            word(name, Scalar::Int { lo: 0, hi: i32::MAX }, Value::Int(0));
        }
    }
    for input in &mut inputs {
        if !matches!(input.ty.scalar, Scalar::Point) {
            input.ty.scalar = Scalar::Real;
            input.elements.fill(Value::Real(0.0));
        }
    }
    Machine { state: 0, elapsed: 0, variables, inputs }
}

fn assign(system: &ir::System, variables: &mut [Variable], word: &str) -> Result<(), String> {
    let (target, text) = word.split_once('=').ok_or(format!("`{word}` has no value"))?;
    let (name, index) = match target.split_once('[') {
        Some((name, index)) => (name, Some(index.trim_end_matches(']'))),
        None => (target, None),
    };
    let variable = variables.iter_mut().find(|v| v.name == name).ok_or(format!("there is no `{name}`"))?;
    let Some(index) = index else {
        return set(system, variable.ty.scalar, &mut variable.elements, text);
    };
    let index = match variable.ty.extent {
        ir::Extent::By(id) => system.model.enums[id.0].members.iter().position(|m| m == index),
        _ => index.parse().ok().filter(|i| *i < variable.elements.len()),
    };
    let index = index.ok_or(format!("no element `{target}`"))?;
    variable.elements[index] = value(system, variable.ty.scalar, text)?;
    Ok(())
}

fn image(variables: &[Variable], running: bool) -> Vec<f64> {
    let mut words = Vec::new();
    for variable in variables {
        for element in &variable.elements {
            match (variable.stop, *element) {
                (Some(Stop::Value(stop)), _) if !running => words.push(stop),
                (_, Value::Bool(b)) => words.push(f64::from(u8::from(b))),
                (_, Value::Int(i)) => words.push(f64::from(i)),
                (_, Value::Real(r)) => words.push(r),
                (_, Value::Point(p)) => words.extend(p),
            }
        }
    }
    words
}

/// What each number of a trace is.
pub fn columns(system: &ir::System) -> Vec<String> {
    let mut names = Vec::new();
    for (index, instance) in system.instances.iter().enumerate() {
        names.push(format!("{}: state", instance.name));
        names.push(format!("{}: elapsed", instance.name));
        for variable in machine(system, index).variables {
            for element in 0..variable.elements.len() {
                let axes: &[&str] =
                    if variable.ty.scalar == Scalar::Point { &[".x", ".y", ".z"] } else { &[""] };
                for axis in axes {
                    names.push(format!("{}: {}[{element}]{axis}", instance.name, variable.name));
                }
            }
        }
    }
    names
}
