//! Structured Text: the same automata for a PLC.
//!
//! The intermediate representation becomes units of statements ([`code`], [`declaration`]), once; one printer
//! writes them in two dialects. `portable/main.st` keeps to what common compilers take and run alike: no enumeration,
//! no timer of the standard, no reliance on short circuit or on initial values.
//!
//! A type is a function block, a robot an instance of it that the program calls with the robot's ports and
//! parameters. Where the generated Rust leaves a step by `?`, the block returns: what was written stays, and
//! the blocks behind it find `fault_code` set and do nothing.

mod alarm;
mod alarms;
mod attributes;
mod block;
mod body;
mod bounds;
mod code;
mod columns;
mod context;
mod dead;
mod declaration;
mod drives;
mod expression;
mod externals;
mod figures;
mod filling;
mod functions;
mod globals;
mod guard;
mod image;
mod masks;
mod modes;
mod name;
mod names;
mod points;
mod print;
mod program;
mod property;
mod restart;
mod role;
mod screen;
mod siemens;
mod state;
mod states;
mod structured;
mod table;
mod text;
mod update;
mod value;
mod values;
mod version;
mod walk;
mod watchdog;
mod xml;

use super::{Files, Folder, Sink, part};
use crate::io_map::{IoMap, Point};
use crate::ir::{AutomatonId, System};
use crate::naming::st::Scope;
use crate::source::Sources;
use crate::translation::Translations;
use context::Shared;
use declaration::Unit;
use externals::Externals;
use globals::{Globals, Index};
use image::{Image, Wired};
use names::Names;
use program::Blocks;
use runtime_sim::io_trace::Columns;
use std::collections::{BTreeSet, HashSet};
use std::sync::Arc;
use structured::{Common, Enumerated, Structure, structured};

/// Every point of I/O, in the order of `io.csv`; an [`IoMap`] counts them so.
pub fn points(system: &System) -> Vec<Point> {
    points::terminals(system, &names::names(system)).map(|terminal| terminal.point).collect()
}

/// The files of the folder `plc/`, without addresses.
pub fn files(system: &System, sources: &Sources) -> Files {
    mapped(system, sources, &IoMap::default()).0
}

/// The files of the folder `plc/`, with the addresses of a map for [`points`] of the same system. And the columns
/// of an I/O trace, named as the globals of `portable/main.st`; the state of a robot as `robot.state`.
pub fn mapped(system: &System, sources: &Sources, map: &IoMap) -> (Files, Columns) {
    let named = Named::new(system, map);
    let program = named.program(system, sources, map);
    let mut files = Files::new();
    program.portable(Flavours::WithoutPlcopen, &Translations::default(), &mut files);
    program.with_structures(Flavours::WithoutPlcopen, &mut files);
    (files, program.columns())
}

/// The text of [`mapped`] as PLCopen XML, in the two flavours that tools import; files of the folder `plc/`.
pub fn plcopen(system: &System, sources: &Sources, map: &IoMap) -> Files {
    let named = Named::new(system, map);
    let program = named.program(system, sources, map);
    let mut files = Files::new();
    program.plcopen(&mut files);
    let common = Common::new(program.shared, &program.line);
    program.codesys_xml(&program.structured(&common, Enumerated::ByType), &mut files);
    files
}

/// In what the program is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Flavours {
    All,
    WithoutPlcopen,
}

/// The program of a line, as it is written in all flavours. With structures it is made for one of them at a time: it is
/// as large as the whole line.
pub struct Program<'a> {
    shared: Shared<'a>,
    map: &'a IoMap,
    line: Line<'a>,
    wired: &'a [Wired],
    /// The names of MAIN.
    names: &'a Scope,
}

/// The names of a line and its process image, of which its program is made.
pub struct Named {
    names: Names,
    /// The names of MAIN.
    scope: Scope,
    image: Image,
}

impl Named {
    /// With a raw variable for each address of the map that needs one.
    pub fn new(system: &System, map: &IoMap) -> Self {
        let names = names::names(system);
        let mut scope = names.program.inner();
        let image = image::image(system, &names, map, &mut scope);
        Self { names, scope, image }
    }

    /// The program of the same line. [`Program::portable`] and [`Program::with_structures`] give all files of the
    /// folder `plc/`, each half of them, and may do it at the same time.
    pub fn program<'a>(&'a self, system: &'a System, sources: &'a Sources, map: &'a IoMap) -> Program<'a> {
        let shared = Shared { system, sources, names: &self.names };
        let line = line(shared, &self.image);
        Program { shared, map, line, wired: &self.image.wired, names: &self.scope }
    }
}

impl Program<'_> {
    /// The text that all compilers take, and all tables, those in other languages too.
    pub fn portable(&self, flavours: Flavours, translations: &Translations, files: &mut dyn Sink) {
        self.texts_without_types(files);
        screen::files(self.shared, translations).iter().for_each(|(name, text)| files.file(name, text));
        if flavours == Flavours::All {
            self.plcopen(files);
        }
    }

    /// The texts for tools that have structures.
    pub fn with_structures(&self, flavours: Flavours, files: &mut dyn Sink) {
        let common = Common::new(self.shared, &self.line);
        self.codesys(&common, flavours, files);
        self.siemens(&common, files);
    }

    /// The columns of [`mapped`].
    pub fn columns(&self) -> Columns {
        columns::columns(self.shared, &self.line.globals)
    }

    fn structured(&self, common: &Common, enumerated: Enumerated) -> Line<'_> {
        structured(self.shared, &self.line, common, enumerated, &mut self.names.clone())
    }

    fn texts_without_types(&self, files: &mut dyn Sink) {
        let (shared, names) = (self.shared, self.shared.names);
        files.file("portable/main.st", &text::portable(shared, &self.line));
        files.file("io.csv", &part(|f| table::io(shared, self.map, f)));
        files.file("alarms.csv", &alarms::table(shared, &mut screen::as_written));
        files.file("states.csv", &states::table(shared, &mut screen::as_written));
        files.file("bounds.txt", &figures::report(shared, &self.line));
        let raw = self.names.renamed().iter().map(|renamed| ("globals".to_string(), renamed.clone()));
        let renamed: Vec<_> = names.renamed.iter().cloned().chain(raw).collect();
        if !renamed.is_empty() {
            files.file("names.csv", &table::renamed(&renamed));
        }
    }

    fn plcopen(&self, files: &mut dyn Sink) {
        files.file("portable/project.xml", &xml::plcopen(self.shared, &self.line));
    }

    fn codesys(&self, common: &Common, flavours: Flavours, files: &mut dyn Sink) {
        let line = self.structured(common, Enumerated::ByType);
        text::codesys(self.shared, &line, &mut Folder { name: "codesys", sink: files });
        if flavours == Flavours::All {
            self.codesys_xml(&line, files);
        }
    }

    fn codesys_xml(&self, by_type: &Line, files: &mut dyn Sink) {
        files.file("codesys/project.xml", &xml::codesys(self.shared, by_type));
    }

    fn siemens(&self, common: &Common, files: &mut dyn Sink) {
        let by_number = self.structured(common, Enumerated::ByNumber);
        let copies = siemens::copies(self.wired, self.map.counting());
        siemens::files(self.shared, &by_number, &copies, &mut Folder { name: "siemens", sink: files });
    }
}

/// Texts that a screen shows, each once.
pub fn screen_texts(system: &System, sources: &Sources) -> Vec<String> {
    let names = names::names(system);
    let shared = Shared { system, sources, names: &names };
    screen::texts(shared).into_iter().map(|(_, text)| text).collect()
}

/// The table of these texts, and those of alarms and states in other languages; files of the folder `plc/` that
/// [`Program::portable`] gives too.
pub fn translated(system: &System, sources: &Sources, translations: &Translations) -> Files {
    let names = names::names(system);
    screen::files(Shared { system, sources, names: &names }, translations)
}

/// Reference blocks for drives; files of the folder `plc/`.
pub fn drives() -> Files {
    drives::FILES.iter().map(|(name, text)| (format!("drives/{name}"), text.to_string())).collect()
}

/// The units of a line, in the order in which they must be declared.
struct Line<'a> {
    functions: Vec<&'static functions::Function>,
    blocks: Arc<Vec<Option<Blocks<'a>>>>,
    watchdog: Unit<'a>,
    layout: Unit<'a>,
    program: Unit<'a>,
    globals: Arc<Globals>,
    /// Of a line with structures.
    structures: Vec<Structure>,
}

impl<'a> Line<'a> {
    /// Function blocks, then the program.
    fn units(&self) -> impl Iterator<Item = &Unit<'a>> {
        let blocks = self.blocks.iter().flatten();
        let blocks = blocks.flat_map(|b| [Some(&b.steps), b.properties.as_ref()].into_iter().flatten());
        [&self.watchdog, &self.layout].into_iter().chain(blocks.map(|b| &b.unit)).chain([&self.program])
    }
}

fn line<'a>(shared: Shared<'a>, image: &Image) -> Line<'a> {
    let mut globals = Globals::new(shared, image);
    let index = Index::new(&globals);
    let blocks: Vec<Option<Blocks>> = (0..shared.system.model.automata.len())
        .map(AutomatonId)
        .map(|id| {
            (!shared.instances(id).is_empty()).then(|| Blocks {
                steps: block::steps(shared, id, &index),
                properties: property::block(shared, id, &index),
            })
        })
        .collect();
    let blocks = Arc::new(blocks);
    let body = program::statements(shared, &blocks, image);
    let mut functions = BTreeSet::new();
    let mut used = HashSet::with_capacity(globals.all().count());
    body.names_and_functions(&mut used, &mut functions);
    let program = program::program(shared, &blocks, body, &used);
    let units =
        blocks.iter().flatten().flat_map(|b| [Some(&b.steps), b.properties.as_ref()].into_iter().flatten());
    let mut of_blocks = HashSet::new();
    units.for_each(|block| block.unit.body.names_and_functions(&mut of_blocks, &mut functions));
    globals.retain(|name| used.contains(name) || of_blocks.contains(name));
    let globals = Arc::new(globals);
    let program = Unit { externals: Externals::marked(&globals, |name| used.contains(name)), ..program };
    let functions = functions::needed(&functions.into_iter().collect::<Vec<_>>());
    let layout = program::layout(&globals);
    Line { functions, blocks, watchdog: watchdog::block(), layout, program, globals, structures: Vec::new() }
}
