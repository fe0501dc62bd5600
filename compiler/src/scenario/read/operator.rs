//! What a person does at the panels.

use super::LONGEST_S;
use crate::layout::decode::{Decoder, find};
use crate::layout::json::Json;
use crate::scenario::{Operation, Part};

/// Of the numbers that may be set.
pub const MOST: f64 = 1e6;

impl Decoder {
    pub(super) fn operator(&mut self, json: &Json) -> Vec<Operation<Part>> {
        let items = self.list(json, "operator").unwrap_or_default();
        items.iter().filter_map(|item| self.operation(item)).collect()
    }

    fn operation(&mut self, json: &Json) -> Option<Operation<Part>> {
        let members = self.object(json, "an operation")?;
        self.unknown_keys(members, &["robot", "part", "at_s", "for_s", "value"], "an operation");
        let text = |decoder: &mut Self, key| {
            let found = decoder.required(members, key, json.span, "an operation");
            found.and_then(|found| decoder.text(found, key))
        };
        let (robot, part) = (text(self, "robot"), text(self, "part"));
        let at_s = self.required(members, "at_s", json.span, "an operation");
        let at_s = at_s.and_then(|j| self.number_in(j, "at_s", 0.0..=LONGEST_S));
        let for_s = find(members, "for_s").map(|j| self.seconds(j, "for_s"));
        let value = find(members, "value").map(|j| (j.span, self.number_in(j, "value", -MOST..=MOST)));
        let (span, value) = value.map_or((None, Some(1.0)), |(span, value)| (Some(span), value));
        Some(Operation {
            part: Part { robot: robot?, part: part?, value: span },
            at_s: at_s?,
            for_s: match for_s {
                Some(for_s) => Some(for_s?),
                None => None,
            },
            value: value?,
        })
    }
}
