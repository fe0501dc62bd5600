//! What is said of a kind that cannot get to where it is asked for.

use super::along::{Beside, Missed};
use super::by_hand::ByHand;
use super::{Reached, Spot, made_by};
use crate::diagnostic::Diagnostic;
use crate::layout::decode::listing;
use crate::source::Spanned;
use runtime_sim::line::Line;
use runtime_sim::part::Primitive;
use runtime_sim::plant::{By, Transfer};

/// Who asks for it, by the name that is shown.
pub enum Asked<'a> {
    /// As `machine.part`.
    Sink(&'a Spanned<String>),
    Station(&'a Spanned<String>),
}

pub struct Missing<'a> {
    pub line: &'a Line,
    pub transfers: &'a [Transfer],
    pub by_hand: &'a ByHand,
    pub reached: &'a Reached,
}

impl Missing<'_> {
    pub fn diagnostic(&self, kind: usize, asked: &Asked) -> Diagnostic {
        let Self { line, transfers, by_hand, reached } = self;
        let name = &line.kinds[kind].name;
        let (to, place, from) = match asked {
            Asked::Sink(sink) => (format!("the sink {}", sink.value), sink.span, "the goal"),
            Asked::Station(station) => {
                (format!("{}, whose orders ask for it", station.value), station.span, "the orders")
            }
        };
        let diagnostic = Diagnostic::new("E0410", place, format!("no `{name}` can get to {to}"));
        let machines = line.machines.iter().enumerate();
        let passed = machines.filter(|(number, _)| reached.contains_key(&(Spot::Machine(*number), kind)));
        let (numbers, passed): (Vec<usize>, Vec<&str>) =
            passed.map(|(number, machine)| (number, machine.name.as_str())).unzip();
        let misplaced = misplaced(line, reached);
        if passed.is_empty() {
            let makers = line.machines.iter().flat_map(|machine| {
                let from = line.kinds.iter().enumerate();
                let from = from.filter(move |(from, _)| {
                    machine.processes().any(|(_, process)| made_by(line, process, *from).any(|to| to == kind))
                });
                from.map(|(_, from)| format!("{} makes it of a `{}`", machine.name, from.name))
            });
            let makers: Vec<String> = makers.collect();
            let diagnostic = diagnostic.note(format!("no source brings a `{name}`"));
            return if !misplaced.is_empty() {
                noted(diagnostic, &misplaced).help(MOVE)
            } else if makers.is_empty() {
                diagnostic.note(format!("no process makes a `{name}`")).help(format!(
                    "add `{name}` to `items` of `supply`, let a process make it (`makes: [KIND, {name}]`), or take it \
                     out of {from}"
                ))
            } else {
                diagnostic.note(makers.join(", ")).help(format!(
                    "let such a kind get there, add `{name}` to `items` of `supply`, or take it out of {from}"
                ))
            };
        }
        let mut diagnostic =
            diagnostic.note(format!("machines that a `{name}` can get to: {}", listing(&passed)));
        let ends = open_ends(line, transfers, reached, kind);
        if !ends.is_empty() {
            let ends: Vec<&str> = ends.iter().map(String::as_str).collect();
            diagnostic = diagnostic.note(format!(
                "beyond the end of {} it falls onto neither a conveyor nor a place",
                listing(&ends)
            ));
        }
        for (arm, apart, other) in by_hand.apart(&numbers) {
            let [arm, other] = [arm, other].map(|machine| &line.machines[machine].name);
            diagnostic = diagnostic.note(format!(
                "the tool of {arm} stays at least {apart:.3} m away from items on {other}, the nearest of these machines"
            ));
        }
        if !misplaced.is_empty() {
            return noted(diagnostic, &misplaced).help(MOVE);
        }
        diagnostic.help(match asked {
            Asked::Sink(_) => {
                "let a conveyor begin where the one before it ends, or name a sink after these machines in the goal"
                    .to_owned()
            }
            Asked::Station(station) => format!(
                "let a conveyor begin where the one before it ends, bring {} and the arm that takes the `{name}` to it \
                 nearer to these machines, or take `{name}` out of the orders",
                station.value
            ),
        })
    }
}

/// What may help where something stands along a conveyor that items do not get to.
const MOVE: &str = "move what no item gets to, the sink or the source along the conveyor, or change the goal";
/// No more parts are named that stand where items do not get to.
const MOST_NAMED: usize = 5;

fn noted(diagnostic: Diagnostic, notes: &[String]) -> Diagnostic {
    notes.iter().take(MOST_NAMED).fold(diagnostic, |diagnostic, note| diagnostic.note(note.clone()))
}

/// A text for each process, diverter and pusher along a conveyor that kinds do not get to which are on this conveyor.
fn misplaced(line: &Line, reached: &Reached) -> Vec<String> {
    let mut texts = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        for (part, of) in machine.parts.iter().enumerate() {
            let works_on = |kind: usize| match &of.primitive {
                Primitive::Process(process) => made_by(line, process, kind).next().is_some(),
                _ => true,
            };
            let missed = (0..line.kinds.len()).filter(|kind| works_on(*kind)).find_map(|kind| {
                let beside = Beside::of(line, (number, part), kind)?;
                let first = reached.get(&(Spot::Lane(number, beside.lane), kind))?;
                Some((kind, beside.reached(line, number, *first).err()?, beside))
            });
            let Some((kind, missed, Beside { lane, at, .. })) = missed else { continue };
            let (kind, name) = (&line.kinds[kind].name, |part: usize| &machine.parts[part].name);
            let gets = match missed {
                Missed::Behind(first) => format!("comes onto it at {first:.3} m"),
                Missed::Before(last, Some(sink)) => format!("leaves it at {last:.3} m, by {}", name(sink)),
                Missed::Before(last, None) => format!("leaves it at its end, at {last:.3} m"),
            };
            texts.push(format!(
                "{}.{} is at {at:.3} m of {}: the middle of a `{kind}` {gets}",
                machine.name,
                of.name,
                name(lane)
            ));
        }
    }
    texts
}

/// The conveyors at the end of which a kind falls onto neither a conveyor nor a place.
fn open_ends(line: &Line, transfers: &[Transfer], reached: &Reached, kind: usize) -> Vec<String> {
    let mut ends = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        for (part, of) in machine.parts.iter().enumerate() {
            let has_sink = || {
                let mut parts = machine.parts.iter();
                parts.any(|other| matches!(&other.primitive, Primitive::Sink(sink) if sink.lane == part))
            };
            let goes_on = |transfer: &Transfer| {
                transfer.from == (number, part)
                    && !matches!(transfer.by, By::Branch { .. })
                    && transfer.kinds.contains(&kind)
            };
            if reached.contains_key(&(Spot::Lane(number, part), kind))
                && !has_sink()
                && !transfers.iter().any(goes_on)
            {
                ends.push(format!("{}.{}", machine.name, of.name));
            }
        }
    }
    ends
}
