//! The world as SDF 1.7, for Gazebo 11 and Ignition Gazebo: each machine a model of simple shapes at its place.
//!
//! Whatever moves by joints has the joints of [`runtime_sim::kinematics`], with the same axes and the same
//! zero but for rails: those stand at the middle of their range when their joint is at 0, so that a world
//! opens with every joint within its limits. Shapes are those of [`runtime_sim::solid`].

mod carriage;
mod inertia;
mod lane;
mod model;
mod number;
mod robot;
mod sensor;
mod shape;

use super::{Files, Part, Sink, Text, part};
use crate::naming;
use askama::Template;
use model::Model;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::line::{Line, Obstacle};
use runtime_sim::machine::Machine;
use runtime_sim::part::Primitive;
use runtime_sim::point::Point;
use runtime_sim::solid;
use std::fmt::Formatter;

/// Ambient and diffuse colour of an obstacle, and of a machine of no material.
const OBSTACLE: &str = "0.75 0.75 0.75 1";

/// Floor beyond the outermost machine, m.
const BORDER: f64 = 5.0;

#[derive(Template)]
#[template(path = "sdf/world.sdf")]
struct World<'a> {
    name: String,
    floor: Floor,
    /// Each on lines of its own.
    models: Part<'a>,
}

struct Floor {
    pose: String,
    size: String,
}

/// The files of the folder `world/`; `name` is the layout's.
pub fn files(name: &str, line: &Line) -> Files {
    let mut files = Files::new();
    write(name, line, &mut files);
    files
}

/// Writes the files of the folder `world/`.
pub fn write(name: &str, line: &Line, files: &mut dyn Sink) {
    let machines = || line.machines.iter().flat_map(models);
    let models = part(|f| {
        let mut models = machines().chain(line.obstacles.iter().filter_map(obstacle));
        models.try_for_each(|model| write!(f, "\n{model}"))
    });
    let world = World { name: naming::sdf(name), floor: floor(line), models };
    files.file("factory.sdf", &Text(|f: &mut Formatter| writeln!(f, "{world}")));
}

/// A machine, and the cameras over its stops.
fn models(machine: &Machine) -> impl Iterator<Item = Model> {
    let own = self::machine(naming::sdf(&machine.name), machine);
    [Some(own), sensor::over_stops(machine)].into_iter().flatten()
}

fn machine(name: String, machine: &Machine) -> Model {
    if let Some(arm) = machine.arm() {
        return robot::model(name, machine, &arm);
    }
    let material = machine.parts.iter().find_map(|part| match &part.primitive {
        Primitive::Material(material) => Some(material),
        _ => None,
    });
    let colour = material.map_or(OBSTACLE.to_string(), |m| format!("{} 1", number::list(&m.colour)));
    let mut solids = machine.solids();
    solids.extend(lane::surfaces(machine));
    let is_carried = |solid: &solid::Solid| matches!(solid.link, solid::Link::Carriage(_));
    let friction = material.and_then(|material| material.friction);
    let mut model = match (machine.route(), machine.track()) {
        (Some(route), _) => Model::vehicle(name, at(machine.pose), &solids, route.mass, &colour),
        (_, Some(track)) => Model::vehicle(name, track.begin().pose(), &solids, track.mass, &colour),
        (None, None) if solids.iter().any(is_carried) => {
            carriage::model(name, machine, &solids, friction, &colour)
        }
        (None, None) => Model::standing(name, machine.pose, &solids, friction, &colour),
    };
    model.links.extend(sensor::cameras_over(machine));
    model
}

fn at(position: Point) -> Pose {
    Pose { position, ..Pose::IDENTITY }
}

/// None for an obstacle that takes no room.
fn obstacle(obstacle: &Obstacle) -> Option<Model> {
    let solid = obstacle.solid()?;
    Some(Model::standing(naming::sdf(&obstacle.name), obstacle.pose, &[solid], None, OBSTACLE))
}

/// A floor under every machine and every obstacle.
fn floor(line: &Line) -> Floor {
    let machines = line.machines.iter().flat_map(places);
    let places: Vec<Point> = machines.chain(line.obstacles.iter().map(|o| o.pose)).collect();
    let extent = |coordinate: fn(&Point) -> f64| {
        let values = places.iter().map(coordinate);
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), v| (l.min(v), h.max(v)));
        if low > high { (0.0, 2.0 * BORDER) } else { ((low + high) / 2.0, high - low + 2.0 * BORDER) }
    };
    let ((x, length), (y, width)) = (extent(|p| p.x), extent(|p| p.y));
    let middle = Pose { position: Point::new(x, y, 0.0), ..Pose::IDENTITY };
    Floor { pose: number::pose(&middle), size: number::list(&[length, width]) }
}

/// The outermost places of a machine.
fn places(machine: &Machine) -> Vec<Point> {
    let ends = |solid: &solid::Solid| match solid.shape {
        solid::Shape::Box { size } if solid.link == solid::Link::World => {
            let half = Point::new(size.x / 2.0, size.y / 2.0, 0.0);
            vec![solid.pose.position - half, solid.pose.position + half]
        }
        _ => Vec::new(),
    };
    let turning = machine.turning_points();
    if turning.is_empty() { machine.solids().iter().flat_map(ends).collect() } else { turning }
}
