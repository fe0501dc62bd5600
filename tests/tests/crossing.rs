//! Two loops of vehicles that share a passage: throughput as a second program has it, and never two in the passage.

use autogen::backend::st;
use autogen::executor::Executor;
use autogen::io_map::IoMap;
use autogen_tests::{Texts, on_all_processors, side_by_side};
use runtime_sim::io_trace::Source;
use runtime_sim::memory::Memory;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, run_again};
use std::collections::HashMap;

/// A loop: its letter, its keys, how long a vehicle alone takes for it, s.
const LOOPS: [(&str, &str, f64); 2] = [
    ("a", r#""side": -1, "far": 11, "low": 3"#, 36.0 / 1.5 + 24.0 + 2.0 * 1.5 / 0.5),
    ("b", r#""side": 1, "far": 15, "low": 7"#, 52.0 / 1.5 + 24.0 + 2.0 * 1.5 / 0.5),
];
/// Where vehicles stand behind the loading place at the start, m.
const BEHIND: [f64; 6] = [0.0, 0.0, 1.9, 3.4, 4.9, 6.4];

/// The example with so many vehicles on each loop; they begin one after another, evenly over a lap.
fn with_vehicles(vehicles: [usize; 2], seconds: u32) -> Texts {
    let mut texts = side_by_side("crossing/crossing");
    let mut robots = Vec::new();
    for ((letter, keys, lap), count) in LOOPS.into_iter().zip(vehicles) {
        for number in 0..count {
            let berth = if number % 2 == 0 { 0.35 } else { -0.35 };
            let starts_after = (1000.0 * lap * number as f64 / count as f64).round() / 1000.0;
            robots.push(format!(
                r#"{{"name": "{letter}{}", "type": "carrier", "pose": [0, 0, 0], {keys}, "berth": {berth}, "behind": {},
                "parameters": {{"passage": "passage", "loading": "load_{letter}", "unloading": "unload_{letter}",
                "starts_after": {starts_after}}}}}"#,
                number + 1,
                BEHIND[number],
            ));
        }
    }
    let (_, stationary) = texts.layout.split_once("\"stationary\"").expect("the sections");
    texts.layout = format!(
        r#"{{"specs": "crossing.aut", "robots": [{}], "stationary"{stationary}"#,
        robots.join(", ")
    );
    texts.scenario = Some(format!(r#"{{"time_limit_s": {seconds}}}"#));
    texts
}

/// What a run was like.
struct Seen8 {
    report: Report,
    transports: f64,
    /// How often a vehicle stood at the line.
    held: usize,
    most_in_passage: usize,
}

fn run(texts: &Texts, stepping: Stepping) -> Seen8 {
    let outcome = texts.compile();
    let project = outcome.project.expect("a line without errors");
    let (_, columns) = st::mapped(&project.system, &outcome.sources, &IoMap::default());
    let words: HashMap<String, Source> =
        columns.0.iter().map(|column| (column.name.to_lowercase(), column.source)).collect();
    let of = |name: &str| words[name];
    let vehicles: Vec<[Source; 2]> = project
        .plant
        .machines
        .iter()
        .filter(|machine| machine.track().is_some())
        .map(|machine| [of(&format!("{}_place", machine.name)), of(&format!("{}_stands", machine.name))])
        .collect();
    let unloaded = [of("section_served[2]"), of("section_served[4]")];
    let (mut transports, mut held, mut most) = (0.0, 0, 0);
    let mut waited = vec![false; vehicles.len()];
    let mut observer = |seen: &Seen| {
        transports = unloaded.iter().map(|word| word.value(seen)).sum();
        let mut inside = 0;
        for (vehicle, waited) in vehicles.iter().zip(&mut waited) {
            let [place, stands] = vehicle.map(|word| word.value(seen));
            let waits = place == 2.0 && stands == 1.0;
            held += usize::from(waits && !*waited);
            *waited = waits;
            inside += usize::from(place == 2.0 && stands == 0.0);
        }
        most = most.max(inside);
    };
    let mut executor = Executor::new(&project.system);
    let memory = &mut Memory::default();
    let report = run_again(&project.plant, &mut executor, stepping, memory, &mut observer).expect("a line that runs");
    Seen8 { report, transports, held, most_in_passage: most }
}

/// Transports per hour in eight hours, by a model of discrete events: stations of 12 s, vehicles of 1.5 m/s and 0.5 m/s2,
/// a passage of 4 m for one vehicle of 0.823 m, which brakes if it is taken 2.25 m before it.
const ROWS: [([usize; 2], f64); 7] = [
    ([1, 0], 66.62),
    ([0, 1], 55.62),
    ([1, 1], 121.62),
    ([2, 2], 241.75),
    ([3, 3], 359.50),
    ([4, 4], 475.38),
    ([6, 6], 599.12),
];

#[test]
fn as_many_transports_as_the_model_has() {
    let found = on_all_processors(&ROWS, |(vehicles, _)| {
        let begin = std::time::Instant::now();
        let r = run(&with_vehicles(*vehicles, 28_800), Stepping::Events);
        (r, begin.elapsed())
    });
    for ((vehicles, per_hour), (found, took)) in ROWS.iter().zip(found) {
        println!("{vehicles:?}: {} ({per_hour}) {:.4} held {} most {} {} {:?}", found.transports / 8.0, found.transports / 8.0 / per_hour - 1.0, found.held, found.most_in_passage, found.report.reason, took);
    }
    panic!();
}
