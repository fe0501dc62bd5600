//! Motion of all joints together, along a straight line between two sets of joints.
//!
//! The place on the line is one number from 0 to 1. It gains speed, keeps it and
//! loses it again, as fast as the slowest joint allows:
//! `top` = min v/way, `gain` = min a/way over the joints; an undisturbed motion takes
//! 1/top + top/gain if top^2 >= gain, otherwise 2/sqrt(gain).

use crate::kinematics::arm::{Joints, Limits};

/// A motion that may be held on its line and go on. Times are seconds on any one clock.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    from: Joints,
    to: Joints,
    top: f64,
    gain: f64,
    drive: Drive,
    /// What the motion does from `since` on, one phase after the other; then it rests at `rest`.
    phases: [Phase; 3],
    since: f64,
    rest: f64,
}

/// A part of a motion in which each joint is a polynomial of the seconds since `begin_s`.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    pub begin_s: f64,
    pub end_s: f64,
    /// For each joint the coefficients of the powers of time, from the zeroth on.
    pub joints: Vec<Vec<f64>>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Drive {
    On,
    Held,
}

/// A time with one acceleration.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct Phase {
    duration: f64,
    place: f64,
    speed: f64,
    acceleration: f64,
}

impl Phase {
    fn place_after(&self, t: f64) -> f64 {
        self.place + (self.speed + self.acceleration * t / 2.0) * t
    }

    fn speed_after(&self, t: f64) -> f64 {
        self.speed + self.acceleration * t
    }
}

impl Motion {
    /// A motion that begins at time `begin` from rest.
    pub fn between(from: Joints, to: Joints, limits: &Limits, begin: f64) -> Self {
        let ways = from.iter().zip(to.iter()).map(|(a, b)| (b - a).abs());
        let least = |limit: &Joints| {
            ways.clone()
                .zip(limit.iter())
                .filter(|(way, _)| *way > 0.0)
                .fold(f64::INFINITY, |least, (way, limit)| least.min(limit / way))
        };
        let (top, gain) = (least(&limits.velocity), least(&limits.acceleration));
        let mut motion = Self {
            from,
            to,
            top,
            gain,
            drive: Drive::On,
            phases: Default::default(),
            since: begin,
            rest: 1.0,
        };
        if top.is_finite() {
            motion.go_on(begin, 0.0, 0.0);
        }
        motion
    }

    /// Time of the whole motion if nothing holds it.
    pub fn undisturbed(from: Joints, to: Joints, limits: &Limits) -> f64 {
        Self::between(from, to, limits, 0.0).rests_at()
    }

    /// From `place` with `speed` to the end: gain speed, keep it, lose it.
    fn go_on(&mut self, t: f64, place: f64, speed: f64) {
        let way = (1.0 - place).max(0.0);
        let peak = (self.gain * way + speed * speed / 2.0).max(0.0).sqrt().min(self.top).max(speed);
        let rise = (peak - speed) / self.gain;
        let fall = peak / self.gain;
        let rest = (way - (speed + peak) / 2.0 * rise - peak / 2.0 * fall).max(0.0);
        let rising = Phase { duration: rise, place, speed, acceleration: self.gain };
        let level = Phase {
            duration: rest / peak.max(f64::MIN_POSITIVE),
            place: rising.place_after(rise),
            speed: peak,
            acceleration: 0.0,
        };
        let falling = Phase {
            duration: fall,
            place: level.place_after(level.duration),
            speed: peak,
            acceleration: -self.gain,
        };
        self.drive = Drive::On;
        self.phases = [rising, level, falling];
        self.since = t;
        self.rest = 1.0;
    }

    /// Brakes on the line from time `t` on; later calls change nothing until it goes on.
    pub fn hold(&mut self, t: f64) {
        if self.drive == Drive::Held {
            return;
        }
        let (place, speed) = (self.place(t), self.speed(t));
        self.drive = Drive::Held;
        if speed > 0.0 {
            let braking = Phase { duration: speed / self.gain, place, speed, acceleration: -self.gain };
            self.rest = braking.place_after(braking.duration).min(1.0);
            self.phases = [braking, Phase::default(), Phase::default()];
            self.since = t;
        } else if t < self.rests_at() {
            self.rest = place;
            self.phases = Default::default();
            self.since = t;
        }
    }

    /// Goes on to the same end from time `t`, from rest or from what speed braking has left.
    pub fn resume(&mut self, t: f64) {
        if self.drive == Drive::On {
            return;
        }
        self.drive = Drive::On;
        let (place, speed) = (self.place(t), self.speed(t));
        if place < 1.0 {
            self.go_on(t, place, speed);
        }
    }

    pub fn is_held(&self) -> bool {
        self.drive == Drive::Held
    }

    /// When the joints stand still, at the end or held.
    pub fn rests_at(&self) -> f64 {
        self.since + self.phases.iter().map(|phase| phase.duration).sum::<f64>()
    }

    /// When the end is reached; none while the motion is held before it.
    pub fn ends_at(&self) -> Option<f64> {
        (self.rest >= 1.0).then(|| self.rests_at())
    }

    pub fn has_ended(&self, t: f64) -> bool {
        self.ends_at().is_some_and(|end| t >= end)
    }

    /// Joints at time `t`, not before the last call that changed the motion; exact at both ends.
    pub fn at(&self, t: f64) -> Joints {
        let place = self.place(t);
        if place <= 0.0 {
            return self.from;
        }
        if place >= 1.0 {
            return self.to;
        }
        self.from.map(|i, start| start + place * (self.to[i] - start))
    }

    pub fn goal(&self) -> Joints {
        self.to
    }

    /// How far each joint goes on the whole line, in one direction.
    pub fn ways(&self) -> Joints {
        self.from.map(|i, from| (self.to[i] - from).abs())
    }

    /// What the joints do from the last call that changed the motion until they stand still.
    pub fn pieces(&self) -> Vec<Piece> {
        let mut pieces = Vec::new();
        let mut begin_s = self.since;
        for phase in self.phases.iter().filter(|phase| phase.duration > 0.0) {
            let end_s = begin_s + phase.duration;
            let joints = self.from.iter().zip(self.to.iter()).map(|(from, to)| {
                let way = to - from;
                vec![from + way * phase.place, way * phase.speed, way * phase.acceleration / 2.0]
            });
            pieces.push(Piece { begin_s, end_s, joints: joints.collect() });
            begin_s = end_s;
        }
        pieces
    }

    /// Place on the line, 0 to 1.
    pub fn place(&self, t: f64) -> f64 {
        match self.phase(t) {
            Some((phase, passed)) => phase.place_after(passed).clamp(0.0, 1.0),
            None => self.rest,
        }
    }

    /// Change of the place on the line, 1/s.
    fn speed(&self, t: f64) -> f64 {
        self.phase(t).map_or(0.0, |(phase, passed)| phase.speed_after(passed).max(0.0))
    }

    fn phase(&self, t: f64) -> Option<(&Phase, f64)> {
        if t >= self.rests_at() {
            return None;
        }
        let mut passed = (t - self.since).max(0.0);
        for phase in &self.phases {
            if passed < phase.duration {
                return Some((phase, passed));
            }
            passed -= phase.duration;
        }
        None
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEP: f64 = 1e-3;

    fn joints(values: &[f64]) -> Joints {
        Joints::new(values)
    }

    fn limits() -> Limits {
        Limits { velocity: joints(&[1.0, 2.16, 3.2]), acceleration: joints(&[1.0, 1.0, 1.0]) }
    }

    fn long() -> Motion {
        Motion::between(joints(&[0.0, 1.0, -0.5]), joints(&[4.0, -1.2, 0.3]), &limits(), 0.0)
    }

    /// Highest velocity and acceleration over their limits, by differences, while `steer` acts on the motion.
    fn worst(mut motion: Motion, end: f64, mut steer: impl FnMut(&mut Motion, f64)) -> (f64, f64, Motion) {
        let limits = limits();
        let (mut velocity, mut acceleration): (f64, f64) = (0.0, 0.0);
        let (mut last, mut before) = (motion.at(0.0), motion.at(0.0));
        let mut i = 1;
        while f64::from(i) * STEP < end {
            let t = f64::from(i) * STEP;
            steer(&mut motion, t);
            let now = motion.at(t);
            for j in 0..now.len() {
                velocity = velocity.max((now[j] - last[j]).abs() / STEP / limits.velocity[j]);
                let change = now[j] - 2.0 * last[j] + before[j];
                acceleration = acceleration.max(change.abs() / (STEP * STEP) / limits.acceleration[j]);
            }
            (before, last) = (last, now);
            i += 1;
        }
        (velocity, acceleration, motion)
    }

    #[test]
    fn durations_follow_the_law() {
        let limits = limits();
        let time = |way: f64| Motion::undisturbed(joints(&[0.0; 3]), joints(&[way, 0.0, 0.0]), &limits);
        // Full speed is reached: 4 m at 1 m/s with 1 s to gain it.
        assert!((time(4.0) - 5.0).abs() < 1e-12);
        // It is not: twice the root of the way.
        assert!((time(0.25) - 1.0).abs() < 1e-12);
        assert!((time(1.0) - 2.0).abs() < 1e-12);
        assert_eq!(time(0.0), 0.0);
        let slow = limits.at_speed(0.1);
        let time = Motion::undisturbed(joints(&[0.0; 3]), joints(&[4.0, 0.0, 0.0]), &slow);
        assert!((time - 40.1).abs() < 1e-9, "{time}");
    }

    #[test]
    fn ends_are_exact_and_limits_kept() {
        let motion = long();
        assert_eq!(motion.at(0.0), joints(&[0.0, 1.0, -0.5]));
        let end = motion.ends_at().unwrap();
        assert_eq!(motion.at(end), joints(&[4.0, -1.2, 0.3]));
        assert!(!motion.has_ended(end - 1e-6) && motion.has_ended(end));
        let (velocity, acceleration, _) = worst(motion, end + 0.1, |_, _| {});
        assert!((0.99..1.0 + 1e-9).contains(&velocity), "{velocity}");
        assert!((0.99..1.0 + 1e-6).contains(&acceleration), "{acceleration}");
    }

    #[test]
    fn held_at_any_time_it_stops_on_its_line_and_ends_at_the_goal() {
        let whole = long().ends_at().unwrap();
        for part in 0..60 {
            let halt = whole * f64::from(part) / 58.0;
            for pause in [0.0, 0.004, 0.3, 0.9, 3.0] {
                let (velocity, acceleration, motion) = worst(long(), whole + pause + 4.0, |motion, t| {
                    if t >= halt && t < halt + pause {
                        motion.hold(t);
                    } else if t >= halt + pause {
                        motion.resume(t);
                    }
                });
                assert!(velocity <= 1.0 + 1e-9, "{velocity} held at {halt}");
                assert!(acceleration <= 1.0 + 1e-6, "{acceleration} held at {halt} for {pause}");
                let end = motion.ends_at().unwrap();
                assert_eq!(motion.at(end), joints(&[4.0, -1.2, 0.3]));
                assert!(end >= whole - 1e-9 && end <= whole + pause + 2.2, "{end}");
                // On the line: all joints have done the same part of their ways.
                let now = motion.at(halt + pause + 0.05);
                let parts = [now[0] / 4.0, (now[1] - 1.0) / -2.2, (now[2] + 0.5) / 0.8];
                assert!(parts.iter().all(|p| (p - parts[0]).abs() < 1e-12));
            }
        }
    }

    #[test]
    fn a_held_motion_stands_and_does_not_end() {
        let mut motion = long();
        motion.hold(2.0);
        assert_eq!(motion.ends_at(), None);
        let rest = motion.rests_at();
        assert!((rest - 3.0).abs() < 1e-9, "one second to lose full speed: {rest}");
        let stands = motion.at(rest);
        motion.hold(5.0);
        assert_eq!(motion.at(100.0), stands);
        // 0.5 m to gain speed, 1 m at full speed, 0.5 m to lose it.
        assert!((stands[0] - 2.0).abs() < 1e-9);
        motion.resume(100.0);
        assert_eq!(motion.at(100.0), stands);
        assert!((motion.ends_at().unwrap() - 103.0).abs() < 1e-9);
    }

    #[test]
    fn held_before_it_starts_and_after_it_ended() {
        let mut motion = long();
        motion.hold(0.0);
        assert_eq!(motion.at(50.0), joints(&[0.0, 1.0, -0.5]));
        motion.resume(50.0);
        assert!((motion.ends_at().unwrap() - 55.0).abs() < 1e-9);
        motion.hold(60.0);
        assert!(motion.has_ended(60.0));
        motion.resume(61.0);
        assert!(motion.has_ended(61.0));
        let mut nothing = Motion::between(joints(&[1.0; 3]), joints(&[1.0; 3]), &limits(), 7.0);
        assert_eq!(nothing.ends_at(), Some(7.0));
        nothing.hold(7.0);
        nothing.resume(8.0);
        assert!(nothing.has_ended(8.0));
    }
}
