//! What all automata of a generated system share: enumerations, and interfaces with cells of every type and rule.

use super::lot::Lot;
use std::fmt::Write;

#[derive(Clone, Debug, PartialEq)]
pub enum Ty {
    Bool,
    Int(i64, i64),
    Real,
    /// With the longest that is known, ms.
    Time(i64),
    Point,
    Enum(String),
    Ref(String),
}

#[derive(Clone, Debug, PartialEq)]
pub enum Extent {
    One,
    Count(usize),
    By(String),
}

/// Who may write.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rule {
    /// Nobody: parameters, inputs, definitions.
    Fixed,
    Owner,
    Handshake,
    Lock,
    Counter,
    /// A token, or a cell that goes with one.
    Token,
}

/// Something with a name that can be read.
#[derive(Clone, Debug)]
pub struct Named {
    pub name: String,
    pub ty: Ty,
    pub extent: Extent,
    pub rule: Rule,
    /// A real read from it may be infinite or NaN.
    pub finite: Finite,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Finite {
    Always,
    Perhaps,
}

pub struct Enum {
    pub name: String,
    pub members: Vec<String>,
}

pub struct Interface {
    pub name: String,
    pub parameters: Vec<Named>,
    pub cells: Vec<Named>,
}

pub struct World {
    pub enums: Vec<Enum>,
    pub interfaces: Vec<Interface>,
    pub text: String,
}

impl World {
    pub fn new(lot: &mut Lot) -> Self {
        let members = |list: &[&str]| list.iter().map(|m| m.to_string()).collect::<Vec<_>>();
        let kinds = &["Bolt", "Nut", "Washer", "Spring"][..1 + lot.below(4)];
        let enums = vec![
            Enum { name: "Kind".into(), members: members(kinds) },
            Enum { name: "Colour".into(), members: members(&["Red", "Green", "Blue"]) },
            Enum { name: "Turn".into(), members: members(&["Mine", "Yours", "Ours"]) },
            Enum { name: "Slot".into(), members: members(&["Free", "Taken"]) },
        ];
        let mut text = String::new();
        for e in &enums[1..] {
            let _ = writeln!(text, "enum {} {{ {} }}", e.name, e.members.join(", "));
        }
        let (high, size) = (lot.between(1, 12), lot.between(1, 9));
        let shelf = format!(
            "interface Shelf {{
    parameter size: int 1..{size};
    parameter weight: real;
    parameter at: point;
    parameter slow: time;
    parameter wide: bool;
    parameter paint: Colour;
    parameter partner: Shelf;
    parameter share: int 0..9[Kind];
    parameter spots: point[3];
    parameter tints: Colour[4];
    shared open: bool by owner;
    shared bell: bool := false by handshake;
    shared bells: bool[3] by handshake;
    shared held: bool by lock;
    shared locks: bool[Kind] by lock;
    shared parts: int 0..9{high}[Kind] := 50 by counter;
    shared level: int -5..5 by counter;
    shared baton: Turn := Ours by token {{ Mine: owner, Yours: others, Ours: owner }};
    shared load: Kind with baton;
    shared rows: int -9..9[4] with baton;
    shared mass: real := 1.5 by owner;
    shared drop: point := point(1, 0.5, -2) by owner;
    shared drops: point[Kind] with baton;
    shared marks: real[Colour] by owner;
    shared since: time := 20 ms;
    shared waits: time[Colour] with baton;
    shared friend: Shelf with baton;
    shared friends: Shelf[3] by owner;
    shared hue: Colour := Green;
}}
"
        );
        let post = "interface Post {
    parameter rank: int 0..9;
    parameter gains: real[2];
    shared slot: Slot[5] by token { Free: others, Taken: owner };
    shared what: Kind[5] with slot;
    shared whose: Post[5] with slot;
    shared goes_to: Shelf[5] with slot;
    shared tally: int -300..300 by counter;
    shared flags: bool[Colour] by owner;
    shared pause: time by owner;
    shared alarm: bool by handshake;
    keep tally while alarm and rank < 9 else warn \"counted during an alarm\";
    whenever alarm then tally > 0 or not alarm within pause else warn \"nobody comes\";
}
";
        text += &shelf;
        text += post;
        let interfaces = [("Shelf", shelf.as_str()), ("Post", post)];
        let interfaces = interfaces.map(|(name, text)| interface(name, text, &enums)).into();
        Self { enums, interfaces, text }
    }

    pub fn interface(&self, name: &str) -> Option<&Interface> {
        self.interfaces.iter().find(|i| i.name == name)
    }

    pub fn members(&self, name: &str) -> &[String] {
        self.enums.iter().find(|e| e.name == name).map_or(&[], |e| &e.members)
    }

    pub fn size(&self, extent: &Extent) -> usize {
        match extent {
            Extent::One => 1,
            Extent::Count(n) => *n,
            Extent::By(name) => self.members(name).len(),
        }
    }
}

fn interface(name: &str, text: &str, enums: &[Enum]) -> Interface {
    let declared = |word: &str| text.lines().filter_map(|l| declaration(l, word, enums)).collect::<Vec<_>>();
    Interface { name: name.into(), parameters: declared("parameter"), cells: declared("shared") }
}

/// What a line `word name: type ...` declares.
pub fn declaration(line: &str, word: &str, enums: &[Enum]) -> Option<Named> {
    let (name, rest) = line.trim().strip_prefix(word)?.trim().split_once(": ")?;
    let rest = rest.trim_end_matches(';');
    let rule = match rest.split_once(" by ") {
        Some((_, rule)) if rule.starts_with("handshake") => Rule::Handshake,
        Some((_, rule)) if rule.starts_with("lock") => Rule::Lock,
        Some((_, rule)) if rule.starts_with("counter") => Rule::Counter,
        Some((_, rule)) if rule.starts_with("token") => Rule::Token,
        _ if rest.contains(" with ") => Rule::Token,
        _ if word == "parameter" => Rule::Fixed,
        _ => Rule::Owner,
    };
    let ty = rest.split(" :=").next()?.split(" by ").next()?.split(" with ").next()?;
    let (ty, extent) = match ty.trim_end_matches(']').split_once('[') {
        Some((ty, extent)) => (ty, extent.parse().map_or_else(|_| Extent::By(extent.into()), Extent::Count)),
        None => (ty, Extent::One),
    };
    let ty = match ty {
        "bool" => Ty::Bool,
        "real" => Ty::Real,
        "time" => Ty::Time(i64::from(i32::MAX)),
        "point" => Ty::Point,
        _ => match ty.strip_prefix("int ").and_then(|t| t.split_once("..")) {
            Some((lo, hi)) => Ty::Int(lo.parse().ok()?, hi.parse().ok()?),
            None if enums.iter().any(|e| e.name == ty) => Ty::Enum(ty.into()),
            None => Ty::Ref(ty.into()),
        },
    };
    Some(Named { name: name.into(), ty, extent, rule, finite: Finite::Always })
}
