//! A link of a gantry, as its planner takes it.

use crate::collision::BoundingBox;
use crate::collision::body::{Ball, Piece};
use crate::kinematics::pose::Pose;
use crate::machine::Machine;
use crate::solid::Link;

/// A link of the robot with all that is fixed to it.
#[derive(Clone, Debug)]
pub struct Member {
    pub link: usize,
    pub pieces: Vec<Piece>,
    pub ball: Ball,
    /// In the frame of the link.
    bounds: BoundingBox,
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
            Some(Self::new(link, pieces))
        });
        links.collect()
    }

    pub fn new(link: usize, pieces: Vec<Piece>) -> Self {
        let balls: Vec<Ball> = pieces.iter().map(Piece::ball).collect();
        let bounds = pieces.iter().map(|piece| piece.within(&Pose::IDENTITY).bounds());
        let bounds = bounds.fold(BoundingBox::NOTHING, |all, next| all.with(&next));
        Self { link, pieces, ball: Ball::around(&balls), bounds }
    }

    /// A distance that nothing within a ball is nearer to it than, m; its link has this frame.
    #[inline]
    pub fn apart(&self, frame: &Pose, ball: &Ball) -> f64 {
        self.bounds.gap(&Ball { middle: frame.seen(ball.middle), ..*ball })
    }
}
