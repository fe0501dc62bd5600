//! The key `at`: a machine whose conveyor begins where that of another one ends.

use super::decode::{Decoder, instead, some};
use super::json::{Json, Value};
use super::{Object, Part, Routes, machine};
use crate::device::{Device, Placed};
use crate::diagnostic::Diagnostic;
use crate::source::{Span, Spanned};
use runtime_sim::frame::Frame;
use runtime_sim::part::lane::CentreLine;
use std::collections::HashMap;
use std::sync::Arc;

/// Where a machine is, if not by its pose.
#[derive(Clone, Debug, PartialEq)]
pub struct At {
    pub span: Span,
    /// Its own lane; none for the only one.
    pub own: Option<Spanned<String>>,
    /// The machine and the lane at whose end this begins.
    pub machine: String,
    pub lane: String,
    /// The text that names them.
    pub named: Span,
}

impl Decoder {
    /// `"c1.belt"`, or `["belt", "c1.belt"]` with the name of its own lane first.
    pub fn at(&mut self, json: &Json) -> Option<At> {
        let (own, of) = match &json.value {
            Value::List(_) => {
                let items =
                    self.exactly(json, "at", &["its own lane", "the lane at whose end this begins"])?;
                (Some(self.text(&items[0], "at[0]")?), self.text(&items[1], "at[1]")?)
            }
            _ => (None, self.text(json, "at")?),
        };
        let Some((machine, lane)) = of.value.split_once('.') else {
            let message = format!("at is \"{}\", which names no lane of a machine", of.value);
            self.report(Diagnostic::new("E0148", of.span, message).help(AS_TEXT));
            return None;
        };
        let named = of.span;
        Some(At { span: json.span, own, machine: machine.into(), lane: lane.into(), named })
    }
}

const AS_TEXT: &str = "write the machine and its lane, such as \"c1.belt\"";

/// A conveyor that begins where another one ends is off it by less, m and degrees.
const NEAR: f64 = 1e-6;

/// What is known of the place of an object.
#[derive(Clone, Copy, PartialEq)]
enum Known {
    NotYet,
    /// What it depends on is looked at first.
    Begun,
    At(Frame),
    /// It has been reported, or something else is wrong with the object.
    Wrong,
}

/// The frames of all objects, in their order; none for those that have none, which is reported.
pub fn frames(
    objects: &[Object],
    routes: &[Routes],
    device: impl Fn(&Object) -> Option<Arc<Device>>,
) -> (Vec<Option<Frame>>, Vec<Diagnostic>) {
    let known = objects.iter().map(|object| match object.at {
        Some(_) => Known::NotYet,
        None => Known::At(object.pose.value),
    });
    let numbers = objects.iter().enumerate().map(|(i, object)| (object.name.value.as_str(), i));
    let mut places = Places {
        objects,
        routes,
        numbers: numbers.collect(),
        known: known.collect(),
        diagnostics: Vec::new(),
    };
    (0..objects.len()).for_each(|object| places.settle(object, &device));
    let frame = |known: Known| match known {
        Known::At(frame) => Some(frame),
        Known::NotYet | Known::Begun | Known::Wrong => None,
    };
    (places.known.into_iter().map(frame).collect(), places.diagnostics)
}

struct Places<'a> {
    objects: &'a [Object],
    routes: &'a [Routes],
    numbers: HashMap<&'a str, usize>,
    known: Vec<Known>,
    diagnostics: Vec<Diagnostic>,
}

impl Places<'_> {
    /// Finds the place of an object, after those on which it depends.
    fn settle(&mut self, object: usize, device: &impl Fn(&Object) -> Option<Arc<Device>>) {
        let mut waiting = vec![object];
        while let Some(&next) = waiting.last() {
            if self.known[next] == Known::NotYet {
                self.known[next] = Known::Begun;
                let at = self.objects[next].at.as_ref();
                let before = at.and_then(|at| self.numbers.get(at.machine.as_str()).copied());
                match before.map(|before| (before, self.known[before])) {
                    Some((before, Known::NotYet)) => {
                        waiting.push(before);
                        continue;
                    }
                    Some((_, Known::Begun)) => self.report_circle(next),
                    Some((_, Known::At(_) | Known::Wrong)) | None => {}
                }
            }
            if self.known[next] == Known::Begun {
                self.known[next] = match self.found(next, device) {
                    Ok(frame) => Known::At(frame),
                    Err(found) => {
                        self.diagnostics.extend(found);
                        Known::Wrong
                    }
                };
            }
            waiting.pop();
        }
    }

    fn report_circle(&mut self, object: usize) {
        self.known[object] = Known::Wrong;
        let object = &self.objects[object];
        let Some(at) = &object.at else { return };
        let message = format!("the place of \"{}\" depends on itself", object.name.value);
        self.diagnostics.push(
            Diagnostic::new("E0149", at.span, message)
                .note(format!("it is at the end of \"{}\", whose place depends on this one", at.machine))
                .help("give one of these machines a pose"),
        );
    }

    /// No diagnostics where an error of another object is the cause.
    fn found(
        &self,
        number: usize,
        device: &impl Fn(&Object) -> Option<Arc<Device>>,
    ) -> Result<Frame, Vec<Diagnostic>> {
        let object = &self.objects[number];
        let Some(at) = &object.at else { return Err(Vec::new()) };
        let wrong = |span: Span, message: String| Diagnostic::new("E0148", span, message);
        let Some(&before) = self.numbers.get(at.machine.as_str()) else {
            let names: Vec<&str> = self.objects.iter().map(|object| object.name.value.as_str()).collect();
            let message = format!(
                "\"{}\", at the end of which \"{}\" begins, is not in the layout",
                at.machine, object.name.value
            );
            let known = format!("the layout has: {}", some(&names));
            return Err(vec![wrong(at.span, message).note(known).help(instead(&at.machine, &names))]);
        };
        let Known::At(frame) = self.known[before] else { return Err(Vec::new()) };
        let own = self.placed(number, Frame::default(), device)?;
        let other = self.placed(before, frame, device).map_err(|_| self.without_lane(before, at))?;
        let end = lane(&other, &at.lane).map_err(|lanes| {
            let message = format!("\"{}\" has no lane \"{}\"", at.machine, at.lane);
            self.cause(before, &other, wrong(at.span, message).help(which(&lanes)))
        })?;
        let begin = own_lane(&own, at.own.as_ref()).map_err(|(message, lanes)| {
            let span = at.own.as_ref().map_or(at.span, |own| own.span);
            let message = format!("\"{}\" {message}", object.name.value);
            self.cause(number, &own, wrong(span, message).help(which(&lanes)))
        })?;
        let meets = end.frame(end.end());
        let frame = meets.then(begin.frame(begin.begin()).inverse());
        // Lanes that lie along an axis of the world do not turn, and some do not move with the pose at all.
        let placed = own_lane(&Placed { pose: frame, ..own }, at.own.as_ref());
        let comes = placed.map(|lane| lane.frame(lane.begin())).unwrap_or_default();
        let is_there = (comes.position - meets.position).length() < NEAR
            && runtime_sim::frame::whole_turn(comes.yaw - meets.yaw).abs() < NEAR;
        if is_there {
            return Ok(frame);
        }
        let message = format!("the lane of \"{}\" does not move and turn with its pose", object.name.value);
        let found = wrong(at.span, message)
            .note("it is given in the world, or from `pose`, which does not turn")
            .help("give the lane `from: origin * ...` in its device, or write a pose");
        Err(vec![found])
    }

    /// What is wrong with the lanes of a machine, if that is why one was not found.
    fn cause(&self, number: usize, placed: &Placed, not_found: Diagnostic) -> Vec<Diagnostic> {
        let wrong = placed.wrong_lanes(self.objects[number].span);
        if wrong.is_empty() { vec![not_found] } else { wrong }
    }

    /// What is wrong with the other machine is reported there, but not that an obstacle has no lane.
    fn without_lane(&self, before: usize, at: &At) -> Vec<Diagnostic> {
        if self.objects[before].part == Part::Robot {
            return Vec::new();
        }
        let message = format!("\"{}\" has no lane \"{}\"", at.machine, at.lane);
        vec![Diagnostic::new("E0148", at.span, message).help(which(&[]))]
    }

    /// The machine at a place.
    fn placed(
        &self,
        number: usize,
        pose: Frame,
        device: &impl Fn(&Object) -> Option<Arc<Device>>,
    ) -> Result<Placed, Vec<Diagnostic>> {
        let object = &self.objects[number];
        let Some(device) = device(object) else {
            if object.part == Part::Robot {
                return Err(Vec::new());
            }
            let message = format!("\"{}\" has no device, so it has no lane", object.name.value);
            let span = object.at.as_ref().map_or(object.span, |at| at.span);
            return Err(vec![Diagnostic::new("E0148", span, message).help("write a pose")]);
        };
        let arguments = machine::arguments(object, &device, self.routes)?;
        Ok(Placed { device, pose, arguments })
    }
}

/// The lane of this name, or the names of those that there are.
fn lane(placed: &Placed, name: &str) -> Result<CentreLine, Vec<String>> {
    let lanes = placed.lanes();
    let found = lanes.iter().find(|(own, _)| own == name).map(|(_, lane)| *lane);
    found.ok_or_else(|| lanes.into_iter().map(|(name, _)| name).collect())
}

fn own_lane(placed: &Placed, name: Option<&Spanned<String>>) -> Result<CentreLine, (String, Vec<String>)> {
    if let Some(name) = name {
        return lane(placed, &name.value).map_err(|lanes| (format!("has no lane \"{}\"", name.value), lanes));
    }
    let lanes = placed.lanes();
    match &lanes[..] {
        [(_, lane)] => Ok(*lane),
        _ => {
            let message = format!("has {} lanes: which one begins there is not clear", lanes.len());
            Err((message, lanes.into_iter().map(|(name, _)| name).collect()))
        }
    }
}

fn which(lanes: &[String]) -> String {
    match lanes {
        [] => "it has no lane: write a pose".into(),
        [one] => format!("its lane is \"{one}\""),
        _ => format!(
            "its lanes are {}; the own lane comes first, as in [\"{}\", \"c1.belt\"]",
            lanes.join(", "),
            lanes[0]
        ),
    }
}
