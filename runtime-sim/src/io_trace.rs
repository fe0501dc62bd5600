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
            Self::WHOLE => "whole".into(),
            Self::Whole { lo, hi } => format!("int {lo} {hi}"),
            Self::Real => "real".into(),
        }
    }

    fn read(words: &mut Words) -> Result<Self, String> {
        match words.name()? {
            "bool" => Ok(Self::Truth),
            "whole" => Ok(Self::WHOLE),
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

    /// The text that [`Columns::from_text`] reads back: a line for each column, and one for the elements of an array whose
    /// words stand one behind the other.
    pub fn to_text(&self) -> String {
        let mut lines = String::new();
        let mut count = 0;
        let mut rest = self.0.as_slice();
        while let [first, ..] = rest {
            let follows = |(i, next): &(usize, &Column)| first.element(*i).as_ref() == Some(*next);
            let row = rest.iter().enumerate().take(MOST_ELEMENTS).skip(1).take_while(follows).count() + 1;
            let Column { name, form, source } = first;
            let _ = writeln!(lines, "{name} {row} {} {}", form.text(), source.text());
            rest = &rest[row..];
            count += 1;
        }
        format!("columns 2\n{count}\n{lines}")
    }

    pub fn from_text(text: &str) -> Result<Self, String> {
        let mut words = Words::new(text);
        words.expect("columns")?;
        words.expect("2")?;
        let rows = words.list(|words| {
            let name = words.name()?.to_string();
            let elements: usize = words.int()?;
            if !(1..=MOST_ELEMENTS).contains(&elements) {
                return Err(words.error(format_args!("there are not {elements} elements in a line")));
            }
            let first = Column { name, form: Form::read(words)?, source: Source::read(words)? };
            let others: Option<Vec<Column>> = (1..elements).map(|i| first.element(i)).collect();
            let others = others.ok_or_else(|| words.error("elements of no array"))?;
            Ok([vec![first], others].concat())
        })?;
        if words.is_empty() {
            Ok(Self(rows.concat()))
        } else {
            Err(words.error("more columns than were announced"))
        }
    }
}

/// Elements of an array in a line of the text.
const MOST_ELEMENTS: usize = 10_000;

impl Column {
    /// The column of an element so far behind the one that this is of.
    fn element(&self, behind: usize) -> Option<Self> {
        let (array, index) = self.name.strip_suffix(']')?.rsplit_once('[')?;
        let index = index.parse::<usize>().ok()?.checked_add(behind)?;
        let source = match self.source {
            Source::Input { machine, word } => Source::Input { machine, word: word.checked_add(behind)? },
            Source::Output { machine, word } => Source::Output { machine, word: word.checked_add(behind)? },
            Source::Trace(word) => Source::Trace(word.checked_add(behind)?),
            _ => return None,
        };
        Some(Self { name: format!("{array}[{index}]"), source, ..self.clone() })
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
    fn elements_of_an_array_are_one_line() {
        let column = |name: String, word| Column { name, form: Form::WHOLE, source: Source::Trace(word) };
        let mut columns: Vec<Column> = (0..12).map(|i| column(format!("slot[{}]", i + 12), 30 + i)).collect();
        assert_eq!(Columns(columns.clone()).to_text(), "columns 2\n1\nslot[12] 12 whole trace 30\n");
        // The words of the next row stand elsewhere, and so do those of another array.
        columns.push(column("slot[24]".into(), 80));
        columns.push(column("holds[25]".into(), 81));
        columns.push(column("holds[27]".into(), 82));
        let columns = Columns(columns);
        let text = columns.to_text();
        assert_eq!(text.lines().count(), 2 + 4, "{text}");
        assert_eq!(Columns::from_text(&text), Ok(columns));
    }

    #[test]
    fn wrong_columns_are_errors() {
        for text in [
            "",
            "columns 1",
            "columns 2\n1\na 1 bool",
            "columns 2\n1\na 1 bool input 0",
            "columns 2\n1\na 1 int 5 1 trace 0",
            "columns 2\n1\na 1 word trace 0",
            "columns 2\n1\na 1 bool trace 0 b",
            "columns 2\n1\na 1 bool somewhere",
            "columns 2\n1\na[0] 0 bool trace 0",
            "columns 2\n1\na 2 bool trace 0",
            "columns 2\n1\na[0] 2 bool running",
            "columns 2\n1\na[0] 99999999999 bool trace 0",
            "columns 2\n1\na[18446744073709551615] 2 bool trace 0",
        ] {
            assert!(Columns::from_text(text).is_err(), "{text}");
        }
    }
}
