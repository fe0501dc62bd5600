//! One machine or thing of the layout, before its type is bound to a device.

use super::Number;
use super::at::At;
use super::decode::{Decoder, find, readable};
use super::json::{Json, Member, Value};
use crate::diagnostic::Diagnostic;
use crate::source::{Span, Spanned};
use runtime_sim::frame::Frame;
use runtime_sim::point::Point;
use std::fmt::Display;

/// The list of the layout in which an object stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Part {
    Robot,
    Stationary,
}

#[derive(Clone, Debug, PartialEq)]
pub struct Object {
    pub name: Spanned<String>,
    /// The key `type`.
    pub kind: Spanned<String>,
    pub part: Part,
    pub span: Span,
    /// Where it stands; the key `pose`. The origin for one with `at`.
    pub pose: Spanned<Frame>,
    /// Where its coordinates stand; none of one with `at`.
    pub coordinates: Vec<Span>,
    pub at: Option<At>,
    /// The key `box` of a stationary thing: its lengths along x, y and z.
    pub size: Option<Spanned<Point>>,
    /// All keys that depend on the device.
    pub members: Vec<Member>,
    pub parameters: Vec<(Spanned<String>, Json)>,
    pub takes_from: Option<Names>,
    pub hands_to: Option<Names>,
}

/// A list of names of other objects, and where it stands.
pub type Names = Spanned<Vec<Spanned<String>>>;

/// Keys that every object may have.
pub const COMMON_KEYS: [&str; 7] = ["name", "type", "pose", "at", "parameters", "takes_from", "hands_to"];

/// Whether a key means the same for every device, so that none can have a parameter of this name.
pub fn is_common(key: &str) -> bool {
    COMMON_KEYS.contains(&key) || key == "box"
}

/// No coordinate of a factory is farther from the origin, in metres.
pub const FARTHEST: f64 = 1000.0;

/// All numbers of a value, each by its path, which begins with that of the value.
pub fn numbers(json: &Json, path: &str) -> Vec<Number> {
    match &json.value {
        Value::Number(value) => vec![Number { path: path.into(), value: *value, span: json.span }],
        Value::List(items) => {
            let items = items.iter().enumerate();
            items.flat_map(|(i, item)| numbers(item, &format!("{path}[{i}]"))).collect()
        }
        _ => Vec::new(),
    }
}

/// Where the coordinates of a pose stand.
fn coordinates(pose: &Json) -> Vec<Span> {
    match &pose.value {
        Value::List(items) => items.iter().take(3).map(|item| item.span).collect(),
        _ => Vec::new(),
    }
}

impl Decoder {
    /// A coordinate or a length in metres.
    pub fn metres(&mut self, json: &Json, path: impl Display) -> Option<f64> {
        let Value::Number(value) = json.value else {
            self.wrong_type(json, path, "a number");
            return None;
        };
        if value.abs() > FARTHEST {
            self.report(
                Diagnostic::new(
                    "E0125",
                    json.span,
                    format!("{path} is {} m, which is outside any factory", readable(value)),
                )
                .note(format!("coordinates are in metres, within {FARTHEST} m of the origin"))
                .help("write it in metres: is the value in millimetres?"),
            );
            return None;
        }
        Some(value)
    }

    pub fn metres_list<const N: usize>(
        &mut self,
        json: &Json,
        path: impl Display,
        elements: [&str; N],
    ) -> Option<[f64; N]> {
        let items = self.exactly(json, &path, &elements)?;
        let read: [Option<f64>; N] =
            std::array::from_fn(|i| self.metres(&items[i], format_args!("{path}[{i}]")));
        read.iter().all(Option::is_some).then(|| read.map(Option::unwrap_or_default))
    }

    pub fn point(&mut self, json: &Json, path: impl Display) -> Option<Point> {
        self.metres_list(json, path, ["x", "y", "z"]).map(|[x, y, z]| Point::new(x, y, z))
    }

    /// A place, and behind it degrees to the left if it is turned.
    fn pose(&mut self, json: &Json) -> Option<Frame> {
        let (json, yaw) = match &json.value {
            Value::List(items) if items.len() == 4 => {
                let yaw = self.number_in(&items[3], "pose[3]", -360.0..=360.0)?;
                (&Json { value: Value::List(items[..3].to_vec()), ..*json }, yaw)
            }
            _ => (json, 0.0),
        };
        Some(Frame::new(self.point(json, "pose")?, yaw))
    }

    pub fn layout_object(&mut self, json: &Json, part: Part) -> Option<Object> {
        let what = match part {
            Part::Robot => "a robot",
            Part::Stationary => "a stationary object",
        };
        let members = self.object(json, what)?;
        let name = self.required(members, "name", json.span, what);
        let name = name.and_then(|j| self.text(j, "name"));
        if let Some(name) = &name {
            self.identifier(name, what);
        }
        let described = name.as_ref().map_or(what.to_string(), |n| format!("\"{}\"", n.value));
        let kind = self.required(members, "type", json.span, &described);
        let kind = kind.and_then(|j| self.text(j, "type"));
        let (at, pose) = match (find(members, "at"), find(members, "pose")) {
            (Some(at), None) => {
                let found = self.at(at);
                let pose = found.as_ref().map(|_| (at.span, Frame::default(), Vec::new()));
                (found, pose)
            }
            (Some(at), Some(_)) => {
                let message = format!("{described} has a pose, and begins at the end of another machine");
                self.report(Diagnostic::new("E0148", at.span, message).help("leave out one of the two"));
                (None, None)
            }
            (None, Some(pose)) => (None, self.pose(pose).map(|read| (pose.span, read, coordinates(pose)))),
            (None, None) => {
                self.missing(members, &["pose", "at"], json.span, &described);
                (None, None)
            }
        };
        let parameters = find(members, "parameters").and_then(|j| self.object(j, "parameters"));
        let takes_from = find(members, "takes_from").and_then(|j| self.names(j, "takes_from"));
        let hands_to = find(members, "hands_to").and_then(|j| self.names(j, "hands_to"));
        let size = find(members, "box").and_then(|j| match part {
            Part::Stationary => self.size(j),
            Part::Robot => {
                self.box_of_robot(j, &described);
                None
            }
        });
        let specific = members.iter().filter(|m| !is_common(&m.key.value));
        let (pose_span, pose, coordinates) = pose?;
        Some(Object {
            name: name?,
            kind: kind?,
            part,
            span: json.span,
            pose: Spanned { value: pose, span: pose_span },
            coordinates,
            at,
            size,
            members: specific.cloned().collect(),
            parameters: parameters
                .unwrap_or_default()
                .iter()
                .map(|m| (m.key.clone(), m.value.clone()))
                .collect(),
            takes_from,
            hands_to,
        })
    }

    fn names(&mut self, json: &Json, key: &str) -> Option<Names> {
        self.texts(json, key).map(|value| Spanned { value, span: json.span })
    }

    fn box_of_robot(&mut self, json: &Json, robot: &str) {
        self.report(
            Diagnostic::new("E0111", json.span, format!("{robot} is a robot and has no \"box\""))
                .note("the size of a robot is that of its device")
                .help("remove the box"),
        );
    }

    fn size(&mut self, json: &Json) -> Option<Spanned<Point>> {
        let size = self.point(json, "box")?;
        let flat = numbers(json, "box").into_iter().find(|number| number.value <= 0.0);
        if let Some(Number { path, value, span }) = flat {
            self.report(
                Diagnostic::new("E0114", span, format!("{path} must be a length over 0, not {value}"))
                    .note("the box has its lengths along x, y and z")
                    .help("write a positive length, or leave \"box\" out"),
            );
            return None;
        }
        Some(Spanned { value: size, span: json.span })
    }
}
