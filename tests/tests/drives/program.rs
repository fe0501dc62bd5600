//! A text to be run: reference blocks, motion blocks by PLCopen, and a wiring of `docs/drives.md`.

use autogen_st_judge::machine::Machine;
use autogen_st_judge::{dead, judge, listed};
use autogen_tests::text;
use std::collections::BTreeSet;

/// Runs the PROGRAM of this name.
pub fn machine(wiring: &str) -> Machine {
    let source = source(wiring);
    Machine::new(&source).unwrap_or_else(|findings| panic!("{}", listed(&findings, &source)))
}

/// The same, with another text in its place.
pub fn machine_with(wiring: &str, text: &str, other: &str) -> Machine {
    let source = source(wiring);
    assert_eq!(source.matches(text).count(), 1, "{text}");
    let source = source.replace(text, other);
    Machine::new(&source).unwrap_or_else(|findings| panic!("{}", listed(&findings, &source)))
}

fn source(wiring: &str) -> String {
    let program = on_the_page(wiring);
    let block = match wiring {
        "Lift_wiring" => "axis.st",
        "Kitting_wiring" => "robot.st",
        _ => "inverter.st",
    };
    let block = text(&format!("templates/plc/drives/{block}"));
    let motion = if block.contains("MC_") { text("tests/fixtures/drives/motion.st") } else { String::new() };
    // The type of an axis is the vendor's. The motion blocks of the tests take its number.
    let units = format!("{motion}{block}{program}").replace("AXIS_REF", "DINT");
    format!(
        "{units}CONFIGURATION Config0\nVAR_GLOBAL\n{}END_VAR\nRESOURCE Res0 ON PLC\n\
         TASK Cyclic(INTERVAL := T#10ms, PRIORITY := 0);\nPROGRAM Wired WITH Cyclic : {wiring};\nEND_RESOURCE\n\
         END_CONFIGURATION\n",
        globals(&units)
    )
}

/// The PROGRAM of this name, as the page shows it.
fn on_the_page(name: &str) -> String {
    let page = text("docs/drives.md");
    let begin = page.find(&format!("PROGRAM {name}\n")).expect("the program stands on the page");
    let length = page[begin..].find("```").expect("the end of a listing");
    page[begin..begin + length].to_string()
}

/// A global for each external variable of the units.
fn globals(units: &str) -> String {
    let sections =
        units.split("VAR_EXTERNAL\n").skip(1).map(|rest| rest.split("END_VAR").next().unwrap_or(""));
    let lines: BTreeSet<&str> = sections.flat_map(str::lines).collect();
    lines.into_iter().map(|line| format!("{line}\n")).collect()
}

#[test]
fn the_blocks_keep_to_the_portable_language() {
    for wiring in ["Lift_wiring", "Kitting_wiring", "Belt_wiring"] {
        let source = source(wiring);
        let checked = judge(&source).unwrap_or_else(|findings| panic!("{}", listed(&findings, &source)));
        assert!(checked.untried.is_empty(), "{}", listed(&checked.untried, &source));
        let unread: Vec<_> = dead::dead(&checked).iter().map(|found| found.located(&source)).collect();
        let unread: Vec<_> = unread.into_iter().filter(|found| !is_of_the_vendor(found)).collect();
        assert!(unread.is_empty(), "{unread:?}");
    }
}

/// Outputs of motion blocks that the reference block has no use for.
fn is_of_the_vendor(found: &str) -> bool {
    ["`Valid`", "`Busy`", "`Active`", "`Done`", "`CommandAborted`"].iter().any(|name| found.contains(name))
}
