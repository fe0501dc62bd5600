//! A machine of a line: the parts of its device with their settings, and how its I/O is wired to them.

mod on_lanes;

use crate::device::PortType;
use crate::frame::Frame;
use crate::kinematics::arm::Arm;
use crate::kinematics::facing::Facing;
use crate::line::State;
use crate::monitor::Monitor;
use crate::part::axis::Axis;
use crate::part::chain::Chain;
use crate::part::lane::{self, Lane};
use crate::part::place::Place;
use crate::part::process::Process;
use crate::part::route::Route;
use crate::part::stroke::{Stroke, Strokes};
use crate::part::track::Track;
use crate::part::{Form, Part, Primitive};
use crate::point::Point;
use crate::value::Value;
use crate::wiring::{Drives, Output, Source, Wiring};
use std::borrow::Cow;
use std::collections::HashSet;
use std::sync::Arc;

#[derive(Clone, Debug, PartialEq)]
pub struct Machine {
    pub name: String,
    /// As the layout gives it.
    pub pose: Point,
    /// A part refers to parts before it only.
    pub parts: Vec<Arc<Part>>,
    pub wiring: Arc<Wiring>,
    /// States of its automaton; empty if it has none.
    pub states: Vec<State>,
    pub monitor: Monitor,
    /// Numbers of the stops of its route at which it can be, the start among them, in ascending order; none: at any.
    pub visits: Option<Vec<usize>>,
}

/// Elements of a port or a constant.
pub const MOST_ELEMENTS: usize = 1024;

/// What is rounded in a length, m.
const ROUNDED: f64 = 1e-6;

/// How to correct most of what does not fit.
const FIX: &str = "change the device, or the values of the machine in the layout";

/// Why parts are no machine.
#[derive(Clone, Debug, PartialEq)]
pub struct Misfit {
    pub reason: String,
    /// The part that does not fit, by its number, if it is one.
    pub part: Option<usize>,
    pub fix: Cow<'static, str>,
}

impl From<&str> for Misfit {
    fn from(reason: &str) -> Self {
        Self { reason: reason.into(), part: None, fix: FIX.into() }
    }
}

impl Misfit {
    fn of(part: usize, reason: impl Into<String>) -> Self {
        Self { reason: reason.into(), part: Some(part), fix: FIX.into() }
    }

    fn fix(self, fix: impl Into<Cow<'static, str>>) -> Self {
        Self { fix: fix.into(), ..self }
    }
}

impl Machine {
    /// Whether both are the same device; what their controllers wait for may differ.
    pub(crate) fn is_same_device(&self, other: &Self) -> bool {
        let Self { name, pose, parts, wiring, states, monitor, visits } = self;
        let of_states = states.iter().zip(&other.states);
        (name, pose, parts, wiring) == (&other.name, &other.pose, &other.parts, &other.wiring)
            && (visits, states.len()) == (&other.visits, other.states.len())
            && of_states.into_iter().all(|(state, other)| {
                state.is_reported_as(other) && state.awaits_answer == other.awaits_answer
            })
            && monitor.has_same_words(&other.monitor)
    }

    /// The first thing that is wrong with its parts or its wiring.
    pub fn check(&self) -> Result<(), Misfit> {
        if !self.pose.is_near() {
            return Err("a coordinate of its pose is no number within 1000 km".into());
        }
        let mut names = HashSet::with_capacity(self.parts.len());
        for (index, part) in self.parts.iter().enumerate() {
            if !names.insert(&part.name) {
                return Err(Misfit::of(index, format!("two parts {}", part.name)));
            }
            self.check_references(index, part).map_err(|reason| Misfit::of(index, reason))?;
            self.check_on_lanes(index)?;
        }
        for (index, part) in self.parts.iter().enumerate() {
            let Primitive::Place(place) = &part.primitive else { continue };
            let strokes = self.strokes_under(place).and_then(|strokes| strokes.stroke);
            let turns = matches!(strokes, Some(Stroke::Turns { .. })) || self.is_on_track(place);
            if place.facing != Facing::Down && turns {
                return Err(Misfit::of(index, "a place that is filled from the side is on what turns"));
            }
        }
        let last = |primitive: &str| self.parts.iter().rposition(|part| part.schema().name == primitive);
        for primitive in ["chain", "route", "track", "source"] {
            if let Some(last) = last(primitive)
                && self.parts[..last].iter().any(|part| part.schema().name == primitive)
            {
                return Err(Misfit::of(last, format!("two parts are a {primitive}")));
            }
        }
        if let (Some(_), Some(track)) = (last("route"), last("track")) {
            return Err(Misfit::of(track, "it moves along a route and along a track"));
        }
        if let (Some(chain), Some(number)) = (self.chain(), last("chain")) {
            let unsolved = "there is no inverse kinematics for its chain on these axes";
            let arm = self.arm().ok_or_else(|| Misfit::of(number, unsolved))?;
            if arm.at_rest(chain.rest).is_none() {
                return Err(Misfit::of(number, "its tool cannot reach its own rest position"));
            }
        }
        self.check_wiring()
    }

    /// By the numbers of their parts.
    pub fn processes(&self) -> impl Iterator<Item = (usize, &Process)> {
        self.parts.iter().enumerate().filter_map(|(number, part)| match &part.primitive {
            Primitive::Process(process) => Some((number, process)),
            _ => None,
        })
    }

    /// Of each word of its inputs, whether it changes while something moves. What a person sets does not.
    pub fn analogue_inputs(&self, kinds: usize) -> Vec<bool> {
        let is_analogue = |source: Source| match source {
            Source::Signal { part, signal } => self
                .parts
                .get(part)
                .map(|part| part.schema())
                .filter(|schema| schema.operated.is_none())
                .and_then(|schema| schema.signals.get(signal))
                .is_some_and(|signal| matches!(signal.ty, PortType::Real | PortType::Point)),
            Source::Ready | Source::Got | Source::Ack | Source::Error => false,
        };
        let inputs = self.wiring.inputs.iter();
        inputs.flat_map(|input| vec![is_analogue(input.source); input.size.words(kinds)]).collect()
    }

    fn check_references(&self, index: usize, part: &Part) -> Result<(), String> {
        for setting in part.schema().settings {
            let (Form::Part(primitives), Some(Value::Part { part: other, frame })) =
                (setting.form, part.settings.get(setting.name))
            else {
                continue;
            };
            let Some(other) = self.parts[..index].get(*other) else {
                return Err(format!("the part {} refers to one that is not before it", part.name));
            };
            let schema = other.schema();
            let is_there = match &other.primitive {
                Primitive::Chain(chain) => chain.link(*frame).is_some(),
                _ => *frame < schema.frames.len().max(1),
            };
            if !primitives.contains(&schema.name) || !is_there {
                return Err(format!("the part {} cannot refer to {}", part.name, other.name));
            }
        }
        Ok(())
    }

    fn check_wiring(&self) -> Result<(), Misfit> {
        let wiring = &self.wiring;
        let schema = |part: usize| self.parts.get(part).map(|part| part.schema());
        let sizes = wiring.inputs.iter().map(|i| i.size).chain(wiring.outputs.iter().map(|o| o.size));
        for size in sizes {
            if !matches!(size.each, 1 | 3) || size.words(1) > MOST_ELEMENTS {
                return Err("a port has no size that it may have".into());
            }
        }
        for input in &wiring.inputs {
            let (expected, is_head) = match input.source {
                Source::Signal { part, signal } => {
                    let signal = schema(part).and_then(|schema| schema.signals.get(signal));
                    let signal = signal.ok_or("an input reads a signal that is not there")?;
                    ((signal.ty.words(), signal.extent), false)
                }
                Source::Ready | Source::Got | Source::Ack | Source::Error => {
                    ((1, crate::device::Extent::One), true)
                }
            };
            if (input.size.each, input.size.extent) != expected || is_head && !wiring.is_commanded() {
                return Err("an input has another size than what it reads".into());
            }
        }
        for output in &wiring.outputs {
            if let Drives::Level { part, level } = output.drives {
                let level = schema(part).and_then(|schema| schema.levels.get(level));
                let level = level.ok_or("an output drives a level that is not there")?;
                if (output.size.each, output.size.words(1)) != (level.ty.words(), level.ty.words()) {
                    return Err("an output has another size than what it drives".into());
                }
            }
        }
        let has = |drives: Drives| wiring.outputs.iter().any(|output| output.drives == drives);
        if wiring.is_commanded() && !(has(Drives::Command) && has(Drives::Verb) && has(Drives::Hold)) {
            return Err("a machine with commands lacks the outputs for them".into());
        }
        self.check_levels()?;
        self.check_lanes()?;
        for command in &wiring.commands {
            let action = schema(command.part).and_then(|schema| schema.actions.get(command.action));
            let action = action.ok_or("a command asks for an action that is not there")?;
            let given: Option<Vec<&Output>> =
                command.arguments.iter().map(|argument| wiring.outputs.get(*argument)).collect();
            let given = given.ok_or("a command has an argument that is not there")?;
            let wanted: usize = action.arguments.iter().map(|ty| ty.words()).sum();
            if given.iter().map(|output| output.size.words(1)).sum::<usize>() != wanted {
                return Err("a command has other arguments than its action".into());
            }
            if let Some(then) = command.then {
                let signal = schema(then.part).and_then(|schema| schema.signals.get(then.signal));
                let is_one = signal.is_some_and(|s| s.ty.words() == 1 && s.extent.elements(2) == 1);
                if !is_one || then.within_ms > 1_000_000_000 {
                    return Err("a command waits for a signal that is not there".into());
                }
            }
        }
        Ok(())
    }

    /// A part that two outputs drive in the same way would obey the last of them.
    fn check_levels(&self) -> Result<(), Misfit> {
        let outputs = &self.wiring.outputs;
        for (number, Output { drives, .. }) in outputs.iter().enumerate() {
            if let Drives::Level { part, level } = *drives
                && outputs[..number].iter().any(|other| other.drives == *drives)
            {
                let Part { name, .. } = &*self.parts[part];
                let level = self.parts[part].schema().levels[level].name;
                return Err(Misfit::of(part, format!("two outputs drive {name}.{level}: take one of them")));
            }
        }
        Ok(())
    }

    /// A lane that runs by its level and by commands would obey whoever came last.
    fn check_lanes(&self) -> Result<(), Misfit> {
        let wiring = &self.wiring;
        let drives = |part: usize| {
            let is_driven = |output: &Output| output.drives == Drives::Level { part, level: lane::RUN };
            wiring.outputs.iter().any(is_driven) && wiring.commands.iter().any(|c| c.part == part)
        };
        let lanes = self.parts.iter().enumerate();
        let mut lanes = lanes.filter(|(_, part)| matches!(part.primitive, Primitive::Lane(_)));
        match lanes.find(|(number, _)| drives(*number)) {
            Some((number, lane)) => {
                let reason = format!("{} is run by an output and by commands: take one of them", lane.name);
                Err(Misfit::of(number, reason))
            }
            None => Ok(()),
        }
    }

    fn first<T>(&self, take: impl Fn(&Primitive) -> Option<&T>) -> Option<&T> {
        self.parts.iter().find_map(|part| take(&part.primitive))
    }

    pub fn chain(&self) -> Option<&Chain> {
        self.first(|primitive| match primitive {
            Primitive::Chain(chain) => Some(chain),
            _ => None,
        })
    }

    pub fn route(&self) -> Option<&Route> {
        self.first(|primitive| match primitive {
            Primitive::Route(route) => Some(route),
            _ => None,
        })
    }

    pub fn track(&self) -> Option<&Track> {
        self.first(|primitive| match primitive {
            Primitive::Track(track) => Some(track),
            _ => None,
        })
    }

    pub fn lane(&self) -> Option<&Lane> {
        self.first(|primitive| match primitive {
            Primitive::Lane(lane) => Some(lane),
            _ => None,
        })
    }

    pub fn lanes(&self) -> impl Iterator<Item = &Lane> {
        self.parts.iter().filter_map(|part| match &part.primitive {
            Primitive::Lane(lane) => Some(lane),
            _ => None,
        })
    }

    pub fn places(&self) -> impl Iterator<Item = &Place> {
        self.parts.iter().filter_map(|part| match &part.primitive {
            Primitive::Place(place) => Some(place),
            _ => None,
        })
    }

    /// Whether one of its parts is of this primitive.
    pub fn has(&self, primitive: &str) -> bool {
        self.parts.iter().any(|part| part.schema().name == primitive)
    }

    /// What reports call a place beside the name of its machine.
    pub fn title(&self, part: usize) -> Option<&str> {
        match &self.parts.get(part)?.primitive {
            Primitive::Place(place) => place.title.as_deref(),
            _ => None,
        }
    }

    /// Whether an order desk serves at this place.
    pub fn is_place_of_orders(&self, part: usize) -> bool {
        self.parts.iter().any(|other| matches!(&other.primitive, Primitive::Orders(o) if o.place == part))
    }

    /// How the cylinder or positioner moves on which a place is.
    pub fn strokes_under(&self, place: &Place) -> Option<Strokes> {
        self.parts.get(place.on?)?.strokes()
    }

    /// Whether a place goes from stop to stop.
    pub fn is_driven(&self, place: &Place) -> bool {
        let carrier = place.on.and_then(|part| self.parts.get(part));
        carrier.is_some_and(|part| matches!(part.primitive, Primitive::Route(_)))
    }

    /// Whether a place is on a vehicle that follows a track.
    pub fn is_on_track(&self, place: &Place) -> bool {
        let carrier = place.on.and_then(|part| self.parts.get(part));
        carrier.is_some_and(|part| matches!(part.primitive, Primitive::Track(_)))
    }

    fn carriers(&self) -> Vec<(usize, &Axis)> {
        let axis = |part: usize| self.parts.get(part).and_then(|part| part.axis());
        self.chain().map_or(Vec::new(), |chain| chain.carriers(axis))
    }

    /// Its chain has no joints but the axes that carry it.
    pub(crate) fn has_only_axes(&self) -> bool {
        self.chain().is_some_and(|chain| chain.joints.is_empty())
    }

    /// The axes that carry the chain, the first one first.
    pub fn axes(&self) -> Vec<&Axis> {
        self.carriers().into_iter().map(|(_, axis)| axis).collect()
    }

    /// The same with the names of their parts.
    pub fn named_axes(&self) -> Vec<(&str, &Axis)> {
        self.carriers().into_iter().map(|(part, axis)| (self.parts[part].name.as_str(), axis)).collect()
    }

    /// Which of the joints of the chain and of the axes that carry it moves with this part.
    pub(crate) fn joint_of(&self, part: usize) -> Option<usize> {
        self.carriers().iter().position(|(axis, _)| *axis == part)
    }

    /// Both ends of the base of its arm, for an arm on a rail that may lie in any direction.
    pub fn riding(&self) -> Option<[Point; 2]> {
        self.arm()?.riding()
    }

    /// None for a machine without a chain, or with one that no closed form fits.
    pub fn arm(&self) -> Option<Arm> {
        Arm::new(&self.axes(), self.chain()?)
    }

    /// Where it is at the start, if it moves as a whole.
    pub fn start(&self) -> Option<Frame> {
        let at_stop = || self.stops().first().map(|stop| Frame::new(*stop, 0.0));
        self.track().map(Track::begin).or_else(at_stop)
    }

    /// Points of the ground between which it moves as a whole: stops of a route, corners of a track.
    pub fn turning_points(&self) -> Vec<Point> {
        self.track().map_or_else(|| self.stops().to_vec(), Track::corners)
    }

    /// All stops, if it goes from stop to stop; the first is where it starts.
    pub fn stops(&self) -> &[Point] {
        self.route().map_or(&[], |route| &route.stops)
    }

    /// Those of them at which it can be.
    pub fn visited(&self) -> Vec<Point> {
        let visits = |number: &usize| self.visits.as_ref().is_none_or(|visits| visits.contains(number));
        let stops = self.stops().iter().enumerate();
        stops.filter(|(number, _)| visits(number)).map(|(_, stop)| *stop).collect()
    }
}
