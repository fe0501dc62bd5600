//! One module for each command, and what they share.

/// A line on standard output.
macro_rules! say {
    ($($text:tt)*) => { $crate::command::print::out(format_args!("{}\n", format_args!($($text)*))) };
}

/// Text on standard output.
macro_rules! say_part {
    ($($text:tt)*) => { $crate::command::print::out(format_args!($($text)*)) };
}

/// A line on standard error.
macro_rules! complain {
    ($($text:tt)*) => { $crate::command::print::err(&format!("{}\n", format_args!($($text)*))) };
}

mod alarm;
pub mod build;
pub mod check;
pub mod commission;
pub mod compare;
pub mod completions;
pub mod contact;
pub mod controllers;
mod copies;
pub mod diff;
pub mod differences;
mod dropped;
pub mod explain;
pub mod fault;
pub mod fmt;
pub mod graph;
pub mod import;
pub mod interrupt;
pub mod io_error;
pub mod io_trace;
pub mod load;
pub mod lock;
pub mod lsp;
pub mod named;
pub mod new;
pub mod options;
pub mod output;
pub mod pending;
pub mod print;
pub mod progress;
pub mod read;
pub mod results;
pub mod schema;
pub mod sweep;
pub mod test;
pub mod trajectories;
pub mod verify;
pub mod why;
