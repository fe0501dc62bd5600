//! A conveyor at work.

use super::{CentreLine, Lane, RUN_BY};
use crate::carrier::Carrier;
use crate::device::error;
use crate::item::block::Block;
use crate::plant::fall::Falling;
use crate::part::{Begun, Progress, Running, See, World};
use crate::plant::conveyed::Conveyed;
use crate::point::Point;

/// What is less is rounding, m.
pub const AT_ONCE: f64 = 1e-9;

#[derive(Clone, Debug)]
pub struct Moving {
    lane: Lane,
    part: usize,
    drive: Drive,
    /// The part of its full speed at which it runs.
    rate: f64,
    held: bool,
    /// Milliseconds since the start of the run in which it has moved.
    travel_ms: u64,
    /// When its rate changed last: of these milliseconds how many had passed, and how far the surface had moved, m.
    changed: Changed,
    now_ms: u64,
    /// The foremost first. Items that have come since the conveyors were checked last are not among them yet: they go
    /// with the surface.
    pub(crate) riders: Vec<Rider>,
}

/// An item on a conveyor.
#[derive(Clone, Debug, PartialEq)]
pub struct Rider {
    pub item: usize,
    /// Half of its length along the conveyor, m.
    pub half: f64,
    pub motion: Motion,
    /// The lane from which it has come over a joint, by its number among those of the line.
    pub from: Option<usize>,
    /// Place of something that stands in its way; negative infinity: nothing does.
    pub stops_at: f64,
}

impl Rider {
    /// It goes with the surface.
    pub fn new(item: usize, half: f64, at: f64) -> Self {
        Self { item, half, motion: Motion::Goes { at }, from: None, stops_at: f64::NEG_INFINITY }
    }
}

/// How an item goes, by the places of its middle on the centre line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Motion {
    /// With the surface: it would be at this place if the surface had not moved since the start of the run.
    Goes { at: f64 },
    /// Something that stands is in its way.
    Stands { place: f64 },
    /// Behind one on a slower conveyor, with the speed of that in m/s, since a time in ms.
    Follows { place: f64, since_ms: f64, speed: f64 },
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Drive {
    Runs,
    Rest,
}

#[derive(Clone, Copy, Debug, Default)]
struct Changed {
    travel_ms: f64,
    travel: f64,
}

impl Moving {
    pub fn new(lane: &Lane, part: usize) -> Self {
        let lane = lane.clone();
        Self {
            lane,
            part,
            drive: Drive::Rest,
            rate: 1.0,
            held: false,
            travel_ms: 0,
            changed: Changed::default(),
            now_ms: 0,
            riders: Vec::new(),
        }
    }

    /// Nobody starts or stops it.
    pub fn always(self) -> Self {
        Self { drive: Drive::Runs, ..self }
    }

    /// At this part of its full speed.
    pub fn by(self, rate: f64) -> Self {
        Self { rate, ..self }
    }

    pub fn lane(&self) -> &Lane {
        &self.lane
    }

    /// Where it is at a time from the start of this span on, ms.
    fn centre_line(&self, see: &See, ms: f64) -> CentreLine {
        let carried = self.lane.on.and_then(|carriage| see.carriage(carriage));
        carried.map_or(self.lane.centre_line, |carriage| self.lane.centre_line.moved(carriage.frame(ms)))
    }

    /// How an item is turned that is there at a time from the start of this span on, ms, about the vertical, rad; none if items
    /// keep their turn.
    pub fn heading(&self, point: Point, ms: f64, see: &See) -> Option<f64> {
        let centre_line = self.centre_line(see, ms);
        let (place, _) = centre_line.find(point).filter(|_| centre_line.turns_items())?;
        Some(centre_line.frame(place).yaw.to_radians())
    }

    /// Metres that the surface has moved since the start of the run.
    pub fn travel(&self) -> f64 {
        self.travel_at(self.now_ms as f64)
    }

    /// The same at a time from the start of this span on, ms.
    pub fn travel_at(&self, ms: f64) -> f64 {
        self.travel_after(self.travel_ms_at(ms))
    }

    /// The same once it has moved for so many milliseconds, at its present rate since this changed last.
    pub fn travel_after(&self, moved_ms: f64) -> f64 {
        self.changed.travel + self.rate * self.lane.distance(moved_ms - self.changed.travel_ms)
    }

    /// Milliseconds in which it moves from the start of the run to a time from the start of this span on.
    pub fn travel_ms_at(&self, ms: f64) -> f64 {
        let since_ms = if self.is_moving() { ms - self.now_ms as f64 } else { 0.0 };
        self.travel_ms as f64 + since_ms
    }

    pub fn is_moving(&self) -> bool {
        self.drive == Drive::Runs && self.rate > 0.0 && !self.held
    }

    /// Of the surface, m/s.
    pub fn speed(&self) -> f64 {
        if self.is_moving() { self.rate * self.lane.speed } else { 0.0 }
    }

    /// Of any point of the surface at most, m/s: up or down, or on the outer side of an arc.
    pub fn top_speed(&self) -> f64 {
        self.speed() * self.lane.centre_line.stretch(self.lane.width / 2.0)
    }

    /// Of an item that goes so, m/s.
    pub fn speed_of(&self, motion: Motion) -> f64 {
        match motion {
            Motion::Goes { .. } => self.speed(),
            Motion::Stands { .. } => 0.0,
            Motion::Follows { speed, .. } => speed,
        }
    }

    /// The place of an item that goes so, at a time from the start of this span on, ms.
    pub fn place_at(&self, motion: Motion, ms: f64) -> f64 {
        match motion {
            Motion::Goes { at } => at - self.travel_at(ms),
            Motion::Stands { place } => place,
            Motion::Follows { place, since_ms, speed } => place - speed * (ms - since_ms) / 1000.0,
        }
    }

    /// When an item that goes so comes to a place, ms; `now_ms` if it has just come there, and infinity if it is past it or
    /// never does.
    pub fn comes_to(&self, motion: Motion, place: f64, now_ms: f64) -> f64 {
        let left = self.place_at(motion, now_ms) - place;
        let speed = self.speed_of(motion);
        if speed <= 0.0 || left < -AT_ONCE {
            return f64::INFINITY;
        }
        now_ms + 1000.0 * (left - AT_ONCE).max(0.0) / speed
    }

    /// How an item goes that has this carrier.
    pub fn motion(&self, item: usize, carrier: &Carrier) -> Option<Motion> {
        let Carrier::Lane { at, .. } = *carrier else { return None };
        let known = self.riders.iter().find(|rider| rider.item == item);
        Some(known.map_or(Motion::Goes { at }, |rider| rider.motion))
    }

    /// Of the last look, ms from the start of the run.
    pub fn now_ms(&self) -> f64 {
        self.now_ms as f64
    }

    pub fn place_now(&self, rider: &Rider) -> f64 {
        self.place_at(rider.motion, self.now_ms as f64)
    }

    /// The place of an item that has this carrier.
    pub fn place_of(&self, item: usize, carrier: &Carrier) -> Option<f64> {
        Some(self.place_at(self.motion(item, carrier)?, self.now_ms as f64))
    }
}

impl Running for Moving {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn begin(&mut self, action: usize, _arguments: &[f64], _world: &mut World) -> Result<Begun, i32> {
        self.drive = match action {
            0 => Drive::Runs,
            1 => Drive::Rest,
            _ => return Err(error::REFUSED),
        };
        Ok(Begun::UnderWay)
    }

    fn lose_command(&mut self, _now_ms: u64) {
        self.drive = Drive::Rest;
    }

    fn hold(&mut self, held: bool, _now_ms: u64) {
        self.held = held;
    }

    fn level(&mut self, level: usize, value: &[f64]) {
        if level == RUN_BY {
            let rate = if value[0] > 0.0 { value[0].min(1.0) } else { 0.0 };
            if rate != self.rate {
                self.changed = Changed { travel_ms: self.travel_ms as f64, travel: self.travel() };
                self.rate = rate;
            }
        } else {
            self.drive = if value[0] != 0.0 { Drive::Runs } else { Drive::Rest };
        }
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        if self.is_moving() {
            self.travel_ms += world.dt_ms;
        }
        self.now_ms = world.next_ms();
        Progress::Reached
    }

    fn signal(&self, _signal: usize, _see: &See, out: &mut [f64]) {
        out[0] = f64::from(u8::from(self.is_moving()));
    }

    fn is_busy(&self, see: &See) -> bool {
        let goes = |rider: &Rider| self.speed_of(rider.motion) > 0.0;
        self.is_moving() && see.borne_by(self.part).count() > self.riders.len()
            || self.riders.iter().any(goes)
    }

    fn below(&self, &Falling { point, .. }: &Falling, ms: f64, see: &See) -> Option<(f64, Carrier)> {
        let centre_line = self.centre_line(see, ms);
        let (place, across) = centre_line.find(point)?;
        let height = centre_line.point(place, across).z;
        let at = place + self.travel_at(ms);
        let carrier = Carrier::Lane { machine: see.machine, part: self.part, at, across };
        (across.abs() <= self.lane.width / 2.0).then_some((height, carrier))
    }

    fn block(&self, item: usize, ms: f64, see: &See) -> Option<Block> {
        let carrier = see.items[item].carrier;
        let Carrier::Lane { across, .. } = carrier else { return None };
        let centre_line = self.centre_line(see, ms);
        let place = self.place_at(self.motion(item, &carrier)?, ms);
        let turn = match centre_line.turns_items() {
            true => centre_line.frame(place).yaw.to_radians(),
            false => see.items.turn(item),
        };
        Some(Block::new(see.items.dimensions(item).size, centre_line.point(place, across), turn))
    }

    fn place(&self, item: usize, carrier: &Carrier, see: &See) -> Option<Point> {
        let Carrier::Lane { across, .. } = *carrier else { return None };
        Some(self.centre_line(see, self.now_ms as f64).point(self.place_of(item, carrier)?, across))
    }

    fn conveyed(&self, item: usize, carrier: &Carrier, _see: &See) -> Option<Conveyed> {
        let Carrier::Lane { across, .. } = *carrier else { return None };
        let motion = self.motion(item, carrier)?;
        let rider = self.riders.iter().find(|rider| rider.item == item);
        Some(Conveyed {
            centre_line: self.lane.centre_line,
            place: self.place_at(motion, self.now_ms as f64),
            across,
            offset: Point::default(),
            speed: self.speed_of(motion),
            stops_at: rider.map_or(f64::NEG_INFINITY, |rider| rider.stops_at),
            carried: None,
        })
    }

    fn on(&self) -> Option<usize> {
        self.lane.on
    }

    fn lane(&self) -> Option<&Moving> {
        Some(self)
    }

    fn lane_mut(&mut self) -> Option<&mut Moving> {
        Some(self)
    }
}
