//! What a run has found, given to the next process as words.

use autogen::executor::Executor;
use autogen::lower::Project;
use autogen_tests::examples;
use runtime_sim::line::Line;
use runtime_sim::memory::Memory;
use runtime_sim::report::Report;
use runtime_sim::run::{Stepping, run_again};
use std::collections::BTreeSet;

/// Those in which a path is planned first.
const EXAMPLES: [&str; 4] = ["default", "spaced", "tending", "lathe"];

fn project(example: &str) -> Project {
    let found = examples().into_iter().find(|(name, _)| name == example);
    found.expect("an example").1.project()
}

fn run(project: &Project, memory: &mut Memory) -> Report {
    let mut executor = Executor::new(&project.system);
    run_again(&project.plant, &mut executor, Stepping::Events, memory, &mut |_| {}).expect("a run")
}

/// A question, and the joints on the path.
type Path = (Vec<u64>, Vec<Vec<u64>>);

/// What stands in stored words: the paths of each machine, and the answers about contact, in any order.
#[derive(Debug, PartialEq)]
struct Found {
    paths: Vec<BTreeSet<Path>>,
    answers: [BTreeSet<[u64; 3]>; 2],
}

impl Found {
    fn read(words: &[u64]) -> Self {
        let mut words = words.iter().copied();
        let mut next = move || words.next().expect("a word");
        let paths = (0..next()).map(|_| {
            let path = |next: &mut dyn FnMut() -> u64| {
                let mut list = || -> Vec<u64> { (0..next()).map(|_| next()).collect() };
                let question = list();
                let count = next();
                (question, (0..count).map(|_| (0..next()).map(|_| next()).collect()).collect())
            };
            (0..next()).map(|_| path(&mut next)).collect()
        });
        let paths = paths.collect();
        let answers = [0; 2].map(|_| (0..next()).map(|_| [0; 3].map(|_| next())).collect());
        Self { paths, answers }
    }

    fn words(&self) -> Vec<u64> {
        let count = |len: usize| len as u64;
        let mut words = vec![count(self.paths.len())];
        for paths in &self.paths {
            words.push(count(paths.len()));
            for (question, knots) in paths {
                words.push(count(question.len()));
                words.extend(question);
                words.push(count(knots.len()));
                for joints in knots {
                    words.push(count(joints.len()));
                    words.extend(joints);
                }
            }
        }
        for answers in &self.answers {
            words.push(count(answers.len()));
            words.extend(answers.iter().flatten());
        }
        words
    }
}

#[test]
fn a_run_with_what_another_process_has_found_is_the_same_and_finds_nothing_new() {
    for example in EXAMPLES {
        let project = project(example);
        let mut memory = Memory::default();
        let first = run(&project, &mut memory);
        let found = Found::read(&memory.stored());
        let mut restored = Memory::restored(&project.plant, &memory.stored()).expect("its own words");
        assert_eq!(run(&project, &mut restored), first, "{example}");
        assert_eq!(Found::read(&restored.stored()), found, "{example}");
        assert!(!found.answers[0].is_empty(), "{example}");
        assert!(
            EXAMPLES[..2].contains(&example) == found.paths.iter().any(|paths| !paths.is_empty()),
            "{example}"
        );
    }
}

/// Else the run would be the same only because it finds everything out again.
#[test]
fn what_was_found_is_believed() {
    let project = project(EXAMPLES[0]);
    let mut memory = Memory::default();
    let first = run(&project, &mut memory);
    let mut found = Found::read(&memory.stored());
    for paths in &mut found.paths {
        *paths = std::mem::take(paths).into_iter().map(|(question, _)| (question, Vec::new())).collect();
    }
    let mut nowhere = Memory::restored(&project.plant, &found.words()).expect("words");
    assert_ne!(run(&project, &mut nowhere).trace_hash, first.trace_hash);
}

#[test]
fn other_words_are_no_memory() {
    let project = project(EXAMPLES[0]);
    let mut memory = Memory::default();
    run(&project, &mut memory);
    let words = memory.stored();
    let is_memory = |words: &[u64]| Memory::restored(&project.plant, words).is_some();
    assert!(is_memory(&words));
    assert!(!is_memory(&[]));
    assert!(!is_memory(&words[..words.len() - 1]));
    assert!(!is_memory(&[&words[..], &[0]].concat()));
    assert!(!is_memory(&[&[u64::MAX], &words[1..]].concat()));
    assert!(!is_memory(&[&words[..2], &[u64::MAX], &words[3..]].concat()));
}

#[test]
fn the_text_says_where_things_are_and_not_what_controllers_do() {
    let plant = project(EXAMPLES[0]).plant;
    let text = Memory::text_of(&plant);
    let with = |change: fn(&mut Line)| {
        let mut plant = plant.clone();
        change(&mut plant);
        Memory::text_of(&plant)
    };
    assert_eq!(with(|line| line.scan_ms = 20), text);
    assert_eq!(with(|line| line.machines[0].states.clear()), text);
    assert_ne!(with(|line| line.machines[0].pose.x += 1e-12), text);
    assert_ne!(with(|line| line.obstacles.clear()), text);
    assert_ne!(with(|line| line.kinds[0].height += 1e-12), text);
}
