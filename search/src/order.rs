//! One scan with the steps of its instances in any order.

use crate::footprint::Footprint;
use crate::model::Reductions;
use crate::program::{Cells, bit, members};
use crate::scan::{Scan, Told};
use crate::stop::Stopped;
use crate::successor::{Expander, Successor};
use crate::violation::Violation;

/// Some instances have stepped.
struct Midway {
    bytes: Vec<u8>,
    marks: Marks,
    told: Told,
}

#[derive(Clone, Copy, Default)]
struct Marks {
    /// Instances that have stepped, or that would have done nothing when they did.
    stepped: u64,
    /// Others that might do something.
    due: u64,
    /// A step has ended in a fault: it only matters which of the others do.
    has_failed: bool,
    written: Cells,
    fired: u64,
    restless: u64,
    given: u64,
    repeated: u64,
    forgotten: u128,
}

impl Midway {
    fn is_like(&self, other: &Self) -> bool {
        let key = |Midway { marks, .. }: &Self| {
            (marks.stepped, marks.due, marks.written, marks.has_failed, marks.forgotten)
        };
        key(self) == key(other) && self.bytes == other.bytes
    }
}

impl Expander<'_> {
    /// Instances that would do nothing now may step now or later; all others take their turns. Groups of instances whose
    /// steps do not depend on one another step one group after the other. A line has 64 instances at most.
    pub(crate) fn scan_in_any_order(&mut self, level: usize, touched: u64, emit: &mut impl FnMut(Successor)) {
        let all = u64::MAX.checked_shr(64 - self.model.instances.len() as u32).unwrap_or(0);
        let due = if self.model.reductions == Reductions::Off { all } else { touched & all };
        let mut bytes = self.spare.pop().unwrap_or_default();
        bytes.clone_from(&self.levels[level]);
        let marks = Marks { due, forgotten: self.forgotten, ..Marks::default() };
        let begin = Midway { bytes, marks, told: Told::default() };
        let mut ends = vec![self.copy(&begin)];
        let (mut left, mut next, mut reached) = (all, Vec::new(), Vec::new());
        while begin.marks.due & left != 0 {
            let group = self.group(&begin, left);
            left &= !group;
            for end in ends.drain(..) {
                reached.push(end);
                self.steps(&mut reached, group, emit, &mut next);
                reached.drain(..).for_each(|midway| self.spare.push(midway.bytes));
            }
            std::mem::swap(&mut ends, &mut next);
        }
        for end in ends {
            if !end.marks.has_failed {
                self.finish(&end, touched, emit);
            }
            self.spare.push(end.bytes);
        }
        self.spare.push(begin.bytes);
    }

    fn copy(&mut self, midway: &Midway) -> Midway {
        let mut bytes = self.spare.pop().unwrap_or_default();
        bytes.clone_from(&midway.bytes);
        Midway { bytes, marks: midway.marks, told: midway.told.clone() }
    }

    /// The first of these instances that is due, and all those whose steps may depend on its step in this scan. None is due:
    /// all of them.
    fn group(&self, midway: &Midway, of: u64) -> u64 {
        if self.model.reductions == Reductions::Off || midway.marks.due & of == 0 {
            return of;
        }
        let footprint = |instance| self.footprint(midway, instance);
        let first = 1_u64 << (midway.marks.due & of).trailing_zeros();
        let (mut group, mut waiting) = (first, first);
        // Who is not due, and becomes so by nobody, does nothing.
        let mut may_step = midway.marks.due & of;
        let mut asked = may_step;
        while asked != 0 {
            let instance = asked.trailing_zeros() as usize;
            asked &= asked - 1;
            let fed = members(of & !may_step).filter(|other| footprint(instance).feeds(footprint(*other)));
            let fed = fed.fold(0, |fed, other| fed | bit(other));
            may_step |= fed;
            asked |= fed;
        }
        while waiting != 0 {
            let instance = waiting.trailing_zeros() as usize;
            waiting &= waiting - 1;
            let more =
                members(may_step & !group).filter(|other| footprint(instance).depends_on(footprint(*other)));
            let more = more.fold(0, |more, other| more | bit(other));
            group |= more;
            waiting |= more;
        }
        group
    }

    fn footprint(&self, midway: &Midway, instance: usize) -> &Footprint {
        &self.footprints[instance][self.model.instances[instance].state.load(&midway.bytes) as usize]
    }

    /// The steps of one group in every order. The first midway of those that are reached is the begin; those in which
    /// nobody of the group is due any more are moved to the ends.
    fn steps(
        &mut self,
        reached: &mut Vec<Midway>,
        group: u64,
        emit: &mut impl FnMut(Successor),
        ends: &mut Vec<Midway>,
    ) {
        let mut next = 0;
        while next < reached.len() {
            let midway = self.copy(&reached[next]);
            next += 1;
            if midway.marks.due & group == 0 {
                ends.push(midway);
                continue;
            }
            // Those that do not depend on the others are not interchanged with them.
            let first = self.group(&midway, group & !midway.marks.stepped);
            for instance in members(midway.marks.due & first) {
                self.choices.clear();
                while !self.is_cut() {
                    let mut after = self.copy(&midway);
                    if let Err(violation) = self.step(&mut after, instance) {
                        self.fail(&after, violation, emit);
                        after.bytes.clone_from(&midway.bytes);
                        after.marks = midway.marks;
                        after.marks.has_failed = true;
                        after.marks.stepped |= first;
                        after.marks.due &= !first;
                    }
                    // What has become due only now might have stepped before, when it was not.
                    let newly = after.marks.due & group & !midway.marks.due;
                    let mut earlier = newly;
                    while earlier != 0 {
                        let mut with = self.copy(&after);
                        with.marks.stepped |= earlier;
                        with.marks.due &= !earlier;
                        self.reach(with, reached);
                        earlier = (earlier - 1) & newly;
                    }
                    self.reach(after, reached);
                    if self.is_cut() || !self.choices.advance() {
                        break;
                    }
                }
            }
            self.spare.push(midway.bytes);
        }
    }

    fn reach(&mut self, midway: Midway, reached: &mut Vec<Midway>) {
        if reached.iter().any(|other| other.is_like(&midway)) {
            self.spare.push(midway.bytes);
        } else {
            reached.push(midway);
        }
    }

    fn fail(&self, midway: &Midway, violation: Violation, emit: &mut impl FnMut(Successor)) {
        emit(Successor {
            state: &midway.bytes,
            events: &self.chosen,
            faults: self.faults,
            guesses: self.guesses,
            result: Err(violation),
            noted: &[],
            remarked: &[],
            restless: 0,
            told: &midway.told,
        });
    }

    /// The step of an instance, and who becomes due by it.
    fn step(&mut self, midway: &mut Midway, instance: usize) -> Result<(), Violation> {
        let written = std::mem::take(&mut midway.marks.written);
        let state = self.model.instances[instance].state.load(&midway.bytes) as usize;
        let result = self.on(midway, |scan| scan.step_if_due(instance, u64::MAX));
        let Midway { bytes, marks, .. } = midway;
        marks.stepped |= bit(instance);
        marks.due &= !bit(instance);
        if marks.written.owners != 0 {
            for (other, program) in self.model.instances.iter().enumerate() {
                let to = program.state.load(bytes) as usize;
                if marks.stepped & bit(other) == 0
                    && marks.written.meets(program.states[to].reads)
                    && self.footprints[instance][state].feeds(&self.footprints[other][to])
                {
                    marks.due |= bit(other);
                }
            }
        }
        marks.written = marks.written | written;
        result
    }

    fn finish(&mut self, midway: &Midway, touched: u64, emit: &mut impl FnMut(Successor)) {
        self.choices.clear();
        while !self.is_cut() {
            let mut end = self.copy(midway);
            self.noted.clear();
            self.remarked.clear();
            let (mut result, mark) = self.on(&mut end, |scan| {
                let result = scan.finish(touched);
                scan.ask_starts();
                (result, scan.mark())
            });
            if let Err(stop @ Violation::Stop { .. }) = result {
                let stopped = Stopped::new(self.model, &end.bytes, mark);
                result = Err(self.behind(stopped).unwrap_or(stop));
            }
            emit(Successor {
                state: &end.bytes,
                events: &self.chosen,
                faults: self.faults,
                guesses: self.guesses,
                result,
                noted: &self.noted,
                remarked: &self.remarked,
                restless: end.marks.restless,
                told: &end.told,
            });
            self.spare.push(end.bytes);
            if self.is_cut() || !self.choices.advance() {
                return;
            }
        }
    }

    fn on<T>(&mut self, midway: &mut Midway, work: impl FnOnce(&mut Scan) -> T) -> T {
        let Midway { bytes, marks, told } = midway;
        let mut scan = Scan {
            model: self.model,
            bytes,
            before: &mut self.before,
            values: &mut self.values,
            choices: &mut self.choices,
            variables: &mut self.variables,
            decisions: &mut self.decisions,
            written: marks.written,
            fired: marks.fired,
            given: marks.given,
            repeated: marks.repeated,
            restless: marks.restless,
            forgotten: marks.forgotten,
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
            story: self.tell.then_some(told),
        };
        let result = work(&mut scan);
        let Scan { written, fired, given, repeated, restless, forgotten, .. } = scan;
        *marks = Marks { written, fired, given, repeated, restless, forgotten, ..*marks };
        result
    }
}
