//! Whether items can get to the sinks that should collect them, and to the stations whose orders ask for them.

mod along;
mod by_hand;
mod missing;

use super::{Loss, Lost};
use crate::connect::Edge;
use crate::diagnostic::Diagnostic;
use crate::layout::Layout;
use crate::scenario::Scenario;
use along::Along;
use by_hand::ByHand;
use missing::{Asked, Missing, open_ends};
use runtime_sim::line::{self, Goal, Line};
use runtime_sim::part::Primitive;
use runtime_sim::part::process::Process;
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

/// Where items of each kind may get to: on a lane with the least distance of their middles from its beginning, m, elsewhere
/// with 0.
type Reached = HashMap<(Spot, usize), f64>;

/// One for each kind that a sink should collect, or that the orders of a station ask for, and that cannot get there.
/// `edges` are those between machines.
pub fn out_of_reach(
    scenario: &Scenario,
    layout: &Layout,
    line: &Line,
    edges: &[Edge],
    transfers: &[Transfer],
) -> Vec<Diagnostic> {
    // What falls from a gripper may get anywhere.
    if !line.scenario.slips.is_empty() {
        return Vec::new();
    }
    let Some(by_hand) = ByHand::new(line, without_handovers(line, edges)) else { return Vec::new() };
    let reached = reached(line, handovers(edges).chain(by_hand.pairs()), transfers, None);
    let missing = Missing { line, transfers, by_hand: &by_hand, reached: &reached };
    let mut found = Vec::new();
    if let Goal::Collected(goal) = &line.scenario.goal {
        for (collected, written) in goal.iter().zip(&scenario.goal) {
            let kinds = (0..line.kinds.len()).filter(|kind| collected.items[*kind] > 0);
            let missed = kinds.filter(|kind| !comes_to(line, &reached, collected, *kind));
            let asked = Asked::Sink(&written.sink);
            found.extend(missed.map(|kind| missing.diagnostic(kind, &asked)));
        }
    }
    // Without arms it is a part of a line: who brings the items is not there.
    let has_arms = (0..line.machines.len()).any(|machine| has_grip(line, machine));
    let mut told: HashSet<(usize, usize)> = HashSet::new();
    for order in line.scenario.orders.iter().filter(|_| has_arms) {
        let gets = |kind: usize| {
            order.stations.iter().any(|station| reached.contains_key(&(Spot::Machine(*station), kind)))
        };
        let kinds = (0..line.kinds.len()).filter(|kind| order.parts[*kind] > 0);
        for kind in kinds.filter(|kind| !gets(*kind)) {
            let stations = order.stations.iter().filter(|station| told.insert((**station, kind)));
            let names = stations.filter_map(|station| {
                let name = &line.machines[*station].name;
                layout.objects.iter().map(|object| &object.name).find(|known| known.value == *name)
            });
            found.extend(names.map(|name| missing.diagnostic(kind, &Asked::Station(name))));
        }
    }
    // Trays bear what falls onto them wherever they are, and what falls off a conveyor with them.
    let has_trays = line.kinds.iter().any(|kind| kind.deck.is_some());
    let falls_off = |kind: usize| !open_ends(line, transfers, &reached, kind).is_empty();
    if !found.is_empty() && has_trays && (0..line.kinds.len()).any(falls_off) {
        return Vec::new();
    }
    found
}

fn handovers(edges: &[Edge]) -> impl Iterator<Item = [usize; 2]> + Clone {
    edges.iter().map(|edge| [edge.from, edge.to])
}

/// Arms that know no handovers: these may take what is within their reach.
fn without_handovers(line: &Line, edges: &[Edge]) -> Vec<usize> {
    let known: HashSet<usize> = handovers(edges).flatten().collect();
    let is_free = |machine: &usize| has_grip(line, *machine) && !known.contains(machine);
    (0..line.machines.len()).filter(is_free).collect()
}

/// What falls from a gripper, and what an arm takes that knows no handovers, may get anywhere.
fn is_anywhere(line: &Line, edges: &[Edge]) -> bool {
    !line.scenario.slips.is_empty() || !without_handovers(line, edges).is_empty()
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
    let whole = reached(line, handovers(edges), transfers, None);
    let lost = |spot: Spot, at: &str, left: &Reached| -> Lost {
        let all = (0..line.kinds.len()).filter(|kind| whole.contains_key(&(spot, *kind)));
        let (others, kinds): (Vec<_>, Vec<_>) = all.partition(|kind| left.contains_key(&(spot, *kind)));
        let names = |kinds: Vec<usize>| kinds.into_iter().map(|kind| line.kinds[kind].name.clone()).collect();
        Lost { at: at.into(), kinds: names(kinds), others: names(others) }
    };
    let without = |machine: usize| {
        let left = reached(line, handovers(edges), transfers, Some(machine));
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
        let reached = all.get_or_init(|| reached(line, handovers(edges), transfers, None));
        reached.contains_key(&(Spot::Lane(machine, part), kind))
    }
}

fn has_grip(line: &Line, machine: usize) -> bool {
    line.machines[machine].parts.iter().any(|part| matches!(part.primitive, Primitive::Grip(_)))
}

fn comes_to(line: &Line, reached: &Reached, sink: &line::Collected, kind: usize) -> bool {
    match &line.machines[sink.machine].parts[sink.part].primitive {
        Primitive::Sink(found) => reached.contains_key(&(Spot::Lane(sink.machine, found.lane), kind)),
        _ => true,
    }
}

/// Where items of each kind may get to, whatever is commanded, if one machine is missing or none.
fn reached(
    line: &Line,
    handovers: impl Iterator<Item = [usize; 2]>,
    transfers: &[Transfer],
    missing: Option<usize>,
) -> Reached {
    let lanes = |machine: usize| {
        let parts = line.machines[machine].parts.iter().enumerate();
        let lanes = parts.filter(|(_, part)| matches!(part.primitive, Primitive::Lane(_)));
        lanes.map(move |(part, _)| Spot::Lane(machine, part))
    };
    let mut open: Vec<(Spot, usize, f64)> = Vec::new();
    for supply in &line.scenario.supply {
        for part in &line.machines[supply.belt].parts {
            if let Primitive::Source(source) = &part.primitive {
                let spot = Spot::Lane(supply.belt, source.lane);
                open.extend(supply.items.iter().map(|kind| (spot, *kind, source.inset)));
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
    handovers.for_each(|[from, to]| hands_to[from].push(to));
    let along = Along::new(line);
    let mut reached = Reached::new();
    while let Some((spot, kind, first)) = open.pop() {
        let (Spot::Lane(machine, _) | Spot::Machine(machine)) = spot;
        if missing == Some(machine) {
            continue;
        }
        let known = reached.entry((spot, kind)).or_insert(f64::INFINITY);
        if first >= *known {
            continue;
        }
        *known = first;
        match spot {
            Spot::Lane(machine, part) => {
                let next = leads_to.get(&(machine, part)).into_iter().flatten();
                let next = next
                    .filter(|transfer| transfer.kinds.contains(&kind) && goes(&along, transfer, kind, first));
                open.extend(next.map(|transfer| (onto(transfer.to), kind, 0.0)));
                open.push((Spot::Machine(machine), kind, 0.0));
                if along.may_close(machine, part) {
                    open.push((spot, kind, 0.0));
                }
            }
            Spot::Machine(machine) => {
                for &to in &hands_to[machine] {
                    open.push((Spot::Machine(to), kind, 0.0));
                    open.extend(lanes(to).map(|lane| (lane, kind, 0.0)));
                }
                if has_grip(line, machine) {
                    open.extend(lanes(machine).map(|lane| (lane, kind, 0.0)));
                }
            }
        }
        open.extend(made_at(line, &along, spot, kind, first).map(|(made, first)| (spot, made, first)));
    }
    reached
}

/// Whether an item goes by a transfer whose middle comes onto the first lane at `first`.
fn goes(along: &Along, transfer: &Transfer, kind: usize, first: f64) -> bool {
    let machine = transfer.from.0;
    match transfer.by {
        By::Branch { part } => along
            .beside((machine, part), kind)
            .is_none_or(|branch| along.reached(&branch, machine, first).is_ok()),
        By::Joint { .. } | By::Fall => true,
    }
}

/// The kinds that one becomes there, and from where on: on a lane by what works on it, elsewhere on a machine by what works
/// at its places.
fn made_at(
    line: &Line,
    along: &Along,
    spot: Spot,
    kind: usize,
    first: f64,
) -> impl Iterator<Item = (usize, f64)> {
    let (Spot::Lane(machine, _) | Spot::Machine(machine)) = spot;
    let parts = line.machines[machine].parts.iter().enumerate();
    let processes = parts.filter_map(move |(part, of)| {
        let Primitive::Process(process) = &of.primitive else { return None };
        let from = match (spot, along.beside((machine, part), kind)) {
            (Spot::Lane(_, lane), Some(beside)) if beside.lane == lane => {
                along.reached(&beside, machine, first).ok()?
            }
            (Spot::Machine(_), None) => 0.0,
            _ => return None,
        };
        Some((process, from))
    });
    processes.flat_map(move |(process, from)| made_by(line, process, kind).map(move |made| (made, from)))
}

/// The kinds that one becomes by a process.
fn made_by<'a>(line: &'a Line, process: &'a Process, kind: usize) -> impl Iterator<Item = usize> + 'a {
    let made = process.made().filter(move |[from, _]| *from == line.kinds[kind].name);
    made.filter_map(|[_, to]| line.kinds.iter().position(|kind| kind.name == to))
}
