//! A line without its values, so that it is read and checked once for many of them.

use super::setting::{self, Setting};
use super::{
    Project, Verdict, bind, collected, complete, device_key, kinds, lonely, overlap, plant, resized, role,
    short,
};
use crate::check::{self, Checked};
use crate::device::panel;
use crate::diagnostic::{self, Diagnostic};
use crate::ir::Model;
use crate::layout::{Layout, Panel, Reading};
use crate::parallel::both;
use crate::scenario::{Number, Scenario};
use crate::source::{FileId, Sources, Span};
use crate::spec::{ast, parser};
use crate::{connect, interlock, lint, scenario};
use runtime_sim::plant::transfers;
use runtime_sim::random::Random;
use std::collections::BTreeSet;

/// The layout of a line, and its other texts by their numbers in [`Sources`].
#[derive(Clone, Debug)]
pub struct Texts<'a> {
    pub layout: Reading,
    /// A type of a later one replaces one of the same name of an earlier one.
    pub specs: &'a [FileId],
    pub scenario: FileId,
}

/// A line as far as it depends neither on values of parameters nor on the order of the steps.
#[derive(Clone, Debug)]
pub struct Draft {
    /// What is wrong whatever the values are.
    diagnostics: Vec<Diagnostic>,
    /// What is hardly meant; of types that have no errors.
    warnings: Vec<Diagnostic>,
    name: Option<String>,
    orders: Option<usize>,
    items: Option<u64>,
    parts: Option<Parts>,
}

/// There if texts and types are right, machines have types, and the types that are used go together.
#[derive(Clone, Debug)]
struct Parts {
    layout: Layout,
    scenario: Scenario,
    /// Of just the types that the layout uses.
    model: Model,
}

/// A draft with its values: `project` is there exactly when `diagnostics` is empty.
#[derive(Clone, Debug)]
pub struct Line {
    pub diagnostics: Vec<Diagnostic>,
    /// What is hardly meant in the layout.
    pub warnings: Vec<Diagnostic>,
    /// There as soon as the check of connectivity could be made.
    pub verdict: Option<Verdict>,
    pub project: Option<Project>,
}

impl Draft {
    /// `settings` are all that will ever be made: each has to concern somebody and something.
    pub fn new(sources: &Sources, texts: Texts, settings: &[Setting]) -> Self {
        let (layout, mut diagnostics) = texts.layout;
        // One with errors may name a scenario where it cannot be read.
        let names_scenario = layout.as_ref().is_some_and(|layout| layout.scenario.is_some());
        let may_name_another = !names_scenario && !diagnostics.is_empty();
        let mut files = Vec::new();
        let mut syntax_is_right = true;
        let mut left = parser::MOST_TOKENS;
        for &file in texts.specs {
            let (tree, found) = parser::parse_within(file, &sources.file(file).text, &mut left);
            syntax_is_right &= found.is_empty();
            diagnostics.extend(found);
            files.push((file, tree));
        }
        let (scenario, found) = scenario::parse(sources, texts.scenario);
        diagnostics.extend(found);
        let kinds = match &scenario {
            _ if may_name_another => None,
            Some(read) => Some(read.names_of_kinds()),
            None => scenario::kinds(sources, texts.scenario),
        };
        // What could not be read is missed by what was read: what follows from that would only confuse.
        let checked = syntax_is_right.then(|| check::check(sources, &files, kinds.as_deref()));
        let checked = checked.and_then(|checked| checked.map_err(|found| diagnostics.extend(found)).ok());
        let of_its_own = scenario.as_ref().filter(|scenario| !scenario.is_built_in(sources));
        let orders = of_its_own.and_then(number_of_orders);
        let goal = scenario.as_ref().map(|s| s.goal.as_slice()).filter(|goal| !goal.is_empty());
        let items = goal.map(|goal| goal.iter().flat_map(|sink| &sink.items).map(|n| u64::from(*n)).sum());
        let name = layout.as_ref().map(|l| l.name.clone());
        let mut draft = Self { diagnostics, warnings: Vec::new(), name, orders, items, parts: None };
        if let (Some(layout), Some(checked), Some(scenario)) = (layout, checked, scenario) {
            draft.warnings = lint::warnings(&checked, &files, layout.panel);
            let model = draft.bind(sources, &layout, &files, &checked, &scenario, settings);
            draft.parts = model.map(|model| {
                let makes = model.automata.iter().any(|a| a.device.has("orders") || a.device.has("source"));
                let is_for_it = makes || !scenario.is_built_in(sources);
                let scenario = if is_for_it { scenario } else { scenario.without_orders() };
                draft.orders = number_of_orders(&scenario);
                Parts { layout, scenario, model }
            });
        }
        diagnostic::sort(&mut draft.diagnostics);
        draft
    }

    /// The model of just the types that the layout uses; `None` has been reported.
    fn bind(
        &mut self,
        sources: &Sources,
        layout: &Layout,
        files: &[(FileId, ast::File)],
        checked: &Checked,
        scenario: &Scenario,
        settings: &[Setting],
    ) -> Option<Model> {
        let model = checked.model();
        let mut found = Vec::new();
        bind::bind(&device_key::set(layout, settings, model), model, &mut found);
        // What other values may not have is told of each line.
        found.retain(|found| !device_key::depends_on_values(found, layout, settings, model));
        self.diagnostics.extend(found);
        let is_right = self.diagnostics.is_empty();
        let machines = setting::machines(layout, model);
        if is_right && machines.is_empty() {
            let place = Span::new(layout.file, 0, 0);
            let message = "the layout has no machine, so there is nothing to control";
            let help = "add one to \"robots\": an object whose type has an automaton";
            self.diagnostics.push(Diagnostic::new("E0512", place, message).help(help));
            return None;
        }
        setting::check(settings, &machines, &mut self.diagnostics);
        if !is_right {
            return None;
        }
        let names: BTreeSet<String> = machines.iter().map(|(_, automaton)| automaton.name.clone()).collect();
        let mut used = check::used(files, &names);
        if layout.panel == Panel::Machines {
            let clashes = panel::add(&mut used);
            if !clashes.is_empty() {
                self.diagnostics.extend(clashes);
                return None;
            }
        }
        if !scenario.is_built_in(sources) {
            let automata = checked.model().automata.iter().filter(|a| names.contains(&a.name));
            let devices = automata.map(|automaton| automaton.device.name.as_str()).collect();
            self.diagnostics.extend(kinds::unknown(&used, &devices, &scenario.names_of_kinds()));
        }
        match check::check(sources, &used, Some(&scenario.names_of_kinds())) {
            Ok(checked) if !checked.lonely().is_empty() => {
                self.diagnostics.extend_from_slice(checked.lonely());
                None
            }
            Ok(checked) => {
                let mut model = checked.into_model();
                complete(&mut model, layout.panel);
                Some(model)
            }
            Err(mut found) => {
                lonely::explain(sources, files, &names, &mut found);
                self.diagnostics.extend(found);
                None
            }
        }
    }

    /// What is wrong whatever the values are.
    pub fn diagnostics(&self) -> &[Diagnostic] {
        &self.diagnostics
    }

    /// What is hardly meant, of all types; empty if they have errors.
    pub fn warnings(&self) -> &[Diagnostic] {
        &self.warnings
    }

    /// The layout's name, if that can be read.
    pub fn name(&self) -> Option<&str> {
        self.name.as_deref()
    }

    /// Number of orders of the scenario; none if they have no end, or if it is not known.
    pub fn orders(&self) -> Option<usize> {
        self.orders
    }

    /// Number of items that the sinks of a goal should collect, if the scenario has one and can be read.
    pub fn items(&self) -> Option<u64> {
        self.items
    }

    /// The seed of the scenario, if no setting gives another; not known of a draft with errors.
    pub fn seed(&self) -> Option<u32> {
        self.parts.as_ref().map(|parts| parts.scenario.supply.seed)
    }

    /// Whether a setting is of the scenario's supply; not known of a draft with errors.
    pub fn is_of_supply(&self, setting: &Setting) -> bool {
        self.parts.as_ref().is_some_and(|parts| {
            setting::is_of_supply(setting, &setting::machines(&parts.layout, &parts.model))
        })
    }

    /// The line with these values, and with its instances in layout order or in one drawn from `order`.
    pub fn line(&self, settings: &[Setting], order: Option<u64>) -> Line {
        let mut line = Line {
            diagnostics: self.diagnostics.clone(),
            warnings: Vec::new(),
            verdict: None,
            project: None,
        };
        if let Some(parts) = &self.parts {
            parts.line(&mut line, settings, order);
            diagnostic::sort(&mut line.diagnostics);
        }
        if !line.diagnostics.is_empty() {
            line.project = None;
        }
        line
    }
}

fn number_of_orders(scenario: &Scenario) -> Option<usize> {
    match scenario.orders.number {
        Number::Listed => Some(scenario.orders.list.len()),
        Number::None => Some(0),
        Number::WithoutEnd => None,
    }
}

impl Parts {
    fn line(&self, found: &mut Line, settings: &[Setting], order: Option<u64>) {
        let mut layout = device_key::set(&self.layout, settings, &self.model);
        if let Some(seed) = order {
            Random::new(seed).shuffle(&mut layout.to_mut().objects);
        }
        let bound = bind::bind(&layout, &self.model, &mut found.diagnostics);
        if bound.robots.len() + bound.obstacles.len() != layout.objects.len() {
            return;
        }
        let mut scenario = self.scenario.clone();
        let machines = setting::machines(&layout, &self.model);
        setting::apply(settings, &machines, &mut scenario, &mut found.diagnostics);
        let mut line = role::Line::new(&layout, bound.robots, self.model.clone(), &scenario);
        if line.is_too_large() {
            found.diagnostics.append(&mut line.diagnostics);
            return;
        }
        let Some(machines) = line.machines() else {
            found.diagnostics.append(&mut line.diagnostics);
            return;
        };
        line.parameters(settings);
        let Some(report) = line.connect() else {
            found.diagnostics.append(&mut line.diagnostics);
            return;
        };
        found.verdict = Some(line.verdict(&report));
        found.diagnostics.append(&mut line.diagnostics);
        found.diagnostics.extend(report.diagnostics.iter().cloned());
        let resolved = match plant::resolve(&scenario, &line, &machines) {
            Ok(resolved) => resolved,
            Err(wrong) => {
                found.diagnostics.extend(wrong);
                return;
            }
        };
        if !found.diagnostics.is_empty() {
            return;
        }
        let robot = |node: usize| line.robot_of(node);
        let edges: Vec<connect::Edge> = report
            .edges
            .iter()
            .map(|e| connect::Edge { from: robot(e.from), to: robot(e.to), ..*e })
            .collect();
        let Some(system) = line.system(report, layout.scan_ms) else {
            found.diagnostics.append(&mut line.diagnostics);
            return;
        };
        let drawn = resolved.drawn.clone();
        let mut plant = plant::line(&system, &line, bound.obstacles, resolved, layout.scan_ms, machines);
        let visits = interlock::visits::of_all(&system, &plant);
        plant.machines.iter_mut().zip(visits).for_each(|(machine, visits)| machine.visits = visits);
        let transfers = transfers(&plant);
        let of_plant = || {
            let overlaps = overlap::overlaps(&layout, &plant);
            let out_of_reach = collected::out_of_reach(&scenario, &layout, &plant, &edges, &transfers);
            let comes = collected::comes_onto(&plant, &edges, &transfers);
            (overlaps, out_of_reach, short::lanes(&layout, &plant, comes))
        };
        let machines = plant.machines.len();
        let ((overlaps, out_of_reach, short), warnings) = both(machines, of_plant, || {
            if let Some(verdict) = &mut found.verdict {
                verdict.add_conveyors(&plant, &edges, &transfers);
            }
            lint::of_layout(&layout, &system, &plant)
        });
        found.diagnostics.extend(overlaps);
        found.diagnostics.extend(resized::items(&line, &plant));
        found.diagnostics.extend(out_of_reach);
        found.diagnostics.extend(short);
        found.warnings = warnings;
        let Layout { name, may_touch, .. } = &*layout;
        let (name, may_touch) = (name.clone(), may_touch.clone());
        found.project = Some(Project { name, system, plant, drawn, edges, transfers, may_touch });
    }
}
