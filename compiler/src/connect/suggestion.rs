//! The smallest change of one number, and the smallest turn, that make two machines meet.

use super::poses::Reachable;
use super::{Line, Node, Suggestion, Turn, flow::Flow};
use crate::device::Placed;
use runtime_sim::frame::whole_turn;

/// How far a number is changed at most, mm.
const FURTHEST: i32 = 10_000;
/// The change is first sought in steps of at least this many mm: a stretch of values shorter than that may be overlooked.
const COARSE: i32 = 10;

/// Of all numbers of both machines and both directions the change after which most nodes are connected,
/// among these the smallest; changes that cost an edge do not count.
pub fn find(
    line: &Line,
    flow: &Flow,
    reachable: &Reachable,
    stands: &[bool],
    proposal: usize,
) -> Option<Suggestion> {
    let pair = &line.proposals[proposal];
    let mut best: Option<Suggestion> = None;
    for node in [pair.passive(), pair.arm] {
        for number in &line.nodes[node].numbers {
            for direction in [1, -1] {
                let Some((change_mm, placed)) =
                    first(line, reachable, proposal, node, &number.path, direction)
                else {
                    continue;
                };
                let Some(stands_then) = after(line, reachable, stands, node, &placed) else { continue };
                let connected = flow.served(&stands_then).connected();
                let better = best.as_ref().is_none_or(|best| {
                    (connected, -change_mm.abs()) > (best.connected, -best.change_mm.abs())
                });
                if better {
                    best = Some(Suggestion {
                        node,
                        path: number.path.clone(),
                        span: number.span,
                        present: number.value,
                        value: changed(number.value, change_mm),
                        change_mm,
                        connected,
                        joined: (0..stands.len()).filter(|p| stands_then[*p] && !stands[*p]).collect(),
                    });
                }
            }
        }
    }
    best
}

/// Of both machines, as far as they can be turned, and both directions the turn after which most nodes are connected, among
/// these the smallest; turns that cost an edge do not count.
pub fn turn(
    line: &Line,
    flow: &Flow,
    reachable: &Reachable,
    stands: &[bool],
    proposal: usize,
) -> Option<Turn> {
    let pair = &line.proposals[proposal];
    let mut best: Option<Turn> = None;
    for node in [pair.passive(), pair.arm].into_iter().filter(|node| can_turn(&line.nodes[*node])) {
        let placed = &line.nodes[node].placed;
        let turned = |degrees: i32| {
            let mut turned = placed.clone();
            turned.pose.yaw = whole_turn(placed.pose.yaw + f64::from(degrees));
            turned
        };
        if !reachable.matters(pair, (node, &turned(1))) {
            continue;
        }
        let farthest = reachable.farthest(pair, node);
        for direction in [1, -1] {
            let mut degrees = 1_i32;
            let found = loop {
                let (change, turned) = (direction * degrees, turned(direction * degrees));
                match reachable.first_miss(pair, (node, &turned)) {
                    None => break Some((change, turned)),
                    // The tool moves by no more than this angle times its distance: as in `stride`.
                    Some(missing) => {
                        let step = (missing / 2.0 / farthest).to_degrees() as i32;
                        degrees = degrees.saturating_add(step.max(1));
                    }
                }
                if degrees > 180 {
                    break None;
                }
            };
            let Some((change_deg, placed_then)) = found else { continue };
            let Some(stands_then) = after(line, reachable, stands, node, &placed_then) else { continue };
            let connected = flow.served(&stands_then).connected();
            let is_better =
                |best: &Turn| (connected, -change_deg.abs()) > (best.connected, -best.change_deg.abs());
            if best.as_ref().is_none_or(is_better) {
                let (present, value) = (placed.pose.yaw, placed_then.pose.yaw);
                best = Some(Turn { node, present, value, change_deg, connected });
            }
        }
    }
    best
}

/// Its device turns with its pose, and the layout gives this.
fn can_turn(node: &Node) -> bool {
    node.placed.device.can_turn && node.numbers.iter().any(|number| number.path.starts_with("pose["))
}

/// `value` and so many millimetres, without the dust of binary fractions.
pub fn changed(value: f64, mm: i32) -> f64 {
    ((value + f64::from(mm) / 1000.0) * 1e9).round() / 1e9
}

/// A pose that misses by so much (m) is not in reach after a change of less than half of it:
/// its wrist moves at most twice as far, unless the tool is nearly in line with the shoulder's axis.
fn stride(missing: f64) -> i32 {
    COARSE.max((missing * 500.0) as i32)
}

/// The first whole millimetre in one direction at which the pair meets, with the machine's placed there.
fn first(
    line: &Line,
    reachable: &Reachable,
    proposal: usize,
    node: usize,
    path: &str,
    direction: i32,
) -> Option<(i32, Placed)> {
    let placed = &line.nodes[node].placed;
    let mut numbers = placed.numbers().into_iter().enumerate();
    let (number, (_, present)) = numbers.find(|(_, (known, _))| known == path)?;
    let pair = &line.proposals[proposal];
    // `None` beyond the values that the machine may have.
    let at = |mm: i32| placed.with_number(number, changed(present, direction * mm));
    if at(COARSE).is_some_and(|changed| !reachable.matters(pair, (node, &changed))) {
        return None;
    }
    let miss = |placed: &Placed| reachable.first_miss(pair, (node, placed));
    let mut passed = 0_i32;
    let mut step = stride(miss(placed)?);
    let coarse = loop {
        let next = passed.saturating_add(step).min(FURTHEST);
        match at(next).map(|changed| miss(&changed)) {
            Some(None) => break next,
            Some(Some(missing)) if next < FURTHEST => (passed, step) = (next, stride(missing)),
            Some(Some(_)) => return None,
            // The last values before the end of what is allowed are tried below.
            None => break next - 1,
        }
    };
    (passed + 1..=coarse).find_map(|mm| {
        let changed = at(mm)?;
        miss(&changed).is_none().then_some((direction * mm, changed))
    })
}

/// Which pairs meet with another placed of one node; none if an edge is lost.
fn after(
    line: &Line,
    reachable: &Reachable,
    stands: &[bool],
    node: usize,
    placed: &Placed,
) -> Option<Vec<bool>> {
    let mut after = stands.to_vec();
    for (proposal, stood) in line.proposals.iter().zip(&mut after) {
        if proposal.from == node || proposal.to == node {
            let stands_now = reachable.stands(proposal, (node, placed));
            if *stood && !stands_now {
                return None;
            }
            *stood = stands_now;
        }
    }
    Some(after)
}
