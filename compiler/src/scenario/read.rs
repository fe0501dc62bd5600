//! From the text of a scenario to its tree.

use super::{Faults, Items, Kind, Order, Orders, Pause, Refusal, Scenario, Slip, Supply};
use crate::diagnostic::{Diagnostic, sort};
use crate::layout::decode::{Decoder, find, instead, listing};
use crate::layout::json::{self, Json, Member, Value};
use crate::source::{FileId, Sources, Spanned};

const MOST_KINDS: usize = 16;
const MOST_ORDERS: u32 = 10_000;
/// Highest value of the port `order_parts` of a station.
const MOST_OF_A_KIND: u32 = 12;
const LONGEST_S: f64 = 1e6;
const TIME_LIMIT_S: f64 = 3600.0;
const EVERY_S: f64 = 2.0;
const SURPLUS: [u32; 2] = [1, 3];
const SEED: u32 = 1;

/// There is a scenario only without any error.
pub fn parse(sources: &Sources, file: FileId) -> (Option<Scenario>, Vec<Diagnostic>) {
    let (json, diagnostics) = json::parse(&sources.file(file).text, file);
    let mut decoder = Decoder { diagnostics };
    let scenario = json.and_then(|json| decoder.scenario(&json));
    sort(&mut decoder.diagnostics);
    (scenario.filter(|_| decoder.diagnostics.is_empty()), decoder.diagnostics)
}

impl Decoder {
    fn scenario(&mut self, json: &Json) -> Option<Scenario> {
        let members = self.object(json, "a scenario")?;
        self.unknown_keys(members, &["kinds", "orders", "supply", "time_limit_s", "faults"], "a scenario");
        let kinds = self.required(members, "kinds", json.span, "the scenario");
        let orders = self.required(members, "orders", json.span, "the scenario");
        let time_limit_s = self.seconds_or(members, "time_limit_s", TIME_LIMIT_S);
        let faults = find(members, "faults").and_then(|j| self.faults(j)).unwrap_or_default();
        let kinds = kinds.and_then(|j| self.kinds(j))?;
        let names: Vec<&str> = kinds.iter().map(|k| k.name.value.as_str()).collect();
        let orders = orders.and_then(|j| self.orders(j, &names));
        let supply = match find(members, "supply") {
            Some(supply) => self.supply(supply, &names),
            None => Some(Supply {
                span: json.span,
                every_s: EVERY_S,
                items: Items::Shuffled { surplus: SURPLUS, seed: SEED },
            }),
        };
        Some(Scenario { file: json.span.file, kinds, orders: orders?, supply: supply?, time_limit_s, faults })
    }

    /// A time longer than nothing.
    fn seconds(&mut self, json: &Json, key: &str) -> Option<f64> {
        self.number_in(json, key, 0.001..=LONGEST_S)
    }

    fn seconds_or(&mut self, members: &[Member], key: &str, default: f64) -> f64 {
        find(members, key).and_then(|j| self.seconds(j, key)).unwrap_or(default)
    }

    fn kinds(&mut self, json: &Json) -> Option<Vec<Kind>> {
        let items = self.list(json, "kinds")?;
        if items.is_empty() || items.len() > MOST_KINDS {
            let found = items.len();
            let message = format!("a scenario has 1 to {MOST_KINDS} kinds of part, not {found}");
            self.report(
                Diagnostic::new("E0113", json.span, message)
                    .note("controllers have one input for each kind")
                    .help("list each kind that is used once"),
            );
            return None;
        }
        let kinds: Vec<Kind> = items.iter().filter_map(|item| self.kind(item)).collect();
        self.distinct(kinds.iter().map(|k| &k.name), "a kind");
        Some(kinds)
    }

    /// With any height if that cannot be read, so that its name is known.
    fn kind(&mut self, json: &Json) -> Option<Kind> {
        let members = self.object(json, "a kind")?;
        self.unknown_keys(members, &["name", "height"], "a kind");
        let name = self.required(members, "name", json.span, "a kind");
        let name = name.and_then(|j| self.text(j, "name"));
        if let Some(name) = &name {
            self.identifier(name, "a kind");
        }
        let height = self.required(members, "height", json.span, "a kind");
        let height = height.and_then(|j| self.number_in(j, "height", 0.001..=1.0));
        Some(Kind { name: name?, height: height.unwrap_or_default() })
    }

    fn kind_index(&mut self, name: &Spanned<String>, kinds: &[&str]) -> Option<usize> {
        let found = kinds.iter().position(|k| *k == name.value);
        if found.is_none() {
            self.report(
                Diagnostic::new("E0131", name.span, format!("there is no kind of part \"{}\"", name.value))
                    .note(format!("kinds of this scenario: {}", listing(kinds)))
                    .help(instead(&name.value, kinds)),
            );
        }
        found
    }

    fn orders(&mut self, json: &Json, kinds: &[&str]) -> Option<Orders> {
        let Value::Object(members) = &json.value else {
            return self.order_list(json, kinds);
        };
        self.unknown_keys(members, &["count", "parts", "stations"], "orders");
        let count = self.required(members, "count", json.span, "orders");
        let count = count.and_then(|j| self.whole(j, "count", 0..=MOST_ORDERS));
        let parts = self.required(members, "parts", json.span, "orders");
        let parts = parts.and_then(|j| self.parts(j, kinds));
        let stations = find(members, "stations").and_then(|j| self.stations(j));
        let order = Order { station: None, parts: parts? };
        Some(Orders { span: json.span, list: vec![order; count? as usize], stations })
    }

    fn order_list(&mut self, json: &Json, kinds: &[&str]) -> Option<Orders> {
        let items = self.list(json, "orders")?;
        if items.len() > MOST_ORDERS as usize {
            let message = format!("a scenario has at most {MOST_ORDERS} orders, not {}", items.len());
            self.report(
                Diagnostic::new("E0113", json.span, message).help("make several scenarios of these orders"),
            );
            return None;
        }
        let list = items.iter().map(|item| self.order(item, kinds)).collect::<Vec<_>>();
        Some(Orders { span: json.span, list: list.into_iter().collect::<Option<_>>()?, stations: None })
    }

    fn order(&mut self, json: &Json, kinds: &[&str]) -> Option<Order> {
        let members = self.object(json, "an order")?;
        self.unknown_keys(members, &["station", "parts"], "an order");
        let station = find(members, "station").map(|j| self.text(j, "station"));
        let parts = self.required(members, "parts", json.span, "an order");
        let parts = parts.and_then(|j| self.parts(j, kinds))?;
        Some(Order { station: station.flatten(), parts })
    }

    fn parts(&mut self, json: &Json, kinds: &[&str]) -> Option<Vec<u32>> {
        let members = self.object(json, "parts")?;
        let mut parts = vec![0; kinds.len()];
        let mut complete = true;
        for Member { key, value } in members {
            let kind = self.kind_index(key, kinds);
            let what = format!("the number of parts \"{}\" of one order", key.value);
            match (kind, self.whole(value, &what, 0..=MOST_OF_A_KIND)) {
                (Some(kind), Some(number)) => parts[kind] = number,
                _ => complete = false,
            }
        }
        if complete && parts.iter().all(|n| *n == 0) {
            self.report(
                Diagnostic::new("E0132", json.span, "an order asks for no part")
                    .note("an order is made when its parts lie in the briefcase: this one would be made already")
                    .help("ask for at least one part, or remove the order"),
            );
        }
        complete.then_some(parts)
    }

    fn stations(&mut self, json: &Json) -> Option<Vec<Spanned<String>>> {
        match &json.value {
            Value::Text(text) if text == "in turn" => None,
            Value::List(items) if !items.is_empty() => self.texts(json, "stations"),
            Value::List(_) => {
                self.report(
                    Diagnostic::new("E0113", json.span, "stations names no station")
                        .help("name stations, or write \"in turn\" for all"),
                );
                None
            }
            _ => {
                self.report(
                    Diagnostic::new("E0115", json.span, "stations must be \"in turn\" or a list of names")
                        .note("\"in turn\" spreads the orders over all stations of the layout, in its order")
                        .help("write \"in turn\", or a list such as [\"as1\"]"),
                );
                None
            }
        }
    }

    fn supply(&mut self, json: &Json, kinds: &[&str]) -> Option<Supply> {
        let members = self.object(json, "supply")?;
        self.unknown_keys(members, &["surplus", "seed", "every_s", "items"], "supply");
        let every_s = self.seconds_or(members, "every_s", EVERY_S);
        let Some(items) = find(members, "items") else {
            let surplus = find(members, "surplus").and_then(|j| self.fraction(j)).unwrap_or(SURPLUS);
            let seed = find(members, "seed").and_then(|j| self.whole(j, "seed", 0..=u32::MAX));
            let items = Items::Shuffled { surplus, seed: seed.unwrap_or(SEED) };
            return Some(Supply { span: json.span, every_s, items });
        };
        for key in members.iter().map(|m| &m.key).filter(|k| k.value == "surplus" || k.value == "seed") {
            self.report(
                Diagnostic::new(
                    "E0133",
                    key.span,
                    format!("\"{}\" has no effect beside \"items\"", key.value),
                )
                .other(items.span, "these parts are brought as they stand")
                .note("surplus and seed make a list of parts where none is given")
                .help(format!("remove \"{}\" or \"items\"", key.value)),
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
        Some(Supply { span: json.span, every_s, items })
    }

    fn items(&mut self, json: &Json, kinds: &[&str]) -> Option<Vec<usize>> {
        let names = self.texts(json, "items")?;
        let found: Vec<_> = names.iter().map(|name| self.kind_index(name, kinds)).collect();
        found.into_iter().collect()
    }

    fn fraction(&mut self, json: &Json) -> Option<[u32; 2]> {
        let items = self.exactly(json, "surplus", &["numerator", "denominator"])?;
        let numerator = self.whole(&items[0], "surplus[0]", 0..=100);
        let denominator = self.whole(&items[1], "surplus[1]", 1..=100);
        Some([numerator?, denominator?])
    }

    fn faults(&mut self, json: &Json) -> Option<Faults> {
        let members = self.object(json, "faults")?;
        self.unknown_keys(members, &["slips", "refusals", "pauses"], "faults");
        Some(Faults {
            slips: self.each(members, "slips", Self::slip),
            refusals: self.each(members, "refusals", Self::refusal),
            pauses: self.each(members, "pauses", Self::pause),
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
        number.and_then(|j| self.whole(j, key, 1..=1_000_000))
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

    fn pause(&mut self, json: &Json) -> Option<Pause> {
        let members = self.object(json, "a pause")?;
        self.unknown_keys(members, &["at_s", "for_s"], "a pause");
        let at_s = self.required(members, "at_s", json.span, "a pause");
        let at_s = at_s.and_then(|j| self.number_in(j, "at_s", 0.0..=LONGEST_S));
        let for_s = self.required(members, "for_s", json.span, "a pause");
        let for_s = for_s.and_then(|j| self.seconds(j, "for_s"));
        Some(Pause { at_s: at_s?, for_s: for_s? })
    }
}
