//! Statements that copy between the process image of the controller and the data block, for a person to insert: a source
//! of SCL contains no organization block.

use super::SHARED;
use super::quotes::quoted;
use crate::backend::st::image::Wired;
use crate::io_map::{Address, Counting, Raw, Size};
use runtime_sim::device::Direction;
use std::fmt::Write;

/// What the description says of the table of addresses; nothing without one.
pub fn copies(wired: &[Wired], counting: Counting) -> String {
    if wired.is_empty() {
        return String::new();
    }
    if counting == Counting::Apart {
        return "\n   The addresses of the table are not valid for this controller: build with --addresses bytes.\n".into();
    }
    let of = |direction: Direction| -> Vec<String> {
        let all = wired.iter().filter(|wired| wired.direction == direction);
        all.map(|wired| statement(wired, counting)).collect()
    };
    let mut text = String::new();
    for (direction, place) in [(Direction::Input, "before that call"), (Direction::Output, "after it")] {
        let statements = of(direction);
        if !statements.is_empty() {
            let _ = writeln!(text, "\n   By the table of addresses, {place}:\n");
            statements.iter().for_each(|statement| {
                let _ = writeln!(text, "       {statement}");
            });
        }
    }
    text
}

fn statement(Wired { variable, direction, wire }: &Wired, counting: Counting) -> String {
    let (address, variable) = (address(wire.address, counting), format!("\"{SHARED}\".{}", quoted(variable)));
    let bits = match wire.raw {
        Raw::Bool => None,
        Raw::Sint | Raw::Usint => Some("BYTE"),
        Raw::Int | Raw::Uint => Some("WORD"),
        Raw::Dint => Some("DWORD"),
    };
    match (direction, bits) {
        (Direction::Input, None) => format!("{variable} := {address};"),
        (Direction::Input, Some(bits)) => format!("{variable} := {bits}_TO_{}({address});", wire.raw.name()),
        (Direction::Output, None) => format!("{address} := {variable};"),
        (Direction::Output, Some(bits)) => format!("{address} := {}_TO_{bits}({variable});", wire.raw.name()),
    }
}

/// As this controller counts, by bytes: `%I0.3`, `%IW4`.
fn address(Address { area, size, number, bit }: Address, counting: Counting) -> String {
    let area = area.letter();
    let bytes = match counting {
        Counting::Words => size.bits() / 8,
        Counting::Bytes | Counting::Apart => 1,
    };
    match size {
        Size::Bit => format!("%{area}{number}.{bit}"),
        Size::Byte | Size::Word | Size::Double => {
            format!("%{area}{}{}", size.letter(), u64::from(number) * u64::from(bytes))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::io_map::{Conversion, Wire};

    fn said(direction: Direction, text: &str, raw: Raw, counting: Counting) -> String {
        let address = Address::parse(text).expect("an address");
        let wire = Wire { address, raw, conversion: Conversion::None };
        let wired = Wired { variable: "v".into(), direction, wire };
        copies(&[wired], counting).lines().last().unwrap_or_default().trim().to_string()
    }

    #[test]
    fn points_are_copied_as_the_controller_counts() {
        let (input, output) = (Direction::Input, Direction::Output);
        for (direction, address, raw, counting, statement) in [
            (input, "%IX3.7", Raw::Bool, Counting::Words, "\"Line\".v := %I3.7;"),
            (input, "%IW1", Raw::Int, Counting::Words, "\"Line\".v := WORD_TO_INT(%IW2);"),
            (input, "%IW1", Raw::Uint, Counting::Bytes, "\"Line\".v := WORD_TO_UINT(%IW1);"),
            (output, "%QB5", Raw::Usint, Counting::Words, "%QB5 := USINT_TO_BYTE(\"Line\".v);"),
            (output, "%QD3", Raw::Dint, Counting::Words, "%QD12 := DINT_TO_DWORD(\"Line\".v);"),
        ] {
            assert_eq!(said(direction, address, raw, counting), statement);
        }
        assert!(said(input, "%IX0.0", Raw::Bool, Counting::Apart).contains("--addresses bytes"));
    }
}
