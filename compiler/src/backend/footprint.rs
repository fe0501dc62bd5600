//! Machines from above.

use runtime_sim::kinematics::pose::Pose;
use runtime_sim::machine::Machine;
use runtime_sim::part::axis::Motion;
use runtime_sim::part::lane::{CentreLine, Lane};
use runtime_sim::part::place::Place;
use runtime_sim::part::track::Track;
use runtime_sim::point::{Axis, Direction, Point};

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

/// The shapes of a machine, each with its class for the drawing's style.
pub fn shapes(machine: &Machine) -> Vec<(Shape, &'static str)> {
    if machine.lane().is_some() {
        return machine.lanes().map(|lane| (of_lane(lane), "belt")).collect();
    }
    if machine.chain().is_some() {
        return of_axes(machine);
    }
    if let Some(track) = machine.track() {
        return of_track(machine, track);
    }
    let Some(place) = machine.places().next() else { return of_bodies(machine) };
    let [start, further @ ..] = machine.stops() else {
        return vec![(of_place(place, place.at), "station")];
    };
    let at = |stop: &Point| (of_place(place, *stop), Shape::Line { from: *start, to: *stop });
    let stops = further.iter().map(at).flat_map(|(place, path)| [(place, "stop"), (path, "path")]);
    stops.chain([(of_place(place, *start), "vehicle")]).collect()
}

fn of_lane(lane: &Lane) -> Shape {
    match lane.centre_line {
        CentreLine::Axis { along, range: [low, high], surface } => {
            let (middle, length) = ((low + high) / 2.0, high - low);
            let (centre, size) = match along {
                Axis::X => (Point::new(middle, surface.y, 0.0), (length, lane.outline)),
                Axis::Y => (Point::new(surface.x, middle, 0.0), (lane.outline, length)),
            };
            Shape::Rectangle { centre, size }
        }
        CentreLine::Line { .. } => Shape::Polygon(band(lane, 1)),
        CentreLine::Arc { .. } => Shape::Polygon(band(lane, ARC_SIDES)),
    }
}

/// Straight sides in which an arc is drawn.
const ARC_SIDES: usize = 24;

/// Both sides of a lane, one after another.
fn band(lane: &Lane, pieces: usize) -> Vec<Point> {
    let side = |piece: usize, across: f64| {
        let place = lane.centre_line.end() + lane.centre_line.length() * piece as f64 / pieces as f64;
        lane.centre_line.point(place, across * lane.outline / 2.0)
    };
    let there = (0..=pieces).map(|piece| side(piece, 1.0));
    there.chain((0..=pieces).rev().map(|piece| side(piece, -1.0))).collect()
}

/// A place whose origin is at this point.
fn of_place(place: &Place, origin: Point) -> Shape {
    match place.drawn {
        Some(size) => Shape::Rectangle { centre: origin, size: (size.x, size.y) },
        None => {
            let middle = |[low, high]: [f64; 2]| (low + high) / 2.0;
            let aside = Point::new(middle(place.floor_x), middle(place.floor_y), 0.0);
            let size = (place.floor_x[1] - place.floor_x[0], place.floor_y[1] - place.floor_y[0]);
            let floor = Point { z: 0.0, ..place.floor };
            Shape::Rectangle { centre: origin + floor + aside, size }
        }
    }
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
    if let Some([from, to]) = machine.riding() {
        let centre = (from + to).scaled(0.5);
        return vec![(Shape::Line { from, to }, "rail"), (Shape::Circle { centre, radius: 0.22 }, "arm")];
    }
    let axes = machine.axes();
    let pose = machine.pose;
    match axes.iter().map(|axis| axis.motion).collect::<Vec<_>>()[..] {
        [Motion::Slides { along, range: [low, high] }] => {
            let end = |at: f64| pose.with_coordinate(along, at);
            vec![
                (Shape::Line { from: end(low), to: end(high) }, "rail"),
                (Shape::Circle { centre: end((low + high) / 2.0), radius: 0.22 }, "arm"),
            ]
        }
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

/// The track of a vehicle, its places, and the vehicle where it is at the start.
fn of_track(machine: &Machine, track: &Track) -> Vec<(Shape, &'static str)> {
    use runtime_sim::solid::Shape as Solid;
    let sides = track.sides().into_iter().map(|[from, to]| (Shape::Line { from, to }, "path"));
    let goals = track.goals().into_iter();
    let places = goals.map(|centre| (Shape::Circle { centre, radius: 0.06 }, "stop"));
    let start = track.begin().pose();
    let bodies = machine.solids().into_iter().filter_map(|solid| match solid.shape {
        Solid::Box { size } => Some((of_box(&start.then(&solid.pose), size), "vehicle")),
        Solid::Capsule { .. } => None,
    });
    sides.chain(places).chain(bodies).collect()
}

/// Boxes that stand.
fn of_bodies(machine: &Machine) -> Vec<(Shape, &'static str)> {
    use runtime_sim::solid::{Link, Shape as Solid};
    let solids = machine.solids().into_iter().filter(|solid| solid.link == Link::World);
    let boxes = solids.filter_map(|solid| match solid.shape {
        Solid::Box { size } => Some((of_box(&solid.pose, size), "station")),
        Solid::Capsule { .. } => None,
    });
    boxes.collect()
}

/// A box that stands upright.
fn of_box(pose: &Pose, size: Point) -> Shape {
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
        return match lane.centre_line {
            CentreLine::Axis { along: Axis::X, range: [low, high], .. } => {
                Point::new((low + high) / 2.0, pose.y + lane.outline / 2.0 + 0.2, 0.0)
            }
            CentreLine::Axis { along: Axis::Y, range, .. } => Point::new(pose.x, range[1] + 0.2, 0.0),
            CentreLine::Line { .. } | CentreLine::Arc { .. } => {
                let middle = lane.centre_line.end() + lane.centre_line.length() / 2.0;
                lane.centre_line.point(middle, lane.outline / 2.0 + 0.2)
            }
        };
    }
    if let Some(robot) = machine.arm().as_ref().and_then(|arm| arm.cartesian()) {
        let ground = robot.ground();
        let least = |value: fn(&Point) -> f64| ground.iter().map(value).fold(f64::INFINITY, f64::min);
        return Point::new(least(|point| point.x), least(|point| point.y) - 0.1, 0.0);
    }
    if let Some([from, to]) = machine.riding() {
        return Point::new(from.x.min(to.x), from.y.min(to.y) - 0.35, 0.0);
    }
    match (machine.axes().first().map(|axis| axis.motion), machine.axes().len()) {
        (Some(Motion::Slides { along: Direction::X, range }), 1) => {
            return Point::new(range[0], pose.y - 0.35, 0.0);
        }
        (Some(Motion::Slides { along: Direction::Y, range }), 1) => {
            return Point::new(pose.x, range[0] - 0.35, 0.0);
        }
        (Some(_), _) => return pose + Point::new(0.0, 0.5, 0.0),
        (None, _) => {}
    }
    let shape = machine.places().next().map(|place| of_place(place, pose));
    match shape {
        Some(Shape::Rectangle { centre, size: (_, y) }) => {
            Point { z: 0.0, ..centre } + Point::new(0.0, y / 2.0 + 0.12, 0.0)
        }
        _ => pose + Point::new(0.0, 0.42, 0.0),
    }
}
