//! Literals of the portable core: plain decimal numbers.

/// The value of a whole number, or what is wrong with it.
pub fn int(text: &str) -> Result<i32, &'static str> {
    let digits = text.strip_prefix('-').unwrap_or(text);
    if !digits.bytes().all(|b| b.is_ascii_digit()) {
        return Err("a whole number is written with decimal digits only");
    }
    text.parse().map_err(|_| "the number does not fit into a DINT")
}

/// The greatest literal that every compiler takes.
const GREATEST: f64 = 1.0e38;

/// The value of a real number, or what is wrong with it.
pub fn real(text: &str) -> Result<f64, &'static str> {
    if !text.contains('.') {
        return Err("a real number is written with a point");
    }
    if text.contains('_') || text.starts_with('+') {
        return Err("a real number is written with digits, point and exponent only");
    }
    match text.parse::<f64>() {
        Ok(value) if value.abs() <= GREATEST => Ok(value),
        _ => Err("the number is greater than 1.0E38"),
    }
}

/// The milliseconds of a time with a single unit, or what is wrong with it.
pub fn time(text: &str) -> Result<u32, &'static str> {
    const WRONG: &str = "a time is written as T#, digits and the unit ms or s";
    let rest = text.strip_prefix("T#").ok_or(WRONG)?;
    let (number, factor) = match rest.strip_suffix("ms") {
        Some(number) => (number, 1),
        None => (rest.strip_suffix('s').ok_or(WRONG)?, 1000),
    };
    if number.is_empty() || !number.bytes().all(|b| b.is_ascii_digit()) {
        return Err(WRONG);
    }
    number.parse::<u32>().ok().and_then(|n| n.checked_mul(factor)).ok_or(WRONG)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn whole_numbers_fit_into_a_dint() {
        assert_eq!(int("-2147483648"), Ok(i32::MIN));
        assert_eq!(int("2147483647"), Ok(i32::MAX));
        for wrong in ["2147483648", "16#FF", "1_000", "+1"] {
            assert!(int(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn real_numbers_have_a_point() {
        assert_eq!(real("-2.5E-3"), Ok(-0.0025));
        for wrong in ["1E3", "1.0E39", "1_0.0"] {
            assert!(real(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn times_have_one_unit() {
        assert_eq!(time("T#10ms"), Ok(10));
        assert_eq!(time("T#2s"), Ok(2000));
        for wrong in ["T#1s500ms", "t#1s", "T#1.5s", "T#ms"] {
            assert!(time(wrong).is_err(), "{wrong}");
        }
    }
}
