//! Process images: a number for each point of I/O.

use controllers::types::{Array, Point};

/// The numbers of an image, from the front; missing numbers are 0.
pub struct Image<'a>(std::slice::Iter<'a, f64>);

impl<'a> Image<'a> {
    pub fn new(image: &'a [f64]) -> Self {
        Self(image.iter())
    }

    fn word(&mut self) -> f64 {
        self.0.next().copied().unwrap_or(0.0)
    }
}

/// A value that is latched from an image.
pub trait Latch {
    fn latch(image: &mut Image) -> Self;
}

impl Latch for bool {
    fn latch(image: &mut Image) -> Self {
        image.word() != 0.0
    }
}

impl Latch for i32 {
    fn latch(image: &mut Image) -> Self {
        image.word() as i32
    }
}

impl Latch for f64 {
    fn latch(image: &mut Image) -> Self {
        image.word()
    }
}

impl Latch for Point {
    fn latch(image: &mut Image) -> Self {
        Point::new(image.word(), image.word(), image.word())
    }
}

impl<T: Latch, const N: usize> Latch for Array<T, N> {
    fn latch(image: &mut Image) -> Self {
        Array(std::array::from_fn(|_| T::latch(image)))
    }
}

/// A value that is written to an image.
pub trait Put {
    fn put(self, out: &mut Vec<f64>);
}

impl Put for bool {
    fn put(self, out: &mut Vec<f64>) {
        out.push(f64::from(u8::from(self)));
    }
}

impl Put for i32 {
    fn put(self, out: &mut Vec<f64>) {
        out.push(f64::from(self));
    }
}

impl Put for f64 {
    fn put(self, out: &mut Vec<f64>) {
        out.push(self);
    }
}

impl Put for Point {
    fn put(self, out: &mut Vec<f64>) {
        out.extend([self.x, self.y, self.z]);
    }
}

impl<T: Put, const N: usize> Put for Array<T, N> {
    fn put(self, out: &mut Vec<f64>) {
        self.0.into_iter().for_each(|value| value.put(out));
    }
}
