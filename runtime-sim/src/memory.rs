//! What runs of the same machines have in common: motions that were computed, and what was found free of contact.

mod stored;

pub(crate) use stored::take;

use crate::answers::Answers;
use crate::collision::Boxes;
use crate::fingerprint::Fingerprint;
use crate::line::{Kind, Line, Obstacle};
use crate::machine::Machine;
use crate::part::Part;
use crate::part::chain::motions::{Motions, Stored};
use crate::planner::Planner;
use crate::point::Point;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

/// It changes no result: a run with the memory of another one is the same, and faster. Of other machines, obstacles or
/// kinds of part it remembers nothing.
#[derive(Debug, Default)]
pub struct Memory {
    surroundings: Option<Surroundings>,
    shared: Arc<Mutex<Shared>>,
    contacts: Arc<Contacts>,
}

/// What several memories have in common.
#[derive(Debug, Default)]
struct Shared {
    surroundings: Option<Surroundings>,
    /// By machine; none for what is no arm.
    motions: Vec<Option<Arc<Motions>>>,
    /// By machine: what was read back, until it has motions.
    stored: Vec<Stored>,
    contacts: Arc<Contacts>,
}

/// What was found about motions and places, by their fingerprints.
#[derive(Debug)]
struct Contacts {
    /// Whether a motion is free of contact with what rests, or two that rest are.
    free: Answers<Fingerprint, bool>,
    /// What contains an arm on each piece of its path.
    boxes: Answers<Fingerprint, Arc<Boxes>>,
    /// What contains an arm where it rests.
    boxes_at_rest: Answers<Fingerprint, Arc<Boxes>>,
    /// For how long two that move stay apart, s.
    clear: Answers<Fingerprint, f64>,
}

impl Default for Contacts {
    fn default() -> Self {
        Self {
            free: Answers::new(MOST),
            boxes: Answers::new(MOST_BOXES),
            boxes_at_rest: Answers::new(MOST_BOXES),
            clear: Answers::new(MOST_CLEAR),
        }
    }
}

/// All that paths and contacts depend on.
#[derive(Clone, Debug, PartialEq)]
struct Surroundings {
    machines: Vec<Surrounding>,
    obstacles: Vec<Obstacle>,
    kinds: Vec<Kind>,
}

/// A machine: where it stands, what it consists of, and the stops at which it can be.
#[derive(Clone, Debug, PartialEq)]
struct Surrounding {
    pose: Point,
    parts: Vec<Arc<Part>>,
    visits: Option<Vec<usize>>,
}

impl Surroundings {
    fn of(line: &Line) -> Self {
        let machines = line.machines.iter().map(|Machine { pose, parts, visits, .. }| Surrounding {
            pose: *pose,
            parts: parts.clone(),
            visits: visits.clone(),
        });
        Self { machines: machines.collect(), obstacles: line.obstacles.clone(), kinds: line.kinds.clone() }
    }
}

/// So many answers of late are remembered, and as many older ones, in all runs at the same time: 24 bytes each.
const MOST: usize = 500_000;
/// So many motions have their boxes remembered, and as many older ones: 9 kB each. So have as many places of rest: 1 kB each.
const MOST_BOXES: usize = 5_000;
/// So many answers about two that move are remembered, and as many older ones: 24 bytes each.
const MOST_CLEAR: usize = 100_000;

impl Memory {
    /// Forgets what is about other machines.
    pub(crate) fn keep_for(&mut self, line: &Line) {
        let surroundings = Surroundings::of(line);
        if self.surroundings.as_ref() != Some(&surroundings) {
            *self = Self { surroundings: Some(surroundings), shared: self.shared.clone(), ..Self::default() };
            let contacts = self.shared(line).contacts.clone();
            self.contacts = contacts;
        }
    }

    /// Another one that knows the motions of this one and their contacts, for runs at the same time.
    pub fn beside(&self) -> Self {
        Self { shared: self.shared.clone(), ..Self::default() }
    }

    /// The motions of a machine; none if it is no arm.
    pub(crate) fn motions(&mut self, line: &Line, machine: usize) -> Option<Arc<Motions>> {
        let mut shared = self.shared(line);
        let Shared { motions, stored, .. } = &mut *shared;
        let known = motions.get_mut(machine)?;
        if known.is_none() {
            let arm = line.machines[machine].arm()?;
            let planner = Planner::of(line, machine);
            let stored = std::mem::take(&mut stored[machine]);
            *known = Some(Arc::new(Motions::new(arm, &line.machines[machine], planner, stored)));
        }
        known.clone()
    }

    /// What is known of these surroundings; all else is forgotten.
    fn shared(&self, line: &Line) -> MutexGuard<'_, Shared> {
        // Nothing panics while it is locked.
        let mut shared = self.shared.lock().unwrap_or_else(PoisonError::into_inner);
        if shared.surroundings != self.surroundings {
            let machines = line.machines.len();
            let (motions, stored) = (vec![None; machines], vec![Stored::default(); machines]);
            let surroundings = self.surroundings.clone();
            *shared = Shared { surroundings, motions, stored, contacts: Arc::default() };
        }
        shared
    }

    pub(crate) fn boxes(&self, motion: Fingerprint, compute: impl FnOnce() -> Arc<Boxes>) -> Arc<Boxes> {
        known_or(&self.contacts.boxes, motion, compute)
    }

    pub(crate) fn boxes_at_rest(
        &self,
        place: Fingerprint,
        compute: impl FnOnce() -> Arc<Boxes>,
    ) -> Arc<Boxes> {
        known_or(&self.contacts.boxes_at_rest, place, compute)
    }

    /// For how long two stay apart that move like this, s; none if that is not known.
    pub(crate) fn clear(&self, motions: Fingerprint) -> Option<f64> {
        self.contacts.clear.known(&motions)
    }

    pub(crate) fn note_clear(&self, motions: Fingerprint, seconds: f64) {
        self.contacts.clear.note(motions, seconds);
    }

    pub(crate) fn is_free(&self, question: Fingerprint) -> Option<bool> {
        self.contacts.free.known(&question)
    }

    pub(crate) fn note_free(&self, question: Fingerprint, is_free: bool) {
        self.contacts.free.note(question, is_free);
    }
}

/// Fingerprints take places that are nearly the same for one, so another computation may differ in the last digits:
/// [`Answers::get`], which wants the same answer, is not for them.
fn known_or(
    boxes: &Answers<Fingerprint, Arc<Boxes>>,
    of: Fingerprint,
    compute: impl FnOnce() -> Arc<Boxes>,
) -> Arc<Boxes> {
    boxes.known(&of).unwrap_or_else(|| {
        let computed = compute();
        boxes.note(of, computed.clone());
        computed
    })
}
