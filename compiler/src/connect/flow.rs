//! The flow graph: machines are its nodes, handovers its edges.

use super::Line;
use petgraph::algo::dominators;
use petgraph::graph::{DiGraph, EdgeReference, NodeIndex};
use petgraph::visit::{Dfs, EdgeFiltered, FilterEdge, IntoNeighbors, Reversed, VisitMap, Visitable};

/// All handovers that the types propose, whether the machines meet or not, and behind these the ones that
/// lists of the layout withhold. Items enter at one node more, which leads to every source, and leave at
/// another, to which every destination leads.
#[derive(Clone, Debug)]
pub struct Flow {
    graph: Handovers,
    entry: NodeIndex,
    exit: NodeIndex,
}

/// An edge holds the number of its proposal; those of the entry and of the exit hold none.
type Handovers = DiGraph<(), Option<usize>>;

/// A bit for each node.
type Nodes = <Handovers as Visitable>::Map;

/// For each proposal whether its machines meet; those behind the last one do not.
#[derive(Clone, Copy)]
struct Standing<'s>(&'s [bool]);

impl FilterEdge<EdgeReference<'_, Option<usize>>> for Standing<'_> {
    fn include_edge(&self, edge: EdgeReference<'_, Option<usize>>) -> bool {
        edge.weight().is_none_or(|proposal| self.0.get(proposal).is_some_and(|stands| *stands))
    }
}

/// Which node gets to which along edges; a node gets to itself.
#[derive(Clone, Debug)]
pub struct Reach {
    rows: Vec<Nodes>,
}

/// Which nodes items get to, and from which they leave the layout.
#[derive(Clone, Debug)]
pub struct Served {
    /// For each node: some source gets to it.
    pub supplied: Vec<bool>,
    /// For each node: it gets to some destination.
    pub drained: Vec<bool>,
}

impl Flow {
    pub fn new(line: &Line) -> Self {
        let mut graph = DiGraph::with_capacity(line.nodes.len() + 2, line.proposals.len());
        let nodes: Vec<NodeIndex> = line.nodes.iter().map(|_| graph.add_node(())).collect();
        let [entry, exit] = [(); 2].map(|()| graph.add_node(()));
        for (&node, machine) in nodes.iter().zip(&line.nodes) {
            if machine.is_source {
                graph.add_edge(entry, node, None);
            }
            if machine.is_destination {
                graph.add_edge(node, exit, None);
            }
        }
        let withheld = line.withheld.iter().map(|withheld| &withheld.pair);
        for (number, proposal) in line.proposals.iter().chain(withheld).enumerate() {
            graph.add_edge(nodes[proposal.from], nodes[proposal.to], Some(number));
        }
        Self { graph, entry, exit }
    }

    fn standing<'a>(&'a self, stands: &'a [bool]) -> EdgeFiltered<&'a Handovers, Standing<'a>> {
        EdgeFiltered(&self.graph, Standing(stands))
    }

    fn machines(&self) -> impl Iterator<Item = NodeIndex> {
        self.graph.node_indices().filter(|node| ![self.entry, self.exit].contains(node))
    }

    /// With those proposals as edges for which `stands` is true.
    pub fn reach(&self, stands: &[bool]) -> Reach {
        let graph = self.standing(stands);
        Reach { rows: self.machines().map(|machine| found(&graph, machine)).collect() }
    }

    /// With those proposals as edges for which `stands` is true.
    pub fn served(&self, stands: &[bool]) -> Served {
        let graph = self.standing(stands);
        let of = |nodes: &Nodes| self.machines().map(|machine| nodes.is_visited(&machine)).collect();
        Served { supplied: of(&found(&graph, self.entry)), drained: of(&found(Reversed(&graph), self.exit)) }
    }
}

/// Machines that every item passes on its way from where items enter to where they leave, but for these, in the order in
/// which it does: if one of them is at rest, nothing leaves the layout. Machines by their numbers, and which leads to
/// which.
pub fn single_points(
    leads_to: impl IntoIterator<Item = [usize; 2]>,
    enters: &[usize],
    leaves: &[usize],
) -> Vec<usize> {
    let [entry, exit] = [0, 1];
    let node = |machine: usize| machine as u32 + 2;
    let inner = leads_to.into_iter().map(|[from, to]| (node(from), node(to)));
    let ends = enters.iter().map(|machine| (entry, node(*machine)));
    let ends = ends.chain(leaves.iter().map(|machine| (node(*machine), exit)));
    let graph: DiGraph<(), ()> = DiGraph::from_edges(inner.chain(ends));
    if graph.node_count() == 0 {
        return Vec::new();
    }
    let dominators = dominators::simple_fast(&graph, NodeIndex::from(entry));
    let passed = dominators.strict_dominators(NodeIndex::from(exit)).into_iter().flatten();
    let machines = passed.filter_map(|node| node.index().checked_sub(2));
    let mut passed: Vec<usize> =
        machines.filter(|machine| !enters.contains(machine) && !leaves.contains(machine)).collect();
    passed.reverse();
    passed
}

/// What a search from a node finds.
fn found<G>(graph: G, start: NodeIndex) -> Nodes
where
    G: IntoNeighbors<NodeId = NodeIndex> + Visitable<NodeId = NodeIndex, Map = Nodes>,
{
    let mut search = Dfs::new(graph, start);
    while search.next(graph).is_some() {}
    search.discovered
}

impl Reach {
    pub fn get(&self, from: usize, to: usize) -> bool {
        self.rows[from].is_visited(&NodeIndex::<u32>::new(to))
    }
}

impl Served {
    pub fn unreachable(&self) -> Vec<usize> {
        (0..self.supplied.len()).filter(|n| !self.supplied[*n]).collect()
    }

    pub fn dead_ends(&self) -> Vec<usize> {
        (0..self.drained.len()).filter(|n| !self.drained[*n]).collect()
    }

    /// Number of nodes between a source and a destination, ends included.
    pub fn connected(&self) -> usize {
        self.supplied.iter().zip(&self.drained).filter(|(supplied, drained)| **supplied && **drained).count()
    }
}
