//! Mistakes in the library's types are found: those that show without faults of devices here, all others in the long form.

use autogen::library;
use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, explore};
use autogen_search::plant::Faults;
use autogen_search::successor::Orders;
use autogen_tests::mutants::mutants;
use autogen_tests::{Texts, is_full_campaign, on_all_processors, own_line};
use std::collections::BTreeSet;
use std::time::{Duration, Instant};

const ONE_PART: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}],
    "orders": [{"station": "as1", "parts": {"battery": 1}}]
}"#;
const TWO_PARTS: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}, {"name": "pump", "height": 0.11}],
    "orders": [{"station": "as1", "parts": {"battery": 1, "pump": 1}}]
}"#;

/// What a search finds; none if the line is refused.
fn found(texts: &Texts, faults: Faults) -> Option<BTreeSet<String>> {
    let project = texts.compile().project?;
    let model = model(&project, &Asked::with(faults)).ok()?.model;
    let bounds = Bounds {
        answers: Some(1),
        orders: Orders::One,
        time: Some(Duration::from_secs(30)),
        memory: 500_000_000,
        violations: if faults == Faults::None { 1 } else { 100 },
        jobs: 1,
    };
    let outcome = explore(&model, &bounds, &mut |_| true);
    Some(outcome.violations.iter().map(|(violation, _)| format!("{violation:?}")).collect())
}

#[test]
fn mistakes_are_found() {
    let line = Texts { scenario: Some(TWO_PARTS.into()), ..own_line("buffer") };
    // Without the table parts go by the vehicle.
    let begin = line
        .layout
        .find(
            r#"{
      "name": "buffer""#,
        )
        .expect("the table");
    let end = line
        .layout
        .find(
            r#"{
      "name": "agv1""#,
        )
        .expect("the vehicle");
    let direct = Texts { layout: line.layout.replace(&line.layout[begin..end], ""), ..line.clone() };
    let of_type = |name: &str| if name == "agv" { &direct } else { &line };
    let one_part = |texts: &Texts| Texts { scenario: Some(ONE_PART.into()), ..texts.clone() };
    let names = ["agv", "conveyor", "gantry", "kitting", "station"];
    let library = names.map(|name| {
        let file = library::FILES.iter().find(|(file, _)| *file == format!("library/{name}.aut"));
        (name, file.expect("a type of the library").1.to_string())
    });
    let own = ("buffer", line.specs[0].clone());
    let mut all = Vec::new();
    for (name, text) in library.into_iter().chain([own]) {
        all.extend(mutants(&text).into_iter().map(|mutant| (name, mutant)));
    }
    let is_long = is_full_campaign();
    let before = |texts: &Texts| found(&one_part(texts), Faults::All).expect("a right line");
    let before = is_long.then(|| [before(&line), before(&direct)]);
    let results = on_all_processors(&all, |(name, mutant)| {
        let begin = Instant::now();
        let mut texts = of_type(name).clone();
        match *name {
            "buffer" => texts.specs[0].clone_from(&mutant.text),
            _ => texts.specs.push(mutant.text.clone()),
        }
        let without = found(&texts, Faults::None)?;
        if !without.is_empty() || !is_long {
            return Some((!without.is_empty(), begin.elapsed()));
        }
        let with = found(&one_part(&texts), Faults::All)?;
        let before = before.as_ref().map(|before| &before[usize::from(*name == "agv")]);
        let is_found = before.is_some_and(|before| with.iter().any(|violation| !before.contains(violation)));
        Some((is_found, begin.elapsed()))
    });
    let refused = results.iter().filter(|result| result.is_none()).count();
    let found = results.iter().flatten().filter(|(is_found, _)| *is_found);
    let (caught, longest) = (found.clone().count(), found.map(|(_, time)| *time).max().unwrap_or_default());
    for ((name, mutant), _) in
        all.iter().zip(&results).filter(|(_, result)| result.is_some_and(|(found, _)| !found))
    {
        println!("{name}.aut, {}", mutant.what);
    }
    println!(
        "{} mutants, {refused} refused by the compiler, {caught} found, each within {longest:.1?}",
        all.len()
    );
    assert!(all.len() >= 100, "{} mutants", all.len());
    let least = if is_long { 165 } else { 55 };
    assert!(caught >= least, "{caught} of {} mutants are found", all.len() - refused);
}
