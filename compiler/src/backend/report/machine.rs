//! What stands on the line and of what it consists, for the drawing.

use super::signals::Signal;
use crate::backend::footprint;
use runtime_sim::io_trace::Source;
use runtime_sim::kinematics::links::Joint;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::line::{IoDelay, Line, Obstacle};
use runtime_sim::machine::Machine;
use runtime_sim::part::Primitive;
use runtime_sim::part::lane::CentreLine;
use runtime_sim::part::stroke::Stroke;
use runtime_sim::part::track::Track;
use runtime_sim::point::{Axis, Direction, Point};
use runtime_sim::solid::{Link, Shape, Solid};
use runtime_sim::wiring::{self, Drives};
use serde_json::{Value, json};
use std::collections::HashMap;

/// Edge of the square that stands for an obstacle of which the layout gives no size, m.
const UNKNOWN: f64 = 0.4;

/// All of a line; `signals` are its words by name.
pub fn machines(line: &Line, signals: &[Signal]) -> Vec<Value> {
    let numbers: HashMap<Source, usize> =
        signals.iter().enumerate().map(|(number, signal)| (signal.source, number)).collect();
    let numbered = |(index, machine): (usize, &Machine)| {
        let mut value = self::machine(machine);
        value["lamps"] = (0..machine.parts.len())
            .filter_map(|part| {
                let word = machine.wiring.output_at(Drives::Level { part, level: 0 }, line.kinds.len());
                let signal = word.and_then(|word| numbers.get(&Source::Output { machine: index, word }));
                lamp(machine, part, signal.copied())
            })
            .collect();
        value["beams"] = (0..machine.parts.len())
            .filter_map(|part| {
                let source = wiring::Source::Signal { part, signal: 0 };
                let word = machine.wiring.input_at(source, line.kinds.len());
                let signal = word.and_then(|word| numbers.get(&Source::Input { machine: index, word }));
                beam(machine, part, signal.copied())
            })
            .collect();
        value["measured"] = measured(line, index, &numbers);
        value
    };
    line.machines.iter().enumerate().map(numbered).collect()
}

/// Where a machine is, as its controller has it: what is measured, the number of the signal of x, which those of y and z
/// follow, and how many scans late it is. Null if the motions do not say it, or if the sensor sticks for a time.
fn measured(line: &Line, index: usize, numbers: &HashMap<Source, usize>) -> Value {
    let machine = &line.machines[index];
    let what = |primitive: &Primitive| match primitive {
        Primitive::Chain(_) => Some("tool"),
        Primitive::Route(_) | Primitive::Track(_) => Some("position"),
        _ => None,
    };
    let mut parts = machine.parts.iter().enumerate();
    let Some((part, what)) = parts.find_map(|(part, found)| Some((part, what(&found.primitive)?))) else {
        return Value::Null;
    };
    let word = machine.wiring.input_at(wiring::Source::Signal { part, signal: 0 }, line.kinds.len());
    let signal = word.and_then(|word| numbers.get(&Source::Input { machine: index, word }));
    let sticks = line.scenario.sensors.iter().any(|stuck| {
        stuck.machine == index
            && word.is_some_and(|word| stuck.word < word + 3 && word < stuck.word + stuck.words)
    });
    match (signal, &line.io_delay) {
        (Some(signal), IoDelay::Fixed(late)) if !sticks => {
            json!({ "what": what, "signal": signal, "late": late })
        }
        _ => Value::Null,
    }
}

pub fn obstacles(line: &Line) -> Vec<Value> {
    line.obstacles.iter().map(obstacle).collect()
}

fn machine(machine: &Machine) -> Value {
    let label = footprint::label(machine);
    json!({
        "name": machine.name,
        "pose": point(machine.pose),
        "label": [label.x, label.y],
        "bodies": machine.solids().iter().map(body).collect::<Vec<_>>(),
        "links": links(machine),
        "lanes": of_parts(machine, lane),
        "places": of_parts(machine, place),
        "stops": machine.stops().iter().copied().map(point).collect::<Vec<_>>(),
        "track": machine.track().map(track),
        "cylinders": of_parts(machine, cylinder),
        "rails": rails(machine),
        "gates": of_parts(machine, gate),
    })
}

fn of_parts(machine: &Machine, value: fn(&Machine, usize) -> Option<Value>) -> Vec<Value> {
    (0..machine.parts.len()).filter_map(|part| value(machine, part)).collect()
}

fn obstacle(obstacle: &Obstacle) -> Value {
    let flat = || Solid {
        name: "body".into(),
        link: Link::World,
        pose: Pose { position: obstacle.pose, ..Pose::IDENTITY },
        shape: Shape::Box { size: Point::new(UNKNOWN, UNKNOWN, 0.0) },
        grips: false,
    };
    json!({ "name": obstacle.name, "body": body(&obstacle.solid().unwrap_or_else(flat)) })
}

fn point(point: Point) -> Value {
    json!([point.x, point.y, point.z])
}

/// The rows of the rotation, then the position.
fn pose(pose: &Pose) -> Value {
    let rotation = pose.rotation.iter().flatten().copied();
    json!(rotation.chain([pose.position.x, pose.position.y, pose.position.z]).collect::<Vec<f64>>())
}

fn body(solid: &Solid) -> Value {
    let on = match solid.link {
        Link::World => json!("world"),
        Link::Route => json!("route"),
        Link::Carriage(part) => json!({ "cylinder": part }),
        Link::Joint(joint) => json!({ "joint": joint }),
    };
    let shape = match solid.shape {
        Shape::Box { size } => json!({ "box": point(size) }),
        Shape::Capsule { length, radius } => json!({ "capsule": [length, radius] }),
    };
    json!({ "name": solid.name, "on": on, "pose": pose(&solid.pose), "shape": shape })
}

/// The joints of an arm, from the world on; null for any other machine.
fn links(machine: &Machine) -> Value {
    let Some(arm) = machine.arm() else { return Value::Null };
    let link = |link: runtime_sim::kinematics::links::Link| {
        let joint = match link.joint {
            Joint::Slides(Direction::X) => "x",
            Joint::Slides(Direction::Y) => "y",
            Joint::Slides(Direction::Z) => "z",
            Joint::Turns => "turns",
        };
        json!({ "before": pose(&link.before), "joint": joint, "behind": pose(&link.behind) })
    };
    arm.links().into_iter().map(link).collect()
}

fn lane(machine: &Machine, part: usize) -> Option<Value> {
    let Primitive::Lane(lane) = &machine.parts[part].primitive else { return None };
    let line = match lane.centre_line {
        CentreLine::Axis { along, range, surface } => {
            let along = if along == Axis::X { "x" } else { "y" };
            json!({ "along": along, "range": range, "surface": point(surface) })
        }
        CentreLine::Line { from, length, rise } => {
            json!({ "from": point(from.position), "yaw": from.yaw, "length": length, "rise": rise })
        }
        CentreLine::Arc { from, length, rise, radius } => json!({
            "from": point(from.position), "yaw": from.yaw, "length": length, "rise": rise, "radius": radius
        }),
    };
    Some(json!({
        "part": part, "name": machine.parts[part].name, "on": lane.on, "line": line, "width": lane.width,
        "outline": lane.outline, "speed": lane.speed
    }))
}

/// A floor on which items lie, but on a vehicle on a track, of which the bodies are drawn alone: its corners from above, from the origin of what carries it.
fn place(machine: &Machine, part: usize) -> Option<Value> {
    let Primitive::Place(place) = &machine.parts[part].primitive else { return None };
    if machine.is_on_track(place) {
        return None;
    }
    let corners = place.floor.corners().map(|corner| json!([corner.x, corner.y]));
    Some(json!({
        "part": part, "carried": machine.is_driven(place),
        "on": place.on.filter(|_| machine.strokes_under(place).is_some()), "at": point(place.at), "corners": corners,
        "z": place.floor.middle.z, "orders": machine.is_place_of_orders(part)
    }))
}

/// The track of a vehicle, from above.
fn track(track: &Track) -> Value {
    let flat = |point: Point| json!([point.x, point.y]);
    let sides = track.sides().into_iter().map(|ends| ends.map(flat));
    let goals = track.goals().into_iter().map(flat);
    json!({ "sides": sides.collect::<Vec<_>>(), "places": goals.collect::<Vec<_>>() })
}

fn cylinder(machine: &Machine, part: usize) -> Option<Value> {
    let stroke = machine.parts[part].strokes()?.stroke.map(|stroke| match stroke {
        Stroke::Slides(far) => json!({ "slides": point(far) }),
        Stroke::Turns { pivot, degrees } => json!({ "pivot": point(pivot), "degrees": degrees }),
    });
    Some(json!({ "part": part, "name": machine.parts[part].name, "stroke": stroke }))
}

/// What a cylinder moves into a conveyor, so far from its beginning.
fn gate(machine: &Machine, part: usize) -> Option<Value> {
    let (kind, lane, at, cylinder, onto, width) = match &machine.parts[part].primitive {
        Primitive::Stopper(stopper) => ("stopper", stopper.lane, stopper.at, stopper.cylinder, None, None),
        Primitive::Diverter(d) => ("diverter", d.lane, d.at, d.cylinder, Some(d.onto), None),
        Primitive::Pusher(p) => ("pusher", p.lane, p.at, p.cylinder, Some(p.onto), Some(p.width)),
        _ => return None,
    };
    Some(json!({ "kind": kind, "lane": lane, "at": at, "cylinder": cylinder, "onto": onto, "width": width }))
}

/// With the number of the signal that says whether it is on.
fn lamp(machine: &Machine, part: usize, signal: Option<usize>) -> Option<Value> {
    let Primitive::Lamp(lamp) = &machine.parts[part].primitive else { return None };
    Some(json!({ "at": [lamp.at.x, lamp.at.y], "colour": lamp.colour, "signal": signal }))
}

/// A sensor across a conveyor, so far from its beginning, with the number of the signal that says what it sees.
fn beam(machine: &Machine, part: usize, signal: Option<usize>) -> Option<Value> {
    let Primitive::Beam(beam) = &machine.parts[part].primitive else { return None };
    let name = &machine.parts[part].name;
    Some(json!({ "part": part, "name": name, "lane": beam.lane, "at": beam.at, "signal": signal }))
}

/// Where the axes of an arm may be: a line, or an area.
fn rails(machine: &Machine) -> Vec<Value> {
    let of_axes =
        footprint::shapes(machine).into_iter().filter(|(_, class)| ["rail", "range"].contains(class));
    let corners = |shape: footprint::Shape| match shape {
        footprint::Shape::Line { from, to } => vec![from, to],
        footprint::Shape::Rectangle { centre, size: (x, y) } => {
            let at = |i: f64, j: f64| centre + Point::new(i * x / 2.0, j * y / 2.0, 0.0);
            vec![at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)]
        }
        footprint::Shape::Polygon(points) => points,
        footprint::Shape::Circle { .. } => Vec::new(),
    };
    let rail = |(shape, class)| {
        let points: Vec<Value> = corners(shape).into_iter().map(|p| json!([p.x, p.y])).collect();
        json!({ "points": points, "isArea": class == "range" })
    };
    of_axes.map(rail).collect()
}
