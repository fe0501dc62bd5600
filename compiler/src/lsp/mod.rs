//! What an editor asks about texts, in the terms of the Language Server Protocol. The server itself, which reads
//! messages and files, is a command.

pub use gen_lsp_types as protocol;

pub mod completion;
pub mod diagnostics;
pub mod hover;
pub mod json;
pub mod lines;
pub mod rename;
pub mod specs;
