//! Faults of the plant that a scenario asks for, on small lines whose times follow from the rules.

use autogen::executor::Executor;
use autogen_tests::Texts;
use runtime_sim::line::{IoDelay, Line};
use runtime_sim::report::Report;
use runtime_sim::run::{Recorded, Stepping, record};

/// A machine of this device and automaton, run for 60 s.
fn line(device: &str, automaton: &str, scenario: &str) -> Texts {
    Texts {
        layout: r#"{"robots": [{"name": "it", "type": "it", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![format!("device it {{ {device} }} automaton It on it {{ {automaton} }}")],
        scenario: Some(format!(r#"{{"time_limit_s": 60, {scenario}}}"#)),
        ..Texts::default()
    }
}

/// The run, which is the same however it is stepped.
fn run(texts: &Texts, change: impl Fn(&mut Line)) -> Recorded {
    let outcome = texts.compile();
    let Some(mut project) = outcome.project else {
        panic!("{}", autogen_tests::plain(&outcome.sources, &outcome.diagnostics))
    };
    change(&mut project.plant);
    let execute = |stepping| {
        let mut executor = Executor::new(&project.system);
        record(&project.plant, &mut executor, stepping, &[], &mut |_| {}).expect("a line that can be run")
    };
    let every = execute(Stepping::EveryScan);
    for stepping in [Stepping::Events, Stepping::Checked] {
        let other = execute(stepping);
        assert_eq!(other.report, every.report, "{stepping:?}");
        assert_eq!(other.history.machines[0].stays, every.history.machines[0].stays, "{stepping:?}");
    }
    every
}

/// When each state of the machine is entered, ms. The beginning is state 0.
fn entries(texts: &Texts) -> Vec<(u64, usize)> {
    entries_with(texts, |_| {})
}

fn entries_with(texts: &Texts, change: impl Fn(&mut Line)) -> Vec<(u64, usize)> {
    let mut entered: Vec<(u64, usize)> = Vec::new();
    for stay in &run(texts, change).history.machines[0].stays {
        if entered.last().is_none_or(|(_, state)| *state != stay.state) {
            entered.push((stay.scan * 10, stay.state));
        }
    }
    entered
}

/// A bar of 1 s that is opened in the scan of the start, at 20 ms, so that it is out at 1020 ms; the automaton is then in
/// state 2.
const BAR: &str = "part bar = cylinder { extend: 1 s; retract: 1 s; };
    in is_open: bool = bar.is_out;
    in is_closed: bool = bar.is_in;
    out open: bool = bar.extend;";
const OPENS: &str = "initial -> Opening { open := true; }
    state Opening { when is_open -> Opened {} }
    final state Opened;";

/// Faults of sensors of the machine.
fn sensors(faults: &[&str]) -> String {
    let faults: Vec<String> = faults.iter().map(|fault| format!(r#"{{"robot": "it", {fault}}}"#)).collect();
    format!(r#""faults": {{"sensors": [{}]}}"#, faults.join(", "))
}

#[test]
fn a_sensor_that_sticks_is_read_and_the_plant_goes_on() {
    let opened = |faults: &[&str]| entries(&line(BAR, OPENS, &sensors(faults)));
    let at = |ms| vec![(0, 0), (20, 1), (ms, 2)];
    assert_eq!(opened(&[]), at(1020));
    // Too early, for a while.
    assert_eq!(opened(&[r#""signal": "is_open", "reads": true, "at_s": 0.4, "for_s": 0.2"#]), at(400));
    // Until it is over the cylinder is not seen to be out.
    assert_eq!(opened(&[r#""signal": "is_open", "reads": false, "at_s": 0.9, "for_s": 2"#]), at(2900));
    // Over before anybody asks.
    assert_eq!(opened(&[r#""signal": "is_open", "reads": false, "at_s": 0.1, "for_s": 0.5"#]), at(1020));
    assert_eq!(opened(&[r#""signal": "is_closed", "reads": false, "at_s": 0.1"#]), at(1020));
    // To the end of the run.
    assert_eq!(opened(&[r#""signal": "is_open", "reads": false, "at_s": 0"#]), [(0, 0), (20, 1)]);
    // In the first scan as well; the first step is that of the start.
    assert_eq!(opened(&[r#""signal": "is_open", "reads": true, "at_s": 0"#]), at(30));
}

#[test]
fn of_faults_of_one_input_the_one_that_began_last_counts() {
    let never = r#""signal": "is_open", "reads": false, "at_s": 0.3"#;
    let once = r#""signal": "is_open", "reads": true, "at_s": 0.7, "for_s": 0.01"#;
    let early = r#""signal": "is_open", "reads": true, "at_s": 0.2, "for_s": 5"#;
    let at = |ms| vec![(0, 0), (20, 1), (ms, 2)];
    for order in [[never, once], [once, never]] {
        assert_eq!(entries(&line(BAR, OPENS, &sensors(&order))), at(700));
    }
    let both = [early, never];
    assert_eq!(entries(&line(BAR, OPENS, &sensors(&both))), at(200));
    // What comes after a fault is the true value, not that of the one before.
    let wrong_then_right = [r#""signal": "is_open", "reads": false, "at_s": 0.5, "for_s": 1"#, once];
    assert_eq!(entries(&line(BAR, OPENS, &sensors(&wrong_then_right))), at(700));
}

/// The bus carries the wrong value as it carries a right one.
#[test]
fn a_wrong_value_comes_as_late_as_any_other() {
    let texts =
        line(BAR, OPENS, &sensors(&[r#""signal": "is_open", "reads": true, "at_s": 0.4, "for_s": 0.01"#]));
    let late = |scans| entries_with(&texts, |line| line.io_delay = IoDelay::Fixed(scans));
    assert_eq!(late(0)[2], (400, 2));
    assert_eq!(late(7)[2], (470, 2));
    let random = entries_with(&texts, |line| line.io_delay = IoDelay::Random { max: 5, seed: 3 });
    // It may be overtaken by none, and lie between two telegrams.
    let opened = random[2].0;
    assert!((400..=450).contains(&opened) || (1020..=1070).contains(&opened), "{random:?}");
}

/// Numbers, and elements of inputs: the machine counts the values that it sees as states.
#[test]
fn numbers_and_single_elements_stick() {
    let device = "part level = setpoint { begins: 1.0; };
        part choice = selector { begins: 2; };
        part belt = lane { from: origin; length: 2.0; width: 0.2; speed: 0.1; };
        part eye = beam { across: belt; at: 1.0; };
        in level_is: real = level.value;
        in chosen: int 0..5 = choice.position;
        in sees: bool[Kind] = eye.sees_kind;";
    let automaton = "initial -> Level {}
        state Level { when level_is < 0.35 and level_is > 0.25 -> Choice {} }
        state Choice { when chosen = 4 -> Both {} }
        state Both { when sees[bolt] and sees[nut] -> Nut {} }
        state Nut { when sees[nut] and not sees[bolt] -> Right {} }
        state Right { when level_is = 1.0 and chosen = 2 -> Ended {} }
        final state Ended;";
    let faults = [
        r#""signal": "level_is", "reads": 0.3, "at_s": 1, "for_s": 4"#,
        r#""signal": "chosen", "reads": 4, "at_s": 2, "for_s": 4"#,
        r#""signal": "sees", "reads": true, "at_s": 3, "for_s": 1"#,
        r#""signal": "sees", "element": "nut", "reads": true, "at_s": 4"#,
    ];
    let kinds = r#""kinds": [{"name": "bolt", "height": 0.05}, {"name": "nut", "height": 0.03}]"#;
    let texts = line(device, automaton, &format!("{kinds}, {}", sensors(&faults)));
    let expected = [(0, 0), (20, 1), (1000, 2), (2000, 3), (3000, 4), (4000, 5), (6000, 6)];
    assert_eq!(entries(&texts), expected);
}

/// A command waits for the signal itself; a process needs its cylinder, not what the controller reads of it.
#[test]
fn the_device_reads_its_own_sensors() {
    let device = "part belt = lane { from: origin; length: 2.0; width: 0.2; speed: 0.1; };
        part key = button {};
        in pressed: bool = key.on;
        command 1 run() = belt.run() then key.on within 2 s else 2;";
    let automaton = "initial -> Waiting { run(); }
        state Waiting { when done -> Ended {} when failed -> Failed {} }
        final state Ended;
        final state Failed;";
    let press = r#""operator": [{"robot": "it", "part": "key", "at_s": 1}]"#;
    let dead = sensors(&[r#""signal": "pressed", "reads": false, "at_s": 0"#]);
    assert_eq!(entries(&line(device, automaton, &format!("{press}, {dead}"))), [(0, 0), (20, 1), (1000, 2)]);
    let on = sensors(&[r#""signal": "pressed", "reads": true, "at_s": 0"#]);
    // The lane runs one scan after the command, and the wait begins.
    assert_eq!(entries(&line(device, automaton, &on)), [(0, 0), (20, 1), (2030, 3)]);
}

/// An answer that is not seen is no answer, and one that is seen too early is taken for one.
#[test]
fn answers_of_commands_may_stick() {
    let device = "part belt = lane { from: origin; length: 2.0; width: 0.2; speed: 0.1; };
        command 1 run() = belt.run();";
    let automaton = "initial -> Waiting { run(); }
        state Waiting { when done -> Ended {} when after 10 s -> Late {} }
        final state Ended;
        final state Late;";
    let ended = |fault: &str| entries(&line(device, automaton, &sensors(&[fault])));
    assert_eq!(ended(r#""signal": "ack", "reads": 0, "at_s": 0, "for_s": 5"#)[2], (5000, 2));
    assert_eq!(ended(r#""signal": "ack", "reads": 0, "at_s": 0"#)[2], (10_020, 3));
    assert_eq!(ended(r#""signal": "error", "reads": 2, "at_s": 0"#)[2], (10_020, 3));
}

/// A fault that ends is something that is to come: the line waits for it. One without an end is none.
#[test]
fn a_run_waits_for_the_end_of_a_fault() {
    let report = |for_s: &str| -> Report {
        let fault = format!(r#""signal": "is_open", "reads": false, "at_s": 0.5{for_s}"#);
        let texts = line(BAR, OPENS, &sensors(&[fault.as_str()]));
        run(&texts, |line| {
            line.scenario.stall_limit_s = 5.0;
            line.scenario.time_limit_s = 40.0;
        })
        .report
    };
    // It is out at 1.02 s, and 5 s later nothing has changed since.
    let ended = report("");
    assert!(ended.reason.starts_with("deadlock"), "{}", ended.reason);
    assert!((6.0..6.1).contains(&ended.simulated_s), "{}", ended.simulated_s);
    // Until 20.5 s it lasts; in state 2 nothing happens any more.
    let ended = report(r#", "for_s": 20"#);
    assert!((25.5..25.6).contains(&ended.simulated_s), "{}", ended.simulated_s);
}
