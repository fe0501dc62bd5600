//! The collision shapes of the links as bodies of the device: boxes and capsules that contain them.

use super::chain::{Chain, listed};
use super::read::{Geometry, Motion, Robot, Shape};
use super::tree::Tree;
use super::{Options, stl};
use crate::import::arm::fit::{Fit, JOINTS};
use crate::import::arm::{Body, Form};
use runtime_sim::kinematics::fixed::Geometry as Kinematics;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::point::Point;
use std::f64::consts::PI;

/// Bodies of a device, fewer than its parts may be, and collision shapes that are looked at.
const MOST: usize = 200;
/// What the axis of a cylinder may lack to lie along an axis of the frame.
const ALONG: f64 = 1e-3;

pub fn bodies(
    robot: &Robot,
    tree: &Tree,
    chain: &Chain,
    fit: &Fit,
    options: &Options,
    notes: &mut Vec<String>,
) -> Vec<Body> {
    let zero = [0.0; JOINTS];
    let base = Pose { position: fit.base, ..Pose::turned(Point::default(), fit.yaw.to_radians()) };
    let ours = match &fit.geometry {
        Kinematics::OrthoParallel(opw) => opw.frames(&zero),
        Kinematics::UniversalRobots(lengths) => lengths.frames(&zero),
    };
    // Every link that is fixed to a link of the arm moves with it.
    let mut carried: Vec<(usize, Option<usize>, Pose)> = vec![(chain.base, None, Pose::IDENTITY)];
    for (link, pose) in chain.frames(robot, &zero) {
        if let Some(number) = chain.moving.iter().position(|joint| robot.joints[*joint].child == link) {
            carried.push((link, Some(number), pose));
        }
    }
    let mut next = 0;
    while let Some((link, on, pose)) = carried.get(next).copied() {
        next += 1;
        for joint in tree.below[link].iter().map(|joint| &robot.joints[*joint]) {
            if joint.motion == Motion::Fixed {
                carried.push((joint.child, on, pose.then(&joint.origin)));
            }
        }
    }
    if robot.links.iter().all(|link| link.shapes.is_empty()) {
        notes.push("the file has no collision shapes: add bodies, or contact of the arm is not found".into());
    }
    let others: Vec<&str> = (robot.links.iter().enumerate())
        .filter(|(link, of)| !of.shapes.is_empty() && carried.iter().all(|(carried, ..)| carried != link))
        .map(|(_, link)| link.name.value.as_str())
        .collect();
    if !others.is_empty() {
        notes.push(format!(
            "no body is written for links that do not move with a link of the arm: {}",
            listed(others.into_iter())
        ));
    }
    let mut bodies = Vec::new();
    let mut looked_at = 0;
    let mut told: Vec<(String, Vec<&str>)> = Vec::new();
    let mut tell = |text: String, name| match told.iter_mut().find(|(other, _)| *other == text) {
        Some((_, names)) => names.push(name),
        None => told.push((text, vec![name])),
    };
    'links: for (link, on, pose) in carried {
        let frame = on.map_or(Pose::IDENTITY, |number| base.then(&ours[number]));
        for shape in &robot.links[link].shapes {
            let name = robot.links[link].name.value.as_str();
            looked_at += 1;
            if looked_at > MOST {
                tell(
                    format!("after {MOST} collision shapes the others are left out, from this link on"),
                    name,
                );
                break 'links;
            }
            let seen = pose.then(&shape.origin).seen_from(&frame);
            match form(shape, &seen, options) {
                Ok((form, text)) => {
                    if let Some(text) = text {
                        tell(text, name);
                    }
                    bodies.push(Body { link: name.into(), on, form });
                }
                Err(why) => tell(why, name),
            }
        }
    }
    notes.extend(told.into_iter().map(|(text, names)| format!("{text}: {}", listed(names.into_iter()))));
    bodies
}

/// A box or capsule around a shape, and what is to be told of it; an error says why there is none.
fn form(shape: &Shape, seen: &Pose, options: &Options) -> Result<(Form, Option<String>), String> {
    match &shape.geometry {
        Geometry::Box(size) => {
            let half = size.scaled(0.5);
            let corners = [-1.0, 1.0].into_iter().flat_map(|x| {
                [-1.0, 1.0].into_iter().flat_map(move |y| [-1.0, 1.0].map(|z| Point::new(x, y, z)))
            });
            let corners = corners.map(|sign| Point::new(sign.x * half.x, sign.y * half.y, sign.z * half.z));
            let told = (!is_square(seen)).then(|| {
                "a larger box contains a box that is inclined against the frames of the chain".to_string()
            });
            Ok((bounds(corners, seen).ok_or("no body is written for a box without size")?, told))
        }
        Geometry::Sphere(radius) => {
            let around = Point::new(*radius, *radius, *radius);
            let form = Form::Box { low: seen.position - around, high: seen.position + around };
            Ok((form, Some("a box contains the sphere".into())))
        }
        Geometry::Cylinder { radius, length } => Ok(cylinder(*radius, *length, seen)),
        Geometry::Capsule { radius, length } => Ok(capsule(*radius, *length, seen)),
        Geometry::Mesh { name, scale } => {
            let Some(read) = options.mesh else {
                return Err(
                    "no body is written for a collision shape that is a mesh; `--meshes DIR` reads STL files"
                        .into(),
                );
            };
            let is_stl = name.len() >= 4
                && name.is_char_boundary(name.len() - 4)
                && name[name.len() - 4..].eq_ignore_ascii_case(".stl");
            if !is_stl {
                return Err(format!("no body is written for the mesh {name}: only STL is read"));
            }
            let bytes = read(name).map_err(|why| format!("no body is written for the mesh {name}: {why}"))?;
            let vertices = stl::vertices(&bytes)
                .map_err(|why| format!("no body is written for the mesh {name}: {why}"))?;
            let scaled = vertices.iter().map(|v| Point::new(v.x * scale.x, v.y * scale.y, v.z * scale.z));
            let form = bounds(scaled, seen)
                .ok_or_else(|| format!("no body is written for the mesh {name}: it has no size"))?;
            Ok((form, Some("a box contains the mesh".into())))
        }
    }
}

/// Whether the axes of a frame lie along those of the outer one.
fn is_square(pose: &Pose) -> bool {
    (0..3).all(|axis| along(pose.axis(axis)).is_some())
}

/// Which axis of the frame a direction lies along.
fn along(direction: Point) -> Option<usize> {
    [direction.x, direction.y, direction.z].iter().position(|part| part.abs() > 1.0 - ALONG * ALONG)
}

/// The box around points that are given in the frame `seen`.
fn bounds(points: impl Iterator<Item = Point>, seen: &Pose) -> Option<Form> {
    let least = |a: Point, b: Point| Point::new(a.x.min(b.x), a.y.min(b.y), a.z.min(b.z));
    let most = |a: Point, b: Point| Point::new(a.x.max(b.x), a.y.max(b.y), a.z.max(b.z));
    let points = points.map(|point| seen.point(point));
    let (low, high) = points.fold(None, |found: Option<(Point, Point)>, point| {
        Some(found.map_or((point, point), |(low, high)| (least(low, point), most(high, point))))
    })?;
    let size = high - low;
    (size.x > 0.0 && size.y > 0.0 && size.z > 0.0).then_some(Form::Box { low, high })
}

/// A capsule where the cylinder is long and lies along an axis of the frame, else a box.
fn cylinder(radius: f64, length: f64, seen: &Pose) -> (Form, Option<String>) {
    let direction = seen.axis(2);
    let half = length / 2.0;
    // Half of the box along an axis of the frame to which the cylinder's own has this cosine.
    let reach = |cosine: f64| half * cosine.abs() + radius * (1.0 - cosine * cosine).max(0.0).sqrt();
    let around = Point::new(reach(direction.x), reach(direction.y), reach(direction.z));
    let boxed = Form::Box { low: seen.position - around, high: seen.position + around };
    let capsule = PI * radius * radius * (length + 4.0 / 3.0 * radius);
    match along(direction) {
        Some(axis) if capsule < 4.0 * radius * radius * length => {
            (lying(axis, radius, length, seen), Some("a capsule contains the cylinder".into()))
        }
        _ => (boxed, Some("a box contains the cylinder".into())),
    }
}

/// The same capsule where it lies along an axis of the frame, else a box.
fn capsule(radius: f64, length: f64, seen: &Pose) -> (Form, Option<String>) {
    let direction = seen.axis(2);
    if let Some(axis) = along(direction) {
        return (lying(axis, radius, length, seen), None);
    }
    let reach = |cosine: f64| length / 2.0 * cosine.abs() + radius;
    let around = Point::new(reach(direction.x), reach(direction.y), reach(direction.z));
    let boxed = Form::Box { low: seen.position - around, high: seen.position + around };
    (boxed, Some("a box contains the capsule".into()))
}

/// A capsule along an axis of the frame, about the place `seen`.
fn lying(axis: usize, radius: f64, length: f64, seen: &Pose) -> Form {
    let unit = [Point::new(1.0, 0.0, 0.0), Point::new(0.0, 1.0, 0.0), Point::new(0.0, 0.0, 1.0)][axis];
    let from = seen.position - unit.scaled(length / 2.0);
    Form::Capsule { from, axis, length, radius }
}
