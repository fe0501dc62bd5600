//! All tests of the whole in one program: it is linked once, and its tests run beside one another.

mod axes;
mod collisions;
mod compared;
mod conveying;
mod counterexamples;
mod crossing;
mod devices;
mod distances;
mod disturbed;
mod driven_through;
mod drives;
mod errors;
mod examples;
mod fault_campaign;
mod faults;
mod figures;
mod flow;
mod forgotten;
mod format;
mod generated;
mod grasps;
mod import;
mod interlocks;
mod io_map;
mod io_trace;
mod language;
mod late_signals;
mod layout;
mod limits;
mod lines;
mod loads;
mod looking_ahead;
mod margins;
mod missed;
mod mistakes;
mod mutants;
mod names;
mod openplc;
mod oriented;
mod over_places;
mod plan;
mod plcopen;
mod postponed;
mod processes;
mod processes_on_lanes;
mod remembered;
mod replaced;
mod replays;
mod report;
mod retained;
mod rust;
mod scenes;
mod schema;
mod searched_properties;
mod sideways;
mod specs;
mod spin;
mod st_compared;
mod st_output;
mod stacking;
mod stepping;
mod strokes;
mod structured_text;
mod sweep_page;
mod table1;
mod texts;
mod together;
mod traces;
mod trays;
mod tutorial;
mod vehicles;
mod verdicts;
mod verify;
mod visits;
mod waiting;
mod ways;
mod why;
mod world;
mod wrong_plants;

/// Those of the bench.
#[path = "../benches/cost/lines.rs"]
pub(crate) mod long_lines;

use autogen_tests::{root, text};
use std::collections::BTreeSet;

#[test]
fn every_file_is_part_of_this_program() {
    let entries = std::fs::read_dir(root().join("tests/tests")).expect("the folder");
    let names = entries.map(|entry| entry.expect("an entry").file_name().into_string().expect("a name"));
    let files: BTreeSet<String> = names
        .map(|name| name.trim_end_matches(".rs").to_owned())
        .filter(|name| !["main", "snapshots"].contains(&name.as_str()))
        .collect();
    let main = text("tests/tests/main.rs");
    let named = main.lines().filter_map(|line| line.strip_prefix("mod ")?.strip_suffix(';'));
    assert_eq!(files, named.map(str::to_owned).collect());
}
