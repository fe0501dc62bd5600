//! The layout: which machines there are and where they stand.

pub mod at;
pub mod decode;
pub mod json;
pub(crate) mod machine;
mod may_touch;
pub(crate) mod object;
mod paths;
pub(crate) mod read;
pub mod routes;

pub use machine::{machine, numbers, obstacle};
pub use object::{Names, Object, Part};
pub use paths::OUTSIDE;
pub use read::{KEYS, Reading, parse};
pub use routes::Routes;

use crate::source::{FileId, Span, Spanned};

#[derive(Clone, Debug, PartialEq)]
pub struct Layout {
    /// Of the key `name`, else of the file.
    pub name: String,
    pub file: FileId,
    /// Robots, then stationary things, in the order of the text.
    pub objects: Vec<Object>,
    /// Empty: the built-in library.
    pub specs: Vec<Spanned<String>>,
    /// None: the file beside the layout, else the built-in scenario.
    pub scenario: Option<Spanned<String>>,
    pub scan_ms: u32,
    pub panel: Panel,
    pub routes: Vec<Routes>,
    pub may_touch: Vec<MayTouch>,
}

impl Layout {
    /// The names of the objects, in their order.
    pub fn names(&self) -> Vec<Spanned<String>> {
        self.objects.iter().map(|object| object.name.clone()).collect()
    }
}

/// What a person can operate beside the devices.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Panel {
    /// Permit, start and reset of the whole line.
    #[default]
    Line,
    /// For each machine an enable, a mode, and what it does by hand, too.
    Machines,
}

impl Panel {
    /// With the words of layouts.
    pub const ALL: [(&str, Panel); 2] = [("line", Panel::Line), ("machines", Panel::Machines)];
}

/// Two objects whose contact is no reason to end a run.
#[derive(Clone, Debug, PartialEq)]
pub struct MayTouch {
    pub pair: [Spanned<String>; 2],
    /// Why that is so, for people.
    pub reason: String,
}

impl MayTouch {
    /// Whether it is about these two, in either order.
    pub fn is_of(&self, [a, b]: [&str; 2]) -> bool {
        let [c, d] = self.pair.each_ref().map(|name| name.value.as_str());
        (a, b) == (c, d) || (b, a) == (c, d)
    }
}

/// A number of a layout, by its path in its object, such as `rail_range[1]`.
#[derive(Clone, Debug, PartialEq)]
pub struct Number {
    pub path: String,
    pub value: f64,
    pub span: Span,
}
