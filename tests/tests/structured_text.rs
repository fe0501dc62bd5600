//! Emitted Structured Text, judged and run beside the reference executor.

use autogen::backend::st;
use autogen::ir::System;
use autogen::source::Sources;
use autogen_st_judge::machine::Machine;
use autogen_st_judge::{faults, judge, listed};
use autogen_tests::instances::instantiate;
use autogen_tests::lots::Lots;
use autogen_tests::st::{Beside, Emitted, StructuredText};
use autogen_tests::{LAYOUTS, ariac, root, trace};
use runtime_sim::scan::Controllers;
use std::collections::BTreeMap;

fn emitted(system: &System, sources: &Sources) -> Emitted {
    Emitted::of(&st::files(system, sources))
}

/// The text of a layout of the paper.
fn of_layout(layout: &str) -> (autogen::lower::Project, Emitted) {
    let outcome = ariac(layout).compile();
    let project = outcome.project.expect("a layout that can be built");
    let text = emitted(&project.system, &outcome.sources);
    (project, text)
}

/// The specifications of the small fixtures.
fn fixtures() -> Vec<(String, String)> {
    let folder = root().join("tests/fixtures/rust");
    let mut files: Vec<_> = std::fs::read_dir(folder)
        .expect("a folder")
        .map(|entry| entry.expect("an entry").path())
        .map(|path| {
            let name = path.file_name().expect("a name").to_string_lossy().into_owned();
            (name, std::fs::read_to_string(&path).expect("a text"))
        })
        .collect();
    files.sort();
    files
}

/// Branches of CASE by unit and label, and constructs: how often executed.
#[derive(Default)]
struct Entered {
    branches: BTreeMap<(String, String), u64>,
    constructs: BTreeMap<String, u64>,
}

impl Entered {
    fn add(&mut self, beside: &Beside) {
        for branch in beside.text.machine.branches() {
            *self.branches.entry((branch.unit, branch.label)).or_default() += branch.entered;
        }
        for (name, count) in beside.text.machine.constructs() {
            *self.constructs.entry(name).or_default() += count;
        }
    }

    fn print(&self) {
        let never: Vec<_> =
            self.branches.iter().filter(|(_, n)| **n == 0).map(|((u, l), _)| format!("{u} {l}")).collect();
        let all = self.branches.len();
        println!("{} of {all} CASE branches entered; not: {}", all - never.len(), never.join(", "));
        let never: Vec<_> =
            self.constructs.iter().filter(|(_, n)| **n == 0).map(|(name, _)| name.as_str()).collect();
        println!("{} constructs, never executed: {}", self.constructs.len(), never.join(", "));
    }
}

fn same(beside: &Beside, name: &str) {
    println!("{name}: {} scans, {} words, difference: {:?}", beside.scans, beside.words, beside.difference);
    assert_eq!(beside.difference, None, "{name}");
}

/// So many scans of inputs drawn by lot.
fn drawn<'s>(system: &'s System, text: &Emitted, scans: usize, seed: u64) -> Result<Beside<'s>, String> {
    let mut beside = Beside::new(system, text)?;
    let mut lots = Lots::new(system, seed);
    let mut outputs = vec![Vec::new(); system.instances.len()];
    for _ in 0..scans {
        let given = lots.next(system, &outputs);
        beside.scan(given, &lots.images, &mut outputs);
    }
    Ok(beside)
}

#[test]
fn layouts_are_the_same_on_the_simulator_and_on_drawn_inputs() {
    let mut entered = Entered::default();
    for layout in LAYOUTS {
        let (project, text) = of_layout(layout);
        let mut beside =
            Beside::new(&project.system, &text).unwrap_or_else(|error| panic!("{layout}: {error}"));
        runtime_sim::run::run(&project.plant, &mut beside, &mut |_| {}).expect("a line that can be run");
        same(&beside, layout);
        entered.add(&beside);
        for seed in 1..=3 {
            let beside =
                drawn(&project.system, &text, 3000, seed).unwrap_or_else(|error| panic!("{layout}: {error}"));
            same(&beside, &format!("{layout}, inputs drawn from {seed}"));
            entered.add(&beside);
        }
    }
    entered.print();
}

#[test]
fn fixtures_are_the_same_on_drawn_inputs() {
    let mut entered = Entered::default();
    let mut wrong = Vec::new();
    for file in fixtures() {
        let name = file.0.clone();
        let (system, sources) = instantiate(&[file]);
        match drawn(&system, &emitted(&system, &sources), 3000, 1) {
            Err(error) => wrong.push(format!("{name}: {error}")),
            Ok(beside) => {
                println!("{name}: {} scans, {} words", beside.scans, beside.words);
                wrong.extend(beside.difference.iter().map(|d| format!("{name}: {d}")));
                entered.add(&beside);
            }
        }
    }
    entered.print();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

#[test]
fn a_state_that_there_is_not_is_a_fault() {
    let (project, text) = of_layout("default");
    for instance in &project.system.instances {
        let mut machine = Machine::new(&text.main).expect("a clean text");
        machine.set("run_permit", 1.0);
        machine.scan().expect("a scan");
        machine.set("start", 1.0);
        machine.set(&format!("{}.state", instance.name), 99.0);
        machine.scan().expect("a scan");
        assert_eq!((machine.get("fault"), machine.get("running")), (1.0, 0.0), "{}", instance.name);
        assert!(machine.branches().iter().any(|b| b.label == "ELSE" && b.entered == 1), "{}", instance.name);
    }
}

/// Where a text differs, it is written to the folder that AUTOGEN_ST names.
fn keep(name: &str, text: &str) {
    if let Some(folder) = std::env::var_os("AUTOGEN_ST") {
        std::fs::write(std::path::Path::new(&folder).join(format!("{name}.st")), text).expect("a folder");
    }
}

#[test]
fn hand_written_traces_are_followed() {
    let mut wrong = Vec::new();
    let mut differ = Vec::new();
    let mut paths: Vec<_> = std::fs::read_dir(root().join("tests/fixtures/trace"))
        .expect("the folder of traces")
        .map(|entry| entry.expect("an entry").path())
        .collect();
    paths.sort();
    for path in &paths {
        let fixture = trace::load(&std::fs::read_to_string(path).expect("a text")).expect("a trace");
        let text = emitted(&fixture.system, &fixture.sources);
        let outcome = StructuredText::new(&fixture.system, &text).and_then(|mut engine| {
            let compared = trace::compare(&fixture, &mut engine);
            engine.ended.map_or(compared, Err)
        });
        if let Err(error) = outcome {
            let name = path.file_stem().expect("a name").to_string_lossy().into_owned();
            keep(&name, &text.main);
            wrong.push(format!("{name}: {error}"));
            differ.push(name);
        }
    }
    println!("{} traces, {} wrong\n{}", paths.len(), wrong.len(), wrong.join("\n"));
    assert!(differ.is_empty(), "{}", wrong.join("\n\n"));
}

#[test]
fn every_fault_seeded_into_the_default_layout_is_found() {
    let text = of_layout("default").1.main;
    let checked = judge(&text).unwrap_or_else(|findings| panic!("{}", listed(&findings, &text)));
    let rows = faults::seed(&text, &checked, 10, 1);
    println!("{}", faults::table(&rows));
    assert!(rows.iter().all(|row| row.caught == row.seeded), "{}", faults::table(&rows));
}
