//! Command lines: arguments are separated by line ends.

use super::Effort;
use super::line::{small, text};
use crate::judge;
use autogen::diagnostic;
use autogen::lower::Setting;
use autogen::source::Sources;
use autogen_command_line::{Axis, Cli, Command, InputOptions, SweepOptions, io_delay, milliseconds, scan};
use autogen_tests::Texts;
use clap::Parser;
use runtime_sim::line::IoDelay;

pub fn answer(input: &[u8], effort: Effort) {
    let text = text(input);
    let arguments = std::iter::once("autogen").chain(text.lines());
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => {
            assert!([0, 2].contains(&error.exit_code()), "{error:?}");
            assert!(!error.render().to_string().is_empty());
            return;
        }
    };
    match &cli.command {
        Command::Check(options) => of_line(&options.input, input, effort),
        Command::Build(options) => of_line(&options.build.input, input, effort),
        Command::Commission(options) => {
            delay(&options.io_delay);
            let every = milliseconds(&options.trajectories.every);
            assert!(every.is_none_or(|ms| (1..=3_600_000).contains(&ms)), "{every:?}");
            of_line(&options.build.input, input, effort);
        }
        Command::Sweep(options) => of_sweep(options, input, effort),
        Command::Verify(options) => of_line(&options.input, input, effort),
        Command::Merge(_)
        | Command::New(_)
        | Command::Test(_)
        | Command::Import(_)
        | Command::Fmt(_)
        | Command::Schema(_)
        | Command::Completions(_)
        | Command::Lsp(_) => {}
        Command::Graph(options) => of_line(&options.input, input, effort),
        Command::Explain(options) => {
            diagnostic::explain(&options.code);
        }
        Command::Compare(options) => of_line(&options.input(&options.first), input, effort),
        Command::Why(options) => {
            delay(&options.io_delay);
            let scan = options.at.as_deref().and_then(|at| scan(at, 10));
            assert!(scan.is_none_or(|scan| scan <= 100_000_000_000), "{scan:?}");
            of_line(&options.input, input, effort);
        }
    }
}

fn of_line(options: &InputOptions, input: &[u8], effort: Effort) {
    settings(&options.settings, options.order, input, effort);
}

/// The first value of each axis; the others are read only.
fn of_sweep(options: &SweepOptions, input: &[u8], effort: Effort) {
    options.io_delay.iter().for_each(|text| delay(text));
    let axes: Vec<Axis> = options.settings.iter().map(|text| Axis::parse(text)).collect();
    for (axis, text) in axes.iter().zip(&options.settings) {
        assert_eq!(axis.setting(&axis.values.join(",")).trim_end_matches('='), text.trim_end_matches('='));
        axis.values.iter().for_each(|value| drop(setting(&axis.setting(value), input, effort)));
    }
    let first: Vec<String> = axes.iter().map(|axis| axis.setting(&axis.values[0])).collect();
    settings(&first, options.order.first().copied(), input, effort);
}

fn settings(settings: &[String], order: Option<u64>, input: &[u8], effort: Effort) {
    let are_right = settings.iter().all(|text| setting(text, text.as_bytes(), effort).is_some());
    if are_right && effort.takes(input, 16) {
        let texts = Texts { settings: settings.to_vec(), order, ..Texts::of_layout(small("")) };
        judge::line(&texts, input, effort);
    }
}

fn setting(text: &str, input: &[u8], effort: Effort) -> Option<Setting> {
    let mut sources = Sources::default();
    let file = sources.add("--set", text);
    match Setting::parse(&sources, file) {
        Ok(setting) => Some(setting),
        Err(found) => {
            assert!(!found.is_empty(), "refused without a word");
            judge::diagnostics(&sources, &found, input, effort);
            None
        }
    }
}

fn delay(text: &str) {
    match io_delay(text) {
        Some(IoDelay::Fixed(scans)) => assert!(scans <= 1000, "{scans}"),
        Some(IoDelay::Random { max, .. }) => assert_eq!(max, 5),
        None => {}
    }
}
