//! A vehicle on a track, by closed forms: how long it takes, where it brakes, what it refuses.

use autogen::executor::Executor;
use autogen_tests::words::with_words;
use autogen_tests::{Texts, is_full_campaign};
use runtime_sim::collision::Contact;
use runtime_sim::memory::Memory;
use runtime_sim::point::Point;
use runtime_sim::random::Random;
use runtime_sim::run::{Seen, Stepping, record, run_again};

/// An open track of 10 m with a corner, and what drives on it.
fn with_automaton(automaton: &str, scenario: &str) -> Texts {
    let device = "device cart {
        part drive = track {
            corners: [pose, pose + point(6, 0, 0), pose + point(6, 4, 0)]; places: [0.0, 3.0, 8.0, 10.0];
            speed: 1.5; acceleration: 0.5; mass: 10.0;
        };
        part hull = body { on: drive; low: point(-0.4, -0.2, 0); high: point(0.4, 0.2, 0.3); };
        in pos: point = drive.position;
        in place: int -1..3 = drive.place;
        in stands: bool = drive.stands;
        out goal: int 0..9;
        command 1 go(goal) = drive.to(goal);
        command 2 halt() = drive.halt();
    }";
    Texts {
        layout: r#"{"robots": [{"name": "cart", "type": "cart", "pose": [0, 0, 0]}]}"#.into(),
        specs: vec![format!("{device} automaton Cart on cart {{ {automaton} }}")],
        scenario: Some(scenario.into()),
        ..Texts::default()
    }
}

/// Times, s, places by which it has come, and x and y at which it came to rest, each time that it did, with every scan.
/// How it is stepped makes no difference.
fn rests(texts: &Texts) -> Vec<(f64, f64, [f64; 2])> {
    let (project, words) = with_words(texts);
    let of = |name: &str| words[name];
    let (stands, place) = (of("cart_stands"), of("cart_place"));
    let position = ["cart_pos_x", "cart_pos_y"].map(of);
    let execute = |stepping| {
        let (mut rests, mut stood) = (Vec::new(), true);
        let mut observer = |seen: &Seen| {
            let stands = stands.value(seen) == 1.0;
            if stands && !stood {
                rests.push((
                    seen.scan as f64 / 100.0,
                    place.value(seen),
                    position.map(|word| word.value(seen)),
                ));
            }
            stood = stands;
        };
        let (mut executor, mut memory) = (Executor::new(&project.system), Memory::default());
        let report = run_again(&project.plant, &mut executor, stepping, &mut memory, &mut observer);
        (report.expect("a line that runs"), rests)
    };
    let [events, every, checked] = [Stepping::Events, Stepping::EveryScan, Stepping::Checked].map(execute);
    assert_eq!(events.0, every.0);
    assert_eq!(checked.0, every.0);
    every.1
}

fn is_near(found: f64, wanted: f64, tolerance: f64) -> bool {
    (found - wanted).abs() <= tolerance
}

/// The command is given in the scan after the start; a change is told in the first scan not before it.
const SCANS: f64 = 0.05;

#[test]
fn it_drives_both_ways_round_its_corner() {
    let rests = rests(&with_automaton(
        "initial -> There { go(3); }
        state There { when done -> Back { go(1); } }
        state Back { when done -> Short { go(0); } }
        state Short { when done -> Ended; }
        final state Ended;",
        r#"{"time_limit_s": 60}"#,
    ));
    let [there, back, short] = rests[..] else { panic!("{rests:?}") };
    assert_eq!((there.1, there.2), (3.0, [6.0, 4.0]));
    assert_eq!((back.1, back.2), (1.0, [3.0, 0.0]));
    assert_eq!((short.1, short.2), (0.0, [0.0, 0.0]));
    let way = |length: f64| if length < 4.5 { 2.0 * (length / 0.5).sqrt() } else { length / 1.5 + 3.0 };
    assert!(is_near(there.0, way(10.0), SCANS), "{rests:?}");
    assert!(is_near(back.0 - there.0, way(7.0), SCANS), "{rests:?}");
    assert!(is_near(short.0 - back.0, way(3.0), SCANS), "{rests:?}");
}

/// At 3 m it is told to go on to the end, without a stop: it takes no longer than the way at once.
#[test]
fn on_the_way_it_takes_another_goal_without_a_stop() {
    let rests = rests(&with_automaton(
        "initial -> First { go(2); }
        state First { when place = 1 -> Then { go(3); } }
        state Then { when done -> Ended; }
        final state Ended;",
        r#"{"time_limit_s": 60}"#,
    ));
    let [end] = rests[..] else { panic!("{rests:?}") };
    assert_eq!(end.2, [6.0, 4.0]);
    assert!(is_near(end.0, 10.0 / 1.5 + 3.0, SCANS), "{rests:?}");
}

/// At 3 m it goes 1.5 m/s, and halts in 2.25 m. A place behind it, asked for on the way, is refused, and it brakes too.
#[test]
fn it_halts_in_its_braking_distance() {
    for (order, why) in
        [("halt();", "done"), ("go(0);", "failed and error = 1"), ("go(9);", "failed and error = 1")]
    {
        let rests = rests(&with_automaton(
            &format!(
                "initial -> First {{ go(3); }}
                state First {{ when place = 1 -> Then {{ {order} }} }}
                state Then {{ when stands and ({why}) -> Ended; }}
                final state Ended;
                invariant not stands or pos.x < 5.5 else \"too far\";"
            ),
            r#"{"time_limit_s": 60}"#,
        ));
        let [end] = rests[..] else { panic!("{order}: {rests:?}") };
        assert_eq!(end.1, 1.0);
        assert!(end.2[0] > 5.25 - 1e-9 && end.2[0] < 5.25 + 1.5 * SCANS, "{order}: {rests:?}");
    }
}

/// Held after 4 s it has come 3.75 m and brakes in 2.25 m, to rest at 6 m; after the pause it has 4 m more.
#[test]
fn held_it_brakes_and_goes_on_when_it_is_let_go() {
    let rests = rests(&with_automaton(
        "initial -> There { go(3); }
        state There { when done -> Ended; }
        final state Ended;",
        r#"{"time_limit_s": 60, "faults": {"pauses": [{"at_s": 4, "for_s": 10}]}}"#,
    ));
    let [held, end] = rests[..] else { panic!("{rests:?}") };
    assert!(is_near(held.0, 7.0, SCANS), "{rests:?}");
    assert!(is_near(held.2[0] + held.2[1], 6.0, 1.5 * SCANS), "{rests:?}");
    assert_eq!(end.2, [6.0, 4.0]);
    assert!(is_near(end.0, 14.0 + 2.0 * (4.0_f64 / 0.5).sqrt(), 2.0 * SCANS), "{rests:?}");
}

/// The first contact of a vehicle that drives to the end of its track, beside what else is in the layout.
fn contact(robots: &str, stationary: &str) -> Contact {
    let mut texts = with_automaton(
        "parameter goes: bool := true;
        initial -> Waiting {}
        state Waiting { when goes -> There { go(3); } }
        state There { when done -> Ended; }
        final state Ended;",
        r#"{"time_limit_s": 60}"#,
    );
    texts.layout = format!(
        r#"{{"robots": [{{"name": "cart", "type": "cart", "pose": [0, 0, 0]}}{robots}], "stationary": [{stationary}]}}"#
    );
    let (project, _) = with_words(&texts);
    let execute = |stepping| {
        let (mut executor, mut memory) = (Executor::new(&project.system), Memory::default());
        run_again(&project.plant, &mut executor, stepping, &mut memory, &mut |_| {})
            .expect("a line that runs")
    };
    let report = execute(Stepping::Events);
    assert_eq!(report, execute(Stepping::EveryScan));
    assert_eq!(report, execute(Stepping::Checked));
    let [contact] = &report.collisions[..] else { panic!("{report:?}") };
    contact.clone()
}

/// Middles are 5 m apart and the vehicles 0.8 m long: one drives 4.2 m until it touches, at full speed from 2.25 m on.
#[test]
fn it_runs_into_a_vehicle_that_stands_before_it() {
    let other = r#", {"name": "other", "type": "cart", "pose": [5, 0, 0], "parameters": {"goes": false}}"#;
    let found = contact(other, "");
    assert_eq!(found.pair, ["cart", "other"]);
    assert!(is_near(found.time_s, 4.2 / 1.5 + 1.5, SCANS), "{found:?}");
    assert!(is_near(found.place.x, 4.6, 0.005), "{found:?}");
}

/// At its corner the vehicle turns at once: only then is its rear where the post stands, at the side of the straight.
#[test]
fn it_touches_with_its_rear_what_stands_beside_its_corner() {
    let post =
        |y: f64| format!(r#"{{"name": "post", "type": "box", "pose": [6, {y}, 0], "box": [0.1, 0.1, 0.5]}}"#);
    let found = contact("", &post(-0.35));
    assert_eq!(found.pair, ["cart", "post"]);
    assert!(is_near(found.time_s, 6.0 / 1.5 + 1.5, SCANS), "{found:?}");
}

/// A conveyor whose end is 0.1 m ahead of the middle of a cart, and lays a piece of 0.2 m there on its deck. After 10 s the
/// cart drives 3 m ahead, turns to the left and drives 2 m.
fn loaded(stationary: &str) -> Texts {
    let text = "device feeder {
        part belt = lane { from: origin * frame(-1, 0, 0.6, 0); length: 1.0; width: 0.3; speed: 0.5; };
        part feed = source { on: belt; inset: 0.2; };
        out run: bool = belt.run;
    }
    automaton Feeder on feeder { initial -> Running { run := true; } final state Running; }
    device cart {
        part drive = track {
            corners: [pose, pose + point(3, 0, 0), pose + point(3, 2, 0)]; places: [0.0, 5.0];
            speed: 1.5; acceleration: 0.5; mass: 10.0;
        };
        part hull = body { on: drive; low: point(-0.4, -0.2, 0); high: point(0.1, 0.2, 0.39); };
        part deck = place {
            on: drive; at: point(0.1, 0, 0.4); slots: [point(0, 0, 0)]; by_kind: false;
            floor: point(0, 0, 0); floor_x: [-0.3, 0.3]; floor_y: [-0.2, 0.2];
        };
        out goal: int 0..1;
        command 1 go(goal) = drive.to(goal);
    }
    automaton Cart on cart {
        initial -> Loading {}
        state Loading { when after 10 s -> Driving { go(1); } }
        state Driving { when done -> There; }
        final state There;
    }";
    let layout = format!(
        r#"{{"robots": [
            {{"name": "feeder", "type": "feeder", "pose": [0, 0, 0]}}, {{"name": "cart", "type": "cart", "pose": [0, 0, 0]}}
        ], "stationary": [{stationary}]}}"#
    );
    let scenario = r#"{"kinds": [{"name": "piece", "height": 0.1, "size": [0.2, 0.1]}],
        "supply": {"items": ["piece"]}, "time_limit_s": 30}"#;
    Texts { layout, specs: vec![text.into()], scenario: Some(scenario.into()), ..Texts::default() }
}

#[test]
fn what_lies_on_a_vehicle_rides_and_turns_with_it() {
    let texts = loaded("");
    let outcome = texts.compile();
    let Some(project) = outcome.project else {
        panic!("{}", autogen_tests::plain(&outcome.sources, &outcome.diagnostics))
    };
    let execute = |stepping| {
        let mut seen_at = Vec::new();
        let mut observer = |seen: &Seen| {
            seen_at.extend(seen.plant.place(0).map(|place| (seen.plant.now_ms(), place)));
        };
        let mut executor = Executor::new(&project.system);
        let run = record(&project.plant, &mut executor, stepping, &[], &mut observer);
        let run = run.expect("a line that can be run");
        (run.report, run.paths, seen_at)
    };
    let (report, paths, seen_at) = execute(Stepping::EveryScan);
    for stepping in [Stepping::Events, Stepping::Checked] {
        assert_eq!(execute(stepping).0, report, "{stepping:?}");
    }
    let is_near = |a: Point, b: Point| (a - b).length() < 1e-9;
    for (ms, place) in &seen_at {
        let ms = *ms as f64;
        let known: Vec<Point> = paths[0].at(ms).map(|segment| segment.place(ms)).collect();
        assert!(known.iter().any(|known| is_near(*known, *place)), "{ms} ms: {known:?}, not {place:?}");
    }
    let at = |ms: u64| seen_at.iter().find(|(time, _)| *time == ms).expect("a scan").1;
    // The command comes 10 s after the start in scan 2; then 0.25 t2 until 1.5 m/s, round the corner after 3 m.
    assert!(is_near(at(10_000), Point::new(0.1, 0.0, 0.4)), "{:?}", at(10_000));
    let ahead = at(11_020).x - 0.1;
    assert!((ahead - 0.25).abs() < 0.02 && at(11_020).y == 0.0, "{:?}", at(11_020));
    // Braking to 5 m: 2 sqrt(5 / 0.5) s.
    let there = seen_at.last().expect("a place").1;
    assert!(is_near(there, Point::new(3.0, 2.1, 0.4)), "{there:?}");
    let corner = seen_at.windows(2).find(|pair| pair[0].1.x > 3.0 && pair[1].1.y > 0.0).expect("a corner");
    assert!((corner[1].1 - corner[0].1).length() > 0.1, "{corner:?}");
    assert_eq!((report.items[0].carrier.as_str(), report.collisions.len()), ("cart", 0));
}

/// It is 0.2 m long and lies 0.1 m ahead of the middle: 0.1 m beyond the hull, along the cart's own direction.
#[test]
fn what_lies_on_a_vehicle_touches_what_is_in_its_way() {
    let run = |stationary: &str| {
        let project = loaded(stationary).project();
        let execute = |stepping| {
            let (mut executor, mut memory) = (Executor::new(&project.system), Memory::default());
            run_again(&project.plant, &mut executor, stepping, &mut memory, &mut |_| {})
                .expect("a line that runs")
        };
        let [events, every, checked] =
            [Stepping::Events, Stepping::EveryScan, Stepping::Checked].map(execute);
        assert_eq!(events, every);
        assert_eq!(checked, every);
        every.reason
    };
    let wall =
        |y: f64| format!(r#"{{"name": "wall", "type": "box", "pose": [3, {y}, 0], "box": [0.4, 0.2, 1]}}"#);
    assert_eq!(run(&wall(2.31)), "time limit reached");
    let touches = run(&wall(2.25));
    assert!(touches.starts_with("collision of cart (piece_1) with wall (body)"), "{touches}");
}

/// What a layout with a device of one vehicle is told.
fn told(settings: &str) -> String {
    let device = format!(
        "device cart {{ parameter spot: real; part drive = track {{ {settings} mass: 10.0; }};
        in stands: bool = drive.stands; }}
        automaton Cart on cart {{ initial state S {{ when stands -> S {{}} }} }}"
    );
    let layout = r#"{"robots": [{"name": "cart", "type": "cart", "pose": [0, 0, 0], "spot": 12}]}"#;
    let texts = Texts { specs: vec![device], ..Texts::of_layout(layout) };
    let outcome = texts.compile();
    let all: Vec<String> = outcome
        .diagnostics
        .iter()
        .map(|found| {
            assert!(!found.help.is_empty(), "{found:?}");
            format!("{} {}", found.code, found.message)
        })
        .collect();
    all.join("; ")
}

#[test]
fn what_is_wrong_with_a_track_is_told() {
    let line = "corners: [pose, pose + point(10, 0, 0)];";
    let runs = "speed: 1.5; acceleration: 0.5;";
    let right = told(&format!("{line} places: [spot - 2.0]; {runs}"));
    assert_eq!(right, "");
    for (settings, wanted) in [
        (
            format!("{line} places: [0.0, spot]; {runs}"),
            "E0704 the part drive: place 1 is at 12.000 m of a track of 10.000 m",
        ),
        (
            format!("{line} places: [0.0]; begins: spot; {runs}"),
            "E0704 the part drive: it begins at 12.000 m of a track of 10.000 m",
        ),
        (
            format!("corners: [pose, pose + point(spot - 12.0, 0, 0)]; places: [0.0]; {runs}"),
            "E0704 the part drive: the track has no length at corner 0",
        ),
        (
            format!("corners: [pose + point(spot, 0, 0)]; places: [0.0]; {runs}"),
            "E0704 the part drive: a track has two corners at least",
        ),
        (
            format!("corners: [pose, pose + point(spot, 0, 1)]; places: [0.0]; {runs}"),
            "E0704 the part drive: the track rises at corner 0: all corners have the same z",
        ),
        (
            format!("{line} places: [0.0]; speed: 0.0 - spot; acceleration: 0.5;"),
            "E0704 `speed` has to be a number over 0",
        ),
        (
            format!("{line} places: [0.0]; speed: 1.0; acceleration: spot - 12.0;"),
            "E0704 `acceleration` has to be a number over 0",
        ),
    ] {
        assert_eq!(told(&settings), wanted, "{settings}");
    }
}

/// A network of 10 m by 10 m: from node 1 straight to node 2, or round by 3 and 4; from 2 back to 0 by 5 and 6. `speeds` are
/// those of the edges 0-1, 1-2, 1-3, 3-4, 4-2, 2-5, 5-6, 6-0.
fn with_network(speeds: [f64; 8], automaton: &str, scenario: &str) -> Texts {
    let device = format!(
        "device cart {{
        part drive = track {{
            nodes: pose + [point(0, 0, 0), point(10, 0, 0), point(20, 0, 0), point(10, 10, 0), point(20, 10, 0),
                point(20, -5, 0), point(0, -5, 0)];
            edges: [0, 1, 1, 2, 1, 3, 3, 4, 4, 2, 2, 5, 5, 6, 6, 0]; speeds: {speeds:?};
            speed: 1.5; acceleration: 0.5; mass: 10.0;
        }};
        in pos: point = drive.position;
        in place: int -1..9 = drive.place;
        in stands: bool = drive.stands;
        out goal: int 0..9;
        command 1 go(goal) = drive.to(goal);
        command 2 halt() = drive.halt();
    }}
    automaton Cart on cart {{ {automaton} }}"
    );
    Texts { specs: vec![device], ..with_automaton("", scenario) }
}

/// From one speed to another one over so many metres, with 1.5 m/s and 0.5 m/s2 at most, s.
fn leg(length: f64, from: f64, to: f64) -> f64 {
    let (v, a) = (1.5, 0.5);
    length / v + ((v - from).powi(2) + (v - to).powi(2)) / (2.0 * a * v)
}

const FAST: [f64; 8] = [1.5; 8];
const ONCE: &str = "state There { when done -> Ended; } final state Ended;";

/// Straight 10 + 10 m, of them 10 at 0.4 m/s, or round 40 m.
#[test]
fn on_a_network_it_takes_the_quickest_way() {
    let slow = [1.5, 0.4, 1.5, 1.5, 1.5, 1.5, 1.5, 1.5];
    for (speeds, length) in [(FAST, 20.0), (slow, 40.0)] {
        let rests = rests(&with_network(
            speeds,
            &format!("initial -> There {{ go(2); }} {ONCE}"),
            r#"{"time_limit_s": 60}"#,
        ));
        let [end] = rests[..] else { panic!("{rests:?}") };
        assert_eq!((end.1, end.2), (2.0, [20.0, 0.0]));
        assert!(is_near(end.0, leg(length, 0.0, 0.0), SCANS), "{rests:?}");
    }
}

/// It brakes before a slow edge, and gains speed behind it.
#[test]
fn on_a_network_each_edge_has_its_speed() {
    let speeds = [1.5, 1.5, 0.5, 1.5, 1.5, 1.5, 1.5, 1.5];
    let rests = rests(&with_network(
        speeds,
        &format!("initial -> There {{ go(4); }} {ONCE}"),
        r#"{"time_limit_s": 60}"#,
    ));
    let [end] = rests[..] else { panic!("{rests:?}") };
    assert_eq!((end.1, end.2), (4.0, [20.0, 10.0]));
    let wanted = leg(10.0, 0.0, 0.5) + 10.0 / 0.5 + leg(10.0, 0.5, 0.0);
    assert!(is_near(end.0, wanted, SCANS), "{rests:?}");
}

/// Sent straight on, it is sent round before it is at the branch: it does not stop, and passes node 3.
#[test]
fn on_a_network_it_takes_another_way_without_a_stop() {
    let rests = rests(&with_network(
        FAST,
        "local passed: bool := false;
        initial -> First { go(2); }
        state First { when after 4 s -> Then { go(4); } }
        state Then { when place = 3 and not passed { passed := true; } when done and passed -> Ended; }
        final state Ended;",
        r#"{"time_limit_s": 60}"#,
    ));
    let [end] = rests[..] else { panic!("{rests:?}") };
    assert_eq!((end.1, end.2), (4.0, [20.0, 10.0]));
    assert!(is_near(end.0, leg(30.0, 0.0, 0.0), SCANS), "{rests:?}");
}

/// After 7 s it has come 8.25 m, and brakes in 2.25 m: node 1 is too near, and it comes to rest behind it, on its old way.
/// From there it goes on to node 3 by the whole round.
#[test]
fn on_a_network_a_node_that_is_too_near_is_refused() {
    let rests = rests(&with_network(
        FAST,
        "initial -> First { go(2); }
        state First { when after 7 s -> Then { go(1); } }
        state Then { when stands and failed and error = 1 -> On { go(3); } }
        state On { when done -> Ended; }
        final state Ended;",
        r#"{"time_limit_s": 90}"#,
    ));
    let [halted, end] = rests[..] else { panic!("{rests:?}") };
    assert_eq!(halted.1, 1.0);
    assert!(is_near(halted.2[0], 10.5, 1.5 * SCANS), "{rests:?}");
    assert_eq!((end.1, end.2), (3.0, [10.0, 10.0]));
    let length = 9.5 + 5.0 + 20.0 + 5.0 + 10.0 + 10.0;
    assert!(is_near(end.0 - halted.0, leg(length, 0.0, 0.0), 2.0 * SCANS), "{rests:?}");
}

/// As on a line: held after 3.75 m, it rests at 6 m, and has 14 m more when it is released, or when it no longer jams.
#[test]
fn on_a_network_it_goes_on_where_it_was_held() {
    for faults in [
        r#""pauses": [{"at_s": 4, "for_s": 10}]"#,
        r#""jams": [{"robot": "cart", "part": "drive", "at_s": 4, "for_s": 10}]"#,
    ] {
        let rests = rests(&with_network(
            FAST,
            &format!("initial -> There {{ go(2); }} {ONCE}"),
            &format!(r#"{{"time_limit_s": 60, "faults": {{{faults}}}}}"#),
        ));
        let [held, end] = rests[..] else { panic!("{rests:?}") };
        assert!(is_near(held.0, 7.0, SCANS), "{rests:?}");
        assert!(is_near(held.2[0], 6.0, 1.5 * SCANS), "{rests:?}");
        assert_eq!((end.1, end.2), (2.0, [20.0, 0.0]));
        assert!(is_near(end.0, 14.0 + leg(14.0, 0.0, 0.0), 2.0 * SCANS), "{rests:?}");
    }
}

/// A way that turns back at a node has a stop there.
#[test]
fn on_a_network_it_stops_where_its_way_turns_back() {
    let mut texts =
        with_network(FAST, &format!("initial -> There {{ go(3); }} {ONCE}"), r#"{"time_limit_s": 60}"#);
    texts.specs[0] = texts.specs[0].replace("point(10, 10, 0)", "point(4, 8, 0)");
    let rests = rests(&texts);
    let [end] = rests[..] else { panic!("{rests:?}") };
    assert_eq!(end.1, 3.0);
    assert!(is_near(end.2[0], 4.0, 1e-9) && is_near(end.2[1], 8.0, 1e-9), "{rests:?}");
    assert!(is_near(end.0, leg(10.0, 0.0, 0.0) + leg(10.0, 0.0, 0.0), SCANS), "{rests:?}");
}

/// Goals at drawn times, and pauses: in each scan it is on an edge, no faster than allowed there, and its speed changes no
/// faster than its acceleration allows. How it is stepped makes no difference.
#[test]
fn on_a_network_it_keeps_to_its_edges_whatever_it_is_told() {
    const NODES: [[f64; 2]; 7] =
        [[0.0, 0.0], [10.0, 0.0], [20.0, 0.0], [10.0, 10.0], [20.0, 10.0], [20.0, -5.0], [0.0, -5.0]];
    const EDGES: [[usize; 2]; 8] = [[0, 1], [1, 2], [1, 3], [3, 4], [4, 2], [2, 5], [5, 6], [6, 0]];
    let speeds = [1.5, 0.4, 1.0, 0.7, 1.5, 1.2, 0.9, 1.5];
    let (dt, a) = (0.01, 0.5);
    let on = |edge: usize, [x, y]: [f64; 2]| {
        let [from, to] = EDGES[edge].map(|node| NODES[node]);
        let [dx, dy] = [to[0] - from[0], to[1] - from[1]];
        let along = ((x - from[0]) * dx + (y - from[1]) * dy) / dx.hypot(dy);
        let across = ((x - from[0]) * dy - (y - from[1]) * dx) / dx.hypot(dy);
        (across.abs() < 1e-6 && (-1e-6..=dx.hypot(dy) + 1e-6).contains(&along)).then_some(along)
    };
    let seeds = if is_full_campaign() { 200 } else { 6 };
    for seed in 0..seeds {
        let mut random = Random::at(seed, [1, 2]);
        let mut drawn = |most: u64| random.next_u64() % most;
        let goals: Vec<String> = (0..40)
            .map(|number| {
                let at_ms = 4000 * number + drawn(4000);
                format!(
                    r#"{{"robot": "cart", "part": "wish", "at_s": {}, "value": {}}}"#,
                    at_ms as f64 / 1000.0,
                    drawn(7)
                )
            })
            .collect();
        let pauses: Vec<String> = (0..3)
            .map(|number| format!(r#"{{"at_s": {}, "for_s": 3.3}}"#, 50 * number + 5 + drawn(40)))
            .collect();
        let scenario = format!(
            r#"{{"time_limit_s": 170, "operator": [{}], "faults": {{"pauses": [{}]}}}}"#,
            goals.join(", "),
            pauses.join(", ")
        );
        let mut texts = with_network(
            speeds,
            "local told: int 0..6 := 0;
            initial -> Driving {}
            state Driving {
                when wanted <> told -> Driving { told := wanted; go(wanted); }
                when failed and stands -> Driving { go(told); }
            }",
            &scenario,
        );
        let wish = "part wish = selector { begins: 0; }; in wanted: int 0..6 = wish.position; in pos";
        texts.specs[0] = texts.specs[0].replace("in pos", wish);
        let (project, words) = with_words(&texts);
        let position = ["cart_pos_x", "cart_pos_y"].map(|name| words[name]);
        let execute = |stepping| {
            let mut places: Vec<[f64; 2]> = Vec::new();
            let mut observer = |seen: &Seen| places.push(position.map(|word| word.value(seen)));
            let (mut executor, mut memory) = (Executor::new(&project.system), Memory::default());
            let report = run_again(&project.plant, &mut executor, stepping, &mut memory, &mut observer);
            (report.expect("a line that runs"), places)
        };
        let [events, every, checked] =
            [Stepping::Events, Stepping::EveryScan, Stepping::Checked].map(execute);
        assert_eq!(events.0, every.0, "seed {seed}");
        assert_eq!(checked.0, every.0, "seed {seed}");
        let mut last: Option<(usize, f64)> = None;
        let mut passed = 0;
        for (scan, pair) in every.1.windows(2).enumerate() {
            let [from, to] = [pair[0], pair[1]];
            let step = (to[0] - from[0]).hypot(to[1] - from[1]);
            let both = (0..EDGES.len()).find_map(|edge| Some((edge, on(edge, to)? - on(edge, from)?)));
            let Some((edge, forward)) = both else {
                assert!(
                    (0..EDGES.len()).any(|edge| on(edge, to).is_some()),
                    "seed {seed}, scan {scan}: {to:?}"
                );
                assert!(step <= 1.5 * dt + 1e-6, "seed {seed}, scan {scan}: {step}");
                last = None;
                passed += 1;
                continue;
            };
            assert!(
                (-1e-5..=speeds[edge] * dt + 1e-6).contains(&forward),
                "seed {seed}, scan {scan}: {forward} on {edge}"
            );
            let speed = forward / dt;
            if let Some((_, before)) = last.filter(|(last, _)| *last == edge) {
                assert!(
                    (speed - before).abs() <= a * dt + 1e-3,
                    "seed {seed}, scan {scan}: {before} to {speed}"
                );
            }
            last = Some((edge, speed));
        }
        assert!(passed > 3, "seed {seed}: it passes {passed} nodes");
    }
}

#[test]
fn what_is_wrong_with_a_network_is_told() {
    let runs = "speed: 1.5; acceleration: 0.5;";
    let nodes = "nodes: [pose, pose + point(10, 0, 0), pose + point(spot - 2.0, 5, 0)];";
    let round = "edges: [0, 1, 1, 2, 2, 0];";
    assert_eq!(told(&format!("{nodes} {round} {runs}")), "");
    for (settings, wanted) in [
        (
            format!("{nodes} edges: [0, 1, 1, 0]; {runs}"),
            "no way leads from node 0, where it begins, to node 2",
        ),
        (
            format!("{nodes} edges: [0, 1, 1, 0, 1, 2]; {runs}"),
            "no way leads from node 2 back to node 0, where it begins",
        ),
        (
            format!("{nodes} edges: [0, 1, 1, 2, 2]; {runs}"),
            "`edges` are 1 to 1024 pairs of nodes, these are 5 numbers",
        ),
        (format!("{nodes} edges: []; {runs}"), "`edges` are 1 to 1024 pairs of nodes, these are 0 numbers"),
        (format!("{nodes} edges: [0, 1, 1, 3]; {runs}"), "edge 1 ends at node 3, nodes are 0 to 2"),
        (format!("{nodes} edges: [0, 1, 1, 1]; {runs}"), "edge 1 from node 1 to node 1 has no length"),
        (format!("{nodes} edges: [0, 1, 0, 1]; {runs}"), "two edges lead from node 0 to node 1"),
        (format!("{nodes} {round} speeds: [1.0]; {runs}"), "1 speeds of 3 edges"),
        (
            format!("{nodes} {round} speeds: [1.0, spot - 12.0, 1.0]; {runs}"),
            "the speed of edge 1 from node 1 to node 2 is not over 0",
        ),
        (format!("{nodes} {round} begins: 3; {runs}"), "it begins at node 3, nodes are 0 to 2"),
        (
            format!("{nodes} {round} closed: true; {runs}"),
            "a track is given by corners and places, or by nodes and edges",
        ),
        (format!("{nodes} {runs}"), "a track is given by corners and places, or by nodes and edges"),
        (
            format!("nodes: [pose, pose + point(1, 0, spot)]; edges: [0, 1, 1, 0]; {runs}"),
            "node 1 is at another height: all nodes have the same z",
        ),
        (format!("nodes: [pose]; edges: [0, 0]; {runs}"), "1 nodes, there are 2 to 256"),
    ] {
        assert_eq!(told(&settings), format!("E0704 the part drive: {wanted}"), "{settings}");
    }
}
