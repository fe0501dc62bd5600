//! What is left out when a run goes from event to event: nothing that anybody could see.
//!
//! The long form: `AUTOGEN_CAMPAIGN=full cargo test --profile optimized -p autogen-tests stepping::`.

use autogen::executor::Executor;
use autogen::ir::{Element, Expr, PropertyKind, System, Value};
use autogen::reads::{self, Reads};
use autogen_tests::generate::generate;
use autogen_tests::lots::Lots;
use autogen_tests::{Texts, ariac, examples, is_full_campaign, on_all_processors, own_line, prototype};
use runtime_sim::line::{IoDelay, Line, Pause, Refusal, Slip};
use runtime_sim::memory::Memory;
use runtime_sim::random::Random;
use runtime_sim::run::{Seen, Stepping, run_again};
use runtime_sim::scan::Controllers;

/// A run by name, and what is done to its line.
pub struct Case {
    pub name: String,
    pub texts: Texts,
    pub change: Box<dyn Fn(&mut Line) + Sync + Send>,
}

fn case(name: &str, texts: Texts, change: impl Fn(&mut Line) + Sync + Send + 'static) -> Case {
    Case { name: name.into(), texts, change: Box::new(change) }
}

fn machine(line: &Line, name: &str) -> usize {
    line.machines.iter().position(|machine| machine.name == name).expect("a machine of the layout")
}

pub fn cases() -> Vec<Case> {
    let mut cases: Vec<Case> =
        examples().into_iter().map(|(name, texts)| case(&name, texts, |_| {})).collect();
    let delays =
        [IoDelay::Fixed(1), IoDelay::Fixed(5), IoDelay::Random { max: 5, seed: 9 }, IoDelay::Fixed(40)];
    for delay in delays {
        let name = format!("default, {delay:?}");
        cases.push(case(&name, ariac("default"), move |line| line.io_delay = delay.clone()));
    }
    cases.push(case("buffer, late", own_line("buffer"), |line| {
        line.io_delay = IoDelay::Random { max: 3, seed: 2 };
    }));
    cases.push(case("rack", own_line("rack"), |_| {}));
    cases.push(case("a tank whose times are rounded", tank(), |_| {}));
    cases.push(case("order 5", Texts { order: Some(5), ..ariac("spaced") }.set("agv.capacity=3"), |_| {}));
    cases.push(case("losses of power", ariac("default"), |line| {
        let off = |at_scan| Pause { at_scan, scans: 1 + at_scan % 300 };
        line.scenario.power_offs = [1, 5000, 5701, 9000, 12_000, 33_333].map(off).into();
    }));
    cases.push(case("pauses", ariac("default"), |line| {
        let pause = |at_scan| Pause { at_scan, scans: 700 };
        line.scenario.pauses = [3, 5000, 5701, 9000, 12_000].map(pause).into();
    }));
    cases.push(case("slips", ariac("default"), |line| {
        let slip = |machine, pick, after_s| Slip { machine, pick, after_s };
        let (kitting, gantry) = (machine(line, "kitting"), machine(line, "gantry"));
        line.scenario.slips = vec![slip(kitting, 3, 0.5), slip(gantry, 2, 3.0)];
    }));
    cases.push(case("refusals", ariac("default"), |line| {
        let refused = ["kitting", "gantry", "agv1", "agv2", "conveyor_belt"].map(|name| machine(line, name));
        let refusals = refused.into_iter().flat_map(|m| [2, 5, 9].map(|command| (m, command)));
        line.scenario.refusals = refusals.map(|(machine, command)| Refusal { machine, command }).collect();
    }));
    cases.push(case("deadlock", ariac("default"), |line| {
        line.scenario.supply[0].items.truncate(5);
        line.scenario.stall_limit_s = 33.33;
    }));
    cases.push(case("a part that nobody wants is the last", ariac("default"), |line| {
        line.scenario.orders.truncate(1);
        line.scenario.supply[0].items = vec![0, 1, 2, 0, 0];
        line.scenario.stall_limit_s = 20.0;
    }));
    cases.push(case("a slow contact", prototype("default").set("gantry.speed=0.003"), |line| {
        line.may_touch.clear();
        line.scenario.time_limit_s = if is_full_campaign() { 4000.0 } else { 800.0 };
    }));
    cases.push(case("an alarm of one scan", alarmed(), |_| {}));
    cases.push(case("time limit", ariac("default"), |line| line.scenario.time_limit_s = 123.456));
    cases.push(case("contact", prototype("default"), |line| line.may_touch.clear()));
    if is_full_campaign() {
        for layout in autogen_tests::LAYOUTS {
            for capacity in 1..=12 {
                let texts = ariac(layout).set(&format!("agv.capacity={capacity}"));
                cases.push(case(&format!("{layout}, {capacity}"), texts, |_| {}));
            }
            for order in 1..=40 {
                let texts = Texts { order: Some(order), ..ariac(layout) };
                let delay = IoDelay::Random { max: 5, seed: order };
                cases.push(case(&format!("{layout}, order {order}"), texts, move |line| {
                    line.io_delay = delay.clone();
                }));
            }
        }
    }
    cases
}

/// A machine that gives a command and raises an alarm which ends in the scan after, again and again.
fn alarmed() -> Texts {
    let device = "device shaker {
            part arm = positioner { positions: [0, 0.5]; slides: point(0, 0, 1); speed: 0.5; };
            out to: int 0..1;
            command 1 go(to) = arm.to(to);
        }
        automaton Shaker on shaker {
            local n: int 0..1;
            keep n while n >= 0 else warn \"the position is another one\";
            initial -> Going { go(0); }
            state Going { when done -> Going { n := 1 - n; go(n); } }
        }";
    Texts {
        layout: r#"{"robots": [{"name": "shaker", "type": "shaker", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![device.into()],
        scenario: Some(r#"{"time_limit_s": 20}"#.into()),
        ..Texts::default()
    }
}

/// A tank that is full after 8.1 s. By the numbers of the simulator its level is 2e-16 m below the rim then.
fn tank() -> Texts {
    let device = "device tanker {
            part vessel = tank { area: 2.1; height: 1.47; inflow: 0.21; outflow: 0.5; begins: 0.66; };
            in is_empty: bool = vessel.is_empty;
            in is_full: bool = vessel.is_full;
            out fill: bool = vessel.fill;
            out drain: bool = vessel.drain;
        }
        automaton Tanker on tanker {
            initial -> Filling { fill := true; }
            state Filling { when is_full -> Full {} }
            state Full { when after 1 s -> Draining { fill := false; drain := true; } }
            state Draining { when is_empty -> Empty { drain := false; } }
            final state Empty;
        }";
    Texts {
        layout: r#"{"robots": [{"name": "tanker", "type": "tanker", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![device.into()],
        scenario: Some(r#"{"time_limit_s": 60}"#.into()),
        ..Texts::default()
    }
}

/// Of a run of the short form.
pub const MOST_ORDERS: usize = 2;

#[test]
fn events_and_every_scan_are_the_same() {
    let cases = cases();
    let wrong = on_all_processors(&cases, |case| {
        let project = case.texts.project();
        let mut line = project.plant.clone();
        (case.change)(&mut line);
        if !is_full_campaign() {
            line.scenario.orders.truncate(MOST_ORDERS);
        }
        let execute = |line: &Line, stepping, memory: &mut Memory| {
            run_again(line, &mut Executor::new(&project.system), stepping, memory, &mut |_| {})
        };
        let anew = |stepping| execute(&line, stepping, &mut Memory::default());
        let every = anew(Stepping::EveryScan).expect("a line that can be run");
        let events = anew(Stepping::Events).expect("a line that can be run");
        // What is remembered comes from another run of these machines.
        let mut memory = Memory::default();
        execute(&project.plant, Stepping::Events, &mut memory).expect("a line that can be run");
        let again = execute(&line, Stepping::Events, &mut memory).expect("a line that can be run");
        println!("{}: {} scans, {}", case.name, every.scans, every.reason);
        let mut wrong = Vec::new();
        if events != every {
            wrong.push(format!("{}: {:#?}\nbut with every scan {:#?}", case.name, events, every));
        }
        if again != events {
            wrong.push(format!("{}: another result with memory", case.name));
        }
        let beside = execute(&line, Stepping::Events, &mut memory.beside()).expect("a line that can be run");
        if beside != events {
            wrong.push(format!("{}: another result beside another run", case.name));
        }
        if !project.differs(&line) {
            let mut other = line.clone();
            other.scenario.seed += 1;
            let other =
                execute(&other, Stepping::Events, &mut memory.beside()).expect("a line that can be run");
            if other != events {
                wrong.push(format!("{}: nothing is drawn, but another seed has another result", case.name));
            }
        }
        wrong.extend(anew(Stepping::Checked).err().map(|text| format!("{}: {text}", case.name)));
        wrong
    });
    let wrong: Vec<String> = wrong.into_iter().flatten().collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Arms of the library read where their tool is, but only in case of an item that was lost: that they move is no reason
/// to execute a scan.
#[test]
fn an_arm_that_moves_wakes_nobody() {
    let project = ariac("default").project();
    let mut line = project.plant.clone();
    line.scenario.orders.truncate(MOST_ORDERS);
    let mut executed = 0;
    let mut controllers = Executor::new(&project.system);
    let mut count = |_: &Seen| executed += 1;
    let report = run_again(&line, &mut controllers, Stepping::Events, &mut Memory::default(), &mut count);
    let scans = report.expect("a line that can be run").scans;
    println!("{executed} of {scans} scans");
    assert!(executed * 30 < scans, "{executed} of {scans} scans");
}

/// A scan in which only inputs change that no present state reads does nothing, unless a timer ends.
#[test]
fn what_a_state_does_not_read_does_not_move_it() {
    let seeds: Vec<u64> = (1..=if is_full_campaign() { 20 } else { 2 }).collect();
    let counts = on_all_processors(&seeds, |seed| {
        let made = generate(*seed, 49);
        made.layouts.iter().map(|system| quiet_scans(system, *seed)).sum::<usize>()
    });
    let quiet: usize = counts.iter().sum();
    println!("{quiet} scans in which nothing happened");
    assert!(quiet > 200 * seeds.len(), "only {quiet} quiet scans");
}

fn quiet_scans(system: &System, seed: u64) -> usize {
    let mut executor = Executor::new(system);
    let mut lots = Lots::new(system, seed);
    let mut random = Random::new(seed);
    let mut outputs = vec![Vec::new(); system.instances.len()];
    let stays = executor.stays();
    let remembered = |executor: &Executor| {
        let mut trace = Vec::new();
        executor.trace(&mut trace);
        trace
    };
    let counters = counters(system);
    let without_times = |trace: &[f64]| -> Vec<u64> {
        let is_time = |word: &usize| stays.contains(word) || counters.iter().any(|c| c.word == *word);
        let words = trace.iter().enumerate().filter(|(word, _)| !is_time(word));
        words.map(|(_, value)| value.to_bits()).collect()
    };
    let stopped = stopped(system);
    let mut given = lots.next(system, &outputs);
    let mut before = executor.scan(given, &lots.images, &mut outputs);
    let (mut acted, mut quiet) = (true, 0);
    for _ in 0..6000 {
        let trace = remembered(&executor);
        let mut may_act = acted;
        if acted || random.up_to(6) == 0 {
            given = lots.next(system, &outputs);
            given.run_permit = true;
            may_act = true;
        }
        for instance in 0..system.instances.len() {
            let automaton = system.automaton_of(instance);
            let reads = Reads::of_state(automaton, &automaton.states[executor.state(instance)]);
            let mut read = reads.words(system.kinds());
            let behind = reads.words_while(system.kinds()).into_iter();
            read.extend(behind.filter(|read| read.is_read(&lots.images[instance])).map(|read| read.word));
            for word in (0..lots.images[instance].len()).filter(|word| !read.contains(word)) {
                lots.images[instance][word] = f64::from(random.up_to(12)) - 2.0;
            }
            let stay = trace[stays[instance]];
            for time in &reads.timers {
                let is_fixed = reads::is_fixed(automaton, time);
                may_act |= !is_fixed;
                if is_fixed && let Value::Int(time) = executor.value(instance, time) {
                    may_act |= stay < f64::from(time) && f64::from(time) <= stay + f64::from(system.scan_ms);
                }
            }
        }
        for Counter { instance, word, within } in &counters {
            let (automaton, waited) = (system.automaton_of(*instance), trace[*word]);
            let is_fixed = reads::is_fixed(automaton, within);
            may_act |= waited >= 0.0 && !is_fixed;
            if is_fixed && let Value::Int(time) = executor.value(*instance, within) {
                let next = waited + f64::from(system.scan_ms);
                may_act |= waited >= 0.0 && waited < f64::from(time) && f64::from(time) <= next;
            }
        }
        let answer = executor.scan(given, &lots.images, &mut outputs);
        let after = remembered(&executor);
        let passed = if answer.running { f64::from(system.scan_ms) } else { 0.0 };
        let is_stopped = |instance: usize| stopped[instance].is_some_and(|word| trace[word] != 0.0);
        let restarted = stays.iter().enumerate().any(|(instance, stay)| {
            let lasts = if is_stopped(instance) { 0.0 } else { trace[*stay] + passed };
            after[*stay] != lasts
        });
        let counted = counters.iter().any(|Counter { word, .. }| {
            let waits = if trace[*word] < 0.0 { trace[*word] } else { trace[*word] + passed };
            after[*word] != waits
        });
        acted = restarted || counted || answer != before || without_times(&trace) != without_times(&after);
        assert!(may_act || !acted, "seed {seed}: something happens though nothing was read");
        quiet += usize::from(!may_act && answer.running);
        before = answer;
    }
    quiet
}

/// What a property waits for: the word of its time in the trace, and how long it may be.
struct Counter<'a> {
    instance: usize,
    word: usize,
    within: &'a Expr,
}

fn counters(system: &System) -> Vec<Counter<'_>> {
    let mut found = Vec::new();
    for (instance, begin) in (0..system.instances.len()).zip(system.traces()) {
        let values = system.values_of(instance, begin);
        for property in &system.automaton_of(instance).properties {
            if let PropertyKind::Whenever { within, waited, .. } = &property.kind {
                let element = Element::Local { robot: instance, local: *waited, index: 0 };
                let word = values.iter().find(|value| value.element == element).and_then(|value| value.trace);
                found.push(Counter { instance, word: word.expect("a word of the trace"), within });
            }
        }
    }
    found
}

/// Of each instance the word that says whether an alarm has stopped it, if one can.
fn stopped(system: &System) -> Vec<Option<usize>> {
    let traces = system.traces();
    let word = |instance: usize| {
        let automaton = system.automaton_of(instance);
        automaton.can_stop().then(|| traces[instance + 1] - automaton.alarm_words())
    };
    (0..system.instances.len()).map(word).collect()
}
