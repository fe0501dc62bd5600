//! Runs of several controllers that are one run as long as these do the same: each comes to what it comes to alone.
//!
//! The long form: `AUTOGEN_CAMPAIGN=full cargo test --profile optimized -p autogen-tests together::`.

use crate::stepping::{Case, MOST_ORDERS, cases};
use autogen::executor::Executor;
use autogen::ir::{Scalar, Value};
use autogen::lower::Project;
use autogen_tests::{Texts, is_full_campaign, on_all_processors};
use runtime_sim::line::Line;
use runtime_sim::memory::Memory;
use runtime_sim::random::Random;
use runtime_sim::report::Report;
use runtime_sim::run::{Stepping, run_again, run_together};
use runtime_sim::scan::Controllers;

/// A line, and what executes its automata.
struct Variant {
    project: Project,
    line: Line,
}

impl Variant {
    fn new(project: Project, case: &Case) -> Self {
        let mut line = project.plant.clone();
        (case.change)(&mut line);
        if !is_full_campaign() {
            line.scenario.orders.truncate(MOST_ORDERS);
        }
        Self { project, line }
    }

    fn alone(&self, memory: &mut Memory) -> Report {
        let mut executor = Executor::new(&self.project.system);
        run_again(&self.line, &mut executor, Stepping::Events, memory, &mut |_| {}).expect("a run")
    }
}

fn together(variants: &[Variant], memory: &mut Memory) -> Vec<Report> {
    let mut executors: Vec<_> = variants.iter().map(|it| Executor::new(&it.project.system)).collect();
    let mut all = variants.iter().zip(&mut executors).map(|(variant, executor)| {
        let controllers: &mut dyn Controllers = executor;
        (&variant.line, controllers)
    });
    let (line, controllers) = all.next().expect("a variant");
    run_together(line, controllers, all.collect(), memory).expect("runs")
}

/// A setting that gives a parameter of a machine another value; none if nothing can be drawn for it.
fn setting(project: &Project, random: &mut Random) -> Option<String> {
    let system = &project.system;
    let instance = &system.instances[random.up_to(system.instances.len() as u32 - 1) as usize];
    let parameters = &system.model.automaton(instance.automaton).parameters;
    let number = random.up_to(parameters.len().checked_sub(1)? as u32) as usize;
    let parameter = parameters.get(number).filter(|parameter| parameter.is_settable())?;
    let [value] = instance.parameters[number][..] else { return None };
    let mut one_of = |values: &[f64]| values[random.up_to(values.len() as u32 - 1) as usize];
    let value = match (value, parameter.ty.scalar) {
        (Value::Int(ms), Scalar::Time) => f64::from(ms) / 1000.0 * one_of(&[0.1, 0.5, 0.99, 1.01, 2.0, 5.0]),
        (Value::Int(value), _) => f64::from(value) + one_of(&[-2.0, -1.0, 1.0, 2.0, 3.0, 40.0]),
        (Value::Real(value), _) => value * one_of(&[0.5, 0.9, 1.1, 2.0]),
        _ => return None,
    };
    Some(format!("{}.{}={value}", instance.name, parameter.name))
}

/// The line of a case, and some with other values that have its plant.
fn variants(case: &Case, seed: u64) -> Vec<Variant> {
    let mut random = Random::new(seed);
    let first = case.texts.project();
    let [wanted, tries] = if is_full_campaign() { [12, 60] } else { [4, 16] };
    let settings: Vec<String> = (0..tries).filter_map(|_| setting(&first, &mut random)).collect();
    let mut variants = vec![Variant::new(first, case)];
    for setting in settings {
        if variants.len() <= wanted
            && let Some(project) = case.texts.clone().set(&setting).compile().project
        {
            let variant = Variant::new(project, case);
            variants.extend(Some(variant).filter(|it| variants[0].line.has_plant_of(&it.line)));
        }
    }
    variants
}

#[test]
fn each_comes_to_what_it_comes_to_alone() {
    let cases = cases();
    let numbered: Vec<(usize, &Case)> = cases.iter().enumerate().collect();
    let found = on_all_processors(&numbered, |(number, case)| {
        let variants = variants(case, *number as u64);
        let mut memory = Memory::default();
        let reports = together(&variants, &mut memory);
        let alone: Vec<Report> = variants.iter().map(|variant| variant.alone(&mut memory)).collect();
        let same = reports.iter().skip(1).filter(|report| **report == reports[0]).count();
        println!("{}: {same} of {} as the first", case.name, reports.len() - 1);
        let wrong = (reports != alone).then(|| format!("{}: {reports:#?}\nbut alone {alone:#?}", case.name));
        (same, reports.len() - 1, wrong)
    });
    let wrong: Vec<&str> = found.iter().filter_map(|(.., wrong)| wrong.as_deref()).collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    let same: usize = found.iter().map(|(same, ..)| same).sum();
    let all: usize = found.iter().map(|(_, all, _)| all).sum();
    println!("{same} of {all} as the first");
    assert!(same * 10 > all && same * 10 < all * 9, "{same} of {all} do what the first one does");
}

/// A tank that would be drained after this time, if it were not empty: the end of the timer is the last time at which
/// anything is about to happen.
fn emptied(after: &str) -> Case {
    let device = "device tanker {
            part vessel = tank { area: 1; height: 1; inflow: 1; outflow: 1; };
            in is_empty: bool = vessel.is_empty;
            out drain: bool = vessel.drain;
        }
        automaton Tanker on tanker {
            parameter patience: time := 1 s;
            initial -> Waiting {}
            state Waiting { when not is_empty and after patience -> Draining { drain := true; } }
            final state Draining;
        }";
    let layout = r#"{"robots": [{"name": "tanker", "type": "tanker", "pose": [0, 0, 0]}]}"#;
    let texts = Texts {
        specs: vec![device.into()],
        scenario: Some(r#"{"time_limit_s": 60}"#.into()),
        ..Texts::of_layout(layout)
    };
    Case {
        name: after.into(),
        texts: texts.set(&format!("tanker.patience={after}")),
        change: Box::new(|line| line.scenario.stall_limit_s = 3.0),
    }
}

#[test]
fn a_run_ends_when_its_own_timers_have() {
    let cases = ["2", "1", "7.5", "2.01", "40", "2"].map(emptied);
    let variants: Vec<_> = cases.iter().map(|case| Variant::new(case.texts.project(), case)).collect();
    let mut memory = Memory::default();
    let reports = together(&variants, &mut memory);
    let seconds: Vec<f64> = reports.iter().map(|report| report.simulated_s).collect();
    let alone: Vec<f64> = variants.iter().map(|variant| variant.alone(&mut memory).simulated_s).collect();
    println!("{seconds:?}, {}", reports[0].reason);
    assert_eq!(seconds, alone);
    assert!(seconds[0] > seconds[1] && seconds[0] < seconds[3] && seconds[2] < seconds[4], "{seconds:?}");
    assert!(reports[1..].iter().all(|report| report.trace_hash == reports[0].trace_hash));
}
