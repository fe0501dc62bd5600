//! The keys of an object that depend on its device.

use super::decode::{Decoder, find, instead, listing};
use super::json::Json;
use super::object::{self, COMMON_KEYS};
use super::{Number, Object, Part, Routes};
use crate::device::{Device, Form, Parameter, Placed};
use crate::diagnostic::{Diagnostic, sort};
use runtime_sim::frame::Frame;
use runtime_sim::line::Obstacle;
use runtime_sim::point::{Axis, Point};
use runtime_sim::value::Value;
use std::fmt::Display;
use std::sync::Arc;

/// No time that a machine takes is longer, s.
pub const LONGEST_S: f64 = 1e5;

pub const OBSTACLES: [&str; 6] = ["bin", "station", "assembly_station", "collector", "rail", "box"];

/// A machine whose type is bound to a device, at this place.
pub fn machine(
    object: &Object,
    device: &Arc<Device>,
    pose: Frame,
    routes: &[Routes],
) -> Result<Placed, Vec<Diagnostic>> {
    let arguments = arguments(object, device, routes)?;
    turned(object, device, pose)?;
    let placed = Placed { device: device.clone(), pose, arguments };
    unmet(object, &placed)?;
    Ok(placed)
}

/// The numbers of a machine's object that may be changed so that machines meet, those of the pose first.
pub fn numbers(object: &Object, device: &Device) -> Vec<Number> {
    let Point { x, y, z } = object.pose.value.position;
    let of_pose = object.coordinates.iter().zip([x, y, z]).enumerate();
    let of_pose = of_pose.map(|(i, (span, value))| Number { path: format!("pose[{i}]"), value, span: *span });
    let is_changed = |form: &Form| matches!(form, Form::Real | Form::Range | Form::Point | Form::Points(_));
    let keys = device.parameters.iter().filter(|parameter| is_changed(&parameter.form));
    let of_keys = keys.filter_map(|key| Some(object::numbers(find(&object.members, &key.name)?, &key.name)));
    of_pose.chain(of_keys.flatten()).collect()
}

/// Values of the parameters of its device.
pub fn arguments(object: &Object, device: &Device, routes: &[Routes]) -> Result<Vec<Value>, Vec<Diagnostic>> {
    let of_routes = device.parameters.iter().find(|parameter| parameter.form == Form::Routes);
    let key = of_routes.map(|parameter| parameter.name.as_str());
    let mut reader = Reader { object, routes, key, decoder: Decoder::default() };
    let known: Vec<&str> = device.parameters.iter().map(|parameter| parameter.name.as_str()).collect();
    unknown_keys(
        &mut reader.decoder,
        object,
        &known,
        format_args!("an object on the device {}", device.name),
    );
    let arguments: Vec<_> = device.parameters.iter().map(|parameter| reader.argument(parameter)).collect();
    let mut diagnostics = std::mem::take(&mut reader.decoder.diagnostics);
    match arguments.into_iter().collect::<Option<Vec<_>>>().filter(|_| diagnostics.is_empty()) {
        Some(arguments) => Ok(arguments),
        None => {
            sort(&mut diagnostics);
            Err(diagnostics)
        }
    }
}

/// A machine that is turned has parts that turn with it.
fn turned(object: &Object, device: &Device, pose: Frame) -> Result<(), Vec<Diagnostic>> {
    if pose.yaw == 0.0 || device.can_turn {
        return Ok(());
    }
    let message =
        format!("\"{}\" is turned, but the device {} cannot be turned", object.name.value, device.name);
    Err(vec![
        Diagnostic::new("E0144", object.pose.span, message)
            .other(device.place, "its parts lie along the axes of the world: none is given from `origin`")
            .help("leave out the fourth number of the pose, or give the parts of the device from `origin`"),
    ])
}

/// What the device requires of the numbers.
fn unmet(object: &Object, placed: &Placed) -> Result<(), Vec<Diagnostic>> {
    let unmet = placed.unmet().map_err(|found| vec![found.other(object.span, "for this machine")])?;
    let found: Vec<Diagnostic> = unmet
        .into_iter()
        .map(|unmet| {
            let members = object.members.iter();
            let named = members.filter(|member| unmet.parameters.contains(&member.key.value));
            // A key that the command line gives, if there is one: the layout without it may be right.
            let member = named.min_by_key(|member| member.value.span.file == object.span.file);
            let place = member.map_or(object.span, |member| member.value.span);
            Diagnostic::new("E0124", place, format!("\"{}\": {}", object.name.value, unmet.text))
                .other(unmet.place, "required here")
                .other(object.pose.span, "the machine is here")
                .help("change these numbers, or those of the pose")
        })
        .collect();
    if found.is_empty() { Ok(()) } else { Err(found) }
}

/// The checks of [`machine`] for an object whose type has no automaton.
pub fn obstacle(object: &Object) -> Result<Obstacle, Vec<Diagnostic>> {
    let mut decoder = Decoder::default();
    let kind = object.kind.value.as_str();
    if OBSTACLES.contains(&kind) && object.part == Part::Stationary {
        unknown_keys(&mut decoder, object, &[], format_args!("a {kind} without an automaton"));
    } else {
        decoder.report(
            Diagnostic::new("E0126", object.kind.span, format!("no automaton has the type \"{kind}\""))
                .note(format!("stationary objects of these types need none: {}", listing(&OBSTACLES)))
                .help(match object.part {
                    Part::Stationary => instead(kind, &OBSTACLES),
                    Part::Robot => format!("write an automaton for \"{kind}\", or correct the type"),
                }),
        );
    }
    if object.pose.value.yaw != 0.0 {
        let message = format!("\"{}\" is turned, but an obstacle cannot be turned", object.name.value);
        decoder.report(
            Diagnostic::new("E0144", object.pose.span, message)
                .note("the boxes of obstacles lie along the axes of the world")
                .help("leave out the fourth number of the pose, or write a device with a body `at` a turned frame"),
        );
    }
    match decoder.diagnostics.is_empty() {
        true => Ok(Obstacle {
            name: object.name.value.clone(),
            pose: object.pose.value.position,
            size: object.size.as_ref().map(|s| s.value),
        }),
        false => Err(decoder.diagnostics),
    }
}

fn unknown_keys(decoder: &mut Decoder, object: &Object, own: &[&str], what: impl Display) {
    let mut known = COMMON_KEYS.to_vec();
    known.extend(own);
    if object.part == Part::Stationary {
        known.push("box");
    }
    decoder.unknown_keys(&object.members, &known, what);
}

struct Reader<'a> {
    object: &'a Object,
    /// Of the layout.
    routes: &'a [Routes],
    /// That names those of this machine.
    key: Option<&'a str>,
    decoder: Decoder,
}

impl<'a> Reader<'a> {
    fn argument(&mut self, parameter: &Parameter) -> Option<Value> {
        let key = parameter.name.as_str();
        if let (Some(default), None) = (&parameter.default, find(&self.object.members, key)) {
            return Some(default.clone());
        }
        match &parameter.form {
            Form::Axis => self.axis(key).map(Value::Axis),
            Form::Range => self.range(key).map(|range| Value::List(range.map(Value::Number).to_vec())),
            Form::Real => {
                let json = self.required(key)?;
                self.decoder.metres(json, key).map(Value::Number)
            }
            Form::Time => {
                let json = self.required(key)?;
                let seconds = self.decoder.number_in(json, key, 0.0..=LONGEST_S)?;
                Some(Value::Number((seconds * 1000.0).round()))
            }
            Form::Point => {
                let json = self.required(key)?;
                self.decoder.point(json, key).map(Value::Point)
            }
            Form::Points(elements) => self.points(key, elements),
            Form::Routes => self.routes(key).map(Routes::value),
            Form::Node => self.node(key).map(|node| Value::Number(node as f64)),
        }
    }

    fn routes(&mut self, key: &str) -> Option<&'a Routes> {
        let json = self.required(key)?;
        let name = self.decoder.text(json, key)?;
        let found = self.routes.iter().find(|routes| routes.name.value == name.value);
        if found.is_none() {
            let known: Vec<&str> = self.routes.iter().map(|routes| routes.name.value.as_str()).collect();
            let message = format!("the layout has no routes \"{}\"", name.value);
            let help = match known.is_empty() {
                true => {
                    "write `\"routes\": {\"...\": {\"nodes\": ..., \"edges\": ...}}` beside `robots`".into()
                }
                false => instead(&name.value, &known),
            };
            self.decoder.report(Diagnostic::new("E0155", name.span, message).help(help));
        }
        found
    }

    /// The number of a node of the machine's routes; what is wrong with those is told where they are named.
    fn node(&mut self, key: &str) -> Option<usize> {
        let json = self.required(key)?;
        let name = self.decoder.text(json, key)?;
        let of = find(&self.object.members, self.key?).map(|json| &json.value);
        let super::json::Value::Text(of) = of? else { return None };
        let routes = self.routes.iter().find(|routes| routes.name.value == *of)?;
        let found = routes.node(&name.value);
        if found.is_none() {
            let known: Vec<&str> = routes.nodes.iter().map(|(name, _)| name.value.as_str()).collect();
            let message = format!("the routes \"{of}\" have no node \"{}\"", name.value);
            self.decoder.report(
                Diagnostic::new("E0155", name.span, message)
                    .other(routes.name.span, "the routes")
                    .note(format!("the nodes are {}", listing(&known)))
                    .help(instead(&name.value, &known)),
            );
        }
        found
    }

    fn required(&mut self, key: &str) -> Option<&'a Json> {
        let Object { members, span, name, .. } = self.object;
        self.decoder.required(members, key, *span, format_args!("\"{}\"", name.value))
    }

    fn axis(&mut self, key: &str) -> Option<Axis> {
        let text = self.required(key).and_then(|j| self.decoder.text(j, key))?;
        match text.value.as_str() {
            "x" => Some(Axis::X),
            "y" => Some(Axis::Y),
            other => {
                self.decoder.report(
                    Diagnostic::new(
                        "E0115",
                        text.span,
                        format!("{key} must be \"x\" or \"y\", not \"{other}\""),
                    )
                    .note("it is the horizontal axis of the world along which the machine lies")
                    .help("write \"x\" or \"y\""),
                );
                None
            }
        }
    }

    fn range(&mut self, key: &str) -> Option<[f64; 2]> {
        let json = self.required(key)?;
        let [lower, upper] = self.decoder.metres_list(json, key, ["lower end", "upper end"])?;
        if lower >= upper {
            self.decoder.report(
                Diagnostic::new(
                    "E0123",
                    json.span,
                    format!("{key} is from {lower} to {upper}: its ends are in the wrong order"),
                )
                .note("the lower end comes first; both are in the world frame")
                .help(match lower > upper {
                    true => format!("write [{upper}, {lower}]"),
                    false => "write two different ends".into(),
                }),
            );
            return None;
        }
        Some([lower, upper])
    }

    fn points(&mut self, key: &str, elements: &[String]) -> Option<Value> {
        let json = self.required(key)?;
        let elements: Vec<&str> = elements.iter().map(String::as_str).collect();
        let items = self.decoder.exactly(json, key, &elements)?;
        let points: Vec<_> = (items.iter().enumerate())
            .map(|(i, item)| Some(Value::Point(self.decoder.point(item, format_args!("{key}[{i}]"))?)))
            .collect();
        points.into_iter().collect::<Option<_>>().map(Value::List)
    }
}
