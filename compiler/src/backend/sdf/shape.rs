//! Solids as shapes of SDF 1.7, which has no capsule: a cylinder with a ball on either end takes the same room.

use super::number;
use crate::naming::Scope;
use askama::Template;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::point::Point;
use runtime_sim::solid;

#[derive(Template)]
#[template(path = "sdf/shape.sdf")]
pub struct Shape {
    name: String,
    pose: String,
    geometry: String,
    colour: String,
    /// None for what can be seen but not touched.
    contact: Option<Contact>,
}

pub struct Contact {
    /// Coefficient of friction, if the source of the machine gives one.
    pub friction: Option<f64>,
}

/// How the solids of a machine look and feel.
#[derive(Clone, Copy)]
pub struct Surface<'a> {
    pub colour: &'a str,
    /// Coefficient, if the source of the machine gives one.
    pub friction: Option<f64>,
}

/// The shapes of solids, in the frame of their link. Each has a name of its own: that of its solid, if possible.
pub fn shapes<'a>(solids: impl IntoIterator<Item = (&'a solid::Solid, Surface<'a>)>) -> Vec<Shape> {
    let mut names = Scope::default();
    let named = solids.into_iter().map(|(solid, surface)| (names.take(solid.name.clone()), solid, surface));
    let named: Vec<_> = named.collect();
    named.into_iter().flat_map(|(name, solid, surface)| of_solid(name, solid, surface, &mut names)).collect()
}

fn of_solid(name: String, solid: &solid::Solid, surface: Surface, names: &mut Scope) -> Vec<Shape> {
    let shape = |name: String, pose: &Pose, geometry: String| Shape {
        name,
        pose: number::pose(pose),
        geometry,
        colour: surface.colour.to_string(),
        contact: Some(Contact { friction: surface.friction }),
    };
    match solid.shape {
        solid::Shape::Box { size } => vec![shape(name, &solid.pose, cuboid(size))],
        solid::Shape::Capsule { length, radius } => {
            let end = |z: f64| solid.pose.then(&Pose { position: Point::new(0.0, 0.0, z), ..Pose::IDENTITY });
            let ball = format!("<sphere><radius>{}</radius></sphere>", number::length(radius));
            let tube = format!(
                "<cylinder><radius>{}</radius><length>{}</length></cylinder>",
                number::length(radius),
                number::length(length)
            );
            let [lower, upper] = ["lower", "upper"].map(|end| names.take(format!("{name}_{end}_end")));
            vec![
                shape(name, &solid.pose, tube),
                shape(lower, &end(-length / 2.0), ball.clone()),
                shape(upper, &end(length / 2.0), ball),
            ]
        }
    }
}

/// Something small to see where a sensor is.
pub fn marker(name: &str, length: f64, colour: &str) -> Shape {
    Shape {
        name: name.into(),
        pose: number::pose(&Pose::IDENTITY),
        geometry: cuboid(Point::new(length, length, length)),
        colour: colour.to_string(),
        contact: None,
    }
}

fn cuboid(size: Point) -> String {
    format!("<box><size>{}</size></box>", number::point(size))
}
