//! The recorded paths against the plant.

mod common;

use common::*;
use runtime_sim::carrier::Carrier;
use runtime_sim::item;
use runtime_sim::kinematics::arm::Joints;
use runtime_sim::line::{During, IoDelay, Jam, Line, Pause, Refusal, Slip, Supply};
use runtime_sim::path::{Law, Path, table_csv};
use runtime_sim::plant::Plant;
use runtime_sim::point::Point;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, record, run};

/// Where the belt of these tests ends.
const SINK: Carrier = Carrier::Sink { machine: 0, part: 2 };

/// Where every item was at the start of every scan, by the plant: carrier and place.
type Places = Vec<Vec<(Carrier, Option<Point>)>>;

fn places(plant: &Plant) -> Vec<(Carrier, Option<Point>)> {
    plant.items().all().enumerate().map(|(i, item)| (item.carrier, plant.place(i))).collect()
}

fn recorded(line: &Line, steps: Vec<Step>) -> (Report, Vec<Path>, Places) {
    let mut all = Places::new();
    let mut observe = |seen: &Seen| all.push(places(seen.plant));
    let script = &mut Script::new(steps);
    let recorded = record(line, script, Stepping::EveryScan, &[], &mut observe).unwrap();
    (recorded.report, recorded.paths, all)
}

fn distance(a: Point, b: Point) -> f64 {
    let offset = a - b;
    offset.x.abs().max(offset.y.abs()).max(offset.z.abs())
}

/// Each path has no gap and is, at every scan, where the plant has the item. What hangs on a gripper and what
/// rests is there to the last bit, unless it came to rest after it was moved between two scans; what slides is
/// reckoned from where it began to slide, by the plant from where the belt or the vehicle began.
fn agree(line: &Line, steps: Vec<Step>) -> (Report, Vec<Path>) {
    let (report, paths, places) = recorded(line, steps.clone());
    assert_eq!(
        report,
        run(line, &mut Script::new(steps), Stepping::EveryScan, &mut |_: &Seen| {}).unwrap(),
        "recorded or not"
    );
    for (item, path) in paths.iter().enumerate() {
        for pair in path.segments.windows(2) {
            assert_eq!(pair[0].end_ms, pair[1].begin_ms, "{pair:?}");
            let at = pair[0].end_ms;
            if pair[0].carrier == pair[1].carrier {
                let jump = distance(pair[0].place(at), pair[1].place(at));
                assert!(jump < 1e-12, "{jump} between {pair:?}");
            }
        }
        for segment in &path.segments {
            assert!(segment.begin_ms <= segment.end_ms && segment.end_ms.is_finite(), "{segment:?}");
        }
        for (scan, places) in places.iter().enumerate() {
            let ms = scan as f64 * f64::from(line.scan_ms);
            let (carrier, place) = places[item];
            let here: Vec<_> = path.at(ms).filter(|segment| segment.carrier == carrier).collect();
            let Some(place) = place else {
                assert!(here.is_empty() || carrier.is_final(), "item {item} at {ms} ms: {here:?}");
                continue;
            };
            assert!(!here.is_empty(), "item {item} at {ms} ms is on {carrier:?}: {path:?}");
            for segment in here {
                let off = distance(segment.place(ms), place);
                let most = if matches!(segment.law, Law::Hangs(_)) { 0.0 } else { 1e-12 };
                assert!(off <= most, "item {item} at {ms} ms: {off} m off, {segment:?}");
            }
        }
        let last = path.segments.last();
        assert!(
            last.is_none_or(|last| { last.carrier.is_final() || last.end_ms == report.simulated_s * 1000.0 })
        );
    }
    (report, paths)
}

#[test]
fn an_order_is_followed_from_the_belt_to_the_briefcase() {
    let (report, paths) = agree(&line(), whole_order());
    assert!(report.finished, "{}", report.reason);
    for path in &paths {
        let carriers: Vec<&str> = path.segments.iter().map(|segment| carrier_name(segment.carrier)).collect();
        let mut offset = carriers.clone();
        offset.dedup();
        assert_eq!(
            offset,
            ["belt", "gripper of kitting", "tray of agv", "gripper of gantry", "briefcase of as1", "order 1"]
        );
        assert!(carriers.len() < 25, "{}: {carriers:?}", carriers.len());
    }
}

#[test]
fn paths_follow_pauses_and_late_answers() {
    for delay in [IoDelay::Fixed(0), IoDelay::Fixed(5), IoDelay::Random { max: 5, seed: 3 }] {
        let mut line = line();
        line.io_delay = delay;
        line.scenario.pauses = (1..30).map(|i| Pause { at_scan: i * 113, scans: 37 }).collect();
        let (report, paths) = agree(&line, whole_order());
        assert!(report.finished, "{}", report.reason);
        let most = paths.iter().map(|path| path.segments.len()).max();
        assert!(most.is_some_and(|most| (30..150).contains(&most)), "{most:?}");
    }
}

/// The belt, the arms and the vehicle jam in turn, also while they are held.
#[test]
fn paths_follow_jams() {
    let mut line = line();
    let part = |machine: usize, primitive: &str| {
        line.machines[machine].parts.iter().position(|part| part.schema().name == primitive).unwrap()
    };
    let parts =
        [(BELT, "lane"), (KITTING, "chain"), (AGV, "route"), (GANTRY, "chain")].map(|(m, p)| (m, part(m, p)));
    let jam = |i: u64| {
        let (machine, part) = parts[i as usize % parts.len()];
        Jam { machine, part, during: During { at_scan: i * 41, scans: Some(59) } }
    };
    let usual = agree(&line, whole_order()).0;
    line.scenario.jams = (1..120).map(jam).collect();
    let (report, paths) = agree(&line, whole_order());
    assert!(report.finished, "{}", report.reason);
    assert!(report.scans > usual.scans + 59, "{} {}", report.scans, usual.scans);
    let most = paths.iter().map(|path| path.segments.len()).max();
    assert!(most.is_some_and(|most| (30..300).contains(&most)), "{most:?}");
    line.scenario.pauses = (1..30).map(|i| Pause { at_scan: i * 113, scans: 37 }).collect();
    assert!(agree(&line, whole_order()).0.finished);
}

/// Vehicles start and stop between scans, and parts appear there.
#[test]
fn scans_of_seven_milliseconds() {
    let mut line = line();
    line.scan_ms = 7;
    line.scenario.spawn_every_s = 1.999;
    line.scenario.pauses = (1..30).map(|i| Pause { at_scan: i * 171, scans: 37 }).collect();
    assert!(agree(&line, whole_order()).0.finished);
}

#[test]
fn what_slips_lies_on_the_floor() {
    let mut line = line();
    line.scenario.slips = vec![Slip { machine: GANTRY, pick: 2, after_s: 2.003 }];
    line.scenario.stall_limit_s = 5.0;
    let (_, paths) = agree(&line, whole_order());
    let [.., hangs, lies] = paths[1].segments.as_slice() else { panic!("{paths:?}") };
    assert!(matches!(hangs.law, Law::Hangs(_)) && matches!(lies.carrier, Carrier::Floor { .. }));
    let (above, below) = (hangs.place(hangs.end_ms), lies.place(lies.begin_ms));
    assert_eq!((above.x, above.y, 0.0), (below.x, below.y, below.z));
    assert!(above.z > 0.5);
}

#[test]
fn a_belt_brings_its_parts_to_the_end() {
    let mut line = line();
    line.scenario.supply = vec![Supply { belt: BELT, items: vec![BATTERY; 30] }];
    line.scenario.time_limit_s = 60.0;
    let mut steps = Vec::new();
    for _ in 0..40 {
        let belt = |verb| [Step::Command(BELT, verb, None), Step::Done(BELT)];
        steps.extend(belt(DRIVE).into_iter().chain(belt(HALT)));
        steps.extend([Step::Write(KITTING, output::GRIP, 0.0), Step::Write(KITTING, output::GRIP, 0.0)]);
    }
    steps.push(Step::Command(BELT, DRIVE, None));
    let (_, paths) = agree(&line, steps);
    let last = |path: &Path| path.segments.last().map(|segment| segment.carrier);
    assert_eq!(last(&paths[0]), Some(SINK));
    assert!(paths.last().is_some_and(|path| path.segments.is_empty() || last(path) != Some(SINK)));
}

/// Commands that come while others are under offset, refused ones, and a part that is let go in between: it falls
/// on the belt that moves.
#[test]
fn paths_follow_what_goes_wrong() {
    let mut line = line();
    line.scenario.refusals = vec![Refusal { machine: KITTING, command: 6 }];
    line.scenario.stall_limit_s = 60.0;
    line.scenario.pauses = vec![Pause { at_scan: 2650, scans: 20 }];
    let mut steps = load(BATTERY, Point::default());
    steps.truncate(9);
    let wait = |n: usize| std::iter::repeat_n(Step::Write(STATION, output::COMPLETE, 0.0), n);
    let goal = |x: f64, y: f64, z: f64| Some(Point::new(x, y, z));
    // The part hangs on the gripper, over the belt.
    steps.push(Step::Command(BELT, DRIVE, None));
    for i in 0..6 {
        let y = 0.4 * f64::from(i % 3) - 0.4;
        steps.push(Step::Command(KITTING, MOVE, goal(-0.573076, y, 1.3)));
        steps.extend(wait(40));
    }
    steps.push(Step::Command(KITTING, 9.0, goal(-0.6, 0.0, 1.3)));
    steps.extend(wait(10));
    steps.push(Step::Command(KITTING, MOVE, goal(-0.573076, 1.0, 1.3)));
    steps.extend(wait(60));
    steps.push(Step::Write(KITTING, output::GRIP, 0.0));
    let (_, paths) = agree(&line, steps);
    let carriers: Vec<Carrier> = paths[0].segments.iter().map(|segment| segment.carrier).collect();
    let drop =
        carriers.windows(2).position(|pair| matches!(pair, [Carrier::Grip { .. }, Carrier::Lane { .. }]));
    let drop = drop.unwrap_or_else(|| panic!("{carriers:?}"));
    assert!(matches!(paths[0].segments[drop + 1].law, Law::Slides { .. }));
    let hung = paths[0].segments.iter().filter(|segment| matches!(segment.law, Law::Hangs(_))).count();
    assert!(hung > 6, "{hung}");
    assert_eq!(carriers.last(), Some(&SINK));
}

/// Picks the battery and takes it past corners, held now and then, to where it is let go.
fn around_corners() -> (Line, Vec<Step>) {
    let mut line = line();
    line.scenario.pauses = (1..40).map(|i| Pause { at_scan: 2500 + i * 131, scans: 37 }).collect();
    line.scenario.stall_limit_s = 5.0;
    let mut steps = load(BATTERY, Point::default());
    steps.truncate(9);
    for (via, goal) in [([-0.6, 1.0, 1.4], [-2.2, 1.4, 1.2]), ([-2.2, 0.0, 1.3], [-0.7, -0.4, 1.5])] {
        for (i, value) in via.into_iter().enumerate() {
            steps.push(Step::Write(KITTING, output::VIA + i, value));
        }
        steps.push(Step::Command(KITTING, THROUGH, Some(Point::new(goal[0], goal[1], goal[2]))));
        steps.push(Step::Done(KITTING));
    }
    steps.push(Step::Write(KITTING, output::GRIP, 0.0));
    (line, steps)
}

#[test]
fn paths_follow_corners() {
    let (line, steps) = around_corners();
    let (_, paths) = agree(&line, steps);
    let hung = paths[0].segments.iter().filter(|segment| matches!(segment.law, Law::Hangs(_))).count();
    assert!(hung > 10, "{hung}");
    assert!(paths[0].segments.last().is_some_and(|last| matches!(last.carrier, Carrier::Lane { .. })));
}

/// A row of a table: item, time, place, carrier.
fn rows(table: &str) -> Vec<(String, f64, Point, String)> {
    let row = |line: &str| {
        let words: Vec<&str> = line.split(',').collect();
        let [item, _, numbers @ .., carrier] = words.as_slice() else { panic!("{line}") };
        let numbers: Vec<f64> = numbers.iter().map(|word| word.parse().unwrap()).collect();
        (item.to_string(), numbers[0], Point::new(numbers[1], numbers[2], numbers[3]), carrier.to_string())
    };
    table.lines().skip(1).map(row).collect()
}

fn carrier_name(carrier: Carrier) -> &'static str {
    match carrier {
        Carrier::Lane { .. } => "belt",
        Carrier::Grip { machine: KITTING, .. } => "gripper of kitting",
        Carrier::Grip { .. } => "gripper of gantry",
        Carrier::Place { machine: AGV, .. } => "tray of agv",
        Carrier::Place { .. } => "briefcase of as1",
        Carrier::Shipped { .. } => "order 1",
        _ => "elsewhere",
    }
}

#[test]
fn the_table_has_every_interval_and_every_corner() {
    let line = line();
    let (_, paths, _) = recorded(&line, whole_order());
    let table = table_csv(&line, &paths, &[1, 0], 100);
    assert!(table.starts_with("item,kind,t,x,y,z,carrier\npump_1,pump,"), "{table}");
    let rows = rows(&table);
    for (item, path) in [(1, &paths[1]), (0, &paths[0])] {
        let name = item::Names::new(&line).name(item);
        let own: Vec<_> = rows.iter().filter(|row| row.0 == *name).collect();
        assert!(own.windows(2).all(|pair| pair[0].1 <= pair[1].1 && pair[0] != pair[1]));
        for row in &own {
            let around = [-1e-3, 0.0, 1e-3].map(|off| row.1 * 1000.0 + off);
            let here = around.into_iter().flat_map(|ms| path.at(ms).map(move |segment| (segment, ms)));
            let off = here.map(|(s, ms)| distance(s.place(ms.clamp(s.begin_ms, s.end_ms)), row.2));
            // Half a millionth of a metre, and of a second at the speed of the fastest.
            assert!(off.fold(1.0, f64::min) < 3e-6, "{row:?}");
        }
        let has = |ms: f64| own.iter().any(|row| (row.1 * 1000.0 - ms).abs() < 1e-3);
        let segments = &path.segments;
        for segment in segments {
            for ms in [segment.begin_ms, segment.end_ms] {
                let carrier = carrier_name(segment.carrier);
                let is_here = |row: &&(String, f64, Point, String)| {
                    (row.1 * 1000.0 - ms).abs() < 1e-3
                        && row.3 == carrier
                        && distance(row.2, segment.place(ms)) < 1e-6
                };
                assert!(own.iter().any(is_here), "{segment:?} at {ms}");
            }
        }
        let (begin, end) = (segments[0].begin_ms, segments[segments.len() - 1].end_ms);
        let ticks = (begin / 100.0).ceil() as u64..(end / 100.0) as u64;
        assert!(ticks.clone().count() > 100 && ticks.clone().all(|n| has(n as f64 * 100.0)));
    }
    let coarse = table_csv(&line, &paths, &[0], 1_000_000_000);
    assert!((8..60).contains(&coarse.lines().count()), "{coarse}");
    assert_eq!(table_csv(&line, &paths, &[], 100).lines().count(), 1);
}

/// Joints and hang are enough to know where a part was: the same place comes out with the robot's kinematics.
#[test]
fn a_hanging_part_can_be_computed_from_polynomials() {
    let mut orders = line();
    orders.scenario.pauses = (1..30).map(|i| Pause { at_scan: i * 171, scans: 37 }).collect();
    let (mut hanging, mut bent) = (0, 0);
    for (line, steps) in [(orders, whole_order()), around_corners()] {
        let (_, paths, _) = recorded(&line, steps);
        for segment in paths.iter().flat_map(|path| &path.segments) {
            let Law::Hangs(hangs) = &segment.law else { continue };
            hanging += 1;
            let pieces = hangs.motion.pieces();
            assert!(pieces.windows(2).all(|pair| pair[0].end_s == pair[1].begin_s));
            for share in (0..=40).map(|i| f64::from(i) / 40.0) {
                let ms = segment.begin_ms + share * (segment.end_ms - segment.begin_ms);
                let s = ms / 1000.0;
                let piece = pieces.iter().find(|piece| piece.begin_s - 1e-9 <= s && s <= piece.end_s + 1e-9);
                let piece = piece.unwrap_or_else(|| panic!("{s} in {pieces:?}"));
                bent += usize::from(piece.joints.iter().any(|powers| powers.len() > 3));
                let power = |c: &Vec<f64>| c.iter().rev().fold(0.0, |sum, c| sum * (s - piece.begin_s) + c);
                let joints: Vec<f64> = piece.joints.iter().map(power).collect();
                let tool = hangs.arm.tool_pose(&Joints::new(&joints));
                let off = distance(tool.point(hangs.hang), segment.place(ms));
                assert!(off < 1e-12, "{off}: {segment:?} at {ms}");
            }
        }
    }
    assert!(hanging > 20 && bent > 10, "{hanging} {bent}");
}
