//! The generated Rust: how it reads, that it compiles without a warning, that no path leads to a panic,
//! and that it does what the reference executor does.

use autogen::backend::{Files, rust, st};
use autogen::executor::Executor;
use autogen::io_map::IoMap;
use autogen::ir::{Instance, System};
use autogen::layout::Panel;
use autogen::source::Sources;
use autogen_tests::instances::{instantiate, panelled};
use autogen_tests::lots::Lots;
use autogen_tests::replay::{Recording, bits, difference, record, replay, run, silent};
use autogen_tests::workspace::Workspace;
use autogen_tests::{Texts, ariac, many, root};
use runtime_sim::device::Direction;
use runtime_sim::run::{Seen, Stepping, run as simulate};
use std::collections::BTreeSet;
use std::io::{BufRead, BufReader, Write};
use std::process::{Command, Stdio};

/// Names and texts of the fixtures.
fn fixtures() -> Vec<(String, String)> {
    let folder = root().join("tests/fixtures/rust");
    let mut names: Vec<String> = std::fs::read_dir(folder)
        .expect("a folder of fixtures")
        .map(|entry| entry.expect("an entry").file_name().to_string_lossy().into_owned())
        .collect();
    names.sort();
    let text = |name: String| (name.clone(), autogen_tests::text(&format!("tests/fixtures/rust/{name}")));
    names.into_iter().map(text).collect()
}

#[test]
fn fixtures_read_well() {
    for (name, text) in fixtures() {
        let (system, sources) = instantiate(&[(name.clone(), text.clone())]);
        let files = rust::files(&system, &sources);
        let mut shown = text;
        for automaton in &system.model.automata {
            let module = autogen::naming::snake(&automaton.name);
            let path = files
                .keys()
                .find(|path| path.starts_with(&format!("controllers/src/{module}")))
                .expect("its module");
            shown += &format!("\n---- {path}\n{}", files[path]);
        }
        insta::assert_snapshot!(name.trim_end_matches(".aut"), shown);
    }
}

/// All fixtures in one system, of robots and files with odd names.
fn together() -> (System, Sources) {
    let mut files = fixtures();
    for (name, _) in files.iter_mut().filter(|(name, _)| name == "text.aut") {
        *name = "te\u{202e}xt\r\n\t.aut".into();
    }
    let (mut system, sources) = instantiate(&files);
    let names = ["lib", "mod", "self", "crate", "super", "line", "Self", "WIRING", "main", "con"];
    for (instance, name) in system.instances.iter_mut().zip(names) {
        instance.name = name.into();
    }
    (system, sources)
}

/// Names that begin with a capital letter, as those of types and traits, without what is in comments and texts.
fn capital_names<'t>(texts: impl Iterator<Item = &'t str>) -> BTreeSet<&'t str> {
    let code = texts.flat_map(str::lines).filter(|line| !line.trim_start().starts_with("//"));
    let code = code.flat_map(|line| line.split('"').step_by(2));
    let names = code.flat_map(|part| part.split(|c: char| !c.is_ascii_alphanumeric() && c != '_'));
    names.filter(|name| name.starts_with(|c: char| c.is_ascii_uppercase())).collect()
}

/// Those of the Rust of a line.
fn capital_names_of(files: &Files) -> BTreeSet<&str> {
    let is_own = |path: &str| path.starts_with("controllers/") || path.starts_with("adapters/");
    capital_names(
        files.iter().filter(|(path, _)| is_own(path) && path.ends_with(".rs")).map(|(_, text)| text.as_str()),
    )
}

/// No enumeration has the name of a type or of a trait that the Rust of every line uses.
#[test]
fn names_of_all_generated_code_are_given_to_no_enumeration() {
    let (system, sources) = together();
    let fixtures_written = rust::files(&system, &sources);
    let default = ariac("default").compile();
    let project = default.project.expect("a line that is right");
    let default_written = rust::files(&project.system, &default.sources);
    let library = ["conveyor", "agv", "kitting", "gantry", "station", "handover", "devices/gantry"]
        .map(|name| autogen_tests::text(&format!("compiler/library/{name}.aut")));
    let words = library.iter().flat_map(|text| text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_'));
    let of_library: BTreeSet<String> = words.map(autogen::naming::camel).collect();
    let is_constant = |name: &str| name.len() > 1 && !name.contains(|c: char| c.is_ascii_lowercase());
    let in_both = capital_names_of(&fixtures_written);
    let in_both = in_both.intersection(&capital_names_of(&default_written)).copied().collect::<Vec<_>>();
    let is_used = |name: &&str| !of_library.contains(*name) && !is_constant(name) && *name != "Self";
    let used: BTreeSet<&str> =
        in_both.into_iter().filter(is_used).chain(["Sized", "Drop", "Send", "Fn"]).collect();
    assert!(used.contains(&"FnMut") && used.contains(&"Debug"), "{used:?}");

    let enums = used.iter().map(|name| format!("enum {name} {{ {name}First, {name}Second }}\n"));
    let one = fixtures().into_iter().find(|(name, _)| name == "arithmetic.aut").expect("a fixture");
    let (system, sources) = instantiate(&[one, ("used.aut".into(), enums.collect())]);
    let kinds = &rust::files(&system, &sources)["controllers/src/kinds.rs"];
    let given: Vec<&str> =
        used.into_iter().filter(|name| kinds.contains(&format!("pub enum {name} {{"))).collect();
    assert!(given.is_empty(), "{given:?}");
}

/// Of ports without a text only what is known is said.
#[test]
fn ports_without_a_meaning_leave_no_punctuation() {
    let device = "device unit {
            part belt = lane { from: origin; length: 2.0; width: 0.2; speed: 0.1; };
            part feed = source { on: belt; inset: 0.1; };
            part eye = zone { over: belt; middle: point(1, 0, 0); half: 0.3; part_half: 0.05; };
            in sees: bool[Kind] = eye.sees;
            in seen_at: point[Kind] unit \"m\" = eye.foremost;
            out run: bool = belt.run;
        }";
    let automaton = "automaton Unit on unit { local at: point[Kind];
            initial -> Off {}
            state Off { when exists k in Kind: sees[k] and seen_at[k].x > 1 -> On { run := true; } }
            state On { when false -> Off {} } }";
    let texts = Texts {
        layout: r#"{"robots": [{"name": "unit", "type": "unit", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![device.into(), automaton.into()],
        scenario: Some(r#"{"kinds": [{"name": "box", "height": 0.1}], "time_limit_s": 9}"#.into()),
        ..Texts::default()
    };
    let outcome = texts.compile();
    let found = autogen_tests::plain(&outcome.sources, &outcome.diagnostics);
    let project = outcome.project.unwrap_or_else(|| panic!("{found}"));
    let rust = rust::files(&project.system, &outcome.sources);
    let st = st::files(&project.system, &outcome.sources);
    let own = rust.iter().filter(|(path, _)| path.starts_with("controllers/"));
    for (path, text) in own.chain(&st) {
        for wrong in ["(* ,", ": *)", "(* *)", "/// .\n", "/// \n", ": ,", ": ;"] {
            assert!(!text.contains(wrong), "{path}: {wrong}\n{text}");
        }
    }
}

#[test]
fn text_of_the_user_comes_without_what_is_not_shown() {
    let (system, sources) = together();
    for (path, text) in rust::files(&system, &sources) {
        let hidden = |c: &char| c.is_control() && *c != '\n' || ('\u{202a}'..='\u{202e}').contains(c);
        assert_eq!(text.chars().find(hidden), None, "{path}");
    }
}

/// What the executor answers to inputs drawn by lot, of which every transition has fired.
fn executed(system: &System, scans: usize, seed: u64) -> Recording {
    let mut executor = Executor::new(system);
    let recording = record(&mut executor, system, scans, Lots::new(system, seed));
    let silent = silent(system, &executor);
    assert!(silent.is_empty(), "never fired:\n{}", silent.join("\n"));
    recording
}

/// Each by itself: in the line of all of them some robot faults in nearly every scan, and no time passes.
#[test]
fn each_fixture_runs_as_on_the_executor() {
    let mut systems: Vec<_> = fixtures()
        .into_iter()
        .map(|fixture| (instantiate(std::slice::from_ref(&fixture)), fixture.0))
        .collect();
    for (name, text) in fixtures() {
        if matches!(name.as_str(), "sequence.aut" | "stores.aut" | "steps.aut") {
            let title = format!("{name} with panels");
            systems.push((panelled(&[(name, text)], Panel::Machines), title));
        }
    }
    let parts: Vec<_> = systems.iter().map(|((system, sources), _)| (system, sources)).collect();
    let workspace = many::workspace("each_fixture", &parts);
    workspace.cargo(&["build", "--quiet", "-p", "replays"]);
    for (number, ((system, _), name)) in systems.iter().enumerate() {
        // In manual and single step little fires by lot.
        let has_panels = system.model.automata.iter().any(|automaton| automaton.modes.is_some());
        let recording = match has_panels {
            true => record(&mut Executor::new(system), system, 30_000, Lots::new(system, 2)),
            false => executed(system, 30_000, 2),
        };
        let arguments = [number.to_string(), many::parameters(number)];
        let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
        let program = workspace.debug_program("replays");
        let found = run(&program, &arguments, &workspace.folder, &recording.inputs);
        assert_eq!(difference(system, &recording.answers, &found), None, "{name}");
    }
}

/// Lines of which each leaves something out, or has it, that others do not: by themselves, with and without panels.
#[test]
fn small_lines_compile_without_a_warning() {
    let panels = [(Panel::Line, ""), (Panel::Machines, " with panels")];
    let lines = autogen_tests::fixtures("clean", "aut").into_iter().chain(fixtures());
    let lines: Vec<(System, Sources)> = lines
        .flat_map(|line| panels.map(|(panel, _)| panelled(std::slice::from_ref(&line), panel)))
        .collect();
    let parts: Vec<_> = lines.iter().map(|(system, sources)| (system, sources)).collect();
    let workspace = many::workspace("small_lines", &parts);
    let crates = (0..parts.len()).flat_map(|n| [format!("controllers-{n}"), format!("adapters-{n}")]);
    let crates: Vec<String> = crates.flat_map(|name| ["-p".into(), name]).collect();
    let crates: Vec<&str> = crates.iter().map(String::as_str).collect();
    workspace.cargo(&[&["clippy", "--quiet"], &crates[..], &["--", "-D", "warnings"]].concat());
}

/// Descriptions are shown as they stand, and none is a program.
#[test]
fn comments_of_documentation_have_no_mistakes() {
    let mut texts = autogen_tests::fixtures("clean", "aut");
    texts.retain(|(name, _)| name == "descriptions");
    let (system, sources) = panelled(&[texts, fixtures()].concat(), Panel::Machines);
    let workspace = Workspace::write("documentation", &system, &sources);
    for name in ["controllers", "adapters"] {
        workspace.cargo(&["rustdoc", "--quiet", "-p", name, "--lib", "--", "-D", "warnings"]);
    }
    // Programs in comments would be compiled even so.
    let manifest = &rust::files(&system, &sources)["controllers/Cargo.toml"];
    assert!(manifest.contains("doctest = false"));
    workspace.put("controllers/Cargo.toml", &manifest.replace("doctest = false", "doctest = true"));
    workspace.cargo(&["test", "--quiet", "-p", "controllers", "--doc"]);
}

/// Robots and cells of all machines together are larger than the stack of a program: 10 MB each.
#[test]
fn a_long_line_is_deployed_on_an_ordinary_stack() {
    let text = "automaton Long on bin {
        retain all;
        local spots: point[1000];
        shared shown: point[1000];
        initial state Waiting { when spots[7].x < 1 -> Waiting { spots[7] := point(1, 2, 3); shown[7] := spots[7]; } }
    }";
    let (mut system, sources) = instantiate(&[("long.aut".into(), text.into())]);
    let machines = 450;
    let one = system.instances.remove(0);
    let named = |row: usize| Instance { name: format!("long{row}"), rows: vec![row], ..one.clone() };
    system.instances = (0..machines).map(named).collect();
    system.members = vec![(0..machines).collect()];
    let workspace = Workspace::write("long", &system, &sources);
    workspace.cargo(&["build", "--quiet", "-p", "commissioning", "--example", "host"]);
    let host = workspace.debug_program("examples/host");
    let scan = |start: u8| format!("1 {start} 0{}\n", " 0".repeat(machines));
    let found = run(&host, &[], &workspace.folder, &[scan(0), scan(1), scan(1)].concat());
    assert_eq!(found, "0 0\n1 0\n1 0\n0 0\n");
}

/// Outputs of the line, in front of those of its machines.
const SYSTEM: usize = 7;

/// All in one line, with odd names.
#[test]
fn fixtures_run_as_on_the_executor() {
    let (system, sources) = together();
    let workspace = Workspace::write("fixtures", &system, &sources);
    // The simulator, which is always the same, is judged in the workspace of the default line.
    let crates = ["-p", "controllers", "-p", "adapters", "-p", "commissioning", "--no-deps"];
    workspace
        .cargo(&[&["clippy", "--quiet", "--all-targets"], &crates[..], &["--", "-D", "warnings"]].concat());
    workspace.cargo(&["build", "--quiet", "--release", "-p", "commissioning", "--bins", "--examples"]);
    let recording = record(&mut Executor::new(&system), &system, 30_000, Lots::new(&system, 1));

    let found = replay(&workspace.program("commissioning"), &workspace, "parameters.txt", &recording);
    assert_eq!(difference(&system, &recording.answers, &found), None);

    // The constants of the layout make the same controllers as the words.
    let recording = record(&mut Executor::new(&system), &system, 30_000, Lots::powered(&system, 1));
    let host = run(&workspace.program("examples/host"), &[], &workspace.folder, &recording.inputs);
    let outputs: usize = (0..system.instances.len())
        .map(|i| system.automaton_of(i).device.words(Direction::Output, system.kinds()))
        .sum();
    for (scan, (found, wanted)) in host.lines().zip(&recording.answers).enumerate() {
        let words: Vec<f64> = found.split(' ').map(|w| w.parse().expect("a number")).collect();
        let wanted: Vec<&str> = wanted.split(' ').collect();
        let wanted = [&wanted[..1], &wanted[2..3], &wanted[SYSTEM..SYSTEM + outputs]].concat().join(" ");
        assert_eq!(bits(&words), wanted, "scan {scan}");
    }
    refuses_what_are_no_inputs(&workspace, &recording.inputs);
}

/// The host ends with an error, after a scan without permission, and takes nothing of the line.
fn refuses_what_are_no_inputs(workspace: &Workspace, inputs: &str) {
    let started: Vec<String> = (inputs.lines().take(2).zip(["1 0 0", "1 1 0"]))
        .map(|(line, system)| format!("{system}{}\n", &line[system.len()..]))
        .collect();
    let next = started[1].trim_end();
    let images = &next["1 1 0".len()..];
    let first = images.split_whitespace().next().expect("the size of an image");
    let cut = &next[..next.rfind(' ').expect("words")];
    let host = |line: &str| {
        let mut child = Command::new(workspace.program("examples/host"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("a program that can be started");
        let mut stdin = child.stdin.take().expect("a pipe");
        writeln!(stdin, "{}{line}", started.concat()).expect("a program that reads its input");
        drop(stdin);
        let output = child.wait_with_output().expect("a program that ends");
        let lines = String::from_utf8(output.stdout).expect("text");
        (output.status.success(), lines.lines().map(String::from).collect::<Vec<String>>())
    };
    let (is_fine, lines) = host(next);
    assert!(is_fine && lines.len() == 4, "{lines:?}");
    let stopped = format!("0 0 0{images}");
    let (_, wanted) = host(&stopped);
    for (wrong, why) in [
        (String::new(), "nothing"),
        (format!("nan 0 0{images}"), "a permission that is none"),
        (format!("2 0 0{images}"), "a permission that is none"),
        (format!("1 x 0{images}"), "a start that is none"),
        (cut.into(), "a word is missing"),
        ("1 0 0".into(), "all images are missing"),
        (format!("{next} 0"), "a word too many"),
        (
            next.replacen(&format!("0 {first} "), "0 18446744073709551615 ", 1),
            "a size that is not that of the image",
        ),
    ] {
        assert_ne!(wrong, next, "{why}");
        let (is_fine, lines) = host(&wrong);
        assert!(!is_fine, "{why}");
        assert_eq!(lines, wanted[..3], "{why}");
    }
}

#[test]
fn the_line_runs_as_on_the_executor() {
    let outcome = ariac("default").compile();
    let project = outcome.project.expect("a line that is right");
    let workspace = Workspace::write("default", &project.system, &outcome.sources);
    workspace.put("line.txt", &project.plant.to_text());
    workspace.cargo(&["clippy", "--quiet", "--all-targets", "--", "-D", "warnings"]);
    workspace.cargo(&["build", "--quiet", "--release", "-p", "commissioning", "--bins"]);
    let (_, columns) = st::mapped(&project.system, &outcome.sources, &IoMap::default());
    workspace.put("columns.txt", &columns.to_text());
    let hashes = ["--hashes", "hashes.txt"];
    let arguments =
        [&["line.txt", "parameters.txt"], &hashes[..], &["--io-trace", "columns.txt", "trace.csv"]].concat();
    let report = run(&workspace.program("commissioning"), &arguments, &workspace.folder, "");

    let mut hashes = String::new();
    let trace = std::fs::File::open(workspace.folder.join("trace.csv")).expect("the I/O trace");
    let mut trace = BufReader::new(trace);
    let (mut wanted, mut found) = (columns.header(), String::new());
    trace.read_line(&mut found).expect("a line");
    assert_eq!(found, wanted);
    let mut executor = Executor::new(&project.system);
    let observe = &mut |seen: &Seen| {
        hashes += &format!("{:016x}\n", seen.hash);
        wanted.clear();
        found.clear();
        columns.row(seen, &mut wanted);
        trace.read_line(&mut found).expect("a line");
        assert_eq!(found, wanted, "scan {}", seen.scan);
    };
    let expected = simulate(&project.plant, &mut executor, Stepping::EveryScan, observe)
        .expect("a line that can be run");
    assert_eq!(trace.read_line(&mut found).expect("the end"), 0);
    let found = std::fs::read_to_string(workspace.folder.join("hashes.txt")).expect("the hashes");
    for (scan, (found, wanted)) in found.lines().zip(hashes.lines()).enumerate() {
        assert_eq!(found, wanted, "scan {scan}");
    }
    assert_eq!(report.trim_end(), expected.to_json());
    assert_eq!(found.len(), hashes.len());
    debug_gives_the_same(&workspace, &found, &report);
    links_without_a_panic(&workspace);
    workspace.put("controllers/examples/document.rs", &program_of_the_document());
    workspace.cargo(&["check", "--quiet", "-p", "controllers", "--example", "document"]);
    workspace.put("controllers/tests/restore.rs", RESTORE);
    workspace.cargo(&["test", "--quiet", "-p", "controllers", "--test", "restore"]);
    workspace.put("adapters/tests/images.rs", IMAGES);
    workspace.cargo(&["test", "--quiet", "-p", "adapters", "--test", "images"]);
}

/// The program that is not optimized, in which an overflow panics, against hashes and report of the one for release.
fn debug_gives_the_same(workspace: &Workspace, hashes: &str, report: &str) {
    workspace.cargo(&["build", "--quiet", "-p", "commissioning", "--bins"]);
    let arguments = ["line.txt", "parameters.txt", "--hashes", "hashes_of_debug.txt"];
    let found = run(&workspace.debug_program("commissioning"), &arguments, &workspace.folder, "");
    assert_eq!(found, report);
    let found = std::fs::read_to_string(workspace.folder.join("hashes_of_debug.txt")).expect("the hashes");
    assert!(found == hashes, "debug and release differ");
}

/// What docs/rust.md shows, with an end.
fn program_of_the_document() -> String {
    let text = std::fs::read_to_string("../docs/rust.md").expect("the document");
    let program = text.split("```rust\n").nth(1).and_then(|rest| rest.split("```").next());
    format!("#![allow(dead_code)]\n{}\nfn main() {{}}\n", program.expect("a program"))
}

/// Words that are not those of the line, or of no scan of it: it begins with initial values and a fault, or with words
/// that it would write itself.
const RESTORE: &str = r#"use controllers::cells::{Cells, Wiring};
use controllers::line;
use controllers::retained::{UNCHECKED, check, check_word};
use controllers::robot::Robot;
use controllers::system::{NOT_RETAINED, System, SystemInputs};

/// A line that was restored from words, if there are any.
struct Line<'a> {
    system: System,
    robots: Vec<Robot<'static>>,
    cells: Cells<'a>,
    scans: usize,
}

impl<'a> Line<'a> {
    fn new(memory: &'a mut line::Memory) -> Self {
        Self { system: System::new(), robots: line::robots().into(), cells: memory.cells(), scans: 0 }
    }

    fn restore(&mut self, wiring: &Wiring, words: &[f64]) {
        let mut rest = words.iter().copied();
        self.system.restore(wiring, &mut self.robots, &mut self.cells, &mut || rest.next());
        self.scans = 0;
    }

    /// Some scans with `start`: whether there was the fault.
    fn run(&mut self, scans: usize) -> bool {
        let mut is_lost = false;
        for _ in 0..scans {
            let inputs = SystemInputs { run_permit: true, start: self.scans > 0, reset: false };
            let answer = self.system.scan(inputs, &line::WIRING, &mut self.robots, &mut self.cells);
            self.scans += 1;
            is_lost |= answer.fault_code == NOT_RETAINED;
            assert!(!is_lost || !answer.running);
        }
        is_lost
    }

    fn words(&self) -> Vec<f64> {
        let mut found = Vec::new();
        self.system.retain(&line::WIRING, &self.robots, &self.cells, &mut |word| found.push(word));
        found
    }

    fn shown(&self) -> String {
        format!("{:?} {:?} {:?}", self.system, self.robots, self.cells)
    }
}

/// The words after some scans with `start`, and whether there was the fault, of a line that began with words.
fn after(words: Option<&[f64]>, scans: usize) -> (Vec<f64>, bool) {
    let mut memory = line::Memory::NEW;
    let mut line = Line::new(&mut memory);
    if let Some(words) = words {
        line.restore(&line::WIRING, words);
    }
    let is_lost = line.run(scans);
    (line.words(), is_lost)
}

/// Words with the check that belongs to them.
fn checked(mut words: Vec<f64>) -> Vec<f64> {
    words.pop();
    let sum = words.iter().fold(UNCHECKED, |sum, word| check(sum, *word));
    words.push(check_word(sum));
    words
}

/// The words of a line that begins with the fault.
fn lost() -> Vec<f64> {
    let mut words = after(None, 1).0;
    words[1] = f64::from(NOT_RETAINED);
    checked(words)
}

fn refused(words: &[f64], why: &str) {
    assert_eq!(after(Some(words), 1), (lost(), true), "{why}");
    after(Some(words), 50);
}

/// Its own words, in which a machine that begins anew is in its beginning.
fn own() -> Vec<f64> {
    let (kept, is_lost) = after(None, 50);
    assert!(!is_lost && kept.len() > 200, "{}", kept.len());
    let own = after(Some(&kept), 1).0;
    assert!(own != kept && own.len() == kept.len());
    own
}

#[test]
fn words_of_another_line_are_not_taken() {
    let own = own();
    assert_eq!(after(Some(&own), 1), (own.clone(), false), "its own words");
    for length in 1..own.len() {
        refused(&own[..length], &format!("{length} words"));
    }
    refused(&[&own[..], &[0.0]].concat(), "a word too many");
    let mut taken = 0;
    for at in 0..own.len() {
        for wrong in [f64::NAN, f64::INFINITY, 0.5, -1.0, 99.0, 70_000.0, 3e9, 1e300] {
            let mut words = own.clone();
            if words[at] == wrong {
                continue;
            }
            words[at] = wrong;
            refused(&words, &format!("word {at} is {wrong}"));
            if at + 1 == own.len() {
                continue;
            }
            // As if it had been retained so.
            let words = checked(words);
            let (found, is_lost) = after(Some(&words), 1);
            assert!(is_lost || wrong.is_finite(), "word {at} is {wrong}");
            if !is_lost {
                taken += 1;
                assert_eq!(found, after(Some(&found), 1).0, "word {at} is {wrong}");
                // It may run into a fault, and never panics.
                after(Some(&words), 50);
            }
        }
    }
    // Of a value that fits nobody knows whether it was that.
    assert!(taken > 0);
}

#[test]
fn words_of_two_scans_are_not_taken() {
    let (earlier, later) = (after(None, 1).0, after(None, 50).0);
    assert!(earlier.iter().zip(&later).filter(|(a, b)| a != b).count() > 5);
    for at in 0..=earlier.len() {
        let torn = [&earlier[..at], &later[at..]].concat();
        match torn == earlier || torn == later {
            true => assert!(!after(Some(&torn), 1).1, "torn at {at}"),
            false => refused(&torn, &format!("torn at {at}")),
        }
    }
}

#[test]
fn words_of_another_layout_are_not_taken() {
    let own = own();
    let other = Wiring { retained_of: line::WIRING.retained_of + 1, ..line::WIRING };
    let mut memory = line::Memory::NEW;
    let mut line = Line::new(&mut memory);
    line.restore(&other, &own);
    assert!(line.run(1));
}

#[test]
fn where_nothing_was_retained_all_is_as_at_first() {
    let fresh = (after(None, 1).0, false);
    let blank = vec![0.0; fresh.0.len()];
    assert_eq!(after(Some(&[]), 1), fresh);
    assert_eq!(after(Some(&blank), 1), fresh);
    refused(&blank[1..], "too few zeros");
    refused(&[&blank[..], &[0.0]].concat(), "too many zeros");
    for at in 1..blank.len() {
        let mut words = blank.clone();
        words[at] = 1.0;
        refused(&words, &format!("one at {at}"));
    }
}

#[test]
fn whatever_happened_before_does_not_count() {
    for words in [own(), Vec::new(), vec![1.0]] {
        let (mut fresh, mut used) = (line::Memory::NEW, line::Memory::NEW);
        let (mut fresh, mut used) = (Line::new(&mut fresh), Line::new(&mut used));
        let first = used.shown();
        used.run(77);
        assert_ne!(used.shown(), first);
        fresh.restore(&line::WIRING, &words);
        used.restore(&line::WIRING, &words);
        assert_eq!(used.shown(), fresh.shown());
    }
}
"#;

/// A scan with an image of another size is none.
const IMAGES: &str = r#"#![allow(unsafe_code)]

use adapters::c_interface::{Image, Inputs, Outputs, autogen_close, autogen_open, autogen_scan, autogen_trace};

#[test]
fn images_of_another_size_are_refused() {
    let text = include_str!("../../parameters.txt");
    let mut message = [0; 200];
    let mut length = 0;
    let session =
        unsafe { autogen_open(text.as_ptr(), text.len(), message.as_mut_ptr(), message.len(), &mut length) };
    assert!(!session.is_null());
    let layout = adapters::layout::Layout::compiled();
    let mut image = Vec::new();
    let sizes: Vec<[usize; 2]> = (layout.robots.iter())
        .map(|robot| {
            adapters::layout::publish(robot, false, &mut image);
            [adapters::layout::input_words(robot), image.len()]
        })
        .collect();
    let trace = || {
        let mut words = vec![0.0; 100_000];
        let count = unsafe { autogen_trace(session, words.as_mut_ptr(), words.len()) };
        words.truncate(count);
        words
    };
    let scan = |sizes: &[[usize; 2]]| {
        let mut words: Vec<[Vec<f64>; 2]> = sizes.iter().map(|size| size.map(|size| vec![0.0; size])).collect();
        let mut images = |which: usize| -> Vec<Image> {
            words.iter_mut().map(|of| Image { words: of[which].as_mut_ptr(), count: of[which].len() }).collect()
        };
        let (inputs, outputs) = (images(0), images(1));
        let mut answer = Outputs { fault_code: -5, ..Outputs::default() };
        let system = Inputs { run_permit: 1, start: 0, reset: 0 };
        let wrong = unsafe {
            autogen_scan(session, system, inputs.as_ptr(), outputs.as_ptr(), sizes.len(), &mut answer)
        };
        (wrong, answer.fault_code)
    };
    assert_eq!(scan(&sizes), (0, 0));
    let before = trace();
    for (robot, which) in (0..sizes.len()).flat_map(|robot| [(robot, 0), (robot, 1)]) {
        for size in [0, sizes[robot][which] + 1] {
            let mut wrong = sizes.clone();
            wrong[robot][which] = size;
            let expected = if size == sizes[robot][which] { (0, 0) } else { (robot + 1, -5) };
            assert_eq!(scan(&wrong), expected, "robot {robot}, image {which} of {size} words");
        }
    }
    assert_eq!(scan(&sizes[1..]).0, 1);
    assert_eq!(scan(&sizes[..sizes.len() - 1]), (sizes.len(), -5));
    assert_eq!(scan(&[&sizes[..], &[[0, 0]]].concat()), (sizes.len() + 1, -5));
    assert_eq!(trace(), before);
    unsafe { autogen_close(session) };
}
"#;

/// A program for a controller without an operating system, whose panic handler does not exist.
const BARE: &str = r#"#![no_std]
#![no_main]

use controllers::line;
use controllers::system::{System, SystemInputs};

unsafe extern "C" {
    fn there_is_a_path_to_a_panic() -> !;
}

#[panic_handler]
fn panic(_: &core::panic::PanicInfo) -> ! {
    unsafe { there_is_a_path_to_a_panic() }
}

#[unsafe(no_mangle)]
pub extern "C" fn _start() -> ! {
    let mut memory = line::Memory::NEW;
    let mut cells = memory.cells();
    let mut robots = line::robots();
    let mut system = System::new();
    loop {
        let read = |at: usize| unsafe { core::ptr::read_volatile((0x4000_0000 + at) as *const u32) } != 0;
        let inputs = SystemInputs { run_permit: read(0), start: read(4), reset: read(8) };
        let answer = system.scan(inputs, &line::WIRING, &mut robots, &mut cells);
        unsafe { core::ptr::write_volatile(0x4000_0010 as *mut i32, answer.fault_code) };
    }
}
"#;

const BARE_MANIFEST: &str = r#"[package]
name = "bare"
version = "0.1.0"
edition = "2024"

[workspace]

[dependencies]
controllers = { path = "../controllers" }

[profile.release]
opt-level = 2
lto = true
panic = "abort"
overflow-checks = false
"#;

fn links_without_a_panic(workspace: &Workspace) {
    workspace.put("bare/Cargo.toml", BARE_MANIFEST);
    workspace.put("bare/src/main.rs", BARE);
    for (level, lto) in [("1", "false"), ("2", "true"), ("3", "false"), ("\"s\"", "false"), ("\"z\"", "true")]
    {
        let manifest = BARE_MANIFEST.replace("opt-level = 2", &format!("opt-level = {level}"));
        workspace.put("bare/Cargo.toml", &manifest.replace("lto = true", &format!("lto = {lto}")));
        workspace.cargo(&[
            "rustc",
            "--quiet",
            "--release",
            "--manifest-path",
            "bare/Cargo.toml",
            "--target",
            "thumbv7em-none-eabihf",
        ]);
    }
}

#[test]
fn no_path_of_the_fixtures_leads_to_a_panic() {
    let (system, sources) = together();
    links_without_a_panic(&Workspace::write("bare", &system, &sources));
}
