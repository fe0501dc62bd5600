//! A search that postpones answers nobody needs yet, against one that does not.

use crate::Texts;
use crate::bounds::BOUNDS;
use crate::outcome::{states_of, verdict};
use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, End, Outcome, explore};
use autogen_search::model::{Model, Reductions, Variable};
use autogen_search::plant::{Faults, status};
use autogen_search::story::Happened;
use autogen_search::unread::Unread;
use std::collections::{BTreeMap, BTreeSet};

/// Lines with more states are not compared.
const STATES: usize = 20_000;

const ALL: Bounds = Bounds { states: STATES, violations: 100, ..BOUNDS };

fn search(model: &Model, reductions: Reductions) -> Outcome {
    let model = Model { reductions, unread: Unread::default(), ..model.clone() };
    explore(&model, &ALL, &mut |_| true)
}

/// The values of other machines, and those of each vehicle.
type Halves = (Vec<[u64; 3]>, Vec<Vec<[u64; 3]>>);

/// Of the values of others all that vehicles have beside them.
type All = BTreeMap<Vec<[u64; 3]>, BTreeSet<Vec<Vec<[u64; 3]>>>>;

/// All states, in halves.
fn halves(model: &Model, outcome: &Outcome) -> All {
    let owner = |variable: &Variable| usize::from(model.owners[variable.var.at as usize]);
    let vehicles: Vec<usize> =
        (0..model.machines.len()).filter(|number| model.machines[*number].route.is_some()).collect();
    let half = |state: &[[u64; 3]]| -> Halves {
        let of = |is_kept: &dyn Fn(usize) -> bool| {
            let all = model.variables.iter().zip(state).filter(|(variable, _)| is_kept(owner(variable)));
            all.map(|(_, value)| *value).collect()
        };
        let of_others = of(&|owner| !vehicles.contains(&owner));
        (of_others, vehicles.iter().map(|vehicle| of(&|owner| owner == *vehicle)).collect())
    };
    let mut all = All::new();
    for (others, vehicles) in states_of(model, outcome, |_| true).iter().map(|state| half(state)) {
        all.entry(others).or_default().insert(vehicles);
    }
    all
}

/// The places of the vehicles' answers, each among the values of its own vehicle.
fn answers(model: &Model) -> Vec<usize> {
    let vehicles = (0..model.machines.len()).filter(|number| model.machines[*number].route.is_some());
    let place = |vehicle: usize| {
        let own = |variable: &&Variable| usize::from(model.owners[variable.var.at as usize]) == vehicle;
        let status = model.machines[vehicle].head.as_ref().map(|head| head.status);
        model.variables.iter().filter(own).position(|variable| Some(variable.var) == status)
    };
    vehicles.map(|vehicle| place(vehicle).expect("an answer")).collect()
}

/// They find the same; and for each state of one there is the same of the other, but that commands of vehicles that have
/// ended may be under way. How many states fewer one has; none if it is not compared.
pub fn compare(name: &str, texts: &Texts, faults: Faults) -> Option<usize> {
    let model = model(&texts.compile().project?, &Asked::with(faults)).ok()?.model;
    let more = search(&model, Reductions::OfScans);
    if more.end == End::TooManyStates {
        return None;
    }
    let less = search(&model, Reductions::All);
    assert_eq!(verdict(&less), verdict(&more), "{name}");
    assert_eq!(more.end, End::Complete, "{name}");
    assert_eq!(less.occurred, more.occurred, "{name}");
    let answers = answers(&model);
    let counts_for = |less: &[Vec<[u64; 3]>], more: &[Vec<[u64; 3]>]| {
        less.iter().zip(more).zip(&answers).all(|((less, more), answer)| {
            let is_under_way = |values: &[[u64; 3]]| values[*answer][0] == status::UNDER_WAY as u64;
            less == more || is_under_way(less) && !is_under_way(more)
        })
    };
    let (of_less, of_more) = (halves(&model, &less), halves(&model, &more));
    for (others, vehicles) in &of_more {
        let found = of_less.get(others).unwrap_or_else(|| panic!("{name}: a state of the others is missing"));
        let missing = vehicles.iter().find(|more| !found.iter().any(|less| counts_for(less, more)));
        assert_eq!(missing, None, "{name}: for this state no other one counts");
    }
    let is_real = |(others, vehicles): (&Vec<[u64; 3]>, &BTreeSet<_>)| {
        of_more.get(others).is_some_and(|more| vehicles.is_subset(more))
    };
    assert!(of_less.iter().all(is_real), "{name}: a state that cannot be reached");
    println!("{name}: {} of {} states", less.covered.states, more.covered.states);
    Some(more.covered.states - less.covered.states)
}

/// What a search with all reductions finds, and one in which all machines step in each scan and nothing is forgotten.
pub fn found_with_and_without(texts: &Texts, faults: Faults) -> [(End, Vec<String>); 2] {
    let whole = model(&texts.project(), &Asked::with(faults)).expect("a line that can be searched").model;
    let plain = Model { reductions: Reductions::Off, unread: Unread::default(), ..whole.clone() };
    [whole, plain].map(|model| verdict(&explore(&model, &ALL, &mut |_| true)))
}

/// They find the same with what is forgotten too, on two processors; and when the first violation is found, all sequences with
/// as many faults have been checked. The sequence to each is one of the line.
pub fn compare_verdicts(name: &str, texts: &Texts, faults: Faults) {
    let project = texts.project();
    let whole = model(&project, &Asked::with(faults)).expect("a line that can be searched").model;
    let more = Model { reductions: Reductions::OfScans, unread: Unread::default(), ..whole.clone() };
    let find = |model: &Model, bounds: Bounds| explore(model, &bounds, &mut |_| true);
    let forgetting = find(&whole, Bounds { jobs: 2, ..ALL });
    let found = find(&more, ALL);
    assert_eq!(verdict(&forgetting), verdict(&found), "{name}");
    if found.end == End::Complete {
        assert_eq!(forgetting.occurred, found.occurred, "{name}");
    }
    let less = Model { unread: Unread::default(), ..whole };
    let checked = |model: &Model| find(model, BOUNDS).covered.failing;
    assert_eq!(checked(&less), checked(&more), "{name}");
    for (violation, execution) in &find(&less, ALL).violations {
        let scans = &execution.scans;
        assert!(scans.first().is_none_or(|first| first.before == less.initial), "{name}: {violation:?}");
        let is_followed = |pair: &[Happened]| pair[0].after == pair[1].before;
        assert!(scans.windows(2).all(is_followed), "{name}: {violation:?} is reached by no sequence");
    }
}
