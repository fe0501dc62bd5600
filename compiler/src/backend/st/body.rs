//! The statements of a unit.

use super::bounds;
use super::code::{self, Stmt};
use super::name::Name;
use std::borrow::Cow;
use std::collections::{BTreeSet, HashSet};
use std::sync::Arc;

/// The statements of a unit. What it does for each robot or for each value is as long as the line: that is made piece
/// by piece, each time that it is looked at.
#[derive(Clone, Default)]
pub struct Body<'a>(Vec<Part<'a>>);

#[derive(Clone)]
enum Part<'a> {
    Whole(Vec<Stmt>),
    /// So many pieces.
    Made(usize, Arc<dyn Fn(usize) -> Vec<Stmt> + Send + Sync + 'a>),
}

/// How many statements there are.
pub struct Size {
    /// The most that are executed.
    pub greatest: u64,
    pub written: u64,
}

impl<'a> Body<'a> {
    pub fn push(&mut self, statements: impl Into<Vec<Stmt>>) {
        self.0.push(Part::Whole(statements.into()));
    }

    /// So many pieces, by their numbers.
    pub fn push_made(&mut self, count: usize, make: impl Fn(usize) -> Vec<Stmt> + Send + Sync + 'a) {
        self.0.push(Part::Made(count, Arc::new(make)));
    }

    /// The same with other statements in the place of each piece.
    pub fn map(&'a self, change: impl Fn(&[Stmt]) -> Vec<Stmt> + Send + Sync + 'a) -> Self {
        let change = Arc::new(change);
        let changed = |part: &'a Part<'a>| match part {
            Part::Whole(statements) => Part::Whole(change(statements)),
            Part::Made(count, make) => {
                let change = change.clone();
                Part::Made(*count, Arc::new(move |i| change(&make(i))))
            }
        };
        Self(self.0.iter().map(changed).collect())
    }

    /// All statements, in pieces.
    pub fn pieces(&self) -> impl Iterator<Item = Cow<'_, [Stmt]>> {
        self.0.iter().flat_map(|part| {
            let (whole, made) = match part {
                Part::Whole(statements) => (Some(Cow::Borrowed(statements.as_slice())), None),
                Part::Made(count, make) => (None, Some((0..*count).map(|i| Cow::Owned(make(i))))),
            };
            whole.into_iter().chain(made.into_iter().flatten())
        })
    }

    /// Adds all names that are read or written, and all functions that are called.
    pub fn names_and_functions(&self, names: &mut HashSet<Name>, functions: &mut BTreeSet<&'static str>) {
        let mut called = Vec::new();
        for piece in self.pieces() {
            code::expressions(&piece, &mut |ex| {
                ex.names(names);
                ex.functions(&mut called);
            });
            functions.extend(called.drain(..));
        }
    }

    pub fn size(&self) -> Size {
        let mut size = Size { greatest: 0, written: 0 };
        for piece in self.pieces() {
            size.greatest = size.greatest.saturating_add(bounds::greatest(&piece));
            size.written += bounds::written(&piece);
        }
        size
    }
}

impl From<Vec<Stmt>> for Body<'_> {
    fn from(statements: Vec<Stmt>) -> Self {
        Self(vec![Part::Whole(statements)])
    }
}
