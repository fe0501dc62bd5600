//! The scenario: which orders are to be made of which parts, and what the belts bring.

mod faults;
pub(crate) mod read;
mod resolve;
mod supply;

pub use faults::{
    Answer, Element, Faults, Jam, PartName, Pause, Reading, Refusal, Signal, Slip, SlowCycle, Stuck, Words,
};
pub use read::kinds::ANY;
pub use read::{kinds, parse};
pub use resolve::{Input, Line, MachinePart, Panel, resolve};
pub use supply::Drawn;

use crate::source::{FileId, Sources, Span, Spanned};
use runtime_sim::line::{Deck, LineButton};

/// Parts that the belts bring: more than a plant could bring in the longest time limit.
const MOST_PARTS: u64 = 1_000_000;

/// The name of [`DEFAULT`], which is no file.
pub const BUILT_IN: &str = "built-in scenario";
/// For a layout that names no scenario and has none beside it.
pub const DEFAULT: &str = include_str!("default.json");

/// A scenario by itself: names of kinds are resolved, names of machines are not.
#[derive(Clone, Debug, PartialEq)]
pub struct Scenario {
    pub file: FileId,
    pub kinds: Vec<Kind>,
    pub orders: Orders,
    pub supply: Supply,
    pub time_limit_s: f64,
    pub faults: Faults,
    pub operations: Vec<Operation<Operated>>,
    pub removals: Vec<Removal>,
    /// What sinks should collect; empty: nobody asks.
    pub goal: Vec<Collected<Spanned<String>>>,
}

/// What a sink should collect: `robot.part`, and the number of items of each kind.
#[derive(Clone, Debug, PartialEq)]
pub struct Collected<Sink> {
    pub sink: Sink,
    pub items: Vec<u32>,
}

/// A kind of part.
#[derive(Clone, Debug, PartialEq)]
pub struct Kind {
    pub name: Spanned<String>,
    /// In metres.
    pub height: f64,
    /// Over its underside, where a tool grips it, in metres.
    pub grasp: f64,
    /// Lengths along x and y as it appears on a belt, in metres.
    pub size: [f64; 2],
    /// What sensors find it to be, such as `metal`.
    pub is: Vec<Spanned<String>>,
    /// kg.
    pub mass: f64,
    pub deck: Option<Deck>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Orders {
    pub span: Span,
    /// Without end: the one order that is repeated.
    pub list: Vec<Order>,
    pub number: Number,
    /// Over which orders without a station of their own are spread in turn; `None`: over all.
    pub stations: Option<Vec<Spanned<String>>>,
}

/// How many orders there are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Number {
    /// Those of the list.
    Listed,
    /// As many as the line can make until the time limit, which then is a good end.
    WithoutEnd,
    /// None are asked for: the line runs until the time limit, a good end too.
    None,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Order {
    /// Where it opens: at each of these, to be made at one of them. `None`: at the next in turn.
    pub stations: Option<Vec<Spanned<String>>>,
    /// Number of parts of each kind.
    pub parts: Vec<u32>,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Supply {
    /// Of the key `supply`, or of the scenario that has none.
    pub span: Span,
    /// Time until the first part on each belt.
    pub first_s: f64,
    /// Time between two parts on one belt.
    pub every_s: f64,
    /// Of a supply that is shuffled and of everything else that is drawn in a run.
    pub seed: u32,
    pub items: Items,
    /// How many times each list of the file stands in `items`.
    pub times: u32,
}

impl Orders {
    /// Nobody asks for anything.
    pub fn none(span: Span) -> Self {
        Self { span, list: Vec::new(), number: Number::None, stations: None }
    }
}

impl Scenario {
    /// The same without orders: what the built-in scenario is in a layout in which nothing is made.
    pub fn without_orders(&self) -> Self {
        Self { orders: Orders::none(self.orders.span), ..self.clone() }
    }

    pub fn names_of_kinds(&self) -> Vec<String> {
        self.kinds.iter().map(|kind| kind.name.value.clone()).collect()
    }

    /// Whether it is the built-in one.
    pub fn is_built_in(&self, sources: &Sources) -> bool {
        sources.file(self.file).text == DEFAULT
    }
}

/// What the belts bring; numbers are kinds.
#[derive(Clone, Debug, PartialEq)]
pub enum Items {
    /// What the orders need and a fraction more, shuffled lot by lot.
    Shuffled {
        surplus: [u32; 2],
    },
    /// On the only belt.
    OnlyBelt(Vec<usize>),
    Belts(Vec<(Spanned<String>, Vec<usize>)>),
}

impl Items {
    /// The parts of the lists.
    fn count(&self) -> usize {
        match self {
            Items::Shuffled { .. } => 0,
            Items::OnlyBelt(items) => items.len(),
            Items::Belts(lists) => lists.iter().map(|(_, items)| items.len()).sum(),
        }
    }

    /// Lists, so many times one after another.
    fn repeated(self, times: usize) -> Self {
        match self {
            Items::Shuffled { .. } => self,
            Items::OnlyBelt(items) => Items::OnlyBelt(items.repeat(times)),
            Items::Belts(lists) => {
                Items::Belts(lists.into_iter().map(|(belt, items)| (belt, items.repeat(times))).collect())
            }
        }
    }
}

/// What a person operates.
#[derive(Clone, Debug, PartialEq)]
pub enum Operated {
    OfLine(LineButton),
    OfRobot(Part),
}

/// A button or a set-point of a machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    pub robot: Spanned<String>,
    pub part: Spanned<String>,
    /// Where the number is given that is set, if one is.
    pub value: Option<Span>,
}

/// A person presses a button or sets a number.
#[derive(Clone, Debug, PartialEq)]
pub struct Operation<Whose> {
    pub part: Whose,
    pub at_s: f64,
    /// None: to the end of the run.
    pub for_s: Option<f64>,
    /// 1 for a button.
    pub value: f64,
}

/// A person takes an item off the line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Removal {
    /// The kind that the item has when it comes from the supply, and its number among those of this kind, from 1.
    pub kind: usize,
    pub number: u32,
    pub at_s: f64,
    /// Where it is named.
    pub span: Span,
}

/// A scenario for one line: machines are indices, everything is decided.
#[derive(Clone, Debug, PartialEq)]
pub struct ResolvedScenario {
    pub kinds: Vec<Kind>,
    pub number: Number,
    /// Stations, and the number of parts of each kind.
    pub orders: Vec<(Vec<usize>, Vec<u32>)>,
    /// Belt, and the kinds it brings, in order.
    pub supply: Vec<(usize, Vec<usize>)>,
    /// How it was drawn from the seed, if it was.
    pub drawn: Option<Drawn>,
    pub spawn_first_s: f64,
    pub spawn_every_s: f64,
    pub time_limit_s: f64,
    pub seed: u32,
    pub slips: Vec<Slip<usize>>,
    pub refusals: Vec<Refusal<usize>>,
    pub answers: Vec<Answer<usize>>,
    pub pauses: Vec<Pause>,
    pub power_offs: Vec<Pause>,
    pub sensors: Vec<Stuck<Words, f64>>,
    /// By numbers of the machine and of its part.
    pub jams: Vec<Jam<[usize; 2]>>,
    pub slow: Vec<SlowCycle<[usize; 2]>>,
    /// The same.
    pub operations: Vec<Operation<[usize; 2]>>,
    pub presses: Vec<Operation<LineButton>>,
    pub removals: Vec<Removal>,
    /// The same, of sinks.
    pub goal: Vec<Collected<[usize; 2]>>,
}
