//! The plant: all devices and items of a line, and how a scan moves them on.

mod arm;
mod belt;
mod bin;
mod command;
pub mod course;
mod delay;
mod drive;
mod fall;
mod gripper;
pub(crate) mod image;
mod station;
mod vehicle;

pub(crate) use delay::Bus;

use crate::carrier::Carrier;
use crate::device::{Device, Direction};
use crate::geometry::Geometry;
use crate::item::Items;
use crate::kinematics::arm::Joints;
use crate::line::Line;
use crate::point::Point;
use crate::way::Ways;
use arm::Arm;
use belt::{Belt, Spawn};
use command::Command;
use course::Course;
use drive::Drive;
use gripper::{CONTACT, Gripper, Slip};
use image::out;
use station::{Desk, Station};
use vehicle::Vehicle;

/// The state of the plant at the start of a scan.
#[derive(Clone, Debug)]
pub struct Plant {
    scan_ms: u64,
    scan: u64,
    machines: Vec<Machine>,
    items: Items,
    /// Heights of the kinds.
    heights: Vec<f64>,
    desk: Desk,
    images: Vec<Vec<f64>>,
}

#[derive(Clone, Debug)]
#[expect(clippy::large_enum_variant)] // a dozen of them in all
enum Machine {
    Belt(Belt),
    Vehicle(Vehicle),
    Arm(Arm),
    Station(Station),
    Bin(Point),
}

impl Plant {
    /// The plant before scan 0: belts empty and at rest, vehicles at their pose, arms at rest, the first
    /// order of each station open.
    pub fn new(line: &Line) -> Result<Self, String> {
        line.check()?;
        let mut items = Items::new(line);
        let desk = Desk::new(line.scenario.orders.clone());
        let machines = (0..line.machines.len())
            .map(|index| Machine::new(line, index, &desk, &mut items))
            .collect::<Result<Vec<_>, _>>()?;
        let kinds = line.kinds.len();
        let images =
            line.machines.iter().map(|m| vec![0.0; words(&m.geometry, Direction::Input, kinds)]).collect();
        let mut plant = Self {
            scan_ms: u64::from(line.scan_ms),
            scan: 0,
            machines,
            items,
            heights: line.kinds.iter().map(|kind| kind.height).collect(),
            desk,
            images,
        };
        plant.write_images();
        Ok(plant)
    }

    /// From the start of a scan to that of the next; `outputs` are those that the scan published.
    /// Every image has to have the length that [`outputs`] gives it.
    pub fn advance(&mut self, outputs: &[Vec<f64>]) {
        self.obey(outputs);
        self.proceed();
    }

    /// The second part of [`Self::advance`]: everything moves on to the start of the next scan.
    pub(crate) fn proceed(&mut self) {
        let next_ms = (self.scan + 1) * self.scan_ms;
        for (index, machine) in self.machines.iter_mut().enumerate() {
            match machine {
                Machine::Belt(belt) => belt.advance(index, self.scan_ms, &mut self.items),
                Machine::Vehicle(vehicle) => vehicle.advance(self.scan_ms),
                Machine::Arm(arm) => arm.advance(next_ms, self.scan_ms),
                Machine::Station(_) | Machine::Bin(_) => {}
            }
        }
        self.slip();
        self.grip();
        for (index, machine) in self.machines.iter_mut().enumerate() {
            match machine {
                Machine::Arm(arm) => arm.settle(),
                Machine::Station(station) => station.advance(index, &mut self.desk, &mut self.items),
                Machine::Belt(_) | Machine::Vehicle(_) | Machine::Bin(_) => {}
            }
        }
        for (index, machine) in self.machines.iter_mut().enumerate() {
            if let Machine::Station(station) = machine {
                station.withdraw(index, &self.desk, &mut self.items);
            }
        }
        self.scan += 1;
        self.write_images();
    }

    /// The first part of [`Self::advance`]: latches commands and levels, and lets go what is to be let go,
    /// before anything moves.
    pub(crate) fn obey(&mut self, outputs: &[Vec<f64>]) {
        self.items.scan = self.scan + 1;
        let now_ms = self.scan * self.scan_ms;
        for (index, outputs) in outputs.iter().enumerate().take(self.machines.len()) {
            match &mut self.machines[index] {
                Machine::Belt(belt) => belt.obey(outputs),
                Machine::Vehicle(vehicle) => vehicle.obey(outputs),
                Machine::Station(station) => station.obey(outputs),
                Machine::Bin(_) => {}
                Machine::Arm(arm) => {
                    arm.obey(outputs, now_ms);
                    if let Some(item) = arm.gripper.switch(outputs[out::GRIP]) {
                        self.drop_item(item);
                    }
                }
            }
        }
    }

    fn slip(&mut self) {
        let now_ms = (self.scan + 1) * self.scan_ms;
        for index in 0..self.machines.len() {
            let Machine::Arm(arm) = &mut self.machines[index] else { continue };
            if let Some(item) = arm.gripper.slip(now_ms) {
                self.drop_item(item);
            }
        }
    }

    fn grip(&mut self) {
        let before_ms = self.scan * self.scan_ms;
        let now_ms = before_ms + self.scan_ms;
        for index in 0..self.machines.len() {
            let Machine::Arm(arm) = &self.machines[index] else { continue };
            if !arm.gripper.is_polled(before_ms, now_ms) {
                continue;
            }
            let tool = arm.tool();
            let contact = self.contact(tool);
            let Machine::Arm(arm) = &mut self.machines[index] else { continue };
            if let Some(item) = arm.gripper.poll(contact, before_ms, now_ms)
                && let Some(place) = self.place(item)
            {
                self.items.pass(item, Carrier::Gripper { machine: index, hang: place - tool }, place);
            }
        }
    }

    /// The item nearest to the tool among those in contact with it; the first of equals.
    fn contact(&self, tool: Point) -> Option<usize> {
        let mut nearest: Option<(f64, usize)> = None;
        for (index, item) in self.items.all().iter().enumerate() {
            if matches!(item.carrier, Carrier::Gripper { .. }) {
                continue;
            }
            let Some(place) = self.place(index) else { continue };
            let gap = place.up(self.heights[item.kind]) - tool;
            let square = gap.x * gap.x + gap.y * gap.y + gap.z * gap.z;
            if square <= CONTACT * CONTACT && nearest.is_none_or(|(least, _)| square < least) {
                nearest = Some((square, index));
            }
        }
        nearest.map(|(_, item)| item)
    }

    fn drop_item(&mut self, item: usize) {
        let Some(place) = self.place(item) else { return };
        let (carrier, point) = fall::fall(&self.machines, place);
        self.items.pass(item, carrier, point);
    }

    fn write_images(&mut self) {
        for (index, (machine, image)) in self.machines.iter().zip(&mut self.images).enumerate() {
            match machine {
                Machine::Belt(belt) => belt.write(image, index, &self.items),
                Machine::Vehicle(vehicle) => vehicle.write(image),
                Machine::Arm(arm) => arm.write(image),
                Machine::Station(station) => station.write(image, &self.desk),
                Machine::Bin(_) => {}
            }
        }
    }

    /// The inputs of each machine, as the plant stands.
    pub fn images(&self) -> &[Vec<f64>] {
        &self.images
    }

    pub fn items(&self) -> &Items {
        &self.items
    }

    /// Where the underside of an item is; `None` if it is not on the line (supply, collector, shipped).
    pub fn place(&self, item: usize) -> Option<Point> {
        match self.items.all().get(item)?.carrier {
            Carrier::Belt { machine, at, across } => match &self.machines[machine] {
                Machine::Belt(belt) => Some(belt.place(at, across)),
                _ => None,
            },
            Carrier::Gripper { machine, hang: offset }
            | Carrier::Tray { machine, offset }
            | Carrier::Briefcase { machine, offset }
            | Carrier::Bin { machine, offset } => Some(self.position(machine)? + offset),
            Carrier::Floor { point } => Some(point),
            Carrier::Supply | Carrier::Collector | Carrier::Shipped { .. } => None,
        }
    }

    /// Where a machine is: the tool of an arm, the position of a vehicle, the pose of a station or a bin.
    pub fn position(&self, machine: usize) -> Option<Point> {
        match self.machines.get(machine)? {
            Machine::Belt(_) => None,
            Machine::Vehicle(vehicle) => Some(vehicle.position()),
            Machine::Arm(arm) => Some(arm.tool()),
            Machine::Station(station) => Some(station.pose()),
            Machine::Bin(pose) => Some(*pose),
        }
    }

    /// The joints of an arm.
    pub(crate) fn joints(&self, machine: usize) -> Option<Joints> {
        match self.machines.get(machine)? {
            Machine::Arm(arm) => Some(arm.joints()),
            _ => None,
        }
    }

    /// How a machine moves from now on.
    pub(crate) fn course(&self, machine: usize) -> Course {
        match self.machines.get(machine) {
            Some(Machine::Belt(belt)) => belt.course(),
            Some(Machine::Vehicle(vehicle)) => vehicle.course(self.now_ms()),
            Some(Machine::Arm(arm)) => arm.course(),
            Some(Machine::Station(_) | Machine::Bin(_)) | None => Course::Rests,
        }
    }

    /// Time from the start of the run.
    pub fn now_ms(&self) -> u64 {
        self.scan * self.scan_ms
    }

    /// The order that lies on the table of a station.
    pub fn open_order(&self, machine: usize) -> Option<usize> {
        match self.machines.get(machine)? {
            Machine::Station(station) => station.open_order(),
            _ => None,
        }
    }

    /// Number of the orders of a station that have not opened yet.
    pub fn orders_to_open(&self, machine: usize) -> usize {
        match self.machines.get(machine) {
            Some(Machine::Station(station)) => station.orders_to_open(&self.desk),
            _ => 0,
        }
    }

    /// Whether something will change even if no output does: a command under way that is not held, or a
    /// moving belt that bears parts or will.
    pub fn is_busy(&self) -> bool {
        self.machines.iter().enumerate().any(|(index, machine)| match machine {
            Machine::Belt(belt) => {
                belt.is_moving() && (belt.has_supply() || !self.items.borne_by(index).is_empty())
            }
            Machine::Vehicle(vehicle) => vehicle.is_busy(),
            Machine::Arm(arm) => arm.is_busy(),
            Machine::Station(station) => station.is_busy(),
            Machine::Bin(_) => false,
        })
    }
}

impl Machine {
    fn new(line: &Line, index: usize, desk: &Desk, items: &mut Items) -> Result<Self, String> {
        let scenario = &line.scenario;
        let command = || {
            let refusals = scenario.refusals.iter().filter(|r| r.machine == index);
            Command::new(refusals.map(|r| r.command).collect())
        };
        let machine = &line.machines[index];
        Ok(match &machine.geometry {
            Geometry::Belt { pose, orient, orient_range } => {
                let mut first = 0;
                let mut supply = Vec::new();
                for other in &scenario.supply {
                    if other.belt == index {
                        supply.extend(first..first + other.items.len());
                    }
                    first += other.items.len();
                }
                let spawn = Spawn {
                    first_ms: milliseconds(scenario.spawn_first_s),
                    every_ms: milliseconds(scenario.spawn_every_s),
                };
                Machine::Belt(Belt::new(command(), *pose, *orient, *orient_range, spawn, &line.kinds, supply))
            }
            Geometry::Vehicle { pose, .. } => {
                Machine::Vehicle(Vehicle::new(command(), machine.geometry.stops(), *pose))
            }
            Geometry::RailArm { .. } | Geometry::Gantry { .. } => {
                let slips = scenario.slips.iter().filter(|slip| slip.machine == index);
                let slips = slips
                    .map(|slip| Slip { pick: slip.pick, after_ms: milliseconds(slip.after_s) })
                    .collect();
                let drive = Drive::new(&machine.geometry, Ways::of(line, index))
                    .ok_or_else(|| format!("{} cannot reach its own rest position", machine.name))?;
                Machine::Arm(Arm::new(command(), Gripper::new(slips), drive))
            }
            Geometry::Station { pose } => {
                let orders = scenario.orders.iter().enumerate();
                let here = orders.filter(|(_, order)| order.stations.contains(&index));
                let mut station = Station::new(*pose, here.map(|(i, _)| i).collect());
                station.open(index, desk, items);
                Machine::Station(station)
            }
            Geometry::Bin { pose } => Machine::Bin(*pose),
        })
    }

    fn below(&self, index: usize, point: Point) -> Option<(f64, Carrier)> {
        match self {
            Machine::Belt(belt) => belt.below(index, point),
            Machine::Vehicle(vehicle) => vehicle.below(index, point),
            Machine::Arm(_) => None,
            Machine::Station(station) => station.below(index, point),
            Machine::Bin(pose) => bin::below(*pose, index, point),
        }
    }
}

/// An image of zeros for the outputs of each machine.
pub fn outputs(line: &Line) -> Vec<Vec<f64>> {
    let kinds = line.kinds.len();
    line.machines.iter().map(|m| vec![0.0; words(&m.geometry, Direction::Output, kinds)]).collect()
}

fn words(geometry: &Geometry, direction: Direction, kinds: usize) -> usize {
    Device::find(geometry.device()).map_or(0, |device| device.words(direction, kinds))
}

fn milliseconds(seconds: f64) -> u64 {
    libm::round(seconds * 1000.0) as u64
}
