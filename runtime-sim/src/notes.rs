//! What a run did not come to.

use crate::item::Names;
use crate::line::{Line, LineButton};
use crate::plant::{Missed, Plant};
use crate::report::{Outcome, carrier_text, seconds};

/// What the scenario has go wrong, or somebody do, that did not happen, a line each.
pub fn not_reached(line: &Line, plant: &Plant, outcome: &Outcome) -> Vec<String> {
    let scans = outcome.scans;
    let scenario = &line.scenario;
    let name = |machine: usize| &line.machines[machine].name;
    let part = |machine: usize, part: usize| {
        let machine = &line.machines[machine];
        format!("{}.{}", machine.name, machine.parts[part].name)
    };
    let counted = |what: String, number: u32, found: u32, of_what: &str| {
        (number > found || number == 0)
            .then(|| format!("not reached: {what}, which had {found} {of_what}; name an earlier one"))
    };
    let command = |what: &str, machine: usize, number: u32| {
        let what = format!("{what} command {number} of {}", name(machine));
        counted(what, number, plant.commands(machine), "commands")
    };
    let end_s = seconds(scans, line.scan_ms);
    let end = match outcome.fault {
        Some(_) => format!("as the run ended in the fault at {end_s:.2} s"),
        None => format!("as the run ended at {end_s:.2} s; give an earlier time"),
    };
    let late = |what: String, at_s: f64| format!("not reached: {what} at {at_s:.2} s, {end}");
    let timed = |what: String, at: u64| (at >= scans).then(|| late(what, seconds(at, line.scan_ms)));

    let slips = scenario.slips.iter().map(|slip| {
        let what = format!("slip of pick {} of {}", slip.pick, name(slip.machine));
        counted(what, slip.pick, plant.picks(slip.machine), "picks")
    });
    let refusals = scenario.refusals.iter().map(|r| command("refusal of", r.machine, r.command));
    let answers = scenario.answers.iter().map(|a| command("answer to", a.machine, a.command));
    let pauses = scenario.pauses.iter().map(|pause| timed("pause".into(), pause.at_scan));
    let power_offs = scenario.power_offs.iter().map(|off| timed("loss of power".into(), off.at_scan));
    let sensors = scenario
        .sensors
        .iter()
        .map(|stuck| timed(format!("input of {} that sticks", name(stuck.machine)), stuck.during.at_scan));
    let jams = scenario.jams.iter();
    let jams = jams.map(|jam| timed(format!("jam of {}", part(jam.machine, jam.part)), jam.during.at_scan));
    let slow = scenario.slow.iter().map(|slow| {
        let what = format!("slow cycle {} of {}", slow.cycle, part(slow.machine, slow.part));
        counted(what, slow.cycle, plant.cycles(slow.machine, slow.part), "cycles")
    });
    let operations = scenario.operations.iter().map(|operation| {
        let what = format!("operation of {}", part(operation.machine, operation.part));
        (operation.at_s >= end_s).then(|| late(what, operation.at_s))
    });
    let presses = scenario.presses.iter().map(|press| {
        let button = match press.button {
            LineButton::Start => "start",
            LineButton::Reset => "reset",
        };
        timed(format!("press of `{button}`"), press.during.at_scan)
    });
    let names = Names::new(line);
    let removals = scenario.removals.iter().zip(plant.missed_removals()).map(|(removal, missed)| {
        let what = format!("removal of {}_{}", line.kinds[removal.kind].name, removal.number);
        let missed = missed.map(|missed| {
            let at_s = seconds(removal.at_scan, line.scan_ms);
            let why = match missed {
                Missed::Elsewhere(carrier) => format!("its carrier was: {}", carrier_text(line, carrier)),
                Missed::Under(upper) => format!("{} lay on it; remove this one first", names.name(upper)),
            };
            format!("not reached: {what} at {at_s:.2} s, when {why}")
        });
        missed.or_else(|| timed(what, removal.at_scan))
    });
    let faults = slips.chain(refusals).chain(answers).chain(pauses).chain(power_offs);
    faults
        .chain(sensors)
        .chain(jams)
        .chain(slow)
        .chain(operations)
        .chain(presses)
        .chain(removals)
        .flatten()
        .collect()
}
