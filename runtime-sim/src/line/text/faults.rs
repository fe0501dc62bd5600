//! The faults of a scenario.

use super::super::{Answer, Jam, Pause, Refusal, Scenario, Slip, SlowCycle, Stuck};
use super::{during_text, read_during};
use crate::words::Words;

pub fn write(scenario: &Scenario, put: &mut impl FnMut(String)) {
    put(format!("slips {}", scenario.slips.len()));
    for slip in &scenario.slips {
        put(format!("  {} {} {:?}", slip.machine, slip.pick, slip.after_s));
    }
    put(format!("refusals {}", scenario.refusals.len()));
    for refusal in &scenario.refusals {
        put(format!("  {} {}", refusal.machine, refusal.command));
    }
    put(format!("answers {}", scenario.answers.len()));
    for Answer { machine, command, late_s, error } in &scenario.answers {
        put(format!("  {machine} {command} {late_s:?} {}", error.unwrap_or(0)));
    }
    for (name, pauses) in [("pauses", &scenario.pauses), ("power_offs", &scenario.power_offs)] {
        put(format!("{name} {}", pauses.len()));
        for pause in pauses {
            put(format!("  {} {}", pause.at_scan, pause.scans));
        }
    }
    put(format!("sensors {}", scenario.sensors.len()));
    for Stuck { machine, word, words, value, during } in &scenario.sensors {
        put(format!("  {machine} {word} {words} {value:?} {}", during_text(*during)));
    }
    put(format!("jams {}", scenario.jams.len()));
    for Jam { machine, part, during } in &scenario.jams {
        put(format!("  {machine} {part} {}", during_text(*during)));
    }
    put(format!("slow {}", scenario.slow.len()));
    for SlowCycle { machine, part, cycle, longer_s } in &scenario.slow {
        put(format!("  {machine} {part} {cycle} {longer_s:?}"));
    }
}

/// A scenario with these faults and nothing else.
pub fn read(words: &mut Words) -> Result<Scenario, String> {
    words.expect("slips")?;
    let slips = words.list(|w| Ok(Slip { machine: w.int()?, pick: w.int()?, after_s: w.real()? }))?;
    words.expect("refusals")?;
    let refusals = words.list(|w| Ok(Refusal { machine: w.int()?, command: w.int()? }))?;
    words.expect("answers")?;
    let answers = words.list(|w| {
        let (machine, command, late_s, error) = (w.int()?, w.int()?, w.real()?, w.int()?);
        Ok(Answer { machine, command, late_s, error: (error != 0).then_some(error) })
    })?;
    words.expect("pauses")?;
    let pauses = words.list(read_pause)?;
    words.expect("power_offs")?;
    let power_offs = words.list(read_pause)?;
    words.expect("sensors")?;
    let sensors = words.list(|w| {
        let (machine, word, words, value) = (w.int()?, w.int()?, w.int()?, w.real()?);
        Ok(Stuck { machine, word, words, value, during: read_during(w)? })
    })?;
    words.expect("jams")?;
    let jams = words.list(|w| Ok(Jam { machine: w.int()?, part: w.int()?, during: read_during(w)? }))?;
    words.expect("slow")?;
    let slow = words.list(|w| {
        let (machine, part, cycle) = (w.int()?, w.int()?, w.int()?);
        Ok(SlowCycle { machine, part, cycle, longer_s: w.real()? })
    })?;
    Ok(Scenario { slips, refusals, answers, pauses, power_offs, sensors, jams, slow, ..Scenario::default() })
}

fn read_pause(words: &mut Words) -> Result<Pause, String> {
    Ok(Pause { at_scan: words.int()?, scans: words.int()? })
}
