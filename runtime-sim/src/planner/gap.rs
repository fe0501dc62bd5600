//! How far a gantry is from obstacles and from itself.

use super::member::{Located, Member};
use super::obstacle::Cluster;
use crate::collision::reach::{Chain, Radii};
use crate::kinematics::arm::{Arm, Frames, Joints, MOST_JOINTS};
use std::cell::OnceCell;

/// What hangs on the gripper.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
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
    located: [OnceCell<Located<'a>>; MOST_JOINTS + 1],
}

/// Number of the joint that turns the torso.
pub const TORSO: usize = 2;
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
    pub fn located(&self, frames: &Frames) -> Vec<Located<'_>> {
        let links = &self.members[..self.members.len() - 1];
        links.iter().map(|member| Located::new(member, frames)).collect()
    }

    pub fn at(&self, joints: &Joints) -> Standing<'_> {
        Standing { links: self, frames: self.arm.frames(joints), located: Default::default() }
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
        let member = self.located(pair.member);
        match pair.other {
            Some(other) => between(member, self.located(other), enough),
            None if member.link() < TORSO => from_all(member, &near.high, enough),
            None => from_all(member, &near.all, enough),
        }
    }

    fn located(&self, member: usize) -> &Located<'_> {
        self.located[member].get_or_init(|| Located::new(&self.links.members[member], &self.frames))
    }
}

/// The distance of two links, or one that is no longer and no shorter than `enough`, m.
fn between(a: &Located, b: &Located, enough: f64) -> f64 {
    let apart = a.ball.gap(&b.ball);
    if apart >= enough {
        return apart;
    }
    b.pieces().iter().fold(f64::INFINITY, |least, piece| least.min(a.gap(piece, enough.min(least))))
}

/// The same from obstacles.
fn from_all(member: &Located, obstacles: &[&Cluster], enough: f64) -> f64 {
    let mut least = f64::INFINITY;
    for cluster in obstacles {
        let apart = cluster.apart(&member.ball);
        if apart >= enough.min(least) {
            least = least.min(apart);
            continue;
        }
        for other in &cluster.all {
            let enough = enough.min(least);
            let apart = other.apart(&member.ball);
            least = least.min(if apart >= enough { apart } else { member.gap_to(other, enough) });
        }
    }
    least
}
