//! Whole lines on the reference executor and the simulator: whatever happens to a line that the
//! library's controllers have to cope with, all orders are made and no item is lost.

use autogen::executor::Executor;
use autogen::lower::Project;
use autogen_tests::{LAYOUTS, Texts, ariac, on_all_processors, own_line};
use runtime_sim::line::{IoDelay, Pause, Refusal, Slip};
use runtime_sim::memory::Memory;
use runtime_sim::random::Random;
use runtime_sim::report::Report;
use runtime_sim::run::{Stepping, run, run_again};
use std::sync::Mutex;

/// What runs have found, for those that come after them.
static MEMORIES: Mutex<Vec<Memory>> = Mutex::new(Vec::new());

fn execute(project: &Project) -> Report {
    let mut executor = Executor::new(&project.system);
    let mut memory = MEMORIES.lock().unwrap().pop().unwrap_or_default();
    let report = run_again(&project.plant, &mut executor, Stepping::Events, &mut memory, &mut |_| {});
    MEMORIES.lock().unwrap().push(memory);
    report.expect("a line that can be run")
}

/// What kept a line from making all its orders; nothing if it made them.
fn failure(name: &str, report: &Report) -> Option<String> {
    let made = report.finished && report.orders_done == report.orders;
    (!made).then(|| format!("{name}: {} of {} orders, {}", report.orders_done, report.orders, report.reason))
}

fn assert_all_made<T: Sync>(
    inputs: &[T],
    name: impl Fn(&T) -> String + Sync,
    project: impl Fn(&T) -> Project + Sync,
) {
    let failures: Vec<String> =
        on_all_processors(inputs, |input| failure(&name(input), &execute(&project(input))))
            .into_iter()
            .flatten()
            .collect();
    assert!(
        failures.is_empty(),
        "{} of {} runs failed:\n{}",
        failures.len(),
        inputs.len(),
        failures.join("\n")
    );
    println!("{} runs, 0 failures", inputs.len());
}

/// How many runs a campaign makes: a short form, or all of them with AUTOGEN_CAMPAIGN=full.
fn campaign(short: usize, full: usize) -> usize {
    if autogen_tests::is_full_campaign() { full } else { short }
}

#[test]
fn every_layout_works_with_every_capacity_and_touches_nothing() {
    let mut inputs = Vec::new();
    for layout in LAYOUTS {
        for capacity in (1..=12).step_by(campaign(4, 1)) {
            inputs.push((layout, capacity));
        }
    }
    assert_all_made(
        &inputs,
        |(layout, capacity)| format!("{layout} with {capacity}"),
        |(layout, capacity)| ariac(layout).set(&format!("agv.capacity={capacity}")).project(),
    );
}

/// The long form: 108 runs.
#[test]
fn parts_in_another_order_make_no_difference() {
    let mut inputs = Vec::new();
    for layout in LAYOUTS {
        for seed in 2..campaign(3, 14) {
            for capacity in [2, 4, 8] {
                inputs.push((layout, seed, capacity));
            }
        }
    }
    assert_all_made(
        &inputs,
        |input| format!("{input:?}"),
        |(layout, seed, capacity)| {
            let seed = format!("\"seed\": {seed}");
            let scenario = autogen::scenario::DEFAULT.replace("\"seed\": 1", &seed);
            assert!(scenario.contains(&seed));
            let texts = Texts { scenario: Some(scenario), ..ariac(layout) };
            texts.set(&format!("agv.capacity={capacity}")).project()
        },
    );
}

/// Gantry and kitting robot are busy nearly all the time then.
#[test]
fn an_order_of_the_default_layout_takes_at_most_70_s() {
    for capacity in [2, 4] {
        let seeds: Vec<u32> = (1..=12).collect();
        let seconds = on_all_processors(&seeds, |seed| {
            let texts = ariac("default").set(&format!("agv.capacity={capacity}"));
            execute(&texts.set(&format!("supply.seed={seed}")).project()).seconds_per_order
        });
        let all: Vec<f64> = seconds.into_iter().map(|seconds| seconds.expect("orders")).collect();
        let mean = all.iter().sum::<f64>() / all.len() as f64;
        println!("{capacity} parts per trip: {mean:.2} s per order");
        assert!(mean <= 70.0, "{capacity} parts per trip: {mean} s");
    }
}

/// Beside the stations there is not much room for the gantry here, and two vehicles drive past them to the far stop.
#[test]
fn vehicles_under_way_are_not_touched() {
    let seeds: Vec<u32> = (1..=campaign(4, 100) as u32).collect();
    let contacts = on_all_processors(&seeds, |seed| {
        let texts = ariac("spaced").set("agv.capacity=4");
        execute(&texts.set(&format!("supply.seed={seed}")).project()).collisions
    });
    let contacts = contacts.concat();
    assert!(contacts.is_empty(), "{contacts:?}");
}

/// Four times at which no path begins where the gantry is halted, on its way between two places.
#[test]
fn after_a_loss_of_power_the_gantry_goes_on_along_its_path() {
    assert_all_made(
        &[73.9, 274.4, 401.58, 509.04],
        |at| format!("without power at {at} s"),
        |at| {
            let mut project = ariac("default").project();
            project.plant.scenario.power_offs =
                vec![Pause { at_scan: (at * 100.0_f64).round() as u64, scans: 300 }];
            project
        },
    );
}

#[test]
fn lines_of_the_users_own_make_their_orders() {
    let mut inputs = Vec::new();
    for folder in ["buffer", "rack", "shared_agv"] {
        for seed in 0..campaign(2, 100) as u64 {
            inputs.push((folder, seed));
        }
    }
    assert_all_made(
        &inputs,
        |input| format!("{input:?}"),
        |(folder, seed)| {
            let mut project = Texts { order: Some(*seed), ..own_line(folder) }
                .set(&format!("agv.capacity={}", 1 + seed % 12))
                .project();
            project.plant.io_delay = IoDelay::Random { max: 5, seed: *seed };
            project
        },
    );
}

#[test]
fn one_order_and_five_orders() {
    let scenario =
        |count: usize| autogen::scenario::DEFAULT.replace("\"count\": 8", &format!("\"count\": {count}"));
    let mut inputs = Vec::new();
    for count in [1, 5] {
        for capacity in [1, 3, 8, 12] {
            inputs.push((count, capacity));
        }
    }
    assert_all_made(
        &inputs,
        |input| format!("{input:?}"),
        |(count, capacity)| {
            let texts = Texts { scenario: Some(scenario(*count)), ..ariac("default") };
            texts.set(&format!("agv.capacity={capacity}")).project()
        },
    );
}

#[test]
fn no_controller_depends_on_the_order_of_the_steps() {
    let seeds: Vec<u64> = (0..campaign(4, 100) as u64).collect();
    for layout in LAYOUTS {
        assert_all_made(
            &seeds,
            |seed| format!("{layout}, order {seed}"),
            |seed| {
                let texts = Texts { order: Some(*seed), ..ariac(layout) };
                texts.set(&format!("agv.capacity={}", 1 + seed % 12)).project()
            },
        );
    }
}

#[test]
fn devices_may_answer_late() {
    let mut inputs = vec![IoDelay::Fixed(0), IoDelay::Fixed(1), IoDelay::Fixed(5)];
    inputs.extend((0..campaign(1, 20) as u64).map(|seed| IoDelay::Random { max: 5, seed }));
    for layout in LAYOUTS {
        assert_all_made(
            &inputs,
            |delay| format!("{layout}, {delay:?}"),
            |delay| {
                let mut project = ariac(layout).project();
                project.plant.io_delay = delay.clone();
                project
            },
        );
    }
}

#[test]
fn the_line_may_be_stopped_at_any_moment() {
    let mut random = Random::new(7);
    let project = ariac("default").project();
    let last = execute(&project).scans as u32;
    let scans: Vec<u64> = (0..campaign(6, 100)).map(|_| u64::from(3 + random.up_to(last - 4))).collect();
    on_all_processors(&scans, |scan| {
        let mut plant = project.plant.clone();
        plant.scenario.pauses = vec![Pause { at_scan: *scan, scans: 300 }];
        let mut executor = Executor::new(&project.system);
        let (mut kept, mut stopped) = (Vec::new(), 0);
        let report = run(&plant, &mut executor, Stepping::EveryScan, &mut |seen| {
            if seen.answer.running {
                kept = seen.trace.to_vec();
            } else if seen.scan >= *scan {
                stopped += 1;
                assert!(kept == seen.trace, "stopped at {scan}: something changes in scan {}", seen.scan);
            }
        });
        let report = report.expect("a line that can be run");
        assert_eq!(failure(&format!("stopped at {scan}"), &report), None);
        assert!(stopped >= 300, "stopped at {scan}: only {stopped} scans without running");
        let lost = report.items.iter().filter(|item| item.carrier.contains("floor")).count();
        assert_eq!(lost, 0, "stopped at {scan}: {lost} items on the floor");
    });
    println!("{} stops, nothing changed and nothing was lost", scans.len());
}

/// The controller loses its power at some moment, and begins again with what it retained: all orders are made, or the
/// line stops and says what somebody has to do. Nothing falls and nothing is touched. The long form: 1,000 times.
#[test]
fn power_may_be_lost_at_any_moment() {
    let mut random = Random::new(11);
    let project = ariac("default").project();
    let last = execute(&project).scans as u32;
    let scans: Vec<u64> = (0..campaign(16, 1000)).map(|_| u64::from(3 + random.up_to(last - 4))).collect();
    let reports = on_all_processors(&scans, |scan| {
        let mut project = project.clone();
        project.plant.scenario.power_offs = vec![Pause { at_scan: *scan, scans: 1 + scan % 500 }];
        execute(&project)
    });
    let (mut stopped, mut wrong) = (0, Vec::new());
    for (scan, report) in scans.iter().zip(&reports) {
        let is_told = report.fault.is_some();
        stopped += usize::from(is_told);
        if !is_told {
            wrong.extend(failure(&format!("without power from scan {scan}"), report));
        }
        let lost = report.items.iter().filter(|item| item.carrier.contains("floor")).count();
        if lost > 0 {
            wrong.push(format!("without power from scan {scan}: {lost} items on the floor"));
        }
    }
    println!("{} losses of power, {stopped} of them with a stop", scans.len());
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), scans.len(), wrong.join("\n"));
}

/// The states of a machine, each with the scan in which it is entered.
fn states(project: &Project, machine: usize) -> Vec<(u64, String)> {
    let begin = project.system.traces()[machine];
    let automaton = project.system.automaton_of(machine);
    let mut entered: Vec<(u64, String)> = Vec::new();
    let mut executor = Executor::new(&project.system);
    run(&project.plant, &mut executor, Stepping::Events, &mut |seen| {
        let state = &automaton.states[seen.trace[begin] as usize].name;
        if entered.last().is_none_or(|(_, last)| last != state) {
            entered.push((seen.scan, state.clone()));
        }
    })
    .expect("a line that can be run");
    entered
}

/// The gantry's first command to fetch a part is refused, and so is the one to go up. While it then comes for a part,
/// power is lost, and the device still shows the error of the command before.
#[test]
fn a_command_that_power_broke_off_is_not_taken_for_the_one_that_was_refused_before() {
    let mut project = ariac("default").project();
    let machine = project.plant.machines.iter().position(|m| m.name == "gantry").expect("a gantry");
    // Behind `pace` and the way to its rest.
    project.plant.scenario.refusals = [3, 4].map(|command| Refusal { machine, command }).into();
    let at_first = states(&project, machine);
    let names: Vec<&str> = at_first.iter().map(|(_, name)| name.as_str()).collect();
    let refused = names.iter().position(|name| *name == "Refused").expect("both commands are refused");
    let coming = refused + 2;
    assert_eq!(names[refused - 1..=coming], ["Missed", "Refused", "Waiting", "Picking"]);
    project.plant.scenario.power_offs = vec![Pause { at_scan: at_first[coming].0 + 100, scans: 200 }];
    let names: Vec<String> = states(&project, machine).into_iter().map(|(_, name)| name).collect();
    assert_eq!(names[coming..coming + 4], ["Picking", "Fetching", "Missed", "Waiting"]);
}

/// A part falls at some moment of its transport: all orders are made, or the line stops and says what somebody has to
/// do. Nothing is touched, and no order is left that could not be made any more.
#[test]
fn a_part_that_slips_is_made_up_for() {
    let mut random = Random::new(3);
    let drawn = (0..campaign(16, 500)).map(|_| {
        let (robot, pick) = (["kitting", "gantry"][random.up_to(1) as usize], 1 + random.up_to(30));
        (robot, u64::from(pick), f64::from(random.up_to(1000)) / 100.0)
    });
    // Over its place, while the arm still turns: what it did next once brought its links together. And onto another part
    // on the conveyor, which ended the run.
    let slips: Vec<_> = [("gantry", 11, 5.79), ("kitting", 17, 2.17)].into_iter().chain(drawn).collect();
    let reports = on_all_processors(&slips, |(robot, pick, after_s)| {
        let mut project = ariac("default").project();
        let machine =
            project.plant.machines.iter().position(|m| m.name == *robot).expect("a robot of the layout");
        project.plant.scenario.slips = vec![Slip { machine, pick: *pick as _, after_s: *after_s }];
        execute(&project)
    });
    let mut stopped = 0;
    let mut wrong = Vec::new();
    for (slip, report) in slips.iter().zip(&reports) {
        let is_told = report.fault.is_some();
        stopped += usize::from(is_told);
        if !report.finished && !is_told {
            wrong.push(format!(
                "{slip:?}: {} of {} orders, {}",
                report.orders_done, report.orders, report.reason
            ));
        }
    }
    println!("{} slips, {stopped} of them with a stop", slips.len());
    assert!(wrong.is_empty(), "{} of {}:\n{}", wrong.len(), slips.len(), wrong.join("\n"));
}

/// Parts of one kind come so close to one another that one of them is always in the field of the belt.
#[test]
fn behind_a_part_that_was_not_gripped_the_next_one_is() {
    let scenario = r#"{
        "kinds": [{"name": "battery", "height": 0.053}],
        "orders": [{"station": "as1", "parts": {"battery": 1}}],
        "supply": {"items": ["battery"], "times": 100, "every_s": 4},
        "faults": {"refusals": [{"robot": "kitting", "command": 3}]}
    }"#;
    let texts = Texts { scenario: Some(scenario.into()), ..ariac("less_agv") };
    assert_eq!(failure("less_agv", &execute(&texts.project())), None);
}

/// A draw that is left to be done: the forearm touches a lid, since the command that leads up from a briefcase is refused
/// while the torso still turns, and the one that is tried next does not know the lid.
const TOUCHES_A_LID: u64 = 391;

/// The gantry loses every second part, and one in three of its commands is refused: the line may stop and say what
/// somebody has to do, but nothing is touched. In the first of these draws the arm once rose with each refusal until it
/// touched itself.
#[test]
fn an_arm_that_is_refused_again_and_again_touches_nothing() {
    let drawn = (0..campaign(12, 400) as u64).filter(|seed| *seed != TOUCHES_A_LID);
    let seeds: Vec<u64> = [181, 227, 304, 355].into_iter().chain(drawn).collect();
    let reports = on_all_processors(&seeds, |seed| {
        let mut random = Random::at(5, [*seed, 0]);
        let mut project = ariac("default").project();
        let machine = project.plant.machines.iter().position(|m| m.name == "gantry").expect("a gantry");
        let scenario = &mut project.plant.scenario;
        scenario.orders.truncate(2);
        scenario.time_limit_s = 500.0;
        let refused = (1..300).filter(|_| random.up_to(2) == 0);
        scenario.refusals = refused.map(|command| Refusal { machine, command }).collect();
        for pick in 1..60 {
            let after_s = f64::from(random.up_to(1000)) / 100.0;
            if random.up_to(1) == 0 {
                scenario.slips.push(Slip { machine, pick, after_s });
            }
        }
        execute(&project)
    });
    let touched = seeds.iter().zip(&reports).filter(|(_, report)| !report.collisions.is_empty());
    let touched: Vec<String> = touched.map(|(seed, report)| format!("{seed}: {}", report.reason)).collect();
    println!("{} runs", seeds.len());
    assert!(touched.is_empty(), "{} of {}:\n{}", touched.len(), seeds.len(), touched.join("\n"));
}

/// Tools lower than this over a tray and within its rectangle are at work on it, m.
const AT_WORK: f64 = 0.4;

#[test]
fn one_arm_at_a_time_is_over_a_tray_and_none_when_it_moves() {
    for (folder, delay) in [("shared_agv", 0), ("shared_agv", 5), ("buffer", 0)] {
        let mut project = own_line(folder).set("agv.capacity=6").project();
        project.plant.io_delay = IoDelay::Fixed(delay);
        let of = |device: &[&str]| -> Vec<usize> {
            (0..project.system.instances.len())
                .filter(|i| device.contains(&project.system.automaton_of(*i).device.name.as_str()))
                .collect()
        };
        let (arms, vehicles) = (of(&["rail_arm", "gantry"]), of(&["vehicle", "bin"]));
        let mut before: Vec<_> = vehicles.iter().map(|_| None).collect();
        let mut visits = 0;
        let mut executor = Executor::new(&project.system);
        let report = run(&project.plant, &mut executor, Stepping::EveryScan, &mut |seen| {
            for (vehicle, before) in vehicles.iter().zip(&mut before) {
                let at = seen.plant.position(*vehicle).expect("a vehicle is somewhere");
                let is_bin = project.system.automaton_of(*vehicle).device.name == "bin";
                // A tray is 0.70 by 0.50 m around (0.15, 0) from its vehicle, with its top at 0.755 m; a bin 0.60 by 0.60, at 0.725 m.
                let (ahead, half, height) =
                    if is_bin { (0.0, (0.3, 0.3), 0.725) } else { (0.15, (0.35, 0.25), 0.755) };
                let over = arms.iter().filter(|arm| {
                    let tool = seen.plant.position(**arm).expect("a tool is somewhere");
                    let (x, y, z) = (tool.x - at.x - ahead, tool.y - at.y, tool.z - at.z - height);
                    x.abs() < half.0 && y.abs() < half.1 && z < AT_WORK
                });
                let over = over.count();
                assert!(over <= 1, "{folder}: {over} arms over one tray in scan {}", seen.scan);
                let moves = before.is_some_and(|b| b != at);
                assert!(!moves || over == 0, "{folder}: a vehicle moves under an arm in scan {}", seen.scan);
                visits += over;
                *before = Some(at);
            }
        })
        .expect("a line that can be run");
        assert!(
            report.finished && visits > 100,
            "{folder}: {}, {visits} scans with an arm over a tray",
            report.reason
        );
    }
}
