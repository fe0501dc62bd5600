//! `autogen sweep --part` and `autogen merge`.

use super::sweep::{ONE_PART, printed, put};
use super::{autogen, errors, example, folder, json, status};
use serde_json::Value;
use std::fs;
use std::path::Path;
use std::process::Output;

/// A sweep of six points, of which half are refused, twice each.
fn sweep(folder: &Path, more: &[&str]) -> Output {
    let layout = example("ariac2021/default.json");
    let fixed = ["sweep", &layout, "--scenario", "short.json", "--set", "agv.capacity=1,13"];
    let varied = ["--order", "1,2,3", "--replications", "2", "--warm-up", "0orders"];
    autogen(folder, &[&fixed[..], &varied[..], more].concat())
}

/// Writes a part of that sweep into a file.
fn part(folder: &Path, number: usize, of: usize) -> String {
    let output = sweep(folder, &["--part", &format!("{number}/{of}")]);
    assert!([0, 3].contains(&status(&output)), "{}", errors(&output));
    let name = format!("part{number}of{of}.jsonl");
    put(folder, &name, &printed(&output));
    name
}

fn begun(name: &str) -> std::path::PathBuf {
    let folder = folder(name);
    put(&folder, "short.json", ONE_PART);
    folder
}

fn merge(folder: &Path, files: &[&str], more: &[&str]) -> Output {
    autogen(folder, &[&["merge"], files, more].concat())
}

#[test]
fn parts_make_the_bytes_of_the_whole() {
    let folder = begun("parts_bytes");
    let names: Vec<String> = [3, 1, 5, 2, 4].iter().map(|number| part(&folder, *number, 5)).collect();
    let files: Vec<&str> = names.iter().map(String::as_str).collect();
    put(&folder, "figures.csv", "agv.capacity,seconds_per_order\n1,20\n");
    for table in [
        &["--format", "csv"][..],
        &["--format", "json", "--beside", "figures.csv"],
        &["--format", "jsonl", "--compare"],
        &["--format", "text"],
    ] {
        let whole = sweep(&folder, table);
        let merged = merge(&folder, &files, table);
        assert_eq!(status(&whole), 3, "{}", errors(&whole));
        assert_eq!(status(&merged), 3, "{}", errors(&merged));
        assert!(whole.stdout == merged.stdout, "{}\n{}", printed(&whole), printed(&merged));
    }
    // Every run stands in one of the parts, and says by itself which one it is.
    let texts: String =
        files.iter().map(|name| fs::read_to_string(folder.join(name)).expect("a part")).collect();
    let lines = texts.lines().map(|line| serde_json::from_str::<Value>(line).expect("an object"));
    let runs: Vec<Value> = lines.filter(|line| line.get("autogen_sweep_part").is_none()).collect();
    let mut named: Vec<String> = (runs.iter())
        .map(|run| format!("{} {} {} {}", run["layout"], run["set"], run["order_seed"], run["replication"]))
        .collect();
    named.sort();
    named.dedup();
    assert_eq!((runs.len(), named.len()), (12, 12));
}

#[test]
fn parts_make_the_page_of_the_whole() {
    let folder = begun("parts_page");
    let types = example("lathe/lathe.aut");
    let specs = ["--specs", &types];
    let names: Vec<String> = (1..=2)
        .map(|number| {
            let output = sweep(&folder, &[&specs[..], &["--part", &format!("{number}/2")]].concat());
            put(&folder, &format!("{number}.jsonl"), &printed(&output));
            format!("{number}.jsonl")
        })
        .collect();
    let files: Vec<&str> = names.iter().rev().map(String::as_str).collect();
    let page = |name: &str| fs::read_to_string(folder.join(name)).expect("a page");
    let whole = sweep(&folder, &[&specs[..], &["--compare", "--report", "whole.html"]].concat());
    let merged = merge(&folder, &files, &["--compare", "--report", "merged.html"]);
    assert_eq!((status(&whole), status(&merged)), (3, 3), "{}", errors(&merged));
    assert!(whole.stdout == merged.stdout);
    let whole = page("whole.html");
    assert!(["short.json", "lathe.aut"].iter().all(|name| whole.contains(name)));
    assert!(whole == page("merged.html"));
    // A file that is no page stays, and is told before anything is printed.
    put(&folder, "notes.html", "by hand");
    let refused = merge(&folder, &files, &["--report", "notes.html"]);
    assert_eq!((status(&refused), printed(&refused)), (2, String::new()));
    assert!(errors(&refused).contains("notes.html"), "{}", errors(&refused));
    assert_eq!(page("notes.html"), "by hand");
    // A part that does not say of what is none; what it says is text.
    let text = page("1.jsonl");
    let (head, rest) = text.split_once('\n').expect("two lines");
    let mut head: Value = serde_json::from_str(head).expect("an object");
    head["about"]["seed"] = "</script><b>seed</b>".into();
    put(&folder, "1.jsonl", &format!("{head}\n{rest}"));
    assert_eq!(status(&merge(&folder, &files, &["--report", "hostile.html"])), 3);
    assert!(page("hostile.html").contains("seed") && !page("hostile.html").contains("<b>seed"));
    for wrong in
        [Value::Null, "short.json".into(), serde_json::json!({"scenarios": [1], "types": [], "seed": ""})]
    {
        head["about"] = wrong;
        put(&folder, "1.jsonl", &format!("{head}\n{rest}"));
        let output = merge(&folder, &files, &[]);
        assert_eq!(status(&output), 1, "{head}");
        assert!(errors(&output).contains("E0801"), "{}", errors(&output));
    }
}

#[cfg(unix)]
#[test]
fn the_page_of_parts_is_written_where_nobody_reads_the_table() {
    let folder = begun("parts_no_reader");
    let name = part(&folder, 1, 1);
    let merge =
        format!("'{}' merge {name} --report page.html; echo $? > status", env!("CARGO_BIN_EXE_autogen"));
    let mut shell = std::process::Command::new("sh");
    let output =
        shell.args(["-c", &format!("({merge}) | true")]).current_dir(&folder).output().expect("a shell");
    assert_eq!(errors(&output), "");
    assert_eq!(fs::read_to_string(folder.join("status")).expect("a file"), "3\n");
    assert!(folder.join("page.html").exists());
}

#[test]
fn what_is_wrong_with_parts_is_said() {
    let folder = begun("parts_wrong");
    let names: Vec<String> = (1..=3).map(|number| part(&folder, number, 3)).collect();
    let [one, two, three] = [0, 1, 2].map(|i| names[i].as_str());
    let of_two = part(&folder, 1, 2);
    put(&folder, "short.json", &ONE_PART.replacen('{', "{ \"time_limit_s\": 3599,", 1));
    let of_another = sweep(&folder, &["--part", "2/3"]);
    put(&folder, "another.jsonl", &printed(&of_another));
    let text = fs::read_to_string(folder.join(two)).expect("a part");
    let lines: Vec<&str> = text.lines().collect();
    put(&folder, "short.jsonl", &format!("{}\n", lines[..3].join("\n")));
    put(&folder, "cut.jsonl", &text[..text.len() - 1]);
    put(&folder, "long.jsonl", &format!("{text}{}\n", lines[1]));
    put(&folder, "turned.jsonl", &format!("{}\n{}\n{}\n", lines[0], lines[2], lines[1]));
    put(&folder, "text.jsonl", "agv.capacity,seconds_per_order\n");
    put(&folder, "nothing.jsonl", "");
    let cases: &[(&[&str], &str, &str)] = &[
        (&[one, two], "E0806", "1 of 3 parts missing: 3"),
        (&[one], "E0806", "2 of 3 parts missing: 2, 3"),
        (&[one, two, three, two], "E0805", "part 2/3 is given twice"),
        (&[one, &of_two, three], "E0804", "it has another number of parts"),
        (&[one, "another.jsonl", three], "E0804", "it has another layout, other types or another scenario"),
        (&[one, "short.jsonl", three], "E0803", "part 2/3 ends after 2 of its 4 runs"),
        (&[one, "cut.jsonl", three], "E0803", "part 2/3 ends after 3 of its 4 runs"),
        (&[one, "long.jsonl", three], "E0803", "part 2/3 continues after its last run"),
        (&[one, "turned.jsonl", three], "E0802", "this is not the result of part 2/3 for point "),
        (&[one, "text.jsonl", three], "E0801", "text.jsonl is not a part of a sweep"),
        (&[one, "nothing.jsonl", three], "E0801", "nothing.jsonl is not a part of a sweep"),
    ];
    for (files, code, message) in cases {
        let output = merge(&folder, files, &["--format", "json"]);
        assert_eq!(status(&output), 1, "{files:?}: {}", printed(&output));
        let found = json(&output)["diagnostics"].clone();
        let diagnostic = found.as_array().expect("a list").iter().find(|d| d["code"] == *code);
        let diagnostic = diagnostic.unwrap_or_else(|| panic!("{files:?}: no {code} in {found}"));
        assert!(diagnostic["message"].as_str().is_some_and(|m| m.contains(message)), "{diagnostic}");
        assert!(diagnostic["help"].as_str().is_some_and(|h| !h.is_empty()), "{diagnostic}");
        let output = merge(&folder, files, &[]);
        assert!(output.stdout.is_empty() && errors(&output).contains(code), "{files:?}: {}", errors(&output));
    }
    assert_eq!(status(&merge(&folder, &[one, "no_such_file.jsonl"], &[])), 2);
    assert_eq!(status(&merge(&folder, &[one, "."], &[])), 2);
}

#[test]
fn a_changed_part_is_never_a_panic() {
    let folder = begun("parts_hostile");
    let name = part(&folder, 1, 1);
    let text = fs::read_to_string(folder.join(name)).expect("a part");
    let (head, rest) = text.split_once('\n').expect("two lines");
    let changed = [
        (head.replace("\"replications\":2", "\"replications\":4294967295"), "E0802"),
        (head.replace("\"replications\":2", "\"replications\":0"), "E0801"),
        (head.replace("\"replications\":2", "\"replications\":1e99"), "E0801"),
        (head.replace("\"parts\":1", "\"parts\":18446744073709551615"), "E0801"),
        (head.replace("\"1\",\"13\"", ""), "E0801"),
        (head.replace("[1,2,3]", "[]"), "E0802"),
        (head.replace("\"layouts\":[", "\"layouts\":[\"more\","), "E0802"),
        (head.replace("\"0orders\"", "\"soon\""), "E0801"),
        ("[".repeat(100_000), "E0801"),
        ("{\"autogen_sweep_part\":1}".into(), "E0801"),
    ];
    for (head, code) in changed {
        put(&folder, "changed.jsonl", &format!("{head}\n{rest}"));
        let output = merge(&folder, &["changed.jsonl"], &[]);
        assert_eq!(status(&output), 1, "{head}: {}", errors(&output));
        assert!(errors(&output).contains(code), "{head}: {}", errors(&output));
    }
    for (old, new) in [
        ("\"status\":", "\"status\":7"),
        ("\"finished\":true", "\"finished\":\"yes\""),
        ("\"seconds_per_order\":", "\"seconds_per_order\":1e999"),
        ("\"replication\":0", "\"replication\":1"),
        ("{\"layout\"", "{\"more\":0,\"layout\""),
        ("{\"layout\"", "[\"layout\""),
        ("\"orders_done\":1", "\"orders_done\":-1"),
        ("\"orders_done\":1", "\"orders_done\":0"),
        ("\"simulated_s\":", "\"simulated_s\":1"),
    ] {
        assert!(rest.contains(old), "{old}");
        put(&folder, "changed.jsonl", &format!("{head}\n{}", rest.replacen(old, new, 1)));
        let output = merge(&folder, &["changed.jsonl"], &[]);
        assert_eq!(status(&output), 1, "{new}: {}", errors(&output));
        assert!(errors(&output).contains("E0802"), "{new}: {}", errors(&output));
    }
}

#[test]
fn parts_refuse_what_they_cannot_do() {
    let folder = begun("parts_command");
    for (more, message) in [
        (&["--part", "0/3"][..], "--part takes K/N"),
        (&["--part", "1/1001"], "N up to 1000"),
        (&["--part", "1/2", "--until-precision", "2%"], "depends on all of its runs so far"),
        (&["--part", "1/2", "--format", "csv"], "--format"),
        (&["--part", "1/2", "--compare"], "--compare"),
    ] {
        let output = sweep(&folder, more);
        assert_eq!(status(&output), 2, "{more:?}: {}", errors(&output));
        assert!(errors(&output).contains(message), "{more:?}: {}", errors(&output));
    }
    assert_eq!(status(&autogen(&folder, &["merge"])), 2);
}
