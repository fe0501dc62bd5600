//! What the code of a fault or an alarm means to who stands before the line.

use super::context::Shared;
use super::screen::{Translate, Use};
use super::table::row;
use super::value::{LATE_SCAN, NO_SUCH_STATE, NOT_RETAINED, WRONG_INTERVAL};
use crate::ir::{AutomatonId, FaultId, FaultKind, Severity};
use std::collections::BTreeMap;

/// `alarms.csv`: the codes that are published with a fault or an alarm. Robots have the numbers that `fault_robot` gives.
pub fn table(shared: Shared, translate: &mut Translate) -> String {
    let mut text = row(&["code", "type", "robots", "state", "transition", "text", "remedy", "stops"]);
    let mut robots_of: BTreeMap<AutomatonId, String> = BTreeMap::new();
    for (i, site) in shared.system.model.faults.iter().enumerate() {
        let robots = robots_of.entry(site.automaton).or_insert_with(|| {
            let robots = shared.instances(site.automaton);
            let named = robots.iter().map(|r| format!("{r} {}", shared.system.instances[*r].name));
            named.collect::<Vec<_>>().join(" ")
        });
        if robots.is_empty() {
            continue;
        }
        let remedy = match site.kind {
            _ if site.severity == Severity::Warning => {
                "Do what the text says. Nothing was stopped; reset acknowledges the alarm."
            }
            _ if site.severity == Severity::Machine => {
                "Do what the text says. The robot is held until the cause is gone, the alarm is acknowledged by reset, and start has a rising edge; the others continue to run. Before you reach in, remove run_permit by the safety system."
            }
            FaultKind::OutOfBounds => {
                "The number was limited to its bounds. Check the state of the robot and its counters. After reset and start the step is repeated from its beginning: items counted before the fault are counted twice."
            }
            FaultKind::NotFinite => {
                "The old value was kept. Check the inputs and parameters from which it is computed. After reset and start the step is repeated from its beginning: items counted before the fault are counted twice."
            }
            FaultKind::InvariantFails => {
                "Do what the text says. If it is a condition, check the values that it names, and correct them before reset, or the fault returns."
            }
            FaultKind::NotKept => {
                "A value has changed that the text promises to keep. Check which robots write it."
            }
            FaultKind::NotFollowed => {
                "Check what did not happen in time: the answer of a device, the action of another robot, or the action of a person."
            }
            FaultKind::TooLong => {
                "Check what the state waits for (states.csv): the answer of the device, or another robot. After reset and start the time of the state begins anew."
            }
        };
        let about = format!("{} ({})", translate(Use::Alarm, &site.text), shared.line(site.place));
        let automaton = shared.system.model.automaton(site.automaton);
        let [state, transition] = automaton.situation(FaultId(i));
        text += &row(&[
            &(i + 1).to_string(),
            &automaton.name,
            robots,
            &state,
            &transition,
            &about,
            &translate(Use::Remedy, remedy),
            match site.severity {
                Severity::Line => "line",
                Severity::Machine => "machine",
                Severity::Warning => "nothing",
            },
        ]);
    }
    for (code, about, remedy) in of_the_line(shared) {
        let [about, remedy] = [translate(Use::Alarm, about), translate(Use::Remedy, remedy)];
        let robots = if code == NO_SUCH_STATE { "any" } else { "" };
        text += &row(&[&code.to_string(), "", robots, "", "", &about, &remedy, "line"]);
    }
    text
}

/// Faults that no automaton raises: code, text, remedy.
fn of_the_line(shared: Shared) -> Vec<(i32, &'static str, &'static str)> {
    let mut faults = vec![
        (
            WRONG_INTERVAL,
            "the interval of the task is not dt_ms, by the clock of the PLC: hundred_scans_ms of watchdog is not about 100 * dt_ms",
            "Set the interval of the task to dt_ms, or change dt_ms and scan_ms of the layout. Then reset and start.",
        ),
        (
            LATE_SCAN,
            "a scan came later than late_ms after the one before, by the clock of the PLC",
            "The PLC was stopped while the line was running, or its task has not enough time: check the load of the processor and tasks of higher priority. Then reset and start.",
        ),
    ];
    if shared.system.model.retains() {
        faults.push((
            NOT_RETAINED,
            "the retained values are not of this program or not of one scan, or some were not kept",
            "The program was changed while power was off, power was lost within a scan, or the PLC does not retain all that is declared so. The line begins with its initial values: secure the parts on the grippers, remove the items from all places, then reset and start.",
        ));
    }
    faults.push((
        NO_SUCH_STATE,
        "the state has a number that does not exist",
        "The memory of the controller is damaged: only a cold start helps. Secure the parts on the grippers first: without power they fall. Remove the items from all places: the controller loses the data of them.",
    ));
    faults
}
