//! Through all states: first those that are reached without a fault, then those behind one scan with faults, and so on; each
//! time breadth first. So what is found has as few faults as possible, and is the shortest with so few; and a search that is
//! cut has checked all that happens with up to so many.

mod allowance;
mod arrival;
mod outcome;

use outcome::{Again, Certain};
pub use outcome::{Bounds, Covered, Decided, End, Outcome};

use crate::cut::{Because, Cut};
use crate::event::Event;
use crate::expanded::{self, Expanded, Step};
use crate::model::Model;
use crate::occurred::Occurred;
use crate::plant::Faults;
use crate::possible::{Allowance, AnswersArePostponed, Edges, Mark, Possible};
use crate::postponed::{Postponing, is_possible};
use crate::reached::Reached;
use crate::refinement::{self, Random, Refinement};
use crate::representative::{LEFT_OUT, Representatives};
use crate::story::{self, Execution};
use crate::successor::{Expander, Part};
use crate::unread::Needed;
use crate::violation::Violation;
use std::collections::{BTreeSet, HashSet};
use std::mem::discriminant;
use std::ops::Range;
use std::sync::Arc;
use std::time::{Duration, Instant};

/// States are expanded for so long before what was found is put together.
const BATCH: Duration = Duration::from_millis(50);
/// Bounds of the number of states that are expanded in that time.
const LEAST: usize = 32;
const MOST: usize = 1 << 16;

/// The states that hold all sequences with so many faults, and what leads from one to another.
#[derive(Default)]
struct Checked {
    states: usize,
    edges: Mark,
}

struct Found {
    violation: Violation,
    /// The state before, and what devices did then.
    from: usize,
    events: Vec<Event>,
}

impl Found {
    fn told(self, store: &Reached, expander: &mut Expander) -> (Violation, Execution) {
        let execution = story::to_violation(store, expander, self.from, &self.violation, &self.events);
        (self.violation, execution)
    }
}

/// A search under way.
struct Search<'a> {
    bounds: &'a Bounds,
    begin: Instant,
    watch: &'a mut dyn FnMut(&Covered) -> bool,
    /// It gives the numbers to places and reals, in the order of the states.
    first: Expander<'a>,
    /// One for each processor.
    expanders: Vec<Expander<'a>>,
    /// States that are expanded before what was found is put together: without faults, and with faults.
    batches: [usize; 2],
    spare: Vec<Expanded>,
    store: Reached,
    /// Of each state: instances that may do something even if no device does.
    restless: Vec<u64>,
    edges: Edges,
    /// If answers are postponed.
    representatives: Option<Representatives>,
    /// States with which devices fail once more in this round.
    late: Vec<usize>,
    /// Where this round began.
    round: usize,
    found: Vec<Found>,
    known: HashSet<Violation>,
    /// Of each kind the first.
    remarked: Vec<Found>,
    /// Instances with states that they have where a scan ends in a stop or a violation.
    entered: BTreeSet<(usize, usize)>,
    /// What is forgotten and has to be known, and the states where that turned out.
    needed: Vec<(Needed, usize)>,
    /// How many violations were found before that.
    certain: usize,
    /// Bytes that are kept to be used again.
    again: usize,
    cut: Arc<Cut>,
    covered: Covered,
}

impl<'a> Search<'a> {
    fn new(
        model: &'a Model,
        bounds: &'a Bounds,
        begin: Instant,
        postpones: bool,
        watch: &'a mut dyn FnMut(&Covered) -> bool,
    ) -> Self {
        let cut = Cut::new(until(bounds, begin));
        cut.allow(bounds.memory / bounds.jobs.max(1));
        let expander = || {
            let mut expander = Expander::new(model, bounds.answers.unwrap_or(usize::MAX), bounds.orders);
            if postpones {
                expander.postponing = Postponing::new(model);
            }
            expander.cut = cut.clone();
            expander
        };
        let mut store = Reached::new(model.initial.len());
        store.add(&model.initial, 0);
        Self {
            bounds,
            begin,
            watch,
            first: expander(),
            expanders: (0..bounds.jobs.max(1)).map(|_| expander()).collect(),
            batches: [LEAST; 2],
            spare: Vec::new(),
            store,
            restless: vec![u64::MAX],
            edges: Edges::default(),
            representatives: postpones.then(|| Representatives::new(model.machines.len())),
            late: Vec::new(),
            round: 0,
            found: Vec::new(),
            known: HashSet::new(),
            remarked: Vec::new(),
            entered: BTreeSet::new(),
            needed: Vec::new(),
            certain: 0,
            again: 0,
            cut,
            covered: Covered::default(),
        }
    }

    /// Why it has to end, if it is not complete; and how many states, with which edges, hold all sequences of
    /// [`Covered::failing`].
    fn search(&mut self, faults: Faults) -> (Option<End>, Checked) {
        let mut complete = Checked::default();
        // Of each depth the states that devices fail in the fewest scans to reach, and those with one less.
        let (mut level, mut last): (Vec<_>, Vec<_>) = (std::iter::once(0..1).collect(), Vec::new());
        loop {
            let mut depth = 0;
            self.round = self.store.len();
            while depth < level.len().max(last.len()) || !self.late.is_empty() {
                let next = self.store.len();
                self.covered.depth = self.covered.depth.max(depth);
                self.leave_out(level.get(depth).cloned().unwrap_or_default());
                for (part, states) in [(Part::Calm, &level), (Part::Failing, &last)] {
                    let states: Option<Range<usize>> = states.get(depth).cloned();
                    if let Some(end) = states.and_then(|states| self.expand(part, states)) {
                        return (Some(end), complete);
                    }
                }
                if depth >= level.len().max(last.len()) {
                    level.resize(depth + 1, next..next);
                    for state in std::mem::take(&mut self.late) {
                        if let Some(end) = self.expand(Part::Failing, state..state + 1) {
                            return (Some(end), complete);
                        }
                    }
                }
                while let Some(state) = self.representatives.as_mut().and_then(|all| all.resumed.pop()) {
                    if let Some(end) = self.expand(Part::Calm, state..state + 1) {
                        return (Some(end), complete);
                    }
                    if state < self.round {
                        self.late.push(state);
                    }
                }
                depth += 1;
                if level.len() == depth && (next < self.store.len() || depth < last.len()) {
                    level.push(next..self.store.len());
                }
            }
            complete = Checked { states: self.store.len(), edges: self.edges.mark() };
            self.covered.failing = Some(self.covered.failing.map_or(0, |failing| failing + 1));
            if faults == Faults::None || level.iter().all(Range::is_empty) {
                return (None, complete);
            }
            // A first scan comes before any fault.
            last = std::mem::take(&mut level);
            level.push(0..0);
        }
    }

    /// Expands some states, in batches; why it has to end, if it has to.
    fn expand(&mut self, part: Part, states: Range<usize>) -> Option<End> {
        let mut next = states.start;
        while next < states.end {
            let batch_begins = Instant::now();
            let size = *self.batch(part);
            let batch = next..states.end.min(next + size);
            let is_full = batch.len() == size;
            let spare = std::mem::take(&mut self.spare);
            let Self { expanders, store, restless, representatives, .. } = self;
            let postponed = representatives.as_ref().map(|all| all.postponed.as_slice());
            let runs = expanded::expand(expanders, part, store, restless, postponed, batch, spare);
            if let Some(end) = self.is_cut() {
                return Some(end);
            }
            for run in &runs {
                let mut numbers = Vec::new();
                for (state, after) in run.states.iter().enumerate() {
                    if after.has_new_values {
                        // The numbers that it was given are of no use to others.
                        let mut again = Expanded::new(next, self.store.length());
                        let postponed = self.representatives.as_ref().map(|all| all.postponed.as_slice());
                        let restless = self.restless[next];
                        again.expand(&mut self.first, part, &self.store, next, restless, postponed);
                        if let Some(end) = self.is_cut() {
                            return Some(end);
                        }
                        self.add(part, &again, 0, &mut Vec::new());
                    } else {
                        self.add(part, run, state, &mut numbers);
                    }
                    next += 1;
                    if self.needed.is_empty() && self.found.len() >= self.bounds.violations {
                        return Some(End::Violated);
                    }
                    if self.first.values.is_full() {
                        return Some(End::TooManyValues);
                    }
                }
            }
            let again = runs.iter().map(Expanded::size).chain(self.all_expanders().map(Expander::size));
            self.again = again.sum();
            self.spare = runs;
            if self.first.values.count() != self.expanders[0].values.count() {
                let values = &self.first.values;
                self.expanders.iter_mut().for_each(|expander| expander.values.clone_from(values));
            }
            self.measure();
            if let Some(end) = self.end() {
                return Some(end);
            }
            let size = self.batch(part);
            match batch_begins.elapsed() {
                time if time < BATCH / 2 && is_full => *size = (*size * 2).min(MOST),
                time if time > BATCH * 2 => *size = (*size / 2).max(LEAST),
                _ => {}
            }
        }
        (!self.needed.is_empty()).then_some(End::Stopped)
    }

    fn batch(&mut self, part: Part) -> &mut usize {
        &mut self.batches[usize::from(part == Part::Failing)]
    }

    /// Takes over what follows a state.
    fn add(&mut self, part: Part, expanded: &Expanded, state: usize, numbers: &mut Vec<(usize, u64)>) {
        let from = expanded.first + state;
        let after = expanded.states[state];
        self.covered.transitions += after.transitions;
        self.covered.stops += after.stops;
        if after.postponed == LEFT_OUT {
            return;
        }
        self.note_expanded(from, after.postponed);
        for step in expanded.steps(state) {
            match step {
                Step::Known { state, acting, is_plain } => {
                    self.reach(part, from, after.postponed & !acting, (*state as usize, 0), *is_plain)
                }
                Step::Unknown { number, acting, is_plain } => {
                    let (number, mask) = (*number as usize, after.postponed & !acting);
                    if numbers.len() <= number {
                        numbers.resize(number + 1, (usize::MAX, 0));
                    }
                    if !self.still_counts(numbers[number]) {
                        let restless = expanded.restless[number];
                        numbers[number] = {
                            let (state, code) = expanded.unknown(number);
                            let coded = self.store.complete(state, code.to_vec());
                            self.arrive(from, mask, coded, restless)
                        };
                    }
                    self.reach(part, from, mask, numbers[number], *is_plain);
                }
                // Not from states for which this one counts, if these machines have done something else there.
                Step::Out { acting } if acting & after.postponed != 0 => {}
                Step::Out { .. } => self.edges.lead_out(from),
                Step::Stop => self.edges.lead_to_stop(from),
                Step::Found(found) => self.find(from, found),
                Step::Needs(needed) => {
                    if self.needed.is_empty() {
                        self.certain = self.found.len();
                    }
                    self.needed.push((*needed, from));
                }
                Step::Remarked(found) => self.remark(from, found),
                Step::Entered { instance, state } => {
                    self.entered.insert((*instance, *state));
                }
            }
        }
    }

    fn lead(&mut self, from: usize, to: usize, is_plain: bool) {
        if is_plain && from != to {
            self.edges.add(from, to);
        }
    }

    fn find(&mut self, from: usize, (violation, events): &(Violation, Vec<Event>)) {
        if self.found.len() < self.bounds.violations && self.known.insert(violation.clone()) {
            self.found.push(Found { violation: violation.clone(), from, events: events.clone() });
        }
    }

    fn remark(&mut self, from: usize, (remark, events): &(Violation, Vec<Event>)) {
        let is_known = |known: &Found| discriminant(&known.violation) == discriminant(remark);
        if !self.remarked.iter().any(is_known) {
            self.remarked.push(Found { violation: remark.clone(), from, events: events.clone() });
        }
    }

    /// The first execution to everything of its kind that has to be known.
    fn refinements(&mut self) -> Vec<Refinement> {
        let Self { needed, store, first, .. } = self;
        let mut found = HashSet::new();
        needed.retain(|(needed, _)| found.insert(first.model.unread.like(*needed)));
        needed.iter().map(|(needed, state)| Refinement::new(*needed, store, first, *state)).collect()
    }

    fn all_expanders(&self) -> impl Iterator<Item = &Expander<'a>> {
        self.expanders.iter().chain([&self.first])
    }

    fn measure(&mut self) {
        self.covered.time = self.begin.elapsed();
        self.covered.memory = self.store.size()
            + 8 * self.restless.capacity()
            + self.edges.size()
            + self.again
            + self.representatives.as_ref().map_or(0, Representatives::size);
        self.covered.states = self.store.len();
        self.cut.allow(self.bounds.memory.saturating_sub(self.covered.memory) / self.bounds.jobs.max(1));
    }

    /// Not all that follows the states at hand was found: none of it is used.
    fn is_cut(&mut self) -> Option<End> {
        let end = match self.cut.because()? {
            Because::OfTime => End::TimeIsUp,
            Because::OfMemory => End::MemoryIsFull,
        };
        self.measure();
        Some(end)
    }

    /// Why it has to end here, if it has to.
    fn end(&mut self) -> Option<End> {
        if self.bounds.time.is_some_and(|time| self.covered.time > time) {
            Some(End::TimeIsUp)
        } else if self.covered.memory > self.bounds.memory || self.store.is_full() {
            Some(End::MemoryIsFull)
        } else if self.covered.states > self.bounds.states {
            Some(End::TooManyStates)
        } else if !(self.watch)(&self.covered) {
            Some(End::Stopped)
        } else {
            None
        }
    }
}

/// `watch` is told how far it is, some times a second, and says whether to continue. The outcome does not depend on the
/// number of processors, but for where a limit of time or memory cuts it.
pub fn explore(model: &Model, bounds: &Bounds, watch: &mut dyn FnMut(&Covered) -> bool) -> Outcome {
    let begin = Instant::now();
    let mut model = model.clone();
    let mut random = Random::default();
    let mut covered = Covered::default();
    let mut postpones = is_possible(&model, bounds.answers, bounds.orders);
    let mut farthest = Covered::default();
    let (mut earlier, mut certain) = (None, Certain::default());
    loop {
        let states = covered.states;
        refinement::at_random(&mut model, &mut random, states, until(bounds, begin), &mut || {
            goes_on(&mut covered, begin, bounds, watch)
        });
        match attempt(&model, bounds, begin, postpones, watch) {
            Ok(outcome) => return outcome.or_checked(&farthest).or_earlier(earlier, certain),
            Err(again) => {
                if again.covered.failing >= farthest.failing {
                    farthest = again.covered;
                }
                covered = Covered { failing: farthest.failing, ..again.covered };
                certain = certain.or(again.certain);
                if let Some(undecided) = again.undecided {
                    postpones = false;
                    earlier = Some(undecided.or_checked(&farthest));
                }
                refinement::along(&mut model, bounds, &again.refinements, until(bounds, begin), &mut || {
                    goes_on(&mut covered, begin, bounds, watch)
                });
            }
        }
    }
}

/// When the limit of time is reached.
fn until(bounds: &Bounds, begin: Instant) -> Option<Instant> {
    bounds.time.and_then(|time| begin.checked_add(time))
}

/// Whether there is time left, and whoever watches wants more.
fn goes_on(
    covered: &mut Covered,
    begin: Instant,
    bounds: &Bounds,
    watch: &mut dyn FnMut(&Covered) -> bool,
) -> bool {
    covered.time = begin.elapsed();
    bounds.time.is_none_or(|time| covered.time <= time) && watch(covered)
}

/// The search with what is forgotten now.
fn attempt(
    model: &Model,
    bounds: &Bounds,
    begin: Instant,
    postpones: bool,
    watch: &mut dyn FnMut(&Covered) -> bool,
) -> Result<Outcome, Box<Again>> {
    let mut search = Search::new(model, bounds, begin, postpones, watch);
    let (mut cut, checked) = search.search(model.faults);
    if !search.needed.is_empty() {
        search.found.truncate(search.certain);
        cut = search.end();
        if cut.is_none() {
            let refinements = search.refinements();
            let Search { mut first, store, found, covered, .. } = search;
            let violations = found.into_iter().map(|found| found.told(&store, &mut first)).collect();
            let certain = Certain { violations, values: first.values };
            return Err(Box::new(Again { covered, certain, refinements, undecided: None }));
        }
    }
    let end = cut.unwrap_or(End::Complete);
    search.measure();
    let mut occurred = Occurred::new(model);
    search.all_expanders().for_each(|expander| occurred.add(&expander.occurred));
    let Search {
        begin,
        mut first,
        store,
        mut edges,
        mut representatives,
        found,
        remarked,
        mut entered,
        mut covered,
        ..
    } = search;
    let mut violations: Vec<(Violation, Execution)> =
        found.into_iter().map(|found| found.told(&store, &mut first)).collect();
    let number = violations.len();
    let mut remarks = Vec::new();
    let mut is_decided = true;
    let (mut orders, mut obligations) = (Decided::NotReached, Decided::NotReached);
    if end != End::Violated && checked.states > 0 {
        let calm = Model { faults: Faults::None, ..model.clone() };
        edges.forget_after(&checked.edges);
        let left_out = representatives.iter().flat_map(Representatives::left_out);
        left_out
            .filter(|(state, other)| (*state).max(*other) < checked.states)
            .for_each(|(state, other)| edges.add(state, other));
        let allowance = Allowance::after(end, &covered, bounds);
        let mut possible =
            Possible::new(&calm, &store, checked.states, &edges, &first.values, bounds, allowance);
        let mut never = Vec::new();
        possible.bound = representatives.as_mut().map(|all| std::mem::take(&mut all.bound));
        orders = match possible.orders(&mut never) {
            Ok(orders) => orders,
            Err(AnswersArePostponed) => {
                is_decided = false;
                Decided::NotReached
            }
        };
        if violations.len() + never.len() < bounds.violations {
            obligations = possible.obligations(&mut never);
        }
        for (violation, state) in never {
            violations.push((violation, story::to_state(&store, &mut first, state)));
        }
        violations.truncate(bounds.violations);
        if violations.is_empty() && end == End::Complete {
            let has_all = orders == Decided::Yes && !postpones;
            let of_orders = if has_all { possible.remarks().ok() } else { None };
            for (remark, state) in of_orders.into_iter().flatten() {
                remarks.push((remark, story::to_state(&store, &mut first, state)));
            }
            remarks.extend(remarked.into_iter().map(|found| found.told(&store, &mut first)));
        }
        // All of these scans were searched; if one had not been, nothing could be concluded.
        if !possible.expander.needed.is_empty() {
            let refinements = possible.expander.needed.drain(..).map(Refinement::of).collect();
            violations.truncate(number);
            let certain = Certain { violations, values: first.values };
            return Err(Box::new(Again { covered, certain, refinements, undecided: None }));
        }
    }
    if end == End::Complete {
        covered.failing = None;
        covered.stopped = (0..store.len()).filter(|state| model.any_stands(&store.state(*state))).count();
    }
    covered.time = begin.elapsed();
    entered.extend(representatives.into_iter().flat_map(|all| all.entered));
    let (values, unread) = (first.values, model.unread.clone());
    let outcome = Outcome {
        covered,
        end,
        violations,
        remarks,
        orders,
        obligations,
        reached: store,
        values,
        unread,
        entered,
        occurred,
    };
    match is_decided {
        true => Ok(outcome),
        false => {
            let undecided = Some(Box::new(outcome));
            Err(Box::new(Again { covered, certain: Certain::default(), refinements: Vec::new(), undecided }))
        }
    }
}
