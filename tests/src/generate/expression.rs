//! Expressions of each type, whole numbers with the bounds that the checker can prove.

use super::world::Ty;
use super::writer::{Caution, Stage, Writer};

/// A whole number and its bounds.
pub type Whole = (String, i64, i64);

impl Writer<'_> {
    pub fn boolean(&mut self, depth: usize) -> String {
        if depth == 0 {
            let read = self.reading(&|ty| *ty == Ty::Bool).map(|(text, _)| text);
            return match (self.lot.below(8), read) {
                (0, _) => "true".into(),
                (1, _) => "false".into(),
                (2, Some(text)) => format!("not {text}"),
                (3..8, Some(text)) => text,
                _ => self.boolean(1),
            };
        }
        let next = depth - 1;
        match self.lot.below(28) {
            0 | 1 => format!("({} and {})", self.boolean(next), self.boolean(next)),
            2 | 3 => format!("({} or {})", self.boolean(next), self.boolean(next)),
            4 => format!("not ({})", self.boolean(next)),
            5..8 => {
                let (a, b) = (self.whole(next).0, self.whole(next).0);
                format!("{a} {} {b}", self.order())
            }
            8 => format!("{} {} {}", self.real(next), self.order(), self.real(next)),
            9 => format!("{} {} {}", self.time(next).0, self.order(), self.time(next).0),
            10 | 11 => self.equality(),
            12 if self.device.is_commanded() => self.lot.pick(&["done", "failed"]).to_string(),
            13 if self.stage == Stage::Guard => {
                let time = match self.lot.below(4) {
                    0 => self.time(next).0,
                    _ => format!("{} ms", self.lot.between(0, 60)),
                };
                format!("after {time}")
            }
            14 => self.membership(),
            15..17 => self.quantified("exists", next),
            17..19 => self.quantified("forall", next),
            19 => {
                let read = self.reading(&|ty| *ty == Ty::Bool);
                match read {
                    Some((text, _)) => {
                        format!("{text} {} ({})", self.lot.pick(&["=", "<>"]), self.boolean(0))
                    }
                    None => "true".into(),
                }
            }
            20 | 21 => format!("{} {} {}", self.real(next), self.order(), self.real(next)),
            22 | 23 => format!("{} {} {}", self.time(next).0, self.order(), self.time(next).0),
            24 => self.equality(),
            25 | 26 => format!("{} {} {}", self.counted(next).0, self.order(), self.lot.between(0, 3)),
            _ => self.boolean(0),
        }
    }

    fn order(&mut self) -> &'static str {
        const ORDER: [&str; 8] = ["=", "<>", "<", "<=", ">", ">=", "<", ">"];
        ORDER[self.lot.below(ORDER.len())]
    }

    /// Equality of members or references.
    fn equality(&mut self) -> String {
        let sign = *self.lot.pick(&["=", "<>"]);
        let read = match self.lot.below(2) {
            0 => self.reading(&|ty| matches!(ty, Ty::Enum(_))),
            _ => self.reading(&|ty| matches!(ty, Ty::Ref(_))),
        };
        match read {
            Some((text, Ty::Enum(name))) => format!("{text} {sign} {}", self.member(&name)),
            Some((text, Ty::Ref(name))) => match self.reference(&name) {
                Some(other) => format!("{text} {sign} {other}"),
                None => "true".into(),
            },
            _ => "true".into(),
        }
    }

    fn membership(&mut self) -> String {
        let (role, interfaces) = self.lot.pick(&self.roles).clone();
        let one = self.plain_reference(&interfaces[0], 1);
        let interface = *self.lot.pick(&["Shelf", "Shelf", "Post"]);
        let other = self.plain_reference(interface, 1);
        match (one, other) {
            (Some(one), Some(other)) if self.lot.one_in(2) => format!("{one} reaches {other}"),
            (Some(_), _) if self.lot.one_in(4) && self.own.contains(&interfaces[0]) => {
                format!("self in {role}")
            }
            (Some(one), _) => format!("{one} in {role}"),
            _ => "true".into(),
        }
    }

    /// A domain, and the type of a variable that runs over it.
    pub fn domain(&mut self) -> (String, Ty) {
        match self.lot.below(4) {
            0 | 1 => {
                let (role, interfaces) = self.lot.pick(&self.roles).clone();
                (role, Ty::Ref(interfaces[0].clone()))
            }
            2 => {
                let name = self.lot.pick(&["Kind", "Colour", "Turn"]).to_string();
                (name.clone(), Ty::Enum(name))
            }
            _ => {
                let (a, b) = (self.small(), self.small());
                match self.lot.below(4) {
                    0 => (
                        format!("{}..{}", a.0, b.0),
                        Ty::Int(a.1, if b.2 < a.1 { i64::from(i32::MAX) } else { b.2 }),
                    ),
                    1 => (format!("0..{}", b.0), Ty::Int(0, b.2.max(0))),
                    _ => {
                        let hi = self.lot.between(0, 4);
                        (format!("0..{hi}"), Ty::Int(0, i64::from(hi)))
                    }
                }
            }
        }
    }

    /// A whole number of little size.
    fn small(&mut self) -> Whole {
        let (text, lo, hi) = self.whole(1);
        if lo >= -20 && hi <= 20 {
            return (text, lo, hi);
        }
        let n = self.lot.between(2, 6);
        (format!("({text}) mod {n}"), i64::from(1 - n), i64::from(n - 1))
    }

    fn quantified(&mut self, word: &str, depth: usize) -> String {
        let (domain, ty) = self.domain();
        let name = self.new_variable();
        self.variables.push((name.clone(), ty));
        let body = match self.lot.one_in(4) {
            true if word != "count" => {
                let (second, ty) = self.domain();
                let other = self.new_variable();
                self.variables.push((other.clone(), ty));
                let body = self.boolean(depth.min(1));
                self.variables.pop();
                format!(", {other} in {second}: {body}")
            }
            _ => format!(": {}", self.boolean(depth)),
        };
        self.variables.pop();
        format!("({word} {name} in {domain}{body})")
    }

    /// A whole number with its bounds.
    pub fn whole(&mut self, depth: usize) -> Whole {
        if depth == 0 {
            if let Some((text, Ty::Int(lo, hi))) = self.reading(&|ty| matches!(ty, Ty::Int(..)))
                && !self.lot.one_in(5)
            {
                return (text, lo, hi);
            }
            let n = i64::from(self.lot.between(-9, 12));
            return (n.to_string(), n, n);
        }
        let next = depth - 1;
        let (a, lo, hi) = self.whole(next);
        let found = match self.lot.below(16) {
            0 | 1 => {
                let (b, low, high) = self.whole(next);
                (format!("({a} + {b})"), lo + low, hi + high)
            }
            2 => {
                let (b, low, high) = self.whole(next);
                (format!("({a} - ({b}))"), lo - high, hi - low)
            }
            3 => {
                let (b, low, high) = self.whole(next);
                let all = [
                    lo.saturating_mul(low),
                    lo.saturating_mul(high),
                    hi.saturating_mul(low),
                    hi.saturating_mul(high),
                ];
                let (least, most) = (all.iter().min().copied(), all.iter().max().copied());
                (format!("({a} * ({b}))"), least.unwrap_or(lo), most.unwrap_or(hi))
            }
            4 | 5 => {
                let divisor = self.divisor();
                let largest = lo.abs().max(hi.abs());
                (format!("(({a}) / {divisor})"), -largest, largest)
            }
            6 | 7 => {
                let n = self.lot.between(1, 9);
                let divisor = match self.lot.below(3) {
                    0 => format!("(-{n})"),
                    _ => n.to_string(),
                };
                (format!("(({a}) mod {divisor})"), i64::from(1 - n), i64::from(n - 1))
            }
            8 => (format!("(-({a}))"), -hi, -lo),
            9 => (format!("abs({a})"), 0, lo.abs().max(hi.abs())),
            10 => {
                let (b, low, high) = self.whole(next);
                (format!("min({a}, {b})"), lo.min(low), hi.min(high))
            }
            11 => {
                let (b, low, high) = self.whole(next);
                (format!("max({a}, {b})"), lo.max(low), hi.max(high))
            }
            12 => self.counted(next),
            13 => self.summed(),
            _ => (a.clone(), lo, hi),
        };
        let fits = |v: i64| i32::try_from(v).is_ok();
        if fits(found.1) && fits(found.2) { found } else { (a, lo, hi) }
    }

    fn counted(&mut self, depth: usize) -> Whole {
        match self.lot.below(5) {
            0 => (format!("count({})", self.lot.pick(&self.roles).0), 0, 65_535),
            1..4 => {
                let arrays = self.arrays();
                let simple: Vec<_> =
                    arrays.iter().filter(|n| !matches!(n.ty, Ty::Point | Ty::Ref(_))).collect();
                if simple.is_empty() {
                    return ("1".into(), 1, 1);
                }
                let array = (*self.lot.pick(&simple)).clone();
                let bound = self.variables.iter().rev().find(|(_, ty)| matches!(ty, Ty::Int(..)));
                let value = match (&array.ty, bound.cloned()) {
                    (Ty::Int(..), Some((variable, _))) if self.lot.one_in(2) => variable,
                    (Ty::Int(..), _) if depth > 0 && self.lot.one_in(2) => self.counted(depth - 1).0,
                    (ty, _) => self.value(ty, 0),
                };
                (format!("count({}, {value})", array.name), 0, self.world.size(&array.extent) as i64)
            }
            _ => (self.quantified("count", depth), 0, 65_535),
        }
    }

    fn summed(&mut self) -> Whole {
        let (domain, ty) = self.domain();
        let name = self.new_variable();
        let size = match &ty {
            Ty::Int(lo, hi) => hi - lo + 1,
            _ => 65_535,
        };
        self.variables.push((name.clone(), ty));
        let (text, lo, hi) = self.whole(1);
        self.variables.pop();
        if lo.abs().max(hi.abs()) * size > 2_000_000_000 {
            return ("2".into(), 2, 2);
        }
        (format!("(sum {name} in {domain}: {text})"), (lo * size).min(0), (hi * size).max(0))
    }

    /// A whole number that differs from 0.
    fn divisor(&mut self) -> String {
        let known = |ty: &Ty| matches!(ty, Ty::Int(lo, hi) if *lo > 0 || *hi < 0);
        match self.lot.below(4) {
            0 => match self.reading(&known) {
                Some((text, _)) => text,
                None => "3".into(),
            },
            1 => {
                let (text, _, hi) = self.whole(0);
                if hi < 1_000_000 { format!("(abs({text}) + 1)") } else { "7".into() }
            }
            2 => format!("(-{})", self.lot.between(1, 9)),
            _ => self.lot.between(1, 9).to_string(),
        }
    }

    pub fn real(&mut self, depth: usize) -> String {
        if self.caution == Caution::Safe {
            return self.plain_real();
        }
        if depth == 0 {
            return match self.lot.below(6) {
                0 => format!("({:?})", self.lot.real()),
                1 => self.lot.pick(&["1e200", "(-3e250)", "1e-300", "0.5"]).to_string(),
                2 => {
                    let point = self.point(0);
                    format!("({point}).{}", self.lot.pick(&["x", "y", "z"]))
                }
                _ => self.plain_real(),
            };
        }
        let next = depth - 1;
        let a = self.real(next);
        match self.lot.below(12) {
            0 | 1 => format!("({a} + {})", self.real(next)),
            2 => format!("({a} - {})", self.real(next)),
            3 => format!("({a} * {})", self.real(next)),
            4 | 5 => format!("({a} / {})", self.real_divisor()),
            6 => format!("(-({a}))"),
            7 => format!("abs({a})"),
            8 => format!("min({a}, {})", self.real(next)),
            9 => format!("max({a}, {})", self.real(next)),
            10 => format!("squared_distance({}, {})", self.point(next), self.point(next)),
            _ => {
                let (domain, ty) = self.domain();
                let name = self.new_variable();
                self.variables.push((name.clone(), ty));
                let body = self.plain_real();
                self.variables.pop();
                format!("(sum {name} in {domain}: 0.25 * {body})")
            }
        }
    }

    fn real_divisor(&mut self) -> String {
        if !self.divisors.is_empty() && !self.lot.one_in(3) {
            return self.lot.pick(&self.divisors).clone();
        }
        match self.lot.below(2) {
            0 => "0.3".into(),
            _ => self.divisor(),
        }
    }

    /// A real that is finite if what it reads is.
    fn plain_real(&mut self) -> String {
        match self.lot.below(6) {
            0 => format!("({:?})", self.lot.real()),
            1 => {
                let whole = self.whole(0).0;
                format!("max({whole}, {:?})", self.lot.real().abs())
            }
            _ => self.reading(&|ty| *ty == Ty::Real).map_or("2.5".into(), |(text, _)| text),
        }
    }

    /// A time, and the longest it can be.
    pub fn time(&mut self, depth: usize) -> (String, i64) {
        let literal = i64::from(self.lot.between(0, 90));
        let unbounded = i64::from(i32::MAX);
        let leaf = |ms: i64| match ms {
            ms if ms % 20 == 0 => (format!("{:?} s", ms as f64 / 1000.0), ms),
            ms => (format!("{ms} ms"), ms),
        };
        if depth == 0 {
            return match self.reading(&|ty| matches!(ty, Ty::Time(_))) {
                Some((text, Ty::Time(hi))) if !self.lot.one_in(3) => (text, hi),
                _ => leaf(literal),
            };
        }
        let a = self.time(depth - 1);
        let found = match self.lot.below(6) {
            0 | 1 => {
                let b = self.time(depth - 1);
                (format!("({} + {})", a.0, b.0), a.1 + b.1)
            }
            2 | 3 => {
                let (whole, lo, hi) = self.whole(0);
                let (factor, most) = if lo >= 0 { (whole, hi) } else { ("3".into(), 3) };
                let text = match self.lot.one_in(2) {
                    true => format!("({factor} * {})", a.0),
                    false => format!("({} * {factor})", a.0),
                };
                (text, a.1.saturating_mul(most))
            }
            4 => (format!("min({}, {literal} ms)", a.0), unbounded),
            _ => (format!("max({}, {literal} ms)", a.0), unbounded),
        };
        if found.1 <= unbounded { found } else { leaf(literal) }
    }

    pub fn point(&mut self, depth: usize) -> String {
        let read = self.reading(&|ty| *ty == Ty::Point).map(|(text, _)| text);
        if self.caution == Caution::Safe || depth == 0 {
            let literal = format!("point({:?}, {:?}, {:?})", self.lot.real(), self.lot.real().abs(), 1);
            return match read {
                Some(text) if !self.lot.one_in(4) => text,
                _ => literal,
            };
        }
        let next = depth - 1;
        match self.lot.below(5) {
            0 => format!("({} + {})", self.point(next), self.point(next)),
            1 => format!("({} - {})", self.point(next), self.point(next)),
            2 => format!("up({})", self.real(next)),
            3 => format!("point({}, {}, {})", self.real(next), self.real(0), self.real(0)),
            _ => self.point(0),
        }
    }

    /// A member of an enumeration, or something that reads one.
    pub fn member(&mut self, name: &str) -> String {
        let literal = self.lot.pick(self.world.members(name)).clone();
        match self.reading(&|ty| *ty == Ty::Enum(name.into())) {
            Some((text, _)) if self.lot.one_in(2) => text,
            _ if self.lot.one_in(4) => format!("{name}.{literal}"),
            _ => literal,
        }
    }

    pub fn reference(&mut self, interface: &str) -> Option<String> {
        if self.own.iter().any(|own| own == interface) && self.lot.one_in(4) {
            return Some("self".into());
        }
        self.plain_reference(interface, 2)
    }

    /// A value that has a type and fits, or may not if risks are taken.
    pub fn value(&mut self, ty: &Ty, depth: usize) -> String {
        match ty {
            Ty::Bool => self.boolean(depth),
            Ty::Int(lo, hi) => {
                let (text, low, high) = self.whole(depth);
                if low >= *lo && high <= *hi {
                    text
                } else if self.caution == Caution::Risky && self.lot.one_in(8) {
                    self.faults += 1;
                    text
                } else {
                    format!("min(max({text}, {lo}), {hi})")
                }
            }
            Ty::Real => {
                self.faults += usize::from(self.caution == Caution::Risky);
                self.real(depth)
            }
            Ty::Time(_) => self.time(depth).0,
            Ty::Point => {
                self.faults += usize::from(self.caution == Caution::Risky);
                self.point(depth)
            }
            Ty::Enum(name) => self.member(name),
            Ty::Ref(name) => self.reference(name).unwrap_or_else(|| "self".into()),
        }
    }
}
