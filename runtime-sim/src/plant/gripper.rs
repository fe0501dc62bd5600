//! A vacuum gripper.

/// How often it looks for contact.
const POLL_MS: u64 = 100;
/// Polls in a row with contact before a part is attached.
const POLLS: u32 = 2;
/// Contact is a tool no farther than this from where a part is gripped, in metres.
pub const CONTACT: f64 = 0.005;

#[derive(Clone, Debug)]
pub struct Gripper {
    vacuum: Vacuum,
    polls: u32,
    held: Option<usize>,
    /// Parts attached so far.
    picks: u32,
    slips: Vec<Slip>,
    loses_at_ms: Option<u64>,
}

/// The part number `pick`, from 1, falls so long after it was attached.
#[derive(Clone, Copy, Debug)]
pub struct Slip {
    pub pick: u32,
    pub after_ms: u64,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Vacuum {
    On,
    Off,
}

impl Gripper {
    pub fn new(slips: Vec<Slip>) -> Self {
        Self { vacuum: Vacuum::Off, polls: 0, held: None, picks: 0, slips, loses_at_ms: None }
    }

    pub fn held(&self) -> Option<usize> {
        self.held
    }

    /// What it holds is going to slip.
    pub fn is_slipping(&self) -> bool {
        self.loses_at_ms.is_some()
    }

    /// Sets the vacuum; the item that is let go by that.
    pub fn switch(&mut self, grip: f64) -> Option<usize> {
        if grip != 0.0 {
            self.vacuum = Vacuum::On;
            return None;
        }
        self.vacuum = Vacuum::Off;
        self.polls = 0;
        self.lose()
    }

    /// The item that slips by this time.
    pub fn slip(&mut self, now_ms: u64) -> Option<usize> {
        let due = self.loses_at_ms?;
        if now_ms < due {
            return None;
        }
        self.lose()
    }

    /// Whether it looks for contact between these times.
    pub fn is_polled(&self, before_ms: u64, now_ms: u64) -> bool {
        self.vacuum == Vacuum::On && self.held.is_none() && before_ms / POLL_MS != now_ms / POLL_MS
    }

    /// Takes the outcome of the polls between these times; the item that is attached by them.
    pub fn poll(&mut self, contact: Option<usize>, before_ms: u64, now_ms: u64) -> Option<usize> {
        let Some(item) = contact else {
            self.polls = 0;
            return None;
        };
        let polls = now_ms / POLL_MS - before_ms / POLL_MS;
        self.polls = self.polls.saturating_add(u32::try_from(polls).unwrap_or(POLLS));
        if self.polls < POLLS {
            return None;
        }
        self.polls = 0;
        self.held = Some(item);
        self.picks = self.picks.saturating_add(1);
        self.loses_at_ms =
            self.slips.iter().find(|slip| slip.pick == self.picks).map(|slip| now_ms + slip.after_ms);
        self.held
    }

    fn lose(&mut self) -> Option<usize> {
        self.loses_at_ms = None;
        self.held.take()
    }
}
