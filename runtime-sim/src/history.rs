//! What went on in a run: the states of all machines, how they moved, and the words of their controllers, as changes.

pub mod times;

use crate::account::Counted;
use crate::event::Event;
use crate::io_trace::Source;
use crate::kinematics::arm::Joints;
use crate::line::Line;
use crate::part::Primitive;
use crate::plant::Plant;
use crate::plant::trajectory::Trajectory;
use crate::point::Point;
use crate::run::Seen;
use times::Times;

/// Changes of words that are kept at most.
const MOST_CHANGES: usize = 4_000_000;

#[derive(Clone, Debug, Default)]
pub struct History {
    /// In the order of the line's machines.
    pub machines: Vec<MachineHistory>,
    /// In the order in which they were asked for.
    pub words: Vec<Word>,
    /// The scan from which on words are not kept, as there were too many changes.
    pub words_until: Option<u64>,
    /// What became of items and orders.
    pub events: Vec<Event>,
    changes: usize,
    /// Numbers of the words that are inputs and outputs of the line.
    of_line: Vec<usize>,
    /// Of each word, whether it changes while something moves.
    analogue: Vec<bool>,
    /// The last scan in which something has happened.
    happened: u64,
    scan_ms: u64,
}

/// What one machine did.
#[derive(Clone, Debug, Default)]
pub struct MachineHistory {
    /// Each holds from its scan on until the next one does.
    pub stays: Vec<Stay>,
    pub times: Times,
    /// Of a vehicle: where it is at the start. Of all else: its pose.
    pub position: Point,
    /// Of a vehicle on a track, at the start: degrees.
    pub heading: Option<f64>,
    /// Of an arm, at the start.
    pub joints: Option<Joints>,
    /// Each continues until the next one begins, or until it comes to rest.
    pub motions: Vec<Motion>,
    pub strokes: Vec<Track<Stroke>>,
    /// Speeds of the surfaces of conveyors, m/s.
    pub surfaces: Vec<Track<f64>>,
}

/// What a machine is counted as in a state.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Stay {
    /// From its start on.
    pub scan: u64,
    pub state: usize,
    pub counted: Counted,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    pub begin_ms: u64,
    /// Of a vehicle, at that time.
    pub from: Point,
    pub trajectory: Trajectory,
}

/// Changes of a part of a machine.
#[derive(Clone, Debug)]
pub struct Track<T> {
    pub part: usize,
    /// Times in ms, and what holds from then on.
    pub changes: Vec<(u64, T)>,
}

/// A cylinder or a positioner as it continues, 0 (in) to 1 (out).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stroke {
    pub out: f64,
    /// 1/s.
    pub rate: f64,
    /// Where it stops.
    pub until: f64,
}

/// A word of a controller.
#[derive(Clone, Debug)]
pub struct Word {
    pub source: Source,
    /// Scans, and what holds from then on. What changes while something moves has its last value once more before it
    /// begins to change.
    pub changes: Vec<(u64, f64)>,
}

impl History {
    pub fn new(line: &Line, watched: &[Source]) -> Self {
        let begun = |machine: &crate::machine::Machine| {
            let numbers = |wanted: fn(&Primitive) -> bool| {
                let parts = machine.parts.iter().enumerate();
                parts.filter(move |(_, part)| wanted(&part.primitive)).map(|(number, _)| number)
            };
            let carriages = numbers(|part| matches!(part, Primitive::Cylinder(_) | Primitive::Positioner(_)));
            let lanes = numbers(|part| matches!(part, Primitive::Lane(_)));
            MachineHistory {
                strokes: carriages.map(|part| Track { part, changes: Vec::new() }).collect(),
                surfaces: lanes.map(|part| Track { part, changes: Vec::new() }).collect(),
                ..MachineHistory::default()
            }
        };
        let is_of_line = |source: &Source| {
            !matches!(source, Source::Input { .. } | Source::Output { .. } | Source::Trace(_))
        };
        let kinds = line.kinds.len();
        let analogue: Vec<_> = line.machines.iter().map(|machine| machine.analogue_inputs(kinds)).collect();
        let is_analogue = |source: &Source| match *source {
            Source::Input { machine, word } => analogue[machine].get(word) == Some(&true),
            _ => false,
        };
        Self {
            analogue: watched.iter().map(is_analogue).collect(),
            machines: line.machines.iter().map(begun).collect(),
            words: watched.iter().map(|source| Word { source: *source, changes: Vec::new() }).collect(),
            of_line: (0..watched.len()).filter(|number| is_of_line(&watched[*number])).collect(),
            scan_ms: u64::from(line.scan_ms),
            ..Self::default()
        }
    }

    /// What the line has in a scan: it changes without the controllers too, such as the permit while they have no power.
    pub(crate) fn line_words(&mut self, seen: &Seen) {
        for number in &self.of_line {
            self.words[*number].look(seen);
        }
    }

    /// A scan in which something has happened.
    pub(crate) fn words(&mut self, seen: &Seen) {
        if self.words_until.is_some() {
            return;
        }
        for (word, is_analogue) in self.words.iter_mut().zip(&self.analogue) {
            let has_changed = word.look(seen);
            self.changes += usize::from(has_changed);
            if has_changed && *is_analogue {
                self.changes += usize::from(word.rested_until(self.happened));
            }
        }
        self.happened = seen.scan;
        if self.changes > MOST_CHANGES {
            self.words_until = Some(seen.scan + 1);
        }
    }

    /// The plant has obeyed the outputs of a scan, and nothing has moved yet.
    pub(crate) fn look(&mut self, plant: &Plant) {
        self.take_events(plant);
        let now_ms = plant.now_ms();
        for (machine, history) in self.machines.iter_mut().enumerate() {
            history.look(machine, plant, now_ms);
        }
    }

    /// From the start of a scan on.
    pub(crate) fn stay(&mut self, machine: usize, stay: Stay) {
        let stays = &mut self.machines[machine].stays;
        let is_new = |last: &Stay| (last.state, last.counted) != (stay.state, stay.counted);
        if stays.last().is_none_or(is_new) {
            stays.push(stay);
        }
    }

    /// The controllers have stepped a machine: its state, and the time in it.
    pub(crate) fn time(&mut self, machine: usize, stay: Stay, ms: u64) {
        if self.words_until.is_none() {
            let is_new = self.machines[machine].times.note(stay, ms, self.scan_ms);
            self.changes += usize::from(is_new);
        }
    }

    pub(crate) fn finish(mut self, plant: &Plant) -> Self {
        self.take_events(plant);
        self
    }

    fn take_events(&mut self, plant: &Plant) {
        self.events.extend(plant.items().log().since(self.events.len()));
    }
}

impl Word {
    /// Whether it has changed.
    fn look(&mut self, seen: &Seen) -> bool {
        let value = self.source.value(seen);
        let has_changed = self.changes.last().is_none_or(|(_, last)| last.to_bits() != value.to_bits());
        if has_changed {
            self.changes.push((seen.scan, value));
        }
        has_changed
    }

    /// Before its last change it had the same value up to this scan: what is joined by a line rests until then. Whether
    /// that had to be noted.
    fn rested_until(&mut self, scan: u64) -> bool {
        let Some(before) = self.changes.len().checked_sub(2).map(|number| self.changes[number]) else {
            return false;
        };
        let is_later = before.0 < scan;
        if is_later {
            self.changes.insert(self.changes.len() - 1, (scan, before.1));
        }
        is_later
    }

    /// What it is at the end of a scan; none before it is known.
    pub fn at(&self, scan: u64) -> Option<f64> {
        let number = self.changes.partition_point(|(since, _)| *since <= scan);
        number.checked_sub(1).map(|number| self.changes[number].1)
    }
}

impl MachineHistory {
    /// Scans of transitions to the same state.
    pub fn entered_again(&self) -> impl Iterator<Item = u64> {
        let is_stopped = |scan: u64| {
            let number = self.stays.partition_point(|stay| stay.scan <= scan).checked_sub(1);
            number.is_none_or(|number| self.stays[number].counted == Counted::Stopped)
        };
        let set = self.times.set.iter().filter(|(_, ms)| *ms == 0).map(|(scan, _)| *scan);
        set.filter(move |scan| !is_stopped(*scan))
    }

    fn look(&mut self, machine: usize, plant: &Plant, now_ms: u64) {
        if now_ms == 0 {
            self.position = plant.position(machine).unwrap_or_default();
            self.heading = plant.vehicle(machine).map(|vehicle| vehicle.yaw);
            self.joints = plant.joints(machine);
        }
        let trajectory = plant.trajectory(machine).since(now_ms as f64);
        let goes_on = match self.motions.last() {
            None => trajectory == Trajectory::Rests,
            Some(last) => {
                last.trajectory == trajectory || trajectory == Trajectory::Rests && last.is_over(now_ms)
            }
        };
        if !goes_on {
            let from = plant.position(machine).unwrap_or_default();
            self.motions.push(Motion { begin_ms: now_ms, from, trajectory });
        }
        for track in &mut self.strokes {
            let Some([out, rate, until]) = plant.carriage_going(machine, track.part) else { continue };
            let stroke = Stroke { out, rate, until };
            track.note(now_ms, stroke, |last| (last.rate, last.until) != (rate, until));
        }
        for track in &mut self.surfaces {
            let Some(speed) = plant.surface_speed(machine, track.part) else { continue };
            track.note(now_ms, speed, |last| *last != speed);
        }
    }
}

impl Motion {
    fn is_over(&self, ms: u64) -> bool {
        self.trajectory == Trajectory::Rests || self.trajectory.clone().since(ms as f64) == Trajectory::Rests
    }
}

impl<T> Track<T> {
    fn note(&mut self, now_ms: u64, value: T, differs: impl Fn(&T) -> bool) {
        if self.changes.last().is_none_or(|(_, last)| differs(last)) {
            self.changes.push((now_ms, value));
        }
    }
}
