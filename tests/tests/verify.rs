//! The search against the simulator, against itself with reductions off, and on lines with known mistakes.

use autogen::executor::Executor;
use autogen::library;
use autogen::lower::Project;
use autogen::verify::{Asked, model, replay::replay};
use autogen_search::explore::{Bounds, Covered, Decided, End, Outcome, explore};
use autogen_search::model::{Model, Reductions, Variable};
use autogen_search::plant::{Faults, Watch};
use autogen_search::successor::Orders;
use autogen_search::unread::Unread;
use autogen_search::value::Var;
use autogen_search::violation::Violation;
use autogen_tests::bounds::BOUNDS;
use autogen_tests::outcome::{states_of, verdict};
use autogen_tests::searched::Common;
use autogen_tests::{Texts, ariac, is_full_campaign, own_line, scenes};
use runtime_sim::line::{Answer, IoDelay, Refusal, Slip};
use runtime_sim::random::Random;
use runtime_sim::run::{Stepping, run};

const ONE_PART: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}, {"name": "pump", "height": 0.11}],
    "orders": [{"station": "as3", "parts": {"battery": 1}}],
    "supply": {"surplus": [4, 1]}
}"#;
const TWO_PARTS: &str = r#"{
    "kinds": [{"name": "battery", "height": 0.053}, {"name": "pump", "height": 0.11}],
    "orders": [{"station": "as3", "parts": {"battery": 1, "pump": 1}}],
    "supply": {"surplus": [4, 1]}
}"#;

fn buffer(scenario: &str) -> Texts {
    Texts { scenario: Some(scenario.into()), ..own_line("buffer") }
}

/// The line with one place of its own type changed.
fn changed(from: &str, to: &str) -> Texts {
    let mut texts = buffer(TWO_PARTS);
    assert!(texts.specs[0].contains(from), "{from}");
    texts.specs[0] = texts.specs[0].replace(from, to);
    texts
}

/// The line with a type of the library in which something is changed.
fn with_library(scenario: &str, name: &str, from: &str, to: &str) -> Texts {
    let file = library::FILES.iter().find(|(file, _)| *file == format!("library/{name}.aut"));
    let text = file.expect("a type of the library").1;
    assert!(text.contains(from), "{from}");
    let mut texts = buffer(scenario);
    texts.specs.push(text.replace(from, to));
    texts
}

fn search(model: &Model, bounds: &Bounds) -> Outcome {
    explore(model, bounds, &mut |_| true)
}

fn model_of(project: &Project, faults: Faults) -> Model {
    model(project, &Asked::with(faults)).expect("a line that can be searched").model
}

#[test]
fn a_right_line_is_proved_without_faults() {
    for orders in [Orders::One, Orders::All] {
        let project = buffer(ONE_PART).project();
        let outcome = search(&model_of(&project, Faults::None), &Bounds { orders, ..BOUNDS });
        assert_eq!((outcome.end, outcome.violations.len()), (End::Complete, 0));
    }
}

/// Whatever devices do, all orders are made, or the line stops and says what somebody has to do.
#[test]
fn a_right_line_is_proved_with_faults() {
    let project = buffer(ONE_PART).project();
    let outcome = search(&model_of(&project, Faults::All), &BOUNDS);
    assert_eq!(outcome.end, End::Complete);
    assert!(outcome.violations.is_empty(), "{:?}", outcome.violations[0].0);
    assert!(outcome.covered.stops > 0);
}

#[test]
fn a_table_without_its_lock_has_two_arms_over_it_in_the_simulator_too() {
    let project = changed("held := true;", "").project();
    let model = model_of(&project, Faults::None);
    let outcome = search(&model, &BOUNDS);
    let [(violation, execution)] = &outcome.violations[..] else {
        panic!("{} violations", outcome.violations.len())
    };
    assert!(matches!(violation, Violation::TwoArms { .. }), "{violation:?}");
    let replay = replay(&project, &model, execution).expect("a run");
    assert!(replay.result.is_ok(), "{:?}", replay.result);
}

/// An item put 50 mm beside its slot: the other arm does not find it, in the simulator neither.
#[test]
fn an_item_that_is_put_beside_the_slots_is_found() {
    let texts = with_library(
        ONE_PART,
        "kitting",
        "define put_point = tray.places[n] + up(heights[k]);",
        "define put_point = tray.places[n] + up(heights[k]) + point(0.05, 0, 0);",
    );
    let project = texts.project();
    let model = model_of(&project, Faults::None);
    let outcome = search(&model, &BOUNDS);
    let [(Violation::NeverMade, execution)] = &outcome.violations[..] else {
        panic!("{:?}", outcome.violations)
    };
    let replay = replay(&project, &model, execution).expect("a run");
    assert!(!replay.report.finished, "{}", replay.report.reason);
}

#[test]
fn a_rack_with_one_part_is_proved() {
    let project = Texts { scenario: Some(ONE_PART.into()), ..own_line("rack") }.project();
    let outcome = search(&model_of(&project, Faults::All), &Bounds { answers: Some(1), ..BOUNDS });
    assert_eq!(verdict(&outcome), (End::Complete, Vec::new()));
    assert!(outcome.remarks.is_empty(), "{:?}", outcome.remarks[0].0);
}

/// Its boxes come on a conveyor without commands.
#[test]
fn orders_for_items_that_are_not_known_are_left_open() {
    let (_, texts) = scenes().into_iter().find(|(name, _)| name == "palletizer").expect("a scene");
    let outcome = search(&model_of(&texts.project(), Faults::All), &Bounds { answers: Some(1), ..BOUNDS });
    assert_eq!(verdict(&outcome), (End::Complete, Vec::new()));
    assert_eq!((outcome.orders, outcome.obligations), (Decided::ItemsAreHidden, Decided::ItemsAreHidden));
    assert!(outcome.remarks.is_empty());
}

/// Boxes come to the deck of a car on a track from a conveyor without commands.
#[test]
fn an_item_may_be_on_a_place_that_is_carried() {
    let (_, texts) = scenes().into_iter().find(|(name, _)| name == "transfer_car").expect("a scene");
    let project = texts.project();
    let model = model_of(&project, Faults::All);
    let outcome = search(&model, &BOUNDS);
    assert_eq!(verdict(&outcome), (End::Complete, Vec::new()));
    for (number, program) in model.instances.iter().enumerate() {
        for (state, text) in project.system.automaton_of(number).states.iter().enumerate() {
            let mut states = 0..outcome.reached.len();
            let is_reached =
                states.any(|of| program.state.load(&outcome.reached.state(of)) as usize == state);
            assert!(is_reached || outcome.entered.contains(&(number, state)), "{}", text.name);
        }
    }
}

#[test]
fn a_fault_is_found_and_its_course_is_the_shortest() {
    let project =
        changed("local next: int 0..11 := 0;", "local next: int 0..11 := 0; invariant not offer;").project();
    let model = model_of(&project, Faults::None);
    let outcome = search(&model, &BOUNDS);
    let [(Violation::Fault { .. }, execution)] = &outcome.violations[..] else {
        panic!("{:?}", outcome.violations)
    };
    assert_eq!(execution.scans.len(), outcome.covered.depth + 1);
    let replay = replay(&project, &model, execution).expect("a run");
    assert!(replay.report.reason.starts_with("fault "), "{}", replay.report.reason);
}

/// All places of the table are one.
#[test]
fn what_is_put_onto_an_item_where_items_stack_is_no_violation() {
    let found = |stacks: &str| {
        let piled = format!("slots: grid(point(0, 0, 0.725), 3, 0, 4, 0); by_kind: false;{stacks}");
        let from = "slots: grid(point(-0.2, -0.18, 0.725), 3, 0.20, 4, 0.12); by_kind: false;";
        // It takes both parts before it offers one.
        let both =
            ("when not held, first i in", "when not held and slot[0] = Full and slot[1] = Full, first i in");
        let project = with_library(TWO_PARTS, "devices/bin", from, &piled).replaced(&[both]).project();
        search(&model_of(&project, Faults::None), &BOUNDS)
    };
    let flat = found("");
    let [(violation, _)] = &flat.violations[..] else { panic!("{:?}", flat.violations) };
    assert!(matches!(violation, Violation::ItemOnItem { .. } | Violation::Dropped { .. }), "{violation:?}");
    let stacked = found(" stacks: true;");
    let is_put = |violation: &Violation| {
        matches!(
            violation,
            Violation::ItemOnItem { .. } | Violation::Dropped { .. } | Violation::ItemAmongItems { .. }
        )
    };
    assert!(!stacked.violations.iter().any(|(violation, _)| is_put(violation)), "{:?}", stacked.violations);
}

#[test]
fn a_search_that_is_cut_proves_nothing() {
    let model = model_of(&buffer(TWO_PARTS).project(), Faults::None);
    let outcome = search(&model, &Bounds { memory: 1, ..BOUNDS });
    assert_eq!(outcome.end, End::MemoryIsFull);
    let outcome = explore(&model, &BOUNDS, &mut |_| false);
    assert_eq!(outcome.end, End::Stopped);
}

/// A missed grip leads there in fewer scans.
#[test]
fn what_is_found_has_as_few_faults_as_possible() {
    let project = changed(
        "local next: int 0..11 := 0;",
        "local next: int 0..11 := 0; invariant not missed and slot[1] <> Full;",
    )
    .project();
    let [all, none] = [Faults::All, Faults::None].map(|faults| search(&model_of(&project, faults), &BOUNDS));
    let scans = |outcome: &Outcome| outcome.violations[0].1.scans.len();
    assert_eq!(verdict(&all), verdict(&none));
    assert_eq!(scans(&all), scans(&none));
    let missed = changed("local next: int 0..11 := 0;", "local next: int 0..11 := 0; invariant not missed;");
    let missed = search(&model_of(&missed.project(), Faults::All), &BOUNDS);
    assert!(scans(&missed) < scans(&all));
    assert_eq!((all.covered.failing, missed.covered.failing), (None, Some(0)));
}

/// Of the sequences with few faults it is decided whether the orders can be made.
#[test]
fn a_search_that_is_cut_has_checked_all_with_few_faults() {
    let model = model_of(&buffer(ONE_PART).project(), Faults::All);
    let whole = search(&model, &BOUNDS);
    let mut states = 0;
    for failing in 0..3 {
        let cut = explore(&model, &BOUNDS, &mut |covered| covered.failing != Some(failing));
        assert_eq!(verdict(&cut), (End::Stopped, Vec::new()));
        assert!(states < cut.reached.len() && cut.reached.len() < whole.reached.len());
        states = cut.reached.len();
    }
    let model =
        model_of(&changed("when taken -> Ready", "when taken and missed -> Ready").project(), Faults::All);
    let cut = explore(&model, &BOUNDS, &mut |covered| covered.failing.is_none());
    assert_eq!(verdict(&cut), (End::Stopped, vec!["NeverMade".into()]));
}

/// A search that begins anew tells how far it has come before.
#[test]
fn a_search_that_is_cut_when_it_begins_anew_tells_what_was_checked() {
    let model = model_of(&buffer(ONE_PART).project(), Faults::All);
    let (mut before, mut begins_anew) = (Covered::default(), false);
    let cut = explore(&model, &BOUNDS, &mut |covered| {
        begins_anew |= before.failing.is_some() && covered.states < before.states;
        if !begins_anew {
            before = *covered;
        }
        !begins_anew
    });
    assert!(begins_anew);
    assert_eq!(cut.covered.failing, before.failing);
    assert!(cut.covered.states >= before.states);
}

/// Without reductions all paths to the orders are kept, which takes more memory than there is left.
#[test]
fn a_limit_of_memory_holds_for_what_comes_after_the_search() {
    let model =
        model_of(&Texts { scenario: Some(ONE_PART.into()), ..ariac("default") }.project(), Faults::None);
    let plain = Model { reductions: Reductions::Off, ..model };
    let mut most = 0;
    let whole = explore(&plain, &BOUNDS, &mut |covered| {
        most = most.max(covered.memory);
        true
    });
    assert!(whole.is_proved() && whole.orders == Decided::Yes);
    // How much a search takes depends a little on how fast the processors are: it looks at as many states at once as it can
    // in a given time.
    let limits = (6..16).map(|eighths| most / 8 * eighths);
    let mut cuts = limits.map(|memory| search(&plain, &Bounds { memory, ..BOUNDS }));
    let cut = cuts.find(|cut| verdict(cut).0 == End::Complete).expect("a limit that the search keeps");
    assert_eq!((verdict(&cut).1, cut.orders), (Vec::new(), Decided::NotReached));
    assert!(!cut.is_proved());
}

/// Both may be seen on the conveyor at the same time.
#[test]
fn kinds_of_equal_height_are_told_apart() {
    let scenario = ONE_PART.replace("0.11", "0.053").replace(r#""battery": 1"#, r#""pump": 1"#);
    let outcome = search(&model_of(&buffer(&scenario).project(), Faults::All), &BOUNDS);
    assert_eq!(verdict(&outcome), (End::Complete, Vec::new()));
}

/// Violations and whether the search was complete.
#[test]
fn forgetting_what_is_of_no_use_changes_no_verdict() {
    let lines = [
        (buffer(ONE_PART), Faults::All),
        (buffer(TWO_PARTS), Faults::None),
        (changed("held := true;", ""), Faults::None),
        (changed("slot[next] := Free;", ""), Faults::None),
    ];
    let mut saved = 0;
    for (texts, faults) in lines {
        let model = model_of(&texts.project(), faults);
        let mut whole = Model { unread: Unread::default(), ..model.clone() };
        for state in whole.instances.iter_mut().flat_map(|instance| &mut instance.states) {
            state.dead.clear();
            state.unread.clear();
            state.is_answer_dead = false;
            state.is_error_dead = false;
        }
        let bounds = Bounds { answers: Some(1), violations: 100, ..BOUNDS };
        let (less, more) = (search(&model, &bounds), search(&whole, &bounds));
        assert_eq!(verdict(&less), verdict(&more));
        saved += more.covered.states - less.covered.states;
    }
    println!("{saved} states fewer");
}

/// Lines without mistakes, and some with one.
fn right_and_wrong() -> [(Texts, Faults); 6] {
    [
        (buffer(ONE_PART), Faults::All),
        (buffer(TWO_PARTS), Faults::None),
        (changed("held := true;", ""), Faults::None),
        (changed("offer := false;", ""), Faults::None),
        (changed("slot[next] := Free;", ""), Faults::None),
        (changed("open := true;", ""), Faults::None),
    ]
}

/// All else is as it would be if everything was remembered, in right lines and in wrong ones.
#[test]
fn what_nobody_reads_leaves_all_else_as_it_is() {
    let mut saved = 0;
    for (number, (texts, faults)) in right_and_wrong().into_iter().enumerate() {
        let model = model_of(&texts.project(), faults);
        let whole = Model { unread: Unread::default(), ..model.clone() };
        let unread: Vec<Var> = model.unread.vars().collect();
        assert!(!unread.is_empty());
        let is_kept = |variable: &Variable| !unread.contains(&variable.var);
        for orders in [Orders::One, Orders::All].into_iter().take(if number == 0 { 2 } else { 1 }) {
            let bounds = Bounds { answers: Some(1), violations: 100, orders, ..BOUNDS };
            let (less, more) = (search(&model, &bounds), search(&whole, &bounds));
            assert_eq!(verdict(&less), verdict(&more));
            assert_eq!(states_of(&model, &less, is_kept), states_of(&model, &more, is_kept));
            saved += more.reached.len() - less.reached.len();
        }
    }
    assert!(saved > 0);
    println!("{saved} states fewer");
}

/// Every instance steps in every scan, and ways to an end may have any number of answers. All orders of steps take minutes:
/// the short form compares them on smaller lines, `searched_properties.rs`.
#[test]
fn leaving_out_what_does_nothing_changes_no_verdict() {
    let mut found = 0;
    for (texts, faults) in right_and_wrong() {
        let model = model_of(&texts.project(), faults);
        let plain = Model { reductions: Reductions::Off, ..model.clone() };
        let count = if is_full_campaign() { 2 } else { 1 };
        for orders in [Orders::One, Orders::All].into_iter().take(count) {
            let bounds = Bounds { answers: Some(1), violations: 100, orders, ..BOUNDS };
            let (less, more) = (search(&model, &bounds), search(&plain, &bounds));
            assert_eq!(verdict(&less), verdict(&more));
            assert_eq!(less.covered.states, more.covered.states);
            found += less.violations.len();
        }
    }
    assert!(found > 0);
}

/// Several processors reach the same states in the same order, and find the same executions.
#[test]
fn processors_change_nothing() {
    let lines = [
        (buffer(ONE_PART), Faults::All, Some(1), Orders::One),
        (changed("held := true;", ""), Faults::None, Some(1), Orders::One),
        (changed("slot[next] := Free;", ""), Faults::None, Some(1), Orders::All),
        (buffer(ONE_PART), Faults::All, None, Orders::One),
        (Texts { scenario: Some(ONE_PART.into()), ..ariac("default") }, Faults::None, None, Orders::One),
    ];
    for (texts, faults, answers, orders) in lines {
        let model = model_of(&texts.project(), faults);
        let bounds = Bounds { answers, violations: 3, orders, ..BOUNDS };
        let one = search(&model, &bounds);
        for jobs in [2, 5] {
            let several = search(&model, &Bounds { jobs, ..bounds });
            assert_eq!(several.covered.transitions, one.covered.transitions);
            assert_eq!(
                (several.reached.len(), several.covered.depth),
                (one.reached.len(), one.covered.depth)
            );
            let states = 0..one.reached.len();
            assert!(states.into_iter().all(|s| several.reached.state(s) == one.reached.state(s)));
            assert_eq!(several.values.points(), one.values.points());
            if one.end == End::Complete {
                assert_eq!(several.occurred, one.occurred);
            }
            assert_eq!(format!("{:?}", several.violations), format!("{:?}", one.violations));
        }
    }
}

/// With few answers in a scan there are fewer states, never others.
#[test]
fn few_answers_reach_a_part_of_the_states() {
    let mut model = model_of(&buffer(ONE_PART).project(), Faults::None);
    model.reductions = Reductions::OfScans;
    let all = search(&model, &BOUNDS);
    let one = search(&model, &Bounds { answers: Some(1), ..BOUNDS });
    assert!((0..one.reached.len()).all(|state| all.reached.find(&one.reached.state(state)).is_some()));
    assert!(one.reached.len() <= all.reached.len());
}

/// The long form: 1,000 runs. Every scan of every run is a state that was reached.
#[test]
fn simulated_runs_stay_within_the_states() {
    let runs = if is_full_campaign() { 1000 } else { 40 };
    let mut random = Random::new(1);
    let (mut scans, mut outside) = (0, Vec::new());
    for order in 0..runs / 20 {
        let texts = Texts { order: (order > 0).then_some(order), ..buffer(ONE_PART) };
        let project = texts.project();
        let mut model = model_of(&project, Faults::All);
        model.watch = Watch::Faults;
        model.unread = Unread::default();
        model.reductions = Reductions::OfScans;
        let outcome = search(&model, &Bounds { memory: 2_000_000_000, ..BOUNDS });
        assert_eq!(outcome.end, End::Complete);
        let common = Common::new(&project, &model);
        let all = common.of_all(&outcome.reached);
        for number in 0..20_u64 {
            let mut line = project.plant.clone();
            let machines = line.machines.len() as u32;
            let scenario = &mut line.scenario;
            let arms: Vec<usize> =
                (0..machines as usize).filter(|m| project.plant.machines[*m].has("grip")).collect();
            for pick in 1..4 {
                for machine in &arms {
                    if random.up_to(2) == 0 {
                        let after_s = f64::from(random.up_to(9000)) / 1000.0;
                        scenario.slips.push(Slip { machine: *machine, pick, after_s });
                    }
                }
            }
            let commanded: Vec<usize> =
                (0..machines as usize).filter(|m| project.plant.machines[*m].wiring.is_commanded()).collect();
            for machine in commanded {
                for command in 1..40 {
                    match random.up_to(15) {
                        0 => scenario.refusals.push(Refusal { machine, command }),
                        1 => scenario.answers.push(Answer {
                            machine,
                            command,
                            late_s: f64::from(random.up_to(3000)) / 1000.0,
                            error: (random.up_to(2) == 0).then_some(2),
                        }),
                        _ => {}
                    }
                }
            }
            line.io_delay = match number % 3 {
                0 => IoDelay::Fixed(0),
                1 => IoDelay::Fixed(3),
                _ => IoDelay::Random { max: 5, seed: number },
            };
            scenario.time_limit_s = 300.0;
            let mut executor = Executor::new(&project.system);
            let mut last = Vec::new();
            let mut is_outside = false;
            let report = run(&line, &mut executor, Stepping::Events, &mut |seen| {
                let found = common.of_trace(seen.trace);
                scans += 1;
                // Behind a stop nothing is searched.
                if seen.answer.running && found != last && !is_outside && !all.contains(&found) {
                    is_outside = true;
                    let difference = common.difference(&found, &all);
                    outside.push(format!("order {order}, run {number}, scan {}: {difference}", seen.scan));
                }
                last = found;
            });
            report.expect("a line that can be run");
        }
    }
    println!("{runs} runs, {scans} scans");
    assert!(outside.is_empty(), "{} of {runs} runs leave the states:\n{}", outside.len(), outside.join("\n"));
}
