//! SPIN counts the states of small lines too: a search of its own on the same models.

use autogen::lower::Project;
use autogen::verify::{Asked, model};
use autogen_search::explore::{Bounds, Covered, End, explore};
use autogen_search::model::Model;
use autogen_search::plant::Faults;
use autogen_search::promela::promela;
use autogen_search::successor::Orders;
use autogen_search::unread::Unread;
use autogen_tests::{Texts, is_full_campaign, text};
use std::path::Path;
use std::process::Command;

/// Whether SPIN and a C compiler can be called; in a run of CI they have to be.
fn has_judge() -> bool {
    let can = |program: &str, option: &str| {
        Command::new(program).arg(option).output().is_ok_and(|o| o.status.success())
    };
    let answers = can("spin", "-V") && can("gcc", "--version");
    let is_required = std::env::var("AUTOGEN_JUDGES").is_ok_and(|judges| judges == "required");
    assert!(answers || !is_required, "`spin` or `gcc` is not installed: see .ci/run");
    if !answers {
        println!("skipped: `spin` or `gcc` is not installed (Debian: spin, gcc)");
    }
    answers
}

/// Seconds that processors have worked for this process, and for those that it has called; 0 if the system does not say.
fn processor_time() -> (f64, f64) {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields: Vec<&str> = stat.rsplit(')').next().unwrap_or_default().split_whitespace().collect();
    let ticks = |field: usize| fields.get(field).and_then(|ticks| ticks.parse::<f64>().ok()).unwrap_or(0.0);
    // Times of the user, in hundredths.
    (ticks(11) / 100.0, ticks(13) / 100.0)
}

/// States and transitions, as SPIN counts them: every transition leads to a state that is new or known, and the first
/// state is one more; and the seconds of its processor. No sequence may have so many `steps`, for which it takes memory
/// before it begins: there it goes no farther, and counts that as no error.
fn counted_by_spin(folder: &Path, text: &str, steps: usize) -> (usize, u64, f64) {
    std::fs::write(folder.join("line.pml"), text).expect("a folder that can be written");
    let call = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).current_dir(folder).output().expect(program);
        let said = String::from_utf8_lossy(&output.stdout).into_owned();
        assert!(output.status.success(), "{program}: {said}{}", String::from_utf8_lossy(&output.stderr));
        said
    };
    call("spin", &["-a", "line.pml"]);
    call("gcc", &["-O2", "-w", "-DSAFETY", "-DNOREDUCE", "-DVECTORSZ=4096", "-o", "pan", "pan.c"]);
    let before = processor_time().1;
    let said = call(folder.join("pan").to_str().expect("a path"), &[&format!("-m{steps}"), "-w22"]);
    let seconds = processor_time().1 - before;
    let number = |what: &str| -> u64 {
        let line = said.lines().find(|line| line.contains(what)).unwrap_or_else(|| panic!("{what}: {said}"));
        line.split_whitespace().next().and_then(|word| word.parse().ok()).expect("a number")
    };
    assert!(said.contains("errors: 0"), "{said}");
    let depth = said.split("depth reached ").nth(1).and_then(|rest| rest.split(',').next());
    let depth: usize = depth.and_then(|depth| depth.parse().ok()).unwrap_or_else(|| panic!("{said}"));
    assert!(depth < steps, "{said}");
    (number("states, stored") as usize, number("transitions (=") - 1, seconds)
}

fn line(file: &str, types: &[&str]) -> Texts {
    let robots: Vec<String> = types
        .iter()
        .enumerate()
        .map(|(number, of)| {
            let y = 3 * number;
            format!(
                r#"{{"name": "v{number}", "type": "{of}", "pose": [0, {y}, 0], "destinations": [[5, {y}, 0], [10, {y}, 0]]}}"#
            )
        })
        .collect();
    Texts {
        layout: format!("{{\"robots\": [{}]}}", robots.join(",\n")),
        specs: vec![text(&format!("tests/fixtures/verify/{file}.aut"))],
        ..Texts::default()
    }
}

const BOUNDS: Bounds = Bounds {
    answers: None,
    orders: Orders::One,
    time: None,
    memory: 4_000_000_000,
    states: usize::MAX,
    violations: 1,
    jobs: 1,
};

/// A model in which nothing is forgotten: what has to be known turns out in a search of its own.
fn remembering(project: &Project, faults: Faults) -> Model {
    let model = model(project, &Asked::with(faults)).expect("a line that can be searched").model;
    Model { unread: Unread::default(), ..model }
}

/// What both count, and the seconds that the processor worked for each.
fn counted_by_both(name: &str, model: &Model) -> (Covered, [f64; 2]) {
    let before = processor_time().0;
    let outcome = explore(model, &BOUNDS, &mut |_| true);
    let own = processor_time().0 - before;
    assert_eq!(outcome.end, End::Complete);
    let folder = std::env::temp_dir().join(format!("autogen-spin-{}-{name}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder that can be made");
    let text = promela(model).expect("a model that SPIN can count");
    // No state comes twice in a sequence; between two states there are steps of each process.
    let steps = 100_000 + 30 * outcome.covered.states;
    let (states, transitions, seconds) = counted_by_spin(&folder, &text, steps);
    assert_eq!((outcome.covered.states, outcome.covered.transitions), (states, transitions), "{name}");
    std::fs::remove_dir_all(&folder).expect("a folder that can be removed");
    (outcome.covered, [own, seconds])
}

#[test]
fn states_and_transitions_are_those_that_spin_counts() {
    if !has_judge() {
        return;
    }
    let lines: [(&[&str], Faults); 7] = [
        (&["doubter"], Faults::All),
        (&["doubter", "doubter"], Faults::None),
        (&["doubter", "doubter"], Faults::All),
        (&["gate", "shuttle"], Faults::All),
        (&["gate", "shuttle", "shuttle"], Faults::All),
        (&["shuttle", "gate", "shuttle", "shuttle"], Faults::None),
        (&["shuttle", "gate", "shuttle", "doubter"], Faults::All),
    ];
    for (number, (types, faults)) in lines.into_iter().enumerate() {
        let project = line("shuttles", types).project();
        let model = remembering(&project, faults);
        let (covered, _) = counted_by_both(&number.to_string(), &model);
        println!(
            "{types:?}, faults {faults:?}: {} states, {} transitions",
            covered.states, covered.transitions
        );
    }
}

/// The long form has 900,000 states, and prints how many transitions in a second both searches make.
#[test]
fn many_states_are_those_that_spin_counts() {
    if !has_judge() {
        return;
    }
    let trips = if is_full_campaign() { 29 } else { 3 };
    let project = line("laps", &["lap"; 4]).set(&format!("lap.trips={trips}")).project();
    let model = remembering(&project, Faults::None);
    let (one, seconds) = counted_by_both("laps", &model);
    let two = explore(&model, &Bounds { jobs: 2, ..BOUNDS }, &mut |_| true).covered;
    assert_eq!((two.states, two.transitions), (one.states, one.transitions));
    let [own, spin] = seconds.map(|seconds| one.transitions as f64 / seconds / 1e6);
    println!("{} states, {} transitions", one.states, one.transitions);
    println!("millions of transitions in a second of one processor: {own:.2}, SPIN {spin:.2}");
    println!("by the clock: {:.2?} with one processor, {:.2?} with two", one.time, two.time);
}
