//! Inputs drawn by lot.

use autogen::device::panel;
use autogen::ir::System;
use runtime_sim::device::Direction;
use runtime_sim::random::Random;
use runtime_sim::scan::SystemInputs;

/// Inputs drawn by lot, of which some are beyond what a device may send: a line for each scan.
pub struct Lots {
    random: Random,
    pub images: Vec<Vec<f64>>,
    scan: u32,
    /// One in how many inputs changes when little happens, and one in how many commands is answered.
    calm: (u32, u32),
    /// Power is lost before one in so many scans; 0: never.
    losses: u32,
}

impl Lots {
    pub fn new(system: &System, seed: u64) -> Self {
        let words = |i: usize| system.automaton_of(i).device.words(Direction::Input, system.kinds());
        Self {
            random: Random::new(seed),
            images: (0..system.instances.len()).map(|i| vec![0.0; words(i)]).collect(),
            scan: 0,
            calm: (150, 60),
            losses: 150,
        }
    }

    /// Something happens always.
    pub fn lively(system: &System, seed: u64) -> Self {
        Self { calm: (20, 5), ..Self::new(system, seed) }
    }

    /// Power is never lost.
    pub fn powered(system: &System, seed: u64) -> Self {
        Self { losses: 0, ..Self::new(system, seed) }
    }

    fn one_in(&mut self, count: u32) -> bool {
        self.random.up_to(count - 1) == 0
    }

    fn word(&mut self) -> f64 {
        match self.random.up_to(40) {
            0 => f64::NAN,
            1 => f64::INFINITY,
            2 => -0.0,
            3 => -1e300,
            4 => 70_000.5,
            30..32 => -1.0,
            5..12 => 1.0,
            12..20 => f64::from(self.random.up_to(32_767)),
            20..26 => f64::from(self.random.up_to(12)),
            26..30 => f64::from(self.random.up_to(8000)) / 1000.0 - 4.0,
            _ => 0.0,
        }
    }

    /// Mostly enabled and automatic, or little would happen.
    fn panel(&mut self, system: &System, robot: usize) {
        let device = &system.automaton_of(robot).device;
        let [enable, mode] = [panel::ENABLE, panel::MODE].map(|port| device.offset(port, system.kinds()));
        if let Some(enable) = enable {
            self.images[robot][enable] = f64::from(u8::from(!self.one_in(40)));
        }
        if let Some(mode) = mode
            && self.one_in(20)
        {
            self.images[robot][mode] = if self.one_in(3) { f64::from(self.random.up_to(3)) } else { 0.0 };
        }
    }

    /// Whether power is lost before the next scan.
    pub fn powers_up(&mut self) -> bool {
        self.losses > 0 && self.one_in(self.losses)
    }

    /// Inputs of the next scan; devices often answer the command that they see in the outputs.
    pub fn next(&mut self, system: &System, outputs: &[Vec<f64>]) -> SystemInputs {
        // Times in which much happens take turns with others in which little does.
        self.scan += 1;
        let (changes, answers) = if (self.scan / 64).is_multiple_of(3) { (6, 2) } else { self.calm };
        for (robot, published) in outputs.iter().enumerate() {
            let device = &system.automaton_of(robot).device;
            for word in 0..self.images[robot].len() {
                if self.one_in(changes) {
                    self.images[robot][word] = self.word();
                }
            }
            self.panel(system, robot);
            if device.is_commanded() && self.one_in(answers) {
                let command = published.first().copied().unwrap_or(0.0);
                let error = if self.one_in(4) { 2.0 } else { 0.0 };
                for (port, value) in [("got", command), ("ack", command), ("error", error)] {
                    let at = device.offset(port, system.kinds()).expect("a commanded device");
                    self.images[robot][at] = value;
                }
            }
        }
        SystemInputs { run_permit: !self.one_in(60), start: self.one_in(3), reset: self.one_in(4) }
    }
}
