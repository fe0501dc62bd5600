//! The space that a body can ever take on its machine.

use super::super::body::Ball;
use super::super::bounds::BoundingBox;
use crate::machine::Machine;
use crate::part::lane::CentreLine;
use crate::part::stroke::Stroke;
use crate::plant::conveyed::Conveyed;
use crate::point::Point;

/// Places on an arc between which an item is taken for somewhere on a straight line, and beside it.
const ARC_PIECES: usize = 16;

/// What a vehicle's body takes at all of its stops and between them, or on all of its track.
pub fn at_stops(machine: &Machine, ball: &Ball) -> BoundingBox {
    if let Some(track) = machine.track() {
        let radius = ball.middle.length() + ball.radius;
        let corners = track.corners().into_iter();
        let boxes = corners.map(|middle| BoundingBox::around(&Ball { middle, radius }));
        return boxes.fold(BoundingBox::NOTHING, |all, next| all.with(&next));
    }
    let boxes = machine.stops().iter().map(|stop| BoundingBox::around(&ball.shifted(*stop)));
    boxes.reduce(|a, b| a.with(&b)).unwrap_or(BoundingBox::around(ball))
}

/// What a body can take on a cylinder or a positioner.
pub fn on_carriage(machine: &Machine, part: usize, ball: &Ball) -> BoundingBox {
    let strokes = machine.parts[part].strokes();
    let stroke = strokes.and_then(|strokes| strokes.stroke);
    stroke.map_or(BoundingBox::around(ball), |stroke| along_stroke(&stroke, ball))
}

fn along_stroke(stroke: &Stroke, ball: &Ball) -> BoundingBox {
    let piece = 1.0 / ARC_PIECES as f64;
    let beside = stroke.path(ball.middle, ball.radius, piece);
    let boxes = (0..=ARC_PIECES).map(|number| {
        let middle = stroke.frame(number as f64 * piece).point(ball.middle);
        BoundingBox::around(&Ball { middle, radius: ball.radius + beside })
    });
    boxes.fold(BoundingBox::NOTHING, |all, next| all.with(&next))
}

/// What an item can take that lies at `place`, at `offset` from the machine's position.
pub fn lying(
    machine: &Machine,
    ball: &Ball,
    place: Point,
    offset: Point,
    conveyed: Option<Conveyed>,
) -> BoundingBox {
    let ball = &about_vertical(ball);
    let here = BoundingBox::around(&ball.shifted(place));
    match (machine.route(), conveyed) {
        (Some(_), _) => at_stops(machine, &ball.shifted(offset)),
        (None, Some(conveyed)) => here.with(&along_conveyor(&conveyed, ball)),
        (None, None) => here,
    }
}

/// However a body is turned about the vertical: what lies on an item may reach beyond it to one side.
fn about_vertical(ball: &Ball) -> Ball {
    let Point { x, y, z } = ball.middle;
    Ball { middle: Point::new(0.0, 0.0, z), radius: ball.radius + libm::hypot(x, y) }
}

/// What an item can take on the rest of its conveyor, wherever that is carried.
fn along_conveyor(conveyed: &Conveyed, ball: &Ball) -> BoundingBox {
    let Conveyed { centre_line, place, across, carried, .. } = conveyed;
    let pieces = if matches!(centre_line, CentreLine::Arc { .. }) { ARC_PIECES } else { 1 };
    let piece = (place - centre_line.end()).max(0.0) / pieces as f64;
    // No point of an arc is farther from the nearest of these places than half of a piece, and what lies outside the
    // middle line by so much more.
    let beside = if pieces > 1 { piece * conveyed.widening() } else { 0.0 };
    let boxes = (0..=pieces).map(|number| {
        let Ball { middle, radius } = ball.shifted(centre_line.point(place - piece * number as f64, *across));
        let ball = Ball { middle, radius: radius + beside };
        carried.map_or(BoundingBox::around(&ball), |carried| along_stroke(&carried.stroke, &ball))
    });
    boxes.fold(BoundingBox::NOTHING, |all, next| all.with(&next))
}
