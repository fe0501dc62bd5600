//! Recording the paths of all items while a line runs.

use super::{Hanging, Law, OnItem, Path, Segment};
use crate::carrier::Carrier;
use crate::event::Event;
use crate::kinematics::arm::Arm;
use crate::line::Line;
use crate::part::track::Ride;
use crate::plant::Plant;
use crate::plant::conveyed::{Along, Carry, Conveyed};
use crate::plant::trajectory::Trajectory;
use crate::point::Point;

/// What is known of the paths so far. What continues ends never, until something changes it.
#[derive(Clone, Debug)]
pub struct Recorder {
    /// The arm of each machine that is one.
    arms: Vec<Option<Arm>>,
    /// How each machine moved when it was checked last.
    trajectories: Vec<Trajectory>,
    /// How each item went on then, if it was on a conveyor.
    conveyed: Vec<Option<Conveyed>>,
    /// The items that were.
    on_lanes: Vec<usize>,
    /// When they were checked.
    looked_ms: f64,
    /// Events that were checked.
    read: usize,
    paths: Vec<Path>,
}

impl Recorder {
    pub fn new(line: &Line) -> Self {
        let items: usize = line.scenario.supply.iter().map(|supply| supply.items.len()).sum();
        Self {
            arms: line.machines.iter().map(|machine| machine.arm()).collect(),
            trajectories: vec![Trajectory::Rests; line.machines.len()],
            conveyed: vec![None; items],
            on_lanes: Vec::new(),
            looked_ms: 0.0,
            read: 0,
            paths: vec![Path::default(); items],
        }
    }

    /// Takes note of what has changed, when the plant has obeyed the outputs of a scan and nothing has moved yet.
    pub(crate) fn look(&mut self, plant: &Plant) {
        let now_ms = plant.now_ms() as f64;
        let passed_s = (now_ms - std::mem::replace(&mut self.looked_ms, now_ms)) / 1000.0;
        let handed_over = self.take_events(plant);
        let mut changed = handed_over.clone();
        for (machine, last) in self.trajectories.iter_mut().enumerate() {
            let trajectory = plant.trajectory(machine).since(now_ms);
            if std::mem::replace(last, trajectory.clone()).since(now_ms) != trajectory {
                changed.extend(plant.items().borne_by(machine));
            }
        }
        changed = changed.into_iter().flat_map(|item| plant.items().with_loads(item)).collect();
        // Nothing comes onto a conveyor unless it is handed over.
        self.on_lanes.extend(handed_over.iter().flat_map(|item| plant.items().with_loads(*item)));
        self.on_lanes.sort_unstable();
        self.on_lanes.dedup();
        for &item in &self.on_lanes {
            let (conveyed, last) = (plant.conveyed(item), &mut self.conveyed[item]);
            let is_as_before = match (last.as_ref(), conveyed.as_ref()) {
                (Some(last), Some(conveyed)) => last.goes_on_as(conveyed, passed_s),
                (last, conveyed) => last.is_none() && conveyed.is_none(),
            };
            if !is_as_before {
                changed.push(item);
            }
            if let (false, Some(last), Some(conveyed)) = (is_as_before, last.as_ref(), conveyed)
                && let Some(stood_s) = last.stood_after(&conveyed, passed_s)
            {
                let carrier = plant.base_carrier(item);
                let begin_ms = to_nanosecond(now_ms + 1000.0 * (stood_s - passed_s));
                let path = &mut self.paths[item];
                path.cut(begin_ms);
                let law = Law::Rests(conveyed.point(0.0));
                path.push(Segment { begin_ms, end_ms: now_ms, carrier, law });
            }
            *last = conveyed;
        }
        self.on_lanes.retain(|&item| self.conveyed[item].is_some());
        for item in changed {
            self.follow(plant, item);
        }
    }

    /// The paths of all items, in the order of the line's supply, once the plant has come to its end.
    pub(crate) fn finish(mut self, plant: &Plant) -> Vec<Path> {
        self.take_events(plant);
        for path in &mut self.paths {
            path.cut(plant.now_ms() as f64);
        }
        self.paths
    }

    /// The items that were handed over since the last time, each with a segment without duration for it.
    fn take_events(&mut self, plant: &Plant) -> Vec<usize> {
        let now_ms = plant.now_ms() as f64;
        let log = plant.items().log();
        let mut passed = Vec::new();
        for event in log.since(self.read) {
            match *event {
                Event::Item { item, from, to, point, .. } => {
                    let carrier = to.item().map_or(to, |under| plant.base_carrier(under));
                    let path = &mut self.paths[item];
                    path.cut(now_ms);
                    // The place of an event is that of the item at the bottom.
                    let own = path.segments.last().filter(|_| from.item().is_some() && to.is_final());
                    let point = own.map_or(point, |last| last.place(last.end_ms));
                    path.segments.push(Segment {
                        begin_ms: now_ms,
                        end_ms: now_ms,
                        carrier,
                        law: Law::Rests(point),
                    });
                    if let Some(load) = path.loads.last_mut() {
                        load.end_ms = load.end_ms.min(now_ms);
                    }
                    if let Some(under) = to.item() {
                        let turn = plant.items().turn(item);
                        path.loads.push(OnItem { begin_ms: now_ms, end_ms: f64::INFINITY, under, turn });
                    }
                    passed.push(item);
                }
                Event::Kind { item, kind, .. } => self.paths[item].becomes.push((now_ms, kind)),
                Event::Order { .. } => {}
            }
        }
        self.read = log.count();
        passed
    }

    /// What an item does from now on, if nothing changes any more.
    fn follow(&mut self, plant: &Plant, item: usize) {
        let now_ms = plant.now_ms() as f64;
        let carrier = plant.base_carrier(item);
        let Some(place) = plant.place(item) else { return };
        let machine = carrier.machine();
        let trajectory = match self.conveyed[item] {
            Some(conveyed) => return self.convey(item, now_ms, carrier, conveyed),
            None => machine.map_or(Trajectory::Rests, |machine| self.trajectories[machine].clone()),
        };
        if let (Trajectory::Rides(ride), Some(vehicle)) = (&trajectory, plant.vehicle_under(item)) {
            let laws = on_ride(now_ms, vehicle.seen(place), ride);
            return self.put(item, now_ms, carrier, laws);
        }
        let arm = machine.and_then(|machine| self.arms[machine]);
        self.put(item, now_ms, carrier, laws(now_ms, place, carrier, trajectory, arm));
    }

    fn convey(&mut self, item: usize, now_ms: f64, carrier: Carrier, conveyed: Conveyed) {
        let laws = conveyed.pieces().into_iter().map(|(begin_s, end_s, goes)| {
            let law = match (goes.along(), goes.carry()) {
                _ if !goes.moves() => Law::Rests(goes.point(0.0)),
                (Along::Straight(velocity), None) => slides(goes.point(0.0), velocity),
                (Along::Straight(velocity), Some(Carry::Slides(carried))) => {
                    slides(goes.point(0.0), velocity + carried)
                }
                _ => Law::Conveyed(goes),
            };
            (now_ms + 1000.0 * begin_s, now_ms + 1000.0 * end_s, law)
        });
        self.put(item, now_ms, carrier, laws.collect());
    }

    /// Begin, end and law of each segment from now on.
    fn put(&mut self, item: usize, now_ms: f64, carrier: Carrier, laws: Vec<(f64, f64, Law)>) {
        let path = &mut self.paths[item];
        path.cut(now_ms);
        if path.segments.last().is_some_and(|last| last.begin_ms == now_ms && last.carrier == carrier) {
            path.segments.pop();
        }
        for (begin_ms, end_ms, law) in laws {
            if begin_ms < end_ms {
                path.push(Segment { begin_ms, end_ms, carrier, law });
            }
        }
    }
}

/// A time in ms without what is rounded in it, which depends on the scan before.
fn to_nanosecond(ms: f64) -> f64 {
    libm::round(ms * 1e6) / 1e6
}

fn slides(from: Point, velocity: Point) -> Law {
    Law::Slides { from, velocity, acceleration: Point::default() }
}

/// Begin, end and law of all that an item does from now on that is here on a vehicle, from the middle of that.
fn on_ride(now_ms: f64, here: Point, ride: &Ride) -> Vec<(f64, f64, Law)> {
    let mut laws = Vec::new();
    let mut rests = (now_ms, ride.frame(now_ms).point(here));
    for piece in ride.pieces().into_iter().filter(|piece| piece.end_ms > now_ms) {
        let begin_ms = piece.begin_ms.max(now_ms);
        let gone = (begin_ms - piece.begin_ms) / 1000.0;
        let law = Law::Slides {
            from: piece.from.point(here)
                + piece.velocity.scaled(gone)
                + piece.acceleration.scaled(gone * gone / 2.0),
            velocity: piece.velocity + piece.acceleration.scaled(gone),
            acceleration: piece.acceleration,
        };
        laws.push((begin_ms, piece.end_ms, law));
        rests = (piece.end_ms, ride.frame(piece.end_ms).point(here));
    }
    laws.push((rests.0, f64::INFINITY, Law::Rests(rests.1)));
    laws
}

/// Begin, end and law of all that an item does that is here now.
fn laws(
    now_ms: f64,
    place: Point,
    carrier: Carrier,
    trajectory: Trajectory,
    arm: Option<Arm>,
) -> Vec<(f64, f64, Law)> {
    match (trajectory, arm, carrier) {
        (Trajectory::Drives { velocity, from_ms, until_ms }, ..) => {
            let begin_ms = from_ms.max(now_ms);
            let offset = || velocity.scaled((until_ms - begin_ms) / 1000.0);
            let mut laws =
                vec![(now_ms, begin_ms, Law::Rests(place)), (begin_ms, until_ms, slides(place, velocity))];
            if until_ms.is_finite() {
                laws.push((until_ms, f64::INFINITY, Law::Rests(place + offset())));
            }
            laws
        }
        (Trajectory::Swings(motion), Some(arm), Carrier::Grip { hang, .. }) => {
            let rests_s = motion.rests_at();
            let hanging = Hanging { arm, motion, hang };
            let rest = Law::Rests(hanging.place(rests_s));
            let rests_ms = rests_s * 1000.0;
            vec![(now_ms, rests_ms, Law::Hangs(Box::new(hanging))), (rests_ms, f64::INFINITY, rest)]
        }
        _ => vec![(now_ms, f64::INFINITY, Law::Rests(place))],
    }
}
