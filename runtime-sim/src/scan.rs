//! Where the simulator meets the controllers.

/// Inputs of the system as a whole.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SystemInputs {
    /// False while the emergency stop has acted or the fieldbus is lost.
    pub run_permit: bool,
    /// Acts on its rising edge.
    pub start: bool,
    pub reset: bool,
}

/// Outputs of the system as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct SystemOutputs {
    pub running: bool,
    pub fault: bool,
    pub fault_code: i32,
    /// Machine that raised the fault, -1 if none did.
    pub fault_robot: i32,
    /// An alarm is active, or not acknowledged.
    pub alarm: bool,
    /// Of the alarms that are not acknowledged, the one that was raised first; 0 if there is none.
    pub alarm_code: i32,
    /// Machine of that alarm, -1 if there is none.
    pub alarm_robot: i32,
}

impl Default for SystemOutputs {
    /// At rest: not running, no fault, no alarm.
    fn default() -> Self {
        Self {
            running: false,
            fault: false,
            fault_code: 0,
            fault_robot: -1,
            alarm: false,
            alarm_code: 0,
            alarm_robot: -1,
        }
    }
}

/// The controllers of all machines of a line, stepped together.
pub trait Controllers {
    /// One scan. `inputs` and `outputs` hold an image for each machine in layout order, laid out as
    /// [`crate::device`] says; `outputs` keep their values from scan to scan and are published as they
    /// stand on return, so they bear the stop values while the system does not run.
    fn scan(&mut self, system: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs;

    /// Number of the state in which the automaton of this machine is.
    fn state(&self, machine: usize) -> usize;

    /// Appends all that the controllers remember, so that two engines can be compared scan by scan.
    fn trace(&self, out: &mut Vec<f64>);

    /// For each machine, which number of the trace is the time in its present state, ms.
    fn stays(&self) -> Vec<usize>;

    /// So many scans pass without power; then [`Self::power_up`] follows, unless the run ends. Only who counts scans has to
    /// know.
    fn lose_power(&mut self, _scans: u64) {}

    /// Power was lost after the last scan, and is back before the next: retained values are kept, all others are the initial ones.
    fn power_up(&mut self);

    /// So many scans pass in which nothing happens: while the system runs, times in states continue, and nothing else.
    fn skip(&mut self, scans: u64);
}
