//! What runs have found, as words that a later process reads back.

use super::{Memory, Surroundings};
use crate::answers::Answers;
use crate::fingerprint::Fingerprint;
use crate::line::Line;
use crate::part::chain::motions::Stored;
use std::fmt::Write;
use std::sync::PoisonError;

/// So many paths are stored, 10 kB each, and so many answers about contact, 24 bytes each.
const MOST_PATHS: usize = 500;
const MOST_ANSWERS: usize = 50_000;

impl Memory {
    /// All that paths and contacts of a line depend on: what was stored for another text is of no use.
    pub fn text_of(line: &Line) -> String {
        let Surroundings { machines, obstacles, kinds } = Surroundings::of(line);
        let mut text = String::new();
        for machine in machines {
            // Writing to memory does not fail.
            let _ = writeln!(text, "{:?} {:?}", machine.pose, machine.visits);
            for part in machine.parts {
                part.write(&mut text);
                text.push('\n');
            }
        }
        text + &format!("{obstacles:?}\n{kinds:?}\n")
    }

    /// The paths that were planned and what was found free of contact.
    pub fn stored(&self) -> Vec<u64> {
        let shared = self.shared.lock().unwrap_or_else(PoisonError::into_inner);
        let mut words = vec![shared.motions.len() as u64];
        for (motions, given) in shared.motions.iter().zip(&shared.stored) {
            let paths = motions.as_ref().map(|motions| motions.to_store(MOST_PATHS));
            paths.as_ref().unwrap_or(given).write(&mut words);
        }
        write_answers(&shared.contacts.free, u64::from, &mut words);
        write_answers(&shared.contacts.clear, f64::to_bits, &mut words);
        words
    }

    /// What was [stored](Self::stored) by a run of a line with the same [text](Self::text_of); none if these are no words
    /// of it.
    pub fn restored(line: &Line, mut words: &[u64]) -> Option<Self> {
        let words = &mut words;
        let machines = usize::try_from(take(words)?).ok().filter(|count| *count == line.machines.len())?;
        let stored = (0..machines).map(|_| Stored::read(words)).collect::<Option<Vec<_>>>()?;
        let mut memory = Self::default();
        memory.keep_for(line);
        read_answers(words, &memory.contacts.free, |word| (word <= 1).then_some(word == 1))?;
        read_answers(words, &memory.contacts.clear, |word| Some(f64::from_bits(word)))?;
        memory.shared.lock().unwrap_or_else(PoisonError::into_inner).stored = stored;
        words.is_empty().then_some(memory)
    }
}

fn write_answers<A: Clone + PartialEq>(
    answers: &Answers<Fingerprint, A>,
    word: impl Fn(A) -> u64,
    words: &mut Vec<u64>,
) {
    let all = answers.of_late(MOST_ANSWERS, |_| true);
    words.push(all.len() as u64);
    words.extend(all.into_iter().flat_map(|(question, answer)| {
        let [a, b] = question.words();
        [a, b, word(answer)]
    }));
}

fn read_answers<A: Clone + PartialEq>(
    words: &mut &[u64],
    answers: &Answers<Fingerprint, A>,
    answer: impl Fn(u64) -> Option<A>,
) -> Option<()> {
    for _ in 0..take(words)? {
        let question = Fingerprint::of_words([take(words)?, take(words)?]);
        answers.note(question, answer(take(words)?)?);
    }
    Some(())
}

/// The next word.
pub(crate) fn take(words: &mut &[u64]) -> Option<u64> {
    let (first, rest) = words.split_first()?;
    *words = rest;
    Some(*first)
}
