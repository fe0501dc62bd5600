//! Models, links and joints as the templates print them.

use super::inertia::{Inertial, inertial};
use super::number;
use super::shape::{Shape, shapes};
use askama::Template;
use runtime_sim::geometry::Geometry;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::point::Point;
use runtime_sim::solid::{Solid, solids};

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

/// Friction of the belt's surface (`conveyor_belt/model.sdf`, ARIAC 2021).
const BELT_FRICTION: f64 = 1.0;
/// Of the vehicle and of its tray (`warehouse_robot_ariac/model.sdf`, `kit_tray_ariac/model.sdf`), kg.
const VEHICLE_MASS: f64 = 50.0 + 1.0;

impl Model {
    /// A belt: its surface has friction.
    pub fn belt(name: String, pose: Point, solids: &[Solid], colour: &'static str) -> Self {
        Self::standing(name, pose, solids, Some(BELT_FRICTION), colour)
    }

    /// Something that does not move. The solids are in the world's frame, the model stands at `pose`.
    pub fn fixed(name: String, pose: Point, solids: &[Solid], colour: &'static str) -> Self {
        Self::standing(name, pose, solids, None, colour)
    }

    fn standing(
        name: String,
        pose: Point,
        solids: &[Solid],
        friction: Option<f64>,
        colour: &'static str,
    ) -> Self {
        let from_pose = |solid: &Solid| {
            let mut solid = solid.clone();
            solid.pose.position = solid.pose.position - pose;
            shapes(&solid, friction, colour)
        };
        let link = Link {
            name: "link".into(),
            relative_to: None,
            pose: number::pose(&Pose::IDENTITY),
            is_weightless: false,
            inertial: None,
            shapes: solids.iter().flat_map(from_pose).collect(),
            sensor: None,
        };
        Self::of_links(name, pose, vec![link])
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

    /// A vehicle at its start, free to be moved.
    pub fn vehicle(name: String, geometry: &Geometry, colour: &'static str) -> Self {
        let solids = solids(geometry);
        let link = Link {
            name: "link".into(),
            relative_to: None,
            pose: number::pose(&Pose::IDENTITY),
            is_weightless: false,
            inertial: Some(inertial(VEHICLE_MASS, &solids)),
            shapes: solids.iter().flat_map(|s| shapes(s, None, colour)).collect(),
            sensor: None,
        };
        Self { is_static: false, ..Self::of_links(name, geometry.pose(), vec![link]) }
    }
}
