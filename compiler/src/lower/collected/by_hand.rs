//! What arms can take and bring that know no handovers, as seen from above.

use runtime_sim::collision::{BoundingBox, range};
use runtime_sim::line::Line;
use runtime_sim::part::Primitive;
use runtime_sim::point::Axis;

pub struct ByHand {
    arms: Vec<Arm>,
    /// Where items can be on each machine; none if they lie nowhere on it.
    items: Vec<Option<BoundingBox>>,
    /// The tool need not come nearer to the middle of an item, m.
    near: f64,
}

struct Arm {
    machine: usize,
    /// Where its tool can be.
    tool: BoundingBox,
}

impl ByHand {
    /// None if it is not known of one of the arms.
    pub fn new(line: &Line, arms: Vec<usize>) -> Option<Self> {
        let ranges = arms.iter().map(|arm| {
            let tool = range::of_tool(&line.machines[*arm])?;
            Some(Arm { machine: *arm, tool })
        });
        let arms: Vec<Arm> = ranges.collect::<Option<_>>()?;
        let items =
            line.machines.iter().map(|machine| if arms.is_empty() { None } else { range::of_items(machine) });
        let grips = line.machines.iter().flat_map(|machine| &machine.parts).filter_map(|part| {
            match &part.primitive {
                Primitive::Grip(grip) => Some(grip.near),
                _ => None,
            }
        });
        let sizes = line.kinds.iter().map(|kind| kind.size[0].hypot(kind.size[1]) + kind.height);
        let largest = |all: &mut dyn Iterator<Item = f64>| all.fold(0.0, f64::max);
        let near = largest(&mut { grips }) + largest(&mut { sizes });
        Some(Self { items: items.collect(), arms, near })
    }

    /// Machines from one of which an item may get to the other one.
    pub fn pairs(&self) -> impl Iterator<Item = [usize; 2]> {
        let both = |arm: &Arm, other: usize| [[arm.machine, other], [other, arm.machine]];
        self.arms.iter().flat_map(move |arm| {
            let to_items = (0..self.items.len()).filter(|other| self.distance(arm, *other) <= self.near);
            let to_tools =
                self.arms.iter().filter(|other| distance(&arm.tool, &other.tool) <= 2.0 * self.near);
            let all = to_items.chain(to_tools.map(|other| other.machine));
            all.filter(|other| *other != arm.machine).flat_map(move |other| both(arm, other))
        })
    }

    /// Each arm that can take from none of these machines and is none of them, its distance from the nearest of them, m,
    /// and which that is.
    pub fn apart(&self, machines: &[usize]) -> impl Iterator<Item = (usize, f64, usize)> {
        self.arms.iter().filter(|arm| !machines.contains(&arm.machine)).filter_map(|arm| {
            let all = machines.iter().map(|machine| (self.distance(arm, *machine), *machine));
            let (distance, machine) = all.min_by(|a, b| a.0.total_cmp(&b.0))?;
            distance.is_finite().then_some((arm.machine, distance, machine))
        })
    }

    fn distance(&self, arm: &Arm, machine: usize) -> f64 {
        self.items[machine].map_or(f64::INFINITY, |items| distance(&arm.tool, &items))
    }
}

/// Of what is in one from what is in the other, at least, as seen from above, m.
fn distance(a: &BoundingBox, b: &BoundingBox) -> f64 {
    let [x, y] = [Axis::X, Axis::Y].map(|axis| {
        let ([low, high], [from, to]) = (a.along(axis), b.along(axis));
        (low - to).max(from - high).max(0.0)
    });
    x.hypot(y)
}
