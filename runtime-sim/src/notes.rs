//! What a run did not come to.

use crate::item::Names;
use crate::line::{Line, LineButton};
use crate::plant::{Entry, NotRemoved, Plant, Time};
use crate::report::{MissedReport, Outcome, carrier_text, seconds};
use std::collections::{BTreeMap, BTreeSet};

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
                NotRemoved::Elsewhere(carrier) => format!("its carrier was: {}", carrier_text(line, carrier)),
                NotRemoved::Under(upper) => format!("{} lay on it; remove this one first", names.name(upper)),
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

/// Lines about commands that ended in one error.
const MOST_MISSED: usize = 5;

/// Commands that ended in an error of reach, or gripped nothing, a line each.
pub fn missed(line: &Line, plant: &Plant) -> Vec<String> {
    let mut of_errors: BTreeMap<i32, Vec<(&str, &Entry)>> = BTreeMap::new();
    for (index, machine) in line.machines.iter().enumerate() {
        for entry in plant.missed(index).into_iter().flat_map(|missed| missed.entries()) {
            of_errors.entry(entry.error).or_default().push((&machine.name, entry));
        }
    }
    of_errors.into_iter().flat_map(|(error, entries)| missed_in(error, entries)).collect()
}

fn missed_in(error: i32, mut entries: Vec<(&str, &Entry)>) -> Vec<String> {
    entries.sort_by_key(|(_, entry)| entry.first_ms);
    let shown = entries.len().min(MOST_MISSED);
    let one = |(name, entry): &(&str, &Entry)| {
        let Entry { command, reason, count, first_ms, .. } = entry;
        let first_s = *first_ms as f64 / 1000.0;
        let often = if *count > 1 { format!(", {count} times") } else { String::new() };
        format!("command {command} of {name} ended in error {error} at {first_s:.2} s{often}: {reason}")
    };
    let mut notes: Vec<String> = entries[..shown].iter().map(one).collect();
    let others = &entries[shown..];
    if !others.is_empty() {
        let count: u32 = others.iter().fold(0, |sum, (_, entry)| sum.saturating_add(entry.count));
        let machines: BTreeSet<&str> = others.iter().map(|(name, _)| *name).collect();
        let machines: Vec<&str> = machines.into_iter().take(MOST_MISSED).collect();
        notes.push(format!("{count} more commands ended in error {error}, of {}", machines.join(", ")));
    }
    notes
}

/// The same at each time, for the alarms of a report.
pub fn missed_times(line: &Line, plant: &Plant) -> Vec<MissedReport> {
    let of = |machine: usize| {
        let times = plant.missed(machine).into_iter().flat_map(|missed| missed.times());
        times.map(move |Time { at_ms, error, reason }| MissedReport {
            machine,
            at_ms: *at_ms,
            error: *error,
            text: reason.to_string(),
        })
    };
    (0..line.machines.len()).flat_map(of).collect()
}
