//! How far a gantry is from obstacles and from itself.

use super::member::Member;
use super::obstacle::{Cluster, Obstruction};
use crate::collision::body::{Piece, Placed};
use crate::collision::reach::{Ball, Chain, Radii};
use crate::kinematics::arm::{Arm, Frames, Joints, MOST_JOINTS};
use crate::kinematics::pose::Pose;
use crate::point::{Point, lesser};
use std::cell::OnceCell;

/// What hangs on the gripper.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Load {
    None,
    Largest,
}

/// The links of a gantry and the largest load, and what of them may meet.
#[derive(Clone, Debug)]
pub struct Links {
    arm: Arm,
    /// The load is the last one.
    members: Vec<Member>,
    /// Where the pieces of each member begin among those of all.
    begins: Vec<usize>,
    /// How many they all have.
    pieces: usize,
    pairs: Vec<Pair>,
}

/// A link and what it may meet.
#[derive(Clone, Debug)]
pub struct Pair {
    member: usize,
    /// Another link; all obstacles if it is none.
    other: Option<usize>,
    /// How far each joint moves them at most as seen from one another.
    pub radii: Radii,
}

/// The obstacles that the robot can come near.
pub struct Nearby<'s> {
    pub all: Vec<&'s Cluster>,
    /// What travels on the rails without turning can come near these.
    pub high: Vec<&'s Cluster>,
}

/// The links at some joints.
pub struct Standing<'a> {
    links: &'a Links,
    frames: Frames,
    /// By member.
    balls: [Ball; MOST_JOINTS + 1],
    /// The pieces of all members; those that are near something are known.
    placed: Vec<OnceCell<Placed>>,
}

/// A piece of a link where it is.
struct Located<'a> {
    piece: &'a Piece,
    frame: &'a Pose,
    placed: &'a OnceCell<Placed>,
}

impl<'a> Located<'a> {
    fn ball(&self) -> Ball {
        self.piece.ball().within(self.frame)
    }

    fn placed(&self) -> &'a Placed {
        self.placed.get_or_init(|| self.piece.within(self.frame))
    }
}

/// Number of the joint that turns the torso.
pub const TORSO: usize = 2;
/// What is rounded in a square, as a part of it.
const ROUNDED: f64 = 1e-12;
/// Links with so many joints between them or more may meet.
const FREE: usize = 3;

impl Links {
    /// The load is fixed to the last link.
    pub fn new(arm: Arm, chain: &Chain, mut members: Vec<Member>, load: Member) -> Self {
        members.push(load);
        let radii: Vec<Radii> = members.iter().map(|member| chain.radii(member.link, &member.ball)).collect();
        let mut pairs = Vec::new();
        for (i, member) in members.iter().enumerate() {
            pairs.push(Pair { member: i, other: None, radii: radii[i] });
            for (j, other) in members.iter().enumerate().skip(i) {
                if other.link >= member.link + FREE {
                    // What carries both of them does not move them to one another.
                    let mut radii = radii[j];
                    radii[..=member.link].fill(0.0);
                    pairs.push(Pair { member: i, other: Some(j), radii });
                }
            }
        }
        let mut begins = Vec::with_capacity(members.len());
        let mut pieces = 0;
        for member in &members {
            begins.push(pieces);
            pieces += member.pieces.len();
        }
        Self { arm, members, begins, pieces, pairs }
    }

    pub fn at(&self, joints: &Joints) -> Standing<'_> {
        let frames = self.arm.frames(joints);
        let mut balls = [Ball { middle: Point::default(), radius: 0.0 }; MOST_JOINTS + 1];
        for (ball, member) in balls.iter_mut().zip(&self.members) {
            *ball = member.ball.within(&frames[member.link]);
        }
        Standing { links: self, frames, balls, placed: vec![OnceCell::new(); self.pieces] }
    }

    /// All that may meet, with or without a load.
    pub fn pairs(&self, load: Load) -> impl Iterator<Item = &Pair> {
        self.pairs.iter().filter(move |pair| load == Load::Largest || !self.is_of_load(pair))
    }

    pub fn is_of_load(&self, pair: &Pair) -> bool {
        pair.member.max(pair.other.unwrap_or(0)) == self.members.len() - 1
    }
}

impl Standing<'_> {
    /// How far the robot is from these obstacles and from its own links, with or without a load, m; `enough` if it is
    /// that far or farther, 0 if they touch. Something less than `needed` if it is nearer than that.
    pub fn gap(&self, near: &Nearby, load: Load, [needed, enough]: [f64; 2]) -> f64 {
        let mut least = enough;
        for pair in self.links.pairs(load) {
            least = lesser(self.distance(pair, near, least), least);
            if least < needed {
                break;
            }
        }
        least
    }

    /// Between the two, m; where it is no shorter than `enough` it is this or something shorter that is not either.
    pub fn distance(&self, pair: &Pair, near: &Nearby, enough: f64) -> f64 {
        let Some(other) = pair.other else {
            let travels = self.links.members[pair.member].link < TORSO;
            return self.gap_to_obstacles(pair.member, if travels { &near.high } else { &near.all }, enough);
        };
        let apart = self.balls[pair.member].gap(&self.balls[other]);
        if apart >= enough {
            return apart;
        }
        let member = &self.links.members[pair.member];
        let frame = &self.frames[member.link];
        if member.apart(frame, &self.balls[other]) >= enough {
            return enough;
        }
        self.pieces(other).fold(f64::INFINITY, |least, located| {
            let enough = lesser(enough, least);
            if member.apart(frame, &located.ball()) >= enough {
                return lesser(enough, least);
            }
            lesser(self.gap_of_member(pair.member, located.placed(), enough), least)
        })
    }

    /// How far all links, without a load, are from something, m; `enough` if they are that far or farther.
    pub fn gap_to(&self, other: &Placed, enough: f64) -> f64 {
        let links = 0..self.links.members.len() - 1;
        links.fold(enough, |least, member| least.min(self.gap_of_member(member, other, least)))
    }

    /// The same of one member; no shorter than `enough` if it is that far or farther.
    fn gap_of_member(&self, member: usize, other: &Placed, enough: f64) -> f64 {
        self.pieces(member).fold(f64::INFINITY, |least, located| {
            let enough = lesser(enough, least);
            let is_apart = located.ball().is_apart_by(&other.ball, enough);
            lesser(if is_apart { enough } else { gap(located.placed(), other, enough) }, least)
        })
    }

    /// The distance of a link from obstacles.
    fn gap_to_obstacles(&self, member: usize, obstacles: &[&Cluster], enough: f64) -> f64 {
        let ball = &self.balls[member];
        let mut least = f64::INFINITY;
        // Of what is far away only the nearest counts, so one root is enough.
        let mut far_square = f64::INFINITY;
        for cluster in obstacles {
            let square = cluster.square_gap(ball.middle);
            let enough_here = lesser(enough, least);
            let needed = enough_here + ball.radius;
            if square > needed * needed * (1.0 + ROUNDED) || square.sqrt() - ball.radius >= enough_here {
                far_square = lesser(square, far_square);
                continue;
            }
            for other in &cluster.all {
                let enough = lesser(enough, least);
                let apart = other.apart(ball);
                least = least.min(if apart >= enough {
                    apart
                } else {
                    self.gap_to_obstruction(member, other, enough)
                });
            }
        }
        least.min(far_square.sqrt() - ball.radius)
    }

    /// The distance of a link from an obstacle, or one that is no longer and no shorter than `enough`, m.
    fn gap_to_obstruction(&self, member: usize, other: &Obstruction, enough: f64) -> f64 {
        self.pieces(member).fold(f64::INFINITY, |least, located| {
            let enough = lesser(enough, least);
            let apart = other.apart(&located.ball());
            if apart >= enough {
                return lesser(apart, least);
            }
            lesser(gap(located.placed(), &other.placed, enough), least)
        })
    }

    fn pieces(&self, member: usize) -> impl Iterator<Item = Located<'_>> {
        let placed = &self.placed[self.links.begins[member]..];
        let Member { link, pieces, .. } = &self.links.members[member];
        let frame = &self.frames[*link];
        pieces.iter().zip(placed).map(move |(piece, placed)| Located { piece, frame, placed })
    }
}

/// The distance, or one that is no longer and no shorter than `enough`, m.
#[inline]
fn gap(a: &Placed, b: &Placed, enough: f64) -> f64 {
    if a.is_apart_by(b, enough) { enough } else { a.gap(b).distance }
}
