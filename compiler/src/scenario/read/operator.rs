//! What a person does at the panels.

use super::LONGEST_S;
use crate::diagnostic::Diagnostic;
use crate::layout::decode::{Decoder, find};
use crate::layout::json::{Json, Member};
use crate::scenario::{Operated, Operation, Part, Removal};
use crate::source::Spanned;
use runtime_sim::line::LineButton;

/// Of the numbers that may be set.
pub const MOST: f64 = 1e6;

/// What belongs to no machine.
pub const OF_LINE: [(&str, LineButton); 2] = [("start", LineButton::Start), ("reset", LineButton::Reset)];

/// All that a person does.
#[derive(Default)]
pub struct Operator {
    pub operations: Vec<Operation<Operated>>,
    pub removals: Vec<Removal>,
}

impl Decoder {
    /// Without kinds, which have errors of their own, no item is known.
    pub(super) fn operator(&mut self, json: &Json, kinds: Option<&[&str]>) -> Operator {
        let mut operator = Operator::default();
        for entry in self.list(json, "operator").unwrap_or_default() {
            let Some(members) = self.object(entry, "an operation") else { continue };
            match find(members, "remove") {
                Some(item) => operator.removals.extend(self.removal(entry, members, item, kinds)),
                None => operator.operations.extend(self.operation(entry, members)),
            }
        }
        operator
    }

    fn removal(
        &mut self,
        json: &Json,
        members: &[Member],
        item: &Json,
        kinds: Option<&[&str]>,
    ) -> Option<Removal> {
        let at_s = self.required(members, "at_s", json.span, "a removal");
        let at_s = at_s.and_then(|j| self.number_in(j, "at_s", 0.0..=LONGEST_S));
        self.unknown_keys(members, &["remove", "at_s"], "a removal");
        let name = self.text(item, "remove")?;
        let numbered = name.value.rsplit_once('_').and_then(|(kind, text)| {
            let number: u32 = text.parse().ok()?;
            (number > 0 && number.to_string() == text).then_some((kind, number))
        });
        let Some((kind, number)) = numbered else {
            self.report(
                Diagnostic::new("E0131", name.span, format!("\"{}\" names no item", name.value)).help(
                    "an item is named by its kind and its number among those of this kind, from 1, such as battery_3",
                ),
            );
            return None;
        };
        let kind = self.kind_index(&Spanned { value: kind.to_string(), span: name.span }, kinds?)?;
        Some(Removal { kind, number, at_s: at_s?, span: name.span })
    }

    fn operation(&mut self, json: &Json, members: &[Member]) -> Option<Operation<Operated>> {
        let part = self.required(members, "part", json.span, "an operation");
        let at_s = self.required(members, "at_s", json.span, "an operation");
        let at_s = at_s.and_then(|j| self.number_in(j, "at_s", 0.0..=LONGEST_S));
        let for_s = find(members, "for_s").map(|j| self.seconds(j, "for_s"));
        let robot = find(members, "robot");
        let value = find(members, "value");
        self.unknown_keys(members, &["robot", "part", "at_s", "for_s", "value", "remove"], "an operation");
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
