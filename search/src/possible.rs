//! Whether the orders can always still be made, and what is waited for can always still come: from every state that was
//! reached there is a path to one in which it is so, on which no device fails any more.

use crate::cut::Cut;
use crate::explore::{Bounds, Decided};
use crate::model::{Model, Reductions};
use crate::property::Check;
use crate::reached::Reached;
use crate::successor::Expander;
use crate::value::Values;
use crate::violation::Violation;
use std::time::Instant;

/// Transitions before which at most one device did something, and nothing failed. If paths of them lead to the orders, these
/// can be made; if they do not, all paths on which nothing fails are checked.
#[derive(Default)]
pub(crate) struct Edges {
    list: Vec<(u32, u32)>,
    /// States from which something leads to a violation although nothing fails: what could come after it is not known.
    out: Vec<u32>,
    /// States from which the line comes to a stop for an operator although nothing fails any more.
    stops: Vec<u32>,
}

/// How many of each there were at some time.
#[derive(Default)]
pub(crate) struct Mark {
    edges: usize,
    out: usize,
    stops: usize,
}

impl Edges {
    pub fn add(&mut self, from: usize, to: usize) {
        let edge = (from as u32, to as u32);
        if self.list.last() != Some(&edge) {
            self.list.push(edge);
        }
    }

    pub fn lead_out(&mut self, from: usize) {
        if self.out.last() != Some(&(from as u32)) {
            self.out.push(from as u32);
        }
    }

    pub fn lead_to_stop(&mut self, from: usize) {
        if self.stops.last() != Some(&(from as u32)) {
            self.stops.push(from as u32);
        }
    }

    pub fn mark(&self) -> Mark {
        Mark { edges: self.list.len(), out: self.out.len(), stops: self.stops.len() }
    }

    pub fn forget_after(&mut self, mark: &Mark) {
        self.list.truncate(mark.edges);
        self.out.truncate(mark.out);
        self.stops.truncate(mark.stops);
    }

    /// Bytes of memory that they take, and that sorting them will take.
    pub fn size(&self) -> usize {
        BYTES_OF_EDGE * self.list.capacity()
    }
}

/// For how long, and with how much memory beside that of the search, it is checked what is possible.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Allowance {
    pub until: Option<Instant>,
    /// Bytes.
    pub memory: usize,
}

/// The allowance did not suffice.
#[derive(Debug)]
pub(crate) struct UsedUp;

impl Allowance {
    pub fn check(&self, memory: usize) -> Result<(), UsedUp> {
        let is_late = self.until.is_some_and(|until| Instant::now() > until);
        if is_late || memory > self.memory { Err(UsedUp) } else { Ok(()) }
    }
}

/// What is to be possible, from every state that was reached, if nothing fails any more.
pub(crate) struct Possible<'a> {
    pub(crate) store: &'a Reached,
    /// Those of the store that are asked about.
    pub(crate) states: usize,
    edges: &'a Edges,
    pub(crate) expander: Expander<'a>,
    pub(crate) allowance: Allowance,
    /// If answers are postponed: states that can for sure only if the other one can too.
    pub(crate) bound: Option<Vec<(u32, u32)>>,
}

/// Why it is not decided.
#[derive(Debug)]
pub(crate) enum Open {
    /// The allowance did not suffice.
    UsedUp,
    /// States are left out.
    Postponed,
}

/// So it cannot be shown that the orders can be made.
pub(crate) struct AnswersArePostponed;

impl From<UsedUp> for Open {
    fn from(UsedUp: UsedUp) -> Self {
        Self::UsedUp
    }
}

impl<'a> Possible<'a> {
    /// `calm`: the model without faults. The first `states` of the store, from which nothing leads to others as long as nothing
    /// fails.
    pub fn new(
        calm: &'a Model,
        store: &'a Reached,
        states: usize,
        edges: &'a Edges,
        values: &Values,
        bounds: &Bounds,
        allowance: Allowance,
    ) -> Self {
        let mut expander = Expander::new(calm, bounds.answers.unwrap_or(usize::MAX), bounds.orders);
        expander.values.clone_from(values);
        expander.cut = Cut::new(allowance.until);
        Self { store, states, edges, expander, allowance, bound: None }
    }

    /// Whether the orders can be made; adds the first state from which they cannot.
    pub fn orders(&mut self, found: &mut Vec<(Violation, usize)>) -> Result<Decided, AnswersArePostponed> {
        let mut decide = || -> Result<Decided, Open> {
            if self.expander.model.hides_items && self.is_never_made_from_the_start()? {
                return Ok(Decided::ItemsAreHidden);
            }
            found.extend(self.never_made()?.map(|state| (Violation::NeverMade, state)));
            Ok(Decided::Yes)
        };
        match decide() {
            Ok(decided) => Ok(decided),
            Err(Open::UsedUp) => Ok(Decided::NotReached),
            Err(Open::Postponed) => Err(AnswersArePostponed),
        }
    }

    /// Whether what is waited for can come; adds of each property the first state in which it cannot any more.
    pub fn obligations(&mut self, found: &mut Vec<(Violation, usize)>) -> Decided {
        if self.expander.model.hides_items {
            return Decided::ItemsAreHidden;
        }
        self.never_followed(found).map_or(Decided::NotReached, |()| Decided::Yes)
    }

    /// The first state from which the orders cannot be made, nor does an operator come who was called because something
    /// has failed. If nothing has failed, none is called for.
    fn never_made(&mut self) -> Result<Option<usize>, Open> {
        let model = self.expander.model;
        if model.orders.is_empty() {
            return Ok(None);
        }
        let can = self.made();
        let calm = self.calm();
        if let Some(state) = self.reach(can.clone(), &calm, Stops::AreNoGoal)? {
            return Ok(Some(state));
        }
        let all = vec![true; self.states];
        self.reach(can, &all, Stops::AreGoals)
    }

    /// Of each state whether all orders are made in it, or an operator has to come.
    fn made(&self) -> Vec<bool> {
        let model = self.expander.model;
        let states = (0..self.states).map(|state| self.store.state(state));
        states.map(|state| model.is_made(&state) || model.any_stands(&state)).collect()
    }

    /// Whether nothing leads to the orders. A stop for an operator does not: it may come of an item that is not known.
    fn is_never_made_from_the_start(&mut self) -> Result<bool, Open> {
        let model = self.expander.model;
        let can = self.made();
        let mut first = vec![false; self.states];
        first[0] = true;
        Ok(!model.orders.is_empty() && self.reach(can, &first, Stops::AreNoGoal)?.is_some())
    }

    fn never_followed(&mut self, found: &mut Vec<(Violation, usize)>) -> Result<(), Open> {
        let model = self.expander.model;
        let ends = |state: &[u8]| !model.orders.is_empty() && model.is_made(state) || model.any_stands(state);
        let all = vec![true; self.states];
        for (instance, program) in model.instances.iter().enumerate() {
            for property in &program.properties {
                let Check::Whenever(whenever) = &property.check else { continue };
                let mut can = Vec::with_capacity(self.states);
                for number in 0..self.states {
                    let state = &self.store.state(number);
                    can.push(!self.expander.is_waiting(state, program, whenever) || ends(state));
                }
                if let Some(state) = self.reach(can, &all, Stops::AreGoals)? {
                    found.push((Violation::NeverFollowed { instance, fault: property.fault }, state));
                }
            }
        }
        Ok(())
    }

    /// States to which the transitions lead from the first one.
    pub(crate) fn calm(&self) -> Vec<bool> {
        let mut calm = vec![false; self.states];
        calm[0] = true;
        spread(&mut calm, self.edges.list.iter().map(|(from, to)| (*to, *from)));
        calm
    }

    /// States in which a command is under way, or something happens at once but that inputs change by themselves, or an operator
    /// has to come. A command that is given again each time it ends leads to the same state.
    pub(crate) fn go_on(&self) -> Vec<bool> {
        let model = self.expander.model;
        let mut counts = vec![true; self.store.length()];
        for input in &model.inputs {
            counts[input.var.at as usize..][..usize::from(input.var.width)].fill(false);
        }
        let differs = |from: u32, to: u32| {
            let [from, to] = [from, to].map(|state| self.store.state(state as usize));
            from.iter().zip(&to).zip(&counts).any(|((before, after), counts)| *counts && before != after)
        };
        let mut go_on: Vec<bool> = (0..self.states)
            .map(|state| self.store.state(state))
            .map(|state| model.any_stands(&state) || model.any_is_under_way(&state))
            .collect();
        for (from, to) in &self.edges.list {
            if !go_on[*from as usize] {
                go_on[*from as usize] = differs(*from, *to);
            }
        }
        go_on
    }

    /// The first of the states `asked` that does not lead to one that can.
    pub(crate) fn reach(
        &mut self,
        mut can: Vec<bool>,
        asked: &[bool],
        stops: Stops,
    ) -> Result<Option<usize>, Open> {
        let Self { store, states, edges, expander, allowance, bound } = self;
        let fails = |can: &[bool]| can.iter().zip(asked).position(|(can, asked)| *asked && !can);
        if let Some(bound) = bound {
            let stops = edges.stops.iter().filter(|_| stops == Stops::AreGoals);
            edges.out.iter().for_each(|state| can[*state as usize] = true);
            let all = spread_bound(&can, stops.copied(), &edges.list, bound, *states);
            return if fails(&all).is_none() { Ok(None) } else { Err(Open::Postponed) };
        }
        edges.out.iter().for_each(|state| can[*state as usize] = true);
        if stops == Stops::AreGoals {
            edges.stops.iter().for_each(|state| can[*state as usize] = true);
        }
        if fails(&can).is_some() && expander.model.reductions != Reductions::Off {
            spread(&mut can, edges.list.iter().copied());
        }
        if fails(&can).is_none() {
            return Ok(None);
        }
        let mut all = Vec::new();
        for state in 0..*states {
            if can[state] || !asked[state] {
                continue;
            }
            allowance.check(BYTES_OF_EDGE * all.capacity())?;
            let mut leads_to_stop = false;
            expander.expand(&store.state(state), u64::MAX, &mut |successor| {
                if successor.guesses > 0 {
                    return;
                }
                leads_to_stop |= matches!(successor.result, Err(Violation::Stop { .. }));
                let to = successor.result.is_ok().then(|| store.find(successor.state)).flatten();
                if let Some(to) = to.filter(|to| *to != state) {
                    all.push((state as u32, to as u32));
                }
            });
            if expander.cut.because().is_some() {
                return Err(UsedUp.into());
            }
            can[state] = leads_to_stop && stops == Stops::AreGoals;
            all.dedup();
        }
        spread(&mut can, all.iter().copied());
        Ok(fails(&can))
    }
}

/// Bytes of memory that an edge takes, and that sorting it takes.
const BYTES_OF_EDGE: usize = 12;

/// Whether a stop for an operator counts as what was wanted.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Stops {
    AreGoals,
    AreNoGoal,
}

/// Whatever leads to a state that can, can too.
fn spread(can: &mut [bool], edges: impl Iterator<Item = (u32, u32)> + Clone) {
    let mut begins = vec![0_u32; can.len() + 1];
    edges.clone().for_each(|(_, to)| begins[to as usize + 1] += 1);
    for state in 0..can.len() {
        begins[state + 1] += begins[state];
    }
    let mut before = vec![0_u32; begins[can.len()] as usize];
    let mut filled = begins.clone();
    for (from, to) in edges {
        let place = &mut filled[to as usize];
        before[*place as usize] = from;
        *place += 1;
    }
    let mut waiting: Vec<usize> = (0..can.len()).filter(|state| can[*state]).collect();
    while let Some(state) = waiting.pop() {
        for from in &before[begins[state] as usize..begins[state + 1] as usize] {
            if !std::mem::replace(&mut can[*from as usize], true) {
                waiting.push(*from as usize);
            }
        }
    }
}

/// The same; a state that is bound to others can only if these can too. `goals`: states that can if they are not bound.
fn spread_bound(
    can: &[bool],
    goals: impl Iterator<Item = u32>,
    edges: &[(u32, u32)],
    bound: &[(u32, u32)],
    states: usize,
) -> Vec<bool> {
    let bound: Vec<(u32, u32)> = bound
        .iter()
        .copied()
        .filter(|(from, to)| (*from as usize) < states && (*to as usize) < states)
        .collect();
    let mut left = vec![0_u32; states];
    bound.iter().for_each(|(from, _)| left[*from as usize] += 1);
    let mut leads = vec![false; states];
    goals.for_each(|state| leads[state as usize] = true);
    let (begins, before) = reversed(edges, states);
    let (bound_begins, bound_before) = reversed(&bound, states);
    let mut all = can.to_vec();
    let mut waiting: Vec<usize> = (0..states).filter(|state| all[*state]).collect();
    waiting.extend((0..states).filter(|state| !all[*state] && leads[*state] && left[*state] == 0));
    waiting.iter().for_each(|state| all[*state] = true);
    while let Some(state) = waiting.pop() {
        let mut reach = |from: usize, leads: bool, left: u32| {
            if leads && left == 0 && !all[from] {
                all[from] = true;
                waiting.push(from);
            }
        };
        for from in &before[begins[state] as usize..begins[state + 1] as usize] {
            let from = *from as usize;
            leads[from] = true;
            reach(from, true, left[from]);
        }
        for from in &bound_before[bound_begins[state] as usize..bound_begins[state + 1] as usize] {
            let from = *from as usize;
            left[from] -= 1;
            reach(from, leads[from], left[from]);
        }
    }
    all
}

/// Of each state where those begin among the second ones that lead to it.
fn reversed(edges: &[(u32, u32)], states: usize) -> (Vec<u32>, Vec<u32>) {
    let mut begins = vec![0_u32; states + 1];
    edges.iter().for_each(|(_, to)| begins[*to as usize + 1] += 1);
    for state in 0..states {
        begins[state + 1] += begins[state];
    }
    let mut before = vec![0_u32; edges.len()];
    let mut filled = begins.clone();
    for (from, to) in edges {
        let place = &mut filled[*to as usize];
        before[*place as usize] = *from;
        *place += 1;
    }
    (begins, before)
}
