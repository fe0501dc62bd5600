//! What becomes of items that lie on what a process changes or takes away.

use super::cycle::Cycle;
use crate::carrier::Carrier;
use crate::item::block::{Block, SAME_HEIGHT};
use crate::part::World;
use crate::part::place::Stack;
use crate::point::Point;

/// Where items lie on one another.
#[derive(Clone, Copy)]
pub(super) enum Ground {
    /// This part of the machine.
    Place(usize),
    /// On this item.
    Deck(usize),
}

impl Ground {
    pub(super) fn stack(self, world: &World) -> Option<Stack> {
        match self {
            Self::Place(place) => world.see().stack(place),
            Self::Deck(tray) => world.items.deck(tray),
        }
    }

    fn shift(self, item: usize, to: Point, world: &mut World) {
        match self {
            Self::Place(place) => world.shift(item, place, to),
            Self::Deck(tray) => world.shift_on_item(item, Carrier::On { item: tray, offset: to }),
        }
    }
}

impl Cycle {
    fn kind_of(&self, item: usize, world: &World) -> &str {
        &self.kinds[world.items[item].kind]
    }

    /// What lies on an item at a place comes to rest again where the process has changed or taken away what is under it.
    /// `before` is what lay there, and `gone` what has become parts of the item. The error is why that ends the run.
    pub(super) fn settle_at_place(
        &self,
        item: usize,
        before: &Stack,
        gone: &[usize],
        world: &mut World,
    ) -> Result<(), String> {
        let shaken = before.shaken(item, gone);
        let place = Ground::Place(self.process.on);
        self.settle(&shaken, before, place, world)?;
        let stack = place.stack(world);
        match stack.and_then(|stack| stack.is_in(item)) {
            Some(other) => Err(self.moves_into(item, other, world)),
            None => Ok(()),
        }
    }

    /// The same for all that lies on a tray.
    pub(super) fn settle_on_tray(
        &self,
        tray: usize,
        before: &Stack,
        world: &mut World,
    ) -> Result<(), String> {
        let mut loads = world.items.loads_of(tray).to_vec();
        if let Some(load) = loads.first().filter(|_| world.items.deck(tray).is_none()) {
            let [load, tray] = [*load, tray].map(|item| self.kind_of(item, world));
            return Err(format!("{} leaves a {load} on a {tray}, which bears nothing", self.name));
        }
        let height = |item: &usize| before.block(*item).map_or(0.0, |block| block.at().z);
        loads.sort_by(|one, other| height(one).total_cmp(&height(other)));
        self.settle(&loads, before, Ground::Deck(tray), world)
    }

    /// The error names two items that are in one another now: an item or what lies on it, or one of these and what lies on
    /// another item of the machine.
    pub(super) fn check_apart(&self, item: usize, world: &World) -> Result<(), String> {
        if !world.items.has_loads() {
            return Ok(());
        }
        let (see, ms) = (world.see(), world.next_ms() as f64);
        let solids = |base: usize| -> Vec<(usize, Vec<Block>)> {
            let part = world.items[base].carrier.part();
            let Some(block) = part.and_then(|part| see.block(part, base, ms)) else { return Vec::new() };
            let solids = |item: usize| {
                let frame = block.frame().then(world.items.on_base(item).1);
                (item, world.items.dimensions(item).solids_in(frame))
            };
            world.items.with_loads(base).map(solids).collect()
        };
        let own = solids(item);
        let others = world.items.borne_by(world.machine).iter().filter(|base| **base != item);
        let others: Vec<_> = others.flat_map(|base| solids(*base)).collect();
        for (number, (one, mine)) in own.iter().enumerate() {
            // Items at a place and on a lane themselves are seen to there.
            let beside = others.iter().filter(|(other, _)| {
                [*one, *other].iter().any(|item| world.items[*item].carrier.item().is_some())
            });
            let mut all = own[..number].iter().chain(beside);
            if let Some((other, _)) = all.find(|(_, theirs)| Block::are_in_one_another(mine, theirs)) {
                return Err(self.moves_into(*one, *other, world));
            }
        }
        Ok(())
    }

    /// Items come to rest again, the lowest first, each on what was below it.
    fn settle(
        &self,
        items: &[usize],
        before: &Stack,
        ground: Ground,
        world: &mut World,
    ) -> Result<(), String> {
        for (number, item) in items.iter().enumerate() {
            let (Some(stack), Some(was)) = (ground.stack(world), before.block(*item)) else { continue };
            let Some(block) = stack.block(*item) else { continue };
            let was_below = |other: usize| {
                before.block(other).is_some_and(|other| other.top() <= was.at().z + SAME_HEIGHT)
            };
            let rest = stack.rest_on(block, |other, _| !items[number..].contains(&other) && was_below(other));
            let Some(rest) = rest.filter(|rest| rest.tips_off.is_none()) else {
                return Err(format!("a {} tips off in {}", self.kind_of(*item, world), self.name));
            };
            if (rest.height - block.at().z).abs() > SAME_HEIGHT {
                ground.shift(*item, Point { z: rest.height, ..block.at() }, world);
            }
        }
        let Some(stack) = ground.stack(world) else { return Ok(()) };
        match items.iter().find_map(|item| Some((*item, stack.is_in(*item)?))) {
            Some((one, other)) => Err(self.moves_into(one, other, world)),
            None => Ok(()),
        }
    }

    fn moves_into(&self, one: usize, other: usize, world: &World) -> String {
        let [one, other] = [one, other].map(|item| self.kind_of(item, world));
        format!("{} moves a {one} into a {other}", self.name)
    }

    /// A part that was laid at a slot of the place comes to rest there. The error is why it cannot.
    pub(super) fn lay_down(&self, item: usize, world: &mut World) -> Result<(), String> {
        let place = self.process.on;
        if let Some(stack) = world.see().stack(place)
            && let Some(block) = stack.block(item)
        {
            let highest = block.at().z + SAME_HEIGHT;
            let rest = stack.rest_on(block, |other, under| other != item && under.top() <= highest);
            let Some(rest) = rest.filter(|rest| rest.tips_off.is_none()) else {
                return Err(format!("{} lays a {} beside its place", self.name, self.kind_of(item, world)));
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
                let [item, other] = [item, other].map(|item| self.kind_of(item, world));
                Err(format!("{} lays a {item} into a {other}", self.name))
            }
            None => Ok(()),
        }
    }
}
