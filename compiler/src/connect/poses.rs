//! The poses at which two machines must meet.

use super::{Line, Miss, Proposal, Stage};
use crate::device::{Place, Placed};
use runtime_sim::kinematics::arm::Arm;
use runtime_sim::point::Point;
use std::ops::ControlFlow;

/// Every pose of the tool, which grips an item from its upper side: each place, with each kind of part,
/// at contact and above it. `see` gets the place, the kind's name, the stage and the tool's place,
/// and answers whether to continue.
fn each(
    line: &Line,
    proposal: &Proposal,
    passive: &Placed,
    see: impl FnMut(&Place, &str, Stage, Point) -> ControlFlow<()>,
) -> ControlFlow<()> {
    each_of(line, proposal, &places(line, proposal, passive), see)
}

/// The same at these places.
fn each_of(
    line: &Line,
    proposal: &Proposal,
    places: &[Place],
    mut see: impl FnMut(&Place, &str, Stage, Point) -> ControlFlow<()>,
) -> ControlFlow<()> {
    for place in places {
        for (kind, grasp) in &line.kinds {
            let contact = place.facing.back(place.point, *grasp);
            see(place, kind, Stage::Contact, contact)?;
            see(place, kind, Stage::Approach, place.facing.back(contact, proposal.site.approach))?;
        }
    }
    ControlFlow::Continue(())
}

fn places<'a>(line: &Line, proposal: &Proposal, passive: &'a Placed) -> Vec<Place<'a>> {
    let site = &proposal.site;
    passive
        .handover(&site.name, site.index, site.capacity, line.kinds.len())
        .expect("a type is bound only to a machine with its handover")
}

/// How two machines meet, at the worst pose.
#[derive(Clone, Copy)]
pub struct Met {
    /// How far the arm stays within its reach, m.
    pub margin: f64,
    /// How far the last three joints of the arm stay from their limits, deg; none if they have no limits.
    pub wrist_room: Option<f64>,
}

/// A line with the arms of its nodes, which are worked out once.
pub struct Reachable<'a> {
    line: &'a Line,
    arms: Vec<Option<Arm>>,
}

impl<'a> Reachable<'a> {
    pub fn new(line: &'a Line) -> Self {
        let mut is_arm = vec![false; line.nodes.len()];
        let withheld = line.withheld.iter().map(|withheld| &withheld.pair);
        line.proposals.iter().chain(withheld).for_each(|proposal| is_arm[proposal.arm] = true);
        let arms =
            line.nodes.iter().zip(is_arm).map(|(node, is_arm)| is_arm.then(|| node.placed.arm()).flatten());
        Self { line, arms: arms.collect() }
    }

    fn arm(&self, node: usize) -> &Arm {
        self.arms[node].as_ref().expect("the active one of a pair is an arm")
    }

    /// None if a pose is out of reach.
    pub fn met(&self, proposal: &Proposal) -> Option<Met> {
        let arm = self.arm(proposal.arm);
        let places = places(self.line, proposal, &self.line.nodes[proposal.passive()].placed);
        let mut margin = f64::INFINITY;
        let seen = each_of(self.line, proposal, &places, |place, _, _, tool| {
            margin = margin.min(arm.margin_facing(tool, place.facing));
            if margin < 0.0 { ControlFlow::Break(()) } else { ControlFlow::Continue(()) }
        });
        seen.is_continue().then(|| Met { margin, wrist_room: self.wrist_room(proposal, &places) })
    }

    fn wrist_room(&self, proposal: &Proposal, places: &[Place]) -> Option<f64> {
        let arm = self.arm(proposal.arm);
        let mut worst = f64::INFINITY;
        let seen = each_of(self.line, proposal, places, |place, _, _, tool| {
            let Some(room) = arm.wrist_room(tool, place.facing) else { return ControlFlow::Break(()) };
            worst = worst.min(room);
            ControlFlow::Continue(())
        });
        seen.is_continue().then(|| worst.to_degrees())
    }

    /// The poses that miss, the worst first, and the number of all poses.
    pub fn misses(&self, proposal: &Proposal) -> (Vec<Miss>, usize) {
        let arm = self.arm(proposal.arm);
        let (mut misses, mut tested) = (Vec::new(), 0);
        let passive = &self.line.nodes[proposal.passive()].placed;
        let _ = each(self.line, proposal, passive, |place, kind, stage, tool| {
            let margin = arm.margin_facing(tool, place.facing);
            tested += 1;
            if margin < 0.0 {
                misses.push(Miss {
                    place: place.name(&self.line.kinds),
                    kind: kind.to_string(),
                    stage,
                    tool,
                    missing_mm: -margin * 1000.0,
                });
            }
            ControlFlow::Continue(())
        });
        misses.sort_by(|a, b| b.missing_mm.total_cmp(&a.missing_mm));
        (misses, tested)
    }

    /// How far from the place of a machine, about which it turns, the tool is at most, m.
    pub fn farthest(&self, proposal: &Proposal, node: usize) -> f64 {
        let own = self.line.nodes[node].placed.pose.position;
        let mut farthest = 0.0_f64;
        let passive = &self.line.nodes[proposal.passive()].placed;
        let _ = each(self.line, proposal, passive, |_, _, _, tool| {
            farthest = farthest.max((tool.x - own.x).hypot(tool.y - own.y));
            ControlFlow::Continue(())
        });
        farthest
    }

    /// By how much the first pose that misses does so with `placed` instead of the one of `node`, m; none if all
    /// are in reach.
    pub fn first_miss(&self, proposal: &Proposal, (node, placed): (usize, &Placed)) -> Option<f64> {
        let changed = (node == proposal.arm).then(|| placed.arm()).flatten();
        let arm = changed.as_ref().unwrap_or_else(|| self.arm(proposal.arm));
        let passive = proposal.passive();
        let passive = if passive == node { placed } else { &self.line.nodes[passive].placed };
        let mut miss = None;
        let _ = each(self.line, proposal, passive, |place, _, _, tool| {
            let margin = arm.margin_facing(tool, place.facing);
            if margin < 0.0 {
                miss = Some(-margin);
                return ControlFlow::Break(());
            }
            ControlFlow::Continue(())
        });
        miss
    }

    /// Whether the two machines would meet with `placed` instead of the one of `node`.
    pub fn stands(&self, proposal: &Proposal, changed: (usize, &Placed)) -> bool {
        self.first_miss(proposal, changed).is_none()
    }

    /// Whether `placed` instead of the one of `node` changes anything for the two machines.
    pub fn matters(&self, proposal: &Proposal, (node, placed): (usize, &Placed)) -> bool {
        if node == proposal.arm {
            placed.arm().as_ref() != self.arms[node].as_ref()
        } else {
            let present = &self.line.nodes[node].placed;
            places(self.line, proposal, placed) != places(self.line, proposal, present)
        }
    }
}
