//! The kinds of part.

use crate::diagnostic::Diagnostic;
use crate::layout::decode::{Decoder, find, instead, listing};
use crate::layout::json::Json;
use crate::scenario::Kind;
use crate::source::{Span, Spanned};
use crate::spec::parser::is_word;
use runtime_sim::line::Deck;
use std::ops::RangeInclusive;

/// Of height, length and width of a part, m.
pub const LENGTHS: RangeInclusive<f64> = 0.001..=2.0;
/// Of a kind that does not say how long and wide its parts are, m: they fit side by side on a tray.
const SIZE: [f64; 2] = [0.1, 0.1];

/// Of a part, kg.
pub const MASSES: RangeInclusive<f64> = 0.001..=1000.0;
/// Of a kind that does not say, kg.
const MASS: f64 = 0.1;

/// Most kinds of part that a line has; a briefcase of the library has a place for each.
pub const MOST_KINDS: usize = 16;

/// The only kind of a line in which nobody tells kinds apart.
pub const ANY: &str = "part";

/// Of a line in which nobody tells kinds apart.
pub fn any(span: Span) -> Kind {
    Kind {
        name: Spanned { value: ANY.into(), span },
        height: SIZE[0],
        grasp: SIZE[0],
        size: SIZE,
        is: Vec::new(),
        mass: MASS,
        deck: None,
    }
}

impl Decoder {
    pub(super) fn kinds(&mut self, json: &Json) -> Option<Vec<Kind>> {
        let items = self.list(json, "kinds")?;
        if items.is_empty() || items.len() > MOST_KINDS {
            let found = items.len();
            let message = format!("a scenario has 1 to {MOST_KINDS} kinds of part, not {found}");
            self.report(
                Diagnostic::new("E0113", json.span, message)
                    .note("controllers have one input for each kind")
                    .help("list each kind that is used once"),
            );
            return None;
        }
        let kinds: Vec<Kind> = items.iter().filter_map(|item| self.kind(item)).collect();
        self.distinct(kinds.iter().map(|k| &k.name), "a kind");
        Some(kinds)
    }

    /// With any height if that cannot be read, so that its name is known.
    fn kind(&mut self, json: &Json) -> Option<Kind> {
        let members = self.object(json, "a kind")?;
        self.unknown_keys(members, &["name", "height", "grasp", "size", "is", "mass", "bears"], "a kind");
        let name = self.required(members, "name", json.span, "a kind");
        let name = name.and_then(|j| self.text(j, "name"));
        if let Some(name) = &name
            && self.identifier(name, "a kind")
        {
            self.no_word(name, "a kind");
        }
        let height = self.required(members, "height", json.span, "a kind");
        let height = height.and_then(|j| self.number_in(j, "height", LENGTHS));
        let grasp = find(members, "grasp").and_then(|j| self.grasp(j, height));
        let size = find(members, "size").and_then(|j| self.footprint(j));
        let mass = find(members, "mass").and_then(|j| self.number_in(j, "mass", MASSES)).unwrap_or(MASS);
        let is = find(members, "is").and_then(|j| self.texts(j, "is")).unwrap_or_default();
        is.iter().for_each(|word| {
            if self.identifier(word, "what a kind is") {
                self.no_word(word, "what a kind is");
            }
        });
        let is_sized = find(members, "size").is_none() || size.is_some();
        let known = height.filter(|_| is_sized).map(|height| (height, size.unwrap_or(SIZE)));
        let deck = find(members, "bears").and_then(|j| self.deck(j, known));
        let height = height.unwrap_or_default();
        let (grasp, size) = (grasp.unwrap_or(height), size.unwrap_or(SIZE));
        Some(Kind { name: name?, height, grasp, size, is, mass, deck })
    }

    /// Where items lie on a kind of this height and of these lengths, if they are known.
    fn deck(&mut self, json: &Json, kind: Option<(f64, [f64; 2])>) -> Option<Deck> {
        let members = self.object(json, "bears")?;
        self.unknown_keys(members, &["height", "size"], "bears");
        let inner = find(members, "size").map(|inner| self.footprint(inner));
        let over = find(members, "height").map(|over| self.number_in(over, "height", 0.0..=*LENGTHS.end()));
        let (height, outer) = kind?;
        let (size, deck) = (inner.unwrap_or(Some(outer))?, over.unwrap_or(Some(height))?);
        let has_walls = deck < height;
        let fits = |axis: usize| size[axis] < outer[axis] || !has_walls && size[axis] == outer[axis];
        if deck <= height && fits(0) && fits(1) {
            return Some(Deck { height: deck, size });
        }
        let [x, y] = outer;
        let message = match has_walls {
            _ if deck > height => format!("items lie {deck} m over the underside of a kind {height} m high"),
            true => format!("a kind of {x} m by {y} m has no walls around {} m by {} m", size[0], size[1]),
            false => format!("items lie on {} m by {} m of a kind of {x} m by {y} m", size[0], size[1]),
        };
        self.report(
            Diagnostic::new("E0114", json.span, message)
                .note("items lie on its upper side, or lower between walls")
                .help(match has_walls {
                    true => "write in `size` the lengths between its walls, less than its own ones",
                    false => "write a height up to its own, and lengths up to its own ones",
                }),
        );
        None
    }

    /// Automata and devices write the names of kinds.
    fn no_word(&mut self, name: &Spanned<String>, what: &str) {
        if is_word(&name.value) {
            let message = format!("\"{}\" cannot be the name of {what}", name.value);
            self.report(
                Diagnostic::new("E0120", name.span, message)
                    .note("it is a word of the language: an automaton would not mean the kind by it")
                    .help(format!("write for example \"{}_1\"", name.value.to_ascii_lowercase())),
            );
        }
    }

    /// Not over the upper side of the part, if its height is known.
    fn grasp(&mut self, json: &Json, height: Option<f64>) -> Option<f64> {
        let grasp = self.number_in(json, "grasp", LENGTHS)?;
        let Some(height) = height.filter(|height| grasp > *height) else { return Some(grasp) };
        let message = format!("grasp is {grasp} m over the underside of a part {height} m high");
        self.report(
            Diagnostic::new("E0114", json.span, message)
                .note("a tool grips a part between its underside and its upper side")
                .help(format!("write a number from {} to {height}", LENGTHS.start())),
        );
        None
    }

    fn footprint(&mut self, json: &Json) -> Option<[f64; 2]> {
        let lengths = self.exactly(json, "size", &["x", "y"])?;
        let x = self.number_in(&lengths[0], "size[0]", LENGTHS);
        let y = self.number_in(&lengths[1], "size[1]", LENGTHS);
        Some([x?, y?])
    }

    pub(super) fn kind_index(&mut self, name: &Spanned<String>, kinds: &[&str]) -> Option<usize> {
        let found = kinds.iter().position(|k| *k == name.value);
        if found.is_none() {
            self.report(
                Diagnostic::new("E0131", name.span, format!("there is no kind of part \"{}\"", name.value))
                    .note(format!("kinds of this scenario: {}", listing(kinds)))
                    .help(instead(&name.value, kinds)),
            );
        }
        found
    }
}
