//! `autogen graph`.

use super::options::{Format, GraphOptions};
use super::{load, print};
use crate::Status;
use autogen::backend::{dot, plan};
use autogen::lower::compile;
use autogen::naming;

pub fn run(options: &GraphOptions) -> Status {
    if options.input.format == Format::Json {
        complain!("autogen: --format json: a graph is DOT, and the plan SVG; leave the option out");
        return Status::WrongCommand;
    }
    let input = match load::load(&options.input) {
        Ok(input) => input,
        Err(failure) => return print::failure(&options.input, &failure),
    };
    let outcome = compile(input);
    let Some(project) = outcome.project else {
        print::diagnostics(&outcome.sources, &outcome.diagnostics);
        return Status::WrongInput;
    };
    if options.of == dot::PLAN {
        say_part!("{}", plan::svg(&project.plant, &project.edges));
        return Status::Done;
    }
    let files = dot::files(&project);
    let model = &project.system.model;
    let mut automata = model.automata.iter().zip(dot::names(model));
    let snake = naming::snake(&options.of);
    let named = automata.find(|(automaton, name)| automaton.name == options.of || *name == snake);
    let name = named.map_or(options.of.clone(), |(_, name)| name);
    match files.get(&format!("{name}.dot")) {
        Some(text) => {
            say_part!("{text}");
            Status::Done
        }
        None => {
            let known: Vec<&str> = files.keys().map(|name| name.trim_end_matches(".dot")).collect();
            complain!(
                "autogen: there is no graph of `{}`; there are {}, {}",
                options.of,
                dot::PLAN,
                known.join(", ")
            );
            Status::WrongCommand
        }
    }
}
