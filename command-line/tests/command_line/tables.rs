//! Tables of a spreadsheet in an encoding that is not read, or too large.

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
