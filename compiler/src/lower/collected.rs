//! Whether items can get to the sinks that should collect them.

use super::{Loss, Lost};
use crate::connect::Edge;
use crate::diagnostic::Diagnostic;
use crate::layout::decode::listing;
use crate::scenario::Scenario;
use runtime_sim::line::{self, Goal, Line};
use runtime_sim::part::Primitive;
use runtime_sim::plant::{By, Transfer};
use std::cell::OnceCell;
use std::collections::{HashMap, HashSet};

/// Where an item may be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
enum Spot {
    /// On a conveyor: machine and part.
    Lane(usize, usize),
    /// Elsewhere on a machine.
    Machine(usize),
}

/// One for each kind that a sink should collect, and that cannot get there. `edges` are those between machines.
pub fn out_of_reach(
    scenario: &Scenario,
    line: &Line,
    edges: &[Edge],
    transfers: &[Transfer],
) -> Vec<Diagnostic> {
    let Goal::Collected(goal) = &line.scenario.goal else { return Vec::new() };
    if is_anywhere(line, edges) {
        return Vec::new();
    }
    let reached = reached(line, edges, transfers, None);
    let asked = goal.iter().zip(&scenario.goal);
    let lacking = asked.flat_map(|(collected, written)| {
        let kinds = (0..line.kinds.len()).filter(|kind| collected.items[*kind] > 0);
        let missed = kinds.filter(|kind| !comes_to(line, &reached, collected, *kind));
        missed.map(|kind| diagnostic(line, transfers, &reached, kind, written)).collect::<Vec<_>>()
    });
    lacking.collect()
}

/// What falls from a gripper, and what an arm takes that knows no handovers, may get anywhere.
fn is_anywhere(line: &Line, edges: &[Edge]) -> bool {
    let is_free =
        |machine: usize| has_grip(line, machine) && !edges.iter().any(|e| [e.from, e.to].contains(&machine));
    !line.scenario.slips.is_empty() || (0..line.machines.len()).any(is_free)
}

/// Machines of a line for each of which it is found out what is lost without it.
const MOST_LOSSES: usize = 300;

/// What no longer gets to where it is collected without each machine, but for those where it is collected; none where items
/// may get anywhere, or in a long line.
pub fn losses(line: &Line, edges: &[Edge], transfers: &[Transfer]) -> Vec<Loss> {
    if is_anywhere(line, edges) || line.machines.len() > MOST_LOSSES {
        return Vec::new();
    }
    let mut goals: Vec<(usize, Spot, String)> = Vec::new();
    for (number, machine) in line.machines.iter().enumerate() {
        for part in &machine.parts {
            match &part.primitive {
                Primitive::Sink(sink) => {
                    goals.push((
                        number,
                        Spot::Lane(number, sink.lane),
                        format!("{}.{}", machine.name, part.name),
                    ));
                }
                Primitive::Orders(_) => goals.push((number, Spot::Machine(number), machine.name.clone())),
                _ => {}
            }
        }
    }
    let whole = reached(line, edges, transfers, None);
    let lost = |spot: Spot, at: &str, left: &HashSet<(Spot, usize)>| -> Lost {
        let all = (0..line.kinds.len()).filter(|kind| whole.contains(&(spot, *kind)));
        let (others, kinds): (Vec<_>, Vec<_>) = all.partition(|kind| left.contains(&(spot, *kind)));
        let names = |kinds: Vec<usize>| kinds.into_iter().map(|kind| line.kinds[kind].name.clone()).collect();
        Lost { at: at.into(), kinds: names(kinds), others: names(others) }
    };
    let without = |machine: usize| {
        let left = reached(line, edges, transfers, Some(machine));
        let others = goals.iter().filter(|(at, ..)| *at != machine);
        let lost = others.map(|(_, spot, name)| lost(*spot, name, &left));
        let goals: Vec<_> = lost.filter(|lost| !lost.kinds.is_empty()).collect();
        (!goals.is_empty()).then(|| Loss { machine: line.machines[machine].name.clone(), goals })
    };
    (0..line.machines.len()).filter_map(without).collect()
}

/// Whether a kind may get onto a lane, a part of a machine. Found out when it is first asked for.
pub fn comes_onto<'a>(
    line: &'a Line,
    edges: &'a [Edge],
    transfers: &'a [Transfer],
) -> impl Fn((usize, usize), usize) -> bool + 'a {
    let all = OnceCell::new();
    move |(machine, part), kind| {
        let reached = all.get_or_init(|| reached(line, edges, transfers, None));
        reached.contains(&(Spot::Lane(machine, part), kind))
    }
}

fn has_grip(line: &Line, machine: usize) -> bool {
    line.machines[machine].parts.iter().any(|part| matches!(part.primitive, Primitive::Grip(_)))
}

fn comes_to(line: &Line, reached: &HashSet<(Spot, usize)>, sink: &line::Collected, kind: usize) -> bool {
    match &line.machines[sink.machine].parts[sink.part].primitive {
        Primitive::Sink(found) => reached.contains(&(Spot::Lane(sink.machine, found.lane), kind)),
        _ => true,
    }
}

/// Where items of each kind may get to, whatever is commanded, if one machine is missing or none.
fn reached(
    line: &Line,
    edges: &[Edge],
    transfers: &[Transfer],
    missing: Option<usize>,
) -> HashSet<(Spot, usize)> {
    let lanes = |machine: usize| {
        let parts = line.machines[machine].parts.iter().enumerate();
        let lanes = parts.filter(|(_, part)| matches!(part.primitive, Primitive::Lane(_)));
        lanes.map(move |(part, _)| Spot::Lane(machine, part))
    };
    let mut open: Vec<(Spot, usize)> = Vec::new();
    for supply in &line.scenario.supply {
        for part in &line.machines[supply.belt].parts {
            if let Primitive::Source(source) = &part.primitive {
                open.extend(supply.items.iter().map(|kind| (Spot::Lane(supply.belt, source.lane), *kind)));
            }
        }
    }
    // In a long line everything gets nearly everywhere.
    let mut leads_to: HashMap<(usize, usize), Vec<&Transfer>> = HashMap::new();
    transfers.iter().for_each(|transfer| leads_to.entry(transfer.from).or_default().push(transfer));
    let onto = |(machine, part): (usize, usize)| match line.machines[machine].parts[part].primitive {
        Primitive::Lane(_) => Spot::Lane(machine, part),
        _ => Spot::Machine(machine),
    };
    let mut hands_to = vec![Vec::new(); line.machines.len()];
    edges.iter().for_each(|edge| hands_to[edge.from].push(edge.to));
    let mut reached = HashSet::new();
    while let Some((spot, kind)) = open.pop() {
        let (Spot::Lane(machine, _) | Spot::Machine(machine)) = spot;
        if missing == Some(machine) {
            continue;
        }
        if !reached.insert((spot, kind)) {
            continue;
        }
        let machine = match spot {
            Spot::Lane(machine, part) => {
                let next = leads_to.get(&(machine, part)).into_iter().flatten();
                let next = next.filter(|transfer| transfer.kinds.contains(&kind));
                open.extend(next.map(|transfer| (onto(transfer.to), kind)));
                open.push((Spot::Machine(machine), kind));
                machine
            }
            Spot::Machine(machine) => {
                for &to in &hands_to[machine] {
                    open.push((Spot::Machine(to), kind));
                    open.extend(lanes(to).map(|lane| (lane, kind)));
                }
                if has_grip(line, machine) {
                    open.extend(lanes(machine).map(|lane| (lane, kind)));
                }
                machine
            }
        };
        open.extend(made_of(line, machine, kind).map(|made| (spot, made)));
    }
    reached
}

/// The kinds into which a machine makes one.
fn made_of(line: &Line, machine: usize, kind: usize) -> impl Iterator<Item = usize> {
    let made = line.machines[machine].processes().flat_map(|process| process.made());
    let made = made.filter(move |[from, _]| *from == line.kinds[kind].name);
    made.filter_map(|[_, to]| line.kinds.iter().position(|kind| kind.name == to))
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

fn diagnostic(
    line: &Line,
    transfers: &[Transfer],
    reached: &HashSet<(Spot, usize)>,
    kind: usize,
    written: &crate::scenario::Collected<crate::source::Spanned<String>>,
) -> Diagnostic {
    let (name, sink) = (&line.kinds[kind].name, &written.sink);
    let message = format!("no `{name}` can get to the sink {}", sink.value);
    let diagnostic = Diagnostic::new("E0410", sink.span, message);
    let machines = line.machines.iter().enumerate();
    let passed = machines.filter(|(number, _)| reached.contains(&(Spot::Machine(*number), kind)));
    let passed: Vec<&str> = passed.map(|(_, machine)| machine.name.as_str()).collect();
    if passed.is_empty() {
        let makers = line.machines.iter().enumerate().flat_map(|(number, machine)| {
            let from = line.kinds.iter().enumerate();
            let from = from.filter(move |(from, _)| made_of(line, number, *from).any(|to| to == kind));
            from.map(|(_, from)| format!("{} makes it of a `{}`", machine.name, from.name))
        });
        let makers: Vec<String> = makers.collect();
        let diagnostic = diagnostic.note(format!("no source brings a `{name}`"));
        return if makers.is_empty() {
            diagnostic.note(format!("no process makes a `{name}`")).help(format!(
                "add `{name}` to `items` of `supply`, let a process make it (`makes: [KIND, {name}]`), or take it out \
                 of the goal"
            ))
        } else {
            diagnostic.note(makers.join(", ")).help(format!(
                "let such a kind get there, add `{name}` to `items` of `supply`, or take it out of the goal"
            ))
        };
    }
    let ends = open_ends(line, transfers, reached, kind);
    let diagnostic = diagnostic.note(format!("machines that a `{name}` can get to: {}", listing(&passed)));
    let diagnostic = match ends.is_empty() {
        true => diagnostic,
        false => {
            let ends: Vec<&str> = ends.iter().map(String::as_str).collect();
            diagnostic.note(format!(
                "beyond the end of {} it falls onto neither a conveyor nor a place",
                listing(&ends)
            ))
        }
    };
    diagnostic.help(
        "let a conveyor begin where the one before it ends, or name a sink after these machines in the goal",
    )
}
