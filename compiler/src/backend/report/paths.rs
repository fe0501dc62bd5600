//! Where items were, for the drawing: the segments of [`runtime_sim::path`].

use super::numbers::{List, list};
use runtime_sim::carrier::Carrier;
use runtime_sim::line::Line;
use runtime_sim::path::{Law, OnItem, Path, Segment};
use runtime_sim::point::Point;
use runtime_sim::report::carrier_text;
use serde_json::{Value, json};

/// Each a value of JSON.
pub struct Paths {
    /// Text, what it is, number of the machine or -1, number of its part or -1.
    pub carriers: String,
    /// Of each item the end of its path in ms, then its segments: begin in ms, number of the carrier, number of the law,
    /// and the numbers of that. What continues where the segment before has brought it does without the place: a number of
    /// the law that is greater by [`GOES_ON`].
    pub items: String,
}

/// What an item is: its name, its first kind, what it became and when, and when it lay on others: begin, end, which one,
/// and how it was turned there, ms and rad. Empty lists at the end are left out.
pub fn item_json(name: &str, kind: usize, path: &Path) -> Value {
    let load = |load: &OnItem| json!([load.begin_ms, load.end_ms, load.under, load.turn]);
    let loads: Vec<Value> = path.loads.iter().map(load).collect();
    match (path.becomes.is_empty(), loads.is_empty()) {
        (true, true) => json!([name, kind]),
        (false, true) => json!([name, kind, path.becomes]),
        (_, false) => json!([name, kind, path.becomes, loads]),
    }
}

/// When each item came and when it left, ms; null for what it did not do. Nothing for one that never came.
pub fn lives(paths: &[Path]) -> Vec<Value> {
    let life = |path: &Path| {
        let (Some(first), Some(last)) = (path.segments.first(), path.segments.last()) else {
            return json!([]);
        };
        json!([first.begin_ms, last.carrier.is_final().then_some(last.end_ms)])
    };
    paths.iter().map(life).collect()
}

/// Of the segments those that begin by this time.
pub fn paths(line: &Line, paths: &[Path], until_ms: f64) -> Paths {
    let mut carriers: Vec<String> = Vec::new();
    let mut number = |carrier: Carrier| {
        let json = carrier_json(line, carrier);
        carriers.iter().position(|known| *known == json).unwrap_or_else(|| {
            carriers.push(json);
            carriers.len() - 1
        })
    };
    let items: Vec<String> = paths.iter().map(|path| item(path, until_ms, &mut number)).collect();
    Paths { items: list(items), carriers: list(carriers) }
}

fn item(path: &Path, until_ms: f64, number: &mut impl FnMut(Carrier) -> usize) -> String {
    let known = &path.segments[..path.segments.partition_point(|segment| segment.begin_ms <= until_ms)];
    let Some(last) = known.last() else { return "[]".into() };
    let mut all = List::default();
    all.put(last.end_ms);
    let mut before: Option<&Segment> = None;
    for (index, segment) in known.iter().enumerate() {
        // One without duration says nothing that its neighbours do not, but at the end.
        if segment.begin_ms == segment.end_ms && index + 1 < known.len() {
            continue;
        }
        let goes_on = before.is_some_and(|before| goes_on(before, segment));
        all.put_json(&law(segment, number(segment.carrier), goes_on));
        before = Some(segment);
    }
    all.end()
}

/// What is added to the number of a law.
const GOES_ON: u32 = 4;
/// What is nearer is at the same place, m.
const NEAR: f64 = 1e-9;

/// Whether a segment begins where the one before it ends, both on a straight line.
fn goes_on(before: &Segment, segment: &Segment) -> bool {
    let is_straight = |segment: &Segment| matches!(segment.law, Law::Rests(_) | Law::Slides { .. });
    let gap = before.place(segment.begin_ms) - segment.place(segment.begin_ms);
    is_straight(before) && is_straight(segment) && gap.length() < NEAR
}

fn law(segment: &Segment, carrier: usize, goes_on: bool) -> String {
    let mut numbers = List::default();
    numbers.put(segment.begin_ms).put_whole(carrier);
    match &segment.law {
        Law::Rests(_) if goes_on => numbers.put_whole(GOES_ON),
        Law::Slides { velocity, acceleration, .. } if goes_on => {
            numbers.put_whole(GOES_ON + 1).put_all([velocity.x, velocity.y, velocity.z]);
            numbers.put_all(gains(*acceleration).into_iter().flatten())
        }
        Law::Rests(point) => numbers.put_whole(0).put_all([point.x, point.y, point.z]),
        Law::Slides { from, velocity, acceleration } => numbers
            .put_whole(1)
            .put_all([from.x, from.y, from.z])
            .put_all([velocity.x, velocity.y, velocity.z])
            .put_all(gains(*acceleration).into_iter().flatten()),
        Law::Conveyed(conveyed) if matches!(segment.carrier, Carrier::Place { .. }) => {
            let Point { x, y, z } = conveyed.on_line(0.0);
            numbers.put_whole(2).put_all([x, y, z, f64::NEG_INFINITY]);
            let carried = conveyed.carried.map(|carried| [carried.out, carried.rate, carried.until]);
            numbers.put_all(carried.unwrap_or_default())
        }
        Law::Conveyed(conveyed) => {
            numbers.put_whole(2).put_all([
                conveyed.place,
                conveyed.across,
                conveyed.speed,
                conveyed.stops_at,
            ]);
            let offset = conveyed.offset;
            let carried = conveyed.carried.map(|carried| [carried.out, carried.rate, carried.until]);
            match carried {
                _ if offset != Point::default() => {
                    numbers.put_all(carried.unwrap_or([f64::NAN; 3])).put_all([offset.x, offset.y, offset.z])
                }
                Some(carried) => numbers.put_all(carried),
                None => &mut numbers,
            }
        }
        Law::Hangs(hanging) => numbers.put_whole(3).put_all([hanging.hang.x, hanging.hang.y, hanging.hang.z]),
    };
    numbers.end()
}

/// Nothing for what goes on evenly.
fn gains(acceleration: Point) -> Option<[f64; 3]> {
    let Point { x, y, z } = acceleration;
    (acceleration != Point::default()).then_some([x, y, z])
}

fn carrier_json(line: &Line, carrier: Carrier) -> String {
    let what = match carrier {
        Carrier::Supply => "supply",
        Carrier::Lane { .. } => "lane",
        Carrier::Grip { .. } => "grip",
        Carrier::Place { .. } => "place",
        Carrier::On { .. } => "item",
        Carrier::Floor { .. } => "floor",
        Carrier::Sink { .. } => "sink",
        Carrier::Collector => "collector",
        Carrier::Part { .. } => "part",
        Carrier::Shipped { .. } => "order",
    };
    let (machine, part) = match carrier {
        Carrier::Sink { machine, part } => (Some(machine), Some(part)),
        other => (other.machine(), other.part()),
    };
    let number = |index: Option<usize>| index.map_or(-1, |index| index as i64);
    json!([carrier_text(line, carrier), what, number(machine), number(part)]).to_string()
}
