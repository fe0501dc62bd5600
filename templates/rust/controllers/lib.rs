//! The controllers of a factory line, made by autogen from {{ files }}.
//!
//! One [`system::System`] steps all robots of the line in each scan. The logic of each type of robot
//! is in the module of its name; [`robots`] and [`mod@line`] have the values that the layout fixes.
//! Nothing allocates, nothing is unsafe, nothing panics. From `opt-level = 1` on no code that could panic is linked;
//! without optimization, or with `overflow-checks`, rustc keeps checks that never act.
//!
//! The crate has no clock, no bus and no storage: `docs/rust.md` of autogen says what the program that calls it has to do.
//!
//! **This is not a safety function.** It implements no emergency stop, no guards and no safe speeds.
#![no_std]

{%- for module in modules %}
pub mod {{ module }};
{%- endfor %}
