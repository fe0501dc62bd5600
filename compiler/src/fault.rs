//! Faults of a run, by what and where they are in the text: the simulator knows their numbers only.

use crate::ir::{FaultSite, System};
use crate::source::Sources;

/// `fault 37 of gantry, in state Carrying: the part fell (gantry.aut:33)`; `state` is that of the robot. None if there is
/// no such fault.
pub fn reason(system: &System, sources: &Sources, code: u64, robot: &str, state: &str) -> Option<String> {
    let site = site(system, code)?;
    let place = place(sources, site);
    Some(format!("fault {code} of {robot}, in state {state}: {} ({place})", site.text))
}

/// What is published as this number.
pub fn site(system: &System, code: u64) -> Option<&FaultSite> {
    system.model.faults.get(usize::try_from(code).ok()?.checked_sub(1)?)
}

/// `gantry.aut:33`
pub fn place(sources: &Sources, site: &FaultSite) -> String {
    format!("{}:{}", sources.file(site.place.file).name, sources.position(site.place).0)
}
