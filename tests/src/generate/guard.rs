//! Guards: conditions, binders, and facts that make what follows provable.

use super::world::{Extent, Ty};
use super::writer::{Caution, Stage, Writer, is_definition};

impl Writer<'_> {
    /// Clauses joined by commas; what they prove is known afterwards.
    pub fn guard(&mut self) -> String {
        self.stage = Stage::Guard;
        let mut clauses = Vec::new();
        if self.lot.one_in(2) {
            clauses.extend(self.fact());
        }
        let binders = *self.lot.pick(&[0, 0, 0, 1, 1, 2, 2, 3]);
        for _ in 0..binders {
            clauses.push(self.binder());
        }
        if clauses.is_empty() || self.lot.one_in(3) {
            let depth = self.lot.below(4);
            clauses.push(self.boolean(depth));
        }
        clauses.join(", ")
    }

    /// A condition that narrows what is known of an own name.
    fn fact(&mut self) -> Option<String> {
        // What is read through a definition, or changed by a command, cannot be known.
        let is_known = |name: &str| !is_definition(name) && !["cmd", "verb"].contains(&name);
        let own = self
            .names
            .iter()
            .filter(|n| n.extent == Extent::One && is_known(&n.name) && !self.frozen.contains(&n.name));
        let own: Vec<_> = own.cloned().collect();
        let named = self.lot.pick(&own).clone();
        let name = named.name;
        let text = match named.ty {
            Ty::Int(lo, hi) if hi - lo > 2 => match self.lot.below(3) {
                0 if hi > 0 => {
                    self.facts.push((name.clone(), Ty::Int(lo.max(1), hi)));
                    format!("{name} > 0")
                }
                1 if lo <= 0 && hi >= 3 => {
                    self.facts.push((name.clone(), Ty::Int(0, 2)));
                    format!("{name} >= 0 and {name} <= 2")
                }
                _ => {
                    let most = lo + (hi - lo) / 2;
                    self.facts.push((name.clone(), Ty::Int(lo, most)));
                    format!("not ({name} > {most})")
                }
            },
            Ty::Time(_) => {
                self.facts.push((name.clone(), Ty::Time(9999)));
                format!("{name} < 10 s")
            }
            Ty::Real => {
                self.divisors.push(name.clone());
                format!("{name} {}", self.lot.pick(&["> 0.01", "< -1.5", "> 0", "< 0"]))
            }
            _ => return None,
        };
        self.frozen.push(name);
        Some(text)
    }

    fn binder(&mut self) -> String {
        let (domain, ty) = self.domain();
        let name = self.new_variable();
        self.variables.push((name.clone(), ty));
        let with = match self.lot.one_in(2) {
            true => {
                let depth = self.lot.below(3);
                format!(" with {}", self.boolean(depth))
            }
            false => String::new(),
        };
        let caution = std::mem::replace(&mut self.caution, Caution::Risky);
        let text = match self.lot.below(4) {
            0 | 1 => format!("first {name} in {domain}{with}"),
            2 => {
                let key = match self.lot.below(3) {
                    0 => self.real(1),
                    1 => self.time(1).0,
                    _ => self.whole(1).0,
                };
                format!("least {name} in {domain} by {key}{with}")
            }
            _ => format!("nearest {name} in {domain} by {} to {}{with}", self.point(1), self.point(1)),
        };
        self.caution = caution;
        text
    }

    /// A condition that changes by itself, so that a fault does not return for ever.
    pub fn passing(&mut self) -> String {
        let of = |name: &str| match name {
            "belt" => &["ready", "moving", "not ready", "error > 3", "sees[Bolt]"][..],
            "vehicle" => &["ready", "not ready", "at_stop = 1", "pos.x < 1", "error = 2"],
            "station" => &["order_open", "not order_open", "order_id > 9", "order_parts[Bolt] > 0"],
            "bin" => &["exists s in shelves: s.bell", "count(shelves) = count s in shelves: not s.open"],
            _ => &["ready", "attached", "not attached", "got = 0", "tool.y >= 0"],
        };
        self.lot.pick(of(&self.device.name)).to_string()
    }
}
