//! Runs that are the same however they are stepped.

use crate::Texts;
use autogen::executor::Executor;
use runtime_sim::plant::Plant;
use runtime_sim::point::Point;
use runtime_sim::report::Report;
use runtime_sim::run::{Seen, Stepping, run};
use std::f64::consts::{PI, TAU};

/// The observer sees every scan of the first one.
pub fn report(texts: &Texts, mut observer: impl FnMut(&Seen)) -> Report {
    let project = texts.project();
    let execute = |stepping, see: &mut dyn FnMut(&Seen)| {
        run(&project.plant, &mut Executor::new(&project.system), stepping, see)
            .expect("a line that can be run")
    };
    let mut places = Vec::new();
    let every = execute(Stepping::EveryScan, &mut |seen| {
        observer(seen);
        places.push((seen.scan, placed(seen.plant)));
    });
    for stepping in [Stepping::Events, Stepping::Checked] {
        let mut all = places.iter();
        let other = execute(stepping, &mut |seen| {
            let (_, there) = all.find(|(scan, _)| *scan == seen.scan).expect("a scan among all");
            for (item, (one, other)) in there.iter().zip(placed(seen.plant)).enumerate() {
                assert!(
                    is_same(*one, other),
                    "{stepping:?}, scan {}, item {item}: {other:?}, not {one:?}",
                    seen.scan
                );
            }
        });
        assert_eq!(other, every, "{stepping:?}");
    }
    every
}

/// Where an item is and how it is turned, rad; none if it is not on the line.
type Placed = Option<(Point, f64)>;

/// Of each item.
fn placed(plant: &Plant) -> Vec<Placed> {
    (0..plant.items().count()).map(|item| Some((plant.place(item)?, plant.turn(item)))).collect()
}

fn is_same(one: Placed, other: Placed) -> bool {
    let (Some((point, turn)), Some((there, turned))) = (one, other) else {
        return one.is_none() == other.is_none();
    };
    let off = (turn - turned + PI).rem_euclid(TAU) - PI;
    (point - there).length() < 1e-6 && off.abs() < 1e-6
}
