//! The device text of an imported arm.

use super::arm::fit::{Fit, JOINTS, turn};
use super::arm::{Arm, Body, Form, Joint, LISTS};
use super::{distinct, identifier};
use crate::plain;
use runtime_sim::kinematics::fixed::Geometry;
use runtime_sim::kinematics::opw::Opw;
use runtime_sim::kinematics::ur::Lengths;
use runtime_sim::point::Point;
use std::fmt::Write;

/// Frames of a chain, behind its joints.
const FRAMES: [&str; JOINTS] = ["shoulder", "upper_arm", "forearm", "wrist_1", "wrist_2", "wrist_3"];

/// `rest` is the place of the flange at the start, in the frame of the machine.
pub fn of_arm(arm: &Arm, rest: Point) -> String {
    let mut out = String::new();
    let _ = writeln!(
        out,
        "// From {}: {}. Written by `autogen import`.",
        comment(&arm.file),
        comment(&arm.title)
    );
    for note in &arm.notes {
        let _ = writeln!(out, "// - {}.", comment(note));
    }
    let _ = writeln!(out, "\n/// An arm, {}.", comment(&arm.title));
    let _ = writeln!(out, "device {} {{", arm.device);
    let _ = writeln!(out, "    /// From the flange ({}) to the tool centre point.", comment(&arm.flange));
    out += "    parameter tool_length: real := 0.0;\n";
    let has_speeds = !arm.joints.is_empty() && arm.joints.iter().all(|joint| joint.speed.is_some());
    if !has_speeds {
        out += "    /// Greatest velocity of each joint of which the file has none, rad/s.\n";
        out += "    parameter joint_speed: real;\n";
    }
    out += "    /// Greatest acceleration of each joint, rad/s2; the file has none.\n";
    out += "    parameter acceleration: real;\n\n";
    chain(arm, rest, &mut out);
    bodies(&arm.bodies, &mut out);
    out += "\n    /// tool centre point; moves with the arm\n";
    out += "    in tool: point unit \"m\" = arm.tool;\n";
    out += "    /// where to go\n";
    out += "    out goal: point unit \"m\";\n\n";
    out += "    /// tool to `goal`, all joints together\n";
    out += "    command 1 move(goal) = arm.joints(goal);\n\n";
    out += "    /// place of the tool at the start\n";
    out += "    constant rest: point unit \"m\" = arm.rest;\n";
    out += "}\n";
    out
}

fn chain(arm: &Arm, rest: Point, out: &mut String) {
    let Fit { base, yaw, geometry } = &arm.fit;
    let from = match (*base == Point::default(), *yaw == 0.0) {
        (true, true) => "origin".to_string(),
        _ => format!(
            "origin * frame({}, {}, {}, {})",
            number(base.x),
            number(base.y),
            number(base.z),
            number(*yaw)
        ),
    };
    *out += "    part arm = chain {\n";
    let mut line = |text: String| {
        let _ = writeln!(out, "        {text}");
    };
    line(format!("from: {from};"));
    match geometry {
        Geometry::OrthoParallel(Opw { a1, a2, b, c1, c2, c3, tool, offsets, signs }) => {
            line(format!("opw: {};", list(&[*a1, *a2, *b, *c1, *c2, *c3, *tool])));
            line(format!("offsets: {}; signs: {};", list(&offsets.map(turn)), list(signs)));
        }
        Geometry::UniversalRobots(Lengths { d1, a2, a3, d4, d5, tool }) => {
            line(format!("lengths: {};", list(&[*d1, *a2, *a3, *d4, *d5, *tool])));
        }
    }
    let each = |of: fn(&Joint) -> Option<f64>| -> Option<Vec<f64>> {
        (!arm.joints.is_empty()).then(|| arm.joints.iter().map(of).collect()).flatten()
    };
    let degrees = |values: Vec<f64>| list(&values.iter().map(|value| limit(*value)).collect::<Vec<_>>());
    if let (Some(lowest), Some(highest)) =
        (each(|joint| joint.range.map(|r| r[0])), each(|joint| joint.range.map(|r| r[1])))
    {
        line(format!("lowest: {};", degrees(lowest)));
        line(format!("highest: {};", degrees(highest)));
    }
    line("tool_length: tool_length;".into());
    line(format!(
        "rest: origin * point({}, {}, {}) - point(0, 0, tool_length);",
        number(rest.x),
        number(rest.y),
        number(rest.z)
    ));
    let speed =
        |joint: Option<&Joint>| joint.and_then(|joint| joint.speed).map_or("joint_speed".into(), number);
    let speeds: Vec<String> = (0..JOINTS).map(|i| speed(arm.joints.get(i))).collect();
    line(format!("speeds: [{}]; acceleration: acceleration;", speeds.join(", ")));
    if !arm.joints.is_empty() {
        let names = |name: fn(&Joint) -> &str| {
            let names = arm.joints.iter().map(|joint| identifier(name(joint), "joint")).collect();
            distinct(names).join(", ")
        };
        line(format!("joints: [{}];", names(|joint| &joint.name)));
        line(format!("links: [{}];", names(|joint| &joint.link)));
    }
    for (name, of) in LISTS {
        if let Some(values) = each(of) {
            line(format!("{name}: {};", list(&values)));
        }
    }
    *out += "    };\n";
}

fn bodies(bodies: &[Body], out: &mut String) {
    let names = bodies.iter().map(|body| identifier(&format!("{}_shape", body.link), "link")).collect();
    for (body, name) in bodies.iter().zip(distinct(names)) {
        let on = match body.on {
            Some(number) => format!("on: arm.{}", FRAMES[number]),
            None => "at: origin".into(),
        };
        // The last frame is the tool's.
        let shift = if body.on == Some(JOINTS - 1) { " - point(0, 0, tool_length)" } else { "" };
        let form = match body.form {
            Form::Box { low, high } => format!("low: {}{shift}; high: {}{shift}", point(low), point(high)),
            Form::Capsule { from, axis, length, radius } => format!(
                "from: {}{shift}; direction: {}; length: {}; radius: {}",
                point(from),
                ["x", "y", "z"][axis],
                number(length),
                number(radius)
            ),
        };
        let _ = writeln!(out, "    part {name} = body {{ {on}; {form}; }};");
    }
}

/// On one line, and no end of a comment.
fn comment(text: &str) -> String {
    plain::line(text)
}

/// To 1e-7: a tenth of a micrometre.
pub fn number(value: f64) -> String {
    let rounded = (value * 1e7).round() / 1e7;
    if rounded == 0.0 { "0".into() } else { rounded.to_string() }
}

/// Degrees of a limit, to 1e-6.
fn limit(angle: f64) -> f64 {
    (angle.to_degrees() * 1e6).round() / 1e6
}

fn list(values: &[f64]) -> String {
    format!("[{}]", values.iter().map(|value| number(*value)).collect::<Vec<_>>().join(", "))
}

fn point(Point { x, y, z }: Point) -> String {
    format!("point({}, {}, {})", number(x), number(y), number(z))
}
