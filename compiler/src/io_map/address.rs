//! Addresses of IEC 61131-3: `%IX0.3`, `%QW4`.

use std::fmt;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Address {
    pub area: Area,
    pub size: Size,
    /// In units of the size; of a bit its byte.
    pub number: u32,
    /// Of a bit, below 8; else 0.
    pub bit: u8,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Area {
    Input,
    Output,
    Memory,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Size {
    Bit,
    Byte,
    Word,
    Double,
}

impl Size {
    pub fn bits(self) -> u32 {
        match self {
            Size::Bit => 1,
            Size::Byte => 8,
            Size::Word => 16,
            Size::Double => 32,
        }
    }

    pub fn letter(self) -> char {
        match self {
            Size::Bit => 'X',
            Size::Byte => 'B',
            Size::Word => 'W',
            Size::Double => 'D',
        }
    }
}

impl Area {
    pub fn letter(self) -> char {
        match self {
            Area::Input => 'I',
            Area::Output => 'Q',
            Area::Memory => 'M',
        }
    }
}

impl Address {
    /// Capital or small letters; an error says what is wrong.
    pub fn parse(text: &str) -> Result<Self, String> {
        let rest = text.strip_prefix('%').ok_or("it does not begin with `%`")?;
        let mut letters = rest.chars();
        let area = match letters.next().map(|c| c.to_ascii_uppercase()) {
            Some('I') => Area::Input,
            Some('Q') => Area::Output,
            Some('M') => Area::Memory,
            _ => return Err("`%` is not followed by I, Q or M".into()),
        };
        let size = match letters.next().map(|c| c.to_ascii_uppercase()) {
            Some('X') => Size::Bit,
            Some('B') => Size::Byte,
            Some('W') => Size::Word,
            Some('D') => Size::Double,
            Some('L') => return Err("no raw type has 64 bits".into()),
            _ => return Err("the area is not followed by a size: X, B, W or D".into()),
        };
        let numbers = letters.as_str();
        let (number, bit) = match (size, numbers.split_once('.')) {
            (Size::Bit, Some((byte, bit))) => (byte, Some(bit)),
            (Size::Bit, None) => return Err("a bit has the number of its byte and its own: %IX0.3".into()),
            (_, Some(_)) => return Err("only a bit has two numbers".into()),
            (_, None) => (numbers, None),
        };
        let whole = |text: &str| match text.bytes().all(|b| b.is_ascii_digit()) && !text.is_empty() {
            true => text.parse::<u32>().map_err(|_| format!("`{text}` is too large")),
            false => Err(format!("`{text}` is not a number")),
        };
        let bit = match bit.map(whole).transpose()? {
            Some(bit @ 8..) => return Err(format!("a byte has the bits 0 to 7, not {bit}")),
            bit => bit.unwrap_or(0) as u8,
        };
        Ok(Self { area, size, number: whole(number)?, bit })
    }
}

impl fmt::Display for Address {
    fn fmt(&self, f: &mut fmt::Formatter) -> fmt::Result {
        write!(f, "%{}{}{}", self.area.letter(), self.size.letter(), self.number)?;
        match self.size {
            Size::Bit => write!(f, ".{}", self.bit),
            _ => Ok(()),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Address;

    #[test]
    fn addresses_are_read_and_written() {
        for (text, written) in
            [("%IX0.3", "%IX0.3"), ("%qw12", "%QW12"), ("%MB07", "%MB7"), ("%id4294967295", "%ID4294967295")]
        {
            assert_eq!(Address::parse(text).map(|a| a.to_string()), Ok(written.into()));
        }
        for text in [
            "",
            "%",
            "IX0.0",
            "%I0.0",
            "%IX0",
            "%IX0.8",
            "%IX0.0.0",
            "%IX.1",
            "%IX1.",
            "%IW1.2",
            "%IW",
            "%IW-1",
            "%IW+1",
            "%ZW0",
            "%QL0",
            "%IW99999999999",
            "%IWé",
            "% IW1",
        ] {
            assert!(Address::parse(text).is_err(), "{text}");
        }
    }
}
