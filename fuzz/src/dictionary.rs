//! Words of each grammar, from where the grammar itself has them: the documented productions, the tables of
//! devices and of raw types, the definition of the command line.

use autogen::io_map::Raw;
use autogen::library;
use autogen::spec::parser::RESERVED;
use autogen_command_line::Cli;
use autogen_tests::text;
use clap::{Command, CommandFactory};
use runtime_sim::part::ALL;
use std::collections::BTreeSet;
use std::fmt::Write;

/// Numbers at which something ends.
pub const NUMBERS: [&str; 26] = [
    "0",
    "1",
    "-1",
    "2",
    "12",
    "13",
    "63",
    "64",
    "65",
    "255",
    "256",
    "1000",
    "1001",
    "1024",
    "1025",
    "10000",
    "32767",
    "2147483647",
    "2147483648",
    "4294967295",
    "4294967296",
    "0.0001",
    "1e9",
    "1e308",
    "1e-308",
    "-0.0",
];

/// A dictionary as libFuzzer reads it.
pub fn file(words: &[String]) -> String {
    let mut out = String::new();
    for word in words {
        let mut quoted = String::new();
        for byte in word.bytes() {
            match byte {
                b'"' | b'\\' => quoted += &format!("\\{}", char::from(byte)),
                0x20..0x7f => quoted.push(char::from(byte)),
                _ => quoted += &format!("\\x{byte:02X}"),
            }
        }
        let _ = writeln!(out, "\"{quoted}\"");
    }
    out
}

pub fn layout() -> Vec<String> {
    let mut words = json("docs/layout.md");
    words.extend(devices());
    words
        .extend(["conveyor", "kitting", "agv", "gantry", "station", "bin"].map(|kind| format!("\"{kind}\"")));
    sorted(words)
}

pub fn scenario() -> Vec<String> {
    let mut words = json("docs/layout.md");
    words.extend(["belt", "kitting", "agv1", "gantry", "as1"].map(|robot| format!("\"{robot}\"")));
    sorted(words)
}

pub fn specification() -> Vec<String> {
    let mut words: Vec<String> = RESERVED.iter().map(|word| word.to_string()).collect();
    let page = text("docs/language.md");
    for production in blocks(&page, "ebnf") {
        words.extend(between(production, '"').filter(|word| !word.is_empty()).map(String::from));
    }
    words.extend(["min(", "max(", "abs(", "point(", "up(", "squared_distance(", "count("].map(String::from));
    words.extend(devices());
    sorted(words)
}

pub fn table() -> Vec<String> {
    let columns =
        ["robot", "name", "direction", "type", "address", "raw type", "scale", "offset", "inversion"];
    let raw = ["BOOL", "SINT", "USINT", "INT", "UINT", "DINT"];
    debug_assert!(raw.iter().all(|name| Raw::named(name).is_some()));
    let others = [
        ",",
        ";",
        "\t",
        "\n",
        "\r\n",
        "\"",
        "\"\"",
        "TRUE",
        "FALSE",
        "LREAL",
        "input",
        "output",
        "%IX0.0",
        "%QX0.7",
        "%IB1",
        "%IW2",
        "%QW3",
        "%ID4",
        "%QD4294967295",
        "%MX0.0",
        "%MD10",
        "%IL0",
        "0.001",
        "0,001",
        "1e-300",
        "seconds_per_order",
        "layout",
        "agv.capacity",
        "order",
        "io_delay",
        "belt",
        "kitting",
        "agv1",
        "gantry",
        "as1",
        "run_permit",
        "start",
        "reset",
        "running",
        "fault",
        "fault_code",
        "fault_robot",
        "agv1_got",
        "agv1_ack",
        "agv1_cmd",
        "agv1_pos_x",
        "belt_hold",
        "kitting_grip",
    ];
    let words = columns.into_iter().chain(raw).chain(others).chain(NUMBERS);
    sorted(words.map(String::from).collect())
}

/// Elements, attributes and words of URDF; keys of OPW parameters and of LIF.
pub fn import() -> Vec<String> {
    let elements = [
        "robot",
        "link",
        "joint",
        "parent",
        "child",
        "origin",
        "axis",
        "limit",
        "dynamics",
        "mimic",
        "collision",
        "geometry",
        "box",
        "cylinder",
        "capsule",
        "sphere",
        "mesh",
        "inertial",
        "mass",
        "xacro:include",
    ];
    let attributes = [
        "name", "type", "link", "xyz", "rpy", "lower", "upper", "velocity", "effort", "damping", "friction",
        "joint", "size", "radius", "length", "filename", "scale", "value",
    ];
    let words = [
        "fixed",
        "revolute",
        "continuous",
        "prismatic",
        "planar",
        "floating",
        "0 0 1",
        "0 1 0",
        "1 0 0",
        "0 0 0",
        "nan",
        "inf",
        "tool0",
        "flange",
        "package://a/b.stl",
        "${x}",
        "&lt;",
        "&#0;",
        "&a;",
        "<!--",
        "-->",
        "<![CDATA[",
        "]]>",
        "<?xml version=\"1.0\"?>",
        "<!DOCTYPE a [",
        "<!ENTITY a \"b\">",
        "/>",
        "</",
        "opw_kinematics_geometric_parameters:",
        "opw_kinematics_joint_offsets:",
        "opw_kinematics_joint_sign_corrections:",
        "offsets:",
        "sign_corrections:",
        "a1:",
        "a2:",
        "b:",
        "c1:",
        "c2:",
        "c3:",
        "c4:",
        "deg(",
        "rad(",
        "- ",
        "---",
        "!!float",
        "&a",
        "*a",
        "|",
        ">",
        "\"",
        "'",
        "#",
        "\n",
        "\n  ",
        "\t",
        "[",
        "]",
        "{",
        "}",
        ":",
        ",",
        "null",
        "true",
    ];
    let keys = [
        "metaInformation",
        "projectIdentification",
        "lifVersion",
        "1.0.0",
        "layouts",
        "nodes",
        "edges",
        "stations",
        "nodeId",
        "nodePosition",
        "x",
        "y",
        "edgeId",
        "startNodeId",
        "endNodeId",
        "vehicleTypeEdgeProperties",
        "vehicleTypeId",
        "maxSpeed",
        "trajectory",
        "controlPoints",
        "stationId",
        "stationName",
        "interactionNodeIds",
    ];
    let elements = elements.iter().flat_map(|name| [format!("<{name} "), format!("</{name}>")]);
    let attributes = attributes.iter().map(|name| format!("{name}=\""));
    let keys = keys.iter().map(|key| format!("\"{key}\""));
    let words = words.iter().chain(&NUMBERS).map(|word| word.to_string());
    sorted(elements.chain(attributes).chain(keys).chain(words).collect())
}

pub fn command_line() -> Vec<String> {
    let mut words = Vec::new();
    let cli = Cli::command();
    options(&cli, &mut words);
    for command in cli.get_subcommands() {
        words.push(command.get_name().to_string());
        options(command, &mut words);
    }
    let values = [
        "line.json",
        "agv.capacity=4",
        "agv1.capacity=2,4,8",
        "kitting.speed=0.1",
        "gantry.speed=1",
        "E0401",
        "random",
        "random:7",
        "battery_1,pump_3",
        "paths.csv",
        "paths.json",
        "paths.svg",
        "plan",
        "connectivity",
        "--",
        "=",
        ",",
        "[",
        "]",
        "{",
        "}",
        "\"",
        "\\",
        "\n",
    ];
    words.extend(values.into_iter().chain(NUMBERS).map(String::from));
    sorted(words)
}

fn options(command: &Command, words: &mut Vec<String>) {
    for argument in command.get_arguments() {
        words.extend(argument.get_long().map(|name| format!("--{name}")));
        words.extend(argument.get_short().map(|letter| format!("-{letter}")));
        words.extend(argument.get_possible_values().iter().map(|value| value.get_name().to_string()));
    }
}

/// Keys of the JSON blocks of a page and of the first columns of its tables, and what stands in quotes.
fn json(page: &str) -> Vec<String> {
    let page = text(page);
    let mut words: Vec<String> =
        ["{", "}", "[", "]", ":", ",", "true", "false", "null", "\"in turn\"", "\"without end\""]
            .into_iter()
            .chain(NUMBERS)
            .map(String::from)
            .collect();
    for block in blocks(&page, "json") {
        words.extend(between(block, '"').filter(|word| is_name(word)).map(|word| format!("\"{word}\"")));
    }
    for line in page.lines().filter(|line| line.starts_with('|')) {
        let first = line.split('|').nth(1).unwrap_or_default();
        words.extend(between(first, '`').filter(|word| is_name(word)).map(|word| format!("\"{word}\"")));
    }
    words
}

/// Names that the devices give: their own, of ports, commands, constants, places.
fn devices() -> Vec<String> {
    let mut words = Vec::new();
    for device in library::devices() {
        words.push(device.name.clone());
        words.extend(device.ports.iter().map(|port| port.name.clone()));
        words.extend(device.verbs.iter().map(|verb| verb.name.clone()));
        words.extend(device.constants.iter().map(|constant| constant.name.clone()));
        words.extend(device.handovers.iter().map(|handover| handover.name.clone()));
    }
    for schema in ALL {
        words.push(schema.name.into());
        words.extend(schema.settings.iter().map(|setting| setting.name.into()));
        words.extend(schema.signals.iter().map(|signal| signal.name.into()));
        words.extend(schema.levels.iter().map(|level| level.name.into()));
        words.extend(schema.actions.iter().map(|action| action.name.into()));
    }
    words
}

/// The fenced blocks of a page whose language begins so.
fn blocks<'p>(page: &'p str, language: &'p str) -> impl Iterator<Item = &'p str> {
    let fenced = page.split("\n```").skip(1).step_by(2);
    fenced
        .filter(move |block| block.starts_with(language))
        .map(|block| block.split_once('\n').map_or("", |(_, b)| b))
}

/// What stands between two marks, line by line.
fn between(text: &str, mark: char) -> impl Iterator<Item = &str> {
    text.lines().flat_map(move |line| line.split(mark).skip(1).step_by(2))
}

fn is_name(word: &str) -> bool {
    !word.is_empty() && word.chars().all(|c| c.is_ascii_alphanumeric() || c == '_')
}

fn sorted(words: Vec<String>) -> Vec<String> {
    words.into_iter().collect::<BTreeSet<_>>().into_iter().collect()
}
