//! Types and functions of all controllers. Nothing here allocates, and nothing panics.

use core::ops::{Add, Index, IndexMut, Sub};

/// A point or a difference of points, in metres.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    pub x: f64,
    pub y: f64,
    pub z: f64,
}

impl Point {
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    pub fn is_finite(self) -> bool {
        self.x.is_finite() && self.y.is_finite() && self.z.is_finite()
    }

    pub fn squared_distance(self, other: Self) -> f64 {
        let d = self - other;
        d.x * d.x + d.y * d.y + d.z * d.z
    }
}

impl Add for Point {
    type Output = Self;

    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl Sub for Point {
    type Output = Self;

    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

/// An array whose indices the compiler has proved. An index outside its bounds would nevertheless find the first
/// element, so that the program has no place at which it could panic, from `opt-level = 1` on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Array<T, const N: usize>(pub [T; N]);

impl<T: Copy, const N: usize> Array<T, N> {
    pub const fn all(value: T) -> Self {
        Self([value; N])
    }
}

impl<T, const N: usize> Index<i32> for Array<T, N> {
    type Output = T;

    fn index(&self, index: i32) -> &T {
        self.0.get(index as usize).unwrap_or(&self.0[0])
    }
}

impl<T, const N: usize> IndexMut<i32> for Array<T, N> {
    fn index_mut(&mut self, index: i32) -> &mut T {
        let place = index as usize;
        if place < N { &mut self.0[place] } else { &mut self.0[0] }
    }
}

/// A robot, by its row among the members of an interface.
pub trait Reference: Copy {
    fn row(self) -> usize;
}

/// A row for each member of an interface; the caller owns them. A reference to no member finds the spare row.
#[derive(Debug)]
pub struct Table<'a, T> {
    rows: &'a mut [T],
    spare: T,
}

impl<'a, T> Table<'a, T> {
    pub const fn new(rows: &'a mut [T], spare: T) -> Self {
        Self { rows, spare }
    }
}

impl<R: Reference, T> Index<R> for Table<'_, T> {
    type Output = T;

    fn index(&self, reference: R) -> &T {
        self.rows.get(reference.row()).unwrap_or(&self.spare)
    }
}

impl<R: Reference, T> IndexMut<R> for Table<'_, T> {
    fn index_mut(&mut self, reference: R) -> &mut T {
        self.rows.get_mut(reference.row()).unwrap_or(&mut self.spare)
    }
}

/// As [`Table`], for values that never change.
#[derive(Clone, Copy, Debug)]
pub struct Rows<'a, T> {
    rows: &'a [T],
    spare: T,
}

impl<'a, T> Rows<'a, T> {
    pub const fn new(rows: &'a [T], spare: T) -> Self {
        Self { rows, spare }
    }
}

impl<R: Reference, T> Index<R> for Rows<'_, T> {
    type Output = T;

    fn index(&self, reference: R) -> &T {
        self.rows.get(reference.row()).unwrap_or(&self.spare)
    }
}

/// A relation between the members of two interfaces: a row for each member of the first.
#[derive(Clone, Copy, Debug)]
pub struct Relation<'a>(pub &'a [&'a [bool]]);

impl Relation<'_> {
    pub fn holds(&self, from: impl Reference, to: impl Reference) -> bool {
        self.0.get(from.row()).and_then(|row| row.get(to.row())).copied().unwrap_or(false)
    }
}

/// Why the system has stopped.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// The number that is published as `fault_code`.
    pub code: i32,
    pub text: &'static str,
}

impl Fault {
    pub const fn new(code: i32, text: &'static str) -> Self {
        Self { code, text }
    }
}

/// Stores a whole number. Outside its bounds it stores the nearest bound, and this is a fault.
pub fn store_whole(value: i32, [low, high]: [i32; 2], place: &mut i32, fault: Fault) -> Result<(), Fault> {
    *place = value.max(low).min(high);
    if *place == value { Ok(()) } else { Err(fault) }
}

/// Stores a real that is finite; any other real is a fault.
pub fn store_real(value: f64, place: &mut f64, fault: Fault) -> Result<(), Fault> {
    if value.is_finite() {
        *place = value;
        Ok(())
    } else {
        Err(fault)
    }
}

/// Stores a point that is finite; any other point is a fault.
pub fn store_point(value: Point, place: &mut Point, fault: Fault) -> Result<(), Fault> {
    if value.is_finite() {
        *place = value;
        Ok(())
    } else {
        Err(fault)
    }
}

/// A fault if a state lasts `longest` milliseconds or more.
pub fn within(elapsed: i32, longest: i32, fault: Fault) -> Result<(), Fault> {
    if elapsed >= longest { Err(fault) } else { Ok(()) }
}

/// A quotient whose divisor the compiler has proved to differ from 0.
pub fn quotient(dividend: i32, divisor: i32) -> i32 {
    dividend.checked_div(divisor).unwrap_or(0)
}

/// A remainder whose divisor the compiler has proved to differ from 0.
pub fn remainder(dividend: i32, divisor: i32) -> i32 {
    dividend.checked_rem(divisor).unwrap_or(0)
}

/// The lesser of two reals; the first unless the second is less.
pub fn lesser(a: f64, b: f64) -> f64 {
    if b < a { b } else { a }
}

/// The greater of two reals; the first unless it is less than the second.
pub fn greater(a: f64, b: f64) -> f64 {
    if a < b { b } else { a }
}

/// Highest number of a command; the number after it is 1. 0 means that none was given yet.
pub const LAST_COMMAND: i32 = 32767;

/// The number after the last one that the device does not show at present.
pub fn next_command(last: i32, got: i32, ack: i32) -> i32 {
    let mut number = last;
    loop {
        number = if number >= LAST_COMMAND { 1 } else { number + 1 };
        if number != got && number != ack {
            return number;
        }
    }
}
