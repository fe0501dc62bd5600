//! `autogen compare`: two results, or the runs of two layouts on the reference executor.

mod first;
mod seen;
mod table;

use super::options::{CompareOptions, Format};
use super::output::RESULTS;
use super::progress::Progress;
use super::results::results;
use super::{load, print, read};
use crate::Status;
use autogen::lower::{Project, compile};
use autogen::source::Sources;
use first::First;
use serde_json::{Value, json};
use std::io::{self, IsTerminal};
use std::path::{Path, PathBuf};

pub fn run(options: &CompareOptions) -> Status {
    let sides = [side(&options.first), side(&options.second)];
    let compared = match sides {
        [Ok(Side::Results(a)), Ok(Side::Results(b))] => Compared { reports: [a, b], traces: Traces::Hashes },
        [Ok(Side::Layout), Ok(Side::Layout)] => match layouts(options) {
            Ok(compared) => compared,
            Err(status) => return status,
        },
        [Err(why), _] | [_, Err(why)] => return print::unusable(&options.input(&options.first), &why),
        _ => {
            let why =
                "one of the two is a layout and the other one has results: name two layouts or two results";
            return print::unusable(&options.input(&options.first), why);
        }
    };
    let is_same = compared.is_same();
    match options.format {
        Format::Json => say!("{}", compared.json()),
        Format::Text if !options.quiet => say_part!("{}", compared.text()),
        Format::Text => {}
    }
    if is_same { Status::Done } else { Status::NotReached }
}

enum Side {
    Layout,
    Results(Value),
}

/// What a path of the command line names.
fn side(path: &Path) -> Result<Side, String> {
    let file: PathBuf = if path.is_dir() { path.join(RESULTS) } else { path.into() };
    let text = read::text(&file).map_err(|why| match path.is_dir() {
        true => format!("{}: {why}; `commission` writes the results of a run there", file.display()),
        false => format!("{}: {why}", file.display()),
    })?;
    match serde_json::from_str::<Value>(&text) {
        Ok(results) if results["trace_hash"].is_string() => Ok(Side::Results(results)),
        _ if path.is_dir() => Err(format!("{}: these are not results of a run", file.display())),
        // What is wrong with a layout its reader says.
        _ => Ok(Side::Layout),
    }
}

/// What came of two runs.
struct Compared {
    reports: [Value; 2],
    traces: Traces,
}

/// What is known of the values in each scan.
enum Traces {
    /// Results have a hash of them.
    Hashes,
    /// Where they differ first, and what only one of the runs has: machines, cells, local variables, outputs.
    Values { first: Option<First>, only: [Vec<String>; 2] },
}

fn layouts(options: &CompareOptions) -> Result<Compared, Status> {
    let is_shown = !options.quiet && options.format == Format::Text && io::stderr().is_terminal();
    let (a, of_a) = project(options, &options.first)?;
    let (b, of_b) = project(options, &options.second)?;
    let found = first::find([&a, &b], Progress::new(is_shown))
        .map_err(|why| print::unusable(&options.input(&options.first), &why))?;
    let [report_a, report_b] = &found.reports;
    let bug = |text: String| {
        complain!("autogen: {text}");
        Status::Bug
    };
    let reports = [results(report_a, &a, &of_a).map_err(bug)?, results(report_b, &b, &of_b).map_err(bug)?];
    Ok(Compared { reports, traces: Traces::Values { first: found.first, only: found.only } })
}

fn project(options: &CompareOptions, layout: &Path) -> Result<(Project, Sources), Status> {
    let input = options.input(layout);
    let outcome = compile(load::load(&input).map_err(|failure| print::failure(&input, &failure))?);
    match outcome.project {
        Some(project) => Ok((project, outcome.sources)),
        None => Err(print::refused(&input, &outcome.sources, &outcome.diagnostics)),
    }
}

impl Compared {
    /// Everything that is compared: not how long a run took, nor from which settings it came.
    fn is_same(&self) -> bool {
        let [a, b] = &self.reports;
        let are_traces_same = match &self.traces {
            Traces::Hashes => a["trace_hash"] == b["trace_hash"],
            Traces::Values { first, only } => first.is_none() && only.iter().all(Vec::is_empty),
        };
        are_traces_same && table::rows(a, b).iter().all(|row| row.is_same())
    }

    fn text(&self) -> String {
        let [a, b] = &self.reports;
        let mut out = String::from(if self.is_same() { "the same\n" } else { "different\n" });
        match &self.traces {
            Traces::Hashes if a["trace_hash"] != b["trace_hash"] => {
                out +=
                    "\nthe hashes of the traces differ; compare the layouts to see where they differ first\n";
            }
            Traces::Hashes => {}
            Traces::Values { first, only } => {
                out.extend(first.iter().map(|first| format!("\n{}", first.text())));
                for (which, only) in ["the first", "the second"].iter().zip(only) {
                    if let [one, rest @ ..] = only.as_slice() {
                        let more =
                            if rest.is_empty() { String::new() } else { format!(" and {} more", rest.len()) };
                        out += &format!("\nonly {which} has {one}{more}\n");
                    }
                }
            }
        }
        out + "\n" + &table::text(&table::rows(a, b))
    }

    fn json(&self) -> Value {
        let [a, b] = &self.reports;
        let rows = table::rows(a, b);
        let rows = rows.iter().filter(|row| !row.is_same());
        let rows =
            rows.map(|row| json!({ "what": row.what, "first": row.values[0], "second": row.values[1] }));
        let mut answer =
            json!({ "same": self.is_same(), "differences": rows.collect::<Vec<_>>(), "diagnostics": [] });
        if let Traces::Values { first, only: [a, b] } = &self.traces {
            answer["first_difference"] = first.as_ref().map_or(Value::Null, First::json);
            answer["only_first"] = json!(a);
            answer["only_second"] = json!(b);
        }
        answer
    }
}
