//! Tables of a spreadsheet: in an encoding that is not read, too large, or with rows that are not filled.

use super::*;

#[test]
fn a_table_that_is_not_utf_8_is_refused_with_its_line() {
    let folder = folder("latin_1");
    let layout = example("scenes/lifting_table.json");
    let latin_1 = |text: &str| -> Vec<u8> { text.chars().map(|c| c as u32 as u8).collect() };
    let with_orders = example("ariac2021/default.json");
    for (ending, name) in [("\n", "lf.csv"), ("\r\n", "crlf.csv"), ("\r", "cr.csv")] {
        let text = ["text,use,de", "first,,erster", "second,,\u{fc}ber", "third,,\u{e4}"].join(ending);
        fs::write(folder.join(name), latin_1(&text)).expect("a file");
        for arguments in [
            ["build", &layout, "--texts", name],
            ["build", &layout, "--io", name],
            ["sweep", &with_orders, "--beside", name],
        ] {
            let output = autogen(&folder, &arguments);
            let said = errors(&output);
            assert_eq!(status(&output), 1, "{arguments:?}: {said}");
            let why = format!("{name}: line 3 has a byte that is not UTF-8, 16#FC");
            assert!(said.contains(&why) && said.contains("CSV UTF-8"), "{said}");
        }
    }
    assert!(!folder.join("out").exists(), "nothing is written");
}

#[test]
fn a_table_that_is_too_large_is_an_error_of_the_input() {
    let folder = folder("large_table");
    let layout = example("scenes/lifting_table.json");
    fs::write(folder.join("large.csv"), "text,use,de\n".repeat(1_000_000)).expect("a file");
    for option in ["--texts", "--io"] {
        let output = autogen(&folder, &["build", &layout, option, "large.csv"]);
        assert_eq!(status(&output), 1, "{option}: {}", errors(&output));
        assert!(errors(&output).contains("large.csv: this file is larger than 10 MB"), "{}", errors(&output));
    }
}

#[test]
fn inputs_that_a_type_reads_are_among_the_points_without_an_address() {
    let folder = folder("table_with_gaps");
    let table = "robot,name,address,raw type,scale,offset,inversion\n\
                 agv1,agv1_cmd,%QW1,UINT,,,\nkitting,kitting_cmd,%QW2,UINT,,,\n";
    fs::write(folder.join("io.csv"), table).expect("a file");
    let layout = example("ariac2021/default.json");
    let output = autogen(&folder, &["build", &layout, "--io", "io.csv", "-o", "out"]);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let said = String::from_utf8_lossy(&output.stdout);
    let missing = |robot: &str| -> Vec<&str> {
        let begin = format!("note: {robot} has points without one: ");
        let names = said.lines().find_map(|line| line.strip_prefix(&begin));
        names.unwrap_or_else(|| panic!("{robot}: {said}")).split(", ").collect()
    };
    assert_eq!(missing("the line"), ["run_permit", "start", "reset"]);
    let kitting = missing("kitting");
    for name in ["kitting_attached", "kitting_tool_x", "kitting_got", "kitting_ack", "kitting_grip"] {
        assert!(kitting.contains(&name), "{name}: {kitting:?}");
    }
    let of_agv = missing("agv1");
    assert!(of_agv.contains(&"agv1_got"), "{of_agv:?}");
    // No state of the vehicle reads where it is.
    assert!(!of_agv.contains(&"agv1_at_stop") && !of_agv.contains(&"agv1_pos_x"), "{of_agv:?}");
}
