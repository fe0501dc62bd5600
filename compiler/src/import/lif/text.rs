//! The device text of imported tracks.

use super::read::Network;
use super::track::Track;
use crate::import::text::number;
use crate::import::{Imported, distinct, identifier};
use crate::layout::decode::listing;
use crate::plain;
use std::fmt::Write;

pub fn of_tracks(network: &Network, tracks: &[Track], name: &str, file: &str) -> Imported {
    let mut notes = Vec::new();
    let single = network
        .nodes
        .iter()
        .enumerate()
        .filter(|(node, _)| !tracks.iter().any(|track| track.nodes.contains(node)));
    let single: Vec<&str> = single.map(|(_, node)| node.id.value.as_str()).collect();
    if !single.is_empty() {
        let shown = single.iter().take(8).copied().collect::<Vec<_>>().join(", ");
        notes
            .push(format!("{} nodes have no edge for this vehicle and are left out ({shown})", single.len()));
    }
    notes.push("acceleration, size and mass of the vehicle are not in such a file: they are parameters of the device".into());
    let names = distinct(tracks.iter().map(|_| identifier(name, "vehicle")).collect());
    let mut devices = String::new();
    for (track, name) in tracks.iter().zip(&names) {
        notes.extend(told(track).into_iter().map(|note| format!("{name}: {note}")));
        device(network, track, name, &mut devices);
    }
    let mut text = format!(
        "// From {}: tracks of the vehicles {}. Written by `autogen import`.\n",
        plain::line(file),
        plain::line(&network.vehicle)
    );
    for note in &notes {
        let _ = writeln!(text, "// - {}.", plain::line(note));
    }
    Imported { text: text + &devices, notes }
}

/// What the primitive says otherwise than the file.
fn told(track: &Track) -> Vec<String> {
    let mut notes = Vec::new();
    match (track.closed, track.both_ways) {
        (true, true) => notes.push(
            "edges lead in both directions; a closed track is driven in one, that of the corners".into(),
        ),
        (false, false) => {
            notes.push(
                "edges lead in one direction only; the vehicle could drive back: no automaton may send it"
                    .into(),
            );
        }
        _ => {}
    }
    if let Some(speed) = track.speed.filter(|_| track.has_speeds) {
        notes.push(format!("edges have different speeds; the vehicle has the least, {speed} m/s, on all"));
    }
    let nameless: Vec<&str> = track.without_speed.iter().map(String::as_str).collect();
    match track.speed {
        Some(speed) if !nameless.is_empty() => {
            notes.push(format!(
                "the vehicle has {speed} m/s also on edges without a velocity: {}",
                listing(&nameless)
            ));
        }
        None => notes.push("no edge has a velocity; it is a parameter of the device".into()),
        Some(_) => {}
    }
    if track.places.len() < track.nodes.len() {
        notes.push("only nodes of stations are goals".into());
    }
    notes
}

fn device(network: &Network, track: &Track, name: &str, out: &mut String) {
    let id = |number: usize| plain::line(&network.nodes[track.nodes[number]].id.value);
    let _ = writeln!(
        out,
        "\n/// A vehicle on a {} track of {} nodes.",
        if track.closed { "closed" } else { "straight-line" },
        track.nodes.len()
    );
    let _ = writeln!(out, "device {name} {{");
    *out += "    /// Its place along the track at the start, from the first corner.\n    parameter begins: real := 0.0;\n";
    match track.speed {
        Some(speed) => {
            let _ = writeln!(
                out,
                "    /// Greatest velocity, m/s.\n    parameter speed: real := {};",
                number(speed)
            );
        }
        None => *out += "    /// Greatest velocity, m/s; the file has none.\n    parameter speed: real;\n",
    }
    *out += "    /// Greatest acceleration, m/s2.\n    parameter acceleration: real;\n";
    *out += "    /// Of the vehicle.\n    parameter length: real;\n    parameter width: real;\n    parameter height: real;\n";
    *out += "    /// kg\n    parameter mass: real;\n\n";
    *out += "    part chassis = track {\n        corners: [\n";
    for (corner, node) in track.nodes.iter().enumerate() {
        let at = network.nodes[*node].at;
        let comma = if corner + 1 < track.nodes.len() { "," } else { "" };
        let _ = writeln!(
            out,
            "            origin * point({}, {}, 0){comma}  // {}",
            number(at.x),
            number(at.y),
            id(corner)
        );
    }
    *out += "        ];\n";
    let _ = writeln!(out, "        closed: {};", track.closed);
    let places: Vec<String> = track.places.iter().map(|place| number(track.distances[*place])).collect();
    let _ = writeln!(out, "        places: [{}];", places.join(", "));
    *out += "        begins: begins; speed: speed; acceleration: acceleration; mass: mass;\n    };\n";
    *out += "    part hull = body {\n        on: chassis; low: point(-length / 2.0, -width / 2.0, 0.02); high: point(length / 2.0, width / 2.0, height);\n    };\n\n";
    *out += "    /// place of its middle\n    in pos: point unit \"m\" = chassis.position;\n";
    *out += "    /// number of the place that it has passed last:\n";
    for (number, place) in track.places.iter().enumerate() {
        let stations = &network.nodes[track.nodes[*place]].stations;
        let at = if stations.is_empty() {
            String::new()
        } else {
            format!(", {}", plain::line(&stations.join(", ")))
        };
        let _ = writeln!(out, "    /// {number} {}{at}", id(*place));
    }
    let last = track.places.len() - 1;
    let lowest = if track.closed || track.places[0] == 0 { 0 } else { -1 };
    let _ = writeln!(out, "    in place: int {lowest}..{last} = chassis.place;");
    *out += "    /// it is at rest\n    in stands: bool = chassis.stands;\n";
    let _ = writeln!(out, "    /// number of the destination\n    out goal: int 0..{last};\n");
    *out += "    /// go to the place `goal`; a new command during the motion is accepted without a stop\n";
    *out += "    command 1 drive(goal) = chassis.to(goal);\n    /// brake\n    command 2 halt() = chassis.halt();\n}\n";
}
