//! One scan with the steps of its instances in any order.

use crate::model::Reductions;
use crate::program::bit;
use crate::scan::{Scan, Told};
use crate::successor::{Expander, Successor};
use crate::violation::Violation;
use std::collections::HashSet;

/// Some instances have stepped.
#[derive(Clone)]
struct Midway {
    bytes: Vec<u8>,
    /// Instances that have stepped, or that would have done nothing when they did.
    stepped: u64,
    written: u64,
    fired: u64,
    restless: u64,
    given: u64,
    repeated: u64,
    told: Told,
}

impl Expander<'_> {
    /// Instances that would do nothing now may step now or later; all others take their turns. A line has 64 instances
    /// at most.
    pub(crate) fn scan_in_any_order(&mut self, level: usize, touched: u64, emit: &mut impl FnMut(Successor)) {
        let mut seen: HashSet<(Vec<u8>, u64, u64)> = HashSet::new();
        let begin = Midway {
            bytes: self.levels[level].clone(),
            stepped: 0,
            written: 0,
            fired: 0,
            restless: 0,
            given: 0,
            repeated: 0,
            told: Told::default(),
        };
        let mut waiting = vec![begin];
        while let Some(midway) = waiting.pop() {
            let due = self.due(&midway, touched);
            if due == 0 {
                self.finish(&midway, touched, emit);
                continue;
            }
            for instance in (0..self.model.instances.len()).filter(|instance| due & bit(*instance) != 0) {
                self.choices.clear();
                loop {
                    let mut next = midway.clone();
                    let result = self.on(&mut next, |scan| scan.step_if_due(instance, u64::MAX));
                    next.stepped |= bit(instance);
                    match result {
                        Err(violation) => emit(Successor {
                            state: &next.bytes,
                            events: &self.chosen,
                            is_plain: self.is_plain(),
                            result: Err(violation),
                            noted: &[],
                            remarked: &[],
                            restless: 0,
                            told: &next.told,
                        }),
                        Ok(()) => {
                            // What has become due only now might have stepped before, when it was not.
                            let newly = self.due(&next, touched) & !due;
                            let mut earlier = newly;
                            loop {
                                let with = Midway { stepped: next.stepped | earlier, ..next.clone() };
                                if seen.insert((with.bytes.clone(), with.stepped, with.written)) {
                                    waiting.push(with);
                                }
                                if earlier == 0 {
                                    break;
                                }
                                earlier = (earlier - 1) & newly;
                            }
                        }
                    }
                    if !self.choices.advance() {
                        break;
                    }
                }
            }
        }
    }

    /// Instances that have not stepped and might do something.
    fn due(&self, midway: &Midway, touched: u64) -> u64 {
        let mut due = 0;
        for (instance, program) in self.model.instances.iter().enumerate() {
            let state = program.state.load(&midway.bytes) as usize;
            let is_due = touched & bit(instance) != 0
                || midway.written & program.states[state].reads != 0
                || self.model.reductions == Reductions::Off;
            if is_due && midway.stepped & bit(instance) == 0 {
                due |= bit(instance);
            }
        }
        due
    }

    fn finish(&mut self, midway: &Midway, touched: u64, emit: &mut impl FnMut(Successor)) {
        self.choices.clear();
        loop {
            let mut end = midway.clone();
            self.noted.clear();
            self.remarked.clear();
            let mut result = self.on(&mut end, |scan| scan.finish(touched));
            if result == Err(Violation::Stop) {
                result = Err(self.behind_stop(&end.bytes).unwrap_or(Violation::Stop));
            }
            emit(Successor {
                state: &end.bytes,
                events: &self.chosen,
                is_plain: self.is_plain(),
                result,
                noted: &self.noted,
                remarked: &self.remarked,
                restless: end.restless | midway.restless,
                told: &end.told,
            });
            if !self.choices.advance() {
                return;
            }
        }
    }

    fn on(
        &mut self,
        midway: &mut Midway,
        work: impl FnOnce(&mut Scan) -> Result<(), Violation>,
    ) -> Result<(), Violation> {
        let mut scan = Scan {
            model: self.model,
            bytes: &mut midway.bytes,
            before: &mut self.before,
            values: &mut self.values,
            choices: &mut self.choices,
            variables: &mut self.variables,
            written: midway.written,
            fired: midway.fired,
            given: midway.given,
            repeated: midway.repeated,
            restless: midway.restless,
            noted: &mut self.noted,
            remarked: &mut self.remarked,
            story: self.tell.then_some(&mut midway.told),
        };
        let result = work(&mut scan);
        let (written, fired, restless) = (scan.written, scan.fired, scan.restless);
        (midway.given, midway.repeated) = (scan.given, scan.repeated);
        (midway.written, midway.fired, midway.restless) = (written, fired, restless);
        result
    }
}
