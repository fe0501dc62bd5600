//! What a person does at the panels.

use super::LONGEST_S;
use crate::diagnostic::Diagnostic;
use crate::layout::decode::{Decoder, find};
use crate::layout::json::Json;
use crate::scenario::{Operated, Operation, Part};
use runtime_sim::line::LineButton;

/// Of the numbers that may be set.
pub const MOST: f64 = 1e6;

/// What belongs to no machine.
pub const OF_LINE: [(&str, LineButton); 2] = [("start", LineButton::Start), ("reset", LineButton::Reset)];

impl Decoder {
    pub(super) fn operator(&mut self, json: &Json) -> Vec<Operation<Operated>> {
        let items = self.list(json, "operator").unwrap_or_default();
        items.iter().filter_map(|item| self.operation(item)).collect()
    }

    fn operation(&mut self, json: &Json) -> Option<Operation<Operated>> {
        let members = self.object(json, "an operation")?;
        let part = self.required(members, "part", json.span, "an operation");
        let at_s = self.required(members, "at_s", json.span, "an operation");
        let at_s = at_s.and_then(|j| self.number_in(j, "at_s", 0.0..=LONGEST_S));
        let for_s = find(members, "for_s").map(|j| self.seconds(j, "for_s"));
        let robot = find(members, "robot");
        let value = find(members, "value");
        self.unknown_keys(members, &["robot", "part", "at_s", "for_s", "value"], "an operation");
        if let (None, Some(value)) = (robot, value) {
            let message = "a button of the line takes no \"value\"";
            self.report(
                Diagnostic::new("E0133", value.span, message)
                    .help("remove it, or name the robot of the part by \"robot\""),
            );
            return None;
        }
        let (part, value) = match robot {
            None => (self.one_of(part?, "a button of the line", &OF_LINE).map(Operated::OfLine), Some(1.0)),
            Some(robot) => {
                let robot = self.text(robot, "robot");
                let part = part.and_then(|part| self.text(part, "part"));
                let value = value.map(|j| (j.span, self.number_in(j, "value", -MOST..=MOST)));
                let (span, value) = value.map_or((None, Some(1.0)), |(span, value)| (Some(span), value));
                let both = robot.zip(part);
                (both.map(|(robot, part)| Operated::OfRobot(Part { robot, part, value: span })), value)
            }
        };
        Some(Operation {
            part: part?,
            at_s: at_s?,
            for_s: match for_s {
                Some(for_s) => Some(for_s?),
                None => None,
            },
            value: value?,
        })
    }
}
