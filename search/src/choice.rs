//! Choices that come up while a scan is executed: it is executed again until all of them have been made.

#[derive(Clone, Debug, Default)]
pub struct Choices {
    /// What was chosen, and out of how many.
    made: Vec<(u32, u32)>,
    next: usize,
}

impl Choices {
    /// One of so many, from 0.
    pub fn take(&mut self, of: u32) -> u32 {
        if of <= 1 {
            return 0;
        }
        if self.next == self.made.len() {
            self.made.push((0, of));
        }
        let (chosen, _) = self.made[self.next];
        self.next += 1;
        chosen
    }

    /// How many have come up in this execution.
    pub fn count(&self) -> usize {
        self.next
    }

    /// What has come up so far, to go back there.
    pub fn mark(&self) -> (usize, usize) {
        (self.next, self.made.len())
    }

    /// As if what came up since had not.
    pub fn go_back(&mut self, (next, made): (usize, usize)) {
        self.next = next;
        self.made.truncate(made);
    }

    /// Before the first execution.
    pub fn clear(&mut self) {
        self.made.clear();
        self.next = 0;
    }

    /// Goes on to the next way; false if there is none.
    pub fn advance(&mut self) -> bool {
        self.next = 0;
        while let Some((chosen, of)) = self.made.last_mut() {
            if *chosen + 1 < *of {
                *chosen += 1;
                return true;
            }
            self.made.pop();
        }
        false
    }

    /// Whether there was anything to choose.
    pub fn is_empty(&self) -> bool {
        self.made.is_empty()
    }
}
