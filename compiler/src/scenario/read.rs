//! From the text of a scenario to its tree.

pub mod faults;
pub mod goal;
pub mod kinds;
pub mod operator;
pub mod orders;
pub mod supply;

use super::{Items, Orders, Scenario, Supply};
use crate::diagnostic::{Diagnostic, sort};
use crate::layout::decode::{Decoder, find};
use crate::layout::json::{self, Json, Member};
use crate::source::{FileId, Sources};
use std::collections::BTreeSet;

pub const KEYS: [&str; 7] = ["kinds", "orders", "supply", "time_limit_s", "faults", "operator", "goal"];
pub const LONGEST_S: f64 = 1e6;
const TIME_LIMIT_S: f64 = 3600.0;
const EVERY_S: f64 = 2.0;
const SURPLUS: [u32; 2] = [1, 3];
const SEED: u32 = 1;

/// There is a scenario only without any error.
pub fn parse(sources: &Sources, file: FileId) -> (Option<Scenario>, Vec<Diagnostic>) {
    let (json, diagnostics) = json::parse(&sources.file(file).text, file);
    let mut decoder = Decoder::new(diagnostics);
    let scenario = json.and_then(|json| decoder.scenario(&json));
    sort(&mut decoder.diagnostics);
    (scenario.filter(|_| decoder.diagnostics.is_empty()), decoder.diagnostics)
}

/// The names of the kinds of part, whatever else is wrong with the scenario. `None`: they cannot be read, or the key
/// `kinds` is not there although the scenario has errors, so that it may be misspelt.
pub fn kinds(sources: &Sources, file: FileId) -> Option<Vec<String>> {
    if let (Some(scenario), _) = parse(sources, file) {
        return Some(scenario.names_of_kinds());
    }
    let (json, diagnostics) = json::parse(&sources.file(file).text, file);
    if !diagnostics.is_empty() {
        return None;
    }
    let mut decoder = Decoder::new(diagnostics);
    let json = json?;
    let list = find(decoder.object(&json, "a scenario")?, "kinds")?;
    let kinds = decoder.kinds(list)?;
    let names: BTreeSet<&str> = kinds.iter().map(|kind| kind.name.value.as_str()).collect();
    let is_whole = names.len() == decoder.list(list, "kinds")?.len();
    is_whole.then(|| kinds.into_iter().map(|kind| kind.name.value).collect())
}

impl Decoder {
    fn scenario(&mut self, json: &Json) -> Option<Scenario> {
        let members = self.object(json, "a scenario")?;
        self.unknown_keys_of_file(members, &KEYS, "a scenario", |_| None);
        // Without orders nothing has to be brought, and nobody has to tell kinds apart.
        let has_parts = ["kinds", "orders", "supply"].iter().any(|key| find(members, key).is_some());
        let kinds = if has_parts {
            self.required(members, "kinds", json.span, "the scenario").map(|json| self.kinds(json))
        } else {
            Some(Some(vec![kinds::any(json.span)]))
        };
        let orders = find(members, "orders");
        let time_limit_s = self.seconds_or(members, "time_limit_s", TIME_LIMIT_S);
        let faults = find(members, "faults").and_then(|j| self.faults(j)).unwrap_or_default();
        let known = kinds.as_ref().and_then(Option::as_ref);
        let known: Option<Vec<&str>> =
            known.map(|kinds| kinds.iter().map(|kind| kind.name.value.as_str()).collect());
        let operator = find(members, "operator").map(|j| self.operator(j, known.as_deref()));
        let operator = operator.unwrap_or_default();
        let kinds = kinds??;
        let names: Vec<&str> = kinds.iter().map(|k| k.name.value.as_str()).collect();
        let goal = find(members, "goal").map_or_else(Vec::new, |j| self.goal(j, &names));
        if let (Some(orders), Some(goal)) = (orders, find(members, "goal")) {
            self.report(
                Diagnostic::new("E0145", goal.span, "a scenario has orders or a goal, not both")
                    .other(orders.span, "the orders are here")
                    .help("remove one of them"),
            );
        }
        let orders = match orders {
            Some(orders) => self.orders(orders, &names),
            None => Some(Orders::none(json.span)),
        };
        let supply = match find(members, "supply") {
            Some(supply) => self.supply(supply, &names),
            None => Some(Supply {
                span: json.span,
                first_s: EVERY_S,
                every_s: EVERY_S,
                seed: SEED,
                items: Items::Shuffled { surplus: SURPLUS },
                times: 1,
            }),
        };
        Some(Scenario {
            file: json.span.file,
            kinds,
            orders: orders?,
            supply: supply?,
            time_limit_s,
            faults,
            operations: operator.operations,
            removals: operator.removals,
            goal,
        })
    }

    /// A time longer than nothing.
    fn seconds(&mut self, json: &Json, key: &str) -> Option<f64> {
        self.number_in(json, key, 0.001..=LONGEST_S)
    }

    fn seconds_or(&mut self, members: &[Member], key: &str, default: f64) -> f64 {
        find(members, key).and_then(|j| self.seconds(j, key)).unwrap_or(default)
    }
}
