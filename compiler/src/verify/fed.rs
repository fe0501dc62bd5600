//! Where items come that no arm puts there.

use super::plant::is_carried;
use runtime_sim::line::Line;
use runtime_sim::part::Primitive;
use runtime_sim::plant::{By, transfers};
use runtime_sim::wiring::Drives;
use std::collections::BTreeSet;

/// Lanes on which items come, go or become others even while they stand, and places that get them from conveyors: by
/// other conveyors, by a source that puts them on when it is asked to, by diverters, pushers and processes. Each by the
/// numbers of its machine and of its part.
pub struct Fed(BTreeSet<(usize, usize)>);

impl Fed {
    pub fn of(line: &Line) -> Self {
        let mut fed = BTreeSet::new();
        for transfer in transfers(line) {
            fed.insert(transfer.to);
            if let By::Branch { .. } = transfer.by {
                fed.insert(transfer.from);
            }
        }
        // With a tray its load comes and goes.
        let bears = line.kinds.iter().any(|kind| kind.deck.is_some());
        for (number, machine) in line.machines.iter().enumerate() {
            for (part, of) in machine.parts.iter().enumerate() {
                match &of.primitive {
                    Primitive::Lane(_) if bears => {
                        fed.insert((number, part));
                    }
                    Primitive::Process(process)
                        if process.changes_items()
                            && matches!(machine.parts[process.on].primitive, Primitive::Lane(_)) =>
                    {
                        fed.insert((number, process.on));
                    }
                    _ => {}
                }
            }
            for output in &machine.wiring.outputs {
                if let Drives::Level { part, .. } = output.drives
                    && let Primitive::Source(source) = &machine.parts[part].primitive
                {
                    fed.insert((number, source.lane));
                }
            }
        }
        Self(fed)
    }

    pub fn has(&self, machine: usize, part: usize) -> bool {
        self.0.contains(&(machine, part))
    }

    /// Whether a place is searched: none that is carried is, and one that is fed only if orders are made there. What lies at
    /// such a one is not known either.
    pub fn is_known(&self, line: &Line, number: usize, part: usize) -> bool {
        let machine = &line.machines[number];
        let Primitive::Place(place) = &machine.parts[part].primitive else { return false };
        let is_of_orders =
            |other: &Primitive| matches!(other, Primitive::Orders(orders) if orders.place == part);
        let has_orders = machine.parts.iter().any(|other| is_of_orders(&other.primitive));
        !is_carried(machine, place) && (has_orders || !self.has(number, part))
    }
}
