//! Stories: what happens to a drive, one thing after the other.

use super::axis::Axis;
use super::course::{Drive, Surroundings};
use super::inverter::Inverter;
use super::ledger::{Answer, Ledger, Order, next_number};
use super::robot::Robot;

pub struct Told<D> {
    pub drive: D,
    pub order: Order,
    pub around: Surroundings,
    pub answer: Answer,
    ledger: Ledger,
}

impl<D: Drive> Told<D> {
    /// Ready for a command.
    pub fn new() -> Self {
        let mut told = Self::begun(Order { hold: true, ..Order::default() });
        told.scans(20);
        told.order.hold = false;
        assert!(told.answer.ready && told.drive.speed() == 0.0);
        told
    }

    /// After the first scan, with what the controller shows in it.
    fn begun(order: Order) -> Self {
        let mut drive = D::plain();
        let answer = drive.scan(&order, Surroundings::QUIET);
        let mut ledger = Ledger::default();
        ledger.power_up(order.cmd, answer);
        Self { drive, order, around: Surroundings::QUIET, answer, ledger }
    }

    fn scan(&mut self) {
        self.answer = self.drive.scan(&self.order, self.around);
        match self.around.link_ok {
            true => self.ledger.scan(self.order.cmd, self.answer),
            false => self.ledger.scan_without_link(self.answer),
        };
    }

    pub fn scans(&mut self, count: u32) {
        (0..count).for_each(|_| self.scan());
    }

    /// A command that takes some time.
    pub fn give_far(&mut self) {
        let (verb, arguments) = D::far(next_number(&self.order, self.answer));
        self.give(verb, arguments);
    }

    pub fn give(&mut self, verb: i32, arguments: [f64; 8]) {
        self.order = Order { cmd: next_number(&self.order, self.answer), verb, arguments, ..self.order };
        self.scan();
    }

    /// The error in which the command ends.
    pub fn end(&mut self) -> i32 {
        let rest = (0..D::PATIENCE).find(|_| {
            let is_open = self.ledger.is_open();
            if is_open {
                self.scan();
            }
            !is_open
        });
        assert!(rest.is_some(), "has not ended: {:?} {:?}", self.order, self.answer);
        assert!(self.answer.error != 0 || self.drive.has_reached(&self.order));
        self.answer.error
    }

    pub fn press_reset(&mut self) {
        self.around.reset = true;
        self.scans(20);
        self.around.reset = false;
        self.scans(20);
    }

    pub fn rests(&mut self, scans: u32) {
        for _ in 0..scans {
            self.scan();
            assert!(self.drive.speed() == 0.0, "moves: {:?} {:?}", self.order, self.answer);
        }
    }

    /// A new number is all that it needs.
    pub fn goes_on(&mut self) {
        self.give_far();
        assert_eq!(self.end(), 0);
    }
}

/// Once for each drive.
macro_rules! of_each_drive {
    ($($name:ident)*) => {
        $(#[test]
        fn $name() {
            each::$name::<Axis>();
            each::$name::<Robot>();
            each::$name::<Inverter>();
        })*
    };
}

of_each_drive! {
    a_command_comes_to_its_end
    a_number_from_before_power_up_is_not_carried_out
    hold_halts_and_the_same_command_goes_on
    a_command_under_hold_waits
    a_new_number_replaces_the_command
    arguments_without_a_new_number_are_not_taken
    a_fault_ends_the_command_and_stays_until_reset
    a_button_that_is_held_resets_nothing
    a_lost_fieldbus_ends_the_command
    without_the_link_a_command_is_held_and_ends_in_an_error_behind_it
    the_first_number_after_the_link_was_lost_is_not_carried_out
    a_number_after_a_blank_one_is_the_first_after_the_link_was_lost
    a_block_without_a_link_carries_out_nothing
    a_withdrawn_number_ends_the_command
    numbers_go_on_with_1
}

mod each {
    use super::*;

    pub fn a_command_comes_to_its_end<D: Drive>() {
        let mut told = Told::<D>::new();
        for _ in 0..3 {
            told.give_far();
            assert_eq!((told.answer.got, told.answer.ack), (told.order.cmd, told.order.cmd - 1));
            assert_eq!(told.end(), 0);
        }
    }

    pub fn a_number_from_before_power_up_is_not_carried_out<D: Drive>() {
        let (verb, arguments) = D::far(17);
        let mut told = Told::<D>::begun(Order { cmd: 17, verb, arguments, hold: false });
        assert_eq!((told.answer.got, told.answer.ack, told.answer.error), (17, 17, 6));
        told.rests(200);
        told.order.hold = true;
        told.rests(20);
        told.order.hold = false;
        told.rests(200);
        told.goes_on();
    }

    pub fn hold_halts_and_the_same_command_goes_on<D: Drive>() {
        for before in [1, 5, 10, 25] {
            let mut told = Told::<D>::new();
            told.give_far();
            told.scans(before);
            told.order.hold = true;
            told.scans(D::BRAKING + 3);
            told.rests(100);
            assert_eq!(told.answer.ack, 0);
            told.order.hold = false;
            assert_eq!(told.end(), 0);
        }
    }

    pub fn a_command_under_hold_waits<D: Drive>() {
        let mut told = Told::<D>::new();
        told.order.hold = true;
        told.give_far();
        told.rests(100);
        told.order.hold = false;
        assert_eq!(told.end(), 0);
    }

    pub fn a_new_number_replaces_the_command<D: Drive>() {
        for before in [0, 1, 2, 3, 20] {
            let mut told = Told::<D>::new();
            told.give_far();
            told.scans(before);
            assert_eq!(told.answer.ack, 0);
            told.give_far();
            assert_eq!((told.end(), told.answer.ack), (0, 2));
        }
    }

    pub fn arguments_without_a_new_number_are_not_taken<D: Drive>() {
        let mut told = Told::<D>::new();
        told.give_far();
        told.scans(20);
        // The robot takes it when the one before has been left.
        told.give_far();
        let given = told.order.clone();
        (_, told.order.arguments) = D::far(given.cmd + 1);
        told.order.verb = 9;
        while told.answer.ack != given.cmd {
            told.scan();
        }
        assert!(told.answer.error == 0 && told.drive.has_reached(&given));
        told.scans(50);
        assert!(told.drive.has_reached(&given));
    }

    pub fn a_fault_ends_the_command_and_stays_until_reset<D: Drive>() {
        let mut told = Told::<D>::new();
        told.give_far();
        told.scans(20);
        told.drive.fault();
        assert_eq!(told.end(), 4);
        told.scans(D::BRAKING + 3);
        told.rests(100);
        told.give_far();
        assert_eq!(told.end(), 4);
        told.press_reset();
        told.rests(100);
        assert!(told.answer.ready);
        told.goes_on();
    }

    pub fn a_button_that_is_held_resets_nothing<D: Drive>() {
        let mut told = Told::<D>::new();
        told.around.reset = true;
        told.scans(20);
        told.drive.fault();
        told.scans(200);
        assert!(!told.answer.ready);
        told.around.reset = false;
        told.scans(20);
        assert!(!told.answer.ready);
        told.press_reset();
        assert!(told.answer.ready);
    }

    pub fn a_lost_fieldbus_ends_the_command<D: Drive>() {
        let mut told = Told::<D>::new();
        told.give_far();
        told.scans(20);
        told.around.bus_ok = false;
        told.scan();
        assert_eq!((told.answer.ack, told.answer.error), (told.order.cmd, 5));
        told.scans(D::BRAKING + 3);
        told.give_far();
        assert_eq!(told.end(), 5);
        told.around.bus_ok = true;
        told.rests(100);
        told.press_reset();
        told.rests(100);
        told.goes_on();
    }

    pub fn without_the_link_a_command_is_held_and_ends_in_an_error_behind_it<D: Drive>() {
        let mut told = Told::<D>::new();
        told.give_far();
        told.scans(20);
        told.around.link_ok = false;
        told.scans(D::BRAKING + 3);
        // What is not seen is not withdrawn.
        told.order.cmd = 0;
        told.rests(100);
        assert_eq!((told.answer.ready, told.answer.got, told.answer.ack), (false, 1, 0));
        told.order.cmd = 1;
        told.around.link_ok = true;
        told.scan();
        assert_eq!((told.answer.ready, told.answer.ack, told.answer.error), (true, 1, 5));
        told.rests(100);
        told.goes_on();
    }

    pub fn the_first_number_after_the_link_was_lost_is_not_carried_out<D: Drive>() {
        for before in [0, 1, 30] {
            let mut told = Told::<D>::new();
            told.goes_on();
            told.around.link_ok = false;
            told.scans(D::BRAKING + 3);
            // What has been commanded meanwhile is seen when the link is back, or later.
            told.give_far();
            assert_eq!((told.answer.got, told.answer.ack), (1, 1));
            let given = std::mem::replace(&mut told.order.cmd, 0);
            told.around.link_ok = true;
            told.scans(before);
            told.order.cmd = given;
            told.scan();
            assert_eq!((told.answer.got, told.answer.ack, told.answer.error), (2, 2, 5));
            told.rests(200);
            told.goes_on();
        }
    }

    pub fn a_number_after_a_blank_one_is_the_first_after_the_link_was_lost<D: Drive>() {
        let mut told = Told::<D>::new();
        told.give_far();
        told.scans(20);
        told.around.link_ok = false;
        told.scans(D::BRAKING + 3);
        told.around.link_ok = true;
        told.order.cmd = 0;
        told.scan();
        assert_eq!((told.answer.ack, told.answer.error), (1, 6));
        told.order.cmd = 2;
        told.scan();
        assert_eq!((told.answer.ack, told.answer.error), (2, 5));
        told.rests(200);
        told.goes_on();
    }

    pub fn a_block_without_a_link_carries_out_nothing<D: Drive>() {
        let mut told = Told::<D>::new();
        told.around.link_ok = false;
        for _ in 0..3 {
            told.give_far();
            told.rests(50);
        }
        assert_eq!((told.answer.ready, told.answer.got, told.answer.ack), (false, 0, 0));
    }

    pub fn a_withdrawn_number_ends_the_command<D: Drive>() {
        let mut told = Told::<D>::new();
        told.give_far();
        told.scans(20);
        told.order.cmd = 0;
        told.scan();
        assert_eq!((told.answer.ack, told.answer.error), (1, 6));
        told.scans(D::BRAKING + 3);
        told.order.cmd = 1;
        told.rests(100);
        told.goes_on();
    }

    pub fn numbers_go_on_with_1<D: Drive>() {
        let mut told = Told::<D>::begun(Order { cmd: 32765, hold: true, ..Order::default() });
        told.scans(20);
        told.order.hold = false;
        let numbers = [32766, 32767, 1, 2].map(|_| {
            told.goes_on();
            told.answer.ack
        });
        assert_eq!(numbers, [32766, 32767, 1, 2]);
    }
}
