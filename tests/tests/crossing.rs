//! Two loops of vehicles that share a passage: throughput as a second program has it, and never two in the passage.

use autogen::executor::Executor;
use autogen_tests::words::with_words;
use autogen_tests::{Texts, is_full_campaign, on_all_processors, side_by_side};
use runtime_sim::io_trace::Source;
use runtime_sim::line::{IoDelay, Line, Pause, Refusal};
use runtime_sim::memory::Memory;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, run_again};

/// A loop: its letter, its keys, how long a vehicle alone takes for it, s: 36 and 52 m, 2 x 12 s, two stops.
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
        for (number, behind) in BEHIND.into_iter().enumerate().take(count) {
            let berth = if number % 2 == 0 { 0.35 } else { -0.35 };
            let starts_after = (1000.0 * lap * number as f64 / count as f64).round() / 1000.0;
            robots.push(format!(
                r#"{{"name": "{letter}{number}", "type": "carrier", "pose": [0, 0, 0], {keys},
                "berth": {berth}, "behind": {behind}, "parameters": {{"passage": "passage", "loading": "load_{letter}",
                "unloading": "unload_{letter}", "starts_after": {starts_after}}}}}"#,
            ));
        }
    }
    let (_, stationary) = texts.layout.split_once("\"stationary\"").expect("the sections");
    texts.layout = format!(r#"{{"robots": [{}], "stationary"{stationary}"#, robots.join(", "));
    texts.scenario = Some(format!(r#"{{"time_limit_s": {seconds}}}"#));
    texts
}

/// What a run was like.
struct Found {
    report: Report,
    /// Scan and number of transports so far, at each of them.
    transports: Vec<(u64, f64)>,
    /// How often a vehicle waited at the line.
    held: usize,
    most_in_passage: usize,
}

impl Found {
    /// In an hour, from a time on.
    fn per_hour(&self, from_s: u32) -> f64 {
        let from = u64::from(from_s) * 100;
        let before = self
            .transports
            .iter()
            .take_while(|(scan, _)| *scan < from)
            .last()
            .map_or(0.0, |(_, count)| *count);
        let all = self.transports.last().map_or(0.0, |(_, count)| *count);
        3600.0 * (all - before) / (self.report.simulated_s - f64::from(from_s))
    }
}

fn run(texts: &Texts) -> Found {
    let (project, words) = with_words(texts);
    let vehicles = project.plant.machines.iter().filter(|machine| machine.track().is_some());
    let vehicles: Vec<[Source; 2]> = vehicles
        .map(|machine| ["place", "stands"].map(|port| words[&format!("{}_{port}", machine.name)]))
        .collect();
    // Rows of the sections, in layout order: the passage, then two of each loop.
    let unloaded = ["section_served[2]", "section_served[4]"].map(|name| words[name]);
    let (mut transports, mut held, mut most_in_passage) = (vec![(0, 0.0)], 0, 0);
    let mut waited = vec![false; vehicles.len()];
    let mut observer = |seen: &Seen| {
        let count = unloaded.iter().map(|word| word.value(seen)).sum();
        if transports.last().is_none_or(|(_, last)| *last != count) {
            transports.push((seen.scan, count));
        }
        let mut inside = 0;
        for (vehicle, waited) in vehicles.iter().zip(&mut waited) {
            // From the line on: place 2, until it is clear at place 3.
            let [place, stands] = vehicle.map(|word| word.value(seen));
            let waits = place == 2.0 && stands == 1.0;
            held += usize::from(waits && !*waited);
            *waited = waits;
            inside += usize::from(place == 2.0 && !waits);
        }
        most_in_passage = most_in_passage.max(inside);
    };
    let (mut executor, mut memory) = (Executor::new(&project.system), Memory::default());
    let report = run_again(&project.plant, &mut executor, Stepping::Events, &mut memory, &mut observer);
    Found { report: report.expect("a line that runs"), transports, held, most_in_passage }
}

/// Transports per hour in eight hours, by a model of discrete events: loading and unloading of 12 s each, one vehicle at a
/// time; 1.5 m/s and 0.5 m/s2; a passage of 4 m for one vehicle of 0.823 m at a time. Who finds it taken 2.25 m before it
/// brakes to a stop, and asks from then on.
const MODEL: [([usize; 2], f64); 7] = [
    ([1, 0], 66.62),
    ([0, 1], 55.62),
    ([1, 1], 121.62),
    ([2, 2], 241.75),
    ([3, 3], 359.50),
    ([4, 4], 475.38),
    ([6, 6], 599.12),
];

/// The last two rows for two hours, without the first half of an hour; in the long form all for eight hours.
#[test]
fn as_many_transports_as_the_model_has() {
    let found = on_all_processors(&MODEL, |(vehicles, per_hour)| {
        let is_short = vehicles[0] > 3 && !is_full_campaign();
        let (seconds, from_s) = if is_short { (7200, 1800) } else { (28_800, 0) };
        let found = run(&with_vehicles(*vehicles, seconds));
        let ratio = found.per_hour(from_s) / per_hour;
        println!("{vehicles:?}: {:.2} an hour, {ratio:.4} of the model's", found.per_hour(from_s));
        (ratio, found)
    });
    for ((vehicles, _), (ratio, found)) in MODEL.iter().zip(found) {
        assert_eq!(found.report.reason, "time limit reached", "{vehicles:?}");
        assert!(found.report.collisions.is_empty(), "{vehicles:?}: {:?}", found.report.collisions);
        assert_eq!(found.most_in_passage, 1, "{vehicles:?}");
        assert!((0.99..=1.01).contains(&ratio), "{vehicles:?}: {ratio} of what the model has");
        assert_eq!(
            found.held > 0,
            vehicles[0] == vehicles[1] && vehicles[0] < 6,
            "{vehicles:?}: {} held",
            found.held
        );
    }
}

/// Without the lock two come into the passage, and the contact ends the run. The scanners would see most of it coming.
#[test]
fn without_the_lock_vehicles_meet_in_the_passage() {
    let mut texts = with_vehicles([1, 1], 28_800);
    let lock = "at_gate and passage.served = passage.drawn and not halted";
    assert!(texts.specs[0].contains(lock));
    texts.specs[0] = texts.specs[0].replace(lock, "at_gate and not halted").replace("braking + 1.55", "0.01");
    let found = run(&texts);
    assert!(!found.report.finished);
    let [contact] = &found.report.collisions[..] else { panic!("{:?}", found.report.collisions) };
    assert_eq!(contact.pair, ["a0", "b0"]);
    assert!(contact.time_s > 0.0 && (contact.time_s - found.report.simulated_s).abs() < 0.02, "{contact:?}");
    // Between the lines before and behind the passage.
    assert!(contact.place.x.abs() < 1.0 && (-0.5..=2.5).contains(&contact.place.y), "{contact:?}");
    let reason = format!("collision of a0 (hull) with b0 (hull) at {:.3} s", contact.time_s);
    assert!(found.report.reason.starts_with(&reason), "{}", found.report.reason);
    assert_eq!(found.most_in_passage, 2);
}

/// From event to event, with every scan, and with every scan looked at: the same, whatever goes wrong.
#[test]
fn steppings_agree_on_vehicles() {
    let seconds = if is_full_campaign() { 3600 } else { 240 };
    let pause = |line: &mut Line| {
        let pause = |at_scan| Pause { at_scan, scans: 1234 };
        line.scenario.pauses = [1500, 4004, 9870, 14_321].map(pause).into();
    };
    let refuse = |line: &mut Line| {
        let refusal = |machine| [2, 3, 5, 8].map(|command| Refusal { machine, command });
        line.scenario.refusals = [0, 1, 4].into_iter().flat_map(refusal).collect();
    };
    type Change = (&'static str, fn(&mut Line));
    let changes: [Change; 4] = [
        ("nothing", |_| {}),
        ("pauses", pause),
        ("refusals", refuse),
        ("late", |line| line.io_delay = IoDelay::Random { max: 5, seed: 3 }),
    ];
    let cases: Vec<([usize; 2], Change)> =
        [[2, 2], [6, 6]].into_iter().flat_map(|vehicles| changes.map(|change| (vehicles, change))).collect();
    on_all_processors(&cases, |(vehicles, (name, change))| {
        let project = with_vehicles(*vehicles, seconds).project();
        let mut line = project.plant.clone();
        change(&mut line);
        let execute = |stepping| {
            let (mut executor, mut memory) = (Executor::new(&project.system), Memory::default());
            let run = run_again(&line, &mut executor, stepping, &mut memory, &mut |_| {});
            run.unwrap_or_else(|error| panic!("{vehicles:?}, {name}: {error}"))
        };
        let [events, every, checked] =
            [Stepping::Events, Stepping::EveryScan, Stepping::Checked].map(execute);
        println!("{vehicles:?}, {name}: {}", events.reason);
        assert_eq!(events, every, "{vehicles:?}, {name}");
        assert_eq!(events, checked, "{vehicles:?}, {name}");
        assert!(events.collisions.is_empty(), "{vehicles:?}, {name}: {:?}", events.collisions);
    });
}
