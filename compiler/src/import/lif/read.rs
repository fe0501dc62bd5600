//! From JSON to nodes and edges of one type of vehicle. Keys that are not needed here are passed over, as the format says.

use crate::diagnostic::Diagnostic;
use crate::layout::decode::{Decoder, find, listing};
use crate::layout::json::{Json, Member, Value};
use crate::source::{Span, Spanned};
use runtime_sim::point::Point;
use std::collections::{BTreeSet, HashMap};

/// No vehicle is slower, m/s: less is hardly meant.
const SLOWEST: f64 = 1e-3;

pub struct Network {
    pub project: String,
    pub vehicle: String,
    /// `layouts`
    pub span: Span,
    pub nodes: Vec<Node>,
    pub edges: Vec<Edge>,
}

pub struct Node {
    pub id: Spanned<String>,
    /// On the floor, m.
    pub at: Point,
    /// Names of the stations where vehicles stop here.
    pub stations: Vec<String>,
}

/// From one node to another one; indices.
pub struct Edge {
    pub id: Spanned<String>,
    pub from: usize,
    pub to: usize,
    /// m/s
    pub speed: Option<f64>,
}

/// Nodes by their names; none of one without a place, which is reported.
type Places = HashMap<String, (Option<usize>, Spanned<String>)>;

/// m
const FARTHEST: f64 = 1e5;
/// What a curve may leave the straight line, m.
const STRAIGHT: f64 = 0.005;

pub fn network(decoder: &mut Decoder, json: &Json, vehicle: Option<&str>) -> Option<Network> {
    let members = decoder.object(json, "a LIF file")?;
    let meta = decoder.required(members, "metaInformation", json.span, "the LIF file");
    let project = meta.and_then(|meta| version(decoder, meta));
    let layouts = decoder.required(members, "layouts", json.span, "the LIF file")?;
    let span = Span { end: layouts.span.start + 1, ..layouts.span };
    let objects: Vec<(&Json, &[Member])> = decoder
        .list(layouts, "layouts")?
        .iter()
        .filter_map(|layout| Some((layout, decoder.object(layout, "a layout")?)))
        .collect();
    let mut lists = |key: &str, needed: bool| -> Vec<&Json> {
        let mut all = Vec::new();
        for (layout, members) in &objects {
            let list = match needed {
                true => decoder.required(members, key, layout.span, "the layout"),
                false => find(members, key),
            };
            all.extend(list.and_then(|list| decoder.list(list, key)).into_iter().flatten());
        }
        all
    };
    let (nodes, edges, stations) = (lists("nodes", true), lists("edges", true), lists("stations", false));
    let (vehicle, project) = (chosen(decoder, &edges, vehicle, span), project.unwrap_or_default());
    let mut found = Network {
        project,
        vehicle: vehicle.clone().unwrap_or_default(),
        span,
        nodes: Vec::new(),
        edges: Vec::new(),
    };
    let mut places = Places::default();
    for json in nodes {
        let Some((id, at)) = node(decoder, json) else { continue };
        match places.get(&id.value) {
            Some((_, first)) => twice(decoder, "nodes", &id, first),
            None => {
                places.insert(id.value.clone(), (at.map(|_| found.nodes.len()), id.clone()));
                found.nodes.extend(at.map(|at| Node { id, at, stations: Vec::new() }));
            }
        }
    }
    let mut ids: HashMap<String, usize> = HashMap::new();
    for json in edges {
        let Some(edge) = edge(decoder, json, &places, &found) else { continue };
        match ids.get(&edge.id.value) {
            Some(first) => twice(decoder, "edges", &edge.id, &found.edges[*first].id),
            None => {
                ids.insert(edge.id.value.clone(), found.edges.len());
                found.edges.push(edge);
            }
        }
    }
    for json in stations {
        station(decoder, json, &places, &mut found.nodes);
    }
    vehicle.map(|_| found)
}

/// The name of the project. Of other versions nothing is known.
fn version(decoder: &mut Decoder, meta: &Json) -> Option<String> {
    let members = decoder.object(meta, "metaInformation")?;
    let version = decoder.required(members, "lifVersion", meta.span, "metaInformation")?;
    let version = decoder.text(version, "lifVersion")?;
    if !version.value.starts_with("1.") {
        let message = format!("this is LIF {}, and only version 1 is read", version.value);
        decoder
            .report(Diagnostic::new("E1111", version.span, message).help("export the layout as LIF 1.0.0"));
    }
    let project = find(members, "projectIdentification")?;
    decoder.text(project, "projectIdentification").map(|text| text.value)
}

/// Types of vehicles of a node or of an edge, with their objects.
fn vehicles<'a>(
    decoder: &mut Decoder,
    members: &'a [Member],
    key: &str,
    json: &Json,
) -> Vec<(String, &'a [Member])> {
    let Some(list) =
        decoder.required(members, key, json.span, "the edge").and_then(|list| decoder.list(list, key))
    else {
        return Vec::new();
    };
    let mut found = Vec::new();
    for item in list {
        let Some(members) = decoder.object(item, key) else { continue };
        let id = decoder.required(members, "vehicleTypeId", item.span, key);
        let id = id.and_then(|id| decoder.text(id, "vehicleTypeId"));
        found.extend(id.map(|id| (id.value, members)));
    }
    found
}

/// The type of vehicle that was asked for, or the only one.
fn chosen(decoder: &mut Decoder, edges: &[&Json], asked: Option<&str>, span: Span) -> Option<String> {
    let mut known = BTreeSet::new();
    for edge in edges {
        if let Value::Object(members) = &edge.value {
            known.extend(
                vehicles(decoder, members, "vehicleTypeEdgeProperties", edge).into_iter().map(|(id, _)| id),
            );
        }
    }
    let names: Vec<&str> = known.iter().map(String::as_str).collect();
    match (asked, &names[..]) {
        (Some(asked), _) if known.contains(asked) => Some(asked.into()),
        (Some(asked), _) => {
            let message = format!("no edge is for vehicles of the type {asked}");
            let help = format!("the types of the file: {}", listing(&names));
            decoder.report(Diagnostic::new("E1111", span, message).help(help));
            None
        }
        (None, [only]) => Some((*only).into()),
        (None, []) => {
            if decoder.diagnostics.is_empty() {
                decoder.report(
                    Diagnostic::new("E1111", span, "no edge is for any type of vehicle")
                        .help("name a file with edges"),
                );
            }
            None
        }
        (None, _) => {
            let message = format!("the file has edges for {} types of vehicles", names.len());
            decoder.report(
                Diagnostic::new("E1111", span, message)
                    .note(format!("the types: {}", listing(&names)))
                    .help("choose one with `--vehicle TYPE`"),
            );
            None
        }
    }
}

fn twice(decoder: &mut Decoder, what: &str, id: &Spanned<String>, first: &Spanned<String>) {
    let message = format!("there are two {what} with the name {}", id.value);
    decoder.report(
        Diagnostic::new("E1111", id.span, message)
            .other(first.span, "the first one")
            .help("give one of them another name"),
    );
}

fn id(
    decoder: &mut Decoder,
    members: &[Member],
    key: &str,
    json: &Json,
    what: &str,
) -> Option<Spanned<String>> {
    let id = decoder.required(members, key, json.span, what)?;
    decoder.text(id, key)
}

fn position(decoder: &mut Decoder, json: &Json, what: &str) -> Option<Point> {
    let members = decoder.object(json, what)?;
    let mut coordinate = |key: &str| {
        let value = decoder.required(members, key, json.span, what)?;
        decoder.number_in(value, key, -FARTHEST..=FARTHEST)
    };
    let (x, y) = (coordinate("x"), coordinate("y"));
    Some(Point::new(x?, y?, 0.0))
}

fn node(decoder: &mut Decoder, json: &Json) -> Option<(Spanned<String>, Option<Point>)> {
    let members = decoder.object(json, "a node")?;
    let id = id(decoder, members, "nodeId", json, "the node");
    let at = decoder.required(members, "nodePosition", json.span, "the node");
    let at = at.and_then(|at| position(decoder, at, "nodePosition"));
    Some((id?, at))
}

fn named(decoder: &mut Decoder, places: &Places, id: &Spanned<String>) -> Option<usize> {
    match places.get(&id.value) {
        Some((place, _)) => *place,
        None => {
            let message = format!("there is no node {}", id.value);
            decoder.report(Diagnostic::new("E1111", id.span, message).help("name a node of this file"));
            None
        }
    }
}

/// An edge of the vehicle; none for edges of others.
fn edge(decoder: &mut Decoder, json: &Json, places: &Places, found: &Network) -> Option<Edge> {
    let Value::Object(members) = &json.value else {
        decoder.object(json, "an edge");
        return None;
    };
    let own = id(decoder, members, "edgeId", json, "the edge");
    let mut end = |key: &str| {
        let id = id(decoder, members, key, json, "the edge")?;
        named(decoder, places, &id)
    };
    let (from, to) = (end("startNodeId"), end("endNodeId"));
    // What is wrong with the list was reported when the types were collected.
    let Value::List(types) = &find(members, "vehicleTypeEdgeProperties")?.value else { return None };
    let is_of = |members: &&[Member]| {
        find(members, "vehicleTypeId").is_some_and(|id| id.value == Value::Text(found.vehicle.clone()))
    };
    let objects = types.iter().filter_map(|item| match &item.value {
        Value::Object(members) => Some(members.as_slice()),
        _ => None,
    });
    let properties = objects.into_iter().find(is_of)?;
    let speed = find(properties, "maxSpeed").and_then(|json| {
        let speed = decoder.number_in(json, "maxSpeed", 0.0..=100.0)?;
        // 0 stands for no limit.
        if speed > 0.0 { decoder.number_in(json, "maxSpeed", SLOWEST..=100.0) } else { None }
    });
    let (own, from, to) = (own?, from?, to?);
    if let Some(trajectory) = find(properties, "trajectory") {
        straight(decoder, trajectory, &own, [found.nodes[from].at, found.nodes[to].at]);
    }
    Some(Edge { id: own, from, to, speed })
}

/// Tracks are straight from node to node: a curve is refused if one of its control points is beside that line.
fn straight(
    decoder: &mut Decoder,
    trajectory: &Json,
    edge: &Spanned<String>,
    [from, to]: [Point; 2],
) -> Option<()> {
    let members = decoder.object(trajectory, "trajectory")?;
    let points = decoder.required(members, "controlPoints", trajectory.span, "trajectory")?;
    let points = decoder.list(points, "controlPoints")?;
    let along = to - from;
    let length = along.length();
    let mut farthest = 0.0_f64;
    for point in points {
        let seen = position(decoder, point, "a control point")? - from;
        let forward = if length > 0.0 { (seen.dot(along) / (length * length)).clamp(0.0, 1.0) } else { 0.0 };
        farthest = farthest.max((seen - along.scaled(forward)).length());
    }
    if farthest > STRAIGHT {
        let message = format!(
            "the edge {} is curved: its trajectory has a point {farthest:.3} m beside the straight line",
            edge.value
        );
        decoder.report(
            Diagnostic::new("E1112", trajectory.span, message)
                .note("a track goes straight from node to node")
                .help("replace the curve by several straight edges with nodes between them"),
        );
    }
    Some(())
}

fn station(decoder: &mut Decoder, json: &Json, places: &Places, nodes: &mut [Node]) -> Option<()> {
    let members = decoder.object(json, "a station")?;
    let own = id(decoder, members, "stationId", json, "the station")?;
    let name = find(members, "stationName").and_then(|name| decoder.text(name, "stationName"));
    let name = name.map(|name| name.value).filter(|name| !name.trim().is_empty()).unwrap_or(own.value);
    let at = decoder.required(members, "interactionNodeIds", json.span, "the station")?;
    for node in decoder.texts(at, "interactionNodeIds")? {
        if let Some(place) = named(decoder, places, &node) {
            nodes[place].stations.push(name.clone());
        }
    }
    Some(())
}
