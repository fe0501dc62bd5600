//! `autogen build`.

use super::copies::{Copies, copies};
use super::options::{Addresses, BuildCommandOptions, BuildOptions, Format};
use super::output::{self, Make, Output, Overwrite, Refusal};
use super::titles::{shown, title};
use super::{differences, dropped, io_error, load, print, read};
use crate::Status;
use autogen::backend::{Files, Folder, Sink, dot, plan, rust, sdf, st};
use autogen::device::panel;
use autogen::diagnostic::Diagnostic;
use autogen::io_map::{self, Conversion, Counting, IoMap, Kind, Point};
use autogen::ir::System;
use autogen::lower::{Outcome, Project, compile};
use autogen::parallel::in_parts;
use autogen::plain;
use autogen::simulator;
use autogen::source::{FileId, Sources};
use autogen::translation::{self, Translations};
use autogen::version;
use serde_json::{Map, Value, json};
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

/// A line that was compiled.
pub struct Built {
    pub project: Project,
    /// Under the names that the output shows.
    pub sources: Sources,
    /// What the manifest says before the list of files.
    pub about: Map<String, Value>,
    pub folder: PathBuf,
    map: IoMap,
    translations: Translations,
    copies: Files,
    flavours: st::Flavours,
    /// With reference blocks for drives.
    drives: Files,
}

pub fn run(options: &BuildCommandOptions) -> Status {
    let BuildCommandOptions { build: options, check } = options;
    if *check {
        return build(options).map_or_else(|status| status, |built| differences::run(options, &built));
    }
    let done = build(options).and_then(|built| {
        let output = open(options, &built).map_err(|refusal| refused(options, &refusal))?;
        let of_a_run = output.of_a_run();
        // All else does not wait for these.
        let named = LazyLock::new(|| built.named());
        let program = LazyLock::new(|| built.program(&named));
        let first = |files: &mut dyn Sink| {
            built.write_all_else(files);
            built.write_portable(&program, files);
        };
        let make: [&Make; 2] = [&first, &|files| built.write_with_structures(&program, files)];
        let names = write(options, &built, &make, &output);
        // The process ends: to give back each value of a long line takes time.
        std::mem::forget(program);
        std::mem::forget(named);
        let names = names.map_err(|refusal| refused(options, &refusal))?;
        let folder = built.folder.clone();
        // The same.
        std::mem::forget(built);
        Ok((folder, names, dropped::of_a_run(&of_a_run, &output.of_a_run())))
    });
    match done {
        Ok((folder, names, removed)) => {
            if options.input.format == Format::Json {
                say!(
                    "{}",
                    json!({ "feasible": true, "folder": folder.display().to_string(), "files": names, "diagnostics": [] })
                );
            } else if !options.input.quiet {
                say!("{} files written to {}", names.len() + 1, folder.display());
                if let Some(removed) = removed {
                    say!("{removed}");
                }
                if let Ok(bounds) = fs::read_to_string(folder.join("plc/bounds.txt")) {
                    say_part!("\n{bounds}");
                }
            }
            Status::Done
        }
        Err(status) => status,
    }
}

/// Compiles; what is wrong has been printed.
pub fn build(options: &BuildOptions) -> Result<Built, Status> {
    let failed = |failure| print::failure(&options.input, &failure);
    let mut input = load::load(&options.input).map_err(failed)?;
    let table = options.io.as_ref().map(|path| load::table(&mut input.sources, path));
    let table = table.transpose().map_err(failed)?;
    let Outcome { sources, diagnostics, verdict, project, .. } = compile(input);
    let wrong = |sources: &Sources, diagnostics: &[Diagnostic]| {
        match options.input.format {
            Format::Json => {
                let mut answer = print::verdict_json(verdict.as_ref(), sources, diagnostics);
                answer["finished"] = json!(false);
                answer["reason"] = json!("the input has errors");
                say!("{answer}");
            }
            Format::Text => print::diagnostics(sources, diagnostics),
        }
        Status::WrongInput
    };
    let Some(project) = project else { return Err(wrong(&sources, &diagnostics)) };
    let map = io_map(options, &project, &sources, table).map_err(|found| wrong(&sources, &found))?;
    if table.is_some() && options.input.format == Format::Text && !options.input.quiet {
        report_gaps(&map, &project.system);
    }
    let (with_texts, translations) = match &options.texts {
        None => (sources.clone(), Translations::default()),
        Some(path) => {
            let mut with_texts = sources.clone();
            let table = load::table(&mut with_texts, path).map_err(failed)?;
            let texts = st::screen_texts(&project.system, &sources);
            let read = translation::read(&with_texts, table, &texts.iter().map(String::as_str).collect());
            let translations = read.map_err(|found| wrong(&with_texts, &found))?;
            if options.input.format == Format::Text && !options.input.quiet {
                report_missing(&translations, &texts);
            }
            (with_texts, translations)
        }
    };
    let Copies { files: copies, command, not_found } = copies(options, &with_texts);
    if !options.input.quiet {
        report_not_found(&options.input.layout, &not_found);
    }
    // The same input gives the same bytes, from whatever folder it is compiled.
    let sources = shown(&sources, &options.input.layout);
    // Other words on a screen make no other program.
    let about = about(&project, &shown(&with_texts, &options.input.layout), sources.hash(), &command);
    let folder = options.output.clone().unwrap_or_else(|| Path::new("out").join(&project.name));
    let flavours = if options.no_plcopen { st::Flavours::WithoutPlcopen } else { st::Flavours::All };
    let drives = if options.drives { st::drives() } else { Files::new() };
    Ok(Built { project, sources, about, folder, map, translations, copies, flavours, drives })
}

impl Built {
    /// Gives all files of the output folder.
    pub fn write(&self, files: &mut dyn Sink) {
        self.write_structured_text(files);
        self.write_all_else(files);
    }

    /// The same files, all in memory, made by two threads where there are two processors.
    pub fn files(&self) -> Files {
        let halves: [fn(&Self, &mut dyn Sink); 2] = [Self::write_structured_text, Self::write_all_else];
        let made = in_parts(&halves, 1, |part| {
            let files = part.iter().map(|write| {
                let mut files = Files::new();
                write(self, &mut files);
                files
            });
            files.collect()
        });
        made.into_iter().flatten().collect()
    }

    fn write_structured_text(&self, files: &mut dyn Sink) {
        let named = self.named();
        let program = self.program(&named);
        self.write_portable(&program, files);
        self.write_with_structures(&program, files);
    }

    fn named(&self) -> st::Named {
        st::Named::new(&self.project.system, &self.map)
    }

    fn program<'a>(&'a self, named: &'a st::Named) -> st::Program<'a> {
        named.program(&self.project.system, &self.sources, &self.map)
    }

    fn write_portable(&self, program: &st::Program, files: &mut dyn Sink) {
        let mut plc = Folder { name: "plc", sink: files };
        program.portable(self.flavours, &self.translations, &mut plc);
        put(&mut plc, &self.drives);
        files.file(COLUMNS, &program.columns().to_text());
    }

    fn write_with_structures(&self, program: &st::Program, files: &mut dyn Sink) {
        program.with_structures(self.flavours, &mut Folder { name: "plc", sink: files });
    }

    fn write_all_else(&self, files: &mut dyn Sink) {
        let Self { project, sources, .. } = self;
        let system = &project.system;
        put(files, &self.copies);
        write_rust(system, sources, &mut Folder { name: "rust", sink: files });
        put(&mut Folder { name: "graph", sink: files }, &dot::files(project));
        files.file("graph/plan.svg", &plan::svg(&project.plant, &project.edges));
        sdf::write(&project.name, &project.plant, &mut Folder { name: "world", sink: files });
        files.file("rust/commissioning/data/line.txt", &project.plant.to_text());
        files.file("rust/commissioning/data/parameters.txt", &rust::parameters(system));
    }
}

/// The columns of an I/O trace.
pub const COLUMNS: &str = "rust/commissioning/data/columns.txt";

fn put(files: &mut dyn Sink, more: &Files) {
    more.iter().for_each(|(name, text)| files.file(name, text));
}

/// A folder that nobody has named may have come with the layout: it must not lead anywhere else.
pub fn is_where_it_seems(options: &BuildOptions, built: &Built) -> Result<(), Refusal> {
    let unnamed = match options.output {
        Some(_) => None,
        None => Some([Path::new("out"), &built.folder]),
    };
    let is_link = |path: &&Path| path.symlink_metadata().is_ok_and(|there| there.is_symlink());
    let links: Vec<PathBuf> = unnamed.into_iter().flatten().filter(is_link).map(PathBuf::from).collect();
    if links.is_empty() { Ok(()) } else { Err(Refusal::InTheWay(links)) }
}

/// The output folder, once no other process writes to it.
pub fn open(options: &BuildOptions, built: &Built) -> Result<Output, Refusal> {
    is_where_it_seems(options, built)?;
    let says = options.input.format == Format::Text && !options.input.quiet;
    let output = Output::open(&built.folder, read::files(), || {
        if says {
            complain!("waiting for another autogen that writes to {} ...", built.folder.display());
        }
    })?;
    // Names of layouts lead here, and two may be the same.
    if options.output.is_none() && options.overwrite() == Overwrite::Own {
        let layout = plain::line(&options.input.layout.display().to_string());
        output.is_of_layout(&title(&options.input.layout, &layout))?;
    }
    Ok(output)
}

/// Writes the files of what was built, and returns their names.
pub fn write(
    options: &BuildOptions,
    built: &Built,
    make: &[&Make],
    output: &Output,
) -> Result<Vec<String>, Refusal> {
    let commands = [output.last_command(), built.about["command"].as_str().map(String::from)];
    if let [Some(last), Some(now)] = commands
        && options.input.format == Format::Text
        && !options.input.quiet
    {
        dropped::notes(&last, &now).iter().for_each(|note| complain!("note: {note}"));
    }
    output.write(make, built.about.clone(), options.overwrite())
}

/// The addresses that the table gives, if there is one.
fn io_map(
    options: &BuildOptions,
    project: &Project,
    sources: &Sources,
    table: Option<FileId>,
) -> Result<IoMap, Vec<Diagnostic>> {
    let Some(table) = table else { return Ok(IoMap::default()) };
    let counting = match options.addresses {
        Addresses::Words => Counting::Words,
        Addresses::Bytes => Counting::Bytes,
        Addresses::Apart => Counting::Apart,
    };
    io_map::read(sources, table, &st::points(&project.system), counting)
}

/// Says which addresses a table leaves out.
fn report_gaps(map: &IoMap, system: &System) {
    let points = st::points(system);
    say!("{} of {} points have an address", map.len(), points.len());
    let is_inverted = |at| map.wire(at).is_some_and(|wire| wire.conversion == Conversion::Inverted);
    let pressed = points.iter().enumerate().filter(|(at, point)| is_pressed(point) && is_inverted(*at));
    for (_, point) in pressed {
        say!(
            "note: {} is inverted: a broken wire or a lost fieldbus would read as TRUE, as if it were pressed",
            point.name
        );
    }
    for (robot, missing) in map.gaps(&points, system) {
        let whose = if robot.is_empty() { "the line" } else { robot };
        say!("note: {whose} has points without one: {}", missing.join(", "));
    }
}

/// A contact that a person closes.
fn is_pressed(point: &Point) -> bool {
    let is_of_line = point.robot.is_empty() && ["start", "reset"].contains(&point.port.as_str());
    is_of_line || point.kind == Kind::Bool && panel::has(&point.port)
}

/// Says which of the copies the copy of the layout does not lead to.
fn report_not_found(layout: &Path, not_found: &[(String, String)]) {
    let Some((name, copy)) = not_found.first() else { return };
    let more = match not_found.len() - 1 {
        0 => String::new(),
        more => format!(" (and {more} more)"),
    };
    complain!(
        "warning: {}: the layout names `{name}`{more}, whose copy in sources/ is `{copy}`: the name has a character \
         that not all systems take, leads up by `..`, or differs from another one in case alone. The copy of the \
         layout does not find it, so `command` in manifest.json does not build the same again. Rename what the layout \
         names, or give it by --specs or --scenario instead.",
        layout.display()
    );
}

/// Says which texts a table leaves out, and which of its rows are of no text.
fn report_missing(translations: &Translations, texts: &[String]) {
    for language in &translations.languages {
        let missing: Vec<&String> = texts.iter().filter(|text| !language.has(text)).collect();
        let first = missing.first().map(|text| format!("; the first missing text: {text}"));
        let count = texts.len() - missing.len();
        say!("{}: {count} of {} texts{}", language.tag, texts.len(), first.unwrap_or_default());
    }
    for text in &translations.strangers {
        say!("note: no text of this line: {}", plain::line(text));
    }
}

/// The Cargo workspace that links the controllers with the simulator, without the data that it runs.
fn write_rust(system: &System, sources: &Sources, files: &mut dyn Sink) {
    rust::write(system, sources, files);
    for (name, text) in simulator::SOURCES {
        files.file(&format!("runtime-sim/{name}"), text);
    }
    files.file("runtime-sim/Cargo.toml", &simulator::MANIFEST);
}

/// What the manifest says before the list of files. No dates and no paths: the same input, the same bytes.
fn about(project: &Project, sources: &Sources, program: i32, command: &str) -> Map<String, Value> {
    let inputs: Map<String, Value> = (sources.files().iter())
        .map(|file| {
            let name = if file.name == "--set" { format!("--set {}", file.text) } else { file.name.clone() };
            (name, json!(output::hash(file.text.as_bytes())))
        })
        .collect();
    let order: Vec<&String> = project.system.instances.iter().map(|i| &i.name).collect();
    let about = [
        ("tool", json!(format!("autogen {}", version::NUMBER))),
        ("command", json!(command)),
        ("layout", json!(project.name)),
        ("step_order", json!(order)),
        ("program_hash", json!(program)),
        ("inputs", inputs.into()),
    ];
    about.into_iter().map(|(key, value)| (key.to_string(), value)).collect()
}

/// Says why nothing was written.
pub fn refused(options: &BuildOptions, refusal: &Refusal) -> Status {
    let list = |paths: &[PathBuf]| {
        paths.iter().map(|p| plain::line(&p.display().to_string())).collect::<Vec<_>>().join("\n  ")
    };
    let text = match refusal {
        Refusal::NotOurs(paths) => format!(
            "not written: autogen did not write these files, or they were changed since:\n  {}\nMove them to another place, choose another folder with -o, or overwrite them with --force.{}",
            list(paths),
            match paths.iter().any(|path| path.ends_with("io.csv")) {
                true =>
                    "\nA filled table of addresses is an input: copy it to another folder, and give it with --io.",
                false => "",
            }
        ),
        Refusal::InTheWay(paths) => format!(
            "not written: these are a file instead of a folder, a folder instead of a file, or a symbolic link, which is never followed:\n  {}\nMove them to another place, or choose another folder with -o.",
            list(paths)
        ),
        Refusal::Inputs(paths) => format!(
            "not written: these files are inputs, and would be overwritten:\n  {}\nChoose another folder with -o.",
            list(paths)
        ),
        Refusal::OfAnotherLayout(folder, command) => format!(
            "not written: {} has what `{command}` has built from another layout, and both layouts have the same name.\nGive one of them another name with its key \"name\", choose another folder with -o, or overwrite it with --force.",
            plain::line(&folder.display().to_string())
        ),
        Refusal::Io(path, error) => format!("{}: {}", path.display(), io_error::text(error)),
    };
    match options.input.format {
        Format::Json => say!("{}", json!({ "finished": false, "reason": text, "diagnostics": [] })),
        Format::Text => complain!("autogen: {text}"),
    }
    Status::WrongCommand
}
