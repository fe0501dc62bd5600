//! Work on many threads, taken in order.

use std::collections::BTreeMap;
use std::sync::{Condvar, Mutex, MutexGuard, PoisonError};
use std::thread;

/// Results that may wait for an earlier one, for each thread. So many are held at most, however many there are in all.
const AHEAD: usize = 16;

struct Progress<R> {
    /// Index that is given out next.
    next: usize,
    /// Index of the result that is taken next.
    taken: usize,
    waiting: BTreeMap<usize, R>,
}

/// Does the job for each index below `count`, on `threads` threads; `take` sees the
/// results in the order of the indices, as soon as they can be had. The job must not panic.
pub fn each<R: Send>(count: usize, threads: usize, job: impl Fn(usize) -> R + Sync, mut take: impl FnMut(R)) {
    let progress = Mutex::new(Progress { next: 0, taken: 0, waiting: BTreeMap::new() });
    let changed = Condvar::new();
    let ahead = threads * AHEAD;
    thread::scope(|scope| {
        for _ in 0..threads.min(count) {
            scope.spawn(|| {
                while let Some(index) = next(&progress, &changed, count, ahead) {
                    let result = job(index);
                    lock(&progress).waiting.insert(index, result);
                    changed.notify_all();
                }
            });
        }
        for index in 0..count {
            let mut held = lock(&progress);
            let result = loop {
                if let Some(result) = held.waiting.remove(&index) {
                    break result;
                }
                held = changed.wait(held).unwrap_or_else(PoisonError::into_inner);
            };
            held.taken = index + 1;
            drop(held);
            changed.notify_all();
            take(result);
        }
    });
}

fn next<R>(progress: &Mutex<Progress<R>>, changed: &Condvar, count: usize, ahead: usize) -> Option<usize> {
    let mut held = lock(progress);
    while held.next < count && held.next >= held.taken + ahead {
        held = changed.wait(held).unwrap_or_else(PoisonError::into_inner);
    }
    let index = held.next;
    held.next = index.saturating_add(1);
    (index < count).then_some(index)
}

fn lock<R>(progress: &Mutex<Progress<R>>) -> MutexGuard<'_, Progress<R>> {
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
            each(500, threads, job, |result| {
                assert!(made.load(Ordering::Relaxed) <= taken.len() + threads * (AHEAD + 1));
                taken.push(result);
            });
            assert!(taken.iter().copied().eq((0..500).map(|i| i * 3)));
        }
    }

    #[test]
    fn nothing_to_do() {
        each(0, 4, |index| index, |_| panic!("there is no result"));
    }
}
