//! Where items of each conveyor may get from there, whatever is commanded.

use super::branch::Kind;
use super::tracks::{ALIGNED, JOINED, Track, apart, tracks};
use crate::line::Line;
use crate::part::Primitive;

/// From one conveyor to another one; machine and part of each.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Transfer {
    pub from: (usize, usize),
    pub to: (usize, usize),
    pub by: By,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum By {
    /// One begins where the other one ends, at some end of their cylinders: by so many m and degrees more they could be
    /// apart and turned.
    Joint { margin: [f64; 2] },
    /// A diverter or a pusher.
    Branch,
    /// One ends over the other one.
    Fall,
}

/// Beyond the end of a conveyor, where the middle of an item may be that falls there, m.
const FALLS_AT: [f64; 5] = [0.0, 0.1, 0.2, 0.4, 0.8];

/// All transfers of a line, in the order of their conveyors.
pub fn transfers(line: &Line) -> Vec<Transfer> {
    let tracks = tracks(line);
    let mut transfers = Vec::new();
    for track in &tracks {
        let from = (track.machine, track.part);
        for (number, other) in tracks.iter().enumerate() {
            let to = (other.machine, other.part);
            let ends = track.sink.is_none() && to != from;
            let joint = (ends && track.leads_onto(number)).then(|| margin(line, from, to)).flatten();
            if let Some(margin) = joint {
                transfers.push(Transfer { from, to, by: By::Joint { margin } });
            }
            if branches_onto(track, number) {
                transfers.push(Transfer { from, to, by: By::Branch });
            }
            if ends && joint.is_none() && is_over(line, from, to) {
                transfers.push(Transfer { from, to, by: By::Fall });
            }
        }
    }
    transfers
}

fn branches_onto(track: &Track, number: usize) -> bool {
    track.branches.iter().any(|branch| match branch.kind {
        Kind::Diverter { onto } | Kind::Pusher { onto, .. } => onto == number,
        Kind::Stopper => false,
    })
}

/// What is left at the best of the joints of two conveyors.
fn margin(line: &Line, from: (usize, usize), to: (usize, usize)) -> Option<[f64; 2]> {
    let lines = |(machine, part): (usize, usize)| match &line.machines[machine].parts[part].primitive {
        Primitive::Lane(lane) => line.machines[machine].centre_lines(lane),
        _ => Vec::new(),
    };
    let begins = lines(to);
    let pairs =
        lines(from).into_iter().flat_map(|(_, end)| begins.iter().map(move |(_, begin)| (end, *begin)));
    let margins = pairs.map(|(end, begin)| {
        let [off, turn] = apart(&end, &begin);
        [JOINED - off, ALIGNED - turn]
    });
    let joined = margins.filter(|margin| margin.iter().all(|left| *left >= 0.0));
    joined.max_by(|a, b| a[0].total_cmp(&b[0]))
}

/// Whether a conveyor ends over another one.
fn is_over(line: &Line, from: (usize, usize), to: (usize, usize)) -> bool {
    let lane = |(machine, part): (usize, usize)| match &line.machines[machine].parts[part].primitive {
        Primitive::Lane(lane) => Some((line.machines[machine].centre_lines(lane), lane.width)),
        _ => None,
    };
    let (Some((above, _)), Some((below, width))) = (lane(from), lane(to)) else { return false };
    above.iter().any(|(_, line)| {
        let mut points = FALLS_AT.iter().map(|beyond| line.point(line.end() - beyond, 0.0));
        points.any(|point| {
            let mut places = below.iter().filter_map(|(_, under)| under.find(point));
            places.any(|(_, across)| across.abs() <= width)
        })
    })
}
