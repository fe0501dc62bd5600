//! The controllers of a factory line, made by autogen from {{ files }}.
//!
//! One [`system::System`] steps all robots of the line in each scan. The logic of each type of robot
//! stands once, in the module of its name; what the layout fixes stands in [`robots`] and [`line`].
//! Nothing allocates, nothing is unsafe, nothing panics.
//!
//! **This is no safety function.** Emergency stop, guards and safe speeds are not its business.
#![no_std]

{%- for module in modules %}
pub mod {{ module }};
{%- endfor %}
