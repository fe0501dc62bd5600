//! Where tools can be, and where items can lie, at any time: for questions that no run answers.

use super::body::Ball;
use super::bounds::{BoundingBox, Chain};
use super::group::extent::{at_stops, on_carriage};
use crate::machine::Machine;
use crate::part::Primitive;
use crate::part::lane::Lane;
use crate::part::place::Place;
use crate::point::Point;

/// A conveyor is taken for so many pieces.
const PIECES: usize = 32;

/// Contains all places of the tool of an arm; none of a machine without one.
pub fn of_tool(machine: &Machine) -> Option<BoundingBox> {
    let arm = machine.arm()?;
    let (start, chain) = (arm.start(), Chain::new(&arm, machine));
    let length = (arm.tool(&start) - arm.frames(&start)[chain.last()].position).length();
    Some(chain.bounds(chain.last(), &Ball { middle: Point::default(), radius: length }))
}

/// Contains all places of the middles of items on the conveyors and places of a machine; none of one without these.
pub fn of_items(machine: &Machine) -> Option<BoundingBox> {
    let of_part = |primitive: &Primitive| match primitive {
        Primitive::Lane(lane) => Some(on_lane(machine, lane)),
        Primitive::Place(place) => Some(on_place(machine, place)),
        _ => None,
    };
    machine.parts.iter().filter_map(|part| of_part(&part.primitive)).reduce(|a, b| a.with(&b))
}

fn on_lane(machine: &Machine, lane: &Lane) -> BoundingBox {
    let piece = lane.centre_line.length() / PIECES as f64;
    let radius = (lane.width + piece) / 2.0;
    let balls = (0..=PIECES).map(|number| {
        let middle = lane.centre_line.point(lane.centre_line.begin() - piece * number as f64, 0.0);
        Ball { middle, radius }
    });
    let boxes = balls.map(|ball| match lane.on {
        Some(part) => on_carriage(machine, part, &ball),
        None => BoundingBox::around(&ball),
    });
    boxes.fold(BoundingBox::NOTHING, |all, next| all.with(&next))
}

fn on_place(machine: &Machine, place: &Place) -> BoundingBox {
    let is_driven = machine.is_driven(place);
    // On a vehicle from where it stands.
    let origin = if is_driven { Point::default() } else { place.at };
    let farthest = |[low, high]: [f64; 2]| low.abs().max(high.abs());
    let floor = Ball {
        middle: origin + place.floor.middle,
        radius: libm::hypot(farthest(place.floor.x), farthest(place.floor.y)),
    };
    let slots = place.slots.iter().map(|slot| Ball { middle: origin + *slot, radius: 0.0 });
    let boxes = std::iter::once(floor).chain(slots).map(|ball| match place.on {
        Some(_) if is_driven || machine.is_on_track(place) => at_stops(machine, &ball),
        Some(part) => on_carriage(machine, part, &ball),
        None => BoundingBox::around(&ball),
    });
    boxes.fold(BoundingBox::NOTHING, |all, next| all.with(&next))
}
