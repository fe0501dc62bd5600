//! Conveyors that nearly meet.

use crate::diagnostic::Diagnostic;
use crate::layout::Layout;
use runtime_sim::line::Line;
use runtime_sim::plant::{Gap, gaps};
use runtime_sim::point::Point;

/// One for each pair of conveyors of which one ends a little beside the beginning of the other one.
pub fn check(layout: &Layout, line: &Line) -> Vec<Diagnostic> {
    gaps(line).iter().filter_map(|gap| diagnostic(layout, line, gap)).collect()
}

fn diagnostic(layout: &Layout, line: &Line, gap: &Gap) -> Option<Diagnostic> {
    let [from, to] = [gap.from, gap.to].map(|(machine, part)| {
        let machine = &line.machines[machine];
        format!("`{}` of {}", machine.parts[part].name, machine.name)
    });
    let name = &line.machines[gap.to.0].name;
    let object = layout.objects.iter().find(|object| object.name.value == *name)?;
    let mm = gap.off.length() * 1000.0;
    let message = format!(
        "the conveyor {from} ends {mm:.0} mm from where {to} begins: they are not joined, and items fall where the first one ends"
    );
    let diagnostic = Diagnostic::new("W0201", object.pose.span, message);
    if gap.turn != 0.0 && gap.turn.abs() > ALIGNED {
        let note = format!("their directions differ by {:.1} degrees", gap.turn.abs());
        return Some(
            diagnostic.note(note).help("turn one of the machines, so that both have the same direction"),
        );
    }
    if gap.from.0 == gap.to.0 {
        return Some(diagnostic.help("let one begin where the other one ends, in the device"));
    }
    let Point { x, y, z } = object.pose.value.position + gap.off;
    let pose = [x, y, z].map(|number| format!("{}", (number * 1e6).round() / 1e6)).join(", ");
    let yaw = object.pose.value.yaw;
    let yaw = if yaw == 0.0 { String::new() } else { format!(", {yaw}") };
    Some(diagnostic.help(format!("if they should be joined, write \"pose\": [{pose}{yaw}] for {name}")))
}

/// Less is no fault of the direction, degrees.
const ALIGNED: f64 = 1.0;
