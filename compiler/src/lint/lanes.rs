//! Conveyors that nearly meet.

use crate::diagnostic::Diagnostic;
use crate::ir::System;
use crate::layout::{Layout, Object};
use crate::source::Span;
use runtime_sim::frame::Frame;
use runtime_sim::line::Line;
use runtime_sim::plant::{Gap, gaps};
use runtime_sim::point::Point;

/// One for each pair of conveyors of which one ends a little beside the beginning of the other one.
pub fn check(layout: &Layout, system: &System, line: &Line) -> Vec<Diagnostic> {
    gaps(line).iter().filter_map(|gap| diagnostic(layout, system, line, gap)).collect()
}

fn diagnostic(layout: &Layout, system: &System, line: &Line, gap: &Gap) -> Option<Diagnostic> {
    let [from, to] = [gap.from, gap.to].map(|(machine, part)| {
        let machine = &line.machines[machine];
        format!("`{}` of {}", machine.parts[part].name, machine.name)
    });
    let object = |machine: usize| {
        let name = &line.machines[machine].name;
        layout.objects.iter().find(|object| object.name.value == *name)
    };
    let [ends, begins] = [object(gap.from.0)?, object(gap.to.0)?];
    let mm = gap.off().length() * 1000.0;
    let message = format!(
        "the conveyor {from} ends {mm:.0} mm from where {to} begins: they are not joined, and items fall where the first one ends"
    );
    let is_turned = gap.turn().abs() > ALIGNED;
    let told = |place: Span| {
        let diagnostic = Diagnostic::new("W0201", place, message.clone());
        match is_turned {
            true => diagnostic.note(format!("their directions differ by {:.1} degrees", gap.turn().abs())),
            false => diagnostic,
        }
    };
    if gap.from.0 == gap.to.0 {
        let lane = system.automaton_of(gap.to.0).device.place_of(gap.to.1)?;
        let told = told(lane).other(begins.span, "for this machine");
        return Some(told.help("let one begin where the other one ends, in the device"));
    }
    let (root, other) = (stands(layout, begins), stands(layout, ends));
    if root.name.value == other.name.value {
        let told = told(begins.pose.span).other(ends.pose.span, "the other one");
        return Some(told.help(
            "the places of both come from one machine by \"at\": change a length or a turn of a conveyor between them",
        ));
    }
    // The machine as it is, with what begins at its ends, moved so that both meet.
    let moved = match is_turned {
        true => gap.end.then(gap.begin.inverse()).then(root.pose.value),
        false => Frame { position: root.pose.value.position + gap.off(), ..root.pose.value },
    };
    let rounded = |number: f64| format!("{}", (number * 1e6).round() / 1e6 + 0.0);
    let Point { x, y, z } = moved.position;
    let pose = [x, y, z].map(rounded).join(", ");
    let yaw = if moved.yaw == 0.0 { String::new() } else { format!(", {}", rounded(moved.yaw)) };
    let name = &root.name.value;
    let help = format!("if they should be joined, write \"pose\": [{pose}{yaw}] for {name}");
    Some(told(root.pose.span).help(help))
}

/// The machine with a pose from which one has its place by `at`, itself if it has a pose.
fn stands<'a>(layout: &'a Layout, object: &'a Object) -> &'a Object {
    let mut root = object;
    // No more steps than there are machines: a circle has been told of.
    for _ in &layout.objects {
        let before = root.at.as_ref().map(|at| &at.machine);
        let Some(next) = before.and_then(|name| layout.objects.iter().find(|o| o.name.value == *name)) else {
            break;
        };
        root = next;
    }
    root
}

/// Less is no fault of the direction, degrees.
const ALIGNED: f64 = 1.0;
