//! Where items lie: slots on a floor that stands or is carried.

use super::settings::{Form, Setting, Settings};
use super::{Described, Running, Schema, See, Start, Primitive};
use crate::carrier::Carrier;
use crate::point::Point;

pub const SCHEMA: Schema = Schema::new(
    "place",
    "A floor with slots. Items that fall on it stay on it.",
    &[
        Setting::new("on", Form::Part(&["route"]), "", "what carries it; without it, it is at rest").optional(),
        Setting::new(
            "at",
            Form::Point,
            "m",
            "origin of the offsets; at the first stop if it is carried",
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
        Setting::new("title", Form::Word, "", "its name in reports, after the machine's name").optional(),
    ],
);

#[derive(Clone, Debug, PartialEq)]
pub struct Place {
    pub route: Option<usize>,
    pub at: Point,
    pub slots: Vec<Point>,
    pub by_kind: bool,
    pub floor: Point,
    pub floor_x: [f64; 2],
    pub floor_y: [f64; 2],
    pub drawn: Option<Point>,
    pub title: Option<String>,
}

impl Described for Place {
    fn new(settings: &Settings) -> Result<Self, String> {
        Ok(Self {
            route: settings.optional("on", Settings::part)?,
            at: settings.point("at")?,
            slots: settings.points("slots")?,
            by_kind: settings.truth("by_kind")?,
            floor: settings.point("floor")?,
            floor_x: settings.range("floor_x")?,
            floor_y: settings.range("floor_y")?,
            drawn: settings.optional("drawn", Settings::point)?,
            title: settings.optional("title", Settings::word)?.map(Into::into),
        })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let part = start.part;
        let orders =
            start.find(|other| matches!(other, Primitive::Orders(orders) if orders.place == part));
        Ok(Some(Box::new(Bearing::new(self, part, orders))))
    }
}

/// A place at work.
#[derive(Clone, Debug)]
pub struct Bearing {
    place: Place,
    part: usize,
    /// The order desk that takes the place away and brings it.
    orders: Option<usize>,
}

impl Bearing {
    pub fn new(place: &Place, part: usize, orders: Option<usize>) -> Self {
        Self { place: place.clone(), part, orders }
    }

    fn origin(&self, see: &See) -> Point {
        self.place.route.and_then(|route| see.position(route)).unwrap_or(self.place.at)
    }
}

impl Running for Bearing {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn below(&self, point: Point, _ms: f64, see: &See) -> Option<(f64, Carrier)> {
        if self.orders.is_some_and(|orders| !see.is_open(orders)) {
            return None;
        }
        let Place { floor, floor_x, floor_y, .. } = self.place;
        let origin = self.origin(see);
        let from_middle = point - (origin + floor);
        let is_within = |at: f64, [low, high]: [f64; 2]| (low..=high).contains(&at);
        let meets = is_within(from_middle.x, floor_x) && is_within(from_middle.y, floor_y);
        let offset = Point { z: floor.z, ..point - origin };
        let carrier = Carrier::Place { machine: see.machine, part: self.part, offset };
        meets.then_some((origin.z + floor.z, carrier))
    }

    fn place(&self, _item: usize, carrier: &Carrier, see: &See) -> Option<Point> {
        match *carrier {
            Carrier::Place { offset, .. } => Some(self.origin(see) + offset),
            _ => None,
        }
    }
}
