//! The small lines of `examples/scenes`: each is run, and told as a story of what changes when.

use autogen::backend::st;
use autogen::executor::Executor;
use autogen::io_map::IoMap;
use autogen_tests::{scenes, text};
use runtime_sim::io_trace::Columns;
use runtime_sim::line::Line;
use runtime_sim::memory::Memory;
use runtime_sim::run::{Seen, Stepping, run_again};
use std::fmt::Write;

/// A scene is read in a few minutes.
const MOST_LINES: usize = 120;

/// What changes in each scan, but for times in states.
struct Story<'a> {
    line: &'a Line,
    columns: Columns,
    names: Vec<String>,
    last: Vec<String>,
    text: String,
}

impl<'a> Story<'a> {
    fn new(line: &'a Line, columns: Columns) -> Self {
        let names = columns.header().trim_end().split(',').map(str::to_string).collect();
        Self { line, columns, names, last: Vec::new(), text: String::new() }
    }

    fn take(&mut self, seen: &Seen) {
        let mut row = String::new();
        self.columns.row(seen, &mut row);
        let row: Vec<String> = row.trim_end().split(',').map(str::to_string).collect();
        let is_told =
            |i: &usize| !self.names[*i].ends_with(".elapsed") && self.last.get(*i) != Some(&row[*i]);
        let changed: Vec<String> = (0..row.len())
            .filter(is_told)
            .map(|i| {
                if is_state(&self.names[i]) {
                    self.state(i, &row[i])
                } else {
                    format!("{} {}", self.names[i], row[i])
                }
            })
            .collect();
        if !changed.is_empty() {
            let seconds = (seen.scan * u64::from(self.line.scan_ms)) as f64 / 1000.0;
            let _ = writeln!(self.text, "{seconds:10.3} s  {}", changed.join(", "));
        }
        self.last = row;
    }

    /// The columns of the states are in the order of the machines. Their names are not always the machines' own: `left` is
    /// a function of Structured Text.
    fn state(&self, column: usize, number: &str) -> String {
        let machine = self.names[..column].iter().filter(|name| is_state(name)).count();
        let machine = &self.line.machines[machine];
        let number: usize = number.parse().expect("the number of a state");
        format!("{} -> {}", machine.name, machine.states[number].name)
    }
}

fn is_state(column: &str) -> bool {
    column.ends_with(".state")
}

#[test]
fn each_scene_is_short_and_does_what_its_story_says() {
    for (name, texts) in scenes() {
        let files =
            [".json", ".aut", ".scenario.json"].map(|end| text(&format!("examples/scenes/{name}{end}")));
        let lines: usize = files.iter().map(|file| file.lines().count()).sum();
        assert!(lines <= MOST_LINES, "{name} has {lines} lines");

        let outcome = texts.compile();
        let project = outcome.project.unwrap_or_else(|| panic!("{name}: {:?}", outcome.diagnostics));
        let (_, columns) = st::mapped(&project.system, &outcome.sources, &IoMap::default());
        let mut story = Story::new(&project.plant, columns);
        let mut executor = Executor::new(&project.system);
        let mut observer = |seen: &Seen| story.take(seen);
        let memory = &mut Memory::default();
        let report = run_again(&project.plant, &mut executor, Stepping::Checked, memory, &mut observer);
        let report = report.expect("a line that can be run");
        let end = format!("{:10.3} s  {}\n", report.simulated_s, report.reason);
        insta::assert_snapshot!(name, story.text + &end);
    }
}
