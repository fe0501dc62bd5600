//! Ways along edges.

use super::Line;

/// Which node gets to which along edges; a node gets to itself.
#[derive(Clone, Debug)]
pub struct Reach {
    rows: Vec<Vec<bool>>,
}

impl Reach {
    fn new(nodes: usize, edges: impl Iterator<Item = (usize, usize)>) -> Self {
        let mut next = vec![Vec::new(); nodes];
        for (from, to) in edges {
            next[from].push(to);
        }
        let rows = (0..nodes)
            .map(|start| {
                let mut row = vec![false; nodes];
                let mut open = vec![start];
                while let Some(node) = open.pop() {
                    if !std::mem::replace(&mut row[node], true) {
                        open.extend(&next[node]);
                    }
                }
                row
            })
            .collect();
        Self { rows }
    }

    pub fn get(&self, from: usize, to: usize) -> bool {
        self.rows[from][to]
    }
}

/// Which nodes items get to, and from which they leave the layout.
#[derive(Clone, Debug)]
pub struct Ways {
    pub reach: Reach,
    /// For each node: some source gets to it.
    pub supplied: Vec<bool>,
    /// For each node: it gets to some destination.
    pub drained: Vec<bool>,
}

impl Ways {
    /// With those proposals as edges for which `stands` is true.
    pub fn new(line: &Line, stands: &[bool]) -> Self {
        let pairs = line.proposals.iter().zip(stands).filter(|(_, stands)| **stands);
        let nodes = &line.nodes;
        let reach = Reach::new(nodes.len(), pairs.map(|(p, _)| (p.from, p.to)));
        let any = |test: &dyn Fn(usize) -> bool| (0..nodes.len()).any(test);
        let supplied = (0..nodes.len()).map(|n| any(&|s| nodes[s].is_source && reach.get(s, n))).collect();
        let drained =
            (0..nodes.len()).map(|n| any(&|d| nodes[d].is_destination && reach.get(n, d))).collect();
        Self { reach, supplied, drained }
    }

    pub fn unreachable(&self) -> Vec<usize> {
        (0..self.supplied.len()).filter(|n| !self.supplied[*n]).collect()
    }

    pub fn dead_ends(&self) -> Vec<usize> {
        (0..self.drained.len()).filter(|n| !self.drained[*n]).collect()
    }

    /// Number of nodes on a way from a source to a destination.
    pub fn connected(&self) -> usize {
        self.supplied.iter().zip(&self.drained).filter(|(supplied, drained)| **supplied && **drained).count()
    }
}
