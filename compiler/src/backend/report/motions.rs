//! How machines moved, for the drawing: what comes again is written once.

use super::numbers::{List, list};
use runtime_sim::history::{History, MachineHistory};
use runtime_sim::motion::Motion;
use runtime_sim::plant::trajectory::Trajectory;
use runtime_sim::point::Point;
use std::collections::HashMap;

/// What all machines did, and what that refers to; each a value of JSON.
pub struct Motions {
    /// Of each trajectory of an arm first what the place on its path does: where it begins and how fast, then duration and
    /// acceleration of each phase. Then the places of the knots of its path, half of the length of each corner, and for
    /// each joint its values at the knots, all three by [`bends`]. Both of the former are 0 for a path of two knots, and a
    /// joint that stands is one number.
    pub trajectories: String,
    pub machines: String,
}

#[derive(Default)]
struct Known {
    numbers: HashMap<String, usize>,
    all: Vec<String>,
}

impl Known {
    fn number(&mut self, json: String) -> usize {
        let next = self.all.len();
        *self.numbers.entry(json).or_insert_with_key(|json| {
            self.all.push(json.clone());
            next
        })
    }
}

/// Those that begin by this time.
pub fn motions(history: &History, until_ms: f64) -> Motions {
    let mut trajectories = Known::default();
    let machines: Vec<String> =
        history.machines.iter().map(|history| machine(history, until_ms, &mut trajectories)).collect();
    Motions { trajectories: list(trajectories.all), machines: list(machines) }
}

fn machine(history: &MachineHistory, until_ms: f64, trajectories: &mut Known) -> String {
    let mut swings = List::default();
    let mut drives = List::default();
    let mut rides = List::default();
    let ends = history.motions.iter().skip(1).map(|next| next.begin_ms as f64).chain([f64::INFINITY]);
    let all = history.motions.iter().zip(ends);
    for (motion, end_ms) in all.take_while(|(motion, _)| motion.begin_ms as f64 <= until_ms) {
        let (from, begin_ms) = (motion.from, motion.begin_ms as f64);
        match &motion.trajectory {
            Trajectory::Rides(ride) => {
                for piece in ride.pieces().into_iter().filter(|piece| piece.begin_ms < end_ms) {
                    let Point { x, y, .. } = piece.from.position;
                    let (speed, gain) = (piece.velocity, piece.acceleration);
                    rides.put_all([piece.begin_ms, piece.end_ms.min(end_ms), x, y, piece.from.yaw]);
                    rides.put_all([speed.x, speed.y, gain.x, gain.y]);
                }
            }
            Trajectory::Swings(swing) => {
                let number = trajectories.number(trajectory(swing));
                swings.put(begin_ms).put(swing.since() * 1000.0 - begin_ms).put_whole(number);
            }
            Trajectory::Drives { velocity, from_ms, until_ms } => {
                let velocity = [velocity.x, velocity.y, velocity.z];
                drives.put_all([begin_ms, from.x, from.y, from.z]).put_all(velocity);
                drives.put_all([*from_ms, *until_ms]);
            }
            // Where it is then, an arm knows by itself.
            Trajectory::Rests if history.joints.is_some() => {
                swings.put(begin_ms).put_whole(0).put_whole(-1);
            }
            Trajectory::Rests if history.heading.is_some() => {}
            Trajectory::Rests => {
                drives.put_all([begin_ms, from.x, from.y, from.z, 0.0, 0.0, 0.0, begin_ms, begin_ms]);
            }
        }
    }
    let mut start = List::default();
    start.put_all([history.position.x, history.position.y, history.position.z]).put_all(history.heading);
    let mut joints = List::default();
    joints.put_all(history.joints.iter().flat_map(|joints| joints.iter().copied()));
    let strokes = history.strokes.iter().map(|track| {
        let mut changes = List::default();
        for (ms, stroke) in &track.changes {
            changes.put_whole(ms).put(stroke.out).put(stroke.rate).put(stroke.until);
        }
        format!("[{},{}]", track.part, changes.end())
    });
    let surfaces = history.surfaces.iter().map(|track| {
        let mut changes = List::default();
        for (ms, speed) in &track.changes {
            changes.put_whole(ms).put(*speed);
        }
        format!("[{},{}]", track.part, changes.end())
    });
    format!(
        "{{\"start\":{},\"joints\":{},\"swings\":{},\"drives\":{},\"rides\":{},\"strokes\":{},\"surfaces\":{}}}",
        start.end(),
        joints.end(),
        swings.end(),
        drives.end(),
        rides.end(),
        list(strokes),
        list(surfaces)
    )
}

/// Units of places on a path for one, and of a joint for a metre or a radian.
const OF_A_PLACE: f64 = 1e8;
const OF_A_JOINT: f64 = 1e7;

fn trajectory(motion: &Motion) -> String {
    let (begin, phases) = motion.phases();
    let path = motion.path();
    let mut place = List::default();
    place.put_all(begin).put_all(phases.into_iter().flatten().map(|number| rounded(number, OF_A_PLACE)));
    let mut trajectory = List::default();
    trajectory.put_json(&place.end());
    if path.knots().len() == 2 {
        trajectory.put_whole(0).put_whole(0);
    } else {
        trajectory.put_json(&bends(path.places().iter().copied(), OF_A_PLACE));
        trajectory.put_json(&bends(path.halves().iter().copied(), OF_A_PLACE));
    }
    for joint in 0..path.knots()[0].len() {
        let values = path.knots().iter().map(|knot| knot[joint]);
        match values.clone().all(|value| value == path.knots()[0][joint]) {
            true => trajectory.put(path.knots()[0][joint]),
            false => trajectory.put_json(&bends(values, OF_A_JOINT)),
        };
    }
    trajectory.end()
}

fn rounded(value: f64, unit: f64) -> f64 {
    (value * unit).round() / unit
}

/// Whole units: the first number, and of each further one by how much its distance from the last differs from the distance
/// before. Along an even line that is little.
fn bends(values: impl Iterator<Item = f64>, unit: f64) -> String {
    let mut list = List::default();
    let (mut last, mut step) = (0, 0);
    for value in values {
        let value = (value * unit).round() as i64;
        list.put_whole(value - last - step);
        step = value - last;
        last = value;
    }
    list.end()
}
