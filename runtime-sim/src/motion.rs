//! Motion of all joints together, between two sets of joints: straight, or past others without a stop.
//!
//! The place on the path is one number from 0 to 1. It gains speed, keeps it and
//! loses it again, as fast as the slowest joint allows. On a straight line
//! `top` = min v/change, `gain` = min a/change over the joints; an undisturbed motion takes
//! 1/top + top/gain if top^2 >= gain, otherwise 2/sqrt(gain).

mod law;
mod path;
mod pieces;
mod profile;

pub use path::{CORNER_NEAR, Knot, Path, Section, Travel};
pub use pieces::Piece;

use crate::fingerprint::Fingerprint;
use crate::kinematics::arm::{Joints, Limits};
use profile::{Phase, Profile, Zone};
use std::sync::Arc;

/// A motion that may be held and resumed. Times are seconds on any one clock.
#[derive(Clone, Debug)]
pub struct Motion {
    path: Arc<Path>,
    zones: Arc<[Zone]>,
    drive: Drive,
    /// What the motion does from `since` on, one phase after the other; then it rests at `rest`.
    profile: Arc<Profile>,
    since: f64,
    rest: f64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Drive {
    On,
    Held,
}

impl Motion {
    /// A motion that begins at time `begin` from rest.
    pub fn between(from: Joints, to: Joints, limits: &Limits, begin: f64) -> Self {
        Self::past(from, &[Knot::new(to)], limits, begin)
    }

    /// The same past all knots but the last, and to that. Lines meet in corners that are short of their knots by at most
    /// [`Knot::near`] for each joint.
    pub fn past(from: Joints, knots: &[Knot], limits: &Limits, begin: f64) -> Self {
        Self::on(Path::new(from, knots, limits), limits, begin)
    }

    /// The same along a path.
    pub fn on(path: Path, limits: &Limits, begin: f64) -> Self {
        let zones = path.zones(limits);
        let profile = Arc::new(profile::to_the_end(&zones, 0.0, 0.0).into());
        Self { path: Arc::new(path), zones: zones.into(), drive: Drive::On, profile, since: begin, rest: 1.0 }
    }

    /// The same motion, begun at another time; of one that nothing has held.
    pub fn begun(&self, begin: f64) -> Self {
        Self { since: begin, ..self.clone() }
    }

    /// Time of the whole motion if nothing holds it.
    pub fn undisturbed(from: Joints, to: Joints, limits: &Limits) -> f64 {
        Self::between(from, to, limits, 0.0).rests_at()
    }

    /// Brakes on its path from time `t` on; later calls change nothing until it continues.
    pub fn hold(&mut self, t: f64) {
        if self.drive == Drive::Held {
            return;
        }
        let (place, speed) = (self.place(t), self.speed(t));
        self.drive = Drive::Held;
        if speed > 0.0 {
            let (profile, rest) = profile::to_rest(&self.zones, place, speed);
            (self.profile, self.rest) = (Arc::new(profile.into()), rest);
            self.since = t;
        } else if t < self.rests_at() {
            self.rest = place;
            self.profile = Arc::default();
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
            self.profile = Arc::new(profile::to_the_end(&self.zones, place, speed).into());
            self.since = t;
            self.rest = 1.0;
        }
    }

    /// Whether both go along the same path, whenever.
    pub fn is_along(&self, other: &Motion) -> bool {
        Arc::ptr_eq(&self.path, &other.path)
    }

    /// Along which it goes.
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// When what [`Self::phases`] gives begins, s.
    pub fn since(&self) -> f64 {
        self.since
    }

    /// What the place on the path does from then on: where it begins and how fast, 1/s, and then for each phase its
    /// duration in s and its acceleration in 1/s2. Behind the last the motion rests.
    pub fn phases(&self) -> ([f64; 2], Vec<[f64; 2]>) {
        let phases = self.profile.phases();
        let first = phases.iter().find(|phase| phase.duration > 0.0);
        let begin = first.map_or([self.rest, 0.0], |first| [first.place_after(0.0), first.speed_after(0.0)]);
        let phases = phases.iter().filter(|phase| phase.duration > 0.0);
        (begin, phases.map(|phase| [phase.duration, phase.gain()]).collect())
    }

    /// Of its path.
    pub(crate) fn fingerprint(&self) -> Fingerprint {
        self.path.fingerprint()
    }

    pub fn is_held(&self) -> bool {
        self.drive == Drive::Held
    }

    /// When the joints are at rest, at the end or held.
    pub fn rests_at(&self) -> f64 {
        self.since + self.profile.duration()
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
        self.path.at(self.place(t))
    }

    /// Joints at a place on the path, 0 to 1.
    pub fn along(&self, place: f64) -> Joints {
        self.path.at(place)
    }

    pub fn goal(&self) -> Joints {
        self.path.goal()
    }

    /// How far a point goes at most, if it goes so far for each metre or radian of each joint.
    pub fn travel(&self, radii: &[f64]) -> Travel {
        Travel::new(self.path.sections(radii))
    }

    /// Place on the path, 0 to 1.
    pub fn place(&self, t: f64) -> f64 {
        match self.phase(t) {
            Some((phase, passed)) => phase.place_after(passed).clamp(0.0, 1.0),
            None => self.rest,
        }
    }

    /// Change of the place on the path, 1/s.
    fn speed(&self, t: f64) -> f64 {
        self.phase(t).map_or(0.0, |(phase, passed)| phase.speed_after(passed).max(0.0))
    }

    fn phase(&self, t: f64) -> Option<(&Phase, f64)> {
        if t >= self.rests_at() {
            return None;
        }
        self.profile.at((t - self.since).max(0.0))
    }
}

impl PartialEq for Motion {
    /// What is shared is equal without a look at it.
    fn eq(&self, other: &Self) -> bool {
        (self.since, self.rest, self.drive) == (other.since, other.rest, other.drive)
            && (Arc::ptr_eq(&self.profile, &other.profile) || self.profile == other.profile)
            && (Arc::ptr_eq(&self.path, &other.path) || self.path == other.path)
    }
}

#[cfg(test)]
mod tests {
    use super::pieces::Piece;
    use super::*;
    use crate::kinematics::random::Random;

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
    fn worst(motion: Motion, end: f64, steer: impl FnMut(&mut Motion, f64)) -> (f64, f64, Motion) {
        worst_of(motion, &limits(), end, steer)
    }

    fn worst_of(
        mut motion: Motion,
        limits: &Limits,
        end: f64,
        mut steer: impl FnMut(&mut Motion, f64),
    ) -> (f64, f64, Motion) {
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
        let time = |change: f64| Motion::undisturbed(joints(&[0.0; 3]), joints(&[change, 0.0, 0.0]), &limits);
        // Full speed is reached: 4 m at 1 m/s with 1 s to gain it.
        assert!((time(4.0) - 5.0).abs() < 1e-12);
        // It is not: twice the root of the change.
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
                // On the line: all joints have done the same part of their changes.
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

    fn through(from: Joints, via: Joints, to: Joints, limits: &Limits, begin: f64) -> Motion {
        Motion::past(from, &[Knot::new(via), Knot::new(to)], limits, begin)
    }

    fn corner() -> Motion {
        let via = joints(&[2.0, 0.2, 1.0]);
        through(joints(&[0.0, 1.0, -0.5]), via, joints(&[1.0, -1.2, 0.3]), &limits(), 0.0)
    }

    /// Least distance of a motion from `via`, in the joint that is furthest from it.
    fn passes(motion: &Motion, via: &Joints) -> f64 {
        let end = motion.ends_at().unwrap();
        let far =
            |t: f64| motion.at(t).iter().zip(via.iter()).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        (0..=20_000).map(|i| far(end * f64::from(i) / 20_000.0)).fold(f64::INFINITY, f64::min)
    }

    #[test]
    fn a_corner_is_passed_without_a_stop_near_its_place_and_within_the_limits() {
        let mut random = Random::new(21);
        let mut anywhere = |half: f64| joints(&[0.0; 3].map(|_: f64| random.between(-half, half)));
        let mut slowest = f64::INFINITY;
        for i in 0..300 {
            let half = [3.0, 0.3, 0.01][i % 3];
            let [from, via, to] = [0; 3].map(|_| anywhere(half));
            let limits = limits().at_speed([1.0, 0.1][i % 2]);
            let motion = through(from, via, to, &limits, 0.0);
            let end = motion.ends_at().unwrap();
            assert_eq!((motion.at(0.0), motion.at(end)), (from, to));
            let near = passes(&motion, &via);
            assert!(near <= CORNER_NEAR + 1e-3 * half, "{near} from {via:?}");
            let stop = Motion::undisturbed(from, via, &limits) + Motion::undisturbed(via, to, &limits);
            assert!(end < 1.01 * stop, "{end}, with a stop {stop}");
            let (velocity, acceleration, motion) = worst_of(motion, &limits, end + 0.1, |_, _| {});
            assert!(velocity <= 1.0 + 1e-9, "{velocity} through {via:?}");
            assert!(acceleration <= 1.0 + 1e-6, "{acceleration} through {via:?}");
            // On its path it never stands.
            for step in 1..1000 {
                slowest = slowest.min(motion.speed(end * f64::from(step) / 1000.0) * end);
            }
        }
        assert!(slowest > 1e-3, "{slowest}");
    }

    #[test]
    fn held_anywhere_about_a_corner_it_stops_on_its_path_and_ends_at_the_goal() {
        let whole = corner().ends_at().unwrap();
        let at_place = |place: f64| corner().path.at(place);
        for part in 0..150 {
            let halt = whole * f64::from(part) / 148.0;
            for pause in [0.0, 0.004, 0.1, 0.3, 0.9, 3.0] {
                let mut rest = 0.0;
                let steer = |motion: &mut Motion, t: f64| {
                    if t >= halt && t < halt + pause {
                        motion.hold(t);
                        rest = motion.rests_at();
                    } else if t >= halt + pause {
                        motion.resume(t);
                    }
                };
                let (velocity, acceleration, motion) =
                    worst_of(corner(), &limits(), whole + pause + 4.0, steer);
                assert!(velocity <= 1.0 + 1e-9, "{velocity} held at {halt}");
                assert!(acceleration <= 1.0 + 1e-6, "{acceleration} held at {halt} for {pause}");
                assert!(pause < 3.0 || rest <= halt + 3.0, "{rest} held at {halt}");
                let end = motion.ends_at().unwrap();
                assert_eq!(motion.at(end), joints(&[1.0, -1.2, 0.3]));
                assert!(end >= whole - 1e-9 && end <= whole + pause + 4.0, "{end} of {whole}");
                let t = halt + pause + 0.05;
                assert_eq!(motion.at(t), at_place(motion.place(t)));
            }
        }
    }

    /// Like a straight line of a tool: short lines, all corners between.
    fn many_corners() -> Motion {
        let knot = |i: u32| {
            let t = f64::from(i) / 14.0;
            Knot::new(joints(&[0.9 * t.sin(), 1.4 * (1.0 - t * t).sqrt(), -0.8 * t * t]))
        };
        let knots: Vec<Knot> = (1..=13).map(knot).collect();
        Motion::past(joints(&[0.0, 1.4, 0.0]), &knots, &limits(), 0.0)
    }

    #[test]
    fn many_corners_held_for_a_moment_keep_their_limits() {
        let whole = many_corners().ends_at().unwrap();
        for part in 0..200 {
            let halt = whole * f64::from(part) / 198.0;
            for pause in [0.02, 0.06, 0.1, 0.2, 0.4] {
                let steer = |motion: &mut Motion, t: f64| {
                    if t >= halt && t < halt + pause {
                        motion.hold(t);
                    } else if t >= halt + pause {
                        motion.resume(t);
                    }
                };
                let (velocity, acceleration, motion) =
                    worst_of(many_corners(), &limits(), whole + pause + 4.0, steer);
                assert!(velocity <= 1.0 + 1e-9, "{velocity} held at {halt}");
                assert!(acceleration <= 1.0 + 1e-6, "{acceleration} held at {halt} for {pause}");
                assert!(motion.has_ended(whole + pause + 4.0));
            }
        }
    }

    #[test]
    fn a_corner_held_and_held_again_keeps_its_limits() {
        let mut random = Random::new(22);
        for _ in 0..200 {
            let mut change = 0.0;
            let (velocity, acceleration, motion) = worst_of(corner(), &limits(), 60.0, |motion, t| {
                if t < change {
                    return;
                }
                change = t + random.between(0.0, 0.8);
                if motion.is_held() || t > 40.0 { motion.resume(t) } else { motion.hold(t) }
            });
            assert!(velocity <= 1.0 + 1e-9, "{velocity}");
            assert!(acceleration <= 1.0 + 1e-6, "{acceleration}");
            assert_eq!(motion.at(60.0), joints(&[1.0, -1.2, 0.3]));
        }
    }

    #[test]
    fn many_knots_are_passed_without_a_stop_within_the_limits() {
        let mut random = Random::new(22);
        for i in 0..100 {
            let half = [1.0, 0.2, 0.02][i % 3];
            let mut at = joints(&[0.0; 3]);
            let knots: Vec<Knot> = (0..3 + i % 20)
                .map(|_| {
                    let step: [f64; 3] = std::array::from_fn(|_| random.between(-half, half));
                    at = at.map(|i, value| value + step[i]);
                    Knot { joints: at, near: [0.3, CORNER_NEAR][i % 2] }
                })
                .collect();
            let from = joints(&[0.0; 3]);
            let motion = Motion::past(from, &knots, &limits(), 0.0);
            let end = motion.ends_at().unwrap();
            assert_eq!((motion.at(0.0), motion.at(end)), (from, at));
            for knot in &knots {
                assert!(passes(&motion, &knot.joints) <= knot.near + 1e-2 * half, "{knot:?}");
            }
            let travel = motion.travel(&[1.0, 2.0, 0.5]);
            let mut gone = 0.0;
            for step in 0..2000 {
                let [a, b] = [step, step + 1].map(|step| motion.along(f64::from(step) / 2000.0));
                let radii = [1.0, 2.0, 0.5];
                gone += (0..3).map(|j| (b[j] - a[j]).abs() * radii[j]).sum::<f64>();
                assert!(travel.to(f64::from(step + 1) / 2000.0) >= gone - 1e-9);
            }
            let (velocity, acceleration, _) = worst_of(motion, &limits(), end + 0.1, |_, _| {});
            assert!(velocity <= 1.0 + 1e-9 && acceleration <= 1.0 + 1e-6, "{velocity} {acceleration}");
        }
    }

    fn check_pieces(motion: &Motion) {
        for Piece { begin_s, end_s, joints } in motion.pieces() {
            let passed = (end_s - begin_s) / 2.0;
            let place = motion.at(begin_s + passed);
            for (powers, joint) in joints.iter().zip(place.iter()) {
                let sum = powers.iter().rev().fold(0.0, |sum, factor| sum * passed + factor);
                assert!((sum - joint).abs() < 1e-9, "{sum}, not {joint}");
            }
        }
    }

    /// Near the end rounding brings the place past it.
    #[test]
    fn pieces_are_those_of_the_motion_whenever_it_is_held() {
        let mut random = Random::new(23);
        for number in 0..20_000 {
            let mut motion = [long(), corner()][number % 2].clone();
            for before in [0.3, 1e-6, 1e-6] {
                let held = (motion.rests_at() - random.between(0.0, before)).max(motion.since);
                motion.hold(held);
                check_pieces(&motion);
                motion.resume(held + random.between(0.0, before));
                check_pieces(&motion);
            }
        }
    }

    /// Knots that lie together are one: no corner between lines that are none.
    #[test]
    fn a_line_that_is_none_is_left_out() {
        let (from, to) = (joints(&[0.0; 3]), joints(&[1.0, 0.5, -0.2]));
        let beside = to.map(|_, value| value + 1e-10);
        let knots = [from, from, to, beside, to].map(Knot::new);
        let motion = Motion::past(from, &knots, &limits(), 0.0);
        assert!((motion.rests_at() - Motion::undisturbed(from, to, &limits())).abs() < 1e-9);
        assert_eq!(motion.goal(), to);
        assert!(motion.pieces().iter().all(|piece| piece.end_s - piece.begin_s > 1e-3));
    }

    #[test]
    fn a_path_without_a_corner() {
        let (from, via, to) = (joints(&[0.0; 3]), joints(&[1.0, 0.5, -0.2]), joints(&[3.0, 1.5, -0.6]));
        let straight = Motion::undisturbed(from, to, &limits());
        for (via, duration) in [(via, straight), (from, straight), (to, straight)] {
            let motion = through(from, via, to, &limits(), 0.0);
            assert!((motion.rests_at() - duration).abs() < 1e-6, "{} {duration}", motion.rests_at());
        }
        // There and back: the corner turns round.
        let motion = through(from, via, from, &limits(), 0.0);
        assert_eq!(motion.at(motion.rests_at()), from);
        assert!(passes(&motion, &via) <= CORNER_NEAR);
        assert_eq!(through(from, from, from, &limits(), 3.0).ends_at(), Some(3.0));
    }
}
