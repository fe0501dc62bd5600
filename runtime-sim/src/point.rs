//! A position in space.

use std::ops::{Add, Sub};

/// A position or an offset, in metres, world frame unless said otherwise.
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

    /// Whether every coordinate is a number within 1000 km.
    pub fn is_near(self) -> bool {
        [self.x, self.y, self.z].iter().all(|coordinate| coordinate.abs() <= 1e6)
    }

    /// The same place, `height` metres higher.
    pub fn up(self, height: f64) -> Self {
        Self { z: self.z + height, ..self }
    }

    /// This offset, so many times as long.
    pub fn scaled(self, factor: f64) -> Self {
        Self::new(self.x * factor, self.y * factor, self.z * factor)
    }

    pub fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y + self.z * other.z
    }

    pub fn length(self) -> f64 {
        self.dot(self).sqrt()
    }

    pub fn coordinate(self, axis: Axis) -> f64 {
        match axis {
            Axis::X => self.x,
            Axis::Y => self.y,
        }
    }

    /// The same place with another coordinate along one axis.
    pub fn with_coordinate(self, axis: Axis, value: f64) -> Self {
        match axis {
            Axis::X => Self { x: value, ..self },
            Axis::Y => Self { y: value, ..self },
        }
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

/// The horizontal axis along which a belt or a rail lies.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    X,
    Y,
}
