//! A device at a place of the layout.

use super::evaluate::{Environment, Heights, Values, Wrong};
use super::program::Symbol;
use super::{Device, Form, Parameter};
use crate::diagnostic::{Diagnostic, sort};
use crate::source::Span;
use crate::spec::ast;
use runtime_sim::frame::Frame;
use runtime_sim::kinematics::arm::Arm;
use runtime_sim::kinematics::facing::Facing;
use runtime_sim::machine::Machine;
use runtime_sim::part::axis::Motion;
use runtime_sim::part::lane::CentreLine;
use runtime_sim::part::{Part, Primitive, Settings};
use runtime_sim::point::Point;
use runtime_sim::value::Value;
use std::cell::Cell;
use std::sync::Arc;

/// A device with what the layout gives one machine.
#[derive(Clone, Debug)]
pub struct Placed {
    pub device: Arc<Device>,
    pub pose: Frame,
    /// Of each parameter of the device, in its order.
    pub arguments: Vec<Value>,
}

/// A place at which an item changes hands. The point is where the item's underside rests.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Place<'a> {
    pub point: Point,
    /// Where the tool points there.
    pub facing: Facing,
    title: &'a str,
    number: usize,
    index: Option<usize>,
}

impl Place<'_> {
    /// For reports, such as `slot 3 at stops[0]`.
    pub fn name(&self, kinds: &[(String, f64)]) -> String {
        let index = self.index.map_or(String::new(), |index| index.to_string());
        let kind = kinds.get(self.number).map_or("", |(kind, _)| kind.as_str());
        let title = self.title.replace("{index}", &index).replace("{kind}", kind);
        title.replace("{number}", &self.number.to_string())
    }
}

/// A requirement of a device that a machine does not meet.
#[derive(Clone, Debug, PartialEq)]
pub struct Unmet {
    pub parameters: Vec<String>,
    pub text: String,
    pub place: Span,
}

impl Placed {
    fn environment<'a>(&'a self, heights: &'a [Heights], index: Option<usize>) -> Environment<'a> {
        Environment {
            program: &self.device.program,
            pose: Some(self.pose),
            arguments: &self.arguments,
            heights: Some(heights),
            index,
            values: Values::OfMachine,
            left: Cell::default(),
        }
    }

    /// The machine as the simulator takes it, without an automaton, and the values of the constants of its device,
    /// flattened. `place` is where the layout describes it; `heights` are those of the kinds.
    pub fn machine(
        &self,
        name: &str,
        heights: &[Heights],
        place: Span,
    ) -> Result<(Machine, Vec<Vec<f64>>), Vec<Diagnostic>> {
        let mut diagnostics = Vec::new();
        let all: Vec<usize> = (0..self.device.program.parts.len()).collect();
        let parts = self.some(&all, heights, place, &mut diagnostics);
        let constants = self.constants(heights, place, &mut diagnostics);
        diagnostics.extend(self.wrong_directions(place));
        if !diagnostics.is_empty() {
            sort(&mut diagnostics);
            return Err(diagnostics);
        }
        let machine = Machine {
            name: name.into(),
            pose: self.pose.position,
            parts: parts.into_iter().map(|(_, part)| part).collect(),
            wiring: self.device.wiring.clone(),
            states: Vec::new(),
            monitor: Default::default(),
            visits: None,
        };
        match machine.check() {
            Ok(()) => Ok((machine, constants)),
            Err(misfit) => {
                let message = format!("`{name}` cannot be built from its device: {}", misfit.reason);
                let diagnostic = match misfit.part.and_then(|part| self.device.place_of(part)) {
                    Some(part) => Diagnostic::new("E0711", part, message).other(place, "for this machine"),
                    None => Diagnostic::new("E0711", place, message).other(self.device.place, "the device"),
                };
                Err(vec![diagnostic.help(misfit.fix)])
            }
        }
    }

    /// Parts by their numbers, as far as they are right.
    fn some(
        &self,
        numbers: &[usize],
        heights: &[Heights],
        place: Span,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<(usize, Arc<Part>)> {
        let environment = self.environment(heights, None);
        let mut parts = Vec::new();
        for number in numbers {
            let part = &self.device.program.parts[*number];
            if let Some(known) = &part.known {
                parts.push((*number, known.clone()));
                continue;
            }
            let mut settings = Vec::with_capacity(part.settings.len());
            let before = diagnostics.len();
            for given in &part.settings {
                let Some(setting) = part.schema.setting(&given.name.value) else { continue };
                match environment.setting(part, setting, given) {
                    Ok(value) => settings.push((setting.name, value)),
                    Err(found) => diagnostics.push(found.other(place, "for this machine")),
                }
            }
            if diagnostics.len() > before {
                continue;
            }
            match Part::new(&part.name.value, part.schema.name, Settings::new(settings)) {
                Ok(part) => parts.push((*number, Arc::new(part))),
                Err(error) => diagnostics.push(
                    Diagnostic::new("E0704", part.name.span, error)
                        .other(place, "for this machine")
                        .help("correct the setting, or the values of the machine in the layout"),
                ),
            }
        }
        parts
    }

    /// The values of the constants of the device, flattened; those that are not of their types are reported: generated
    /// code relies on them.
    fn constants(
        &self,
        heights: &[Heights],
        place: Span,
        diagnostics: &mut Vec<Diagnostic>,
    ) -> Vec<Vec<f64>> {
        let environment = self.environment(heights, None);
        let constants = self.device.constants.iter().map(|constant| {
            let mut words = Vec::new();
            let Some(expression) = self.expression(&constant.name) else { return words };
            match environment.value(0, expression) {
                Ok(value) => {
                    if let Some(reason) = constant.refuses(&value, heights.len()) {
                        let message = format!("`{}` of {} {reason}", constant.name, self.device.name);
                        let wrong = Diagnostic::new("E0709", place, message).other(self.device.place, "the device");
                        diagnostics.push(wrong.help(
                            "change the device, the scenario's kinds, or the values of the machine in the layout",
                        ));
                    }
                    flatten(&value, &mut words);
                    words.truncate(constant.ty.words() * constant.extent.elements(heights.len()));
                }
                Err(found) => diagnostics.push(found.other(place, "for this machine")),
            }
            words
        });
        constants.collect()
    }

    fn expression(&self, name: &str) -> Option<&ast::Expr> {
        match self.device.program.scopes.first()?.names.get(name)? {
            Symbol::Define(expr) => Some(expr),
            _ => None,
        }
    }

    /// Requirements of the device that do not hold: the parameters that each is about, what is wrong, and where it
    /// stands.
    pub fn unmet(&self) -> Result<Vec<Unmet>, Wrong> {
        let environment = self.environment(&[], None);
        let mut unmet = Vec::new();
        for require in &self.device.program.requires {
            if environment.value(0, &require.condition)? == Value::Truth(true) {
                continue;
            }
            let text = require.text.iter().map(|part| match part {
                ast::TextPart::Words(words) => words.clone(),
                ast::TextPart::Value(expr) => shown(environment.value(0, expr)),
            });
            let named =
                |parameter: &&Parameter| super::program::mentions(&require.condition, &parameter.name);
            let parameters = self.device.parameters.iter().filter(named).map(|p| p.name.clone());
            unmet.push(Unmet { parameters: parameters.collect(), text: text.collect(), place: require.span });
        }
        Ok(unmet)
    }

    /// The parts of some primitives, as far as they are right.
    fn parts_of(&self, primitives: &[&str]) -> Vec<(usize, Arc<Part>)> {
        let all = self.device.program.parts.iter().enumerate();
        let wanted = all.filter(|(_, part)| primitives.contains(&part.schema.name)).map(|(i, _)| i);
        self.some(&wanted.collect::<Vec<_>>(), &[], self.device.place, &mut Vec::new())
    }

    /// The names and the centre lines of its lanes, on a carriage at its inner end, as far as they are right.
    pub fn lanes(&self) -> Vec<(String, CentreLine)> {
        let parts = self.parts_of(&["lane"]);
        let lane = |(_, part): (usize, Arc<Part>)| match &part.primitive {
            Primitive::Lane(lane) => Some((part.name.clone(), lane.centre_line)),
            _ => None,
        };
        parts.into_iter().filter_map(lane).collect()
    }

    /// What is wrong with its lanes; `place` is where the layout describes the machine.
    pub fn wrong_lanes(&self, place: Span) -> Vec<Diagnostic> {
        let lanes: Vec<usize> = self.device.parts_called("lane").map(|(number, _)| number).collect();
        let mut found = Vec::new();
        self.some(&lanes, &[], place, &mut found);
        found
    }

    /// None for a machine without a chain.
    pub fn arm(&self) -> Option<Arm> {
        let parts = self.parts_of(&["axis", "chain"]);
        let chain = parts.iter().find_map(|(_, part)| match &part.primitive {
            Primitive::Chain(chain) => Some(chain),
            _ => None,
        })?;
        let axis = |wanted: usize| parts.iter().find(|(number, _)| *number == wanted)?.1.axis();
        let axes: Vec<_> = chain.carriers(axis).into_iter().map(|(_, axis)| axis).collect();
        Arm::new(&axes, chain)
    }

    /// Where it may be, and where its axes bring it: the lower and the upper end of x and of y.
    pub fn ground(&self) -> [[f64; 2]; 2] {
        let at = |value: f64| [value, value];
        let mut ground = [at(self.pose.position.x), at(self.pose.position.y)];
        let with = |[low, high]: [f64; 2], value: f64| [low.min(value), high.max(value)];
        let arm = self.arm();
        if let Some(robot) = arm.as_ref().and_then(|arm| arm.cartesian()) {
            for point in robot.ground() {
                ground = [with(ground[0], point.x), with(ground[1], point.y)];
            }
            return ground;
        }
        if let Some([from, to]) = arm.as_ref().and_then(|arm| arm.riding()) {
            return [[from.x.min(to.x), from.x.max(to.x)], [from.y.min(to.y), from.y.max(to.y)]];
        }
        for (_, part) in self.parts_of(&["axis", "route", "track"]) {
            match &part.primitive {
                Primitive::Axis(axis) => {
                    if let Motion::Slides { along, range } = axis.motion
                        && let Some(along) = along.level()
                    {
                        ground[along as usize] = range;
                    }
                }
                Primitive::Route(route) => {
                    for stop in &route.stops {
                        ground = [with(ground[0], stop.x), with(ground[1], stop.y)];
                    }
                }
                Primitive::Track(track) => {
                    for corner in track.corners() {
                        ground = [with(ground[0], corner.x), with(ground[1], corner.y)];
                    }
                }
                _ => {}
            }
        }
        ground
    }

    /// The places of a handover that a type names, such as `stops[0]`, `pick_zone` or `places`. Of places with
    /// numbers only the first `capacity` count; those for kinds are as many as there are kinds.
    /// `None` if this device has no such handover.
    pub fn handover(
        &self,
        name: &str,
        index: Option<usize>,
        capacity: usize,
        kinds: usize,
    ) -> Option<Vec<Place<'_>>> {
        let place = self.device.program.places.iter().find(|place| place.name.value == name)?;
        let environment = self.environment(&[], index);
        // A direction that is none has been reported.
        let facing = self.facing(place, &environment).ok().unwrap_or_default();
        let mut places = Vec::new();
        for (expr, title) in &place.points {
            let title = title.value.as_str();
            let named = |number: usize, point: Point| Place { point, facing, title, number, index };
            match environment.value(0, expr).ok()? {
                Value::Point(point) => places.push(named(0, point)),
                Value::List(points) => {
                    let count = if title.contains("{kind}") {
                        kinds
                    } else if title.contains("{number}") {
                        capacity
                    } else {
                        usize::MAX
                    };
                    for (number, point) in points.into_iter().enumerate().take(count) {
                        let Value::Point(point) = point else { return None };
                        places.push(named(number, point));
                    }
                }
                _ => return None,
            }
        }
        Some(places)
    }

    fn facing(&self, place: &ast::Place, environment: &Environment) -> Result<Facing, Wrong> {
        let Some(toward) = &place.toward else { return Ok(Facing::Down) };
        let found = match environment.value(0, toward)? {
            Value::Point(direction) => Facing::new(direction),
            _ => None,
        };
        let message = "this direction is neither down nor level";
        found.ok_or_else(|| {
            Diagnostic::new("E0709", toward.span, message)
                .help("write `point(0, 0, -1)`, or a direction with z = 0, such as `point(1, 0, 0)`")
                .into()
        })
    }

    /// Directions of places that a tool cannot have.
    fn wrong_directions(&self, place: Span) -> Vec<Diagnostic> {
        let mut found = Vec::new();
        for handover in &self.device.program.places {
            let count = match handover.extent {
                Some(ast::Expr { kind: ast::ExprKind::Int(count), .. }) => {
                    usize::try_from(count).unwrap_or(0)
                }
                _ => 1,
            };
            let index = |number: usize| handover.extent.as_ref().map(|_| number);
            let wrong = (0..count)
                .find_map(|number| self.facing(handover, &self.environment(&[], index(number))).err());
            found.extend(wrong.map(|wrong| wrong.other(place, "for this machine")));
        }
        found
    }

    /// Every number by its path among the keys of the JSON object, such as `pose[0]` or `destinations[0][1]`.
    pub fn numbers(&self) -> Vec<(String, f64)> {
        let Point { x, y, z } = self.pose.position;
        let pose = [x, y, z].into_iter().enumerate().map(|(i, value)| (format!("pose[{i}]"), value));
        let mut found: Vec<(String, f64)> = pose.collect();
        let own = |parameter: &&Parameter| parameter.has_numbers();
        let all = self.device.parameters.iter().zip(&self.arguments);
        for (parameter, value) in all.filter(|(parameter, _)| own(parameter)) {
            collect(&parameter.name, value, &mut found);
        }
        found
    }

    /// The same machine with another value of one number, by its place in [`Self::numbers`]; none if it has no such
    /// number, or a range would lose its order.
    pub fn with_number(&self, number: usize, value: f64) -> Option<Placed> {
        let mut changed = self.clone();
        let mut left = number;
        let Point { x, y, z } = &mut changed.pose.position;
        match [x, y, z].into_iter().nth(number) {
            Some(coordinate) => *coordinate = value,
            None => {
                left -= 3;
                let all = self.device.parameters.iter().zip(&mut changed.arguments);
                let mut arguments =
                    all.filter(|(parameter, _)| parameter.has_numbers()).map(|(_, value)| value);
                arguments.find_map(|argument| nth(argument, &mut left)).map(|place| *place = value)?;
            }
        }
        let ranges = self.device.parameters.iter().zip(&changed.arguments);
        let mut ranges = ranges.filter(|(parameter, _)| parameter.form == Form::Range);
        let in_order = ranges.all(|(_, value)| match value {
            Value::List(ends) => matches!(ends[..], [Value::Number(low), Value::Number(high)] if low < high),
            _ => false,
        });
        (value.is_finite() && in_order).then_some(changed)
    }
}

fn collect(path: &str, value: &Value, found: &mut Vec<(String, f64)>) {
    match value {
        Value::Number(number) => found.push((path.to_string(), *number)),
        Value::Point(Point { x, y, z }) => {
            found
                .extend([x, y, z].into_iter().enumerate().map(|(i, value)| (format!("{path}[{i}]"), *value)));
        }
        Value::List(values) => {
            for (i, value) in values.iter().enumerate() {
                collect(&format!("{path}[{i}]"), value, found);
            }
        }
        _ => {}
    }
}

/// The number that is so many behind the first; what is passed is counted off.
fn nth<'a>(value: &'a mut Value, left: &mut usize) -> Option<&'a mut f64> {
    match value {
        Value::Number(number) if *left == 0 => Some(number),
        Value::Number(_) => {
            *left -= 1;
            None
        }
        Value::Point(Point { x, y, z }) => {
            let found = [x, y, z].into_iter().nth(*left);
            if found.is_none() {
                *left -= 3;
            }
            found
        }
        Value::List(values) => values.iter_mut().find_map(|value| nth(value, left)),
        _ => None,
    }
}

fn flatten(value: &Value, words: &mut Vec<f64>) {
    match value {
        Value::Number(number) => words.push(*number),
        Value::Truth(truth) => words.push(f64::from(u8::from(*truth))),
        Value::Point(point) => words.extend([point.x, point.y, point.z]),
        Value::List(values) => values.iter().for_each(|value| flatten(value, words)),
        _ => {}
    }
}

fn shown(value: Result<Value, Wrong>) -> String {
    match value {
        Ok(Value::Number(number)) => format!("{number:.3}"),
        Ok(Value::Point(Point { x, y, z })) => format!("({x:.3}, {y:.3}, {z:.3})"),
        _ => "?".into(),
    }
}
