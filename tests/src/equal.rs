//! Whether two lines do the same to their plant: a bisimulation over all that can be reached, with as many answers in a
//! scan as the bounds allow, and up to a violation or a stop for an operator.

use autogen_search::event::{Event, What};
use autogen_search::explore::Bounds;
use autogen_search::model::Model;
use autogen_search::plant::{Action, Arm, Machine, motion, status};
use autogen_search::store::Store;
use autogen_search::successor::Expander;
use autogen_search::unread::Unread;
use autogen_search::value::{Values, Var};
use autogen_search::violation::Violation;
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::time::Instant;

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    Equal,
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
    let mut both = Transitions::default();
    for (model, other) in [(a, b), (b, a)] {
        if !both.explore(model, other, bounds, begin) {
            return Comparison::Undecided;
        }
    }
    // The first state of the first model is the first one of all.
    if both.are_bisimilar(0, both.first_of_last) { Comparison::Equal } else { Comparison::Unequal }
}

/// What is seen of transitions, and where they lead, for the states of several models one after the other.
#[derive(Default)]
struct Transitions {
    /// Numbers of what is seen.
    seen: HashMap<Seen, u32>,
    /// Of each state; a transition that ends in a violation leads nowhere.
    of: Vec<Vec<(u32, Option<u32>)>>,
    /// The first state of the last model.
    first_of_last: usize,
}

impl Transitions {
    /// Adds all states of a model. Signals that the other one does not have are not seen. False if the bounds end it.
    fn explore(&mut self, model: &Model, other: &Model, bounds: &Bounds, begin: Instant) -> bool {
        // Which values nobody reads a search finds out; here they all count.
        let model = &Model { unread: Unread::default(), ..model.clone() };
        let mut expander = Expander::new(model, bounds.answers.unwrap_or(usize::MAX), bounds.orders);
        let signals = common_signals(model, other);
        let mut store = Store::new(model.initial.len());
        store.add(&model.initial, 0);
        self.first_of_last = self.of.len();
        let mut next = 0;
        while next < store.len() {
            let mut found = BTreeSet::new();
            for (seen, state) in successors(&mut expander, &signals, store.state(next)) {
                let to = state.map(|state| (self.first_of_last + store.add(&state, next).0) as u32);
                let count = self.seen.len() as u32;
                found.insert((*self.seen.entry(seen).or_insert(count), to));
            }
            self.of.push(found.into_iter().collect());
            let is_late = next % 64 == 0 && bounds.time.is_some_and(|time| begin.elapsed() > time);
            if is_late || store.size() > bounds.memory {
                return false;
            }
            next += 1;
        }
        true
    }

    /// By classes of states: each is split as long as states in it lead to different classes.
    fn are_bisimilar(&self, a: usize, b: usize) -> bool {
        let mut class = vec![0_u32; self.of.len()];
        let mut count = 1;
        loop {
            let mut classes = HashMap::new();
            let split: Vec<u32> = self
                .of
                .iter()
                .zip(&class)
                .map(|(transitions, own)| {
                    let to = |to: &Option<u32>| to.map(|to| class[to as usize]);
                    let leads: BTreeSet<_> =
                        transitions.iter().map(|(seen, state)| (*seen, to(state))).collect();
                    let number = classes.len() as u32;
                    *classes.entry((*own, leads)).or_insert(number)
                })
                .collect();
            class = split;
            if class[a] != class[b] {
                return false;
            }
            if classes.len() == count {
                return true;
            }
            count = classes.len();
        }
    }
}

/// Values that change by themselves in both models, in the order of their names.
fn common_signals(model: &Model, other: &Model) -> Vec<Var> {
    let names: BTreeSet<&str> = other.variables.iter().map(|variable| variable.name.as_str()).collect();
    let is_signal = |var: Var| model.inputs.iter().any(|input| input.var == var);
    let common = model.variables.iter().filter(|v| names.contains(v.name.as_str()) && is_signal(v.var));
    common
        .map(|variable| (variable.name.as_str(), variable.var))
        .collect::<BTreeMap<_, _>>()
        .into_values()
        .collect()
}

/// Behind a violation there is no state.
fn successors(expander: &mut Expander, signals: &[Var], state: &[u8]) -> Vec<(Seen, Option<Vec<u8>>)> {
    let mut all = Vec::new();
    let model = expander.model;
    expander.expand(state, u64::MAX, &mut |successor| {
        let result = successor.result.as_ref().copied().map_err(kind);
        let noted = successor.noted.iter().map(kind).collect::<Vec<_>>();
        let events = successor.events.iter().filter(|event| !is_hidden(model, state, event));
        let events = events.map(|Event { machine, what }| format!("{machine} {what:?}")).collect();
        all.push((events, result, noted, successor.state.to_vec()));
    });
    let found = all.into_iter().map(|(events, result, noted, state)| match result {
        Ok(()) => {
            let plant = plant(model, signals, &expander.values, &state);
            ((events, result, noted, plant), Some(state))
        }
        Err(_) => ((events, result, noted, Vec::new()), None),
    });
    found.collect()
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
        Violation::Stop { .. } => "stop for an operator".to_string(),
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
