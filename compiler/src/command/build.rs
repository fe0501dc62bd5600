//! `autogen build`.

use super::options::{BuildOptions, Format};
use super::write::{self, Files, Overwrite, Refusal};
use super::{load, print};
use crate::Status;
use autogen::backend::{dot, plan, rust};
use autogen::lower::{Outcome, Project, compile};
use autogen::simulator;
use autogen::source::Sources;
use serde_json::{Value, json};
use std::path::{Path, PathBuf};

/// A line that was compiled and written.
pub struct Built {
    pub project: Project,
    pub files: Files,
    pub folder: PathBuf,
}

pub fn run(options: &BuildOptions) -> Status {
    match build(options) {
        Ok(built) => {
            if options.input.format == Format::Json {
                let names: Vec<&String> = built.files.keys().collect();
                println!(
                    "{}",
                    json!({ "feasible": true, "folder": built.folder.display().to_string(), "files": names, "diagnostics": [] })
                );
            } else if !options.input.quiet {
                println!("{} files written to {}", built.files.len() + 1, built.folder.display());
            }
            Status::Done
        }
        Err(status) => status,
    }
}

/// Compiles and writes; what is wrong has been printed.
pub fn build(options: &BuildOptions) -> Result<Built, Status> {
    let input = load::load(&options.input).map_err(|failure| print::failure(&options.input, &failure))?;
    let Outcome { sources, diagnostics, verdict, project } = compile(input);
    let Some(project) = project else {
        match options.input.format {
            Format::Json => {
                let mut answer = print::verdict_json(verdict.as_ref(), &sources, &diagnostics);
                answer["finished"] = json!(false);
                answer["reason"] = json!("the input has errors");
                println!("{answer}");
            }
            Format::Text => print::diagnostics(&sources, &diagnostics),
        }
        return Err(Status::WrongInput);
    };
    let files = files(&project, &sources);
    let folder = options.output.clone().unwrap_or_else(|| Path::new("out").join(&project.name));
    let overwrite = if options.force { Overwrite::Everything } else { Overwrite::Own };
    write::write(&folder, &files, about(&project, &sources), overwrite)
        .map_err(|refusal| refused(options, &refusal))?;
    Ok(Built { project, files, folder })
}

/// All files of the output.
fn files(project: &Project, sources: &Sources) -> Files {
    let mut files = Files::new();
    for (name, text) in rust::files(&project.system, sources) {
        files.insert(format!("rust/{name}"), text);
    }
    for (name, text) in dot::files(&project.system, &project.edges) {
        files.insert(format!("graph/{name}"), text);
    }
    files.insert("graph/plan.svg".into(), plan::svg(&project.plant, &project.edges, &project.obstacles));
    for (name, text) in simulator::SOURCES {
        files.insert(format!("rust/runtime-sim/{name}"), (*text).into());
    }
    files.insert("rust/runtime-sim/Cargo.toml".into(), simulator::MANIFEST.into());
    files.insert("rust/commissioning/data/line.txt".into(), project.plant.to_text());
    files.insert("rust/commissioning/data/parameters.txt".into(), rust::parameters_text(&project.system));
    files
}

/// What the manifest says before the list of files. No dates and no paths: the same input, the same bytes.
fn about(project: &Project, sources: &Sources) -> Value {
    let inputs: serde_json::Map<String, Value> = (sources.files().iter())
        .map(|file| {
            let name = file.name.rsplit(['/', '\\']).next().unwrap_or(&file.name);
            let name = if name == "--set" { format!("--set {}", file.text) } else { name.to_string() };
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
        Refusal::Io(path, error) => format!("{}: {error}", path.display()),
    };
    match options.input.format {
        Format::Json => println!("{}", json!({ "finished": false, "reason": text, "diagnostics": [] })),
        Format::Text => eprintln!("autogen: {text}"),
    }
    Status::WrongCommand
}
