//! What is said of a kind that cannot get to where it is asked for.

use super::by_hand::ByHand;
use super::{Spot, made_by};
use crate::diagnostic::Diagnostic;
use crate::layout::decode::listing;
use crate::source::Spanned;
use runtime_sim::line::Line;
use runtime_sim::part::Primitive;
use runtime_sim::plant::{By, Transfer};
use std::collections::HashSet;

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
    pub reached: &'a HashSet<(Spot, usize)>,
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
        let passed = machines.filter(|(number, _)| reached.contains(&(Spot::Machine(*number), kind)));
        let (numbers, passed): (Vec<usize>, Vec<&str>) =
            passed.map(|(number, machine)| (number, machine.name.as_str())).unzip();
        if passed.is_empty() {
            let makers = line.machines.iter().flat_map(|machine| {
                let from = line.kinds.iter().enumerate();
                let from = from.filter(move |(from, _)| {
                    made_by(line, machine.processes().map(|(_, process)| process), *from).any(|to| to == kind)
                });
                from.map(|(_, from)| format!("{} makes it of a `{}`", machine.name, from.name))
            });
            let makers: Vec<String> = makers.collect();
            let diagnostic = diagnostic.note(format!("no source brings a `{name}`"));
            return if makers.is_empty() {
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

/// The conveyors at the end of which a kind falls onto neither a conveyor nor a place.
fn open_ends(
    line: &Line,
    transfers: &[Transfer],
    reached: &HashSet<(Spot, usize)>,
    kind: usize,
) -> Vec<String> {
    let mut ends = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        for (part, of) in machine.parts.iter().enumerate() {
            let has_sink = || {
                let mut parts = machine.parts.iter();
                parts.any(|other| matches!(&other.primitive, Primitive::Sink(sink) if sink.lane == part))
            };
            let goes_on = |transfer: &Transfer| {
                transfer.from == (number, part) && transfer.by != By::Branch && transfer.kinds.contains(&kind)
            };
            if reached.contains(&(Spot::Lane(number, part), kind))
                && !has_sink()
                && !transfers.iter().any(goes_on)
            {
                ends.push(format!("{}.{}", machine.name, of.name));
            }
        }
    }
    ends
}
