//! Values of the settings of parts, and their text form.

use crate::frame::Frame;
use crate::point::{Axis, Point};
use crate::words::Words;
use std::fmt::Write;

/// A value that a device gives a setting of one of its parts.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    Truth(bool),
    Number(f64),
    Point(Point),
    Frame(Frame),
    Axis(Axis),
    Word(String),
    /// Another part of the same machine, by its number, and one of its frames.
    Part {
        part: usize,
        frame: usize,
    },
    List(Vec<Value>),
}

impl Value {
    /// Appends the words that [`Self::read`] reads back to the same bits.
    pub fn write(&self, out: &mut String) {
        let _ = match self {
            Value::Truth(truth) => write!(out, " {truth}"),
            Value::Number(number) => write!(out, " number {number:?}"),
            Value::Point(Point { x, y, z }) => write!(out, " point {x:?} {y:?} {z:?}"),
            Value::Frame(Frame { position: Point { x, y, z }, yaw }) => {
                write!(out, " frame {x:?} {y:?} {z:?} {yaw:?}")
            }
            Value::Axis(Axis::X) => write!(out, " axis x"),
            Value::Axis(Axis::Y) => write!(out, " axis y"),
            Value::Word(word) => write!(out, " word {word}"),
            Value::Part { part, frame } => write!(out, " part {part} {frame}"),
            Value::List(values) => {
                let _ = write!(out, " list {}", values.len());
                values.iter().for_each(|value| value.write(out));
                Ok(())
            }
        };
    }

    pub fn read(words: &mut Words) -> Result<Self, String> {
        Ok(match words.name()? {
            "true" => Value::Truth(true),
            "false" => Value::Truth(false),
            "number" => Value::Number(words.real()?),
            "point" => Value::Point(Point::new(words.real()?, words.real()?, words.real()?)),
            "frame" => {
                let position = Point::new(words.real()?, words.real()?, words.real()?);
                Value::Frame(Frame::new(position, words.real()?))
            }
            "axis" => match words.name()? {
                "x" => Value::Axis(Axis::X),
                "y" => Value::Axis(Axis::Y),
                other => return Err(words.error(format_args!("`{other}` is no axis"))),
            },
            "word" => Value::Word(words.name()?.into()),
            "part" => Value::Part { part: words.int()?, frame: words.int()? },
            "list" => Value::List(words.list(Self::read)?),
            other => return Err(words.error(format_args!("`{other}` begins no value"))),
        })
    }
}
