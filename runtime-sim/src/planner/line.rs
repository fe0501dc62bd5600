//! The line of the torso's axis on the plane: from place to place, with rounded corners.

use crate::point::Point;

/// Straight pieces, and parabolas over the corners.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Places on it, near one another over corners.
    places: Vec<Point>,
    /// How far each of them is from the first, m.
    lengths: Vec<f64>,
}

/// A rounded corner begins no farther from it, m.
const ROUND: f64 = 0.8;
/// A rounded corner has so many straight pieces.
const PIECES: u32 = 8;

impl Line {
    pub fn new(corners: &[Point]) -> Self {
        let mut places = Vec::new();
        for (i, corner) in corners.iter().enumerate() {
            let beside = (i > 0).then(|| corners[i - 1]).zip(corners.get(i + 1));
            let Some((before, after)) = beside else {
                places.push(*corner);
                continue;
            };
            let [back, ahead] = [before - *corner, *after - *corner];
            let reach = ROUND.min(back.length() / 2.0).min(ahead.length() / 2.0);
            let toward = |side: Point| side.scaled(reach / side.length().max(f64::MIN_POSITIVE));
            for piece in 0..=PIECES {
                let t = f64::from(piece) / f64::from(PIECES);
                places
                    .push(*corner + toward(back).scaled((1.0 - t) * (1.0 - t)) + toward(ahead).scaled(t * t));
            }
        }
        let mut gone = 0.0;
        let lengths = places.windows(2).map(|pair| {
            gone += (pair[1] - pair[0]).length();
            gone
        });
        let lengths = [0.0].into_iter().chain(lengths).collect();
        Self { places, lengths }
    }

    /// Where it bends; no place on it is outside of these.
    pub fn places(&self) -> &[Point] {
        &self.places
    }

    /// Whole length, m.
    pub fn length(&self) -> f64 {
        self.lengths.last().copied().unwrap_or(0.0)
    }

    /// The place so many metres behind the first.
    pub fn at(&self, distance: f64) -> Point {
        let next = self.lengths.partition_point(|length| *length <= distance).clamp(1, self.places.len() - 1);
        let [low, high] = [self.lengths[next - 1], self.lengths[next]];
        let part = if high > low { ((distance - low) / (high - low)).clamp(0.0, 1.0) } else { 1.0 };
        self.places[next - 1] + (self.places[next] - self.places[next - 1]).scaled(part)
    }
}
