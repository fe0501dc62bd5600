//! Work on many threads, taken in order.

use std::collections::BTreeMap;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// Results that may wait for an earlier one, for each thread. So many are held at most, however many there are in all.
const AHEAD: usize = 16;

struct Progress<W, R> {
    /// What is still to be done.
    work: W,
    /// Pieces of work given out.
    given: usize,
    /// Results taken.
    taken: usize,
    is_out_of_work: bool,
    waiting: BTreeMap<usize, R>,
}

/// Does the job for each piece of work, on `threads` threads; `take` sees the results in the order of the work, as soon
/// as they can be had. Work is asked for late, so that it may depend on what was taken before. The job must not panic.
pub fn each<T: Send, R: Send>(
    work: impl Iterator<Item = T> + Send,
    threads: usize,
    job: impl Fn(T) -> R + Sync,
    mut take: impl FnMut(R),
) {
    let progress =
        Mutex::new(Progress { work, given: 0, taken: 0, is_out_of_work: false, waiting: BTreeMap::new() });
    let changed = Condvar::new();
    let ahead = threads * AHEAD;
    thread::scope(|scope| {
        for _ in 0..threads {
            scope.spawn(|| {
                while let Some((index, piece)) = next(&progress, &changed, ahead) {
                    let result = job(piece);
                    lock(&progress).waiting.insert(index, result);
                    changed.notify_all();
                }
            });
        }
        loop {
            let mut held = lock(&progress);
            let result = loop {
                let index = held.taken;
                if let Some(result) = held.waiting.remove(&index) {
                    break result;
                }
                if held.is_out_of_work && held.given == index {
                    return;
                }
                held = changed.wait(held).unwrap_or_else(PoisonError::into_inner);
            };
            held.taken += 1;
            drop(held);
            take(result);
            changed.notify_all();
        }
    });
}

fn next<T, R>(
    progress: &Mutex<Progress<impl Iterator<Item = T>, R>>,
    changed: &Condvar,
    ahead: usize,
) -> Option<(usize, T)> {
    let mut held = lock(progress);
    while !held.is_out_of_work && held.given >= held.taken + ahead {
        held = changed.wait(held).unwrap_or_else(PoisonError::into_inner);
    }
    let piece = if held.is_out_of_work { None } else { held.work.next() };
    let Some(piece) = piece else {
        held.is_out_of_work = true;
        changed.notify_all();
        return None;
    };
    let index = held.given;
    held.given += 1;
    Some((index, piece))
}

fn lock<P>(progress: &Mutex<P>) -> MutexGuard<'_, P> {
    progress.lock().unwrap_or_else(PoisonError::into_inner)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::sync::atomic::{AtomicUsize, Ordering};

    #[test]
    fn results_come_in_order_and_few_wait() {
        for threads in [1, 3, 8] {
            let made = AtomicUsize::new(0);
            let mut taken = Vec::new();
            let job = |index: usize| {
                // The first of each lot is the last to be done.
                (0..if index.is_multiple_of(50) { 2000 } else { 1 }).for_each(|_| thread::yield_now());
                made.fetch_add(1, Ordering::Relaxed);
                index * 3
            };
            each(0..500, threads, job, |result| {
                assert!(made.load(Ordering::Relaxed) <= taken.len() + threads * (AHEAD + 1));
                taken.push(result);
            });
            assert!(taken.iter().copied().eq((0..500).map(|i| i * 3)));
        }
    }

    #[test]
    fn work_may_end_by_what_was_taken() {
        for threads in [1, 4] {
            let is_enough = AtomicUsize::new(0);
            let mut next = 0_usize;
            let work = std::iter::from_fn(|| {
                next += 1;
                (is_enough.load(Ordering::Relaxed) == 0).then_some(next)
            });
            let mut most = 0;
            each(
                work,
                threads,
                |index| index,
                |index| {
                    most = index;
                    is_enough.store(usize::from(index >= 10), Ordering::Relaxed);
                },
            );
            assert!((10..=10 + threads * (AHEAD + 1)).contains(&most), "{most}");
        }
    }

    #[test]
    fn nothing_to_do() {
        each(0..0, 4, |index: usize| index, |_| panic!("there is no result"));
    }
}
