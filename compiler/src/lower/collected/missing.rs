//! What is said of a kind that cannot get to where it is asked for.

use super::along::{Along, Missed};
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
        let misplaced = misplaced(line, reached, kind);
        let noted =
            |diagnostic: Diagnostic| misplaced.iter().fold(diagnostic, |d, note| d.note(note.clone()));
        let help = |usual: String| if misplaced.is_empty() { usual } else { format!("{MOVE}; or {usual}") };
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
            return if makers.is_empty() {
                noted(diagnostic.note(format!("no process makes a `{name}`"))).help(help(format!(
                    "add `{name}` to `items` of `supply`, let a process make it (`makes: [KIND, {name}]`), or take it \
                     out of {from}"
                )))
            } else {
                noted(diagnostic.note(makers.join(", "))).help(help(format!(
                    "let such a kind get there, add `{name}` to `items` of `supply`, or take it out of {from}"
                )))
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
        noted(diagnostic).help(help(match asked {
            Asked::Sink(_) => {
                "let a conveyor begin where the one before it ends, or name a sink after these machines in the goal"
                    .to_owned()
            }
            Asked::Station(station) => format!(
                "let a conveyor begin where the one before it ends, bring {} and the arm that takes the `{name}` to it \
                 nearer to these machines, or take `{name}` out of the orders",
                station.value
            ),
        }))
    }
}

/// What helps too where something stands along a conveyor that items do not get to.
const MOVE: &str = "move what no item gets to along its conveyor";
/// No more parts are named that stand where items do not get to.
const MOST_NAMED: usize = 5;

/// The kinds that processes can make a kind of, one after another, and itself.
fn becoming(line: &Line, kind: usize) -> Vec<bool> {
    let mut known = vec![false; line.kinds.len()];
    let mut open = vec![kind];
    while let Some(kind) = open.pop() {
        if std::mem::replace(&mut known[kind], true) {
            continue;
        }
        let processes = line.machines.iter().flat_map(|machine| machine.processes());
        let made = processes.flat_map(|(_, process)| process.made());
        let from = made.filter(|[_, to]| *to == line.kinds[kind].name);
        open.extend(from.filter_map(|[from, _]| line.kinds.iter().position(|other| other.name == from)));
    }
    known
}

/// A text for each process, diverter and pusher along a conveyor that would bring a kind nearer to where it is missing, and
/// does not get the items for that which are on this conveyor.
fn misplaced(line: &Line, reached: &Reached, kind: usize) -> Vec<String> {
    let (along, wanted) = (Along::new(line), becoming(line, kind));
    let mut texts = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        for (part, of) in machine.parts.iter().enumerate() {
            let helps = |kind: usize| match &of.primitive {
                Primitive::Process(process) => made_by(line, process, kind).any(|made| wanted[made]),
                _ => wanted[kind],
            };
            let missed = (0..line.kinds.len()).filter(|kind| helps(*kind)).find_map(|kind| {
                let beside = along.beside((number, part), kind)?;
                let first = reached.get(&(Spot::Lane(number, beside.lane), kind))?;
                Some((kind, along.reached(&beside, number, *first).err()?, beside))
            });
            let Some((kind, missed, beside)) = missed else { continue };
            let (kind, name) = (&line.kinds[kind].name, |part: usize| &machine.parts[part].name);
            let gets = match missed {
                Missed::Behind(first) => format!("this is on it from {first:.3} m on"),
                Missed::Before(last, Some(sink)) => {
                    format!("this leaves it at {last:.3} m, by {}", name(sink))
                }
                Missed::Before(last, None) => format!("this leaves it at its end, at {last:.3} m"),
            };
            let [low, high] = beside.middles;
            let middles = match high - low > 0.0 {
                true => format!("from {low:.3} to {high:.3} m"),
                false => format!("at {low:.3} m"),
            };
            texts.push(format!(
                "{}.{} at {:.3} m of {} acts on a `{kind}` with its middle {middles}, and {gets}",
                machine.name,
                of.name,
                beside.at,
                name(beside.lane)
            ));
        }
    }
    texts.truncate(MOST_NAMED);
    texts
}

/// The conveyors at the end of which a kind falls onto neither a conveyor nor a place.
pub fn open_ends(line: &Line, transfers: &[Transfer], reached: &Reached, kind: usize) -> Vec<String> {
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
