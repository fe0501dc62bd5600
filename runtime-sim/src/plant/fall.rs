//! Where an item comes to rest that nothing holds any more.

use super::Plant;
use super::loads::OnDeck;
use crate::carrier::Carrier;
use crate::item::block::SAME_HEIGHT;
use crate::point::Point;

/// An item that is let go at most so far below a surface lies on it: the reach of a contact, twice, m.
pub(crate) const SINK: f64 = 0.01;

/// An item that nothing holds.
#[derive(Clone, Copy, Debug)]
pub struct Falling {
    /// Where its underside is.
    pub point: Point,
    /// Where its upper side faces; none: up.
    pub upper: Option<Point>,
    /// Its lengths, m.
    pub size: Point,
    /// About the vertical, rad.
    pub turn: f64,
}

/// The highest surface under an item, or what holds it; the top of an obstacle or the floor, and where the item then
/// rests. It stays there however deep it fell. Items lie on one another only where a place says so, and on a deck.
pub fn fall(plant: &Plant, item: usize, falling: &Falling, ms: f64) -> (Carrier, Point) {
    let point = falling.point;
    let mut lands: Option<(f64, Carrier)> = None;
    for machine in &plant.machines {
        let Some((height, carrier)) = machine.below(falling, ms, &plant.items, &plant.desk) else {
            continue;
        };
        if lands.is_none_or(|(highest, _)| height > highest) {
            lands = Some((height, carrier));
        }
    }
    if let Some(OnDeck { under, block, height, rim, rest }) = plant.on_deck(item, falling, ms) {
        // The place of a box takes its upper side for its surface.
        let is_at_place = |carrier: &Carrier| {
            let base = plant.base_carrier(under);
            matches!(carrier, Carrier::Place { .. })
                && [carrier.machine(), carrier.part()] == [base.machine(), base.part()]
        };
        let is_lower = |(surface, carrier): &(f64, Carrier)| {
            let is_level = (*surface - height).abs() < SAME_HEIGHT;
            // Off a deck it may tip where a place as high bears it.
            let bears = is_level && matches!(carrier, Carrier::Place { .. }) && rest.tips_off.is_some();
            *surface < height + SAME_HEIGHT && !bears || is_at_place(carrier) && *surface <= rim + SAME_HEIGHT
        };
        if lands.as_ref().is_none_or(is_lower) {
            lands = Some((height, Carrier::On { item: under, offset: block.at() }));
        }
    }
    match (lands, to_floor(plant, point)) {
        (Some((height, carrier)), (_, floor)) if height >= floor.z => (carrier, Point { z: height, ..point }),
        (_, on_floor) => on_floor,
    }
}

/// The floor under `point`, or the top of an obstacle.
pub fn to_floor(plant: &Plant, point: Point) -> (Carrier, Point) {
    let tops = plant.obstacles.iter().filter_map(|obstacle| obstacle.top_at(point));
    let floor = tops.filter(|top| *top <= point.z + SINK).fold(0.0, f64::max);
    let point = Point { z: floor, ..point };
    (Carrier::Floor { point }, point)
}
