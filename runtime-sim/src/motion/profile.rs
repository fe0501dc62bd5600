//! How the place on a path changes with time: as fast as the limits of each zone allow.
//!
//! With the square of the speed as the unknown all limits are linear: along a corner the joints' acceleration is what
//! turning off takes of it, and what gaining or losing speed does. From the end backwards follows the highest speed at
//! the beginning of each zone from which all later limits can be kept; then each zone is passed as fast as it allows
//! (Bobrow, Dubowsky and Gibson 1985; Pham and Pham 2018).

/// A part of a path with limits of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct Zone {
    /// Place at which the zone ends; it begins where the one before ends, or at 0.
    pub end: f64,
    /// Highest change of the place, 1/s.
    pub top: f64,
    pub limit: Limit,
}

/// What the acceleration of the joints allows.
#[derive(Clone, Debug, PartialEq)]
pub enum Limit {
    /// Highest change of the speed, 1/s2.
    Straight(f64),
    Corner(Corner),
}

/// A corner over which the joints' change with the place changes evenly.
#[derive(Clone, Debug, PartialEq)]
pub struct Corner {
    pub begin: f64,
    /// For each joint that moves its change with the place at the beginning, and the change of that with the place:
    /// both as parts of its acceleration.
    pub joints: Vec<[f64; 2]>,
}

/// A bound on the change of the speed: the first number, and the second times the square of the speed.
#[derive(Clone, Copy)]
struct Bound(f64, f64);

impl Bound {
    fn at(self, square: f64) -> f64 {
        self.0 + self.1 * square
    }
}

impl Corner {
    /// Lower and upper bounds between a place and the end of the zone, for the square of the speed at that place.
    fn bounds(&self, place: f64, end: f64) -> impl Iterator<Item = [Bound; 2]> + '_ {
        self.joints.iter().flat_map(move |&[rate, bend]| {
            let (here, there) = (rate + bend * (place - self.begin), rate + bend * (end - self.begin));
            // The square of the speed grows evenly with the place.
            let rates =
                [here, there + 2.0 * bend * (end - place)].into_iter().filter(|rate| rate.is_normal());
            rates.map(move |rate| {
                [Bound(-1.0 / rate.abs(), -bend / rate), Bound(1.0 / rate.abs(), -bend / rate)]
            })
        })
    }

    /// The highest square of the speed at a place from which that at the end is none higher than `leave`.
    fn enter(&self, place: f64, end: f64, leave: f64, most: f64) -> f64 {
        let double = 2.0 * (end - place);
        let stop = [Bound(0.0, -1.0 / double), Bound(leave / double, -1.0 / double)];
        let bends = self.joints.iter().map(|[_, bend]| 1.0 / bend.abs());
        let mut square = bends.fold(most, f64::min);
        // Each cut leaves at least one pair of bounds behind.
        for _ in 0..4 * self.joints.len() {
            let all = || self.bounds(place, end).chain([stop]);
            let highest = |a: Bound, b: Bound| if b.at(square) > a.at(square) { b } else { a };
            let lowest = |a: Bound, b: Bound| if b.at(square) < a.at(square) { b } else { a };
            let lower = all().map(|[lower, _]| lower).reduce(highest).unwrap_or(stop[0]);
            let upper = all().map(|[_, upper]| upper).reduce(lowest).unwrap_or(stop[1]);
            if lower.at(square) <= upper.at(square) {
                break;
            }
            let crossing = (upper.0 - lower.0) / (lower.1 - upper.1);
            square = if crossing > 0.0 { crossing.min(square) } else { 0.0 };
        }
        square
    }

    /// The most that the speed may change from this square of it on.
    fn gain(&self, place: f64, end: f64, square: f64) -> f64 {
        self.bounds(place, end).map(|[_, upper]| upper.at(square)).fold(f64::INFINITY, f64::min)
    }

    /// The same for losing speed, to rest too.
    fn loss(&self, place: f64, end: f64, square: f64) -> f64 {
        let bounds = self.bounds(place, end).map(|[lower, _]| lower.at(square).max(lower.0));
        let least = bounds.fold(f64::NEG_INFINITY, f64::max);
        let rates = self
            .joints
            .iter()
            .flat_map(|[rate, bend]| [place, end].map(|at| -1.0 / (rate + bend * (at - self.begin)).abs()));
        rates.fold(least, f64::max).min(0.0)
    }
}

/// A time with one acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Phase {
    pub duration: f64,
    place: f64,
    speed: f64,
    acceleration: f64,
}

impl Phase {
    pub fn place_after(&self, t: f64) -> f64 {
        self.place + (self.speed + self.acceleration * t / 2.0) * t
    }

    /// The place as powers of the time in this phase.
    pub fn powers(&self) -> [f64; 3] {
        [self.place, self.speed, self.acceleration / 2.0]
    }

    /// 1/s2.
    pub fn gain(&self) -> f64 {
        self.acceleration
    }

    pub fn speed_after(&self, t: f64) -> f64 {
        self.speed + self.acceleration * t
    }
}

/// Phases one after the other.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Profile {
    phases: Vec<Phase>,
    /// When each of them ends, from the beginning of the first.
    ends: Vec<f64>,
}

impl Profile {
    pub fn phases(&self) -> &[Phase] {
        &self.phases
    }

    pub fn duration(&self) -> f64 {
        self.ends.last().copied().unwrap_or(0.0)
    }

    /// The phase at this time, and the time in it; none when all are over.
    pub fn at(&self, time: f64) -> Option<(&Phase, f64)> {
        let number = self.ends.partition_point(|end| *end <= time);
        let phase = self.phases.get(number)?;
        let begin = if number > 0 { self.ends[number - 1] } else { 0.0 };
        Some((phase, time - begin))
    }
}

impl From<Vec<Phase>> for Profile {
    fn from(phases: Vec<Phase>) -> Self {
        let mut gone = 0.0;
        let ends = phases.iter().map(|phase| {
            gone += phase.duration;
            gone
        });
        let ends = ends.collect();
        Self { phases, ends }
    }
}

/// From `place` with `speed` to rest at the end: in each zone gain speed, keep it, lose it.
pub fn to_the_end(zones: &[Zone], mut place: f64, mut speed: f64) -> Vec<Phase> {
    let zones = &zones[present(zones, place)..];
    let leave = leaving(zones);
    let mut phases = Vec::with_capacity(3 * zones.len());
    for (zone, leave) in zones.iter().zip(leave) {
        let distance = (zone.end - place).max(0.0);
        let out = match &zone.limit {
            Limit::Straight(gain) => {
                let out = leave.min((speed * speed + 2.0 * gain * distance).sqrt());
                phases.extend(straight(*gain, zone.top, place, distance, [speed, out]));
                out
            }
            Limit::Corner(corner) => {
                let square = speed * speed;
                let gain = corner.gain(place, zone.end, square);
                let out = (square + 2.0 * gain * distance).clamp(0.0, leave * leave).sqrt();
                phases.push(even(place, distance, [speed, out]));
                out
            }
        };
        (place, speed) = (zone.end, out);
    }
    phases
}

/// Gains speed, keeps it and loses it, from one speed to another.
fn straight(gain: f64, top: f64, place: f64, distance: f64, [speed, out]: [f64; 2]) -> [Phase; 3] {
    let peak = (gain * distance + (speed * speed + out * out) / 2.0).sqrt().min(top).max(speed).max(out);
    let rise = (peak - speed) / gain;
    let fall = (peak - out) / gain;
    let rest = (distance - (speed + peak) / 2.0 * rise - (peak + out) / 2.0 * fall).max(0.0);
    let rising = Phase { duration: rise, place, speed, acceleration: gain };
    let level = Phase {
        duration: rest / peak.max(f64::MIN_POSITIVE),
        place: rising.place_after(rise),
        speed: peak,
        acceleration: 0.0,
    };
    let falling =
        Phase { duration: fall, place: level.place_after(level.duration), speed: peak, acceleration: -gain };
    [rising, level, falling]
}

/// From one speed to another with one acceleration.
fn even(place: f64, distance: f64, [speed, out]: [f64; 2]) -> Phase {
    let duration = 2.0 * distance / (speed + out).max(f64::MIN_POSITIVE);
    Phase { duration, place, speed, acceleration: (out - speed) / duration.max(f64::MIN_POSITIVE) }
}

/// From `place` with `speed` to rest, as soon as the zones allow; and the place of rest.
pub fn to_rest(zones: &[Zone], mut place: f64, mut speed: f64) -> (Vec<Phase>, f64) {
    let zones = &zones[present(zones, place)..];
    let mut phases = Vec::new();
    for (zone, leave) in zones.iter().zip(leaving(zones)) {
        let distance = (zone.end - place).max(0.0);
        let loss = match &zone.limit {
            Limit::Straight(gain) => -gain,
            Limit::Corner(corner) => corner.loss(place, zone.end, speed * speed),
        };
        let left = speed * speed + 2.0 * loss * distance;
        let out = if left > 0.0 && zone.end < 1.0 { left.sqrt() } else { 0.0 };
        // A corner may let the joints lose less speed than what comes behind it asks for.
        if out > leave && matches!(zone.limit, Limit::Corner(_)) {
            phases.push(even(place, distance, [speed, leave]));
            (place, speed) = (zone.end, leave);
            continue;
        }
        let duration = if out > 0.0 { 2.0 * distance / (speed + out) } else { -speed / loss };
        let braking = Phase { duration, place, speed, acceleration: loss };
        phases.push(braking);
        if out == 0.0 {
            return (phases, braking.place_after(duration).min(1.0));
        }
        (place, speed) = (zone.end, out);
    }
    (phases, place)
}

/// Number of the zone that holds the place.
fn present(zones: &[Zone], place: f64) -> usize {
    zones.iter().position(|zone| place < zone.end).unwrap_or(zones.len().saturating_sub(1))
}

/// The highest speed at the end of each zone from which all later limits can be kept.
fn leaving(zones: &[Zone]) -> Vec<f64> {
    let mut leave = vec![0.0; zones.len()];
    for i in (1..zones.len()).rev() {
        let (next, begin) = (&zones[i], zones[i - 1].end);
        let square = leave[i] * leave[i];
        let most = next.top.min(zones[i - 1].top);
        let enter = match &next.limit {
            Limit::Straight(gain) => (square + 2.0 * gain * (next.end - begin)).min(most * most),
            Limit::Corner(corner) => corner.enter(begin, next.end, square, most * most),
        };
        leave[i - 1] = enter.sqrt();
    }
    leave
}
