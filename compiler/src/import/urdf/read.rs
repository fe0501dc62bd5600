//! From the elements of a URDF file to links and joints; all that is wrong is reported.

use crate::diagnostic::{Diagnostic, MOST, collect};
use crate::import::xml::Element;
use crate::source::{Span, Spanned};
use runtime_sim::kinematics::pose::Pose;
use runtime_sim::point::Point;
use std::collections::HashMap;

#[derive(Debug)]
pub struct Robot {
    pub name: Spanned<String>,
    pub links: Vec<Link>,
    pub joints: Vec<Joint>,
}

#[derive(Debug)]
pub struct Link {
    pub name: Spanned<String>,
    /// kg
    pub mass: Option<f64>,
    /// For collisions.
    pub shapes: Vec<Shape>,
}

#[derive(Debug)]
pub struct Shape {
    /// In the frame of the link.
    pub origin: Pose,
    pub geometry: Geometry,
}

/// Lengths in m.
#[derive(Clone, Debug, PartialEq)]
pub enum Geometry {
    /// Lengths along x, y and z.
    Box(Point),
    /// About z.
    Cylinder {
        radius: f64,
        length: f64,
    },
    /// The same, with half a sphere at each end.
    Capsule {
        radius: f64,
        length: f64,
    },
    Sphere(f64),
    Mesh {
        name: String,
        scale: Point,
    },
}

#[derive(Debug)]
pub struct Joint {
    pub name: Spanned<String>,
    pub span: Span,
    pub motion: Motion,
    /// Indices of links.
    pub parent: usize,
    pub child: usize,
    /// In the frame of the parent, at 0.
    pub origin: Pose,
    /// Unit vector, in the frame of the joint.
    pub axis: Point,
    /// rad or m
    pub range: Option<[f64; 2]>,
    /// rad/s or m/s
    pub velocity: Option<f64>,
    pub effort: Option<f64>,
    pub damping: Option<f64>,
    pub friction: Option<f64>,
    /// It follows another joint.
    pub mimics: bool,
    /// A controller keeps it within narrower limits than its own.
    pub has_soft_limits: bool,
}

#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Motion {
    Fixed,
    Turns,
    TurnsFreely,
    Slides,
    Planar,
    Floating,
}

const MOTIONS: [(&str, Motion); 6] = [
    ("fixed", Motion::Fixed),
    ("revolute", Motion::Turns),
    ("continuous", Motion::TurnsFreely),
    ("prismatic", Motion::Slides),
    ("planar", Motion::Planar),
    ("floating", Motion::Floating),
];

impl Motion {
    pub fn word(self) -> &'static str {
        MOTIONS.iter().find(|(_, motion)| *motion == self).map_or("", |(word, _)| word)
    }
}

/// Greatest length (m), angle (rad) and value of any number of a file.
const FARTHEST: f64 = 1e6;

pub fn robot(root: &Element) -> Result<Robot, Vec<Diagnostic>> {
    if root.name != "robot" {
        let message = format!("this is not URDF: the root element is <{}>, not <robot>", root.name);
        let help = match root.name.as_str() {
            "sdf" => "SDF is another format: export the arm as URDF",
            _ => "name a file whose root element is <robot>",
        };
        return Err(vec![Diagnostic::new("E1103", root.span, message).help(help)]);
    }
    if let Some(element) = xacro(root) {
        let message = format!("<{}> is xacro, which is not expanded here", element.name);
        return Err(vec![
            Diagnostic::new("E1103", element.span, message)
                .note("xacro files are programs, which may read other files")
                .help("expand the file first: xacro FILE.xacro > FILE.urdf"),
        ]);
    }
    let mut reader = Reader { diagnostics: Vec::new(), links: HashMap::new() };
    let name = reader.name(root, "robot");
    let links: Vec<Link> = root.all("link").filter_map(|element| reader.link(element)).collect();
    for (index, link) in links.iter().enumerate() {
        if let Some(first) = reader.links.insert(link.name.value.clone(), index) {
            reader.twice("link", &link.name, &links[first].name);
            reader.links.insert(link.name.value.clone(), first);
        }
    }
    let joints: Vec<Joint> = root.all("joint").filter_map(|element| reader.joint(element)).collect();
    let mut places: HashMap<&str, &Spanned<String>> = HashMap::new();
    for joint in &joints {
        match places.get(joint.name.value.as_str()).copied() {
            Some(first) => reader.twice("joint", &joint.name, first),
            None => drop(places.insert(&joint.name.value, &joint.name)),
        }
    }
    if links.is_empty() && reader.diagnostics.is_empty() {
        reader.report(
            Diagnostic::new("E1103", root.span, "the robot has no links").help("add <link name=\"...\"/>"),
        );
    }
    match name {
        Some(name) if reader.diagnostics.is_empty() => Ok(Robot { name, links, joints }),
        _ => Err(reader.diagnostics),
    }
}

/// The first element of the macro language; what gazebo and controllers keep for themselves is not looked at.
fn xacro(element: &Element) -> Option<&Element> {
    if element.name.starts_with("xacro:") || element.attributes.iter().any(|a| a.value.value.contains("${")) {
        return Some(element);
    }
    element.children.iter().find_map(xacro)
}

struct Reader {
    diagnostics: Vec<Diagnostic>,
    /// Indices by names.
    links: HashMap<String, usize>,
}

impl Reader {
    fn report(&mut self, diagnostic: Diagnostic) {
        if self.diagnostics.len() < MOST {
            collect(&mut self.diagnostics, diagnostic);
        }
    }

    fn twice(&mut self, what: &str, name: &Spanned<String>, first: &Spanned<String>) {
        let message = format!("there are two {what}s with the name {}", name.value);
        self.report(
            Diagnostic::new("E1105", name.span, message)
                .other(first.span, "the first one")
                .help("give one of them another name"),
        );
    }

    fn attribute<'a>(&mut self, element: &'a Element, name: &str) -> Option<&'a Spanned<String>> {
        let found = element.attribute(name);
        if found.is_none() {
            let message = format!("<{}> has no attribute {name}", element.name);
            self.report(Diagnostic::new("E1103", element.span, message).help(format!("add {name}=\"...\"")));
        }
        found
    }

    fn child<'a>(&mut self, element: &'a Element, name: &str) -> Option<&'a Element> {
        let found = element.child(name);
        if found.is_none() {
            let message = format!("<{}> has no element <{name}>", element.name);
            self.report(Diagnostic::new("E1103", element.span, message).help(format!("add <{name}>")));
        }
        found
    }

    /// Refuses a second one of elements of which only the first would count.
    fn once(&mut self, element: &Element, names: &[&str]) {
        for name in names {
            let mut all = element.all(name);
            if let (Some(first), Some(second)) = (all.next(), all.next()) {
                self.report(
                    Diagnostic::new(
                        "E1103",
                        second.span,
                        format!("<{}> has two elements <{name}>", element.name),
                    )
                    .other(first.span, "the first one")
                    .help("leave one of them out"),
                );
            }
        }
    }

    fn name(&mut self, element: &Element, what: &str) -> Option<Spanned<String>> {
        let name = self.attribute(element, "name")?;
        if name.value.trim().is_empty() {
            self.report(
                Diagnostic::new("E1103", element.span, format!("the name of this {what} is empty"))
                    .help("write a name"),
            );
            return None;
        }
        Some(name.clone())
    }

    /// So many numbers with white space between them.
    fn numbers<const N: usize>(&mut self, value: &Spanned<String>, what: &str) -> Option<[f64; N]> {
        let words: Vec<&str> = value.value.split_whitespace().take(N + 1).collect();
        let number = |word: &&str| word.parse::<f64>().ok().filter(|number| number.abs() <= FARTHEST);
        let numbers: Option<Vec<f64>> = words.iter().map(number).collect();
        if let Some(Ok(numbers)) = numbers.map(<[f64; N]>::try_from) {
            return Some(numbers);
        }
        let wanted = if N == 1 { "a number".into() } else { format!("{N} numbers") };
        let message =
            format!("{what} must be {wanted} from -{FARTHEST} to {FARTHEST}, not \"{}\"", value.value);
        self.report(Diagnostic::new("E1104", value.span, message).help(format!("write {wanted}")));
        None
    }

    fn number(&mut self, element: &Element, name: &str) -> Option<f64> {
        let value = element.attribute(name)?;
        self.numbers::<1>(value, name).map(|[number]| number)
    }

    fn over_0(&mut self, element: &Element, name: &str) -> Option<f64> {
        let value = self.attribute(element, name)?;
        let [number] = self.numbers::<1>(value, name)?;
        if number <= 0.0 {
            let message = format!("{name} must be over 0, not {number}");
            self.report(Diagnostic::new("E1104", value.span, message).help("write a number over 0"));
            return None;
        }
        Some(number)
    }

    fn point(&mut self, attribute: Option<&Spanned<String>>, name: &str, default: Point) -> Option<Point> {
        let Some(value) = attribute else { return Some(default) };
        self.numbers::<3>(value, name).map(|[x, y, z]| Point::new(x, y, z))
    }

    /// Place and rotation about fixed axes: about x, then y, then z.
    fn origin(&mut self, element: &Element) -> Option<Pose> {
        let Some(origin) = element.child("origin") else { return Some(Pose::IDENTITY) };
        let place = self.point(origin.attribute("xyz"), "xyz", Point::default())?;
        let turn = self.point(origin.attribute("rpy"), "rpy", Point::default())?;
        let rotation = [
            (Point::new(0.0, 0.0, 1.0), turn.z),
            (Point::new(0.0, 1.0, 0.0), turn.y),
            (Point::new(1.0, 0.0, 0.0), turn.x),
        ]
        .iter()
        .fold(Pose::IDENTITY, |pose, (axis, angle)| pose.then(&about(*axis, *angle)));
        Some(Pose { position: place, ..rotation })
    }

    fn link(&mut self, element: &Element) -> Option<Link> {
        let name = self.name(element, "link");
        self.once(element, &["inertial"]);
        let mass = element.child("inertial").and_then(|inertial| inertial.child("mass"));
        let mass = mass.and_then(|mass| self.number(mass, "value"));
        let shapes = element.all("collision").filter_map(|collision| self.shape(collision)).collect();
        Some(Link { name: name?, mass, shapes })
    }

    fn shape(&mut self, collision: &Element) -> Option<Shape> {
        let origin = self.origin(collision);
        let geometry = self.child(collision, "geometry")?;
        let Some(shape) = geometry.children.first() else {
            self.report(
                Diagnostic::new("E1103", geometry.span, "<geometry> is empty")
                    .help("add <box>, <cylinder>, <sphere> or <mesh>"),
            );
            return None;
        };
        let geometry = match shape.name.as_str() {
            "box" => {
                let size = self.attribute(shape, "size")?;
                let [x, y, z] = self.numbers::<3>(size, "size")?;
                if [x, y, z].iter().any(|length| *length <= 0.0) {
                    let message = "a length of this box is not over 0".to_string();
                    self.report(
                        Diagnostic::new("E1104", size.span, message).help("write three lengths over 0"),
                    );
                    return None;
                }
                Geometry::Box(Point::new(x, y, z))
            }
            kind @ ("cylinder" | "capsule") => {
                let (radius, length) = (self.over_0(shape, "radius"), self.over_0(shape, "length"));
                let (radius, length) = (radius?, length?);
                if kind == "capsule" {
                    Geometry::Capsule { radius, length }
                } else {
                    Geometry::Cylinder { radius, length }
                }
            }
            "sphere" => Geometry::Sphere(self.over_0(shape, "radius")?),
            "mesh" => {
                let name = self.attribute(shape, "filename")?.value.clone();
                let scale = self.point(shape.attribute("scale"), "scale", Point::new(1.0, 1.0, 1.0))?;
                Geometry::Mesh { name, scale }
            }
            other => {
                let message = format!("<{other}> is no shape of URDF");
                self.report(
                    Diagnostic::new("E1103", shape.span, message)
                        .help("write <box>, <cylinder>, <sphere> or <mesh>"),
                );
                return None;
            }
        };
        Some(Shape { origin: origin?, geometry })
    }

    /// The index of the link that an element names.
    fn named(&mut self, joint: &Element, which: &str) -> Option<usize> {
        let element = self.child(joint, which)?;
        let name = self.attribute(element, "link")?;
        let found = self.links.get(&name.value).copied();
        if found.is_none() {
            let known = self.links.keys().map(String::as_str);
            let help = match crate::diagnostic::suggestion(&name.value, known) {
                Some(meant) => format!("did you mean {meant}?"),
                None => "name a link of this file".into(),
            };
            let message = format!("there is no link {}", name.value);
            self.report(Diagnostic::new("E1105", name.span, message).help(help));
        }
        found
    }

    fn joint(&mut self, element: &Element) -> Option<Joint> {
        let name = self.name(element, "joint");
        self.once(
            element,
            &["parent", "child", "origin", "axis", "limit", "dynamics", "mimic", "safety_controller"],
        );
        let motion = self.motion(element);
        let (parent, child) = (self.named(element, "parent"), self.named(element, "child"));
        let origin = self.origin(element);
        // Files give axes without direction to joints that do not move.
        let axis =
            if motion == Some(Motion::Fixed) { Some(Point::new(1.0, 0.0, 0.0)) } else { self.axis(element) };
        let limit = element.child("limit");
        let mut of_limit = |name: &str| limit.and_then(|limit| self.number(limit, name));
        let (lower, upper) = (of_limit("lower"), of_limit("upper"));
        let (velocity, effort) = (of_limit("velocity"), of_limit("effort"));
        let dynamics = element.child("dynamics");
        let mut of_dynamics = |name: &str| dynamics.and_then(|dynamics| self.number(dynamics, name));
        let (damping, friction) = (of_dynamics("damping"), of_dynamics("friction"));
        Some(Joint {
            name: name?,
            span: element.span,
            motion: motion?,
            parent: parent?,
            child: child?,
            origin: origin?,
            axis: axis?,
            // As the format says: what is left out is 0.
            range: limit.map(|_| [lower.unwrap_or(0.0), upper.unwrap_or(0.0)]),
            velocity,
            effort,
            damping,
            friction,
            mimics: element.child("mimic").is_some(),
            has_soft_limits: element.child("safety_controller").is_some_and(|safety| {
                ["soft_lower_limit", "soft_upper_limit"].iter().any(|limit| safety.attribute(limit).is_some())
            }),
        })
    }

    fn motion(&mut self, element: &Element) -> Option<Motion> {
        let word = self.attribute(element, "type")?;
        let found = MOTIONS.iter().find(|(known, _)| *known == word.value).map(|(_, motion)| *motion);
        if found.is_none() {
            let message = format!("\"{}\" is no type of joint", word.value);
            let known = MOTIONS.map(|(word, _)| word).join(", ");
            self.report(Diagnostic::new("E1103", word.span, message).help(format!("write one of: {known}")));
        }
        found
    }

    fn axis(&mut self, element: &Element) -> Option<Point> {
        let value = element.child("axis").and_then(|axis| axis.attribute("xyz"));
        let axis = self.point(value, "xyz", Point::new(1.0, 0.0, 0.0))?;
        let length = axis.length();
        match (length < 1e-6, value) {
            (true, Some(value)) => {
                let message = "the axis of a joint has no direction".to_string();
                self.report(
                    Diagnostic::new("E1104", value.span, message).help("write a direction such as 0 0 1"),
                );
                None
            }
            _ => Some(axis.scaled(1.0 / length)),
        }
    }
}

/// A rotation about an axis through the origin, by the formula of Rodrigues; `axis` is a unit vector, the angle in rad.
pub fn about(axis: Point, angle: f64) -> Pose {
    let (s, c) = angle.sin_cos();
    let Point { x, y, z } = axis;
    let d = 1.0 - c;
    let rotation = [
        [c + x * x * d, x * y * d - z * s, x * z * d + y * s],
        [y * x * d + z * s, c + y * y * d, y * z * d - x * s],
        [z * x * d - y * s, z * y * d + x * s, c + z * z * d],
    ];
    Pose { rotation, position: Point::default() }
}
