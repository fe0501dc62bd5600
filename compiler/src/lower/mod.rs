//! From texts to a system: types bound to the machines of a layout, parameters,
//! connectivity, roles. The hinge between what knows source text and what does not.

mod bind;
mod parameter;
mod plant;
mod role;
mod setting;

pub use setting::Setting;

use crate::check::{self, Checked};
use crate::diagnostic::{self, Diagnostic};
use crate::layout::Layout;
use crate::scenario::Scenario;
use crate::source::{FileId, Sources};
use crate::spec::{ast, parser};
use crate::{connect, ir, layout, scenario};
use runtime_sim::random::Random;
use std::collections::BTreeSet;

/// What is to be compiled; every text is in `sources` already.
#[derive(Clone, Debug)]
pub struct Input {
    pub sources: Sources,
    pub layout: FileId,
    /// Files of types; a type of a later one replaces one of the same name of an earlier one.
    pub specs: Vec<FileId>,
    pub scenario: FileId,
    /// From the command line; they stand above the layout.
    pub settings: Vec<Setting>,
    /// Steps the instances in an order shuffled with this seed instead of layout order.
    pub order: Option<u64>,
}

/// A line that has passed every check.
#[derive(Clone, Debug)]
pub struct Project {
    pub name: String,
    pub system: ir::System,
    /// What the simulator needs; its machines are the instances.
    pub plant: runtime_sim::line::Line,
    /// Between instances.
    pub edges: Vec<connect::Edge>,
}

/// What the connectivity check found, by names.
#[derive(Clone, Debug, Default)]
pub struct Verdict {
    pub feasible: bool,
    /// All instances, in the order in which they step.
    pub robots: Vec<String>,
    pub edges: Vec<(String, String, f64)>,
    pub sources: Vec<String>,
    pub destinations: Vec<String>,
    pub unreachable: Vec<String>,
    pub dead_ends: Vec<String>,
    /// Pairs that should meet and do not.
    pub apart: Vec<Apart>,
}

/// A pair of machines that should meet and does not.
#[derive(Clone, Debug)]
pub struct Apart {
    pub from: String,
    pub to: String,
    pub tested: usize,
    /// Place, kind, stage and missing mm of each pose, the worst first.
    pub misses: Vec<connect::Miss>,
    /// Robot, path of the number, present and new value.
    pub mend: Option<(String, String, f64, f64)>,
}

/// The result of a compilation: `project` is there exactly when `diagnostics` is empty.
#[derive(Clone, Debug)]
pub struct Outcome {
    pub sources: Sources,
    pub diagnostics: Vec<Diagnostic>,
    /// There as soon as the check of connectivity could be made.
    pub verdict: Option<Verdict>,
    pub project: Option<Project>,
}

/// Compiles a line as far as it is right.
pub fn compile(input: Input) -> Outcome {
    let Input { sources, layout: layout_file, specs, scenario: scenario_file, settings, order } = input;
    let mut diagnostics = Vec::new();

    let (layout, found) = layout::parse(&sources, layout_file);
    let layout_is_right = found.is_empty();
    diagnostics.extend(found);
    let mut files = Vec::new();
    let mut syntax_is_right = true;
    for file in specs {
        let (tree, found) = parser::parse(file, &sources.file(file).text);
        syntax_is_right &= found.is_empty();
        diagnostics.extend(found);
        files.push((file, tree));
    }
    let (scenario, found) = scenario::parse(&sources, scenario_file);
    diagnostics.extend(found);
    let kinds: Vec<String> = match &scenario {
        Some(scenario) => scenario.kinds.iter().map(|k| k.name.value.clone()).collect(),
        None => vec!["part".into()],
    };
    let checked = match check::check(&sources, &files, &kinds) {
        Ok(checked) => Some(checked),
        // What could not be read is missed by what was read: those messages would only confuse.
        Err(found) => {
            if syntax_is_right {
                diagnostics.extend(found);
            }
            None
        }
    };
    let mut outcome = Outcome { sources, diagnostics, verdict: None, project: None };
    if let (Some(mut layout), Some(checked), Some(scenario)) = (layout, checked, scenario)
        && syntax_is_right
    {
        if let Some(seed) = order {
            Random::new(seed).shuffle(&mut layout.objects);
        }
        let is_whole = layout_is_right && outcome.diagnostics.is_empty();
        system(&mut outcome, layout, &files, &checked, &scenario, &settings, is_whole);
    }
    diagnostic::sort(&mut outcome.diagnostics);
    if !outcome.diagnostics.is_empty() {
        outcome.project = None;
    }
    outcome
}

fn system(
    outcome: &mut Outcome,
    layout: Layout,
    files: &[(FileId, ast::File)],
    checked: &Checked,
    scenario: &Scenario,
    settings: &[Setting],
    is_whole: bool,
) {
    let bound = bind::bind(&layout, checked.model(), &mut outcome.diagnostics);
    setting::check(settings, &bound, checked.model(), &mut outcome.diagnostics);
    if !is_whole || bound.robots.len() + bound.obstacles.len() != layout.objects.len() {
        return;
    }
    let names: BTreeSet<String> = bound.robots.iter().map(|r| r.automaton.clone()).collect();
    let kinds: Vec<String> = scenario.kinds.iter().map(|k| k.name.value.clone()).collect();
    let model = match check::check(&outcome.sources, &check::used(files, &names), &kinds) {
        Ok(checked) => checked.into_model(),
        Err(found) => {
            outcome.diagnostics.extend(found);
            return;
        }
    };
    let mut line = role::Line::new(&layout, bound.robots, model, scenario);
    line.parameters(settings);
    let report = line.connect();
    outcome.verdict = Some(line.verdict(&report));
    outcome.diagnostics.append(&mut line.diagnostics);
    outcome.diagnostics.extend(report.diagnostics.iter().cloned());
    let resolved = plant::resolve(scenario, &line);
    let resolved = match resolved {
        Ok(resolved) => resolved,
        Err(found) => {
            outcome.diagnostics.extend(found);
            return;
        }
    };
    if !outcome.diagnostics.is_empty() {
        return;
    }
    let robot = |node: usize| line.robot_of(node);
    let edges =
        report.edges.iter().map(|e| connect::Edge { from: robot(e.from), to: robot(e.to), ..*e }).collect();
    let Some(system) = line.system(report, layout.scan_ms) else {
        outcome.diagnostics.append(&mut line.diagnostics);
        return;
    };
    let plant = plant::line(&system, &line, bound.obstacles, resolved, layout.scan_ms);
    outcome.project = Some(Project { name: layout.name, system, plant, edges });
}
