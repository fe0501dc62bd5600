//! Which autogen this is.

/// The number of the crate.
pub const NUMBER: &str = env!("CARGO_PKG_VERSION");

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
