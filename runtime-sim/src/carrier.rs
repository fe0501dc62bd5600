//! What bears an item.

use crate::point::Point;

/// What bears an item. `machine` is an index into the line's machines.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carrier {
    /// Not on the line yet.
    Supply,
    /// `at` is where along the belt it would lie if the belt had not moved since the start of the run,
    /// `across` its distance from the belt's middle line.
    Belt {
        machine: usize,
        at: f64,
        across: f64,
    },
    /// `hang` leads from the tool to the item's underside.
    Gripper {
        machine: usize,
        hang: Point,
    },
    /// `offset` from the vehicle's position.
    Tray {
        machine: usize,
        offset: Point,
    },
    /// `offset` from the station's pose.
    Briefcase {
        machine: usize,
        offset: Point,
    },
    /// `offset` from the bin's pose.
    Bin {
        machine: usize,
        offset: Point,
    },
    Floor {
        point: Point,
    },
    /// It left a belt at its lower end, or lay in a briefcase whose order was made elsewhere.
    Collector,
    /// Taken away in the briefcase of an order.
    Shipped {
        order: usize,
    },
}

impl Carrier {
    pub fn machine(&self) -> Option<usize> {
        match *self {
            Carrier::Belt { machine, .. }
            | Carrier::Gripper { machine, .. }
            | Carrier::Tray { machine, .. }
            | Carrier::Briefcase { machine, .. }
            | Carrier::Bin { machine, .. } => Some(machine),
            Carrier::Supply | Carrier::Floor { .. } | Carrier::Collector | Carrier::Shipped { .. } => None,
        }
    }

    /// Nothing takes an item from there.
    pub fn is_final(&self) -> bool {
        matches!(self, Carrier::Collector | Carrier::Shipped { .. })
    }
}
