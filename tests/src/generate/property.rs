//! Properties of an automaton: of each kind, with each of the things that a violation can do.

use super::writer::{Stage, Writer};

impl Writer<'_> {
    pub fn properties(&mut self) -> String {
        self.stage = Stage::Elsewhere;
        let mut out = String::new();
        for _ in 0..self.lot.below(4) {
            let property = self.property();
            out += &format!("    {property};\n");
        }
        out
    }

    fn property(&mut self) -> String {
        let reaction = match self.lot.below(12) {
            0 => " else stop line \"what stops the line\"",
            1..=3 => " else stop machine \"what stops the machine\"",
            _ => " else warn \"what warns\"",
        };
        let stops = reaction.contains("stop");
        // What stops something must not do so in every scan.
        let guarded = |w: &mut Self, text: String| match stops {
            true => format!("({}) and ({}) and ({text})", w.passing(), w.boolean(1)),
            false => text,
        };
        match self.lot.below(3) {
            0 => {
                let text = self.boolean(2);
                let text = guarded(self, text);
                format!("invariant not ({text}){reaction}")
            }
            1 => {
                let value = match self.lot.below(4) {
                    0 => self.whole(1).0,
                    1 => self.real(1),
                    2 => self.point(1),
                    _ => self.member("Kind"),
                };
                let more = if self.lot.one_in(2) { format!(", {}", self.boolean(1)) } else { String::new() };
                let condition = self.boolean(1);
                let condition = guarded(self, condition);
                format!("keep {value}{more} while {condition}{reaction}")
            }
            _ => {
                let (trigger, goal) = (self.boolean(2), self.boolean(1));
                let trigger = guarded(self, trigger);
                let goal = if self.lot.one_in(2) { self.passing() } else { goal };
                let within = match self.lot.one_in(4) {
                    true => self.time(1).0,
                    false => format!("{} ms", 10 * self.lot.between(0, 12)),
                };
                format!("whenever {trigger} then {goal} within {within}{reaction}")
            }
        }
    }
}
