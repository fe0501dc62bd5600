//! What the belts bring.

use super::{EVERY_S, LONGEST_S, SEED, SURPLUS};
use crate::diagnostic::Diagnostic;
use crate::layout::decode::{Decoder, find};
use crate::layout::json::{Json, Value};
use crate::scenario::{Items, MOST_PARTS, Supply};

/// Numerator and denominator of its surplus.
pub const MOST_SURPLUS: u32 = 100;
/// Of one list of parts.
pub const MOST_TIMES: u32 = 10_000;

impl Decoder {
    pub(super) fn supply(&mut self, json: &Json, kinds: &[&str]) -> Option<Supply> {
        let members = self.object(json, "supply")?;
        self.unknown_keys(members, &["surplus", "seed", "first_s", "every_s", "items", "times"], "supply");
        let every_s = self.seconds_or(members, "every_s", EVERY_S);
        let first_s = find(members, "first_s").and_then(|j| self.number_in(j, "first_s", 0.0..=LONGEST_S));
        let first_s = first_s.unwrap_or(every_s);
        let seed = find(members, "seed").and_then(|j| self.whole(j, "seed", 0..=u32::MAX)).unwrap_or(SEED);
        let Some(items) = find(members, "items") else {
            if let Some(times) = members.iter().find(|m| m.key.value == "times") {
                self.report(
                    Diagnostic::new("E0133", times.key.span, "\"times\" has no effect without \"items\"")
                        .note("it says how often a list of parts is repeated; here autogen makes the list from the orders")
                        .help("remove \"times\", or add \"items\""),
                );
            }
            let surplus = find(members, "surplus").and_then(|j| self.fraction(j)).unwrap_or(SURPLUS);
            return Some(Supply {
                span: json.span,
                first_s,
                every_s,
                seed,
                items: Items::Shuffled { surplus },
                times: 1,
            });
        };
        if let Some(surplus) = members.iter().find(|m| m.key.value == "surplus") {
            self.report(
                Diagnostic::new("E0133", surplus.key.span, "\"surplus\" has no effect with \"items\"")
                    .other(items.span, "the belt brings exactly these parts")
                    .note("it is for a list of parts that autogen makes")
                    .help("remove \"surplus\" or \"items\""),
            );
        }
        let items = match &items.value {
            Value::Object(belts) => {
                let lists: Vec<_> =
                    belts.iter().map(|m| Some((m.key.clone(), self.items(&m.value, kinds)?))).collect();
                Items::Belts(lists.into_iter().collect::<Option<_>>()?)
            }
            _ => Items::OnlyBelt(self.items(items, kinds)?),
        };
        let times = find(members, "times").map_or(Some(1), |j| self.whole(j, "times", 1..=MOST_TIMES))?;
        let brought = items.count() as u64 * u64::from(times);
        if brought > MOST_PARTS {
            self.report(
                Diagnostic::new("E0137", json.span, format!("the belts would have to bring {brought} parts"))
                    .note(format!(
                        "{} parts, {times} times; a scenario brings at most {MOST_PARTS}",
                        items.count()
                    ))
                    .help("bring fewer parts, or fewer times"),
            );
            return None;
        }
        let items = items.repeated(times as usize);
        Some(Supply { span: json.span, first_s, every_s, seed, items, times })
    }

    fn items(&mut self, json: &Json, kinds: &[&str]) -> Option<Vec<usize>> {
        let names = self.texts(json, "items")?;
        let found: Vec<_> = names.iter().map(|name| self.kind_index(name, kinds)).collect();
        found.into_iter().collect()
    }

    fn fraction(&mut self, json: &Json) -> Option<[u32; 2]> {
        let items = self.exactly(json, "surplus", &["numerator", "denominator"])?;
        let numerator = self.whole(&items[0], "surplus[0]", 0..=MOST_SURPLUS);
        let denominator = self.whole(&items[1], "surplus[1]", 1..=MOST_SURPLUS);
        Some([numerator?, denominator?])
    }
}
