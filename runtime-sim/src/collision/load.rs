//! The solids of an item with all that lies on it.

use super::body::Piece;
use crate::fingerprint::Fingerprint;
use crate::item::{Dimensions, Names};
use crate::kinematics::pose::Pose;
use crate::line::Deck;
use crate::plant::Plant;
use crate::point::Point;
use crate::solid;

/// In the frame in which the item has this one.
pub fn pieces(item: usize, frame: &Pose, names: &Names, plant: &Plant) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for other in plant.items().with_loads(item) {
        let (_, on_base) = plant.items().on_base(other);
        let frame = frame.then(&on_base.pose());
        for block in plant.items().dimensions(other).solids() {
            let size = block.size();
            let middle = Pose { position: block.at().up(size.z / 2.0), ..Pose::IDENTITY };
            pieces.push(Piece::new(names.name(other), &frame.then(&middle), solid::Shape::Box { size }));
        }
    }
    pieces
}

/// Of all that lies on an item, added to what tells the item itself apart.
pub fn with_loads(item: usize, print: Fingerprint, plant: &Plant) -> Fingerprint {
    let items = plant.items();
    let mut numbers: Vec<f64> = Vec::new();
    numbers.extend(
        items.dimensions(item).deck.iter().flat_map(|Deck { height, size: [x, y] }| [*height, *x, *y]),
    );
    for other in items.with_loads(item).skip(1) {
        let (_, frame) = items.on_base(other);
        let Dimensions { size, deck } = items.dimensions(other);
        let deck = deck.map_or([0.0; 3], |Deck { height, size: [x, y] }| [height, x, y]);
        for Point { x, y, z } in [frame.position, size] {
            numbers.extend([x, y, z]);
        }
        numbers.extend(deck.into_iter().chain([frame.yaw]));
    }
    numbers.into_iter().fold(print, Fingerprint::near)
}
