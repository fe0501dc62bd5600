//! Logical cameras where the machines' own sensors are.

use super::model::{Camera, Link, Model};
use super::number;
use super::shape::marker;
use runtime_sim::geometry::Geometry;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::point::{Axis, Point};
use std::f64::consts::{FRAC_PI_2, PI};

/// Values of `logical_camera.sdf.template`, ARIAC 2021: Hz, m, and rad. Its noise is left out.
const RATE: u32 = 10;
const NEAR: f64 = 0.2;
const FAR: f64 = 1.1;
const ASPECT_RATIO: f64 = 1.2;
const HORIZONTAL_FOV: f64 = 1.5;

/// Heights over a machine's pose, from the prototype's `sample_user_config.yaml` and from `gear.py`: over the
/// pick zone; over the first stop of a vehicle, where its tray is inspected; over the other stops; over a briefcase.
const OVER_BELT: f64 = 1.5;
const OVER_FIRST_STOP: f64 = 1.507;
const OVER_STOP: f64 = 1.0;
const OVER_STATION: f64 = 2.286;
/// The tray's middle from a stop. The prototype's cameras stand at +0.222, +0.000 and -0.128 m from their stops.
const TRAY_MIDDLE: Point = Point::new(0.15, 0.0, 0.0);
/// The prototype's cameras over stations, from the station's pose; their 36 mm along y differ in sign.
const STATION_MIDDLE: Point = Point::new(0.038, 0.0, 0.0);

/// What is drawn for a camera: length of its edges, m, and colour.
const BODY: f64 = 0.05;
const COLOUR: &str = "0.1 0.1 0.1 1";

/// The camera of a belt or of a station, in the frame of its model.
pub fn camera_over(geometry: &Geometry) -> Option<Link> {
    match geometry {
        Geometry::Belt { orient, .. } => {
            let yaw = match orient {
                Axis::Y => 0.0,
                Axis::X => -FRAC_PI_2,
            };
            Some(link("camera".into(), Point::default().up(OVER_BELT), yaw))
        }
        Geometry::Station { .. } => Some(link("camera".into(), STATION_MIDDLE.up(OVER_STATION), 0.0)),
        _ => None,
    }
}

/// A model with a camera over each stop of a vehicle: it does not move with the vehicle `name`.
pub fn over_stops(name: &str, geometry: &Geometry) -> Option<Model> {
    let start = geometry.pose();
    let links: Vec<Link> = (geometry.stops().iter().enumerate())
        .map(|(i, stop)| {
            let height = if i == 0 { OVER_FIRST_STOP } else { OVER_STOP };
            link(format!("camera_{i}"), (*stop - start + TRAY_MIDDLE).up(height), 0.0)
        })
        .collect();
    // Names of a layout have no two underscores in a row.
    (!links.is_empty()).then(|| Model::of_links(format!("{name}__cameras"), start, links))
}

/// A camera that looks straight down, the longer side of its field along y before it is turned by `yaw`.
fn link(name: String, at: Point, yaw: f64) -> Link {
    let Point { x, y, z } = at;
    Link {
        name,
        relative_to: None,
        pose: number::list(&[x, y, z, PI, FRAC_PI_2, yaw]),
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
