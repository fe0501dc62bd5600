//! What is wrong, said once for each cause.

use super::flow::{Flow, Served};
use super::{Failure, Line, Miss, Stage, most_suggestions, withheld};
use crate::diagnostic::{Diagnostic, MOST, sort};
use std::collections::HashSet;

/// Places listed in a report; the data hold every pose.
const LISTED: usize = 3;

/// `met` are the pairs that a list of the layout keeps apart, and that would meet.
pub fn diagnostics(
    line: &Line,
    flow: &Flow,
    stands: &[bool],
    failures: &[Failure],
    met: &[usize],
) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    // Where no type hands anything over, nothing has to get anywhere.
    if line.nodes.is_empty() {
        return found;
    }
    if !line.nodes.iter().any(|node| node.is_source) {
        found.push(
            Diagnostic::new("E0404", line.span, "no machine of this layout brings items in")
                .help("add a machine whose type only offers items, such as a conveyor, or an arm whose device has a `source`"),
        );
    }
    if !line.nodes.iter().any(|node| node.is_destination) {
        found.push(
            Diagnostic::new("E0405", line.span, "no machine of this layout takes finished items away")
                .help("add a machine whose type only accepts items, such as an assembly station, or an arm whose device has a `sink`"),
        );
    }
    let mut stands = stands.to_vec();
    let mut served = flow.served(&stands);
    if found.is_empty() && served.connected() == line.nodes.len() {
        return found;
    }
    let failures = &failures[..failures.len().min(most_suggestions(line))];
    found.extend(withheld::diagnostics(line, flow, &mut stands, &mut served, met));
    while let Some((failure, after)) = most_helpful(flow, &stands, failures, &served) {
        found.push(apart(line, failure, failures, &stands, &served, &after));
        join(&mut stands, failure);
        served = after;
    }
    // Lists beside which another pair was named, which now is taken for changed.
    found.extend(withheld::diagnostics(line, flow, &mut stands, &mut served, met));
    found.extend(left_alone(line, flow, &served));
    sort(&mut found);
    found
}

/// Takes a failed pair for changed as suggested, with all that the change brings together.
fn join(stands: &mut [bool], failure: &Failure) {
    stands[failure.proposal] = true;
    for proposal in failure.suggestion.iter().flat_map(|suggestion| &suggestion.joined) {
        stands[*proposal] = true;
    }
}

/// The failed pair that would connect most nodes if it were changed, and what is connected then.
/// At equal numbers the one that misses by least.
fn most_helpful<'a>(
    flow: &Flow,
    stands: &[bool],
    failures: &'a [Failure],
    served: &Served,
) -> Option<(&'a Failure, Served)> {
    let mut best: Option<(usize, &Failure, Served)> = None;
    for failure in failures.iter().filter(|failure| !stands[failure.proposal]) {
        let mut with = stands.to_vec();
        join(&mut with, failure);
        let after = flow.served(&with);
        let gain = gain(served, &after);
        let better = match &best {
            None => gain > 0,
            Some((most, other, _)) => gain > *most || (gain == *most && worst_mm(failure) < worst_mm(other)),
        };
        if better {
            best = Some((gain, failure, after));
        }
    }
    best.map(|(_, failure, after)| (failure, after))
}

/// How much more is connected after a change.
pub fn gain(before: &Served, after: &Served) -> usize {
    newly(&before.supplied, &after.supplied).len() + newly(&before.drained, &after.drained).len()
}

pub fn newly(before: &[bool], after: &[bool]) -> Vec<usize> {
    (0..before.len()).filter(|n| after[*n] && !before[*n]).collect()
}

fn worst_mm(failure: &Failure) -> f64 {
    failure.misses.first().map_or(0.0, |miss| miss.missing_mm)
}

/// Two machines that should meet, do not, and are needed.
fn apart(
    line: &Line,
    failure: &Failure,
    failures: &[Failure],
    stands: &[bool],
    served: &Served,
    after: &Served,
) -> Diagnostic {
    let pair = &line.proposals[failure.proposal];
    let [arm, passive] = [pair.arm, pair.passive()].map(|n| &line.nodes[n]);
    let verb = if pair.arm == pair.from { "hand over to" } else { "take from" };
    if worst_mm(failure).is_infinite() {
        let message = format!(
            "{} cannot {verb} {}: its tool only points down, and the place is approached from the side",
            arm.name, passive.name
        );
        return Diagnostic::new("E0412", passive.span, message)
            .other(arm.span, "the arm that should come here")
            .other(pair.rule, "the place of the handover")
            .help("use an arm with `lengths` or `opw`, or give the place of the device no `toward`");
    }
    let mut diagnostic = Diagnostic::new(
        "E0401",
        passive.span,
        format!(
            "{} cannot {verb} {}: {} of {} poses are out of its reach, the worst by {}",
            arm.name,
            passive.name,
            failure.misses.len(),
            failure.tested,
            millimetres(worst_mm(failure))
        ),
    )
    .label("out of reach")
    .other(arm.span, "the arm that should come here")
    .other(pair.rule, "the place of the handover");

    let listed = worst_of_places(&failure.misses);
    for miss in &listed {
        diagnostic = diagnostic.note(describe(miss));
    }
    if failure.misses.len() > listed.len() {
        diagnostic = diagnostic.note(format!("and {} more poses", failure.misses.len() - listed.len()));
    }
    let starved = newly(&served.supplied, &after.supplied);
    let stuck = newly(&served.drained, &after.drained);
    diagnostic = flow_notes(diagnostic, line, &starved, &stuck);
    let also: Vec<String> = failures
        .iter()
        .filter(|other| other.proposal != failure.proposal && !stands[other.proposal])
        .filter(|other| {
            let joined = failure
                .suggestion
                .as_ref()
                .is_some_and(|suggestion| suggestion.joined.contains(&other.proposal));
            let other = &line.proposals[other.proposal];
            joined
                || (other.to == pair.to && starved.contains(&pair.to))
                || (other.from == pair.from && stuck.contains(&pair.from))
        })
        .map(|other| {
            let pair = &line.proposals[other.proposal];
            format!(
                "{} to {} ({})",
                line.nodes[pair.from].name,
                line.nodes[pair.to].name,
                millimetres(worst_mm(other))
            )
        })
        .collect();
    if !also.is_empty() {
        diagnostic = diagnostic.note(format!("out of reach as well: {}", also.join(", ")));
    }
    let turn = failure.turn.as_ref().map(|turn| {
        let (name, degrees) = (&line.nodes[turn.node].name, turn.change_deg.abs());
        format!(
            "turn {name} to {} (the fourth number of its pose, now {}): {degrees} degrees bring the two together, {} do not",
            turn.value,
            turn.present,
            degrees - 1
        )
    });
    match (&failure.suggestion, turn) {
        (Some(suggestion), turn) => {
            let name = &line.nodes[suggestion.node].name;
            let or_turn = turn.map(|turn| format!("; or {turn}")).unwrap_or_default();
            diagnostic.other(suggestion.span, "a change of this number is enough").help(format!(
                "set `{}` of {name} to {} (now {}): {} mm bring the two together, {} mm do not{or_turn}",
                suggestion.path,
                suggestion.value,
                suggestion.present,
                suggestion.change_mm.abs(),
                suggestion.change_mm.abs() - 1
            ))
        }
        (None, Some(turn)) => diagnostic.help(turn),
        (None, None) => diagnostic.help(format!(
            "no change of one number by up to 10 m brings the two together without separating others: move {} or {}, or lower the approach",
            passive.name, arm.name
        )),
    }
}

/// To which machines no item gets, and from which none leaves.
pub fn flow_notes(mut diagnostic: Diagnostic, line: &Line, starved: &[usize], stuck: &[usize]) -> Diagnostic {
    if !starved.is_empty() {
        diagnostic = diagnostic.note(format!("no item gets to {}", names(line, starved)));
    }
    if !stuck.is_empty() {
        diagnostic = diagnostic.note(format!("no item from {} ever leaves the layout", names(line, stuck)));
    }
    diagnostic
}

/// Nodes that are on no path even if every pair met.
fn left_alone(line: &Line, flow: &Flow, served: &Served) -> Vec<Diagnostic> {
    let nodes = &line.nodes;
    let has_source = nodes.iter().any(|node| node.is_source);
    let has_destination = nodes.iter().any(|node| node.is_destination);
    // Behind a machine that nothing supplies, machines out of its reach are cut off too.
    let full = flow.reach(&vec![true; line.proposals.len()]);
    let is_given: HashSet<usize> = line.proposals.iter().map(|p| p.to).collect();
    let gives: HashSet<usize> = line.proposals.iter().map(|p| p.from).collect();
    let mut found = Vec::new();
    let mut starved: Vec<usize> = if has_source { served.unreachable() } else { Vec::new() };
    let mut stuck: Vec<usize> = if has_destination { served.dead_ends() } else { Vec::new() };
    let roots: Vec<usize> = starved.iter().copied().filter(|n| !is_given.contains(n)).take(MOST).collect();
    for root in roots {
        let behind: Vec<usize> =
            starved.iter().copied().filter(|n| *n != root && full.get(root, *n)).collect();
        starved.retain(|n| *n != root && !behind.contains(n));
        found.push(alone(line, root, "E0402", format!("nothing hands over to {}", nodes[root].name), |d| {
            let d = if behind.is_empty() {
                d
            } else {
                d.note(format!("no item gets to {}", names(line, &behind)))
            };
            d.help("add a machine that hands over to it, or remove it")
        }));
    }
    let ends: Vec<usize> = stuck.iter().copied().filter(|n| !gives.contains(n)).take(MOST).collect();
    for end in ends {
        let before: Vec<usize> = stuck.iter().copied().filter(|n| *n != end && full.get(*n, end)).collect();
        stuck.retain(|n| *n != end && !before.contains(n));
        found.push(alone(line, end, "E0403", format!("{} hands over to nothing", nodes[end].name), |d| {
            let d = if before.is_empty() {
                d
            } else {
                d.note(format!("no item from {} ever leaves the layout", names(line, &before)))
            };
            d.help("add a machine that takes from it, or remove it")
        }));
    }
    for node in starved {
        found.push(alone(line, node, "E0406", format!("no item gets to {}", nodes[node].name), |d| {
            d.note("it takes only from machines to which no item gets")
                .help("connect one of them to a source")
        }));
    }
    for node in stuck {
        let message = format!("no item from {} ever leaves the layout", nodes[node].name);
        found.push(alone(line, node, "E0407", message, |d| {
            d.note("it hands over only to machines from which none leaves")
                .help("connect one of them to a destination")
        }));
    }
    found
}

fn alone(
    line: &Line,
    node: usize,
    code: &'static str,
    message: String,
    finish: impl FnOnce(Diagnostic) -> Diagnostic,
) -> Diagnostic {
    finish(Diagnostic::new(code, line.nodes[node].span, message))
}

/// The worst pose of each place, for the few worst places.
fn worst_of_places(misses: &[Miss]) -> Vec<&Miss> {
    let mut listed: Vec<&Miss> = Vec::new();
    for miss in misses {
        if listed.len() < LISTED && listed.iter().all(|other| other.place != miss.place) {
            listed.push(miss);
        }
    }
    listed
}

fn describe(miss: &Miss) -> String {
    let stage = match miss.stage {
        Stage::Contact => "at contact",
        Stage::Approach => "at approach",
    };
    format!("{}, {} {stage}: {} out of reach", miss.place, miss.kind, millimetres(miss.missing_mm))
}

/// Rounded up, so that nothing misses by 0 mm.
fn millimetres(mm: f64) -> String {
    format!("{} mm", mm.ceil())
}

pub fn names(line: &Line, nodes: &[usize]) -> String {
    nodes.iter().map(|n| line.nodes[*n].name.as_str()).collect::<Vec<_>>().join(", ")
}
