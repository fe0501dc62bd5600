//! Whole runs.

mod common;

use common::*;
use runtime_sim::carrier::Carrier;
use runtime_sim::event::Event;
use runtime_sim::item::Items;
use runtime_sim::line::{Goal, IoDelay, Line, Pause, Slip};
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, run};
use runtime_sim::scan::{Controllers, SystemInputs, SystemOutputs};

const DELAYS: [IoDelay; 4] =
    [IoDelay::Fixed(0), IoDelay::Fixed(1), IoDelay::Fixed(5), IoDelay::Random { max: 5, seed: 3 }];

fn follow(line: &Line, steps: Vec<Step>) -> Report {
    run(line, &mut Script::new(steps), Stepping::EveryScan, &mut |_: &Seen| {}).unwrap()
}

#[test]
fn an_order_is_made_however_late_the_answers_are() {
    let mut times = Vec::new();
    for delay in DELAYS {
        let mut line = line();
        line.io_delay = delay;
        for machine in 0..line.machines.len() {
            line.machines[machine].states = states(vec![BELT, GANTRY]);
        }
        let report = follow(&line, whole_order());
        assert!(report.finished, "{}", report.reason);
        assert_eq!(report.reason, "all orders made");
        assert_eq!((report.orders_done, report.orders), (1, 1));
        for machine in &report.machines {
            let a = &machine.account;
            assert_eq!(a.moving + a.working + a.waiting + a.stopped, report.scans, "{}", machine.name);
            assert_eq!(a.stopped, 2, "the start comes in scan 2");
        }
        assert!(report.items.iter().all(|item| item.carrier == "order 1"), "{:?}", report.items);
        assert_eq!(report.order_times[0].made_s, Some(report.simulated_s));
        times.push(report.scans);
    }
    assert!(times[0] < times[1] && times[1] < times[2], "{times:?}");
    assert!(times[3] > times[0] && times[3] < times[2], "{times:?}");
}

#[test]
fn the_same_run_twice_has_the_same_trace() {
    let mut line = line();
    line.io_delay = IoDelay::Random { max: 5, seed: 3 };
    let first = follow(&line, whole_order());
    assert_eq!(first, follow(&line, whole_order()));
    line.io_delay = IoDelay::Random { max: 5, seed: 4 };
    assert_ne!(first.trace_hash, follow(&line, whole_order()).trace_hash);
}

/// Drives and halts the belt, each as soon as the answer to the one before is there.
struct Restless {
    answered: Vec<u64>,
    scan: u64,
}

impl Controllers for Restless {
    fn scan(&mut self, _: SystemInputs, inputs: &[Vec<f64>], outputs: &mut [Vec<f64>]) -> SystemOutputs {
        let (input, output) = (&inputs[BELT], &mut outputs[BELT]);
        if input[input::ACK] == output[output::CMD] {
            self.answered.push(self.scan);
            let verb = if output[output::VERB] == DRIVE { HALT } else { DRIVE };
            command(output, verb, None);
        }
        self.scan += 1;
        SystemOutputs { running: true, fault: self.answered.len() > 100, ..SystemOutputs::default() }
    }

    fn state(&self, _: usize) -> usize {
        0
    }

    fn trace(&self, _: &mut Vec<f64>) {}

    fn stays(&self) -> Vec<usize> {
        Vec::new()
    }

    fn power_up(&mut self) {}

    fn skip(&mut self, _: u64) {}
}

#[test]
fn the_answer_to_the_last_command_is_never_taken_for_this_one() {
    for delay in DELAYS {
        let mut line = line();
        line.io_delay = delay.clone();
        let mut restless = Restless { answered: vec![], scan: 0 };
        run(&line, &mut restless, Stepping::EveryScan, &mut |_| {}).unwrap();
        let gaps: Vec<u64> = restless.answered.windows(2).map(|pair| pair[1] - pair[0]).collect();
        match delay {
            // The command acts in its scan, and its answer is there a scan later, and so many more.
            IoDelay::Fixed(late) => assert!(gaps.iter().all(|&gap| gap == u64::from(late) + 1), "{gaps:?}"),
            IoDelay::Random { max, .. } => {
                assert!(gaps.iter().all(|&gap| (1..=u64::from(max) + 1).contains(&gap)), "{gaps:?}");
            }
        }
    }
}

#[test]
fn a_machine_moves_from_its_command_to_the_answer() {
    let mut line = line();
    for (delay, moving) in [(0, 376), (5, 381)] {
        line.io_delay = IoDelay::Fixed(delay);
        let report = follow(&line, whole_order());
        assert_eq!(report.machines[AGV].account.moving, moving, "once to the near stop");
        assert_eq!(report.machines[STATION].account.moving, 0);
    }
}

/// Remembers something that no output shows.
struct Pensive(Script, f64);

impl Controllers for Pensive {
    fn scan(&mut self, s: SystemInputs, i: &[Vec<f64>], o: &mut [Vec<f64>]) -> SystemOutputs {
        self.0.scan(s, i, o)
    }

    fn state(&self, machine: usize) -> usize {
        self.0.state(machine)
    }

    fn trace(&self, out: &mut Vec<f64>) {
        out.push(self.1);
    }

    fn stays(&self) -> Vec<usize> {
        Vec::new()
    }

    fn power_up(&mut self) {}

    fn skip(&mut self, _: u64) {}
}

#[test]
fn the_trace_tells_what_the_controllers_remember() {
    let hash = |memory: f64, steps: Vec<Step>| {
        let mut hashes = Vec::new();
        let mut controllers = Pensive(Script::new(steps), memory);
        let report =
            run(&line(), &mut controllers, Stepping::EveryScan, &mut |seen: &Seen| hashes.push(seen.hash))
                .unwrap();
        assert_eq!(hashes.last(), Some(&report.trace_hash));
        assert_eq!(hashes.len() as u64, report.scans);
        hashes
    };
    let ordinary = hash(1.0, whole_order());
    assert_eq!(ordinary, hash(1.0, whole_order()));
    assert_ne!(ordinary[0], hash(-1.0, whole_order())[0]);
    // The first command comes with the start, in scan 2.
    let other = hash(1.0, vec![Step::Command(BELT, HALT, None)]);
    assert_eq!(ordinary[..2], other[..2]);
    assert_ne!(ordinary[2], other[2]);
}

#[test]
fn an_order_behind_another_is_named() {
    let mut line = line();
    line.scenario.orders = vec![line.scenario.orders[0].clone(); 2];
    line.scenario.stall_limit_s = 3.0;
    let mut steps = whole_order();
    steps.pop();
    let report = follow(&line, steps);
    assert_eq!(report.reason, "deadlock: 1 more of as1 cannot open while `complete` is set");
    assert_eq!((report.orders_done, report.orders), (1, 2));
    assert!(report.order_times[1].opened_s.is_none());
    let report = follow(&line, whole_order());
    assert!(report.reason.starts_with("deadlock: order 2 at as1 lacks battery (none left)"));
    // It is made by scan n, in which that is seen; n+1 takes `complete` back, n+2 sees nothing, n+3 the next order.
    let gap = report.order_times[1].opened_s.unwrap() - report.order_times[0].made_s.unwrap();
    assert!((gap - 0.03).abs() < 1e-9, "{gap}");
}

#[test]
fn orders_without_end_are_made_until_the_time_limit() {
    let mut line = line();
    line.scenario.goal = Goal::TimeLimit;
    line.scenario.orders = vec![line.scenario.orders[0].clone(); 3];
    line.scenario.time_limit_s = 300.0;
    line.scenario.stall_limit_s = 1000.0;
    assert_eq!(Line::from_text(&line.to_text()), Ok(line.clone()));
    let report = follow(&line, whole_order());
    assert!(report.finished, "{}", report.reason);
    assert_eq!((report.reason.as_str(), report.simulated_s), ("time limit reached", 300.0));
    assert_eq!((report.orders_done, report.orders, report.seconds_per_order), (1, 1, Some(300.0)));
    // The third has not opened, and nothing is left on the line.
    let times: Vec<_> = report.order_times.iter().map(|times| times.made_s.is_some()).collect();
    assert_eq!(times, [true, false]);
    assert_eq!(report.items, []);

    line.scenario.orders.truncate(1);
    let report = follow(&line, whole_order());
    assert!(!report.finished);
    assert_eq!(report.reason, "all 1 orders made before the time limit");
}

#[test]
fn pauses_cost_time_and_nothing_else() {
    let undisturbed = follow(&line(), whole_order());
    let mut line = line();
    line.scenario.pauses = (1..20).map(|i| Pause { at_scan: i * 200, scans: 37 }).collect();
    let report = follow(&line, whole_order());
    assert!(report.finished, "{}", report.reason);
    assert!(report.scans > undisturbed.scans + 19 * 37);
    // The pause, and the scan until the edge of start.
    assert_eq!(report.machines[0].account.stopped, 2 + 19 * 38);
}

#[test]
fn a_lost_part_is_named_with_its_place() {
    let mut line = line();
    line.scenario.slips = vec![Slip { machine: GANTRY, pick: 2, after_s: 2.0 }];
    line.scenario.stall_limit_s = 5.0;
    let report = follow(&line, whole_order());
    assert!(!report.finished);
    assert!(
        report.reason.starts_with(
            "deadlock: order 1 at as1 lacks pump (none left); pump (item 1) lies on the floor at (-"
        ),
        "{}",
        report.reason
    );
    assert_eq!((report.orders_done, report.seconds_per_order), (0, None));
    assert_eq!(report.items[1].carrier, "floor");
    assert_eq!(report.items[0].carrier, "briefcase of as1");
}

#[test]
fn ends_that_are_no_success() {
    let mut line = line();
    line.scenario.time_limit_s = 3.0;
    let report = follow(&line, whole_order());
    assert_eq!(report.reason, "time limit: order 1 at as1 lacks battery, pump");
    assert_eq!((report.scans, report.simulated_s), (300, 3.0));

    line.scenario.time_limit_s = 1000.0;
    let report = follow(&line, vec![Step::Fault(12, AGV as i32)]);
    assert_eq!((report.reason.as_str(), report.scans), ("fault 12 of agv", 3));
    assert_eq!(follow(&line, vec![Step::Fault(7, -1)]).reason, "fault 7");

    // Nothing ever moves: 120 s after the last change, the start.
    let report = follow(&line, vec![]);
    assert_eq!(report.reason, "deadlock: order 1 at as1 lacks battery, pump");
    assert!((report.simulated_s - 120.02).abs() < 0.05, "{}", report.simulated_s);

    // The belt runs until it has nothing more to bring.
    let report = follow(&line, vec![Step::Command(BELT, DRIVE, None)]);
    assert_eq!(
        report.reason,
        "deadlock: order 1 at as1 lacks battery (none left), pump (none left); 1 battery in the collector; \
         1 pump in the collector"
    );
    assert!(report.simulated_s > 165.0);
}

#[test]
fn a_line_that_cannot_be_run_is_an_error() {
    let mut line = line();
    line.machines.truncate(2);
    assert!(run(&line, &mut Script::new(vec![]), Stepping::EveryScan, &mut |_| {}).is_err());
}

#[test]
fn the_report_as_json() {
    let mut line = line();
    line.machines[AGV].states = states(vec![BELT]);
    let json = follow(&line, whole_order()).to_json();
    assert!(json.starts_with(r#"{"finished":true,"reason":"all orders made","simulated_s":"#), "{json}");
    for part in [
        r#""orders_done":1,"orders":1,"seconds_per_order":"#,
        r#""robots":{"belt":{"moving_s":"#,
        r#""waiting_for":{"belt":"#,
        r#""items":[{"id":0,"name":"battery_1","kind":"battery","place":"-","carrier":"order 1"}"#,
        r#""collisions":["#,
    ] {
        assert!(json.contains(part), "{part} in {json}");
    }
}

/// The plant's last log and items, of a run that makes an order.
fn finished_plant() -> Items {
    let mut rest = None;
    run(&line(), &mut Script::new(whole_order()), Stepping::EveryScan, &mut |seen: &Seen| {
        if seen.scan.is_multiple_of(500) {
            rest = Some(seen.plant.items().clone());
        }
    })
    .unwrap();
    rest.unwrap()
}

#[test]
fn conservation_catches_a_doctored_log() {
    let items = finished_plant();
    let log = items.log().since(0).to_vec();
    assert!(log.len() > 6);
    assert_eq!(conservation(&log, &items), Ok(()));
    for i in 0..log.len() {
        let Event::Item { scan, item, from, to, point } = log[i] else { continue };
        let mut missing = log.clone();
        missing.remove(i);
        assert!(conservation(&missing, &items).is_err(), "without {i}");
        let mut twice = log.clone();
        twice.insert(i, log[i]);
        assert!(conservation(&twice, &items).is_err(), "{i} twice");
        let lies = [
            Event::Item { scan, item: 1 - item, from, to, point },
            Event::Item { scan, item: 9, from, to, point },
            Event::Item { scan, item, from: Carrier::Collector, to, point },
            Event::Item { scan, item, from, to: Carrier::Collector, point },
        ];
        for lie in lies {
            let mut doctored = log.clone();
            doctored[i] = lie;
            assert!(conservation(&doctored, &items).is_err(), "{lie:?}");
        }
    }
}
