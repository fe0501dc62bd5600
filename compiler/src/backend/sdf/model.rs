//! Models, links and joints as the templates print them.

use super::inertia::{Inertial, inertial};
use super::number;
use super::shape::{Shape, Surface, shapes};
use askama::Template;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::point::Point;
use runtime_sim::solid::Solid;

#[derive(Template)]
#[template(path = "sdf/model.sdf")]
pub struct Model {
    pub name: String,
    pub is_static: bool,
    pub pose: String,
    pub links: Vec<Link>,
    pub joints: Vec<Joint>,
    /// The link whose frame is that of the tool.
    pub tool: Option<String>,
}

/// A sensor that knows what it sees.
#[derive(Template)]
#[template(path = "sdf/logical_camera.sdf")]
pub struct Camera {
    pub name: &'static str,
    pub pose: String,
    pub rate: u32,
    pub near: f64,
    pub far: f64,
    pub aspect_ratio: f64,
    pub horizontal_fov: f64,
}

pub struct Link {
    pub name: String,
    /// None: the model's frame.
    pub relative_to: Option<String>,
    pub pose: String,
    pub is_weightless: bool,
    /// Links of static models need none.
    pub inertial: Option<Inertial>,
    pub shapes: Vec<Shape>,
    pub sensor: Option<Camera>,
}

pub struct Joint {
    pub name: String,
    pub kind: &'static str,
    pub parent: String,
    pub child: String,
    pub relative_to: String,
    pub pose: String,
    /// None for a fixed joint.
    pub axis: Option<Axis>,
}

pub struct Axis {
    pub xyz: String,
    pub lower: String,
    pub upper: String,
    pub effort: String,
    pub velocity: String,
    pub damping: String,
    pub friction: String,
}

impl Model {
    /// Something that does not move. The solids are in the world's frame, the model stands at `pose`.
    pub fn standing(name: String, pose: Point, solids: &[Solid], surface: Surface) -> Self {
        let from_pose = |solid: &Solid| {
            let mut solid = solid.clone();
            solid.pose.position = solid.pose.position - pose;
            solid
        };
        let solids: Vec<Solid> = solids.iter().map(from_pose).collect();
        let link = Link {
            name: "link".into(),
            relative_to: None,
            pose: number::pose(&Pose::IDENTITY),
            is_weightless: false,
            inertial: None,
            shapes: shapes(solids.iter().map(|solid| (solid, surface))),
            sensor: None,
        };
        Self::of_links(name, pose, vec![link])
    }

    /// Something that moves by joints, in the frame of the world. Nothing of it is there yet.
    pub fn jointed(name: String) -> Self {
        Self { is_static: false, ..Self::of_links(name, Point::default(), Vec::new()) }
    }

    /// A static model at `pose`.
    pub fn of_links(name: String, pose: Point, links: Vec<Link>) -> Self {
        Self {
            name,
            is_static: true,
            pose: number::pose(&Pose { position: pose, ..Pose::IDENTITY }),
            links,
            joints: Vec::new(),
            tool: None,
        }
    }

    /// A vehicle of so many kg at its start, free to be moved.
    pub fn vehicle(name: String, pose: Pose, solids: &[Solid], mass: f64, colour: &str) -> Self {
        let surface = Surface { colour, friction: None };
        let link = Link {
            name: "link".into(),
            relative_to: None,
            pose: number::pose(&Pose::IDENTITY),
            is_weightless: false,
            inertial: Some(inertial(mass, solids)),
            shapes: shapes(solids.iter().map(|solid| (solid, surface))),
            sensor: None,
        };
        Self {
            is_static: false,
            pose: number::pose(&pose),
            ..Self::of_links(name, pose.position, vec![link])
        }
    }
}
