//! `autogen verify`: all executions are searched.

mod drawing;
mod report;

use super::interrupt;
use super::options::{self, Format, VerifyOptions};
use super::pending::{Content, Foreign, Pending};
use super::{load, print};
use crate::Status;
use autogen::lower::compile;
use autogen::verify::{self, Asked, Remembered, Searched, Warnings, replay, scenario};
use autogen_search::explore::{Bounds, Covered, End, Outcome, explore};
use autogen_search::model::Model;
use autogen_search::plant::Faults;
use autogen_search::violation::Violation;
use report::{First, Report, Shown};
use std::io::{self, IsTerminal};
use std::mem::discriminant;
use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::thread::available_parallelism;
use std::time::{Duration, Instant};

/// Without `--limit`.
const TIME: Duration = Duration::from_secs(600);
const MEMORY: usize = 2_000_000_000;
/// The search with one answer in a scan that comes first ends with so many states.
const STATES: usize = 200_000;
/// Different violations of which `--all` tells.
const MOST: usize = 100;
/// Instances whose steps are put into every order.
const MOST_IN_ANY_ORDER: usize = 64;

pub fn run(options: &VerifyOptions) -> Status {
    let limits = match limits(&options.limit) {
        Ok(limits) => limits,
        Err(text) => {
            complain!("autogen: {text}");
            return Status::WrongCommand;
        }
    };
    let pending = |path: &Option<PathBuf>, content: Content| {
        path.as_ref().map(|path| Pending::new(path, content, Foreign::Stays)).transpose()
    };
    let files = pending(&options.counterexample, Content::Scenario)
        .and_then(|scenario| Ok((scenario, pending(&options.report, Content::Report)?)));
    let (file, page) = match files {
        Ok(files) => files,
        Err(text) => {
            complain!("autogen: {text}");
            return Status::WrongCommand;
        }
    };
    let input = match load::load(&options.input) {
        Ok(input) => input,
        Err(failure) => return print::failure(&options.input, &failure),
    };
    let outcome = compile(input);
    let faults = if options.no_faults { Faults::None } else { Faults::All };
    let warnings = match options.warnings {
        options::Warnings::None => Warnings::None,
        options::Warnings::Own => Warnings::Own(&outcome.sources),
        options::Warnings::All => Warnings::All,
    };
    let asked = Asked { faults, warnings, remembered: Remembered::Least };
    let searched = outcome.project.as_ref().map(|project| verify::model(project, &asked));
    let refused = |found: &[autogen::diagnostic::Diagnostic]| {
        match options.input.format {
            Format::Text => print::diagnostics(&outcome.sources, found),
            Format::Json => {
                say!(
                    "{}",
                    serde_json::json!({ "diagnostics": print::diagnostics_json(&outcome.sources, found) })
                );
            }
        }
        Status::WrongInput
    };
    let (Some(project), Some(searched)) = (&outcome.project, searched) else {
        return refused(&outcome.diagnostics);
    };
    let Searched { model, skipped } = match searched {
        Ok(searched) => searched,
        Err(found) => return refused(&found),
    };
    if options.orders == super::options::StepOrders::All && model.instances.len() > MOST_IN_ANY_ORDER {
        complain!("autogen: --orders all takes lines of {MOST_IN_ANY_ORDER} machines at most");
        return Status::WrongCommand;
    }
    let Found { outcome: found, answers, first } = search(options, &model, limits);
    let mut shown: Vec<Shown> = Vec::new();
    for (violation, execution) in &found.violations {
        let replay = replay::replay(project, &model, execution);
        shown.push(Shown { violation, execution, replay });
    }
    if let (Some(file), Some(first)) = (file, shown.first().and_then(|shown| shown.replay.as_ref().ok())) {
        let written = file.write(&scenario::text(&project.system, &first.line)).and_then(|()| file.keep());
        if let Err(text) = written {
            complain!("autogen: {text}");
            return Status::WrongCommand;
        }
    }
    let teller = verify::story::Teller { project, model: &model, sources: &outcome.sources };
    if let (Some(file), Some(first)) = (page, shown.first()) {
        let text = drawing::page(project, &teller, first);
        let written = text.and_then(|text| file.write(&text)).and_then(|()| file.keep());
        if let Err(text) = written {
            complain!("autogen: {text}");
            return Status::WrongCommand;
        }
    }
    let never = report::Unreached::new(&teller, &found);
    let report = Report {
        options,
        teller: &teller,
        outcome: &found,
        answers,
        first,
        shown: &shown,
        skipped: &skipped,
        under_way: verify::under_way::places(&project.system, &project.plant, &asked),
        never,
    };
    match options.input.format {
        Format::Json => say!("{}", report.json()),
        Format::Text if options.input.quiet && found.violations.is_empty() && found.is_proved() => {}
        Format::Text => say_part!("{}", report.text()),
    }
    match (found.violations.is_empty(), found.is_proved()) {
        (false, _) => Status::NotReached,
        (true, true) => Status::Done,
        (true, false) => Status::Undecided,
    }
}

/// What was found, and what the search with one answer in a scan has covered without finding anything, if it came first.
struct Found {
    outcome: Outcome,
    /// In one scan of the last search; none for any number.
    answers: Option<usize>,
    first: Option<First>,
}

/// Without a number of answers first with one in a scan, which finds most in little time; then with any number.
fn search(options: &VerifyOptions, model: &Model, (time, memory): (Duration, usize)) -> Found {
    let begin = Instant::now();
    let is_shown = !options.input.quiet && options.input.format == Format::Text && io::stderr().is_terminal();
    let mut last = Instant::now();
    let stops = interrupt::asks_first();
    let mut watch = |covered: &Covered| {
        if is_shown && last.elapsed() >= Duration::from_millis(200) {
            last = Instant::now();
            let rate = covered.states as f64 / covered.time.as_secs_f64().max(0.001);
            print::err_styled(&format!(
                "\r\x1b[K{} states, {rate:.0} a second, depth {}, {} MB",
                covered.states,
                covered.depth,
                covered.memory / 1_000_000
            ));
        }
        !stops.asked()
    };
    let is_first = options.answers.is_none();
    let mut bounds = Bounds {
        answers: Some(options.answers.map_or(1, NonZeroUsize::get)),
        states: if is_first { STATES } else { usize::MAX },
        orders: options.orders.into(),
        time: Some(time),
        memory,
        violations: if options.all { MOST } else { 1 },
        jobs: options.jobs.or_else(|| available_parallelism().ok()).map_or(1, NonZeroUsize::get),
    };
    let mut outcome = explore(model, &bounds, &mut watch);
    let mut first = None;
    if is_first && (outcome.is_proved() || outcome.end == End::TooManyStates && outcome.violations.is_empty())
    {
        first = Some(First { is_proved: outcome.is_proved(), covered: outcome.covered });
        bounds.answers = None;
        bounds.states = usize::MAX;
        bounds.time = Some(time.saturating_sub(begin.elapsed()));
        let model = Model { unread: outcome.unread, ..model.clone() };
        let noticed = outcome.remarks;
        outcome = explore(&model, &bounds, &mut watch);
        if outcome.is_proved() {
            // A search that postpones answers does not look for all of them.
            let is_new = |remark: &Violation| {
                outcome.remarks.iter().all(|(known, _)| discriminant(known) != discriminant(remark))
            };
            let more: Vec<_> = noticed.into_iter().filter(|(remark, _)| is_new(remark)).collect();
            outcome.remarks.extend(more);
        }
    }
    if is_shown {
        print::err_styled("\r\x1b[K");
    }
    Found { outcome, answers: bounds.answers, first }
}

/// Of time and memory, as `90s`, `10min`, `2GB` or `500MB`.
fn limits(texts: &[String]) -> Result<(Duration, usize), String> {
    let (mut time, mut memory) = (None, None);
    for text in texts {
        let digits = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
        let number: Option<u32> = text[..digits].parse().ok().filter(|number| *number > 0);
        let time_of = |n: u32, seconds: u64| Some(Duration::from_secs(seconds * u64::from(n)));
        let memory_of = |n: u32, bytes: usize| Some((n as usize).saturating_mul(bytes));
        let (of_time, of_memory) = match (number, &text[digits..]) {
            (Some(n), "s") => (time_of(n, 1), None),
            (Some(n), "min") => (time_of(n, 60), None),
            (Some(n), "h") => (time_of(n, 3600), None),
            (Some(n), "MB") => (None, memory_of(n, 1_000_000)),
            (Some(n), "GB") => (None, memory_of(n, 1_000_000_000)),
            _ => {
                return Err(
                    "--limit takes a time or an amount of memory, such as 90s, 10min, 500MB or 2GB".into()
                );
            }
        };
        if time.is_some() && of_time.is_some() {
            return Err("--limit takes one time, and there are two".into());
        }
        if memory.is_some() && of_memory.is_some() {
            return Err("--limit takes one amount of memory, and there are two".into());
        }
        (time, memory) = (time.or(of_time), memory.or(of_memory));
    }
    Ok((time.unwrap_or(TIME), memory.unwrap_or(MEMORY)))
}
