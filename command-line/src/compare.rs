//! `autogen compare`: two results, or the runs of two layouts on the reference executor.

mod first;
mod rows;
mod seen;
mod side;
mod table;

use super::options::{CompareOptions, Format};
use super::progress::Progress;
use super::results::results;
use super::{load, print, titles};
use crate::Status;
use autogen::lower::{Project, compile};
use autogen::source::Sources;
use first::First;
use serde_json::{Value, json};
use side::Side;
use std::io::{self, IsTerminal};
use std::path::Path;

pub fn run(options: &CompareOptions) -> Status {
    let refused = |why: &str| print::unusable(&options.input(&options.first), why);
    let sides = [side::of(&options.first), side::of(&options.second)];
    let compared = match sides {
        [Err(why), _] | [_, Err(why)] => return refused(&why),
        [Ok(Side::Results(a)), Ok(Side::Results(b))] => match of_layouts(options) {
            Some(given) => {
                return refused(&format!(
                    "{given} is for layouts, and {} and {} are results of runs: remove it, or name the two layouts",
                    options.first.display(),
                    options.second.display()
                ));
            }
            None => Compared { reports: [a, b], traces: Traces::Hashes },
        },
        [Ok(Side::Results(_)), Ok(Side::Other(why))] | [Ok(Side::Other(why)), Ok(Side::Results(_))] => {
            return refused(&why);
        }
        [Ok(Side::Results(_)), Ok(Side::Layout)] | [Ok(Side::Layout), Ok(Side::Results(_))] => {
            return refused(
                "one of the two is a layout and the other one has results: name two layouts or two results",
            );
        }
        // What is wrong with a layout its reader says.
        [Ok(Side::Layout | Side::Other(_)), Ok(Side::Layout | Side::Other(_))] => match layouts(options) {
            Ok(compared) => compared,
            Err(status) => return status,
        },
    };
    let is_same = compared.is_same();
    match options.format {
        Format::Json => say!("{}", compared.json()),
        Format::Text if !options.quiet => say_part!("{}", compared.text()),
        Format::Text => {}
    }
    if is_same { Status::Done } else { Status::NotReached }
}

/// The first option that was given and that says how to run a layout.
fn of_layouts(options: &CompareOptions) -> Option<&'static str> {
    let given = [
        ("--specs", !options.specs.is_empty()),
        ("--scenario", options.scenario.is_some()),
        ("--set", !options.settings.is_empty()),
    ];
    given.into_iter().find_map(|(name, is_given)| is_given.then_some(name))
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
        Some(project) => Ok((project, titles::shown(&outcome.sources, layout))),
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
        are_traces_same && rows::rows(a, b).iter().all(|row| row.is_same())
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
        out + "\n" + &table::text(&rows::rows(a, b))
    }

    fn json(&self) -> Value {
        let [a, b] = &self.reports;
        let rows = rows::rows(a, b);
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
