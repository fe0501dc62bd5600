//! What stands at the lanes of a machine, and whether it can be there.

use super::{Machine, Misfit, ROUNDED};
use crate::part::lane::{CentreLine, Lane};
use crate::part::process::Process;
use crate::part::source::Source;
use crate::part::stroke::Strokes;
use crate::part::{Part, Primitive};
use crate::point::Point;

/// What a pusher or a diverter brings over lies beside its lane: the middle lines are apart by half of both widths, and by
/// this much more for what frames them, m.
const FRAMES: f64 = 0.1;
/// The other lane may begin so far above, m: as far as lanes that are joined.
const STEP: f64 = 0.005;

/// A pusher or a diverter.
struct Branch {
    lane: usize,
    at: f64,
    onto: usize,
}

impl Machine {
    /// Where a lane lies: at each stop of its cylinder or positioner, by the number of the stop, if it is on one.
    pub fn centre_lines(&self, lane: &Lane) -> Vec<(Option<usize>, CentreLine)> {
        let Some(Strokes { stroke, stops, .. }) = lane.on.and_then(|part| self.parts[part].strokes()) else {
            return vec![(None, lane.centre_line)];
        };
        let moved =
            |out: f64| stroke.map_or(lane.centre_line, |stroke| lane.centre_line.moved(stroke.frame(out)));
        stops.iter().enumerate().map(|(stop, out)| (Some(stop), moved(*out))).collect()
    }

    /// Whether a lane is over the floor; whether what stands at a lane stands beside it, and beside the lane onto which it
    /// brings items.
    pub(super) fn check_on_lanes(&self, index: usize) -> Result<(), Misfit> {
        let part = &self.parts[index];
        let of_part = |reason: String| Misfit::of(index, reason);
        self.check_beside(index, part)?;
        match &part.primitive {
            Primitive::Lane(lane) => self.check_over_floor(&part.name, lane).map_err(of_part),
            Primitive::Sink(sink) => self.check_only_sink(index, sink.lane),
            Primitive::Source(source) => self.check_source(index, source),
            Primitive::Diverter(d) => {
                self.check_branch(index, &Branch { lane: d.lane, at: d.at, onto: d.onto })
            }
            Primitive::Pusher(p) => {
                self.check_branch(index, &Branch { lane: p.lane, at: p.at, onto: p.onto })
            }
            Primitive::Process(process) => self.check_process(&part.name, process).map_err(of_part),
            _ => Ok(()),
        }
    }

    /// Items on a lane have their place by `at`, and lie side by side.
    fn check_process(&self, name: &str, process: &Process) -> Result<(), String> {
        let on = &self.parts[process.on].name;
        match (self.lane_of(process.on), process.at) {
            (None, Some(_)) => Err(format!("{name} has `at`, which is for a lane, and {on} is a place")),
            (None, None) if process.moving => {
                Err(format!("{name} has `moving`, which is for a lane, and {on} is a place"))
            }
            (Some(_), None) => {
                Err(format!("{name} has no `at`: {on} is a lane, and {name} is at a place of it"))
            }
            (Some(_), Some(_)) if process.frees => {
                Err(format!("{name} frees items, which come to lie at a place together, and {on} is a lane"))
            }
            _ => Ok(()),
        }
    }

    fn check_over_floor(&self, name: &str, lane: &Lane) -> Result<(), String> {
        for (_, line) in self.centre_lines(lane) {
            for (place, verb) in [(line.begin(), "begins"), (line.end(), "ends")] {
                let height = line.point(place, 0.0).z;
                if height < -ROUNDED {
                    return Err(format!("{name} {verb} {:.3} m below the floor", -height));
                }
            }
        }
        Ok(())
    }

    /// The first sink on the way takes all items.
    fn check_only_sink(&self, index: usize, lane: usize) -> Result<(), Misfit> {
        let mut before = self.parts[..index].iter();
        let other = before.find(|o| matches!(&o.primitive, Primitive::Sink(sink) if sink.lane == lane));
        let Some(other) = other else { return Ok(()) };
        let (name, lane) = (&self.parts[index].name, &self.parts[lane].name);
        let reason =
            format!("{} and {name} are both a sink of {lane}: one of them takes all items", other.name);
        Err(Misfit::of(index, reason).fix(
            "take one of them out, or let a diverter or a pusher lead to another lane with the other one",
        ))
    }

    /// Items that appear where others leave the lane would never come there.
    fn check_source(&self, index: usize, source: &Source) -> Result<(), Misfit> {
        let Some(lane) = self.lane_of(source.lane) else { return Ok(()) };
        let length = lane.centre_line.length();
        let sink = self.parts.iter().find_map(|part| match &part.primitive {
            Primitive::Sink(sink) if sink.lane == source.lane => Some((&part.name, sink.inset)),
            _ => None,
        });
        // One that is not at the lane is told itself.
        let sink = sink.filter(|(_, inset)| (-ROUNDED..=length + ROUNDED).contains(inset));
        let last = length - sink.map_or(0.0, |(_, inset)| inset);
        if source.inset < last - ROUNDED {
            return Ok(());
        }
        let (name, on) = (&self.parts[index].name, &self.parts[source.lane].name);
        let leave = sink.map_or("it ends".into(), |(sink, _)| format!("{sink} takes them off"));
        let reason =
            format!("{name} puts items onto {on} at {:.3} m, and {leave} at {last:.3} m", source.inset);
        let fix = "let items appear before the place where they leave the lane: give `inset` a lower value";
        Err(Misfit::of(index, reason).fix(fix))
    }

    fn lane_of(&self, part: usize) -> Option<&Lane> {
        match &self.parts.get(part)?.primitive {
            Primitive::Lane(lane) => Some(lane),
            _ => None,
        }
    }

    fn check_beside(&self, index: usize, part: &Part) -> Result<(), Misfit> {
        let (lane, at, setting, from) = match &part.primitive {
            Primitive::Beam(beam) => (beam.lane, beam.at, "at", "beginning"),
            Primitive::Gauge(gauge) => (gauge.lane, gauge.at, "at", "beginning"),
            Primitive::Stopper(stopper) => (stopper.lane, stopper.at, "at", "beginning"),
            Primitive::Diverter(diverter) => (diverter.lane, diverter.at, "at", "beginning"),
            Primitive::Pusher(pusher) => (pusher.lane, pusher.at, "at", "beginning"),
            Primitive::Source(source) => (source.lane, source.inset, "inset", "beginning"),
            Primitive::Sink(sink) => (sink.lane, sink.inset, "inset", "end"),
            Primitive::Process(Process { on, at: Some(at), .. }) => (*on, *at, "at", "beginning"),
            _ => return Ok(()),
        };
        let Some(lane) = self.lane_of(lane) else { return Ok(()) };
        let length = lane.centre_line.length();
        if !(-ROUNDED..=length + ROUNDED).contains(&at) {
            let reason = format!("{} is {at:.3} m from the {from} of a lane of {length:.3} m", part.name);
            let fix = format!("give `{setting}` a value from 0 to {length:.3}, or make the lane longer");
            return Err(Misfit::of(index, reason).fix(fix));
        }
        Ok(())
    }

    fn check_branch(&self, index: usize, branch: &Branch) -> Result<(), Misfit> {
        let name = &self.parts[index].name;
        if branch.lane == branch.onto {
            let reason = format!("{name} brings items from {0} onto {0}", self.parts[branch.onto].name);
            return Err(Misfit::of(index, reason).fix("let it bring them onto another lane"));
        }
        let (Some(lane), Some(onto)) = (self.lane_of(branch.lane), self.lane_of(branch.onto)) else {
            return Ok(());
        };
        let farthest = (lane.width + onto.width) / 2.0 + FRAMES;
        let at = |line: CentreLine, place: f64| line.point(place, 0.0);
        let begins = self.centre_lines(onto).into_iter().map(|(_, line)| at(line, line.begin()));
        let begins: Vec<Point> = begins.collect();
        let places = self.centre_lines(lane).into_iter();
        let places = places.map(|(_, line)| at(line, line.begin() - branch.at));
        let pairs = places.flat_map(|place| begins.iter().map(move |begin| [place, *begin]));
        let is_beside = |pair: [Point; 2]| beside(pair) <= farthest + ROUNDED;
        let is_level = |[place, begin]: [Point; 2]| begin.z - place.z <= STEP + ROUNDED;
        let mut nearest: Option<[Point; 2]> = None;
        for pair in pairs {
            if is_beside(pair) && is_level(pair) {
                return Ok(());
            }
            nearest = nearest.filter(|other| beside(*other) <= beside(pair)).or(Some(pair));
        }
        let Some(pair @ [place, begin]) = nearest else { return Ok(()) };
        let off = match is_beside(pair) {
            true => format!("{:.3} m higher: {STEP:.3} m are the most", begin.z - place.z),
            false => format!("{:.3} m beside it: {farthest:.3} m are the most", beside(pair)),
        };
        let [place, begin] = [place, begin].map(|Point { x, y, z }| format!("({x:.3}, {y:.3}, {z:.3})"));
        let onto = &self.parts[branch.onto].name;
        let reason = format!("{name} at {place} brings items onto {onto}, which begins at {begin}, {off}");
        Err(Misfit::of(index, reason)
            .fix("let the other lane begin beside the place at `at`, and no higher; or change `at`"))
    }
}

/// How far two points are from each other as seen from above, m.
fn beside([place, begin]: [Point; 2]) -> f64 {
    libm::hypot(begin.x - place.x, begin.y - place.y)
}
