//! Mistakes in the library's types are found: by `check`, or by a search of one of some small lines.

use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, explore};
use autogen_search::model::Model;
use autogen_search::plant::Faults;
use autogen_search::successor::Orders;
use autogen_tests::equal::{Comparison, compare};
use autogen_tests::mutants::mutants;
use autogen_tests::small_lines::{self, Line};
use autogen_tests::{Texts, is_full_campaign, on_all_processors};
use std::collections::BTreeSet;
use std::time::{Duration, Instant};

/// The lines of these that are small enough to be compared.
const COMPARED: usize = 6;

const BOUNDS: Bounds = Bounds {
    answers: Some(1),
    orders: Orders::One,
    time: Some(Duration::from_secs(20)),
    memory: 500_000_000,
    states: usize::MAX,
    violations: 1,
    jobs: 1,
};

/// None if the line is refused.
fn searched(texts: &Texts, faults: Faults) -> Option<Model> {
    let project = texts.compile().project?;
    Some(model(&project, &Asked::with(faults)).ok()?.model)
}

/// What a search finds.
fn found(model: &Model) -> Option<String> {
    let outcome = explore(model, &BOUNDS, &mut |_| true);
    let found = outcome.violations.iter().chain(&outcome.remarks).next();
    found.map(|(violation, _)| format!("{violation:?}"))
}

/// That of this thread: others work at the same time.
fn processor_time() -> Duration {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").expect("the times of a thread");
    let nanoseconds = text.split_whitespace().next().and_then(|number| number.parse().ok());
    Duration::from_nanos(nanoseconds.expect("a number"))
}

#[derive(Debug)]
enum Result {
    Refused,
    Found(String, Duration),
    /// No line shows a difference.
    Equal,
    Missed,
}

fn of_mutant(lines: &[Line], originals: &[Model], name: &str, text: &str) -> Result {
    let begin = processor_time();
    let mut changed = Vec::new();
    for (number, line) in lines.iter().enumerate() {
        let texts = line.with(name, text);
        if changed.is_empty() {
            let outcome = texts.compile();
            if outcome.project.is_none() {
                return Result::Refused;
            }
            if let Some(warning) = outcome.warnings.first() {
                return Result::Found(format!("check: {}", warning.code), processor_time() - begin);
            }
        }
        let Some(model) = searched(&texts, line.faults) else { return Result::Refused };
        let begin = processor_time();
        // One arm more at the table is of interest to arms alone.
        if number == COMPARED && name != "kitting" {
            continue;
        }
        if let Some(violation) = found(&model) {
            return Result::Found(format!("{}: {violation}", line.name), processor_time() - begin);
        }
        changed.push(model);
    }
    let is_equal = |(a, b): (&Model, &Model)| compare(a, b, &BOUNDS) == Comparison::Equal;
    match is_full_campaign() && originals.iter().zip(&changed).take(COMPARED).all(is_equal) {
        true => Result::Equal,
        false => Result::Missed,
    }
}

/// An arm that has not this transition comes to the next state by way of `Confirming`.
const ONE_SCAN_LATER: &str = "without `when done and attached`";
/// Where the gantry goes up for a better path. Paths are not searched, so these count neither as found nor as missed.
const OF_A_PATH: &str = "risen";

#[test]
fn mistakes_are_found() {
    let mut lines = small_lines::all();
    let mut all = Vec::new();
    for name in ["agv", "conveyor", "gantry", "kitting", "station", "buffer"] {
        all.extend(mutants(&lines[0].text_of(name)).into_iter().map(|mutant| (name, mutant)));
    }
    assert!(all.len() >= 100, "{} mutants", all.len());
    let is_long = is_full_campaign();
    if !is_long {
        lines.truncate(1);
        all = all.into_iter().step_by(4).collect();
    }
    let originals: Vec<Model> = lines.iter().map(|l| searched(&l.texts, l.faults).expect(l.name)).collect();
    for (line, model) in lines.iter().zip(&originals) {
        let begin = Instant::now();
        let outcome = explore(model, &BOUNDS, &mut |_| true);
        let what = outcome.violations.iter().chain(&outcome.remarks).next().map(|(violation, _)| violation);
        println!(
            "{}: {} states, {:.1?}, {:?}",
            line.name,
            outcome.covered.states,
            begin.elapsed(),
            outcome.end
        );
        assert_eq!(what, None, "{}", line.name);
    }
    let results = on_all_processors(&all, |(name, mutant)| of_mutant(&lines, &originals, name, &mutant.text));
    let (mut refused, mut caught, mut equal, mut longest) = (0, 0, 0, Duration::ZERO);
    let (mut missed, mut of_a_path) = (BTreeSet::new(), 0);
    for ((name, mutant), result) in all.iter().zip(results) {
        let what = format!("{name}.aut, {}", mutant.what);
        match result {
            Result::Refused => refused += 1,
            Result::Found(how, time) => {
                (caught, longest) = (caught + 1, longest.max(time));
                println!("{what}: {how}, {time:.1?}");
            }
            Result::Equal => {
                equal += 1;
                println!("{what}: equal");
            }
            Result::Missed if what.ends_with(ONE_SCAN_LATER) => {
                equal += 1;
                println!("{what}: the same, one scan later");
            }
            Result::Missed => {
                of_a_path += usize::from(what.contains(OF_A_PATH));
                missed.insert(what);
            }
        }
    }
    missed.iter().for_each(|what| println!("missed: {what}"));
    println!(
        "{} mutants, {refused} refused, {equal} equal, {caught} of the others found, each within {longest:.1?} of a processor",
        all.len()
    );
    let unequal = all.len() - refused - equal - of_a_path;
    let least = if is_long { unequal * 95 / 100 } else { 30 };
    assert!(caught >= least, "{caught} of {unequal} mutants are found");
}
