//! Values of a state: where each stands among its bytes, and numbers for what is no whole number.

use crate::hazard::Site;
use rustc_hash::FxHashMap;

/// Where a value stands in a state. 1, 2 or 4 bytes; those of one and two hold no negative numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Var {
    pub at: u32,
    pub width: u8,
}

impl Var {
    #[inline(always)]
    pub fn load(self, state: &[u8]) -> i32 {
        let at = self.at as usize;
        match self.width {
            1 => i32::from(state[at]),
            2 => i32::from(u16::from_le_bytes([state[at], state[at + 1]])),
            _ => i32::from_le_bytes([state[at], state[at + 1], state[at + 2], state[at + 3]]),
        }
    }

    #[inline(always)]
    pub fn store(self, state: &mut [u8], value: i32) {
        let at = self.at as usize;
        match self.width {
            1 => state[at] = value as u8,
            2 => state[at..at + 2].copy_from_slice(&(value as u16).to_le_bytes()),
            _ => state[at..at + 4].copy_from_slice(&value.to_le_bytes()),
        }
    }
}

pub type Point = [f64; 3];

/// Numbers of the points and reals that have come up. Number 0 is (0, 0, 0), and 0; point 1 is without end.
#[derive(Clone, Debug)]
pub struct Values {
    points: Vec<Point>,
    point_numbers: FxHashMap<[u64; 3], u16>,
    reals: Vec<f64>,
    real_numbers: FxHashMap<u64, u16>,
    is_full: bool,
    /// Of each point for which machines it was asked whether they can bring their tools there, and whether they can.
    reached: Vec<Vec<(usize, bool)>>,
    /// Of each point that was asked for the sites that it is at.
    pub(crate) sites: Vec<Option<Box<[Site]>>>,
    /// Of each point that was asked for the vehicles that may be there, a bit each.
    vehicles: Vec<Option<u64>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Count {
    points: usize,
    reals: usize,
    is_full: bool,
}

impl Default for Values {
    fn default() -> Self {
        let mut values = Self {
            points: Vec::new(),
            point_numbers: FxHashMap::default(),
            reals: Vec::new(),
            real_numbers: FxHashMap::default(),
            is_full: false,
            reached: Vec::new(),
            sites: Vec::new(),
            vehicles: Vec::new(),
        };
        values.number_of_point([0.0; 3]);
        values.number_of_point([f64::INFINITY; 3]);
        values.number_of_real(0.0);
        values
    }
}

impl Values {
    /// The point of which it is not known where it is: far from all others.
    pub(crate) const NOWHERE: i32 = 1;

    pub fn point(&self, number: i32) -> Point {
        self.points[number as usize]
    }

    pub fn real(&self, number: i32) -> f64 {
        self.reals[number as usize]
    }

    pub fn number_of_point(&mut self, point: Point) -> i32 {
        // 0 equals -0.
        let point = point.map(|c| c + 0.0);
        let key = point.map(f64::to_bits);
        if let Some(number) = self.point_numbers.get(&key) {
            return i32::from(*number);
        }
        let Ok(number) = u16::try_from(self.points.len()) else {
            self.is_full = true;
            return 0;
        };
        self.points.push(point);
        self.point_numbers.insert(key, number);
        i32::from(number)
    }

    pub fn number_of_real(&mut self, real: f64) -> i32 {
        let real = real + 0.0;
        if let Some(number) = self.real_numbers.get(&real.to_bits()) {
            return i32::from(*number);
        }
        let Ok(number) = u16::try_from(self.reals.len()) else {
            self.is_full = true;
            return 0;
        };
        self.reals.push(real);
        self.real_numbers.insert(real.to_bits(), number);
        i32::from(number)
    }

    /// More than 65,536 places or numbers have come up: states can no longer be told apart.
    pub fn is_full(&self) -> bool {
        self.is_full
    }

    /// How many have a number, and whether there are more.
    pub(crate) fn count(&self) -> Count {
        Count { points: self.points.len(), reals: self.reals.len(), is_full: self.is_full }
    }

    /// As if only so many had come up.
    pub(crate) fn forget_after(&mut self, count: Count) {
        if self.count() == count {
            return;
        }
        for point in self.points.drain(count.points..) {
            self.point_numbers.remove(&point.map(f64::to_bits));
        }
        for real in self.reals.drain(count.reals..) {
            self.real_numbers.remove(&real.to_bits());
        }
        self.is_full = count.is_full;
        self.sites.truncate(count.points);
        self.reached.truncate(count.points);
        self.vehicles.truncate(count.points);
    }

    /// Asks once for each machine and point.
    pub fn is_reached(&mut self, machine: usize, number: i32, ask: impl FnOnce(Point) -> bool) -> bool {
        if self.reached.len() < self.points.len() {
            self.reached.resize(self.points.len(), Vec::new());
        }
        let known = &mut self.reached[number as usize];
        if let Some((_, is_reached)) = known.iter().find(|(other, _)| *other == machine) {
            return *is_reached;
        }
        let is_reached = ask(self.points[number as usize]);
        known.push((machine, is_reached));
        is_reached
    }

    /// Asks once for each point.
    pub(crate) fn vehicles_at(&mut self, number: i32, ask: impl FnOnce(Point) -> u64) -> u64 {
        let at = number as usize;
        if self.vehicles.len() <= at {
            self.vehicles.resize(self.points.len(), None);
        }
        let point = self.points[at];
        *self.vehicles[at].get_or_insert_with(|| ask(point))
    }

    pub(crate) fn note_sites(&mut self, number: i32, sites: Vec<Site>) {
        let number = number as usize;
        if self.sites.len() <= number {
            self.sites.resize(number + 1, None);
        }
        self.sites[number] = Some(sites.into());
    }

    pub(crate) fn sites_of(&self, number: i32) -> &[Site] {
        self.sites.get(number as usize).and_then(Option::as_deref).unwrap_or(&[])
    }

    pub fn points(&self) -> &[Point] {
        &self.points
    }
}
