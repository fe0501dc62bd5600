//! Arms from files of OPW parameters, as the packages of ROS-Industrial have them: lengths, offsets and signs, in YAML.

mod yaml;

use super::arm::fit::{Fit, JOINTS};
use super::arm::{self, Arm};
use super::{Imported, identifier, text};
use crate::diagnostic::{Diagnostic, sort};
use crate::source::{FileId, Sources, Span};
use runtime_sim::kinematics::fixed::Geometry;
use runtime_sim::kinematics::opw::Opw;
use runtime_sim::point::Point;
use yaml::{Entry, Node, Value};

const LENGTHS: [&str; 7] = ["a1", "a2", "b", "c1", "c2", "c3", "c4"];
const GEOMETRY: &str = "opw_kinematics_geometric_parameters";
/// The names of `moveit_opw_kinematics_plugin`, and those of plugins of Tesseract.
const OFFSETS: [&str; 2] = ["opw_kinematics_joint_offsets", "offsets"];
const SIGNS: [&str; 2] = ["opw_kinematics_joint_sign_corrections", "sign_corrections"];
/// Greatest length, m, and angle, rad.
const LONGEST: f64 = 100.0;
const WIDEST: f64 = 4.0 * std::f64::consts::PI;

/// A device text for the arm; `name` is the device's.
pub fn import(sources: &Sources, file: FileId, name: &str) -> Result<Imported, Vec<Diagnostic>> {
    let root = yaml::parse(&sources.file(file).text, file).map_err(|error| vec![*error])?;
    let mut reader = Reader { diagnostics: Vec::new() };
    let opw = reader.arm(&root);
    sort(&mut reader.diagnostics);
    let Some(opw) = opw.filter(|_| reader.diagnostics.is_empty()) else { return Err(reader.diagnostics) };
    let arm = Arm {
        device: identifier(name, "arm"),
        title: "the parameters of an arm with a spherical wrist".into(),
        file: sources.file(file).name.clone(),
        flange: "c4 from the centre of the wrist".into(),
        fit: Fit { base: Point::default(), yaw: 0.0, geometry: Geometry::OrthoParallel(opw) },
        joints: Vec::new(),
        bodies: Vec::new(),
        notes: vec![
            "limits of the joints are not in such a file: add `lowest` and `highest` of the data sheet, in degrees; without \
             them every joint turns once to either side"
                .into(),
            "velocities and accelerations are not in such a file: they are parameters of the device".into(),
            "the file has no shapes: add bodies, or contact of the arm is not found".into(),
        ],
    };
    let rest = arm::rest(&arm).ok_or_else(|| {
        vec![
            Diagnostic::new(
                "E1108",
                root.span,
                "no place was found that the arm reaches with its tool pointing down",
            )
            .note("places all around the base were tried")
            .help("compare the lengths with the data sheet: they are in metres"),
        ]
    })?;
    Ok(Imported { text: text::of_arm(&arm, rest), notes: arm.notes })
}

struct Reader {
    diagnostics: Vec<Diagnostic>,
}

/// Where lengths are found: their own map, and the map around it.
struct Found<'a> {
    own: &'a Node,
    around: &'a [Entry],
}

impl Reader {
    fn report(&mut self, code: &'static str, span: Span, message: String, help: &str) {
        self.diagnostics.push(Diagnostic::new(code, span, message).help(help));
    }

    fn arm(&mut self, root: &Node) -> Option<Opw> {
        let mut all = Vec::new();
        search(root, &mut all);
        let found = match all[..] {
            [ref found] => found,
            [] => {
                let message = format!("there is no key {GEOMETRY} in this file");
                self.report("E1110", Span { end: root.span.start, ..root.span }, message, "name a file with OPW parameters: a1, a2, b, c1, c2, c3, c4, offsets and signs of the joints");
                return None;
            }
            [_, ref second, ..] => {
                self.report(
                    "E1110",
                    second.own.span,
                    "the file has the parameters of several arms".into(),
                    "import a file with those of one arm",
                );
                return None;
            }
        };
        let Value::Map(own) = &found.own.value else {
            self.report(
                "E1110",
                found.own.span,
                format!("{GEOMETRY} is no group of keys"),
                "write the lengths below it, a line each: a1: 0.1",
            );
            return None;
        };
        let lengths = LENGTHS.map(|name| match own.iter().find(|entry| entry.key.value == name) {
            Some(entry) => self.number(&entry.node, name, LONGEST),
            None => {
                self.report(
                    "E1110",
                    found.own.span,
                    format!("the length {name} is missing"),
                    "write it, in metres; 0 if the arm has none",
                );
                None
            }
        });
        let of_joints = |names: [&str; 2]| {
            let entries = found.around.iter().chain(own);
            entries
                .filter(|entry| names.contains(&entry.key.value.as_str()))
                .collect::<Vec<_>>()
                .first()
                .copied()
        };
        let offsets = of_joints(OFFSETS).map(|entry| self.six(&entry.node, "offsets", WIDEST));
        let signs = of_joints(SIGNS).map(|entry| {
            let signs = self.six(&entry.node, "sign corrections", 1.0)?;
            if signs.iter().any(|sign| sign.abs() != 1.0) {
                self.report(
                    "E1110",
                    entry.node.span,
                    "a sign correction is neither 1 nor -1".into(),
                    "write 1, or -1 for a joint that turns the other way",
                );
                return None;
            }
            Some(signs)
        });
        for (is_there, name) in [(offsets.is_some(), OFFSETS[0]), (signs.is_some(), SIGNS[0])] {
            if !is_there {
                self.report(
                    "E1110",
                    found.own.span,
                    format!("the key {name} is missing"),
                    "write the six numbers of the joints: without them the arm would be another one",
                );
            }
        }
        let (offsets, signs) = (offsets??, signs??);
        let [Some(a1), Some(a2), Some(b), Some(c1), Some(c2), Some(c3), Some(c4)] = lengths else {
            return None;
        };
        if c2 <= 0.0 || (a2 == 0.0 && c3 == 0.0) {
            self.report(
                "E1110",
                found.own.span,
                "c2 has to be over 0, and a2 and c3 must not both be 0".into(),
                "compare the lengths with the data sheet",
            );
            return None;
        }
        Some(Opw { a1, a2, b, c1, c2, c3, tool: c4, offsets, signs })
    }

    fn six(&mut self, node: &Node, what: &str, most: f64) -> Option<[f64; JOINTS]> {
        let Value::List(items) = &node.value else {
            self.report(
                "E1110",
                node.span,
                format!("the {what} are no list"),
                "write six numbers in brackets: [0, 0, 0, 0, 0, 0]",
            );
            return None;
        };
        if items.len() != JOINTS {
            let message = format!("there are {} {what}, not {JOINTS}", items.len());
            self.report("E1110", node.span, message, "write a number for each joint");
            return None;
        }
        let numbers: Vec<Option<f64>> = items.iter().map(|item| self.number(item, what, most)).collect();
        numbers.into_iter().collect::<Option<Vec<f64>>>()?.try_into().ok()
    }

    /// A number, or an angle as `deg(90)` or `rad(1.57)`.
    fn number(&mut self, node: &Node, what: &str, most: f64) -> Option<f64> {
        let number = match &node.value {
            Value::Scalar(word) => {
                let inside = |name: &str| word.strip_prefix(name)?.strip_prefix('(')?.strip_suffix(')');
                match (inside("deg"), inside("rad")) {
                    (Some(degrees), _) => degrees.trim().parse::<f64>().ok().map(f64::to_radians),
                    (_, Some(radians)) => radians.trim().parse().ok(),
                    _ => word.parse().ok(),
                }
            }
            Value::List(_) | Value::Map(_) => None,
        };
        let number = number.filter(|number: &f64| number.abs() <= most);
        if number.is_none() {
            let message = format!("{what}: this is no number from -{most:.4} to {most:.4}");
            self.report("E1110", node.span, message, "write a number, or an angle as deg(90)");
        }
        number
    }
}

/// Maps of lengths, by their name or by what they hold.
fn search<'a>(node: &'a Node, found: &mut Vec<Found<'a>>) {
    match &node.value {
        Value::Map(entries) => {
            for entry in entries {
                let is_geometry = match &entry.node.value {
                    Value::Map(inner) => {
                        ["c1", "c2", "c3"].iter().all(|name| inner.iter().any(|e| e.key.value == *name))
                    }
                    _ => false,
                };
                if is_geometry || entry.key.value == GEOMETRY {
                    found.push(Found { own: &entry.node, around: entries });
                } else {
                    search(&entry.node, found);
                }
            }
        }
        Value::List(items) => items.iter().for_each(|item| search(item, found)),
        Value::Scalar(_) => {}
    }
}
