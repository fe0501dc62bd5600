//! What becomes of the items on a tray that a process changes, or whose items it changes.

use super::Cycle;
use crate::carrier::Carrier;
use crate::item::block::SAME_HEIGHT;
use crate::part::World;
use crate::part::place::Stack;
use crate::point::Point;

impl Cycle {
    /// They come to rest again, the lowest first, each on what was below it and on the deck. `before` is what lay there. The
    /// error is why that ends the run.
    pub(super) fn settle_on_deck(
        &self,
        tray: usize,
        before: &Stack,
        world: &mut World,
    ) -> Result<(), String> {
        let kind = |item: usize, world: &World| self.kinds[world.items[item].kind].clone();
        let mut loads = world.items.loads_of(tray).to_vec();
        let old_height = |item: usize| before.block(item).map_or(0.0, |block| block.at().z);
        loads.sort_by(|one, other| old_height(*one).total_cmp(&old_height(*other)));
        for (number, load) in loads.iter().enumerate() {
            let Some(stack) = world.items.deck(tray) else {
                let [load, tray] = [*load, tray].map(|item| kind(item, world));
                return Err(format!("{} leaves a {load} on a {tray}, which bears nothing", self.name));
            };
            let Some(block) = stack.block(*load) else { continue };
            let was_below = |other: usize| {
                before.block(other).is_some_and(|other| other.top() <= old_height(*load) + SAME_HEIGHT)
            };
            let rest = stack.rest_on(block, |other, _| loads[..number].contains(&other) && was_below(other));
            let Some(rest) = rest.filter(|rest| rest.tips_off.is_none()) else {
                return Err(format!("a {} tips off in {}", kind(*load, world), self.name));
            };
            let at = Point { z: rest.height, ..block.at() };
            if (rest.height - block.at().z).abs() > SAME_HEIGHT {
                world.shift_on(*load, Carrier::On { item: tray, offset: at });
            }
        }
        let Some(stack) = world.items.deck(tray) else { return Ok(()) };
        match loads.into_iter().find_map(|load| Some((load, stack.is_in(load)?))) {
            Some((one, other)) => {
                Err(format!("{} moves a {} into a {}", self.name, kind(one, world), kind(other, world)))
            }
            None => Ok(()),
        }
    }
}
