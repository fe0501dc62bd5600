//! Mistakes in the library's types are found: by `check`, or by a search of one of some small lines.

use autogen::library;
use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, explore};
use autogen_search::model::Model;
use autogen_search::plant::Faults;
use autogen_search::successor::Orders;
use autogen_tests::equal::{Comparison, compare};
use autogen_tests::mutants::mutants;
use autogen_tests::{Texts, is_full_campaign, on_all_processors, own_line};
use std::collections::BTreeSet;
use std::time::{Duration, Instant};

const KINDS: &str = r#"[{"name": "battery", "height": 0.053}, {"name": "pump", "height": 0.11}]"#;
const ONE_PART: &str = r#"[{"station": "as1", "parts": {"battery": 1}}]"#;
const TWO_PARTS: &str = r#"[{"station": "as1", "parts": {"battery": 1, "pump": 1}}]"#;
const TWO_ORDERS: &str =
    r#"[{"station": "as1", "parts": {"battery": 1}}, {"station": "as1", "parts": {"pump": 1}}]"#;

/// A line to be searched: its texts, without those of the type that has the mistake.
struct Line {
    name: &'static str,
    texts: Texts,
    faults: Faults,
}

fn line(name: &'static str, layout: &str, orders: &str, faults: Faults) -> Line {
    let scenario = format!(r#"{{"kinds": {KINDS}, "orders": {orders}}}"#);
    let texts = Texts { layout: layout.into(), scenario: Some(scenario), ..own_line("buffer") };
    Line { name, texts, faults }
}

/// The layout of the buffer without an object, or with another one in its place.
fn replaced(layout: &str, name: &str, by: &str) -> String {
    let end_of = |begin: usize| begin + layout[begin..].find("\n    },\n").expect("an end") + 8;
    let at = layout.find(&format!(r#""name": "{name}""#)).expect("an object");
    let begin = layout[..at].rfind("    {\n").expect("its beginning");
    format!("{}{by}{}", &layout[..begin], &layout[end_of(begin)..])
}

/// Lines of which each shows some mistakes; with the quickest first.
fn lines() -> Vec<Line> {
    let table = own_line("buffer").layout;
    let only = replaced(&table, "agv1", "");
    // Without the table items go by the vehicle.
    let vehicle = replaced(&table, "buffer", "");
    // A second arm on the other side of the table, with a belt of its own.
    let second = r#"    {
      "name": "conveyor_belt2", "type": "conveyor", "pose": [-3.826924, 0, 0], "orient": "y", "orient_range": [-5, 5]
    },
    {
      "name": "kitting2", "type": "kitting", "pose": [-3.1, 0, 1.127], "rail_dim": "y", "rail_range": [-4.8, 4.8],
      "takes_from": ["conveyor_belt2"]
    },
"#;
    let twins = replaced(&table, "agv1", second);
    vec![
        line("table, two parts", &table, TWO_PARTS, Faults::None),
        line("vehicle, two parts", &vehicle, TWO_PARTS, Faults::None),
        line("vehicle, two orders", &vehicle, TWO_ORDERS, Faults::None),
        line("table, one part, faults", &table, ONE_PART, Faults::All),
        line("vehicle, one part, faults", &vehicle, ONE_PART, Faults::All),
        line("table alone, two parts", &only, TWO_PARTS, Faults::None),
        line("two arms at the table", &twins, TWO_PARTS, Faults::None),
    ]
}

/// The lines of these that are small enough to be compared.
const COMPARED: usize = 6;

const BOUNDS: Bounds = Bounds {
    answers: Some(1),
    orders: Orders::One,
    time: Some(Duration::from_secs(20)),
    memory: 500_000_000,
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
        let mut texts = line.texts.clone();
        match name {
            "buffer" => texts.specs[0] = text.to_string(),
            _ => texts.specs.push(text.to_string()),
        }
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

#[test]
fn mistakes_are_found() {
    let names = ["agv", "conveyor", "gantry", "kitting", "station"];
    let library = names.map(|name| {
        let file = library::FILES.iter().find(|(file, _)| *file == format!("library/{name}.aut"));
        (name, file.expect("a type of the library").1.to_string())
    });
    let mut lines = lines();
    let own = ("buffer", lines[0].texts.specs[0].clone());
    let mut all = Vec::new();
    for (name, text) in library.into_iter().chain([own]) {
        all.extend(mutants(&text).into_iter().map(|mutant| (name, mutant)));
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
    let mut missed = BTreeSet::new();
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
            Result::Missed => {
                missed.insert(what);
            }
        }
    }
    missed.iter().for_each(|what| println!("missed: {what}"));
    println!(
        "{} mutants, {refused} refused, {equal} equal, {caught} of the others found, each within {longest:.1?} of a processor",
        all.len()
    );
    let least = if is_long { 240 } else { 30 };
    assert!(caught >= least, "{caught} of {} mutants are found", all.len() - refused);
}
