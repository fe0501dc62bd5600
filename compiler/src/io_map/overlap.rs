//! No two points share a bit of the process image.

use super::Point;
use super::address::{Address, Area};
use crate::diagnostic::Diagnostic;
use crate::source::Span;

/// How the controller counts addresses of different sizes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Counting {
    /// `%IW1` is the bytes 2 and 3, as in CODESYS.
    #[default]
    Words,
    /// `%IW1` is the bytes 1 and 2, as in TwinCAT.
    Bytes,
    /// Bits, bytes, words and double words are memories of their own, as in OpenPLC.
    Apart,
}

/// An address and the field that gives it.
pub struct Place {
    pub point: usize,
    pub address: Address,
    pub span: Span,
}

/// A stretch of an area, in bits, end excluded.
#[derive(PartialEq)]
struct Stretch {
    area: Area,
    /// Of [`Counting::Apart`] the memory, else 0.
    memory: u32,
    start: u64,
    end: u64,
}

fn stretch(address: Address, counting: Counting) -> Stretch {
    let bits = u64::from(address.size.bits());
    let number = u64::from(address.number);
    let start = match counting {
        Counting::Bytes => 8 * number,
        Counting::Words | Counting::Apart => bits.max(8) * number,
    } + u64::from(address.bit);
    let memory = if counting == Counting::Apart { address.size.bits() } else { 0 };
    Stretch { area: address.area, memory, start, end: start + bits }
}

impl Stretch {
    fn overlaps(&self, other: &Self) -> bool {
        self.area == other.area
            && self.memory == other.memory
            && self.start < other.end
            && other.start < self.end
    }
}

/// The places in the order of their rows.
pub fn check(places: &[Place], points: &[Point], counting: Counting, found: &mut Vec<Diagnostic>) {
    for (i, place) in places.iter().enumerate() {
        let own = stretch(place.address, counting);
        let before = places[..i].iter().find(|other| stretch(other.address, counting).overlaps(&own));
        let Some(other) = before else { continue };
        let (name, other_name) = (&points[place.point].name, &points[other.point].name);
        let message = match other.address == place.address {
            true => format!("{} is given to {name} and to {other_name}", place.address),
            false => format!("{} of {name} overlaps {} of {other_name}", place.address, other.address),
        };
        let mut diagnostic = Diagnostic::new("E0606", place.span, message)
            .other(other.span, "the other one")
            .help("give each point an address of its own");
        if other.address.size != place.address.size && counting != Counting::Apart {
            diagnostic = diagnostic.note(
                "if bits, bytes and words are separate memories, as in OpenPLC, give `--addresses apart`",
            );
        }
        found.push(diagnostic);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_overlap_as_the_controller_counts() {
        let pairs = [
            ("%IX0.3", "%IB0", [true, true, false]),
            ("%IX0.3", "%IX0.4", [false; 3]),
            ("%IX0.3", "%QX0.3", [false; 3]),
            ("%IX1.7", "%IW0", [true, true, false]),
            ("%IW0", "%IW1", [false, true, false]),
            ("%IW1", "%IB1", [false, true, false]),
            ("%IW1", "%IB2", [true, true, false]),
            ("%ID1", "%IW2", [true, true, false]),
            ("%ID1", "%IW1", [false, true, false]),
            ("%ID4294967295", "%ID4294967295", [true; 3]),
        ];
        for (a, b, wanted) in pairs {
            let [x, y] = [a, b].map(|text| Address::parse(text).expect("an address"));
            let found = [Counting::Words, Counting::Bytes, Counting::Apart]
                .map(|counting| stretch(x, counting).overlaps(&stretch(y, counting)));
            assert_eq!(found, wanted, "{a} {b}");
        }
    }
}
