//! Logical cameras where the machines' own sensors are.

use super::model::{Camera, Link, Model};
use super::number;
use super::shape::marker;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::machine::Machine;
use runtime_sim::part::{self, Primitive};
use runtime_sim::point::Point;
use std::f64::consts::{FRAC_PI_2, PI};

/// Values of `logical_camera.sdf.template`, ARIAC 2021: Hz, m, and rad. Its noise is left out.
const RATE: u32 = 10;
const NEAR: f64 = 0.2;
const FAR: f64 = 1.1;
const ASPECT_RATIO: f64 = 1.2;
const HORIZONTAL_FOV: f64 = 1.5;

/// What is drawn for a camera: length of its edges, m, and colour.
const BODY: f64 = 0.05;
const COLOUR: &str = "0.1 0.1 0.1 1";

/// The cameras of a machine that stands, in the frame of its model.
pub fn cameras_over(machine: &Machine) -> Vec<Link> {
    let places: Vec<Place> = standing(machine).collect();
    let name = |i: usize| if places.len() == 1 { "camera".to_string() } else { format!("camera_{i}") };
    places.iter().enumerate().map(|(i, place)| link(name(i), place)).collect()
}

/// A model with the cameras of a machine that moves: over each stop of a vehicle, and where others stand. None of them moves.
pub fn beside(machine: &Machine) -> Option<Model> {
    let start = machine.pose;
    let over = cameras(machine).filter(|camera| camera.route.is_some());
    let over = over.flat_map(|camera| {
        let stops = machine.stops().iter().zip(&camera.at);
        stops.map(move |(stop, at)| Place { at: *stop - start + *at, yaw: camera.yaw })
    });
    let places = over.chain(standing(machine));
    let links: Vec<Link> = places.enumerate().map(|(i, place)| link(format!("camera_{i}"), &place)).collect();
    // Names of a layout have no two underscores in a row.
    (!links.is_empty()).then(|| Model::of_links(format!("{}__cameras", machine.name), start, links))
}

/// Of a camera, from the pose of its machine.
struct Place {
    at: Point,
    yaw: f64,
}

fn standing(machine: &Machine) -> impl Iterator<Item = Place> {
    let standing = cameras(machine).filter(|camera| camera.route.is_none());
    standing.flat_map(|camera| camera.at.iter().map(|at| Place { at: *at, yaw: camera.yaw }))
}

fn cameras(machine: &Machine) -> impl Iterator<Item = &part::camera::Camera> {
    machine.parts.iter().filter_map(|part| match &part.primitive {
        Primitive::Camera(camera) => Some(camera),
        _ => None,
    })
}

/// A camera that looks straight down, the longer side of its field along y before it is turned by `yaw`.
fn link(name: String, Place { at: Point { x, y, z }, yaw }: &Place) -> Link {
    Link {
        name,
        relative_to: None,
        pose: number::list(&[*x, *y, *z, PI, FRAC_PI_2, *yaw]),
        is_weightless: false,
        inertial: None,
        shapes: vec![marker("body", BODY, COLOUR)],
        sensor: Some(Camera {
            name: "logical_camera",
            pose: number::pose(&Pose::IDENTITY),
            rate: RATE,
            near: NEAR,
            far: FAR,
            aspect_ratio: ASPECT_RATIO,
            horizontal_fov: HORIZONTAL_FOV,
        }),
    }
}
