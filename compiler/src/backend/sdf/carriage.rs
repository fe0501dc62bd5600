//! Machines with something on cylinders or positioners: a joint for each of these.

use super::inertia::inertial;
use super::model::{Axis, Joint, Link, Model};
use super::number;
use super::shape::shapes;
use runtime_sim::frame::Frame;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::machine::Machine;
use runtime_sim::part::Primitive;
use runtime_sim::part::stroke::Stroke;
use runtime_sim::point::Point;
use runtime_sim::solid::{self, Solid};

/// Of what stands, and of what is on one cylinder or positioner, kg. Devices do not say them.
const MASS: f64 = 10.0;
/// N or N m.
const EFFORT: f64 = 1000.0;

/// The model with each cylinder and positioner where it is at the start; the solids are in the world's frame at its inner end.
pub fn model(
    name: String,
    machine: &Machine,
    solids: &[Solid],
    friction: Option<f64>,
    colour: &str,
) -> Model {
    let mut model = Model { is_static: false, ..Model::of_links(name, Point::default(), Vec::new()) };
    let on =
        |link: solid::Link| -> Vec<Solid> { solids.iter().filter(|s| s.link == link).cloned().collect() };
    let link = |name: String, frame: Frame, solids: &[Solid]| Link {
        name,
        relative_to: None,
        pose: number::pose(&frame.pose()),
        is_weightless: false,
        inertial: Some(inertial(MASS, solids)),
        shapes: solids.iter().flat_map(|s| shapes(s, friction, colour)).collect(),
        sensor: None,
    };
    let base = on(solid::Link::World);
    let mut parent = "world".to_string();
    if !base.is_empty() {
        parent = "base_link".into();
        model.joints.push(Joint {
            name: "base_joint".into(),
            kind: "fixed",
            parent: "world".into(),
            child: parent.clone(),
            relative_to: parent.clone(),
            pose: number::pose(&Pose::IDENTITY),
            axis: None,
        });
        model.links.push(link(parent.clone(), Frame::default(), &base));
    }
    for (number, part) in machine.parts.iter().enumerate() {
        let carried = on(solid::Link::Carriage(number));
        let Some(strokes) = part.strokes().filter(|_| !carried.is_empty()) else { continue };
        let Some(stroke) = strokes.stroke else { continue };
        let begins = strokes.stops.get(strokes.begins).copied().unwrap_or_default();
        let child = format!("{}_link", part.name);
        let carries = link(child.clone(), stroke.frame(begins), &carried);
        let (kind, pose, xyz, length) = match stroke {
            Stroke::Slides(far) => {
                ("prismatic", Point::default(), far.scaled(1.0 / far.length()), far.length())
            }
            Stroke::Turns { pivot, degrees } => {
                ("revolute", pivot, Point::new(0.0, 0.0, degrees.signum()), degrees.to_radians().abs())
            }
        };
        model.joints.push(Joint {
            name: format!("{}_joint", part.name),
            kind,
            parent: parent.clone(),
            relative_to: child.clone(),
            child,
            pose: number::pose(&Pose { position: pose, ..Pose::IDENTITY }),
            axis: Some(Axis {
                xyz: number::point(xyz),
                lower: number::length(-begins * length),
                upper: number::length((1.0 - begins) * length),
                effort: number::length(EFFORT),
                velocity: number::length(rate(&part.primitive) * length),
                damping: number::length(0.0),
                friction: number::length(0.0),
            }),
        });
        model.links.push(carries);
    }
    model
}

/// Parts of the stroke a second, at most.
fn rate(primitive: &Primitive) -> f64 {
    match primitive {
        Primitive::Cylinder(cylinder) => 1000.0 / cylinder.extend_ms.min(cylinder.retract_ms).max(1) as f64,
        Primitive::Positioner(positioner) => positioner.rate,
        _ => 0.0,
    }
}
