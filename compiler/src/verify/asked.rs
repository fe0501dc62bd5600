//! What a search is asked for.

use crate::source::Sources;
use autogen_search::plant::Faults;

#[derive(Clone, Copy, Debug)]
pub struct Asked<'a> {
    pub faults: Faults,
    pub warnings: Warnings<'a>,
    pub remembered: Remembered,
}

impl Asked<'static> {
    /// Without warnings.
    pub fn with(faults: Faults) -> Self {
        Self { faults, warnings: Warnings::None, remembered: Remembered::Least }
    }
}

/// Which properties are searched whose violation stops nothing.
#[derive(Clone, Copy, Debug)]
pub enum Warnings<'a> {
    None,
    /// All but those of the library's files among these.
    Own(&'a Sources),
    All,
}

/// What a state remembers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Remembered {
    /// Only what makes a difference to what follows.
    Least,
    /// All that the controller remembers too: to compare the search with itself.
    Whole,
}
