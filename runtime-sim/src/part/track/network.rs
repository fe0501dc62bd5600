//! Nodes and the edges between them, on which vehicles find their way.

use super::polyline::{Polyline, Limits};
use crate::point::Point;
use std::cmp::Ordering;
use std::collections::BinaryHeap;

/// Nodes and edges at most.
pub const MOST_NODES: usize = 256;
pub const MOST_EDGES: usize = 1024;
/// Nodes nearer to one another have no edge, m.
const SHORTEST: f64 = 1e-3;
/// What is rounded differs by no more than such a part.
const SAME: f64 = 1e-9;

#[derive(Clone, Debug, PartialEq)]
pub struct Network {
    pub nodes: Vec<Point>,
    pub edges: Vec<Edge>,
    /// Of each node, the edges that lead away from it.
    away: Vec<Vec<usize>>,
}

/// Straight from a node to another one, in this direction only.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Edge {
    pub from: usize,
    pub to: usize,
    /// m/s
    pub speed: f64,
}

impl Network {
    /// `ends` are pairs of numbers of nodes; without `speeds` no edge has a limit of its own. An error says what is wrong.
    pub fn new(nodes: Vec<Point>, ends: &[f64], speeds: Option<&[f64]>) -> Result<Self, String> {
        if nodes.len() < 2 || nodes.len() > MOST_NODES {
            return Err(format!("{} nodes, there are 2 to {MOST_NODES}", nodes.len()));
        }
        if let Some(number) = nodes.iter().position(|node| node.z != nodes[0].z) {
            return Err(format!("node {number} is at another height: all nodes have the same z"));
        }
        let (pairs, rest) = ends.as_chunks::<2>();
        if !rest.is_empty() || pairs.is_empty() || pairs.len() > MOST_EDGES {
            return Err(format!("`edges` are 1 to {MOST_EDGES} pairs of nodes, these are {} numbers", ends.len()));
        }
        if let Some(speeds) = speeds.filter(|speeds| speeds.len() != pairs.len()) {
            return Err(format!("{} speeds of {} edges", speeds.len(), pairs.len()));
        }
        let mut edges = Vec::new();
        for (number, pair) in pairs.iter().enumerate() {
            let is_node = |end: &f64| end.fract() == 0.0 && (0.0..nodes.len() as f64).contains(end);
            if let Some(wrong) = pair.iter().find(|end| !is_node(end)) {
                return Err(format!("edge {number} ends at node {wrong}, nodes are 0 to {}", nodes.len() - 1));
            }
            let [from, to] = pair.map(|end| end as usize);
            if (nodes[to] - nodes[from]).length() < SHORTEST {
                return Err(format!("edge {number} from node {from} to node {to} has no length"));
            }
            if edges.iter().any(|edge: &Edge| (edge.from, edge.to) == (from, to)) {
                return Err(format!("two edges lead from node {from} to node {to}"));
            }
            let speed = speeds.map_or(f64::INFINITY, |speeds| speeds[number]);
            if speed <= 0.0 {
                return Err(format!("the speed of edge {number} from node {from} to node {to} is not over 0"));
            }
            edges.push(Edge { from, to, speed });
        }
        let leads = |node: usize| edges.iter().enumerate().filter(move |(_, edge)| edge.from == node);
        let away = (0..nodes.len()).map(|node| leads(node).map(|(number, _)| number).collect()).collect();
        Ok(Self { nodes, edges, away })
    }

    /// The direction of an edge, degrees, and both ends.
    pub fn driven(&self, edge: &Edge) -> (f64, [Point; 2]) {
        let ends = [edge.from, edge.to].map(|node| self.nodes[node]);
        let ahead = ends[1] - ends[0];
        (libm::atan2(ahead.y, ahead.x).to_degrees(), ends)
    }

    /// The first node that no way leads to from this one, or that no way leads back from.
    pub fn cut_off(&self, begin: usize) -> Option<String> {
        let mut back = self.clone();
        for (number, edge) in self.edges.iter().enumerate() {
            back.edges[number] = Edge { from: edge.to, to: edge.from, ..*edge };
        }
        back.away.iter_mut().for_each(Vec::clear);
        for (number, edge) in back.edges.iter().enumerate() {
            back.away[edge.from].push(number);
        }
        let none = |network: &Self| {
            let found = network.ways(begin, 1.0);
            found.iter().enumerate().position(|(node, way)| node != begin && way.is_none())
        };
        if let Some(node) = none(self) {
            return Some(format!("no way leads from node {begin}, where it begins, to node {node}"));
        }
        none(&back).map(|node| format!("no way leads from node {node} back to node {begin}, where it begins"))
    }

    /// The edges of the quickest way of a vehicle with this speed, m/s, if it did not stop on it; of equals that with the
    /// edges of lower numbers. Empty if both are the same node; none if there is no way.
    pub fn way(&self, from: usize, to: usize, speed: f64) -> Option<Vec<usize>> {
        let last = self.ways(from, speed);
        let mut way = Vec::new();
        let mut node = to;
        while node != from {
            let edge = last[node]?;
            way.push(edge);
            node = self.edges[edge].from;
        }
        way.reverse();
        Some(way)
    }

    /// Of each node, the last edge of the way to it.
    fn ways(&self, from: usize, speed: f64) -> Vec<Option<usize>> {
        let mut last = vec![None; self.nodes.len()];
        let mut seconds = vec![f64::INFINITY; self.nodes.len()];
        let mut open = BinaryHeap::from([Reached { seconds: 0.0, node: from }]);
        seconds[from] = 0.0;
        while let Some(Reached { seconds: begin, node }) = open.pop() {
            if begin > seconds[node] {
                continue;
            }
            for &edge in &self.away[node] {
                let Edge { to, speed: limit, .. } = self.edges[edge];
                let end = begin + self.length(edge) / speed.min(limit);
                let is_same = (end - seconds[to]).abs() <= SAME * end;
                let is_better = match last[to] {
                    Some(last) if is_same => edge < last,
                    _ => end < seconds[to],
                };
                if to != from && is_better {
                    (seconds[to], last[to]) = (end, Some(edge));
                    open.push(Reached { seconds: end, node: to });
                }
            }
        }
        last
    }

    pub fn length(&self, edge: usize) -> f64 {
        let Edge { from, to, .. } = self.edges[edge];
        (self.nodes[to] - self.nodes[from]).length()
    }

    /// Where a vehicle looks that has not left this node yet: unit vector along the first edge.
    pub fn ahead(&self, node: usize) -> Point {
        let along = |edge: &usize| {
            let Edge { from, to, .. } = self.edges[*edge];
            (self.nodes[to] - self.nodes[from]).scaled(1.0 / self.length(*edge))
        };
        self.away[node].first().map_or(Point::new(1.0, 0.0, 0.0), along)
    }

    /// From a node to the next one.
    pub fn edge(&self, from: usize, to: usize) -> Option<usize> {
        self.away[from].iter().copied().find(|edge| self.edges[*edge].to == to)
    }

    /// The line over these edges, behind a lead to the first node if there is one. Where it turns back a vehicle stops that
    /// is so fast, m/s.
    pub fn polyline(&self, lead: Option<Point>, edges: &[usize], fast: f64) -> Result<Polyline, String> {
        let first = edges.first().map(|edge| self.nodes[self.edges[*edge].from]);
        let ends = edges.iter().map(|edge| self.nodes[self.edges[*edge].to]);
        let corners: Vec<Point> = lead.into_iter().chain(first).chain(ends).collect();
        let mut limits: Vec<Limits> = Vec::new();
        let speeds = edges.iter().map(|edge| self.edges[*edge].speed);
        let lead_speed = lead.and(edges.first()).map(|edge| self.edges[*edge].speed);
        for (number, speed) in lead_speed.into_iter().chain(speeds).enumerate() {
            let turns_back = number > 0 && {
                let [before, after] = [number - 1, number].map(|corner| corners[corner + 1] - corners[corner]);
                before.dot(after) < -SAME * before.length() * after.length()
            };
            let stands = number == 1 && lead.is_some() && fast == 0.0;
            limits.push(Limits { speed, entry: if turns_back && !stands { 0.0 } else { f64::INFINITY } });
        }
        Ok(Polyline::new(&corners, false)?.limited(limits))
    }
}

/// The least time is the greatest; of equals the node of the lowest number.
#[derive(PartialEq)]
struct Reached {
    seconds: f64,
    node: usize,
}

impl Eq for Reached {}

impl Ord for Reached {
    fn cmp(&self, other: &Self) -> Ordering {
        other.seconds.total_cmp(&self.seconds).then(other.node.cmp(&self.node))
    }
}

impl PartialOrd for Reached {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// With all nodes turned about the origin.
    fn network(nodes: &[[f64; 2]], degrees: f64, ends: &[f64]) -> Network {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let turned = |[x, y]: &[f64; 2]| Point::new(cos * x - sin * y, sin * x + cos * y, 0.0);
        Network::new(nodes.iter().map(turned).collect(), ends, None).expect("a network")
    }

    #[test]
    fn at_right_angles_nothing_stops_however_it_lies() {
        let square = [[0.0, 0.0], [6.0, 0.0], [6.0, 6.0], [0.0, 6.0]];
        for degrees in 0..180 {
            let network = network(&square, f64::from(degrees), &[0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 0.0]);
            let line = network.polyline(None, &[0, 1, 2], 0.0).expect("a line");
            let stretches = line.stretches(0.0, line.length());
            assert!(stretches.iter().all(|stretch| stretch.limits.entry > 0.0), "{degrees} degrees");
        }
    }

    #[test]
    fn of_equal_ways_the_one_with_lower_numbers_is_taken_however_it_lies() {
        let diamond = [[0.0, 1.9], [4.0, 1.9], [8.0, 4.4], [8.0, -0.6], [12.0, 1.9]];
        let ends = [0.0, 1.0, 1.0, 2.0, 2.0, 4.0, 1.0, 3.0, 3.0, 4.0, 4.0, 0.0];
        for degrees in 0..180 {
            let network = network(&diamond, f64::from(degrees), &ends);
            assert_eq!(network.way(0, 4, 1.0), Some(vec![0, 1, 2]), "{degrees} degrees");
        }
    }
}
