//! Where a machine is and goes, with the locks that it has there.

use super::few::around;
use super::holder::{Holder, lender, owner};
use super::lock::{self, Lock};
use super::region::{self, Bound, Given, Region, Regions, rows_of_local};
use super::stage::{Corner, Corners, Places, Stage};
use crate::ir::{Asking, Automaton, Expr, ExprKind, Place, Scalar, StateId, System, Transition, UpdateKind};
use crate::source::Span;
use runtime_sim::collision::{BoundingBox, Moving, Path};
use runtime_sim::device::Direction;
use runtime_sim::kinematics::facing::Facing;
use runtime_sim::line::Line;
use runtime_sim::machine::Machine;
use runtime_sim::part::{Primitive, chain};
use runtime_sim::point::Point;
use runtime_sim::wiring::Source;
use rustc_hash::FxHashMap;
use std::cmp::Ordering;
use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};
use std::f64::consts::{FRAC_PI_4, TAU};
use std::rc::Rc;

/// Choices of the machines that one works with.
const MOST_BOUND: usize = 64;
/// Paths of one machine.
const MOST_PATHS: usize = 4000;
/// Between two turns of a tool of which it is not known which ones it has, rad.
const APART: f64 = FRAC_PI_4;

/// A path, or a place where the machine stands.
pub struct Stay {
    pub path: Rc<Path>,
    /// The set of instances of which it has a lock all the while, by its number.
    pub locks: usize,
    /// The transition with the command.
    pub place: Span,
}

pub enum Range {
    /// The goal of the command there is not known.
    Whole(BoundingBox, Span),
    Stays(Stays),
}

pub struct Stays {
    pub all: Vec<Stay>,
    pub bounds: BoundingBox,
    /// The sets of instances, each in layout order.
    locks: Vec<Vec<usize>>,
}

impl Stays {
    /// For each set of locks of one machine and each of another one, whether no instance is in both.
    pub fn without_common_lock(&self, other: &Self) -> Vec<Vec<bool>> {
        let with = |set: &Vec<usize>| other.locks.iter().map(|next| is_disjoint(set, next)).collect();
        self.locks.iter().map(with).collect()
    }
}

/// Both ascend.
fn is_disjoint(a: &[usize], b: &[usize]) -> bool {
    let (mut a, mut b) = (a, b);
    while let ([first, left @ ..], [second, right @ ..]) = (a, b) {
        match first.cmp(second) {
            Ordering::Less => a = left,
            Ordering::Greater => b = right,
            Ordering::Equal => return false,
        }
    }
    true
}

/// Where a machine goes past, one after the other.
type Stages = Vec<Stage>;

/// Of one motion, for all bounds that answer alike.
struct Evaluated {
    asked: BTreeSet<(usize, Option<usize>)>,
    stages: Option<Rc<Stages>>,
}

/// A command that moves the machine; several for a tool of which not exactly one turn is known.
pub(super) struct Motion<'a> {
    state: usize,
    pub(super) transition: &'a Transition,
    /// Where the command is written.
    place: Span,
    /// The places past which it goes, and the last one.
    pub(super) goals: Vec<(&'a Expr, Facing)>,
    /// The locals by which it reads places of other machines.
    named: BTreeSet<usize>,
}

pub fn range(given: &Given, instance: usize, moving: &Moving) -> Range {
    let Given { system, line, .. } = *given;
    let automaton = system.automaton_of(instance);
    let motions = motions(given, instance);
    let from = origins(automaton, &motions);
    let held = lock::held(system, automaton);
    let locks = motions.iter().map(|motion| {
        let target = motion.transition.target.map_or(motion.state, |StateId(target)| target);
        let first = (target, lock::after(system, motion.transition, &held[motion.state]));
        [true, false].map(|goes| held_behind(system, automaton, &motions, first.clone(), goes))
    });
    let locks: Vec<[BTreeSet<Lock>; 2]> = locks.collect();
    let mut places = Places::new(moving);
    let at_rest = Rc::new(vec![places.stage(rest(line, instance).as_slice(), Facing::Down)]);
    let mut known: Vec<Vec<Evaluated>> = motions.iter().map(|_| Vec::new()).collect();
    let mut goals = |number: usize, bound: &Bound| -> Option<Rc<Stages>> {
        let motion = &motions[number];
        let is_same = |of: &&Evaluated| of.asked.iter().all(|(local, row)| bound.row(*local) == *row);
        if let Some(evaluated) = known[number].iter().find(is_same) {
            return evaluated.stages.clone();
        }
        let bound = Bound::new(bound.rows.clone());
        let regions = Regions::new(given, instance, &bound, motion.transition);
        let stages =
            motion.goals.iter().map(|(goal, facing)| Some(places.stage(&regions.points(goal)?, *facing)));
        let stages = stages.collect::<Option<Stages>>().map(Rc::new);
        known[number].push(Evaluated { asked: bound.asked(), stages: stages.clone() });
        stages
    };
    let mut found = Found {
        system,
        instance,
        moving,
        stays: Vec::new(),
        paths: FxHashMap::default(),
        key: Vec::new(),
        sets: Sets::default(),
    };
    found.add(&[&at_rest[0]], &BTreeSet::new(), automaton.place);
    // For most bounds goals and locks are those of another one.
    let mut stood: HashSet<(*const Stages, BTreeSet<Holder>)> = HashSet::new();
    let mut gone: HashSet<(Option<*const Stages>, *const Stages, BTreeSet<Holder>)> = HashSet::new();
    for bound in bounds(system, instance) {
        for (number, motion) in motions.iter().enumerate() {
            let place = motion.place;
            let Some(stages) = goals(number, &bound) else {
                return Range::Whole(moving.whole(), place);
            };
            let [going, there] = &locks[number];
            let holders = |locks: &BTreeSet<Lock>| -> BTreeSet<Holder> {
                locks.iter().map(|lock| owner(system, instance, &bound, lock)).collect()
            };
            // A machine that offers its places and locks itself has its lock for whoever comes.
            let lent = |motion: &Motion, bound: &Bound| -> BTreeSet<Holder> {
                motion.named.iter().filter_map(|local| lender(system, instance, bound, *local)).collect()
            };
            let here = lent(motion, &bound);
            let (on_the_path, at_the_goal) = (&holders(going) | &here, &holders(there) | &here);
            if stood.insert((Rc::as_ptr(&stages), at_the_goal.clone())) {
                found.add(&[&stages[stages.len() - 1]], &at_the_goal, place);
            }
            let chosen = lock::chosen(motion.transition);
            let mut before = bound.clone();
            before.rows.retain(|(local, _)| !chosen.contains(local));
            for origin in &from[number] {
                let (begin, there) = match origin {
                    None => (Some(at_rest.clone()), BTreeSet::new()),
                    Some(origin) => (goals(*origin, &before), lent(&motions[*origin], &before)),
                };
                let held = &on_the_path | &there;
                if gone.insert((begin.as_ref().map(Rc::as_ptr), Rc::as_ptr(&stages), held.clone())) {
                    let begin = begin.as_ref().and_then(|stages| stages.last());
                    let passed: Vec<&Stage> = begin.into_iter().chain(stages.iter()).collect();
                    found.add(&passed, &held, place);
                }
            }
        }
    }
    let bounds = found.stays.iter().fold(BoundingBox::NOTHING, |all, stay| all.with(&stay.path.bounds));
    Range::Stays(Stays { all: found.stays, bounds, locks: found.sets.all })
}

struct Found<'a> {
    system: &'a System,
    instance: usize,
    moving: &'a Moving,
    stays: Vec<Stay>,
    /// By the numbers of the corners.
    paths: FxHashMap<Vec<usize>, Known>,
    /// The numbers of the present one.
    key: Vec<usize>,
    sets: Sets,
}

/// Of one machine, past some corners.
struct Known {
    /// None: not all of them are reached.
    path: Option<Rc<Path>>,
    /// With which it goes there, by their numbers.
    locks: BTreeSet<usize>,
}

/// Sets of instances, each once.
#[derive(Default)]
struct Sets {
    all: Vec<Vec<usize>>,
    numbers: HashMap<Vec<usize>, usize>,
    of_holders: HashMap<BTreeSet<Holder>, usize>,
}

impl Sets {
    fn number(&mut self, system: &System, instance: usize, holders: &BTreeSet<Holder>) -> usize {
        if let Some(number) = self.of_holders.get(holders) {
            return *number;
        }
        let mut instances: Vec<usize> =
            holders.iter().flat_map(|holder| holder.instances(system, instance)).collect();
        instances.sort_unstable();
        instances.dedup();
        let number = *self.numbers.entry(instances.clone()).or_insert(self.all.len());
        if number == self.all.len() {
            self.all.push(instances);
        }
        self.of_holders.insert(holders.clone(), number);
        number
    }
}

impl Found<'_> {
    /// The paths from region to region: for each choice of one of each stage, between corners that lie alike, and between
    /// those that lie opposite.
    fn add(&mut self, stages: &[&Stage], holders: &BTreeSet<Holder>, place: Span) {
        if self.stays.len() >= MOST_PATHS {
            return;
        }
        let locks = self.sets.number(self.system, self.instance, holders);
        let choices: usize = stages.iter().map(|stage| stage.regions.len()).product();
        let numbers: &[usize] = if choices == 1 { &[0, 1, 2, 3, 4, 5, 6, 7] } else { &[0, 7] };
        for choice in 0..choices {
            if self.stays.len() >= MOST_PATHS {
                return;
            }
            let regions = chosen(stages, choice);
            // Of places that are known exactly all corners are one.
            let mut known = [false; 64];
            let wide = regions.iter().fold(0, |wide, region| wide | region.wide);
            for &number in numbers {
                for first in [number, 7 - number] {
                    let pair = (number & wide) * 8 + (first & wide);
                    if std::mem::replace(&mut known[pair], true) {
                        continue;
                    }
                    let corners = regions.iter().zip(stages).enumerate().map(|(i, (region, stage))| {
                        (&region.corners[if i == 0 { first } else { number }], stage.facing)
                    });
                    self.path(corners, locks, place);
                }
            }
        }
    }

    fn path<'c>(
        &mut self,
        corners: impl Iterator<Item = (&'c Corner, Facing)> + Clone,
        locks: usize,
        place: Span,
    ) {
        if self.stays.len() >= MOST_PATHS || !corners.clone().all(|(corner, _)| corner.is_reached) {
            return;
        }
        self.key.clear();
        self.key.extend(corners.clone().map(|(corner, _)| corner.number));
        let known = match self.paths.get_mut(&self.key) {
            Some(known) => known,
            None => {
                let goals: Vec<(Point, Facing)> = corners.map(|(at, facing)| (at.point, facing)).collect();
                let path = self.moving.path(&goals).map(Rc::new);
                let known = Known { path, locks: BTreeSet::new() };
                self.paths.entry(self.key.clone()).or_insert(known)
            }
        };
        let Known { path: Some(path), locks: held } = known else { return };
        if held.insert(locks) {
            self.stays.push(Stay { path: path.clone(), locks, place });
        }
    }
}

/// One region of each stage: all choices have a number, and those of the last stage follow one another.
fn chosen<'a>(stages: &[&'a Stage], choice: usize) -> Vec<&'a Corners> {
    let mut left = choice;
    let mut regions: Vec<&Corners> = Vec::with_capacity(stages.len());
    for stage in stages.iter().rev() {
        regions.push(&stage.regions[left % stage.regions.len()]);
        left /= stage.regions.len();
    }
    regions.reverse();
    regions
}

pub(super) fn motions<'a>(given: &Given<'a>, instance: usize) -> Vec<Motion<'a>> {
    let Given { system, line, .. } = *given;
    let automaton = system.automaton_of(instance);
    let machine = &line.machines[instance];
    let tool_ports = tool_ports(automaton, machine);
    let asks_tool = (!tool_ports.is_empty()).then(|| asking_tool(automaton, &tool_ports));
    let mut motions = Vec::new();
    for (state, transition) in
        automaton.states.iter().enumerate().flat_map(|(n, s)| s.transitions.iter().map(move |t| (n, t)))
    {
        for update in &transition.updates {
            let UpdateKind::Command { verb, arguments } = &update.kind else { continue };
            let Some(command) = machine.wiring.commands.iter().find(|command| command.number == *verb) else {
                continue;
            };
            let part = &machine.parts[command.part];
            if !matches!(part.primitive, Primitive::Chain(_) | Primitive::Route(_)) {
                continue;
            }
            let of_type = |ty: Scalar| {
                arguments.iter().map(|argument| &argument.value).filter(move |value| value.ty == ty)
            };
            let points = of_type(Scalar::Point);
            let bound = Bound::default();
            let regions = Regions::new(given, instance, &bound, transition);
            let turned: Vec<Vec<(&Expr, Facing)>> = match part.schema().actions[command.action].name {
                "facing" => {
                    let points: Vec<&Expr> = points.collect();
                    let [goal, direction] = points[..] else { continue };
                    let ahead = regions.points(direction).as_deref().and_then(middle).and_then(Facing::new);
                    vec![vec![(goal, ahead.unwrap_or_default())]]
                }
                chain::ORIENTED => {
                    let turn = of_type(Scalar::Real).next().and_then(|turn| regions.span(turn));
                    let turns = turns(turn).into_iter().filter_map(Facing::oriented);
                    let points: Vec<&Expr> = points.collect();
                    turns.map(|facing| points.iter().map(|point| (*point, facing)).collect()).collect()
                }
                _ => vec![points.map(|point| (point, Facing::Down)).collect()],
            };
            // Up from where it is, or the like: it stays about there.
            let is_by_tool = |goal: &Expr| asks_tool.as_ref().is_some_and(|asks| asks.expression(goal));
            for goals in turned {
                if !goals.is_empty() && !goals.iter().any(|(goal, _)| is_by_tool(goal)) {
                    let mut named = BTreeSet::new();
                    goals.iter().for_each(|(goal, _)| names(automaton, goal, &mut named));
                    motions.push(Motion { state, transition, place: update.place, goals, named });
                }
            }
        }
    }
    motions
}

/// Turns of a tool that are between these, this far apart at most, rad; all round if that is not known, or is more.
fn turns(span: Option<region::Span>) -> Vec<f64> {
    let [low, high] = span.filter(|[low, high]| high - low < TAU).unwrap_or([0.0, TAU]);
    let steps = ((high - low) / APART).ceil();
    (0..=steps as u32).map(|step| low + (high - low) * f64::from(step) / steps.max(1.0)).collect()
}

/// Expressions that read where the machine is by one of these ports, or a local that keeps where it was.
fn asking_tool(automaton: &Automaton, tool_ports: &[usize]) -> Asking<impl Fn(&ExprKind) -> bool> {
    let is_tool = |kind: &ExprKind| matches!(kind, ExprKind::Read(Place::Port { port, .. }) if tool_ports.contains(port));
    let asks = Asking::new(automaton, is_tool);
    let transitions = automaton.states.iter().flat_map(|state| &state.transitions);
    let kept =
        transitions.flat_map(|transition| &transition.updates).filter_map(|update| match &update.kind {
            UpdateKind::Assign { target, value, .. } if asks.expression(value) => match target.place {
                Place::Local { local, .. } => Some(local),
                _ => None,
            },
            _ => None,
        });
    let kept: BTreeSet<usize> = kept.collect();
    Asking::new(automaton, move |kind| match kind {
        ExprKind::Read(Place::Local { local, .. }) => kept.contains(local),
        kind => is_tool(kind),
    })
}

/// The ports that show where the machine is.
fn tool_ports(automaton: &Automaton, machine: &Machine) -> Vec<usize> {
    let is_tool = |source: &Source| match *source {
        Source::Signal { part, signal } => {
            let schema = machine.parts[part].schema();
            schema.name == "chain" && schema.signals[signal].name == "tool"
        }
        _ => false,
    };
    let ports = automaton.device.ports.iter().enumerate();
    let inputs = ports.filter(|(_, port)| port.direction == Direction::Input);
    let shown = inputs.zip(&machine.wiring.inputs).filter(|(_, input)| is_tool(&input.source));
    shown.map(|((port, _), _)| port).collect()
}

fn names(automaton: &Automaton, expr: &Expr, found: &mut BTreeSet<usize>) {
    match &expr.kind {
        ExprKind::Define(define) => names(automaton, &automaton.defines[*define].value, found),
        ExprKind::Read(Place::Local { local, .. }) if matches!(expr.ty, Scalar::Ref(_)) => {
            found.insert(*local);
        }
        _ => expr.parts().for_each(|part| names(automaton, part, found)),
    }
}

fn middle(regions: &[Region]) -> Option<Point> {
    let [x, y, z] = around(regions)?.map(|[low, high]| (low + high) / 2.0);
    Some(Point::new(x, y, z))
}

/// Of each motion those whose goals the machine is at, or on its way to, when it begins; none: it is at rest.
fn origins(automaton: &Automaton, motions: &[Motion]) -> Vec<BTreeSet<Option<usize>>> {
    let mut at: Vec<BTreeSet<Option<usize>>> = vec![BTreeSet::new(); automaton.states.len()];
    at[0].insert(None);
    let mut has_changed = true;
    while std::mem::take(&mut has_changed) {
        for (number, state) in automaton.states.iter().enumerate() {
            for transition in &state.transitions {
                let target = transition.target.map_or(number, |StateId(target)| target);
                let here = motions.iter().enumerate();
                let here = here.filter(|(_, motion)| std::ptr::eq(motion.transition, transition));
                let mut after: BTreeSet<Option<usize>> = here.map(|(motion, _)| Some(motion)).collect();
                if after.is_empty() {
                    after.clone_from(&at[number]);
                }
                let before = at[target].len();
                at[target].extend(after);
                has_changed |= at[target].len() > before;
            }
        }
    }
    motions.iter().map(|motion| at[motion.state].clone()).collect()
}

/// The locks that a machine has in all states that can follow before the next motion, and before this one has ended if it
/// `goes`. It has the given ones in the first of these.
fn held_behind(
    system: &System,
    automaton: &Automaton,
    motions: &[Motion],
    first: (usize, BTreeSet<Lock>),
    goes: bool,
) -> BTreeSet<Lock> {
    let done = Asking::new(automaton, |kind| *kind == ExprKind::Done);
    let mut held: BTreeMap<usize, BTreeSet<Lock>> = BTreeMap::new();
    let mut open = vec![first];
    while let Some((state, locks)) = open.pop() {
        let all = held.get(&state).map_or_else(|| locks.clone(), |known| known & &locks);
        if held.insert(state, all.clone()).as_ref() == Some(&all) {
            continue;
        }
        for transition in &automaton.states[state].transitions {
            let moves = motions.iter().any(|motion| std::ptr::eq(motion.transition, transition));
            let ends = goes && done.guard(transition);
            if !moves && !ends {
                let target = transition.target.map_or(state, |StateId(target)| target);
                open.push((target, lock::after(system, transition, &all)));
            }
        }
    }
    held.into_values().reduce(|a, b| &a & &b).unwrap_or_default()
}

/// All choices of the machines that the locals of an instance name.
fn bounds(system: &System, instance: usize) -> Vec<Bound> {
    let locals = &system.automaton_of(instance).locals;
    let names = locals.iter().enumerate().filter(|(_, local)| matches!(local.ty.scalar, Scalar::Ref(_)));
    let mut all = vec![Bound::default()];
    for (local, _) in names {
        let rows = rows_of_local(system, instance, local);
        if rows.is_empty() || all.len() * rows.len() > MOST_BOUND {
            continue;
        }
        let with = |bound: &Bound| -> Vec<Bound> {
            let also = rows.iter().map(|row| {
                let mut bound = bound.clone();
                bound.rows.push((local, *row));
                bound
            });
            also.collect()
        };
        all = all.iter().flat_map(with).collect();
    }
    all
}

/// Where the machine is before its first motion.
fn rest(line: &Line, instance: usize) -> Option<Region> {
    let machine = &line.machines[instance];
    let point = machine.chain().map(|chain| chain.rest).or_else(|| machine.stops().first().copied())?;
    Some([point.x, point.y, point.z].map(|value| [value, value]))
}
