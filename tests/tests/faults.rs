//! Faults of the plant that a scenario asks for, on small lines whose times follow from the rules.

use autogen::executor::Executor;
use autogen_tests::{Texts, side_by_side};
use runtime_sim::line::{IoDelay, Line};
use runtime_sim::report::{AlarmReport, Report};
use runtime_sim::run::{Recorded, Stepping, record, run as simulate};

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

/// Faults of parts of the machine.
fn jams(faults: &[&str]) -> String {
    let faults: Vec<String> = faults.iter().map(|fault| format!(r#"{{"robot": "it", {fault}}}"#)).collect();
    format!(r#""faults": {{"jams": [{}]}}"#, faults.join(", "))
}

#[test]
fn a_cylinder_that_jams_stands_and_goes_on_afterwards() {
    let opened = |faults: &[&str]| entries(&line(BAR, OPENS, &jams(faults)));
    let at = |ms| vec![(0, 0), (20, 1), (ms, 2)];
    // 0.38 s gone, 2 s at rest, 0.62 s left.
    assert_eq!(opened(&[r#""part": "bar", "at_s": 0.4, "for_s": 2"#]), at(3020));
    // Before it begins to move.
    assert_eq!(opened(&[r#""part": "bar", "at_s": 0, "for_s": 2"#]), at(3000));
    // When it has arrived nothing changes.
    assert_eq!(opened(&[r#""part": "bar", "at_s": 1.02, "for_s": 2"#]), at(1020));
    // Two jams, apart and one within the other.
    let apart =
        [r#""part": "bar", "at_s": 0.1, "for_s": 0.2"#, r#""part": "bar", "at_s": 0.5, "for_s": 0.3"#];
    assert_eq!(opened(&apart), at(1520));
    let within = [r#""part": "bar", "at_s": 0.1, "for_s": 2"#, r#""part": "bar", "at_s": 0.5, "for_s": 0.3"#];
    assert_eq!(opened(&within), at(3020));
    // Without an end it never arrives.
    assert_eq!(opened(&[r#""part": "bar", "at_s": 1.01"#]), [(0, 0), (20, 1)]);
}

/// The valve goes off while the cylinder is 0.3 s out and stands: afterwards the spring needs 0.3 s.
#[test]
fn valves_that_change_during_a_jam_act_after_it() {
    let closes = "initial -> Opening { open := true; }
        state Opening { when after 1 s -> Closing { open := false; } }
        state Closing { when is_closed -> Closed {} }
        final state Closed;";
    let jam = jams(&[r#""part": "bar", "at_s": 0.32, "for_s": 2"#]);
    assert_eq!(entries(&line(BAR, closes, &jam)), [(0, 0), (20, 1), (1020, 2), (2620, 3)]);
    // On and off again while it jams at its inner end: it is never seen to leave it.
    let leaves = "initial -> Opening { open := true; }
        state Opening { when not is_closed -> Left {} when after 1 s -> Closing { open := false; } }
        state Closing { when not is_closed -> Left {} when is_open -> Left {} }
        final state Left;";
    let jam = jams(&[r#""part": "bar", "at_s": 0, "for_s": 3"#]);
    assert_eq!(entries(&line(BAR, leaves, &jam)), [(0, 0), (20, 1), (1020, 2)]);
}

/// Two valves that keep their position: a pulse during the jam counts afterwards. With a closed centre it does not.
#[test]
fn a_valve_that_keeps_its_position_keeps_it_during_a_jam() {
    let device = |centre: &str| {
        format!(
            "part bar = cylinder {{ extend: 1 s; retract: 1 s; {centre} }};
            in is_closed: bool = bar.is_in;
            in is_open: bool = bar.is_out;
            out outward: bool = bar.extend;
            out inward: bool = bar.retract;"
        )
    };
    // Out from 20 ms on; from 1020 ms to 1120 ms the other valve.
    let automaton = "initial -> Going { outward := true; }
        state Going { when after 1 s -> Coming { outward := false; inward := true; } }
        state Coming { when after 100 ms -> Resting { inward := false; } }
        state Resting { when is_closed -> In {} when is_open -> Out {} }
        final state In;
        final state Out;";
    let jam = jams(&[r#""part": "bar", "at_s": 0.32, "for_s": 2"#]);
    let began = [(0, 0), (20, 1), (1020, 2), (1120, 3)];
    let both = entries(&line(&device(""), automaton, &jam));
    assert_eq!((&both[..4], &both[4..]), (&began[..], &[(2620, 4)][..]));
    assert_eq!(entries(&line(&device("closed_centre: true;"), automaton, &jam)), began);
}

/// In a pause a cylinder goes on if its valve stays on, and comes back by its spring if the valve goes off.
#[test]
fn a_jam_and_a_pause_overlap() {
    let faults = r#""faults": {"jams": [{"robot": "it", "part": "bar", "at_s": 0.4, "for_s": 2}],
        "pauses": [{"at_s": 2, "for_s": 3}]}"#;
    // The permit is back at 5 s, and start is given one scan later.
    assert_eq!(entries(&line(BAR, OPENS, faults)), [(0, 0), (20, 1), (5010, 2)]);
    let stops = BAR.replace("bar.extend;", "bar.extend stop false;");
    assert_eq!(entries(&line(&stops, OPENS, faults)), [(0, 0), (20, 1), (6010, 2)]);
    // Without power the valve goes off too. The machine begins anew in the scan of the start.
    let off = faults.replace("pauses", "power_offs");
    assert_eq!(entries(&line(&stops, OPENS, &off)).last(), Some(&(6010, 2)));
}

/// An item of 0.1 m appears after 2 s, its front 0.5 m before the beam, at 0.1 m/s.
const BELT: &str = "part belt = lane { from: origin; length: 2.0; width: 0.2; speed: 0.1; };
    part feed = source { on: belt; inset: 0.1; };
    part eye = beam { across: belt; at: 0.65; };
    in sees: bool = eye.sees;";
const BOX: &str = r#""kinds": [{"name": "box", "height": 0.1}], "supply": {"items": ["box"]}"#;

#[test]
fn a_conveyor_that_jams_stands_with_its_items() {
    let device = format!("{BELT} in moves: bool = belt.moves;");
    let automaton = "initial -> Waiting {}
        state Waiting { when sees -> Seen {} when not moves -> Standing {} }
        state Standing { when sees -> Seen {} when moves -> Waiting {} }
        final state Seen;";
    let seen = |faults: &str| entries(&line(&device, automaton, &format!("{BOX}, {faults}")));
    let usual = seen(r#""faults": {}"#);
    assert_eq!(usual, [(0, 0), (20, 1), (7000, 3)]);
    let jammed = seen(&jams(&[r#""part": "belt", "at_s": 3, "for_s": 4"#]));
    assert_eq!(jammed, [(0, 0), (20, 1), (3010, 2), (7010, 1), (11_000, 3)]);
    // Time until the first item counts while the lane moves.
    let jammed = seen(&jams(&[r#""part": "belt", "at_s": 0.5, "for_s": 1"#]));
    assert_eq!(jammed.last(), Some(&(8000, 3)));
}

/// The scan at 3 s is executed, that at 7 s again; in between the level is off, which has no stop value.
#[test]
fn a_conveyor_without_power_stands_whatever_its_level_was() {
    let device = format!("{BELT} out run: bool = belt.run;");
    let automaton = "retain all;
        initial -> Waiting { run := true; }
        resume state Waiting { when sees -> Seen {} }
        final state Seen;";
    let seen = |faults: &str| entries(&line(&device, automaton, &format!("{BOX}, {faults}")));
    assert_eq!(seen(r#""faults": {}"#), [(0, 0), (20, 1), (7020, 2)]);
    let off = seen(r#""faults": {"power_offs": [{"at_s": 3, "for_s": 4}]}"#);
    assert_eq!(off.last(), Some(&(7020 + 3990, 2)));
}

/// A route has no ramps: it stands where it is. A track brakes: from 1.5 m/s with 0.5 m/s2 in 2.25 m and 3 s.
#[test]
fn vehicles_that_jam_halt_and_continue_to_their_goals() {
    let route = "part drive = route {
            stops: [pose, pose + point(10, 0, 0)]; speed: 1.0; latency: 0 ms; tolerance: 0.1; mass: 1.0;
        };
        out goal: point;
        command 1 go(goal) = drive.to(goal);";
    let goes = |command: &str| {
        format!(
            "initial -> Going {{ {command} }}
            state Going {{ when done -> There {{}} when failed -> Failed {{}} }}
            final state There;
            final state Failed;"
        )
    };
    let there = |device: &str, automaton: &str, faults: &[&str]| {
        let found = entries(&line(device, automaton, &jams(faults)));
        assert_eq!((found[..2].to_vec(), found[2].1), (vec![(0, 0), (20, 1)], 2), "{found:?}");
        found[2].0
    };
    let to = goes("go(point(10, 0, 0));");
    assert_eq!(there(route, &to, &[]), 10_020);
    assert_eq!(there(route, &to, &[r#""part": "drive", "at_s": 3, "for_s": 4"#]), 14_020);
    assert_eq!(there(route, &to, &[r#""part": "drive", "at_s": 0, "for_s": 4"#]), 14_000);

    let track = "part drive = track {
            corners: [pose, pose + point(10, 0, 0)]; places: [0.0, 10.0];
            speed: 1.5; acceleration: 0.5; mass: 10.0;
        };
        out goal: int 0..1;
        command 1 go(goal) = drive.to(goal);
        command 2 halt() = drive.halt();";
    let is_near = |found: u64, seconds: f64| (found as f64 / 1000.0 - seconds).abs() < 0.015;
    // 10 m at 1.5 m/s, and 3 s for the ramps.
    let usual = there(track, &goes("go(1);"), &[]);
    assert!(is_near(usual, 0.02 + 10.0 / 1.5 + 3.0), "{usual}");
    // After 4 s 3.75 m, at rest after 6 m; from 14.02 s on 4 m from rest to rest.
    let jammed = there(track, &goes("go(1);"), &[r#""part": "drive", "at_s": 4.02, "for_s": 10"#]);
    assert!(is_near(jammed, 14.02 + 2.0 * (4.0_f64 / 0.5).sqrt()), "{jammed}");
    // A command to stand ends with the jam.
    assert_eq!(there(track, &goes("halt();"), &[r#""part": "drive", "at_s": 0, "for_s": 4"#]), 4010);
}

/// A run of the tending cell for three parts.
fn tending(faults: &str) -> Report {
    let mut texts = side_by_side("tending/tending");
    let scenario = texts.scenario.expect("a scenario").replace("41", "3");
    texts.scenario = Some(scenario.replacen('{', &format!(r#"{{"faults": {{{faults}}},"#), 1));
    run(&texts, |_| {}).report
}

/// The mill limits the cell: what its cycle takes longer, the run takes longer.
#[test]
fn a_slow_cycle_of_the_mill_delays_the_cell() {
    let slow = |cycle: u32, longer_s: f64| {
        format!(r#"{{"robot": "mill", "part": "cycle", "cycle": {cycle}, "longer_s": {longer_s}}}"#)
    };
    let usual = tending("");
    assert!(usual.finished, "{}", usual.reason);
    let later = |faults: &[String]| {
        let report = tending(&format!(r#""slow": [{}]"#, faults.join(", ")));
        assert!(report.finished, "{}", report.reason);
        (report.scans - usual.scans) as f64 / 100.0
    };
    for cycle in 1..=3 {
        assert_eq!(later(&[slow(cycle, 30.0)]), 30.0, "{cycle}");
    }
    assert_eq!(later(&[slow(2, 7.5), slow(3, 20.0), slow(2, 2.5)]), 30.0);
    // It never begins before the goal is reached.
    let never = Report { notes: Vec::new(), ..tending(&format!(r#""slow": [{}]"#, slow(9, 30.0))) };
    assert_eq!(never, usual);
}

/// What the types say of a sensor that sticks or a door that jams: the state that waits for it lasts too long.
#[test]
fn the_mill_reports_what_does_not_come() {
    let fault = |faults: &str| {
        let report = tending(faults);
        let fault = report.fault.map(|(_, machine)| machine);
        (report.finished, fault.unwrap_or_default())
    };
    let sensor = |signal: &str, reads: bool, more: &str| {
        format!(
            r#""sensors": [{{"robot": "mill", "signal": "{signal}", "reads": {reads}, "at_s": 0{more}}}]"#
        )
    };
    let door = |for_s: &str| format!(r#""jams": [{{"robot": "mill", "part": "door", "at_s": 20{for_s}}}]"#);
    let mill = || (false, "mill".to_string());
    for signal in ["door_closed", "cutting"] {
        assert_eq!(fault(&sensor(signal, false, "")), mill(), "{signal}");
    }
    // The arm holds the blank until the vise is seen to hold it: it reports first.
    let vise = fault(&sensor("clamped", false, ""));
    assert!(!vise.0 && ["mill", "arm"].contains(&vise.1.as_str()), "{vise:?}");
    assert_eq!(fault(&door("")), mill());
    // The door takes 4 s of the 15 s that it has.
    assert_eq!(fault(&door(r#", "for_s": 8"#)), (true, String::new()));
}

/// The belt waits for a gate that does not close. A piece that is not seen to be red goes into the wrong box.
#[test]
fn a_gate_that_jams_stops_the_sorter() {
    let run = |faults: &str| {
        let mut texts = side_by_side("sorting/sorting");
        let scenario = texts.scenario.expect("a scenario");
        texts.scenario = Some(scenario.replacen('{', &format!(r#"{{"faults": {{{faults}}},"#), 1));
        run(&texts, |_| {}).report.reason
    };
    let of_sorter = |key: &str, fault: &str| format!(r#""{key}": [{{"robot": "sorter", {fault}}}]"#);
    let gate = run(&of_sorter("jams", r#""part": "first_arm", "at_s": 0"#));
    assert_eq!(gate, "fault 3 of sorter");
    let late = run(&of_sorter("jams", r#""part": "first_arm", "at_s": 0, "for_s": 5"#));
    assert_eq!(late, "all items collected");
    let colour = run(&of_sorter("sensors", r#""signal": "is_red", "reads": false, "at_s": 0"#));
    assert_eq!(colour, "sorter.last_box has collected more red than 0");
    let piece = run(&of_sorter("sensors", r#""signal": "at_stopper", "reads": false, "at_s": 0"#));
    assert!(piece.starts_with("fault"), "{piece}");
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

/// A person who is still to release a button keeps a run alive, up to the scan before.
#[test]
fn a_run_waits_for_the_operator() {
    let scenario = r#""operator": [{"part": "start", "at_s": 20, "for_s": 0.5}]"#;
    let ended = run(&line(BAR, OPENS, scenario), |line| {
        line.scenario.stall_limit_s = 5.0;
        line.scenario.time_limit_s = 40.0;
    });
    assert_eq!(ended.report.scans, 2_050 + 500, "{}", ended.report.reason);
}

/// A timer that runs is something that is to come, whatever its length: the line waits for it.
#[test]
fn a_run_waits_for_timers() {
    let ends = |automaton: &str| {
        let texts = line(BAR, automaton, &sensors(&[r#""signal": "is_open", "reads": false, "at_s": 0"#]));
        let report = run(&texts, |line| {
            line.scenario.stall_limit_s = 5.0;
            line.scenario.time_limit_s = 400.0;
        })
        .report;
        (report.reason, report.simulated_s)
    };
    // The bar is out 1 s after the start in scan 2, and the timer ends at 200.02 s; 5 s later nothing has changed.
    let (reason, s) = ends(
        "initial -> Opening { open := true; } state Opening { when is_open and after 200 s -> Opened {} } final state Opened;",
    );
    assert!(reason.starts_with("deadlock"), "{reason}");
    assert!((205.0..205.1).contains(&s), "{s}");
    let (reason, s) = ends(
        "initial -> Opening { open := true; } state Opening within 200 s { when is_open -> Opened {} } final state Opened;",
    );
    assert!(reason.starts_with("fault"), "{reason}");
    assert!((200.0..200.1).contains(&s), "{s}");
    let (reason, s) = ends(
        "initial -> Opening { open := true; } state Opening { when after 200 s -> Opened {} } final state Opened;",
    );
    assert!(reason.starts_with("deadlock"), "{reason}");
    assert!((205.0..205.1).contains(&s), "{s}");
    // A property that waits for its goal.
    let (reason, s) = ends(
        "whenever open then is_open within 200 s; initial -> Opening { open := true; } state Opening { when is_open -> Opened {} } final state Opened;",
    );
    assert!(reason.starts_with("fault"), "{reason}");
    assert!((200.0..200.1).contains(&s), "{s}");
}

/// Power is lost at 3 s for 2 s; then the machine begins anew, with `cmd` 0, and nobody gives a command.
fn loses_power(device: &str, command: &str) -> Texts {
    let automaton = format!(
        "local given: bool := false;
        initial -> Waits {{}}
        state Waits {{ when go and not given -> Moves {{ {command} given := true; }} }}
        state Moves {{ when changes -> Changed {{}} }}
        final state Changed;"
    );
    let device = format!("part start = button {{}}; in go: bool = start.on; {device}");
    let scenario = r#""operator": [{"robot": "it", "part": "start", "at_s": 1, "for_s": 1}],
        "faults": {"power_offs": [{"at_s": 3, "for_s": 2}]}"#;
    line(&device, &automaton, scenario)
}

#[test]
fn a_command_from_before_a_loss_of_power_is_not_finished() {
    let lift = "part hoist = positioner { slides: point(1, 0, 0); positions: [0, 1]; speed: 0.1; };
        part bed = lane { on: hoist; from: origin * frame(0, 0, 0.8, 0); length: 1.0; width: 0.4; speed: 0.3; };
        in changes: bool = hoist.stands; in place: int -1..31 = hoist.place; out goal: int 0..31;
        command 1 to(goal) = hoist.to(goal);";
    let run_of = |device: &str, command: &str| run(&loses_power(device, command), |_| {});
    let lifted = run_of(lift, "to(1);");
    let strokes = &lifted.history.machines[0].strokes[0].changes;
    let ends = strokes.last().map(|(ms, stroke)| (*ms, stroke.out, stroke.rate));
    assert_eq!(ends, Some((3000, 0.2, 0.0)), "{strokes:?}");

    let belt = "part bed = lane { from: origin * frame(0, 0, 0.8, 0); length: 1.0; width: 0.4; speed: 0.3; };
        in changes: bool = bed.moves; command 1 run() = bed.run();";
    let carried = run_of(belt, "run();");
    let surfaces = &carried.history.machines[0].surfaces[0].changes;
    assert_eq!(surfaces.last().map(|(_, speed)| *speed), Some(0.0), "{surfaces:?}");
}

/// The button is pressed for 0.5 s at each of these seconds; power is lost at 3 s and at 9 s for 2 s.
fn alarms_of_presses(at_s: &[u32]) -> Vec<AlarmReport> {
    let press = |at_s| format!(r#"{{"robot": "it", "part": "start", "at_s": {at_s}, "for_s": 0.5}}"#);
    let presses = at_s.iter().map(press).collect::<Vec<_>>().join(", ");
    let offs = r#"[{"at_s": 3, "for_s": 2}, {"at_s": 9, "for_s": 2}]"#;
    let scenario = format!(r#""operator": [{presses}], "faults": {{"power_offs": {offs}}}"#);
    let device = "part start = button {}; in pressed: bool = start.on;";
    let automaton = r#"invariant not pressed else warn "do not press";
        initial state Idle { when false -> Idle {} }"#;
    run(&line(device, automaton, &scenario), |_| {}).report.alarms
}

#[test]
fn alarms_of_a_run_are_those_of_all_its_power_ups() {
    let alarm = |count, first_s, last_s, acknowledged| {
        let machine = "it".into();
        AlarmReport { machine, code: 1, count, first_s, last_s, active: false, acknowledged }
    };
    assert_eq!(alarms_of_presses(&[1]), [alarm(1, 1.0, 1.0, true)]);
    assert_eq!(alarms_of_presses(&[6]), [alarm(1, 6.0, 6.0, true)]);
    assert_eq!(alarms_of_presses(&[12]), [alarm(1, 12.0, 12.0, false)]);
    assert_eq!(alarms_of_presses(&[1, 6, 7, 12]), [alarm(4, 1.0, 12.0, false)]);
    assert_eq!(alarms_of_presses(&[]), []);
}

/// An item on a conveyor below the tool, which two grippers pick one after the other.
#[test]
fn slips_count_the_picks_of_all_grippers_of_an_arm() {
    let device = "part bed = lane { from: origin * frame(0, 0, 0.5, 0); length: 1.0; width: 0.4; speed: 0.1; };
        part feed = source { on: bed; inset: 0.5; };
        part across = axis { from: origin * frame(0, 0, 1.2, 0); along: x; range: [0, 1]; speed: 0.5; acceleration: 1.0; };
        part up = axis { on: across; along: z; range: [-0.9, 0.1]; speed: 0.5; acceleration: 1.0; };
        part arm = chain { on: up; tool_length: 0.1; rest: origin * point(0.5, 0, 0.56); };
        part first_cup = grip { on: arm; period: 20 ms; looks: 2; near: 0.08; };
        part other_cup = grip { on: arm; period: 20 ms; looks: 2; near: 0.08; };
        in holds: bool = first_cup.holds; in other_holds: bool = other_cup.holds;
        out run: bool = bed.run; out close: bool = first_cup.close; out close_other: bool = other_cup.close;";
    let automaton = "initial -> Starts { run := true; }
        state Starts { when after 100 ms -> First { run := false; close := true; } }
        state First { when holds and after 1 s -> Between { close := false; } }
        state Between { when not holds -> Other { close_other := true; } }
        state Other { when other_holds -> Holds {} }
        state Holds { when not other_holds -> Lost {} }
        final state Lost;";
    let scenario = r#""kinds": [{"name": "box", "height": 0.05, "size": [0.06, 0.06]}],
        "supply": {"items": ["box"], "first_s": 0},
        "faults": {"slips": [{"robot": "it", "pick": 2, "after_s": 1}]}"#;
    let entered = entries(&line(device, automaton, scenario));
    let at = |state: usize| entered.iter().find(|(_, entered)| *entered == state).map(|(ms, _)| *ms);
    assert_eq!(at(6).zip(at(5)).map(|(lost, held)| lost - held), Some(1000), "{entered:?}");
}

/// A clamp and a press are started in the same scan; the clamp takes 50 ms, which a scan of 100 ms hides.
#[test]
fn what_a_process_needs_is_there_when_it_starts() {
    let device =
        "part bed = lane { from: origin * frame(0, 0, 1.0, 0); length: 1.0; width: 0.4; speed: 0.5; };
        part feed = source { on: bed; inset: 0.5; };
        part clamp = cylinder { extend: 50 ms; retract: 50 ms; };
        part plate = place { at: origin.position; slots: [point(1.05, 0, 0.6)]; by_kind: false;
            floor: point(1.2, 0, 0.6); floor_x: [-0.4, 0.4]; floor_y: [-0.2, 0.2]; };
        part press = process { on: plate; time: 2 s; needs_out: clamp; };
        in ended: bool = press.ended;
        out run: bool = bed.run; out hold_down: bool = clamp.extend; out start: bool = press.start;";
    let reason = |transitions: &str| {
        let automaton = format!("initial -> Runs {{ run := true; }} {transitions} final state Done;");
        let scenario = r#""kinds": [{"name": "box", "height": 0.05, "size": [0.1, 0.05]}],
            "supply": {"items": ["box"], "first_s": 0}"#;
        let mut texts = line(device, &automaton, scenario);
        texts.layout = texts.layout.replacen('{', r#"{"scan_ms": 100, "#, 1);
        run(&texts, |_| {}).report.reason
    };
    let lacks = "interlock of it: the process press was started without its clamp out";
    let together = "state Runs { when after 5 s -> Works { hold_down := true; start := true; } }
        state Works { when ended -> Done {} }";
    assert_eq!(reason(together), lacks);
    let let_go = "state Runs { when after 5 s -> Holds { hold_down := true; } }
        state Holds { when after 1 s -> Works { hold_down := false; start := true; } }
        state Works { when ended -> Done {} }";
    assert_ne!(reason(let_go), lacks);
}

/// Each fault and each action that the run does not come to is told, and no other one.
#[test]
fn what_a_run_does_not_come_to_is_told() {
    let device = "part drive = track {
            corners: [origin * point(0, 0, 0), origin * point(6, 0, 0)]; places: [0.0, 6.0];
            speed: 1.0; acceleration: 0.5; mass: 10;
        };
        part key = button {};
        in pressed: bool = key.on;
        out goal: int 0..1;
        command 1 drive_to(goal) = drive.to(goal);";
    let automaton = "initial -> Going { drive_to(1); }
        state Going { when done -> Back { drive_to(0); } when failed -> Going { drive_to(1); } }
        state Back { when pressed and done -> Going { drive_to(1); } }";
    let scenario = r#""faults": {
            "refusals": [{"robot": "it", "command": 1}, {"robot": "it", "command": 4}],
            "answers": [{"robot": "it", "command": 3, "late_s": 1}, {"robot": "it", "command": 98, "late_s": 1}],
            "pauses": [{"at_s": 4, "for_s": 1}, {"at_s": 60, "for_s": 1}],
            "power_offs": [{"at_s": 500, "for_s": 1}],
            "sensors": [{"robot": "it", "signal": "pressed", "reads": false, "at_s": 70}],
            "jams": [{"robot": "it", "part": "drive", "at_s": 59.99}, {"robot": "it", "part": "drive", "at_s": 80}]
        },
        "operator": [
            {"robot": "it", "part": "key", "at_s": 90, "for_s": 1},
            {"part": "start", "at_s": 59, "for_s": 0.5}, {"part": "reset", "at_s": 100, "for_s": 0.5}
        ]"#;
    let notes = run(&line(device, automaton, scenario), |_| {}).report.notes;
    assert_eq!(
        notes,
        [
            "not reached: refusal of command 4 of it, which had 3 commands; name an earlier one",
            "not reached: answer to command 98 of it, which had 3 commands; name an earlier one",
            "not reached: pause at 60.00 s, as the run ended at 60.00 s; give an earlier time",
            "not reached: loss of power at 500.00 s, as the run ended at 60.00 s; give an earlier time",
            "not reached: input of it that sticks at 70.00 s, as the run ended at 60.00 s; give an earlier time",
            "not reached: jam of it.drive at 80.00 s, as the run ended at 60.00 s; give an earlier time",
            "not reached: operation of it.key at 90.00 s, as the run ended at 60.00 s; give an earlier time",
            "not reached: press of `reset` at 100.00 s, as the run ended at 60.00 s; give an earlier time",
        ]
    );
    // An earlier time would not help: the line has to be reset before it is started.
    let guarded = format!("{automaton} invariant not pressed;");
    let scenario = r#""operator": [{"robot": "it", "part": "key", "at_s": 2, "for_s": 1},
        {"part": "start", "at_s": 9, "for_s": 0.5}]"#;
    let notes = run(&line(device, &guarded, scenario), |_| {}).report.notes;
    assert_eq!(notes, ["not reached: press of `start` at 9.00 s, as the run ended in the fault at 2.01 s"]);
    let faults = r#""slow": [{"robot": "mill", "part": "cycle", "cycle": 9, "longer_s": 1}],
        "slips": [{"robot": "arm", "pick": 1, "after_s": 900}, {"robot": "arm", "pick": 50, "after_s": 1}]"#;
    assert_eq!(
        tending(faults).notes,
        [
            "not reached: slip of pick 50 of arm, which had 7 picks; name an earlier one",
            "not reached: slow cycle 9 of mill.cycle, which had 3 cycles; name an earlier one",
        ]
    );
}

/// A controller starts at an edge: one that is held during a pause gives none after it.
#[test]
fn a_line_that_stands_for_want_of_an_edge_is_told() {
    let notes = |start: &str, at_s: &str| {
        let pauses = format!(r#""faults": {{"pauses": [{{"at_s": {at_s}, "for_s": 1}}]}}"#);
        let scenario = format!(r#"{pauses}, "operator": [{{"part": "start", {start}}}]"#);
        run(&line(BAR, OPENS, &scenario), |_| {}).report.notes
    };
    let stands = |since: &str| {
        vec![format!(
            "the line stands: `start` has had no edge since {since} s; release it before, and press it then"
        )]
    };
    assert_eq!(notes(r#""at_s": 0.5"#, "2"), stands("3.00"));
    assert_eq!(notes(r#""at_s": 0"#, "2"), stands("3.00"));
    assert_eq!(notes(r#""at_s": 0.5, "for_s": 1"#, "2"), Vec::<String>::new());
    // The pause lasts to the end of the run, and to the last scan before it.
    assert_eq!(notes(r#""at_s": 0.5, "for_s": 1"#, "58.99"), Vec::<String>::new());
    assert_eq!(notes(r#""at_s": 0.5"#, "59.5"), Vec::<String>::new());
}

/// The bar of [`BAR`], out at 1020 ms, must not be out while the key is pressed: the key is pressed from 5 s to 6 s.
fn guarded(automaton: &str, scenario: &str) -> Report {
    let device = format!("{BAR} part key = button {{}}; in pressed: bool = key.on;");
    let key = r#""operator": [{"robot": "it", "part": "key", "at_s": 5, "for_s": 1}"#;
    let automaton = format!("{automaton} invariant not pressed;");
    run(&line(&device, &automaton, &scenario.replace("OPERATOR", key)), |_| {}).report
}

#[test]
fn a_run_goes_on_if_its_fault_is_reset() {
    let faults = |report: &Report| -> Vec<(i32, String, f64, Option<f64>)> {
        let faults = report.faults.iter();
        faults.map(|fault| (fault.code, fault.state.clone(), fault.at_s, fault.cleared_s)).collect()
    };
    let opened = || "Opened".to_string();
    let reset = |at_s: f64| format!(r#"OPERATOR, {{"part": "reset", "at_s": {at_s}, "for_s": 0.2}}]"#);

    let never = guarded(OPENS, "OPERATOR]");
    assert_eq!((never.finished, never.fault, never.scans), (false, Some((1, "it".into())), 501));
    assert_eq!((never.faults, never.fault_s, never.notes), (Vec::new(), Some(5.0), Vec::new()));

    // No reset comes after it.
    let early = guarded(OPENS, &reset(4.0));
    assert_eq!((early.fault, early.scans), (Some((1, "it".into())), 501));

    // It is cleared, but the line is not started: it stands.
    let cleared = guarded(OPENS, &reset(8.0));
    assert_eq!((cleared.finished, &cleared.fault, cleared.simulated_s), (true, &None, 60.0));
    assert_eq!(faults(&cleared), [(1, opened(), 5.0, Some(8.0))]);
    assert!(
        cleared.notes[0].starts_with("the line stands: `start` has had no edge since 8.00 s"),
        "{:?}",
        cleared.notes
    );
    assert_eq!(cleared.machines[0].account.stopped, 5_500 + 2);

    // The cause is still there when the line is started, and nobody resets it again.
    let too_early = reset(5.5).replace(']', r#", {"part": "start", "at_s": 5.8, "for_s": 0.1}]"#);
    let again = guarded(OPENS, &too_early);
    assert_eq!((&again.fault, again.scans), (&Some((1, "it".into())), 581));
    assert_eq!(faults(&again), [(1, opened(), 5.0, Some(5.5))]);

    // The second press begins while the first one lasts: there is no edge, and the run ends.
    let held = guarded(
        OPENS,
        r#"OPERATOR, {"part": "reset", "at_s": 4, "for_s": 3}, {"part": "reset", "at_s": 6, "for_s": 2}]"#,
    );
    assert_eq!((&held.fault, held.fault_s), (&Some((1, "it".into())), Some(5.0)));
    assert!(held.scans > 600, "{}", held.scans);
    assert!(held.notes[0].starts_with("the fault is there since 5.00 s"), "{:?}", held.notes);

    let recovers = reset(8.0).replace(']', r#", {"part": "start", "at_s": 9, "for_s": 0.1}]"#);
    let recovered = guarded(OPENS, &recovers);
    assert_eq!((recovered.finished, recovered.notes.len()), (true, 0));
    assert_eq!(recovered.machines[0].account.stopped, 400 + 2);
}

#[test]
fn a_run_whose_fault_would_be_cleared_after_its_end_has_not_reached_its_goal() {
    let late = guarded(OPENS, r#"OPERATOR, {"part": "reset", "at_s": 70, "for_s": 0.2}]"#);
    assert_eq!((late.finished, late.simulated_s), (false, 60.0));
    assert_eq!(late.reason, "time limit: the line is in a fault");
    let [fault] = &late.faults[..] else { panic!("{:?}", late.faults) };
    assert_eq!((fault.at_s, fault.cleared_s), (5.0, None));
}

#[test]
fn a_loss_of_power_clears_a_fault_that_is_not_retained() {
    let power_off = r#"OPERATOR], "faults": {"power_offs": [{"at_s": 10, "for_s": 2}]}"#;
    let cleared = guarded(OPENS, power_off);
    assert_eq!((cleared.finished, cleared.fault), (true, None));
    assert_eq!((cleared.faults[0].at_s, cleared.faults[0].cleared_s), (5.0, Some(12.0)));
    let retained = guarded(&format!("retain all; {OPENS}"), power_off);
    assert_eq!((retained.finished, retained.fault), (false, Some((1, "it".into()))));
    assert_eq!((retained.scans, retained.faults), (1_201, vec![]));
}

/// Two boxes, after 3 s and 6 s of its belt, of which the sink should collect some.
fn two_boxes(goal: u32, operator: &str) -> String {
    format!(
        r#""kinds": [{{"name": "box", "height": 0.2, "size": [0.3, 0.3]}}],
        "supply": {{"items": ["box", "box"], "every_s": 3}}, "goal": {{"it.end": {{"box": {goal}}}}},
        "operator": [{operator}]"#
    )
}

/// A belt that keeps running in a fault: a goal that is reached meanwhile counts once the fault is cleared.
#[test]
fn no_goal_is_reached_in_a_fault() {
    let device =
        "part belt = lane { from: origin * frame(0, 0, 0.7, 0); length: 2.0; width: 0.4; speed: 0.5; };
        part entry = source { on: belt; inset: 0.2; };
        part end = sink { of: belt; inset: 0; };
        part key = button {};
        in pressed: bool = key.on;
        out run: bool = belt.run;";
    let automaton = "initial -> Running { run := true; } final state Running; invariant not pressed;";
    let report = |reset: &str| {
        let key = r#"{"robot": "it", "part": "key", "at_s": 5, "for_s": 1}"#;
        run(&line(device, automaton, &two_boxes(2, &format!("{key}{reset}"))), |_| {}).report
    };
    let ended = report("");
    assert_eq!((ended.finished, ended.scans, ended.collected), (false, 501, Some([0, 2])));
    let cleared = report(r#", {"part": "reset", "at_s": 30, "for_s": 0.2}"#);
    assert_eq!(
        (cleared.finished, cleared.reason.as_str(), cleared.scans),
        (true, "all items collected", 3_001)
    );
    assert_eq!((cleared.faults[0].at_s, cleared.faults[0].cleared_s), (5.0, Some(30.0)));
    let late = report(r#", {"part": "reset", "at_s": 61, "for_s": 0.2}"#);
    assert_eq!((late.finished, late.collected), (false, Some([2, 2])));
    assert_eq!(late.reason, "time limit: the line is in a fault");
}

/// Boxes appear at 3.02 s and 6.02 s and go 1.8 m at 0.5 m/s: the first one is at the beam from 3.02 + 0.65 / 0.5 s on.
#[test]
fn a_person_removes_an_item() {
    let device =
        "part belt = lane { from: origin * frame(0, 0, 0.7, 0); length: 2.0; width: 0.4; speed: 0.5; };
        part entry = source { on: belt; inset: 0.2; };
        part eye = beam { across: belt; at: 1.0; };
        part end = sink { of: belt; inset: 0; };
        in sees: bool = eye.sees;
        out run: bool = belt.run;";
    let automaton = "initial -> Waits { run := true; }
        state Waits { when sees -> Sees {} } state Sees { when not sees -> Gone {} } final state Gone;";
    let recorded =
        |goal: u32, removals: &str| run(&line(device, automaton, &two_boxes(goal, removals)), |_| {});
    let gone_at = |recorded: &Recorded| {
        let gone = recorded.history.machines[0].stays.iter().find(|stay| stay.state == 3);
        gone.map(|stay| stay.scan * 10)
    };
    let removed = recorded(1, r#"{"remove": "box_1", "at_s": 4.5}"#);
    assert_eq!((removed.report.finished, removed.report.scans), (true, 602 + 360));
    // What a beam shows of an item that is taken off its lane follows in the next scan.
    assert_eq!((gone_at(&removed), removed.report.notes.len()), (Some(4_510), 0));
    // It is not there yet, and it is in the sink.
    let missed = recorded(2, r#"{"remove": "box_2", "at_s": 6.01}, {"remove": "box_1", "at_s": 7}"#);
    assert_eq!((missed.report.finished, missed.report.scans), (true, 602 + 360));
    assert_eq!(
        missed.report.notes,
        [
            "not reached: removal of box_2 at 6.01 s, when its carrier was: supply",
            "not reached: removal of box_1 at 7.00 s, when its carrier was: collector",
        ]
    );
    // It is still to come, so the line is not at a standstill before.
    let late = recorded(2, r#"{"remove": "box_2", "at_s": 50}, {"remove": "box_1", "at_s": 50.5}"#);
    assert_eq!(late.report.notes.len(), 2);
}

/// `box_5` is laid on `box_1` before 45 s.
#[test]
fn an_item_on_which_another_one_lies_is_not_removed() {
    let mut texts = side_by_side("scenes/palletizer");
    let removal = r#""operator": [{"remove": "box_1", "at_s": 45}], "orders""#;
    texts.scenario = texts.scenario.map(|text| text.replace("\"orders\"", removal));
    let project = texts.project();
    let report = simulate(&project.plant, &mut Executor::new(&project.system), Stepping::Events, &mut |_| {});
    let report = report.expect("a line that can be run");
    assert_eq!(
        report.notes,
        ["not reached: removal of box_1 at 45.00 s, when box_5 lay on it; remove this one first"]
    );
}

/// In `examples/tending` the arm loses its second part at the mill: it falls to the floor, where a person removes it.
#[test]
fn what_fell_to_the_floor_is_removed() {
    let report = |removals: &str| {
        let mut texts = side_by_side("tending/tending");
        let scenario = texts.scenario.expect("the cell has a scenario");
        let faults =
            r#""faults": {"slips": [{"robot": "arm", "pick": 3, "after_s": 1}]}, "operator": [REMOVALS],"#;
        let faults = faults.replace("REMOVALS", removals);
        texts.scenario = Some(scenario.replacen('{', &format!("{{{faults}"), 1));
        run(&texts, |_| {}).report
    };
    let on_floor = |report: &Report| report.items.iter().filter(|item| item.carrier == "floor").count();
    let fallen = report("");
    assert_eq!(on_floor(&fallen), 1, "{:?}", fallen.items);
    let item = &fallen.items.iter().find(|item| item.carrier == "floor").expect("an item").name;
    let early = report(&format!(r#"{{"remove": "{item}", "at_s": 1}}"#));
    assert_eq!((on_floor(&early), early.notes.len()), (1, 1));
    let removed = report(&format!(r#"{{"remove": "{item}", "at_s": 140}}"#));
    assert_eq!((on_floor(&removed), removed.notes.len()), (0, 0), "{:?}", removed.notes);
    let held = report(&format!(r#"{{"remove": "{item}", "at_s": 1}}, {{"remove": "blank_1", "at_s": 9}}"#));
    assert_eq!(held.notes.len(), 2, "{:?}", held.notes);
}
