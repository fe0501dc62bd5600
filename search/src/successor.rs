//! All that may follow a state: what devices do, then one scan.

use crate::choice::Choices;
use crate::cut::Cut;
use crate::decision::Decisions;
use crate::event::{self, Event};
use crate::footprint::{Footprint, footprints};
use crate::model::{Model, Reductions};
use crate::occurred::Occurred;
use crate::plant::{Faults, Input, sight};
use crate::postponed::{Postponed, Postponing};
use crate::program::{Cells, Instance, bit};
use crate::property::Whenever;
use crate::scan::{Scan, Told};
use crate::stop::{Stopped, Stops};
use crate::unread::Needed;
use crate::value::Values;
use crate::violation::Violation;
use std::sync::Arc;

/// In which orders the instances step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Orders {
    /// In that of the line.
    One,
    /// In any, another one in each scan.
    All,
}

/// Which successors of a state are asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    All,
    /// Those before which no device fails.
    Calm,
    /// The others.
    Failing,
}

pub struct Expander<'a> {
    pub model: &'a Model,
    pub values: Values,
    /// At most so many devices do something in one scan.
    pub answers: usize,
    pub orders: Orders,
    pub(crate) order: Vec<usize>,
    /// Of each state of each instance, if they step in any order.
    pub(crate) footprints: Vec<Vec<Footprint>>,
    /// Memory of states midway in a scan, to be used again.
    pub(crate) spare: Vec<Vec<u8>>,
    pub(crate) choices: Choices,
    pub(crate) variables: Vec<i32>,
    pub(crate) decisions: Decisions,
    /// Of each source that may do anything what that is.
    options: Vec<Vec<Choice>>,
    events: Vec<Event>,
    /// The state after the events chosen so far, by their number.
    pub(crate) levels: Vec<Vec<u8>>,
    /// The state that is expanded.
    pub(crate) before: Vec<u8>,
    pub(crate) work: Vec<u8>,
    pub(crate) noted: Vec<Violation>,
    pub(crate) remarked: Vec<Violation>,
    /// In all that was expanded.
    pub(crate) occurred: Occurred,
    pub(crate) chosen: Vec<Event>,
    restless: u64,
    /// How many of the chosen events are faults.
    pub(crate) faults: usize,
    /// How many depend on what is forgotten.
    pub(crate) guesses: usize,
    part: Part,
    /// Whether successors are to say what has fired.
    pub tell: bool,
    pub(crate) told: Told,
    /// What is forgotten in the state that is worked on, and in the one before.
    pub(crate) forgotten: u128,
    pub(crate) forgotten_before: u128,
    /// What was forgotten and has to be known, since this was last asked.
    pub(crate) needed: Vec<Needed>,
    pub(crate) postponing: Postponing,
    pub(crate) postponed: Postponed,
    pub(crate) stops: Stops,
    /// The values of a machine that are looked up.
    pub(crate) own: Vec<u8>,
    /// Successors are looked at, and not told.
    is_silent: bool,
    /// Where expansions end before they are complete.
    pub(crate) cut: Arc<Cut>,
    /// Scans since the last look at the clock.
    scans: u32,
}

/// So many scans take some milliseconds at most.
const SCANS: u32 = 256;

/// What a device may do.
#[derive(Clone, Copy)]
struct Choice {
    event: Event,
    is_fault: bool,
    is_guess: bool,
}

/// What follows a state.
pub struct Successor<'a> {
    pub state: &'a [u8],
    pub events: &'a [Event],
    pub result: Result<(), Violation>,
    /// How many of the events are faults, and how many may not be able to happen.
    pub faults: usize,
    pub guesses: usize,
    /// Violations after which the line continues.
    pub noted: &'a [Violation],
    /// What is hardly meant.
    pub remarked: &'a [Violation],
    /// Instances that may do something in the next scan even if no device does.
    pub restless: u64,
    /// What is told of it, if that was asked for.
    pub told: &'a Told,
}

impl Successor<'_> {
    /// Whether at most one device did something, and it was no fault, and certainly could happen.
    pub fn is_plain(&self) -> bool {
        self.events.len() <= 1 && self.faults == 0 && self.guesses == 0
    }
}

/// Machines of which a sensor over a conveyor at rest may tell something else now: an item has come or gone.
fn opened(model: &Model, before: &[u8], state: &[u8]) -> u64 {
    let is_open = |input: &Input, state: &[u8]| input.var.load(state) == sight::OPEN;
    let is_opened =
        |input: &&Input| input.stays.is_some() && is_open(input, state) && !is_open(input, before);
    model.inputs.iter().filter(is_opened).fold(0, |machines, input| machines | bit(input.machine))
}

impl<'a> Expander<'a> {
    pub fn new(model: &'a Model, answers: usize, orders: Orders) -> Self {
        Self {
            model,
            values: model.values.clone(),
            answers,
            orders,
            order: (0..model.instances.len()).collect(),
            footprints: if orders == Orders::All { footprints(model) } else { Vec::new() },
            spare: Vec::new(),
            choices: Choices::default(),
            variables: vec![0; model.most_variables()],
            decisions: match model.reductions {
                Reductions::Off => Decisions::default(),
                _ => Decisions::new(model),
            },
            options: Vec::new(),
            events: Vec::new(),
            levels: Vec::new(),
            before: vec![0; model.initial.len()],
            work: vec![0; model.initial.len()],
            noted: Vec::new(),
            remarked: Vec::new(),
            occurred: Occurred::new(model),
            chosen: Vec::new(),
            restless: 0,
            faults: 0,
            guesses: 0,
            part: Part::All,
            tell: false,
            told: Told::default(),
            forgotten: 0,
            forgotten_before: 0,
            needed: Vec::new(),
            postponing: Postponing::default(),
            postponed: Postponed::default(),
            stops: Stops::default(),
            own: Vec::new(),
            is_silent: false,
            cut: Cut::new(None),
            scans: 0,
        }
    }

    /// Whether the expansion is cut here; called for each scan.
    pub(crate) fn is_cut(&mut self) -> bool {
        self.scans += 1;
        if self.scans >= SCANS {
            self.scans = 0;
            self.cut.look_at_the_clock();
        }
        self.cut.because().is_some()
    }

    /// Calls `emit` with every successor; a state may come several times.
    /// `restless` are the instances that may do something even if no device does.
    pub fn expand(&mut self, state: &[u8], restless: u64, emit: &mut impl FnMut(Successor)) {
        self.expand_part(Part::All, state, restless, emit);
    }

    /// The same for a part of them.
    pub fn expand_part(&mut self, part: Part, state: &[u8], restless: u64, emit: &mut impl FnMut(Successor)) {
        let mut options = self.begin_expansion(state, restless, |is_fault| part != Part::Calm || !is_fault);
        self.answers_of(part, &mut options, emit);
        self.options = options;
    }

    /// The same, without answers that can be postponed, of these machines; of which machines they are.
    pub(crate) fn expand_postponing(
        &mut self,
        part: Part,
        state: &[u8],
        restless: u64,
        among: u64,
        emit: &mut impl FnMut(Successor),
    ) -> u64 {
        let mut options = self.begin_expansion(state, restless, |_| true);
        self.postpone(state, self.restless, among);
        if part == Part::Calm
            && self.postponed.waiting != 0
            && self.model.faults == Faults::All
            && !self.can_stay(state)
        {
            self.is_silent = true;
            self.answers_of(Part::Failing, &mut options, emit);
            self.is_silent = false;
        }
        self.answers_of(part, &mut options, emit);
        self.options = options;
        self.end_postponing()
    }

    /// What each source may do in a state.
    fn begin_expansion(
        &mut self,
        state: &[u8],
        restless: u64,
        is_wanted: impl Fn(bool) -> bool,
    ) -> Vec<Vec<Choice>> {
        self.stops.clear();
        self.decisions.numbered = Some(self.values.count());
        self.before.copy_from_slice(state);
        self.forgotten = self.model.unread.in_state(&self.model.instances, state, u64::MAX);
        self.forgotten_before = self.forgotten;
        self.restless = self.restless_in(state, restless);
        self.work.copy_from_slice(state);
        self.begin().ask_starts();
        let sources = event::sources(self.model);
        let mut options: Vec<Vec<Choice>> = std::mem::take(&mut self.options);
        let mut used = 0;
        let mut events = std::mem::take(&mut self.events);
        for source in 0..sources {
            if used == options.len() {
                options.push(Vec::new());
            }
            events.clear();
            event::events(self.model, &self.values, state, source, &mut events);
            options[used].clear();
            options[used].extend(events.iter().filter_map(|event| {
                let is_fault = event::is_fault(self.model, &self.values, state, event);
                let is_guess = event::is_guess(self.model, &self.values, state, event);
                is_wanted(is_fault).then_some(Choice { event: *event, is_fault, is_guess })
            }));
            used += usize::from(!options[used].is_empty());
        }
        options.truncate(used);
        self.events = events;
        self.levels.resize_with(used + 2, || vec![0; state.len()]);
        self.levels[0].copy_from_slice(state);
        self.chosen.clear();
        options
    }

    /// All that devices may do before the scan, and again with what turns out not to be postponed.
    fn answers_of(&mut self, part: Part, options: &mut [Vec<Choice>], emit: &mut impl FnMut(Successor)) {
        self.part = part;
        self.occurred.is_noted = true;
        self.answer(options, 0, 0, emit);
        loop {
            let needed = self.postponed.observed & (self.postponed.waiting | self.postponed.idle);
            if needed == 0 {
                break;
            }
            self.no_longer(needed);
            if self.is_silent && !self.may_be_needed() {
                break;
            }
            self.postponed.fresh = needed;
            self.answer(options, 0, 0, emit);
            self.postponed.fresh = 0;
        }
        self.occurred.is_noted = false;
    }

    /// Whether there is something postponed of which nobody has needed it so far.
    fn may_be_needed(&self) -> bool {
        let Postponed { waiting, idle, observed, .. } = self.postponed;
        (waiting | idle) & !observed != 0
    }

    /// Whether the state may stay as it is if no device does anything.
    fn can_stay(&mut self, state: &[u8]) -> bool {
        if self.restless == 0 {
            return true;
        }
        self.choices.clear();
        let mut stays = false;
        loop {
            self.work.copy_from_slice(state);
            let order = std::mem::take(&mut self.order);
            let mut scan = self.begin();
            stays |= scan.run(&order, u64::MAX).is_ok() && self.work == state;
            self.order = order;
            if stays || self.is_cut() || !self.choices.advance() {
                return stays;
            }
        }
    }

    /// Instances that would do something even if no device did.
    fn restless_in(&mut self, state: &[u8], candidates: u64) -> u64 {
        let mut restless = 0;
        for instance in (0..self.model.instances.len()).filter(|instance| candidates & bit(*instance) != 0) {
            self.choices.clear();
            self.work.copy_from_slice(state);
            let mut scan = self.begin();
            let result = scan.step_if_due(instance, u64::MAX);
            if result.is_err() || scan.fired != 0 || !self.choices.is_empty() {
                restless |= bit(instance);
            }
        }
        restless
    }

    /// Bytes of memory that it keeps to be used again.
    pub(crate) fn size(&self) -> usize {
        self.spare.iter().chain(&self.levels).map(Vec::capacity).sum::<usize>() + self.decisions.size()
    }

    /// Whether the goal of a property is waited for in a state.
    pub fn is_waiting(&mut self, state: &[u8], program: &Instance, whenever: &Whenever) -> bool {
        self.choices.clear();
        self.work.copy_from_slice(state);
        self.forgotten = self.model.unread.in_state(&self.model.instances, state, u64::MAX);
        self.begin().is_waiting(program, whenever)
    }

    /// A scan of the state that is worked on.
    pub(crate) fn begin(&mut self) -> Scan<'_> {
        Scan {
            model: self.model,
            bytes: &mut self.work,
            before: &mut self.before,
            values: &mut self.values,
            choices: &mut self.choices,
            variables: &mut self.variables,
            decisions: &mut self.decisions,
            written: Cells::default(),
            fired: 0,
            given: 0,
            repeated: 0,
            restless: 0,
            forgotten: self.forgotten,
            forgotten_before: self.forgotten_before,
            looks_back: false,
            is_reset: false,
            needed: &mut self.needed,
            postponed: (&self.postponed, &self.postponing),
            own: &mut self.own,
            observed: 0,
            stepping: 0,
            not_passed: i32::MAX,
            noted: &mut self.noted,
            remarked: &mut self.remarked,
            occurred: &mut self.occurred,
            story: self.tell.then_some(&mut self.told),
        }
    }

    fn answer(
        &mut self,
        options: &[Vec<Choice>],
        level: usize,
        touched: u64,
        emit: &mut impl FnMut(Successor),
    ) {
        if self.cut.because().is_some() {
            return;
        }
        let has_to_fail = self.part == Part::Failing && self.faults == 0;
        let is_fresh = self.postponed.fresh != 0;
        if has_to_fail && !is_fresh && !options.iter().flatten().any(|choice| choice.is_fault) {
            return;
        }
        let Some((choices, rest)) = options.split_first().filter(|_| self.chosen.len() < self.answers) else {
            if self.is_asked_for(has_to_fail) {
                self.scan(level, touched | self.restless, emit);
            }
            return;
        };
        self.answer(rest, level, touched, emit);
        for Choice { event, is_fault, is_guess } in choices {
            if self.part == Part::Calm && *is_fault {
                continue;
            }
            self.occurred.event(self.model, &self.levels[level], *event);
            if self.can_wait(*event) {
                continue;
            }
            let (before, after) = self.levels.split_at_mut(level + 1);
            after[0].copy_from_slice(&before[level]);
            event::apply(self.model, &mut self.values, &mut after[0], *event);
            self.chosen.push(*event);
            self.faults += usize::from(*is_fault);
            self.guesses += usize::from(*is_guess);
            self.answer(rest, level + 1, touched | bit(event.machine), emit);
            self.faults -= usize::from(*is_fault);
            self.guesses -= usize::from(*is_guess);
            self.chosen.pop();
        }
    }

    /// Whether a scan after the events chosen is searched.
    fn is_asked_for(&self, has_to_fail: bool) -> bool {
        let fresh = self.postponed.fresh;
        if fresh == 0 {
            return !has_to_fail;
        }
        // Other events of these machines were searched before, with and without those of others.
        let is_fresh = |event: &Event| event.machine < 64 && fresh & bit(event.machine) != 0;
        self.chosen.iter().any(is_fresh) && (!has_to_fail || self.chosen.len() == 1)
    }

    /// Every outcome of one scan.
    fn scan(&mut self, level: usize, touched: u64, emit: &mut impl FnMut(Successor)) {
        let touched = touched | opened(self.model, &self.before, &self.levels[level]);
        if self.orders == Orders::All {
            return self.scan_in_any_order(level, touched, emit);
        }
        if self.is_silent && !self.may_be_needed() {
            return;
        }
        self.choices.clear();
        while !self.is_cut() {
            self.work.copy_from_slice(&self.levels[level]);
            self.noted.clear();
            self.remarked.clear();
            self.told.fired.clear();
            self.told.read.clear();
            let order = std::mem::take(&mut self.order);
            let mut scan = self.begin();
            let mut result = scan.run(&order, touched);
            scan.ask_starts();
            let restless = scan.restless;
            let (observed, changed, given) = (scan.observed, scan.written.owners | scan.fired, scan.given);
            let mark = scan.mark();
            self.order = order;
            self.observe(observed, changed);
            if given == 0 && result.is_ok() {
                self.observe_hazards();
            }
            if let Err(stop @ Violation::Stop { .. }) = result {
                let stopped = Stopped::new(self.model, &self.work, mark);
                result = Err(self.behind(stopped).unwrap_or(stop));
            }
            if self.is_silent {
                if self.choices.advance() {
                    continue;
                }
                return;
            }
            emit(Successor {
                state: &self.work,
                events: &self.chosen,
                faults: self.faults,
                guesses: self.guesses,
                result,
                noted: &self.noted,
                remarked: &self.remarked,
                restless,
                told: &self.told,
            });
            if !self.choices.advance() {
                return;
            }
        }
    }
}
