//! Variables in the process image.

use super::Checker;
use crate::types::{Scalar, Type};
use crate::view::Variable;
use std::collections::HashSet;

impl Checker<'_> {
    /// The size of the address is that of the type, and nothing else has a narrow type.
    pub(super) fn located(&mut self, variable: &Variable, ty: &Type) {
        let Some(address) = &variable.address else {
            if let Type::Scalar(Scalar::Narrow(_)) = ty {
                self.report("narrow", variable.ty.span, format!("{ty} without an address"));
            }
            return;
        };
        let bits = match ty {
            Type::Scalar(Scalar::Bool) => 1,
            Type::Scalar(Scalar::Narrow(narrow)) => narrow.bits(),
            Type::Scalar(Scalar::Dint) => 32,
            other => {
                self.report("address", address.span, format!("{other} at an address"));
                return;
            }
        };
        match address_bits(&address.text) {
            None => self.report("address", address.span, format!("`{}` is no address", address.text)),
            Some(found) if found != bits => {
                self.report(
                    "address",
                    address.span,
                    format!("{ty} has {bits} bits, {} {found}", address.text),
                );
            }
            Some(_) => {}
        }
    }

    pub(super) fn addresses(&mut self, globals: &[Variable]) {
        let mut seen = HashSet::new();
        for address in globals.iter().filter_map(|v| v.address.as_ref()) {
            if !seen.insert(address.key()) {
                self.report("address", address.span, format!("{} is given twice", address.text));
            }
        }
    }
}

/// The bits at an address such as `%IX0.3` or `%QW4`; None if it is none that all compilers take.
fn address_bits(text: &str) -> Option<u32> {
    let rest = text.strip_prefix(['%'])?.strip_prefix(['I', 'Q', 'M'])?;
    let is_number = |text: &str| !text.is_empty() && text.bytes().all(|b| b.is_ascii_digit());
    let (bits, numbers) = match rest.split_at_checked(1)? {
        ("X", numbers) => {
            let (byte, bit) = numbers.split_once('.')?;
            return (is_number(byte) && matches!(bit.as_bytes(), [b'0'..=b'7'])).then_some(1);
        }
        ("B", numbers) => (8, numbers),
        ("W", numbers) => (16, numbers),
        ("D", numbers) => (32, numbers),
        _ => return None,
    };
    is_number(numbers).then_some(bits)
}

#[cfg(test)]
mod tests {
    use super::address_bits;

    #[test]
    fn addresses_have_a_size() {
        let wanted = [("%IX0.7", 1), ("%QB3", 8), ("%MW12", 16), ("%QD0", 32)];
        for (text, bits) in wanted {
            assert_eq!(address_bits(text), Some(bits), "{text}");
        }
        for text in ["%IX0", "%IX0.8", "%I0.0", "%IW", "%IW1.1", "%IL0", "IW0", "%iw0"] {
            assert_eq!(address_bits(text), None, "{text}");
        }
    }
}
