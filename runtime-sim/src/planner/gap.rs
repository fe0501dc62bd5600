//! How far a gantry is from obstacles and from itself.

use super::member::{Located, Member};
use super::obstacle::Cluster;
use crate::collision::reach::{Ball, Chain, Radii};
use crate::kinematics::arm::{Arm, Frames, Joints, MOST_JOINTS};
use crate::point::Point;
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
    /// Those that are near something.
    located: [OnceCell<Located>; MOST_JOINTS + 1],
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
        Self { arm, members, pairs }
    }

    /// All of them but the load, where they are.
    pub fn located(&self, frames: &Frames) -> Vec<Located> {
        let links = &self.members[..self.members.len() - 1];
        links.iter().map(|member| Located::new(member, frames)).collect()
    }

    pub fn at(&self, joints: &Joints) -> Standing<'_> {
        let frames = self.arm.frames(joints);
        let mut balls = [Ball { middle: Point::default(), radius: 0.0 }; MOST_JOINTS + 1];
        for (ball, member) in balls.iter_mut().zip(&self.members) {
            *ball = member.ball.within(&frames[member.link]);
        }
        Standing { links: self, frames, balls, located: Default::default() }
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
            least = least.min(self.distance(pair, near, least));
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
        between(self.located(pair.member), self.located(other), enough)
    }

    /// The distance of a link from obstacles.
    fn gap_to_obstacles(&self, member: usize, obstacles: &[&Cluster], enough: f64) -> f64 {
        let ball = &self.balls[member];
        let mut least = f64::INFINITY;
        // Of what is far away only the nearest counts, so one root is enough.
        let mut far_square = f64::INFINITY;
        for cluster in obstacles {
            let square = cluster.square_gap(ball.middle);
            let enough_here = enough.min(least);
            let needed = enough_here + ball.radius;
            if square > needed * needed * (1.0 + ROUNDED) || square.sqrt() - ball.radius >= enough_here {
                far_square = far_square.min(square);
                continue;
            }
            for other in &cluster.all {
                let enough = enough.min(least);
                let apart = other.apart(ball);
                least = least.min(if apart >= enough {
                    apart
                } else {
                    self.located(member).gap_to(other, enough)
                });
            }
        }
        least.min(far_square.sqrt() - ball.radius)
    }

    fn located(&self, member: usize) -> &Located {
        self.located[member].get_or_init(|| Located::new(&self.links.members[member], &self.frames))
    }
}

/// The distance of two links, or one that is no longer and no shorter than `enough`, m.
fn between(a: &Located, b: &Located, enough: f64) -> f64 {
    b.pieces.iter().fold(f64::INFINITY, |least, piece| least.min(a.gap(piece, enough.min(least))))
}
