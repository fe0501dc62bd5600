//! Which nodes and edges are tracks: a closed way in one direction, or a way to and fro between two ends.

use super::read::{Edge, Network, Node};
use crate::diagnostic::Diagnostic;
use crate::layout::decode::{Decoder, listing};
use crate::source::Spanned;
use runtime_sim::point::Point;

/// Nodes one behind the other.
pub struct Track {
    /// Indices of nodes; of a closed track the first one does not come again.
    pub nodes: Vec<usize>,
    pub closed: bool,
    /// There are edges in the other direction too.
    pub both_ways: bool,
    /// Least of its edges, whatever their direction, m/s; none if no edge has one.
    pub speed: Option<f64>,
    /// Edges have different speeds.
    pub has_speeds: bool,
    /// Names of edges that have none.
    pub without_speed: Vec<String>,
    /// Numbers of those of its nodes that are goals.
    pub places: Vec<usize>,
    /// From the first corner to each node, m.
    pub distances: Vec<f64>,
}

/// Goals of a vehicle, as the primitive has them.
const MOST_PLACES: usize = 32;
/// Corners of a track.
const MOST_NODES: usize = 1000;
/// Two nodes nearer than this are one corner, m.
const NEAREST: f64 = 0.001;

/// All tracks; a node without edges belongs to none. None if something cannot be said as a track, which is reported.
pub fn find(decoder: &mut Decoder, network: &Network) -> Option<Vec<Track>> {
    let mut beside: Vec<Vec<usize>> = vec![Vec::new(); network.nodes.len()];
    for edge in &network.edges {
        for (one, other) in [(edge.from, edge.to), (edge.to, edge.from)] {
            if !beside[one].contains(&other) {
                beside[one].push(other);
            }
        }
        let ends = [edge.from, edge.to].map(|node| network.nodes[node].at);
        if (ends[0] - ends[1]).length() < NEAREST {
            decoder.report(
                Diagnostic::new("E1112", edge.id.span, format!("the edge {} has no length", edge.id.value))
                    .help("join its nodes to one"),
            );
        }
    }
    let is_junction = |node: &usize| beside[*node].len() > 2;
    let junctions: Vec<usize> = (0..network.nodes.len()).filter(is_junction).collect();
    if let Some(first) = junctions.first() {
        let name = |node: &usize| network.nodes[*node].id.value.as_str();
        let all: Vec<&str> = junctions.iter().take(8).map(name).collect();
        let neighbours: Vec<&str> = beside[*first].iter().map(name).collect();
        let message = format!(
            "{} is a junction: edges lead from or to {}",
            network.nodes[*first].id.value,
            listing(&neighbours)
        );
        decoder.report(
            Diagnostic::new("E1112", network.nodes[*first].id.span, message)
                .note(format!("junctions of the file: {} ({})", junctions.len(), all.join(", ")))
                .note("what is imported is one closed way, or one way between two ends, without junctions")
                .help("export each loop that a vehicle drives as a layout of its own, or write the network by hand: a track takes `nodes` and `edges`, a layout `routes`"),
        );
    }
    if network.edges.is_empty() && decoder.diagnostics.is_empty() {
        decoder.report(
            Diagnostic::new("E1112", network.span, "there are no edges").help("name a file with edges"),
        );
    }
    if !decoder.diagnostics.is_empty() {
        return None;
    }
    let mut tracks = Vec::new();
    let mut is_on_track = vec![false; network.nodes.len()];
    // Ends first: what is left then is closed.
    let ends = (0..network.nodes.len()).filter(|node| beside[*node].len() == 1);
    let closed = (0..network.nodes.len()).filter(|node| beside[*node].len() == 2);
    for start in ends.chain(closed) {
        if is_on_track[start] {
            continue;
        }
        let mut nodes = vec![start];
        is_on_track[start] = true;
        while let Some(next) =
            nodes.last().and_then(|last| beside[*last].iter().find(|next| !is_on_track[**next]))
        {
            is_on_track[*next] = true;
            nodes.push(*next);
        }
        let closed = beside[start].len() == 2;
        tracks.extend(track(decoder, network, nodes, closed));
    }
    Some(tracks).filter(|_| decoder.diagnostics.is_empty())
}

fn track(decoder: &mut Decoder, network: &Network, mut nodes: Vec<usize>, closed: bool) -> Option<Track> {
    let place = network.nodes[nodes[0]].id.span;
    if nodes.len() > MOST_NODES {
        let message = format!("this track has {} nodes, and {MOST_NODES} are the most", nodes.len());
        decoder.report(
            Diagnostic::new("E1112", place, message).help("leave out nodes that lie on a straight line"),
        );
        return None;
    }
    let legs = |nodes: &[usize]| -> Vec<(usize, usize)> {
        let behind = nodes.iter().copied().skip(1).chain(closed.then_some(nodes[0]));
        nodes.iter().copied().zip(behind).collect()
    };
    let edge =
        |from: usize, to: usize| network.edges.iter().find(move |edge| (edge.from, edge.to) == (from, to));
    let leads = |nodes: &[usize]| legs(nodes).into_iter().all(|(from, to)| edge(from, to).is_some());
    let backwards: Vec<usize> = match closed {
        true => nodes[..1].iter().chain(nodes[1..].iter().rev()).copied().collect(),
        false => nodes.iter().rev().copied().collect(),
    };
    let (forth, back) = (leads(&nodes), leads(&backwards));
    match (forth, back) {
        (false, true) => nodes = backwards,
        (false, false) => {
            let against = legs(&nodes).into_iter().find(|(from, to)| edge(*from, *to).is_none());
            let against = against.map_or(nodes[0], |(from, _)| from);
            let Node { id, .. } = &network.nodes[against];
            let message = format!("at {} edges lead against one another", id.value);
            decoder.report(
                Diagnostic::new("E1112", id.span, message)
                    .note("a track is driven in one direction throughout, or in both")
                    .help("turn an edge round, or add the edges of the other direction"),
            );
            return None;
        }
        (true, false) => {
            let behind = legs(&nodes).into_iter().find_map(|(from, to)| edge(to, from));
            if let Some(edge) = behind {
                let Spanned { value, span } = &edge.id;
                decoder.report(
                    Diagnostic::new(
                        "E1112",
                        *span,
                        format!("the edge {value} leads against the others of its track"),
                    )
                    .note("a track is driven in one direction throughout, or in both")
                    .help("leave it out, or add the other edges of its direction"),
                );
                return None;
            }
        }
        (true, true) => {}
    }
    let at: Vec<Point> = nodes.iter().map(|node| network.nodes[*node].at).collect();
    let mut distances = vec![0.0];
    for pair in at.windows(2) {
        distances.push(distances[distances.len() - 1] + (pair[1] - pair[0]).length());
    }
    let stations: Vec<usize> =
        (0..nodes.len()).filter(|number| !network.nodes[nodes[*number]].stations.is_empty()).collect();
    let places = if nodes.len() <= MOST_PLACES { (0..nodes.len()).collect() } else { stations };
    if places.is_empty() || places.len() > MOST_PLACES {
        let message = format!(
            "this track has {} nodes, {} of them at stations, and a vehicle has at most {MOST_PLACES} goals",
            nodes.len(),
            places.len()
        );
        decoder.report(
            Diagnostic::new("E1112", place, message)
                .help("name the nodes that are goals in stations, and leave out the others"),
        );
        return None;
    }
    let edges: Vec<&Edge> = network.edges.iter().filter(|edge| nodes.contains(&edge.from)).collect();
    let speeds: Vec<f64> = edges.iter().filter_map(|edge| edge.speed).collect();
    let speed = speeds.iter().copied().reduce(f64::min);
    let has_speeds = speeds.iter().any(|other| Some(*other) != speed);
    let without_speed =
        edges.iter().filter(|edge| edge.speed.is_none()).map(|edge| edge.id.value.clone()).collect();
    Some(Track {
        nodes,
        closed,
        both_ways: forth && back,
        speed,
        has_speeds,
        without_speed,
        places,
        distances,
    })
}
