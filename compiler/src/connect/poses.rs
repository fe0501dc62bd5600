//! The poses at which two machines must meet.

use super::{Line, Miss, Proposal, Stage};
use runtime_sim::geometry::{Geometry, Place};
use runtime_sim::kinematics::arm::Arm;
use runtime_sim::point::Point;
use std::ops::ControlFlow;

/// What the poses of one proposal gave.
pub struct Test {
    /// Of the worst pose.
    pub margin: f64,
    /// Worst first.
    pub misses: Vec<Miss>,
    pub tested: usize,
}

/// Every pose of the tool, which grips an item on its upper side: each place, with each kind of part,
/// at contact and above it. `see` gets the place's name, the kind's name, the stage and the tool's place,
/// and answers whether to go on.
fn each(
    line: &Line,
    proposal: &Proposal,
    passive: &Geometry,
    mut see: impl FnMut(&str, &str, Stage, Point) -> ControlFlow<()>,
) -> ControlFlow<()> {
    for place in &places(line, proposal, passive) {
        for (kind, height) in &line.kinds {
            let contact = place.point.up(*height);
            see(&place.name, kind, Stage::Contact, contact)?;
            see(&place.name, kind, Stage::Approach, contact.up(proposal.site.approach))?;
        }
    }
    ControlFlow::Continue(())
}

fn places(line: &Line, proposal: &Proposal, passive: &Geometry) -> Vec<Place> {
    let names: Vec<String> = line.kinds.iter().map(|(name, _)| name.clone()).collect();
    let site = &proposal.site;
    passive
        .handover(&site.name, site.index, site.capacity, &names)
        .expect("a type is bound only to a machine with its handover")
}

fn arm(geometry: &Geometry) -> Arm {
    Arm::from_geometry(geometry).expect("the active one of a pair is an arm")
}

pub fn test(line: &Line, proposal: &Proposal) -> Test {
    let arm = arm(&line.nodes[proposal.arm].geometry);
    let mut test = Test { margin: f64::INFINITY, misses: Vec::new(), tested: 0 };
    let _ = each(line, proposal, &line.nodes[proposal.passive()].geometry, |place, kind, stage, tool| {
        let margin = arm.margin(tool);
        test.tested += 1;
        test.margin = test.margin.min(margin);
        if margin < 0.0 {
            test.misses.push(Miss {
                place: place.to_string(),
                kind: kind.to_string(),
                stage,
                tool,
                missing_mm: -margin * 1000.0,
            });
        }
        ControlFlow::Continue(())
    });
    test.misses.sort_by(|a, b| b.missing_mm.total_cmp(&a.missing_mm));
    test
}

/// By how much the first pose that misses does so with `geometry` instead of the one of `node`, m; none if all are in reach.
pub fn first_miss(line: &Line, proposal: &Proposal, (node, geometry): (usize, &Geometry)) -> Option<f64> {
    let of = |index: usize| if index == node { geometry } else { &line.nodes[index].geometry };
    let arm = arm(of(proposal.arm));
    let mut miss = None;
    let _ = each(line, proposal, of(proposal.passive()), |_, _, _, tool| {
        let margin = arm.margin(tool);
        if margin < 0.0 {
            miss = Some(-margin);
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    miss
}

/// Whether the two machines would meet with `geometry` instead of the one of `node`.
pub fn stands(line: &Line, proposal: &Proposal, changed: (usize, &Geometry)) -> bool {
    first_miss(line, proposal, changed).is_none()
}

/// Whether `geometry` instead of the one of `node` changes anything for the two machines.
pub fn matters(line: &Line, proposal: &Proposal, (node, geometry): (usize, &Geometry)) -> bool {
    let present = &line.nodes[node].geometry;
    if node == proposal.arm {
        arm(geometry) != arm(present)
    } else {
        places(line, proposal, geometry) != places(line, proposal, present)
    }
}
