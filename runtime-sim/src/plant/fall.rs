//! Where an item comes to rest that nothing holds any more.

use super::Plant;
use crate::carrier::Carrier;
use crate::point::Point;

/// An item that is let go at most so far below a surface lies on it: the reach of a contact, twice, m.
const SINK: f64 = 0.01;

/// The highest surface under `point`, or the floor, and where the item then rests. It stays there however
/// deep it fell. Items do not lie on one another.
pub fn fall(plant: &Plant, point: Point) -> (Carrier, Point) {
    let mut lands: Option<(f64, Carrier)> = None;
    for machine in &plant.machines {
        let Some((height, carrier)) = machine.below(point, &plant.items, &plant.desk) else { continue };
        if height <= point.z + SINK && lands.is_none_or(|(highest, _)| height > highest) {
            lands = Some((height, carrier));
        }
    }
    match lands {
        Some((height, carrier)) => (carrier, Point { z: height, ..point }),
        None => {
            let point = Point { z: 0.0, ..point };
            (Carrier::Floor { point }, point)
        }
    }
}
