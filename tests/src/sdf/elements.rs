//! Which elements and attributes may stand in which element, and what they hold
//! (SDF 1.7, http://sdformat.org/spec?ver=1.7; only those that worlds of this project use).

use super::numbers;
use crate::xml::Element;
use Count::*;
use Holds::*;

/// What stands between the tags.
#[derive(Clone, Copy, PartialEq)]
enum Holds {
    Elements,
    Name,
    Bool,
    Number,
    /// Greater than 0.
    Positive,
    /// 0 or greater.
    Magnitude,
    Vector(usize),
    /// All greater than 0.
    Sizes(usize),
    /// From 0 to 1.
    Colour,
}

#[derive(Clone, Copy, PartialEq)]
enum Count {
    Once,
    AtMostOnce,
    Any,
    AtLeastOnce,
}

/// Parent, element, how often, what it holds, attributes; those with `!` must be there.
/// Without elements in the text a simulator would take the specification's default, which is never meant here:
/// lengths, masses and limits are therefore needed even where the specification calls them optional.
const TABLE: &[(&str, &str, Count, Holds, &[&str])] = &[
    ("", "sdf", Once, Elements, &["version!"]),
    ("sdf", "world", Once, Elements, &["name!"]),
    ("world", "physics", AtLeastOnce, Elements, &["name", "default", "type!"]),
    ("physics", "max_step_size", Once, Positive, &[]),
    ("physics", "real_time_factor", Once, Positive, &[]),
    ("physics", "real_time_update_rate", Once, Positive, &[]),
    ("world", "gravity", Once, Vector(3), &[]),
    ("world", "scene", Once, Elements, &[]),
    ("scene", "ambient", Once, Colour, &[]),
    ("scene", "background", Once, Colour, &[]),
    ("scene", "shadows", Once, Bool, &[]),
    ("world", "light", Any, Elements, &["name!", "type!"]),
    ("light", "cast_shadows", AtMostOnce, Bool, &[]),
    ("light", "pose", AtMostOnce, Vector(6), &["relative_to"]),
    ("light", "diffuse", AtMostOnce, Colour, &[]),
    ("light", "specular", AtMostOnce, Colour, &[]),
    ("light", "direction", Once, Vector(3), &[]),
    ("world", "model", Any, Elements, &["name!", "canonical_link"]),
    ("model", "static", AtMostOnce, Bool, &[]),
    ("model", "pose", AtMostOnce, Vector(6), &["relative_to"]),
    ("model", "link", AtLeastOnce, Elements, &["name!"]),
    ("model", "joint", Any, Elements, &["name!", "type!"]),
    ("model", "frame", Any, Elements, &["name!", "attached_to"]),
    ("frame", "pose", AtMostOnce, Vector(6), &["relative_to"]),
    ("link", "pose", AtMostOnce, Vector(6), &["relative_to"]),
    ("link", "gravity", AtMostOnce, Bool, &[]),
    ("link", "inertial", AtMostOnce, Elements, &[]),
    ("inertial", "pose", AtMostOnce, Vector(6), &["relative_to"]),
    ("inertial", "mass", Once, Positive, &[]),
    ("inertial", "inertia", Once, Elements, &[]),
    ("inertia", "ixx", Once, Positive, &[]),
    ("inertia", "ixy", Once, Number, &[]),
    ("inertia", "ixz", Once, Number, &[]),
    ("inertia", "iyy", Once, Positive, &[]),
    ("inertia", "iyz", Once, Number, &[]),
    ("inertia", "izz", Once, Positive, &[]),
    ("link", "collision", Any, Elements, &["name!"]),
    ("collision", "pose", AtMostOnce, Vector(6), &["relative_to"]),
    ("collision", "geometry", Once, Elements, &[]),
    ("collision", "surface", AtMostOnce, Elements, &[]),
    ("surface", "friction", AtMostOnce, Elements, &[]),
    ("friction", "ode", AtMostOnce, Elements, &[]),
    ("ode", "mu", Once, Magnitude, &[]),
    ("ode", "mu2", Once, Magnitude, &[]),
    ("link", "visual", Any, Elements, &["name!"]),
    ("visual", "pose", AtMostOnce, Vector(6), &["relative_to"]),
    ("visual", "geometry", Once, Elements, &[]),
    ("visual", "material", AtMostOnce, Elements, &[]),
    ("material", "ambient", AtMostOnce, Colour, &[]),
    ("material", "diffuse", AtMostOnce, Colour, &[]),
    ("geometry", "box", AtMostOnce, Elements, &[]),
    ("box", "size", Once, Sizes(3), &[]),
    ("geometry", "cylinder", AtMostOnce, Elements, &[]),
    ("cylinder", "radius", Once, Positive, &[]),
    ("cylinder", "length", Once, Positive, &[]),
    ("geometry", "sphere", AtMostOnce, Elements, &[]),
    ("sphere", "radius", Once, Positive, &[]),
    ("geometry", "plane", AtMostOnce, Elements, &[]),
    ("plane", "normal", Once, Vector(3), &[]),
    ("plane", "size", Once, Sizes(2), &[]),
    ("link", "sensor", Any, Elements, &["name!", "type!"]),
    ("sensor", "pose", AtMostOnce, Vector(6), &["relative_to"]),
    ("sensor", "always_on", AtMostOnce, Bool, &[]),
    ("sensor", "update_rate", Once, Positive, &[]),
    ("sensor", "visualize", AtMostOnce, Bool, &[]),
    ("sensor", "logical_camera", AtMostOnce, Elements, &[]),
    ("logical_camera", "near", Once, Positive, &[]),
    ("logical_camera", "far", Once, Positive, &[]),
    ("logical_camera", "aspect_ratio", Once, Positive, &[]),
    ("logical_camera", "horizontal_fov", Once, Positive, &[]),
    ("joint", "pose", AtMostOnce, Vector(6), &["relative_to"]),
    ("joint", "parent", Once, Name, &[]),
    ("joint", "child", Once, Name, &[]),
    ("joint", "axis", AtMostOnce, Elements, &[]),
    ("axis", "xyz", Once, Vector(3), &["expressed_in"]),
    ("axis", "limit", Once, Elements, &[]),
    ("limit", "lower", Once, Number, &[]),
    ("limit", "upper", Once, Number, &[]),
    ("limit", "effort", Once, Positive, &[]),
    ("limit", "velocity", Once, Positive, &[]),
    ("axis", "dynamics", AtMostOnce, Elements, &[]),
    ("dynamics", "damping", AtMostOnce, Magnitude, &[]),
    ("dynamics", "friction", AtMostOnce, Magnitude, &[]),
    ("dynamics", "spring_reference", Once, Number, &[]),
    ("dynamics", "spring_stiffness", Once, Magnitude, &[]),
];

/// What stands where it may not, is missing, or holds something else.
pub fn findings(root: &Element) -> Vec<String> {
    let mut found = Vec::new();
    let outside = Element { children: vec![root.clone()], ..Element::default() };
    within(&outside, &mut found);
    found
}

fn within(parent: &Element, found: &mut Vec<String>) {
    for (_, name, times, ..) in TABLE.iter().filter(|row| row.0 == parent.name) {
        let count = parent.all(name).count();
        let is_right = match times {
            Once => count == 1,
            AtMostOnce => count <= 1,
            AtLeastOnce => count >= 1,
            Any => true,
        };
        if !is_right {
            found.push(format!("line {}: <{}> has {count} <{name}>", parent.line, parent.name));
        }
    }
    for child in &parent.children {
        match TABLE.iter().find(|row| row.0 == parent.name && row.1 == child.name) {
            Some((.., holds, attributes)) => {
                check(child, *holds, attributes, found);
                within(child, found);
            }
            None => found.push(format!("line {}: <{}> in <{}>", child.line, child.name, parent.name)),
        }
    }
}

fn check(element: &Element, holds: Holds, attributes: &[&str], found: &mut Vec<String>) {
    let mut report = |what: String| found.push(format!("line {}: <{}> {what}", element.line, element.name));
    for (name, _) in &element.attributes {
        if !attributes.iter().any(|a| a.trim_end_matches('!') == name) {
            report(format!("has the attribute {name}"));
        }
    }
    for name in attributes.iter().filter_map(|a| a.strip_suffix('!')) {
        if element.attribute(name).is_none_or(str::is_empty) {
            report(format!("has no attribute {name}"));
        }
    }
    let values = numbers(element);
    let are = |count: usize, rule: fn(f64) -> bool| {
        values.as_ref().is_some_and(|v| v.len() == count && v.iter().all(|n| rule(*n)))
    };
    let is_right = match holds {
        Elements => element.text.is_empty(),
        Name => !element.text.is_empty(),
        Bool => ["true", "false"].contains(&element.text.as_str()),
        Number => are(1, |_| true),
        Positive => are(1, |n| n > 0.0),
        Magnitude => are(1, |n| n >= 0.0),
        Vector(count) => are(count, |_| true),
        Sizes(count) => are(count, |n| n > 0.0),
        Colour => are(4, |n| (0.0..=1.0).contains(&n)),
    };
    if !is_right || (holds != Elements && !element.children.is_empty()) {
        report(format!("holds `{}`", element.text));
    }
}
