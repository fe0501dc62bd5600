//! Where items lie: slots on a floor that stands or is carried.

mod floor;
mod stack;

pub use floor::Floor;
pub use stack::{Rest, Stack};

use super::settings::{Form, Setting, Settings};
use super::{Described, Running, Schema, See, Start, Primitive};
use crate::carrier::Carrier;
use crate::frame::Frame;
use crate::item::block::Block;
use crate::kinematics::facing::Facing;
use crate::plant::conveyed::Conveyed;
use crate::plant::fall::{Falling, SINK};
use crate::point::Point;

pub const SCHEMA: Schema = Schema::new(
    "place",
    "A floor with slots. Items that fall on it stay on it. It has no solid of its own: give the machine a body, such as the table under it, so that contact with it is found.",
    &[
        Setting::new("on", Form::Part(&["route", "track", "cylinder", "positioner"]), "", "what carries it; without it, it is at rest").optional(),
        Setting::new(
            "at",
            Form::Origin,
            "m",
            "origin of the offsets: at the first stop of a route, at the inner end of a cylinder, at 0 of a positioner; on a track from the middle of the vehicle, x ahead. A frame turns slots and floor: `origin * frame(1, 0, 0.5, 0)` with the machine. With a point they lie along the axes of the world, on a track along the vehicle. `drawn` is turned too, `toward` is not",
        ),
        Setting::new("slots", Form::Points, "m", "places of the undersides of items, from the origin"),
        Setting::new("by_kind", Form::Truth, "", "each slot is for one kind, in the order of the kinds"),
        Setting::new("floor", Form::Point, "m", "middle of the floor, from the origin"),
        Setting::new("floor_x", Form::Range, "m", "extent of the floor along x, from its middle"),
        Setting::new("floor_y", Form::Range, "m", "the same along y"),
        Setting::new(
            "drawn",
            Form::Point,
            "m",
            "lengths along x and y in drawings, around the origin; without it those of the floor",
        )
        .optional(),
        Setting::new(
            "stacks",
            Form::Truth,
            "",
            "items lie on one another, each on the highest of those under any part of it, as they are turned; without it each lies on the floor. Taking an item on which another one lies ends the run. So does an item that comes down [into or off](#items-on-conveyors) another one. What lies on an item that a process changes or takes away comes down, or is lifted",
        )
        .optional(),
        Setting::new(
            "toward",
            Form::Point,
            "m",
            "direction in which items are put there, down or level; in a level one they are held at the slots, with their undersides ahead, as in the chuck of a lathe. Without it down",
        )
        .optional(),
        Setting::new("title", Form::Word, "", "its name in reports, after the machine's name").optional(),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    /// What carries it.
    pub on: Option<usize>,
    pub at: Point,
    /// From there, along the axes of the world or of what carries it.
    pub slots: Vec<Point>,
    pub by_kind: bool,
    /// The same.
    pub floor: Floor,
    pub drawn: Option<Point>,
    pub stacks: bool,
    /// Where a tool points that puts an item there.
    pub facing: Facing,
    pub title: Option<String>,
}

impl Described for Place {
    fn new(settings: &Settings) -> Result<Self, String> {
        let facing = match settings.optional("toward", Settings::point)? {
            Some(toward) => Facing::new(toward).ok_or("the setting toward is neither down nor level")?,
            None => Facing::Down,
        };
        let stacks = settings.optional("stacks", Settings::truth)?.unwrap_or(false);
        if stacks && facing != Facing::Down {
            return Err("items are not stacked at a place that is filled from the side".into());
        }
        let at = settings.origin("at")?;
        Ok(Self {
            on: settings.optional("on", Settings::part)?,
            at: at.position,
            slots: settings.points("slots")?.into_iter().map(|slot| at.direction(slot)).collect(),
            by_kind: settings.truth("by_kind")?,
            floor: Floor {
                middle: at.direction(settings.point("floor")?),
                x: settings.range("floor_x")?,
                y: settings.range("floor_y")?,
                yaw: at.yaw,
            },
            drawn: settings.optional("drawn", Settings::point)?,
            stacks,
            facing,
            title: settings.optional("title", Settings::word)?.map(Into::into),
        })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let part = start.part;
        let orders =
            start.find(|other| matches!(other, Primitive::Orders(orders) if orders.place == part));
        Ok(Some(Box::new(Bearing { place: self.clone(), part, orders })))
    }
}

/// Cosine of the angle between two directions that are less than 45 degrees from opposite ones.
pub const OPPOSITE: f64 = -std::f64::consts::FRAC_1_SQRT_2;

/// A place at work.
#[derive(Clone, Debug)]
pub struct Bearing {
    place: Place,
    part: usize,
    /// The order desk that takes the place away and brings it.
    orders: Option<usize>,
}

impl Bearing {
    /// An item with its upper side there, held where it is; at the places of the slots alone.
    fn held(&self, point: Point, upper: Option<Point>, frame: Frame, see: &See) -> Option<(f64, Carrier)> {
        let seen = frame.seen(point);
        let is_near = self.place.slots.iter().any(|slot| (*slot - seen).length() <= SINK);
        let fits = upper.is_some_and(|upper| upper.dot(frame.direction(self.place.facing.direction())) < OPPOSITE);
        let carrier = Carrier::Place { machine: see.machine, part: self.part, offset: seen };
        (is_near && fits).then_some((point.z, carrier))
    }

    /// From the origin; where they do not lie on one another, without them.
    fn all(&self, see: &See) -> Stack {
        let Place { floor, stacks, .. } = self.place;
        let borne = see.borne_by(self.part).filter(|_| stacks);
        let items = borne.filter_map(|item| {
            let size = see.items.dimensions(item).size;
            Some((item, Block::new(size, see.items[item].carrier.offset()?, see.items.turn(item))))
        });
        Stack::new(floor, items.collect())
    }

    /// Where an item comes to rest, from the origin.
    fn rest(&self, falling: &Falling, frame: Frame, see: &See) -> Option<Rest> {
        let seen = frame.seen(falling.point);
        let turn = falling.turn - frame.yaw.to_radians();
        self.all(see).rest(&Block::new(falling.size, seen, turn), seen.z + SINK)
    }

    /// Its frame, parallel to the world at the inner end of what carries it, on a track as the vehicle is turned; at this time from the start of the span on, ms,
    /// or now.
    fn frame(&self, see: &See, ms: Option<f64>) -> Frame {
        let at = Frame::new(self.place.at, 0.0);
        let Some(on) = self.place.on else { return at };
        if let Some(vehicle) = see.vehicle(on) {
            return ms.map_or_else(|| vehicle.frame_now(), |ms| vehicle.frame(ms)).then(at);
        }
        match see.carriage(on) {
            Some(carriage) => carriage.frame(ms.unwrap_or(carriage.now_ms() as f64)).then(at),
            None => Frame::new(see.position(on).unwrap_or(self.place.at), 0.0),
        }
    }
}

impl Running for Bearing {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn below(&self, falling: &Falling, ms: f64, see: &See) -> Option<(f64, Carrier)> {
        if self.orders.is_some_and(|orders| !see.is_open(orders)) {
            return None;
        }
        let frame = self.frame(see, Some(ms));
        if self.place.facing != Facing::Down {
            return self.held(falling.point, falling.upper, frame, see);
        }
        let height = self.rest(falling, frame, see)?.height;
        let offset = Point { z: height, ..frame.seen(falling.point) };
        let carrier = Carrier::Place { machine: see.machine, part: self.part, offset };
        Some((frame.position.z + height, carrier))
    }

    fn stack(&self, see: &See) -> Option<Stack> {
        self.place.stacks.then(|| self.all(see))
    }

    fn tips_off(&self, falling: &Falling, ms: f64, see: &See) -> Option<usize> {
        self.rest(falling, self.frame(see, Some(ms)), see)?.tips_off
    }

    fn block(&self, item: usize, ms: f64, see: &See) -> Option<Block> {
        let (offset, frame) = (see.items[item].carrier.offset()?, self.frame(see, Some(ms)));
        let turn = see.items.turn(item) + frame.yaw.to_radians();
        (self.place.facing == Facing::Down).then(|| Block::new(see.items.dimensions(item).size, frame.point(offset), turn))
    }

    fn place(&self, _item: usize, carrier: &Carrier, see: &See) -> Option<Point> {
        match *carrier {
            Carrier::Place { offset, .. } => Some(self.frame(see, None).point(offset)),
            _ => None,
        }
    }

    fn upper(&self, carrier: &Carrier, see: &See) -> Option<Point> {
        let is_level = matches!(carrier, Carrier::Place { .. }) && self.place.facing != Facing::Down;
        is_level.then(|| self.frame(see, None).direction(self.place.facing.direction()).scaled(-1.0))
    }

    /// An item on a cylinder or a positioner is carried along.
    fn conveyed(&self, _item: usize, carrier: &Carrier, see: &See) -> Option<Conveyed> {
        let (Carrier::Place { offset, .. }, Some(on)) = (carrier, self.place.on) else { return None };
        see.carriage(on).map(|_| Conveyed::standing(self.place.at + *offset))
    }

    fn on(&self) -> Option<usize> {
        self.place.on
    }
}
