//! What devices do between two scans.

use crate::model::Model;
use crate::plant::{Action, Arm, Asked, Faults, Head, Machine, motion, phase, status};
use crate::stroke;
use crate::surface::{self, Landing};
use crate::value::{Point, Values};

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub struct Event {
    /// The machine, or the instance whose time has come.
    pub machine: usize,
    pub what: What,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum What {
    /// The command under way ends.
    Ends(Ending),
    /// The gripper loses what it holds.
    Loses(From),
    /// The gripper takes the item that is there.
    Takes,
    /// It does where the motion under way has begun.
    TakesAtStart,
    /// It becomes known whether an item hangs on the gripper.
    Shows,
    /// The next order opens.
    Opens,
    /// It becomes known that the order was taken away.
    IsGone,
    /// The next time of the state has come.
    TimeComes,
    /// A cylinder comes to one of [`crate::stroke::position`], sent by one of [`crate::stroke::drive`].
    Strokes {
        cylinder: usize,
        drive: i32,
        to: i32,
    },
    /// A cylinder rests: what its valves have asked for before does not move it any more.
    Settles(usize),
    /// A process begins.
    Begins(usize),
    /// It begins and is over at once.
    Leaps(usize),
    Completes(usize),
}

#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Ending {
    Well,
    /// Well, and an item hangs on the gripper.
    WithItem,
    /// The same, and the controller does not see the item yet.
    WithItemUnseen,
    /// What is awaited did not come.
    InVain,
    /// In this error, before anything has moved.
    Refused(i32),
}

/// Where an item is lost.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum From {
    /// Where the motion under way began, or where the tool rests.
    Tool,
    Via,
    Goal,
    /// In between: it falls to where nothing looks for it.
    OnTheWay,
    /// The same, but near to where the motion began.
    BesideTool,
    /// The same, but near to where it goes.
    BesideGoal,
}

/// So far from an end of its motion, along x and along y, a tool is still over what is there, and not over one slot, m.
const BESIDE: f64 = 0.2;
/// So far it is over nothing that an automaton knows.
const FAR: f64 = 100.0;

/// Who may do something in a scan: each machine at most one thing beside its cylinders and processes, each instance at
/// most one time.
pub(crate) fn sources(model: &Model) -> usize {
    2 * model.machines.len() + stroke::sources(model)
}

/// What a source may do in this state.
pub(crate) fn events(model: &Model, values: &Values, state: &[u8], source: usize, out: &mut Vec<Event>) {
    let machine = source / 2;
    if machine >= model.machines.len() {
        return stroke::events(model, state, source - 2 * model.machines.len(), out);
    }
    let mut add = |what| out.push(Event { machine, what });
    if source % 2 == 1 {
        let program = &model.instances[machine];
        let may_come = !model.stands(state, machine)
            && (model.faults == Faults::All || !is_item_unseen(model, state, machine));
        if let Some(times) = program.times_come.filter(|_| may_come) {
            let number = program.state.load(state) as usize;
            if (times.load(state) as usize) < program.states[number].times.len() {
                add(What::TimeComes);
            }
        }
        return;
    }
    let plant = &model.machines[machine];
    let has_faults = model.faults == Faults::All;
    if let Some(head) = &plant.head
        && head.status.load(state) == status::UNDER_WAY
        && !model.stands(state, machine)
    {
        endings(model, values, state, plant, head, &mut |ending| add(What::Ends(ending)));
    }
    if let Some(arm) = &plant.arm {
        let holds = arm.holds.load(state);
        if (holds != 0) != (arm.shown.load(state) != 0) {
            add(What::Shows);
        }
        if holds != 0 && has_faults {
            for (from, _) in losses(model, values, state, arm, holds as usize - 1) {
                add(What::Loses(from));
            }
        }
        if holds == 0 && takes(model, values, state, plant, arm).is_some() {
            add(What::Takes);
        }
        if holds == 0 && takes_at_start(model, values, state, plant, arm).is_some() {
            add(What::TakesAtStart);
        }
    }
    if let Some(desk) = &plant.desk {
        match desk.phase.load(state) {
            phase::OPENING => add(What::Opens),
            phase::TAKEN => add(What::IsGone),
            _ => {}
        }
    }
}

fn endings(
    model: &Model,
    values: &Values,
    state: &[u8],
    plant: &Machine,
    head: &Head,
    add: &mut dyn FnMut(Ending),
) {
    let asked = &head.commands[head.command.load(state) as usize];
    if !is_reached(values, state, plant, asked) {
        return asked.refusals.iter().for_each(|error| add(Ending::Refused(*error)));
    }
    if asked.action == Action::Trip {
        add(Ending::Well);
    } else if let (Some(awaits), Some(arm)) = (asked.awaits, &plant.arm) {
        if !awaits.is_hold || arm.holds.load(state) != 0 {
            add(Ending::Well);
        } else if found_at_goal(model, values, state, arm).is_some() {
            add(Ending::WithItem);
            add(Ending::WithItemUnseen);
        }
        let is_there = |found: Option<surface::Found>| found.is_some_and(|found| !found.may_be_gone);
        if arm.holds.load(state) == 0
            && (model.faults == Faults::All || !is_there(found_at_goal(model, values, state, arm)))
        {
            add(Ending::InVain);
        }
    } else {
        add(Ending::Well);
        if asked.awaits.is_some() {
            add(Ending::InVain);
        }
    }
    if model.faults == Faults::All {
        asked.refusals.iter().for_each(|error| add(Ending::Refused(*error)));
    }
}

/// Whether the command under way has a goal that can be reached.
fn is_reached(values: &Values, state: &[u8], plant: &Machine, asked: &Asked) -> bool {
    match (asked.action, &plant.route, &plant.arm) {
        (Action::Trip, Some(route), _) => route.stops.contains(&values.point(route.goal.load(state))),
        (Action::Motion, _, Some(arm)) => arm.goal.load(state) != 0,
        _ => true,
    }
}

/// Whether an event is a fault of a device: one that does not happen with [`Faults::None`].
pub(crate) fn is_fault(model: &Model, values: &Values, state: &[u8], event: &Event) -> bool {
    let plant = &model.machines[event.machine];
    match (event.what, &plant.head, &plant.arm) {
        (What::Loses(_), ..) => true,
        // A bus is later than the machine waits.
        (What::TimeComes, ..) => is_item_unseen(model, state, event.machine),
        (What::Ends(Ending::Refused(_)), Some(head), _) => {
            is_reached(values, state, plant, &head.commands[head.command.load(state) as usize])
        }
        (What::Ends(Ending::InVain), _, Some(arm)) => {
            found_at_goal(model, values, state, arm).is_some_and(|found| !found.may_be_gone)
        }
        _ => false,
    }
}

/// Whether an item hangs on the gripper, and the controller does not see it yet.
fn is_item_unseen(model: &Model, state: &[u8], machine: usize) -> bool {
    let arm = model.machines[machine].arm.as_ref();
    arm.is_some_and(|arm| arm.holds.load(state) != 0 && arm.shown.load(state) == 0)
}

/// Whether an event depends on what is forgotten: it may be that it cannot happen.
pub(crate) fn is_guess(model: &Model, values: &Values, state: &[u8], event: &Event) -> bool {
    let plant = &model.machines[event.machine];
    let Some(arm) = &plant.arm else { return false };
    let found = match event.what {
        What::Ends(Ending::InVain | Ending::WithItem | Ending::WithItemUnseen) => {
            found_at_goal(model, values, state, arm)
        }
        What::Takes => takes(model, values, state, plant, arm),
        What::TakesAtStart => takes_at_start(model, values, state, plant, arm),
        _ => None,
    };
    found.is_some_and(|found| found.is_forgotten)
}

fn is_closed(arm: &Arm, state: &[u8]) -> bool {
    arm.closes.is_some_and(|level| level.is_on(state))
}

fn found_at_goal(model: &Model, values: &Values, state: &[u8], arm: &Arm) -> Option<surface::Found> {
    let goal = values.point(arm.goal.load(state));
    is_closed(arm, state).then(|| surface::found(model, values, state, goal, arm.near)).flatten()
}

/// What the gripper may take without a command that waits for it.
fn takes(model: &Model, values: &Values, state: &[u8], plant: &Machine, arm: &Arm) -> Option<surface::Found> {
    if !is_closed(arm, state) {
        return None;
    }
    let head = plant.head.as_ref()?;
    let is_under_way = head.status.load(state) == status::UNDER_WAY;
    let Asked { action, awaits, .. } = &head.commands[head.command.load(state) as usize];
    match (is_under_way, action, awaits) {
        (true, Action::Motion, Some(_)) => None,
        // What is not known to lie at the goal is taken when the tool is there.
        (true, Action::Motion, None) => {
            found_at_goal(model, values, state, arm).filter(|found| found.at != Landing::Elsewhere)
        }
        _ => surface::found(model, values, state, values.point(arm.tool.load(state)), arm.near),
    }
}

/// What the gripper may take where the motion under way has begun: for the search the tool is there until it has ended.
fn takes_at_start(
    model: &Model,
    values: &Values,
    state: &[u8],
    plant: &Machine,
    arm: &Arm,
) -> Option<surface::Found> {
    let head = plant.head.as_ref()?;
    let (tool, goal) = (arm.tool.load(state), arm.goal.load(state));
    let sets_out = head.status.load(state) == status::UNDER_WAY
        && head.commands[head.command.load(state) as usize].action == Action::Motion
        && goal != 0
        && goal != tool;
    let found = (sets_out && is_closed(arm, state))
        .then(|| surface::found(model, values, state, values.point(tool), arm.near));
    found.flatten().filter(|found| found.at != Landing::Elsewhere)
}

/// Where the gripper of an arm may lose an item of this kind; one place for each that makes a difference to where it
/// falls, or to an automaton that reads where the tool is then.
pub(crate) fn losses(
    model: &Model,
    values: &Values,
    state: &[u8],
    arm: &Arm,
    kind: usize,
) -> Vec<(From, Landing)> {
    let at = |from, number: i32| (from, surface::landing(model, values, state, values.point(number), kind));
    let mut all = vec![at(From::Tool, arm.tool.load(state))];
    let (via, goal) = (arm.via.load(state), arm.goal.load(state));
    if via != 0 {
        all.push(at(From::Via, via));
    }
    if goal != 0 {
        all.push(at(From::Goal, goal));
        all.push((From::OnTheWay, Landing::Elsewhere));
        for (from, end) in [(From::BesideTool, arm.tool.load(state)), (From::BesideGoal, goal)] {
            let landing = surface::landing(model, values, state, beside(values.point(end)), kind);
            let landing = match landing {
                Landing::Slot { machine, place, .. } | Landing::Beside { machine, place } => {
                    Landing::Beside { machine, place }
                }
                Landing::Zone { .. } | Landing::Elsewhere => Landing::Elsewhere,
            };
            all.push((from, landing));
        }
    }
    all
}

fn beside([x, y, z]: Point) -> Point {
    [x + BESIDE, y + BESIDE, z]
}

/// Where the tool is when it loses an item; none: where it was.
fn tool_at(values: &mut Values, state: &[u8], arm: &Arm, from: From) -> Option<i32> {
    let [tool, goal] = [arm.tool, arm.goal].map(|place| values.point(place.load(state)));
    let place = match from {
        From::Tool => return None,
        From::Via => return Some(arm.via.load(state)),
        From::Goal => return Some(arm.goal.load(state)),
        From::OnTheWay => [tool[0] + FAR, tool[1] + FAR, tool[2]],
        From::BesideTool => beside(tool),
        From::BesideGoal => beside(goal),
    };
    Some(values.number_of_point(place))
}

/// The state after an event.
pub(crate) fn apply(model: &Model, values: &mut Values, state: &mut [u8], event: Event) {
    let plant = &model.machines[event.machine];
    match event.what {
        What::TimeComes => {
            if let Some(times) = model.instances[event.machine].times_come {
                times.store(state, times.load(state) + 1);
            }
        }
        What::Ends(ending) => end(model, values, state, plant, ending),
        What::Loses(from) => {
            let Some(arm) = &plant.arm else { return };
            let kind = arm.holds.load(state) as usize - 1;
            let landing = losses(model, values, state, arm, kind).into_iter().find(|(f, _)| *f == from);
            if let Some(place) = tool_at(values, state, arm, from) {
                arm.tool.store(state, place);
            }
            arm.holds.store(state, 0);
            arm.shown.store(state, 0);
            if let Some((_, landing)) = landing {
                land(model, state, landing, kind);
            }
        }
        What::Takes => {
            let Some(arm) = &plant.arm else { return };
            if let Some(found) = takes(model, values, state, plant, arm) {
                take(model, state, arm, found);
            }
        }
        What::TakesAtStart => {
            let Some(arm) = &plant.arm else { return };
            if let Some(found) = takes_at_start(model, values, state, plant, arm) {
                take(model, state, arm, found);
            }
        }
        What::Shows => {
            if let Some(arm) = &plant.arm {
                let shown = i32::from(arm.holds.load(state) != 0);
                arm.shown.store(state, shown);
            }
        }
        What::Opens => open(model, state, plant),
        What::IsGone => {
            if let Some(desk) = &plant.desk {
                desk.phase.store(state, phase::GONE);
            }
        }
        What::Strokes { .. } | What::Settles(_) | What::Begins(_) | What::Leaps(_) | What::Completes(_) => {
            stroke::apply(model, state, event.what)
        }
    }
}

fn end(model: &Model, values: &Values, state: &mut [u8], plant: &Machine, ending: Ending) {
    let Some(head) = &plant.head else { return };
    let asked = &head.commands[head.command.load(state) as usize];
    let error = match ending {
        Ending::Well | Ending::WithItem | Ending::WithItemUnseen => 0,
        Ending::InVain => asked.awaits.map_or(0, |awaits| awaits.error),
        Ending::Refused(error) => error,
    };
    let has_moved = !matches!(ending, Ending::Refused(_));
    if let Some(arm) = &plant.arm {
        if matches!(ending, Ending::WithItem | Ending::WithItemUnseen)
            && let Some(found) = found_at_goal(model, values, state, arm)
        {
            take(model, state, arm, found);
        }
        let goal = arm.goal.load(state);
        if has_moved && goal != 0 {
            arm.tool.store(state, goal);
        }
        arm.via.store(state, 0);
        arm.goal.store(state, 0);
        let is_shown = arm.holds.load(state) != 0 && ending != Ending::WithItemUnseen;
        arm.shown.store(state, i32::from(is_shown));
    }
    if let Some(route) = &plant.route {
        if has_moved {
            route.at.store(state, route.goal.load(state));
        }
        route.goal.store(state, route.at.load(state));
    }
    if let Some(lane) = &plant.lane {
        let after = match (lane.motion.load(state), has_moved) {
            (motion::STARTS, true) | (motion::STOPS, false) => motion::RUNS,
            (motion::STARTS, false) | (motion::STOPS, true) => motion::STANDS,
            (other, _) => other,
        };
        lane.motion.store(state, after);
    }
    head.status.store(state, if error == 0 { status::DONE } else { status::FAILED });
    head.command.store(state, 0);
    if let Some(port) = head.error {
        port.store(state, error);
    }
}

fn take(model: &Model, state: &mut [u8], arm: &Arm, found: surface::Found) {
    arm.holds.store(state, found.kind as i32 + 1);
    arm.shown.store(state, 1);
    match found.at {
        Landing::Slot { machine, place, slot } => {
            let place = &model.machines[machine].places[place];
            let item = place.items[slot];
            let held = item.load(state);
            // Of too many there are still too many.
            let left = if !place.by_kind {
                0
            } else if held == place.most {
                held
            } else {
                held - 1
            };
            item.store(state, left);
        }
        Landing::Zone { machine, zone } => forget(model, state, machine, zone, found.kind),
        Landing::Beside { .. } | Landing::Elsewhere => {}
    }
}

/// An item of this kind has come or gone: whether one is seen is open, in all fields that share a part of this one.
fn forget(model: &Model, state: &mut [u8], machine: usize, zone: usize, kind: usize) {
    let Some(lane) = &model.machines[machine].lane else { return };
    let Some(own) = lane.zones.get(zone) else { return };
    for zone in lane.zones.iter().filter(|zone| zone.overlaps(own)) {
        if let Some(input) = zone.sees[kind] {
            model.inputs[input].var.store(state, 0);
        }
    }
}

/// What stands for several items beside the slots of a place, or for one that may have come to lie there.
pub(crate) fn others(model: &Model) -> i32 {
    model.grasps.len() as i32 + 1
}

/// An item comes to lie; onto another one, it falls off.
pub(crate) fn land(model: &Model, state: &mut [u8], landing: Landing, kind: usize) {
    match landing {
        Landing::Slot { machine, place, slot } => {
            let place = &model.machines[machine].places[place];
            let item = place.items[slot];
            let held = item.load(state);
            if place.by_kind {
                item.store(state, (held + 1).min(place.most));
            } else if held == 0 {
                item.store(state, kind as i32 + 1);
            } else if let Some(stray) = place.stray {
                stray.store(state, others(model));
            }
        }
        Landing::Beside { machine, place } => {
            if let Some(stray) = model.machines[machine].places[place].stray {
                let is_first = stray.load(state) == 0;
                stray.store(state, if is_first { kind as i32 + 1 } else { others(model) });
            }
        }
        Landing::Zone { machine, zone } => forget(model, state, machine, zone, kind),
        Landing::Elsewhere => {}
    }
}

fn open(model: &Model, state: &mut [u8], plant: &Machine) {
    let Some(desk) = &plant.desk else { return };
    loop {
        let next = desk.next.load(state);
        let Some(order) = desk.orders.get(next as usize) else {
            desk.phase.store(state, phase::BARE);
            return;
        };
        desk.next.store(state, next + 1);
        if model.orders[*order].made.load(state) == 0 {
            desk.order.store(state, *order as i32);
            desk.phase.store(state, phase::OPEN);
            return;
        }
    }
}

/// The place where a goal of a vehicle is a stop, else the goal.
pub(crate) fn stop(stops: &[Point], tolerance: f64, goal: Point) -> Point {
    let near = |stop: &&Point| {
        let gap = [0, 1, 2].map(|axis| stop[axis] - goal[axis]);
        gap.iter().map(|c| c * c).sum::<f64>().sqrt() <= tolerance
    };
    stops.iter().find(near).copied().unwrap_or(goal)
}

/// The machines of these events, a bit each, of which there are less than 64.
pub(crate) fn machines_of(events: &[Event]) -> u64 {
    events.iter().fold(0, |machines, event| machines | 1_u64 << (event.machine % 64))
}
