//! The layout from above, as SVG: x to the right, y upwards, with an arrow for each edge.

mod arrow;

use super::footprint::{self, Shape};
use crate::connect::Edge;
use arrow::Arrow;
use runtime_sim::line::Line;
use runtime_sim::machine::Machine;
use runtime_sim::part::lane::CentreLine;
use runtime_sim::point::Point;
use std::fmt::Write;

/// Pixels per metre.
const SCALE: f64 = 60.0;
/// Empty border around the machines, m.
const BORDER: f64 = 0.9;
/// The same around names and circles, m.
const MARGIN: f64 = 0.1;
/// Width of a character of a name for each pixel of its height, in wide fonts.
const CHARACTER: f64 = 0.72;
/// Heights of names, pixels.
const NAME: f64 = 16.0;
const SMALL: f64 = 10.0;

/// One drawing; edges are between machines.
pub fn svg(line: &Line, edges: &[Edge]) -> String {
    let mut drawing = Drawing {
        body: String::new(),
        labels: String::new(),
        machines: Extent::NOTHING,
        others: Extent::NOTHING,
    };
    for obstacle in &line.obstacles {
        let size = obstacle.size.unwrap_or(Point::new(0.4, 0.4, 0.0));
        drawing.rectangle(obstacle.pose, (size.x, size.y), "obstacle");
        drawing.label(obstacle.pose, &obstacle.name, ("small", SMALL));
    }
    for machine in &line.machines {
        drawing.machine(machine);
    }
    for edge in edges {
        let (from, to) = (&line.machines[edge.from], &line.machines[edge.to]);
        let arrow = Arrow::between(meeting(from, to, true), meeting(to, from, false));
        drawing.edge(&arrow.outside(&outlines(from), &outlines(to)));
    }
    drawing.finish()
}

/// Where an arrow touches a machine: a vehicle is loaded at its start and unloaded at the first stop to which it goes.
fn meeting(machine: &Machine, other: &Machine, leaves: bool) -> Point {
    if let [start, first, ..] = machine.visited()[..] {
        return if leaves { first } else { start };
    }
    if let Some([from, to]) = footprint::rail(machine) {
        let rail = to - from;
        let part = (other.pose - from).dot(rail) / rail.dot(rail).max(f64::MIN_POSITIVE);
        return from + rail.scaled(part.clamp(0.0, 1.0));
    }
    if let Some(lane) = machine.lane().filter(|lane| !matches!(lane.centre_line, CentreLine::Axis { .. })) {
        return nearest(&footprint::centre_line(machine, lane), other.pose);
    }
    let outlines = outlines(machine);
    match outlines.first() {
        Some(first) if !outlines.iter().any(|shape| arrow::contains(shape, machine.pose)) => middle(first),
        _ => machine.pose,
    }
}

/// The place on a conveyor that is nearest.
fn nearest(line: &CentreLine, other: Point) -> Point {
    let places = (0..=PLACES).map(|place| line.end() + line.length() * place as f64 / PLACES as f64);
    let points = places.map(|place| line.point(place, 0.0));
    let far = |point: &Point| (point.x - other.x).hypot(point.y - other.y);
    points.min_by(|a, b| far(a).total_cmp(&far(b))).unwrap_or(other)
}

/// Pieces of a conveyor that are compared.
const PLACES: usize = 32;

fn middle(shape: &Shape) -> Point {
    match shape {
        Shape::Rectangle { centre, .. } | Shape::Circle { centre, .. } => *centre,
        Shape::Line { from, to } => (*from + *to).scaled(0.5),
        Shape::Polygon(corners) => {
            let sum = corners.iter().fold(Point::default(), |sum, corner| sum + *corner);
            sum.scaled(1.0 / corners.len().max(1) as f64)
        }
    }
}

/// What an arrow does not cross: not where a gantry can be, in which everything else is.
fn outlines(machine: &Machine) -> Vec<Shape> {
    let shapes = footprint::shapes(machine).into_iter().filter(|(_, class)| *class != "range");
    shapes.map(|(shape, _)| shape).collect()
}

struct Drawing {
    body: String,
    /// Drawn over everything else.
    labels: String,
    machines: Extent,
    /// Names and circles.
    others: Extent,
}

/// From the least to the greatest coordinates, m.
#[derive(Clone, Copy)]
struct Extent {
    low: (f64, f64),
    high: (f64, f64),
}

impl Extent {
    const NOTHING: Self = Self { low: (f64::MAX, f64::MAX), high: (f64::MIN, f64::MIN) };

    fn take(&mut self, x: f64, y: f64) {
        self.low = (self.low.0.min(x), self.low.1.min(y));
        self.high = (self.high.0.max(x), self.high.1.max(y));
    }

    fn wider(self, by: f64) -> Self {
        Self { low: (self.low.0 - by, self.low.1 - by), high: (self.high.0 + by, self.high.1 + by) }
    }

    fn with(mut self, other: Self) -> Self {
        self.take(other.low.0, other.low.1);
        self.take(other.high.0, other.high.1);
        self
    }
}

impl Drawing {
    fn machine(&mut self, machine: &Machine) {
        for (shape, class) in footprint::shapes(machine) {
            match shape {
                Shape::Rectangle { centre, size } => self.rectangle(centre, size, class),
                Shape::Line { from, to } => self.line(from, to, class),
                Shape::Circle { centre, radius } => self.circle(centre, radius, class),
                Shape::Polygon(corners) => self.polygon(&corners, class),
            }
        }
        self.label(footprint::label(machine), &machine.name, ("name", NAME));
    }

    fn rectangle(&mut self, centre: Point, (width, height): (f64, f64), class: &str) {
        self.machines.take(centre.x - width / 2.0, centre.y - height / 2.0);
        self.machines.take(centre.x + width / 2.0, centre.y + height / 2.0);
        let (x, y) = (px(centre.x - width / 2.0), py(centre.y + height / 2.0));
        let _ = writeln!(
            self.body,
            "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{:.1}\" height=\"{:.1}\"/>",
            width * SCALE,
            height * SCALE
        );
    }

    fn polygon(&mut self, corners: &[Point], class: &str) {
        corners.iter().for_each(|corner| self.machines.take(corner.x, corner.y));
        let points: Vec<String> = corners.iter().map(|c| format!("{:.1},{:.1}", px(c.x), py(c.y))).collect();
        let _ = writeln!(self.body, "<polygon class=\"{class}\" points=\"{}\"/>", points.join(" "));
    }

    fn circle(&mut self, centre: Point, radius: f64, class: &str) {
        self.machines.take(centre.x, centre.y);
        self.others.take(centre.x - radius, centre.y - radius);
        self.others.take(centre.x + radius, centre.y + radius);
        let _ = writeln!(
            self.body,
            "<circle class=\"{class}\" cx=\"{:.1}\" cy=\"{:.1}\" r=\"{:.1}\"/>",
            px(centre.x),
            py(centre.y),
            radius * SCALE
        );
    }

    fn line(&mut self, from: Point, to: Point, class: &str) {
        self.machines.take(from.x, from.y);
        self.machines.take(to.x, to.y);
        let _ = writeln!(
            self.body,
            "<line class=\"{class}\" x1=\"{:.1}\" y1=\"{:.1}\" x2=\"{:.1}\" y2=\"{:.1}\"/>",
            px(from.x),
            py(from.y),
            px(to.x),
            py(to.y)
        );
    }

    fn edge(&mut self, Arrow { from, bend, to }: &Arrow) {
        let _ = writeln!(
            self.body,
            "<path class=\"edge\" d=\"M {:.1} {:.1} Q {:.1} {:.1} {:.1} {:.1}\"/>",
            px(from.x),
            py(from.y),
            px(bend.x),
            py(bend.y),
            px(to.x),
            py(to.y)
        );
    }

    fn label(&mut self, at: Point, text: &str, (class, height): (&str, f64)) {
        let half = text.chars().count() as f64 * CHARACTER * height / 2.0 / SCALE;
        let height = height / SCALE;
        self.others.take(at.x - half, at.y - height);
        self.others.take(at.x + half, at.y + height);
        let _ = writeln!(
            self.labels,
            "<text class=\"{class}\" x=\"{:.1}\" y=\"{:.1}\">{text}</text>",
            px(at.x),
            py(at.y) + 4.0
        );
    }

    fn finish(self) -> String {
        let Extent { low, high } = match self.body.is_empty() && self.labels.is_empty() {
            true => Extent { low: (0.0, 0.0), high: (1.0, 1.0) }.wider(BORDER),
            false => self.machines.wider(BORDER).with(self.others.wider(MARGIN)),
        };
        let (x, y) = (px(low.0), py(high.1));
        let [width, height] = [high.0 - low.0, high.1 - low.1].map(|length| length * SCALE);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"{x:.1} {y:.1} {width:.1} {height:.1}\" width=\"{width:.0}\" height=\"{height:.0}\">\n\
<defs><marker id=\"head\" viewBox=\"0 0 10 10\" refX=\"9\" refY=\"5\" markerWidth=\"7\" markerHeight=\"7\" orient=\"auto-start-reverse\"><path d=\"M 0 0 L 10 5 L 0 10 z\" fill=\"#b3261e\"/></marker></defs>\n\
<style>{STYLE}</style>\n\
<rect x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\" fill=\"#ffffff\"/>\n{}{}</svg>\n",
            self.body, self.labels
        )
    }
}

const STYLE: &str = "text{font-family:sans-serif;text-anchor:middle}.name{font-size:16px;font-weight:bold;paint-order:stroke;stroke:#fff;stroke-width:3px}\
.small{font-size:10px;fill:#444;paint-order:stroke;stroke:#fff;stroke-width:3px}.obstacle{fill:#eee;stroke:#bbb}.belt{fill:#cfd8dc;stroke:#607d8b}\
.vehicle{fill:#ffe0b2;stroke:#e65100;stroke-width:2}.stop{fill:none;stroke:#e65100;stroke-dasharray:4 4}\
.path{stroke:#e65100;stroke-dasharray:2 6}.rail{stroke:#1565c0;stroke-width:6;opacity:.5}\
.arm{fill:#bbdefb;stroke:#1565c0;stroke-width:2}.range{fill:none;stroke:#1565c0;stroke-dasharray:12 6;opacity:.6}\
.station{fill:#c8e6c9;stroke:#2e7d32;stroke-width:2}.edge{fill:none;stroke:#b3261e;stroke-width:2;marker-end:url(#head);opacity:.8}";

fn px(x: f64) -> f64 {
    x * SCALE
}

fn py(y: f64) -> f64 {
    -y * SCALE
}
