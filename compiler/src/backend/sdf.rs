//! The world as SDF 1.7, for Gazebo 11 and Ignition Gazebo: each machine a model of simple shapes at its place.
//!
//! Whatever moves by joints has the joints of [`runtime_sim::kinematics`], with the same axes and the same
//! zero but for rails: those stand at the middle of their range when their joint is at 0, so that a world
//! opens with every joint within its limits. Shapes are those of [`runtime_sim::solid`].

mod inertia;
mod model;
mod number;
mod robot;
mod sensor;
mod shape;

use super::Files;
use crate::naming;
use askama::Template;
use model::Model;
use runtime_sim::geometry::Geometry;
use runtime_sim::kinematics::arm::Arm;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::line::{Line, Obstacle};
use runtime_sim::point::Point;
use runtime_sim::solid;

/// Ambient and diffuse colours.
const BELT: &str = "0.38 0.49 0.55 1";
const VEHICLE: &str = "0.9 0.45 0.1 1";
const STATION: &str = "0.35 0.65 0.35 1";
const BIN: &str = "0.49 0.82 1 1";
const OBSTACLE: &str = "0.75 0.75 0.75 1";

/// Floor beyond the outermost machine, m.
const BORDER: f64 = 5.0;

#[derive(Template)]
#[template(path = "sdf/world.sdf")]
struct World {
    name: String,
    floor: Floor,
    models: Vec<Model>,
}

struct Floor {
    pose: String,
    size: String,
}

/// The files of the folder `world/`; `name` is the layout's.
pub fn files(name: &str, line: &Line) -> Files {
    let machines = line.machines.iter().flat_map(|machine| {
        let name = naming::sdf(&machine.name);
        let cameras = sensor::over_stops(&machine.name, &machine.geometry);
        [Some(self::machine(name, &machine.geometry)), cameras].into_iter().flatten()
    });
    let world = World {
        name: naming::sdf(name),
        floor: floor(line),
        models: machines.chain(line.obstacles.iter().filter_map(obstacle)).collect(),
    };
    // Writing to memory does not fail.
    let text = world.render().unwrap_or_default();
    Files::from([("factory.sdf".into(), text + "\n")])
}

fn machine(name: String, geometry: &Geometry) -> Model {
    if let Some(arm) = Arm::from_geometry(geometry) {
        return robot::model(name, geometry, &arm);
    }
    let mut model = match geometry {
        Geometry::Vehicle { .. } => Model::vehicle(name, geometry, VEHICLE),
        Geometry::Belt { .. } => Model::belt(name, geometry.pose(), &solid::solids(geometry), BELT),
        Geometry::Bin { .. } => Model::fixed(name, geometry.pose(), &solid::solids(geometry), BIN),
        _ => Model::fixed(name, geometry.pose(), &solid::solids(geometry), STATION),
    };
    model.links.extend(sensor::camera_over(geometry));
    model
}

/// None for an obstacle that takes no room.
fn obstacle(obstacle: &Obstacle) -> Option<Model> {
    let solid = obstacle.solid()?;
    Some(Model::fixed(naming::sdf(&obstacle.name), obstacle.pose, &[solid], OBSTACLE))
}

/// A floor under every machine and every obstacle.
fn floor(line: &Line) -> Floor {
    let machines = line.machines.iter().flat_map(|m| places(&m.geometry));
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
fn places(geometry: &Geometry) -> Vec<Point> {
    let ends = |solid: &solid::Solid| match solid.shape {
        solid::Shape::Box { size } if solid.link == solid::Link::World => {
            let half = Point::new(size.x / 2.0, size.y / 2.0, 0.0);
            vec![solid.pose.position - half, solid.pose.position + half]
        }
        _ => Vec::new(),
    };
    match geometry {
        Geometry::Vehicle { .. } => geometry.stops(),
        _ => solid::solids(geometry).iter().flat_map(ends).collect(),
    }
}
