//! What no list of elements can say: names that must be there and differ, and bodies that can exist.

use super::numbers;
use crate::xml::Element;

/// Names that mean something else.
const RESERVED: [&str; 1] = ["world"];

pub fn findings(root: &Element) -> Vec<String> {
    let mut found = Vec::new();
    names(root, &mut found);
    for world in root.all("world") {
        for model in world.all("model") {
            check_model(model, &mut found);
        }
    }
    found
}

fn name(element: &Element) -> &str {
    element.attribute("name").unwrap_or_default()
}

/// Of all things side by side, of whatever kind.
fn names(parent: &Element, found: &mut Vec<String>) {
    let named: Vec<&Element> = parent.children.iter().filter(|c| c.attribute("name").is_some()).collect();
    for (i, child) in named.iter().enumerate() {
        if named[..i].iter().any(|other| name(other) == name(child)) {
            found.push(format!("line {}: the name {} is taken", child.line, name(child)));
        }
        let is_legal = name(child).chars().all(|c| c.is_ascii_alphanumeric() || c == '_');
        if !is_legal || RESERVED.contains(&name(child)) || name(child).starts_with("__") {
            found.push(format!("line {}: the name {} has another meaning", child.line, name(child)));
        }
    }
    parent.children.iter().for_each(|child| names(child, found));
}

fn check_model(model: &Element, found: &mut Vec<String>) {
    let is_static = model.child("static").is_some_and(|s| s.text == "true");
    let is_link = |name: &str| model.named("link", name).is_some();
    let is_frame = |wanted: &str| model.children.iter().any(|c| c.attribute("name") == Some(wanted));
    for link in model.all("link") {
        match link.child("inertial") {
            Some(inertial) => check_inertia(inertial, found),
            None if !is_static => found.push(format!("line {}: a link without inertia", link.line)),
            None => {}
        }
        for shape in link.all("collision").chain(link.all("visual")) {
            let shapes = shape.child("geometry").map_or(0, |g| g.children.len());
            if shapes != 1 {
                found.push(format!("line {}: {shapes} shapes in a geometry", shape.line));
            }
        }
        for camera in link.all("sensor").filter_map(|s| s.child("logical_camera")) {
            if number(camera, "near") >= number(camera, "far") {
                found.push(format!("line {}: a camera that sees nothing", camera.line));
            }
        }
    }
    let mut children = Vec::new();
    for joint in model.all("joint") {
        let of = |end: &str| joint.child(end).map_or("", |e| e.text.as_str());
        let (parent, child) = (of("parent"), of("child"));
        let mut report = |what: String| found.push(format!("line {}: {what}", joint.line));
        if parent != "world" && !is_link(parent) {
            report(format!("a joint with the parent {parent}, which is not there"));
        }
        if !is_link(child) {
            report(format!("a joint with the child {child}, which is not there"));
        }
        if parent == child {
            report(format!("a joint from {parent} to itself"));
        }
        if children.contains(&child) {
            report(format!("a second joint to {child}"));
        }
        children.push(child);
        match (joint.attribute("type"), joint.child("axis")) {
            (Some("fixed"), None) => {}
            (Some("revolute" | "prismatic"), Some(axis)) => {
                let xyz = axis.child("xyz").and_then(numbers).unwrap_or_default();
                let length: f64 = xyz.iter().map(|c| c * c).sum();
                if (length - 1.0).abs() > 1e-9 {
                    report("an axis that is no unit vector".into());
                }
                if let Some(limit) = axis.child("limit")
                    && number(limit, "lower") >= number(limit, "upper")
                {
                    report("limits without room between them".into());
                }
            }
            (kind, _) => {
                report(format!("a joint of the type {} with or without an axis", kind.unwrap_or("none")))
            }
        }
    }
    let poses = model.children.iter().filter_map(|c| c.child("pose"));
    let relative = poses.filter_map(|p| Some((p, p.attribute("relative_to")?)));
    let attached = model.all("frame").filter_map(|f| Some((f, f.attribute("attached_to")?)));
    for (element, frame) in relative.chain(attached) {
        if !is_frame(frame) {
            found.push(format!("line {}: the frame {frame}, which is not there", element.line));
        }
    }
}

fn number(parent: &Element, child: &str) -> f64 {
    parent.child(child).and_then(numbers).and_then(|n| n.first().copied()).unwrap_or(f64::NAN)
}

/// A body has some extent in every direction: its second moments, half the trace less the tensor, are those of
/// a positive matrix. This is the triangle inequality of the principal moments, and more than their being positive.
fn check_inertia(inertial: &Element, found: &mut Vec<String>) {
    let Some(inertia) = inertial.child("inertia") else { return };
    let of = |name| number(inertia, name);
    let (xx, yy, zz) = (of("ixx"), of("iyy"), of("izz"));
    let (xy, xz, yz) = (of("ixy"), of("ixz"), of("iyz"));
    let half = (xx + yy + zz) / 2.0;
    let (a, b, c) = (half - xx, half - yy, half - zz);
    let second = a * b - xy * xy;
    let third = a * (b * c - yz * yz) + xy * (-xy * c - yz * xz) - xz * (xy * yz + b * xz);
    if !(a > 0.0 && second > 0.0 && third > 0.0) {
        found.push(format!("line {}: an inertia that no body has", inertia.line));
    }
}
