//! The poses at which two machines must meet.

use super::{Line, Miss, Proposal, Stage};
use runtime_sim::geometry::Geometry;
use runtime_sim::kinematics::arm::Arm;
use runtime_sim::point::Point;

/// What the poses of one proposal gave.
pub struct Test {
    /// Of the worst pose.
    pub margin: f64,
    /// Worst first.
    pub misses: Vec<Miss>,
    pub tested: usize,
}

/// A pose of the tool, which grips an item on its upper side.
pub struct ToolPose<'a> {
    pub place: String,
    pub kind: &'a str,
    pub stage: Stage,
    pub tool: Point,
}

/// Every place, with every kind of part, at contact and above it.
pub fn all<'a>(line: &'a Line, proposal: &Proposal, passive: &Geometry) -> Vec<ToolPose<'a>> {
    let names: Vec<String> = line.kinds.iter().map(|(name, _)| name.clone()).collect();
    let site = &proposal.site;
    let places = passive
        .handover(&site.name, site.index, site.capacity, &names)
        .expect("a type is bound only to a machine with its handover");
    let mut poses = Vec::with_capacity(places.len() * line.kinds.len() * 2);
    for place in &places {
        for (kind, height) in &line.kinds {
            let contact = place.point.up(*height);
            for (stage, tool) in [(Stage::Contact, contact), (Stage::Approach, contact.up(site.approach))] {
                poses.push(ToolPose { place: place.name.clone(), kind, stage, tool });
            }
        }
    }
    poses
}

pub fn arm(geometry: &Geometry) -> Arm {
    Arm::from_geometry(geometry).expect("the active one of a pair is an arm")
}

pub fn test(line: &Line, proposal: &Proposal) -> Test {
    let arm = arm(&line.nodes[proposal.arm].geometry);
    let poses = all(line, proposal, &line.nodes[proposal.passive()].geometry);
    let tested = poses.len();
    let mut margin = f64::INFINITY;
    let mut misses = Vec::new();
    for pose in poses {
        let here = arm.margin(pose.tool);
        margin = margin.min(here);
        if here < 0.0 {
            misses.push(Miss {
                place: pose.place,
                kind: pose.kind.to_string(),
                stage: pose.stage,
                tool: pose.tool,
                missing_mm: -here * 1000.0,
            });
        }
    }
    misses.sort_by(|a, b| b.missing_mm.total_cmp(&a.missing_mm));
    Test { margin, misses, tested }
}

/// Whether the two machines would meet with other geometries. `(index, geometry)` replaces that node's.
pub fn stands(line: &Line, proposal: &Proposal, (node, geometry): (usize, &Geometry)) -> bool {
    let of = |index: usize| if index == node { geometry } else { &line.nodes[index].geometry };
    let arm = arm(of(proposal.arm));
    all(line, proposal, of(proposal.passive())).iter().all(|pose| arm.margin(pose.tool) >= 0.0)
}
