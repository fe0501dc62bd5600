//! Answers that nobody needs yet.
//!
//! A vehicle that reports that it is at home while nobody looks may as well report it later: just before somebody does. So a
//! search of sequences with any number of answers in a scan postpones the end of a command after which its machine is where
//! it was, and does nothing more by itself, until a scan reads a value that this end changes. Of all states that differ only in
//! what has ended unseen, the one in which nothing of it has ended counts for the others.

use crate::event::{self, Event, What, machines_of};
use crate::model::{Model, Reductions};
use crate::occurred::Occurred;
use crate::plant::{Machine, Watch};
use crate::program::{Cells, bit, members};
use crate::property::Check;
use crate::stop::{Mark, Stopped};
use crate::successor::{Expander, Orders};
use crate::unread::Needed;
use crate::value::{Values, Var};
use crate::violation::Violation;
use rustc_hash::FxHashMap;

/// An instance that reads what so many machines have postponed counts as one that needs it.
const MOST_ASKED: u32 = 4;

/// What the machines own, as far as their answers may be postponed.
#[derive(Default)]
pub(crate) struct Postponing {
    machines: Vec<Owned>,
    /// What each may do by itself, by its values.
    known: Vec<FxHashMap<Box<[u8]>, usize>>,
    alone: Vec<Alone>,
}

/// The values of a machine.
#[derive(Default)]
struct Owned {
    may_be_postponed: bool,
    vars: Vec<Var>,
    /// Those that others see in the plant, and that an end may change: where it is. Items at its places lie there before and
    /// after it.
    visible: Vec<Var>,
    bytes: Vec<usize>,
    /// Of each byte of a state whether others own it: all bits.
    foreign: Vec<u64>,
}

/// What a machine may do by itself where its values are these, whatever the others do.
#[derive(Clone, Default)]
pub(crate) struct Alone {
    /// The one answer after which it does nothing more by itself.
    pub end: Option<End>,
    /// Answers that change nothing.
    idle: Vec<What>,
    /// One of these gives a command again.
    gives: bool,
    /// What is forgotten and had to be known to find this out.
    needed: Vec<Needed>,
}

#[derive(Clone)]
pub(crate) struct End {
    what: What,
    /// Its values then.
    pub after: Box<[u8]>,
    /// Where values begin that differ.
    watched: Vec<usize>,
    /// The state of its automaton then.
    pub state: usize,
}

/// Whether the answers of this line can be postponed: only where states have to tell nothing else than whether the orders can
/// be made.
pub(crate) fn is_possible(model: &Model, answers: Option<usize>, orders: Orders) -> bool {
    let has_obligations = model.instances.iter().any(|program| {
        program.properties.iter().any(|property| matches!(property.check, Check::Whenever(_)))
    });
    answers.is_none()
        && orders == Orders::One
        && model.reductions == Reductions::All
        && model.instances.len() < 64
        && !model.orders.is_empty()
        && !has_obligations
}

impl Postponing {
    pub fn new(model: &Model) -> Self {
        let machines = (0..model.machines.len()).map(|machine| Owned::new(model, machine)).collect();
        Self { machines, known: vec![FxHashMap::default(); model.machines.len()], alone: Vec::new() }
    }

    pub fn machines(&self) -> impl Iterator<Item = usize> {
        let all = self.machines.iter().enumerate();
        all.filter(|(_, owned)| owned.may_be_postponed).map(|(machine, _)| machine)
    }

    /// The values of a machine in a state.
    pub fn own(&self, machine: usize, state: &[u8]) -> Box<[u8]> {
        self.machines[machine].bytes.iter().map(|at| state[*at]).collect()
    }

    /// The same, in memory that is used again.
    pub fn read_own(&self, machine: usize, state: &[u8], own: &mut Vec<u8>) {
        own.clear();
        own.extend(self.machines[machine].bytes.iter().map(|at| state[*at]));
    }

    /// The state in which a machine has these values.
    pub fn replace(&self, machine: usize, state: &mut [u8], own: &[u8]) {
        for (at, byte) in self.machines[machine].bytes.iter().zip(own) {
            state[*at] = *byte;
        }
    }
}

impl Owned {
    fn new(model: &Model, machine: usize) -> Self {
        let plant = &model.machines[machine];
        let Machine { head, arm, route, lane, desk, .. } = plant;
        let has_strokes = model.cylinders.iter().any(|cylinder| cylinder.machine == machine)
            || model.processes.iter().any(|process| process.machine == machine);
        let may_be_postponed =
            head.is_some() && arm.is_none() && lane.is_none() && desk.is_none() && !has_strokes;
        if !may_be_postponed {
            return Self::default();
        }
        let made: Vec<Var> = model.orders.iter().map(|order| order.made).collect();
        let all = model.variables.iter().map(|variable| variable.var);
        let is_own = |var: &Var| usize::from(model.owners[var.at as usize]) == machine && !made.contains(var);
        let vars: Vec<Var> = all.filter(is_own).collect();
        let visible = route.iter().flat_map(|route| [route.at, route.goal]).collect();
        let begins = |var: &Var| var.at as usize..var.at as usize + usize::from(var.width);
        let bytes: Vec<usize> = vars.iter().flat_map(begins).collect();
        let mut foreign = vec![u64::MAX; model.initial.len()];
        bytes.iter().for_each(|at| foreign[*at] = 0);
        Self { may_be_postponed, vars, visible, bytes, foreign }
    }
}

/// What is postponed in the state that is expanded.
#[derive(Default)]
pub(crate) struct Postponed {
    /// Machines whose command may have ended unseen.
    pub waiting: u64,
    /// Machines of which answers that change nothing are left out.
    pub idle: u64,
    /// Those of them that would give a command again.
    giving: u64,
    /// What they may do, by the number of the machine.
    alone: Vec<usize>,
    /// Of each byte of a state the machines, as bits, whose postponed answers would change the value that begins there;
    /// empty if no answer is postponed.
    pub watched: Vec<u64>,
    /// Those of them that somebody needs.
    pub observed: u64,
    /// Those that were needed a moment ago: their answers are added.
    pub fresh: u64,
}

impl Postponed {
    /// The end of a machine's command that is postponed.
    #[inline]
    pub fn end<'a>(&self, postponing: &'a Postponing, machine: usize) -> Option<&'a End> {
        if self.waiting == 0 || self.waiting & bit(machine) == 0 {
            return None;
        }
        postponing.alone[self.alone[machine]].end.as_ref()
    }
}

impl Expander<'_> {
    /// What a machine may do by itself in this state.
    pub(crate) fn alone(&mut self, machine: usize, state: &[u8]) -> usize {
        let mut own = std::mem::take(&mut self.own);
        self.postponing.read_own(machine, state, &mut own);
        let known = self.postponing.known[machine].get(own.as_slice());
        self.own = own;
        if let Some(known) = known {
            self.needed.extend_from_slice(&self.postponing.alone[*known].needed);
            return *known;
        }
        self.before.copy_from_slice(state);
        self.forgotten = self.model.unread.in_state(&self.model.instances, state, u64::MAX);
        self.forgotten_before = self.forgotten;
        let needed = std::mem::take(&mut self.needed);
        let count = self.values.count();
        let mut alone = self.find_alone(machine, state);
        let has_new_values = self.values.count() != count;
        if has_new_values {
            alone = self.find_alone(machine, state);
        }
        alone.needed = std::mem::replace(&mut self.needed, needed);
        self.needed.extend_from_slice(&alone.needed);
        let number = self.postponing.alone.len();
        self.postponing.alone.push(alone);
        // New values may be given other numbers later.
        if !has_new_values {
            let own = self.postponing.own(machine, state);
            self.postponing.known[machine].insert(own, number);
        }
        number
    }

    pub(crate) fn end_of(&mut self, machine: usize, state: &[u8]) -> Option<&End> {
        let number = self.alone(machine, state);
        self.postponing.alone[number].end.as_ref()
    }

    fn find_alone(&mut self, machine: usize, state: &[u8]) -> Alone {
        let mut alone = Alone::default();
        let (mut events, mut times) = (Vec::new(), Vec::new());
        event::events(self.model, &self.values, state, 2 * machine + 1, &mut times);
        // A time may come before the same scan, or instead.
        if !times.is_empty() {
            return alone;
        }
        event::events(self.model, &self.values, state, 2 * machine, &mut events);
        // Of those that are no faults.
        let mut changing = 0;
        for event in events {
            let is_fault = event::is_fault(self.model, &self.values, state, &event);
            let gives = self.tries(machine, state, event);
            match gives.filter(|_| self.work == state) {
                Some(gives) => {
                    alone.idle.push(event.what);
                    alone.gives |= gives;
                }
                None if !is_fault => {
                    changing += 1;
                    alone.end = gives.and_then(|_| self.end_in_work(machine, state, event));
                }
                None => {}
            }
        }
        alone.end = alone.end.filter(|_| changing == 1);
        alone
    }

    /// The step of a machine alone after an event of its own, with nothing read of others; whether it gives a command.
    fn tries(&mut self, machine: usize, state: &[u8], event: Event) -> Option<bool> {
        self.choices.clear();
        self.work.copy_from_slice(state);
        event::apply(self.model, &mut self.values, &mut self.work, event);
        let count = self.values.count();
        let foreign = std::mem::take(&mut self.postponing.machines[machine].foreign);
        let watched = std::mem::replace(&mut self.postponed.watched, foreign);
        let (noted, remarked) = (self.noted.len(), self.remarked.len());
        let fresh = Occurred { is_noted: true, ..Occurred::new(self.model) };
        let occurred = std::mem::replace(&mut self.occurred, fresh);
        let mut scan = self.begin();
        let result = scan.run_alone(machine);
        let (observed, given) = (scan.observed, scan.given);
        let occurred_alone = std::mem::replace(&mut self.occurred, occurred);
        let says_more = self.noted.len() > noted || self.remarked.len() > remarked;
        self.noted.truncate(noted);
        self.remarked.truncate(remarked);
        self.postponing.machines[machine].foreign = std::mem::replace(&mut self.postponed.watched, watched);
        let is_quiet = result.is_ok()
            && observed == 0
            && self.choices.is_empty()
            && !says_more
            && self.values.count() == count;
        if is_quiet {
            self.occurred.add(&occurred_alone);
        }
        let foreign = &self.postponing.machines[machine].foreign;
        let stays_within = (0..state.len()).all(|at| foreign[at] == 0 || self.work[at] == state[at]);
        (is_quiet && stays_within).then_some(given != 0)
    }

    fn end_in_work(&mut self, machine: usize, state: &[u8], event: Event) -> Option<End> {
        let Self { model, values, work, postponing, .. } = self;
        let owned = &postponing.machines[machine];
        let differs = |var: &Var| var.load(work) != var.load(state);
        // Where a vehicle is of which it is forgotten where it has set out, nobody sees.
        let is_forgotten = |var: &Var| {
            model.unread.starts.iter().any(|start| start.at == *var) && var.load(state) == Values::NOWHERE
        };
        if owned.visible.iter().any(|var| differs(var) && !is_forgotten(var)) {
            return None;
        }
        let mut events = Vec::new();
        for source in [2 * machine, 2 * machine + 1] {
            event::events(model, values, work, source, &mut events);
        }
        if !events.is_empty() {
            return None;
        }
        let mut watched: Vec<usize> =
            owned.vars.iter().filter(|var| differs(var)).map(|var| var.at as usize).collect();
        let forgotten = |state: &[u8]| model.unread.in_state(&model.instances, state, bit(machine));
        let differ = forgotten(state) ^ forgotten(work);
        watched.extend(model.unread.of(differ).map(|cell| cell.var.at as usize));
        let state = model.instances[machine].state.load(work) as usize;
        Some(End { what: event.what, after: postponing.own(machine, work), watched, state })
    }

    /// Begins to postpone the answers of `among` in this state. `restless`: instances that do something anyway.
    pub(crate) fn postpone(&mut self, state: &[u8], restless: u64, among: u64) {
        let machines: Vec<usize> = self.postponing.machines().collect();
        let (mut waiting, mut idle, mut giving) = (0, 0, 0);
        self.postponed.alone.resize(self.model.machines.len(), 0);
        for machine in machines.into_iter().filter(|machine| restless & bit(*machine) == 0) {
            let number = self.alone(machine, state);
            self.postponed.alone[machine] = number;
            let alone = &self.postponing.alone[number];
            if alone.end.is_some() && among & bit(machine) != 0 {
                waiting |= bit(machine);
            }
            if !alone.idle.is_empty() {
                idle |= bit(machine);
                giving |= if alone.gives { bit(machine) } else { 0 };
            }
        }
        self.postponed.waiting = waiting;
        self.postponed.idle = idle;
        self.postponed.giving = giving;
        self.postponed.watched.clear();
        self.postponed.watched.resize(state.len(), 0);
        for machine in members(waiting) {
            if let Some(end) = &self.postponing.alone[self.postponed.alone[machine]].end {
                end.watched.iter().for_each(|at| self.postponed.watched[*at] |= bit(machine));
            }
        }
        self.postponed.observed = 0;
        let woken = self.woken(state, restless);
        self.no_longer(woken);
        self.postponed.observed = 0;
    }

    /// Nothing of these is postponed any more.
    pub(crate) fn no_longer(&mut self, machines: u64) {
        self.postponed.waiting &= !machines;
        self.postponed.idle &= !machines;
    }

    pub(crate) fn end_postponing(&mut self) -> u64 {
        self.postponed.watched.clear();
        self.postponed.idle = 0;
        std::mem::take(&mut self.postponed.waiting)
    }

    /// Whether an event is left out for now.
    pub(crate) fn can_wait(&self, event: Event) -> bool {
        if event.machine >= 64 || (self.postponed.waiting | self.postponed.idle) & bit(event.machine) == 0 {
            return false;
        }
        let alone = &self.postponing.alone[self.postponed.alone[event.machine]];
        self.postponed.waiting & bit(event.machine) != 0
            && alone.end.as_ref().is_some_and(|end| end.what == event.what)
            || self.postponed.idle & bit(event.machine) != 0 && alone.idle.contains(&event.what)
    }

    /// Machines whose end would make somebody do something who is at rest.
    fn woken(&mut self, state: &[u8], restless: u64) -> u64 {
        let waiting = self.postponed.waiting;
        let mut woken = 0;
        if waiting == 0 {
            return 0;
        }
        for instance in 0..self.model.instances.len() {
            let own = waiting & bit(instance);
            let reads = {
                let program = &self.model.instances[instance];
                program.states[program.state.load(state) as usize].reads
            };
            if restless & bit(instance) != 0
                || self.model.stands(state, instance)
                || own == 0 && reads.owners & waiting == 0
            {
                continue;
            }
            let mut asked = 0;
            loop {
                let Some(reads) = self.would_stay(state, self.forgotten, instance, own, asked) else {
                    woken |= asked | own;
                    break;
                };
                if reads == 0 {
                    break;
                }
                asked |= reads;
                if asked.count_ones() > MOST_ASKED {
                    woken |= asked | own;
                    break;
                }
            }
        }
        woken
    }

    /// Whether an instance does nothing, whichever of these have ended: of which others it reads what is postponed.
    /// `known_not`: what is forgotten in the state.
    fn would_stay(
        &mut self,
        state: &[u8],
        known_not: u128,
        instance: usize,
        own: u64,
        asked: u64,
    ) -> Option<u64> {
        let mut others = 0;
        let mut ended = asked;
        let forgotten = self.forgotten;
        let stays = loop {
            self.work.copy_from_slice(state);
            for machine in members(ended | own) {
                let number = self.postponed.alone[machine];
                if let Some(end) = &self.postponing.alone[number].end {
                    self.postponing.replace(machine, &mut self.work, &end.after);
                }
            }
            let Model { unread, instances, .. } = self.model;
            let of_others = known_not & !unread.owned(ended | own);
            self.forgotten = of_others | unread.in_state(instances, &self.work, ended | own);
            self.choices.clear();
            let mut scan = self.begin();
            let result = scan.step_if_due(instance, u64::MAX);
            let (observed, fired) = (scan.observed, scan.fired);
            if result.is_err() || fired != 0 || !self.choices.is_empty() {
                break false;
            }
            others |= observed & self.postponed.waiting & !asked & !own;
            if ended == 0 {
                break true;
            }
            ended = (ended - 1) & asked;
        };
        self.forgotten = forgotten;
        stays.then_some(others)
    }

    /// After a scan of which the result is worked on: who needs what is postponed of machines that have done nothing in it. An
    /// item that comes to lie at one of their places changes nothing of that.
    pub(crate) fn observe(&mut self, observed: u64, changed: u64) {
        let others = (self.postponed.waiting | self.postponed.idle) & !machines_of(&self.chosen);
        self.postponed.observed |= (observed | changed) & others;
    }

    /// After a scan without a command of which the result is worked on: with one, it would have been asked what is dangerous.
    pub(crate) fn observe_hazards(&mut self) {
        let giving = self.postponed.idle & self.postponed.giving & !machines_of(&self.chosen);
        if giving != 0 && self.model.watch == Watch::Everything && self.begin().hazards().is_err() {
            self.postponed.observed |= giving;
        }
    }

    /// After a stop, behind which this was found in scans that have read this: of which machines it would be another thing if
    /// their commands had ended.
    pub(crate) fn observed_behind(&mut self, stopped: &Stopped, found: &Option<Violation>, read: u64) -> u64 {
        let waiting = self.postponed.waiting;
        if waiting == 0 {
            return 0;
        }
        let mut observed = 0;
        let choices = std::mem::take(&mut self.choices);
        let acting = |machine: &usize| {
            self.would_stay(&stopped.state, stopped.mark.forgotten, *machine, bit(*machine), 0) != Some(0)
        };
        let acting: Vec<usize> = members(waiting).filter(acting).collect();
        let mut asked = acting.into_iter().fold(read & waiting, |asked, machine| asked | bit(machine));
        let mut ended = asked;
        while ended != 0 {
            let mut state = stopped.state.clone();
            for machine in members(ended) {
                if let Some(end) = self.postponed.end(&self.postponing, machine) {
                    self.postponing.replace(machine, &mut state, &end.after);
                }
            }
            let forgotten = self.model.unread.in_state(&self.model.instances, &state, u64::MAX);
            let Mark { written, .. } = stopped.mark;
            let written = written | Cells { owners: ended, columns: u64::MAX };
            let mark = Mark { forgotten, written };
            let (other, read) = self.behind_stop(&Stopped { state, mark });
            let more = read & waiting & !asked;
            if other != *found || (asked | more).count_ones() > MOST_ASKED {
                observed = asked | more;
                break;
            }
            asked |= more;
            ended = if more == 0 { (ended - 1) & asked } else { asked };
        }
        self.choices = choices;
        observed
    }
}
