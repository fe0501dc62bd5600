//! The plant: all machines and items of a line, and how a scan moves them on.

mod command;
pub(crate) mod conveyed;
mod conveying;
mod delay;
pub(crate) mod fall;
mod faults;
mod gripping;
mod idle;
mod loads;
mod mishap;
mod missed;
mod missed_grip;
mod phase;
mod removing;
mod sight;
pub mod trajectory;
mod working;

pub(crate) use delay::{Arrived, Bus};

use crate::carrier::Carrier;
use crate::frame::Frame;
use crate::item::{Items, Names};
use crate::kinematics::arm::Joints;
use crate::kinematics::wrapped;
use crate::line::{Line, Obstacle};
use crate::memory::Memory;
use crate::part::Primitive;
use crate::part::orders::Desk;
use crate::part::stroke::Stroking;
use crate::part::track::Driving;
use crate::point::Point;
use conveyed::Conveyed;
use conveying::{Among, Conveying, Falls, View};
pub use conveying::{By, Gap, Transfer, gaps, transfers};
use fall::Falling;
use gripping::{Lying, NextLook};
use mishap::Mishap;
pub(crate) use missed::{Entry, MissedCommands, Time};
pub use removing::NotRemoved;
use removing::Removing;
use trajectory::Trajectory;
use working::{Shared, Working};

/// A time is not distinguished from one that is so much later.
pub(crate) const EARLY_MS: f64 = 1e-6;

/// The state of the plant at the start of a scan.
#[derive(Clone, Debug)]
pub struct Plant {
    scan_ms: u64,
    scan: u64,
    /// To the start of this scan the machines have moved.
    moved_to: u64,
    machines: Vec<Working>,
    conveying: Conveying,
    items: Items,
    /// Of all items, for reports.
    names: Names,
    /// Of the kinds: over the underside of an item, where it is gripped, m.
    grasps: Vec<f64>,
    obstacles: Vec<Obstacle>,
    desk: Desk,
    images: Vec<Vec<f64>>,
    /// An item has changed hands on the way to the present scan: what a lane shows of it may follow in the next one.
    has_handed: bool,
    /// Machines and parts of all grippers.
    grippers: Vec<(usize, usize)>,
    /// Machines with scanners.
    scanning: Vec<usize>,
    /// Machines with places where items lie on one another.
    stacking: Vec<usize>,
    /// Machines with faults.
    faulty: Vec<usize>,
    /// By machine.
    next_looks: Vec<Option<NextLook>>,
    /// The phases of the machines when it was last asked for, and the next look.
    next_look: (u64, f64),
    /// The phases of the machines with lanes when it was last looked how these go on.
    conveyed_on: u64,
    lying: Option<Lying>,
    /// What a person takes off the line, in the order of the scenario.
    removing: Vec<Removing>,
    /// Events of items and orders that have woken whom they concern.
    heard: usize,
}

impl Plant {
    /// The plant before scan 0: lanes empty and at rest, vehicles at their first stop, arms at rest, the first
    /// order of each terminal open.
    pub fn new(line: &Line) -> Result<Self, String> {
        Self::remembering(line, &mut Memory::default())
    }

    /// The same, with what earlier runs of these machines have found.
    pub(crate) fn remembering(line: &Line, memory: &mut Memory) -> Result<Self, String> {
        line.check()?;
        memory.keep_for(line);
        let mut items = Items::new(line);
        let desk = Desk::new(line.scenario.orders.clone());
        let machines = (0..line.machines.len())
            .map(|index| Working::new(line, index, &desk, &mut items, memory))
            .collect::<Result<Vec<_>, _>>()?;
        let images = machines.iter().map(|machine| vec![0.0; machine.input_words()]).collect();
        let faulty = (0..machines.len()).filter(|machine| machines[*machine].faults().exist()).collect();
        let scanning = machines_with(line, |part| matches!(part, Primitive::Scanner(_)));
        let stacking = machines_with(line, |part| matches!(part, Primitive::Place(place) if place.stacks));
        let names = Names::new(line);
        let removals = line.scenario.removals.iter();
        let removing = removals.map(|removal| Removing::new(removal, &names)).collect();
        let mut plant = Self {
            scan_ms: u64::from(line.scan_ms),
            scan: 0,
            moved_to: 0,
            machines,
            conveying: Conveying::new(line),
            items,
            names,
            grasps: line.kinds.iter().map(|kind| kind.grasp).collect(),
            obstacles: line.obstacles.clone(),
            desk,
            images,
            has_handed: false,
            grippers: parts(line, |part| matches!(part, Primitive::Grip(_))).collect(),
            scanning,
            stacking,
            faulty,
            next_looks: vec![None; line.machines.len()],
            next_look: (0, f64::NEG_INFINITY),
            conveyed_on: 0,
            lying: None,
            removing,
            heard: 0,
        };
        plant.sight();
        plant.write_images();
        Ok(plant)
    }

    /// From the start of a scan to that of the next; `outputs` are those that the scan published.
    /// Every image has to have the length that [`outputs`] gives it.
    pub fn advance(&mut self, outputs: &[Vec<f64>]) {
        self.obey(outputs);
        self.proceed_to(self.scan + 1);
    }

    /// All machines, and what they share on the way to the start of a scan.
    fn split(&mut self, scan: u64) -> (&mut Vec<Working>, Shared<'_>) {
        let shared = Shared {
            scan: self.scan,
            items: &mut self.items,
            desk: &mut self.desk,
            now_ms: self.scan * self.scan_ms,
            dt_ms: (scan - self.scan) * self.scan_ms,
        };
        (&mut self.machines, shared)
    }

    /// The first scan, not before the next one, at whose start something may have happened, if no output changes:
    /// until then all that moves continues along its path, and nothing else changes. None: nothing ever will.
    pub fn next_change(&mut self) -> Option<u64> {
        let now_ms = self.now_ms();
        let look_ms = self.next_look(now_ms);
        let mut next_ms = self.conveying.next_ms().min(look_ms);
        for machine in 0..self.machines.len() {
            next_ms = next_ms.min(self.next_change_of(machine));
        }
        let sights = self.scanning.iter().map(|machine| self.next_sight(*machine));
        let next_ms = sights.fold(next_ms, f64::min);
        // What is rounded may be early.
        let scan = ((next_ms - EARLY_MS) / self.scan_ms as f64).ceil() as u64;
        let next = next_ms.is_finite().then(|| scan.max(self.scan + 1));
        let faulty = self.faulty.iter().map(|machine| self.machines[*machine].faults());
        let faults = faulty.map(|faults| faults.next_change(self.scan));
        let removals = self.removing.iter().map(|removing| removing.next_change(self.scan));
        faults.chain(removals).chain([next, self.has_handed.then_some(self.scan + 1)]).flatten().min()
    }

    /// The second part of [`Self::advance`]: everything moves on to the start of a later scan, before which nothing
    /// happens ([`Self::next_change`]).
    pub fn proceed_to(&mut self, scan: u64) {
        self.items.scan = scan;
        let logged = self.items.log().count();
        while let Some(falls) =
            self.convey(|conveying, among, scan_ms| conveying.proceed(among, scan * scan_ms))
        {
            self.fall(falls);
        }
        self.wake_concerned(self.now_ms());
        let next_ms = scan * self.scan_ms;
        let (machines, mut shared) = self.split(scan);
        machines.iter_mut().for_each(|machine| machine.phase.go_on_to(next_ms as f64));
        working(machines).for_each(|machine| machine.advance(&mut shared));
        self.moved_to = scan;
        self.slip(scan);
        self.grip(scan);
        self.remove(scan);
        self.wake_concerned(next_ms);
        let (machines, mut shared) = self.split(scan);
        for machine in working(machines) {
            machine.settle(&mut shared);
            machine.serve(&mut shared);
        }
        self.note_missed_grips(next_ms);
        self.wake_concerned(next_ms);
        let (machines, mut shared) = self.split(scan);
        working(machines).for_each(|machine| machine.withdraw(&mut shared));
        self.wake_concerned(next_ms);
        self.scan = scan;
        self.has_handed = self.items.log().count() > logged;
        self.spill(scan);
        self.sight();
        self.write_images();
    }

    /// The first part of [`Self::advance`]: latches commands and levels, and lets go what is to be let go,
    /// before anything moves.
    pub fn obey(&mut self, outputs: &[Vec<f64>]) {
        self.items.scan = self.scan + 1;
        for (index, outputs) in outputs.iter().enumerate().take(self.machines.len()) {
            if !self.has_to_obey(index, outputs) {
                continue;
            }
            let (machines, mut shared) = self.split(self.scan + 1);
            machines[index].obey(outputs, &mut shared);
            while let Some(item) = self.machines[index].let_go() {
                self.drop_item(item, self.now_ms());
            }
        }
        let now_ms = self.now_ms();
        let phases = self.conveying.machines().map(|machine| self.machines[machine].phase.number()).sum();
        if std::mem::replace(&mut self.conveyed_on, phases) != phases {
            while let Some(falls) = self.convey(|conveying, among, _| conveying.look(among, now_ms)) {
                self.fall(falls);
            }
        }
        self.wake_concerned(now_ms);
    }

    fn convey<T>(&mut self, work: impl FnOnce(&mut Conveying, &mut Among, u64) -> T) -> T {
        let mut among = Among { machines: &mut self.machines, items: &mut self.items };
        work(&mut self.conveying, &mut among, self.scan_ms)
    }

    fn fall(&mut self, Falls { item, from, turn, ms }: Falls) {
        let landing = self.landing(item, self.falling(item, from, turn), ms);
        if let Some(Mishap { machine, reason }) = self.mishap(&landing) {
            self.items.crash(machine, reason);
        }
        self.hand_over(item, turn, landing.carrier, landing.point, ms);
    }

    fn falling(&self, item: usize, point: Point, turn: f64) -> Falling {
        Falling { point, upper: self.upper(item), size: self.items.dimensions(item).size, turn }
    }

    fn slip(&mut self, scan: u64) {
        let next_ms = scan * self.scan_ms;
        for index in 0..self.machines.len() {
            while let Some(item) = self.machines[index].slip(next_ms) {
                self.lose(item, next_ms as f64);
            }
        }
    }

    /// An item that slips falls, to the floor where it cannot lie.
    fn lose(&mut self, item: usize, ms: f64) {
        let Some(from) = self.place(item) else { return };
        let turn = self.turn(item);
        let landing = self.landing(item, self.falling(item, from, turn), ms);
        let (carrier, point) = match self.mishap(&landing) {
            Some(_) => fall::to_floor(self, from),
            None => (landing.carrier, landing.point),
        };
        self.hand_over(item, turn, carrier, point, ms);
    }

    /// How an item is turned about the vertical since it came onto the line, to the left as seen from above, rad. Of one
    /// that lies on its side this says nothing.
    pub fn turn(&self, item: usize) -> f64 {
        if self.items[item].carrier.item().is_some() {
            return self.turn_of_load(item);
        }
        let own = self.items.turn(item);
        if let Some(conveyed) = self.conveyed(item) {
            return conveyed.yaw(0.0, own.to_degrees()).to_radians();
        }
        if let Some(vehicle) = self.vehicle_under(item) {
            return vehicle.yaw.to_radians() + own;
        }
        let carrier = &self.items[item].carrier;
        let bearer = carrier.machine().and_then(|machine| self.machines.get(machine));
        bearer.map_or(0.0, |bearer| bearer.turn(carrier, &self.items, &self.desk)) + own
    }

    /// Something else bears an item from a time on, ms; its turn at that time it keeps.
    fn hand_over(&mut self, item: usize, turn: f64, to: Carrier, point: Point, ms: f64) {
        self.items.pass(item, to, point);
        self.items.set_turn(item, 0.0);
        let on = self.block(item, ms).map_or_else(|| self.turn(item), |block| block.turn());
        self.items.set_turn(item, wrapped(turn - on));
    }

    /// Where the upper side of an item faces, a unit vector; none for up.
    pub fn upper(&self, item: usize) -> Option<Point> {
        self.items.get(item)?;
        let carrier = &self.base_carrier(item);
        self.machines.get(carrier.machine()?)?.upper(carrier, &self.items, &self.desk)
    }

    fn drop_item(&mut self, item: usize, now_ms: u64) {
        if let Some(from) = self.place(item) {
            self.fall(Falls { item, from, turn: self.turn(item), ms: now_ms as f64 });
        }
    }

    fn write_images(&mut self) {
        if cfg!(debug_assertions) {
            let still = (0..self.machines.len()).filter(|machine| self.machines[*machine].is_still());
            still.for_each(|machine| self.check_still(machine));
        }
        for (machine, image) in self.machines.iter().zip(&mut self.images) {
            if machine.is_still() {
                continue;
            }
            machine.write(image, &self.items, &self.desk);
            machine.faults().stick(self.scan, image);
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
        match self.items.get(item)?.carrier {
            Carrier::Floor { point } => Some(point),
            Carrier::On { .. } => self.place_of_load(item),
            carrier => {
                let machine = self.machines.get(carrier.machine()?)?;
                machine.place(item, &carrier, &self.items, &self.desk)
            }
        }
    }

    /// Everyone has read the first `read` events.
    pub(crate) fn forget_events(&mut self, read: usize) {
        self.items.forget_events(read);
    }

    /// Where a machine is: the tool of an arm, the position of a vehicle, the pose of what does not move.
    pub fn position(&self, machine: usize) -> Option<Point> {
        self.machines.get(machine).map(Working::position)
    }

    /// Where a vehicle on a track is, and how it is turned.
    pub(crate) fn vehicle(&self, machine: usize) -> Option<Frame> {
        self.machines.get(machine)?.first_vehicle().map(Driving::frame_now)
    }

    /// Where the vehicle on a track is that carries an item, and how it is turned.
    pub(crate) fn vehicle_under(&self, item: usize) -> Option<Frame> {
        self.items.get(item)?;
        let Carrier::Place { machine, part, .. } = self.base_carrier(item) else { return None };
        self.machines.get(machine)?.vehicle_under(part).map(Driving::frame_now)
    }

    /// The joints of an arm.
    pub(crate) fn joints(&self, machine: usize) -> Option<Joints> {
        self.machines.get(machine)?.joints()
    }

    /// How an item on a conveyor, or at a place that a cylinder or a positioner carries, continues from now.
    pub(crate) fn conveyed(&self, item: usize) -> Option<Conveyed> {
        let carrier = &self.items.get(item)?.carrier;
        if carrier.item().is_some() {
            return self.load_conveyed(item);
        }
        let machine = self.machines.get(carrier.machine()?)?;
        machine.conveyed(item, carrier, &self.items, &self.desk, self.moved_to * self.scan_ms)
    }

    /// Whether two items lie on conveyors of which one leads onto the other.
    pub(crate) fn are_in_line(&self, items: [usize; 2]) -> bool {
        let lane = |item: usize| match self.base_carrier(item) {
            Carrier::Lane { machine, part, .. } => Some((machine, part)),
            _ => None,
        };
        let [Some(a), Some(b)] = items.map(lane) else { return false };
        self.conveying.are_joined([a, b])
    }

    /// Of the surface of a conveyor, m/s.
    pub(crate) fn surface_speed(&self, machine: usize, part: usize) -> Option<f64> {
        Some(self.machines.get(machine)?.lane(part)?.speed())
    }

    /// How a cylinder or a positioner of a machine continues from now: [`crate::part::stroke::Carriage::going`].
    pub(crate) fn carriage_going(&self, machine: usize, part: usize) -> Option<[f64; 3]> {
        Some(self.machines.get(machine)?.carriage(part)?.going(self.now_ms()))
    }

    /// How a cylinder or a positioner of a machine moves what is on it from now on.
    pub(crate) fn stroking(&self, machine: usize, part: usize) -> Option<Stroking> {
        self.machines.get(machine)?.carriage(part)?.stroking(self.now_ms())
    }

    /// How a machine moves from now on.
    pub(crate) fn trajectory(&self, machine: usize) -> Trajectory {
        self.machines.get(machine).map_or(Trajectory::Rests, |machine| machine.trajectory(self.now_ms()))
    }

    /// How many commands a machine has been given.
    pub(crate) fn commands(&self, machine: usize) -> u32 {
        self.machines.get(machine).map_or(0, Working::commands)
    }

    /// The commands of a machine that ended in an error of reach, or gripped nothing.
    pub(crate) fn missed(&self, machine: usize) -> Option<&MissedCommands> {
        Some(self.machines.get(machine)?.missed())
    }

    /// How many items the grippers of a machine have attached.
    pub(crate) fn picks(&self, machine: usize) -> u32 {
        self.machines.get(machine).map_or(0, Working::picks)
    }

    /// How many cycles of a process have begun.
    pub(crate) fn cycles(&self, machine: usize, part: usize) -> u32 {
        self.machines.get(machine).map_or(0, |machine| machine.cycles(part))
    }

    /// The scan that starts.
    pub fn scan(&self) -> u64 {
        self.scan
    }

    /// Time from the start of the run.
    pub fn now_ms(&self) -> u64 {
        self.scan * self.scan_ms
    }

    /// The order that is open at a machine.
    pub fn open_order(&self, machine: usize) -> Option<usize> {
        self.machines.get(machine)?.open_order()
    }

    /// Number of the orders of a machine that have not opened yet.
    pub fn orders_to_open(&self, machine: usize) -> usize {
        self.machines.get(machine).map_or(0, |machine| machine.orders_to_open(&self.desk))
    }

    /// Whether something will change even if no output does: a command under way that is not held, an arm that brakes, or
    /// a moving lane that bears items or will, a fault that ends.
    pub fn is_busy(&self) -> bool {
        let now_ms = self.now_ms();
        self.faulty.iter().any(|machine| self.machines[*machine].faults().is_passing(self.scan))
            || self.machines.iter().any(|machine| machine.is_busy(&self.items, &self.desk, self.scan, now_ms))
            || self.conveying.is_busy(View { machines: &self.machines, items: &self.items }, now_ms)
    }

    /// Whether a machine moves at the start of this scan.
    pub(crate) fn moves(&self, machine: usize) -> bool {
        self.trajectory(machine).since(self.now_ms() as f64) != Trajectory::Rests
            || self.machines.get(machine).is_some_and(|working| working.flows(self.now_ms()))
    }
}

/// Those that are not idle.
fn working(machines: &mut [Working]) -> impl Iterator<Item = &mut Working> {
    machines.iter_mut().filter(|machine| !machine.is_idle())
}

/// An image of zeros for the outputs of each machine.
pub fn outputs(line: &Line) -> Vec<Vec<f64>> {
    let kinds = line.kinds.len();
    line.machines.iter().map(|machine| vec![0.0; machine.wiring.output_words(kinds)]).collect()
}

/// Machines that have a part of which this holds.
fn machines_with(line: &Line, wanted: impl Fn(&Primitive) -> bool) -> Vec<usize> {
    let mut machines: Vec<usize> = parts(line, wanted).map(|(machine, _)| machine).collect();
    machines.dedup();
    machines
}

/// Numbers of machines and of their parts of which this holds.
fn parts(line: &Line, wanted: impl Fn(&Primitive) -> bool) -> impl Iterator<Item = (usize, usize)> {
    line.machines.iter().enumerate().flat_map(move |(index, machine)| {
        let parts = machine.parts.iter().enumerate();
        let found: Vec<_> = parts.filter(|(_, part)| wanted(&part.primitive)).collect();
        found.into_iter().map(move |(part, _)| (index, part))
    })
}
