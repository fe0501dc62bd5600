//! `autogen check`.

use super::options::{CheckOptions, Denied, Format, InputOptions};
use super::{load, print};
use crate::Status;
use autogen::diagnostic::Diagnostic;
use autogen::layout::Layout;
use autogen::lower::{Outcome, compile};
use autogen::{interlock, overlap};

pub fn run(options: &CheckOptions) -> Status {
    let CheckOptions { input: options, deny, notes } = options;
    let input = match load::load(options) {
        Ok(input) => input,
        Err(failure) => return print::failure(options, &failure),
    };
    let names = input.layout.0.as_ref().map(Layout::names);
    let mut outcome = compile(input);
    let are_denied = *deny == Some(Denied::Warnings);
    // What nobody sees need not be sought.
    if let (Some(names), Some(project)) = (&names, &outcome.project)
        && (!options.quiet || are_denied)
    {
        outcome.warnings.extend(interlock::warnings(names, project));
    }
    let noted = outcome.project.as_ref().filter(|_| *notes && !options.quiet);
    let notes = noted.map(|project| overlap::notes(&project.system));
    show(options, &outcome, &notes.unwrap_or_default());
    let status = match outcome.project {
        Some(_) if outcome.warnings.is_empty() || !are_denied => Status::Done,
        Some(_) | None => Status::WrongInput,
    };
    // The process ends: to give back each value of a long line takes longer than to print all of it.
    std::mem::forget(outcome);
    status
}

fn show(options: &InputOptions, outcome: &Outcome, notes: &[Diagnostic]) {
    let Outcome { sources, diagnostics, warnings, verdict, project } = outcome;
    let others = warnings.iter().chain(notes).filter(|_| !options.quiet);
    let found: Vec<_> = diagnostics.iter().chain(others).cloned().collect();
    match options.format {
        Format::Json => say!("{}", print::verdict_json(verdict.as_ref(), sources, &found)),
        Format::Text => {
            // What the geometry says is of use only where nothing else is wrong.
            let is_geometry = diagnostics.iter().all(|d| d.code.starts_with("E04"));
            if let Some(verdict) = verdict.as_ref().filter(|_| !options.quiet && is_geometry) {
                say_part!("{}", print::verdict(verdict));
            }
            print::diagnostics(sources, &found);
            if !options.quiet {
                say!(
                    "{}",
                    if project.is_some() {
                        "feasible"
                    } else if is_geometry {
                        "not feasible"
                    } else {
                        "not checked: the input has errors"
                    }
                );
            }
        }
    }
}
