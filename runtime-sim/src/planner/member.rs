//! A link of a gantry, as its planner takes it.

use super::obstacle::Obstruction;
use crate::collision::body::{Ball, Piece, Placed};
use crate::kinematics::pose::Pose;
use crate::machine::Machine;
use crate::solid::Link;

/// A link of the robot with all that is fixed to it.
#[derive(Clone, Debug)]
pub struct Member {
    pub link: usize,
    pub pieces: Vec<Piece>,
    pub ball: Ball,
}

impl Member {
    /// All of them, from the rails to the tool.
    pub fn all(machine: &Machine) -> Vec<Self> {
        let mut solids = machine.solids();
        solids.sort_by_key(|solid| solid.link);
        let links = solids.chunk_by(|a, b| a.link == b.link).filter_map(|solids| {
            let Link::Joint(link) = solids[0].link else { return None };
            let pieces: Vec<Piece> =
                solids.iter().map(|s| Piece::new(s.name.clone(), &s.pose, s.shape)).collect();
            let balls: Vec<Ball> = pieces.iter().map(Piece::ball).collect();
            Some(Self { link, pieces, ball: Ball::around(&balls) })
        });
        links.collect()
    }
}

/// A link where it is.
pub struct Located {
    pub pieces: Vec<Placed>,
}

impl Located {
    pub fn new(member: &Member, frames: &[Pose]) -> Self {
        let frame = &frames[member.link];
        Self { pieces: member.pieces.iter().map(|piece| piece.within(frame)).collect() }
    }

    /// The distance from an obstacle, or one that is no longer and no shorter than `enough`, m.
    pub fn gap_to(&self, other: &Obstruction, enough: f64) -> f64 {
        self.pieces.iter().fold(f64::INFINITY, |least, piece| {
            let enough = enough.min(least);
            let apart = other.apart(&piece.ball);
            least.min(if apart >= enough { apart } else { gap(piece, &other.placed, enough) })
        })
    }

    /// The same from something else.
    #[inline]
    pub fn gap(&self, other: &Placed, enough: f64) -> f64 {
        let gap = |least: f64, piece| least.min(gap(piece, other, enough.min(least)));
        self.pieces.iter().fold(f64::INFINITY, gap)
    }
}

/// The distance, or one that is no longer and no shorter than `enough`, m.
#[inline]
fn gap(a: &Placed, b: &Placed, enough: f64) -> f64 {
    if a.is_apart_by(b, enough) { enough } else { a.gap(b).distance }
}
