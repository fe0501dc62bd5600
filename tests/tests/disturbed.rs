//! The examples under other orders of their steps, with inputs that come late, and with pauses, losses of power and
//! refused commands. The long form is that of the campaigns: `AUTOGEN_CAMPAIGN=full`.

use autogen::executor::Executor;
use autogen_tests::{Texts, examples, is_full_campaign, on_all_processors, side_by_side};
use runtime_sim::line::{IoDelay, Line, Pause, Refusal};
use runtime_sim::random::Random;
use runtime_sim::report::Report;
use runtime_sim::run::{Stepping, run};

/// Those that `lines` disturbs.
const ELSEWHERE: [&str; 5] = ["default", "spaced", "less_agv", "buffer", "shared_agv"];

/// Examples that continue after a loss of power.
const RETAINING: [&str; 6] = ["sorting", "palletizer", "pick_and_place", "scara", "warehouse", "layers"];

/// Scans in which a pause or a loss of power once sent an item astray, or stopped a line for ever.
const ONCE_WRONG: [(&str, u64); 5] =
    [("sorting", 365), ("sorting", 395), ("sorting", 982), ("loop", 8100), ("pick_and_place", 846)];

/// Half a second.
const SHORT_S: f64 = 0.5;

fn all() -> Vec<(String, Texts)> {
    let more = ["loop", "turntable"].map(|name| (name.to_string(), side_by_side(&format!("{name}/{name}"))));
    let all = examples().into_iter().chain(more);
    all.filter(|(name, _)| !ELSEWHERE.contains(&name.as_str())).collect()
}

fn execute(texts: &Texts, change: impl Fn(&mut Line)) -> Report {
    let mut project = texts.project();
    change(&mut project.plant);
    run(&project.plant, &mut Executor::new(&project.system), Stepping::Events, &mut |_| {})
        .expect("a line that can be run")
}

/// How many runs a campaign makes of each line.
fn campaign(short: u64, full: u64) -> u64 {
    if is_full_campaign() { full } else { short }
}

/// Runs that end otherwise than by their goal.
fn assert_all_finish<T: Sync>(
    cases: &[(&str, T)],
    told: impl Fn(&T) -> String,
    run: impl Fn(&str, &T) -> Report + Sync,
) {
    let reports = on_all_processors(cases, |(name, case)| run(name, case));
    let failed = cases.iter().zip(&reports).filter(|(_, report)| !report.finished);
    let failed: Vec<String> =
        failed.map(|((name, case), report)| format!("{name}, {}: {}", told(case), report.reason)).collect();
    assert!(failed.is_empty(), "{} of {} runs:\n{}", failed.len(), cases.len(), failed.join("\n"));
    println!("{} runs, 0 failures", cases.len());
}

#[test]
fn no_example_depends_on_the_order_of_the_steps() {
    let lines = all();
    let several = lines.iter().filter(|(_, texts)| texts.project().system.instances.len() > 1);
    let seeds = 1..=campaign(10, 100);
    let cases: Vec<(&str, (&Texts, u64))> = several
        .flat_map(|(name, texts)| seeds.clone().map(move |seed| (name.as_str(), (texts, seed))))
        .collect();
    assert_all_finish(
        &cases,
        |(_, seed)| format!("--order {seed}"),
        |_, (texts, seed)| execute(&Texts { order: Some(*seed), ..(*texts).clone() }, |_| {}),
    );
}

#[test]
fn examples_do_not_depend_on_how_late_inputs_come() {
    let lines = all();
    let mut delays = vec![IoDelay::Fixed(1), IoDelay::Fixed(3), IoDelay::Fixed(5)];
    delays.extend((1..=campaign(1, 40)).map(|seed| IoDelay::Random { max: 5, seed }));
    let cases: Vec<(&str, (&Texts, &IoDelay))> = lines
        .iter()
        .flat_map(|(name, texts)| delays.iter().map(move |delay| (name.as_str(), (texts, delay))))
        // Its scan is a second.
        .filter(|(name, _)| *name != "level_control")
        .collect();
    assert_all_finish(
        &cases,
        |(_, delay)| format!("{delay:?}"),
        |_, (texts, delay)| execute(texts, |line| line.io_delay = (*delay).clone()),
    );
}

/// Moments of a run in which nobody presses a button: a press in a pause is lost.
fn moments(name: &str, texts: &Texts) -> Vec<Pause> {
    let line = texts.project().plant;
    let scan_s = f64::from(line.scan_ms) / 1000.0;
    let scans = ((SHORT_S / scan_s).ceil() as u64).max(1);
    let last = execute(texts, |_| {}).scans;
    let mut random = Random::at(2026, [name.len() as u64, last]);
    let drawn = (0..campaign(6, 200)).map(|_| 3 + random.next_u64() % last);
    let known = ONCE_WRONG.iter().filter(|(of, _)| *of == name).map(|(_, scan)| *scan);
    let is_quiet = |scan: &u64| {
        let (from, to) = (*scan as f64 * scan_s, (scan + scans + 5) as f64 * scan_s);
        line.scenario.operations.iter().all(|o| {
            let end = o.at_s + o.for_s.unwrap_or(0.0);
            (end + scan_s < from || to < o.at_s) && (o.for_s.is_some() || to < o.at_s || end < from)
        })
    };
    let all: Vec<u64> = drawn.chain(known).filter(is_quiet).collect();
    all.into_iter().map(|at_scan| Pause { at_scan, scans }).collect()
}

fn disturb(lines: &[(String, Texts)], add: impl Fn(&mut Line, Pause) + Sync) {
    let pauses: Vec<Vec<Pause>> = on_all_processors(lines, |(name, texts)| moments(name, texts));
    let of_lines = lines.iter().zip(&pauses);
    let cases: Vec<(&str, (&Texts, &Pause))> = of_lines
        .flat_map(|((name, texts), pauses)| pauses.iter().map(move |pause| (name.as_str(), (texts, pause))))
        .collect();
    assert_all_finish(
        &cases,
        |(_, pause)| format!("in scan {}", pause.at_scan),
        |_, (texts, pause)| execute(texts, |line| add(line, (*pause).clone())),
    );
}

#[test]
fn examples_continue_after_a_pause_at_any_moment() {
    disturb(&all(), |line, pause| line.scenario.pauses.push(pause));
}

#[test]
fn examples_that_retain_continue_after_a_loss_of_power_at_any_moment() {
    let mut lines = all();
    lines.retain(|(name, _)| RETAINING.contains(&name.as_str()));
    assert_eq!(lines.len(), RETAINING.len());
    disturb(&lines, |line, pause| line.scenario.power_offs.push(pause));
}

/// A step is tried again; after the third failure the line stops and says what a person has to do.
#[test]
fn an_arm_that_cannot_go_on_stops_the_line() {
    for (name, machine) in [("tending", "arm"), ("warehouse", "rack"), ("turntable", "ur"), ("lathe", "arm")]
    {
        let (_, texts) = all().into_iter().find(|(found, _)| found == name).expect("an example");
        let machines = texts.project().plant.machines;
        let machine = machines.iter().position(|found| found.name == machine).expect("a machine");
        let refused = |commands: std::ops::RangeInclusive<u32>| {
            execute(&texts, |line| {
                line.scenario.refusals =
                    commands.clone().map(|command| Refusal { machine, command }).collect();
            })
        };
        let once = refused(3..=3);
        assert!(once.finished, "{name}: {}", once.reason);
        let thrice = refused(3..=5);
        assert!(thrice.fault.is_some(), "{name}: {}", thrice.reason);
    }
}

/// A pause or a loss of power of less than half a scan lasts one scan.
#[test]
fn the_shortest_loss_of_power_lasts_a_scan() {
    let mut texts = side_by_side("scenes/level_control");
    let faults =
        r#"{"faults": {"pauses": [{"at_s": 40, "for_s": 0.4}], "power_offs": [{"at_s": 50, "for_s": 0.4}]},"#;
    texts.scenario = texts.scenario.map(|text| text.replacen('{', faults, 1));
    let scenario = texts.project().plant.scenario;
    assert_eq!(scenario.pauses, [Pause { at_scan: 40, scans: 1 }]);
    assert_eq!(scenario.power_offs, [Pause { at_scan: 50, scans: 1 }]);
    assert_eq!(execute(&texts, |_| {}).notes, Vec::<String>::new());
}
