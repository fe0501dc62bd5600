//! `FB_AxisDrive` over motion blocks by PLCopen, and an axis that they move.

use super::course::{self, Drive, Surroundings, chance};
use super::ledger::{Answer, Order};
use super::program::machine;
use super::told::Told;
use autogen_st_judge::machine::Machine;
use runtime_sim::random::Random;

const SCAN_S: f64 = 0.01;
/// Of the drive, when it stops by itself.
const OWN_DECELERATION: f64 = 2.0;

pub struct Axis {
    machine: Machine,
    position: f64,
    velocity: f64,
    has_fault: bool,
    /// Scans from enable to power.
    power_scans: u32,
    enabled_scans: u32,
}

impl Axis {
    fn new(power_scans: u32) -> Self {
        Self {
            machine: machine("Lift_wiring"),
            position: 0.0,
            velocity: 0.0,
            has_fault: false,
            power_scans,
            enabled_scans: 0,
        }
    }

    fn set(&mut self, name: &str, value: impl Into<f64>) {
        self.machine.set(name, value.into());
    }

    /// What the motion blocks have asked for, for one scan.
    fn move_on(&mut self, bus_ok: bool) {
        if self.machine.get("motor_reset[0]") != 0.0 {
            self.set("motor_reset[0]", false);
            self.set("motor_halt_fails[0]", false);
            self.has_fault = false;
        }
        let is_enabled = bus_ok && !self.has_fault && self.machine.get("motor_enable[0]") != 0.0;
        let was_powered = self.enabled_scans > self.power_scans;
        // It gets power at rest only.
        let goes_on = is_enabled && (was_powered || self.velocity == 0.0);
        self.enabled_scans = if goes_on { self.enabled_scans + 1 } else { 0 };
        let is_powered = self.enabled_scans > self.power_scans;
        if !is_powered {
            self.set("motor_mode[0]", 0);
        }
        match self.machine.get("motor_mode[0]") as i32 {
            1 => self.approach(),
            2 => self.brake(self.machine.get("motor_deceleration[0]")),
            _ if !is_powered => self.brake(OWN_DECELERATION),
            _ => assert!(self.velocity == 0.0, "a motion ends at rest"),
        }
        if self.machine.get("motor_mode[0]") == 2.0 && self.velocity == 0.0 {
            self.set("motor_mode[0]", 0);
        }
        self.position += self.velocity * SCAN_S;
        self.set("motor_powered[0]", is_powered);
        self.set("motor_fault[0]", self.has_fault);
        self.set("motor_position[0]", self.position);
    }

    /// Another block takes the axis over.
    fn is_taken_over(&mut self) {
        let motion = self.machine.get("motor_motion[0]");
        self.set("motor_motion[0]", motion + 1.0);
    }

    /// Another block stops the axis, and holds it in the state Stopping.
    fn is_stopped(&mut self) {
        self.is_taken_over();
        self.set("motor_stopping[0]", true);
        self.brakes_by_itself();
    }

    fn brakes_by_itself(&mut self) {
        self.set("motor_mode[0]", 2);
        self.set("motor_deceleration[0]", OWN_DECELERATION);
    }

    fn is_enabled(&self) -> bool {
        self.machine.get("motor_enable[0]") != 0.0
    }

    fn halt_failed(&self) -> bool {
        self.machine.get("lift_halt_failed") != 0.0
    }

    fn brake(&mut self, deceleration: f64) {
        let least = (self.velocity.abs() - deceleration * SCAN_S).max(0.0);
        self.velocity = self.velocity.signum() * least;
    }

    fn approach(&mut self) {
        let target = self.machine.get("motor_target[0]");
        let acceleration = self.machine.get("motor_acceleration[0]");
        let rest = target - self.position;
        let step = acceleration * SCAN_S;
        if rest.abs() <= self.velocity.abs() * SCAN_S + 1e-6 && self.velocity.abs() <= 2.0 * step {
            self.position = target;
            self.velocity = 0.0;
            self.set("motor_mode[0]", 0);
            return;
        }
        let wanted = (2.0 * acceleration * rest.abs()).sqrt().min(self.machine.get("motor_velocity[0]"));
        let wanted = wanted.min(rest.abs() / SCAN_S).copysign(rest);
        self.velocity = wanted.clamp(self.velocity - step, self.velocity + step);
    }
}

impl Drive for Axis {
    fn drawn(random: &mut Random) -> Self {
        Self::new(random.up_to(20))
    }

    fn plain() -> Self {
        Self::new(0)
    }

    fn scan(&mut self, order: &Order, around: Surroundings) -> Answer {
        self.set("lift_cmd", order.cmd);
        self.set("lift_verb", order.verb);
        self.set("lift_goal", order.arguments[0]);
        self.set("lift_hold", order.hold);
        self.set("lift_link_ok", around.link_ok);
        self.set("lift_enable", around.enable);
        self.set("lift_bus_ok", around.bus_ok);
        self.set("lift_reset", around.reset);
        self.machine.scan().expect("a scan");
        assert_eq!(self.machine.get("motor_halt_wrong[0]"), 0.0, "1: in a wrong state, 2: left early");
        self.move_on(around.bus_ok);
        let whole = |name: &str| self.machine.get(name) as i32;
        Answer {
            ready: whole("lift_ready") != 0,
            got: whole("lift_got"),
            ack: whole("lift_ack"),
            error: whole("lift_error"),
        }
    }

    /// The motion blocks lose their memory too, and the axis its power.
    fn power_up(&mut self) {
        self.machine = machine("Lift_wiring");
        self.enabled_scans = 0;
        self.set("motor_position[0]", self.position);
        self.set("motor_fault[0]", self.has_fault);
    }

    fn fault(&mut self) {
        self.has_fault = true;
        self.set("motor_fault[0]", true);
        self.brakes_by_itself();
    }

    fn speed(&self) -> f64 {
        self.velocity.abs()
    }

    fn has_reached(&self, order: &Order) -> bool {
        (self.position - order.arguments[0]).abs() < 1e-9 && self.velocity == 0.0
    }

    /// An error is answered in a scan, and the halt follows in the next.
    fn latency(&self) -> u32 {
        2
    }

    fn round_trip(&self) -> u32 {
        2
    }

    fn command(random: &mut Random) -> (i32, [f64; 8]) {
        let verb = if chance(random, 30) { 2 } else { 1 };
        let goal = match random.up_to(60) {
            0 => 2.0,
            1 => f64::NAN,
            _ => f64::from(random.up_to(1200)) / 1000.0,
        };
        (verb, [goal, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    fn far(number: i32) -> (i32, [f64; 8]) {
        (1, [if number % 2 == 0 { 0.1 } else { 1.0 }, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0])
    }

    const BRAKING: u32 = 51;
    const PATIENCE: u32 = 400;
}

#[test]
fn commands_at_any_time_are_carried_out_by_the_rules() {
    let ends = course::campaign::<Axis>();
    assert!([0, 1, 3, 4, 5, 6].iter().all(|error| ends[error] > 20), "{ends:?}");
}

/// On its way.
fn moving() -> Told<Axis> {
    let mut told = Told::<Axis>::new();
    told.give_far();
    told.scans(50);
    assert!(told.drive.speed() > 0.0);
    told
}

/// An axis that another block has taken over: the command has ended, and the axis is being halted.
fn taken_over() -> Told<Axis> {
    let mut told = moving();
    told.drive.is_taken_over();
    assert_eq!(told.end(), 4);
    told
}

#[test]
fn who_else_moves_the_axis_ends_the_command_and_the_axis_is_halted() {
    let mut told = taken_over();
    told.scans(60);
    assert_eq!(told.drive.speed(), 0.0);
}

#[test]
fn a_number_after_an_error_ends_in_an_error_and_is_not_carried_out_late() {
    // While it is halted, and later.
    for before in [0, 1, 10, 100] {
        let mut told = taken_over();
        told.scans(before);
        assert!(!told.answer.ready);
        told.give_far();
        assert_eq!((told.answer.got, told.answer.ack, told.answer.error), (2, 2, 4));
        told.scans(60);
        told.rests(100);
        told.order.hold = true;
        told.rests(1);
        told.order.hold = false;
        told.rests(100);
        told.goes_on();
    }
}

#[test]
fn hold_before_the_halt_has_ended_does_not_end_an_error() {
    let mut told = taken_over();
    told.order.hold = true;
    told.scans(10);
    assert!(told.drive.speed() > 0.0);
    told.order.hold = false;
    told.scans(60);
    told.give_far();
    assert_eq!(told.end(), 4);
}

#[test]
fn a_reset_ends_an_error() {
    let mut told = taken_over();
    told.scans(60);
    told.press_reset();
    assert!(told.answer.ready);
    told.goes_on();
}

#[test]
fn a_reset_that_failed_does_not_end_an_error() {
    let mut told = taken_over();
    told.scans(60);
    told.drive.set("motor_reset_fails[0]", true);
    told.press_reset();
    told.give_far();
    assert_eq!(told.end(), 4);
}

#[test]
fn a_reset_before_the_error_does_not_end_it() {
    let mut told = moving();
    told.press_reset();
    assert!(told.drive.speed() > 0.0);
    told.drive.is_taken_over();
    assert_eq!(told.end(), 4);
    told.scans(60);
    told.give_far();
    assert_eq!(told.end(), 4);
}

#[test]
fn power_that_comes_back_does_not_end_an_error() {
    let mut told = moving();
    told.around.enable = false;
    assert_eq!(told.end(), 4);
    told.order.hold = true;
    told.scans(60);
    told.order.hold = false;
    told.around.enable = true;
    told.rests(60);
    told.give_far();
    assert_eq!(told.end(), 4);
    told.rests(60);
    told.order.hold = true;
    told.rests(1);
    told.order.hold = false;
    told.goes_on();
}

#[test]
fn a_halt_is_carried_out_to_its_end() {
    let mut told = moving();
    told.order.hold = true;
    told.scans(1);
    told.order.hold = false;
    let slows = (0..60).take_while(|_| {
        let before = told.drive.speed();
        told.scans(1);
        told.drive.speed() < before
    });
    assert!(slows.count() > 10);
    assert_eq!(told.drive.speed(), 0.0);
    assert_eq!(told.end(), 0);
}

#[test]
fn a_number_during_a_halt_waits_for_its_end() {
    let mut told = moving();
    told.order.hold = true;
    told.scans(1);
    told.order.hold = false;
    told.give_far();
    assert_eq!((told.end(), told.answer.ack), (0, 2));
}

#[test]
fn a_halt_that_fails_takes_the_power_away_until_reset() {
    let mut told = moving();
    told.drive.set("motor_halt_fails[0]", true);
    told.order.hold = true;
    told.scans(60);
    assert_eq!((told.drive.is_enabled(), told.drive.halt_failed()), (false, true));
    assert_eq!((told.drive.speed(), told.answer.ack, told.answer.error), (0.0, told.order.cmd, 4));
    told.order.hold = false;
    told.scans(60);
    assert!(!told.answer.ready);
    told.press_reset();
    assert_eq!((told.drive.is_enabled(), told.drive.halt_failed()), (true, false));
    assert!(told.answer.ready && told.drive.speed() == 0.0);
    told.goes_on();
}

#[test]
fn a_button_that_is_held_gives_no_power_after_a_halt_that_failed() {
    let mut told = moving();
    told.around.reset = true;
    told.scans(5);
    told.drive.set("motor_halt_fails[0]", true);
    told.order.hold = true;
    told.scans(200);
    assert_eq!((told.drive.is_enabled(), told.drive.halt_failed()), (false, true));
    told.around.reset = false;
    told.scans(20);
    assert_eq!((told.drive.is_enabled(), told.drive.halt_failed()), (false, true));
    told.press_reset();
    assert_eq!((told.drive.is_enabled(), told.drive.halt_failed()), (true, false));
}

#[test]
fn a_button_that_is_pressed_without_the_fieldbus_resets_nothing_when_it_is_back() {
    let mut told = moving();
    told.drive.fault();
    told.around.bus_ok = false;
    told.scans(20);
    told.press_reset();
    told.around.bus_ok = true;
    told.scans(60);
    assert!(told.drive.has_fault);
    told.press_reset();
    assert!(!told.drive.has_fault && told.answer.ready);
}

#[test]
fn an_axis_that_another_block_stops_is_not_halted_and_not_ready() {
    let mut told = moving();
    told.drive.is_stopped();
    assert_eq!(told.end(), 4);
    told.scans(60);
    assert!(!told.answer.ready && told.drive.speed() == 0.0);
    told.order.hold = true;
    told.rests(20);
    assert!(!told.answer.ready);
    told.drive.set("motor_stopping[0]", false);
    told.rests(1);
    assert!(told.answer.ready && !told.drive.halt_failed());
    told.order.hold = false;
    told.goes_on();
}

#[test]
fn an_axis_in_error_stop_is_not_halted() {
    let mut told = moving();
    told.drive.fault();
    assert_eq!(told.end(), 4);
    told.scans(60);
    assert!(told.drive.is_enabled() && !told.drive.halt_failed());
}

#[test]
fn a_halt_that_ends_in_a_fault_has_not_failed() {
    let mut told = moving();
    told.order.hold = true;
    told.scans(5);
    told.drive.fault();
    told.scans(60);
    assert!(told.drive.is_enabled() && !told.drive.halt_failed());
    assert_eq!((told.answer.ready, told.answer.ack, told.answer.error), (false, told.order.cmd, 4));
}

#[test]
fn a_halt_that_another_block_breaks_off_ends_the_command() {
    let mut told = moving();
    told.order.hold = true;
    told.scans(5);
    told.drive.is_taken_over();
    assert_eq!(told.end(), 4);
    assert!(!told.answer.ready && !told.drive.halt_failed());
}

#[test]
fn a_button_that_is_held_at_power_up_resets_nothing() {
    let mut told = moving();
    told.drive.fault();
    told.scans(60);
    told.drive.power_up();
    told.around.reset = true;
    told.order.cmd = 0;
    (0..60).for_each(|_| {
        told.drive.scan(&told.order, told.around);
    });
    assert!(told.drive.has_fault);
}

#[test]
fn a_goal_that_is_not_a_number_is_refused() {
    for goal in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY, -0.001, 1.201] {
        let mut told = Told::<Axis>::new();
        told.give(1, [goal, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        assert_eq!(told.end(), 1, "{goal}");
        told.rests(20);
        told.goes_on();
    }
}

#[test]
fn an_axis_that_lost_its_power_is_not_halted() {
    let mut told = moving();
    told.drive.set("motor_powered[0]", false);
    assert_eq!(told.end(), 4);
    told.scans(60);
    assert!(!told.answer.ready && !told.drive.halt_failed());
}

#[test]
fn a_lost_link_does_not_end_an_error() {
    let mut told = taken_over();
    told.scans(60);
    told.around.link_ok = false;
    told.rests(20);
    told.around.link_ok = true;
    told.give_far();
    assert_eq!(told.end(), 5);
    told.give_far();
    assert_eq!(told.end(), 4);
}
