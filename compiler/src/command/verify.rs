//! `autogen verify`: every course of events is looked at.

use super::options::VerifyOptions;
use super::{load, print};
use crate::Status;
use autogen::lower::compile;
use autogen::verify::{self, story::Teller};
use autogen_search::explore::{Bounds, Covered, End, Outcome, explore};
use autogen_search::plant::Faults;
use autogen_search::successor::Orders;
use std::time::Duration;

pub fn run(options: &VerifyOptions) -> Status {
    let input = match load::load(&options.input) {
        Ok(input) => input,
        Err(failure) => return print::failure(&options.input, &failure),
    };
    let outcome = compile(input);
    let Some(project) = &outcome.project else {
        print::diagnostics(&outcome.sources, &outcome.diagnostics);
        return Status::WrongInput;
    };
    let faults = if options.no_faults { Faults::None } else { Faults::All };
    let model = match verify::model(project, faults) {
        Ok(model) => model,
        Err(found) => {
            print::diagnostics(&outcome.sources, &found);
            return Status::WrongInput;
        }
    };
    let bounds = Bounds {
        answers: options.answers,
        orders: Orders::One,
        time: Some(Duration::from_secs(std::env::var("VT").map_or(600, |t| t.parse().unwrap()))),
        memory: 4_000_000_000,
        violations: if options.all { 1000 } else { 1 },
    };
    let Outcome { covered, end, violations, reached, values: _ } = explore(&model, &bounds, &mut |covered: &Covered| {
        let _ = covered;
        true
    });
    say!(
        "{end:?}: {} states of {} bytes, {} transitions, depth {}, {:.2} s, {} MB",
        covered.states,
        model.initial.len(),
        covered.transitions,
        covered.depth,
        covered.time.as_secs_f64(),
        covered.memory / 1_000_000
    );
    if std::env::var("VD").is_ok() {
        for v in &model.variables {
            let mut seen = std::collections::BTreeMap::new();
            for n in 0..reached.len() { *seen.entry(v.var.load(reached.state(n))).or_insert(0) += 1; }
            if seen.len() > 1 { complain!("{} {} {:?}", v.name, seen.len(), seen.iter().take(12).collect::<Vec<_>>()); }
        }
    }
    let teller = Teller { project, model: &model, sources: &outcome.sources };
    for (violation, course) in &violations {
        say!("{}\n\n{}", teller.title(violation), teller.tell(course));
    }
    match (violations.is_empty(), end) {
        (false, _) => Status::NotReached,
        (true, End::Complete) => Status::Done,
        _ => Status::Undecided,
    }
}
