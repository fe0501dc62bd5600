//! The controllers of any layout of the same types: read from text, given process images, and behind a C
//! interface by which a simulator that was compiled apart loads them.

pub mod c_interface;
pub mod image;
pub mod kept;
pub mod layout;
pub mod read;
pub mod words;
