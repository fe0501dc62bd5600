//! Faults and alarms of a run, by what and where they are in the text: the simulator knows their numbers only.

use crate::ir::{FaultSite, Severity, System};
use crate::source::Sources;
use runtime_sim::report::Report;

/// Why a run ended, such as `fault 37 of gantry, in state Carrying: the part fell (gantry.aut:33)`; of one that has not
/// finished also the alarms that stop machines.
pub fn reason_of_run(report: &Report, system: &System, sources: &Sources) -> String {
    let of_fault = report.fault.as_ref().and_then(|(code, robot)| {
        let site = site(system, *code)?;
        let (state, place) = (report.state(robot), place(sources, site));
        Some(format!("fault {code} of {robot}, in state {state}: {} ({place})", site.text))
    });
    let mut reason = of_fault.unwrap_or_else(|| report.reason.clone());
    if report.finished {
        return reason;
    }
    for alarm in report.alarms.iter().filter(|alarm| alarm.active || !alarm.acknowledged) {
        let stops = |site: &&FaultSite| site.severity == Severity::Machine;
        if let Some(site) = site(system, alarm.code).filter(stops) {
            let (place, text) = (place(sources, site), &site.text);
            reason += &format!("; {} is stopped by alarm {}: {text} ({place})", alarm.machine, alarm.code);
        }
    }
    reason
}

/// What is published as this number.
pub fn site(system: &System, code: i32) -> Option<&FaultSite> {
    system.model.faults.get(usize::try_from(code).ok()?.checked_sub(1)?)
}

/// `gantry.aut:33`
pub fn place(sources: &Sources, site: &FaultSite) -> String {
    format!("{}:{}", sources.file(site.place.file).name, sources.position(site.place).0)
}
