//! Work on many items with all processors.

use std::num::NonZero;
use std::panic::resume_unwind;
use std::thread;

/// Bytes of the stack of a thread: as many as the first thread of a program usually has.
pub const STACK: usize = 8 * 1024 * 1024;
/// Machines or pairs of them in one thread: fewer take no longer than to begin another one.
pub const LEAST: usize = 100;

/// What `work` gives for parts of the items that follow one another, in the order of the items: where a part ends
/// must not matter. No part is shorter than `least`, but for the last one.
pub fn in_parts<T: Sync, R: Send>(items: &[T], least: usize, work: impl Fn(&[T]) -> Vec<R> + Sync) -> Vec<R> {
    let threads = thread::available_parallelism().map_or(1, NonZero::get);
    divided(items, items.len().div_ceil(threads).max(least).max(1), work)
}

/// What both give. With so many machines or pairs that it is worth while, the first of them works in a thread of its own,
/// if the system gives one.
pub fn both<A: Send, B>(items: usize, first: impl Fn() -> A + Sync, second: impl FnOnce() -> B) -> (A, B) {
    if items < LEAST {
        return (first(), second());
    }
    thread::scope(|scope| {
        let first = &first;
        let begun = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, first);
        let second = second();
        let first = match begun {
            Ok(thread) => thread.join().unwrap_or_else(|panic| resume_unwind(panic)),
            Err(_) => first(),
        };
        (first, second)
    })
}

/// In parts of a length, all at the same time as far as the system gives threads.
fn divided<T: Sync, R: Send>(items: &[T], length: usize, work: impl Fn(&[T]) -> Vec<R> + Sync) -> Vec<R> {
    let mut parts = items.chunks(length);
    let Some(first) = parts.next() else { return Vec::new() };
    thread::scope(|scope| {
        let work = &work;
        let begun = |part| {
            let thread = thread::Builder::new().stack_size(STACK);
            (part, thread.spawn_scoped(scope, move || work(part)))
        };
        let others: Vec<_> = parts.map(begun).collect();
        let mut all = work(first);
        for (part, thread) in others {
            all.extend(match thread {
                Ok(thread) => thread.join().unwrap_or_else(|panic| resume_unwind(panic)),
                Err(_) => work(part),
            });
        }
        all
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn results_are_in_the_order_of_the_items() {
        let items: Vec<u32> = (0..100).collect();
        let twice = |part: &[u32]| part.iter().flat_map(|item| [*item; 2]).collect::<Vec<_>>();
        for length in [1, 7, 50, 99, 100, 1000] {
            assert_eq!(divided(&items, length, twice), twice(&items), "{length}");
        }
        assert_eq!(in_parts(&items, 3, twice), twice(&items));
        assert!(in_parts(&[], 3, twice).is_empty());
    }

    #[test]
    fn each_of_both_gives_what_it_gives_alone() {
        for items in [1, LEAST] {
            let mut second = 0;
            assert_eq!(both(items, || 1, || second += 2), (1, ()));
            assert_eq!(second, 2);
        }
    }

    #[test]
    #[should_panic(expected = "of the first")]
    fn a_panic_of_the_first_is_one_of_the_whole() {
        both(LEAST, || panic!("of the first"), || 1);
    }

    #[test]
    #[should_panic(expected = "of the last item")]
    fn a_panic_of_a_part_is_one_of_the_whole() {
        divided(&[1, 2, 3], 1, |part| {
            assert_ne!(part, [3], "of the last item");
            part.to_vec()
        });
    }
}
