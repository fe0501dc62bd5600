//! Machines from above.

use runtime_sim::frame::Frame;
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::machine::Machine;
use runtime_sim::part::axis::Motion;
use runtime_sim::part::lane::{CentreLine, Lane};
use runtime_sim::part::place::Place;
use runtime_sim::point::{Axis, Point};
use runtime_sim::solid::{self, Link};

/// A part of a machine as it is drawn, in the world's x and y.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Sides along x and y.
    Rectangle {
        centre: Point,
        size: (f64, f64),
    },
    Line {
        from: Point,
        to: Point,
    },
    Circle {
        centre: Point,
        radius: f64,
    },
    Polygon(Vec<Point>),
}

/// The shapes of a machine as it stands at the start, each with its class for the drawing's style.
pub fn shapes(machine: &Machine) -> Vec<(Shape, &'static str)> {
    let mut shapes: Vec<_> = machine.lanes().map(|lane| (of_lane(machine, lane), "belt")).collect();
    if machine.chain().is_some() {
        shapes.extend(of_axes(machine));
    }
    if !shapes.is_empty() {
        return shapes;
    }
    if let Some(start) = machine.start() {
        return of_vehicle(machine, start);
    }
    match machine.places().next() {
        Some(place) => vec![(of_place(place, place.at), "station")],
        None => of_bodies(machine, Link::World, Frame::default(), "station").collect(),
    }
}

/// Where a lane is at the start.
pub fn centre_line(machine: &Machine, lane: &Lane) -> CentreLine {
    let strokes = lane.on.and_then(|part| machine.parts[part].strokes());
    strokes.map_or(lane.centre_line, |strokes| lane.centre_line.moved(strokes.begin()))
}

fn of_lane(machine: &Machine, lane: &Lane) -> Shape {
    let centre_line = centre_line(machine, lane);
    match centre_line {
        CentreLine::Axis { along, range: [low, high], surface } => {
            let (middle, length) = ((low + high) / 2.0, high - low);
            let (centre, size) = match along {
                Axis::X => (Point::new(middle, surface.y, 0.0), (length, lane.outline)),
                Axis::Y => (Point::new(surface.x, middle, 0.0), (lane.outline, length)),
            };
            Shape::Rectangle { centre, size }
        }
        CentreLine::Line { .. } => Shape::Polygon(band(&centre_line, lane.outline, 1)),
        CentreLine::Arc { .. } => Shape::Polygon(band(&centre_line, lane.outline, ARC_SIDES)),
    }
}

/// Straight sides in which an arc is drawn.
const ARC_SIDES: usize = 24;

/// Both sides of a lane of this width, one after another.
fn band(centre_line: &CentreLine, width: f64, pieces: usize) -> Vec<Point> {
    let side = |piece: usize, across: f64| {
        let place = centre_line.end() + centre_line.length() * piece as f64 / pieces as f64;
        centre_line.point(place, across * width / 2.0)
    };
    let there = (0..=pieces).map(|piece| side(piece, 1.0));
    there.chain((0..=pieces).rev().map(|piece| side(piece, -1.0))).collect()
}

/// A place whose origin is at this point.
fn of_place(place: &Place, origin: Point) -> Shape {
    let flat = |point: Point| Point { z: 0.0, ..point };
    let (centre, [x, y]) = match place.drawn {
        Some(size) => (Frame::new(origin, place.floor.yaw), [size.x, size.y]),
        None => {
            let (frame, sides) = place.floor.sides();
            (Frame { position: origin + flat(frame.position), ..frame }, sides)
        }
    };
    rectangle(&centre.pose(), Point::new(x, y, 0.0))
}

/// Where the tool of a Cartesian robot can be; the rail of an arm on one, the range of one on two.
fn of_axes(machine: &Machine) -> Vec<(Shape, &'static str)> {
    if let Some(robot) = machine.arm().as_ref().and_then(|arm| arm.cartesian()) {
        return match robot.ground()[..] {
            [centre] => vec![(Shape::Circle { centre, radius: 0.1 }, "arm")],
            [from, to] => vec![(Shape::Line { from, to }, "rail")],
            _ => vec![(Shape::Polygon(robot.ground()), "range")],
        };
    }
    if let Some([from, to]) = rail(machine) {
        let centre = (from + to).scaled(0.5);
        return vec![(Shape::Line { from, to }, "rail"), (Shape::Circle { centre, radius: 0.22 }, "arm")];
    }
    let axes = machine.axes();
    let pose = machine.pose;
    match axes.iter().map(|axis| axis.motion).collect::<Vec<_>>()[..] {
        [Motion::Slides { range: x, .. }, Motion::Slides { range: y, .. }, ..] => {
            let centre = Point::new((x[0] + x[1]) / 2.0, (y[0] + y[1]) / 2.0, 0.0);
            vec![
                (Shape::Rectangle { centre, size: (x[1] - x[0], y[1] - y[0]) }, "range"),
                (Shape::Circle { centre: pose, radius: 0.3 }, "arm"),
            ]
        }
        _ => vec![(Shape::Circle { centre: pose, radius: 0.22 }, "arm")],
    }
}

/// Both ends of the rail of an arm, as far as its base goes.
pub fn rail(machine: &Machine) -> Option<[Point; 2]> {
    let along_axis = || {
        let [axis] = machine.axes()[..] else { return None };
        let Motion::Slides { along, range } = axis.motion else { return None };
        let line = axis.at().unwrap_or(machine.pose);
        Some(range.map(|end| line.with_coordinate(along, end)))
    };
    machine.riding().or_else(along_axis)
}

/// Where a vehicle goes and stops, the vehicle where it is at the start, and what stands beside it.
fn of_vehicle(machine: &Machine, start: Frame) -> Vec<(Shape, &'static str)> {
    let on_route = machine.places().next().filter(|_| machine.track().is_none());
    let stop = |at: &Point| match on_route {
        Some(place) => of_place(place, *at),
        None => Shape::Circle { centre: *at, radius: 0.06 },
    };
    let path = |[from, to]: [Point; 2]| (Shape::Line { from, to }, "path");
    let mut shapes: Vec<_> = match (machine.track(), machine.stops()) {
        (Some(track), _) => {
            let stops = track.goals().into_iter().map(|at| (stop(&at), "stop"));
            track.sides().into_iter().map(path).chain(stops).collect()
        }
        (None, [first, further @ ..]) => {
            further.iter().flat_map(|at| [(stop(at), "stop"), path([*first, *at])]).collect()
        }
        (None, []) => Vec::new(),
    };
    let vehicle: Vec<_> = match on_route {
        Some(place) => vec![(of_place(place, start.position), "vehicle")],
        None => of_bodies(machine, Link::Route, start, "vehicle").collect(),
    };
    shapes.extend(of_bodies(machine, Link::World, Frame::default(), "station"));
    shapes.extend(vehicle);
    shapes
}

/// The bodies on a link, which is there.
fn of_bodies(
    machine: &Machine,
    link: Link,
    at: Frame,
    class: &'static str,
) -> impl Iterator<Item = (Shape, &'static str)> {
    let solids = machine.solids().into_iter().filter(move |solid| solid.link == link);
    solids.map(move |solid| {
        let pose = at.pose().then(&solid.pose);
        let shape = match solid.shape {
            solid::Shape::Box { size } => rectangle(&pose, size),
            solid::Shape::Capsule { length, radius } => of_capsule(&pose, length, radius),
        };
        (shape, class)
    })
}

/// As long and as wide as it is from above.
fn of_capsule(pose: &Pose, length: f64, radius: f64) -> Shape {
    let half = Point { z: 0.0, ..pose.axis(2).scaled(length / 2.0) };
    if half.length() < radius {
        return Shape::Circle { centre: pose.position, radius: radius + half.length() };
    }
    let ahead = half.scaled((half.length() + radius) / half.length());
    let aside = Point::new(-half.y, half.x, 0.0).scaled(radius / half.length());
    let corners = [ahead - aside, ahead + aside, aside - ahead, Point::default() - ahead - aside];
    Shape::Polygon(corners.map(|corner| pose.position + corner).to_vec())
}

/// Of this length and width, upright.
fn rectangle(pose: &Pose, size: Point) -> Shape {
    if pose.rotation == Pose::IDENTITY.rotation {
        return Shape::Rectangle { centre: pose.position, size: (size.x, size.y) };
    }
    let corner = |x: f64, y: f64| pose.point(Point::new(x * size.x / 2.0, y * size.y / 2.0, 0.0));
    Shape::Polygon(vec![corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)])
}

/// Where the name of a machine is written.
pub fn label(machine: &Machine) -> Point {
    let pose = machine.pose;
    if let Some(track) = machine.track() {
        return track.begin().position + Point::new(0.0, 0.5, 0.0);
    }
    if let Some(lane) = machine.lane() {
        let centre_line = centre_line(machine, lane);
        return match centre_line {
            CentreLine::Axis { along: Axis::X, range: [low, high], .. } => {
                Point::new((low + high) / 2.0, pose.y + lane.outline / 2.0 + 0.2, 0.0)
            }
            CentreLine::Axis { along: Axis::Y, range, .. } => Point::new(pose.x, range[1] + 0.2, 0.0),
            CentreLine::Line { .. } | CentreLine::Arc { .. } => {
                let middle = centre_line.end() + centre_line.length() / 2.0;
                centre_line.point(middle, lane.outline / 2.0 + 0.2)
            }
        };
    }
    if let Some(robot) = machine.arm().as_ref().and_then(|arm| arm.cartesian()) {
        let ground = robot.ground();
        let least = |value: fn(&Point) -> f64| ground.iter().map(value).fold(f64::INFINITY, f64::min);
        return Point::new(least(|point| point.x), least(|point| point.y) - 0.1, 0.0);
    }
    if let Some([from, to]) = rail(machine) {
        return Point::new(from.x.min(to.x), from.y.min(to.y) - 0.35, 0.0);
    }
    if !machine.axes().is_empty() {
        return pose + Point::new(0.0, 0.5, 0.0);
    }
    let shape = machine.places().next().map(|place| of_place(place, pose));
    match shape {
        Some(Shape::Rectangle { centre, size: (_, y) }) => {
            Point { z: 0.0, ..centre } + Point::new(0.0, y / 2.0 + 0.12, 0.0)
        }
        Some(Shape::Polygon(corners)) => {
            let top = corners.iter().map(|corner| corner.y).fold(f64::NEG_INFINITY, f64::max);
            let middle = corners.iter().map(|corner| corner.x).sum::<f64>() / corners.len() as f64;
            Point::new(middle, top + 0.12, 0.0)
        }
        _ => pose + Point::new(0.0, 0.42, 0.0),
    }
}
