//! A telegram on its way: it arrives some scans later.

use std::collections::VecDeque;

#[derive(Clone, Debug)]
pub struct Wire<T> {
    under_way: VecDeque<T>,
    /// What the receiver has.
    received: T,
    scans: usize,
}

impl<T: Clone> Wire<T> {
    pub fn new(scans: usize, first: T) -> Self {
        Self { under_way: VecDeque::new(), received: first, scans }
    }

    /// Sends a telegram in this scan, and gives the one that has arrived.
    pub fn pass(&mut self, telegram: T) -> T {
        self.under_way.push_back(telegram);
        if self.under_way.len() > self.scans {
            self.received = self.under_way.pop_front().expect("at least the one that was sent");
        }
        self.received.clone()
    }

    /// Nothing gets through: what is under way is lost, and the receiver keeps what it has.
    pub fn is_cut(&mut self) -> T {
        self.under_way.clear();
        self.received.clone()
    }

    /// The receiver sees this instead of what it had.
    pub fn blank(&mut self, telegram: T) {
        self.received = telegram;
    }
}
