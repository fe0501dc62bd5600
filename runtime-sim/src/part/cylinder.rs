//! What goes from one end to the other and back: cylinder, door, clamp, lift, turntable.

use super::settings::{Form, Setting, Settings};
use super::stroke::{Carriage, Stroke, Strokes};
use super::{Described, Level, Progress, Running, Schema, See, Signal, Start, World};
use crate::device::{Extent, PortType};
use crate::wiring::Drives;

pub const SCHEMA: Schema = Schema {
    signals: &[
        Signal { name: "is_in", ty: PortType::Bool, extent: Extent::One },
        Signal { name: "is_out", ty: PortType::Bool, extent: Extent::One },
    ],
    levels: &[
        Level { name: "extend", ty: PortType::Bool },
        Level { name: "retract", ty: PortType::Bool },
    ],
    can_jam: true,
    ..Schema::new(
        "cylinder",
        "Moves from one end to the other at a constant speed, with a switch at each end. With a valve only for `extend`, a spring brings it back. With a second valve for `retract`, it moves to the end of the valve that alone is on.",
        &[
            Setting::new("extend", Form::Positive, "ms", "from the inner end to the outer one"),
            Setting::new("retract", Form::Positive, "ms", "from the outer end to the inner one"),
            Setting::new(
                "closed_centre",
                Form::Truth,
                "",
                "with two valves, both or none of them on: it stops; without this setting it continues to its last end",
            )
            .optional(),
            Setting::new("slides", Form::Point, "m", "stroke from the inner end to the outer one, in the world").optional(),
            Setting::new("turns", Form::Number, "deg", "stroke as a turn to the left about the vertical, instead of `slides`").optional(),
            Setting::new("pivot", Form::Point, "m", "point about which it turns").optional(),
            Setting::new("begins_out", Form::Truth, "", "it starts at the outer end; without it at the inner one")
                .optional(),
        ],
    )
};

#[derive(Clone, Debug, PartialEq)]
pub struct Cylinder {
    pub extend_ms: u64,
    pub retract_ms: u64,
    pub has_closed_centre: bool,
    pub begins: End,
    /// None: nothing is on it.
    pub stroke: Option<Stroke>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum End {
    In,
    Out,
}

impl End {
    /// Number of the stop, and of the signal that tells that it is there.
    pub fn stop(self) -> usize {
        match self {
            End::In => 0,
            End::Out => 1,
        }
    }
}

impl Described for Cylinder {
    fn new(settings: &Settings) -> Result<Self, String> {
        let [extend_ms, retract_ms] = [settings.milliseconds("extend")?, settings.milliseconds("retract")?];
        if extend_ms == 0 || retract_ms == 0 {
            return Err("a cylinder takes at least a millisecond each way".into());
        }
        let begins_out = settings.optional("begins_out", Settings::truth)?.unwrap_or(false);
        let has_closed_centre = settings.optional("closed_centre", Settings::truth)?.unwrap_or(false);
        let begins = if begins_out { End::Out } else { End::In };
        Ok(Self { extend_ms, retract_ms, has_closed_centre, begins, stroke: Stroke::new(settings)? })
    }

    fn start(&self, start: &mut Start) -> Result<Option<Box<dyn Running>>, String> {
        let part = start.part;
        let mut outputs = start.machine().wiring.outputs.iter();
        let retracts = Drives::Level { part, level: RETRACT };
        let valves = if outputs.any(|output| output.drives == retracts) { Valves::Two } else { Valves::One };
        Ok(Some(Box::new(Working::new(self, valves))))
    }
}

impl Cylinder {
    /// It stops at [`End::stop`].
    pub fn strokes(&self) -> Strokes {
        Strokes { stroke: self.stroke, stops: vec![0.0, 1.0], begins: self.begins.stop() }
    }
}

/// Numbers of the levels.
const EXTEND: usize = 0;
const RETRACT: usize = 1;
/// What is earlier by less is rounding, ms.
const AT_ONCE: f64 = 1e-6;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Valves {
    /// `extend`; a spring retracts.
    One,
    Two,
}

/// A cylinder at work.
#[derive(Clone, Debug)]
pub struct Working {
    cylinder: Cylinder,
    valves: Valves,
    /// What the levels say.
    extend: bool,
    retract: bool,
    /// Where the valves sent it last.
    sent_to: End,
    held: bool,
    toward: End,
    drive: Drive,
    /// Part of the stroke that was left to where it goes, 0 to 1, when it began to move or to stand.
    left: f64,
    since_ms: u64,
    now_ms: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Drive {
    Moves,
    Stands,
}

impl Working {
    pub fn new(cylinder: &Cylinder, valves: Valves) -> Self {
        Self {
            cylinder: cylinder.clone(),
            valves,
            extend: cylinder.begins == End::Out,
            retract: cylinder.begins == End::In,
            sent_to: cylinder.begins,
            held: false,
            toward: cylinder.begins,
            drive: Drive::Moves,
            left: 0.0,
            since_ms: 0,
            now_ms: 0,
        }
    }

    /// Where the valves send it, and whether it moves.
    fn sent(&self) -> (End, Drive) {
        match self.valve() {
            _ if self.held => (self.toward, Drive::Stands),
            Some(end) => (end, Drive::Moves),
            None if self.cylinder.has_closed_centre => (self.toward, Drive::Stands),
            None => (self.sent_to, Drive::Moves),
        }
    }

    /// The end of the valve that alone is on; of a single valve that of the spring, if it is off.
    fn valve(&self) -> Option<End> {
        match (self.valves, self.extend, self.retract) {
            (Valves::One, true, _) | (Valves::Two, true, false) => Some(End::Out),
            (Valves::One, false, _) | (Valves::Two, false, true) => Some(End::In),
            (Valves::Two, ..) => None,
        }
    }

    /// When it comes to the end, ms.
    fn arrives_ms(&self) -> f64 {
        let whole_ms = match self.toward {
            End::In => self.cylinder.retract_ms,
            End::Out => self.cylinder.extend_ms,
        };
        self.since_ms as f64 + self.left * whole_ms as f64
    }

    /// Part of the stroke that is left at this time.
    fn left(&self, now_ms: u64) -> f64 {
        let whole_ms = self.arrives_ms() - self.since_ms as f64;
        let gone_ms = (now_ms - self.since_ms) as f64;
        match self.drive {
            Drive::Moves if gone_ms >= whole_ms - AT_ONCE => 0.0,
            Drive::Moves => self.left * (1.0 - gone_ms / whole_ms),
            Drive::Stands => self.left,
        }
    }

    fn turn(&mut self, now_ms: u64) {
        self.sent_to = self.valve().unwrap_or(self.sent_to);
        let (toward, drive) = self.sent();
        if (toward, drive) == (self.toward, self.drive) {
            return;
        }
        let left = self.left(now_ms);
        self.left = if toward == self.toward { left } else { 1.0 - left };
        (self.toward, self.drive, self.since_ms) = (toward, drive, now_ms);
    }

    fn is_at(&self, end: End) -> bool {
        self.toward == end && self.left(self.now_ms) <= 0.0
    }
}

impl Carriage for Working {
    fn stroke(&self) -> Option<Stroke> {
        self.cylinder.stroke
    }

    fn going(&self, now_ms: u64) -> [f64; 3] {
        let mut sent = self.clone();
        sent.turn(now_ms);
        let left = sent.left(now_ms);
        let moves = sent.drive == Drive::Moves && left > 0.0;
        let (out, way_ms, end) = match sent.toward {
            End::Out => (1.0 - left, self.cylinder.extend_ms as f64, 1.0),
            End::In => (left, -(self.cylinder.retract_ms as f64), 0.0),
        };
        if moves { [out, 1000.0 / way_ms, end] } else { [out, 0.0, out] }
    }

    fn is_at_from(&self, stop: usize, now_ms: u64) -> f64 {
        let mut sent = self.clone();
        sent.turn(now_ms);
        match (sent.toward.stop() == stop, sent.drive) {
            (false, _) => f64::INFINITY,
            (true, Drive::Stands) if sent.left > 0.0 => f64::INFINITY,
            (true, _) => sent.arrives_ms(),
        }
    }

    fn now_ms(&self) -> u64 {
        self.now_ms
    }
}

impl Running for Working {
    fn boxed(&self) -> Box<dyn Running> {
        Box::new(self.clone())
    }

    fn hold(&mut self, held: bool, _now_ms: u64) {
        self.held = held;
    }

    fn level(&mut self, level: usize, value: &[f64]) {
        let is_on = value[0] != 0.0;
        match level {
            EXTEND => self.extend = is_on,
            _ => self.retract = is_on,
        }
    }

    fn advance(&mut self, world: &mut World) -> Progress {
        self.turn(world.now_ms);
        self.now_ms = world.next_ms();
        Progress::Going
    }

    /// It leaves an end, or comes to one.
    fn next_change(&self, _see: &See, now_ms: u64) -> f64 {
        if self.sent() != (self.toward, self.drive) {
            return now_ms as f64;
        }
        if self.drive == Drive::Stands || self.is_at(self.toward) { f64::INFINITY } else { self.arrives_ms() }
    }

    fn is_busy(&self, see: &See) -> bool {
        self.next_change(see, self.now_ms).is_finite()
    }

    fn carriage(&self) -> Option<&dyn Carriage> {
        Some(self)
    }

    fn signal(&self, signal: usize, _see: &See, out: &mut [f64]) {
        let end = if signal == 0 { End::In } else { End::Out };
        out[0] = f64::from(u8::from(self.is_at(end)));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Whether each end is reported after so many ms, in steps of 10 ms; `valves` gives both levels at the start of each.
    fn ends(
        valves: Valves,
        has_closed_centre: bool,
        steps: u64,
        levels: impl Fn(u64) -> [bool; 2],
    ) -> Vec<[bool; 2]> {
        let cylinder =
            Cylinder { extend_ms: 40, retract_ms: 20, has_closed_centre, begins: End::In, stroke: None };
        let mut working = Working::new(&cylinder, valves);
        let step = |step: u64| {
            let [extend, retract] = levels(step * 10);
            working.level(EXTEND, &[f64::from(u8::from(extend))]);
            working.level(RETRACT, &[f64::from(u8::from(retract))]);
            working.turn(step * 10);
            working.now_ms = (step + 1) * 10;
            [working.is_at(End::In), working.is_at(End::Out)]
        };
        (0..steps).map(step).collect()
    }

    const IN: [bool; 2] = [true, false];
    const OUT: [bool; 2] = [false, true];
    const BETWEEN: [bool; 2] = [false, false];

    #[test]
    fn a_spring_brings_it_back() {
        let found = ends(Valves::One, false, 9, |ms| [(10..60).contains(&ms), true]);
        assert_eq!(found, [IN, BETWEEN, BETWEEN, BETWEEN, OUT, OUT, BETWEEN, IN, IN]);
    }

    #[test]
    fn it_turns_where_it_is() {
        // Half of the way out takes half of the way in.
        let found = ends(Valves::One, false, 4, |ms| [ms < 20, false]);
        assert_eq!(found, [BETWEEN, BETWEEN, IN, IN]);
    }

    #[test]
    fn with_two_valves_it_goes_on_to_where_it_was_sent_last() {
        let found = ends(Valves::Two, false, 8, |ms| match ms {
            0 => [true, false],
            50 => [true, true],
            60 => [false, true],
            _ => [false, false],
        });
        assert_eq!(found, [BETWEEN, BETWEEN, BETWEEN, OUT, OUT, OUT, BETWEEN, IN]);
    }

    #[test]
    fn with_a_closed_centre_it_stands_between_the_ends() {
        let found = ends(Valves::Two, true, 9, |ms| match ms {
            0..20 => [true, false],
            20..50 => [false, false],
            50..60 => [true, true],
            _ => [false, true],
        });
        // Two of four tenths out, then half of the way in.
        assert_eq!(
            found,
            [BETWEEN, BETWEEN, BETWEEN, BETWEEN, BETWEEN, BETWEEN, IN, IN, IN]
        );
    }
}
