//! Surfaces of conveyors.

use runtime_sim::kinematics::pose::Pose;
use runtime_sim::machine::Machine;
use runtime_sim::part::Primitive;
use runtime_sim::part::lane::{CentreLine, Lane};
use runtime_sim::point::Point;
use runtime_sim::solid::{Link, Shape, Solid};

/// Of a surface, m.
const THICK: f64 = 0.01;
/// An arc is straight for so many degrees at most.
const PIECE: f64 = 15.0;

/// Those of lanes that are given by a frame; lanes along an axis of the world have beds in their devices.
pub fn surfaces(machine: &Machine) -> Vec<Solid> {
    let mut solids = Vec::new();
    for part in &machine.parts {
        if let Primitive::Lane(lane) = &part.primitive {
            solids.extend(pieces(&part.name, lane));
        }
    }
    solids
}

fn pieces(name: &str, lane: &Lane) -> Vec<Solid> {
    let (count, rise) = match lane.centre_line {
        CentreLine::Axis { .. } => return Vec::new(),
        CentreLine::Line { rise, .. } => (1, rise),
        CentreLine::Arc { length, rise, radius, .. } => {
            (((length / radius).to_degrees().abs() / PIECE).ceil().max(1.0) as usize, rise)
        }
    };
    let length = lane.centre_line.length();
    let long = length / count as f64;
    let slope = rise / length;
    let piece = |number: usize| {
        let place = lane.centre_line.begin() - long * (number as f64 + 0.5);
        let level = lane.centre_line.frame(place).pose();
        let over = (1.0 + slope * slope).sqrt();
        let (sin, cos) = (slope / over, 1.0 / over);
        let rotation = [[cos, 0.0, -sin], [0.0, 1.0, 0.0], [sin, 0.0, cos]];
        let below = Point::new(0.0, 0.0, -THICK / 2.0);
        let inclined = level.then(&Pose { rotation, position: Point::default() });
        Solid {
            name: if count == 1 { name.into() } else { format!("{name}_piece_{}", number + 1) },
            link: lane.on.map_or(Link::World, Link::Carriage),
            pose: inclined.then(&Pose { position: below, ..Pose::IDENTITY }),
            shape: Shape::Box { size: Point::new(long * over, lane.width, THICK) },
            grips: false,
        }
    };
    (0..count).map(piece).collect()
}
