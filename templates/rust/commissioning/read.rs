//! Parameters of a layout from words. What is read lives as long as the program.

use controllers::types::{Array, Point, Relation};
use runtime_sim::words::Words;

pub trait Read: Sized {
    fn read(words: &mut Words) -> Result<Self, String>;
}

impl Read for bool {
    fn read(words: &mut Words) -> Result<Self, String> {
        Ok(words.int::<u8>()? != 0)
    }
}

impl Read for i32 {
    fn read(words: &mut Words) -> Result<Self, String> {
        words.int()
    }
}

impl Read for f64 {
    fn read(words: &mut Words) -> Result<Self, String> {
        words.real()
    }
}

impl Read for Point {
    fn read(words: &mut Words) -> Result<Self, String> {
        Ok(Point::new(words.real()?, words.real()?, words.real()?))
    }
}

impl Read for &'static str {
    fn read(words: &mut Words) -> Result<Self, String> {
        Ok(words.name()?.to_string().leak())
    }
}

impl<T: Read, const N: usize> Read for Array<T, N> {
    fn read(words: &mut Words) -> Result<Self, String> {
        let values = (0..N).map(|_| T::read(words)).collect::<Result<Vec<T>, String>>()?;
        values.try_into().map(Array).map_err(|_| words.error("too few elements"))
    }
}

impl<T: Read> Read for &'static [T] {
    fn read(words: &mut Words) -> Result<Self, String> {
        Ok(words.list(T::read)?.leak())
    }
}

pub fn relation(words: &mut Words, name: &str) -> Result<Relation<'static>, String> {
    words.expect(name)?;
    Ok(Relation(words.list(<&'static [bool]>::read)?.leak()))
}

/// So many rows that hold the same.
pub fn rows<T: Clone>(count: usize, row: T) -> Vec<T> {
    vec![row; count]
}

pub fn leak<T>(value: T) -> &'static mut T {
    Box::leak(Box::new(value))
}
