//! The schema of scenarios.

use super::{Property, file, list, name, number, object, property, text, tuple, whole};
use crate::scenario::read::{self, LONGEST_S, faults, goal, kinds, operator, orders, supply};
use serde_json::{Value, json};

/// The least time, s.
const SHORTEST_S: f64 = 0.001;

pub fn scenario() -> Value {
    let all = vec![
        property(
            "kinds",
            json!({ "type": "array", "items": kind(), "minItems": 1, "maxItems": kinds::MOST_KINDS }),
            "The kinds of part: members of the enumeration Kind, in this order. Required with orders or supply",
        ),
        property("orders", orders(), "What is to be made: a list, or many orders of the same kind"),
        property("supply", supply(), "What the belts bring"),
        property("time_limit_s", seconds(), "Simulated time after which the run ends, s. Without it: 3600"),
        property("faults", faults(), "Faults that the run simulates"),
        property(
            "operator",
            list(operation()),
            "What a person does: at buttons and set-points, and with items",
        ),
        property(
            "goal",
            json!({ "type": "object", "additionalProperties": parts(goal::MOST_ITEMS), "minProperties": 1 }),
            "What sinks should collect, by machine.part: the number of items of each kind",
        ),
    ];
    debug_assert!(all.iter().map(|(key, _)| key.as_str()).eq(read::KEYS));
    let mut schema = file("Scenario of autogen", all, &[]);
    schema["dependencies"] = json!({ "orders": ["kinds"], "supply": ["kinds"] });
    schema["not"] = json!({ "required": ["orders", "goal"] });
    schema
}

fn seconds() -> Value {
    number(SHORTEST_S, LONGEST_S)
}

fn seconds_from_0() -> Value {
    number(0.0, LONGEST_S)
}

/// The number of parts of each kind.
fn parts(most: u32) -> Value {
    json!({ "type": "object", "additionalProperties": whole(0, most) })
}

fn kind() -> Value {
    let (lengths, masses) = (kinds::LENGTHS, kinds::MASSES);
    let length = || number(*lengths.start(), *lengths.end());
    let deck = object(
        vec![
            property(
                "height",
                number(0.0, *lengths.end()),
                "How far over its underside they lie, m. Without it: on its upper side. What is higher is a wall all around",
            ),
            property(
                "size",
                tuple(&[length(), length()]),
                "Lengths along its x and y on which they lie, m, around its middle. Without it: its own",
            ),
        ],
        &[],
    );
    let all = vec![
        property("name", name(), "Its name"),
        property("height", length(), "Height over what it lies on, m"),
        property(
            "grasp",
            length(),
            "Height over what it lies on at which a tool grips it, m. Without it: its height",
        ),
        property(
            "size",
            tuple(&[length(), length()]),
            "Lengths along x and y as it appears on a belt, m. Without it: 0.1 each",
        ),
        property("is", list(text()), "Words that sensors detect, such as metal"),
        property("mass", number(*masses.start(), *masses.end()), "kg. Without it: 0.1"),
        property("bears", deck, "Other items lie on it and go on with it: a pallet, a tray, a box"),
    ];
    object(all, &["name", "height"])
}

fn orders() -> Value {
    let count = json!({ "anyOf": [whole(0, orders::MOST_ORDERS), { "const": orders::WITHOUT_END }] });
    let stations = json!({ "anyOf": [{ "const": "in turn" }, several()] });
    let parts = || parts(orders::MOST_OF_A_KIND);
    let of_each = "How many parts of each kind one order has";
    let many = object(
        vec![
            property("count", count, "Number of orders, all the same, or without end"),
            property("parts", parts(), of_each),
            property("stations", stations, "The stations that get them in turn. Without it: all"),
        ],
        &["count", "parts"],
    );
    let station = json!({ "anyOf": [text(), several()] });
    let one = object(
        vec![
            property(
                "station",
                station,
                "Stations at which it opens: one or several. Without it: the next one in turn",
            ),
            property("parts", parts(), of_each),
        ],
        &["parts"],
    );
    let listed = json!({ "type": "array", "items": one, "maxItems": orders::MOST_ORDERS });
    json!({ "anyOf": [many, listed] })
}

/// Names of stations.
fn several() -> Value {
    json!({ "type": "array", "items": text(), "minItems": 1 })
}

fn supply() -> Value {
    let items =
        json!({ "anyOf": [list(text()), { "type": "object", "additionalProperties": list(text()) }] });
    let all = vec![
        property(
            "surplus",
            tuple(&[whole(0, supply::MOST_SURPLUS), whole(1, supply::MOST_SURPLUS)]),
            "A fraction of additional parts of each kind, rounded up. Without it: [1, 3]",
        ),
        property("seed", whole(0, u32::MAX), "Seed of the shuffled parts. Without it: 1"),
        property(
            "first_s",
            seconds_from_0(),
            "Time until the first part on each belt, s. Without it: every_s",
        ),
        property("every_s", seconds(), "Time between two parts on one belt, s. Without it: 2"),
        property("items", items, "The parts themselves: kinds for the only belt, or a list for each belt"),
        property(
            "times",
            whole(1, supply::MOST_TIMES),
            "With items: how often a list is repeated. Without it: 1",
        ),
    ];
    let mut schema = object(all, &[]);
    schema["not"] = json!({ "required": ["items", "surplus"] });
    schema
}

fn robot() -> Property {
    property("robot", text(), "The machine")
}

fn faults() -> Value {
    let nth = || whole(1, faults::LAST);
    let slip = object(
        vec![
            robot(),
            property("pick", nth(), "At which pick of this arm, from 1"),
            property("after_s", seconds_from_0(), "How long after it, s"),
        ],
        &["robot", "pick", "after_s"],
    );
    let command = property("command", nth(), "Which command of this machine, from 1");
    let refusal = object(vec![robot(), command.clone()], &["robot", "command"]);
    let answer = object(
        vec![
            robot(),
            command,
            property("late_s", seconds_from_0(), "Delay of the answer, s"),
            property("error", whole(1, 255), "The error in which it ends. Without it: its usual result"),
        ],
        &["robot", "command"],
    );
    let pause = object(
        vec![
            property("at_s", seconds_from_0(), "Beginning, s"),
            property("for_s", seconds(), "For how long, s"),
        ],
        &["at_s", "for_s"],
    );
    let begins = || property("at_s", seconds_from_0(), "Beginning, s");
    let lasts = || property("for_s", seconds(), "For how long, s. Without it: to the end of the run");
    let part = |meaning: &str| property("part", text(), meaning);
    let jam = object(
        vec![
            robot(),
            part("The name of a cylinder, a conveyor, a vehicle or an arm in its device"),
            begins(),
            lasts(),
        ],
        &["robot", "part", "at_s"],
    );
    let slow = object(
        vec![
            robot(),
            part("The name of a process in its device"),
            property("cycle", nth(), "Which cycle of it, from 1"),
            property("longer_s", seconds(), "How much longer it takes, s"),
        ],
        &["robot", "part", "cycle", "longer_s"],
    );
    let stuck = {
        let element = json!({ "anyOf": [whole(0, faults::LAST_ELEMENT), text()] });
        let reads = json!({ "anyOf": [{ "type": "boolean" }, number(-operator::MOST, operator::MOST)] });
        object(
            vec![
                robot(),
                property("signal", text(), "The name of an input of its device"),
                property(
                    "element",
                    element,
                    "Of several elements: a number from 0, or a kind. Without it: all",
                ),
                property("reads", reads, "The value that the controller reads"),
                begins(),
                lasts(),
            ],
            &["robot", "signal", "reads", "at_s"],
        )
    };
    let all = vec![
        property("slips", list(slip), "Parts that fall off a gripper"),
        property("refusals", list(refusal), "Commands that a machine refuses"),
        property("answers", list(answer), "How commands end, and how late"),
        property("pauses", list(pause.clone()), "The permit to run is false, then the line is started again"),
        property(
            "power_offs",
            list(pause),
            "The controller loses its power; when it has it again, the line is started again",
        ),
        property("sensors", list(stuck), "Inputs that stick at a value"),
        property("jams", list(jam), "Parts that stand though they should move"),
        property("slow", list(slow), "Cycles of processes that take longer"),
    ];
    debug_assert!(all.iter().map(|(key, _)| key.as_str()).eq(faults::KEYS));
    object(all, &[])
}

fn operation() -> Value {
    let all = vec![
        robot(),
        property(
            "part",
            text(),
            "The name of a button or a set-point in the device of the robot; without a robot start or reset, of the line",
        ),
        property("at_s", seconds_from_0(), "When, s from the start of the run"),
        property("for_s", seconds(), "For how long, s. Without it: to the end of the run"),
        property("value", number(-operator::MOST, operator::MOST), "The number that is set at a set-point"),
        property(
            "remove",
            text(),
            "An item that the person takes off the line, such as battery_3; with at_s alone",
        ),
    ];
    let mut operation = object(all, &["at_s"]);
    operation["oneOf"] = json!([{ "required": ["part"] }, { "required": ["remove"] }]);
    operation
}
