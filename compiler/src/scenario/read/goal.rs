//! What the sinks of a line should collect.

use crate::diagnostic::Diagnostic;
use crate::layout::decode::{Decoder, find};
use crate::layout::json::Json;
use crate::scenario::Collected;
use crate::source::Spanned;

/// Of each kind.
pub const MOST_ITEMS: u32 = 1_000_000;

impl Decoder {
    pub(super) fn goal(&mut self, json: &Json, kinds: &[&str]) -> Vec<Collected<Spanned<String>>> {
        let Some(members) = self.object(json, "goal") else { return Vec::new() };
        let reported = self.diagnostics.len();
        let sinks = members.iter().filter_map(|member| {
            let what = format!("goal of {}", member.key.value);
            let wanted = self.object(&member.value, &what)?;
            self.unknown_keys(wanted, kinds, &what);
            let number = |kind: &&str| {
                find(wanted, kind).map_or(Some(0), |found| self.whole(found, kind, 0..=MOST_ITEMS))
            };
            let items: Option<Vec<u32>> = kinds.iter().map(number).collect();
            Some(Collected { sink: member.key.clone(), items: items? })
        });
        let sinks: Vec<_> = sinks.collect();
        let is_read = self.diagnostics.len() == reported;
        let asks = |sink: &Collected<_>| sink.items.iter().any(|number| *number > 0);
        if is_read && !sinks.iter().any(asks) {
            self.report(
                Diagnostic::new("E0145", json.span, "the goal asks for no item")
                    .help("write how many items of which kind each sink should collect"),
            );
        }
        sinks
    }
}
