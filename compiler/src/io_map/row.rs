//! One row: which point it is about, and what it says about it.

use super::address::{Address, Area};
use super::columns::{Columns, Record};
use super::overlap::Place;
use super::{Conversion, Kind, Point, Raw, Wire, raw};
use crate::csv::Field;
use crate::diagnostic::{Diagnostic, suggestion};
use crate::source::Span;
use runtime_sim::device::Direction;
use std::collections::{BTreeMap, BTreeSet, HashMap};

/// The rows of a table, read one after the other.
pub struct Rows<'p> {
    points: &'p [Point],
    separator: u8,
    /// By robot and name, in lower case.
    known: HashMap<(String, String), usize>,
    seen: HashMap<usize, Span>,
    /// Robots that the line does not have, by their names in lower case.
    strangers: BTreeMap<String, Stranger>,
    /// Each robot of the line once.
    robots: BTreeSet<&'p str>,
    /// Every address that could be read, of rows with other errors too.
    pub places: Vec<Place>,
}

/// A robot of the table that the line does not have.
struct Stranger {
    name: String,
    first: Span,
    rows: usize,
}

/// The numbers of a conversion, finite both.
struct Numbers {
    scale: f64,
    offset: f64,
}

impl<'p> Rows<'p> {
    pub fn new(points: &'p [Point], separator: u8) -> Self {
        let key = |p: &Point| (p.robot.to_ascii_lowercase(), p.name.to_ascii_lowercase());
        let known = points.iter().enumerate().map(|(i, p)| (key(p), i)).collect();
        Self {
            points,
            separator,
            known,
            seen: HashMap::new(),
            strangers: BTreeMap::new(),
            robots: points.iter().map(|p| p.robot.as_str()).collect(),
            places: Vec::new(),
        }
    }

    /// The point and its wire, if the row gives it an address and all is right.
    pub fn read(
        &mut self,
        columns: &Columns,
        fields: &[Field],
        found: &mut Vec<Diagnostic>,
    ) -> Option<(usize, Wire)> {
        let record = columns.row(fields, found)?;
        let whole = fields.first()?.span.to(fields.last()?.span);
        let number = self.point(&record, whole, found)?;
        let point = &self.points[number];
        let name = record.place("name").unwrap_or(whole);
        if let Some(first) = self.seen.insert(number, name) {
            found.push(
                Diagnostic::new("E0604", name, format!("{} has two rows", point.name))
                    .other(first, "the first one")
                    .help("keep one of them"),
            );
            return None;
        }
        let count = found.len();
        stale(&record, point, found);
        let Some(address_field) = record.get("address") else {
            without_address(&record, point, found);
            return None;
        };
        let address = self.address(address_field, point, found);
        let span = address_field.span;
        self.places.extend(address.map(|address| Place { point: number, address, span }));
        let raw = self.raw(&record, point, address, address_field, found);
        let conversion = self.conversion(&record, point, found);
        let (address, raw, conversion) = (address?, raw?, conversion?);
        if found.len() > count {
            return None;
        }
        let wire = Wire { address, raw, conversion };
        holds(&wire, point, &record, address_field, found);
        (found.len() == count).then_some((number, wire))
    }

    fn point(&mut self, record: &Record, whole: Span, found: &mut Vec<Diagnostic>) -> Option<usize> {
        let (robot, name) = (record.text("robot"), record.text("name"));
        let key = (robot.to_ascii_lowercase(), name.to_ascii_lowercase());
        if let Some(number) = self.known.get(&key) {
            return Some(*number);
        }
        let is_robot = |p: &&Point| p.robot.eq_ignore_ascii_case(robot);
        let place = |column: &str| record.place(column).unwrap_or(whole);
        if !self.robots.iter().any(|own| own.eq_ignore_ascii_case(robot)) {
            let stranger = || Stranger { name: robot.into(), first: place("robot"), rows: 0 };
            self.strangers.entry(key.0).or_insert_with(stranger).rows += 1;
            return None;
        }
        let own = self.points.iter().filter(is_robot).map(|p| p.name.as_str());
        let elsewhere = self.points.iter().find(|p| p.name.eq_ignore_ascii_case(name));
        let owner = if robot.is_empty() { "the line".to_string() } else { format!("`{robot}`") };
        let help = match (suggestion(name, own), elsewhere) {
            (_, Some(point)) if point.robot.is_empty() => "leave the column `robot` empty".into(),
            (_, Some(point)) => format!("it is one of `{}`", point.robot),
            (Some(near), None) => format!("did you mean `{near}`?"),
            (None, None) => "plc/io.csv, as `build` writes it without `--io`, has all points".into(),
        };
        let message = match name {
            "" => "the row names no point".into(),
            _ => format!("{owner} has no point `{name}`"),
        };
        found.push(Diagnostic::new("E0603", place("name"), message).help(help));
        None
    }

    /// The robots that the line does not have, each once however many rows it has.
    pub fn strangers(&self, found: &mut Vec<Diagnostic>) {
        for Stranger { name, first, rows } in self.strangers.values() {
            let robots = self.robots.iter().copied().filter(|robot| !robot.is_empty());
            let whose = if *rows == 1 { "its row".into() } else { format!("its {rows} rows") };
            let help = match suggestion(name, robots) {
                Some(near) => {
                    format!("did you mean `{near}`? If the layout has lost `{name}`, remove {whose}")
                }
                None => format!("the layout names the robots; if it has lost `{name}`, remove {whose}"),
            };
            found.push(Diagnostic::new("E0603", *first, format!("there is no robot `{name}`")).help(help));
        }
    }

    fn address(&self, field: &Field, point: &Point, found: &mut Vec<Diagnostic>) -> Option<Address> {
        let address = match Address::parse(&field.text) {
            Ok(address) => address,
            Err(wrong) => {
                found.push(
                    Diagnostic::new("E0605", field.span, format!("`{}` is not an address: {wrong}", field.text))
                        .help("write %IX0.3 for a bit, %IB4, %IW4 or %ID4 for 8, 16 or 32 bits; I for inputs, Q for outputs, M for memory"),
                );
                return None;
            }
        };
        let (word, wanted) = match point.direction {
            Direction::Input => ("input", Area::Input),
            Direction::Output => ("output", Area::Output),
        };
        if address.area != wanted && address.area != Area::Memory {
            let corrected = Address { area: wanted, ..address };
            found.push(
                Diagnostic::new(
                    "E0607",
                    field.span,
                    format!("{} is an {word}: {address} does not fit it", point.name),
                )
                .help(format!("give it an address such as {corrected}")),
            );
            return None;
        }
        Some(address)
    }

    fn raw(
        &self,
        record: &Record,
        point: &Point,
        address: Option<Address>,
        address_field: &Field,
        found: &mut Vec<Diagnostic>,
    ) -> Option<Raw> {
        let field = record.get("raw type");
        let goes = |raw: &Raw| (*raw == Raw::Bool) == (point.kind == Kind::Bool);
        let fits = |raw: &Raw| goes(raw) && address.is_none_or(|a| a.size == raw.size());
        let listed = |raws: Vec<Raw>| raws.iter().map(|r| r.name()).collect::<Vec<_>>().join(" or ");
        let choice = listed(raw::ALL.into_iter().filter(fits).collect());
        let help = match (choice.is_empty(), point.kind) {
            (false, _) => format!("write {choice}"),
            (true, Kind::Bool) => "a boolean is BOOL at the address of a bit, such as %IX0.3".into(),
            (true, _) => {
                "a number is SINT or USINT at a byte, INT or UINT at a word, DINT at a double word".into()
            }
        };
        let mut wrong = |place: Span, message: String| {
            found.push(Diagnostic::new("E0608", place, message).help(help.clone()));
            None
        };
        let Some(field) = field else {
            // A bit can be nothing else. What is wrong with an address has been said: it decides what goes here.
            return match (point.kind, address?.size) {
                (Kind::Bool, super::Size::Bit) => Some(Raw::Bool),
                _ => wrong(address_field.span, format!("{} has an address and no raw type", point.name)),
            };
        };
        let Some(raw) = Raw::named(&field.text) else {
            return wrong(field.span, format!("`{}` is not a raw type", field.text));
        };
        if !goes(&raw) {
            return wrong(
                field.span,
                format!("{} is {}: {} does not fit it", point.name, point.kind.name(), raw.name()),
            );
        }
        match address {
            Some(address) if address.size != raw.size() => wrong(
                field.span,
                format!(
                    "the raw type {} needs an address with {}, {address} has {}",
                    raw.name(),
                    raw.size().letter(),
                    address.size.letter()
                ),
            ),
            _ => Some(raw),
        }
    }

    fn conversion(&self, record: &Record, point: &Point, found: &mut Vec<Diagnostic>) -> Option<Conversion> {
        let refused = |column: &str, why: &str| {
            record.get(column).map(|field| {
                Diagnostic::new(
                    "E0609",
                    field.span,
                    format!("{} is {}: {why}", point.name, point.kind.name()),
                )
                .help(format!("leave the column `{column}` empty"))
            })
        };
        let count = found.len();
        let inverted = record.get("inversion").filter(|field| self.truth(field, found) == Some(true));
        if point.kind == Kind::Bool {
            let why = "a boolean has no scale and no offset";
            found.extend(refused("scale", why).into_iter().chain(refused("offset", why)));
            let is_permit = point.robot.is_empty() && point.name == PERMIT;
            found.extend(inverted.filter(|_| is_permit).map(never_inverted));
            let conversion = if inverted.is_some() { Conversion::Inverted } else { Conversion::None };
            return (found.len() == count).then_some(conversion);
        }
        if inverted.is_some() {
            found.extend(refused("inversion", "only a boolean is inverted"));
        }
        let scale = record.get("scale").map_or(Some(1.0), |field| self.number(field, found));
        let offset = record.get("offset").map_or(Some(0.0), |field| self.number(field, found));
        let numbers = Numbers { scale: scale?, offset: offset? };
        if found.len() > count {
            return None;
        }
        match point.kind {
            Kind::Int { .. } => whole(&numbers, record, point, found),
            _ => scaled(&numbers, record, point, found),
        }
    }

    fn truth(&self, field: &Field, found: &mut Vec<Diagnostic>) -> Option<bool> {
        match field.text.to_ascii_lowercase().as_str() {
            "true" | "yes" | "1" => Some(true),
            "false" | "no" | "0" => Some(false),
            _ => {
                found.push(
                    Diagnostic::new("E0610", field.span, format!("`{}` does not say whether", field.text))
                        .help("write TRUE or FALSE; an empty field is FALSE"),
                );
                None
            }
        }
    }

    /// Where commas do not separate fields, a decimal comma is allowed.
    fn number(&self, field: &Field, found: &mut Vec<Diagnostic>) -> Option<f64> {
        let text = match self.separator {
            b',' => field.text.clone(),
            _ => field.text.replacen(',', ".", 1),
        };
        let is_plain = text.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
        match text.parse::<f64>() {
            Ok(number) if is_plain && number.is_finite() => Some(number),
            Ok(_) if is_plain => {
                found.push(
                    Diagnostic::new("E0610", field.span, format!("{} is too large", field.text))
                        .help("write a number that fits into 64 bits"),
                );
                None
            }
            _ => {
                found.push(
                    Diagnostic::new("E0610", field.span, format!("`{}` is no number", field.text))
                        .help("write it like 0.001, -5 or 2.5E-3"),
                );
                None
            }
        }
    }
}

/// The input of the line that a broken wire has to make false.
const PERMIT: &str = "run_permit";

fn never_inverted(field: &Field) -> Diagnostic {
    Diagnostic::new("E0609", field.span, format!("{PERMIT} may not be inverted"))
        .note("a broken wire or a lost fieldbus reads 0, which would then permit the line to run")
        .help("leave the column `inversion` empty, and wire the contact so that it is closed while the line may run")
}

/// Direction and type of a table that was made for another line.
fn stale(record: &Record, point: &Point, found: &mut Vec<Diagnostic>) {
    let direction = if point.direction == Direction::Input { "input" } else { "output" };
    for (column, own) in [("direction", direction), ("type", point.kind.name())] {
        if let Some(field) = record.get(column).filter(|f| !f.text.eq_ignore_ascii_case(own)) {
            found.push(
                Diagnostic::new("E0612", field.span, format!("{} is {own}, not {}", point.name, field.text))
                    .help("the table was made for another line, or the field was changed; compare the row with a new plc/io.csv"),
            );
        }
    }
}

fn without_address(record: &Record, point: &Point, found: &mut Vec<Diagnostic>) {
    let filled =
        ["raw type", "scale", "offset", "inversion"].into_iter().find_map(|column| record.get(column));
    if let Some(field) = filled {
        found.push(
            Diagnostic::new("E0613", field.span, format!("{} has a conversion and no address", point.name))
                .help("fill in the column `address`, or empty the columns after it"),
        );
    }
}

/// Integers count and name; a factor would lose some of them.
fn whole(
    numbers: &Numbers,
    record: &Record,
    point: &Point,
    found: &mut Vec<Diagnostic>,
) -> Option<Conversion> {
    let count = found.len();
    if let Some(field) = record.get("scale").filter(|_| numbers.scale != 1.0) {
        found.push(
            Diagnostic::new("E0609", field.span, format!("{} is DINT: an integer is not scaled", point.name))
                .help("leave the column `scale` empty; scale reals only"),
        );
    }
    let offset = numbers.offset as i32;
    if let Some(field) = record.get("offset").filter(|_| f64::from(offset) != numbers.offset) {
        found.push(
            Diagnostic::new(
                "E0609",
                field.span,
                format!("{} is DINT: its offset is a whole number of 32 bits", point.name),
            )
            .help("write a whole number"),
        );
    }
    (found.len() == count).then_some(if offset == 0 { Conversion::None } else { Conversion::Shifted(offset) })
}

fn scaled(
    numbers: &Numbers,
    record: &Record,
    point: &Point,
    found: &mut Vec<Diagnostic>,
) -> Option<Conversion> {
    let Numbers { scale, offset } = *numbers;
    if scale == 0.0 {
        let place = record.place("scale")?;
        found.push(
            Diagnostic::new(
                "E0610",
                place,
                format!("the scale of {} is 0: all raw values would be the same", point.name),
            )
            .help("write the value of one raw step, or leave it empty for 1"),
        );
        return None;
    }
    Some(Conversion::Scaled { scale, offset })
}

/// Whether the raw type holds all values of the point, or gives finite ones.
fn holds(wire: &Wire, point: &Point, record: &Record, address: &Field, found: &mut Vec<Diagnostic>) {
    let (low, high) = wire.raw.bounds();
    let place = record.place("raw type").unwrap_or(address.span);
    match (point.kind, wire.conversion) {
        (Kind::Int { lo, hi }, conversion) => {
            let offset = if let Conversion::Shifted(offset) = conversion { i64::from(offset) } else { 0 };
            let (least, greatest) = (i64::from(low) + offset, i64::from(high) + offset);
            if least > i64::from(lo) || greatest < i64::from(hi) {
                let message = format!(
                    "{} holds {least} to {greatest} here, {} needs {lo} to {hi}",
                    wire.raw.name(),
                    point.name
                );
                found.push(
                    Diagnostic::new("E0611", place, message)
                        .help("use a raw type that has all these values, or another offset"),
                );
            }
        }
        (Kind::Real, Conversion::Scaled { scale, offset }) => {
            let ends = [low, high].map(|end| f64::from(end) * scale + offset);
            let step = 1.0 / scale;
            if ends.iter().any(|end| !end.is_finite()) || !step.is_finite() {
                let message = format!(
                    "{} cannot be computed from {}: the numbers do not fit into 64 bits",
                    point.name,
                    wire.raw.name()
                );
                let place = record.place("scale").unwrap_or(place);
                found.push(
                    Diagnostic::new("E0611", place, message)
                        .help("write a scale and an offset of usual size"),
                );
            }
        }
        _ => {}
    }
}
