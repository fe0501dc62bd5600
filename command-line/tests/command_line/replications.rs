//! Several runs of a point: replications, precision, warm-up and comparisons.

use super::sweep::{printed, put, rows};
use super::{autogen, errors, example, folder, status};
use serde_json::Value;
use std::process::Output;

/// Two orders of two parts.
fn scenario(seed: u32) -> String {
    format!(
        r#"{{"kinds": [{{"name": "battery", "height": 0.053}}, {{"name": "pump", "height": 0.11}}],
            "orders": {{"count": 2, "parts": {{"battery": 1, "pump": 1}}}}, "supply": {{"seed": {seed}}}}}"#
    )
}

#[test]
fn replications_are_runs_with_other_seeds() {
    let folder = folder("sweep_replications");
    let layout = example("ariac2021/default.json");
    let seconds = |seed: u32| {
        put(&folder, "one.json", &scenario(seed));
        let output = autogen(&folder, &["sweep", &layout, "--scenario", "one.json", "--format", "json"]);
        rows(&output)[0]["seconds_per_order"].as_f64().expect("orders are made")
    };
    let values = [7, 8, 9].map(seconds);
    put(&folder, "three.json", &scenario(7));
    let sweep = ["sweep", &layout, "--scenario", "three.json", "--replications", "3", "--format"];
    let output = autogen(&folder, &[&sweep[..], &["json"]].concat());
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let row = &rows(&output)[0];
    let mean = values.iter().sum::<f64>() / 3.0;
    let deviation = (values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / 2.0).sqrt();
    let is_near = |name: &str, wanted: f64| (row[name].as_f64().expect("a number") - wanted).abs() < 1e-9;
    assert!(deviation > 0.0 && is_near("seconds_per_order", mean), "{row} for {values:?}");
    assert!(is_near("half_width", 4.302_652_729_749_46 * deviation / 3.0_f64.sqrt()), "{row} for {values:?}");
    assert_eq!((&row["runs"], &row["finished_runs"]), (&Value::from(3), &Value::from(3)));

    let output = autogen(&folder, &[&sweep[..], &["csv"]].concat());
    let table = printed(&output);
    let cells: Vec<usize> = table.lines().map(|line| line.split(',').count()).collect();
    assert_eq!(cells, [11, 11], "{table}");
    let output = autogen(&folder, &[&sweep[..], &["text"]].concat());
    assert!(printed(&output).contains("3 of 3"), "{}", printed(&output));
}

/// Seconds per order of one run for each seed of the supply, which is an axis.
fn by_seed(folder: &std::path::Path, seeds: &str, capacity: u32) -> Vec<f64> {
    let layout = example("ariac2021/default.json");
    let (seeds, capacity) = (format!("supply.seed={seeds}"), format!("agv.capacity={capacity}"));
    let sweep = ["sweep", &layout, "--scenario", "one.json", "--set", &seeds, "--set", &capacity];
    let output = autogen(folder, &[&sweep[..], &["--format", "json"]].concat());
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let seconds = |row: &Value| row["seconds_per_order"].as_f64().expect("orders are made");
    rows(&output).iter().map(seconds).collect()
}

fn mean(values: &[f64]) -> f64 {
    values.iter().sum::<f64>() / values.len() as f64
}

fn deviation(values: &[f64]) -> f64 {
    let mean = mean(values);
    (values.iter().map(|v| (v - mean) * (v - mean)).sum::<f64>() / (values.len() - 1) as f64).sqrt()
}

#[test]
fn points_have_the_same_seeds_and_are_compared_run_by_run() {
    let folder = folder("sweep_compare");
    put(&folder, "one.json", &scenario(7));
    let [two, four] = [1, 4].map(|capacity| by_seed(&folder, "7,8,9", capacity));
    let differences: Vec<f64> = two.iter().zip(&four).map(|(two, four)| four - two).collect();
    assert!(deviation(&differences) > 0.0, "{two:?} {four:?}");
    let layout = example("ariac2021/default.json");
    let sweep = ["sweep", &layout, "--scenario", "one.json", "--set", "agv.capacity=1,4,13"];
    let more = ["--replications", "3", "--compare", "--format"];
    let output = autogen(&folder, &[&sweep[..], &more[..], &["json"]].concat());
    assert_eq!(status(&output), 3, "{}", errors(&output));
    let rows = rows(&output);
    let is_near = |key: &str, wanted: f64| (rows[1][key].as_f64().expect("a number") - wanted).abs() < 1e-9;
    assert!(is_near("difference", mean(&differences)), "{} for {differences:?}", rows[1]);
    assert!(
        is_near("difference_half_width", 4.302_652_729_749_46 * deviation(&differences) / 3.0_f64.sqrt()),
        "{}",
        rows[1]
    );
    assert_eq!([&rows[0]["pairs"], &rows[1]["pairs"], &rows[2]["pairs"]], [0, 3, 0]);
    assert!(rows[0]["difference"].is_null() && rows[2]["difference"].is_null());
    let output = autogen(&folder, &[&sweep[..], &more[..], &["text"]].concat());
    assert!(printed(&output).lines().next().is_some_and(|l| l.contains("  difference      +-  pairs  ")));
}

/// More than are made together, of which some do the same, some are refused, and some have another plant.
#[test]
fn points_come_to_what_each_comes_to_alone() {
    let folder = folder("sweep_together");
    put(&folder, "one.json", &scenario(3));
    let layout = example("ariac2021/default.json");
    let sweep = |capacities: &str, patiences: &str, speeds: &str, delays: &str, jobs: &str| {
        let settings =
            [("agv.capacity", capacities), ("conveyor.patience", patiences), ("gantry.speed", speeds)];
        let settings = settings.map(|(name, values)| format!("{name}={values}"));
        let [capacity, patience, speed] = settings.each_ref().map(String::as_str);
        let first = ["sweep", &layout, "--scenario", "one.json", "--set", capacity, "--set", patience];
        let then = ["--set", speed, "--io-delay", delays, "--replications", "3"];
        let last = ["--jobs", jobs, "--format", "jsonl"];
        let output = autogen(&folder, &[&first[..], &then[..], &last[..]].concat());
        printed(&output)
    };
    let [capacities, patiences, speeds, delays] = ["1,2,13,3,4", "0.05,60,61", "1,0.7", "0,random:9"];
    let all = sweep(capacities, patiences, speeds, delays, "1");
    assert_eq!(all.lines().count(), 60);
    assert!(all.contains("E0") && all.contains("all orders made"), "{all}");
    for jobs in ["2", "7"] {
        assert_eq!(sweep(capacities, patiences, speeds, delays, jobs), all, "{jobs} jobs");
    }
    for (capacity, patience, speed, delay) in
        [("1", "60", "1", "0"), ("3", "61", "1", "random:9"), ("4", "60", "0.7", "0"), ("13", "60", "1", "0")]
    {
        let alone = sweep(capacity, patience, speed, delay, "1");
        assert!(all.contains(alone.trim_end()), "{alone}");
    }
}

#[test]
fn replications_stop_at_the_precision_whatever_the_jobs_are() {
    let folder = folder("sweep_precision");
    put(&folder, "one.json", &scenario(1));
    let layout = example("ariac2021/default.json");
    let sweep = |precision: &str, jobs: &str| {
        let fixed = ["sweep", &layout, "--scenario", "one.json", "--set", "agv.capacity=1,13,4"];
        let varied =
            ["--replications", "12", "--until-precision", precision, "--jobs", jobs, "--format", "json"];
        let output = autogen(&folder, &[&fixed[..], &varied[..]].concat());
        assert_eq!(status(&output), 3, "{}", errors(&output));
        output
    };
    let output = sweep("1.2%", "1");
    let not_reached =
        |output: &Output| errors(output).contains("points have not reached the precision in 12 runs");
    assert!(!not_reached(&output), "{}", errors(&output));
    assert!(not_reached(&sweep("0.01%", "1")));
    for jobs in ["2", "7"] {
        assert!(sweep("1.2%", jobs).stdout == output.stdout, "{jobs} jobs");
    }
    // The rule, by the single runs.
    const T: [f64; 11] = [12.706, 4.303, 3.182, 2.776, 2.571, 2.447, 2.365, 2.306, 2.262, 2.228, 2.201];
    let seeds: Vec<String> = (1..=12).map(|seed| seed.to_string()).collect();
    let wanted = |capacity: u32, precision: f64| {
        let seconds = by_seed(&folder, &seeds.join(","), capacity);
        let half = |n: usize| T[n - 2] * deviation(&seconds[..n]) / (n as f64).sqrt();
        (5..=12).find(|&n| half(n) <= precision * mean(&seconds[..n])).unwrap_or(12) as u64
    };
    let runs = |output: &Output| -> Vec<u64> {
        rows(output).iter().map(|row| row["runs"].as_u64().expect("a number")).collect()
    };
    let (of_one, of_four) = (wanted(1, 0.012), wanted(4, 0.012));
    assert_eq!(runs(&output), [of_one, 1, of_four]);
    assert_eq!(runs(&sweep("90%", "3")), [5, 1, 5]);
    assert_eq!(runs(&sweep("0.01%", "3")), [12, 1, 12]);
    assert!((6..12).contains(&of_one) || (6..12).contains(&of_four), "{of_one} {of_four}");
}

#[test]
fn orders_of_the_warm_up_are_not_in_the_mean() {
    let folder = folder("sweep_warm_up");
    put(&folder, "six.json", &scenario(1).replace("\"count\": 2", "\"count\": 6"));
    let layout = example("ariac2021/default.json");
    let point = ["--scenario", "six.json", "--format", "json"];
    let alone =
        super::json(&autogen(&folder, &[&["commission", &layout, "-o", "made"], &point[..]].concat()));
    let times = alone["order_times"].as_array().expect("a list").iter();
    let mut made: Vec<f64> = times.map(|times| times["made_s"].as_f64().expect("it is made")).collect();
    made.sort_by(f64::total_cmp);
    let row = |warm_up: &str| {
        let output = autogen(&folder, &[&["sweep", &layout, "--warm-up", warm_up], &point[..]].concat());
        assert_eq!(status(&output), 0, "{}", errors(&output));
        (rows(&output)[0].clone(), errors(&output))
    };
    let until = format!("{}s", made[1]);
    for (warm_up, cut) in [("0orders", 0), ("2orders", 2), (&until, 2), ("5orders", 5), ("auto", 0)] {
        let (row, said) = row(warm_up);
        assert_eq!((row["measured_runs"].as_u64(), said.as_str()), (Some(1), ""), "{row}");
        let first = if cut == 0 { 0.0 } else { made[cut - 1] };
        let wanted = (made[5] - first) / (6 - cut) as f64;
        assert!((row["seconds_per_order"].as_f64().expect("orders are left") - wanted).abs() < 1e-9, "{row}");
        assert_eq!(row["cut_orders"], cut as f64, "{row}");
    }
    let (row, said) = row("6orders");
    assert!(row["seconds_per_order"].is_null() && row["measured_runs"] == 0, "{row}");
    assert!(said.contains("the warm-up leaves no order of 1 run of 1 point"), "{said}");
}

#[test]
fn wrong_rules_are_status_2() {
    let folder = folder("sweep_wrong_rules");
    put(&folder, "one.json", &scenario(1));
    let layout = example("ariac2021/default.json");
    for (more, message) in [
        (&["--until-precision", "2"][..], "--until-precision takes a percentage"),
        (&["--until-precision", "0%"], "--until-precision takes a percentage"),
        (&["--warm-up", "20"], "--warm-up takes `auto`"),
        (&["--warm-up=-3orders"], "--warm-up takes `auto`"),
        (&["--set", "supply.seed=1,3", "--replications", "3"], "1 and 3 are less than 3 apart"),
        (
            &["--set", "supply.seed=4294967295,1", "--replications", "3"],
            "4294967295 and 1 are less than 3 apart",
        ),
        (
            &["--io-delay", "random:0,random:18446744073709551615", "--replications", "2"],
            "18446744073709551615 and 0 are less than 2 apart",
        ),
        (&["--until-precision", "2%", "--replications", "4"], "looks at a point after 5 runs"),
        (
            &["--set", "supply.seed=1,101", "--until-precision", "2%", "--replications", "101"],
            "less than 101 apart",
        ),
    ] {
        let output = autogen(&folder, &[&["sweep", &layout, "--scenario", "one.json"], more].concat());
        assert_eq!(status(&output), 2, "{more:?}: {}", errors(&output));
        assert!(errors(&output).contains(message), "{more:?}: {}", errors(&output));
    }
}

#[test]
fn the_seed_of_the_supply_is_set_for_any_command() {
    let folder = folder("supply_seed");
    put(&folder, "one.json", &scenario(7));
    put(&folder, "two.json", &scenario(8));
    let layout = example("ariac2021/default.json");
    let hash = |more: &[&str]| {
        let output =
            autogen(&folder, &[&["sweep", &layout, "--format", "json", "--scenario"], more].concat());
        rows(&output)[0]["trace_hash"].clone()
    };
    assert_eq!(hash(&["one.json", "--set", "supply.seed=8"]), hash(&["two.json"]));
    assert_ne!(hash(&["one.json"]), hash(&["two.json"]));
    for (scenario, setting, message) in [
        ("one.json", "supply.seed=-1", "E0503"),
        ("one.json", "supply.seed=1.5", "E0503"),
        ("one.json", "supply.seed=4294967296", "E0503"),
        ("one.json", "supply.seed=many", "E0503"),
        ("one.json", "supply.surplus=1", "`supply` has no parameter `surplus`"),
    ] {
        let output = autogen(&folder, &["check", &layout, "--scenario", scenario, "--set", setting]);
        assert_eq!(status(&output), 1, "{setting}: {}", errors(&output));
        assert!(errors(&output).contains(message), "{setting}: {}", errors(&output));
    }
}

#[test]
fn orders_without_end_are_made_until_the_time_limit() {
    let folder = folder("sweep_without_end");
    let endless = scenario(1).replace("\"count\": 2", "\"count\": \"without end\"");
    put(&folder, "endless.json", &endless.replacen('{', "{\"time_limit_s\": 300,", 1));
    let layout = example("ariac2021/default.json");
    let point = ["--scenario", "endless.json", "--format", "json"];
    let output = autogen(&folder, &[&["sweep", &layout, "--warm-up", "1orders"], &point[..]].concat());
    assert_eq!(status(&output), 0, "{}", errors(&output));
    let row = &rows(&output)[0];
    assert_eq!((&row["finished"], &row["reason"]), (&true.into(), &"time limit reached".into()));
    assert_eq!((&row["simulated_s"], &row["orders"]), (&300.0.into(), &row["orders_done"]));
    assert!(row["orders_done"].as_u64().is_some_and(|done| done > 3), "{row}");
    let alone =
        super::json(&autogen(&folder, &[&["commission", &layout, "-o", "made"], &point[..]].concat()));
    assert_eq!(alone["trace_hash"], row["trace_hash"]);
    let items = alone["items"].as_array().expect("a list");
    assert!(!items.is_empty() && items.iter().all(|item| item["carrier"] != "supply"), "{items:?}");
}

#[test]
fn runs_in_which_nothing_is_drawn_are_the_same() {
    let folder = folder("sweep_same");
    let layout = example("ariac2021/default.json");
    put(&folder, "list.json", super::sweep::ONE_PART);
    let cells = |more: &[&str]| -> Vec<String> {
        let sweep = ["sweep", &layout, "--scenario", "list.json", "--replications", "3"];
        let output = autogen(&folder, &[&sweep[..], more].concat());
        assert_eq!(status(&output), 0, "{}", errors(&output));
        let text = printed(&output);
        text.lines().nth(1).expect("a row").split_whitespace().map(String::from).collect()
    };
    assert_eq!(cells(&[])[5..9], ["same", "3", "of", "3"]);
    assert_ne!(cells(&["--io-delay", "random"])[6], "same");
}
