//! Updates: assignments to what may be written, and commands.

use super::world::{Extent, Named, Rule, Ty};
use super::writer::{Caution, Stage, Writer};

/// Whether this automaton owns the place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Side {
    Owner,
    Others,
}

impl Writer<'_> {
    /// Some updates, at most one of them a command.
    pub fn updates(&mut self, most: usize) -> String {
        self.stage = Stage::Update;
        let mut out = String::new();
        let count = self.lot.below(most + 1);
        let command = self.lot.below(count.max(1) * 2);
        for number in 0..count {
            if number == command && self.device.is_commanded() {
                out += &self.command();
                continue;
            }
            if let Some(text) = self.assignment() {
                out += &text;
            }
        }
        out
    }

    pub fn command(&mut self) -> String {
        let device = self.device.clone();
        let verb = self.lot.pick(&device.verbs);
        let types: Vec<Ty> = (verb.arguments.iter())
            .filter_map(|argument| self.names.iter().find(|n| n.name == *argument))
            .map(|port| port.ty.clone())
            .collect();
        let arguments: Vec<String> = types.iter().map(|ty| self.value(ty, 2)).collect();
        let name = if verb.name == "move" && self.lot.one_in(4) { "goto" } else { &verb.name };
        format!(" {name}({});", arguments.join(", "))
    }

    pub fn assignment(&mut self) -> Option<String> {
        let own: Vec<Named> = (self.names.iter())
            .filter(|n| n.rule != Rule::Fixed && !self.frozen.contains(&n.name))
            .cloned()
            .collect();
        if self.caution == Caution::Risky && self.lot.one_in(3) {
            let interface = self.lot.pick(&["Shelf", "Shelf", "Post"]).to_string();
            let of = self.plain_reference(&interface, 2)?;
            let cells = self.world.interface(&interface)?.cells.iter();
            // A counter with narrow bounds soon faults for ever.
            let is_narrow = |c: &Named| c.name == "level";
            let risk = self.lot.one_in(4);
            let cells: Vec<&Named> =
                cells.filter(|c| c.rule != Rule::Owner && (risk || !is_narrow(c))).collect();
            let cell = (*self.lot.pick(&cells)).clone();
            let target = Named { name: format!("{of}.{}", cell.name), ..cell };
            return self.write(&target, Side::Others);
        }
        let target = self.lot.pick(&own).clone();
        self.write(&target, Side::Owner)
    }

    fn write(&mut self, target: &Named, side: Side) -> Option<String> {
        let is_array = target.extent != Extent::One;
        match (target.rule, side) {
            (Rule::Handshake, Side::Owner) => return Some(self.constant(target, "false")),
            (Rule::Handshake, Side::Others) => return Some(self.constant(target, "true")),
            (Rule::Lock, _) => return Some(self.constant(target, "false")),
            (Rule::Counter, Side::Others) => return Some(self.change(target)),
            _ => {}
        }
        if is_array && self.lot.one_in(3) {
            let value = self.value(&target.ty, 1);
            return Some(format!(" {} := {value};", target.name));
        }
        if is_array && !self.lot.one_in(3) {
            let (sources, risky) = (self.arrays(), self.caution == Caution::Risky);
            let sources = sources.iter().filter(|s| {
                let fits = match (&s.ty, &target.ty) {
                    (Ty::Int(a, b), Ty::Int(c, d)) => risky || (a >= c && b <= d),
                    (a, b) => a == b,
                };
                fits && s.extent == target.extent && s.name != target.name
            });
            let sources: Vec<String> = sources.map(|s| s.name.clone()).collect();
            // Few devices have array inputs, and few targets their type.
            let inputs: Vec<String> =
                sources.iter().filter(|s| self.device.port(s).is_some()).cloned().collect();
            let sources = if inputs.is_empty() { sources } else { inputs };
            if !sources.is_empty() {
                self.faults += 1;
                return Some(format!(" {} := {};", target.name, self.lot.pick(&sources)));
            }
        }
        let is_number = matches!(target.ty, Ty::Int(..) | Ty::Real | Ty::Point);
        let often = if matches!(target.ty, Ty::Int(..)) { 8 } else { 3 };
        if is_number && self.caution == Caution::Risky && self.lot.one_in(often) {
            return Some(self.change(target));
        }
        let place = self.element(&target.name, &target.extent);
        let value = self.value(&target.ty, 2);
        Some(format!(" {place} := {value};"))
    }

    fn constant(&mut self, target: &Named, value: &str) -> String {
        match target.extent != Extent::One && self.lot.one_in(2) {
            true => format!(" {} := {value};", target.name),
            false => format!(" {} := {value};", self.element(&target.name, &target.extent)),
        }
    }

    fn change(&mut self, target: &Named) -> String {
        self.faults += 1;
        let place = self.element(&target.name, &target.extent);
        let sign = *self.lot.pick(&["+=", "-="]);
        let value = match &target.ty {
            Ty::Int(..) => {
                let (text, lo, hi) = self.whole(1);
                if lo.abs().max(hi.abs()) < 10 { text } else { self.lot.between(-1, 2).to_string() }
            }
            Ty::Real => self.real(1),
            _ => self.point(1),
        };
        format!(" {place} {sign} {value};")
    }
}
