//! Who waits for whom.

use super::{Await, Machine, Picture};
use petgraph::algo::tarjan_scc;
use petgraph::graph::{DiGraph, NodeIndex};

/// The graph of a picture: an edge to each machine that could change what a guard fails on.
pub struct Waits<'p> {
    picture: &'p Picture,
    /// Nothing has happened for long: no device answers any more.
    is_stalled: bool,
}

impl<'p> Waits<'p> {
    pub fn new(picture: &'p Picture, is_stalled: bool) -> Self {
        Self { picture, is_stalled }
    }

    fn machine(&self, machine: usize) -> &'p Machine {
        &self.picture.machines[machine]
    }

    /// It continues without the others: a guard holds, nothing but time has to pass, or its device is at work.
    fn goes_on(&self, machine: usize) -> bool {
        let Machine { transitions, awaits, .. } = self.machine(machine);
        transitions.iter().any(|transition| transition.holds)
            || awaits.iter().any(|awaited| match awaited {
                Await::Time { suffices, .. } => *suffices,
                Await::Command { .. } => !self.is_stalled,
                Await::Machine(..) | Await::Input(_) | Await::Own(_) => false,
            })
    }

    /// Its device could bring it on.
    fn has_device(&self, machine: usize) -> bool {
        let mut awaits = self.machine(machine).awaits.iter();
        awaits.any(|awaited| matches!(awaited, Await::Input(_) | Await::Command { .. }))
    }

    /// The machines that it waits for, with what was read; none if it continues by itself.
    fn next(&self, machine: usize) -> Vec<(usize, &'p Await)> {
        if self.goes_on(machine) {
            return Vec::new();
        }
        let awaits = self.machine(machine).awaits.iter();
        awaits
            .filter_map(|awaited| match awaited {
                Await::Machine(other, _) => Some((*other, awaited)),
                _ => None,
            })
            .collect()
    }

    /// All machines, those first for which nobody waits, so that chains are told from their beginnings.
    pub fn beginnings(&self) -> Vec<usize> {
        let count = self.picture.machines.len();
        let mut is_awaited = vec![false; count];
        for (other, _) in (0..count).flat_map(|machine| self.next(machine)) {
            is_awaited[other] = true;
        }
        let mut machines: Vec<usize> = (0..count).collect();
        machines.sort_by_key(|machine| is_awaited[*machine]);
        machines
    }

    /// The deadlocks: machines that wait for each other, and nothing else can bring one of them on.
    pub fn circles(&self) -> Vec<Vec<usize>> {
        let mut graph = DiGraph::<(), ()>::new();
        let count = self.picture.machines.len();
        for _ in 0..count {
            graph.add_node(());
        }
        let dead = self.dead();
        for machine in (0..count).filter(|machine| dead[*machine]) {
            for (other, _) in self.next(machine) {
                graph.update_edge(NodeIndex::new(machine), NodeIndex::new(other), ());
            }
        }
        let components = tarjan_scc(&graph).into_iter().filter(|component| component.len() > 1);
        let mut circles: Vec<Vec<usize>> = components
            .map(|component| self.shortest(&component.iter().map(|node| node.index()).collect::<Vec<_>>()))
            .collect();
        circles.sort();
        circles
    }

    /// The machines that nothing can bring on any more.
    fn dead(&self) -> Vec<bool> {
        let count = self.picture.machines.len();
        let mut dead: Vec<bool> = (0..count).map(|m| !self.goes_on(m) && !self.has_device(m)).collect();
        loop {
            let alive = (0..count).find(|m| dead[*m] && self.next(*m).iter().any(|(other, _)| !dead[*other]));
            match alive {
                Some(machine) => dead[machine] = false,
                None => return dead,
            }
        }
    }

    /// The shortest circle among machines that all lead to each other, from its first machine.
    fn shortest(&self, members: &[usize]) -> Vec<usize> {
        let circles = members.iter().filter_map(|start| {
            let mut paths = vec![vec![*start]];
            let mut seen = vec![*start];
            for at in 0.. {
                let path = paths.get(at)?.clone();
                for (next, _) in self.next(path[path.len() - 1]) {
                    if next == *start {
                        return Some(path);
                    }
                    if members.contains(&next) && !seen.contains(&next) {
                        seen.push(next);
                        paths.push([&path[..], &[next]].concat());
                    }
                }
            }
            None
        });
        circles.min_by(|a, b| (a.len(), a).cmp(&(b.len(), b))).unwrap_or_default()
    }

    /// The shortest way from a machine to one that waits for no other, else into a circle and once round it: each
    /// machine with what it waits for in the next one.
    pub fn chain(&self, machine: usize) -> Vec<(usize, Option<&'p Await>)> {
        let mut paths = vec![vec![(machine, None)]];
        let mut seen = vec![machine];
        let mut at = 0;
        while let Some(path) = paths.get(at).cloned() {
            let next = self.next(path[path.len() - 1].0);
            if next.is_empty() {
                return path;
            }
            for (other, awaited) in next {
                if !seen.contains(&other) {
                    seen.push(other);
                    let mut longer = path.clone();
                    if let Some(last) = longer.last_mut() {
                        last.1 = Some(awaited);
                    }
                    longer.push((other, None));
                    paths.push(longer);
                }
            }
            at += 1;
        }
        self.round(machine)
    }

    fn round(&self, machine: usize) -> Vec<(usize, Option<&'p Await>)> {
        let mut chain: Vec<(usize, Option<&Await>)> = Vec::new();
        let mut at = machine;
        while let Some((other, awaited)) = self.next(at).first().copied() {
            if chain.iter().any(|(before, _)| *before == at) {
                break;
            }
            chain.push((at, Some(awaited)));
            at = other;
        }
        chain.push((at, None));
        chain
    }
}
