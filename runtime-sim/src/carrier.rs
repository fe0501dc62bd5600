//! What bears an item.

use crate::point::Point;

/// What bears an item. `machine` is an index into the line's machines, `part` one into the parts of the machine.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Carrier {
    /// Not on the line yet.
    Supply,
    /// `at` is where along the lane it would lie if the lane had not moved since the start of the run,
    /// `across` its distance from the lane's middle line.
    Lane { machine: usize, part: usize, at: f64, across: f64 },
    /// `hang` leads from the tool to the item's underside, in the frame of the tool: the item is rigid with it.
    Grip { machine: usize, part: usize, hang: Point },
    /// `offset` from the origin of what carries the place.
    Place { machine: usize, part: usize, offset: Point },
    /// On another item, with which it goes on: `offset` from the middle of the underside of that, in its frame.
    On { item: usize, offset: Point },
    /// On the ground, or on an obstacle.
    Floor { point: Point },
    /// It left a lane where that has a sink, `part` of the machine.
    Sink { machine: usize, part: usize },
    /// It lay at a place whose order was made elsewhere, or a person took it away.
    Collector,
    /// It has become a part of another item.
    Part { of: usize },
    /// Taken away with an order.
    Shipped { order: usize },
}

impl Carrier {
    pub fn machine(&self) -> Option<usize> {
        match *self {
            Carrier::Lane { machine, .. }
            | Carrier::Grip { machine, .. }
            | Carrier::Place { machine, .. } => Some(machine),
            Carrier::Supply
            | Carrier::On { .. }
            | Carrier::Floor { .. }
            | Carrier::Sink { .. }
            | Carrier::Collector
            | Carrier::Part { .. }
            | Carrier::Shipped { .. } => None,
        }
    }

    pub fn part(&self) -> Option<usize> {
        match *self {
            Carrier::Lane { part, .. } | Carrier::Grip { part, .. } | Carrier::Place { part, .. } => {
                Some(part)
            }
            Carrier::Supply
            | Carrier::On { .. }
            | Carrier::Floor { .. }
            | Carrier::Sink { .. }
            | Carrier::Collector
            | Carrier::Part { .. }
            | Carrier::Shipped { .. } => None,
        }
    }

    /// From the origin of what carries the place.
    pub fn offset(&self) -> Option<Point> {
        match self {
            Carrier::Place { offset, .. } => Some(*offset),
            _ => None,
        }
    }

    /// The item that bears it.
    pub fn item(&self) -> Option<usize> {
        match self {
            Carrier::On { item, .. } => Some(*item),
            _ => None,
        }
    }

    /// No machine takes an item from there.
    pub fn is_final(&self) -> bool {
        self.is_gone() || matches!(self, Carrier::Part { .. })
    }

    /// Nothing happens to the item any more.
    pub fn is_gone(&self) -> bool {
        matches!(self, Carrier::Sink { .. } | Carrier::Collector | Carrier::Shipped { .. })
    }
}
