//! The controllers as the simulator uses them.

use adapters::layout::{Layout, alarm, latch, publish};
use adapters::read::Reader;
use controllers::system::{self, System};
use runtime_sim::line::Line;
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};

/// The controllers of a layout, and their system.
pub struct Deployed {
    layout: Layout,
    system: System,
}

impl Deployed {
    /// With the layout for which the controllers were made.
    pub fn compiled() -> Self {
        Self { layout: Layout::compiled(), system: System::new() }
    }

    /// With a layout from text.
    pub fn read(text: &str) -> Result<Self, String> {
        Ok(Self { layout: Layout::read(&mut Reader::new(text))?, system: System::new() })
    }

    /// If there is a robot for each machine of the line.
    pub fn of(self, line: &Line) -> Result<Self, String> {
        match self.robots() == line.machines.len() {
            true => Ok(self),
            false => Err(format!("{} robots for {} machines", self.robots(), line.machines.len())),
        }
    }

    pub fn robots(&self) -> usize {
        self.layout.robots.len()
    }
}

impl Controllers for Deployed {
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        for (robot, image) in self.layout.robots.iter_mut().zip(inputs) {
            latch(robot, image);
        }
        let SystemInputs { run_permit, start, reset } = system;
        let answer = self.layout.scan(&mut self.system, system::SystemInputs { run_permit, start, reset });
        for (robot, image) in self.layout.robots.iter().zip(outputs) {
            publish(robot, answer.running, image);
        }
        let (alarm, alarm_code, alarm_robot) = alarm(&answer);
        let system::SystemOutputs { running, fault, fault_code, fault_robot, .. } = answer;
        SystemOutputs { running, fault, fault_code, fault_robot, alarm, alarm_code, alarm_robot }
    }

    fn power_up(&mut self) {
        self.layout.power_up(&mut self.system);
    }

    fn state(&self, machine: usize) -> usize {
        self.layout.robots[machine].state()
    }

    fn trace(&self, out: &mut Vec<f64>) {
        self.layout.trace(out);
    }

    fn stays(&self) -> Vec<usize> {
        self.layout.stays()
    }

    fn skip(&mut self, scans: u64) {
        self.layout.skip(&mut self.system, scans);
    }
}
