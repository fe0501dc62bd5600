//! What is to go wrong.

use super::LONGEST_S;
use super::operator::MOST;
use crate::layout::decode::{Decoder, find};
use crate::layout::json::{Json, Member, Value};
use crate::scenario::{
    Answer, Element, Faults, Jam, PartName, Pause, Reading, Refusal, Signal, Slip, SlowCycle, Stuck,
};
use crate::source::Spanned;
use runtime_sim::machine::MOST_ELEMENTS;

/// The highest number of a pick or of a command.
pub const LAST: u32 = 1_000_000;

/// The highest number of an element of an input.
pub const LAST_ELEMENT: u32 = MOST_ELEMENTS as u32 - 1;

pub const KEYS: [&str; 8] =
    ["slips", "refusals", "answers", "pauses", "power_offs", "sensors", "jams", "slow"];

impl Decoder {
    pub(super) fn faults(&mut self, json: &Json) -> Option<Faults> {
        let members = self.object(json, "faults")?;
        self.unknown_keys(members, &KEYS, "faults");
        Some(Faults {
            slips: self.each(members, "slips", Self::slip),
            refusals: self.each(members, "refusals", Self::refusal),
            answers: self.each(members, "answers", Self::answer),
            pauses: self.each(members, "pauses", Self::pause),
            power_offs: self.each(members, "power_offs", Self::pause),
            sensors: self.each(members, "sensors", Self::stuck),
            jams: self.each(members, "jams", Self::jam),
            slow: self.each(members, "slow", Self::slow_cycle),
        })
    }

    fn each<T>(&mut self, members: &[Member], key: &str, read: fn(&mut Self, &Json) -> Option<T>) -> Vec<T> {
        let items = find(members, key).and_then(|j| self.list(j, key)).unwrap_or_default();
        items.iter().filter_map(|item| read(self, item)).collect()
    }

    fn robot(&mut self, members: &[Member], json: &Json, what: &str) -> Option<Spanned<String>> {
        let robot = self.required(members, "robot", json.span, what);
        robot.and_then(|j| self.text(j, "robot"))
    }

    /// Number of one of many events, counted from 1.
    fn count(&mut self, members: &[Member], json: &Json, key: &str, what: &str) -> Option<u32> {
        let number = self.required(members, key, json.span, what);
        number.and_then(|j| self.whole(j, key, 1..=LAST))
    }

    fn slip(&mut self, json: &Json) -> Option<Slip<Spanned<String>>> {
        let members = self.object(json, "a slip")?;
        self.unknown_keys(members, &["robot", "pick", "after_s"], "a slip");
        let robot = self.robot(members, json, "a slip");
        let pick = self.count(members, json, "pick", "a slip");
        let after_s = self.required(members, "after_s", json.span, "a slip");
        let after_s = after_s.and_then(|j| self.number_in(j, "after_s", 0.0..=LONGEST_S));
        Some(Slip { robot: robot?, pick: pick?, after_s: after_s? })
    }

    fn refusal(&mut self, json: &Json) -> Option<Refusal<Spanned<String>>> {
        let members = self.object(json, "a refusal")?;
        self.unknown_keys(members, &["robot", "command"], "a refusal");
        let robot = self.robot(members, json, "a refusal");
        let command = self.count(members, json, "command", "a refusal");
        Some(Refusal { robot: robot?, command: command? })
    }

    fn answer(&mut self, json: &Json) -> Option<Answer<Spanned<String>>> {
        let members = self.object(json, "an answer")?;
        self.unknown_keys(members, &["robot", "command", "late_s", "error"], "an answer");
        let robot = self.robot(members, json, "an answer");
        let command = self.count(members, json, "command", "an answer");
        let late_s =
            find(members, "late_s").map_or(Some(0.0), |j| self.number_in(j, "late_s", 0.0..=LONGEST_S));
        let error = match find(members, "error") {
            Some(j) => Some(self.whole(j, "error", 1..=255)? as i32),
            None => None,
        };
        Some(Answer { robot: robot?, command: command?, late_s: late_s?, error })
    }

    fn pause(&mut self, json: &Json) -> Option<Pause> {
        let members = self.object(json, "a pause")?;
        self.unknown_keys(members, &["at_s", "for_s"], "a pause");
        let at_s = self.begins(members, json, "a pause");
        let for_s = self.required(members, "for_s", json.span, "a pause");
        let for_s = for_s.and_then(|j| self.seconds(j, "for_s"));
        Some(Pause { at_s: at_s?, for_s: for_s? })
    }

    fn stuck(&mut self, json: &Json) -> Option<Stuck<Signal, Spanned<Reading>>> {
        const WHAT: &str = "a sensor that sticks";
        let members = self.object(json, WHAT)?;
        self.unknown_keys(members, &["robot", "signal", "element", "reads", "at_s", "for_s"], WHAT);
        let robot = self.robot(members, json, WHAT);
        let signal = self.required(members, "signal", json.span, WHAT).and_then(|j| self.text(j, "signal"));
        let element = find(members, "element").map(|j| self.element(j));
        let reads = self.required(members, "reads", json.span, WHAT).and_then(|j| self.reading(j));
        let at_s = self.begins(members, json, WHAT);
        let for_s = find(members, "for_s").map(|j| self.seconds(j, "for_s"));
        let input = Signal { robot: robot?, signal: signal?, element: given(element)? };
        Some(Stuck { input, reads: reads?, at_s: at_s?, for_s: given(for_s)? })
    }

    fn jam(&mut self, json: &Json) -> Option<Jam<PartName>> {
        const WHAT: &str = "a jam";
        let members = self.object(json, WHAT)?;
        self.unknown_keys(members, &["robot", "part", "at_s", "for_s"], WHAT);
        let part = self.part_name(members, json, WHAT);
        let at_s = self.begins(members, json, WHAT);
        let for_s = find(members, "for_s").map(|j| self.seconds(j, "for_s"));
        Some(Jam { part: part?, at_s: at_s?, for_s: given(for_s)? })
    }

    fn slow_cycle(&mut self, json: &Json) -> Option<SlowCycle<PartName>> {
        const WHAT: &str = "a slow cycle";
        let members = self.object(json, WHAT)?;
        self.unknown_keys(members, &["robot", "part", "cycle", "longer_s"], WHAT);
        let part = self.part_name(members, json, WHAT);
        let cycle = self.count(members, json, "cycle", WHAT);
        let longer_s = self.required(members, "longer_s", json.span, WHAT);
        let longer_s = longer_s.and_then(|j| self.seconds(j, "longer_s"));
        Some(SlowCycle { part: part?, cycle: cycle?, longer_s: longer_s? })
    }

    fn part_name(&mut self, members: &[Member], json: &Json, what: &str) -> Option<PartName> {
        let robot = self.robot(members, json, what);
        let part = self.required(members, "part", json.span, what).and_then(|j| self.text(j, "part"));
        Some(PartName { robot: robot?, part: part? })
    }

    fn element(&mut self, json: &Json) -> Option<Spanned<Element>> {
        let value = match &json.value {
            Value::Text(kind) => Element::Kind(kind.clone()),
            Value::Number(_) => Element::Number(self.whole(json, "element", 0..=LAST_ELEMENT)?),
            _ => {
                self.wrong_type(json, "element", "a number or the name of a kind");
                return None;
            }
        };
        Some(Spanned { value, span: json.span })
    }

    fn reading(&mut self, json: &Json) -> Option<Spanned<Reading>> {
        let value = match json.value {
            Value::Bool(truth) => Reading::Truth(truth),
            Value::Number(_) => Reading::Number(self.number_in(json, "reads", -MOST..=MOST)?),
            _ => {
                self.wrong_type(json, "reads", "true, false or a number");
                return None;
            }
        };
        Some(Spanned { value, span: json.span })
    }

    /// When a fault begins.
    fn begins(&mut self, members: &[Member], json: &Json, what: &str) -> Option<f64> {
        let at_s = self.required(members, "at_s", json.span, what);
        at_s.and_then(|j| self.number_in(j, "at_s", 0.0..=LONGEST_S))
    }
}

/// What an optional key gives; none if its value is wrong.
fn given<T>(read: Option<Option<T>>) -> Option<Option<T>> {
    match read {
        None => Some(None),
        Some(value) => value.map(Some),
    }
}
