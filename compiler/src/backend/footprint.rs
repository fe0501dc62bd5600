//! Machines from above.

use runtime_sim::geometry::{Geometry, TRAY, TRAY_MIDDLE};
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

/// Width of a conveyor (competition specification).
const BELT_WIDTH: f64 = 0.65;
/// Stations and bins.
const TABLE: (f64, f64) = (0.6, 0.6);

/// The shapes of a machine, each with its class for the drawing's style.
pub fn shapes(geometry: &Geometry) -> Vec<(Shape, &'static str)> {
    match geometry {
        Geometry::Belt { pose, orient, orient_range } => {
            let (middle, length) =
                ((orient_range[0] + orient_range[1]) / 2.0, orient_range[1] - orient_range[0]);
            let (centre, size) = match orient {
                Axis::X => (Point::new(middle, pose.y, 0.0), (length, BELT_WIDTH)),
                Axis::Y => (Point::new(pose.x, middle, 0.0), (BELT_WIDTH, length)),
            };
            vec![(Shape::Rectangle { centre, size }, "belt")]
        }
        Geometry::Vehicle { pose, destinations } => {
            let tray =
                |stop: Point| Shape::Rectangle { centre: stop + TRAY_MIDDLE, size: (TRAY[0], TRAY[1]) };
            let way = |to: Point| Shape::Line { from: *pose, to };
            let mut shapes: Vec<_> =
                destinations.iter().flat_map(|&stop| [(tray(stop), "stop"), (way(stop), "path")]).collect();
            shapes.push((tray(*pose), "vehicle"));
            shapes
        }
        Geometry::RailArm { rail_dim, rail_range: [low, high], .. } => {
            let pose = geometry.pose();
            let end = |along: f64| match rail_dim {
                Axis::X => Point::new(along, pose.y, 0.0),
                Axis::Y => Point::new(pose.x, along, 0.0),
            };
            vec![
                (Shape::Line { from: end(*low), to: end(*high) }, "rail"),
                (Shape::Circle { centre: end((low + high) / 2.0), radius: 0.22 }, "arm"),
            ]
        }
        Geometry::Gantry { x_rail_range: x, y_rail_range: y, .. } => {
            let centre = Point::new((x[0] + x[1]) / 2.0, (y[0] + y[1]) / 2.0, 0.0);
            vec![
                (Shape::Rectangle { centre, size: (x[1] - x[0], y[1] - y[0]) }, "range"),
                (Shape::Circle { centre: geometry.pose(), radius: 0.3 }, "arm"),
            ]
        }
        Geometry::Station { pose } | Geometry::Bin { pose } => {
            vec![(Shape::Rectangle { centre: *pose, size: TABLE }, "station")]
        }
    }
}
