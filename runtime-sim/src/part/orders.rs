//! The terminal of the order system at a place: orders open here, and are taken away when they are made.

use super::settings::{Form, Setting, Settings};
use super::{Described, Level, Running, Schema, See, Signal, World, Start};
use crate::carrier::Carrier;
use crate::device::{Extent, LAST_COMMAND, PortType};
use crate::event::OrderChange;
use crate::item::Items;
use crate::line::Order;

pub const SCHEMA: Schema = Schema {
    signals: &[
        Signal { name: "open", ty: PortType::Bool, extent: Extent::One },
        Signal { name: "parts", ty: PortType::Int { lo: 0, hi: 12 }, extent: Extent::PerKind },
        Signal { name: "number", ty: PortType::Int { lo: 0, hi: LAST_COMMAND }, extent: Extent::One },
    ],
    levels: &[Level { name: "complete", ty: PortType::Bool }],
    ..Schema::new(
        "orders",
        "Orders of the scenario open here one after another; a made order is taken away with the items at the place.",
        &[Setting::new("at", Form::Part(&["place"]), "", "place for the parts of an order")],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Orders {
    pub place: usize,
}

impl Described for Orders {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self { place: settings.part("at")? })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let all = start.line.scenario.orders.iter().enumerate();
        let here = all.filter(|(_, order)| order.stations.contains(&start.machine));
        let mut serving = Serving::new(self, here.map(|(number, _)| number).collect());
        serving.open(start.machine, start.desk, start.items);
        Ok(Some(Box::new(serving)))
    }
}

/// The orders, and which of them have been made: known at all terminals.
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

/// A terminal at work.
#[derive(Clone, Debug)]
pub struct Serving {
    place: usize,
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
    /// The order is gone, `complete` is still set.
    Gone,
    /// The next order opens with the next scan.
    Opening,
    Bare,
}

impl Serving {
    pub fn new(orders: &Orders, mut queue: Vec<usize>) -> Self {
        queue.reverse();
        Self { place: orders.place, table: Table::Bare, complete: false, queue }
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

    fn clear(&self, to: Carrier, world: &mut World) {
        let there: Vec<usize> = world.see().borne_by(self.place).collect();
        for item in there {
            let place = world.see().place(self.place, item).unwrap_or_default();
            world.items.pass(item, to, place);
        }
    }

    /// Whether the place holds the parts of the order and no others.
    fn is_made(&self, order: &Order, see: &See) -> bool {
        order.parts.iter().enumerate().all(|(kind, &wanted)| {
            let held = see.borne_by(self.place).flat_map(|item| see.items.with_loads(item));
            held.filter(|&item| see.items[item].kind == kind).count() == wanted as usize
        })
    }
}

impl Running for Serving {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn level(&mut self, _level: usize, value: &[f64]) {
        self.complete = value[0] != 0.0;
    }

    fn serves(&self) -> bool {
        true
    }

    fn serve(&mut self, world: &mut World) {
        match self.table {
            Table::Open { order, refused } if !world.desk.made[order] => {
                if !self.complete {
                    self.table = Table::Open { order, refused: false };
                } else if self.is_made(&world.desk.orders[order], &world.see()) {
                    self.clear(Carrier::Shipped { order }, world);
                    world.items.note_order(world.machine, order, OrderChange::Made);
                    world.desk.made[order] = true;
                    self.table = Table::Gone;
                } else if !refused {
                    world.items.note_order(world.machine, order, OrderChange::Refused);
                    self.table = Table::Open { order, refused: true };
                }
            }
            Table::Gone if !self.complete => {
                self.table = if self.orders_to_open(world.desk) == 0 { Table::Bare } else { Table::Opening };
            }
            Table::Opening => self.open(world.machine, world.desk, world.items),
            Table::Open { .. } | Table::Gone | Table::Bare => {}
        }
    }

    /// Takes away an order that was made elsewhere. What lies at its place is collected.
    fn withdraw(&mut self, world: &mut World) {
        if let Some(order) = self.open_order()
            && world.desk.made[order]
        {
            self.clear(Carrier::Collector, world);
            world.items.note_order(world.machine, order, OrderChange::Withdrawn);
            self.table = Table::Gone;
        }
    }

    fn signal(&self, signal: usize, see: &See, out: &mut [f64]) {
        out.fill(0.0);
        let Some(order) = self.open_order() else { return };
        match signal {
            0 => out[0] = 1.0,
            1 => {
                for (word, &count) in out.iter_mut().zip(&see.desk.orders[order].parts) {
                    *word = f64::from(count);
                }
            }
            _ => out[0] = (order + 1) as f64,
        }
    }

    fn next_change(&self, _see: &See, now_ms: u64) -> f64 {
        match self.table {
            Table::Opening => now_ms as f64,
            Table::Gone if !self.complete => now_ms as f64,
            Table::Open { .. } | Table::Gone | Table::Bare => f64::INFINITY,
        }
    }

    /// An order is about to open.
    fn is_busy(&self, _see: &See) -> bool {
        self.table == Table::Opening
    }

    fn open_order(&self) -> Option<usize> {
        match self.table {
            Table::Open { order, .. } => Some(order),
            Table::Gone | Table::Opening | Table::Bare => None,
        }
    }

    fn orders_to_open(&self, desk: &Desk) -> usize {
        self.queue.iter().filter(|&&order| !desk.made[order]).count()
    }
}
