//! Answers that were computed before, by all that they depend on.

use std::collections::HashMap;
use std::hash::Hash;
use std::sync::{Mutex, MutexGuard, PoisonError};

/// Those of late: what nobody asked for is forgotten when `most` others at least have come. Runs at the same time share
/// them.
#[derive(Debug)]
pub struct Answers<Q, A> {
    most: usize,
    known: Mutex<Known<Q, A>>,
}

#[derive(Debug)]
struct Known<Q, A> {
    recent: HashMap<Q, A>,
    older: HashMap<Q, A>,
    /// Answers that were known.
    given: u64,
}

/// With debug assertions one of so many answers is computed again, and has to be the same.
const CHECKED: u64 = 16;

impl<Q: Eq + Hash, A: Clone + PartialEq> Answers<Q, A> {
    pub fn new(most: usize) -> Self {
        let known = Known { recent: HashMap::new(), older: HashMap::new(), given: 0 };
        Self { most, known: Mutex::new(known) }
    }

    /// An answer that is known.
    pub fn known(&self, question: &Q) -> Option<A> {
        self.lock().get(question, self.most).map(|(answer, _)| answer)
    }

    pub fn note(&self, question: Q, answer: A) {
        self.lock().insert(question, answer, self.most);
    }

    /// So many at most, those of late first.
    pub fn of_late(&self, most: usize, is_wanted: impl Fn(&Q) -> bool) -> Vec<(Q, A)>
    where
        Q: Clone,
    {
        let known = self.lock();
        let all = known.recent.iter().chain(&known.older).filter(|(question, _)| is_wanted(question));
        all.take(most).map(|(question, answer)| (question.clone(), answer.clone())).collect()
    }

    /// The answer to a question: `compute` may depend on nothing else.
    pub fn get(&self, question: Q, compute: impl FnOnce() -> A) -> A {
        let known = self.lock().get(&question, self.most);
        if let Some((answer, given)) = known {
            if cfg!(debug_assertions) && given % CHECKED == 0 {
                assert!(compute() == answer, "what is remembered depends on more than it is asked by");
            }
            return answer;
        }
        let answer = compute();
        self.note(question, answer.clone());
        answer
    }

    /// Another run may look while one computes.
    fn lock(&self) -> MutexGuard<'_, Known<Q, A>> {
        // Nothing panics while it is locked.
        self.known.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl<Q: Eq + Hash, A: Clone> Known<Q, A> {
    fn get(&mut self, question: &Q, most: usize) -> Option<(A, u64)> {
        if let Some(answer) = self.recent.get(question) {
            self.given += 1;
            return Some((answer.clone(), self.given));
        }
        let (question, answer) = self.older.remove_entry(question)?;
        self.insert(question, answer.clone(), most);
        self.given += 1;
        Some((answer, self.given))
    }

    fn insert(&mut self, question: Q, answer: A, most: usize) {
        if self.recent.len() >= most {
            self.older = std::mem::take(&mut self.recent);
        }
        self.recent.insert(question, answer);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::cell::Cell;

    #[test]
    fn what_was_asked_of_late_is_not_computed_again() {
        let computed = Cell::new(0);
        let answers = Answers::new(2);
        let ask = |question: u32| {
            let answer = answers.get(question, || {
                computed.set(computed.get() + 1);
                2 * question
            });
            assert_eq!(answer, 2 * question);
            computed.get()
        };
        assert_eq!([1, 1, 2, 3, 1].map(ask), [1, 1, 2, 3, 3]);
        // Three others have come since the last time.
        assert_eq!([4, 5, 6, 1, 6].map(ask), [4, 5, 6, 7, 7]);
    }

    #[test]
    #[cfg(debug_assertions)]
    #[should_panic(expected = "depends on more")]
    fn a_question_that_leaves_something_out_is_found() {
        let answers = Answers::new(2);
        for number in 0..=CHECKED {
            answers.get((), || number);
        }
    }
}
