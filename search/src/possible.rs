//! Whether the orders can always still be made, and what is waited for can always still come: from every state that was
//! reached there is a way to one in which it is so.

use crate::property::Check;
use crate::store::Store;
use crate::successor::Expander;
use crate::violation::Violation;

/// Ways on by which at most one device did something. If they lead to the orders, these can be made; if they do not, all
/// ways are checked.
#[derive(Default)]
pub(crate) struct Edges {
    list: Vec<(u32, u32)>,
    /// States from which something leads to a violation: what could come after it is not known.
    out: Vec<u32>,
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

    /// Bytes of memory that they take, and that sorting them will take.
    pub fn size(&self) -> usize {
        12 * self.list.capacity()
    }
}

/// The first state from which the orders cannot be made, if there is one.
pub(crate) fn never_made(store: &Store, edges: &Edges, expander: &mut Expander) -> Option<usize> {
    let model = expander.model;
    if model.orders.is_empty() {
        return None;
    }
    let is_there = |state: &[u8]| model.is_made(state) || model.any_stands(state);
    let can: Vec<bool> = (0..store.len()).map(|state| is_there(store.state(state))).collect();
    reach(can, store, edges, expander)
}

/// Of each property the first state in which its goal is waited for and cannot come any more, if there is one.
pub(crate) fn never_followed(
    store: &Store,
    edges: &Edges,
    expander: &mut Expander,
) -> Vec<(Violation, usize)> {
    let model = expander.model;
    let ends = |state: &[u8]| !model.orders.is_empty() && model.is_made(state) || model.any_stands(state);
    let mut found = Vec::new();
    for (instance, program) in model.instances.iter().enumerate() {
        for property in &program.properties {
            let Check::Whenever(whenever) = &property.check else { continue };
            let mut can = Vec::with_capacity(store.len());
            for number in 0..store.len() {
                let state = store.state(number);
                can.push(!expander.is_waiting(state, program, whenever) || ends(state));
            }
            if let Some(state) = reach(can, store, edges, expander) {
                found.push((Violation::NeverFollowed { instance, fault: property.fault }, state));
            }
        }
    }
    found
}

/// The first state that does not lead to one of these.
fn reach(mut can: Vec<bool>, store: &Store, edges: &Edges, expander: &mut Expander) -> Option<usize> {
    if can.iter().all(|can| *can) {
        return None;
    }
    edges.out.iter().for_each(|state| can[*state as usize] = true);
    spread(&mut can, &edges.list);
    if can.iter().all(|can| *can) {
        return None;
    }
    let mut all = Vec::new();
    for state in (0..store.len()).filter(|state| !can[*state]) {
        expander.expand(store.state(state), u64::MAX, &mut |successor| {
            let to = successor.result.is_ok().then(|| store.find(successor.state)).flatten();
            if let Some(to) = to.filter(|to| *to != state) {
                all.push((state as u32, to as u32));
            }
        });
        all.dedup();
    }
    spread(&mut can, &all);
    can.iter().position(|can| !can)
}

/// Whatever leads to a state that can, can too.
fn spread(can: &mut [bool], edges: &[(u32, u32)]) {
    let mut begins = vec![0_u32; can.len() + 1];
    edges.iter().for_each(|(_, to)| begins[*to as usize + 1] += 1);
    for state in 0..can.len() {
        begins[state + 1] += begins[state];
    }
    let mut before = vec![0_u32; edges.len()];
    let mut filled = begins.clone();
    for (from, to) in edges {
        let place = &mut filled[*to as usize];
        before[*place as usize] = *from;
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
