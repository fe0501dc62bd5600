//! Does every item that enters the layout leave it?
//!
//! Two machines whose types hand over to each other meet if the arm of the one
//! reaches every place of the other, at contact and above it. From these edges
//! follows which machines lie on a path from a source to a destination.

mod flow;
mod near;
mod poses;
mod suggestion;
mod verdict;
mod withheld;

#[cfg(test)]
mod tests;

pub use flow::single_points;
pub use near::Ground;

use crate::device::Placed;
use crate::diagnostic::Diagnostic;
use crate::layout::Number;
use crate::parallel::{LEAST, in_parts};
use crate::source::Span;
use std::collections::BTreeMap;

/// A machine that hands over or takes.
#[derive(Clone, Debug)]
pub struct Node {
    pub name: String,
    /// Its JSON object.
    pub span: Span,
    pub placed: Placed,
    /// Those numbers of its JSON object that may be changed so that machines meet.
    pub numbers: Vec<Number>,
    /// Items enter the layout here.
    pub is_source: bool,
    /// Items leave the layout here.
    pub is_destination: bool,
}

/// Where the passive one of two machines hands over or takes.
#[derive(Clone, Debug)]
pub struct Site {
    /// As in [`Placed::handover`].
    pub name: String,
    pub index: Option<usize>,
    /// At least 1.
    pub capacity: usize,
    /// Height over contact from which the arm comes, m.
    pub approach: f64,
}

/// Two machines whose types hand items over; indices of nodes.
#[derive(Clone, Debug)]
pub struct Proposal {
    pub from: usize,
    pub to: usize,
    /// Which of the two is the arm.
    pub arm: usize,
    pub site: Site,
    /// Where the automaton declares it.
    pub rule: Span,
    /// Whether `takes_from` or `hands_to` of the arm names the passive machine.
    pub is_named: bool,
}

/// A pair that would be a proposal, but for a list of the layout that does not name the passive machine.
#[derive(Clone, Debug)]
pub struct Withheld {
    pub pair: Proposal,
    /// `takes_from` or `hands_to` of the arm.
    pub list: Span,
}

/// All that connectivity depends on.
#[derive(Clone, Debug)]
pub struct Line {
    /// The layout's file, for what concerns no single machine.
    pub span: Span,
    /// In layout order.
    pub nodes: Vec<Node>,
    pub proposals: Vec<Proposal>,
    /// What is told where they would connect machines that are cut off.
    pub withheld: Vec<Withheld>,
    /// Name, and height of the grip point over the underside, m, of each kind of part.
    pub kinds: Vec<(String, f64)>,
}

/// Two machines that meet.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    pub from: usize,
    pub to: usize,
    /// How far the arm stays within its reach at the worst pose, m.
    pub margin: f64,
    /// How far the last three joints stay from their limits there, deg; none without limits.
    pub wrist_room: Option<f64>,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stage {
    /// The tool touches the item.
    Contact,
    /// The tool is above, where it comes from and goes to.
    Approach,
}

/// A pose of the tool that the arm does not reach.
#[derive(Clone, Debug, PartialEq)]
pub struct Miss {
    /// Name of the place.
    pub place: String,
    pub kind: String,
    pub stage: Stage,
    /// Where the tool would be.
    pub tool: runtime_sim::point::Point,
    /// By how much it is out of reach, mm; infinite for an arm whose tool does not point there at all.
    pub missing_mm: f64,
}

/// One number whose change makes two machines meet: by whole millimetres, and one fewer is not enough.
#[derive(Clone, Debug, PartialEq)]
pub struct Suggestion {
    pub node: usize,
    pub path: String,
    pub span: Span,
    pub present: f64,
    pub value: f64,
    /// Change in mm, signed.
    pub change_mm: i32,
    /// Nodes on a path from a source to a destination after the change.
    pub connected: usize,
    /// Indices of all proposals whose machines meet only after the change.
    pub joined: Vec<usize>,
}

/// A turn of one machine about its own place that makes two machines meet: by whole degrees, and one fewer is not enough.
#[derive(Clone, Debug, PartialEq)]
pub struct Turn {
    pub node: usize,
    /// Yaw of its pose, degrees to the left.
    pub present: f64,
    pub value: f64,
    /// Change in degrees, signed.
    pub change_deg: i32,
    /// Nodes on a path from a source to a destination after the turn.
    pub connected: usize,
}

/// Two machines that should meet and do not.
#[derive(Clone, Debug)]
pub struct Failure {
    /// Index of the proposal.
    pub proposal: usize,
    /// All poses that miss, the worst first; sought only in a layout that is not connected.
    pub misses: Vec<Miss>,
    /// Number of all poses, as far as those that miss were sought.
    pub tested: usize,
    /// Sought only in a layout that is not connected.
    pub suggestion: Option<Suggestion>,
    /// The same; it connects no fewer nodes than the suggestion.
    pub turn: Option<Turn>,
}

/// What the check found, whether the layout is connected or not.
#[derive(Clone, Debug)]
pub struct Report {
    /// In layout order of `from`, then of `to`.
    pub edges: Vec<Edge>,
    pub failures: Vec<Failure>,
    /// Nodes between sources and destinations through which every item goes, in that order.
    pub single_points: Vec<usize>,
    /// Nodes that no item ever gets to.
    pub unreachable: Vec<usize>,
    /// Nodes from which no item ever leaves the layout.
    pub dead_ends: Vec<usize>,
    /// Empty exactly when the layout is connected.
    pub diagnostics: Vec<Diagnostic>,
    connected: Option<Connected>,
}

/// Proof that every node lies on a path from a source to a destination. Only [`check`] makes one.
#[derive(Clone, Debug)]
pub struct Connected {
    edges: Vec<Edge>,
    reach: flow::Reach,
}

impl Connected {
    /// In layout order of `from`, then of `to`.
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Nodes that `node` hands over to, in layout order.
    pub fn targets(&self, node: usize) -> impl Iterator<Item = usize> {
        self.edges.iter().filter(move |edge| edge.from == node).map(|edge| edge.to)
    }

    /// Nodes that `node` takes from, in layout order.
    pub fn origins(&self, node: usize) -> impl Iterator<Item = usize> {
        self.edges.iter().filter(move |edge| edge.to == node).map(|edge| edge.from)
    }

    /// Whether an item at `from` can get to `to` along edges; a node reaches itself.
    pub fn reaches(&self, from: usize, to: usize) -> bool {
        self.reach.get(from, to)
    }
}

impl Report {
    pub fn is_feasible(&self) -> bool {
        self.connected.is_some()
    }

    /// The proof, or what is wrong.
    pub fn connected(self) -> Result<Connected, Vec<Diagnostic>> {
        self.connected.ok_or(self.diagnostics)
    }
}

/// Which machines meet, and whether that is enough.
///
/// # Panics
/// If a proposal names a node that is not there, an arm that is none, or a site that its machine does not have:
/// types are bound to machines before.
pub fn check(line: &Line) -> Report {
    let reachable = poses::Reachable::new(line);
    let met: Vec<Option<poses::Met>> = in_parts(&line.proposals, LEAST, |proposals| {
        proposals.iter().map(|proposal| reachable.met(proposal)).collect()
    });
    let stands: Vec<bool> = met.iter().map(Option::is_some).collect();
    let edges = edges(line, &met);
    let flow = flow::Flow::new(line);
    let served = flow.served(&stands);
    // A pair that does not meet matters only where machines are cut off.
    let is_whole = served.connected() == line.nodes.len();
    let sought = if is_whole { 0 } else { most_suggestions(line) };
    let apart = (0..line.proposals.len()).filter(|proposal| !stands[*proposal]);
    let failures: Vec<Failure> = (apart.enumerate())
        .map(|(number, proposal)| {
            let pair = &line.proposals[proposal];
            let (misses, tested) = if is_whole { (Vec::new(), 0) } else { reachable.misses(pair) };
            let suggestion = (number < sought)
                .then(|| suggestion::find(line, &flow, &reachable, &stands, proposal))
                .flatten();
            let turn = (number < sought)
                .then(|| suggestion::turn(line, &flow, &reachable, &stands, proposal))
                .flatten()
                .filter(|turn| suggestion.as_ref().is_none_or(|other| turn.connected >= other.connected));
            Failure { proposal, misses, tested, suggestion, turn }
        })
        .collect();
    let met: Vec<usize> = withheld::met(line, &reachable, &stands).take(sought).collect();
    let diagnostics = verdict::diagnostics(line, &flow, &stands, &failures, &met);
    let those = |wanted: fn(&Node) -> bool| -> Vec<usize> {
        (0..line.nodes.len()).filter(|node| wanted(&line.nodes[*node])).collect()
    };
    let single_points = single_points(
        edges.iter().map(|edge| [edge.from, edge.to]),
        &those(|node| node.is_source),
        &those(|node| node.is_destination),
    );
    let connected =
        diagnostics.is_empty().then(|| Connected { edges: edges.clone(), reach: flow.reach(&stands) });
    Report {
        edges,
        failures,
        single_points,
        unreachable: served.unreachable(),
        dead_ends: served.dead_ends(),
        diagnostics,
        connected,
    }
}

/// Pairs that do not meet for which a suggestion is sought, and which are compared with one another: fewer in a long
/// line, where each costs more.
fn most_suggestions(line: &Line) -> usize {
    const WORK: usize = 20_000_000;
    (WORK / (line.nodes.len() + line.proposals.len()).max(1)).isqrt().max(8)
}

/// Of several ways to hand over the one with the greatest margin counts.
fn edges(line: &Line, met: &[Option<poses::Met>]) -> Vec<Edge> {
    let mut best: BTreeMap<(usize, usize), poses::Met> = BTreeMap::new();
    for (proposal, met) in line.proposals.iter().zip(met) {
        if let Some(met) = *met {
            let best = best.entry((proposal.from, proposal.to)).or_insert(met);
            if met.margin > best.margin {
                *best = met;
            }
        }
    }
    let edge = |((from, to), poses::Met { margin, wrist_room })| Edge { from, to, margin, wrist_room };
    best.into_iter().map(edge).collect()
}

impl Proposal {
    /// The machine that is at rest while the arm comes.
    pub fn passive(&self) -> usize {
        if self.arm == self.from { self.to } else { self.from }
    }
}
