//! Whether two lines do the same to their plant: a bisimulation over all that can be reached, with as many answers in a
//! scan as the bounds allow, and up to a violation or a stop for an operator.

use autogen_search::event::{Event, What};
use autogen_search::explore::Bounds;
use autogen_search::model::Model;
use autogen_search::plant::{Action, Arm, Machine, motion, status};
use autogen_search::store::Store;
use autogen_search::successor::Expander;
use autogen_search::value::{Values, Var};
use autogen_search::violation::Violation;
use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// In all of so many pairs of states.
    Equal {
        pairs: usize,
    },
    Unequal,
    /// No difference within the bounds.
    Undecided,
}

/// What devices did, what came of it, and what the plant is then. Violations without the numbers of faults, which are those
/// of one text.
type Seen = (Vec<String>, Result<(), String>, Vec<String>, Vec<u64>);

/// Both lines have the same machines, in the same order. What is compared: which events are possible, which commands are
/// under way with which goals, where items, vehicles, tools, cylinders and processes are, which orders are made, which
/// machines are stopped, and which violations there are. States of automata, cells and levels are compared only by what
/// they do to these. Left out are the times of automata, which no device knows, and commands that ask for what is so already.
pub fn compare(a: &Model, b: &Model, bounds: &Bounds) -> Comparison {
    let begin = Instant::now();
    let answers = bounds.answers.unwrap_or(usize::MAX);
    let [mut of_a, mut of_b] = [a, b].map(|model| Expander::new(model, answers, bounds.orders));
    let [common_of_a, common_of_b] = [(a, b), (b, a)].map(|(model, other)| Common::new(model, other));
    let both = |a: &[u8], b: &[u8]| [a, b].concat();
    let length = a.initial.len();
    let mut pairs = Store::new(length + b.initial.len());
    pairs.add(&both(&a.initial, &b.initial), 0);
    let mut next = 0;
    while next < pairs.len() {
        let pair = pairs.state(next).to_vec();
        let (left, right) = pair.split_at(length);
        let (after_a, after_b) =
            (successors(&mut of_a, &common_of_a, left), successors(&mut of_b, &common_of_b, right));
        if after_a.len() != after_b.len() {
            return Comparison::Unequal;
        }
        for ((seen, of_a), (also, of_b)) in after_a.into_iter().zip(after_b) {
            if seen != also {
                return Comparison::Unequal;
            }
            // Several states that look alike are paired by the values that both models have: any pairing that holds is a proof.
            if seen.1.is_ok() {
                for (number, state) in of_a.iter().enumerate() {
                    pairs.add(&both(&state.1, partner(&of_b, number, state)), next);
                }
                for (number, state) in of_b.iter().enumerate() {
                    pairs.add(&both(partner(&of_a, number, state), &state.1), next);
                }
            }
        }
        let is_late = next % 64 == 0 && bounds.time.is_some_and(|time| begin.elapsed() > time);
        if is_late || pairs.size() > bounds.memory {
            return Comparison::Undecided;
        }
        next += 1;
    }
    Comparison::Equal { pairs: pairs.len() }
}

/// A state, behind the values of what both models have.
type After = (Vec<i32>, Vec<u8>);

/// The one with the same values; else the one of this number, or the last one.
fn partner<'a>(states: &'a [After], number: usize, state: &After) -> &'a [u8] {
    let same = states.iter().find(|other| other.0 == state.0);
    let (_, bytes) = same.unwrap_or(&states[number.min(states.len() - 1)]);
    bytes
}

/// What both models have, in the order of the names.
struct Common {
    variables: Vec<Var>,
    /// Those of them that change by themselves.
    signals: Vec<Var>,
}

impl Common {
    fn new(model: &Model, other: &Model) -> Self {
        let names: BTreeSet<&str> = other.variables.iter().map(|variable| variable.name.as_str()).collect();
        let named = model.variables.iter().map(|variable| (variable.name.as_str(), variable.var));
        let common: BTreeMap<&str, Var> = named.filter(|(name, _)| names.contains(name)).collect();
        let is_signal = |var: &Var| model.inputs.iter().any(|input| input.var == *var);
        let variables: Vec<Var> = common.into_values().collect();
        Self { signals: variables.iter().copied().filter(is_signal).collect(), variables }
    }

    fn values(&self, state: &[u8]) -> Vec<i32> {
        self.variables.iter().map(|var| var.load(state)).collect()
    }
}

fn successors(expander: &mut Expander, common: &Common, state: &[u8]) -> BTreeMap<Seen, Vec<After>> {
    let mut all = Vec::new();
    let model = expander.model;
    expander.expand(state, u64::MAX, &mut |successor| {
        let result = successor.result.as_ref().copied().map_err(kind);
        let noted = successor.noted.iter().map(kind).collect::<Vec<_>>();
        let events = successor.events.iter().copied().filter(|event| !is_hidden(model, state, event));
        all.push((events.collect::<Vec<_>>(), result, noted, successor.state.to_vec()));
    });
    let mut found: BTreeMap<Seen, BTreeSet<After>> = BTreeMap::new();
    for (events, result, noted, state) in all {
        // Behind a violation there is nothing.
        let plant =
            if result.is_ok() { plant(model, &common.signals, &expander.values, &state) } else { Vec::new() };
        let events = events.iter().map(|Event { machine, what }| format!("{machine} {what:?}")).collect();
        found.entry((events, result, noted, plant)).or_default().insert((common.values(&state), state));
    }
    found.into_iter().map(|(seen, states)| (seen, states.into_iter().collect())).collect()
}

fn is_hidden(model: &Model, state: &[u8], event: &Event) -> bool {
    match event.what {
        What::TimeComes => true,
        What::Ends(_) => !has_effect(&model.machines[event.machine], state),
        _ => false,
    }
}

/// Whether a command is under way that asks for something that is not so already.
fn has_effect(plant: &Machine, state: &[u8]) -> bool {
    let Some(head) = plant.head.as_ref().filter(|head| head.status.load(state) == status::UNDER_WAY) else {
        return false;
    };
    let asked = &head.commands[head.command.load(state) as usize];
    let moves_arm = |arm: &Arm| arm.via.load(state) != 0 || arm.goal.load(state) != arm.tool.load(state);
    match asked.action {
        _ if asked.awaits.is_some() => true,
        Action::Motion => plant.arm.as_ref().is_none_or(moves_arm),
        Action::Trip => {
            plant.route.as_ref().is_none_or(|route| route.goal.load(state) != route.at.load(state))
        }
        Action::Run | Action::Rest => plant
            .lane
            .as_ref()
            .is_none_or(|lane| matches!(lane.motion.load(state), motion::STARTS | motion::STOPS)),
        Action::Other => false,
    }
}

fn kind(violation: &Violation) -> String {
    match violation {
        Violation::Fault { instance, .. } => format!("fault of {instance}"),
        Violation::Warning { instance, .. } => format!("warning of {instance}"),
        Violation::MachineStops { instance, .. } => format!("stop of {instance}"),
        other => format!("{other:?}"),
    }
}

/// The plant in a state: numbers of both lines are equal where it is.
fn plant(model: &Model, signals: &[Var], values: &Values, state: &[u8]) -> Vec<u64> {
    let mut all = Vec::new();
    let number = |var: Var| var.load(state) as u64;
    for (machine, plant) in model.machines.iter().enumerate() {
        let is_under_way = has_effect(plant, state);
        all.extend([u64::from(is_under_way), u64::from(model.stands(state, machine))]);
        if let Some(head) = plant.head.as_ref().filter(|_| is_under_way) {
            all.push(number(head.command));
        }
        let goals = plant.arm.iter().flat_map(|arm| [arm.via, arm.goal]);
        let goals = goals.chain(plant.route.iter().map(|route| route.goal)).filter(|_| is_under_way);
        let here = plant.arm.iter().map(|arm| arm.tool).chain(plant.route.iter().map(|route| route.at));
        for place in here.chain(goals) {
            all.extend(values.point(place.load(state)).map(f64::to_bits));
        }
        all.extend(plant.arm.iter().flat_map(|arm| [arm.holds, arm.shown]).map(number));
        all.extend(plant.lane.iter().map(|lane| number(lane.motion)));
        all.extend(plant.desk.iter().flat_map(|desk| [desk.phase, desk.order, desk.next]).map(number));
        for place in &plant.places {
            all.extend(place.items.iter().chain(&place.stray).copied().map(number));
        }
    }
    all.extend(signals.iter().map(|signal| number(*signal)));
    all.extend(model.cylinders.iter().map(|cylinder| number(cylinder.position)));
    all.extend(
        model.processes.iter().flat_map(|process| [process.asked, process.runs, process.ended]).map(number),
    );
    all.extend(model.orders.iter().map(|order| number(order.made)));
    all
}
