//! `autogen test`: tests that stand beside the specifications.

mod files;
pub mod junit;
mod run;

use super::options::{TestEngine, TestOptions};
use super::pending::{Content, Foreign, Pending};
use super::print;
use crate::Status;
use autogen::source::Sources;
use autogen::testing::Failure;

/// What came of one test on one engine.
pub struct Result {
    pub title: String,
    pub engine: TestEngine,
    pub outcome: Outcome,
    /// What the run of a line did not come to.
    pub notes: Vec<String>,
}

pub enum Outcome {
    Passed,
    Failed(Vec<Failure>),
    /// This engine cannot run it, and why.
    Skipped(&'static str),
}

/// The results of a file, with the sources that their places are in.
pub struct OfFile {
    pub name: String,
    pub sources: Sources,
    pub results: Vec<Result>,
}

/// A file of tests that has errors, or whose line has.
pub struct NotRun {
    pub name: String,
    /// The first error, on one line.
    pub first: String,
}

pub fn run(options: &TestOptions) -> Status {
    let refused = |why: String| {
        complain!("autogen: {why}");
        Status::WrongCommand
    };
    let junit =
        options.junit.as_ref().map(|path| Pending::new(path, Content::JUnit, Foreign::Stays)).transpose();
    let junit = match junit {
        Ok(junit) => junit,
        Err(why) => return refused(why),
    };
    let paths = match files::find(&options.paths) {
        Ok(paths) => paths,
        Err(why) => return refused(why),
    };
    let mut all = Vec::new();
    let mut not_run = Vec::new();
    for path in &paths {
        match run::file(options, path) {
            Ok(of_file) => {
                say_file(options, &of_file);
                all.push(of_file);
            }
            Err(run::End::Wrong(sources, found)) => {
                print::diagnostics(&sources, &found);
                let name = path.display().to_string();
                let first = found.first().map(|error| format!("error[{}]: {}", error.code, error.message));
                not_run.push(NotRun { name, first: first.unwrap_or_default() });
            }
            Err(run::End::Failed(why)) => return refused(why),
        }
    }
    if let Some(junit_file) = junit {
        let kept = junit_file.write(&junit::text(&all, &not_run)).and_then(|()| junit_file.keep());
        if let Err(why) = kept {
            return refused(why);
        }
    }
    let count = |wanted: fn(&Outcome) -> bool| -> usize {
        all.iter().flat_map(|file| &file.results).filter(|result| wanted(&result.outcome)).count()
    };
    let failed = count(|outcome| matches!(outcome, Outcome::Failed(_)));
    if !options.quiet {
        let (passed, skipped) =
            (count(|o| matches!(o, Outcome::Passed)), count(|o| matches!(o, Outcome::Skipped(_))));
        let skipped = if skipped == 0 { String::new() } else { format!(", {skipped} skipped") };
        let files = match not_run.as_slice() {
            [] => String::new(),
            [one] => format!("the tests of {} were not run: see the errors", one.name),
            many => format!("the tests of {} files were not run: see the errors", many.len()),
        };
        match (all.is_empty(), not_run.is_empty()) {
            (true, false) => say!("no test was run; {files}"),
            (false, false) => say!("{passed} passed, {failed} failed{skipped}; {files}"),
            (_, true) => say!("{passed} passed, {failed} failed{skipped}"),
        }
    }
    match (not_run.is_empty(), failed) {
        (false, _) => Status::WrongInput,
        (true, 0) => Status::Done,
        (true, _) => Status::NotReached,
    }
}

fn say_file(options: &TestOptions, file: &OfFile) {
    if !options.quiet {
        say!("{}", file.name);
    }
    for Result { title, engine, outcome, notes } in &file.results {
        let on = engine.suffix();
        match outcome {
            Outcome::Passed if options.quiet => {}
            Outcome::Passed => say!("  ok    {title}{on}"),
            Outcome::Skipped(_) if options.quiet => {}
            Outcome::Skipped(why) => say!("  skip  {title}{on}: {why}"),
            Outcome::Failed(failures) => {
                say!("  FAIL  {title}{on}");
                for failure in failures {
                    let line = file.sources.position(failure.place).0;
                    say!("    {}:{line}: {}", file.name, place_text(file, failure));
                    say_part!("{}", failure.text());
                }
            }
        }
        if !options.quiet {
            notes.iter().for_each(|note| say!("    note: {note}"));
        }
    }
}

/// The row or the expectation that failed, on one line.
fn place_text(file: &OfFile, failure: &Failure) -> String {
    file.sources.text(failure.place).split_whitespace().collect::<Vec<_>>().join(" ")
}
