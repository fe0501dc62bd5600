//! An assembly station: a briefcase, and the terminal of the order system.

use super::image::{in_station, out_station, put_bit};
use crate::carrier::Carrier;
use crate::event::OrderChange;
use crate::geometry::{BRIEFCASE, BRIEFCASE_X, BRIEFCASE_Y};
use crate::item::Items;
use crate::line::Order;
use crate::point::Point;

/// The orders, and which of them have been made: known at all stations.
#[derive(Clone, Debug)]
pub struct Desk {
    orders: Vec<Order>,
    made: Vec<bool>,
}

impl Desk {
    pub fn new(orders: Vec<Order>) -> Self {
        Self { made: vec![false; orders.len()], orders }
    }
}

#[derive(Clone, Debug)]
pub struct Station {
    pose: Point,
    table: Table,
    complete: bool,
    /// Orders that are still to open here, last one first.
    queue: Vec<usize>,
}

/// Four phases with the controller: order open, complete, order gone, not complete.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Table {
    /// `refused`: `complete` is set and the parts are not those of the order.
    Open {
        order: usize,
        refused: bool,
    },
    /// The briefcase is gone, `complete` is still set.
    Gone,
    /// The next order opens with the next scan.
    Opening,
    Bare,
}

impl Station {
    pub fn new(pose: Point, mut queue: Vec<usize>) -> Self {
        queue.reverse();
        Self { pose, table: Table::Bare, complete: false, queue }
    }

    pub fn obey(&mut self, outputs: &[f64]) {
        self.complete = outputs[out_station::COMPLETE] != 0.0;
    }

    /// Opens the next order that was not made elsewhere, if there is one.
    pub fn open(&mut self, machine: usize, desk: &Desk, items: &mut Items) {
        self.table = Table::Bare;
        while let Some(order) = self.queue.pop() {
            if !desk.made[order] {
                items.note_order(machine, order, OrderChange::Opened);
                self.table = Table::Open { order, refused: false };
                return;
            }
        }
    }

    /// Takes away an order that was made at another station. What lies in its briefcase is collected.
    pub fn withdraw(&mut self, machine: usize, desk: &Desk, items: &mut Items) {
        if let Some(order) = self.open_order()
            && desk.made[order]
        {
            self.clear(machine, Carrier::Collector, items);
            items.note_order(machine, order, OrderChange::Withdrawn);
            self.table = Table::Gone;
        }
    }

    fn clear(&self, machine: usize, to: Carrier, items: &mut Items) {
        while let Some(&item) = items.borne_by(machine).first() {
            let place = self.place(items.all()[item].carrier);
            items.pass(item, to, place);
        }
    }

    pub fn advance(&mut self, machine: usize, desk: &mut Desk, items: &mut Items) {
        match self.table {
            Table::Open { order, refused } if !desk.made[order] => {
                if !self.complete {
                    self.table = Table::Open { order, refused: false };
                } else if is_made(&desk.orders[order], items, machine) {
                    self.clear(machine, Carrier::Shipped { order }, items);
                    items.note_order(machine, order, OrderChange::Made);
                    desk.made[order] = true;
                    self.table = Table::Gone;
                } else if !refused {
                    items.note_order(machine, order, OrderChange::Refused);
                    self.table = Table::Open { order, refused: true };
                }
            }
            Table::Gone if !self.complete => {
                self.table = if self.orders_to_open(desk) == 0 { Table::Bare } else { Table::Opening };
            }
            Table::Opening => self.open(machine, desk, items),
            Table::Open { .. } | Table::Gone | Table::Bare => {}
        }
    }

    /// An order is about to open.
    pub fn is_busy(&self) -> bool {
        self.table == Table::Opening
    }

    pub fn open_order(&self) -> Option<usize> {
        match self.table {
            Table::Open { order, .. } => Some(order),
            Table::Gone | Table::Opening | Table::Bare => None,
        }
    }

    pub fn orders_to_open(&self, desk: &Desk) -> usize {
        self.queue.iter().filter(|&&order| !desk.made[order]).count()
    }

    pub fn pose(&self) -> Point {
        self.pose
    }

    fn place(&self, carrier: Carrier) -> Point {
        match carrier {
            Carrier::Briefcase { offset, .. } => self.pose + offset,
            _ => self.pose,
        }
    }

    /// What becomes of an item that comes down at this place, if it meets a briefcase.
    pub fn below(&self, machine: usize, point: Point) -> Option<(f64, Carrier)> {
        self.open_order()?;
        let from_middle = point - (self.pose + BRIEFCASE);
        let is_within = |at: f64, [low, high]: [f64; 2]| (low..=high).contains(&at);
        let meets = is_within(from_middle.x, BRIEFCASE_X) && is_within(from_middle.y, BRIEFCASE_Y);
        let offset = Point { z: BRIEFCASE.z, ..point - self.pose };
        meets.then_some((self.pose.z + BRIEFCASE.z, Carrier::Briefcase { machine, offset }))
    }

    pub fn write(&self, image: &mut [f64], desk: &Desk) {
        image.fill(0.0);
        let Some(order) = self.open_order() else { return };
        put_bit(image, in_station::ORDER_OPEN, true);
        let parts = &desk.orders[order].parts;
        for (word, &count) in image[in_station::ORDER_PARTS..].iter_mut().zip(parts) {
            *word = f64::from(count);
        }
        image[in_station::ORDER_PARTS + parts.len()] = (order + 1) as f64;
    }
}

/// Whether the briefcase holds the parts of the order and no others.
fn is_made(order: &Order, items: &Items, machine: usize) -> bool {
    let held = items.borne_by(machine);
    order.parts.iter().enumerate().all(|(kind, &wanted)| {
        held.iter().filter(|&&item| items.all()[item].kind == kind).count() == wanted as usize
    })
}
