//! What becomes of items that lie on what a process changes or takes away.

use super::Cycle;
use crate::item::block::SAME_HEIGHT;
use crate::part::World;
use crate::part::place::Stack;
use crate::point::Point;

impl Cycle {
    /// They come to rest again, the lowest first, on what was below them. `before` is what lay there, and `gone` what has
    /// become parts of the item. The error is why that ends the run.
    pub(super) fn settle(
        &self,
        item: usize,
        before: &Stack,
        gone: &[usize],
        world: &mut World,
    ) -> Result<(), String> {
        let place = self.process.on;
        let kind = |item: usize, world: &World| self.kinds[world.items[item].kind].clone();
        let shaken = before.shaken(item, gone);
        for (number, upper) in shaken.iter().enumerate() {
            let (Some(stack), Some(was)) = (world.see().stack(place), before.block(*upper)) else { continue };
            let Some(block) = stack.block(*upper) else { continue };
            let was_below = |other: usize| {
                before.block(other).is_some_and(|other| other.top() <= was.at().z + SAME_HEIGHT)
            };
            let rest =
                stack.rest_on(block, |other, _| !shaken[number..].contains(&other) && was_below(other));
            let Some(rest) = rest.filter(|rest| rest.tips_off.is_none()) else {
                return Err(format!("a {} tips off in {}", kind(*upper, world), self.name));
            };
            if (rest.height - block.at().z).abs() > SAME_HEIGHT {
                world.shift(*upper, place, Point { z: rest.height, ..block.at() });
            }
        }
        let Some(stack) = world.see().stack(place) else { return Ok(()) };
        let moved = shaken.iter().chain([&item]);
        match moved.filter_map(|moved| Some((*moved, stack.is_in(*moved)?))).next() {
            Some((one, other)) => {
                Err(format!("{} moves a {} into a {}", self.name, kind(one, world), kind(other, world)))
            }
            None => Ok(()),
        }
    }

    /// A part that was laid at a slot of the place comes to rest there. The error is why it cannot.
    pub(super) fn lay_down(&self, item: usize, world: &mut World) -> Result<(), String> {
        let place = self.process.on;
        let kind = |item: usize, world: &World| self.kinds[world.items[item].kind].clone();
        if let Some(stack) = world.see().stack(place)
            && let Some(block) = stack.block(item)
        {
            let highest = block.at().z + SAME_HEIGHT;
            let rest = stack.rest_on(block, |other, under| other != item && under.top() <= highest);
            let Some(rest) = rest.filter(|rest| rest.tips_off.is_none()) else {
                return Err(format!("{} lays a {} beside its place", self.name, kind(item, world)));
            };
            let offset = Point { z: rest.height, ..block.at() };
            world.shift(item, place, offset);
        }
        let see = world.see();
        let now_ms = world.now_ms as f64;
        let Some(block) = see.block(place, item, now_ms) else { return Ok(()) };
        let stacks = see.stack(place).is_some();
        let mut others = see.borne_by(place).filter(|other| *other != item);
        let is_in = |other: &usize| {
            see.block(place, *other, now_ms).is_some_and(|other| match stacks {
                true => block.is_in(&other),
                false => block.is_surely_in(&other),
            })
        };
        match others.find(is_in) {
            Some(other) => {
                Err(format!("{} lays a {} into a {}", self.name, kind(item, world), kind(other, world)))
            }
            None => Ok(()),
        }
    }
}
