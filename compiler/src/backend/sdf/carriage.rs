//! Cylinders and positioners: a joint for each that carries something.

use super::inertia::inertial;
use super::model::{Axis, Joint, Link, Model};
use super::number;
use super::shape::{Surface, shapes};
use crate::naming::Scope;
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

/// A machine with what stands of it and all its carriages; the solids are in the frame of the world, those of a carriage as it
/// is at its inner end.
pub fn model(name: String, machine: &Machine, solids: &[Solid], surface: Surface) -> Model {
    let mut model = Model::jointed(name);
    let mut names = Scope::default();
    let stands: Vec<Solid> = on(solids, solid::Link::World);
    let mut parent = "world".to_string();
    if !stands.is_empty() {
        parent = names.take("base_link".into());
        model.joints.push(Joint {
            name: names.take("base_joint".into()),
            kind: "fixed",
            parent: "world".into(),
            child: parent.clone(),
            relative_to: parent.clone(),
            pose: number::pose(&Pose::IDENTITY),
            axis: None,
        });
        model.links.push(link(parent.clone(), Frame::default(), &stands, surface));
    }
    add(&mut model, &mut names, &parent, machine, solids, surface);
    model
}

fn on(solids: &[Solid], link: solid::Link) -> Vec<Solid> {
    solids.iter().filter(|solid| solid.link == link).cloned().collect()
}

fn link(name: String, frame: Frame, solids: &[Solid], surface: Surface) -> Link {
    Link {
        name,
        relative_to: None,
        pose: number::pose(&frame.pose()),
        is_weightless: false,
        inertial: Some(inertial(MASS, solids)),
        shapes: shapes(solids.iter().map(|solid| (solid, surface))),
        sensor: None,
    }
}

/// Adds each cylinder and positioner that carries some of these solids, where it is at the start, behind a link of a model
/// in the frame of the world.
pub fn add(
    model: &mut Model,
    names: &mut Scope,
    parent: &str,
    machine: &Machine,
    solids: &[Solid],
    surface: Surface,
) {
    for (number, part) in machine.parts.iter().enumerate() {
        let carried = on(solids, solid::Link::Carriage(number));
        let Some(strokes) = part.strokes().filter(|_| !carried.is_empty()) else { continue };
        let Some(stroke) = strokes.stroke else { continue };
        let begins = strokes.stops.get(strokes.begins).copied().unwrap_or_default();
        let child = names.take(format!("{}_link", part.name));
        let carries = link(child.clone(), stroke.frame(begins), &carried, surface);
        let (kind, pose, xyz, length) = match stroke {
            Stroke::Slides(far) => {
                ("prismatic", Point::default(), far.scaled(1.0 / far.length()), far.length())
            }
            Stroke::Turns { pivot, degrees } => {
                ("revolute", pivot, Point::new(0.0, 0.0, degrees.signum()), degrees.to_radians().abs())
            }
        };
        model.joints.push(Joint {
            name: names.take(format!("{}_joint", part.name)),
            kind,
            parent: parent.to_owned(),
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
}

/// Parts of the stroke a second, at most.
fn rate(primitive: &Primitive) -> f64 {
    match primitive {
        Primitive::Cylinder(cylinder) => 1000.0 / cylinder.extend_ms.min(cylinder.retract_ms).max(1) as f64,
        Primitive::Positioner(positioner) => positioner.rate,
        _ => 0.0,
    }
}
