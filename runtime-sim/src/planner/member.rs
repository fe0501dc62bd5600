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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collision::SKIN;
    use crate::kinematics::random::Random;
    use crate::point::Point;
    use crate::solid::Shape;

    fn point(random: &mut Random) -> Point {
        let mut drawn = || random.between(-1.0, 1.0);
        Point::new(drawn(), drawn(), drawn())
    }

    fn pose(random: &mut Random) -> Pose {
        let quarter =
            Pose { rotation: [[1.0, 0.0, 0.0], [0.0, 0.0, -1.0], [0.0, 1.0, 0.0]], ..Pose::IDENTITY };
        let turned = |random: &mut Random| Pose::turned(Point::default(), random.between(-3.0, 3.0));
        let turns = turned(random).then(&quarter).then(&turned(random));
        Pose { position: point(random), ..turns }
    }

    fn piece(pose: &Pose, shape: Shape) -> Piece {
        Piece::new(String::new(), pose, shape)
    }

    /// A capsule without a length is a ball, smaller by half of the skin.
    fn as_piece(ball: &Ball) -> Piece {
        let shape = Shape::Capsule { length: 0.0, radius: ball.radius + SKIN / 2.0 };
        piece(&Pose { position: ball.middle, ..Pose::IDENTITY }, shape)
    }

    #[test]
    fn a_link_is_no_nearer_than_its_box() {
        let mut random = Random::new(8);
        let mut far = 0;
        for number in 0..1000 {
            let pieces = (0..1 + number % 3).map(|_| {
                let at = pose(&mut random);
                let size = point(&mut random).absolute();
                let capsule = Shape::Capsule { length: size.x, radius: size.y };
                piece(&at, if number % 2 == 0 { Shape::Box { size } } else { capsule })
            });
            let member = Member::new(0, pieces.collect());
            let frame = pose(&mut random);
            let ball = Ball { middle: point(&mut random).scaled(5.0), radius: random.between(0.0, 1.0) };
            let other = as_piece(&ball).within(&Pose::IDENTITY);
            let gaps = member.pieces.iter().map(|piece| piece.within(&frame).gap(&other).distance);
            let apart = member.apart(&frame, &ball);
            assert!(apart.max(0.0) <= gaps.fold(f64::INFINITY, f64::min) + 1e-9);
            far += u32::from(apart > 1.0);
        }
        assert!(far > 300, "{far}");
    }

    #[test]
    fn a_box_is_its_own_box() {
        let mut random = Random::new(9);
        for _ in 0..100 {
            let at = Pose { position: point(&mut random), ..Pose::IDENTITY };
            let member = Member::new(0, vec![piece(&at, Shape::Box { size: point(&mut random).absolute() })]);
            let frame = pose(&mut random);
            let ball = Ball { middle: point(&mut random).scaled(5.0), radius: 0.1 };
            let gap = member.pieces[0].within(&frame).gap(&as_piece(&ball).within(&Pose::IDENTITY)).distance;
            assert!((member.apart(&frame, &ball).max(0.0) - gap).abs() < 1e-9);
        }
    }
}
