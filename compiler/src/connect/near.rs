//! Which pairs of machines are worth a closer look.

use crate::device::Placed;

/// More than any arm stretches out from its rails and any place lies from its machine's stops: an arm
/// of UR10 type reaches 1.3 m, its torso stands out by less than 1 m, and a tray is shorter than that, m.
const STRETCH: f64 = 5.0;

/// What a machine takes up of the floor: from and to in x, and in y. Of an arm, where its rails bring it;
/// of another machine, where it stops.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground([[f64; 2]; 2]);

impl Ground {
    pub fn of(placed: &Placed) -> Self {
        Self(placed.ground())
    }

    /// Whether one of the two might reach the other. If not, their poses need not be tried.
    pub fn is_near(self, other: Self) -> bool {
        let near = |[a, b]: [f64; 2], [c, d]: [f64; 2]| a - STRETCH <= d && c - STRETCH <= b;
        near(self.0[0], other.0[0]) && near(self.0[1], other.0[1])
    }
}
