//! What an item is made of: a box, or a bottom with walls around it.

use super::Dimensions;
use super::block::Block;
use crate::frame::Frame;
use crate::line::Deck;
use crate::point::Point;

impl Dimensions {
    /// In the frame of the item: the whole, or what is under its deck and the walls around that.
    pub fn solids(&self) -> Vec<Block> {
        let block = |size, at| Block::new(size, at, 0.0);
        let Self { size, deck } = *self;
        let Some(Deck { height, size: [x, y] }) = deck.filter(|deck| deck.height < size.z) else {
            return vec![block(size, Point::default())];
        };
        let mut solids = Vec::new();
        if height > 0.0 {
            solids.push(block(Point { z: height, ..size }, Point::default()));
        }
        let [thick_x, thick_y] = [(size.x - x) / 2.0, (size.y - y) / 2.0];
        let long = size.z - height;
        for side in [-1.0, 1.0] {
            let [off_x, off_y] = [side * (size.x - thick_x) / 2.0, side * (size.y - thick_y) / 2.0];
            solids.push(block(Point::new(thick_x, size.y, long), Point::new(off_x, 0.0, height)));
            solids.push(block(Point::new(x, thick_y, long), Point::new(0.0, off_y, height)));
        }
        solids
    }

    /// The same where the item is in this frame.
    pub fn solids_in(&self, frame: Frame) -> Vec<Block> {
        self.solids().iter().map(|solid| solid.in_frame(frame)).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_box_has_a_bottom_and_four_walls() {
        let size = Point::new(0.4, 0.3, 0.2);
        let volume = |deck| -> f64 {
            let solids = Dimensions { size, deck }.solids();
            solids.iter().map(|solid| solid.size().x * solid.size().y * solid.size().z).sum()
        };
        let outer = 0.4 * 0.3 * 0.2;
        assert!((volume(None) - outer).abs() < 1e-12);
        assert!((volume(Some(Deck { height: 0.2, size: [0.4, 0.3] })) - outer).abs() < 1e-12);
        let inner = 0.38 * 0.26 * 0.19;
        let hollow = volume(Some(Deck { height: 0.01, size: [0.38, 0.26] }));
        assert!((hollow - (outer - inner)).abs() < 1e-12, "{hollow}");
    }
}
