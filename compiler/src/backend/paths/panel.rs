//! A frame with axes in which paths are drawn.

use super::outline::{Dot, simplified};
use super::track::Track;
use crate::backend::footprint::{self, Shape};
use runtime_sim::machine::Machine;
use runtime_sim::point::Point;

/// From where the paths are seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// y to the right, x downwards.
    Above,
    /// y to the right, z upwards.
    Side,
}

impl View {
    /// To the right and downwards, in metres.
    fn seen(self, point: Point) -> (f64, f64) {
        match self {
            View::Above => (point.y, point.x),
            View::Side => (point.y, -point.z),
        }
    }

    /// The world's coordinate at so many metres down.
    fn coordinate(self, down: f64) -> f64 {
        match self {
            View::Above => down,
            View::Side => -down,
        }
    }
}

/// Distances between the ticks of an axis, in metres, and how near they may come to one another, in pixels.
const STEPS: [f64; 8] = [0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0];
const TICKS_APART: f64 = 45.0;
/// Lines are drawn so exactly, in pixels.
const TOLERANCE: f64 = 0.2;

/// A frame; all of it in pixels.
pub struct Panel {
    pub id: &'static str,
    view: View,
    pub left: f64,
    pub top: f64,
    pub width: f64,
    pub height: f64,
    scale: f64,
    /// What is at the left upper corner, in metres to the right and downwards.
    corner: (f64, f64),
    pub ticks_below: Vec<Tick>,
    pub ticks_left: Vec<Tick>,
    pub axis: &'static str,
    /// What stands in the background, first one first.
    pub background: Vec<Element>,
    pub labels: Vec<Label>,
    pub lines: Vec<Path>,
}

#[derive(Clone)]
pub struct Tick {
    pub at: f64,
    /// Where the lower edge of its text is, beside a vertical axis.
    pub text_at: f64,
    pub text: String,
}

/// A shape with its class.
pub struct Element {
    pub class: &'static str,
    pub d: String,
}

pub struct Label {
    pub x: f64,
    pub y: f64,
    pub anchor: &'static str,
    pub text: String,
}

/// The path of an item, and its marks.
pub struct Path {
    pub colour: &'static str,
    pub dash: &'static str,
    pub d: String,
    pub begin: String,
    pub handovers: String,
    pub end: String,
}

impl Panel {
    /// A frame around everything between two corners of the world, its left upper corner at `at`.
    pub fn new(id: &'static str, view: View, at: Dot, scale: f64, low: Point, high: Point) -> Self {
        let (a, b) = (view.seen(low), view.seen(high));
        let corner = (a.0.min(b.0), a.1.min(b.1));
        let size = ((b.0 - a.0).abs(), (b.1 - a.1).abs());
        let step = STEPS.into_iter().find(|step| step * scale >= TICKS_APART).unwrap_or(1000.0);
        let ticks = |from: f64, length: f64| {
            let first = (from / step).ceil() as i64;
            (first..).map(move |n| n as f64 * step).take_while(move |tick| *tick <= from + length)
        };
        let place = |start: f64, metres: f64| start + metres * scale;
        let tick = |at: f64, value: f64| Tick {
            at: tenths(at),
            text_at: tenths(at + 4.0),
            text: format!("{}", value + 0.0),
        };
        Self {
            id,
            view,
            left: tenths(at.0),
            top: tenths(at.1),
            width: tenths(size.0 * scale),
            height: tenths(size.1 * scale),
            scale,
            corner,
            ticks_below: ticks(corner.0, size.0).map(|m| tick(place(at.0, m - corner.0), m)).collect(),
            ticks_left: ticks(corner.1, size.1)
                .map(|m| tick(place(at.1, m - corner.1), view.coordinate(m)))
                .collect(),
            axis: "",
            background: Vec::new(),
            labels: Vec::new(),
            lines: Vec::new(),
        }
    }

    pub fn right(&self) -> f64 {
        tenths(self.left + self.width)
    }

    pub fn bottom(&self) -> f64 {
        tenths(self.top + self.height)
    }

    /// Where the name of the vertical axis stands, in its middle.
    pub fn middle(&self) -> f64 {
        tenths(self.top + self.height / 2.0)
    }

    fn dot(&self, point: Point) -> Dot {
        let (right, down) = self.view.seen(point);
        let at = |start: f64, metres: f64| tenths(start + metres * self.scale);
        (at(self.left, right - self.corner.0), at(self.top, down - self.corner.1))
    }

    /// A rectangle on the floor, its sides along x and y.
    pub fn rectangle(&mut self, centre: Point, (x, y): (f64, f64), class: &'static str) {
        let half = Point::new(x / 2.0, y / 2.0, 0.0);
        let (a, b) = (self.dot(centre - half), self.dot(centre + half));
        let d = format!("M{} {}H{}V{}H{}Z", a.0, a.1, b.0, b.1, a.0);
        self.background.push(Element { class, d });
    }

    fn line(&mut self, from: Point, to: Point, class: &'static str) {
        let (a, b) = (self.dot(from), self.dot(to));
        self.background.push(Element { class, d: format!("M{} {}L{} {}", a.0, a.1, b.0, b.1) });
    }

    /// What a machine takes of the floor, and its name beside it.
    pub fn machine(&mut self, machine: &Machine) {
        let mut beside = None;
        for (shape, class) in footprint::shapes(machine) {
            match (shape, class) {
                (Shape::Rectangle { .. }, "range") | (Shape::Circle { .. }, _) => {}
                (Shape::Rectangle { centre, size }, _) => {
                    self.rectangle(centre, size, class);
                    beside = Some((centre, Point::new(size.0 / 2.0, size.1 / 2.0, 0.0), class));
                }
                (Shape::Polygon(corners), _) => {
                    let outline: Vec<String> = corners
                        .iter()
                        .map(|corner| self.dot(*corner))
                        .map(|(x, y)| format!("{x} {y}"))
                        .collect();
                    self.background.push(Element { class, d: format!("M{}Z", outline.join("L")) });
                }
                (Shape::Line { from, to }, _) => {
                    self.line(from, to, class);
                    if class == "rail" {
                        beside = Some((from, Point::default(), class));
                    }
                }
            }
        }
        if let Some((centre, half, class)) = beside {
            self.label(&machine.name, (self.dot(centre - half), self.dot(centre + half)), class);
        }
    }

    /// A surface on which items lie, from the side.
    pub fn support(&mut self, from: Point, to: Point) {
        self.line(from, to, "support");
    }

    /// Within a belt at its right end, under a rail or a vehicle, to the right of anything else. What is out of
    /// the frame has no label.
    fn label(&mut self, text: &str, (a, b): (Dot, Dot), class: &str) {
        let (left, right) = (a.0.min(b.0), a.0.max(b.0));
        let (bottom, middle) = (a.1.max(b.1), f64::midpoint(a.1, b.1));
        if left > self.right() || right < self.left || middle < self.top || middle > self.bottom() {
            return;
        }
        let (x, y, anchor) = match class {
            "belt" => (right.min(self.right()) - 6.0, bottom - 6.0, "end"),
            "rail" => (left.max(self.left) + 6.0, middle + 18.0, "start"),
            "vehicle" => (f64::midpoint(left, right), bottom + 14.0, "middle"),
            _ => (right + 5.0, middle + 4.0, "start"),
        };
        self.labels.push(Label { x: tenths(x), y: tenths(y), anchor, text: text.into() });
    }

    pub fn track(&mut self, track: &Track, colour: &'static str, dash: &'static str) {
        let mut dots: Vec<Dot> = track.points.iter().map(|point| self.dot(*point)).collect();
        dots.dedup();
        let dots = simplified(&dots, TOLERANCE);
        let mut d = String::new();
        for (i, (x, y)) in dots.iter().enumerate() {
            d += &format!("{}{x} {y}", if i == 0 { "M" } else { "L" });
        }
        // A path of one point is seen by its marks only.
        let mark =
            |mark: fn(Dot) -> String, dot: Option<&Dot>| dot.map_or_else(String::new, |dot| mark(*dot));
        self.lines.push(Path {
            colour,
            dash,
            begin: mark(ring, dots.first()),
            end: mark(square, dots.last()),
            handovers: track.handovers.iter().map(|point| disc(self.dot(*point))).collect(),
            d,
        });
    }
}

fn ring((x, y): Dot) -> String {
    format!("M{} {y}a5 5 0 1 0 10 0a5 5 0 1 0 -10 0Z", tenths(x - 5.0))
}

fn disc((x, y): Dot) -> String {
    format!("M{} {y}a2.5 2.5 0 1 0 5 0a2.5 2.5 0 1 0 -5 0Z", tenths(x - 2.5))
}

fn square((x, y): Dot) -> String {
    format!("M{} {}h9v9h-9Z", tenths(x - 4.5), tenths(y - 4.5))
}

/// Rounded to a tenth of a pixel, and never a negative zero.
pub fn tenths(value: f64) -> f64 {
    (value * 10.0).round() / 10.0 + 0.0
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(view: View) -> Panel {
        Panel::new("it", view, (10.0, 20.0), 50.0, Point::new(-8.0, -5.0, 0.0), Point::new(0.0, 5.0, 2.0))
    }

    #[test]
    fn y_points_to_the_right_and_x_downwards() {
        let panel = panel(View::Above);
        assert_eq!((panel.width, panel.height), (500.0, 400.0));
        assert_eq!(panel.dot(Point::new(-8.0, -5.0, 1.0)), (10.0, 20.0));
        assert_eq!(panel.dot(Point::new(-0.5, 4.3, 1.0)), (475.0, 395.0), "right and low");
        let texts: Vec<&str> = panel.ticks_left.iter().map(|tick| tick.text.as_str()).collect();
        assert_eq!(texts, ["-8", "-7", "-6", "-5", "-4", "-3", "-2", "-1", "0"]);
    }

    #[test]
    fn heights_point_upwards() {
        let panel = panel(View::Side);
        assert_eq!((panel.width, panel.height), (500.0, 100.0));
        assert_eq!(panel.dot(Point::new(3.0, 0.0, 2.0)), (260.0, 20.0));
        assert_eq!(panel.dot(Point::new(3.0, 0.0, 0.0)), (260.0, 120.0));
        let texts: Vec<&str> = panel.ticks_left.iter().map(|tick| tick.text.as_str()).collect();
        assert_eq!(texts, ["2", "1", "0"]);
    }
}
