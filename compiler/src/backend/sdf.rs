//! The world as SDF 1.7, for Gazebo 11 and Ignition Gazebo: each machine a model of simple shapes at its place.
//!
//! Whatever moves by joints has the joints of [`runtime_sim::kinematics`], with the same axes and the same
//! zero but for rails: those stand at the middle of their range when their joint is at 0, so that a world
//! opens with every joint within its limits. Shapes are those of [`runtime_sim::solid`].

mod carriage;
mod floor;
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
use floor::Floor;
use model::Model;
use runtime_sim::line::{Line, Obstacle};
use runtime_sim::machine::Machine;
use runtime_sim::part::Primitive;
use runtime_sim::solid::{Link, Solid};
use shape::Surface;
use std::fmt::Formatter;

/// Ambient and diffuse colour of an obstacle, and of a machine of no material.
const OBSTACLE: &str = "0.75 0.75 0.75 1";

#[derive(Template)]
#[template(path = "sdf/world.sdf")]
struct World<'a> {
    name: String,
    floor: Floor,
    /// Each on lines of its own.
    models: Part<'a>,
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
    let world = World { name: naming::sdf(name), floor: Floor::of(line), models };
    files.file("factory.sdf", &Text(|f: &mut Formatter| writeln!(f, "{world}")));
}

/// A machine in a model of its name; beside a vehicle what stands or moves without it, and the cameras of a machine that
/// moves.
fn models(machine: &Machine) -> impl Iterator<Item = Model> {
    let name = naming::sdf(&machine.name);
    let material = machine.parts.iter().find_map(|part| match &part.primitive {
        Primitive::Material(material) => Some(material),
        _ => None,
    });
    let colour = material.map_or(OBSTACLE.to_string(), |m| format!("{} 1", number::list(&m.colour)));
    let surface = Surface { colour: &colour, friction: material.and_then(|material| material.friction) };
    let lanes = lane::surfaces(machine);
    if let Some(arm) = machine.arm() {
        return [Some(robot::model(name, machine, &arm, &lanes, surface)), None, sensor::beside(machine)]
            .into_iter()
            .flatten();
    }
    let (carried, others): (Vec<Solid>, Vec<Solid>) =
        machine.solids().into_iter().chain(lanes).partition(|solid| solid.link == Link::Route);
    let mass = machine.route().map(|route| route.mass).or(machine.track().map(|track| track.mass));
    let Some((start, mass)) = machine.start().zip(mass) else {
        let mut model = without_vehicle(name, machine, &others, surface);
        if model.is_static {
            model.links.extend(sensor::cameras_over(machine));
            return [Some(model), None, None].into_iter().flatten();
        }
        return [Some(model), None, sensor::beside(machine)].into_iter().flatten();
    };
    // Names of a layout have no two underscores in a row.
    let name_beside = format!("{}__beside", machine.name);
    let beside = (!others.is_empty()).then(|| without_vehicle(name_beside, machine, &others, surface));
    [Some(Model::vehicle(name, start.pose(), &carried, mass, &colour)), beside, sensor::beside(machine)]
        .into_iter()
        .flatten()
}

/// What stands, and what is on cylinders and positioners.
fn without_vehicle(name: String, machine: &Machine, solids: &[Solid], surface: Surface) -> Model {
    if solids.iter().any(|solid| matches!(solid.link, Link::Carriage(_))) {
        return carriage::model(name, machine, solids, surface);
    }
    Model::standing(name, machine.pose, solids, surface)
}

/// None for an obstacle that takes no room.
fn obstacle(obstacle: &Obstacle) -> Option<Model> {
    let solid = obstacle.solid()?;
    let surface = Surface { colour: OBSTACLE, friction: None };
    Some(Model::standing(naming::sdf(&obstacle.name), obstacle.pose, &[solid], surface))
}
