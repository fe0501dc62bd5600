//! Parameters of a layout from words.

use crate::kept::Kept;
use crate::words::Words;
use controllers::types::{Array, Point, Relation};
use std::fmt::Display;
use std::str::FromStr;

/// The words of a text, and the position of the reader.
pub struct Reader<'t> {
    words: Words<'t>,
    pub kept: Kept,
}

impl<'t> Reader<'t> {
    pub fn new(text: &'t str) -> Self {
        Self { words: Words::new(text), kept: Kept::default() }
    }

    pub fn name(&mut self) -> Result<&'t str, String> {
        self.words.name()
    }

    pub fn int<T: FromStr>(&mut self) -> Result<T, String> {
        self.words.int()
    }

    pub fn expect(&mut self, keyword: &str) -> Result<(), String> {
        self.words.expect(keyword)
    }

    pub fn error(&self, message: impl Display) -> String {
        self.words.error(message)
    }

    /// A number of elements, then so many elements.
    pub fn list<T>(&mut self, element: impl Fn(&mut Self) -> Result<T, String>) -> Result<Vec<T>, String> {
        let count: usize = self.int()?;
        (0..count).map(|_| element(self)).collect()
    }

    pub fn relation(&mut self, name: &str) -> Result<Relation<'static>, String> {
        self.expect(name)?;
        let rows = self.list(<&'static [bool]>::read)?;
        Ok(Relation(self.kept.keep(rows)))
    }
}

pub trait Read: Sized {
    fn read(reader: &mut Reader) -> Result<Self, String>;
}

impl Read for bool {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        Ok(reader.words.int::<u8>()? != 0)
    }
}

impl Read for i32 {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        reader.words.int()
    }
}

impl Read for f64 {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        reader.words.real()
    }
}

impl Read for Point {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        let mut axis = || reader.words.real();
        Ok(Point::new(axis()?, axis()?, axis()?))
    }
}

impl Read for &'static str {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        let name = reader.name()?.to_string();
        Ok(reader.kept.keep(name))
    }
}

impl<T: Read, const N: usize> Read for Array<T, N> {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        let values = (0..N).map(|_| T::read(reader)).collect::<Result<Vec<T>, String>>()?;
        values.try_into().map(Array).map_err(|_| reader.error("too few elements"))
    }
}

impl<T: Read + 'static> Read for &'static [T] {
    fn read(reader: &mut Reader) -> Result<Self, String> {
        let values = reader.list(T::read)?;
        Ok(reader.kept.keep(values))
    }
}

/// A value that lives as long as the values with which it was read.
pub fn kept<T: Read + 'static>(reader: &mut Reader) -> Result<&'static mut T, String> {
    let value = T::read(reader)?;
    Ok(reader.kept.keep(value))
}

/// So many equal rows.
pub fn rows<T: Clone>(count: usize, row: T) -> Vec<T> {
    vec![row; count]
}
