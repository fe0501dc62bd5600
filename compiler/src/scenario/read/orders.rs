//! The orders.

use crate::diagnostic::Diagnostic;
use crate::layout::decode::{Decoder, find};
use crate::layout::json::{Json, Member, Value};
use crate::scenario::{Number, Order, Orders};
use crate::source::{Span, Spanned};
use std::collections::HashMap;

pub const MOST_ORDERS: u32 = 10_000;
/// The `count` of orders that continue until the time limit.
pub const WITHOUT_END: &str = "without end";
/// Highest value of the port `order_parts` of a station.
pub const MOST_OF_A_KIND: u32 = 12;

impl Decoder {
    pub(super) fn orders(&mut self, json: &Json, kinds: &[&str]) -> Option<Orders> {
        let Value::Object(members) = &json.value else {
            return self.order_list(json, kinds);
        };
        self.unknown_keys(members, &["count", "parts", "stations"], "orders");
        let count = self.required(members, "count", json.span, "orders");
        let (number, count) = match count.map(|j| &j.value) {
            Some(Value::Text(text)) if text == WITHOUT_END => (Number::WithoutEnd, Some(1)),
            _ => (Number::Listed, count.and_then(|j| self.whole(j, "count", 0..=MOST_ORDERS))),
        };
        let parts = self.required(members, "parts", json.span, "orders");
        let parts = parts.and_then(|j| self.parts(j, kinds));
        let stations = find(members, "stations").and_then(|j| self.stations(j));
        let order = Order { stations: None, parts: parts? };
        Some(Orders { span: json.span, list: vec![order; count? as usize], number, stations })
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
        Some(Orders {
            span: json.span,
            list: list.into_iter().collect::<Option<_>>()?,
            number: Number::Listed,
            stations: None,
        })
    }

    fn order(&mut self, json: &Json, kinds: &[&str]) -> Option<Order> {
        let members = self.object(json, "an order")?;
        self.unknown_keys(members, &["station", "parts"], "an order");
        let stations = find(members, "station").map(|j| self.one_or_several(j));
        let parts = self.required(members, "parts", json.span, "an order");
        let parts = parts.and_then(|j| self.parts(j, kinds))?;
        Some(Order { stations: stations.flatten(), parts })
    }

    /// The name of a station, or a list of names.
    fn one_or_several(&mut self, json: &Json) -> Option<Vec<Spanned<String>>> {
        let Value::List(items) = &json.value else {
            return self.text(json, "station").map(|name| vec![name]);
        };
        if items.is_empty() {
            self.report(
                Diagnostic::new("E0113", json.span, "station names no station")
                    .help("name one or several; without the key \"station\" the order goes to all in turn"),
            );
            return None;
        }
        let names = self.texts(json, "station")?;
        let mut before: HashMap<&str, Span> = HashMap::new();
        for name in &names {
            let first = *before.entry(&name.value).or_insert(name.span);
            if first != name.span {
                self.report(
                    Diagnostic::new("E0113", name.span, format!("\"{}\" occurs here twice", name.value))
                        .other(first, "here first")
                        .note("an order opens once at each of its stations")
                        .help("remove one"),
                );
            }
        }
        Some(names)
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
                    .note("an order is made when its parts are in the briefcase: this one would be made at once")
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
                        .note(
                            "\"in turn\" distributes the orders to all stations of the layout, in its order",
                        )
                        .help("write \"in turn\", or a list such as [\"as1\"]"),
                );
                None
            }
        }
    }
}
