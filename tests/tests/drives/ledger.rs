//! What a controller has commanded, and what it was answered: the rules of commands hold in each scan.

/// What a controller writes in a scan.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Order {
    pub cmd: i32,
    pub verb: i32,
    pub arguments: [f64; 8],
    pub hold: bool,
}

/// What it reads in the next.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Answer {
    pub ready: bool,
    pub got: i32,
    pub ack: i32,
    pub error: i32,
}

/// The number behind the last one, by the rules of commands.
pub fn next_number(order: &Order, answer: Answer) -> i32 {
    let following = |number: i32| if number == 32767 { 1 } else { number + 1 };
    let mut number = following(order.cmd);
    while number == answer.got || number == answer.ack {
        number = following(number);
    }
    number
}

#[derive(Clone, Debug, Default)]
pub struct Ledger {
    cmd: i32,
    answer: Answer,
    /// The last number given since power-up of the block.
    last: i32,
    /// It has neither ended nor been replaced.
    is_open: bool,
    /// The link was lost, and no number was seen since.
    is_cut: bool,
}

impl Ledger {
    /// The scan with which the block begins: a number that is there has ended in error 6.
    pub fn power_up(&mut self, cmd: i32, answer: Answer) {
        let error = if cmd == 0 { 0 } else { 6 };
        assert_eq!((answer.got, answer.ack, answer.error), (cmd, cmd, error), "at power-up");
        *self = Self { cmd, answer, last: cmd, is_open: false, is_cut: false };
    }

    /// Any other scan; the error of the command that has ended in it.
    pub fn scan(&mut self, cmd: i32, answer: Answer) -> Option<i32> {
        let is_first = self.is_cut && cmd != 0;
        self.is_cut &= cmd == 0;
        let ended = self.answered(cmd, answer);
        assert!(!is_first || !self.is_open, "{cmd} is the first number after the link was lost");
        assert!(!is_first || ended.is_none_or(|error| error != 0), "{cmd} ended well, seen after the link");
        ended
    }

    /// A scan without the link: a command under way may end, and no other is seen.
    pub fn scan_without_link(&mut self, answer: Answer) -> Option<i32> {
        self.is_cut = true;
        self.answered(self.last, answer)
    }

    fn answered(&mut self, cmd: i32, answer: Answer) -> Option<i32> {
        if cmd != 0 && cmd != self.last {
            self.last = cmd;
            self.is_open = true;
        }
        let before = std::mem::replace(&mut self.answer, answer);
        self.cmd = cmd;
        assert_eq!(answer.got, self.last, "got is the last number given");
        if answer.ack == before.ack {
            assert_eq!(answer.error, before.error, "error is constant while ack is");
            assert!(cmd != 0 || !self.is_open, "{} was withdrawn and has not ended", self.last);
            return None;
        }
        assert_eq!(answer.ack, self.last, "only the last number ends");
        assert!(self.is_open, "{} ends a second time", answer.ack);
        self.is_open = false;
        Some(answer.error)
    }

    pub fn is_open(&self) -> bool {
        self.is_open
    }
}
