//! The keys of an object that depend on its device.

use super::decode::{Decoder, find, instead, listing};
use super::json::Json;
use super::object::COMMON_KEYS;
use super::{Number, Object, Part};
use crate::diagnostic::{Diagnostic, sort};
use crate::source::Span;
use runtime_sim::device::DEVICES;
use runtime_sim::geometry::{END_INSET, Geometry, SPAWN_INSET};
use runtime_sim::line::Obstacle;
use runtime_sim::point::{Axis, Point};

const OBSTACLES: [&str; 6] = ["bin", "station", "assembly_station", "collector", "rail", "box"];

/// The geometry of an object whose type is bound to a device, and all numbers in it, those of the pose first.
pub fn geometry(object: &Object, device: &str) -> Result<(Geometry, Vec<Number>), Vec<Diagnostic>> {
    let mut reader = Reader { object, decoder: Decoder::default(), numbers: object.pose_numbers.clone() };
    let geometry = reader.geometry(device);
    let mut diagnostics = reader.decoder.diagnostics;
    match geometry.filter(|_| diagnostics.is_empty()) {
        Some(geometry) => Ok((geometry, reader.numbers)),
        None => {
            sort(&mut diagnostics);
            Err(diagnostics)
        }
    }
}

/// The checks of [`geometry`] for an object whose type has no automaton.
pub fn obstacle(object: &Object) -> Result<Obstacle, Vec<Diagnostic>> {
    let mut decoder = Decoder::default();
    let kind = object.kind.value.as_str();
    if OBSTACLES.contains(&kind) && object.part == Part::Stationary {
        unknown_keys(&mut decoder, object, &[], &format!("a {kind} without an automaton"));
    } else {
        decoder.report(
            Diagnostic::new("E0126", object.kind.span, format!("no automaton has the type \"{kind}\""))
                .note(format!("stationary things need none if they are of the types {}", listing(&OBSTACLES)))
                .help(match object.part {
                    Part::Stationary => instead(kind, &OBSTACLES),
                    Part::Robot => format!("write an automaton for \"{kind}\", or correct the type"),
                }),
        );
    }
    match decoder.diagnostics.is_empty() {
        true => Ok(Obstacle {
            name: object.name.value.clone(),
            pose: object.pose.value,
            size: object.size.as_ref().map(|s| s.value),
        }),
        false => Err(decoder.diagnostics),
    }
}

fn unknown_keys(decoder: &mut Decoder, object: &Object, own: &[&str], what: &str) {
    let mut known = COMMON_KEYS.to_vec();
    known.extend(own);
    if object.part == Part::Stationary {
        known.push("box");
    }
    decoder.unknown_keys(&object.members, &known, what);
}

struct Reader<'a> {
    object: &'a Object,
    decoder: Decoder,
    numbers: Vec<Number>,
}

impl<'a> Reader<'a> {
    fn geometry(&mut self, device: &str) -> Option<Geometry> {
        let pose = self.object.pose.value;
        match device {
            "belt" => {
                self.keys(device, &["orient", "orient_range"]);
                let orient = self.axis("orient");
                let range = self.range("orient_range");
                let geometry = Geometry::Belt { pose, orient: orient?, orient_range: range? };
                self.pick_zone(&geometry);
                Some(geometry)
            }
            "vehicle" => {
                self.keys(device, &["destinations"]);
                Some(Geometry::Vehicle { pose, destinations: self.destinations()? })
            }
            "rail_arm" => {
                self.keys(device, &["rail_dim", "rail_range"]);
                let (rail_dim, rail_range) = (self.axis("rail_dim"), self.range("rail_range"));
                Some(Geometry::RailArm { pose, rail_dim: rail_dim?, rail_range: rail_range? })
            }
            "gantry" => {
                self.keys(device, &["x_rail_range", "y_rail_range"]);
                let (x, y) = (self.range("x_rail_range"), self.range("y_rail_range"));
                Some(Geometry::Gantry { pose, x_rail_range: x?, y_rail_range: y? })
            }
            "station" => {
                self.keys(device, &[]);
                Some(Geometry::Station { pose })
            }
            "bin" => {
                self.keys(device, &[]);
                Some(Geometry::Bin { pose })
            }
            _ => {
                let known: Vec<&str> = DEVICES.iter().map(|d| d.name).collect();
                self.decoder.report(
                    Diagnostic::new(
                        "E0127",
                        self.object.kind.span,
                        format!("there is no device \"{device}\""),
                    )
                    .note(format!("devices: {}", listing(&known)))
                    .help(instead(device, &known)),
                );
                None
            }
        }
    }

    fn keys(&mut self, device: &str, own: &[&str]) {
        let what = format!("an object on the device {device}");
        unknown_keys(&mut self.decoder, self.object, own, &what);
    }

    fn required(&mut self, key: &str) -> Option<&'a Json> {
        let what = format!("\"{}\"", self.object.name.value);
        self.decoder.required(&self.object.members, key, self.object.span, &what)
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
                    .note("it is the horizontal axis of the world along which the thing lies")
                    .help("write \"x\" or \"y\""),
                );
                None
            }
        }
    }

    fn range(&mut self, key: &str) -> Option<[f64; 2]> {
        let json = self.required(key)?;
        let numbers = self.decoder.metres_list(json, key, &["lower end", "upper end"])?;
        let (lower, upper) = (numbers[0].value, numbers[1].value);
        self.numbers.extend(numbers);
        if lower >= upper {
            self.decoder.report(
                Diagnostic::new(
                    "E0123",
                    json.span,
                    format!("{key} goes from {lower} to {upper}, which is not upwards"),
                )
                .note("the lower end stands first; both are in the world frame")
                .help(match lower > upper {
                    true => format!("write [{upper}, {lower}]"),
                    false => "write two different ends".into(),
                }),
            );
            return None;
        }
        Some([lower, upper])
    }

    fn destinations(&mut self) -> Option<[Point; 2]> {
        let json = self.required("destinations")?;
        let stops = self.decoder.exactly(json, "destinations", &["near stop", "far stop"])?;
        let near = self.decoder.point(&stops[0], "destinations[0]");
        let far = self.decoder.point(&stops[1], "destinations[1]");
        let ((near, near_numbers), (far, far_numbers)) = (near?, far?);
        self.numbers.extend(near_numbers);
        self.numbers.extend(far_numbers);
        Some([near, far])
    }

    /// Parts must pass the whole pick zone between where they appear and where they leave.
    fn pick_zone(&mut self, belt: &Geometry) {
        let Geometry::Belt { orient, orient_range, .. } = *belt else { return };
        let Some(zone) = belt.pick_zone() else { return };
        let [low, high] = zone.map(|end| end.coordinate(orient));
        let (end, spawn) = (orient_range[0] + END_INSET, orient_range[1] - SPAWN_INSET);
        if end < low && high < spawn {
            return;
        }
        let place = find(&self.object.members, "orient_range").map_or(self.object.span, |j| j.span);
        let pose: Span = self.object.pose.span;
        self.decoder.report(
            Diagnostic::new(
                "E0124",
                place,
                format!(
                    "the pick zone of \"{}\" is not between the ends of its belt",
                    self.object.name.value
                ),
            )
            .other(pose, "the pick zone lies around this")
            .note(format!("the pick zone reaches from {low:.3} to {high:.3} m"))
            .note(format!("parts appear at {spawn:.3} m and leave the belt at {end:.3} m"))
            .help(format!(
                "let orient_range reach from below {:.3} to above {:.3}, or move the pose",
                low - END_INSET,
                high + SPAWN_INSET
            )),
        );
    }
}
