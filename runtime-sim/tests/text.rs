//! The text form of a line.

mod common;

use common::*;
use runtime_sim::line::{
    Answer, During, IoDelay, Jam, Line, Obstacle, Pause, Refusal, Slip, SlowCycle, Stuck,
};
use runtime_sim::point::Point;

fn rich_line() -> Line {
    let mut line = line();
    line.machines[BELT].states = states(vec![1, 3]);
    line.machines[BIN] = machines::machine("bin", &machines::bin(Point::new(-0.0, 0.1 + 0.2, 1.0 / 3.0)));
    let obstacle = |name: &str, size| Obstacle { name: name.into(), pose: Point::new(0.1, -0.0, 2.5), size };
    line.obstacles = vec![obstacle("post", Some(Point::new(0.2, 1.0 / 3.0, 1e-3))), obstacle("mark", None)];
    line.scenario.slips = vec![Slip { machine: GANTRY, pick: 2, after_s: 5e-324 }];
    line.scenario.refusals = vec![Refusal { machine: AGV, command: 3 }];
    line.scenario.answers = vec![Answer { machine: AGV, command: 4, late_s: 0.5, error: Some(1) }];
    line.scenario.pauses = vec![Pause { at_scan: 17, scans: u64::MAX }];
    let during = |scans| During { at_scan: 23, scans };
    let stuck = |value, scans| Stuck { machine: KITTING, word: 0, words: 1, value, during: during(scans) };
    line.scenario.sensors = vec![stuck(1.0, Some(u64::MAX)), stuck(-0.0, None)];
    let lane = line.machines[BELT].parts.iter().position(|part| part.schema().name == "lane");
    let jam = |scans| Jam { machine: BELT, part: lane.unwrap(), during: during(scans) };
    line.scenario.jams = vec![jam(None), jam(Some(7))];
    line.io_delay = IoDelay::Random { max: 5, seed: u64::MAX };
    line
}

#[test]
fn it_reads_back_to_the_same_bits() {
    for line in [line(), rich_line()] {
        let text = line.to_text();
        let again = Line::from_text(&text).unwrap();
        assert_eq!(again, line);
        // `==` takes 0.0 and -0.0 for the same; their texts differ.
        assert_eq!(again.to_text(), text);
    }
}

#[test]
fn no_text_makes_it_panic() {
    let text = rich_line().to_text();
    for end in 0..text.len() - 1 {
        assert!(Line::from_text(&text[..end]).is_err(), "{}", &text[..end]);
    }
    let words: Vec<&str> = text.split_whitespace().collect();
    for wrong in ["-1", "nan", "1e999", "18446744073709551615", "x"] {
        for i in 0..words.len() {
            let mut words = words.clone();
            words[i] = wrong;
            // A name may be anything; the rest is refused or makes a line that the plant can take.
            if let Ok(line) = Line::from_text(&words.join(" ")) {
                let _ = runtime_sim::plant::Plant::new(&line).map(|mut plant| {
                    let outputs = runtime_sim::plant::outputs(&line);
                    plant.advance(&outputs);
                });
            }
        }
    }
}

#[test]
fn what_cannot_be_run_is_refused() {
    let refused = |spoil: fn(&mut Line)| {
        let mut line = rich_line();
        spoil(&mut line);
        let checked = line.check().unwrap_err();
        assert_eq!(Line::from_text(&line.to_text()).unwrap_err(), checked);
        checked
    };
    assert_eq!(refused(|l| l.scan_ms = 0), "a scan of 0 ms is not between 1 and 1000 ms");
    assert_eq!(refused(|l| l.kinds[1].height = 0.0), "the height of pump is no positive number");
    assert_eq!(
        refused(|l| l.scenario.orders[0].stations = vec![1]),
        "an order at kitting, which has no terminal"
    );
    assert_eq!(refused(|l| l.scenario.orders[0].stations.clear()), "order 1 names no station");
    assert_eq!(refused(|l| l.scenario.orders[0].stations.push(STATION)), "order 1 names as1 twice");
    assert_eq!(
        refused(|l| l.scenario.spawn_first_s = -1.0),
        "spawn_first_s -1.0 is not between 0 and 32000000.0"
    );
    assert_eq!(
        refused(|l| l.scenario.supply[0].items[1] = 2),
        "the supply of belt names kind 2, which is not there"
    );
    assert_eq!(refused(|l| l.scenario.slips[0].machine = 9), "a slip names machine 9, which is not there");
    assert_eq!(refused(|l| l.scenario.jams[1].part += 1), "a jam of belt, in a part that does not move");
    assert_eq!(
        refused(|l| l.scenario.slow = vec![SlowCycle { machine: AGV, part: 0, cycle: 1, longer_s: 0.5 }]),
        "a slow cycle of agv, of a part that is no process"
    );
    assert_eq!(
        refused(|l| l.scenario.sensors[1].word = 1000),
        "a sensor of kitting that is not there sticks"
    );
    assert_eq!(
        refused(|l| l.scenario.sensors[0].words = usize::MAX),
        "a sensor of kitting that is not there sticks"
    );
    assert_eq!(
        refused(|l| l.machines[0].states[0].awaits[0] = 6),
        "a state names machine 6, which is not there"
    );
    assert_eq!(
        refused(|l| l.obstacles[0].size = Some(Point::new(0.1, 0.0, 0.1))),
        "a length of the box of post is no positive number within 1000 km"
    );
    assert_eq!(refused(|l| l.obstacles[1].pose.z = 1e7), "a coordinate of mark is no number within 1000 km");
    assert_eq!(refused(|l| l.io_delay = IoDelay::Fixed(4_000_000_000)), "answers more than 1000 scans late");
}
