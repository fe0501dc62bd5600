//! The key `routes`: nodes, and edges between them, on which vehicles drive.

use super::decode::{Decoder, instead, some};
use super::json::{Json, Member, Value as Given};
use crate::diagnostic::Diagnostic;
use crate::source::Spanned;
use runtime_sim::point::Point;
use runtime_sim::value::Value;

/// One graph, which several vehicles may have in common.
#[derive(Clone, Debug, PartialEq)]
pub struct Routes {
    pub name: Spanned<String>,
    pub nodes: Vec<(Spanned<String>, Point)>,
    /// Each from one node to another one, by their numbers.
    edges: Vec<Edge>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Edge {
    ends: [usize; 2],
    /// m/s
    speed: f64,
}

/// No vehicle is faster, m/s: an edge without a speed.
pub const FASTEST: f64 = 1000.0;

const OF_ROUTES: [&str; 2] = ["nodes", "edges"];
const OF_EDGE: [&str; 4] = ["from", "to", "speed", "both_ways"];

impl Routes {
    pub fn node(&self, name: &str) -> Option<usize> {
        self.nodes.iter().position(|(known, _)| known.value == name)
    }

    /// Places of the nodes, numbers of the nodes of each edge, and its speed.
    pub fn value(&self) -> Value {
        let number = |number: f64| Value::Number(number);
        let nodes = self.nodes.iter().map(|(_, point)| Value::Point(*point));
        let ends = self.edges.iter().flat_map(|edge| edge.ends.map(|end| number(end as f64)));
        let speeds = self.edges.iter().map(|edge| number(edge.speed));
        Value::List(vec![
            Value::List(nodes.collect()),
            Value::List(ends.collect()),
            Value::List(speeds.collect()),
        ])
    }
}

impl Decoder {
    pub(super) fn all_routes(&mut self, json: &Json) -> Vec<Routes> {
        let members = self.object(json, "routes").unwrap_or_default();
        self.distinct(members.iter().map(|member| &member.key), "routes");
        members.iter().filter_map(|member| self.routes(member)).collect()
    }

    fn routes(&mut self, member: &Member) -> Option<Routes> {
        let what = format!("routes.{}", member.key.value);
        self.identifier(&member.key, "routes");
        let members = self.object(&member.value, &what)?;
        self.unknown_keys(members, &OF_ROUTES, &what);
        let nodes = self.required(members, "nodes", member.value.span, &what);
        let nodes = nodes.and_then(|json| self.object(json, &format!("{what}.nodes"))).unwrap_or_default();
        self.distinct(nodes.iter().map(|node| &node.key), "a node");
        let nodes: Vec<_> = nodes.iter().filter_map(|node| self.node(node)).collect();
        let edges = self.required(members, "edges", member.value.span, &what);
        let edges = edges.and_then(|json| self.list(json, format_args!("{what}.edges"))).unwrap_or_default();
        let edges = edges.iter().filter_map(|edge| self.edge(edge, &nodes)).flatten().collect();
        Some(Routes { name: member.key.clone(), nodes, edges })
    }

    fn node(&mut self, node: &Member) -> Option<(Spanned<String>, Point)> {
        self.identifier(&node.key, "a node");
        let point = self.point(&node.value, &node.key.value)?;
        Some((node.key.clone(), point))
    }

    /// One edge, or two if vehicles drive both ways.
    fn edge(&mut self, json: &Json, nodes: &[(Spanned<String>, Point)]) -> Option<Vec<Edge>> {
        let what = "an edge";
        let members = self.object(json, what)?;
        self.unknown_keys(members, &OF_EDGE, what);
        let mut end = |key: &str| {
            let json = self.required(members, key, json.span, what)?;
            let name = self.text(json, key)?;
            let found = nodes.iter().position(|(known, _)| known.value == name.value);
            if found.is_none() {
                let known: Vec<&str> = nodes.iter().map(|(name, _)| name.value.as_str()).collect();
                let message = format!("there is no node \"{}\"", name.value);
                let found = Diagnostic::new("E0155", name.span, message);
                self.report(
                    found.note(format!("the nodes are {}", some(&known))).help(instead(&name.value, &known)),
                );
            }
            found
        };
        let (from, to) = (end("from"), end("to"));
        let speed = super::decode::find(members, "speed");
        let speed = speed.map_or(Some(FASTEST), |json| self.number_in(json, "speed", 0.001..=FASTEST))?;
        let both = super::decode::find(members, "both_ways").is_some_and(|json| match json.value {
            Given::Bool(both) => both,
            _ => {
                self.wrong_type(json, "both_ways", "true or false");
                false
            }
        });
        let there = Edge { ends: [from?, to?], speed };
        let back = Edge { ends: [there.ends[1], there.ends[0]], speed };
        Some(if both { vec![there, back] } else { vec![there] })
    }
}
