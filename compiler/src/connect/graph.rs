//! Ways along edges.

use super::{Line, Node};

/// Which node gets to which along edges; a node gets to itself.
#[derive(Clone, Debug)]
pub struct Reach {
    /// A bit for each node to which one gets, 64 in a word.
    rows: Vec<Vec<u64>>,
}

const BITS: usize = u64::BITS as usize;

impl Reach {
    /// With those proposals as edges for which `stands` is true.
    pub fn new(line: &Line, stands: &[bool]) -> Self {
        let mut next = vec![Vec::new(); line.nodes.len()];
        for (pair, _) in line.proposals.iter().zip(stands).filter(|(_, stands)| **stands) {
            next[pair.from].push(pair.to);
        }
        Self::along(&next)
    }

    fn along(next: &[Vec<usize>]) -> Self {
        let row = |start: usize| {
            let mut row = vec![0; next.len().div_ceil(BITS)];
            walk(next, [start], |node| {
                let (word, bit): (&mut u64, u64) = (&mut row[node / BITS], 1 << (node % BITS));
                let is_new = *word & bit == 0;
                *word |= bit;
                is_new
            });
            row
        };
        Self { rows: (0..next.len()).map(row).collect() }
    }

    pub fn get(&self, from: usize, to: usize) -> bool {
        self.rows[from][to / BITS] >> (to % BITS) & 1 == 1
    }
}

/// Goes along edges from all the starts; `see` answers whether a node is seen for the first time.
fn walk(next: &[Vec<usize>], starts: impl IntoIterator<Item = usize>, mut see: impl FnMut(usize) -> bool) {
    let mut open: Vec<usize> = starts.into_iter().collect();
    while let Some(node) = open.pop() {
        if see(node) {
            open.extend(&next[node]);
        }
    }
}

/// For each node whether a way leads to it from one of the starts.
fn reached(next: &[Vec<usize>], starts: impl IntoIterator<Item = usize>) -> Vec<bool> {
    let mut reached = vec![false; next.len()];
    walk(next, starts, |node| !std::mem::replace(&mut reached[node], true));
    reached
}

/// Which nodes items get to, and from which they leave the layout.
#[derive(Clone, Debug)]
pub struct Ways {
    /// For each node: some source gets to it.
    pub supplied: Vec<bool>,
    /// For each node: it gets to some destination.
    pub drained: Vec<bool>,
}

impl Ways {
    /// With those proposals as edges for which `stands` is true.
    pub fn new(line: &Line, stands: &[bool]) -> Self {
        let nodes = &line.nodes;
        let (mut next, mut before) = (vec![Vec::new(); nodes.len()], vec![Vec::new(); nodes.len()]);
        for (pair, _) in line.proposals.iter().zip(stands).filter(|(_, stands)| **stands) {
            next[pair.from].push(pair.to);
            before[pair.to].push(pair.from);
        }
        let those = |wanted: fn(&Node) -> bool| (0..nodes.len()).filter(move |n| wanted(&nodes[*n]));
        let supplied = reached(&next, those(|node| node.is_source));
        let drained = reached(&before, those(|node| node.is_destination));
        Self { supplied, drained }
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
