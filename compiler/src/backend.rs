//! Back ends: pure functions from the intermediate representation to files. They cannot fail.

pub mod dot;
mod footprint;
pub mod paths;
pub mod plan;
pub mod report;
pub mod rust;
pub mod sdf;
pub mod st;

use std::collections::BTreeMap;

/// Files in memory: text by path.
pub type Files = BTreeMap<String, String>;
