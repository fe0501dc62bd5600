//! What outputs do to the plant.

use crate::event::{self, From};
use crate::plant::{Action, Desk, Machine, Place, Watch, motion, phase, status};
use crate::program::bit;
use crate::scan::Scan;
use crate::surface::{self, Landing};
use crate::value::Point;
use crate::violation::Violation;

/// An item that is let go higher over a place falls, m.
const DEEP: f64 = 0.05;

impl Scan<'_> {
    /// A command is given to a machine.
    pub(crate) fn begin(&mut self, machine: usize, command: usize, points: &[Point], is_under_way: bool) {
        let plant = &self.model.machines[machine];
        let Some(head) = &plant.head else { return };
        let before = is_under_way.then(|| self.asked(plant));
        self.keep_shown(machine);
        if is_under_way {
            self.ask_start(machine);
            self.interrupt(plant);
        }
        let number = |scan: &mut Self, point: Point| scan.values.number_of_point(point);
        match (head.commands[command].action, points) {
            (Action::Motion, &[goal]) => self.aim(machine, 0, goal),
            (Action::Motion, &[via, goal]) => {
                let via = number(self, via);
                self.aim(machine, via, goal);
            }
            (Action::Trip, &[goal]) => {
                if let Some(route) = &plant.route {
                    let goal = number(self, event::stop(&route.stops, route.tolerance, goal));
                    route.goal.store(self.bytes, goal);
                }
            }
            (Action::Run, _) => self.drive(plant, motion::RUNS, motion::STARTS),
            (Action::Rest, _) => self.drive(plant, motion::STANDS, motion::STOPS),
            _ => {}
        }
        head.status.store(self.bytes, status::UNDER_WAY);
        head.command.store(self.bytes, command as i32);
        self.given |= bit(machine);
        if head.commands[command].is_kept && before == Some(self.asked(plant)) {
            self.repeated |= bit(machine);
        }
    }

    /// The last command, and where it leads.
    fn asked(&self, plant: &Machine) -> [Option<i32>; 4] {
        let arm = plant.arm.as_ref();
        let vars = [
            plant.head.as_ref().map(|head| head.command),
            arm.map(|arm| arm.via),
            arm.map(|arm| arm.goal),
            plant.route.as_ref().map(|route| route.goal),
        ];
        vars.map(|var| var.map(|var| var.load(self.bytes)))
    }

    /// An arm goes nowhere if its goal is out of reach.
    fn aim(&mut self, machine: usize, via: i32, goal: Point) {
        if let Some(arm) = &self.model.machines[machine].arm {
            let goal = self.values.number_of_point(goal);
            let mut is_reached = |number| {
                self.values.is_reached(machine, number, |point| (self.model.reach.0)(machine, point))
            };
            let (via, goal) =
                if is_reached(goal) && (via == 0 || is_reached(via)) { (via, goal) } else { (0, 0) };
            arm.via.store(self.bytes, via);
            arm.goal.store(self.bytes, goal);
        }
    }

    fn drive(&mut self, plant: &Machine, same: i32, changing: i32) {
        if let Some(lane) = &plant.lane
            && lane.motion.load(self.bytes) != same
        {
            lane.motion.store(self.bytes, changing);
        }
    }

    /// The command under way is void: what moved is where it began or where it would have ended.
    fn interrupt(&mut self, plant: &Machine) {
        if let Some(arm) = &plant.arm {
            let goal = arm.goal.load(self.bytes);
            if goal != 0 && goal != arm.tool.load(self.bytes) && self.choices.take(2) == 1 {
                arm.tool.store(self.bytes, goal);
            }
            arm.via.store(self.bytes, 0);
            arm.goal.store(self.bytes, 0);
        }
        if let Some(route) = &plant.route
            && route.goal.load(self.bytes) != route.at.load(self.bytes)
            && self.choices.take(2) == 1
        {
            let goal = route.goal.load(self.bytes);
            route.at.store(self.bytes, goal);
        }
        if let Some(lane) = &plant.lane
            && matches!(lane.motion.load(self.bytes), motion::STARTS | motion::STOPS)
        {
            let now = self.choices.take(2) as i32;
            lane.motion.store(self.bytes, now);
        }
    }

    /// The number of the stop at which a vehicle is: under way it is chosen where it is first read.
    pub(crate) fn at_stop(&mut self, machine: usize) -> i32 {
        self.decisions.end_record();
        let Machine { head, route: Some(route), .. } = &self.model.machines[machine] else { return -1 };
        head.iter().for_each(|head| self.observe(head.status));
        if let Some(shown) = route.shown_stop(self.bytes) {
            return shown;
        }
        self.ask_start(machine);
        let stop = |scan: &Self, number: i32| {
            let at = scan.values.point(number);
            route.stops.iter().position(|stop| *stop == at).map_or(-1, |stop| stop as i32)
        };
        let (at, goal) = (route.at.load(self.bytes), route.goal.load(self.bytes));
        if !surface::is_driving(self.model, self.bytes, machine) {
            return stop(self, at);
        }
        let shown = match self.choices.take(3) {
            0 => stop(self, at),
            1 => -1,
            _ => stop(self, goal),
        };
        route.show(self.bytes, shown);
        shown
    }

    /// Where a vehicle is: under way at its start, in the middle or at its goal, as [`Self::at_stop`] has it.
    pub(crate) fn position(&mut self, machine: usize) -> Point {
        let stop = self.at_stop(machine);
        let Some(route) = &self.model.machines[machine].route else { return [0.0; 3] };
        if let Ok(stop) = usize::try_from(stop) {
            return route.stops[stop];
        }
        self.ask_start(machine);
        let [at, goal] = [route.at, route.goal].map(|var| self.values.point(var.load(self.bytes)));
        [0, 1, 2].map(|axis| (at[axis] + goal[axis]) / 2.0)
    }

    /// What is read in the scan of a command was shown before it.
    fn keep_shown(&mut self, machine: usize) {
        let Machine { route, lane, .. } = &self.model.machines[machine];
        if let Some(route) = route.as_ref().filter(|route| route.shown.is_some()) {
            let stop = self.at_stop(machine);
            route.show(self.bytes, stop);
        }
        if let Some(lane) = lane
            && let Some(shown) = lane.shown
        {
            let moves = lane.motion.load(self.bytes) != motion::STANDS;
            shown.store(self.bytes, 1 + i32::from(moves));
        }
    }

    /// Levels act, orders are served, and what is not remembered is forgotten.
    pub(crate) fn act(&mut self, touched: u64) -> Result<(), Violation> {
        let model = self.model;
        for (machine, plant) in model.machines.iter().enumerate() {
            if (touched | self.fired) & bit(machine) != 0 {
                self.release(machine, plant)?;
                self.forget_answer(machine, plant);
            }
        }
        self.valves(touched);
        for (machine, plant) in model.machines.iter().enumerate() {
            if let Some(desk) = &plant.desk {
                self.serve(machine, plant, desk)?;
            }
        }
        for input in &model.inputs {
            let stays = input.stays.and_then(|machine| model.machines[machine].lane.as_ref());
            if stays.is_none_or(|lane| lane.motion.load(self.bytes) != motion::STANDS) {
                input.var.store(self.bytes, 0);
            }
        }
        model.open_shown(self.bytes);
        if self.given == 0 || model.watch != Watch::Everything {
            return Ok(());
        }
        self.hazards()?;
        self.remark();
        Ok(())
    }

    /// The answer to a command, once it is of no use.
    pub(crate) fn forget_answer(&mut self, machine: usize, plant: &Machine) {
        let Some(head) = &plant.head else { return };
        if head.status.load(self.bytes) == status::UNDER_WAY {
            return;
        }
        let program = &self.model.instances[machine];
        let state = &program.states[program.state.load(self.bytes) as usize];
        if state.is_answer_dead {
            head.status.store(self.bytes, status::NONE);
        }
        if let Some(port) = head.error.filter(|_| state.is_error_dead) {
            port.store(self.bytes, 0);
        }
    }

    fn release(&mut self, machine: usize, plant: &Machine) -> Result<(), Violation> {
        let Some(arm) = &plant.arm else { return Ok(()) };
        let held = arm.holds.load(self.bytes);
        if held == 0 || arm.closes.is_none_or(|level| level.is_on(self.bytes)) {
            return Ok(());
        }
        let kind = held as usize - 1;
        let places = event::losses(self.model, self.values, self.bytes, arm, kind);
        let (from, landing) = places[self.choices.take(places.len() as u32) as usize];
        if self.model.watch == Watch::Everything {
            let tool = self.values.point(arm.tool.load(self.bytes));
            let (depth, below) = surface::fall(self.model, self.values, self.bytes, tool, kind);
            let place = |machine: usize, place: usize| &self.model.machines[machine].places[place];
            let stacks = match below {
                Landing::Slot { machine, place: number, .. } | Landing::Beside { machine, place: number } => {
                    place(machine, number).stacks
                }
                Landing::Zone { .. } | Landing::Elsewhere => false,
            };
            if from == From::Tool
                && depth > DEEP
                && !stacks
                && let Landing::Slot { machine: at, .. } | Landing::Beside { machine: at, .. } = below
            {
                return Err(Violation::Dropped { arm: machine, machine: at });
            }
            if let Landing::Slot { machine: at, place: number, slot } = landing
                && !place(at, number).stacks
            {
                let place = place(at, number);
                if !place.by_kind && place.items[slot].load(self.bytes) != 0 {
                    return Err(Violation::ItemOnItem { arm: machine, machine: at, slot });
                }
                if place.stray.is_some_and(|stray| stray.load(self.bytes) != 0) {
                    return Err(Violation::ItemAmongItems { arm: machine, machine: at });
                }
            }
        }
        event::land(self.model, self.bytes, landing, kind);
        if let Landing::Zone { machine, .. } = landing {
            let seen = self.model.inputs.iter().filter(|input| input.stays == Some(machine));
            self.restless |= seen.fold(0, |machines, input| machines | bit(input.machine));
        }
        arm.holds.store(self.bytes, 0);
        Ok(())
    }

    /// Whether the items at a place are those of an order.
    fn has_all_of(&mut self, order: usize, place: &Place) -> bool {
        let stray = place.stray.map_or(0, |stray| stray.load(self.bytes));
        let is_unknown = stray == event::others(self.model);
        let count = |kind: usize| {
            if place.by_kind {
                return place.items[kind].load(self.bytes) as u32;
            }
            let all = place.items.iter().map(|item| item.load(self.bytes)).chain([stray]);
            all.filter(|item| *item == kind as i32 + 1).count() as u32
        };
        let mut parts = self.model.orders[order].parts.iter().enumerate();
        if is_unknown {
            return parts.all(|(kind, wanted)| count(kind) <= *wanted) && self.choices.take(2) == 1;
        }
        parts.all(|(kind, wanted)| count(kind) == *wanted)
    }

    fn take_away(&mut self, place: &Place) {
        place.items.iter().chain(&place.stray).for_each(|item| item.store(self.bytes, 0));
    }

    fn serve(&mut self, machine: usize, plant: &Machine, desk: &Desk) -> Result<(), Violation> {
        let is_complete = desk.complete.is_some_and(|level| level.is_on(self.bytes));
        let order = desk.order.load(self.bytes) as usize;
        let place = desk.place.map(|place| &plant.places[place]);
        match desk.phase.load(self.bytes) {
            phase::OPEN if self.model.orders[order].made.load(self.bytes) != 0 => {
                place.into_iter().for_each(|place| self.take_away(place));
                desk.phase.store(self.bytes, phase::TAKEN);
            }
            phase::OPEN if is_complete => {
                if place.is_some_and(|place| !place.stacks && !self.has_all_of(order, place)) {
                    return match self.model.watch {
                        Watch::Everything => Err(Violation::WrongItems { machine, order }),
                        Watch::Faults => Ok(()),
                    };
                }
                place.into_iter().for_each(|place| self.take_away(place));
                self.model.orders[order].made.store(self.bytes, 1);
                desk.phase.store(self.bytes, phase::TAKEN);
            }
            phase::GONE if !is_complete => {
                let next = desk.next.load(self.bytes) as usize;
                let is_left = desk.orders[next.min(desk.orders.len())..]
                    .iter()
                    .any(|order| self.model.orders[*order].made.load(self.bytes) == 0);
                desk.phase.store(self.bytes, if is_left { phase::OPENING } else { phase::BARE });
            }
            _ => {}
        }
        Ok(())
    }
}
