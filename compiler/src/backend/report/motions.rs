//! How machines moved, for the drawing: what comes again is written once.

use super::numbers::{List, list};
use runtime_sim::history::{Course, History};
use runtime_sim::motion::Motion;
use runtime_sim::plant::trajectory::Trajectory;
use std::collections::HashMap;

/// What all machines did, and what that refers to; each a value of JSON.
pub struct Motions {
    /// Of each course of an arm first what the place on its path does: where it begins and how fast, then duration and
    /// acceleration of each phase. Then the places of the knots of its path, half of the length of each corner, and for
    /// each joint its values at the knots, all three by [`bends`]. Both of the former are 0 for a path of two knots, and a
    /// joint that stands is one number.
    pub courses: String,
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
    let mut courses = Known::default();
    let machines: Vec<String> =
        history.machines.iter().map(|course| machine(course, until_ms, &mut courses)).collect();
    Motions { courses: list(courses.all), machines: list(machines) }
}

fn machine(course: &Course, until_ms: f64, courses: &mut Known) -> String {
    let mut swings = List::default();
    let mut drives = List::default();
    for motion in course.motions.iter().take_while(|motion| motion.begin_ms as f64 <= until_ms) {
        let (from, begin_ms) = (motion.from, motion.begin_ms as f64);
        match &motion.trajectory {
            Trajectory::Swings(swing) => {
                let number = courses.number(self::course(swing));
                swings.put(begin_ms).put(swing.since() * 1000.0 - begin_ms).put_whole(number);
            }
            Trajectory::Drives { velocity, from_ms, until_ms } => {
                let velocity = [velocity.x, velocity.y, velocity.z];
                drives.put_all([begin_ms, from.x, from.y, from.z]).put_all(velocity);
                drives.put_all([*from_ms, *until_ms]);
            }
            // Where it is then, an arm knows by itself.
            Trajectory::Rests if course.joints.is_some() => {
                swings.put(begin_ms).put_whole(0).put_whole(-1);
            }
            Trajectory::Rests => {
                drives.put_all([begin_ms, from.x, from.y, from.z, 0.0, 0.0, 0.0, begin_ms, begin_ms]);
            }
        }
    }
    let mut start = List::default();
    start.put_all([course.position.x, course.position.y, course.position.z]);
    let mut joints = List::default();
    joints.put_all(course.joints.iter().flat_map(|joints| joints.iter().copied()));
    let strokes = course.strokes.iter().map(|track| {
        let mut changes = List::default();
        for (ms, stroke) in &track.changes {
            changes.put_whole(ms).put(stroke.out).put(stroke.rate);
        }
        format!("[{},{}]", track.part, changes.end())
    });
    let surfaces = course.surfaces.iter().map(|track| {
        let mut changes = List::default();
        for (ms, speed) in &track.changes {
            changes.put_whole(ms).put(*speed);
        }
        format!("[{},{}]", track.part, changes.end())
    });
    format!(
        "{{\"start\":{},\"joints\":{},\"swings\":{},\"drives\":{},\"strokes\":{},\"surfaces\":{}}}",
        start.end(),
        joints.end(),
        swings.end(),
        drives.end(),
        list(strokes),
        list(surfaces)
    )
}

/// Units of places on a path for one, and of a joint for a metre or a radian.
const OF_A_PLACE: f64 = 1e8;
const OF_A_JOINT: f64 = 1e7;

fn course(motion: &Motion) -> String {
    let (begin, phases) = motion.phases();
    let path = motion.path();
    let mut place = List::default();
    place.put_all(begin).put_all(phases.into_iter().flatten().map(|number| rounded(number, OF_A_PLACE)));
    let mut course = List::default();
    course.put_json(&place.end());
    if path.knots().len() == 2 {
        course.put_whole(0).put_whole(0);
    } else {
        course.put_json(&bends(path.places().iter().copied(), OF_A_PLACE));
        course.put_json(&bends(path.halves().iter().copied(), OF_A_PLACE));
    }
    for joint in 0..path.knots()[0].len() {
        let values = path.knots().iter().map(|knot| knot[joint]);
        match values.clone().all(|value| value == path.knots()[0][joint]) {
            true => course.put(path.knots()[0][joint]),
            false => course.put_json(&bends(values, OF_A_JOINT)),
        };
    }
    course.end()
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
