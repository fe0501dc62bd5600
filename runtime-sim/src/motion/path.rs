//! Paths of all joints together: straight lines from knot to knot, with rounded corners.
//!
//! The place on a path is one number from 0 to 1. On a line the joints change evenly with
//! it. Over a corner they follow a parabola that touches both lines, so that their change
//! with the place has no jump.

use super::profile::{Corner, Limit, Zone};
use crate::fingerprint::Fingerprint;
use crate::kinematics::arm::{Joints, Limits};

/// In the middle of a corner no joint is further than this from where both lines meet, m or rad, unless
/// the knot says otherwise.
pub const CORNER_NEAR: f64 = 0.05;
/// A line on which no joint goes farther than this is none, m or rad.
const NO_LINE: f64 = 1e-6;
/// A zone that is shorter than this is none.
const NO_ZONE: f64 = 1e-12;

/// Where a path passes, or ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Knot {
    pub joints: Joints,
    /// In the middle of its corner no joint is further from it than this, m or rad.
    pub near: f64,
}

impl Knot {
    pub fn new(joints: Joints) -> Self {
        Self { joints, near: CORNER_NEAR }
    }
}

#[derive(Clone, Debug, PartialEq)]
pub struct Path {
    /// Both ends, and where lines meet between them.
    knots: Vec<Joints>,
    /// Place of each knot.
    places: Vec<f64>,
    /// For each line the change of the joints with the place.
    rates: Vec<Joints>,
    /// For each knot half of the length of its corner.
    halves: Vec<f64>,
    fingerprint: Fingerprint,
}

/// A part of a path: a line, or a corner.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Section {
    /// Place at which it ends; it begins where the one before ends, or at 0.
    pub end: f64,
    /// The most that some sum over the joints changes for each unit of the place.
    pub rate: f64,
}

/// How far something goes at most along a path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Travel {
    sections: Vec<Section>,
    /// Up to the end of each of them.
    gone: Vec<f64>,
}

impl Travel {
    pub fn new(sections: Vec<Section>) -> Self {
        let mut sum = 0.0;
        let mut begin = 0.0;
        let gone = sections.iter().map(|section| {
            sum += (section.end - begin) * section.rate;
            begin = section.end;
            sum
        });
        let gone = gone.collect();
        Self { sections, gone }
    }

    /// From the beginning to a place.
    #[inline]
    pub fn to(&self, place: f64) -> f64 {
        self.within(self.section(place), place)
    }

    /// Number of the section in which a place is.
    #[inline]
    pub fn section(&self, place: f64) -> usize {
        self.sections.partition_point(|section| section.end < place)
    }

    /// As [`Self::to`], of a place in the section with this number.
    #[inline]
    pub fn within(&self, number: usize, place: f64) -> f64 {
        match self.sections.get(number) {
            Some(section) => self.gone[number] - (section.end - place) * section.rate,
            None => self.gone.last().copied().unwrap_or(0.0),
        }
    }

    /// Metres from the middle one of three places to either end at most; each is in the section with its number.
    #[inline]
    pub fn from_middle(&self, places: [f64; 3], sections: [usize; 3]) -> f64 {
        let gone = |i: usize| self.within(sections[i], places[i]);
        let (from, middle, to) = (gone(0), gone(1), gone(2));
        (middle - from).max(to - middle)
    }

    /// The place at which it has gone so much farther than at `place`, which is in the section with this number; 1 if it
    /// never does.
    pub fn after(&self, number: usize, place: f64, distance: f64) -> f64 {
        let sum = self.within(number, place) + distance;
        let ahead = number.min(self.gone.len());
        let reached = ahead + self.gone[ahead..].partition_point(|gone| *gone < sum);
        let Some(section) = self.sections.get(reached) else { return 1.0 };
        let at = section.end - (self.gone[reached] - sum) / section.rate.max(f64::MIN_POSITIVE);
        at.clamp(place, section.end)
    }
}

/// Where a place is on a path.
enum Position {
    /// On the line with this number.
    Line(usize),
    /// In the corner of the knot with this number.
    Corner(usize),
}

impl Path {
    /// Past all knots but the last, and to that. Each line's share of the place is its share of the time at full speed.
    ///
    /// A corner is as long as its knot and half of either line allow.
    pub fn new(from: Joints, knots: &[Knot], limits: &Limits) -> Self {
        let (knots, nears) = passed(from, knots);
        let numbers =
            knots.iter().flat_map(|joints| joints.iter()).chain(&nears).chain(limits.velocity.iter());
        let fingerprint = numbers.fold(Fingerprint::default(), |print, number| print.near(*number));
        let changes: Vec<Joints> = knots.windows(2).map(|pair| difference(&pair[1], &pair[0])).collect();
        let times: Vec<f64> = changes.iter().map(|change| 1.0 / least(&limits.velocity, change)).collect();
        let whole: f64 = times.iter().sum();
        if whole == 0.0 {
            let rates = changes.clone();
            return Self {
                halves: vec![0.0; knots.len()],
                knots,
                places: vec![0.0, 1.0],
                rates,
                fingerprint,
            };
        }
        let rates: Vec<Joints> = (changes.iter().zip(&times))
            .map(|(change, time)| change.map(|_, change| change * (whole / time)))
            .collect();
        let mut places = vec![0.0];
        let mut gone = 0.0;
        for time in &times {
            gone += time;
            places.push(gone / whole);
        }
        places[times.len()] = 1.0;
        let mut halves = vec![0.0; knots.len()];
        for (i, pair) in rates.windows(2).enumerate() {
            let change = difference(&pair[1], &pair[0]);
            let near = least(&change.map(|_, _| 8.0 * nears[i + 1]), &change);
            halves[i + 1] = near.min(places[i + 1] - places[i]).min(places[i + 2] - places[i + 1]) / 2.0;
        }
        Self { halves, knots, places, rates, fingerprint }
    }

    /// What is left of it at a place.
    pub fn rest(&self, place: f64, limits: &Limits) -> Self {
        let knots = self.knots.iter().zip(&self.places).filter(|(_, at)| **at > place);
        let knots: Vec<Knot> = knots.map(|(joints, _)| Knot::new(*joints)).collect();
        Self::new(self.at(place), &knots, limits)
    }

    /// Of the places of all joints along it.
    pub fn fingerprint(&self) -> Fingerprint {
        self.fingerprint
    }

    /// What the limits allow on each line and in each corner. No zone if no joint moves.
    pub fn zones(&self, limits: &Limits) -> Vec<Zone> {
        let last = self.rates.len() - 1;
        let top = |rates: &Joints| least(&limits.velocity, rates);
        let gain = |rates: &Joints| least(&limits.acceleration, rates);
        if !top(&self.rates[0]).is_finite() {
            return Vec::new();
        }
        let mut zones = Vec::with_capacity(2 * last + 1);
        for (line, rates) in self.rates.iter().enumerate() {
            let (end, half) = (self.places[line + 1], self.halves[line + 1]);
            zones.push(Zone { end: end - half, top: top(rates), limit: Limit::Straight(gain(rates)) });
            let Some(next) = self.rates.get(line + 1) else { break };
            let change = difference(next, rates);
            let most = &limits.acceleration;
            let joints = (0..change.len()).map(|i| [rates[i] / most[i], change[i] / (2.0 * half) / most[i]]);
            let corner =
                Corner { begin: end - half, joints: joints.filter(|joint| *joint != [0.0; 2]).collect() };
            zones.push(Zone {
                end: end + half,
                top: top(rates).min(top(next)),
                limit: Limit::Corner(corner),
            });
        }
        let mut begin = 0.0;
        zones.retain(|zone| {
            let is_zone = zone.end - begin > NO_ZONE;
            if is_zone {
                begin = zone.end;
            }
            is_zone
        });
        zones
    }

    /// Of a place beyond an end that of the end.
    fn position(&self, place: f64) -> Position {
        let place = place.clamp(0.0, 1.0);
        let after = self.places.partition_point(|knot| *knot <= place).clamp(1, self.rates.len());
        let line = after - 1;
        if place > self.places[after] - self.halves[after] {
            Position::Corner(after)
        } else if place < self.places[line] + self.halves[line] {
            Position::Corner(line)
        } else {
            Position::Line(line)
        }
    }

    /// Joints at a place; exact at both ends.
    pub fn at(&self, place: f64) -> Joints {
        let last = self.rates.len() - 1;
        if place <= 0.0 {
            return self.knots[0];
        }
        if place >= 1.0 {
            return self.knots[last + 1];
        }
        match self.position(place) {
            Position::Line(0) if last == 0 => {
                let [from, to] = [&self.knots[0], &self.knots[1]];
                from.map(|i, start| start + place * (to[i] - start))
            }
            Position::Line(line) if line == last => {
                self.knots[last + 1].map(|i, goal| goal - (1.0 - place) * self.rates[last][i])
            }
            Position::Line(line) => self.on_line(line, place),
            Position::Corner(knot) => {
                let (first, second) = (&self.rates[knot - 1], &self.rates[knot]);
                let half = self.halves[knot];
                let beyond = (place - (self.places[knot] - half)).max(0.0);
                let turned = beyond * beyond / (4.0 * half);
                self.on_line(knot - 1, place).map(|i, value| value + turned * (second[i] - first[i]))
            }
        }
    }

    fn on_line(&self, line: usize, place: f64) -> Joints {
        let passed = place - self.places[line];
        self.knots[line].map(|i, start| start + passed * self.rates[line][i])
    }

    /// Joints near a place as powers of the place: what to multiply its powers 0, 1 and 2 with.
    pub fn powers(&self, place: f64) -> Vec<[f64; 3]> {
        let line_of = |line: usize, i: usize| {
            let rate = self.rates[line][i];
            [self.knots[line][i] - self.places[line] * rate, rate, 0.0]
        };
        let joints = 0..self.knots[0].len();
        match self.position(place) {
            Position::Line(line) => joints.map(|i| line_of(line, i)).collect(),
            Position::Corner(knot) => {
                let (half, begin) = (self.halves[knot], self.places[knot] - self.halves[knot]);
                let bent = |i: usize| {
                    let [c0, c1, _] = line_of(knot - 1, i);
                    let turn = (self.rates[knot][i] - self.rates[knot - 1][i]) / (4.0 * half);
                    [c0 + turn * begin * begin, c1 - 2.0 * turn * begin, turn]
                };
                joints.map(bent).collect()
            }
        }
    }

    /// All lines and corners, with the most that the weighted sum of the joints' changes is.
    pub fn sections(&self, weights: &[f64]) -> Vec<Section> {
        let sum = |rates: &Joints| rates.iter().zip(weights).map(|(rate, weight)| rate.abs() * weight).sum();
        let sums: Vec<f64> = self.rates.iter().map(sum).collect();
        let mut sections = Vec::with_capacity(2 * sums.len());
        for (line, rate) in sums.iter().copied().enumerate() {
            let (end, half) = (self.places[line + 1], self.halves[line + 1]);
            sections.push(Section { end: end - half, rate });
            if let Some(next) = sums.get(line + 1) {
                sections.push(Section { end: end + half, rate: rate.max(*next) });
            }
        }
        sections
    }

    /// Of each knot.
    pub fn places(&self) -> &[f64] {
        &self.places
    }

    /// Of each knot half of the length of its corner.
    pub fn halves(&self) -> &[f64] {
        &self.halves
    }

    /// Both ends, and where lines meet.
    pub fn knots(&self) -> &[Joints] {
        &self.knots
    }

    pub fn goal(&self) -> Joints {
        self.knots[self.rates.len()]
    }
}

/// The knots of a path with its beginning, and how near it passes each of them; without lines that are none.
fn passed(from: Joints, knots: &[Knot]) -> (Vec<Joints>, Vec<f64>) {
    let mut all = vec![from];
    let mut nears = vec![0.0];
    let is_line =
        |from: &Joints, to: &Joints| difference(to, from).iter().any(|change| change.abs() > NO_LINE);
    for (i, Knot { joints, near }) in knots.iter().enumerate() {
        if i + 1 == knots.len() {
            // The end stays, whatever is before it.
            while all.len() > 1 && all.last().is_some_and(|last| !is_line(last, joints)) {
                all.pop();
                nears.pop();
            }
        } else if all.last().is_some_and(|last| !is_line(last, joints)) {
            continue;
        }
        all.push(*joints);
        nears.push(*near);
    }
    if all.len() == 1 {
        all.push(from);
        nears.push(0.0);
    }
    (all, nears)
}

fn difference(to: &Joints, from: &Joints) -> Joints {
    to.map(|i, value| value - from[i])
}

/// The least that a joint's limit is of its rate; infinite if no joint moves.
fn least(limits: &Joints, rates: &Joints) -> f64 {
    (rates.iter().map(|rate| rate.abs()).zip(limits.iter()))
        .filter(|(rate, _)| *rate > 0.0)
        .fold(f64::INFINITY, |least, (rate, limit)| least.min(limit / rate))
}
