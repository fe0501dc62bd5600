//! The I/O trace of a run: a row of values for each scan, so that another engine can be driven and compared.
//!
//! Which values there are and how they are called, whoever made the controllers says in a table of columns.
//! A row holds the inputs as latched in the scan, and everything else as it stands when the scan has ended.

use crate::run::Seen;
use crate::scan::SystemOutputs;
use crate::words::Words;
use std::fmt::Write;

/// What the values of a run are called, in the order of a row.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Columns(pub Vec<Column>);

#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Without white space.
    pub name: String,
    pub form: Form,
    pub source: Source,
}

/// What a word stands for, and so what it becomes when it is latched.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// Written as 0 or 1.
    Truth,
    Whole {
        lo: i32,
        hi: i32,
    },
    /// Written so that it is read back to the same bits; it may be `inf`, `-inf` or `NaN`.
    Real,
}

/// Where a value is found.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Source {
    RunPermit,
    Start,
    Reset,
    Running,
    Fault,
    FaultCode,
    FaultRobot,
    Alarm,
    AlarmCode,
    AlarmRobot,
    /// A word of an image, by the machine's number.
    Input {
        machine: usize,
        word: usize,
    },
    Output {
        machine: usize,
        word: usize,
    },
    /// A word of [`crate::scan::Controllers::trace`].
    Trace(usize),
}

impl Form {
    /// A whole number of 32 bits.
    pub const WHOLE: Self = Self::Whole { lo: i32::MIN, hi: i32::MAX };

    fn put(self, value: f64, row: &mut String) {
        let _ = match self {
            Self::Truth => write!(row, "{}", u8::from(value != 0.0)),
            // The conversion drops the fraction, and makes 0 of NaN.
            Self::Whole { lo, hi } => write!(row, "{}", (value as i32).clamp(lo, hi)),
            Self::Real => write!(row, "{value:?}"),
        };
    }

    fn text(self) -> String {
        match self {
            Self::Truth => "bool".into(),
            Self::Whole { lo, hi } => format!("int {lo} {hi}"),
            Self::Real => "real".into(),
        }
    }

    fn read(words: &mut Words) -> Result<Self, String> {
        match words.name()? {
            "bool" => Ok(Self::Truth),
            "int" => {
                let (lo, hi) = (words.int()?, words.int()?);
                if lo > hi {
                    return Err(words.error("the bounds are in the wrong order"));
                }
                Ok(Self::Whole { lo, hi })
            }
            "real" => Ok(Self::Real),
            other => Err(words.error(format_args!("`{other}` is no type"))),
        }
    }
}

/// Sources that are one word.
const SINGLE: [(&str, Source); 10] = [
    ("run_permit", Source::RunPermit),
    ("start", Source::Start),
    ("reset", Source::Reset),
    ("running", Source::Running),
    ("fault", Source::Fault),
    ("fault_code", Source::FaultCode),
    ("fault_robot", Source::FaultRobot),
    ("alarm", Source::Alarm),
    ("alarm_code", Source::AlarmCode),
    ("alarm_robot", Source::AlarmRobot),
];

impl Source {
    /// The word, 0 if the run has none there.
    pub fn value(self, seen: &Seen) -> f64 {
        let flag = |b: bool| f64::from(u8::from(b));
        let word = |images: &[Vec<f64>], machine: usize, word: usize| {
            images.get(machine).and_then(|image| image.get(word)).copied().unwrap_or(0.0)
        };
        let SystemOutputs { running, fault, fault_code, fault_robot, alarm, alarm_code, alarm_robot } =
            seen.answer;
        match self {
            Self::RunPermit => flag(seen.system.run_permit),
            Self::Start => flag(seen.system.start),
            Self::Reset => flag(seen.system.reset),
            Self::Running => flag(running),
            Self::Fault => flag(fault),
            Self::FaultCode => f64::from(fault_code),
            Self::FaultRobot => f64::from(fault_robot),
            Self::Alarm => flag(alarm),
            Self::AlarmCode => f64::from(alarm_code),
            Self::AlarmRobot => f64::from(alarm_robot),
            Self::Input { machine, word: at } => word(seen.inputs, machine, at),
            Self::Output { machine, word: at } => word(seen.outputs, machine, at),
            Self::Trace(at) => seen.trace.get(at).copied().unwrap_or(0.0),
        }
    }

    fn text(self) -> String {
        match self {
            Self::Input { machine, word } => format!("input {machine} {word}"),
            Self::Output { machine, word } => format!("output {machine} {word}"),
            Self::Trace(word) => format!("trace {word}"),
            single => {
                let found = SINGLE.iter().find(|(_, source)| *source == single);
                found.map_or(String::new(), |(name, _)| name.to_string())
            }
        }
    }

    fn read(words: &mut Words) -> Result<Self, String> {
        match words.name()? {
            "input" => Ok(Self::Input { machine: words.int()?, word: words.int()? }),
            "output" => Ok(Self::Output { machine: words.int()?, word: words.int()? }),
            "trace" => Ok(Self::Trace(words.int()?)),
            other => {
                let found = SINGLE.iter().find(|(name, _)| *name == other);
                found
                    .map(|(_, source)| *source)
                    .ok_or_else(|| words.error(format_args!("`{other}` is no source")))
            }
        }
    }
}

impl Columns {
    /// The names, as the first line of the trace.
    pub fn header(&self) -> String {
        let names: Vec<&str> = self.0.iter().map(|column| column.name.as_str()).collect();
        names.join(",") + "\n"
    }

    /// Appends the line of a scan.
    pub fn row(&self, seen: &Seen, out: &mut String) {
        for (i, column) in self.0.iter().enumerate() {
            if i > 0 {
                out.push(',');
            }
            column.form.put(column.source.value(seen), out);
        }
        out.push('\n');
    }

    /// The text that [`Columns::from_text`] reads back.
    pub fn to_text(&self) -> String {
        let mut out = format!("columns 1\n{}\n", self.0.len());
        for Column { name, form, source } in &self.0 {
            let _ = writeln!(out, "{name} {} {}", form.text(), source.text());
        }
        out
    }

    pub fn from_text(text: &str) -> Result<Self, String> {
        let mut words = Words::new(text);
        words.expect("columns")?;
        words.expect("1")?;
        let columns = words.list(|words| {
            let name = words.name()?.to_string();
            Ok(Column { name, form: Form::read(words)?, source: Source::read(words)? })
        })?;
        if words.is_empty() {
            Ok(Self(columns))
        } else {
            Err(words.error("more columns than were announced"))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn put(form: Form, value: f64) -> String {
        let mut row = String::new();
        form.put(value, &mut row);
        row
    }

    #[test]
    fn values_are_written_as_they_are_latched() {
        let whole = Form::Whole { lo: -1, hi: 5 };
        assert_eq!([7.0, -3.0, 2.9, -0.5, f64::NAN].map(|v| put(whole, v)), ["5", "-1", "2", "0", "0"]);
        assert_eq!([0.0, -0.0, 0.1, f64::NAN].map(|v| put(Form::Truth, v)), ["0", "0", "1", "1"]);
        assert_eq!(put(Form::WHOLE, 1e12), "2147483647");
    }

    #[test]
    fn reals_are_read_back_to_the_same_bits() {
        for value in [0.1 + 0.2, -0.0, 1e-320, 1.7976931348623157e308, 4.0, f64::INFINITY] {
            let text = put(Form::Real, value);
            assert_eq!(text.parse::<f64>().map(f64::to_bits), Ok(value.to_bits()), "{text}");
        }
        assert_eq!(put(Form::Real, f64::NAN), "NaN");
    }

    #[test]
    fn columns_are_read_back() {
        let column = |name: &str, form, source| Column { name: name.into(), form, source };
        let mut columns = vec![
            column("a[0]", Form::Truth, Source::Input { machine: 1, word: 2 }),
            column("b", Form::Whole { lo: -1, hi: 9 }, Source::Output { machine: 0, word: 0 }),
            column("r.state", Form::WHOLE, Source::Trace(7)),
            column("x", Form::Real, Source::Trace(8)),
        ];
        columns.extend(SINGLE.map(|(name, source)| column(name, Form::Truth, source)));
        let columns = Columns(columns);
        assert_eq!(Columns::from_text(&columns.to_text()), Ok(columns));
    }

    #[test]
    fn wrong_columns_are_errors() {
        for text in [
            "",
            "columns 2",
            "columns 1\n1\na bool",
            "columns 1\n1\na bool input 0",
            "columns 1\n1\na int 5 1 trace 0",
            "columns 1\n1\na word trace 0",
            "columns 1\n1\na bool trace 0 b",
            "columns 1\n1\na bool somewhere",
        ] {
            assert!(Columns::from_text(text).is_err(), "{text}");
        }
    }
}
