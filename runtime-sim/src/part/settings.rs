//! The settings of a part, read by name.

use crate::frame::Frame;
use crate::point::{Axis, Direction, Point};
use crate::value::Value;

/// A setting that a primitive knows.
#[derive(Debug, PartialEq)]
pub struct Setting {
    pub name: &'static str,
    pub form: Form,
    /// Empty for a number without unit.
    pub unit: &'static str,
    pub meaning: &'static str,
    pub is_optional: bool,
}

/// What values a setting takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Form {
    Truth,
    /// Finite.
    Number,
    Positive,
    Point,
    Frame,
    /// A point, or a frame.
    Origin,
    /// A level axis, x or y.
    Axis,
    /// x, y or z.
    Direction,
    Word,
    /// Another part, of one of these primitives.
    Part(&'static [&'static str]),
    /// Two numbers, the lower one first.
    Range,
    Points,
    Numbers,
    Words,
    /// One time over 0, or a list of such.
    Times,
}

impl Setting {
    pub const fn new(name: &'static str, form: Form, unit: &'static str, meaning: &'static str) -> Self {
        Self { name, form, unit, meaning, is_optional: false }
    }

    pub const fn optional(self) -> Self {
        Self { is_optional: true, ..self }
    }
}

/// Names and values, in the order of the text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Settings(Vec<(&'static str, Value)>);

/// The word of a setting that is a direction, for the axis that is not level.
pub const VERTICAL: &str = "z";

/// No number is farther from 0.
const FARTHEST: f64 = 1e6;
/// No number that is over 0 is less.
const LEAST: f64 = 1e-9;
/// No time is longer, ms.
const LONGEST: f64 = 1e9;

impl Settings {
    pub fn new(settings: Vec<(&'static str, Value)>) -> Self {
        Self(settings)
    }

    pub fn all(&self) -> &[(&'static str, Value)] {
        &self.0
    }

    pub fn get(&self, name: &str) -> Option<&Value> {
        self.0.iter().find(|(known, _)| *known == name).map(|(_, value)| value)
    }

    pub fn has(&self, name: &str) -> bool {
        self.get(name).is_some()
    }

    /// What `read` gives for a setting, if it is there.
    pub fn optional<'s, T>(
        &'s self,
        name: &str,
        read: impl FnOnce(&'s Self, &str) -> Result<T, String>,
    ) -> Result<Option<T>, String> {
        self.has(name).then(|| read(self, name)).transpose()
    }

    fn read<T>(&self, name: &str, what: &str, take: impl FnOnce(&Value) -> Option<T>) -> Result<T, String> {
        let value = self.get(name).ok_or_else(|| format!("the setting {name} is missing"))?;
        take(value).ok_or_else(|| format!("the setting {name} is no {what}"))
    }

    pub fn truth(&self, name: &str) -> Result<bool, String> {
        self.read(name, "`true` or `false`", |value| match value {
            Value::Truth(truth) => Some(*truth),
            _ => None,
        })
    }

    pub fn number(&self, name: &str) -> Result<f64, String> {
        self.read(name, "number from -1000000 to 1000000", number)
    }

    pub fn positive(&self, name: &str) -> Result<f64, String> {
        let what = "number from 0.000000001 to 1000000";
        self.read(name, what, |value| number(value).filter(|n| *n >= LEAST))
    }

    /// Whole milliseconds.
    pub fn milliseconds(&self, name: &str) -> Result<u64, String> {
        self.read(name, "time of at most 1000000 s in whole milliseconds", time)
    }

    /// Whole milliseconds: of one time, or of each of a list.
    pub fn times(&self, name: &str) -> Result<Vec<u64>, String> {
        let some_time = |value: &Value| time(value).filter(|ms| *ms > 0);
        self.read(name, "time over 0 and of at most 1000000 s, in whole milliseconds", |value| match value {
            Value::List(values) => values.iter().map(some_time).collect(),
            _ => Some(vec![some_time(value)?]),
        })
    }

    pub fn point(&self, name: &str) -> Result<Point, String> {
        self.read(name, "point within 1000 km", point)
    }

    pub fn upright(&self, name: &str) -> Result<Frame, String> {
        self.read(name, "frame within 1000 km", |value| match value {
            Value::Frame(frame) if frame.is_near() => Some(*frame),
            _ => None,
        })
    }

    /// A point stands for a frame that is not turned.
    pub fn origin(&self, name: &str) -> Result<Frame, String> {
        self.read(name, "point or frame within 1000 km", |value| match value {
            Value::Frame(frame) => frame.is_near().then_some(*frame),
            _ => Some(Frame::new(point(value)?, 0.0)),
        })
    }

    pub fn axis(&self, name: &str) -> Result<Axis, String> {
        self.read(name, "axis", |value| match value {
            Value::Axis(axis) => Some(*axis),
            _ => None,
        })
    }

    pub fn direction(&self, name: &str) -> Result<Direction, String> {
        self.read(name, "axis", |value| match value {
            Value::Axis(axis) => Some((*axis).into()),
            Value::Word(word) if word == VERTICAL => Some(Direction::Z),
            _ => None,
        })
    }

    pub fn word(&self, name: &str) -> Result<&str, String> {
        let value = self.get(name).ok_or_else(|| format!("the setting {name} is missing"))?;
        word(value).ok_or_else(|| format!("the setting {name} is no word"))
    }

    /// The number of another part.
    pub fn part(&self, name: &str) -> Result<usize, String> {
        Ok(self.frame(name)?.0)
    }

    /// The number of another part, and that of one of its frames.
    pub fn frame(&self, name: &str) -> Result<(usize, usize), String> {
        self.read(name, "part", |value| match value {
            Value::Part { part, frame } => Some((*part, *frame)),
            _ => None,
        })
    }

    /// Lower and upper end.
    pub fn range(&self, name: &str) -> Result<[f64; 2], String> {
        let ends = self.numbers(name)?;
        match ends[..] {
            [low, high] if low <= high => Ok([low, high]),
            _ => Err(format!("the setting {name} is no range, the lower end first")),
        }
    }

    pub fn numbers(&self, name: &str) -> Result<Vec<f64>, String> {
        self.list(name, "list of numbers", number)
    }

    pub fn points(&self, name: &str) -> Result<Vec<Point>, String> {
        self.list(name, "list of points", point)
    }

    pub fn words(&self, name: &str) -> Result<Vec<String>, String> {
        self.list(name, "list of words", |value| word(value).map(Into::into))
    }

    fn list<T>(
        &self,
        name: &str,
        what: &str,
        element: impl Fn(&Value) -> Option<T>,
    ) -> Result<Vec<T>, String> {
        self.read(name, what, |value| match value {
            Value::List(values) => values.iter().map(element).collect(),
            _ => None,
        })
    }
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Number(number) if number.abs() <= FARTHEST => Some(*number),
        _ => None,
    }
}

fn time(value: &Value) -> Option<u64> {
    match value {
        Value::Number(ms) if (0.0..=LONGEST).contains(ms) && ms.fract() == 0.0 => Some(*ms as u64),
        _ => None,
    }
}

fn point(value: &Value) -> Option<Point> {
    match value {
        Value::Point(point) if point.is_near() => Some(*point),
        _ => None,
    }
}

fn word(value: &Value) -> Option<&str> {
    match value {
        Value::Word(word) => Some(word),
        _ => None,
    }
}
