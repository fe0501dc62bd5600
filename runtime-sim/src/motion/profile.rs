//! How the place on a path changes with time: as fast as the limits of each zone allow.

/// A part of a path with limits of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Zone {
    /// Place at which the zone ends; it begins where the one before ends, or at 0.
    pub end: f64,
    /// Highest change of the place, 1/s.
    pub top: f64,
    /// Highest change of that, 1/s2.
    pub gain: f64,
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

    pub fn speed_after(&self, t: f64) -> f64 {
        self.speed + self.acceleration * t
    }
}

/// From `place` with `speed` to rest at the end: in each zone gain speed, keep it, lose it.
pub fn to_the_end(zones: &[Zone], mut place: f64, mut speed: f64) -> Vec<Phase> {
    let zones = &zones[present(zones, place)..];
    let leave = leaving(zones);
    let mut phases = Vec::with_capacity(3 * zones.len());
    for (zone, leave) in zones.iter().zip(leave) {
        let distance = (zone.end - place).max(0.0);
        let out = leave.min((speed * speed + 2.0 * zone.gain * distance).sqrt());
        let peak = (zone.gain * distance + (speed * speed + out * out) / 2.0)
            .sqrt()
            .min(zone.top)
            .max(speed)
            .max(out);
        let rise = (peak - speed) / zone.gain;
        let fall = (peak - out) / zone.gain;
        let rest = (distance - (speed + peak) / 2.0 * rise - (peak + out) / 2.0 * fall).max(0.0);
        let rising = Phase { duration: rise, place, speed, acceleration: zone.gain };
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
            acceleration: -zone.gain,
        };
        phases.extend([rising, level, falling]);
        (place, speed) = (zone.end, out);
    }
    phases
}

/// From `place` with `speed` to rest, as soon as the zones allow; and the place of rest.
pub fn to_rest(zones: &[Zone], mut place: f64, mut speed: f64) -> (Vec<Phase>, f64) {
    let mut phases = Vec::new();
    for zone in zones.iter().skip(present(zones, place)) {
        let distance = (zone.end - place).max(0.0);
        let left = speed * speed - 2.0 * zone.gain * distance;
        let out = if left > 0.0 && zone.end < 1.0 { left.sqrt() } else { 0.0 };
        let duration = (speed - out) / zone.gain;
        let braking = Phase { duration, place, speed, acceleration: -zone.gain };
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
        let (next, length) = (zones[i], zones[i].end - zones[i - 1].end);
        let braked = (leave[i] * leave[i] + 2.0 * next.gain * length).sqrt();
        leave[i - 1] = braked.min(next.top).min(zones[i - 1].top);
    }
    leave
}
