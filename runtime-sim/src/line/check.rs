//! Whether a line can be run at all.

use super::{Collected, Deck, Goal, Kind, Line, Obstacle};
use crate::machine::Machine;

/// Scans that a telegram may be late.
const LONGEST_DELAY: u32 = 1000;
/// Seconds: about a year.
pub(super) const LONGEST_TIME: f64 = 3.2e7;

impl Line {
    /// The first thing that makes this line impossible to run: an index without a machine,
    /// a number that is not finite, a name that is no single word.
    pub fn check(&self) -> Result<(), String> {
        if !(1..=1000).contains(&self.scan_ms) {
            return Err(format!("a scan of {} ms is not between 1 and 1000 ms", self.scan_ms));
        }
        if self.io_delay.max() > LONGEST_DELAY {
            return Err(format!("answers more than {LONGEST_DELAY} scans late"));
        }
        for kind in &self.kinds {
            check_name("kind", &kind.name)?;
            if !(kind.height > 0.0 && kind.height.is_finite()) {
                return Err(format!("the height of {} is no positive number", kind.name));
            }
            if !(kind.grasp > 0.0 && kind.grasp <= kind.height) {
                return Err(format!("{} is not gripped between its underside and its upper side", kind.name));
            }
            if !kind.size.iter().all(|length| *length > 0.0 && length.is_finite()) {
                return Err(format!("a length of {} is no positive number", kind.name));
            }
            if !(kind.mass >= 0.0 && kind.mass.is_finite()) {
                return Err(format!("the mass of {} is no number from 0 on", kind.name));
            }
            if kind.deck.is_some_and(|deck| !is_within(&deck, kind)) {
                return Err(format!("the deck of {} is not within it", kind.name));
            }
            kind.is.iter().try_for_each(|is| check_name("what a kind is", is))?;
        }
        for machine in &self.machines {
            check_name("machine", &machine.name)?;
            machine.check().map_err(|misfit| format!("{}: {}", machine.name, misfit.reason))?;
            for state in &machine.states {
                check_name("state", &state.name)?;
                for &owner in &state.awaits {
                    self.machine(owner, "a state")?;
                }
                let words = machine.wiring.input_words(self.kinds.len());
                let under = state.reads_while.iter();
                let under =
                    under.flat_map(|read| read.gates.iter().map(|(word, _)| word).chain([&read.word]));
                if let Some(word) = state.reads.iter().chain(under).find(|word| **word >= words) {
                    return Err(format!("a state of {} reads word {word} of {words}", machine.name));
                }
            }
        }
        for obstacle in &self.obstacles {
            check_name("obstacle", &obstacle.name)?;
            check_obstacle(obstacle)?;
        }
        for name in self.may_touch.iter().flatten() {
            let machines = self.machines.iter().map(|machine| &machine.name);
            if !machines.chain(self.obstacles.iter().map(|obstacle| &obstacle.name)).any(|n| n == name) {
                return Err(format!("`{name}` may touch something and is not there"));
            }
        }
        self.check_scenario()
    }

    fn check_scenario(&self) -> Result<(), String> {
        let scenario = &self.scenario;
        for (name, seconds) in [
            ("spawn_every_s", scenario.spawn_every_s),
            ("time_limit_s", scenario.time_limit_s),
            ("stall_limit_s", scenario.stall_limit_s),
        ] {
            // Below a millisecond it would round to no time at all.
            if !(0.001..=LONGEST_TIME).contains(&seconds) {
                return Err(format!("{name} {seconds:?} is not between 0.001 and {LONGEST_TIME:?}"));
            }
        }
        if !(0.0..=LONGEST_TIME).contains(&scenario.spawn_first_s) {
            let first = scenario.spawn_first_s;
            return Err(format!("spawn_first_s {first:?} is not between 0 and {LONGEST_TIME:?}"));
        }
        if scenario.start_scan == 0 {
            return Err("a rising edge of `start` in scan 0 has nothing before it".into());
        }
        for (number, order) in (1..).zip(&scenario.orders) {
            for (i, &index) in order.stations.iter().enumerate() {
                let station = self.machine(index, "an order")?;
                if !station.has("orders") {
                    return Err(format!("an order at {}, which has no terminal", station.name));
                }
                if order.stations[..i].contains(&index) {
                    return Err(format!("order {number} names {} twice", station.name));
                }
            }
            if order.stations.is_empty() {
                return Err(format!("order {number} names no station"));
            }
            if order.parts.len() != self.kinds.len() {
                return Err(format!("order {number} is without a number for each kind"));
            }
        }
        for (i, supply) in scenario.supply.iter().enumerate() {
            let belt = self.machine(supply.belt, "the supply")?;
            if !belt.has("source") {
                return Err(format!("a supply of {}, which has no source", belt.name));
            }
            if scenario.supply[..i].iter().any(|other| other.belt == supply.belt) {
                return Err(format!("two supplies of {}", belt.name));
            }
            if let Some(kind) = supply.items.iter().find(|&&kind| kind >= self.kinds.len()) {
                return Err(format!("the supply of {} names kind {kind}, which is not there", belt.name));
            }
        }
        if let Goal::Collected(sinks) = &scenario.goal {
            for Collected { machine, part, items } in sinks {
                let machine = self.machine(*machine, "the goal")?;
                let is_sink = machine.parts.get(*part).is_some_and(|part| part.schema().name == "sink");
                if !is_sink || items.len() != self.kinds.len() {
                    return Err(format!(
                        "the goal asks what is no sink of {}, or not for each kind",
                        machine.name
                    ));
                }
            }
        }
        for slip in &scenario.slips {
            let arm = self.machine(slip.machine, "a slip")?;
            if !arm.has("grip") {
                return Err(format!("a slip of {}, which has no gripper", arm.name));
            }
            if !(0.0..=LONGEST_TIME).contains(&slip.after_s) {
                return Err(format!("a slip of {} after {:?} s", arm.name, slip.after_s));
            }
        }
        for refusal in &scenario.refusals {
            self.machine(refusal.machine, "a refusal")?;
        }
        for answer in &scenario.answers {
            let machine = self.machine(answer.machine, "an answer")?;
            if !(0.0..=LONGEST_TIME).contains(&answer.late_s) {
                return Err(format!("an answer of {} after {:?} s", machine.name, answer.late_s));
            }
            if answer.error.is_some_and(|error| !(1..=255).contains(&error)) {
                return Err(format!("an answer of {} in an error that is none", machine.name));
            }
        }
        for stuck in &scenario.sensors {
            stuck.check(self.machine(stuck.machine, "a sensor that sticks")?, self.kinds.len())?;
        }
        for jam in &scenario.jams {
            jam.check(self.machine(jam.machine, "a jam")?)?;
        }
        for cycle in &scenario.slow {
            cycle.check(self.machine(cycle.machine, "a slow cycle")?)?;
        }
        for operation in &scenario.operations {
            let panel = self.machine(operation.machine, "an operation")?;
            let part = panel.parts.get(operation.part);
            if part.is_none_or(|part| part.schema().operated.is_none()) {
                return Err(format!("an operation of {}, at what nobody operates", panel.name));
            }
            let times = [operation.at_s, operation.for_s.unwrap_or_default()];
            if !times.iter().all(|time| (0.0..=LONGEST_TIME).contains(time)) || !operation.value.is_finite() {
                return Err(format!("an operation of {} at no time, or to no number", panel.name));
            }
        }
        if let Some(removal) = scenario.removals.iter().find(|removal| removal.kind >= self.kinds.len()) {
            return Err(format!("a removal of kind {}, which is not there", removal.kind));
        }
        Ok(())
    }

    fn machine(&self, index: usize, whose: &str) -> Result<&Machine, String> {
        self.machines.get(index).ok_or_else(|| format!("{whose} names machine {index}, which is not there"))
    }
}

/// Walls, if it has any, have a thickness.
fn is_within(deck: &Deck, kind: &Kind) -> bool {
    let has_walls = deck.height < kind.height;
    let fits = |(inner, outer): (&f64, &f64)| *inner > 0.0 && (inner < outer || !has_walls && inner == outer);
    (0.0..=kind.height).contains(&deck.height) && deck.size.iter().zip(&kind.size).all(fits)
}

fn check_name(what: &str, name: &str) -> Result<(), String> {
    if name.is_empty() || name.contains(char::is_whitespace) {
        return Err(format!("the name of the {what} `{name}` is not one word"));
    }
    Ok(())
}

fn check_obstacle(obstacle: &Obstacle) -> Result<(), String> {
    if !obstacle.pose.is_near() {
        return Err(format!("a coordinate of {} is no number within 1000 km", obstacle.name));
    }
    match obstacle.size {
        Some(size) if !(size.is_near() && size.x > 0.0 && size.y > 0.0 && size.z > 0.0) => {
            Err(format!("a length of the box of {} is no positive number within 1000 km", obstacle.name))
        }
        _ => Ok(()),
    }
}
