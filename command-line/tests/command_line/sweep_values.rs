//! `autogen sweep`: which values may be varied, what rows of refused points say, and which files are in the way.

use super::sweep::{printed, put, rows};
use super::*;

#[test]
fn a_layout_without_a_goal_has_no_time_of_it() {
    let folder = folder("sweep_no_goal");
    let layouts = [example("scenes/from_a_to_b.json"), example("scenes/lifting_table.json")];
    let sweep = |format: &str| autogen(&folder, &["sweep", &layouts[0], &layouts[1], "--format", format]);
    let output = sweep("json");
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let found = rows(&output);
    assert!(found[0]["goal_s"].is_number() && found[0]["items_asked"] == 3, "{found:?}");
    assert!(found[1]["goal_s"].is_null() && found[1]["items_asked"].is_null(), "{found:?}");
    let text = printed(&sweep("text"));
    let of_table = text.lines().find(|line| line.starts_with("lifting_table")).expect("a row");
    assert_eq!(of_table.split_whitespace().take(4).collect::<Vec<_>>(), ["lifting_table", "-", "-", "-"]);
}

#[test]
fn values_that_mean_the_same_and_seeds_that_overlap_are_refused() {
    let folder = folder("sweep_same_values");
    let layout = example("ariac2021/default.json");
    for (options, said) in [
        (&["--set", "supply.seed=1,1e0"][..], "--set supply.seed: 1e0 stands twice, or means the same"),
        (&["--set", "agv.capacity=2,4,2.0"], "--set agv.capacity: 2.0 stands twice"),
        (
            &["--set", "supply.seed=1,2.0", "--replications", "3"],
            "--set supply.seed: the seeds 1 and 2 are less than 3",
        ),
        (&["--io-delay", "0,00"], "--io-delay: 00 stands twice"),
        (&["--io-delay", "random,random:1"], "--io-delay: random:1 stands twice"),
        (
            &["--io-delay", "random:1,0,random:2", "--replications", "3"],
            "--io-delay: the seeds 1 and 2 are less than 3 apart",
        ),
    ] {
        let output = autogen(&folder, &[&["sweep", &layout][..], options].concat());
        assert_eq!(status(&output), 2, "{options:?}");
        assert!(errors(&output).contains(said), "{options:?}: {}", errors(&output));
    }
}

/// Its parameter is no seed of the scenario.
#[test]
fn a_machine_that_is_called_supply_has_values_of_its_own() {
    let folder = folder("sweep_supply");
    put(
        &folder,
        "seeder.aut",
        "automaton Seeder on bin {
    parameter seed: int 0..9 := 1;
    initial state Rest { when after 1 s and seed > 9 - 1 -> Rest {} }
}
",
    );
    put(&folder, "scenario.json", r#"{"time_limit_s": 5}"#);
    put(
        &folder,
        "line.json",
        r#"{"specs": "seeder.aut", "robots": [], "stationary": [{"name": "supply", "type": "seeder", "pose": [0, 0, 0]}]}"#,
    );
    let sweep = ["sweep", "line.json", "--set", "supply.seed=1,2", "--replications", "3"];
    let output = autogen(&folder, &sweep);
    assert_eq!(status(&output), 0, "{}{}", printed(&output), errors(&output));
}

#[test]
fn a_refused_point_has_the_orders_of_its_line() {
    let folder = folder("sweep_refused_orders");
    let automata = fs::read_to_string(example("scenes/lifting_table.aut")).expect("the example");
    put(&folder, "lifting_table.aut", &automata);
    let robots = r#"[{"name": "table", "type": "lifting_table", "pose": [0, 0, 0]}]"#;
    put(&folder, "line.json", &format!(r#"{{"specs": "lifting_table.aut", "robots": {robots}}}"#));
    let sweep = ["sweep", "line.json", "--set", "table.warning_time=1000,\"soon\"", "--format", "json"];
    let output = autogen(&folder, &sweep);
    assert_eq!(status(&output), 3, "{}", errors(&output));
    let found = rows(&output);
    assert!(found[1]["reason"].as_str().is_some_and(|reason| reason.starts_with("E0503")), "{found:?}");
    let orders: Vec<&Value> = found.iter().map(|row| &row["orders"]).collect();
    assert_eq!(orders, [0, 0], "no station, no order of the built-in scenario");
}

#[test]
fn what_is_in_the_way_of_pages_is_known_before_the_runs() {
    let folder = folder("sweep_pages_in_the_way");
    let layout = example("scenes/lifting_table.json");
    put(&folder, "other.html", "mine");
    fs::create_dir(folder.join("new-runs")).expect("a folder");
    put(&folder, "new-runs/row-1.html", "mine");
    for options in [&["--report", "other.html"][..], &["--report", "new.html", "--keep", "all"]] {
        let output = autogen(&folder, &[&["sweep", &layout, "--format", "csv"][..], options].concat());
        assert_eq!(status(&output), 2, "{options:?}");
        assert_eq!(printed(&output), "", "no run was made");
        let said = errors(&output);
        assert!(said.contains("this file is not a report; choose another one, or move it"), "{said}");
    }
    assert!(!folder.join("new.html").exists());
}

#[test]
fn the_table_of_the_manual_is_what_its_command_prints() {
    let manual = Path::new(env!("CARGO_MANIFEST_DIR")).join("../docs/sweeps.md");
    let manual = fs::read_to_string(manual).expect("the manual");
    let (_, behind) =
        manual.split_once("tending.json --set mill.cut=30,60,90\n```\n\n```text\n").expect("the command");
    let (table, _) = behind.split_once("```").expect("an end");
    let arguments = ["sweep", &example("tending/tending.json"), "--set", "mill.cut=30,60,90"];
    let output = autogen(&folder("sweep_manual"), &arguments);
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let printed = printed(&output);
    assert!(printed.starts_with(table), "{printed}\n{table}");
}

#[test]
fn figures_of_orders_do_not_stand_beside_those_of_items() {
    let folder = folder("sweep_beside_items");
    fs::write(folder.join("here.csv"), "layout,mill.cut,seconds_per_order\ntending,30,2000\n")
        .expect("a file");
    let layout = example("tending/tending.json");
    let arguments = ["sweep", &layout, "--set", "mill.cut=30", "--beside", "here.csv"];
    let output = autogen(&folder, &arguments);
    assert_eq!(status(&output), 2);
    assert!(errors(&output).contains("--beside compares seconds per order"), "{}", errors(&output));
}

#[test]
fn values_that_no_comma_separates_are_told_so() {
    let folder = folder("sweep_no_comma");
    let layout = example("ariac2021/default.json");
    for values in ["agv.capacity=2;4", "agv.capacity=2:8:2"] {
        let output = autogen(&folder, &["sweep", &layout, "--set", values]);
        assert_eq!(status(&output), 2, "{values}");
        assert!(errors(&output).contains("are separated by commas"), "{values}: {}", errors(&output));
    }
}

#[test]
fn a_number_outside_of_its_range_is_told_so() {
    let folder = folder("sweep_numbers");
    let layout = example("ariac2021/default.json");
    for (option, value, range) in [
        ("--replications", "-1", "from 1 to 4294967295"),
        ("--replications", "4294967296", "from 1 to 4294967295"),
        ("--jobs", "-2", "from 1 to 1024"),
        ("--order", "-1", "from 0"),
        ("--io-delay", "-1", "up to 1000"),
    ] {
        let output = autogen(&folder, &["sweep", &layout, option, value]);
        assert_eq!(status(&output), 2, "{option} {value}");
        assert!(errors(&output).contains(range), "{option} {value}: {}", errors(&output));
    }
}

/// Somebody waits for the page, whether or not the table is read.
#[cfg(unix)]
#[test]
fn a_page_is_written_where_nobody_reads_the_table() {
    let folder = folder("sweep_no_reader");
    let tool = env!("CARGO_BIN_EXE_autogen");
    let layout = example("tending/tending.json");
    let sweep =
        format!("'{tool}' sweep '{layout}' --set mill.cut=30,60 --report page.html; echo $? > status");
    let output = Command::new("sh")
        .args(["-c", &format!("({sweep}) | true")])
        .current_dir(&folder)
        .output()
        .expect("a shell");
    // The first sweep on a machine says this too.
    let told = errors(&output).replace("compiling the controllers (once for these types) ...\n", "");
    assert_eq!(told, "");
    assert_eq!(fs::read_to_string(folder.join("status")).expect("a file"), "0\n");
    assert!(folder.join("page.html").exists());
}
