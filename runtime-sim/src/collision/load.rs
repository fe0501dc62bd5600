//! The solids of an item with all that lies on it.

use super::body::Piece;
use crate::fingerprint::Fingerprint;
use crate::item::{Names, Shape};
use crate::kinematics::pose::Pose;
use crate::line::Deck;
use crate::plant::Plant;
use crate::point::Point;
use crate::solid;

/// Where its underside is, and its size.
struct Block {
    at: Point,
    size: Point,
}

/// In the frame in which the item has this one.
pub fn pieces(item: usize, frame: &Pose, names: &Names, plant: &Plant) -> Vec<Piece> {
    let mut pieces = Vec::new();
    for other in plant.items().with_loads(item) {
        let (_, on_base) = plant.items().on_base(other);
        let frame = frame.then(&on_base.pose());
        for Block { at, size } in blocks(plant.items().shape(other)) {
            let middle = Pose { position: at.up(size.z / 2.0), ..Pose::IDENTITY };
            pieces.push(Piece::new(names.name(other), &frame.then(&middle), solid::Shape::Box { size }));
        }
    }
    pieces
}

/// Of all that lies on an item, added to what tells the item itself apart.
pub fn with_loads(item: usize, print: Fingerprint, plant: &Plant) -> Fingerprint {
    let items = plant.items();
    let mut numbers: Vec<f64> = Vec::new();
    numbers.extend(items.shape(item).deck.iter().flat_map(|Deck { height, size: [x, y] }| [*height, *x, *y]));
    for other in items.with_loads(item).into_iter().skip(1) {
        let (_, frame) = items.on_base(other);
        let Shape { size, deck } = items.shape(other);
        let deck = deck.map_or([0.0; 3], |Deck { height, size: [x, y] }| [height, x, y]);
        for Point { x, y, z } in [frame.position, size] {
            numbers.extend([x, y, z]);
        }
        numbers.extend(deck.into_iter().chain([frame.yaw]));
    }
    numbers.into_iter().fold(print, Fingerprint::near)
}

/// One box, or what is under the deck and the walls around it.
fn blocks(Shape { size, deck }: Shape) -> Vec<Block> {
    let Some(Deck { height, size: [x, y] }) = deck.filter(|deck| deck.height < size.z) else {
        return vec![Block { at: Point::default(), size }];
    };
    let mut blocks = Vec::new();
    if height > 0.0 {
        blocks.push(Block { at: Point::default(), size: Point { z: height, ..size } });
    }
    let [thick_x, thick_y] = [(size.x - x) / 2.0, (size.y - y) / 2.0];
    for side in [-1.0, 1.0] {
        let [off_x, off_y] = [side * (size.x - thick_x) / 2.0, side * (size.y - thick_y) / 2.0];
        let long = size.z - height;
        blocks.push(Block { at: Point::new(off_x, 0.0, height), size: Point::new(thick_x, size.y, long) });
        blocks.push(Block { at: Point::new(0.0, off_y, height), size: Point::new(x, thick_y, long) });
    }
    blocks
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_has_a_bottom_and_four_walls() {
        let size = Point::new(0.4, 0.3, 0.2);
        let volume = |deck| {
            blocks(Shape { size, deck }).iter().map(|it| it.size.x * it.size.y * it.size.z).sum::<f64>()
        };
        let outer = 0.4 * 0.3 * 0.2;
        assert!((volume(None) - outer).abs() < 1e-12);
        assert!((volume(Some(Deck { height: 0.2, size: [0.4, 0.3] })) - outer).abs() < 1e-12);
        let inner = 0.38 * 0.26 * 0.19;
        let hollow = volume(Some(Deck { height: 0.01, size: [0.38, 0.26] }));
        assert!((hollow - (outer - inner)).abs() < 1e-12, "{hollow}");
    }
}
