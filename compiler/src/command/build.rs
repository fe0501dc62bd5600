//! `autogen build`.

use super::options::{Addresses, BuildOptions, Format};
use super::write::{self, Files, Refusal};
use super::{load, print};
use crate::Status;
use autogen::backend::{dot, plan, rust, sdf, st};
use autogen::diagnostic::Diagnostic;
use autogen::io_map::{self, Conversion, Counting, IoMap, Point};
use autogen::ir::System;
use autogen::library;
use autogen::lower::{Outcome, Project, compile};
use autogen::simulator;
use autogen::source::{FileId, Sources};
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// Written by `commission` beside the files of the manifest.
pub const RESULTS: &str = "results.json";

/// A line that was compiled and written.
pub struct Built {
    pub project: Project,
    /// Under the names that the output shows.
    pub sources: Sources,
    pub files: Files,
    pub folder: PathBuf,
}

pub fn run(options: &BuildOptions) -> Status {
    match build(options) {
        Ok(built) => {
            if options.input.format == Format::Json {
                let names: Vec<&String> = built.files.keys().collect();
                say!(
                    "{}",
                    json!({ "feasible": true, "folder": built.folder.display().to_string(), "files": names, "diagnostics": [] })
                );
            } else if !options.input.quiet {
                say!("{} files written to {}", built.files.len() + 1, built.folder.display());
                if let Some(bounds) = built.files.get("plc/bounds.txt") {
                    say_part!("\n{bounds}");
                }
            }
            Status::Done
        }
        Err(status) => status,
    }
}

/// Compiles and writes; what is wrong has been printed.
pub fn build(options: &BuildOptions) -> Result<Built, Status> {
    let failed = |failure| print::failure(&options.input, &failure);
    let mut input = load::load(&options.input).map_err(failed)?;
    let table = options.io.as_ref().map(|path| load::add(&mut input.sources, path));
    let table = table.transpose().map_err(failed)?;
    let Outcome { sources, diagnostics, verdict, project } = compile(input);
    let wrong = |diagnostics: &[Diagnostic]| {
        match options.input.format {
            Format::Json => {
                let mut answer = print::verdict_json(verdict.as_ref(), &sources, diagnostics);
                answer["finished"] = json!(false);
                answer["reason"] = json!("the input has errors");
                say!("{answer}");
            }
            Format::Text => print::diagnostics(&sources, diagnostics),
        }
        Status::WrongInput
    };
    let Some(project) = project else { return Err(wrong(&diagnostics)) };
    let map = io_map(options, &project, &sources, table).map_err(|found| wrong(&found))?;
    if table.is_some() && options.input.format == Format::Text && !options.input.quiet {
        report_gaps(&map, &st::points(&project.system));
    }
    // The same input gives the same bytes, from whatever folder it is compiled.
    let sources = sources.renamed(|name| title(&options.input.layout, name));
    let files = files(&project, &sources, &map);
    let folder = options.output.clone().unwrap_or_else(|| Path::new("out").join(&project.name));
    write::write(&folder, &files, about(&project, &sources), options.overwrite())
        .map_err(|refusal| refused(options, &refusal))?;
    Ok(Built { project, sources, files, folder })
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

/// The name of an input as outputs show it: its path from the layout's folder, or its own name.
pub fn title(layout: &Path, name: &str) -> String {
    if library::FILES.iter().any(|(built_in, _)| *built_in == name) {
        return name.to_string();
    }
    let path = Path::new(name);
    let within =
        layout.parent().and_then(|folder| path.strip_prefix(folder).ok()).filter(|rest| rest.is_relative());
    match within {
        Some(rest) => rest.display().to_string().replace('\\', "/"),
        None => path.file_name().map_or(name.to_string(), |own| own.to_string_lossy().into_owned()),
    }
}

/// Says which addresses a table leaves out.
fn report_gaps(map: &IoMap, points: &[Point]) {
    say!("{} of {} points have an address", map.len(), points.len());
    let permit = points.iter().position(|p| p.robot.is_empty() && p.port == "run_permit");
    if permit.and_then(|p| map.wire(p)).is_some_and(|wire| wire.conversion == Conversion::Inverted) {
        say!("note: run_permit is inverted: a broken wire or a lost fieldbus would permit the line to run");
    }
    for (robot, missing) in map.gaps(points) {
        let whose = if robot.is_empty() { "the line" } else { robot };
        say!("note: {whose} has points without one: {}", missing.join(", "));
    }
}

/// All files of the output.
fn files(project: &Project, sources: &Sources, map: &IoMap) -> Files {
    let mut files = Files::new();
    for (name, text) in files_of_rust(&project.system, sources) {
        files.insert(format!("rust/{name}"), text);
    }
    let (texts, columns) = st::mapped(&project.system, sources, map);
    for (name, text) in texts {
        files.insert(format!("plc/{name}"), text);
    }
    for (name, text) in dot::files(&project.system, &project.edges) {
        files.insert(format!("graph/{name}"), text);
    }
    files.insert("graph/plan.svg".into(), plan::svg(&project.plant, &project.edges));
    for (name, text) in sdf::files(&project.name, &project.plant) {
        files.insert(format!("world/{name}"), text);
    }
    files.insert("rust/commissioning/data/line.txt".into(), project.plant.to_text());
    files.insert("rust/commissioning/data/parameters.txt".into(), rust::parameters_text(&project.system));
    files.insert("rust/commissioning/data/columns.txt".into(), columns.to_text());
    files
}

/// The Cargo workspace that links the controllers with the simulator, without the data that it runs.
pub fn files_of_rust(system: &System, sources: &Sources) -> Files {
    let mut files = rust::files(system, sources);
    for (name, text) in simulator::SOURCES {
        files.insert(format!("runtime-sim/{name}"), (*text).into());
    }
    files.insert("runtime-sim/Cargo.toml".into(), simulator::MANIFEST.into());
    files
}

/// What the manifest says before the list of files. No dates and no paths: the same input, the same bytes.
fn about(project: &Project, sources: &Sources) -> Value {
    let inputs: serde_json::Map<String, Value> = (sources.files().iter())
        .map(|file| {
            let name = if file.name == "--set" { format!("--set {}", file.text) } else { file.name.clone() };
            (name, json!(write::hash(&file.text)))
        })
        .collect();
    let order: Vec<&String> = project.system.instances.iter().map(|i| &i.name).collect();
    json!({
        "tool": format!("autogen {}", env!("CARGO_PKG_VERSION")),
        "layout": project.name,
        "step_order": order,
        "inputs": inputs,
    })
}

fn refused(options: &BuildOptions, refusal: &Refusal) -> Status {
    let text = match refusal {
        Refusal::NotOurs(paths) => {
            let names: Vec<String> = paths.iter().map(|p| p.display().to_string()).collect();
            format!(
                "not written: autogen did not write these files, or they were changed since:\n  {}\nMove them away, choose another folder with -o, or overwrite them with --force.",
                names.join("\n  ")
            )
        }
        Refusal::InTheWay(paths) => {
            let names: Vec<String> = paths.iter().map(|p| p.display().to_string()).collect();
            format!(
                "not written: these are in the way, a file where a folder has to be or the other way round:\n  {}",
                names.join("\n  ")
            )
        }
        Refusal::Io(path, error) => format!("{}: {error}", path.display()),
    };
    match options.input.format {
        Format::Json => say!("{}", json!({ "finished": false, "reason": text, "diagnostics": [] })),
        Format::Text => complain!("autogen: {text}"),
    }
    Status::WrongCommand
}
