//! Solids as shapes of SDF 1.7, which has no capsule: a cylinder with a ball on either end takes the same room.

use super::number;
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

/// The shapes of a solid, in the frame of its link.
pub fn shapes(solid: &solid::Solid, friction: Option<f64>, colour: &str) -> Vec<Shape> {
    let shape = |name: String, pose: &Pose, geometry: String| Shape {
        name,
        pose: number::pose(pose),
        geometry,
        colour: colour.to_string(),
        contact: Some(Contact { friction }),
    };
    match solid.shape {
        solid::Shape::Box { size } => vec![shape(solid.name.clone(), &solid.pose, cuboid(size))],
        solid::Shape::Capsule { length, radius } => {
            let end = |z: f64| solid.pose.then(&Pose { position: Point::new(0.0, 0.0, z), ..Pose::IDENTITY });
            let ball = format!("<sphere><radius>{}</radius></sphere>", number::length(radius));
            let tube = format!(
                "<cylinder><radius>{}</radius><length>{}</length></cylinder>",
                number::length(radius),
                number::length(length)
            );
            vec![
                shape(solid.name.clone(), &solid.pose, tube),
                shape(format!("{}_lower_end", solid.name), &end(-length / 2.0), ball.clone()),
                shape(format!("{}_upper_end", solid.name), &end(length / 2.0), ball),
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
