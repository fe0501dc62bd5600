//! What a sweep runs: its layouts, read and checked, and the runs of its design, none of them written out.

use super::super::commission::io_delay;
use super::super::controllers::{self, Notice, SharedLibrary};
use super::super::load::{self, Failure};
use super::super::options::SweepOptions;
use super::super::titles;
use super::axis::Axis;
use super::design::{Asked, Design, Point};
use super::distinct;
use super::precision::{self, Precision};
use super::together;
use super::warm_up::WarmUp;
use autogen::backend::rust::parameters_text;
use autogen::diagnostic::Diagnostic;
use autogen::ir::System;
use autogen::lower::{Draft, Project, Setting, Texts};
use autogen::source::{FileId, Sources};
use runtime_sim::line::IoDelay;
use runtime_sim::memory::Memory;
use std::collections::VecDeque;
use std::num::NonZeroU32;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, PoisonError};

pub struct Plan {
    pub design: Design,
    /// One for each layout of the design.
    pub lines: Vec<Line>,
    /// What the delays of the design mean; one at least.
    pub delays: Vec<IoDelay>,
    /// Number of runs, at most.
    pub runs: usize,
}

/// A layout, read and checked as far as values do not matter.
pub struct Line {
    pub sources: Sources,
    /// Its texts, by their numbers in the sources.
    pub layout: FileId,
    pub specs: Vec<FileId>,
    pub scenario: FileId,
    pub draft: Draft,
    /// For each axis the settings of its values.
    pub settings: Vec<Vec<Setting>>,
    /// The sources under the names that outputs show.
    pub shown: Sources,
    /// Its own, or that of its file.
    name: String,
    library: Mutex<Option<Result<SharedLibrary, String>>>,
    /// The lines of the points that were asked for last, or what is wrong with them, the last one first: those of the
    /// replications which follow, and of runs that are made together.
    last_made: Mutex<VecDeque<(Point, MadeOrWrong)>>,
    /// What runs of this layout have found; one for each that continues at the same time, beside the first one.
    memories: Mutex<Vec<Memory>>,
    memory: Memory,
}

/// Why there is no plan.
pub enum Refusal {
    Failure(Failure),
    Said(String),
}

impl Plan {
    pub fn new(options: &SweepOptions) -> Result<Self, Refusal> {
        let axes: Vec<Axis> = options.settings.iter().map(|text| Axis::parse(text)).collect();
        for (number, axis) in axes.iter().enumerate() {
            if axes[..number].iter().any(|other| other.name == axis.name) {
                return Err(Refusal::Said(format!(
                    "--set {} is given twice; give all its values in one list, separated by commas",
                    axis.name
                )));
            }
        }
        let files: Vec<PathBuf> = (options.layouts.iter())
            .map(|path| path.canonicalize().unwrap_or_else(|_| path.clone()))
            .collect();
        if let Some(path) = distinct::twice(&files, PartialEq::eq) {
            let path = options.layouts[path].display();
            return Err(Refusal::Said(format!("{path}: this layout is named twice; name it once")));
        }
        let mut lines = Vec::new();
        for path in &options.layouts {
            lines.push(Line::new(path, options, &axes).map_err(Refusal::Failure)?);
        }
        let mut delays = Vec::new();
        for text in &options.io_delay {
            let delay = io_delay(text).ok_or_else(|| {
                Refusal::Said(
                    "--io-delay takes numbers of scans up to 1000, `random` or `random:SEED`".into(),
                )
            })?;
            delays.push(delay);
        }
        for (number, axis) in axes.iter().enumerate() {
            // They are read in the same way for all layouts.
            let settings = lines.first().map_or(&[][..], |line: &Line| &line.settings[number]);
            distinct::once(&format!("--set {}", axis.name), &axis.values, settings, distinct::same_setting)?;
        }
        distinct::once("--order", &options.order, &options.order, PartialEq::eq)?;
        distinct::once("--io-delay", &options.io_delay, &delays, PartialEq::eq)?;
        if delays.is_empty() {
            delays.push(IoDelay::Fixed(0));
        }
        let precision = options.until_precision.as_deref().map(precision).transpose()?;
        if precision.is_some()
            && let Some(few) = options.replications.filter(|few| (few.get() as usize) < precision::FEWEST)
        {
            return Err(Refusal::Said(format!(
                "--until-precision looks at a point after {} runs, and --replications {few} ends it before; give more, or \
                 leave --replications out",
                precision::FEWEST
            )));
        }
        let most = if precision.is_some() { precision::MOST } else { 1 };
        let replications = options.replications.map_or(most, NonZeroU32::get);
        distinct::seeds_are_apart(&axes, &lines, &delays, replications)?;
        let asked = asked(&lines);
        if asked != Asked::Orders && options.warm_up.is_some() {
            return Err(Refusal::Said(
                "--warm-up cuts orders, and these scenarios have none: their figure is of items that sinks collect".into(),
            ));
        }
        if asked != Asked::Orders && options.table.beside.is_some() {
            return Err(Refusal::Said(
                "--beside compares seconds per order, and these scenarios have none: their figure is of items that sinks collect"
                    .into(),
            ));
        }
        let design = Design {
            asked,
            layouts: titles(&lines, &options.layouts),
            axes,
            orders: options.order.clone(),
            delays: options.io_delay.clone(),
            replications,
            warm_up: options.warm_up.as_deref().map(warm_up).transpose()?,
            precision,
        };
        let runs = design.runs().ok_or_else(|| Refusal::Said("there are too many runs to count".into()))?;
        Ok(Self { design, lines, delays, runs })
    }
}

/// Rows have one figure for all: that of orders, if a layout has some, and that of a goal before that of no goal. Layouts
/// with errors do not count.
fn asked(lines: &[Line]) -> Asked {
    let lines: Vec<&Line> = lines.iter().filter(|line| line.draft.diagnostics().is_empty()).collect();
    let has_items = lines.iter().any(|line| line.draft.items().is_some());
    let has_orders = lines.iter().any(|line| line.draft.orders().is_some_and(|orders| orders > 0));
    if has_items && !has_orders {
        Asked::Items
    } else if lines.iter().all(|line| line.draft.orders() == Some(0)) {
        Asked::Throughput
    } else {
        Asked::Orders
    }
}

fn precision(text: &str) -> Result<Precision, Refusal> {
    let said =
        || Refusal::Said("--until-precision takes a percentage between 0% and 100%, such as 2%".into());
    Precision::parse(text).ok_or_else(said)
}

fn warm_up(text: &str) -> Result<WarmUp, Refusal> {
    let said = || {
        Refusal::Said("--warm-up takes `auto`, orders such as `20orders`, or seconds such as `600s`".into())
    };
    WarmUp::parse(text).ok_or_else(said)
}

/// Names of the layouts, or their paths if two have the same name.
fn titles(lines: &[Line], paths: &[PathBuf]) -> Vec<String> {
    let titles: Vec<String> = lines.iter().map(|line| line.name.clone()).collect();
    match distinct::twice(&titles, PartialEq::eq) {
        Some(_) => paths.iter().map(|path| path.display().to_string()).collect(),
        None => titles,
    }
}

/// A line with the values of a point: the same for all its replications.
pub struct Made {
    pub project: Project,
    /// The values of its controllers, as these read them.
    pub parameters: String,
}

type MadeOrWrong = Result<Arc<Made>, Vec<Diagnostic>>;

impl Line {
    fn new(path: &Path, options: &SweepOptions, axes: &[Axis]) -> Result<Self, Failure> {
        let mut sources = Sources::default();
        let texts = load::texts(&mut sources, path, &options.specs, options.scenario.as_deref())?;
        let mut settings = Vec::new();
        let mut wrong = Vec::new();
        for axis in axes {
            let mut of_axis = Vec::new();
            for value in &axis.values {
                match load::setting(&mut sources, &axis.setting(value)) {
                    Ok(setting) => of_axis.push(setting),
                    Err(found) => wrong.extend(found),
                }
            }
            settings.push(of_axis);
        }
        if !wrong.is_empty() {
            return Err(Failure::Wrong(sources, wrong));
        }
        // Whom and what a setting concerns is the same for all values of an axis.
        let concerned: Vec<Setting> =
            settings.iter().filter_map(|of_axis| of_axis.first().cloned()).collect();
        let load::Texts { layout, layout_file, specs, scenario } = texts;
        let named = Texts { layout, specs: &specs, scenario };
        let draft = Draft::new(&sources, named, &concerned);
        let stem = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let shown = titles::shown(&sources, path);
        Ok(Self {
            name: draft.name().map_or(stem, String::from),
            sources,
            layout: layout_file,
            specs,
            scenario,
            draft,
            settings,
            shown,
            library: Mutex::new(None),
            last_made: Mutex::default(),
            memories: Mutex::default(),
            memory: Memory::default(),
        })
    }

    /// The line of a point, with the seed of its scenario and devices that answer at once.
    pub fn made(&self, point: &Point, order: Option<u64>) -> MadeOrWrong {
        let last_made = || self.last_made.lock().unwrap_or_else(PoisonError::into_inner);
        let known = {
            let mut last_made = last_made();
            let place = last_made.iter().position(|(of, _)| of == point);
            place.and_then(|place| last_made.remove(place)).map(|known| {
                last_made.push_front(known.clone());
                known.1
            })
        };
        if let Some(made) = known {
            return made;
        }
        let settings: Vec<Setting> =
            self.settings.iter().zip(&point.values).map(|(of_axis, &value)| of_axis[value].clone()).collect();
        let compiled = self.draft.line(&settings, order);
        let made = compiled.project.ok_or(compiled.diagnostics).map(|project| {
            let parameters = parameters_text(&project.system);
            Arc::new(Made { project, parameters })
        });
        let machines = made.as_ref().map_or(1, |made| made.project.plant.machines.len());
        let mut last_made = last_made();
        last_made.push_front((point.clone(), made.clone()));
        last_made.truncate(2 * together::most_runs(machines) - 1);
        made
    }

    /// Lets a run use what others have found about this layout.
    pub fn remembering<T>(&self, run: impl FnOnce(&mut Memory) -> T) -> T {
        let memories = || self.memories.lock().unwrap_or_else(PoisonError::into_inner);
        let mut memory = memories().pop().unwrap_or_else(|| self.memory.beside());
        let result = run(&mut memory);
        memories().push(memory);
        result
    }

    /// The controllers of this layout's types, compiled by the first who wants them.
    pub fn library(&self, system: &System, notice: Notice) -> Result<SharedLibrary, String> {
        let mut library = self.library.lock().unwrap_or_else(PoisonError::into_inner);
        library.get_or_insert_with(|| controllers::compiled(system, &self.shown, notice)).clone()
    }
}
