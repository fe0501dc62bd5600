//! What bears an item that falls off a conveyor: the highest of what is below.

use super::super::fall::SINK;
use crate::frame::Frame;
use crate::kinematics::facing::Facing;
use crate::line::Line;
use crate::machine::Machine;
use crate::part::lane::{CentreLine, Lane};
use crate::part::place::{Floor, Place};
use crate::part::{Part, Primitive};
use crate::point::Point;

/// All that may bear an item that falls.
pub struct Ground<'a> {
    line: &'a Line,
    bearers: Vec<Bearer>,
}

/// A conveyor or a place.
struct Bearer {
    /// Machine and part.
    part: (usize, usize),
    surface: Surface,
    /// It is always there.
    is_fixed: bool,
}

enum Surface {
    /// Wherever it stops, and half of its width.
    Lane { lines: Vec<CentreLine>, half: f64 },
    /// Wherever it stops.
    Floor { frames: Vec<Frame>, floor: Floor },
    /// On a vehicle, anywhere on its way: between these ends of it, and so far beside.
    Vehicle { sides: Vec<[Point; 2]>, height: f64, reach: f64 },
}

impl<'a> Ground<'a> {
    pub fn new(line: &'a Line) -> Self {
        let mut bearers = Vec::new();
        for (number, machine) in line.machines.iter().enumerate() {
            let parts = machine.parts.iter().enumerate();
            bearers.extend(parts.filter_map(|(part, of)| Bearer::of(machine, of, (number, part))));
        }
        Self { line, bearers }
    }

    /// Machine and part of each that may bear what falls from a point: the highest that is always there, and what may be over
    /// it then.
    pub fn under(&self, from: Point) -> Vec<(usize, usize)> {
        let is_below = |height: &f64| *height <= from.z + SINK;
        let tops = self.line.obstacles.iter().filter_map(|obstacle| obstacle.top_at(from));
        let mut floor = tops.filter(is_below).fold(0.0, f64::max);
        let mut found = Vec::new();
        for bearer in &self.bearers {
            let heights: Vec<f64> = bearer.surface.heights(from).into_iter().filter(is_below).collect();
            let Some(height) = heights.into_iter().reduce(f64::max) else { continue };
            found.push((height, bearer.part));
            if bearer.is_fixed {
                floor = floor.max(height);
            }
        }
        found.into_iter().filter(|(height, _)| *height >= floor).map(|(_, part)| part).collect()
    }
}

impl Bearer {
    fn of(machine: &Machine, part: &Part, number: (usize, usize)) -> Option<Self> {
        let (surface, is_fixed) = match &part.primitive {
            Primitive::Lane(lane) => (Surface::of_lane(machine, lane), lane.on.is_none()),
            Primitive::Place(place) if place.facing == Facing::Down => {
                let is_fixed = place.on.is_none() && !machine.is_place_of_orders(number.1);
                (Surface::of_place(machine, place), is_fixed)
            }
            _ => return None,
        };
        Some(Self { part: number, surface, is_fixed })
    }
}

impl Surface {
    fn of_lane(machine: &Machine, lane: &Lane) -> Self {
        let lines = machine.centre_lines(lane).into_iter().map(|(_, line)| line).collect();
        Self::Lane { lines, half: lane.width / 2.0 }
    }

    fn of_place(machine: &Machine, place: &Place) -> Self {
        let at = Frame::new(place.at, 0.0);
        let carrier = place.on.map(|part| &machine.parts[part]);
        let frames = match carrier.map(|part| &part.primitive) {
            Some(Primitive::Track(track)) => {
                let corners = place.floor.corners().map(|corner| place.at + corner);
                let reach = corners.iter().map(|corner| libm::hypot(corner.x, corner.y)).fold(0.0, f64::max);
                let height = place.at.z + place.floor.middle.z;
                return Self::Vehicle { sides: track.sides(), height, reach };
            }
            Some(Primitive::Route(route)) => route.stops.iter().map(|stop| Frame::new(*stop, 0.0)).collect(),
            _ => match carrier.and_then(|part| part.strokes()) {
                Some(strokes) => {
                    let frame = |out: &f64| strokes.stroke.map_or(at, |stroke| stroke.frame(*out).then(at));
                    strokes.stops.iter().map(frame).collect()
                }
                None => vec![at],
            },
        };
        Self::Floor { frames, floor: place.floor }
    }

    /// Of the surface under or over a point, wherever it may be then.
    fn heights(&self, point: Point) -> Vec<f64> {
        match self {
            Self::Lane { lines, half } => {
                let under = |line: &CentreLine| {
                    let (place, across) = line.find(point)?;
                    (across.abs() <= *half).then(|| line.point(place, across).z)
                };
                lines.iter().filter_map(under).collect()
            }
            Self::Floor { frames, floor } => {
                let under = frames.iter().filter(|frame| floor.is_under(frame.seen(point)));
                under.map(|frame| frame.position.z + floor.middle.z).collect()
            }
            Self::Vehicle { sides, height, reach } => {
                let passes = sides.iter().filter(|side| beside(**side, point) <= *reach);
                passes.map(|[from, _]| from.z + height).collect()
            }
        }
    }
}

/// How far a point is from a straight way, as seen from above, m.
fn beside([from, to]: [Point; 2], point: Point) -> f64 {
    let level = |point: Point| Point { z: 0.0, ..point };
    let (way, off) = (level(to - from), level(point - from));
    let square = way.dot(way);
    let part = if square > 0.0 { (off.dot(way) / square).clamp(0.0, 1.0) } else { 0.0 };
    (off - way.scaled(part)).length()
}
