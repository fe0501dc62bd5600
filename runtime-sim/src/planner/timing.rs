//! When tool and torso move on a path over obstacles.

use super::Turning;
use crate::kinematics::arm::Limits;
use crate::kinematics::gantry::Stance;
use std::sync::Arc;

/// Up, over and down, each from rest to rest and as much at once as is allowed. The times are a proposal: the limits of
/// all joints are kept by the motion along the path that comes of it.
#[derive(Clone, Debug)]
pub struct Timing {
    rise: Arc<Lift>,
    fall: Arc<Lift>,
    over: Trapezoid,
    turn: Trapezoid,
    fall_begin: f64,
    /// When all of it is over, s.
    pub end: f64,
}

/// How the tool goes straight up from rest to rest.
#[derive(Clone, Debug, PartialEq)]
pub struct Lift {
    /// Heights of the tool every [`TICK`] seconds, m.
    heights: Vec<f64>,
}

/// Seconds between two heights.
const TICK: f64 = 0.1;

impl Lift {
    /// From the height of the tool at a time up to the end.
    pub fn new(end: f64, height: impl Fn(f64) -> f64) -> Self {
        let count = (end / TICK).ceil() as u32;
        Self { heights: (0..=count).map(|i| height((f64::from(i) * TICK).min(end))).collect() }
    }

    fn duration(&self) -> f64 {
        (self.heights.len() - 1) as f64 * TICK
    }

    fn top(&self) -> f64 {
        self.heights.last().copied().unwrap_or(0.0)
    }

    fn at(&self, time: f64) -> f64 {
        let ticks = (time / TICK).clamp(0.0, (self.heights.len() - 1) as f64);
        let before = ticks as usize;
        let low = self.heights[before];
        let high = self.heights.get(before + 1).copied().unwrap_or(low);
        low + (high - low) * (ticks - before as f64)
    }

    /// When the tool is so far over the place, or at the top.
    fn time_over(&self, clear: f64) -> f64 {
        let height = self.heights[0] + clear;
        self.heights.iter().position(|h| *h >= height).map_or(self.duration(), |tick| tick as f64 * TICK)
    }
}

/// From 0 to 1: speed is gained, kept and lost.
#[derive(Clone, Copy, Debug)]
struct Trapezoid {
    begin: f64,
    duration: f64,
    /// Part of the duration in which speed is gained, and lost.
    ramp: f64,
}

/// The arm moves the tool out and in so far for each radian of its elbow, m.
const OUT: f64 = 0.5;
/// Joints of a rail, of the torso, and of the arm.
const RAIL: usize = 0;
const TORSO: usize = 2;
const ELBOW: usize = 4;

impl Trapezoid {
    /// Of a distance that is not negative.
    fn new(distance: f64, speed: f64, acceleration: f64) -> Self {
        let full = speed * speed / acceleration;
        let (duration, ramp) = if distance <= 0.0 {
            (0.0, 0.0)
        } else if distance < full {
            (2.0 * (distance / acceleration).sqrt(), 0.5)
        } else {
            let duration = distance / speed + speed / acceleration;
            (duration, speed / acceleration / duration)
        };
        Self { begin: 0.0, duration, ramp }
    }

    fn end(&self) -> f64 {
        self.begin + self.duration
    }

    /// At a time.
    fn at(&self, time: f64) -> f64 {
        let t = if self.duration > 0.0 { (time - self.begin) / self.duration } else { 1.0 };
        let top = 1.0 / (1.0 - self.ramp);
        match t {
            _ if t <= 0.0 => 0.0,
            _ if t >= 1.0 => 1.0,
            _ if t < self.ramp => top * t * t / (2.0 * self.ramp),
            _ if t > 1.0 - self.ramp => 1.0 - top * (1.0 - t) * (1.0 - t) / (2.0 * self.ramp),
            _ => top * (t - self.ramp / 2.0),
        }
    }
}

impl Timing {
    /// `length` is that of the torso's line, m. The torso moves while the tool is `clear` over both ends or more, or at the top if that is lower.
    pub fn new(
        length: f64,
        [first, last]: [&Stance; 2],
        [rise, fall]: [&Arc<Lift>; 2],
        clear: f64,
        turning: Turning,
        limits: &Limits,
    ) -> Self {
        let (speed, acceleration) = (&limits.velocity, &limits.acceleration);
        let lifted = rise.time_over(clear);
        let mut over = Trapezoid::new(length, speed[RAIL], acceleration[RAIL]);
        let mut turn = Trapezoid::new((last.turn - first.turn).abs(), speed[TORSO], acceleration[TORSO]);
        let out =
            Trapezoid::new((last.beyond - first.beyond).abs(), OUT * speed[ELBOW], OUT * acceleration[ELBOW]);
        if out.duration > over.duration {
            over = out;
        }
        match turning {
            Turning::Evenly => {
                let longer = if turn.duration > over.duration { turn } else { over };
                (turn, over) = (longer, longer);
                (turn.begin, over.begin) = (lifted, lifted);
            }
            Turning::First => (turn.begin, over.begin) = (lifted, lifted + turn.duration),
            Turning::Last => (over.begin, turn.begin) = (lifted, lifted + over.duration),
        }
        let arrived = over.end().max(turn.end());
        // The tool is still so high when the torso arrives, and does not go down before it is up.
        let fall_begin = (arrived - (fall.duration() - fall.time_over(clear))).max(rise.duration());
        let end = arrived.max(fall_begin + fall.duration());
        Self { rise: rise.clone(), fall: fall.clone(), over, turn, fall_begin, end }
    }

    /// Part of the line that the torso has gone, part of its turn, and height of the tool, m.
    pub fn at(&self, time: f64) -> (f64, f64, f64) {
        let left = self.fall_begin + self.fall.duration() - time;
        let height = self.rise.at(time) + self.fall.at(left) - self.fall.top();
        (self.over.at(time), self.turn.at(time), height)
    }

    /// How far joints have gone that go from rest to rest while the torso moves, from 0 to 1.
    pub fn passed(&self, time: f64) -> f64 {
        let begin = self.over.begin.min(self.turn.begin);
        let duration = self.over.end().max(self.turn.end()) - begin;
        Trapezoid { begin, duration, ramp: 0.5 }.at(time)
    }
}

#[cfg(test)]
mod tests {
    use super::super::{CLEARS, TURNINGS};
    use super::*;
    use crate::kinematics::arm::{Joints, MOST_JOINTS};
    use crate::kinematics::gantry::Wrist;
    use crate::kinematics::random::Random;

    #[test]
    fn no_path_of_a_trip_takes_less_than_the_first() {
        let mut random = Random::new(3);
        for _ in 0..1000 {
            let mut drawn = |low: f64, high: f64| random.between(low, high);
            let limits = [0.5, 2.0].map(|most| Joints::new(&[drawn(0.1, most); MOST_JOINTS]));
            let limits = Limits { velocity: limits[0], acceleration: limits[1] };
            let mut stance =
                || Stance { turn: drawn(-3.0, 3.0), beyond: drawn(0.0, 0.6), wrist: Wrist::Inside };
            let stances = [stance(), stance()];
            let mut lift = || {
                let (end, speed) = (drawn(0.0, 5.0), drawn(0.05, 0.5));
                Arc::new(Lift::new(end, |time| speed * time))
            };
            let (lifts, length) = ([lift(), lift()], drawn(0.0, 8.0));
            let end = |turning: Turning, clear: f64| {
                let [first, last] = &stances;
                let [rise, fall] = &lifts;
                Timing::new(length, [first, last], [rise, fall], clear, turning, &limits).end
            };
            let first = end(TURNINGS[0], CLEARS[0]);
            for (turning, clear) in TURNINGS.iter().flat_map(|t| CLEARS.map(|clear| (*t, clear))) {
                assert!(first * (1.0 - 1e-12) <= end(turning, clear), "{length} {clear}");
            }
        }
    }
}
