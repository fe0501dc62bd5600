//! What the machines of a line may do: the contract of each primitive, put together by the wiring of the device.
//!
//! Commands take any number of scans and end as [`ending`] says. What a signal may do is in [`Signals::of`]; one of a
//! primitive that is not named there changes freely, which is sound for every primitive and says little.

use super::fed::Fed;
use super::memory::Memory;
use super::strokes::{Changing, Of};
use crate::device::Port;
use crate::device::panel;
use autogen_search::plant::{
    Action, Arm, Asked, Awaits, Desk, Floor, Head, Input, Lane, Level, Place, Route, Zone, motion, phase,
    status,
};
use autogen_search::stroke::position;
use autogen_search::value::Var;
use runtime_sim::device::{Direction, PortType, Stop, error};
use runtime_sim::frame::Frame;
use runtime_sim::line::Line;
use runtime_sim::machine::Machine;
use runtime_sim::part::Primitive;
use runtime_sim::part::lane::{self, Lane as Conveyor};
use runtime_sim::part::place;
use runtime_sim::part::zone::Zone as Field;
use runtime_sim::point::Point;
use runtime_sim::wiring::{Command, Drives, Source, Wiring};

/// What stands for an input of a machine.
#[derive(Clone, Debug)]
pub enum Signal {
    /// It is always so.
    Fixed(i32),
    /// Truths, or whole numbers from `low` on: numbers of inputs that change by themselves, element by element.
    Free(Vec<usize>),
    /// A place in the state.
    At(Var),
    /// A truth that is at its place in the state.
    Held(Var),
    /// Whether this is at its place in the state.
    Is(Var, i32),
    /// Whether the first is not 0; in the scan of a command the second is one more than what was so before, else 0.
    Moves(Var, Option<Var>),
    /// The number of the stop at which it stands.
    AtStop,
    /// Where a vehicle is.
    Position,
    /// Where items of each kind are found.
    Found(Vec<[f64; 3]>),
    IsOpen,
    Parts,
    OrderNumber,
    Error,
    /// Nothing is known of it that could be searched.
    Unbounded,
}

/// A machine as it is searched, with what its inputs are.
#[derive(Debug)]
pub struct Plant {
    pub machine: autogen_search::plant::Machine,
    /// In the order of its input ports.
    pub inputs: Vec<Signal>,
    /// For each output port the place of a level that the plant reads.
    pub outputs: Vec<Option<Var>>,
}

/// What is known of the automaton of a machine.
#[derive(Clone, Copy)]
pub struct Known<'a> {
    /// It reads the port `error` by itself.
    pub reads_error: bool,
    /// Whether it is stopped by itself, if anything can stop it.
    pub stopped: Option<Var>,
    /// Of each port of the device whether an expression reads it.
    pub reads: &'a [bool],
    /// Of the line.
    pub fed: &'a Fed,
}

fn coordinates(p: Point) -> [f64; 3] {
    [p.x, p.y, p.z]
}

fn floor(floor: &place::Floor) -> Floor {
    let ahead = Frame::new(Point::default(), floor.yaw).direction(Point::new(1.0, 0.0, 0.0));
    Floor { middle: coordinates(floor.middle), x: floor.x, y: floor.y, ahead: [ahead.x, ahead.y] }
}

/// The errors in which a command may end before anything has moved, by the primitive of its part and the name of its
/// action. Every device may refuse a command; what goes to a place may find it out of reach, which an automaton can tell
/// from that by the port `error` alone.
fn refusals(asked: (&str, &str), reads_error: bool) -> Vec<i32> {
    match asked {
        ("chain", "limits") => vec![error::REFUSED],
        ("chain", _) | ("route" | "track" | "positioner", "to") if reads_error => {
            vec![error::REFUSED, error::UNREACHABLE]
        }
        _ => vec![error::REFUSED],
    }
}

/// What a command asks for, by the primitive of its part and the name of its action. `around` goes to the first of its
/// two places; all other motions end at the last one.
fn asked(machine: &Machine, command: &Command, reads_error: bool) -> (Asked, usize) {
    let schema = machine.parts[command.part].schema();
    let name = schema.actions[command.action].name;
    let (action, points) = match (schema.name, name) {
        ("chain", "joints" | "turned" | "direct" | "around" | "oriented") => (Action::Motion, 1),
        ("chain", "past" | "onto") => (Action::Motion, 2),
        ("route", "to") => (Action::Trip, 1),
        ("lane", "run") => (Action::Run, 0),
        ("lane", "rest") => (Action::Rest, 0),
        _ => (Action::Other, 0),
    };
    let awaits = command.then.map(|then| Awaits {
        is_hold: signal_name(machine, then.part, then.signal) == ("grip", "holds"),
        error: then.error,
    });
    let refusals = refusals((schema.name, name), reads_error);
    let is_planned = matches!(name, "around" | "onto");
    let is_kept = action != Action::Other || command.arguments.is_empty();
    (Asked { action, is_kept, is_planned, awaits, refusals }, points)
}

fn signal_name(machine: &Machine, part: usize, signal: usize) -> (&'static str, &'static str) {
    let schema = machine.parts[part].schema();
    (schema.name, schema.signals[signal].name)
}

/// How many places each command has, by its number among those of the wiring.
pub fn places_of_commands(machine: &Machine) -> Vec<usize> {
    machine.wiring.commands.iter().map(|command| asked(machine, command, false).1).collect()
}

/// Lays out what the plant remembers of a machine. `ports` are those of its device.
pub fn plant(
    line: &Line,
    number: usize,
    ports: &[Port],
    known: Known,
    memory: &mut Memory,
    changing: &mut Changing,
) -> Plant {
    let Known { reads_error, stopped, reads, fed } = known;
    let machine = &line.machines[number];
    let watched = watched(machine, ports, reads);
    let mut found = autogen_search::plant::Machine::default();
    let name = |what: &str| format!("{}.{what}", machine.name);
    if machine.wiring.is_commanded() {
        let commands = machine.wiring.commands.iter();
        found.head = Some(Head {
            status: memory.number(number, name("(answer)"), 3, status::NONE),
            command: memory.number(number, name("(command)"), 16, 0),
            error: reads_error.then(|| memory.number(number, name("error"), 255, 0)),
            commands: commands.map(|command| asked(machine, command, reads_error).0).collect(),
        });
    }
    let levels = levels(machine, number, ports, &watched, memory);
    let level = |part: usize, wanted: &str| {
        let published = ports.iter().filter(|port| port.direction == Direction::Output);
        let outputs = machine.wiring.outputs.iter().zip(published).zip(&levels);
        let is_wanted = |level: usize| machine.parts[part].schema().levels[level].name == wanted;
        outputs.into_iter().find_map(|((output, port), var)| match output.drives {
            Drives::Level { part: of, level } if of == part && is_wanted(level) => {
                let stop = stop_value(port);
                var.map(|var| (Level { var, stop: stopped.zip(stop) }, stop.unwrap_or(false)))
            }
            _ => None,
        })
    };
    for (part, made) in machine.parts.iter().enumerate() {
        match &made.primitive {
            Primitive::Chain(chain) => {
                let is_on = |other: &Primitive| matches!(other, Primitive::Grip(grip) if grip.chain == part);
                let grip = machine.parts.iter().position(|other| is_on(&other.primitive));
                let near = grip.and_then(|grip| match &machine.parts[grip].primitive {
                    Primitive::Grip(grip) => Some(grip.near),
                    _ => None,
                });
                found.arm = Some(Arm {
                    tool: memory.point(number, name("(tool)"), coordinates(chain.rest)),
                    via: memory.point(number, name("(via)"), [0.0; 3]),
                    goal: memory.point(number, name("(goal)"), [0.0; 3]),
                    holds: memory.number(number, name("(holds)"), line.kinds.len(), 0),
                    shown: memory.number(number, name("(attached)"), 1, 0),
                    closes: grip.and_then(|grip| level(grip, "close")).map(|(level, _)| level),
                    near: near.unwrap_or(0.0),
                });
            }
            Primitive::Route(route) => {
                let first = coordinates(route.stops[0]);
                found.route = Some(Route {
                    at: memory.point(number, name("(at)"), first),
                    goal: memory.point(number, name("(goal)"), first),
                    stops: route.stops.iter().map(|stop| coordinates(*stop)).collect(),
                    tolerance: route.tolerance,
                    shown: ["position", "at_stop"]
                        .into_iter()
                        .any(|signal| shows(machine, ports, reads, ("route", signal)))
                        .then(|| memory.number(number, name("(shown stop)"), route.stops.len() + 1, 0)),
                });
            }
            Primitive::Cylinder(cylinder) if watched[part] => {
                let valves = ["extend", "retract"].map(|valve| level(part, valve));
                let of = Of { machine, number, part, scan_ms: u64::from(line.scan_ms) };
                changing.add_cylinder(of, cylinder, valves, memory);
            }
            Primitive::Process(process) if watched[part] => {
                let of = Of { machine, number, part, scan_ms: u64::from(line.scan_ms) };
                changing.add_process(of, process, level(part, "start"), memory);
            }
            Primitive::Lane(lane) if is_commanded(machine, part) => {
                let zones =
                    machine.parts.iter().enumerate().filter_map(|(of, other)| match &other.primitive {
                        Primitive::Zone(field) if field.lane == part => {
                            let stays = (!fed.has(number, part)).then_some(number);
                            let seen = Seen { machine: number, field: of, stays };
                            Some(zone(line, seen, lane, field, memory, &mut changing.inputs))
                        }
                        _ => None,
                    });
                let zones = zones.flatten().collect();
                let is_read = shows(machine, ports, reads, ("lane", "moves"));
                found.lane = Some(Lane {
                    motion: memory.number(number, name("(motion)"), 3, motion::STANDS),
                    shown: is_read.then(|| memory.number(number, name("(shown motion)"), 2, 0)),
                    zones,
                });
            }
            Primitive::Place(place) if fed.is_known(line, number, part) => {
                let count = if place.by_kind { line.kinds.len() } else { place.slots.len() };
                let asked = line.scenario.orders.iter().flat_map(|order| &order.parts);
                let more = asked.copied().max().unwrap_or(0) as usize + 1;
                let most = if place.by_kind { more } else { line.kinds.len() };
                let items = (0..count)
                    .map(|n| memory.number(number, format!("{}.(item)[{n}]", machine.name), most, 0));
                found.places.push(Place {
                    stands: (!machine.is_driven(place)).then_some(coordinates(place.at)),
                    floor: floor(&place.floor),
                    slots: place.slots.iter().map(|slot| coordinates(*slot)).collect(),
                    by_kind: place.by_kind,
                    items: items.collect(),
                    most: more as i32,
                    stray: (!place.by_kind)
                        .then(|| memory.number(number, name("(stray)"), line.kinds.len() + 1, 0)),
                    stacks: stacks(line, place) || fed.has(number, part),
                });
            }
            Primitive::Orders(orders) => {
                let is_known = |part: &usize| fed.is_known(line, number, *part);
                let place = is_known(&orders.place).then(|| (0..orders.place).filter(is_known).count());
                let here = line.scenario.orders.iter().enumerate();
                let here: Vec<usize> = here
                    .filter(|(_, order)| order.stations.contains(&number))
                    .map(|(order, _)| order)
                    .collect();
                let first = here.first().copied();
                let is_open = first.is_some();
                found.desk = Some(Desk {
                    phase: memory.number(
                        number,
                        name("(order is)"),
                        4,
                        if is_open { phase::OPEN } else { phase::BARE },
                    ),
                    order: memory.number(
                        number,
                        name("(order)"),
                        line.scenario.orders.len(),
                        first.unwrap_or(0) as i32,
                    ),
                    next: memory.number(number, name("(orders begun)"), here.len(), i32::from(is_open)),
                    complete: level(part, "complete").map(|(level, _)| level),
                    place,
                    orders: here,
                });
            }
            _ => {}
        }
    }
    let inputs = ports.iter().filter(|port| port.direction == Direction::Input);
    let signals = machine.wiring.inputs.iter().zip(inputs).map(|(input, port)| match input.source {
        Source::Ready => Signal::Fixed(1),
        Source::Error => Signal::Error,
        Source::Got | Source::Ack => Signal::Unbounded,
        Source::Signal { part, signal } => {
            self::signal(line, number, Shown { part, signal, ty: port.ty }, &found, memory, changing)
        }
    });
    Plant { inputs: signals.collect(), machine: found, outputs: levels }
}

/// Whether a conveyor runs by commands, at full speed.
pub fn is_commanded(machine: &Machine, part: usize) -> bool {
    let Wiring { commands, outputs, .. } = &*machine.wiring;
    let has_rate = outputs.iter().any(|output| output.drives == Drives::Level { part, level: lane::RUN_BY });
    commands.iter().any(|command| command.part == part) && !has_rate
}

/// Whether items may be somewhere that is not searched: on a conveyor without commands or without a field, at such a
/// place, or on other items.
pub fn hides_items(line: &Line, number: usize, fed: &Fed) -> bool {
    let machine = &line.machines[number];
    machine.parts.iter().enumerate().any(|(part, of)| match &of.primitive {
        Primitive::Lane(_) => {
            let has_field = (0..machine.parts.len()).any(|field| field_over(machine, field) == Some(part));
            !is_commanded(machine, part) || !has_field
        }
        Primitive::Place(place) => {
            !fed.is_known(line, number, part) || fed.has(number, part) || stacks(line, place)
        }
        _ => false,
    })
}

/// Whether items may lie on one another there.
fn stacks(line: &Line, place: &runtime_sim::part::place::Place) -> bool {
    place.stacks || line.kinds.iter().any(|kind| kind.deck.is_some())
}

/// Whether there is a place at which it is not known what lies there, and not where that place is.
pub fn has_hidden_places(line: &Line, number: usize, fed: &Fed) -> bool {
    let parts = line.machines[number].parts.iter().enumerate();
    let mut places = parts.filter(|(_, part)| matches!(part.primitive, Primitive::Place(_)));
    places.any(|(part, _)| !fed.is_known(line, number, part))
}

/// Whether a place is on a cylinder, a positioner or a vehicle on a track.
pub(super) fn is_carried(machine: &Machine, place: &runtime_sim::part::place::Place) -> bool {
    machine.strokes_under(place).is_some() || machine.is_on_track(place)
}

/// What is published of a truth while its machine is stopped; none: what the automaton wrote last.
fn stop_value(port: &Port) -> Option<bool> {
    match port.stop {
        Stop::Value(value) => Some(value != 0.0),
        Stop::Hold => None,
    }
}

/// Of each part whether its automaton reads any of its signals.
fn watched(machine: &Machine, ports: &[Port], reads: &[bool]) -> Vec<bool> {
    let mut watched = vec![false; machine.parts.len()];
    let inputs = ports.iter().zip(reads).filter(|(port, _)| port.direction == Direction::Input);
    for ((_, is_read), input) in inputs.zip(&machine.wiring.inputs) {
        if let (true, Source::Signal { part, .. }) = (*is_read, input.source) {
            watched[part] = true;
        }
    }
    watched
}

/// Whether its automaton reads this signal of one of its parts.
fn shows(machine: &Machine, ports: &[Port], reads: &[bool], wanted: (&str, &str)) -> bool {
    let inputs = ports.iter().zip(reads).filter(|(port, _)| port.direction == Direction::Input);
    let mut inputs = inputs.zip(&machine.wiring.inputs);
    inputs.any(|((_, is_read), input)| {
        let is_wanted = |part, signal| signal_name(machine, part, signal) == wanted;
        *is_read && matches!(input.source, Source::Signal { part, signal } if is_wanted(part, signal))
    })
}

/// Places for the levels that the plant reads.
fn levels(
    machine: &Machine,
    number: usize,
    ports: &[Port],
    watched: &[bool],
    memory: &mut Memory,
) -> Vec<Option<Var>> {
    let outputs = ports.iter().filter(|port| port.direction == Direction::Output);
    let levels = outputs.zip(&machine.wiring.outputs).map(|(port, output)| match output.drives {
        Drives::Level { part, level } => {
            let schema = machine.parts[part].schema();
            let is_read = matches!(
                (schema.name, schema.levels[level].name),
                ("grip", "close") | ("orders", "complete")
            ) || (matches!(schema.name, "cylinder" | "process") && watched[part]);
            is_read.then(|| memory.number(number, format!("{}.{}", machine.name, port.name), 1, 0))
        }
        _ => None,
    });
    levels.collect()
}

/// The conveyor with commands over which a part is a field.
fn field_over(machine: &Machine, part: usize) -> Option<usize> {
    let Primitive::Zone(field) = &machine.parts[part].primitive else { return None };
    let Primitive::Lane(lane) = &machine.parts[field.lane].primitive else { return None };
    let is_over = is_commanded(machine, field.lane) && lane.centre_line.find(field.middle).is_some();
    is_over.then_some(field.lane)
}

/// A field as a part of its machine.
struct Seen {
    machine: usize,
    field: usize,
    /// The machine, if items neither come nor go while its lane stands.
    stays: Option<usize>,
}

/// None for a field that is not over the lane.
fn zone(
    line: &Line,
    Seen { machine: number, field: part, stays }: Seen,
    lane: &Conveyor,
    field: &Field,
    memory: &mut Memory,
    inputs: &mut Vec<Input>,
) -> Option<Zone> {
    let (middle, _) = lane.centre_line.find(field.middle)?;
    let corner = |along: f64, across: f64| lane.centre_line.point(middle + along, across);
    let half = lane.width / 2.0;
    let corners = [
        corner(-field.half, -half),
        corner(-field.half, half),
        corner(field.half, -half),
        corner(field.half, half),
    ];
    let least = |of: fn(&Point) -> f64| corners.iter().map(of).fold(f64::INFINITY, f64::min);
    let most = |of: fn(&Point) -> f64| corners.iter().map(of).fold(f64::NEG_INFINITY, f64::max);
    // Items come from where places are greater, and are found as soon as they lie wholly in the field.
    let found = line.kinds.iter().enumerate().map(|(number, kind)| {
        let own = (kind.size[0].max(kind.size[1]) / 2.0).max(field.part_half);
        coordinates(corner((field.half - own).max(0.0) - BESIDE * number as f64, 0.0))
    });
    let machine = &line.machines[number];
    let is_seen = machine.wiring.inputs.iter().any(
        |input| matches!(input.source, Source::Signal { part: of, signal } if of == part && signal_name(machine, of, signal).1 == "sees"),
    );
    let sees = line.kinds.iter().map(|kind| {
        is_seen.then(|| {
            let name = format!("{}.(sees {})", machine.name, kind.name);
            inputs.push(Input {
                var: memory.number(number, name, 2, 1),
                low: 0,
                values: 2,
                stays,
                machine: number,
            });
            inputs.len() - 1
        })
    });
    Some(Zone {
        low: [least(|p| p.x), least(|p| p.y)],
        high: [most(|p| p.x), most(|p| p.y)],
        surface: corners[0].z,
        sees: sees.collect(),
        found: found.collect(),
    })
}

/// Items of two kinds do not lie at the same place of a field: one of the next kind lies so far behind, m. Less than what
/// matters to a gripper.
const BESIDE: f64 = 1e-4;

/// What a panel shows that nobody touches: modes are not searched.
fn at_rest(primitive: &Primitive) -> Signal {
    match primitive {
        Primitive::Button(button) => Signal::Fixed(i32::from(button.is_normally_closed)),
        Primitive::Selector(_) => Signal::Fixed(0),
        _ => Signal::Unbounded,
    }
}

/// A signal of a part, and the type of the port that shows it.
struct Shown {
    part: usize,
    signal: usize,
    ty: PortType,
}

/// How an input behaves that shows this signal.
fn signal(
    line: &Line,
    number: usize,
    shown: Shown,
    found: &autogen_search::plant::Machine,
    memory: &mut Memory,
    changing: &mut Changing,
) -> Signal {
    let Shown { part, signal, ty } = shown;
    let machine = &line.machines[number];
    let zone_of = || {
        let (lane, own) = (found.lane.as_ref()?, field_over(machine, part)?);
        // The fields of the lane, in the order of the parts.
        let before = (0..part).filter(|other| field_over(machine, *other) == Some(own)).count();
        lane.zones.get(before)
    };
    match (signal_name(machine, part, signal), &found.arm, &found.route, &found.lane) {
        (("grip", "holds"), Some(arm), ..) => return Signal::Held(arm.shown),
        (("chain", "tool"), Some(arm), ..) => return Signal::At(arm.tool),
        (("route", "position"), _, Some(_), _) => return Signal::Position,
        (("route", "at_stop"), _, Some(_), _) => return Signal::AtStop,
        (("lane", "moves"), .., Some(lane)) if is_commanded(machine, part) => {
            return Signal::Moves(lane.motion, lane.shown);
        }
        (("zone", "sees"), ..) => {
            if let Some(zone) = zone_of() {
                return Signal::Free(zone.sees.iter().copied().flatten().collect());
            }
        }
        (("zone", "foremost"), ..) => {
            if let Some(zone) = zone_of() {
                return Signal::Found(zone.found.clone());
            }
        }
        (("cylinder", name), ..) => {
            if let Some(cylinder) = changing.cylinder(number, part) {
                let end = if name == "is_in" { position::IN } else { position::OUT };
                return Signal::Is(cylinder.position, end);
            }
        }
        (("process", name), ..) => {
            if let Some(process) = changing.process(number, part) {
                return Signal::Held(if name == "runs" { process.runs } else { process.ended });
            }
        }
        (("orders", "open"), ..) => return Signal::IsOpen,
        (("orders", "parts"), ..) => return Signal::Parts,
        (("orders", "number"), ..) => return Signal::OrderNumber,
        _ => {}
    }
    if !machine.monitor.panel.is_empty() && panel::has(&machine.parts[part].name) {
        return at_rest(&machine.parts[part].primitive);
    }
    let schema = &machine.parts[part].schema().signals[signal];
    let (low, values) = match ty {
        PortType::Bool => (0, 2),
        PortType::Int { lo, hi } if i64::from(hi) - i64::from(lo) < 255 => (lo, (hi - lo) as u32 + 1),
        _ => return Signal::Unbounded,
    };
    let elements = schema.extent.elements(line.kinds.len());
    let free = (0..elements).map(|element| {
        let name = format!("{}.({} {})[{element}]", machine.name, machine.parts[part].name, schema.name);
        let var = memory.number(number, name, 255, 0);
        changing.inputs.push(Input { var, low, values, stays: None, machine: number });
        changing.inputs.len() - 1
    });
    Signal::Free(free.collect())
}
