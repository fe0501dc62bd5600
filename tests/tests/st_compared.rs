//! Every emitted text, judged and run beside the reference executor: examples, fixtures, hand-written traces
//! and automata by lot.
//!
//! The long form, 1,000 automata: `AUTOGEN_CAMPAIGN=full cargo test -p autogen-tests st_compared::`.

use autogen_tests::coverage::{Coverage, Text};
use autogen_tests::generate::generate;
use autogen_tests::instances::instantiate;
use autogen_tests::lots::Lots;
use autogen_tests::st::Beside;
use autogen_tests::{
    Texts, examples, is_full_campaign, on_all_processors, prototype, root, trace, with_panels,
};
use runtime_sim::run::{Stepping, run};
use runtime_sim::scan::Controllers;
use std::path::PathBuf;
use std::time::Instant;

/// Automata of a family that is drawn by lot, with the anchor.
const OF_A_FAMILY: usize = 50;
/// In the short form only "default" and "buffer" make more.
const MOST_ORDERS: usize = 2;

enum Job {
    Example(String, Box<Texts>),
    Fixture(PathBuf),
    Trace(PathBuf),
    ByLot(u64),
}

/// The files of a folder of fixtures.
fn fixtures(folder: &str) -> Vec<PathBuf> {
    let folder = std::fs::read_dir(root().join("tests/fixtures").join(folder)).expect("a folder");
    let mut paths: Vec<_> = folder.map(|entry| entry.expect("an entry").path()).collect();
    paths.sort();
    paths
}

fn name(path: &std::path::Path) -> String {
    path.file_name().expect("a name").to_string_lossy().into_owned()
}

/// So many scans of inputs drawn by lot.
fn drawn(beside: &mut Beside, text: &Text, mut lots: Lots, scans: usize) {
    let mut outputs = vec![Vec::new(); text.system.instances.len()];
    for _ in 0..scans {
        if lots.powers_up() {
            beside.power_up();
        }
        let given = lots.next(text.system, &outputs);
        beside.scan(given, &lots.images, &mut outputs);
    }
}

fn coverage(job: &Job) -> Coverage {
    let mut coverage = Coverage::default();
    match job {
        Job::Example(name, texts) => {
            let outcome = texts.compile();
            let mut project = outcome.project.expect("a layout that can be built");
            if !is_full_campaign() && !matches!(name.as_str(), "default" | "buffer") {
                project.plant.scenario.orders.truncate(MOST_ORDERS);
            }
            let text = Text::new(name, "examples", &project.system, &outcome.sources);
            coverage.take(&text, |beside| {
                run(&project.plant, beside, Stepping::EveryScan, &mut |_| {})
                    .expect("a line that can be run");
            });
            let (scans, seeds) = if is_full_campaign() { (3000, 3) } else { (1000, 1) };
            for seed in 1..=seeds {
                coverage.take(&text, |beside| drawn(beside, &text, Lots::powered(text.system, seed), scans));
            }
            coverage.take(&text, |beside| drawn(beside, &text, Lots::new(text.system, 4), scans));
            coverage.enter_the_rest(&text, &outcome.sources, |beside, text| {
                drawn(beside, text, Lots::lively(text.system, 2), 300);
            });
        }
        Job::Fixture(path) => {
            let file = (name(path), std::fs::read_to_string(path).expect("a text"));
            let (system, sources) = instantiate(&[file]);
            let name = name(path);
            let text = Text::new(&name, &name, &system, &sources);
            let scans = if is_full_campaign() { 3000 } else { 1500 };
            coverage.take(&text, |beside| drawn(beside, &text, Lots::new(text.system, 1), scans));
            coverage.enter_the_rest(&text, &sources, |beside, text| {
                drawn(beside, text, Lots::lively(text.system, 2), 300);
            });
        }
        Job::Trace(path) => {
            let fixture = trace::load(&std::fs::read_to_string(path).expect("a text")).expect("a trace");
            let name = name(path);
            let text = Text::new(&name, &name, &fixture.system, &fixture.sources);
            coverage.take(&text, |beside| {
                let mut outputs = vec![Vec::new(); text.system.instances.len()];
                for scan in &fixture.scans {
                    if scan.powers_up {
                        beside.power_up();
                    }
                    beside.scan(scan.system, &scan.inputs, &mut outputs);
                }
            });
            coverage.enter_the_rest(&text, &fixture.sources, |beside, text| {
                drawn(beside, text, Lots::lively(text.system, 2), 300);
            });
        }
        Job::ByLot(seed) => {
            let made = generate(*seed, OF_A_FAMILY - 1);
            let family = format!("automata {seed}");
            for (number, system) in made.layouts.iter().enumerate() {
                let name = format!("{family}, layout {number}");
                let text = Text::new(&name, &family, system, &made.sources);
                let lots = Lots::lively(system, seed * 1000 + number as u64);
                let scans = if is_full_campaign() { 1500 } else { 750 };
                coverage.take(&text, |beside| drawn(beside, &text, lots, scans));
                coverage.enter_the_rest(&text, &made.sources, |beside, text| {
                    drawn(beside, text, Lots::lively(text.system, *seed), 300);
                });
            }
        }
    }
    coverage
}

#[test]
fn every_text_does_what_the_executor_does() {
    let begin = Instant::now();
    let families = if is_full_campaign() { 1000 / OF_A_FAMILY } else { 50 / OF_A_FAMILY };
    let first: u64 = std::env::var("AUTOGEN_SEED").ok().and_then(|s| s.parse().ok()).unwrap_or(1);
    let mut jobs: Vec<Job> =
        examples().into_iter().map(|(name, texts)| Job::Example(name, Box::new(texts))).collect();
    // Only this version goes a metre aside.
    let fast = ["agv.capacity=4", "kitting.speed=1", "gantry.speed=1", "gantry.version=V4"];
    let aside = fast.iter().fold(prototype("default"), |texts, setting| texts.set(setting));
    jobs.push(Job::Example("prototype, V4".into(), Box::new(aside)));
    for (name, texts) in examples() {
        if matches!(name.as_str(), "default" | "tending" | "production_line") {
            jobs.push(Job::Example(format!("{name} with panels"), Box::new(with_panels(texts))));
        }
    }
    jobs.extend(fixtures("rust").into_iter().map(Job::Fixture));
    jobs.extend(fixtures("trace").into_iter().map(Job::Trace));
    jobs.extend((first..).take(families).map(Job::ByLot));
    let mut all = Coverage::default();
    on_all_processors(&jobs, coverage).into_iter().for_each(|found| all.merge(found));

    let [(branches, never), (others, never_other)] = all.branches();
    let (constructs, unexecuted) = all.constructs();
    println!(
        "{} texts run, {} scans and {} words compared, {} wrong, {:.1} s",
        all.texts,
        all.scans,
        all.words,
        all.wrong.len(),
        begin.elapsed().as_secs_f64()
    );
    println!(
        "{} of {branches} CASE branches of states entered, {} of them in variations that begin there; not: {}",
        branches - never.len(),
        all.only_begun_elsewhere,
        never.join(", ")
    );
    println!(
        "{others} ELSE branches, for numbers that no state has; not entered: {}",
        never_other.join(", ")
    );
    println!("0 dead variables, beside {} that a specification writes and never reads", all.unread.len());
    println!("{} constructs of the grammar: {}", constructs.len(), constructs.join(" "));
    println!("never executed: {}", unexecuted.join(" "));
    println!("a scan executes up to {} % of its bound", all.nearest);
    assert!(all.wrong.is_empty(), "{}", all.wrong.join("\n"));
    assert!(never.is_empty(), "{}", never.join("\n"));
    assert!(unexecuted.is_empty(), "{unexecuted:?}");
    // A screen reads it.
    let shown = ["alarms_first", "tool_version", "program_hash"];
    let is_shown =
        |name: &str| name.strip_prefix("examples: ").is_some_and(|variable| shown.contains(&variable));
    let unread = all.unread.iter().filter(|name| name.starts_with("examples:") && !is_shown(name));
    assert_eq!(unread.count(), 0, "{:?}", all.unread);
}
