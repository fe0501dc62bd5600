//! A positioned drive: a lift, a turntable, a transfer carriage.

use super::settings::{Form, Setting, Settings};
use super::stroke::{Carriage, Stroke, Strokes};
use super::{Action, Begun, Described, Progress, Running, Schema, See, Signal, Start, World};
use crate::device::{Extent, PortType, error};
use crate::plant::EARLY_MS;

pub const SCHEMA: Schema = Schema {
    can_jam: true,
    signals: &[
        Signal { name: "place", ty: PortType::Int { lo: -1, hi: 31 }, extent: Extent::One },
        Signal { name: "stands", ty: PortType::Bool, extent: Extent::One },
    ],
    actions: &[
        Action { name: "to", arguments: &[PortType::Int { lo: 0, hi: 31 }] },
        Action { name: "halt", arguments: &[] },
    ],
    ..Schema::new(
        "positioner",
        "A drive with positions: a lift, a turntable, a transfer carriage. It moves at a constant speed to the position of the command. `place` is the number of the position at which it is at rest, else -1.",
        &[
            Setting::new("positions", Form::Numbers, "m or deg", "from 0 to the end of the stroke, in any order; at most 32"),
            Setting::new("slides", Form::Point, "m", "stroke from 0 to its end, in the world").optional(),
            Setting::new("turns", Form::Number, "deg", "stroke as a turn to the left about the vertical, instead of `slides`").optional(),
            Setting::new("pivot", Form::Point, "m", "point about which it turns").optional(),
            Setting::new("speed", Form::Positive, "m/s or deg/s", "the speed changes in steps"),
            Setting::new("begins", Form::Number, "", "number of the position at the start; without it 0").optional(),
        ],
    )
};

const MOST: usize = 32;

#[derive(Clone, Debug, PartialEq)]
pub struct Positioner {
    pub stroke: Stroke,
    /// Parts of the stroke.
    pub positions: Vec<f64>,
    /// Parts of the stroke per second.
    pub rate: f64,
    /// Number of the position.
    pub begins: usize,
}

impl Described for Positioner {
    fn new(settings: &Settings) -> Result<Self, String> {
        let stroke = Stroke::new(settings)?.ok_or("a positioner slides, or turns about a pivot")?;
        let length = match stroke {
            Stroke::Slides(far) => far.length(),
            Stroke::Turns { degrees, .. } => degrees.abs(),
        };
        if length <= 0.0 {
            return Err("the stroke of a positioner is not over 0".into());
        }
        let positions = settings.numbers("positions")?;
        if positions.is_empty() || positions.len() > MOST {
            return Err(format!("a positioner has 1 to {MOST} positions"));
        }
        if let Some(wrong) = positions.iter().find(|position| !(0.0..=length).contains(*position)) {
            return Err(format!("the position {wrong} is not within the stroke, 0 to {length}"));
        }
        let is_twice = |(i, position): (usize, &f64)| positions[..i].contains(position);
        if positions.iter().enumerate().any(is_twice) {
            return Err("two positions are the same".into());
        }
        let begins = settings.optional("begins", Settings::number)?.unwrap_or(0.0);
        if begins.fract() != 0.0 || !(0.0..positions.len() as f64).contains(&begins) {
            return Err(format!("the setting begins is no number of a position, 0 to {}", positions.len() - 1));
        }
        Ok(Self {
            stroke,
            positions: positions.iter().map(|position| position / length).collect(),
            rate: settings.positive("speed")? / length,
            begins: begins as usize,
        })
    }

    fn start(&self, _start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        Ok(Some(Box::new(Positioning::new(self))))
    }
}

impl Positioner {
    pub fn strokes(&self) -> Strokes {
        Strokes { stroke: Some(self.stroke), stops: self.positions.clone(), begins: self.begins }
    }
}

/// A positioner at work.
#[derive(Clone, Debug)]
pub struct Positioning {
    positioner: Positioner,
    /// Where it was when it began to move or to stand, a part of the stroke, and when.
    from: f64,
    since_ms: u64,
    drive: Drive,
    now_ms: u64,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum Drive {
    Rests,
    /// To the position of this number.
    Moves(usize),
    /// On its way there.
    Held(usize),
}

impl Positioning {
    pub fn new(positioner: &Positioner) -> Self {
        let from = positioner.positions[positioner.begins];
        Self { positioner: positioner.clone(), from, since_ms: 0, drive: Drive::Rests, now_ms: 0 }
    }

    /// When it comes to its goal, ms; infinity if it does not move.
    fn arrives_ms(&self) -> f64 {
        match self.drive {
            Drive::Rests | Drive::Held(_) => f64::INFINITY,
            Drive::Moves(goal) => {
                let left = (self.positioner.positions[goal] - self.from).abs();
                self.since_ms as f64 + 1000.0 * left / self.positioner.rate
            }
        }
    }

    fn has_arrived(&self, now_ms: u64) -> bool {
        now_ms as f64 + EARLY_MS >= self.arrives_ms()
    }

    /// Part of the stroke.
    fn out(&self, now_ms: u64) -> f64 {
        match self.drive {
            Drive::Rests | Drive::Held(_) => self.from,
            Drive::Moves(goal) => {
                let goal = self.positioner.positions[goal];
                if self.has_arrived(now_ms) {
                    return goal;
                }
                let gone = self.positioner.rate * (now_ms - self.since_ms) as f64 / 1000.0;
                self.from + gone.copysign(goal - self.from)
            }
        }
    }

    fn set(&mut self, drive: Drive, now_ms: u64) {
        self.from = self.out(now_ms);
        (self.drive, self.since_ms) = (drive, now_ms);
    }

    /// At which it is at rest.
    fn place(&self) -> Option<usize> {
        let is_here = |position: &f64| *position == self.from;
        match self.drive {
            Drive::Rests | Drive::Held(_) => self.positioner.positions.iter().position(is_here),
            Drive::Moves(_) => None,
        }
    }
}

/// Number of the action.
const TO: usize = 0;

impl Running for Positioning {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn begin(&mut self, action: usize, arguments: &[f64], world: &mut World) -> Result<Begun, i32> {
        if action != TO {
            self.set(Drive::Rests, world.now_ms);
            return Ok(Begun::Ended);
        }
        let &[goal] = arguments else { return Err(error::REFUSED) };
        let goal = goal as usize;
        if goal >= self.positioner.positions.len() {
            return Err(error::UNREACHABLE);
        }
        self.set(Drive::Moves(goal), world.now_ms);
        Ok(Begun::UnderWay)
    }

    fn abandon(&mut self, now_ms: u64) {
        self.set(Drive::Rests, now_ms);
    }

    fn hold(&mut self, held: bool, now_ms: u64) {
        match self.drive {
            Drive::Moves(goal) if held => self.set(Drive::Held(goal), now_ms),
            Drive::Held(goal) if !held => self.set(Drive::Moves(goal), now_ms),
            _ => {}
        }
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        self.now_ms = world.next_ms();
        match self.drive {
            Drive::Rests => Progress::Reached,
            Drive::Moves(goal) if self.has_arrived(self.now_ms) => {
                self.from = self.positioner.positions[goal];
                (self.drive, self.since_ms) = (Drive::Rests, self.now_ms);
                Progress::Reached
            }
            Drive::Moves(_) | Drive::Held(_) => Progress::Going,
        }
    }

    fn next_change(&self, _see: &See, _now_ms: u64) -> f64 {
        self.arrives_ms()
    }

    fn is_busy(&self, _see: &See) -> bool {
        matches!(self.drive, Drive::Moves(_))
    }

    fn carriage(&self) -> Option<&dyn Carriage> {
        Some(self)
    }

    fn signal(&self, signal: usize, _see: &See, out: &mut [f64]) {
        out[0] = match signal {
            0 => self.place().map_or(-1.0, |place| place as f64),
            _ => f64::from(u8::from(!matches!(self.drive, Drive::Moves(_)))),
        };
    }
}

impl Carriage for Positioning {
    fn stroke(&self) -> Option<Stroke> {
        Some(self.positioner.stroke)
    }

    fn going(&self, now_ms: u64) -> [f64; 3] {
        let out = self.out(now_ms);
        match self.drive {
            Drive::Moves(goal) if !self.has_arrived(now_ms) => {
                let until = self.positioner.positions[goal];
                [out, self.positioner.rate.copysign(until - out), until]
            }
            _ => [out, 0.0, out],
        }
    }

    fn is_at_from(&self, stop: usize, _now_ms: u64) -> f64 {
        let is_here = self.positioner.positions.get(stop) == Some(&self.from);
        match self.drive {
            Drive::Moves(goal) if goal == stop => self.arrives_ms(),
            Drive::Rests | Drive::Held(_) if is_here => self.since_ms as f64,
            _ => f64::INFINITY,
        }
    }

    fn now_ms(&self) -> u64 {
        self.now_ms
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn on_its_way(drive: Drive) -> Positioning {
        let stroke = Stroke::Slides(crate::point::Point::new(1.5, 0.0, 0.0));
        let positions = vec![0.0, 1.05 / 1.5, 1.0];
        let positioner = Positioner { stroke, positions, rate: 0.35 / 1.5, begins: 0 };
        Positioning { drive, ..Positioning::new(&positioner) }
    }

    #[test]
    fn three_seconds_are_not_longer_by_rounding() {
        assert!(!on_its_way(Drive::Moves(1)).has_arrived(2999));
        assert!(on_its_way(Drive::Moves(1)).has_arrived(3000));
    }

    #[test]
    fn one_that_jams_before_it_moves_is_where_it_is() {
        assert_eq!(on_its_way(Drive::Held(2)).place(), Some(0));
        assert_eq!(Positioning { from: 0.1, ..on_its_way(Drive::Held(2)) }.place(), None);
    }
}
