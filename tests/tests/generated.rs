//! Automata by lot, on the executor and as compiled Rust.
//!
//! The long form, 1,000 automata: `AUTOGEN_CAMPAIGN=full cargo test -p autogen-tests generated::`.
//! `AUTOGEN_SEED=n` begins with another seed.

use autogen::backend::rust;
use autogen::executor::Executor;
use autogen_tests::constructs::Table;
use autogen_tests::generate::{Generated, generate};
use autogen_tests::lots::Lots;
use autogen_tests::replay::{difference, record, replay};
use autogen_tests::workspace::Workspace;
use autogen_tests::{is_full_campaign, on_all_processors};
use std::collections::{BTreeMap, BTreeSet};
use std::time::Instant;

/// Automata of a crate, with the anchor.
const OF_A_CRATE: usize = 50;
const SCANS: usize = 1500;
/// In how many of 1,000 automata each construct has to be executed at least.
const AT_LEAST: usize = 20;

/// What a crate of automata has shown.
struct Shown {
    made: Generated,
    fired: Vec<Vec<Vec<u64>>>,
    raised: BTreeSet<i32>,
    running: usize,
    different: Vec<String>,
}

#[test]
fn executor_and_rust_agree() {
    let crates = if is_full_campaign() { 1000 / OF_A_CRATE } else { 2 };
    let first: u64 = std::env::var("AUTOGEN_SEED").ok().and_then(|s| s.parse().ok()).unwrap_or(1);
    let begin = Instant::now();
    let seeds: Vec<u64> = (first..).take(crates).collect();
    let mut table = Table::default();
    let mut refused: BTreeMap<String, usize> = BTreeMap::new();
    let (mut automata, mut running, mut layouts) = (0, 0, 0);
    let mut different = Vec::new();
    for shown in on_all_processors(&seeds, |seed| of_a_crate(*seed)) {
        let made = &shown.made;
        automata += made.automata;
        for (code, count) in &made.refused {
            *refused.entry(code.clone()).or_default() += count;
        }
        running += shown.running;
        layouts += made.layouts.len();
        different.extend(shown.different);
        let system = &made.layouts[0];
        table.take(&system.model, &made.tree, &made.layouts, &shown.fired, &shown.raised);
    }
    let scans = layouts * SCANS;
    let tried = automata + refused.values().sum::<usize>();
    println!("{}", table.text());
    println!("{automata} automata of {tried} that were made; refused: {refused:?}");
    println!(
        "{layouts} layouts, {scans} scans compared, {running} of them running, in {:.1} s",
        begin.elapsed().as_secs_f64()
    );
    println!("{} differences", different.len());
    assert!(different.is_empty(), "{}", different.join("\n"));
    assert!((tried - automata) * 20 < tried, "{refused:?}");
    assert!(running * 2 > scans, "the systems run in {running} of {scans} scans only");
    let unknown = table.unknown();
    assert!(unknown.is_empty(), "constructs without a line in all.txt:\n{}", unknown.join("\n"));
    // A tenth of the automata need not show a tenth of what is rare.
    let least = if automata >= 1000 { AT_LEAST } else { 1 };
    let rare: Vec<String> = (table.counts().iter())
        .filter(|(_, count)| count.executed < least)
        .map(|(name, count)| format!("{name}: {} of {}", count.executed, count.written))
        .collect();
    assert!(rare.is_empty(), "executed in fewer than {least} automata:\n{}", rare.join("\n"));
}

fn add(sum: &mut Vec<Vec<Vec<u64>>>, more: &[Vec<Vec<u64>>]) {
    if sum.is_empty() {
        *sum = more.to_vec();
        return;
    }
    let counts = sum.iter_mut().flatten().flatten();
    counts.zip(more.iter().flatten().flatten()).for_each(|(a, b)| *a += b);
}

fn of_a_crate(seed: u64) -> Shown {
    let made = generate(seed, OF_A_CRATE - 1);
    let workspace = Workspace::write(&format!("generated{seed}"), &made.layouts[0], &made.sources);
    workspace.put("spec.aut", &made.text);
    workspace.cargo(&["build", "--quiet", "-p", "commissioning", "--bins"]);
    let (mut fired, mut raised, mut running, mut different) = (Vec::new(), BTreeSet::new(), 0, Vec::new());
    for (number, system) in made.layouts.iter().enumerate() {
        let mut executor = Executor::new(system);
        let lots = Lots::lively(system, seed * 1000 + number as u64);
        let recording = record(&mut executor, system, SCANS, lots);
        add(&mut fired, executor.fired());
        raised.extend(recording.faults.iter().copied());
        running += recording.running;
        workspace.put("parameters.txt", &rust::parameters_text(system));
        let program = workspace.debug_program("commissioning");
        let found = replay(&program, &workspace, "parameters.txt", &recording);
        if let Some(difference) = difference(system, &recording.answers, &found) {
            different.push(format!("seed {seed}, layout {number}, {difference}"));
        }
    }
    Shown { made, fired, raised, running, different }
}
