//! Scenarios, for the default line.

use super::{Shape, repeated};

pub const ALL: &[fn(usize) -> Shape] = &[
    stations_of_an_order,
    stations_in_turn,
    orders,
    supply,
    belts,
    slips,
    kinds,
    great_orders,
    unknown_kinds,
];

const KINDS: &str = "\"kinds\":[{\"name\":\"battery\",\"height\":0.05}]";

fn shape(name: &'static str, rest: String) -> Shape {
    let layout = include_str!("../../../examples/ariac2021/default.json").into();
    Shape { name, layout, scenario: format!("{{{rest}}}"), ..Shape::default() }
}

fn items(bytes: usize, item: impl Fn(usize) -> String) -> String {
    repeated(bytes, item).trim_end_matches(',').into()
}

fn stations_of_an_order(bytes: usize) -> Shape {
    let names = items(bytes, |i| format!("\"s{i}\","));
    let order = format!("{{\"parts\":{{\"battery\":1}},\"station\":[{names}]}}");
    shape("stations_of_an_order", format!("{KINDS},\"orders\":[{order}]"))
}

fn stations_in_turn(bytes: usize) -> Shape {
    let names = items(bytes, |_| "\"as1\",".into());
    let rest = format!("\"orders\":{{\"count\":10000,\"parts\":{{\"battery\":1}},\"stations\":[{names}]}}");
    shape("stations_in_turn", format!("{KINDS},{rest}"))
}

fn orders(bytes: usize) -> Shape {
    let orders = items(bytes, |_| "{\"parts\":{\"battery\":1}},".into());
    shape("orders", format!("{KINDS},\"orders\":[{orders}]"))
}

fn supply(bytes: usize) -> Shape {
    let parts = items(bytes, |_| "\"battery\",".into());
    shape("supply", format!("{KINDS},\"orders\":[],\"supply\":{{\"items\":[{parts}]}}"))
}

fn belts(bytes: usize) -> Shape {
    let belts = items(bytes, |i| format!("\"b{i}\":[],"));
    shape("belts", format!("{KINDS},\"orders\":[],\"supply\":{{\"items\":{{{belts}}}}}"))
}

fn slips(bytes: usize) -> Shape {
    let slips = items(bytes, |i| format!("{{\"robot\":\"k{i}\",\"pick\":1,\"after_s\":1}},"));
    shape("slips", format!("{KINDS},\"orders\":[],\"faults\":{{\"slips\":[{slips}]}}"))
}

fn kinds(bytes: usize) -> Shape {
    let kinds = items(bytes, |i| format!("{{\"name\":\"k{i}\",\"height\":0.1}},"));
    shape("kinds", format!("\"kinds\":[{kinds}],\"orders\":[]"))
}

fn great_orders(_: usize) -> Shape {
    let rest = "\"orders\":{\"count\":10000,\"parts\":{\"battery\":12}},\"supply\":{\"surplus\":[100,1]}";
    shape("great_orders", format!("{KINDS},{rest}"))
}

fn unknown_kinds(bytes: usize) -> Shape {
    let parts = items(bytes, |i| format!("\"k{i}\":1,"));
    shape("unknown_kinds", format!("{KINDS},\"orders\":{{\"count\":1,\"parts\":{{{parts}}}}}"))
}
