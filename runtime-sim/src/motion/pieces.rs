//! Motion as polynomials of time.

use super::Motion;

/// A part of a motion in which each joint is a polynomial of the seconds since `begin_s`.
#[derive(Clone, Debug, PartialEq)]
pub struct Piece {
    pub begin_s: f64,
    pub end_s: f64,
    /// For each joint the coefficients of the powers of time, from the zeroth on.
    pub joints: Vec<Vec<f64>>,
}

impl Motion {
    /// What the joints do from the last call that changed the motion until they are at rest.
    pub fn pieces(&self) -> Vec<Piece> {
        let mut pieces = Vec::new();
        let mut begin_s = self.since;
        for phase in self.profile.phases().iter().filter(|phase| phase.duration > 0.0) {
            let end_s = begin_s + phase.duration;
            // No phase goes from a line into a corner or out of it.
            let within = phase.place_after(phase.duration / 2.0);
            let joints = self.path.powers(within).into_iter().map(|joint| composed(joint, phase.powers()));
            pieces.push(Piece { begin_s, end_s, joints: joints.collect() });
            begin_s = end_s;
        }
        pieces
    }
}

/// A polynomial of the place, which is one of the time.
fn composed([c0, c1, c2]: [f64; 3], [a, b, c]: [f64; 3]) -> Vec<f64> {
    let straight = vec![c0 + c1 * a, c1 * b, c1 * c];
    if c2 == 0.0 {
        return straight;
    }
    let squared = [a * a, 2.0 * a * b, b * b + 2.0 * a * c, 2.0 * b * c, c * c];
    let straight = straight.into_iter().chain([0.0, 0.0]);
    straight.zip(squared).map(|(line, square)| line + c2 * square).collect()
}
