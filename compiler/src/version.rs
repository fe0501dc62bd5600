//! Which autogen this is.

/// The number of the crate.
pub const NUMBER: &str = env!("CARGO_PKG_VERSION");

/// The same as one number: 10203 is 1.2.3.
pub fn number() -> i32 {
    NUMBER.split('.').fold(0, |number, part| number * 100 + part.parse::<i32>().unwrap_or(0))
}

/// The day from which autogen has its number, for files that must bear a date: the day of a build would make other
/// bytes of the same input.
pub const DAY: &str = "2026-11-23";

#[cfg(test)]
mod tests {
    /// A new number has a new day.
    #[test]
    fn the_day_is_that_of_the_number() {
        assert_eq!((super::NUMBER, super::DAY), ("0.1.0", "2026-11-23"));
    }
}
