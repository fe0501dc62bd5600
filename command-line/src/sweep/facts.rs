//! What a page says in its head: which sweep it is, or which run of one.

use super::super::options::TableOptions;
use super::axis::Axis;
use super::design::{Design, RunNumber};
use super::page;
use super::plan::Plan;
use autogen::backend::report::sweep::Fact;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Values of a list that are all named.
const MOST_NAMED: usize = 12;
/// Those at the beginning of a longer list.
const FIRST: usize = 3;

pub fn title(design: &Design) -> String {
    let varied: Vec<&str> =
        (design.axes.iter()).filter(|axis| axis.values.len() > 1).map(|axis| axis.name.as_str()).collect();
    let by = if varied.is_empty() { String::new() } else { format!(" by {}", varied.join(", ")) };
    match design.layouts.len() {
        count if count > FIRST => format!("Sweep of {count} layouts{by}"),
        _ => format!("Sweep of {}{by}", design.layouts.join(", ")),
    }
}

/// What a page says of a sweep that its design does not say.
#[derive(Debug)]
pub struct About {
    /// Names of files.
    scenarios: Vec<String>,
    types: Vec<String>,
    seed: String,
}

impl About {
    pub fn of(plan: &Plan, specs: &[PathBuf]) -> Self {
        let types = specs.iter().map(|path| file_name(path)).collect();
        Self { scenarios: scenarios(plan), types, seed: seeds(plan) }
    }

    /// As a part of a sweep carries it in its first line.
    pub fn to_json(&self) -> Value {
        json!({ "scenarios": self.scenarios, "types": self.types, "seed": self.seed })
    }

    /// What [`Self::to_json`] gave; `None` for anything else.
    pub fn from_json(json: &Value) -> Option<Self> {
        let text = |json: &Value| json.as_str().map(String::from);
        let texts = |json: &Value| json.as_array()?.iter().map(text).collect::<Option<_>>();
        Some(Self {
            scenarios: texts(&json["scenarios"])?,
            types: texts(&json["types"])?,
            seed: text(&json["seed"])?,
        })
    }
}

/// `until_precision` is as written.
pub fn of_sweep(
    design: &Design,
    about: &About,
    until_precision: Option<&str>,
    options: &TableOptions,
) -> Vec<Fact> {
    let mut facts = Facts::default();
    facts.add("layouts", listed(&design.layouts));
    facts.add("scenario", listed(&about.scenarios));
    facts.add("types from", listed(&about.types));
    let (varied, fixed): (Vec<_>, Vec<_>) = design.axes.iter().partition(|axis| axis.values.len() > 1);
    let set = |axes: Vec<&Axis>| {
        let each: Vec<String> =
            axes.iter().map(|axis| format!("{} = {}", axis.name, listed(&axis.values))).collect();
        each.join("; ")
    };
    facts.add("varied", set(varied));
    facts.add("fixed", set(fixed));
    facts.add(
        "order of the steps, seed",
        listed(&design.orders.iter().map(u64::to_string).collect::<Vec<_>>()),
    );
    facts.add("I/O delay, scans", listed(&design.delays));
    let runs = design.replications;
    match until_precision {
        Some(precision) => facts.add("replications", format!("until {precision}, {runs} at most")),
        None => facts.add("replications", runs.to_string()),
    }
    facts.add("seed", about.seed.clone());
    facts.add("warm-up", design.warm_up.map_or_else(String::new, |warm_up| warm_up.to_string()));
    if options.compare {
        let first = RunNumber { point: 0, replication: 0 };
        facts.add("difference to", format!("row 1: {}", point(design, first)));
    }
    if let Some(path) = &options.beside {
        facts.add("measured", file_name(path));
    }
    facts.0
}

/// `seed` is that of the scenario in this run.
pub fn of_run(plan: &Plan, run: RunNumber, seed: u64) -> Vec<Fact> {
    let design = &plan.design;
    let mut facts = Facts::default();
    let line = &plan.lines[design.point(run.point).layout];
    facts.add("row of the sweep", (run.point + 1).to_string());
    facts.add("point", point(design, run));
    facts.add("scenario", line.shown.file(line.scenario).name.clone());
    if design.has_means() {
        facts.add("replication", (run.replication + 1).to_string());
    }
    facts.add("seed", seed.to_string());
    facts.0
}

#[derive(Default)]
struct Facts(Vec<Fact>);

impl Facts {
    /// Nothing is said of what there is not.
    fn add(&mut self, name: &'static str, value: String) {
        if !value.is_empty() {
            self.0.push(Fact { name, value });
        }
    }
}

/// The values that name a point.
fn point(design: &Design, run: RunNumber) -> String {
    let indices = design.indices(&design.point(run.point));
    let names = page::names(design);
    let values = names.iter().zip(indices);
    let values = values.map(|(name, index)| format!("{} {}", name.title, name.values.texts()[index]));
    values.collect::<Vec<_>>().join(", ")
}

fn scenarios(plan: &Plan) -> Vec<String> {
    let mut names: Vec<String> = Vec::new();
    for line in &plan.lines {
        let name = &line.shown.file(line.scenario).name;
        if !names.contains(name) {
            names.push(name.clone());
        }
    }
    names
}

/// Those of the scenarios, unless they are varied.
fn seeds(plan: &Plan) -> String {
    let mut seeds: Vec<String> = Vec::new();
    let is_varied = plan.lines.iter().any(|line| {
        line.settings
            .iter()
            .any(|of_axis| of_axis.first().is_some_and(|setting| line.draft.is_of_supply(setting)))
    });
    for line in plan.lines.iter().filter(|_| !is_varied) {
        let seed = line.draft.seed().map(|seed| seed.to_string());
        seeds.extend(seed.filter(|seed| !seeds.contains(seed)));
    }
    let further = plan.design.has_means().then(|| "one more for each further replication".to_string());
    let listed = Some(listed(&seeds)).filter(|text| !text.is_empty());
    listed.into_iter().chain(further).collect::<Vec<_>>().join(", ")
}

fn file_name(path: &Path) -> String {
    path.file_name().unwrap_or(path.as_os_str()).to_string_lossy().into_owned()
}

/// All of a short list; of a long one the beginning, the end and the number.
fn listed(values: &[String]) -> String {
    match values {
        [.., last] if values.len() > MOST_NAMED => {
            format!("{}, …, {last} ({} values)", values[..FIRST].join(", "), values.len())
        }
        all => all.join(", "),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_list_has_its_ends_and_its_number() {
        let values = |count: usize| (1..=count).map(|n| n.to_string()).collect::<Vec<_>>();
        assert_eq!(listed(&values(3)), "1, 2, 3");
        assert_eq!(listed(&values(13)), "1, 2, 3, …, 13 (13 values)");
        assert_eq!(listed(&[]), "");
    }
}
