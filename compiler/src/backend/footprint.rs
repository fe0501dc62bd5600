//! Machines from above.

use runtime_sim::machine::Machine;
use runtime_sim::part::axis::Motion;
use runtime_sim::part::lane::Lane;
use runtime_sim::part::place::Place;
use runtime_sim::point::{Axis, Point};

/// A part of a machine as it is drawn, in the world's x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
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
}

/// The shapes of a machine, each with its class for the drawing's style.
pub fn shapes(machine: &Machine) -> Vec<(Shape, &'static str)> {
    if let Some(lane) = machine.lane() {
        return vec![(of_lane(lane), "belt")];
    }
    if machine.chain().is_some() {
        return of_axes(machine);
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
    let (middle, length) = ((lane.range[0] + lane.range[1]) / 2.0, lane.range[1] - lane.range[0]);
    let (centre, size) = match lane.along {
        Axis::X => (Point::new(middle, lane.surface.y, 0.0), (length, lane.outline)),
        Axis::Y => (Point::new(lane.surface.x, middle, 0.0), (lane.outline, length)),
    };
    Shape::Rectangle { centre, size }
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

/// The rail of an arm on one, the range of one on two.
fn of_axes(machine: &Machine) -> Vec<(Shape, &'static str)> {
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

/// Boxes that stand.
fn of_bodies(machine: &Machine) -> Vec<(Shape, &'static str)> {
    use runtime_sim::solid::{Link, Shape as Solid};
    let solids = machine.solids().into_iter().filter(|solid| solid.link == Link::World);
    let boxes = solids.filter_map(|solid| match solid.shape {
        Solid::Box { size } => {
            Some((Shape::Rectangle { centre: solid.pose.position, size: (size.x, size.y) }, "station"))
        }
        Solid::Capsule { .. } => None,
    });
    boxes.collect()
}

/// Where the name of a machine is written.
pub fn label(machine: &Machine) -> Point {
    let pose = machine.pose;
    if let Some(lane) = machine.lane() {
        return match lane.along {
            Axis::X => {
                Point::new((lane.range[0] + lane.range[1]) / 2.0, pose.y + lane.outline / 2.0 + 0.2, 0.0)
            }
            Axis::Y => Point::new(pose.x, lane.range[1] + 0.2, 0.0),
        };
    }
    match (machine.axes().first().map(|axis| axis.motion), machine.axes().len()) {
        (Some(Motion::Slides { along: Axis::X, range }), 1) => {
            return Point::new(range[0], pose.y - 0.35, 0.0);
        }
        (Some(Motion::Slides { along: Axis::Y, range }), 1) => {
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
