//! The I/O trace is enough to drive the emitted text and to compare it: nothing else is known here of a line
//! than its files.

use autogen::backend::st;
use autogen::executor::Executor;
use autogen::io_map::IoMap;
use autogen_st_judge::machine::{Machine, Place};
use autogen_tests::{Texts, ariac, examples, is_full_campaign, on_all_processors, text};
use runtime_sim::line::{Pause, Scenario};
use runtime_sim::run::{Seen, Stepping, run};

/// A text that follows a trace row by row.
struct Driven {
    machine: Machine,
    names: Vec<String>,
    places: Vec<Place>,
    is_input: Vec<bool>,
    /// Globals without a column, with what they were after the first scan.
    silent: Vec<(String, u64)>,
    scans: u64,
    /// Of the whole trace.
    bytes: usize,
    values: u64,
    difference: Option<String>,
}

impl Driven {
    /// With the text of `portable/main.st`, of `io.csv`, and the header of the trace.
    fn new(text: &str, io: &str, header: &str) -> Self {
        let machine = Machine::new(text).expect("a clean text");
        let names: Vec<String> = header.trim_end().split(',').map(String::from).collect();
        let points: Vec<Vec<&str>> =
            io.lines().skip(1).map(|line| line.split(',').take(3).collect()).collect();
        for point in &points {
            assert!(names.iter().any(|name| name == point[1]), "{} has no column", point[1]);
        }
        let is_input = (names.iter())
            .map(|name| points.iter().any(|point| point[1] == name && point[2] == "input"))
            .collect();
        let place = |name: &String| machine.place(name).unwrap_or_else(|| panic!("no `{name}` in the text"));
        let places = names.iter().map(place).collect();
        Self {
            machine,
            names,
            places,
            is_input,
            silent: Vec::new(),
            scans: 0,
            bytes: header.len(),
            values: 0,
            difference: None,
        }
    }

    /// As `docs/io-trace.md` says. In rows without power all values but inputs are those of the row before.
    fn follow(&mut self, row: &str, power_offs: &[Pause]) {
        let is_off = power_offs.iter().any(|off| off.at_scan < self.scans && self.scans < off.end());
        if power_offs.iter().any(|off| off.end() == self.scans) {
            self.machine.power_up();
        }
        let values: Vec<f64> = row.trim_end().split(',').map(|v| v.parse().expect("a number")).collect();
        assert_eq!(values.len(), self.names.len());
        self.bytes += row.len();
        for (i, value) in values.iter().enumerate().filter(|(i, _)| self.is_input[*i]) {
            self.machine.write(self.places[i], *value);
        }
        if !is_off {
            self.machine.scan().unwrap_or_else(|error| panic!("scan {}: {error}", self.scans));
        }
        for (i, value) in values.iter().enumerate().filter(|(i, _)| !self.is_input[*i]) {
            let found = self.machine.read(self.places[i]);
            self.values += 1;
            if found.to_bits() != value.to_bits() && self.difference.is_none() {
                let (scan, name) = (self.scans, &self.names[i]);
                self.difference = Some(format!("scan {scan}: {name} is {value:?}, in the text {found:?}"));
            }
        }
        if self.scans == 0 {
            let globals = self.machine.globals().into_iter().filter(|name| !self.names.contains(name));
            self.silent = globals.map(|name| (name.clone(), self.machine.get(&name).to_bits())).collect();
        }
        self.scans += 1;
    }
}

/// Orders of an example in the short form, but for the one of which the document tells the size.
const MOST_ORDERS: usize = 2;

fn driven((name, texts): &(String, Texts)) -> Driven {
    let is_whole = is_full_campaign() || name == "default";
    driven_by(name, texts, |scenario| {
        if !is_whole {
            scenario.orders.truncate(MOST_ORDERS);
        }
    })
}

fn driven_by(name: &str, texts: &Texts, change: impl FnOnce(&mut Scenario)) -> Driven {
    let outcome = texts.compile();
    let mut project = outcome.project.unwrap_or_else(|| panic!("{name}: a line that is right"));
    change(&mut project.plant.scenario);
    let power_offs = &project.plant.scenario.power_offs;
    let files = st::files(&project.system, &outcome.sources);
    let (_, columns) = st::mapped(&project.system, &outcome.sources, &IoMap::default());
    let mut driven = Driven::new(&files["portable/main.st"], &files["io.csv"], &columns.header());
    let mut row = String::new();
    let mut observe = |seen: &Seen| {
        row.clear();
        columns.row(seen, &mut row);
        driven.follow(&row, power_offs);
    };
    run(&project.plant, &mut Executor::new(&project.system), Stepping::EveryScan, &mut observe)
        .expect("a line that can be run");
    driven
}

#[test]
fn the_text_follows_the_trace_of_every_example() {
    let examples = examples();
    for ((name, _), driven) in examples.iter().zip(on_all_processors(&examples, driven)) {
        println!("{name}: {} scans, {} values compared", driven.scans, driven.values);
        assert_eq!(driven.difference, None, "{name}");
        // A controller of a process may scan once a second.
        assert!(driven.scans > 300, "{name}");
        if name == "default" {
            let (thousands, rest, megabytes) =
                (driven.scans / 1000, driven.scans % 1000, driven.bytes / 1_000_000);
            let size = format!("{thousands},{rest:03} lines and {megabytes} MB for the default line");
            assert!(text("docs/io-trace.md").contains(&size), "docs/io-trace.md: {size}");
        }
        // The number of the scan is that of the row.
        for (global, first) in driven.silent.iter().filter(|(global, _)| global != "scan_no") {
            let now = driven.machine.get(global).to_bits();
            assert_eq!(now, *first, "{name}: `{global}` changes and has no column");
        }
    }
}

#[test]
fn the_text_follows_a_trace_with_losses_of_power() {
    let power_offs = [(3000, 500), (9001, 1), (15_000, 2)].map(|(at_scan, scans)| Pause { at_scan, scans });
    let driven = driven_by("default", &ariac("default"), |scenario| scenario.power_offs = power_offs.into());
    assert_eq!(driven.difference, None);
    assert!(driven.scans > 20_000, "{}", driven.scans);
    assert_eq!(driven.machine.get("warm_start"), 1.0);
}
