//! Where items of each conveyor may get from there, whatever is commanded.

use super::branch::Kind;
use super::landing::Ground;
use super::tracks::{ALIGNED, JOINED, Track, apart, tracks};
use crate::line::Line;
use crate::part::Primitive;
use std::collections::{BTreeMap, BTreeSet};

/// From one conveyor to another one, or by a fall to a place; machine and part of each.
#[derive(Clone, Debug, PartialEq)]
pub struct Transfer {
    pub from: (usize, usize),
    pub to: (usize, usize),
    pub by: By,
    /// Those that go so.
    pub kinds: Vec<usize>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
pub enum By {
    /// One begins where the other one ends, at some end of their cylinders: by so many m and degrees more they could be
    /// apart and turned.
    Joint { margin: [f64; 2] },
    /// A diverter or a pusher, a part of the machine of the first one.
    Branch { part: usize },
    /// Half of an item beyond the end of one, the other one is below.
    Fall,
}

/// All transfers of a line, in the order of their conveyors.
pub fn transfers(line: &Line) -> Vec<Transfer> {
    let tracks = tracks(line);
    let ground = Ground::new(line);
    let all: Vec<usize> = (0..line.kinds.len()).collect();
    let mut transfers = Vec::new();
    for track in &tracks {
        let from = (track.machine, track.part);
        let before = transfers.len();
        for (number, other) in tracks.iter().enumerate() {
            let to = (other.machine, other.part);
            let ends = track.sink.is_none() && to != from;
            if ends
                && track.leads_onto(number)
                && let Some(margin) = margin(line, from, to)
            {
                transfers.push(Transfer { from, to, by: By::Joint { margin }, kinds: all.clone() });
            }
            let branches = branches_onto(track, number).map(|part| By::Branch { part });
            transfers.extend(branches.map(|by| Transfer { from, to, by, kinds: all.clone() }));
        }
        let own = transfers[before..].iter();
        let joined: Vec<_> =
            own.filter(|own| !matches!(own.by, By::Branch { .. })).map(|own| own.to).collect();
        for (to, kinds) in falls(line, track, &ground) {
            if !joined.contains(&to) {
                transfers.push(Transfer { from, to, by: By::Fall, kinds });
            }
        }
    }
    transfers
}

/// Onto what the items fall of which kinds that come to the end of a conveyor.
fn falls(line: &Line, track: &Track, ground: &Ground) -> BTreeMap<(usize, usize), Vec<usize>> {
    let mut falls: BTreeMap<_, Vec<usize>> = BTreeMap::new();
    if track.sink.is_some() || track.is_always_joined() {
        return falls;
    }
    let machine = &line.machines[track.machine];
    let Primitive::Lane(lane) = &machine.parts[track.part].primitive else { return falls };
    let lines = machine.centre_lines(lane);
    for (kind, half) in track.halves.iter().enumerate() {
        let ends = lines.iter().map(|(_, line)| line.point(line.end() - half, 0.0));
        let onto: BTreeSet<_> = ends.flat_map(|end| ground.under(end)).collect();
        for to in onto.into_iter().filter(|to| *to != (track.machine, track.part)) {
            falls.entry(to).or_default().push(kind);
        }
    }
    falls
}

/// The diverters and pushers of a lane that bring items onto the one of this number.
fn branches_onto(track: &Track, number: usize) -> impl Iterator<Item = usize> {
    let those = track.branches.iter().filter(move |branch| match branch.kind {
        Kind::Diverter { onto } | Kind::Pusher { onto, .. } => onto == number,
        Kind::Stopper => false,
    });
    those.map(|branch| branch.part)
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
