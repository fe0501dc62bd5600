//! Where things are: what lies under a tool, and what it would grip.

use crate::model::Model;
use crate::plant::{Place, Zone, motion, phase, sight, status};
use crate::value::{Point, Values};

/// An item that is let go at most so far below a surface lies on it, m: as in the simulator.
const SINK: f64 = 0.01;
/// A place no farther from a slot is that slot, m.
const AT_SLOT: f64 = 0.01;

/// Where an item comes to lie.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Landing {
    /// Machine, its place, and the slot or the kind.
    Slot { machine: usize, place: usize, slot: usize },
    /// At a place, and at none of its slots.
    Beside { machine: usize, place: usize },
    /// In a field over a lane.
    Zone { machine: usize, zone: usize },
    /// Where nothing looks for it.
    Elsewhere,
}

/// An item that a gripper could take.
#[derive(Clone, Copy, Debug)]
pub struct Found {
    pub kind: usize,
    pub at: Landing,
    /// Whether it lies there is not known.
    pub is_forgotten: bool,
    /// It may have gone, or may not have come.
    pub may_be_gone: bool,
}

/// The origin of a place, in the state; of one that is carried, at the stop where its vehicle is or was.
pub fn origin(model: &Model, values: &Values, state: &[u8], machine: usize, place: &Place) -> Point {
    match (place.stands, &model.machines[machine].route) {
        (Some(point), _) => point,
        (None, Some(route)) => values.point(route.at.load(state)),
        (None, None) => [0.0; 3],
    }
}

pub fn is_over(place: &Place, origin: Point, point: Point) -> bool {
    let [x, y] = [0, 1].map(|axis| point[axis] - origin[axis]);
    place.floor.is_near([x, y], 0.0) && point[2] >= origin[2] + place.floor.middle[2] - SINK
}

pub fn is_in(zone: &Zone, point: Point) -> bool {
    (0..2).all(|axis| zone.low[axis] <= point[axis] && point[axis] <= zone.high[axis])
        && point[2] >= zone.surface - SINK
}

/// Whether the vehicle of a machine is on its way.
pub fn is_driving(model: &Model, state: &[u8], machine: usize) -> bool {
    let machine = &model.machines[machine];
    match (&machine.head, &machine.route) {
        (Some(head), Some(route)) => {
            head.status.load(state) == status::UNDER_WAY && route.at.load(state) != route.goal.load(state)
        }
        _ => false,
    }
}

fn is_there(model: &Model, state: &[u8], machine: usize, place: usize) -> bool {
    model.machines[machine]
        .desk
        .as_ref()
        .is_none_or(|desk| desk.place != Some(place) || desk.phase.load(state) == phase::OPEN)
}

/// Where an item of a kind lands that a tool loses here.
pub fn landing(model: &Model, values: &Values, state: &[u8], tool: Point, kind: usize) -> Landing {
    fall(model, values, state, tool, kind).1
}

/// How deep an item of a kind falls that a tool lets go here, m, and where it lands; without end where nothing is known to
/// be below.
pub fn fall(model: &Model, values: &Values, state: &[u8], tool: Point, kind: usize) -> (f64, Landing) {
    let under = [tool[0], tool[1], tool[2] - model.grasps[kind]];
    let mut highest = (f64::NEG_INFINITY, Landing::Elsewhere);
    for (machine, plant) in model.machines.iter().enumerate() {
        for (number, place) in plant.places.iter().enumerate() {
            let origin = origin(model, values, state, machine, place);
            let height = origin[2] + place.floor.middle[2];
            if height <= highest.0
                || !is_over(place, origin, under)
                || !is_there(model, state, machine, number)
            {
                continue;
            }
            let slot = if place.by_kind { Some(kind) } else { slot_at(place, origin, under) };
            let landing = match slot.filter(|slot| *slot < place.items.len()) {
                Some(slot) => Landing::Slot { machine, place: number, slot },
                None => Landing::Beside { machine, place: number },
            };
            highest = (height, landing);
        }
        for (number, zone) in plant.lane.iter().flat_map(|lane| &lane.zones).enumerate() {
            if zone.surface > highest.0 && is_in(zone, under) {
                highest = (zone.surface, Landing::Zone { machine, zone: number });
            }
        }
    }
    (under[2] - highest.0, highest.1)
}

fn slot_at(place: &Place, origin: Point, point: Point) -> Option<usize> {
    let distance = |slot: &Point| {
        let [dx, dy] = [0, 1].map(|axis| origin[axis] + slot[axis] - point[axis]);
        dx * dx + dy * dy
    };
    let nearest = place.slots.iter().enumerate().min_by(|(_, a), (_, b)| distance(a).total_cmp(&distance(b)));
    nearest.filter(|(_, slot)| distance(slot) <= AT_SLOT * AT_SLOT).map(|(number, _)| number)
}

/// The nearest item that a gripper finds with its tool here, no farther than `near` from where it is gripped.
pub fn found(model: &Model, values: &Values, state: &[u8], tool: Point, near: f64) -> Option<Found> {
    let gap = |p: Point, kind: usize| {
        let gap = [p[0] - tool[0], p[1] - tool[1], p[2] + model.grasps[kind] - tool[2]];
        gap.iter().map(|c| c * c).sum::<f64>()
    };
    let mut nearest: Option<(f64, Found)> = None;
    let mut meet = |gap: f64, found: Found| {
        if gap <= near * near && nearest.is_none_or(|(least, _)| gap < least) {
            nearest = Some((gap, found));
        }
    };
    for (machine, plant) in model.machines.iter().enumerate() {
        for (number, place) in plant.places.iter().enumerate() {
            if is_driving(model, state, machine) {
                continue;
            }
            let origin = origin(model, values, state, machine, place);
            for (slot, item) in place.items.iter().enumerate() {
                let held = item.load(state);
                let kind = if place.by_kind { slot } else { held as usize - usize::from(held > 0) };
                let Some(offset) = place.slots.get(slot).filter(|_| held > 0) else { continue };
                let at = [0, 1, 2].map(|axis| origin[axis] + offset[axis]);
                let lies = Landing::Slot { machine, place: number, slot };
                meet(gap(at, kind), Found { kind, at: lies, is_forgotten: false, may_be_gone: false });
            }
        }
        let Some(lane) = &plant.lane else { continue };
        let moves = lane.motion.load(state) != motion::STANDS;
        // It may stand before it has answered, and does while its machine is stopped.
        if moves && lane.motion.load(state) != motion::STOPS && !model.stands(state, machine) {
            continue;
        }
        for (number, zone) in lane.zones.iter().enumerate() {
            let told = |kind: usize| {
                zone.sees[kind].map_or(sight::OPEN, |input| model.inputs[input].var.load(state))
            };
            for kind in (0..zone.found.len()).filter(|kind| told(*kind) != sight::NOT_SEEN) {
                let at = Landing::Zone { machine, zone: number };
                let is_forgotten = told(kind) == sight::FORGOTTEN;
                let stays = zone.sees[kind].is_none_or(|input| model.inputs[input].stays.is_some());
                let may_be_gone = is_forgotten || moves || !stays;
                meet(gap(zone.found[kind], kind), Found { kind, at, is_forgotten, may_be_gone });
            }
        }
    }
    if let Some((_, found)) = nearest {
        return Some(found);
    }
    hidden(model, values, state, tool)
}

/// An item on a place that is not known: it may be where no place is known. Of which kind it is, is known if there is one
/// alone.
fn hidden(model: &Model, values: &Values, state: &[u8], tool: Point) -> Option<Found> {
    let may_be = model.has_hidden_places
        && model.grasps.len() == 1
        && landing(model, values, state, tool, 0) == Landing::Elsewhere;
    may_be.then_some(Found { kind: 0, at: Landing::Elsewhere, is_forgotten: true, may_be_gone: true })
}

/// An empty slot, of a machine that stands, at which an item of some kind would be gripped with the tool here.
pub fn empty_slot(
    model: &Model,
    values: &Values,
    state: &[u8],
    tool: Point,
    near: f64,
) -> Option<(usize, usize)> {
    places(model, values, state).find_map(|(machine, place, origin)| {
        let slot = slot_at(place, origin, tool)?;
        let at = origin[2] + place.slots[slot][2];
        let is_height = model.grasps.iter().any(|grasp| (at + grasp - tool[2]).abs() <= near);
        (is_height && place.items.get(slot)?.load(state) == 0).then_some((machine, slot))
    })
}

/// The machine of which a slot is under the tool, if it has others and the tool is so low that it touches items in them.
pub fn low_in_slot(model: &Model, values: &Values, state: &[u8], tool: Point) -> Option<usize> {
    let tallest = model.heights.iter().copied().fold(0.0, f64::max);
    places(model, values, state).find_map(|(machine, place, origin)| {
        let is_low = tool[2] <= origin[2] + place.floor.middle[2] + tallest + 0.001;
        let has_others = place.slots.len() > 1;
        (has_others && is_low && is_over(place, origin, tool) && slot_at(place, origin, tool).is_some())
            .then_some(machine)
    })
}

/// Places that are there and stand, with their machines and their origins.
fn places<'a>(
    model: &'a Model,
    values: &'a Values,
    state: &'a [u8],
) -> impl Iterator<Item = (usize, &'a Place, Point)> {
    model.machines.iter().enumerate().flat_map(move |(machine, plant)| {
        let places = plant.places.iter().enumerate();
        let there = places.filter(move |(number, _)| {
            is_there(model, state, machine, *number) && !is_driving(model, state, machine)
        });
        there.map(move |(_, place)| (machine, place, origin(model, values, state, machine, place)))
    })
}
