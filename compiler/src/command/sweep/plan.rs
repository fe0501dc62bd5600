//! All points of a sweep, none of them written out.

use super::super::build;
use super::super::commission::io_delay;
use super::super::controllers::{self, Notice, SharedLibrary};
use super::super::load::{self, Failure};
use super::super::options::SweepOptions;
use super::axis::Axis;
use autogen::ir::System;
use autogen::lower::{Draft, Setting, Texts};
use autogen::source::Sources;
use runtime_sim::line::IoDelay;
use runtime_sim::memory::Memory;
use std::fmt::Display;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, PoisonError};

pub struct Plan {
    pub lines: Vec<Line>,
    pub axes: Vec<Axis>,
    /// `None` stands for layout order.
    pub orders: Vec<Option<u64>>,
    /// As written, and what it means.
    pub delays: Vec<(String, IoDelay)>,
    len: usize,
}

/// A layout, read and checked as far as values do not matter.
pub struct Line {
    /// How rows name it.
    pub title: String,
    pub sources: Sources,
    pub draft: Draft,
    /// For each axis the settings of its values.
    pub settings: Vec<Vec<Setting>>,
    /// The sources under the names that outputs show.
    pub shown: Sources,
    library: Mutex<Option<Result<SharedLibrary, String>>>,
    /// What runs of this layout have found; one for each that goes on at the same time.
    memories: Mutex<Vec<Memory>>,
}

/// Which value a point has of everything that varies.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Point {
    pub line: usize,
    /// For each axis the index of a value.
    pub values: Vec<usize>,
    pub order: usize,
    pub delay: usize,
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
                    "--set {} stands twice; give all its values in one list, separated by commas",
                    axis.name
                )));
            }
        }
        for axis in &axes {
            is_given_once(&format!("--set {}", axis.name), &axis.values)?;
        }
        is_given_once("--order", &options.order)?;
        is_given_once("--io-delay", &options.io_delay)?;
        let files: Vec<PathBuf> = (options.layouts.iter())
            .map(|path| path.canonicalize().unwrap_or_else(|_| path.clone()))
            .collect();
        if let Some(path) = twice(&files) {
            let path = options.layouts[path].display();
            return Err(Refusal::Said(format!("{path}: this layout is named twice; name it once")));
        }
        let mut lines = Vec::new();
        for path in &options.layouts {
            lines.push(Line::new(path, options, &axes).map_err(Refusal::Failure)?);
        }
        if (1..lines.len()).any(|i| lines[..i].iter().any(|other| other.title == lines[i].title)) {
            for (line, path) in lines.iter_mut().zip(&options.layouts) {
                line.title = path.display().to_string();
            }
        }
        let orders = match options.order.as_slice() {
            [] => vec![None],
            seeds => seeds.iter().copied().map(Some).collect(),
        };
        let mut delays = Vec::new();
        for text in &options.io_delay {
            let delay = io_delay(text).ok_or_else(|| {
                Refusal::Said("--io-delay takes numbers of scans, `random` or `random:SEED`".into())
            })?;
            delays.push((text.clone(), delay));
        }
        if delays.is_empty() {
            delays.push(("0".into(), IoDelay::Fixed(0)));
        }
        let sizes = axes.iter().map(|a| a.values.len()).chain([lines.len(), orders.len(), delays.len()]);
        let len = sizes.into_iter().try_fold(1, usize::checked_mul);
        let len = len.ok_or_else(|| Refusal::Said("there are too many combinations to count".into()))?;
        Ok(Self { lines, axes, orders, delays, len })
    }

    /// Number of points.
    pub fn len(&self) -> usize {
        self.len
    }

    /// The layout changes slowest, then the first axis, and how late devices answer fastest.
    pub fn point(&self, index: usize) -> Point {
        let mut rest = index;
        let mut digit = |size: usize| {
            let digit = rest % size;
            rest /= size;
            digit
        };
        let delay = digit(self.delays.len());
        let order = digit(self.orders.len());
        let mut values: Vec<usize> = self.axes.iter().rev().map(|axis| digit(axis.values.len())).collect();
        values.reverse();
        Point { line: digit(self.lines.len()), values, order, delay }
    }
}

/// Where the first stands that has stood before.
fn twice<T: PartialEq>(list: &[T]) -> Option<usize> {
    (1..list.len()).find(|i| list[..*i].contains(&list[*i]))
}

fn is_given_once<T: PartialEq + Display>(option: &str, values: &[T]) -> Result<(), Refusal> {
    match twice(values) {
        Some(i) => Err(Refusal::Said(format!("{option}: {} stands twice; give it once", values[i]))),
        None => Ok(()),
    }
}

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
        let texts = Texts { layout: texts.layout, specs: &texts.specs, scenario: texts.scenario };
        let draft = Draft::new(&sources, texts, &concerned);
        let stem = path.file_stem().map_or_else(String::new, |stem| stem.to_string_lossy().into_owned());
        let shown = build::shown(&sources, path);
        Ok(Self {
            title: draft.name().map_or(stem, String::from),
            sources,
            draft,
            settings,
            shown,
            library: Mutex::new(None),
            memories: Mutex::default(),
        })
    }

    /// Lets a run use what others have found about this layout.
    pub fn remembering<T>(&self, run: impl FnOnce(&mut Memory) -> T) -> T {
        let memories = || self.memories.lock().unwrap_or_else(PoisonError::into_inner);
        let mut memory = memories().pop().unwrap_or_default();
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
