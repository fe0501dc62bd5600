//! Machines and obstacles that overlap before anything moves.

use super::body::{Piece, Placed};
use super::bounds::BoundingBox;
use super::sweep::Sweep;
use crate::frame::Frame;
use crate::kinematics::arm::Frames;
use crate::kinematics::pose::Pose;
use crate::line::Line;
use crate::machine::Machine;
use crate::solid::{Link, Solid};

/// Two that are in one another by more than the skin of the collision check, by their names, and which solid of each.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlap {
    pub names: [String; 2],
    pub parts: [String; 2],
}

struct Thing<'a> {
    name: &'a str,
    is_machine: bool,
    pieces: Vec<(String, Placed)>,
    bounds: BoundingBox,
}

/// Of all bodies at the start, arms at their rest and vehicles at their first stops; two obstacles may overlap, and so
/// may those that the layout allows to touch. The first pair of solids of each two, and `most` of them at most.
pub fn overlaps(line: &Line, most: usize) -> Vec<Overlap> {
    let machines = line.machines.iter().map(|machine| {
        let start = machine.start().unwrap_or_default().pose();
        let links = at_rest(machine);
        let solids = machine.solids().into_iter().filter_map(|solid| match solid.link {
            Link::World => Some(solid),
            Link::Route => Some(Solid { pose: start.then(&solid.pose), ..solid }),
            Link::Carriage(part) => {
                let frame = at_begin(machine, part);
                Some(Solid { pose: frame.pose().then(&solid.pose), ..solid })
            }
            Link::Joint(joint) => {
                let frame = links.as_ref()?.get(joint)?;
                Some(Solid { pose: frame.then(&solid.pose), ..solid })
            }
        });
        thing(&machine.name, true, solids)
    });
    let obstacles = line.obstacles.iter().map(|o| thing(&o.name, false, o.solid().into_iter()));
    let things: Vec<Thing> = machines.chain(obstacles).filter(|thing| !thing.pieces.is_empty()).collect();
    let sweep = Sweep::new(things.iter().map(|thing| thing.bounds));
    let pairs = sweep.meeting().map(|pair| pair.map(|number| &things[number]));
    let matter = pairs.filter(|[first, second]| {
        (first.is_machine || second.is_machine) && !line.allows([first.name, second.name])
    });
    matter.filter_map(|[first, second]| overlap(first, second)).take(most).collect()
}

/// Of the links of an arm when a run begins.
fn at_rest(machine: &Machine) -> Option<Frames> {
    let (arm, chain) = (machine.arm()?, machine.chain()?);
    Some(arm.frames(&arm.at_rest(chain.rest)?))
}

/// What is on a cylinder or a positioner when a run begins.
fn at_begin(machine: &Machine, part: usize) -> Frame {
    machine.parts[part].strokes().map_or(Frame::default(), |strokes| strokes.begin())
}

fn thing(name: &str, is_machine: bool, solids: impl Iterator<Item = Solid>) -> Thing<'_> {
    let pieces: Vec<(String, Placed)> = solids
        .map(|solid| {
            let piece = Piece::new(String::new(), &solid.pose, solid.shape);
            (solid.name, piece.within(&Pose::IDENTITY))
        })
        .collect();
    let bounds = pieces.iter().map(|(_, placed)| placed.bounds());
    let bounds = bounds.fold(BoundingBox::NOTHING, |all, next| all.with(&next));
    Thing { name, is_machine, pieces, bounds }
}

fn overlap(first: &Thing, second: &Thing) -> Option<Overlap> {
    for (part, a) in &first.pieces {
        for (other, b) in &second.pieces {
            if a.apart_at_least(b, f64::MIN_POSITIVE) <= 0.0 && a.gap(b).distance <= 0.0 {
                return Some(Overlap {
                    names: [first.name.into(), second.name.into()],
                    parts: [part.clone(), other.clone()],
                });
            }
        }
    }
    None
}
