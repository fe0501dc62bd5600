//! The globals that a unit declares because it names them.

use super::declaration::Variable;
use super::globals::Globals;
use std::borrow::Cow;
use std::sync::Arc;

#[derive(Clone)]
pub enum Externals {
    Declared(Vec<Variable>),
    /// Those that are marked, in the order of [`Globals::all`]. The program declares as many as the line has ports.
    Marked(Arc<Globals>, Vec<bool>),
}

impl Default for Externals {
    fn default() -> Self {
        Externals::Declared(Vec::new())
    }
}

impl Externals {
    pub fn marked(globals: &Arc<Globals>, is_used: impl Fn(&str) -> bool) -> Self {
        let marks = globals.all().map(|variable| is_used(&variable.name)).collect();
        Externals::Marked(globals.clone(), marks)
    }

    pub fn iter(&self) -> impl Iterator<Item = Cow<'_, Variable>> {
        let (declared, marked) = match self {
            Externals::Declared(declared) => (Some(declared.iter().map(Cow::Borrowed)), None),
            Externals::Marked(globals, marks) => {
                let marked = globals.all().zip(marks).filter(|(_, is_marked)| **is_marked);
                (None, Some(marked.map(|(variable, _)| Cow::Owned(variable.uncommented()))))
            }
        };
        declared.into_iter().flatten().chain(marked.into_iter().flatten())
    }
}
