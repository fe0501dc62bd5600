//! Values of expressions, as `docs/semantics.md` says.

use crate::program::{After, Domain, Each, Int, Operator, PointValue, Real};
use crate::scan::Scan;
use crate::value::{Point, Values};

impl Scan<'_> {
    pub(crate) fn holds(&mut self, condition: &Int) -> bool {
        self.int(condition) != 0
    }

    pub(crate) fn int(&mut self, expr: &Int) -> i32 {
        match expr {
            Int::Constant(value) => *value,
            Int::Load(var, low) => self.load(*var) + low,
            Int::Element(elements, index) => {
                let index = self.int(index) as usize;
                self.load(elements.vars[index]) + elements.low
            }
            Int::Variable(variable) => self.variables[*variable],
            Int::Table(table, index) => table[self.int(index) as usize],
            Int::Input(input) => self.input(*input),
            Int::InputElement(inputs, index) => {
                let index = self.int(index) as usize;
                self.input(inputs[index])
            }
            Int::AtStop(machine) => self.at_stop(*machine),
            Int::After(after) => i32::from(self.has_passed(after)),
            Int::Shared(expr) => self.int(expr),
            Int::Not(a) => i32::from(!self.holds(a)),
            Int::Negate(a) => self.int(a).wrapping_neg(),
            Int::Absolute(a) => self.int(a).wrapping_abs(),
            Int::Binary(operator, pair) => {
                let (a, b) = (self.int(&pair[0]), self.int(&pair[1]));
                arithmetic(*operator, a, b)
            }
            Int::And(all) => i32::from(all.iter().all(|part| self.holds(part))),
            Int::Or(all) => i32::from(all.iter().any(|part| self.holds(part))),
            Int::Total(all) => all.iter().fold(0, |sum, part| sum.wrapping_add(self.int(part))),
            Int::Min(pair) => self.int(&pair[0]).min(self.int(&pair[1])),
            Int::Max(pair) => self.int(&pair[0]).max(self.int(&pair[1])),
            Int::CompareReals(operator, pair) => {
                let (a, b) = (self.real(&pair[0]), self.real(&pair[1]));
                i32::from(match operator {
                    Operator::Equal => a == b,
                    Operator::NotEqual => a != b,
                    Operator::Less => a < b,
                    Operator::LessEqual => a <= b,
                    Operator::Greater => a > b,
                    _ => a >= b,
                })
            }
            Int::ComparePoints(operator, pair) => {
                let (a, b) = (self.point(&pair[0]), self.point(&pair[1]));
                i32::from((a == b) == (*operator == Operator::Equal))
            }
            Int::OneOf(members, value) => {
                let value = self.int(value);
                i32::from(members.contains(&value))
            }
            Int::Exists(each) => i32::from(self.any(each, 1)),
            Int::ForAll(each) => i32::from(!self.any(each, 0)),
            Int::Count(each) => {
                let mut count = 0;
                self.each(each, |scan, body| count += i32::from(scan.holds(body)));
                count
            }
            Int::Sum(each) => {
                let mut sum = 0_i32;
                self.each(each, |scan, body| sum = sum.wrapping_add(scan.int(body)));
                sum
            }
        }
    }

    /// Whether a time has passed is chosen where it is first asked, between those that have passed and those that have not.
    fn has_passed(&mut self, After { instance, time }: &After) -> bool {
        self.decisions.end_record();
        let model = self.model;
        let program = &model.instances[*instance];
        let Some(elapsed) = program.elapsed else { return false };
        let scans = self.int(time).max(0).unsigned_abs().div_ceil(model.scan_ms) as i32;
        let times = &program.states[program.state.load(self.bytes) as usize].times;
        let come = program.times_come.map_or(0, |come| come.load(self.bytes)) as usize;
        // The first test of a state is one scan after its entry.
        let passed = times[..come].last().copied().unwrap_or(1).max(elapsed.load(self.bytes));
        let not_passed = times.get(come).copied().unwrap_or(i32::MAX).min(self.not_passed);
        if scans <= passed || scans >= not_passed {
            return scans <= passed;
        }
        let has_passed = self.choices.take(2) == 1;
        if has_passed {
            elapsed.store(self.bytes, scans);
        } else {
            self.not_passed = scans;
        }
        has_passed
    }

    /// Whether the body is so for one of the values; they are tried until one is found.
    fn any(&mut self, each: &Each<Int>, wanted: i32) -> bool {
        let mut found = false;
        self.values_of(&each.domain, |scan, value| {
            scan.variables[each.variable] = value;
            found = i32::from(scan.holds(&each.body)) == wanted;
            found
        });
        found
    }

    fn each<T>(&mut self, each: &Each<T>, mut work: impl FnMut(&mut Self, &T)) {
        self.values_of(&each.domain, |scan, value| {
            scan.variables[each.variable] = value;
            work(scan, &each.body);
            false
        });
    }

    /// The values of a domain in order, until `work` says that it is enough.
    pub(crate) fn values_of(&mut self, domain: &Domain, mut work: impl FnMut(&mut Self, i32) -> bool) {
        match domain {
            Domain::List(values) => {
                for value in values.iter() {
                    if work(self, *value) {
                        return;
                    }
                }
            }
            Domain::Range(ends) => {
                let (low, high) = (self.int(&ends[0]), self.int(&ends[1]));
                for value in low..=high {
                    if work(self, value) {
                        return;
                    }
                }
            }
        }
    }

    pub(crate) fn real(&mut self, expr: &Real) -> f64 {
        match expr {
            Real::Constant(value) => *value,
            Real::Load(var) => {
                let number = self.load(*var);
                self.values.real(number)
            }
            Real::Element(vars, index) => {
                let index = self.int(index) as usize;
                let number = self.load(vars[index]);
                self.values.real(number)
            }
            Real::Table(table, index) => table[self.int(index) as usize],
            Real::OfInt(a) => f64::from(self.int(a)),
            Real::Negate(a) => -self.real(a),
            Real::Absolute(a) => self.real(a).abs(),
            Real::Binary(operator, pair) => {
                let (a, b) = (self.real(&pair[0]), self.real(&pair[1]));
                match operator {
                    Operator::Add => a + b,
                    Operator::Subtract => a - b,
                    Operator::Multiply => a * b,
                    _ => a / b,
                }
            }
            Real::Min(pair) => {
                let (a, b) = (self.real(&pair[0]), self.real(&pair[1]));
                if b < a { b } else { a }
            }
            Real::Max(pair) => {
                let (a, b) = (self.real(&pair[0]), self.real(&pair[1]));
                if a < b { b } else { a }
            }
            Real::Coordinate(point, axis) => self.point(point)[*axis],
            Real::SquaredDistance(pair) => {
                let (p, q) = (self.point(&pair[0]), self.point(&pair[1]));
                let (dx, dy, dz) = (p[0] - q[0], p[1] - q[1], p[2] - q[2]);
                dx * dx + dy * dy + dz * dz
            }
            Real::Sum(each) => {
                let mut sum = 0.0;
                self.each(each, |scan, body| sum += scan.real(body));
                sum
            }
        }
    }

    pub(crate) fn point(&mut self, expr: &PointValue) -> Point {
        match expr {
            PointValue::Constant(point) => *point,
            PointValue::Load(var) => {
                let number = self.load(*var);
                if number == Values::NOWHERE {
                    self.decisions.end_record();
                    self.ask_start_at(*var);
                }
                self.values.point(number)
            }
            PointValue::Position(machine) => self.position(*machine),
            PointValue::Element(vars, index) => {
                let index = self.int(index) as usize;
                let number = self.load(vars[index]);
                self.values.point(number)
            }
            PointValue::Table(table, index) => table[self.int(index) as usize],
            PointValue::Make(parts) => [self.real(&parts[0]), self.real(&parts[1]), self.real(&parts[2])],
            PointValue::Add(pair) => {
                let (p, q) = (self.point(&pair[0]), self.point(&pair[1]));
                [p[0] + q[0], p[1] + q[1], p[2] + q[2]]
            }
            PointValue::Subtract(pair) => {
                let (p, q) = (self.point(&pair[0]), self.point(&pair[1]));
                [p[0] - q[0], p[1] - q[1], p[2] - q[2]]
            }
        }
    }
}

fn arithmetic(operator: Operator, a: i32, b: i32) -> i32 {
    match operator {
        Operator::Equal => i32::from(a == b),
        Operator::NotEqual => i32::from(a != b),
        Operator::Less => i32::from(a < b),
        Operator::LessEqual => i32::from(a <= b),
        Operator::Greater => i32::from(a > b),
        Operator::GreaterEqual => i32::from(a >= b),
        Operator::Add => a.wrapping_add(b),
        Operator::Subtract => a.wrapping_sub(b),
        Operator::Multiply => a.wrapping_mul(b),
        // A divisor of 0 is refused by the checker.
        Operator::Divide => a.checked_div(b).unwrap_or(0),
        Operator::Modulo => a.checked_rem(b).unwrap_or(0),
    }
}
