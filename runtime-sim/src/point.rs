//! A position in space.

use std::ops::{Add, Sub};

/// A position or an offset, in metres, world frame unless said otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Point {
    pub x: f64,
    pub y: f64,
    pub z: f64,
}

/// The lesser of two numbers; the second one, if one of them is no number. Unlike [`f64::min`] one instruction.
#[inline]
pub(crate) fn lesser(a: f64, b: f64) -> f64 {
    if a < b { a } else { b }
}

/// The greater of two numbers; the second one, if one of them is no number.
#[inline]
pub(crate) fn greater(a: f64, b: f64) -> f64 {
    if a > b { a } else { b }
}

impl Point {
    pub const fn new(x: f64, y: f64, z: f64) -> Self {
        Self { x, y, z }
    }

    /// Whether every coordinate is a number within 1000 km.
    pub fn is_near(self) -> bool {
        [self.x, self.y, self.z].iter().all(|coordinate| coordinate.abs() <= 1e6)
    }

    /// The same place, `height` metres higher.
    #[inline]
    pub fn up(self, height: f64) -> Self {
        Self { z: self.z + height, ..self }
    }

    /// This offset, so many times as long.
    #[inline]
    pub fn scaled(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }

    /// Without the signs of its coordinates.
    #[inline]
    pub fn absolute(self) -> Self {
        Self::new(self.x.abs(), self.y.abs(), self.z.abs())
    }

    #[inline]
    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    #[inline]
    pub fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    pub fn coordinate(self, along: impl Into<Direction>) -> f64 {
        match along.into() {
            Direction::X => self.x,
            Direction::Y => self.y,
            Direction::Z => self.z,
        }
    }

    /// The same place with another coordinate along one axis.
    pub fn with_coordinate(self, along: impl Into<Direction>, value: f64) -> Self {
        match along.into() {
            Direction::X => Self { x: value, ..self },
            Direction::Y => Self { y: value, ..self },
            Direction::Z => Self { z: value, ..self },
        }
    }
}

impl Add for Point {
    type Output = Self;
    #[inline]
    fn add(self, other: Self) -> Self {
        Self::new(self.x + other.x, self.y + other.y, self.z + other.z)
    }
}

impl Sub for Point {
    type Output = Self;
    #[inline]
    fn sub(self, other: Self) -> Self {
        Self::new(self.x - other.x, self.y - other.y, self.z - other.z)
    }
}

/// The horizontal axis along which a belt or a rail lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    X,
    Y,
}

/// An axis of a frame.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Direction {
    X,
    Y,
    Z,
}

impl Direction {
    pub const ALL: [Self; 3] = [Self::X, Self::Y, Self::Z];

    /// None for the vertical.
    pub fn level(self) -> Option<Axis> {
        match self {
            Self::X => Some(Axis::X),
            Self::Y => Some(Axis::Y),
            Self::Z => None,
        }
    }
}

impl From<Axis> for Direction {
    fn from(axis: Axis) -> Self {
        match axis {
            Axis::X => Self::X,
            Axis::Y => Self::Y,
        }
    }
}
