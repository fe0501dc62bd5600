//! Lines of the examples whose figures are known from closed forms.

use autogen::executor::Executor;
use autogen_tests::{Texts, side_by_side};
use runtime_sim::carrier::Carrier;
use runtime_sim::event::Event;
use runtime_sim::memory::Memory;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, run_again};

fn run(texts: Texts, observer: &mut dyn FnMut(&Seen)) -> Report {
    let outcome = texts.compile();
    let project = outcome.project.unwrap_or_else(|| panic!("{:?}", outcome.diagnostics));
    let mut executor = Executor::new(&project.system);
    let memory = &mut Memory::default();
    run_again(&project.plant, &mut executor, Stepping::Events, memory, observer).expect("a line that runs")
}

/// Of the sorting station, s: 0.10 m at 13 s per metre to the stopper, 0.5 s to identify, 0.15 s until the stopper is
/// down, the rest of the belt; then 0.15 s until the stopper is up.
const SORTED: [f64; 3] = [3.9, 5.85, 8.06];
const CLOSES: f64 = 0.15;

#[test]
fn the_sorting_station_takes_the_time_of_its_closed_form() {
    let pieces = 30.0;
    let exact = SORTED.iter().sum::<f64>() * 10.0 + (pieces - 1.0) * CLOSES;
    assert!((exact - 182.45).abs() < 1e-9);
    for scan_ms in [1_u32, 10] {
        let mut put = Vec::new();
        let mut times: Vec<(usize, f64)> = Vec::new();
        let mut read = 0;
        let mut observer = |seen: &Seen| {
            let log = seen.plant.items().log();
            for event in log.since(read) {
                let Event::Item { scan, item, from, to, .. } = *event else { continue };
                let now_s = (scan * u64::from(scan_ms)) as f64 / 1000.0;
                if from == Carrier::Supply {
                    put.push(now_s);
                }
                if let Carrier::Sink { .. } = to {
                    times.push((seen.plant.items()[item].kind, now_s - put[item]));
                }
            }
            read = log.count();
        };
        let mut texts = side_by_side("sorting/sorting");
        texts.layout = texts.layout.replacen('{', &format!("{{\"scan_ms\": {scan_ms}, "), 1);
        let report = run(texts, &mut observer);
        assert_eq!(report.reason, "all items collected");
        assert!(report.collisions.is_empty());
        // From the belt to the box: 0.3 m at 0.5 m/s. Each of five waits is up to two scans long.
        let to_box = 0.30 / 0.5;
        let scan_s = f64::from(scan_ms) / 1000.0;
        let waits = |pieces: f64| pieces * 5.0 * 2.0 * scan_s;
        for (kind, time) in &times {
            let late = time - SORTED[*kind] - to_box;
            // A piece that is put on at the start of a scan is told of at its end.
            assert!((-scan_s - 1e-9..=waits(1.0)).contains(&late), "kind {kind}: {time} s, {late} s late");
        }
        let late = report.simulated_s - exact - to_box;
        assert!((-1e-9..=waits(pieces)).contains(&late), "{} s, {late} s late", report.simulated_s);
    }
}

/// Of the tending cell, s: 90 of cutting, 2 x 4 of the door, 17.656 of moves, 2 x 0.25 of grips, 2 x 0.2 of releases,
/// 2 x 1 of the vise. Moves: closed forms of a second program, from the maker's lengths.
const TENDED: f64 = 90.0 + 8.0 + 17.656 + 0.5 + 0.4 + 2.0;

#[test]
fn the_tending_cell_takes_the_time_of_its_closed_form() {
    let mut collected = Vec::new();
    let mut read = 0;
    let mut observer = |seen: &Seen| {
        let log = seen.plant.items().log();
        for event in log.since(read) {
            if let Event::Item { scan, to: Carrier::Sink { .. }, .. } = *event {
                collected.push(scan as f64 / 100.0);
            }
        }
        read = log.count();
    };
    let report = run(side_by_side("tending/tending"), &mut observer);
    assert_eq!(report.reason, "all items collected");
    assert!(report.collisions.is_empty());
    let cycles: Vec<f64> = collected.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert_eq!(cycles.len(), 39);
    for cycle in &cycles {
        // Each of 24 waits is up to two scans of 10 ms long.
        assert!((TENDED - 0.01..=TENDED + 0.49).contains(cycle), "{cycle} s");
    }
}

/// At the worst places of the cell, over the vise and over the conveyors: how far the centre of the wrist is from the base's
/// axis, and in the plane of the arm from its longest reach, by a second program; and how far it is in space from any
/// place that the arm does not reach, by trying directions.
const WORST: [([&str; 2], [f64; 3]); 4] = [
    (["infeed", "arm"], [0.851469, 0.372996, 0.369990]),
    (["arm", "mill"], [1.05, 0.170198, 0.169980]),
    (["arm", "outfeed"], [0.851469, 0.372996, 0.369990]),
    (["mill", "arm"], [1.05, 0.170198, 0.169980]),
];

#[test]
fn the_margins_of_the_tending_cell_are_safe() {
    let verdict = side_by_side("tending/tending").compile().verdict.expect("a verdict");
    assert_eq!(verdict.edges.len(), WORST.len());
    for (edge, ([from, to], [radius, in_plane, in_space])) in verdict.edges.iter().zip(WORST) {
        assert_eq!([&edge.from[..], &edge.to[..]], [from, to]);
        // The plane is d4 beside the axis: docs/devices.md.
        let d4 = 0.17415_f64;
        let ahead = (radius * radius - d4 * d4).sqrt() - in_plane;
        let margin = radius - ahead.hypot(d4);
        assert!((edge.margin - margin).abs() < 1e-5, "{from}, {to}: {} m, not {margin} m", edge.margin);
        assert!(margin < in_space && margin > 0.96 * in_space, "{margin} m of {in_space} m");
    }
}

/// A mill 0.4 m further away is out of reach; what is suggested brings it back, and a millimetre less does not.
#[test]
fn a_mill_too_far_away_is_brought_back_by_217_mm() {
    let with_mill_at = |x: &str| {
        let mut texts = side_by_side("tending/tending");
        texts.layout = texts.layout.replace("[1.50, 0, 0, 90]", &format!("[{x}, 0, 0, 90]"));
        texts.compile()
    };
    let apart = with_mill_at("1.90");
    let verdict = apart.verdict.expect("a verdict");
    assert!(!verdict.feasible);
    let pair = verdict.apart.iter().find(|pair| pair.from == "mill").expect("the mill and the arm");
    let (robot, path, present, new) = pair.suggestion.clone().expect("a suggestion");
    assert_eq!((robot.as_str(), path.as_str(), present), ("mill", "pose[0]", 1.9));
    assert!((new - 1.683).abs() < 1e-9, "{new}");
    assert!(with_mill_at("1.683").verdict.expect("a verdict").feasible);
    assert!(!with_mill_at("1.684").verdict.expect("a verdict").feasible);
}

/// The vise is 0.45 m beside the mill's axis, which is 1.5 m from the arm's, and in reach up to 1.233335 m: the sine of the
/// yaw has to be 0.6899 at least.
#[test]
fn a_mill_that_is_turned_away_is_turned_back_by_134_degrees() {
    let turned_to = |yaw: &str| {
        let mut texts = side_by_side("tending/tending");
        texts.layout = texts.layout.replace("[1.50, 0, 0, 90]", &format!("[1.50, 0, 0, {yaw}]"));
        texts.compile()
    };
    let apart = turned_to("-90");
    let verdict = apart.verdict.expect("a verdict");
    let turns: Vec<_> = verdict.apart.iter().filter_map(|pair| pair.turn.clone()).collect();
    assert_eq!(turns, [("mill".to_string(), -90.0, 44.0), ("mill".to_string(), -90.0, 44.0)]);
    let wanted = "; or turn mill to 44 (the fourth number of its pose, now -90): 134 degrees bring the two together, 133 do not";
    let helps: Vec<_> = apart.diagnostics.iter().map(|found| &found.help).collect();
    assert!(
        helps.iter().any(|help| help.starts_with("set `pose[0]` of mill") && help.ends_with(wanted)),
        "{helps:?}"
    );
    for (yaw, is_feasible) in [("43", false), ("44", true), ("136", true), ("137", false)] {
        assert_eq!(turned_to(yaw).verdict.expect("a verdict").feasible, is_feasible, "{yaw}");
    }
}

#[test]
fn a_mill_that_is_started_with_its_door_open_ends_the_run() {
    let mut texts = side_by_side("tending/tending");
    texts.specs[0] = texts.specs[0].replace("when door_closed -> Starting", "when true -> Starting");
    let report = run(texts, &mut |_: &Seen| {});
    assert!(!report.finished);
    assert_eq!(report.reason, "interlock of mill: the process cycle was started without its door in");
}

/// Twenty modules in a loop with a feed and two exits: nothing is stuck, nothing touches, and items go round that find
/// no room at their exit.
#[test]
fn a_loop_of_twenty_modules_brings_all_items_to_their_exits() {
    let texts = side_by_side("loop/loop");
    let project = texts.compile().project.expect("a line without errors");
    let last = project.plant.machines.iter().position(|machine| machine.name == "c4").expect("a module");
    let (mut rounds, mut read) = (0, 0);
    let mut observe = |seen: &Seen| {
        let log = seen.plant.items().log();
        for event in log.since(read) {
            let Event::Item { to, .. } = *event else { continue };
            let is_back = to.machine().is_some_and(|machine| machine == last);
            rounds += usize::from(is_back);
        }
        read = log.count();
    };
    let report = run(texts, &mut observe);
    assert_eq!(report.reason, "all items collected");
    assert!(report.collisions.is_empty(), "{:?}", report.collisions);
    assert!(rounds >= 5, "{rounds} rounds");
}

/// Two arms of different manufacturers hand eight parts over by a turntable: nothing touches, and how the run is stepped
/// makes no difference.
#[test]
fn two_arms_hand_over_by_a_turntable() {
    let project = side_by_side("turntable/turntable").compile().project.expect("a line without errors");
    let execute = |stepping| {
        let (mut executor, mut memory) = (Executor::new(&project.system), Memory::default());
        run_again(&project.plant, &mut executor, stepping, &mut memory, &mut |_: &Seen| {})
            .expect("a line that runs")
    };
    let [events, every, checked] = [Stepping::Events, Stepping::EveryScan, Stepping::Checked].map(execute);
    assert_eq!(events, every);
    assert_eq!(checked, every);
    assert_eq!(events.reason, "all items collected");
    assert!(events.collisions.is_empty(), "{:?}", events.collisions);
}

/// An item at the end of a table that turns hits a post beside it: where the item is then, no body of the machine has been.
#[test]
fn what_lies_on_a_turntable_touches_what_is_in_its_way() {
    let mut texts = side_by_side("turntable/turntable");
    let post = |y: f64| {
        format!(
            r#", "stationary": [{{"name": "post", "type": "box", "pose": [1.0, {y}, 0], "box": [0.02, 0.02, 0.915]}}]"#
        )
    };
    let layout = texts.layout.trim_end().trim_end_matches('}').to_string();
    for (y, touches) in [(-0.26, true), (-0.40, false)] {
        texts.layout = format!("{layout}{}}}", post(y));
        texts.specs[0] = texts.specs[0]
            .replace("high: pose + point(0.35, 0.06, top)", "high: pose + point(0.2, 0.06, top)");
        texts.specs[0] = texts.specs[0].replace("low: pose + point(-0.35,", "low: pose + point(-0.2,");
        let report = run(texts.clone(), &mut |_: &Seen| {});
        let found: Vec<_> =
            report.collisions.iter().map(|contact| (contact.pair.clone(), contact.parts.clone())).collect();
        let wanted = (["table", "post"].map(String::from), ["blank_1", "body"].map(String::from));
        assert_eq!(found, if touches { vec![wanted] } else { Vec::new() });
    }
}

/// From one speed to another one over so many metres, with 1.5 m/s and 0.5 m/s2 at most, s.
fn leg(length: f64, from: f64, to: f64) -> f64 {
    let (v, a) = (1.5, 0.5);
    length / v + ((v - from).powi(2) + (v - to).powi(2)) / (2.0 * a * v)
}

/// One vehicle alone on the routes of the scene: 3 m to the loading place, 13 m to its branch, 6 m and 4 m at 0.5 m/s to the
/// junction, 38 m to the beginning; 5 s at each of both places.
#[test]
fn a_vehicle_on_routes_takes_the_time_of_its_closed_form() {
    let lap = 2.0 * (3.0_f64 / 0.5).sqrt()
        + 5.0
        + leg(13.0, 0.0, 0.0)
        + 5.0
        + leg(6.0, 0.0, 0.5)
        + 4.0 / 0.5
        + leg(38.0, 0.5, 0.0);
    let mut texts = side_by_side("scenes/branches");
    let others = texts.layout.lines().filter(|line| !line.contains("\"v2\"")).collect::<Vec<_>>().join("\n");
    texts.layout = others.replace("}},\n  ],", "}}\n  ],");
    texts.scenario = Some(r#"{"time_limit_s": 700}"#.into());
    let (mut arrivals, mut stood) = (Vec::new(), true);
    let project = texts.compile().project.expect("a line without errors");
    let north = project.plant.machines[0].track().expect("a vehicle").goals()[5];
    let mut observer = |seen: &Seen| {
        let is_there = seen.plant.position(0).is_some_and(|at| (at - north).length() < 1e-6);
        if is_there && !stood {
            arrivals.push(seen.scan as f64 / 100.0);
        }
        stood = is_there;
    };
    run(texts, &mut observer);
    let laps: Vec<f64> = arrivals.windows(2).map(|pair| pair[1] - pair[0]).collect();
    assert!(laps.len() >= 8, "{laps:?}");
    for found in laps {
        // Each of eight waits is up to two scans of 10 ms long.
        assert!((lap - 0.01..=lap + 0.16).contains(&found), "{found} s, {lap} s");
    }
}
