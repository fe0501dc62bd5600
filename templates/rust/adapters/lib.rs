//! The controllers of any layout of the same types: they are read from text and work on process images. A C interface
//! lets a simulator that was compiled separately load them.

pub mod c_interface;
pub mod image;
pub mod kept;
pub mod layout;
pub mod read;
pub mod words;
