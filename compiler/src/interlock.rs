//! Machines whose paths cross while no lock of their types keeps them apart.

mod few;
mod holder;
mod lock;
mod region;
mod stage;
mod stay;
pub mod visits;
mod writers;
mod written;

use crate::diagnostic::{Diagnostic, sort};
use crate::lower::Project;
use crate::parallel::{LEAST, in_parts};
use crate::source::{Span, Spanned};
use region::Given;
use runtime_sim::collision::{BoundingBox, Moving, Sweep};
use runtime_sim::machine::Machine;
use stay::{Range, Stays};
use std::cell::OnceCell;
use std::collections::BTreeMap;

/// Crossing paths of two machines of which the volume is told.
const MOST_CROSSINGS: usize = 100;

/// A machine that moves through the layout.
struct Mover {
    instance: usize,
    moving: Moving,
}

/// Where movers are and go, by their numbers: sought when it is asked for.
struct Ranges<'a> {
    given: Given<'a>,
    movers: &'a [Mover],
    known: Vec<OnceCell<Range>>,
}

impl<'a> Ranges<'a> {
    fn new(project: &'a Project, movers: &'a [Mover]) -> Self {
        let known = movers.iter().map(|_| OnceCell::new()).collect();
        Self { given: Given::new(&project.system, &project.plant), movers, known }
    }

    fn of(&self, number: usize) -> &Range {
        let mover = &self.movers[number];
        self.known[number].get_or_init(|| stay::range(&self.given, mover.instance, &mover.moving))
    }
}

/// Where two machines can both be, and the commands that bring them there; none of one whose goals are not known.
struct Crossing {
    common: BoundingBox,
    places: [Span; 2],
    is_known: [bool; 2],
}

/// One for each pair of arms or vehicles that can be in one place at the same time, as far as texts and layout tell.
/// Pairs that work with one another directly are left out, and so are those that the layout allows to touch.
/// `names` are those of the objects of the layout.
pub fn warnings(names: &[Spanned<String>], project: &Project) -> Vec<Diagnostic> {
    let machines: Vec<(usize, &Machine)> = project.plant.machines.iter().enumerate().collect();
    let movers = in_parts(&machines, LEAST, |machines| {
        let mover = |(instance, machine): &(usize, &Machine)| {
            Some(Mover { instance: *instance, moving: Moving::new(machine)? })
        };
        machines.iter().filter_map(mover).collect()
    });
    let sweep = Sweep::new(movers.iter().map(|mover| mover.moving.whole()));
    let objects: BTreeMap<&str, Span> = names.iter().map(|name| (name.value.as_str(), name.span)).collect();
    let in_order = |mut pair: [usize; 2]| {
        pair.sort_by_key(|number| movers[*number].instance);
        pair
    };
    let pairs = sweep.meeting().map(in_order);
    let pairs: Vec<[usize; 2]> =
        pairs.filter(|pair| !is_allowed(project, pair.map(|number| &movers[number]))).collect();
    let mut found = in_parts(&pairs, 1, |pairs| {
        let ranges = Ranges::new(project, &movers);
        let found = |pair: &[usize; 2]| {
            let crossing = crossing(&ranges, *pair)?;
            diagnostic(project, &objects, pair.map(|number| &movers[number]), &crossing)
        };
        pairs.iter().filter_map(found).collect()
    });
    sort(&mut found);
    found
}

fn is_allowed(project: &Project, [a, b]: [&Mover; 2]) -> bool {
    let names = [a, b].map(|mover| project.plant.machines[mover.instance].name.as_str());
    works_with(project, a, b) || works_with(project, b, a) || project.plant.allows(names)
}

fn crossing(ranges: &Ranges, [a, b]: [usize; 2]) -> Option<Crossing> {
    let moving = |number: usize| &ranges.movers[number].moving;
    // Where the one goes that could take up more often shows that the other one need not be looked at.
    let volume = |number: usize| moving(number).whole().volume();
    let (larger, other) = if volume(a) >= volume(b) { (a, b) } else { (b, a) };
    if let Range::Stays(stays) = ranges.of(larger)
        && stays.bounds.is_apart(&moving(other).whole())
    {
        return None;
    }
    match [a, b].map(|number| ranges.of(number)) {
        [Range::Whole(one, here), Range::Whole(other, there)] => {
            Some(Crossing { common: one.common(other), places: [*here, *there], is_known: [false; 2] })
        }
        [Range::Whole(whole, here), Range::Stays(stays)] => within(whole, stays)
            .map(|(common, there)| Crossing { common, places: [*here, there], is_known: [false, true] }),
        [Range::Stays(stays), Range::Whole(whole, there)] => within(whole, stays)
            .map(|(common, here)| Crossing { common, places: [here, *there], is_known: [true, false] }),
        [Range::Stays(stays), Range::Stays(others)] => both([a, b].map(moving), stays, others),
    }
}

fn within(whole: &BoundingBox, stays: &Stays) -> Option<(BoundingBox, Span)> {
    let near = stays.all.iter().filter(|stay| !stay.path.bounds.is_apart(whole));
    let common = near.map(|stay| (stay.path.bounds.common(whole), stay.place));
    common.reduce(|(all, place), (next, _)| (all.with(&next), place))
}

fn both([a, b]: [&Moving; 2], stays: &Stays, others: &Stays) -> Option<Crossing> {
    if stays.bounds.is_apart(&others.bounds) {
        return None;
    }
    let is_free = stays.without_common_lock(others);
    let mut found: Option<Crossing> = None;
    let mut count = 0;
    for stay in stays.all.iter().filter(|stay| !stay.path.bounds.is_apart(&others.bounds)) {
        for other in others.all.iter().filter(|other| is_free[stay.locks][other.locks]) {
            if let Some(common) = a.common(&stay.path, (b, &other.path)) {
                let crossing = found.get_or_insert(Crossing {
                    common,
                    places: [stay.place, other.place],
                    is_known: [true; 2],
                });
                crossing.common = crossing.common.with(&common);
                count += 1;
                if count == MOST_CROSSINGS {
                    return found;
                }
            }
        }
    }
    found
}

/// Whether the second one is a member of a role of the first: what they share is the matter of their handover.
fn works_with(project: &Project, a: &Mover, b: &Mover) -> bool {
    let system = &project.system;
    let mut roles = system.automaton_of(a.instance).roles.iter().zip(&system.instances[a.instance].roles);
    roles.any(|(role, rows)| {
        let own = system.automaton_of(b.instance).implementing(role.interface);
        own.is_some_and(|own| rows.contains(&system.instances[b.instance].rows[own]))
    })
}

fn diagnostic(
    project: &Project,
    objects: &BTreeMap<&str, Span>,
    pair: [&Mover; 2],
    crossing: &Crossing,
) -> Option<Diagnostic> {
    let [a, b] = pair.map(|mover| project.plant.machines[mover.instance].name.as_str());
    let message = format!("{a} and {b} can be in one place at the same time: no lock keeps them apart");
    let [low, high] = crossing.common.corners();
    let range = |low: f64, high: f64| format!("{low:.2} to {high:.2}");
    let mut diagnostic = Diagnostic::new("W0202", *objects.get(a)?, message)
        .other(*objects.get(b)?, "the other one")
        .other(crossing.places[0], format!("{a} comes there by this"))
        .other(crossing.places[1], format!("{b} by this"))
        .note(format!(
            "both come to x {}, y {}, z {} m",
            range(low.x, high.x),
            range(low.y, high.y),
            range(low.z, high.z)
        ));
    for (name, _) in [a, b].iter().zip(crossing.is_known).filter(|(_, is_known)| !is_known) {
        diagnostic =
            diagnostic.note(format!("the goals of {name} are not known: all that it reaches is taken"));
    }
    Some(diagnostic.help(
        "let both set the same cell `by lock` before they go there and reset it behind it, move one of them, or say under \"may_touch\" why they cannot meet",
    ))
}
