//! Machines that are cut off because a list of the layout leaves them out: an arm reaches them.

use super::flow::{Flow, Served};
use super::poses::Reachable;
use super::verdict::{flow_notes, gain, names, newly};
use super::{Line, Proposal};
use crate::diagnostic::Diagnostic;
use crate::source::Span;
use std::collections::HashSet;

/// Of more pairs it is not looked whether they would meet.
const MOST_TRIED: usize = 1000;

/// What one list cuts off in one way.
struct Cause {
    code: &'static str,
    arm: usize,
    /// The key of the list.
    key: &'static str,
    list: Span,
    /// Machines that the list should name.
    left_out: Vec<usize>,
    /// Machines that are cut off at the handover itself.
    cut_off: Vec<usize>,
    /// Machines behind these to which no item gets, and before them from which none leaves.
    starved: Vec<usize>,
    stuck: Vec<usize>,
}

/// The pairs that would meet. Not among them is one whose arm meets the same machine the other way without
/// naming it: items would go in a circle.
pub fn met<'a>(
    line: &'a Line,
    reachable: &'a Reachable,
    stands: &[bool],
) -> impl Iterator<Item = usize> + use<'a> {
    let unnamed = line.proposals.iter().zip(stands).filter(|(pair, stands)| **stands && !pair.is_named);
    let back: HashSet<[usize; 2]> = unnamed.map(|(pair, _)| [pair.to, pair.from]).collect();
    let pairs = line.withheld.iter().map(|withheld| &withheld.pair).enumerate().take(MOST_TRIED);
    let met =
        pairs.filter(move |(_, pair)| !back.contains(&[pair.from, pair.to]) && reachable.met(pair).is_some());
    met.map(|(number, _)| number)
}

/// Takes pairs that a list keeps apart and that would have `met` for standing, as long as this connects
/// further nodes.
pub fn diagnostics(
    line: &Line,
    flow: &Flow,
    stands: &mut Vec<bool>,
    served: &mut Served,
    met: &[usize],
) -> Vec<Diagnostic> {
    let mut causes: Vec<Cause> = Vec::new();
    let edges = stands.clone();
    stands.resize(line.proposals.len() + line.withheld.len(), false);
    while let Some((number, after)) = most_helpful(line, flow, stands, met, served) {
        let cause = Cause::new(line, &edges, number, &Change { before: served, after: &after });
        let same = |other: &&mut Cause| (other.list, other.code) == (cause.list, cause.code);
        match causes.iter_mut().find(same) {
            Some(other) => other.extend(cause),
            None => causes.push(cause),
        }
        stands[line.proposals.len() + number] = true;
        *served = after;
    }
    causes.iter().map(|cause| cause.diagnostic(line)).collect()
}

/// What is connected before and after one pair is taken for standing.
struct Change<'s> {
    before: &'s Served,
    after: &'s Served,
}

impl Change<'_> {
    /// The machine of the pair that the change connects, of both the passive one.
    fn cut_off(&self, pair: &Proposal) -> usize {
        let is_cut_off = match pair.passive() == pair.to {
            true => self.after.supplied[pair.to] && !self.before.supplied[pair.to],
            false => self.after.drained[pair.from] && !self.before.drained[pair.from],
        };
        if is_cut_off { pair.passive() } else { pair.arm }
    }
}

/// The pair that would connect most nodes if no list kept it apart, and what is connected then. Of several
/// the first.
fn most_helpful(
    line: &Line,
    flow: &Flow,
    stands: &[bool],
    met: &[usize],
    served: &Served,
) -> Option<(usize, Served)> {
    let place = |number: usize| line.proposals.len() + number;
    let apart = met.iter().copied().filter(|number| !stands[place(*number)]);
    let tried = apart.map(|number| {
        let mut with = stands.to_vec();
        with[place(number)] = true;
        (number, flow.served(&with))
    });
    let helpful = tried.filter(|(number, after)| {
        let pair = &line.withheld[*number].pair;
        gain(served, after) > 0 && !has_other(line, stands, pair, &Change { before: served, after })
    });
    helpful.reduce(|best, next| if gain(served, &next.1) > gain(served, &best.1) { next } else { best })
}

/// Whether the layout names another pair for the machine that is cut off: that one should meet.
fn has_other(line: &Line, stands: &[bool], pair: &Proposal, change: &Change) -> bool {
    let cut_off = change.cut_off(pair);
    let named = line.proposals.iter().zip(stands).filter(|(other, stands)| other.is_named && !**stands);
    let mut ends = named.map(|(other, _)| if cut_off == pair.to { other.to } else { other.from });
    ends.any(|end| end == cut_off)
}

impl Cause {
    fn new(line: &Line, edges: &[bool], number: usize, change: &Change) -> Self {
        let withheld = &line.withheld[number];
        let Proposal { from, to, arm, .. } = withheld.pair;
        let cut_off = change.cut_off(&withheld.pair);
        let has_edge = |of: fn(&Proposal) -> usize| {
            line.proposals.iter().zip(edges).any(|(pair, stands)| *stands && of(pair) == cut_off)
        };
        let code = match cut_off == to {
            true if has_edge(|pair| pair.to) => "E0406",
            true => "E0402",
            false if has_edge(|pair| pair.from) => "E0407",
            false => "E0403",
        };
        Self {
            code,
            arm,
            key: if arm == from { "hands_to" } else { "takes_from" },
            list: withheld.list,
            left_out: vec![withheld.pair.passive()],
            cut_off: vec![cut_off],
            starved: newly(&change.before.supplied, &change.after.supplied),
            stuck: newly(&change.before.drained, &change.after.drained),
        }
    }

    fn extend(&mut self, other: Self) {
        let pairs = [
            (&mut self.left_out, other.left_out),
            (&mut self.cut_off, other.cut_off),
            (&mut self.starved, other.starved),
            (&mut self.stuck, other.stuck),
        ];
        for (nodes, more) in pairs {
            let new: Vec<usize> = more.into_iter().filter(|node| !nodes.contains(node)).collect();
            nodes.extend(new);
        }
    }

    fn diagnostic(&self, line: &Line) -> Diagnostic {
        let Self { code, key, .. } = *self;
        let (arm, cut_off) = (&line.nodes[self.arm].name, names(line, &self.cut_off));
        let message = match code {
            "E0402" => format!("nothing hands over to {cut_off}"),
            "E0403" if self.cut_off.len() == 1 => format!("{cut_off} hands over to nothing"),
            "E0403" => format!("{cut_off} hand over to nothing"),
            "E0406" => format!("no item gets to {cut_off}"),
            _ => format!("no item from {cut_off} ever leaves the layout"),
        };
        let them = if self.left_out.len() == 1 { "it" } else { "them" };
        let mut diagnostic = Diagnostic::new(code, line.nodes[self.cut_off[0]].span, message)
            .other(self.list, format!("leaves {them} out"))
            .note(format!(
                "{arm} reaches {}, but its \"{key}\" does not name {them}",
                names(line, &self.left_out)
            ));
        let behind = |nodes: &[usize]| -> Vec<usize> {
            nodes.iter().copied().filter(|node| !self.cut_off.contains(node)).collect()
        };
        diagnostic = flow_notes(diagnostic, line, &behind(&self.starved), &behind(&self.stuck));
        let quoted = self.left_out.iter().map(|node| format!("\"{}\"", line.nodes[*node].name));
        let quoted: Vec<String> = quoted.collect();
        diagnostic.help(format!("add {} to \"{key}\" of {arm}", quoted.join(", ")))
    }
}
