//! The program: status, steps in layout order, properties, outputs, alarms; and the block that sets tables up.

use super::alarm;
use super::block::{Block, publishes};
use super::body::Body;
use super::code::{self, Arm, Ex, Stmt, and, assign, binary, name, not, or, when};
use super::context::Shared;
use super::declaration::{Basic, Instance, Unit, Variable, constants};
use super::externals::Externals;
use super::filling::Filling;
use super::globals::{Globals, Table};
use super::image::Image;
use super::modes::{self, PutOut};
use super::name::Name;
use super::names::{ELEMENT, ROUNDED};
use super::property;
use super::restart;
use super::value::{first_value, stop_value};
use super::watchdog;
use runtime_sim::device::Direction;
use std::collections::HashSet;
use std::sync::Arc;

pub const LAYOUT: &str = "FB_Layout";

/// The blocks of a type that has robots.
pub struct Blocks<'a> {
    pub steps: Block<'a>,
    pub properties: Option<Block<'a>>,
}

/// The blocks of a robot.
fn of_robot<'b, 'a>(
    shared: Shared,
    blocks: &'b [Option<Blocks<'a>>],
    robot: usize,
) -> Option<&'b Blocks<'a>> {
    blocks[shared.system.instances[robot].automaton.0].as_ref()
}

/// The scan.
pub fn statements<'a>(shared: Shared<'a>, blocks: &Arc<Vec<Option<Blocks<'a>>>>, image: &Image) -> Body<'a> {
    let count = shared.system.instances.len();
    let each = |make: fn(Shared, &Blocks, usize) -> Vec<Stmt>| {
        let blocks = blocks.clone();
        move |robot: usize| of_robot(shared, &blocks, robot).map_or(Vec::new(), |of| make(shared, of, robot))
    };
    let mut first = vec![restart::begin_anew(shared)];
    let retained = (0..count).filter(|robot| {
        of_robot(shared, blocks, *robot).is_some_and(|of| publishes(&of.steps, restart::KEPT))
    });
    let instances = retained.map(|robot| shared.names.robots[robot].instance.as_str());
    first.extend(restart::begin(shared, instances));
    let cold = vec![("cold_start".into(), not(name("init_done")))];
    first.push(Stmt::Call { instance: "layout".into(), arguments: cold });
    first.extend(commented("Inputs: from raw values.", &image.inputs));
    first.push(Stmt::Comment(
        "A screen may write these two in the middle of a scan: they are read once.".into(),
    ));
    first.extend([assign("start_now", name("start")), assign("reset_now", name("reset"))]);
    first.extend(watchdog::call(shared));
    first.extend(status(shared));
    first.push(Stmt::Comment("Steps, in layout order.".into()));
    let mut body = Body::from(first);
    body.push_made(
        count,
        each(|shared, of, robot| vec![of.steps.call(shared, &shared.names.robots[robot].instance, robot)]),
    );
    if blocks.iter().flatten().any(|of| of.properties.is_some()) {
        body.push([Stmt::Comment("Properties.".into())]);
        body.push_made(
            count,
            each(|shared, of, robot| {
                let instance = &shared.names.robots[robot].properties;
                of.properties.iter().map(|block| block.call(shared, instance, robot)).collect()
            }),
        );
    }
    let mut then = vec![
        assign("fault", binary("<>", name("fault_code"), Ex::Int(0))),
        when(name("fault"), vec![assign("running", Ex::Bool(false))]),
    ];
    then.extend(alarm::told(shared));
    then.push(Stmt::Comment(
        "Outputs: the values of the blocks, or stop values while the line does not run.".into(),
    ));
    body.push(then);
    body.push_made(count, each(|shared, of, robot| publish(shared, robot, &of.steps)));
    let mut last = commented("Outputs: to raw values.", &image.outputs);
    last.extend(alarm::counted(shared));
    last.push(assign("init_done", Ex::Bool(true)));
    last.extend(restart::end(shared));
    body.push(last);
    body
}

/// The program without its externals. `used` are the names in its statements.
pub fn program<'a>(
    shared: Shared,
    blocks: &[Option<Blocks>],
    body: Body<'a>,
    used: &HashSet<Name>,
) -> Unit<'a> {
    let instance = |name: &str, block: &str, comment: String| Instance {
        name: name.into(),
        block: block.into(),
        comment,
        is_retained: false,
    };
    let mut instances = vec![watchdog::instance(), instance("layout", LAYOUT, String::new())];
    let robots = (shared.names.robots.iter().enumerate())
        .filter_map(|(robot, names)| Some((robot, names, of_robot(shared, blocks, robot)?)));
    instances.extend(robots.clone().map(|(robot, names, of)| Instance {
        is_retained: publishes(&of.steps, restart::KEPT),
        ..instance(&names.instance, &of.steps.unit.name, format!("robot {robot}"))
    }));
    instances.extend(robots.filter_map(|(_, names, of)| {
        Some(instance(&names.properties, &of.properties.as_ref()?.unit.name, String::new()))
    }));
    Unit {
        name: "MAIN".into(),
        comments: vec!["One scan: every robot steps once, in layout order.".into()],
        variables: [
            restart::values_of(),
            Variable::new("start_now", Basic::Bool).with_comment("start, in this scan"),
            Variable::new("reset_now", Basic::Bool).with_comment("reset, in this scan"),
            Variable::new("start_before", Basic::Bool)
                .with_initial(Ex::Bool(true))
                .with_comment("no edge at power-up"),
            Variable::new("reset_before", Basic::Bool).with_initial(Ex::Bool(true)),
            Variable::new("had_fault", Basic::Bool)
                .with_comment("there was a fault at the beginning of the scan"),
            Variable::new("oldest", Basic::Dint)
                .with_comment("scan in which the alarm that is told was raised"),
            Variable::new(alarm::OLDEST_ACKNOWLEDGED, Basic::Bool).with_comment("it has been acknowledged"),
            Variable::new(ELEMENT, Basic::Dint).with_comment("number of an element"),
            Variable::new(ROUNDED, Basic::Dint)
                .with_comment("a raw value before its conversion to a narrower type"),
        ]
        .into_iter()
        .filter(|variable| used.contains(&variable.name))
        .collect(),
        instances,
        body,
        ..Unit::default()
    }
}

/// Statements with a comment before them, if there are any.
fn commented(text: &str, statements: &[Stmt]) -> Vec<Stmt> {
    let comment = (!statements.is_empty()).then(|| Stmt::Comment(text.into()));
    comment.into_iter().chain(statements.iter().cloned()).collect()
}

fn status(shared: Shared) -> Vec<Stmt> {
    let has_fault = || binary("<>", name("fault_code"), Ex::Int(0));
    let edge = |input: &str| and(vec![name(format!("{input}_now")), not(name(format!("{input}_before")))]);
    let arm = |condition: Ex, body: Vec<Stmt>| Arm { comments: Vec::new(), condition, body };
    let mut body = vec![
        Stmt::Comment(
            "Running: from a rising edge of start, while run_permit is true and there is no fault.".into(),
        ),
        assign("had_fault", has_fault()),
        assign("fault_cleared", and(vec![name("had_fault"), edge("reset")])),
        when(
            name("fault_cleared"),
            vec![assign("fault_code", Ex::Int(0)), assign("fault_robot", Ex::Int(-1))],
        ),
        Stmt::If(
            vec![
                arm(or(vec![not(name("run_permit")), has_fault()]), vec![assign("running", Ex::Bool(false))]),
                arm(
                    and(vec![edge("start"), not(name("had_fault"))]),
                    vec![assign("running", Ex::Bool(true))],
                ),
            ],
            Vec::new(),
        ),
    ];
    body.extend(alarm::acknowledged(shared));
    if alarm::can_stop(shared) {
        body.push(assign("start_edge", edge("start")));
    }
    body.extend([assign("start_before", name("start_now")), assign("reset_before", name("reset_now"))]);
    body
}

fn publish(shared: Shared, robot: usize, block: &Block) -> Vec<Stmt> {
    let automaton = shared.system.automaton_of(robot);
    let own = &shared.names.automata[shared.system.instances[robot].automaton.0].ports;
    let names = &shared.names.robots[robot];
    let is_stopped = || Ex::Element(property::STOPPED.into(), Box::new(Ex::Int(robot as i32)));
    let modes = automaton.modes.as_ref();
    let runs = || match (automaton.can_stop(), modes) {
        (_, Some(modes)) => {
            let is_moved = modes::field(shared, robot, modes.moved_by_hand);
            and(vec![name("running"), not(is_stopped()), not(is_moved)])
        }
        (true, None) => and(vec![name("running"), not(is_stopped())]),
        (false, None) => name("running"),
    };
    let mut put = PutOut::default();
    let mut always = Vec::new();
    for (i, port) in
        automaton.device.ports.iter().enumerate().filter(|(_, p)| p.direction == Direction::Output)
    {
        let stop = stop_value(port).map(constants);
        let published = modes.and_then(|modes| modes.published[i].as_ref());
        let panel = published.and_then(|published| modes::by_hand(shared, robot, published));
        if automaton.device.is_commanded() && port.name == "hold" {
            always.push(assign(&names.ports[i][0], modes::hold(shared, robot, runs())));
            continue;
        }
        for (part, (global, output)) in names.ports[i].iter().zip(&own[i]).enumerate() {
            let is_written = publishes(block, output);
            let value = is_written.then(|| Ex::Field(names.instance.clone(), output.clone()));
            match (value, stop.as_ref().map(|s| s[part].clone())) {
                (Some(value), None) => always.push(assign(global, value)),
                (None, None) => {}
                (value, Some(stop)) => {
                    let first = constants(first_value(port.ty))[part].clone();
                    let given = panel.as_ref().map(|panel| panel[part].clone());
                    put.add(global, [value.unwrap_or(first), stop], published, given);
                }
            }
        }
    }
    always.extend(put.statements(runs(), modes, |local| modes::field(shared, robot, local)));
    always
}

/// Sets cells and tables of parameters in the first scan.
pub fn layout<'a>(globals: &Arc<Globals>) -> Unit<'a> {
    let mut first = vec![when(not(name("cold_start")), vec![Stmt::Return])];
    if !globals.cells.is_empty() {
        first.push(Stmt::Comment("Shared cells.".into()));
        first.extend(restart::cells(&globals.cells));
    }
    let mut used = code::names(&first);
    let mut body = Body::from(first);
    let mut fill = |about: &str, tables: &[Table]| {
        let Filling { loops, others } = Filling::new(tables, ELEMENT);
        used.extend(code::names(&loops));
        used.extend(others.iter().map(|others| others.table.clone()));
        body.push([Stmt::Comment(about.into())]);
        body.push(loops);
        body.push_made(others.len(), move |i| others[i].statements());
    };
    if !globals.parameters.is_empty() {
        fill("Parameters.", &globals.parameters);
    }
    if !globals.alarms.is_empty() {
        fill("Alarms.", &globals.alarms);
    }
    let counter = Variable::new(ELEMENT, Basic::Dint).with_comment("number of an element");
    Unit {
        name: LAYOUT.into(),
        comments: vec!["The values of this layout, and the initial values of shared cells.".into()],
        inputs: vec![Variable::new("cold_start", Basic::Bool).with_comment("this is the first scan")],
        externals: Externals::marked(globals, |name| used.contains(name)),
        variables: if used.contains(ELEMENT) { vec![counter] } else { Vec::new() },
        body,
        ..Unit::default()
    }
}
