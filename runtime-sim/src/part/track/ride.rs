//! How a vehicle goes along its track, in closed form.

use super::polyline::{Polyline, Stretch};
use crate::frame::Frame;
use crate::point::Point;
use std::sync::Arc;

/// From where it is to where it comes to rest: it gains speed, keeps it, and brakes.
#[derive(Clone, Debug, PartialEq)]
pub struct Ride {
    polyline: Arc<Polyline>,
    from: f64,
    to: f64,
    /// From the start of the run.
    begin_ms: f64,
    /// One after another; the last one ends at rest.
    phases: Vec<Phase>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Phase {
    /// m/s, at its beginning.
    speed: f64,
    /// m/s2
    acceleration: f64,
    seconds: f64,
}

/// A stretch of a straight side with one acceleration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Piece {
    pub begin_ms: f64,
    pub end_ms: f64,
    /// At its beginning.
    pub from: Frame,
    pub velocity: Point,
    pub acceleration: Point,
}

impl Phase {
    fn speed_after(&self, seconds: f64) -> f64 {
        self.speed + self.acceleration * seconds
    }

    fn length_after(&self, seconds: f64) -> f64 {
        (self.speed + self.acceleration / 2.0 * seconds) * seconds
    }

    fn length(&self) -> f64 {
        self.length_after(self.seconds)
    }

    /// Seconds after which it has gone so far.
    fn time_of(&self, length: f64) -> f64 {
        let square = self.speed * self.speed + 2.0 * self.acceleration * length;
        let sum = self.speed + square.max(0.0).sqrt();
        if length <= 0.0 || sum <= 0.0 { 0.0 } else { (2.0 * length / sum).min(self.seconds) }
    }
}

/// How a vehicle is when a ride begins, and what it can.
#[derive(Clone, Copy, Debug)]
pub struct Begin {
    pub ms: f64,
    pub place: f64,
    /// m/s, toward the end of the ride.
    pub speed: f64,
    pub top_speed: f64,
    pub acceleration: f64,
}

impl Begin {
    /// Metres in which it comes to rest.
    pub fn braking(&self) -> f64 {
        self.speed * self.speed / (2.0 * self.acceleration)
    }
}

/// Part of a speed that is rounded.
const ROUNDED: f64 = 1e-9;

/// The highest speed at the end of each stretch with which it can keep to the limits of those behind, and stop.
fn ends(stretches: &[Stretch], begin: &Begin) -> Vec<f64> {
    let mut ends = vec![0.0; stretches.len()];
    for number in (1..stretches.len()).rev() {
        let [before, behind] = [stretches[number - 1], stretches[number]];
        let limits = before.limits.speed.min(behind.limits.speed).min(behind.limits.entry).min(begin.top_speed);
        let brakes = ends[number] * ends[number] + 2.0 * begin.acceleration * behind.length;
        ends[number - 1] = limits.min(brakes.sqrt());
    }
    ends
}

/// Over a stretch from one speed to another: it gains speed, keeps it, and brakes.
fn over(stretch: &Stretch, begin: Begin, speed: f64, end: f64) -> [Phase; 3] {
    let Begin { top_speed, acceleration, .. } = begin;
    let length = stretch.length;
    let highest = (acceleration * length + (speed * speed + end * end) / 2.0).max(0.0).sqrt();
    let peak = highest.min(top_speed.min(stretch.limits.speed)).max(speed).max(end);
    let gains = (peak - speed) / acceleration;
    let gained = (peak * peak - speed * speed) / (2.0 * acceleration);
    let brakes = (peak - end) / acceleration;
    let kept = (length - gained - (peak * peak - end * end) / (2.0 * acceleration)).max(0.0);
    let keeps = if peak > 0.0 { kept / peak } else { 0.0 };
    [
        Phase { speed, acceleration, seconds: gains },
        Phase { speed: peak, acceleration: 0.0, seconds: keeps },
        Phase { speed: peak, acceleration: -acceleration, seconds: brakes },
    ]
}

impl Ride {
    /// To rest at a place no nearer than where braking brings it.
    pub fn new(polyline: Arc<Polyline>, begin: Begin, to: f64) -> Self {
        let stretches = polyline.stretches(begin.place, to);
        let ends = ends(&stretches, &begin);
        let mut speed = begin.speed;
        let mut phases = Vec::with_capacity(3 * stretches.len());
        for (stretch, highest) in stretches.iter().zip(ends) {
            // So fast it can be at the end of the stretch.
            let end = highest.min((speed * speed + 2.0 * begin.acceleration * stretch.length).sqrt());
            phases.extend(over(stretch, begin, speed, end));
            speed = end;
        }
        Self { polyline, from: begin.place, to, begin_ms: begin.ms, phases }
    }

    /// Whether it can keep to all limits, and come to rest there: `spare` metres more would do too.
    pub fn is_possible(polyline: &Polyline, begin: &Begin, to: f64, spare: f64) -> bool {
        let stretches = polyline.stretches(begin.place, to);
        let Some((first, end)) = stretches.first().zip(ends(&stretches, begin).first().copied()) else {
            return false;
        };
        let is_slow = begin.speed <= first.limits.speed * (1.0 + ROUNDED);
        is_slow && begin.speed * begin.speed <= end * end + 2.0 * begin.acceleration * (first.length + spare)
    }

    pub fn to(&self) -> f64 {
        self.to
    }

    /// 1, or -1 on the way back.
    pub fn sign(&self) -> f64 {
        if self.to < self.from { -1.0 } else { 1.0 }
    }

    pub fn end_ms(&self) -> f64 {
        self.begin_ms + 1000.0 * self.phases.iter().map(|phase| phase.seconds).sum::<f64>()
    }

    /// The highest that it comes to, m/s.
    pub fn top_speed(&self) -> f64 {
        self.phases.iter().map(|phase| phase.speed).fold(0.0, f64::max)
    }

    /// The phase at a time, and seconds since that began; none at rest.
    fn phase(&self, ms: f64) -> Option<(usize, f64)> {
        let mut seconds = (ms - self.begin_ms).max(0.0) / 1000.0;
        for (number, phase) in self.phases.iter().enumerate() {
            if seconds < phase.seconds {
                return Some((number, seconds));
            }
            seconds -= phase.seconds;
        }
        None
    }

    /// m/s, toward its end.
    pub fn speed(&self, ms: f64) -> f64 {
        self.phase(ms).map_or(0.0, |(number, seconds)| self.phases[number].speed_after(seconds).max(0.0))
    }

    /// Along the track; on a closed one it continues beyond the length.
    pub fn place(&self, ms: f64) -> f64 {
        let Some((number, seconds)) = self.phase(ms) else { return self.to };
        let before: f64 = self.phases[..number].iter().map(Phase::length).sum();
        let gone = before + self.phases[number].length_after(seconds);
        self.from + self.sign() * gone.min((self.to - self.from).abs())
    }

    pub fn frame(&self, ms: f64) -> Frame {
        self.polyline.frame(self.place(ms))
    }

    /// When it has gone so far.
    pub fn time_of(&self, length: f64) -> f64 {
        let mut left = length;
        let mut seconds = 0.0;
        for phase in &self.phases {
            let whole = phase.length();
            if left < whole {
                return self.begin_ms + 1000.0 * (seconds + phase.time_of(left));
            }
            left -= whole;
            seconds += phase.seconds;
        }
        self.end_ms()
    }

    /// Metres that no point goes more than between two times that is so far from the vehicle's own: at a corner it turns
    /// at once.
    pub fn path(&self, reach: f64, from_ms: f64, to_ms: f64) -> f64 {
        let [low, high] = self.span(from_ms, to_ms);
        let turns = self.polyline.corners_between(low, high);
        let turned: f64 = turns.map(|(_, turn)| libm::sin(turn.to_radians() / 2.0).abs()).sum();
        high - low + 2.0 * reach * turned
    }

    /// The corners that it passes between two times, with both ends.
    pub fn corners(&self, from_ms: f64, to_ms: f64) -> Vec<Point> {
        let [low, high] = self.span(from_ms, to_ms);
        let corners = self.polyline.corners_between(low, high).map(|(place, _)| place);
        let places = [low].into_iter().chain(corners).chain([high]);
        places.map(|place| self.polyline.frame(place).position).collect()
    }

    fn span(&self, from_ms: f64, to_ms: f64) -> [f64; 2] {
        let [from, to] = [self.place(from_ms), self.place(to_ms)];
        [from.min(to), from.max(to)]
    }

    /// All of it, cut where its acceleration or its direction changes.
    pub fn pieces(&self) -> Vec<Piece> {
        let [low, high] = self.span(self.begin_ms, self.end_ms());
        let corners = self.polyline.corners_between(low, high);
        let mut times: Vec<f64> = corners.map(|(place, _)| self.time_of((place - self.from).abs())).collect();
        let mut ms = self.begin_ms;
        for phase in &self.phases {
            times.push(ms);
            ms += 1000.0 * phase.seconds;
        }
        times.push(ms);
        times.sort_by(f64::total_cmp);
        let spans = times.windows(2).filter(|span| span[1] > span[0]);
        spans.map(|span| self.piece(span[0], span[1])).collect()
    }

    fn piece(&self, begin_ms: f64, end_ms: f64) -> Piece {
        let middle_ms = (begin_ms + end_ms) / 2.0;
        let along = self.polyline.ahead(self.place(middle_ms)).scaled(self.sign());
        let acceleration = self.phase(middle_ms).map_or(0.0, |(number, _)| self.phases[number].acceleration);
        let position = self.frame(begin_ms).position;
        Piece {
            begin_ms,
            end_ms,
            from: Frame { position, ..self.frame(middle_ms) },
            velocity: along.scaled(self.speed(begin_ms)),
            acceleration: along.scaled(acceleration),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ride(length: f64, speed: f64) -> Ride {
        let corners = [Point::new(0.0, 0.0, 0.0), Point::new(100.0, 0.0, 0.0)];
        let polyline = Arc::new(Polyline::new(&corners, false).expect("a track"));
        let begin = Begin { ms: 1000.0, place: 10.0, speed, top_speed: 1.5, acceleration: 0.5 };
        Ride::new(polyline, begin, 10.0 + length)
    }

    #[test]
    fn a_way_with_two_stops_costs_its_length_and_the_speed_by_the_acceleration() {
        let ride = ride(30.0, 0.0);
        assert!((ride.end_ms() - 1000.0 - 1000.0 * (30.0 / 1.5 + 1.5 / 0.5)).abs() < 1e-9);
        assert_eq!(ride.place(ride.end_ms()), 40.0);
        // Half of it by the symmetry of the way.
        let half_ms = 1000.0 + (ride.end_ms() - 1000.0) / 2.0;
        assert!((ride.place(half_ms) - 25.0).abs() < 1e-12);
        assert_eq!(ride.speed(half_ms), 1.5);
    }

    #[test]
    fn a_short_way_never_comes_to_full_speed() {
        let ride = ride(2.0, 0.0);
        assert!((ride.end_ms() - 1000.0 - 2000.0 * (2.0_f64 / 0.5).sqrt()).abs() < 1e-9);
        assert!((ride.top_speed() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn from_full_speed_it_brakes_in_the_square_over_twice_the_acceleration() {
        let ride = ride(2.25, 1.5);
        assert!((ride.end_ms() - 1000.0 - 3000.0).abs() < 1e-6);
        assert!((ride.place(2000.0) - 10.0 - 1.25).abs() < 1e-9);
        assert!((ride.speed(2000.0) - 1.0).abs() < 1e-9);
    }

    #[test]
    fn when_it_has_gone_so_far_is_the_inverse_of_how_far_it_has_gone() {
        for (length, speed) in [(30.0, 0.0), (2.0, 0.0), (5.0, 1.2), (2.25, 1.5)] {
            let ride = ride(length, speed);
            for part in 0..=20 {
                let gone = length * f64::from(part) / 20.0;
                let ms = ride.time_of(gone);
                assert!((ride.place(ms) - 10.0 - gone).abs() < 1e-9, "{length} {speed} {gone}");
            }
        }
    }

    #[test]
    fn pieces_join() {
        let corners = [[0.0, 0.0], [10.0, 0.0], [10.0, 10.0], [0.0, 10.0]].map(|[x, y]| Point::new(x, y, 0.0));
        let polyline = Arc::new(Polyline::new(&corners, true).expect("a track"));
        let begin = Begin { ms: 0.0, place: 35.0, speed: 0.0, top_speed: 1.5, acceleration: 0.5 };
        let ride = Ride::new(polyline, begin, 55.0);
        let pieces = ride.pieces();
        assert_eq!(pieces.len(), 5);
        for piece in &pieces {
            let s = (piece.end_ms - piece.begin_ms) / 1000.0;
            let end = piece.from.position + piece.velocity.scaled(s) + piece.acceleration.scaled(s * s / 2.0);
            assert!((end - ride.frame(piece.end_ms).position).length() < 1e-9, "{piece:?}");
        }
    }
}
