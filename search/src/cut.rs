//! Where the expansion of a state ends that has more successors than there is time or memory for.

use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::time::Instant;

/// What all expanders of a search have in common.
#[derive(Debug)]
pub(crate) struct Cut {
    until: Option<Instant>,
    /// Bytes that what follows some states may take.
    memory: AtomicUsize,
    is_late: AtomicBool,
    is_full: AtomicBool,
}

/// Why an expansion was cut.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Because {
    OfTime,
    OfMemory,
}

impl Cut {
    pub fn new(until: Option<Instant>) -> Arc<Self> {
        let cut = Self {
            until,
            memory: AtomicUsize::new(usize::MAX),
            is_late: AtomicBool::new(false),
            is_full: AtomicBool::new(false),
        };
        Arc::new(cut)
    }

    pub fn because(&self) -> Option<Because> {
        if self.is_late.load(Ordering::Relaxed) {
            Some(Because::OfTime)
        } else {
            self.is_full.load(Ordering::Relaxed).then_some(Because::OfMemory)
        }
    }

    pub fn look_at_the_clock(&self) {
        if self.until.is_some_and(|until| Instant::now() > until) {
            self.is_late.store(true, Ordering::Relaxed);
        }
    }

    pub fn allow(&self, memory: usize) {
        self.memory.store(memory, Ordering::Relaxed);
    }

    /// What follows some states takes so many bytes.
    pub fn takes(&self, memory: usize) {
        if memory > self.memory.load(Ordering::Relaxed) {
            self.is_full.store(true, Ordering::Relaxed);
        }
    }
}
