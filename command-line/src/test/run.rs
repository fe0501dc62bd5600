//! The tests of one file, each on the engines that are asked for.

use super::super::controllers::{self, Notice, SharedLibrary};
use super::super::load::{self, Failure as LoadFailure};
use super::super::named::Folder;
use super::super::options::{Format, InputOptions, TestEngine, TestOptions};
use super::super::remembered::remembering;
use super::super::{read, titles};
use super::{OfFile, Outcome, Result as TestResult};
use autogen::backend::rust::parameters_text;
use autogen::backend::st;
use autogen::diagnostic::{Diagnostic, sort};
use autogen::executor::Executor;
use autogen::lower::{Project, compile};
use autogen::source::{Sources, Spanned};
use autogen::testing::{self, Body, Emitted, Engine, Failure, Played, Setup, StructuredText, Test, Watched};
use runtime_sim::run::{Stepping, run_again};
use std::cell::OnceCell;
use std::path::{Path, PathBuf};

/// Why the tests of a file were not run.
pub enum End {
    /// The file, or a line that it names, has errors.
    Wrong(Sources, Vec<Diagnostic>),
    Failed(String),
}

/// A line that tests of a file have in common.
struct Compiled {
    key: (PathBuf, Option<PathBuf>, Vec<String>),
    project: Project,
    /// Under the names that `commission` shows.
    sources: Sources,
    /// What tests have in common on engines that need it; none until the first one does.
    library: OnceCell<SharedLibrary>,
    emitted: OnceCell<Emitted>,
}

impl Compiled {
    fn library(&self, notice: Notice) -> Result<&SharedLibrary, String> {
        if let Some(known) = self.library.get() {
            return Ok(known);
        }
        let library = controllers::compiled(&self.project.system, &self.sources, notice)?;
        Ok(self.library.get_or_init(|| library))
    }

    fn emitted(&self) -> &Emitted {
        self.emitted.get_or_init(|| Emitted::of(&st::files(&self.project.system, &self.sources)))
    }
}

pub fn file(options: &TestOptions, path: &Path) -> Result<OfFile, End> {
    let text = read::text(path).map_err(|why| End::Failed(format!("{}: {why}", path.display())))?;
    let mut sources = Sources::default();
    let id = sources.add(path.display().to_string(), text.as_str());
    let tests = match testing::read(id, &text) {
        Ok(tests) => tests,
        Err(found) => return Err(End::Wrong(sources, found)),
    };
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut compiled: Vec<Compiled> = Vec::new();
    let (mut results, mut wrong) = (Vec::new(), Vec::new());
    for test in &tests.tests {
        let number = match line(options, folder, &tests.set, test, &mut compiled) {
            Ok(number) => number,
            Err(LineEnd::Test(diagnostic)) => {
                wrong.push(*diagnostic);
                continue;
            }
            Err(LineEnd::End(end)) => return Err(end),
        };
        for engine in &options.on {
            match one(options, &compiled[number], test, *engine).map_err(End::Failed)? {
                Ok((outcome, notes)) => {
                    let title = test.title.value.clone();
                    results.push(TestResult { title, engine: *engine, outcome, notes });
                }
                Err(found) => wrong.extend(found),
            }
        }
    }
    if !wrong.is_empty() {
        sort(&mut wrong);
        return Err(End::Wrong(sources, wrong));
    }
    Ok(OfFile { name: path.display().to_string(), sources, results })
}

fn no_layout(title: &Spanned<String>) -> Diagnostic {
    Diagnostic::new("E0902", title.span, "no layout is named for this test")
        .help("write `layout \"line.json\";` at the beginning of the file, or in the test")
}

enum LineEnd {
    /// The test names no line that can be used.
    Test(Box<Diagnostic>),
    End(End),
}

/// What a test names stands below its own folder, as what a layout names does.
fn named(folder: &Path, key: &str, name: &Spanned<String>) -> Result<PathBuf, LineEnd> {
    match Folder(folder.into()).object(&name.value) {
        Ok((path, _)) => Ok(path.into()),
        Err(why) => {
            let message = format!("`{key}` names \"{}\", which cannot be used", name.value);
            let help = "name a file of the folder in which the tests are, or of one below";
            Err(LineEnd::Test(Box::new(
                Diagnostic::new("E0902", name.span, message).label(why.to_string()).help(help),
            )))
        }
    }
}

/// The line of a test by its number among those that are compiled already.
fn line(
    options: &TestOptions,
    folder: &Path,
    of_file: &Setup,
    test: &Test,
    compiled: &mut Vec<Compiled>,
) -> Result<usize, LineEnd> {
    let one = |own: &Option<Spanned<String>>, other: &Option<Spanned<String>>, key: &str| {
        let name = own.clone().or_else(|| other.clone());
        name.map(|name| named(folder, key, &name)).transpose()
    };
    let layout = one(&test.set.layout, &of_file.layout, "layout")?;
    let layout = layout.ok_or_else(|| LineEnd::Test(Box::new(no_layout(&test.title))))?;
    let scenario = one(&test.set.scenario, &of_file.scenario, "scenario")?;
    let settings = of_file.settings.iter().chain(&test.set.settings).map(|setting| setting.value.clone());
    let key = (layout, scenario, settings.collect::<Vec<_>>());
    if let Some(known) = compiled.iter().position(|line| line.key == key) {
        return Ok(known);
    }
    let input = InputOptions {
        layout: key.0.clone(),
        specs: options.specs.clone(),
        scenario: key.1.clone(),
        settings: key.2.clone(),
        order: None,
        format: Format::Text,
        quiet: true,
    };
    let input = load::load(&input).map_err(|failure| {
        LineEnd::End(match failure {
            LoadFailure::Unreadable(why) | LoadFailure::Unfit(why) => End::Failed(why),
            LoadFailure::Wrong(sources, found) | LoadFailure::Refused(sources, found) => {
                End::Wrong(sources, found)
            }
        })
    })?;
    let outcome = compile(input);
    match outcome.project {
        Some(project) => {
            let sources = titles::shown(&outcome.sources, &key.0);
            let (library, emitted) = Default::default();
            compiled.push(Compiled { key, project, sources, library, emitted });
            Ok(compiled.len() - 1)
        }
        None => Err(LineEnd::End(End::Wrong(outcome.sources, outcome.diagnostics))),
    }
}

/// What came of a test, and the notes of its run.
type Judged = (Outcome, Vec<String>);

/// One test on one engine. Inner errors are those of the test, outer ones those of the engine.
fn one(
    options: &TestOptions,
    line: &Compiled,
    test: &Test,
    engine: TestEngine,
) -> Result<Result<Judged, Vec<Diagnostic>>, String> {
    let (system, plant) = (&line.project.system, &line.project.plant);
    if let Body::Machine { name, rows } = &test.body
        && engine != TestEngine::Executor
        && testing::instance(system, &name.value, name.span)
            .is_ok_and(|machine| !testing::is_for_any_engine(system, machine, rows))
    {
        let why = "it shares values with other machines, which the test plays on the executor only";
        return Ok(Ok((Outcome::Skipped(why), Vec::new())));
    }
    match engine {
        TestEngine::Executor => {
            on(line, test, Engine::Executor(&mut Executor::new(system)), Stepping::Events)
        }
        TestEngine::Rust => {
            let library = line.library(notice(options))?;
            let mut controllers = library.controllers(plant, &parameters_text(system))?;
            on(line, test, Engine::Other(&mut controllers), Stepping::Events)
        }
        TestEngine::St => on_structured_text(line, test, line.emitted()),
    }
}

/// A text that is refused, or stops within a scan, has failed the test: others say something nevertheless.
fn on_structured_text(
    line: &Compiled,
    test: &Test,
    emitted: &Emitted,
) -> Result<Result<Judged, Vec<Diagnostic>>, String> {
    let failed = |found: String| {
        let expected = vec!["the Structured Text executes every scan to its end".to_string()];
        let (place, found) = (test.title.span, found.lines().map(String::from).collect());
        Outcome::Failed(vec![Failure { place, at_ms: None, events: Vec::new(), expected, found }])
    };
    let mut text = match StructuredText::new(&line.project.system, emitted) {
        Ok(text) => text,
        Err(why) => return Ok(Ok((failed(why), Vec::new()))),
    };
    let outcome = on(line, test, Engine::Other(&mut text), Stepping::EveryScan)?;
    Ok(match text.ended {
        Some(why) => outcome.map(|(_, notes)| (failed(why), notes)),
        None => outcome,
    })
}

fn on(
    line: &Compiled,
    test: &Test,
    mut engine: Engine,
    stepping: Stepping,
) -> Result<Result<Judged, Vec<Diagnostic>>, String> {
    let system = &line.project.system;
    let mut notes = Vec::new();
    let failures = match &test.body {
        Body::Machine { name, rows } => {
            let machine = match testing::instance(system, &name.value, name.span) {
                Ok(machine) => machine,
                Err(wrong) => return Ok(Err(vec![*wrong])),
            };
            match testing::play(system, machine, rows, engine) {
                Played::Passed => Vec::new(),
                Played::Failed(failure) => vec![failure],
                Played::Stopped => {
                    let why =
                        "another machine, which makes no steps on the executor, stops the line by a fault";
                    return Ok(Ok((Outcome::Skipped(why), Vec::new())));
                }
                Played::Wrong(found) => return Ok(Err(found)),
            }
        }
        Body::Line(expected) => {
            let mut watched = Watched::new(engine.controllers(), system);
            let plant = &line.project.plant;
            let run = |memory: &mut _| run_again(plant, &mut watched, stepping, memory, &mut |_| {});
            let report = remembering(plant, run)?;
            notes.clone_from(&report.notes);
            match testing::judge(system, &line.sources, &report, &watched, expected) {
                Ok(failures) => failures,
                Err(found) => return Ok(Err(found)),
            }
        }
    };
    let outcome = if failures.is_empty() { Outcome::Passed } else { Outcome::Failed(failures) };
    Ok(Ok((outcome, notes)))
}

fn notice(options: &TestOptions) -> Notice {
    if options.quiet { Notice::None } else { Notice::Compiling }
}

#[cfg(test)]
mod tests {
    use super::*;

    const TESTS: &str = r#"
        layout "line.json";
        test "of a machine" of m1 { 0 s: -> S; 10 ms: -> T; }
    "#;
    const SPECS: &str =
        "automaton Alpha on bin { initial -> S {} state S { when true -> T {} } final state T; }";
    const LAYOUT: &str =
        r#"{"specs": "a.aut", "robots": [{"name": "m1", "type": "alpha", "pose": [0, 0, 0]}]}"#;

    #[test]
    fn a_text_that_stops_has_failed_the_test() {
        let folder = std::env::temp_dir().join(format!("autogen-text-stops-{}", std::process::id()));
        std::fs::create_dir_all(&folder).expect("a folder");
        for (name, text) in [("a.aut", SPECS), ("line.json", LAYOUT), ("a.test", TESTS)] {
            std::fs::write(folder.join(name), text).expect("a file");
        }
        let options =
            TestOptions { paths: Vec::new(), on: Vec::new(), specs: Vec::new(), junit: None, quiet: true };
        let id = Sources::default().add("a.test", TESTS);
        let tests = testing::read(id, TESTS).expect("tests");
        let mut compiled = Vec::new();
        let test = &tests.tests[0];
        assert!(line(&options, &folder, &tests.set, test, &mut compiled).is_ok());
        std::fs::remove_dir_all(folder).expect("a folder");
        let line = &compiled[0];
        let right = Emitted::of(&st::files(&line.project.system, &line.sources));
        let outcome = |emitted: &Emitted| on_structured_text(line, test, emitted).expect("an engine").ok();
        assert!(matches!(outcome(&right), Some((Outcome::Passed, _))));
        for (text, why) in [
            ("WHILE elapsed >= 0 DO elapsed := 0; END_WHILE; CASE state OF", "EndlessLoop"),
            ("CASE unknown OF", "unknown"),
        ] {
            let wrong = Emitted::flat(right.main.replacen("CASE state OF", text, 1), right.names.clone());
            assert_ne!(wrong.main, right.main);
            let Some((Outcome::Failed(failures), _)) = outcome(&wrong) else {
                panic!("{text} has not failed")
            };
            assert!(failures[0].found.concat().contains(why), "{:?}", failures[0].found);
        }
    }
}
