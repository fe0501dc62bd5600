//! What the machines do in a run, booked when it changes.

use crate::account::{Account, Activity};
use crate::line::Line;

#[derive(Clone)]
pub struct Accounts<'a> {
    line: &'a Line,
    accounts: Vec<Account>,
    /// What each machine does now, and the scan since which that is not booked.
    present: Vec<(Activity, u64)>,
}

impl<'a> Accounts<'a> {
    pub fn new(line: &'a Line) -> Self {
        let machines = line.machines.len();
        Self {
            line,
            accounts: vec![Account::new(line); machines],
            present: vec![(Activity::Stopped, 0); machines],
        }
    }

    /// From this scan on a machine does this.
    pub fn note(&mut self, machine: usize, activity: Activity, scan: u64) {
        if self.present[machine].0 != activity {
            self.book(machine, scan);
            self.present[machine] = (activity, scan);
        }
    }

    fn book(&mut self, machine: usize, scan: u64) {
        let (activity, since) = self.present[machine];
        self.accounts[machine].book(self.line, machine, activity, scan - since);
    }

    /// All scans before this one, by machine.
    pub fn until(mut self, scan: u64) -> Vec<Account> {
        (0..self.accounts.len()).for_each(|machine| self.book(machine, scan));
        self.accounts
    }
}
